// SPDX-License-Identifier: GPL-2.0-only
/* ----------------------------------------------------------------------
   What fix aleisph/ppe leaves of the change of volume in a step, on any
   number of ranks: keywords divergence and tol. That the solver stops where
   it should is tested by the numerics (test_krylov.cpp).
------------------------------------------------------------------------- */

#include "errors.h"
#include "script.h"
#include "simulation.h"

#include <gtest/gtest.h>

#include <cmath>

namespace {

constexpr int N = 24;

// not free of divergence: max |div v| = 2 pi U
std::string stir(double U)
{
  return fmt::format("variable u atom {}*sin(2*PI*x)*(1+0.3*cos(2*PI*y))\n"
                     "velocity fluid set v_u 0 0\n",
                     U);
}

Script with_ppe(const Scene &scene, const std::string &keywords, double dt)
{
  Script script = script_of(scene);
  script.ppe = "fix ppe all aleisph/ppe " + keywords;
  script.timestep = fmt::format("timestep {}", dt);
  return script;
}

// after one step
std::vector<double> first_pressure(const Scene &scene, const std::string &keywords, double U)
{
  Simulation sim(scene);
  sim.run(with_ppe(scene, keywords, 0.01 * scene.d).text() + stir(U) + "run 1");
  return without_mean(sim.pressure());
}

// gravity, and a wave that starts
std::vector<double> tank_pressure(const std::string &keywords, double dt, int steps)
{
  const Scene scene = open_tank(2, 16).jitter(0.1);
  Simulation sim(scene);
  Script script = free_script(scene);
  script.body = "fix g all gravity 1.0 vector 0 -1 0";
  script.ppe = "fix ppe all aleisph/ppe " + keywords;
  script.timestep = fmt::format("timestep {}", dt);
  sim.run(script.text() + "velocity fluid set 0.1 0 0\nrun " + std::to_string(steps));
  return sim.pressure();
}

}    // namespace

// Value 6 is what is left, value 12 what was asked for; 2 pi U dt = 0.06 d before the pressure acts
TEST(Tolerance, ChangeOfVolumeIsBounded)
{
  const Scene scene = periodic_square(N);
  for (const double bound : {1.0e-4, 1.0e-6, 1.0e-9}) {
    SCOPED_TRACE(bound);
    Simulation sim(scene);
    const double dt = 0.01;
    sim.run(with_ppe(scene, fmt::format("divergence {} preconditioner jacobi", bound), dt).text() +
            stir(1.0));
    double iterations = 0.0;
    for (int step = 0; step < 5; step++) {
      sim.run("run 1");
      EXPECT_LE(sim.fix("ppe", 6), sim.fix("ppe", 12));
      EXPECT_LE(sim.fix("ppe", 12), bound * (1.0 + 1.0e-14));
      EXPECT_EQ(sim.fix("ppe", 8), 0.0);
      iterations += sim.fix("ppe", 1);
    }
    EXPECT_GT(iterations, 0.0);
  }
}

// A residual r of -d^2 lap p is an error of p of at most r (L/d)^2/8: that of the parabola with
// this second derivative everywhere, between ends L apart that are held
TEST(Tolerance, BoundOfThePressure)
{
  const Scene scene = periodic_square(N);
  const auto exact = first_pressure(scene, "tol 1e-13", 1.0);
  const double dt = 0.01 * scene.d;
  double before = 1.0e300;
  for (const double bound : {1.0e-5, 1.0e-7, 1.0e-9}) {
    const auto p = first_pressure(scene, fmt::format("divergence {}", bound), 1.0);
    const double unit = scene.rho0 * scene.d * scene.d / (dt * dt);
    const double error = largest(p, exact);
    EXPECT_LE(error, bound * unit * N * N / 8.0) << bound;
    EXPECT_LT(error, before);
    before = error;
  }
}

// A bound on the change of volume alone would leave a flow a thousand million times slower without
// pressure. What is left of one solve with a share of 3e-3/N of a smooth residual is the same share
// of the pressure; a hundred times that is room for the rough part.
TEST(Tolerance, SlowFlowIsResolved)
{
  const Scene scene = periodic_square(N);
  for (const double U : {1.0, 1.0e-3, 1.0e-9}) {
    const auto exact = first_pressure(scene, "tol 1e-13", U);
    EXPECT_GT(largest(exact), 0.0);
    EXPECT_LE(relative_l2(first_pressure(scene, "", U), exact), 0.01) << U;
  }
}

// nor may a smaller step be worse: the pressure after the same time
TEST(Tolerance, SmallStepsAreResolved)
{
  for (const int refinement : {1, 4, 16}) {
    const double dt = 0.01 / refinement;
    const auto exact = tank_pressure("tol 1e-12", dt, 8 * refinement);
    const auto p = tank_pressure("", dt, 8 * refinement);
    EXPECT_LE(relative_l2(p, exact), 1.0e-3) << dt;
    EXPECT_GT(relative_l2(p, exact), 0.0);
  }
}

// run 0 has no step before: its pressure is resolved by itself
TEST(Tolerance, FirstPressure)
{
  const auto exact = tank_pressure("tol 1e-13", 0.01, 0);
  EXPECT_LE(relative_l2(tank_pressure("", 0.01, 0), exact), 1.0e-6);
}

// Explicitly, the default, and tol in terms of the change of volume
TEST(Tolerance, Keywords)
{
  const Scene scene = periodic_square(N);
  const auto p = first_pressure(scene, "", 1.0);
  EXPECT_EQ(first_pressure(scene, "tol auto", 1.0), p);
  EXPECT_EQ(first_pressure(scene, "divergence 1e-5", 1.0), p);
  EXPECT_EQ(first_pressure(scene, "tol auto divergence 1e-5", 1.0), p);
  EXPECT_NE(first_pressure(scene, "divergence 1e-9", 1.0), p);

  Simulation sim(scene);
  sim.run(with_ppe(scene, "tol 1e-6", 0.01).text() + stir(1.0) + "run 1");
  EXPECT_LE(sim.fix("ppe", 2), 1.0e-6);
  EXPECT_GT(sim.fix("ppe", 6), 0.0);
  // both are norms over the norm of the same right hand side
  EXPECT_NEAR(sim.fix("ppe", 6) / sim.fix("ppe", 12), sim.fix("ppe", 2) / 1.0e-6, 1.0e-10);
}

TEST(Tolerance, NotMet)
{
  const Scene scene = periodic_square(N);
  Simulation sim(scene);
  sim.run(with_ppe(scene, "preconditioner jacobi maxiter 2", 0.01).text() + stir(1.0));
  expect_words(sim.error_of("run 3"),
               {"ix aleisph/ppe", "not converged", "step 0", "2 iterations", "change of volume",
                "tolerance", "maxiter"});
}
