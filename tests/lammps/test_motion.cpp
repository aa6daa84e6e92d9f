// SPDX-License-Identifier: GPL-2.0-only
/* ----------------------------------------------------------------------
   Particles that move: order in time, and what they remember of the step
   before. What is new in the flow, what flies freely, walls that become wet;
   restart files; several ranks.
------------------------------------------------------------------------- */

#include "errors.h"

#include <algorithm>
#include <cmath>

namespace {

constexpr double PI = 3.14159265358979323846;

// x, v and p of all particles
std::vector<double> state(const Simulation &sim)
{
  std::vector<double> all = sim.pressure();
  for (int a = 0; a < 2; a++)
    for (const auto &field : {sim.x(a), sim.v(a)})
      all.insert(all.end(), field.begin(), field.end());
  return all;
}

/* ----------------------------------------------------------------------
   A block of fluid, free on all sides, under a force that is the same
   everywhere and changes with time: cos(pi t) along x. There is no pressure, and
   no error of space.
------------------------------------------------------------------------- */

constexpr double END = 0.4;

struct Errors {
  double x, v;
};

// `steps` of equal length, or alternating between (1 + swing) and (1 - swing) times their mean
Errors pushed(const std::string &predictor, int steps, double swing = 0.0)
{
  const Scene scene = patch(6);
  Simulation sim(scene);
  Script script = free_script(scene);
  script.shift = "";
  script.body = fmt::format("variable push equal {}*cos(PI*time)\nfix push all addforce v_push 0 0",
                            scene.d * scene.d);
  script.predictor = "fix pred fluid aleisph/predictor " + predictor;
  sim.run(script.text() + fmt::format("timestep {}", END / steps));
  for (int k = 0; k < steps; k++)
    sim.run(fmt::format("timestep {}\nrun 1 post no",
                        END / steps * (k % 2 ? 1.0 - swing : 1.0 + swing)));
  const double v = std::sin(PI * END) / PI, way = (1.0 - std::cos(PI * END)) / (PI * PI);
  return {std::fabs(sim.x(0)[0] - scene.x[0][0] - way), std::fabs(sim.v(0)[0] - v)};
}

void expect_order(const std::string &predictor, double expected, double swing = 0.0)
{
  SCOPED_TRACE(predictor);
  const Errors coarse = pushed(predictor, 20, swing), fine = pushed(predictor, 40, swing);
  EXPECT_NEAR(std::log2(coarse.x / fine.x), expected, 0.15);
  EXPECT_NEAR(std::log2(coarse.v / fine.v), expected, 0.15);
}

}    // namespace

TEST(Motion, OrderInTime)
{
  for (const char *more : {"", " integrator ab2", " nu 0.01", " nu 0.01 scheme cn"}) {
    expect_order(fmt::format("motion verlet{}", more), 2.0);
    expect_order(fmt::format("motion euler{}", more), 1.0);
  }
}

// with the share of equal steps it would be one
TEST(Motion, OrderInTimeOfChangingSteps)
{
  expect_order("motion verlet", 2.0, 0.4);
}

// by default, and in every frame that moves: the parabola of constant force is exact
TEST(Motion, ParabolaIsExact)
{
  for (const char *predictor : {"", "integrator ab2", "scheme be nu 0.1"})
    for (const char *stepping : {"run 20", "run 7\ntimestep 0.013\nrun 10"}) {
      SCOPED_TRACE(predictor);
      const Scene scene = patch(6);
      Simulation sim(scene);
      Script script = free_script(scene);
      script.shift = "";
      script.body = "fix g all gravity 1.0 vector 0 -1 0";
      script.predictor = fmt::format("fix pred fluid aleisph/predictor {}", predictor);
      script.timestep = "timestep 0.01\nvelocity all set 0.5 0.3 0";
      sim.run(script.text() + stepping);
      const double t = sim.variable("time");
      // rounding of 20 steps
      EXPECT_NEAR(sim.x(0)[7], scene.x[7][0] + 0.5 * t, 1e-12);
      EXPECT_NEAR(sim.x(1)[7], scene.x[7][1] + 0.3 * t - 0.5 * t * t, 1e-12);
    }
}

/* ----------------------------------------------------------------------
   Vortices that carry their particles. On one arrangement the divergence that
   the projection leaves, of order dt d^2, is seen beside what the motion does:
   errors are against the exact flow.
------------------------------------------------------------------------- */

namespace {

double vortex_error(const std::string &motion, int steps)
{
  const double time = 0.25;
  const Scene scene = periodic_square(24);
  Simulation sim(scene);
  Script script = shifted_script(scene, "density velocity 1.0");
  script.predictor += " nu 0.01 integrator ab2 motion " + motion;
  script.ppe = "fix ppe all aleisph/ppe tol 1e-9";
  script.timestep = fmt::format("timestep {}\nvariable u atom sin(2*PI*x)*cos(2*PI*y)\n"
                                "variable w atom -cos(2*PI*x)*sin(2*PI*y)\n"
                                "velocity all set v_u v_w 0\n"
                                "compute ex all aleisph/exact taylor-green 1 1 1 0.01\n",
                                time / steps);
  sim.run(script.text() + fmt::format("run {}", steps));
  return relative_l2(sim.v(0), sim.compute("ex", 1));
}

}    // namespace

// Measured: 5.5e-3 and 5.6e-3 with steps of d/8 and d/16; as published 1.4e-2 and 8.4e-3
TEST(Motion, VorticesDoNotDependOnTheStep)
{
  const double coarse = vortex_error("verlet", 48), fine = vortex_error("verlet", 96);
  EXPECT_LE(coarse, 0.007);
  EXPECT_NEAR(coarse / fine, 1.0, 0.15);
  EXPECT_GE(vortex_error("euler", 48), 2.0 * coarse);
}

/* ----------------------------------------------------------------------
   What is new. Fluid at rest under gravity keeps the exact linear pressure, so
   that there is nothing to remember of the step before but zero: a wrong memory
   is a spike of pressure. Tolerance as in test_surface_style.cpp.
------------------------------------------------------------------------- */

namespace {

constexpr double TOLERANCE = 1.0e-11;

// rho = g = H = 1
Script still_script(const Scene &scene)
{
  Script script = free_script(scene);
  script.shift = "";
  script.body = "fix g all gravity 1.0 vector 0 -1 0";
  script.predictor = "fix pred fluid aleisph/predictor";
  script.ppe = "fix ppe all aleisph/ppe tol 1e-13";
  script.timestep = "timestep 0.01";
  return script;
}

// max |p - (level - y)| over the fluid
double pressure_error(const Simulation &sim, double level)
{
  const auto p = sim.pressure(), y = sim.x(1), type = sim.type();
  double worst = 0.0;
  for (std::size_t i = 0; i < p.size(); i++)
    if (type[i] == Scene::FLUID) worst = std::max(worst, std::fabs(p[i] - (level - y[i])));
  return worst;
}

double largest_speed(const Simulation &sim)
{
  return std::max(largest(sim.v(0)), largest(sim.v(1)));
}

}    // namespace

TEST(Memory, AParticleThatIsPutIntoFluidAtRest)
{
  Scene scene = open_tank(2, 10);
  const auto hole = std::find_if(scene.x.begin(), scene.x.end(), [](const auto &x) {
    return std::fabs(x[0] - 0.5) + std::fabs(x[1] - 0.5) < 0.01;
  });
  scene.type.erase(scene.type.begin() + (hole - scene.x.begin()));
  scene.x.erase(hole);
  Simulation sim(scene);
  sim.run(still_script(scene).text() + "run 3");
  EXPECT_LE(pressure_error(sim, 1.05), TOLERANCE);
  for (int step = 0; step < 3; step++) {
    sim.run(step ? "run 1"
                 : "create_atoms 1 single 0.5 0.5 0 units box\ngroup fluid type 1\nrun 1");
    EXPECT_LE(pressure_error(sim, 1.05), TOLERANCE);
    EXPECT_LE(largest_speed(sim), TOLERANCE);
  }
}

// A layer on top of the fluid: its particles have one another as neighbours, all of them new, and
// walls beside it that were dry become wet
TEST(Memory, ALayerThatIsPutOntoFluidAtRest)
{
  const Scene scene = open_tank(2, 10);
  Simulation sim(scene);
  sim.run(still_script(scene).text() + "run 3");
  const double dry = sim.fix("surf", 3);
  EXPECT_LE(pressure_error(sim, 1.05), TOLERANCE);
  std::string layer;
  for (int i = 1; i < 10; i++)
    layer += fmt::format("create_atoms 1 single {} 1.1 0 units box\n", 0.1 * i);
  sim.run(layer + "group fluid type 1");
  for (int step = 0; step < 3; step++) {
    sim.run("run 1");
    EXPECT_LE(pressure_error(sim, 1.15), TOLERANCE);
    EXPECT_LE(largest_speed(sim), TOLERANCE);
  }
  EXPECT_EQ(sim.fix("surf", 3), dry - 2.0);
}

// A particle that flies freely has none; it begins when it is caught
TEST(Memory, BeginsWhereFreeFlightEnds)
{
  Scene scene = patch(6);
  scene.add(Scene::FLUID, 0.0, 1.2);
  const int id = static_cast<int>(scene.x.size());
  Simulation sim(scene);
  Script script = free_script(scene);
  script.predictor = "fix pred fluid aleisph/predictor";
  script.shift = "";
  script.timestep = fmt::format("timestep 0.02\nset atom {} vy -1.0", id);
  sim.run(script.text() + "compute m all property/atom d2_aleisph_gp[4]\nrun 5");
  EXPECT_EQ(sim.fix("surf", 2), 1.0);
  EXPECT_EQ(sim.compute("m", 1)[id - 1], 0.0);
  EXPECT_EQ(sim.compute("m", 1)[0], 1.0);
  while (sim.fix("surf", 2) > 0.0 && sim.variable("step") < 60.0) sim.run("run 1 post no");
  EXPECT_EQ(sim.fix("surf", 2), 0.0);
  EXPECT_EQ(sim.compute("m", 1)[id - 1], 1.0);
}

/* ----------------------------------------------------------------------
   Runs, restart files, ranks: a dam with shifting and a step that is chosen
------------------------------------------------------------------------- */

namespace {

Script dam_script(const std::string &motion)
{
  Script script = free_script(dam(6), "density velocity 2.0");
  script.predictor += " motion " + motion;
  script.body = "fix g all gravity 1.0 vector 0 -1 0";
  script.timestep = "timestep 0.004";
  script.dt = "fix dt all aleisph/dt 1 max 0.01";
  return script;
}

const std::string CONTINUED = "\nneighbor 0.05 bin\nneigh_modify every 1 delay 0 check yes\n";

}    // namespace

TEST(Memory, SeveralRunsEqualOne)
{
  for (const char *motion : {"verlet", "euler"}) {
    SCOPED_TRACE(motion);
    const Scene scene = dam(6);
    Simulation one(scene), many(scene);
    one.run(dam_script(motion).text() + "run 20");
    many.run(dam_script(motion).text() + "run 0\nrun 10\nrun 3 pre no\nrun 0\nrun 7");
    EXPECT_LE(largest(state(one), state(many)), 1e-9);
  }
}

TEST(Memory, RestartContinuesBitwise)
{
  for (const char *motion : {"verlet", "euler"}) {
    SCOPED_TRACE(motion);
    const std::string file = scratch_file("motion.restart");
    Simulation first(dam(6)), second;
    if (first.ranks() > 1) GTEST_SKIP() << "serial";
    first.run(dam_script(motion).text() + "run 20\nwrite_restart " + file + "\nrun 10");
    second.run("read_restart " + file + CONTINUED + dam_script(motion).text() + "run 10");
    EXPECT_EQ(second.variable("step"), 30.0);
    EXPECT_EQ(state(second), state(first));
  }
}

// A frame at rest keeps what it gives back
TEST(Memory, RestartOfAFrameAtRest)
{
  for (const char *more : {"", " increment no"}) {
    const Scene scene = tank(2, 8).jitter(0.1);
    Script script = script_of(scene);
    script.predictor += " frame eulerian nu 0.05";
    script.ppe += more;
    script.timestep = "timestep 0.01";
    const std::string stir =
                          "variable u atom sin(PI*x)^2*sin(2*PI*y)\nvelocity fluid set v_u 0 0\n",
                      file = scratch_file("rest.restart");
    Simulation first(scene), second;
    if (first.ranks() > 1) GTEST_SKIP() << "serial";
    first.run(script.text() + stir + "run 8\nwrite_restart " + file + "\nrun 8");
    second.run("read_restart " + file + CONTINUED + script.text() + "run 8");
    EXPECT_EQ(state(second), state(first));
  }
}

// each rank beside all of them together: solver tolerance 1e-12, 20 steps
TEST(Memory, RanksAgree)
{
  const Scene scene = dam(6);
  Simulation together(scene), alone(scene, MPI_COMM_SELF);
  const std::string script = dam_script("verlet").text() + "run 20";
  together.run(script);
  alone.run(script);
  // answers of `alone` are those of this rank, which has all particles
  EXPECT_LE(largest(state(together), state(alone)), 1e-8);
}
