// SPDX-License-Identifier: GPL-2.0-only
/* ----------------------------------------------------------------------
   Commands of LAMMPS together with the package: rerun, particles that come
   and go, boxes that change, bonds.
------------------------------------------------------------------------- */

#include "errors.h"
#include "library.h"
#include "update.h"

#include <cmath>

namespace {

constexpr char STIR[] = "variable u atom sin(4*PI*x)*cos(4*PI*y)\n"
                        "variable w atom -cos(4*PI*x)*sin(4*PI*y)\n"
                        "velocity fluid set v_u v_w 0\n";
// The solver stops at 1e-12 of its right hand side; sums in another order end up as far apart
constexpr double ROUNDING = 1.0e-9;

std::string periodic_script()
{
  Script script = script_of(periodic_square(12));
  script.timestep = "timestep 0.01";
  return script.text() + STIR;
}

// a tank with a free surface, filled to a height of 1, and room above
Scene half_full()
{
  return open_tank(2, 8, 8);
}

std::string half_full_script(const std::string &body = "")
{
  Script script = free_script(half_full());
  script.body = "fix g all gravity 1.0 vector 0 -1 0" + body;
  script.timestep = "timestep 0.01";
  return script.text();
}

// one particle, at step 1, above the fluid of half_full()
std::string deposit(const std::string &group, int type, const std::string &more = "")
{
  return fmt::format("\nregion slot block 0.3 0.7 1.4 1.6 -0.01 0.01 units box\n"
                     "fix dep {} deposit 1 {} 1 4321 region slot {}",
                     group, type, more);
}

}    // namespace

// Each frame has the pressure that a run which starts with it has
TEST(Commands, RerunSolvesEveryFrame)
{
  const std::string file = scratch_file("dump.rerun");
  Simulation sim(periodic_square(12));
  sim.run(periodic_script() + "dump d all custom 10 " + file +
          " id type x y vx vy\ndump_modify d format float %.17g\nrun 20\nundump d");
  std::vector<double> before;
  for (const int frame : {0, 10, 20}) {
    SCOPED_TRACE(frame);
    Simulation alone(periodic_square(12));
    alone.run(fmt::format("{}read_dump {} {} x y vx vy\nrun 0", periodic_script(), file, frame));
    sim.run(fmt::format("rerun {} first 0 last {} dump x y vx vy", file, frame));
    EXPECT_LE(largest(sim.pressure(), alone.pressure()), ROUNDING);
    if (!before.empty()) {
      EXPECT_GT(largest(sim.pressure(), before), 1e-3);
    }
    before = sim.pressure();
  }
  // what the frames asked LAMMPS for does not outlive the fixes
  sim.run("unfix ppe\nunfix pred\nunfix sph\n" + periodic_script() + "run 2");
  EXPECT_TRUE(std::isfinite(largest(sim.pressure())));
}

TEST(Commands, ParticlesThatComeAreChecked)
{
  struct Case {
    std::string name, body;
    Words words;
  };
  const std::vector<Case> cases = {
      {"another mass",
       "\nmass 3 1.0" + deposit("fluid", 3),
       {"ix aleisph", "mass of atom", "must be rho0 * spacing^2"}},
      {"out of the plane",
       deposit("fluid", 1, "vz 1 1"),
       {"ix aleisph", "velocity in z in a 2d simulation"}},
      {"without a role", deposit("all", 1), {"ix aleisph", "neither fluid", "nor wall"}}};
  for (const auto &item : cases) {
    SCOPED_TRACE(item.name);
    Simulation sim(half_full());
    expect_words(sim.error_of(half_full_script(item.body) + "run 3"), item.words);
    EXPECT_EQ(sim.lammps().update->ntimestep, 1);
  }
}

TEST(Commands, ParticlesComeAndGo)
{
  const double n = static_cast<double>(half_full().x.size());
  Simulation sim(half_full());
  sim.run(half_full_script(deposit("fluid", 1)) + "run 5");
  EXPECT_EQ(sim.variable("atoms"), n + 1.0);
  sim.run("unfix dep\nregion drop block 0.2 0.8 1.2 1.7 INF INF units box\n"
          "group drop region drop\ndelete_atoms group drop compress no\nrun 5");
  EXPECT_EQ(sim.variable("atoms"), n);
  EXPECT_TRUE(std::isfinite(largest(sim.pressure())));
  if (!lammps_has_style(&sim.lammps(), "fix", "evaporate")) return;
  sim.run("region top block INF INF 0.9 INF INF INF units box\ngroup top region top\n"
          "fix ev fluid evaporate 2 1 top 77\nrun 5");
  EXPECT_LT(sim.variable("atoms"), n);
  EXPECT_TRUE(std::isfinite(sim.fix("ppe", 3)));
}

// Half the box by half of it: flows with that period are the same
TEST(Commands, TriclinicBox)
{
  Simulation plain(periodic_square(12)), tilted(periodic_square(12));
  tilted.run("change_box all triclinic\nchange_box all xy final 0.5");
  for (auto *sim : {&plain, &tilted}) sim->run(periodic_script() + "run 20");
  EXPECT_LE(largest(tilted.pressure(), plain.pressure()), ROUNDING);
  for (int a = 0; a < 2; a++) EXPECT_LE(largest(tilted.v(a), plain.v(a)), ROUNDING);
}

// A larger box about a free patch does nothing
TEST(Commands, BoxChangesBetweenRuns)
{
  Script script = free_script(patch(12));
  script.timestep = "timestep 0.005";
  Simulation plain(patch(12)), larger(patch(12));
  for (auto *sim : {&plain, &larger})
    sim->run(script.text() + "variable u atom y\nvariable w atom -x\nvelocity all set v_u v_w 0");
  plain.run("run 5\nrun 5");
  larger.run("run 5\nchange_box all x final -4 4 y final -3 5\nrun 5");
  EXPECT_LE(largest(larger.pressure(), plain.pressure()), ROUNDING);
  for (int a = 0; a < 2; a++) EXPECT_LE(largest(larger.v(a), plain.v(a)), ROUNDING);
}

TEST(Commands, RanksAreBalanced)
{
  Script script = free_script(half_full());
  script.body = "fix g all gravity 1.0 vector 0 -1 0";
  script.timestep = "timestep 0.01";
  Simulation plain(half_full()), balanced(half_full());
  plain.run(script.text() + "run 20");
  balanced.run("fix bal all balance 5 1.0 shift xy 10 1.05\n" + script.text() + "run 20");
  EXPECT_LE(largest(balanced.pressure(), plain.pressure()), ROUNDING);
}

// Bonds between wall particles, with and without weights that keep the neighbors
TEST(Commands, SpecialBonds)
{
  Simulation sim;
  if (!lammps_has_style(&sim.lammps(), "atom", "bond")) GTEST_SKIP() << "LAMMPS without MOLECULE";
  sim.run("units lj\ndimension 2\nboundary p f p\natom_style bond\nlattice sq 1\n"
          "region box block 0 10 -5.5 5.5 -0.5 0.5\n"
          "create_box 2 box bond/types 1 extra/bond/per/atom 4 extra/special/per/atom 8\n"
          "create_atoms 1 box\nregion inside block INF INF -4.5 4.5 INF INF\n"
          "group fluid region inside\ngroup wall subtract all fluid\nmass * 1.0\n"
          "neighbor 0.3 bin\npair_style zero 2.4\npair_coeff * *\nbond_style zero\nbond_coeff 1\n"
          "create_bonds many wall wall 1 0.5 1.1\n"
          "fix sph all aleisph spacing 1 rho0 1\nfix wall wall aleisph/wall\n"
          "fix g all gravity 1 vector 0 -1 0\nfix pred fluid aleisph/predictor frame eulerian\n"
          "fix ppe all aleisph/ppe tol 1e-12\ntimestep 0.01\n");
  expect_words(
      sim.error_of("run 1"),
      {"ix aleisph", "special_bonds removes neighbors of atom", "use special_bonds lj/coul"});
  sim.run("special_bonds lj/coul 1.0e-50 1.0e-50 1.0e-50\nrun 1");
  // at rest: p = -y
  const auto p = without_mean(sim.pressure()), y = sim.x(1);
  for (std::size_t i = 0; i < p.size(); i++) EXPECT_NEAR(p[i], -y[i], ROUNDING);
}
