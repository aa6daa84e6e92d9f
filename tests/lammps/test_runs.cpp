// SPDX-License-Identifier: GPL-2.0-only
/* ----------------------------------------------------------------------
   Several runs, restart files, fixes that are taken away and defined again.
------------------------------------------------------------------------- */

#include "errors.h"

namespace {

struct Setting {
  const char *name, *predictor;
};

const std::vector<Setting> &settings()
{
  static const std::vector<Setting> all = {
      {"lagrangian", "frame lagrangian nu 0.05"},
      {"eulerian", "frame eulerian nu 0.05"},
      {"ab2", "frame eulerian nu 0.05 integrator ab2"},
      {"lagrangian ab2", "frame lagrangian nu 0.05 integrator ab2"},
      {"ale", "frame ale nu 0.05 transport v_wx v_wy 0"},
      {"backward Euler", "frame eulerian nu 0.05 scheme be"},
      {"Crank-Nicolson", "frame lagrangian nu 0.05 scheme cn"}};
  return all;
}

// a jittered tank, stirred, with gravity
Scene stirred_tank()
{
  return tank(2, 8).jitter(0.1);
}

Script stirred_script(const Setting &setting)
{
  Script script = script_of(stirred_tank());
  script.body = "fix g all gravity 1.0 vector 0 -1 0";
  script.predictor = fmt::format("variable wx atom 0.5*vx\nvariable wy atom 0.5*vy\n"
                                 "fix pred fluid aleisph/predictor {}",
                                 setting.predictor);
  script.timestep = "timestep 0.01";
  return script;
}

constexpr char STIR[] = "variable u atom sin(PI*x)^2*sin(2*PI*y)\n"
                        "variable w atom -sin(2*PI*x)*sin(PI*y)^2\n"
                        "velocity fluid set v_u v_w 0\n";

// x, v and p of all particles
std::vector<double> state(const Simulation &sim)
{
  std::vector<double> all = sim.pressure();
  for (int a = 0; a < 2; a++)
    for (const auto &field : {sim.x(a), sim.v(a)})
      all.insert(all.end(), field.begin(), field.end());
  return all;
}

}    // namespace

// In the last digits a second run may differ, as neighbor lists are built anew and sums are
// taken in another order; the solver then ends up to its tolerance, 1e-12, elsewhere.
TEST(Runs, SeveralRunsEqualOne)
{
  for (const auto &setting : settings()) {
    SCOPED_TRACE(setting.name);
    const Script script = stirred_script(setting);
    Simulation one(stirred_tank()), many(stirred_tank()), every(stirred_tank());
    one.run(script.text() + STIR + "run 20");
    many.run(script.text() + STIR + "run 0\nrun 7\nrun 3 pre no\nrun 0\nrun 10");
    every.run(script.text() + STIR + "run 20 every 5 NULL");
    EXPECT_LE(largest(state(many), state(one)), 1e-9);
    EXPECT_LE(largest(state(every), state(one)), 1e-9);
  }
}

// LAMMPS keeps lists of fixes from the last set-up: without one they would name what is no more
TEST(Runs, PreNoAfterAFixHasGone)
{
  const Script script = stirred_script(settings()[1]);
  const auto run = [&](Simulation &sim, const std::string &more) {
    return sim.error_of(script.text() + STIR + "run 3\n" + more);
  };
  const std::string again = "\nfix ppe all aleisph/ppe tol 1e-3\n";
  for (const std::string &change : {"unfix ppe" + again, again}) {
    Simulation without(stirred_tank()), with(stirred_tank());
    EXPECT_EQ(run(without, change + "run 3 pre no"), "");
    EXPECT_EQ(run(with, change + "run 3"), "");
    EXPECT_EQ(state(without), state(with));
  }
  const auto message = [&](const std::string &more) {
    Simulation sim(stirred_tank());
    return run(sim, more);
  };
  expect_words(message("unfix ppe\nrun 1 pre no"), {"needs a fix aleisph/ppe"});
  expect_words(message("unfix sph\nrun 1 pre no"), {"needs a fix aleisph, "});
  expect_words(message("run 4 pre no every 2 \"fix ppe all aleisph/ppe\""),
               {"ix aleisph: a fix of this package was deleted", "pre yes"});
}

// Bitwise, in serial: both continue from the same numbers with a fresh set-up
TEST(Runs, RestartContinuesBitwise)
{
  for (const auto &setting : settings()) {
    SCOPED_TRACE(setting.name);
    const std::string file = scratch_file("half.restart");
    const Script script = stirred_script(setting);
    Simulation first(stirred_tank());
    if (first.ranks() > 1) GTEST_SKIP() << "serial";
    first.run(script.text() + STIR + "run 10\nwrite_restart " + file + "\nrun 10");

    Simulation second;
    second.run("read_restart " + file +
               "\nneighbor 0.0375 bin\n"
               "neigh_modify every 1 delay 0 check yes\n" +
               script.text() + "run 10");
    EXPECT_EQ(second.variable("step"), 20.0);
    EXPECT_EQ(state(second), state(first));
  }
}

// restart file written in the middle of a run
TEST(Runs, RestartDuringARun)
{
  for (const auto &setting : settings()) {
    SCOPED_TRACE(setting.name);
    const std::string file = scratch_file("middle.restart");
    const Script script = stirred_script(setting);
    Simulation first(stirred_tank());
    first.run(script.text() + STIR + "restart 10 " + file + "\nrun 20");

    Simulation second;
    second.run("read_restart " + file +
               ".10\nneighbor 0.0375 bin\n"
               "neigh_modify every 1 delay 0 check yes\n" +
               script.text() + "run 10");
    EXPECT_LE(largest(state(second), state(first)), 1e-9);
  }
}

// A restart keeps the pressure: run 0 after it shows the same, without a solve
TEST(Runs, RestartKeepsThePressure)
{
  const Script script = stirred_script(settings()[1]);
  const std::string file = scratch_file("p.restart");
  Simulation first(stirred_tank());
  first.run(script.text() + STIR + "run 5\nwrite_restart " + file);
  Simulation second;
  second.run("read_restart " + file + "\nneighbor 0.0375 bin\n" + script.text() + "run 0");
  EXPECT_EQ(second.pressure(), first.pressure());
}

// What a script changes between runs is taken up
TEST(Runs, ChangesBetweenRuns)
{
  const Script script = stirred_script(settings()[0]);
  Simulation sim(stirred_tank());
  sim.run(script.text() + STIR + "run 3");
  sim.run("unfix ppe\nfix ppe all aleisph/ppe tol 1e-6 preconditioner jacobi\nrun 3");
  sim.run("unfix ppe\nunfix pred\nfix pred fluid aleisph/predictor frame eulerian nu 0.1\n"
          "fix ppe all aleisph/ppe\nrun 3");
  EXPECT_EQ(sim.fix("pred", 2), 0.1 * 0.01 * 64.0);
  sim.run("timestep 0.005\nrun 3");
  EXPECT_EQ(sim.fix("pred", 2), 0.1 * 0.005 * 64.0);
}

// everything taken away and defined anew; the pressure is then solved for again at the start
TEST(Runs, AllFixesAnew)
{
  const Script script = stirred_script(settings()[0]);
  Simulation sim(stirred_tank());
  sim.run(script.text() + STIR + "run 3\nunfix ppe\nunfix pred\nunfix g\nunfix wall\nunfix sph");
  sim.run("run 0");    // LAMMPS alone
  sim.run(script.text() + "run 3");
  EXPECT_LT(sim.fix("ppe", 2), 1e-11);

  // the owner first
  sim.run("unfix sph\nunfix wall\nunfix g\nunfix pred\nunfix ppe\n" + script.text() + "run 3");
  EXPECT_LT(sim.fix("ppe", 2), 1e-11);
}

TEST(Runs, OwnerTakenAway)
{
  const Script script = stirred_script(settings()[0]);
  Simulation sim(stirred_tank());
  sim.run(script.text() + "compute c all aleisph/atom p divv\n" + STIR + "run 3\nunfix sph");
  EXPECT_NE(sim.error_of("run 1").find("needs a fix aleisph"), std::string::npos);
}

// a command that wants the compute outside of a run must not meet the dead owner
TEST(Runs, ComputeWithoutItsOwner)
{
  const Script script = stirred_script(settings()[0]);
  Simulation sim(stirred_tank());
  sim.run(script.text() + "compute c all aleisph/atom p divv\n" + STIR + "run 3\nunfix sph");
  const std::string file = scratch_file("orphan.dump");
  EXPECT_NE(sim.error_of("write_dump all custom " + file + " id c_c[1]").find("aleisph"),
            std::string::npos);
}

// What a script prints before its first run, or after the owner is gone, is an error or a number
static void expect_outputs(const std::string &id, int size, bool orphan)
{
  Simulation sim(stirred_tank());
  sim.run(stirred_script(settings()[0]).text());
  if (orphan) sim.run("run 1\nunfix sph");
  for (int k = 1; k <= size; k++) {
    SCOPED_TRACE(k);
    const std::string message = sim.error_of(fmt::format("print \"$(f_{}[{}])\"", id, k));
    EXPECT_TRUE(message.empty() || message.find("aleisph") != std::string::npos) << message;
  }
}

TEST(Runs, OutputOfOwnerBeforeTheFirstRun)
{
  expect_outputs("sph", 13, false);
}
TEST(Runs, OutputOfPredictorBeforeTheFirstRun)
{
  expect_outputs("pred", 6, false);
}
TEST(Runs, OutputOfSolverBeforeTheFirstRun)
{
  expect_outputs("ppe", 11, false);
}
TEST(Runs, OutputOfPredictorWithoutItsOwner)
{
  expect_outputs("pred", 6, true);
}
TEST(Runs, OutputOfSolverWithoutItsOwner)
{
  expect_outputs("ppe", 11, true);
}

// LAMMPS replaces a fix that is defined again under its name
TEST(Runs, OwnerReplaced)
{
  const Setting &setting = settings()[1];
  const Script script = stirred_script(setting);
  Simulation sim(stirred_tank()), reference(stirred_tank());
  reference.run(script.text() + STIR + "run 3");
  sim.run(script.text() + script.owner + " kernel quintic-spline\n" + STIR + "run 3\n");
  sim.run(script.owner + "\n" + STIR + "run 3");
  EXPECT_LE(largest(sim.v(0), reference.v(0)), 1e-9);
}

TEST(Runs, ResetTimestepAndClear)
{
  const Script script = stirred_script(settings()[2]);
  Simulation sim(stirred_tank()), reference(stirred_tank());
  reference.run(script.text() + STIR + "run 10");
  sim.run(script.text() + STIR + "run 5\nreset_timestep 0\nrun 5");
  EXPECT_LE(largest(state(sim), state(reference)), 1e-9);
  sim.run("clear");
}
