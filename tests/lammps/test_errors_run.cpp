// SPDX-License-Identifier: GPL-2.0-only
/* ----------------------------------------------------------------------
   What goes wrong during a run: no silent nonsense, and what has been
   written so far is intact.
------------------------------------------------------------------------- */

#include "atom.h"
#include "errors.h"

#include <cmath>
#include <limits>
#include <sstream>

namespace {

constexpr double NOT_A_NUMBER = std::numeric_limits<double>::quiet_NaN();

// fluid that is set in motion: a pressure to solve for at each step
Script stirred_script()
{
  Script script = small_script();
  script.timestep += "\nvariable u atom sin(PI*x)*(1-y^2)\nvelocity fluid set v_u 0 0";
  return script;
}

// snapshots of a text dump, each with its atoms; an incomplete one fails
int complete_snapshots(const std::string &path, int natoms)
{
  std::istringstream in(read_text(path));
  int count = 0;
  for (std::string line; std::getline(in, line); count++) {
    EXPECT_EQ(line, "ITEM: TIMESTEP");
    for (int k = 0; k < 8; k++) EXPECT_TRUE(std::getline(in, line));
    for (int k = 0; k < natoms; k++) {
      double id, p;
      std::getline(in, line);
      EXPECT_TRUE(std::istringstream(line) >> id >> p) << "'" << line << "'";
    }
  }
  return count;
}

}    // namespace

// one iteration with ILU(0), and one with Jacobi
TEST(RunErrors, PressureNotConverged)
{
  Simulation sim(small_channel());
  sim.run(stirred_script().text());
  const std::string file = scratch_file("dump.failed");
  sim.run("dump d all custom 1 " + file +
          " id d_aleisph_p\nrun 3\nunfix ppe\n"
          "fix ppe all aleisph/ppe tol 1e-12 maxiter 1");
  expect_words(sim.error_of("run 5"),
               {"ix aleisph/ppe", "not converged", "step 4", "2 iterations", "residual",
                "tolerance 1e-12", "maxiter"});
  // steps 0 to 3; the second run starts with the snapshot that the first one ended with
  const int natoms = static_cast<int>(small_channel().x.size());
  EXPECT_EQ(complete_snapshots(file, natoms), 4);

  // and the session goes on with a better solver
  sim.run("unfix ppe\nfix ppe all aleisph/ppe tol 1e-12\nrun 2");
  EXPECT_EQ(sim.fix("ppe", 8), 0.0);
  EXPECT_TRUE(std::isfinite(largest(sim.pressure())));
}

TEST(RunErrors, PressureNotConvergedAtTheStart)
{
  Simulation sim(small_channel());
  Script script = stirred_script();
  script.ppe = "fix ppe all aleisph/ppe tol 1e-12 maxiter 1";    // of ILU(0), then of Jacobi
  expect_words(sim.error_of(script.text() + "run 5"),
               {"ix aleisph/ppe", "not converged", "step 0", "2 iterations"});
}

TEST(RunErrors, FailureWarn)
{
  Simulation sim(small_channel());
  Script script = stirred_script();
  script.ppe = "fix ppe all aleisph/ppe tol 1e-12 maxiter 1 failure warn";
  EXPECT_EQ(sim.error_of(script.text() + "run 3"), "");
  EXPECT_EQ(sim.fix("ppe", 8), 4.0);     // set-up and three steps
  EXPECT_EQ(sim.fix("ppe", 1), 2.0);     // one with each preconditioner
  EXPECT_EQ(sim.fix("ppe", 11), 4.0);    // Jacobi is no better
  EXPECT_GT(sim.fix("ppe", 2), 1e-12);
  expect_words(sim.log(), {"WARNING: Fix aleisph/ppe: pressure not converged at step 3"});
}

TEST(RunErrors, NotANumberAtTheStart)
{
  for (int a = 0; a < 2; a++) {
    Simulation sim(small_channel());
    sim.set(sim.lammps().atom->v, 42, a, NOT_A_NUMBER);
    expect_words(sim.error_of(small_script().text() + "run 1"),
                 {"ix aleisph", "velocity of atom 42 is not finite"});
  }
  Simulation sim(small_channel());
  sim.set(sim.lammps().atom->v, 42, 1, std::numeric_limits<double>::infinity());
  expect_words(sim.error_of(small_script().text() + "run 1"),
               {"ix aleisph", "velocity of atom 42 is not finite"});
}

// LAMMPS itself looks at positions first. It stops on the rank that has the atom, which leaves
// other ranks waiting.
TEST(RunErrors, PositionNotANumber)
{
  Simulation sim(small_channel());
  if (sim.ranks() > 1) GTEST_SKIP() << "serial";
  sim.set(sim.lammps().atom->x, 42, 0, NOT_A_NUMBER);
  EXPECT_NE(sim.error_of(small_script().text() + "run 1"), "");
}

TEST(RunErrors, NotANumberDuringTheRun)
{
  for (const char *frame :
       {" frame lagrangian", " frame eulerian", " frame lagrangian nu 1.0 scheme be"}) {
    SCOPED_TRACE(frame);
    Simulation sim(small_channel());
    Script script = small_script();
    // infinity - infinity in the force on one atom from step 3 on
    script.body = "variable bad equal exp(1000*(step>2.5))-exp(1000*(step>2.5))\n"
                  "group one id 42\nfix push one addforce v_bad 0 0";
    script.predictor += frame;
    expect_words(sim.error_of(script.text() + "run 5"),
                 {"ix aleisph", "atom 42", "finite", "step 3"});
  }
}

TEST(RunErrors, PressureValueNotFinite)
{
  Simulation sim(small_channel());
  Script script = small_script();
  script.pressure = "variable p0 equal exp(1000*(step>1.5))\ngroup one id 42\n"
                    "fix p one aleisph/pressure v_p0";
  expect_words(sim.error_of(script.text() + "run 3"),
               {"ix aleisph/pressure", "atom 42", "not finite", "step 2"});
}

TEST(RunErrors, WallVelocityNotFinite)
{
  Simulation sim(small_channel());
  Script script = small_script();
  script.wall = "variable u equal exp(1000*(step>1.5))\n" + script.wall + " velocity v_u 0 0";
  expect_words(sim.error_of(script.text() + "run 3"), {"ix aleisph/wall", "not finite", "step 2"});
}

// must be seen before the particle moves, when LAMMPS would stop without a name
TEST(RunErrors, TransportNotFinite)
{
  Simulation sim(small_channel());
  if (sim.ranks() > 1) GTEST_SKIP() << "serial";
  Script script = small_script();
  script.predictor = "variable w atom exp(1000*(step>1.5)*(id==42))\n" + script.predictor +
      " frame ale transport v_w 0 0";
  expect_words(sim.error_of(script.text() + "run 5"),
               {"ix aleisph/predictor", "transport", "atom 42", "finite"});
}

// atom 42 flies through the wall and out of the box, which is fixed
TEST(RunErrors, LostAtoms)
{
  Simulation sim(small_channel());
  Script script = small_script();
  script.timestep += "\nset atom 42 vy 50.0\nthermo 1";
  const std::string message = sim.error_of(script.text() + "run 200");
  expect_words(message, {"ost atoms"});
}

// During a run this is counted; for the next run these particles are not new
TEST(RunErrors, ParticlesComeClose)
{
  Simulation sim(small_channel());
  Script script = small_script();
  // from its place to 0.005 d from its neighbor's in one step
  script.predictor = "variable w atom 19.9*(id==45)*(step<0.5)\n" + script.predictor +
      " frame ale transport v_w 0 0";
  EXPECT_EQ(sim.error_of(script.text() + "run 0"), "");
  EXPECT_EQ(sim.fix("sph", 14), 0.0);
  EXPECT_EQ(sim.error_of("run 1"), "");
  EXPECT_EQ(sim.fix("sph", 14), 1.0);
  EXPECT_EQ(sim.error_of("run 1"), "");
  // a new one
  const int natoms = static_cast<int>(small_channel().x.size());
  EXPECT_EQ(sim.error_of("group old id 1:" + std::to_string(natoms)), "");
  expect_words(
      sim.error_of("create_atoms 1 single 0.1001 0.2 0 units box\ngroup new subtract all "
                   "old\nset group new type 1\ngroup fluid union fluid new\nrun 1"),
      {"ix aleisph: atom " + std::to_string(natoms + 1), "0.01 spacings", "delete_atoms overlap"});
}

// a particle that runs into another one
TEST(RunErrors, ParticlesMeet)
{
  Simulation sim(small_channel());
  Script script = small_script();
  // from its place on its neighbor's in one step
  script.predictor = "variable w atom 20*(id==45)\n" + script.predictor +
      " frame ale transport v_w 0 0";
  expect_words(sim.error_of(script.text() + "run 1"), {"ix aleisph", "same place"});
}
