// SPDX-License-Identifier: GPL-2.0-only
/* ----------------------------------------------------------------------
   fix aleisph/tension: time step, where sigma comes from, what it costs a
   scene that has it and one that has not, and runs that go on.
------------------------------------------------------------------------- */

#include "aleisph_timestep.h"
#include "comm.h"
#include "errors.h"
#include "neighbor.h"
#include "tension_script.h"
#include "update.h"

using namespace tension;

/* ----------------------------------------------------------------------
   Time step
------------------------------------------------------------------------- */

TEST(TensionTimeStep, CapillaryLimit)
{
  const Scene scene = disc(5);
  Script script = tension_script(scene);
  script.timestep = "timestep 1000";
  script.dt = "fix dt all aleisph/dt 1";
  Simulation sim(scene);
  sim.run(script.text() + "run 0");
  EXPECT_EQ(sim.fix("dt", 1), static_cast<double>(aleisph::StepBound::CAPILLARY));
  EXPECT_NEAR(sim.lammps().update->dt, 0.5 * capillary(), ROUNDING);
  EXPECT_EQ(sim.fix("dt", 6), sim.lammps().update->dt);
  sim.run("unfix dt\nfix dt all aleisph/dt 1 capillary 0.25\nrun 1");
  EXPECT_NEAR(sim.lammps().update->dt, 0.25 * capillary(), ROUNDING);
  EXPECT_EQ(sim.log().find("capillary limit"), std::string::npos);
}

// between runs, with a step that will be chosen
TEST(TensionTimeStep, TimestepCommandBetweenRuns)
{
  const Scene scene = disc(5);
  Script script = tension_script(scene);
  script.dt = "fix dt all aleisph/dt 1";
  Simulation sim(scene);
  sim.run(script.text() + "run 1");
  EXPECT_EQ(sim.error_of("timestep 1000\nrun 1"), "");
  EXPECT_NEAR(sim.lammps().update->dt, 0.5 * capillary(), ROUNDING);
}

// after a run, before the fix has been part of one
TEST(TensionTimeStep, TimestepCommandBeforeItsFirstRun)
{
  const Scene scene = disc(5);
  Simulation sim(scene);
  sim.run(free_script(scene).text() + "timestep 0.001\nrun 1");
  sim.run("unfix pred\nunfix ppe\nunfix shift\n");
  Script script = tension_script(scene);
  script.owner = "";
  script.surface = script.surface.substr(script.surface.find('\n') + 1);
  sim.run(script.text() + "run 1");
}

TEST(TensionTimeStep, Fixed)
{
  const auto message = [](double share, std::string &log) {
    const Scene scene = disc(5);
    Script script = tension_script(scene);
    script.timestep = fmt::format("timestep {:.16g}", share * capillary());
    Simulation sim(scene);
    const std::string error = sim.error_of(script.text() + "run 0");
    log = sim.log();
    return error;
  };
  std::string log;
  const std::string error = message(1.01, log);
  expect_words(error, {"ix aleisph/tension: timestep", "above the capillary limit", "use at most"});
  EXPECT_NEAR(number_after(error, "timestep "), 1.01 * capillary(), 1e-5 * capillary());
  EXPECT_NEAR(number_after(error, "limit "), capillary(), 1e-5 * capillary());
  const double safe = number_after(error, "use at most ");
  EXPECT_NEAR(safe, 0.5 * capillary(), 1e-5 * capillary());

  EXPECT_EQ(message(0.9, log), "");
  EXPECT_NE(log.find("WARNING: Fix aleisph/tension: timestep"), std::string::npos);
  // what the message says can be used
  EXPECT_EQ(message(safe / capillary(), log), "");
  EXPECT_EQ(log.find("WARNING: Fix aleisph/tension"), std::string::npos);
}

// a step that another fix makes larger during the run
TEST(TensionTimeStep, RaisedDuringTheRun)
{
  const Scene scene = disc(5);
  Script script = tension_script(scene);
  script.dt = fmt::format("fix r all dt/reset 1 {} {} 1.0", 2.0 * capillary(), 3.0 * capillary());
  Simulation sim(scene);
  expect_words(sim.error_of(script.text() + "run 2"),
               {"ix aleisph/tension: timestep", "above the capillary limit"});
}

/* ----------------------------------------------------------------------
   Where sigma comes from
------------------------------------------------------------------------- */

TEST(TensionSigma, OfTheFluidFile)
{
  const std::string path = scratch_file("drop.aleisph");
  write_text(path,
             "# DATE: 2026-11-22 UNITS: lj CONTRIBUTOR: nobody CITATION: none\n"
             "rho0 1.0\nsigma 0.25\n");
  const Scene scene = disc(5);
  const auto largest_pressure = [&](const std::string &fluid, const std::string &sigma) {
    Script script = free_script(scene);
    script.owner = "fix sph all aleisph spacing 0.1 " + fluid;
    script.surface += "\nfix tens fluid aleisph/tension " + sigma;
    script.timestep = "timestep 0.001";
    Simulation sim(scene);
    sim.run(script.text() + FIELDS + "run 0");
    return largest(sim.compute("k", PTENSION));
  };
  const double expected = largest_pressure("rho0 1.0", "sigma 0.25");
  EXPECT_GT(expected, 0.0);
  EXPECT_EQ(largest_pressure("fluid " + path, ""), expected);
  EXPECT_EQ(largest_pressure("fluid " + path, "sigma 0.5"), 2.0 * expected);
  EXPECT_EQ(largest_pressure("rho0 1.0", "sigma 0"), 0.0);
}

// another fluid from here on
TEST(TensionSigma, ChangesBetweenRuns)
{
  const std::string header = "# DATE: 2026-11-22 UNITS: lj CONTRIBUTOR: nobody CITATION: none\n";
  const std::string thin = scratch_file("thin.aleisph"), thick = scratch_file("thick.aleisph");
  write_text(thin, header + "rho0 1.0\nsigma 0.25\n");
  write_text(thick, header + "rho0 1.0\nsigma 0.5\n");
  const Scene scene = disc(5);
  Script script = free_script(scene);
  script.owner = "fix sph all aleisph spacing 0.1 fluid " + thin;
  script.surface += "\nfix tens fluid aleisph/tension";
  script.timestep = "timestep 0.001";
  Simulation sim(scene);
  sim.run(script.text() + FIELDS + "run 0");
  const double p = largest(sim.compute("k", PTENSION));
  sim.run("unfix sph\nunfix tens\nunfix surf\nunfix pred\nunfix ppe\nunfix shift\n");
  script.owner = "fix sph all aleisph spacing 0.1 fluid " + thick;
  sim.run(script.text() + "run 0");
  EXPECT_EQ(largest(sim.compute("k", PTENSION)), 2.0 * p);
}

namespace {

// a square that begins to become round, in units of length L, time T and density rho
std::vector<double> drop(const std::string &units, double length, double time, double rho0)
{
  Scene scene = patch(8).scale(length);
  scene.units = units;
  scene.rho0 = rho0;
  const double speed = length / time;
  Script script = free_script(scene, fmt::format("density velocity {}", speed));
  script.surface += fmt::format("\nfix tens fluid aleisph/tension sigma {} filter 0.3",
                                0.3 * rho0 * speed * speed * length);
  script.predictor += fmt::format(" nu {}", 0.02 * speed * length);
  script.timestep = fmt::format("timestep {}", 0.01 * time);
  Simulation sim(scene);
  sim.run(script.text() + "run 10");
  std::vector<double> all;
  for (int a = 0; a < 2; a++)
    for (const double v : sim.v(a)) all.push_back(v / speed);
  for (const double p : sim.pressure()) all.push_back(p / (rho0 * speed * speed));
  return all;
}

}    // namespace

// as in test_units.cpp: the solver stops at 1e-12
TEST(TensionSigma, UnitsDoNotMatter)
{
  const auto reference = drop("lj", 1.0, 1.0, 1.0);
  EXPECT_GT(largest(reference), 0.5);
  EXPECT_LE(largest(drop("si", 1.0, 1.0, 1.0), reference), 1e-9);
  EXPECT_LE(largest(drop("si", 1e-3, 1e-2, 1000.0), reference), 1e-9);
  EXPECT_LE(largest(drop("cgs", 1e-1, 1e-2, 1.0), reference), 1e-9);
  EXPECT_LE(largest(drop("micro", 30.0, 2.0, 1e-3), reference), 1e-9);
  EXPECT_LE(largest(drop("nano", 50.0, 3.0, 1.0), reference), 1e-9);
}

/* ----------------------------------------------------------------------
   Costs
------------------------------------------------------------------------- */

namespace {

double ghost_cutoff(const Simulation &sim)
{
  return sim.lammps().comm->cutghostuser;
}

int lists(const Simulation &sim)
{
  return sim.lammps().neighbor->nlist;
}

}    // namespace

// A second neighbour list and wide ghosts come and go with the fix. The skin is 0.3 d.
TEST(TensionCost, WideListOnlyWhereNeeded)
{
  const Scene scene = disc(5);
  const auto expect = [](const Simulation &sim, int number, double cutoff) {
    EXPECT_EQ(lists(sim), number);
    EXPECT_NEAR(ghost_cutoff(sim), cutoff * D, ROUNDING);
  };
  Simulation sim(scene), published(scene);
  const std::string report = "\nfix_modify sph report now";
  sim.run(free_script(scene).text() + "timestep 0.001\nrun 1" + report);
  expect(sim, 1, 2.4 + 0.3);
  EXPECT_NE(sim.log().find("ALEISPH time"), std::string::npos);
  EXPECT_EQ(sim.log().find("  tension "), std::string::npos);
  sim.run("unfix pred\nunfix ppe\nunfix shift");
  Script script = tension_script(scene);
  script.owner = "";
  script.surface = script.surface.substr(script.surface.find('\n') + 1);
  script.timestep = "";
  sim.run(script.text() + "run 1" + report);
  expect(sim, 2, 4.8 + 0.3);
  EXPECT_NE(sim.log().find("  tension "), std::string::npos);
  sim.run("unfix tens\nrun 1");
  expect(sim, 1, 2.4 + 0.3);

  published.run(tension_script(scene, "model published").text() + "run 1");
  expect(published, 1, 2.4 + 0.3);
}

// Stencil, operators, pressure matrix and preconditioner: once a step and once for the set-up
TEST(TensionCost, BuildsOnceAStep)
{
  const Scene scene = disc(5);
  Simulation sim(scene);
  Script script = tension_script(scene, "filter 0.5");
  script.ppe += " reuse no";
  sim.run(script.text() + FIELDS +
          "thermo_style custom step f_tens[*] f_surf[*]\nthermo 1\nrun 10");
  for (int k = 7; k <= 11; k++) EXPECT_EQ(sim.fix("sph", k), 11.0) << k;
}

TEST(TensionCost, GhostCutoff)
{
  const Scene scene = disc(5);
  Simulation sim(scene);
  const std::string message = sim.error_of("comm_modify cutoff 0.4\n" +
                                           tension_script(scene).text() + "run 0");
  expect_words(message,
               {"ix aleisph: communication cutoff 0.4 is smaller than", "comm_modify cutoff 0.51"});
  EXPECT_EQ(sim.error_of("comm_modify cutoff 0.51\nrun 0"), "");
  EXPECT_EQ(ghost_cutoff(sim), 0.51);
  Simulation narrow(scene);
  EXPECT_EQ(narrow.error_of("comm_modify cutoff 0.4\n" + free_script(scene).text() +
                            "timestep 0.001\nrun 0"),
            "");
}

/* ----------------------------------------------------------------------
   Runs that go on
------------------------------------------------------------------------- */

namespace {

struct Setting {
  const char *name, *words, *nu, *dt;
};

const std::vector<Setting> &settings()
{
  static const std::vector<Setting> all = {
      {"tangent", "angle wall 60", " nu 0.02", ""},
      {"force", "form force angle left 60 angle right 120 filter 0.5", "", ""},
      {"published", "model published form pressure", " nu 0.2 scheme be", ""},
      {"variable", "angle wall v_theta filter 0.5", "", "fix dt all aleisph/dt 3 cfl 0.1"}};
  return all;
}

// a block on the floor of a tank, disordered
Scene rough_block()
{
  return dam(8).jitter(0.15);
}

std::string block_script(const Setting &setting)
{
  const Scene scene = rough_block();
  Script script = angle_script(scene, setting.words, "variable theta equal 60+10*step/20");
  script.body = "fix g all gravity 0.2 vector 0 -1 0";
  script.predictor += setting.nu;
  script.dt = setting.dt;
  return script.text() + FIELDS;
}

std::vector<double> state(const Simulation &sim)
{
  std::vector<double> all = sim.pressure();
  const auto append = [&all](const std::vector<double> &field) {
    all.insert(all.end(), field.begin(), field.end());
  };
  for (int a = 0; a < 2; a++) {
    append(sim.x(a));
    append(sim.v(a));
    append(sim.compute("k", TNX + a));
  }
  append(sim.compute("k", KAPPA));
  append(sim.compute("k", PTENSION));
  append(report(sim));
  return all;
}

constexpr char AFTER_RESTART[] = "\nneighbor 0.0375 bin\nneigh_modify every 1 delay 0 check yes\n";
// neighbour lists are made in every step and atoms stay in their order, so that a new set-up
// changes nothing
constexpr char SAME_ORDER[] = "atom_modify sort 0 0.0\nneigh_modify every 1 delay 0 check no\n";

}    // namespace

// Bitwise, in serial
TEST(TensionRuns, TwoRunsAreOne)
{
  for (const auto &setting : settings()) {
    SCOPED_TRACE(setting.name);
    Simulation one(rough_block()), two(rough_block());
    const std::string script = SAME_ORDER + block_script(setting);
    one.run(script + "run 20");
    two.run(script + "run 10\nrun 0\nrun 10");
    EXPECT_GT(largest(one.v(0)), 1e-3);
    if (one.ranks() == 1)
      EXPECT_EQ(state(two), state(one));
    else
      EXPECT_LE(largest(state(two), state(one)), 1e-7);
  }
}

TEST(TensionRuns, RestartContinues)
{
  for (const auto &setting : settings()) {
    SCOPED_TRACE(setting.name);
    const std::string file = scratch_file("tension.restart");
    Simulation first(rough_block()), second;
    first.run(block_script(setting) + "run 10\nwrite_restart " + file + "\nrun 10");
    // groups come from the file
    second.run("read_restart " + file + AFTER_RESTART + block_script(setting) + "run 10");
    EXPECT_EQ(second.variable("step"), 20.0);
    if (first.ranks() == 1)
      EXPECT_EQ(state(second), state(first));
    else
      EXPECT_LE(largest(state(second), state(first)), 1e-7);
  }
}

// Each rank alone does what all do together, up to the tolerance of the solver
TEST(TensionRuns, RanksAgree)
{
  for (const auto &setting : settings()) {
    SCOPED_TRACE(setting.name);
    Simulation all(rough_block()), one(rough_block(), MPI_COMM_SELF);
    if (all.ranks() == 1) GTEST_SKIP() << "several ranks";
    // between the ranks there is fluid
    all.run("balance 1.0 shift xy 20 1.01\n" + block_script(setting) + "run 20");
    one.run(block_script(setting) + "run 20");
    EXPECT_LE(largest(state(all), state(one)), 1e-7);
  }
}

// The pressure jump alone moves nothing: what is left is the scatter of K, a few percent of
// sigma/R, which gives velocities of its square root at the very most.
TEST(TensionRuns, DiscStaysAtRest)
{
  const Scene scene = disc(8);
  const double scale = std::sqrt(SIGMA / radius(8));
  Script script = tension_script(scene);
  script.predictor += fmt::format(" nu {}", 0.05 * std::sqrt(SIGMA * D));
  Simulation sim(scene);
  sim.run(script.text() + FIELDS + "run 60");
  EXPECT_LE(std::hypot(largest(sim.v(0)), largest(sim.v(1))), 0.1 * scale);
  const auto K = where(sim.compute("k", KAPPA), sim.compute("k", KIND), 1.0);
  EXPECT_NEAR(mean(K), 1.0 / radius(8), 0.01 / radius(8));
}

TEST(TensionRuns, OutputBeforeTheFirstRun)
{
  const Scene scene = disc(5);
  Simulation sim(scene);
  sim.run(tension_script(scene).text());
  EXPECT_EQ(report(sim), std::vector<double>(9, 0.0));
  EXPECT_NE(sim.error_of("unfix sph\nprint \"$(f_tens[1])\"").find("needs a fix aleisph"),
            std::string::npos);
}

// What is left of the fix is not asked
TEST(TensionRuns, FieldsAfterItHasGone)
{
  const Scene scene = disc(5);
  Simulation sim(scene);
  sim.run(tension_script(scene).text() + FIELDS + "run 1\nunfix tens");
  EXPECT_EQ(largest(sim.compute("k", KAPPA)), 0.0);
  sim.run("run 1");
  EXPECT_EQ(largest(sim.compute("k", KAPPA)), 0.0);
}
