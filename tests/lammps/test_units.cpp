// SPDX-License-Identifier: GPL-2.0-only

#include "script.h"
#include "simulation.h"

#include <gtest/gtest.h>

namespace {

// Cavity flow with gravity in units of length L, time T and density rho; returns u T/L, v T/L and
// p/(rho L^2/T^2)
std::vector<double> flow(const std::string &units, double length, double time, double rho0)
{
  Scene scene = tank(2, 8).jitter(0.1).scale(length);
  scene.units = units;
  scene.rho0 = rho0;
  Simulation sim(scene);
  Script script = script_of(scene);
  const double speed = length / time;
  script.wall = fmt::format("region top block INF INF {} INF INF INF\ngroup up region top\n"
                            "group lid intersect up wall\ngroup rest subtract wall lid\n"
                            "fix rest rest aleisph/wall\n"
                            "fix lid lid aleisph/wall velocity {} 0 0 vstar curlcurl",
                            0.95 * length, speed);
  script.body = fmt::format("fix push all addforce 0 {} 0",
                            -rho0 * scene.d * scene.d * speed / time);
  script.predictor += fmt::format(" nu {}", 0.1 * speed * length);
  script.timestep = fmt::format("timestep {}", 0.01 * time);
  sim.run(script.text() + "run 10");

  std::vector<double> all;
  for (int a = 0; a < 2; a++)
    for (const double v : sim.v(a)) all.push_back(v / speed);
  for (const double p : sim.pressure()) all.push_back(p / (rho0 * speed * speed));
  return all;
}

}    // namespace

// Rounding differs, and with it where the solver stops: 1e-12 of the scaled right hand side
TEST(Units, DoNotMatter)
{
  const auto reference = flow("lj", 1.0, 1.0, 1.0);
  EXPECT_GT(largest(reference), 0.5);
  EXPECT_LE(largest(flow("si", 1.0, 1.0, 1.0), reference), 1e-9);
  EXPECT_LE(largest(flow("si", 1e-3, 1e-2, 1000.0), reference), 1e-9);
  EXPECT_LE(largest(flow("cgs", 1e-1, 1e-2, 1.0), reference), 1e-9);
  EXPECT_LE(largest(flow("micro", 30.0, 2.0, 1e-3), reference), 1e-9);
  EXPECT_LE(largest(flow("nano", 50.0, 3.0, 1.0), reference), 1e-9);
}
