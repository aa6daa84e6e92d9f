// SPDX-License-Identifier: GPL-2.0-only
/* ----------------------------------------------------------------------
   What a fix leaves in the particles, in LAMMPS and in restart files is
   worth something as long as there is that fix, and no longer.
------------------------------------------------------------------------- */

#include "comm.h"
#include "errors.h"

#include <cmath>
#include <limits>

namespace {

const std::string SHIFT = "fix shift fluid aleisph/shift density velocity 1.0\n";
const std::string GUARD = "fix guard fluid aleisph/guard collision 0.5\n";
const std::string FIELD = "compute u all aleisph/atom ux uy\n";

Scene disordered()
{
  return periodic_square(10).jitter(0.1);
}

// everything but a fix that shifts
std::string base(const Scene &scene)
{
  Script script = script_of(scene);
  script.predictor += " frame ale nu 0.01";
  script.timestep = "timestep 0.002";
  return "neighbor 0.03 bin\n" + script.text();
}

// the name of a restart file of the scene after some steps with these fixes
std::string saved(const Scene &scene, const std::string &fixes, const std::string &name)
{
  const std::string file = scratch_file(name + ".restart");
  Simulation sim(scene);
  sim.run(fixes + "run 3\nwrite_restart " + file);
  return file;
}

// what begins a run that goes on from it
std::string continued(const std::string &file, const std::string &fixes)
{
  return "read_restart " + file + "\nneighbor 0.03 bin\n" + fixes;
}

double largest_shift(const Simulation &sim)
{
  return largest(sim.compute("u", 1)) + largest(sim.compute("u", 2));
}

}    // namespace

// Fluid at rest stays there when nobody shifts it any more
TEST(State, ShiftVelocityEndsWithItsFix)
{
  const Scene scene = disordered();
  for (const char *guard : {"collision 0.5", "walls 0.5"}) {
    SCOPED_TRACE(guard);
    Simulation sim(scene);
    sim.run(base(scene) + SHIFT + "fix guard fluid aleisph/guard " + guard + "\n" + FIELD +
            "run 3");
    EXPECT_GT(largest_shift(sim), 0.1);
    const auto before = sim.x(0);
    sim.run("unfix shift\nrun 20");
    EXPECT_EQ(largest_shift(sim), 0.0);
    EXPECT_EQ(sim.x(0), before);
  }
}

TEST(State, ShiftVelocityEndsWithARestartWithoutItsFix)
{
  const Scene scene = disordered();
  const std::string file = saved(scene, base(scene) + SHIFT + GUARD, "stale");
  Simulation second;
  second.run(continued(file, base(scene) + GUARD + FIELD) + "run 0");
  EXPECT_EQ(largest_shift(second), 0.0);
  const auto before = second.x(0);
  second.run("run 20");
  EXPECT_EQ(largest_shift(second), 0.0);
  EXPECT_EQ(second.x(0), before);
}

// A predictor that is defined anew has a new field. The fix that shifts fills it again.
TEST(State, ShiftVelocityIsFoundAgainForANewPredictor)
{
  const Scene scene = disordered();
  const std::string rest = "fix ppe all aleisph/ppe tol 1e-12\n" + SHIFT;
  Simulation sim(scene);
  sim.run(base(scene) + SHIFT + FIELD + "run 3");
  const double before = largest_shift(sim);
  sim.run(
      "unfix shift\nunfix ppe\nunfix pred\nfix pred fluid aleisph/predictor frame ale nu 0.01\n" +
      rest + "run 0");
  EXPECT_GT(largest_shift(sim), 0.5 * before);

  // in place: fix shift keeps its own state, but the field is new
  Simulation same(scene);
  same.run(base(scene) + SHIFT + FIELD +
           "run 3\nfix pred fluid aleisph/predictor frame ale nu 0.02\n"
           "run 0");
  EXPECT_GT(largest_shift(same), 0.5 * before);
}

// Two runs are as good as one, and so is a restart with the same fixes
TEST(State, ShiftVelocityStaysWithItsFix)
{
  const Scene scene = disordered();
  const std::string fixes = base(scene) + SHIFT + FIELD;
  Simulation one(scene), two(scene), restarted;
  one.run(fixes + "run 6");
  two.run(fixes + "run 3\nrun 3");
  restarted.run(continued(saved(scene, fixes, "kept"), fixes) + "run 3");
  EXPECT_LT(largest(one.x(0), two.x(0)), 1e-12);
  EXPECT_LT(largest(one.x(0), restarted.x(0)), 1e-12);
  EXPECT_GT(largest_shift(restarted), 0.1);
}

namespace {

double cutoff(const Simulation &sim)
{
  return sim.lammps().comm->cutghostuser;
}

std::string channel_fixes(const std::string &owner = "")
{
  const Scene scene = small_channel();
  Script script = script_of(scene);
  script.owner += " " + owner;
  script.timestep = "timestep 0.01";
  return script.text();
}

const std::string UNFIX = "unfix ppe\nunfix pred\nunfix wall\nunfix sph\n";

}    // namespace

// No communication cutoff has been set by the script: whatever is needed next is free to be taken
TEST(State, CommunicationCutoffFollowsTheKernel)
{
  const Scene scene = small_channel();
  const double skin = 0.06;
  const auto reach = [&](double h_over_d) { return 2.0 * h_over_d * scene.d + skin; };

  Simulation again(scene);
  again.run("neighbor 0.06 bin\n" + channel_fixes() + "run 1");
  EXPECT_NEAR(cutoff(again), reach(1.2), 1e-12);
  again.run(UNFIX);
  EXPECT_EQ(cutoff(again), 0.0);    // as before the first fix
  again.run(channel_fixes("h/d 1.5") + "run 1");
  EXPECT_NEAR(cutoff(again), reach(1.5), 1e-12);
  again.run(UNFIX + channel_fixes("h/d 1.2") + "run 1");
  EXPECT_NEAR(cutoff(again), reach(1.2), 1e-12);

  Simulation redefined(scene);    // in place
  redefined.run("neighbor 0.06 bin\n" + channel_fixes() + "run 1");
  redefined.run("fix sph all aleisph spacing 0.2 rho0 1.0 kernel quintic-spline\nrun 1");
  EXPECT_GT(cutoff(redefined), reach(1.2) + 0.1);

  Simulation skins(scene);
  skins.run("neighbor 0.06 bin\n" + channel_fixes() + "run 1\nneighbor 0.1 bin\nrun 1");
  EXPECT_NEAR(cutoff(skins), reach(1.2) + 0.04, 1e-12);
}

TEST(State, CommunicationCutoffFollowsARestart)
{
  const Scene scene = small_channel();
  const std::string file = scratch_file("cutoff.restart");
  Simulation first(scene);
  first.run("neighbor 0.06 bin\n" + channel_fixes() + "run 1\nwrite_restart " + file);
  for (const char *change : {"neighbor 0.1 bin\n", "neighbor 0.06 bin\n"}) {
    Simulation second;
    EXPECT_EQ(second.error_of("read_restart " + file + "\n" + change + channel_fixes("h/d 1.4") +
                              "run 1"),
              "");
  }
}

// One that the script has set stays, and is not made larger
TEST(State, CommunicationCutoffOfTheScriptStays)
{
  const Scene scene = small_channel();
  Simulation sim(scene);
  sim.run("neighbor 0.06 bin\ncomm_modify cutoff 0.9\n" + channel_fixes() + "run 1\n" + UNFIX);
  EXPECT_EQ(cutoff(sim), 0.9);
  expect_words(sim.error_of("comm_modify cutoff 0.6\n" + channel_fixes("h/d 1.5") + "run 1"),
               {"ix aleisph: communication cutoff 0.6", "use comm_modify cutoff 0.66"});
}

/* ----------------------------------------------------------------------
   Numbers that have come with the particles
------------------------------------------------------------------------- */

TEST(State, NotFiniteInAProperty)
{
  const Scene scene = disordered();
  for (const char *name : {"d_aleisph_p", "d2_aleisph_u[1]", "d2_aleisph_vw[2]"}) {
    SCOPED_TRACE(name);
    Simulation sim(scene);
    sim.run(base(scene) + SHIFT + "run 1\nvariable bad atom \"exp(1000*(id==42))-exp(0)\"");
    expect_words(sim.error_of(fmt::format("set group all {} v_bad\nrun 1", name)),
                 {"ix aleisph: property", "of atom 42 is not finite", "set it to 0"});
  }
}

/* ----------------------------------------------------------------------
   Records of fixes in restart files
------------------------------------------------------------------------- */

namespace {

const std::string MARK = "ALEISPH:";
constexpr std::size_t HEAD = 24;    // of a record, before its values

std::vector<std::size_t> records_of(const std::string &text)
{
  std::vector<std::size_t> places;
  for (auto at = text.find(MARK); at != std::string::npos; at = text.find(MARK, at + 1))
    places.push_back(at);
  return places;
}

std::string all_records(const Scene &scene)
{
  return base(scene) + SHIFT + GUARD + "fix dt all aleisph/dt 10\n";
}

}    // namespace

// Whatever is wrong in a record: one error that names the fix and says what to do
TEST(State, DamagedRecordsAreRefused)
{
  const Scene scene = disordered();
  const std::string bad = scratch_file("bad.restart");
  const std::string right = read_text(saved(scene, all_records(scene), "right"));
  const auto places = records_of(right);
  ASSERT_EQ(places.size(), 5u);    // aleisph, predictor, shift, guard, dt
  const double infinity = std::numeric_limits<double>::infinity();
  for (const std::size_t place : places)
    for (const double value : {std::nan(""), -1.0, infinity, 1.0e300}) {
      std::string text = right;
      text.replace(place + HEAD, sizeof(value), reinterpret_cast<const char *>(&value),
                   sizeof(value));
      write_text(bad, text);
      Simulation second;
      expect_words(second.error_of(continued(bad, all_records(scene))),
                   {"ix aleisph", "the state of fix ", "in the restart file is damaged",
                    "give the fix another ID"});
    }

  // one of the version before, without a mark
  std::string older = right;
  const double known = 1.0;
  older.replace(places[0], sizeof(known), reinterpret_cast<const char *>(&known), sizeof(known));
  write_text(bad, older);
  Simulation second;
  expect_words(second.error_of(continued(bad, all_records(scene))),
               {"ix aleisph: the state of fix sph", "version before", "another ID"});
  // the remedy
  Simulation third;
  std::string renamed = all_records(scene);
  renamed.replace(renamed.find("fix sph"), 7, "fix own");
  EXPECT_EQ(third.error_of(continued(bad, renamed) + "run 1"), "");
}
