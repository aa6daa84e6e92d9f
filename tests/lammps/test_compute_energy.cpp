// SPDX-License-Identifier: GPL-2.0-only
/* ----------------------------------------------------------------------
   compute aleisph/energy against closed forms. Areas of surfaces are tested
   with the numerics (test_surface_area.cpp).
------------------------------------------------------------------------- */

#include "errors.h"
#include "tension_script.h"

#include <algorithm>
#include <cmath>

namespace {

constexpr double SUMS = 1.0e-12;    // relative, of some hundred terms
enum Part { TOTAL, KINETIC, POTENTIAL, SURFACE };

double energy(const Simulation &sim, Part part)
{
  return sim.variable(part == TOTAL ? "c_e" : fmt::format("c_e[{}]", static_cast<int>(part)));
}

std::string compute(const std::string &keywords, const std::string &group = "fluid")
{
  return fmt::format("\ncompute e {} aleisph/energy {}\n"
                     "thermo_style custom step c_e c_e[1] c_e[2] c_e[3]\nthermo 1\n",
                     group, keywords);
}

Scene still_tank(int dimension, const std::string &units)
{
  Scene scene = tank(dimension, 7);
  scene.units = units;
  scene.rho0 = 1000.0;
  return scene;
}

}    // namespace

// v = (a y, 0, b x) or in 2d (a y, b x): sums over the particles themselves
TEST(Energy, KineticAndPotential)
{
  for (const std::string units : {"lj", "si"})
    for (const int dimension : {2, 3}) {
      SCOPED_TRACE(units + " " + std::to_string(dimension));
      const Scene scene = still_tank(dimension, units);
      Simulation sim(scene);
      const char *gravity = dimension == 2 ? "gravity 0.5 -9.81 0" : "gravity 0.5 -9.81 2.0";
      sim.run(script_of(scene).text() +
              "variable a atom 0.3*y\nvariable b atom -0.2*x\nvelocity all set v_a v_b 0\n" +
              compute(std::string(gravity) + " origin 0.1 0.2 0.3", "all") + "run 0");
      const double m = scene.rho0 * std::pow(scene.d, dimension);
      const auto x = sim.x(0), y = sim.x(1), z = sim.x(2), u = sim.v(0), v = sim.v(1);
      const auto type = sim.type();
      double kinetic = 0.0, potential = 0.0;
      for (std::size_t i = 0; i < x.size(); i++) {
        if (type[i] != Scene::FLUID) continue;    // walls have no energy
        kinetic += 0.5 * m * (u[i] * u[i] + v[i] * v[i]);
        potential -= m * (0.5 * (x[i] - 0.1) - 9.81 * (y[i] - 0.2));
        if (dimension == 3) potential -= m * 2.0 * (z[i] - 0.3);
      }
      EXPECT_GT(kinetic, 0.0);
      EXPECT_NEAR(energy(sim, KINETIC), kinetic, SUMS * kinetic);
      EXPECT_NEAR(energy(sim, POTENTIAL), potential, SUMS * std::fabs(potential));
      EXPECT_EQ(energy(sim, SURFACE), 0.0);
      EXPECT_NEAR(energy(sim, TOTAL), kinetic + potential, SUMS * (kinetic + potential));
    }
}

// nothing that is not asked for
TEST(Energy, NoGravityNoPotential)
{
  const Scene scene = still_tank(2, "lj");
  Simulation sim(scene);
  sim.run(script_of(scene).text() + compute("") + "run 0");
  for (const Part part : {TOTAL, KINETIC, POTENTIAL, SURFACE}) EXPECT_EQ(energy(sim, part), 0.0);
}

TEST(Energy, OfAGroup)
{
  const Scene scene = still_tank(2, "lj");
  const auto fluid = std::find(scene.type.begin(), scene.type.end(), Scene::FLUID);
  const auto one = fluid - scene.type.begin();
  Simulation sim(scene);
  sim.run(fmt::format("group one id {}\n", one + 1) + script_of(scene).text() +
          "velocity all set 0.5 0 0\n" + compute("", "one") + "run 0");
  EXPECT_NEAR(energy(sim, KINETIC), 0.5 * scene.rho0 * scene.d * scene.d * 0.25, SUMS);
}

// A fluid that falls through periodic boundaries: E = const. Gravity is exact for parabolas in
// symplectic Euler but for the energy g^2 t dt/2 per mass.
TEST(Energy, GoesOnThroughPeriodicBoundaries)
{
  constexpr double G = 2.0, DT = 0.01;
  constexpr int STEPS = 150;    // 2.25 periods
  const Scene scene = periodic_square(8);
  Simulation sim(scene);
  Script script = script_of(scene);
  script.body = fmt::format("fix g all gravity {} vector 1 0 0", G);
  script.timestep = fmt::format("timestep {}", DT);
  sim.run(script.text() + compute(fmt::format("gravity {} 0 0", G)) + "run 0");
  const double before = energy(sim, TOTAL);
  sim.run(fmt::format("run {}", STEPS));
  const double t = STEPS * DT, v = G * t;
  EXPECT_NEAR(energy(sim, KINETIC), 0.5 * v * v, 1.0e-9 * v * v);
  EXPECT_GT(std::fabs(energy(sim, POTENTIAL)), G * 1.0);    // more than the box has
  EXPECT_NEAR(energy(sim, TOTAL), before, 0.5 * G * G * t * DT + 1.0e-9);
}

// sigma times the circumference, or area, of the drop; second order in d/R (test_surface_area.cpp).
// Rings are not quite those of a disc at rest.
TEST(Energy, SurfaceOfDrops)
{
  for (const int dimension : {2, 3}) {
    SCOPED_TRACE(dimension);
    const int layers = dimension == 2 ? 10 : 6;
    const Scene scene = dimension == 2 ? tension::disc(layers) : tension::ball(layers);
    Simulation sim(scene);
    sim.run(tension::tension_script(scene).text() + compute("", "all") + "run 0");
    const double R = tension::radius(layers);
    const double exact = tension::SIGMA *
        (dimension == 2 ? 2.0 * tension::PI * R : 4.0 * tension::PI * R * R);
    const double share = 0.2 * scene.d * scene.d / (R * R);
    EXPECT_NEAR(energy(sim, SURFACE), exact, share * exact);
    EXPECT_EQ(energy(sim, TOTAL), energy(sim, SURFACE));

    sim.run("uncompute e" + compute("surface no", "all") + "run 0");
    EXPECT_EQ(energy(sim, SURFACE), 0.0);
  }
}

// A flat surface between walls, angle 90 degrees: sigma times the width between the wall particles.
// The walls need not be of one plane then.
TEST(Energy, SurfaceBetweenWalls)
{
  const Scene scene = open_tank(2, 12);
  Simulation sim(scene);
  sim.run(tension::tension_script(scene, "angle wall 90").text() + compute("") + "run 0");
  const auto x = sim.x(0);
  double low = 1.0e9, high = -1.0e9;
  for (const double place : x) {
    low = std::min(low, place);
    high = std::max(high, place);
  }
  EXPECT_NEAR(energy(sim, SURFACE), tension::SIGMA * (high - low), 1.0e-9);
}

TEST(EnergyErrors, Walls)
{
  const Scene scene = open_tank(2, 12);
  Simulation sim(scene);
  const std::string message = sim.error_of(tension::tension_script(scene, "angle wall 60").text() +
                                           compute("") + "run 0");
  EXPECT_NE(message.find("ompute aleisph/energy: the surface energy is known only"),
            std::string::npos)
      << message;
  EXPECT_NE(message.find("surface no"), std::string::npos);
  Simulation other(scene);
  EXPECT_EQ(other.error_of(tension::tension_script(scene, "angle wall 60").text() +
                           compute("surface no") + "run 0"),
            "");
}

TEST(EnergyErrors, Command)
{
  const Scene scene = still_tank(2, "lj");
  struct Case {
    const char *keywords, *message;
  };
  for (const auto &item :
       {Case{"height 1", "unknown keyword height"}, Case{"gravity 0 -1", "gravity"},
        Case{"gravity 0 -1 3", "gravity along z must be 0 in 2d"},
        Case{"gravity 0 1e400 0", "1e400"}, Case{"origin 0 x 0", "x"},
        Case{"surface perhaps", "perhaps"}, Case{"surface", "surface"}}) {
    SCOPED_TRACE(item.keywords);
    Simulation sim(scene);
    const std::string found = sim.error_of(script_of(scene).text() + compute(item.keywords));
    EXPECT_NE(found.find(item.message), std::string::npos) << found;
  }
  Simulation sim(scene);
  EXPECT_NE(sim.error_of(compute("") + "run 0").find("needs a fix aleisph"), std::string::npos);
}

TEST(EnergyErrors, BeforeTheFirstRun)
{
  const Scene scene = still_tank(2, "lj");
  Simulation sim(scene);
  EXPECT_NE(sim.error_of(script_of(scene).text() + compute("") + "print $(c_e)"), "");
}
