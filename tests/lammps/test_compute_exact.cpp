// SPDX-License-Identifier: GPL-2.0-only

#include "aleisph_exact.h"
#include "script.h"
#include "simulation.h"

#include <gtest/gtest.h>

#include <cmath>
#include <functional>

namespace {

namespace exact = aleisph::exact;
using Values = std::array<double, 4>;    // vx vy vz p

struct Case {
  std::string arguments;
  std::function<Values(double x, double y, double z, double t)> solution;
};

const std::vector<Case> &cases()
{
  static const std::vector<Case> all = {
      {"pipe 2.0 3.0 0.5",
       [](double, double y, double z, double t) {
         return Values{exact::pipe_poiseuille(std::hypot(y, z), t, 2.0, 3.0, 0.5), 0, 0, 0};
       }},
      {"plane 2.0 3.0 0.5",
       [](double, double y, double, double t) {
         return Values{exact::plane_poiseuille(y, t, 2.0, 3.0, 0.5), 0, 0, 0};
       }},
      {"couette 2.0 3.0 0.5",
       [](double, double y, double, double t) {
         return Values{exact::couette(y, t, 2.0, 3.0, 0.5), 0, 0, 0};
       }},
      {"taylor-green 2.0 3.0 4.0 0.05",
       [](double x, double y, double, double t) {
         const auto f = exact::taylor_green({x, y, t}, 2.0, 3.0, 4.0, 0.05);
         return Values{f.u, f.v, 0, f.p};
       }},
      {"stokes 1.0 2.0 3.0 4.0 0.05", [](double x, double y, double, double t) {
         const auto f = exact::stokes_mode({x, y, t}, 1.0, 2.0, 3.0, 4.0, 0.05);
         return Values{f.u, f.v, 0, f.p};
       }}};
  return all;
}

// a cube of resting atoms, no fixes: only positions and time matter
Scene cube()
{
  Scene scene = tank(3, 3);
  scene.boundary = "f f f";
  return scene;
}

void expect_solution(const Simulation &sim, const Case &item, double t)
{
  const auto x = sim.x(0), y = sim.x(1), z = sim.x(2);
  for (int c = 0; c < 4; c++) {
    const auto column = sim.compute("ex", c + 1);
    for (std::size_t i = 0; i < x.size(); i++)
      EXPECT_EQ(column[i], item.solution(x[i], y[i], z[i], t)[c]);
  }
}

}    // namespace

// At the start, after 7 steps, after 7 more with another step: time is what LAMMPS says it is
TEST(ComputeExact, ValuesAndTime)
{
  for (const auto &item : cases()) {
    SCOPED_TRACE(item.arguments);
    Simulation sim(cube());
    sim.run("timestep 0.01\ncompute ex all aleisph/exact " + item.arguments + "\nrun 0");
    expect_solution(sim, item, 0.0);
    sim.run("run 7");
    expect_solution(sim, item, sim.variable("time"));
    EXPECT_NEAR(sim.variable("time"), 0.07, 1e-12);
    sim.run("timestep 0.02\nrun 7");
    expect_solution(sim, item, sim.variable("time"));
    EXPECT_NEAR(sim.variable("time"), 0.21, 1e-12);
  }
}

TEST(ComputeExact, Steady)
{
  for (std::size_t k = 0; k < 3; k++) {
    const auto &item = cases()[k];
    SCOPED_TRACE(item.arguments);
    Simulation sim(cube());
    sim.run("timestep 0.01\ncompute ex all aleisph/exact " + item.arguments + " steady\nrun 3");
    expect_solution(sim, item, -1.0);
  }
}

// G (R^2 - r^2)/(4 nu), G (H^2 - y^2)/(2 nu), U y/H
TEST(ComputeExact, SteadyProfiles)
{
  const std::vector<std::pair<std::string, std::function<double(double, double)>>> profiles = {
      {"pipe 2.0 3.0 0.5", [](double y, double z) { return 3.0 * (4.0 - y * y - z * z) / 2.0; }},
      {"plane 2.0 3.0 0.5", [](double y, double) { return 3.0 * (4.0 - y * y); }},
      {"couette 2.0 3.0 0.5", [](double y, double) { return 1.5 * y; }}};
  for (const auto &item : profiles) {
    SCOPED_TRACE(item.first);
    Simulation sim(cube());
    sim.run("compute ex all aleisph/exact " + item.first + " steady\nrun 0");
    const auto expected = sim.at_particles(
        [&](double, double y, double z) { return item.second(y, z); });
    EXPECT_LE(largest(sim.compute("ex", 1), expected), 1e-12);
  }
}

TEST(ComputeExact, OnlyItsGroup)
{
  Simulation sim(cube());
  sim.run("compute ex fluid aleisph/exact couette 2.0 3.0 0.5 steady\nrun 0");
  const auto type = sim.type(), u = sim.compute("ex", 1);
  for (std::size_t i = 0; i < u.size(); i++) EXPECT_EQ(u[i] != 0.0, type[i] == Scene::FLUID);
}

// it can be dumped, reduced and used in variables
TEST(ComputeExact, InVariables)
{
  Simulation sim(cube());
  sim.run("compute ex all aleisph/exact couette 2.0 3.0 0.5 steady\n"
          "variable twice atom 2*c_ex[1]\ncompute m all reduce max v_twice\n"
          "thermo_style custom step c_m\nrun 0");
  EXPECT_NEAR(sim.variable("c_m"), 3.0, 1e-12);    // at y = 1
}
