// SPDX-License-Identifier: GPL-2.0-only
/* ----------------------------------------------------------------------
   A closed tank at rest under gravity. The corrected operators are exact
   for linear fields, so p = rho g (z0 - z) to what the solver leaves.

   Tolerances. The scaled right hand side is rho g d on the N_w wall rows of
   bottom and top, so the solver leaves a residual of 1e-13 rho g d
   sqrt(N_w), and |A^-1| is about (H/(pi d))^2. For H/d <= 10, N_w <= 200:
   an error of p of 1e-13 * 10 * 15 rho g d = 1.5e-12 rho g H, and of
   dt/rho grad p of that per H, or, for the shortest waves,
   1e-13 * 15 g dt = 1.5e-12 g dt. The required 1e-11 leaves a factor 6.
------------------------------------------------------------------------- */

#include "aleisph_mpi_amg.h"
#include "script.h"
#include "simulation.h"

#include <gtest/gtest.h>

#include <algorithm>

namespace {

constexpr double TOLERANCE = 1.0e-11, DT = 0.01;

// rho = g = H = 1
Script tank_script(const Scene &scene)
{
  Script script = script_of(scene);
  const char *down = scene.dimension == 2 ? "0 -1 0" : "0 0 -1";
  script.body = fmt::format("fix g all gravity 1.0 vector {}", down);
  script.ppe = "fix ppe all aleisph/ppe tol 1e-13";
  script.timestep = fmt::format("timestep {}", DT);
  return script;
}

double pressure_error(const Simulation &sim, int dimension)
{
  const auto exact = sim.at_particles(
      [dimension](double, double y, double z) { return 1.0 - (dimension == 2 ? y : z); });
  return largest(without_mean(sim.pressure()), without_mean(exact));
}

double largest_speed(const Simulation &sim)
{
  return std::max({largest(sim.v(0)), largest(sim.v(1)), largest(sim.v(2))});
}

}    // namespace

TEST(ClosedTank, StaysAtRest)
{
  for (const int dimension : {2, 3})
    for (const double jitter : {0.0, 0.2})
      for (const int steps : {1, 20}) {
        SCOPED_TRACE(fmt::format("{}d, jitter {}, {} steps", dimension, jitter, steps));
        const Scene scene = tank(dimension, dimension == 2 ? 10 : 7).jitter(jitter);
        Simulation sim(scene);
        sim.run(tank_script(scene).text() + fmt::format("run {}", steps));
        EXPECT_LE(pressure_error(sim, dimension), TOLERANCE);
        EXPECT_LE(largest_speed(sim), TOLERANCE * DT);
        EXPECT_EQ(sim.fix("ppe", 7), 1.0);    // closed
      }
}

// The first pressure is solved for before the first step, and the velocity is not touched
TEST(ClosedTank, RunZeroHasThePressure)
{
  for (const int dimension : {2, 3}) {
    const Scene scene = tank(dimension, 6).jitter(0.2);
    Simulation sim(scene);
    sim.run(tank_script(scene).text() + "run 0");
    EXPECT_LE(pressure_error(sim, dimension), TOLERANCE);
    EXPECT_EQ(largest_speed(sim), 0.0);
  }
}

TEST(ClosedTank, EveryKernelAndSmoothingLength)
{
  for (const char *kernel : {"cubic-spline", "quintic-spline", "wendland-c2", "wendland-c4"})
    for (const double h : {1.0, 1.2, 1.5})
      for (const int dimension : {2, 3}) {
        SCOPED_TRACE(fmt::format("{} h/d {} {}d", kernel, h, dimension));
        const Scene scene = tank(dimension, dimension == 2 ? 10 : 6).jitter(0.1);
        Simulation sim(scene);
        Script script = tank_script(scene);
        script.owner += fmt::format(" kernel {} h/d {}", kernel, h);
        sim.run(script.text() + "run 2");
        EXPECT_LE(pressure_error(sim, dimension), TOLERANCE);
        EXPECT_LE(largest_speed(sim), TOLERANCE * DT);
      }
}

// any preconditioner leads to the same solution
TEST(ClosedTank, EveryPreconditioner)
{
  for (const std::string name : {"auto", "none", "jacobi", "ilu0", "amg"}) {
    if (name == "amg" && !aleisph::amg_available()) continue;
    SCOPED_TRACE(name);
    const Scene scene = tank(2, 10).jitter(0.2);
    Simulation sim(scene);
    Script script = tank_script(scene);
    script.ppe += fmt::format(" preconditioner {}", name);
    sim.run(script.text() + "run 2");
    EXPECT_LE(pressure_error(sim, 2), TOLERANCE);
  }
}

// A tank that moves along with its fluid is at rest for another observer
TEST(ClosedTank, InUniformMotion)
{
  Scene scene = tank(2, 8).jitter(0.2);
  scene.high[0] = 2.0;
  Simulation sim(scene);
  Script script = tank_script(scene);
  script.wall += "\nfix m wall move linear 3.0 0 0";
  script.timestep += "\nvelocity all set 3.0 0 0";
  sim.run(script.text() + "run 20");
  EXPECT_LE(pressure_error(sim, 2), TOLERANCE);
  auto u = sim.v(0);
  for (double &value : u) value -= 3.0;
  EXPECT_LE(largest(u), TOLERANCE);
  EXPECT_LE(largest(sim.v(1)), TOLERANCE);
}

// A tank that is accelerated along x: its fluid follows, and the pressure is p = -rho a x. In the
// frame of the tank this is a body force, which the tests above show to be exact.
TEST(ClosedTank, Accelerated)
{
  const std::string moved = "variable u equal time\nvariable s equal 0.5*time^2\n"
                            "fix m wall move variable v_s NULL NULL v_u NULL NULL\n"
                            "fix wall wall aleisph/wall";
  // walls that stay while the fluid moves past them: what acted before is of another arrangement
  const std::string told = "variable u equal time\nfix wall wall aleisph/wall velocity v_u 0 0";
  for (const std::string &wall : {moved, told}) {
    SCOPED_TRACE(wall);
    Scene scene = tank(2, 8).jitter(0.2);
    scene.high[0] = 2.0;
    Simulation sim(scene);
    Script script = tank_script(scene);
    script.body = "";
    script.wall = wall;
    if (wall == told) script.predictor += " motion euler";
    sim.run(script.text() + "run 10");
    const auto exact = sim.at_particles([](double x, double, double) { return -x; });
    EXPECT_LE(largest(without_mean(sim.pressure()), without_mean(exact)), 1e-9);
    auto u = sim.v(0);
    for (double &value : u) value -= 10 * DT;
    EXPECT_LE(largest(u), 1e-9);
    EXPECT_LE(largest(sim.v(1)), 1e-9);
  }
}

// One prescribed value instead of a closed tank: the level of the pressure is then known, too
TEST(ClosedTank, PrescribedPressureAtTheTop)
{
  for (const char *value : {"3.0", "v_equal", "v_atom"}) {
    SCOPED_TRACE(value);
    const Scene scene = tank(2, 10).jitter(0.2);
    Simulation sim(scene);
    Script script = tank_script(scene);
    script.pressure = fmt::format("variable equal equal 3.0\nvariable atom atom 4.0-y\n"
                                  "region top block INF INF 0.95 INF INF INF\n"
                                  "group top region top\nfix p top aleisph/pressure {}",
                                  value);
    sim.run(script.text() + "run 5");
    const auto exact = sim.at_particles([](double, double y, double) { return 4.0 - y; });
    EXPECT_LE(largest(sim.pressure(), exact), TOLERANCE);
    EXPECT_EQ(sim.fix("ppe", 7), 0.0);
    EXPECT_EQ(sim.fix("sph", 3), 11.0);
  }
}
