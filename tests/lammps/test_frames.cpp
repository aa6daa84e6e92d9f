// SPDX-License-Identifier: GPL-2.0-only
/* ----------------------------------------------------------------------
   Lagrangian, Eulerian and ALE frame, and the two time integrators, in
   fully periodic flow.
------------------------------------------------------------------------- */

#include "script.h"
#include "simulation.h"

#include <gtest/gtest.h>

#include <cmath>

namespace {

constexpr char TAYLOR_GREEN[] = "variable u atom sin(2*PI*x)*cos(2*PI*y)\n"
                                "variable w atom -cos(2*PI*x)*sin(2*PI*y)\n"
                                "velocity all set v_u v_w 0\n"
                                "compute ex all aleisph/exact taylor-green 1 1 1 0.01\n";

void run_taylor_green(Simulation &sim, const Scene &scene, const std::string &predictor,
                      const std::string &more, int steps, const std::string &ppe = "")
{
  Script script = script_of(scene);
  script.predictor += " nu 0.01 " + predictor;
  script.ppe += " " + ppe;
  script.timestep = "timestep 0.001";
  sim.run(script.text() + TAYLOR_GREEN + more + fmt::format("\nrun {}", steps));
}

struct Errors {
  double u, p;
};

Errors errors(const std::string &predictor, int n)
{
  const Scene scene = periodic_square(n);
  Simulation sim(scene);
  run_taylor_green(sim, scene, predictor, "variable wx atom 0.5*vx\nvariable wy atom 0.5*vy", 20);
  return {relative_l2(sim.v(0), sim.compute("ex", 1)),
          relative_l2(without_mean(sim.pressure()), without_mean(sim.compute("ex", 4)))};
}

}    // namespace

// ale with w = 0 is the Eulerian frame: the same sums of the same numbers. What a frame that moves
// does on top of them: see motion; what one at rest does: increment.
TEST(Frames, AleAtRestIsEulerian)
{
  const Scene scene = periodic_square(12);
  Simulation euler(scene), ale(scene);
  run_taylor_green(euler, scene, "frame eulerian", "", 50, "increment no");
  run_taylor_green(ale, scene, "frame ale transport 0 0 0 motion euler", "", 50);
  for (int a = 0; a < 2; a++) EXPECT_EQ(ale.v(a), euler.v(a));
  EXPECT_EQ(ale.pressure(), euler.pressure());
  EXPECT_EQ(ale.x(0), euler.x(0));
}

// ale with w = v is the Lagrangian frame, c = 0; but a prescribed velocity has no rate of change that
// is known
TEST(Frames, AleWithTheFluidIsLagrangian)
{
  const Scene scene = periodic_square(12).jitter(0.1);
  Simulation lagrange(scene), ale(scene);
  run_taylor_green(lagrange, scene, "frame lagrangian motion euler", "", 20);
  run_taylor_green(ale, scene, "frame ale transport v_wx v_wy 0 motion euler",
                   "variable wx atom vx\nvariable wy atom vy", 20);
  for (int a = 0; a < 2; a++) {
    EXPECT_EQ(ale.v(a), lagrange.v(a));
    EXPECT_EQ(ale.x(a), lagrange.x(a));
  }
}

// Galilean invariance: with w = U everything is as at rest, seen from particles that move with U.
// Convection v.grad v sees c = v - U. Solver tolerance 1e-12 of rho0/dt div v*, 50 steps.
TEST(Frames, AleWithConstantTransportIsGalilean)
{
  const Scene scene = periodic_square(12);
  Simulation rest(scene), moving(scene);
  run_taylor_green(rest, scene, "frame eulerian", "", 50, "increment no");
  run_taylor_green(moving, scene, "frame ale transport 0.7 -0.3 0 motion euler",
                   "variable um atom v_u+0.7\nvariable wm atom v_w-0.3\n"
                   "velocity all set v_um v_wm 0",
                   50);
  auto u = moving.v(0), w = moving.v(1);
  for (double &value : u) value -= 0.7;
  for (double &value : w) value += 0.3;
  EXPECT_LE(largest(u, rest.v(0)), 1e-9);
  EXPECT_LE(largest(w, rest.v(1)), 1e-9);
  EXPECT_LE(largest(moving.pressure(), rest.pressure()), 1e-9);

  // 50 steps of 0.001; the box has the period 1
  for (int a = 0; a < 2; a++) {
    const auto x = moving.x(a), x0 = rest.x(a);
    for (std::size_t i = 0; i < x.size(); i++)
      EXPECT_NEAR(std::remainder(x[i] - x0[i] - 0.05 * (a ? -0.3 : 0.7), 1.0), 0.0, 1e-12);
  }
}

// Three frames, one flow, second order: from N = 12 to 24 errors fall to a quarter. (Lagrangian
// particles crowd at the stagnation points later on; without shifting that limits the run.)
TEST(Frames, AllSolveTheSameFlow)
{
  for (const char *predictor :
       {"frame eulerian", "frame lagrangian", "frame ale transport v_wx v_wy 0"}) {
    SCOPED_TRACE(predictor);
    const Errors coarse = errors(predictor, 12), fine = errors(predictor, 24);
    EXPECT_LE(fine.u, 5e-3);
    EXPECT_LE(fine.p, 0.1);
    EXPECT_GE(coarse.u / fine.u, 3.0);
    EXPECT_GE(coarse.p / fine.p, 3.0);
  }
}

/* ----------------------------------------------------------------------
   A shear wave sin(2 pi y) that is carried along y: no pressure, so that
   the time integrator of viscosity and convection is seen alone. Errors
   are against AB2 with a step 16 times smaller than the smallest.
------------------------------------------------------------------------- */

namespace {

constexpr double END = 0.2;

// `steps` with time steps alternating between (1 + swing) and (1 - swing) times their mean
std::vector<double> shear_wave(const std::string &predictor, int steps, double swing = 0.0)
{
  const Scene scene = periodic_square(10);
  Simulation sim(scene);
  Script script = script_of(scene);
  script.predictor += " nu 0.02 frame eulerian " + predictor;
  script.timestep = "variable u atom sin(2*PI*y)\nvelocity all set v_u 1.0 0";
  sim.run(script.text());
  if (swing == 0.0)
    sim.run(fmt::format("timestep {}\nrun {}", END / steps, steps));
  else
    for (int k = 0; k < steps; k++)
      sim.run(fmt::format("timestep {}\nrun 1", END / steps * (k % 2 ? 1.0 - swing : 1.0 + swing)));
  return sim.v(0);
}

double order(const std::string &predictor, int steps, double swing = 0.0)
{
  const auto reference = shear_wave("integrator ab2", 640);
  const double coarse = largest(shear_wave(predictor, steps, swing), reference);
  const double fine = largest(shear_wave(predictor, 2 * steps, swing), reference);
  return std::log2(coarse / fine);
}

}    // namespace

TEST(Integrator, Order)
{
  EXPECT_NEAR(order("integrator euler", 20), 1.0, 0.1);
  EXPECT_NEAR(order("integrator ab2", 20), 2.0, 0.2);
}

// steps of 1.4 and 0.6: with the weights of equal steps the order would be 1
TEST(Integrator, Ab2WithAChangingTimeStep)
{
  EXPECT_NEAR(order("integrator ab2", 40, 0.4), 2.0, 0.2);
}

TEST(Integrator, Ab2IsMoreAccurate)
{
  const auto reference = shear_wave("integrator ab2", 640);
  EXPECT_LT(largest(shear_wave("integrator ab2", 20), reference),
            0.2 * largest(shear_wave("integrator euler", 20), reference));
}

// Crank-Nicolson is second order in the viscous term, backward Euler first order
TEST(Integrator, ImplicitOrder)
{
  const auto wave = [](const std::string &predictor, int steps) {
    const Scene scene = periodic_square(10);
    Simulation sim(scene);
    Script script = script_of(scene);
    script.predictor += " nu 1.0 frame eulerian " + predictor;
    script.timestep = fmt::format("timestep {}\nvariable u atom sin(2*PI*y)\n"
                                  "velocity all set v_u 0.0 0",
                                  0.05 / steps);
    sim.run(script.text() + fmt::format("run {}", steps));
    return sim.v(0);
  };
  const auto reference = wave("scheme cn", 320);
  const auto order = [&](const std::string &predictor) {
    return std::log2(largest(wave(predictor, 10), reference) /
                     largest(wave(predictor, 20), reference));
  };
  EXPECT_NEAR(order("scheme be"), 1.0, 0.1);
  EXPECT_NEAR(order("scheme cn"), 2.0, 0.2);
}
