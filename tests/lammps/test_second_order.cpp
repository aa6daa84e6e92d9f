// SPDX-License-Identifier: GPL-2.0-only
/* ----------------------------------------------------------------------
   fix aleisph/ppe: walls of second order, impulses, what is given back.
------------------------------------------------------------------------- */

#include "errors.h"

#include <algorithm>
#include <cmath>

namespace {

/* ----------------------------------------------------------------------
   A plate that starts impulsively with U = 1, at the left end of a tank of depth
   1 whose other end is five depths away. Impulse on the plate over rho U h^2, from
   the linear theory: sum of 16 h^2/pi^3/(2n-1)^3 = 0.54274. The pressure is
   singular at the contact line, so that n.grad p of the plate is of first order.
------------------------------------------------------------------------- */

constexpr double IMPULSE = 0.54274;

Scene plate_tank(int n)
{
  Scene scene;
  scene.d = 1.0 / (n + 0.5);
  const double d = scene.d;
  const int length = static_cast<int>(std::lround(5.0 / d));
  scene.boundary = "m m p";
  scene.low = {-0.5 * d, -0.5 * d, -0.5 * d};
  scene.high = {(length + 0.5) * d, 1.0 + 6.0 * d, 0.5 * d};
  for (int j = 0; j <= n + 6; j++)
    for (int i = 0; i <= length; i++) {
      const bool wall = i == 0 || i == length || j == 0;
      if (wall || j <= n) scene.add(wall ? Scene::WALL : Scene::FLUID, i * d, j * d);
    }
  return scene;
}

// the impulses of some steps
std::vector<double> impulses(int n, const std::string &ppe, int steps)
{
  const Scene scene = plate_tank(n);
  const double d = scene.d, dt = 1.0e-4 * d;
  Simulation sim(scene);
  Script script = free_script(scene);
  script.shift = "";
  script.wall = fmt::format("region plate block INF {} {} INF INF INF units box\n"
                            "group left region plate\ngroup plate intersect left wall\n"
                            "group rest subtract wall plate\n"
                            "fix wall rest aleisph/wall condition slip\n"
                            "fix plate plate aleisph/wall condition slip velocity 1.0 0 0",
                            0.1 * d, 0.5 * d);
  script.predictor = "fix pred fluid aleisph/predictor";
  script.ppe = "fix ppe all aleisph/ppe tol 1e-10 " + ppe;
  script.timestep = fmt::format("timestep {}", dt);
  sim.run(script.text());
  std::vector<double> all;
  for (int k = 0; k < steps; k++) {
    sim.run("run 1 post no");
    const auto p = sim.pressure(), y = sim.x(1);
    double sum = 0.0;
    for (std::size_t i = 0; i < p.size(); i++)
      if (scene.x[i][0] < 0.1 * d && y[i] > 0.1 * d) sum += p[i] * dt * d;
    all.push_back(sum);
  }
  return all;
}

}    // namespace

// Measured: 0.516, 0.528. With a v* of the plate that is that of a wall at rest it was 0.22, 0.24.
TEST(Walls, StartOfAPlateIsTakenUpInTheFirstStep)
{
  const auto coarse = impulses(20, "", 1), fine = impulses(40, "", 3);
  EXPECT_NEAR(fine[0], IMPULSE, 0.04 * IMPULSE);
  for (int k = 1; k < 3; k++) EXPECT_LE(std::fabs(fine[k]), 0.01 * fine[0]);
  const double order = std::log2((IMPULSE - coarse[0]) / (IMPULSE - fine[0]));
  EXPECT_GE(order, 0.7);
}

/* ----------------------------------------------------------------------
   Fluid in a closed box, stirred by a force until it flows steadily: a flow that
   has nothing to do with the time step
------------------------------------------------------------------------- */

namespace {

// velocities at the end, steps dt
std::vector<double> stirred(const std::string &ppe, double dt)
{
  const Scene scene = tank(2, 16);
  Simulation sim(scene);
  Script script = script_of(scene);
  script.body = fmt::format("variable fx atom {0}*sin(PI*x)^2*sin(2*PI*y)\n"
                            "variable fy atom -{0}*sin(2*PI*x)*sin(PI*y)^2\n"
                            "fix stir all addforce v_fx v_fy 0",
                            2.0 * scene.d * scene.d);
  script.predictor += " frame eulerian nu 0.02 integrator ab2";
  script.ppe = "fix ppe all aleisph/ppe tol 1e-8 " + ppe;
  script.timestep = fmt::format("timestep {}", dt);
  sim.run(script.text() + fmt::format("run {}", std::lround(12.0 / dt)));
  std::vector<double> all = sim.v(0), w = sim.v(1);
  all.insert(all.end(), w.begin(), w.end());
  return all;
}

}    // namespace

// Steps of 0.36 and 0.18 d/v. Measured: 0.0011 of the flow, and 0.030 of it if nothing is given back.
TEST(Increment, SteadyFlowDoesNotDependOnTheStep)
{
  const double with = relative_l2(stirred("", 0.012), stirred("", 0.006));
  const double without = relative_l2(stirred("increment no", 0.012),
                                     stirred("increment no", 0.006));
  EXPECT_LE(with, 0.003);
  EXPECT_GE(without, 10.0 * with);
}

// value 13 is value 3 times the step
TEST(Increment, ChangeOfVolume)
{
  const Scene scene = tank(2, 10);
  Simulation sim(scene);
  Script script = script_of(scene);
  script.predictor += " frame eulerian nu 0.01 integrator ab2";
  script.timestep = "timestep 0.01\nvariable u atom sin(PI*x)^2*sin(2*PI*y)\n"
                    "velocity fluid set v_u 0 0";
  sim.run(script.text() + "run 5");
  EXPECT_GT(sim.fix("ppe", 13), 0.0);
  EXPECT_DOUBLE_EQ(sim.fix("ppe", 13), 0.01 * sim.fix("ppe", 3));
}

// where particles move there is nothing to give back
TEST(Increment, NotInFramesThatMove)
{
  const Scene scene = tank(2, 8).jitter(0.1);
  std::vector<double> v[2];
  for (int k = 0; k < 2; k++) {
    Simulation sim(scene);
    Script script = script_of(scene);
    script.ppe += k ? " increment yes" : " increment no";
    script.timestep = "timestep 0.01\nvariable u atom sin(PI*x)^2*sin(2*PI*y)\n"
                      "velocity fluid set v_u 0 0";
    sim.run(script.text() + "run 5");
    v[k] = sim.v(0);
  }
  EXPECT_EQ(v[0], v[1]);
}

/* ----------------------------------------------------------------------
   Wrong input
------------------------------------------------------------------------- */

TEST(SecondOrderErrors, Keywords)
{
  expect_errors({
      {"motion without a value",
       [](Script &s) { s.predictor += " motion"; },
       {"ix aleisph/predictor", "motion"}},
      {"motion",
       [](Script &s) { s.predictor += " motion leapfrog"; },
       {"ix aleisph/predictor", "motion must be verlet or euler", "not leapfrog"}},
      {"walls without a value", [](Script &s) { s.ppe += " walls"; }, {"ix aleisph/ppe", "walls"}},
      {"walls",
       [](Script &s) { s.ppe += " walls third"; },
       {"ix aleisph/ppe", "walls must be second or first", "not third"}},
      {"increment without a value",
       [](Script &s) { s.ppe += " increment"; },
       {"ix aleisph/ppe", "increment"}},
      {"increment", [](Script &s) { s.ppe += " increment maybe"; }, {"boolean", "maybe"}},
  });
}
