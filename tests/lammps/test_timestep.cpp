// SPDX-License-Identifier: GPL-2.0-only
/* ----------------------------------------------------------------------
   fix aleisph/dt: every limit as its formula says, growth, multiples of a
   time, and runs that go on.
------------------------------------------------------------------------- */

#include "aleisph_halo_owner.h"
#include "aleisph_lattice.h"
#include "aleisph_timestep.h"
#include "errors.h"
#include "modify.h"
#include "output.h"
#include "update.h"

#include <algorithm>
#include <cmath>
#include <random>
#include <sstream>

using aleisph::StepBound;
using aleisph::StepBounds;
using aleisph::StepControl;

namespace {

constexpr double PI = 3.14159265358979323846;
constexpr double INF = std::numeric_limits<double>::infinity();
constexpr double ROUNDING = 1.0e-14;    // relative, of a few operations

StepBounds only(StepBound bound, double dt)
{
  StepBounds limits;
  limits.lower(bound, dt);
  return limits;
}

// a limit of `dt` that the control takes as it is
StepBounds simple(double dt)
{
  return only(StepBound::CFL, dt / 0.2);
}

double time_of(const Simulation &sim)
{
  return sim.variable("time");
}

double dt_of(const Simulation &sim)
{
  return sim.variable("dt");
}

StepBound acting(const Simulation &sim)
{
  return static_cast<StepBound>(std::lround(sim.fix("dt", 1)));
}

// f_dt[n] of all n
std::vector<double> report(const Simulation &sim)
{
  std::vector<double> all;
  for (int n = 1; n <= 14; n++) all.push_back(sim.fix("dt", n));
  return all;
}

/* ----------------------------------------------------------------------
   Fluid without walls that is pushed by a body force g = 1 in x: nothing but
   v = g t happens, in any frame, so that the Courant limit is 0.2 d/(g t)
   and the force limit 0.25 sqrt(d/g).
------------------------------------------------------------------------- */

constexpr double D = 0.125;

struct Pushed : Simulation {
  explicit Pushed(const std::string &dt, const std::string &timestep = "timestep 0.01") :
      Simulation(periodic_square(8))
  {
    Script script = script_of(periodic_square(8));
    script.body = "fix g all gravity 1.0 vector 1 0 0";
    script.timestep = timestep;
    run(script.text() + "fix dt all aleisph/dt " + dt);
  }
};

}    // namespace

/* ----------------------------------------------------------------------
   Numerics
------------------------------------------------------------------------- */

TEST(TimeStep, Formulas)
{
  EXPECT_DOUBLE_EQ(aleisph::cfl_limit(0.3, 1.5), 0.2);
  EXPECT_DOUBLE_EQ(aleisph::force_limit(0.36, 4.0), 0.3);
  EXPECT_DOUBLE_EQ(aleisph::convection_limit(0.5, 2.0), 0.25);
  // 2 pi sigma = rho d^3
  EXPECT_DOUBLE_EQ(aleisph::capillary_limit(8.0, 0.5, 1.0 / (2.0 * PI)), 1.0);
  // the spectral radius is 4.04 in 2d and 4.28 in 3d (aleisph_lattice.h), three digits
  for (const int dim : {2, 3}) {
    const aleisph::Kernel kernel(aleisph::KernelType::CUBIC_SPLINE, dim, 1.2 * 0.1);
    const double limit = 2.0 / (dim == 2 ? 4.04 : 4.28) * 0.01 / 0.05;
    EXPECT_NEAR(aleisph::viscous_limit(kernel, 0.1, 0.05, false), limit, 2e-3 * limit);
    EXPECT_NEAR(aleisph::viscous_limit(kernel, 0.1, 0.05, true), 0.5 * limit, 1e-3 * limit);
    EXPECT_EQ(aleisph::viscous_limit(kernel, 0.1, 0.0, true), INF);
  }
}

TEST(TimeStep, NoLimitAtRest)
{
  EXPECT_EQ(aleisph::cfl_limit(0.3, 0.0), INF);
  EXPECT_EQ(aleisph::force_limit(0.3, 0.0), INF);
  EXPECT_EQ(aleisph::convection_limit(0.0, 0.0), INF);
  EXPECT_EQ(aleisph::capillary_limit(1.0, 0.3, 0.0), INF);
  EXPECT_EQ(StepBounds().tightest(), StepBound::NONE);
}

TEST(TimeStep, GrowsByAFactorAndShrinksAtOnce)
{
  StepControl control;
  control.start(1.0);
  double expected = 1.0;    // the first choice is not above the start
  for (int k = 0; k < 10; k++, expected *= 1.1) {
    ASSERT_TRUE(control.choose(simple(100.0), 0.0));
    EXPECT_NEAR(control.state.dt, expected, expected * ROUNDING);
    EXPECT_EQ(control.acting(), StepBound::GROW);
  }
  ASSERT_TRUE(control.choose(simple(0.5), 0.0));
  EXPECT_NEAR(control.state.dt, 0.5, ROUNDING);
  EXPECT_EQ(control.acting(), StepBound::CFL);
  EXPECT_EQ(control.state.changes, 10.0);    // the first choice has changed nothing
  EXPECT_EQ(control.state.acted[static_cast<int>(StepBound::GROW)], 10.0);
  EXPECT_EQ(control.state.acted[static_cast<int>(StepBound::CFL)], 1.0);
}

TEST(TimeStep, HeldWhereNothingLimitsIt)
{
  StepControl control;
  control.start(0.3);
  for (int k = 0; k < 3; k++) {
    ASSERT_TRUE(control.choose(StepBounds(), 0.0));
    EXPECT_EQ(control.state.dt, 0.3);
    EXPECT_EQ(control.acting(), StepBound::NONE);
  }
  control.params.max = 0.4;
  for (const double dt : {0.33, 0.363, 0.3993, 0.4, 0.4}) {
    ASSERT_TRUE(control.choose(StepBounds(), 0.0));
    EXPECT_NEAR(control.state.dt, dt, ROUNDING);
  }
  EXPECT_EQ(control.acting(), StepBound::MAX);
}

TEST(TimeStep, BelowMin)
{
  StepControl control;
  control.params.min = 0.1;
  control.start(0.01);    // growth does not hold the step below min
  ASSERT_TRUE(control.choose(simple(1.0), 0.0));
  EXPECT_EQ(control.state.dt, 0.1);
  EXPECT_FALSE(control.choose(simple(0.09), 0.0));
  control.params.min = 0.0;
  EXPECT_TRUE(control.choose(simple(0.09), 0.0));
  EXPECT_FALSE(control.choose(only(StepBound::CONVECTION, 0.0), 0.0));
}

// Whatever the limit does, every multiple is met, no step is above the limit or above 1.1 times
// the one before, and none is below half of both.
TEST(TimeStep, EveryMultipleIsMet)
{
  std::mt19937 generator(7);
  for (const double period : {0.1, 1.0, 3.7, 1e-5}) {
    StepControl control;
    control.params.align = period;
    control.start(0.01 * period);
    double time = 0.0, limit = 0.05 * period;
    int met = 0;
    for (int step = 0; step < 20000; step++) {
      limit *= std::exp(0.4 * (generator() / 4294967295.0 - 0.5));
      limit = std::clamp(limit, 0.002 * period, 3.0 * period);
      const double before = control.state.dt;
      ASSERT_TRUE(control.choose(simple(limit), time));
      const double dt = control.state.dt, bound = std::min(limit, 1.1 * before);
      ASSERT_LE(dt, bound * (1.0 + 1e-8));
      ASSERT_GE(dt, (step ? 0.5 : 0.25) * bound * (1.0 - 1e-8));
      time += dt;
      if (control.at_multiple(time)) {
        met++;
        ASSERT_EQ(time, met * period);
      }
      ASSERT_LT(time, (met + 1) * period);
    }
    EXPECT_GT(met, 100);
  }
}

// 0.29 of a step is left to the multiple: that step is short, the next is not held back by it
TEST(TimeStep, StartCloseToAMultiple)
{
  StepControl control;
  control.params.align = 1.0;
  control.start(0.1);
  double time = 0.971;
  ASSERT_TRUE(control.choose(simple(0.1), time));
  EXPECT_NEAR(control.state.dt, 0.029, ROUNDING);
  time += control.state.dt;
  EXPECT_TRUE(control.at_multiple(time));
  ASSERT_TRUE(control.choose(simple(0.1), time));
  // 1.1 * 0.1/2 = 0.055, and 1/0.055 = 18.2: 19 steps
  EXPECT_NEAR(control.state.dt, 1.0 / 19.0, ROUNDING);
}

/* ----------------------------------------------------------------------
   The limits in a simulation, at the start of a run. A time step of 1000 in
   the script is above all of them.
------------------------------------------------------------------------- */

namespace {

struct LimitCase {
  std::string name, body, predictor, wall, keywords;
  StepBound acting;
  double dt;
};

// small_channel(): d = 0.2, rho0 = 1; the fluid moves with (1.2, 1.6), |v| = 2
void expect_limit(const LimitCase &item)
{
  SCOPED_TRACE(item.name);
  Simulation sim(small_channel());
  Script script = small_script();
  script.body = item.body;
  script.predictor += item.predictor;
  script.wall += item.wall;
  script.timestep = "timestep 1000";
  sim.run(script.text() + "velocity fluid set 1.2 1.6 0\nfix dt all aleisph/dt 1" + item.keywords +
          "\nrun 0");
  EXPECT_EQ(acting(sim), item.acting);
  EXPECT_NEAR(dt_of(sim), item.dt, 1e-13 * item.dt);
  EXPECT_EQ(sim.lammps().update->dt, dt_of(sim));
  const int index = static_cast<int>(item.acting);
  if (item.acting <= aleisph::LAST_STEP_LIMIT) {
    EXPECT_EQ(sim.fix("dt", 1 + index), dt_of(sim));
  }
  EXPECT_EQ(sim.fix("dt", 7 + index), 1.0);
}

// of nu = 1 at d = 0.2
double viscous(double share)
{
  const aleisph::Kernel kernel(aleisph::KernelType::CUBIC_SPLINE, 2, 1.2 * 0.2);
  return share * 2.0 / aleisph::lattice_spectral_radius(kernel, 0.2) * 0.04;
}

}    // namespace

TEST(TimeStep, Courant)
{
  expect_limit({"fluid", "", "", "", "", StepBound::CFL, 0.2 * 0.2 / 2.0});
  expect_limit({"share", "", "", "", " cfl 0.05", StepBound::CFL, 0.05 * 0.2 / 2.0});
  expect_limit({"slow particles", "", " frame ale transport 0.1 0 0", "", "", StepBound::CFL,
                0.2 * 0.2 / 2.0});
  expect_limit({"fast particles", "", " frame ale transport -3 -4 0", "", "", StepBound::CFL,
                0.2 * 0.2 / 5.0});
  expect_limit({"wall", "", "", " velocity -8 0 0", "", StepBound::CFL, 0.2 * 0.2 / 8.0});
}

// mass 0.04: a force of 0.04 * 72 gives a = 72, sqrt(0.2/72) = 1/sqrt(360)
TEST(TimeStep, BodyForce)
{
  const std::string gravity = "fix g all gravity 72 vector 3 -4 0";
  const std::string force = "fix f fluid addforce 0 -2.88 0";
  const double limit = 1.0 / std::sqrt(360.0);
  expect_limit({"gravity", gravity, "", "", "", StepBound::FORCE, 0.25 * limit});
  expect_limit({"addforce", force, "", "", "", StepBound::FORCE, 0.25 * limit});
  expect_limit({"share", gravity, "", "", " force 0.1", StepBound::FORCE, 0.1 * limit});
}

TEST(TimeStep, ExplicitViscosity)
{
  expect_limit({"euler", "", " nu 1", "", "", StepBound::VISCOUS, viscous(0.7)});
  expect_limit({"ab2", "", " nu 1 integrator ab2", "", "", StepBound::VISCOUS, viscous(0.35)});
  expect_limit({"share", "", " nu 1", "", " viscous 0.5", StepBound::VISCOUS, viscous(0.5)});
  expect_limit({"dynamic", "", " mu 2", "", "", StepBound::VISCOUS, viscous(0.35)});
  for (const char *scheme : {"be", "cn"})
    expect_limit(
        {scheme, "", fmt::format(" nu 1 scheme {}", scheme), "", "", StepBound::CFL, 0.02});
}

// 2 nu/|v|^2 = 0.016/4
TEST(TimeStep, Convection)
{
  expect_limit({"explicit", "", " frame eulerian nu 0.008", "", "", StepBound::CONVECTION, 0.004});
  expect_limit(
      {"implicit", "", " frame eulerian nu 0.008 scheme be", "", "", StepBound::CONVECTION, 0.004});
  expect_limit({"share", "", " frame eulerian nu 0.008", "", " convection 0.5",
                StepBound::CONVECTION, 0.002});
  expect_limit(
      {"ab2", "", " frame eulerian nu 0.008 integrator ab2", "", "", StepBound::CFL, 0.02});
  expect_limit({"lagrangian", "", " nu 0.008", "", "", StepBound::CFL, 0.02});
}

TEST(TimeStep, Max)
{
  expect_limit({"max", "", "", "", " max 0.007", StepBound::MAX, 0.007});
  expect_limit({"not needed", "", "", "", " max 0.5 min 0.001", StepBound::CFL, 0.02});
}

namespace {

// a style that knows a limit, as one for surface tension would
class FixTension : public LAMMPS_NS::Fix, public aleisph::TimeStepLimit {
 public:
  FixTension(LAMMPS_NS::LAMMPS *lmp, int narg, char **arg) : Fix(lmp, narg, arg) {}
  int setmask() override { return 0; }
  void init() override
  {
    auto *owner = LAMMPS_NS::FixAleisph::find(lmp, "Fix test/tension");
    owner->scene().add_limit(this);
    limit = aleisph::capillary_limit(owner->fluid().rho0, owner->cloud().spacing(), 10.0);
  }
  void time_step_limits(StepBounds &limits) const override
  {
    limits.lower(StepBound::CAPILLARY, limit);
  }

 private:
  double limit = 0.0;
};

}    // namespace

TEST(TimeStep, LimitOfAnotherStyle)
{
  Simulation sim(small_channel());
  (*sim.lammps().modify->fix_map)["test/tension"] = [](LAMMPS_NS::LAMMPS *lmp, int narg,
                                                       char **arg) -> LAMMPS_NS::Fix * {
    return new FixTension(lmp, narg, arg);
  };
  const double limit = std::sqrt(0.008 / (20.0 * PI));
  sim.run(small_script().text() +
          "timestep 1000\nfix s fluid test/tension\n"
          "fix dt all aleisph/dt 1\nrun 0");
  EXPECT_EQ(acting(sim), StepBound::CAPILLARY);
  EXPECT_NEAR(dt_of(sim), 0.5 * limit, limit * ROUNDING);
  sim.run("unfix dt\nfix dt all aleisph/dt 1 capillary 0.25\nrun 0");
  EXPECT_NEAR(dt_of(sim), 0.25 * limit, limit * ROUNDING);
  // gone with its style
  sim.run("unfix s\nrun 0");
  EXPECT_EQ(acting(sim), StepBound::NONE);
  EXPECT_EQ(sim.fix("dt", 6), 1e30);
}

/* ----------------------------------------------------------------------
   Runs
------------------------------------------------------------------------- */

// Courant and force limits of the flow that is pushed, every step; and v = t says that each step
// was made with the time step that was announced
TEST(TimeStep, FollowsTheFlow)
{
  Pushed sim("1", "timestep 1000");
  sim.run("run 0");
  EXPECT_NEAR(dt_of(sim), 0.25 * std::sqrt(D), ROUNDING);
  double time = 0.0;
  for (int step = 1; step <= 60; step++) {
    const double dt = dt_of(sim);
    time += dt;
    sim.run("run 1");
    EXPECT_NEAR(time_of(sim), time, 1e-12);
    EXPECT_NEAR(largest(sim.v(0)), time, 1e-9);
    const double limit = std::min({0.25 * std::sqrt(D), 0.2 * D / time, 1.1 * dt});
    EXPECT_NEAR(dt_of(sim), limit, 1e-9);
  }
  EXPECT_EQ(acting(sim), StepBound::CFL);
  // 61 choices: the limit of the force acts while t < 0.8 sqrt(d) = 0.283, that is up to the fourth
  EXPECT_EQ(sim.fix("dt", 9) + sim.fix("dt", 8), 61.0);
  EXPECT_EQ(sim.fix("dt", 9), 4.0);
  EXPECT_EQ(sim.fix("dt", 7), 58.0);
}

// The step of the script is that of the first run; from there by 10 % every third step
TEST(TimeStep, EveryNSteps)
{
  Pushed sim("3 max 0.0012", "timestep 0.001");
  std::vector<double> steps;
  for (int k = 0; k < 10; k++) {
    sim.run(k ? "run 1" : "run 0");
    steps.push_back(1000.0 * dt_of(sim));
  }
  const double expected[] = {1, 1, 1, 1.1, 1.1, 1.1, 1.2, 1.2, 1.2, 1.2};
  for (int k = 0; k < 10; k++) EXPECT_NEAR(steps[k], expected[k], 1e-12) << k;
  EXPECT_EQ(acting(sim), StepBound::MAX);
}

TEST(TimeStep, NothingMoves)
{
  Simulation sim(small_channel());
  sim.run(small_script().text() + "fix dt all aleisph/dt 1\nrun 5");
  EXPECT_EQ(dt_of(sim), 0.01);
  EXPECT_EQ(acting(sim), StepBound::NONE);
  const std::string log = sim.log();
  const std::string warning = "WARNING: Fix aleisph/dt: nothing limits the time step at step 0";
  EXPECT_NE(log.find(warning), std::string::npos);
  EXPECT_EQ(log.find(warning.substr(0, 40), log.find(warning) + 1), std::string::npos);
  // a wall that is set in motion does
  sim.run(
      "unfix wall\nunfix pred\nunfix ppe\nunfix dt\nfix wall wall aleisph/wall velocity 40 0 0\n" +
      small_script().predictor + "\n" + small_script().ppe + "\nfix dt all aleisph/dt 1\nrun 0");
  EXPECT_DOUBLE_EQ(dt_of(sim), 0.001);
}

namespace {

// times of the snapshots of a text dump
std::vector<double> snapshots(const std::string &path)
{
  std::istringstream in(read_text(path));
  std::vector<double> times;
  for (std::string line; std::getline(in, line);) {
    if (line != "ITEM: TIME") continue;
    std::getline(in, line);
    times.push_back(std::stod(line));
  }
  return times;
}

}    // namespace

// Snapshots at multiples of 0.05, whatever the steps in between. LAMMPS treats dumps that may use
// computes (custom) and others (atom) differently, so that each must be alone.
TEST(TimeStep, DumpsAtMultiples)
{
  for (const std::string style : {"atom", "custom"})
    for (const int every : {1, 4}) {
      SCOPED_TRACE(fmt::format("{}, every {}", style, every));
      Pushed sim(fmt::format("{} align 0.05", every), "timestep 0.0004");
      const std::string file = scratch_file(fmt::format("times.{}.{}", style, every));
      sim.run(fmt::format("dump d all {} 1 {}{}\ndump_modify d every/time 0.05 time yes\n"
                          "run 100\nrun 60\nrun 400",
                          style, file, style == "custom" ? " id x" : ""));
      const auto times = snapshots(file);
      ASSERT_EQ(times.size(), std::floor(time_of(sim) / 0.05 + 1e-9) + 1.0);
      for (std::size_t k = 0; k < times.size(); k++) EXPECT_DOUBLE_EQ(times[k], 0.05 * k);
    }
}

TEST(TimeStep, StepsEndOnMultiples)
{
  Pushed sim("1 align 0.02");
  int met = 0;
  sim.run("run 0");
  for (int step = 0; step < 100; step++) {
    const double before = dt_of(sim);
    sim.run("run 1");
    EXPECT_LE(dt_of(sim), 1.1 * before * (1.0 + ROUNDING));
    if (time_of(sim) < (met + 1) * 0.02 - 1e-9) continue;
    met++;
    EXPECT_EQ(time_of(sim), met * 0.02);
  }
  EXPECT_GT(met, 10);
  EXPECT_NEAR(largest(sim.v(0)), time_of(sim), 1e-9);
}

namespace {

// a jittered tank, stirred, with gravity and viscosity; steps from all kinds of limits
Script stirred(const std::string &dt)
{
  Script script = script_of(tank(2, 8));
  script.body = "fix g all gravity 1.0 vector 0 -1 0";
  script.predictor += " nu 0.05 integrator ab2";
  script.timestep = "timestep 0.002\nfix dt all aleisph/dt " + dt;
  return script;
}

Scene stirred_tank()
{
  return tank(2, 8).jitter(0.1);
}

constexpr char STIR[] = "variable u atom 3*sin(PI*x)^2*sin(2*PI*y)\n"
                        "variable w atom -3*sin(2*PI*x)*sin(PI*y)^2\n"
                        "velocity fluid set v_u v_w 0\n";
constexpr char AFTER_RESTART[] = "\nneighbor 0.0375 bin\nneigh_modify every 1 delay 0 check yes\n";

const char *const settings[] = {"1", "3", "1 align 0.025", "4 align 0.025 grow 1.3"};

// everything that goes on
std::vector<double> state(const Simulation &sim)
{
  std::vector<double> all = report(sim);
  all.insert(all.end(), {time_of(sim), dt_of(sim)});
  for (int a = 0; a < 2; a++)
    for (const auto &field : {sim.x(a), sim.v(a)})
      all.insert(all.end(), field.begin(), field.end());
  return all;
}

}    // namespace

// the solver ends up elsewhere within its tolerance, 1e-12, as sums are taken in another order
TEST(TimeStep, SeveralRunsEqualOne)
{
  for (const char *setting : settings) {
    SCOPED_TRACE(setting);
    Simulation one(stirred_tank()), many(stirred_tank()), every(stirred_tank());
    const std::string script = stirred(setting).text() + STIR;
    one.run(script + "run 30");
    many.run(script + "run 0\nrun 7\nrun 3 pre no\nrun 0\nrun 5\nrun 22 upto\nrun 8");
    every.run(script + "run 30 every 5 NULL");
    EXPECT_LE(largest(state(many), state(one)), 1e-9);
    EXPECT_LE(largest(state(every), state(one)), 1e-9);
    EXPECT_GT(one.fix("dt", 7), 3.0);
  }
}

// Bitwise, in serial. The second script repeats the timestep command of the first.
TEST(TimeStep, RestartContinuesBitwise)
{
  for (const char *setting : settings) {
    SCOPED_TRACE(setting);
    const std::string file = scratch_file("dt.restart");
    Simulation first(stirred_tank()), second;
    if (first.ranks() > 1) GTEST_SKIP() << "serial";
    first.run(stirred(setting).text() + STIR + "run 17\nwrite_restart " + file);
    second.run("read_restart " + file + AFTER_RESTART + stirred(setting).text() + "run 0");
    EXPECT_EQ(state(second), state(first));
    first.run("run 20");
    second.run("run 20");
    EXPECT_EQ(second.variable("step"), 37.0);
    EXPECT_EQ(state(second), state(first));
  }
}

// written in the middle of a run, between two choices
TEST(TimeStep, RestartDuringARun)
{
  for (const char *setting : settings) {
    SCOPED_TRACE(setting);
    const std::string file = scratch_file("dt.middle");
    Simulation first(stirred_tank()), second;
    first.run(stirred(setting).text() + STIR + "restart 10 " + file + "\nrun 25");
    second.run("read_restart " + file + ".10" + AFTER_RESTART + stirred(setting).text() + "run 15");
    EXPECT_LE(largest(state(second), state(first)), 1e-9);
  }
}

// The next multiple is another one: a new choice, not after the 100 steps
TEST(TimeStep, RestartWithAnotherMultiple)
{
  const std::string file = scratch_file("dt.another");
  Simulation first(stirred_tank()), second;
  first.run(stirred("100 align 0.025").text() + STIR + "run 5\nwrite_restart " + file);
  second.run("read_restart " + file + AFTER_RESTART + stirred("100 align 0.0031").text() + "run 0");
  const double next = 0.0031 * std::ceil(time_of(second) / 0.0031);
  while (time_of(second) < next - 1e-9) second.run("run 1");
  EXPECT_EQ(time_of(second), next);
}

TEST(TimeStep, ChangesBetweenRuns)
{
  Pushed sim("5 max 0.01");
  sim.run("run 7");
  EXPECT_EQ(dt_of(sim), 0.01);
  // faster: at once, not at the next multiple of 5
  sim.run("velocity fluid set 25 0 0\nrun 0");
  EXPECT_NEAR(dt_of(sim), 0.001, ROUNDING);
  // slower: the step grows from where it is
  sim.run("velocity fluid set 0 0 0\nrun 0");
  EXPECT_NEAR(dt_of(sim), 0.0011, ROUNDING);
  sim.run("timestep 0.0002\nrun 0");
  EXPECT_NEAR(dt_of(sim), 0.0002, ROUNDING);
  sim.run("timestep 0.005\nrun 0");
  EXPECT_NEAR(dt_of(sim), 0.005, ROUNDING);
  // other parameters
  sim.run("unfix dt\nfix dt all aleisph/dt 1 max 0.001\nrun 0");
  EXPECT_NEAR(dt_of(sim), 0.001, ROUNDING);
}

// The script's step may be above the limit of viscosity, and shares above 0.7 do not warn
TEST(TimeStep, ViscousLimitIsKept)
{
  Simulation sim(small_channel());
  Script script = small_script();
  script.predictor += " nu 1";
  script.timestep = "timestep 0.5";
  EXPECT_EQ(sim.error_of(script.text() + "fix dt all aleisph/dt 1 viscous 0.95\nrun 5"), "");
  EXPECT_NEAR(dt_of(sim), viscous(0.95), 1e-14);
  EXPECT_EQ(sim.log().find("explicit viscosity"), std::string::npos);
  // without the fix it is refused as before
  sim.run("unfix dt");
  expect_words(sim.error_of("timestep 0.5\nrun 1"), {"explicit viscosity is unstable"});
}

/* ----------------------------------------------------------------------
   Errors
------------------------------------------------------------------------- */

TEST(TimeStepErrors, Command)
{
  const auto line = [](const std::string &words) {
    return [words](Script &s) { s.timestep += "\nfix dt all aleisph/dt " + words; };
  };
  expect_errors({
      {"nothing", line(""), {"fix aleisph/dt", "issing"}},
      {"N", line("0"), {"ix aleisph/dt", "N must be at least 1", "0"}},
      {"N no integer", line("1.5"), {"1.5"}},
      {"keyword", line("1 speed fast"), {"ix aleisph/dt", "unknown keyword speed"}},
      {"value missing", line("1 cfl"), {"fix aleisph/dt cfl", "issing"}},
      {"negative", line("1 cfl -0.2"), {"ix aleisph/dt", "cfl must be positive", "-0.2"}},
      {"zero", line("1 align 0"), {"ix aleisph/dt", "align must be positive", "0"}},
      {"nan", line("1 max nan"), {"nan"}},
      {"inf", line("1 force inf"), {"inf"}},
      {"word", line("1 min small"), {"small"}},
      {"viscous", line("1 viscous 1.2"), {"ix aleisph/dt", "viscous must be at most 1", "1.2"}},
      {"capillary", line("1 capillary 2"), {"capillary must be at most 1", "2"}},
      {"convection", line("1 convection 2"), {"convection must be at most 1", "2"}},
      {"grow", line("1 grow 1.0"), {"ix aleisph/dt", "grow must be greater than 1", "1.0"}},
      {"bounds", line("1 min 0.2 max 0.1"), {"min 0.2 is greater than max 0.1"}},
  });
}

TEST(TimeStepErrors, Setup)
{
  const std::string dt = "\nfix dt all aleisph/dt 1";
  expect_errors({
      {"no owner",
       [&](Script &s) { s = Script{}, s.timestep = "fix dt all aleisph/dt 1"; },
       {"ix aleisph/dt needs a fix aleisph"}},
      {"two",
       [&](Script &s) { s.timestep += dt + "\nfix dt2 all aleisph/dt 1"; },
       {"ix aleisph/dt: there must be only one"}},
      {"dt/reset",
       [&](Script &s) { s.timestep += dt + "\nfix r all dt/reset 1 NULL NULL 0.1"; },
       {"ix aleisph/dt cannot be used with fix dt/reset"}},
      {"group",
       [&](Script &s) { s.timestep += "\nfix dt fluid aleisph/dt 1"; },
       {"ix aleisph/dt: group must be that of fix sph, all"}},
      {"order", [&](Script &s) { s.wall += dt; }, {"dt", "must be defined before"}},
      {"no time step",
       [&](Script &s) {
         s.predictor += " frame eulerian";
         s.timestep += dt + "\nvelocity fluid set 1 0 0";
       },
       {"ix aleisph/dt: limit convection allows no time step at step 0"}},
  });
}

// 0.2 d/(g t) falls below 0.05 when t > 0.5
TEST(TimeStepErrors, BelowMinDuringTheRun)
{
  Pushed sim("1 min 0.05 max 0.06", "timestep 0.06");
  const std::string message = sim.error_of("run 20");
  expect_words(message, {"ix aleisph/dt: time step", "by limit cfl, is below min 0.05"});
  EXPECT_LT(number_after(message, "time step "), 0.05);
  // 0.06 to t = 0.42, then 0.0595, 0.0521
  EXPECT_EQ(number_after(message, "at step "), 9.0);
}

// fix move knows its positions from the number of steps; LAMMPS refuses
TEST(TimeStepErrors, FixMove)
{
  Simulation sim(small_channel());
  Script script = small_script();
  script.wall += "\nfix shake wall move linear 0.1 0 0";
  expect_words(sim.error_of(script.text() + "fix dt all aleisph/dt 1 max 0.005\nrun 1"),
               {"Resetting timestep size is not allowed with fix move"});
}
