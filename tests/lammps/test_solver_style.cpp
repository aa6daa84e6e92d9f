// SPDX-License-Identifier: GPL-2.0-only
/* ----------------------------------------------------------------------
   Choice and life of the preconditioners of fix aleisph/ppe and fix
   aleisph/predictor, on any number of ranks.
------------------------------------------------------------------------- */

#include "aleisph_mpi_amg.h"
#include "errors.h"
#include "script.h"
#include "simulation.h"

#include <gtest/gtest.h>

namespace {

constexpr char STIR[] = "velocity fluid set 0.3 0 0\n";

// open tank under gravity; particles are shifted, and have moved by 0.1 d in the end
std::vector<double> pressure_of(const std::string &keywords, double *builds = nullptr,
                                const std::string &commands = "")
{
  const Scene scene = open_tank(2, 16).jitter(0.2);
  Simulation sim(scene);
  Script script = free_script(scene);
  script.body = "fix g all gravity 1.0 vector 0 -1 0";
  script.ppe = "fix ppe all aleisph/ppe tol 1e-11 " + keywords;
  script.timestep = "timestep 0.002";
  sim.run(script.text() + STIR + commands + "run 10");
  EXPECT_EQ(sim.fix("ppe", 8), 0.0) << keywords;
  EXPECT_EQ(sim.fix("ppe", 11), 0.0) << keywords;
  if (builds) *builds = sim.fix("ppe", 10);
  return sim.pressure();
}

}    // namespace

// and the log tells it
TEST(SolverStyle, AutoGoesByTheNumberOfUnknowns)
{
  for (const int n : {10, 45}) {
    const Scene scene = tank(2, n);
    Simulation sim(scene);
    sim.run(script_of(scene).text() + "run 0");
    const bool multigrid = scene.x.size() >= 2000 && aleisph::amg_available();
    const std::string line = fmt::format("Fix aleisph/ppe: preconditioner {} for {} unknowns\n",
                                         multigrid ? "amg" : "ilu0", scene.x.size());
    EXPECT_NE(sim.log().find(line), std::string::npos) << line;
  }
}

// the tolerance is 1e-11 in every step; ten steps do not amplify it by more than a thousand
TEST(SolverStyle, TheSamePressureWithAll)
{
  const auto expected = pressure_of("preconditioner jacobi");
  for (const std::string keywords : {"preconditioner ilu0", "preconditioner ilu0 reuse no",
                                     "preconditioner amg", "preconditioner amg reuse no"}) {
    if (keywords.find("amg") != std::string::npos && !aleisph::amg_available()) continue;
    double builds = 0.0;
    EXPECT_LE(relative_l2(pressure_of(keywords, &builds), expected), 1.0e-8) << keywords;
    if (keywords.find("no") != std::string::npos)
      EXPECT_EQ(builds, 11.0) << keywords;
    else
      EXPECT_LT(builds, 11.0) << keywords;
  }
}

// particles change places, and ranks where there are several: no reason for another one
TEST(SolverStyle, KeptWhileParticlesAreSorted)
{
  for (const std::string type : {"ilu0", "amg"}) {
    if (type == "amg" && !aleisph::amg_available()) continue;
    double still = 0.0, sorted = 0.0;
    const auto expected = pressure_of("preconditioner " + type, &still);
    const auto p = pressure_of("preconditioner " + type, &sorted,
                               "neigh_modify every 1 delay 0 check no\n"
                               "atom_modify sort 1 0.01\n");
    EXPECT_LE(relative_l2(p, expected), 1.0e-8) << type;
    // one for each sort would be 11; several ranks' ilu0 comes with other iterations
    EXPECT_LE(sorted, still + 1.0) << type;
    EXPECT_LE(still, 3.0) << type;
  }
}

TEST(SolverStyle, MultigridMustHaveBeenCompiledIn)
{
  if (aleisph::amg_available()) GTEST_SKIP() << "compiled with hypre";
  const Scene scene = tank(2, 10);
  Simulation sim(scene);
  Script script = script_of(scene);
  script.ppe += " preconditioner amg";
  expect_words(sim.error_of(script.text() + "run 0"),
               {"ix aleisph/ppe", "needs the library hypre"});
}

// three iterations are too few for ILU(0), and for Jacobi after it
TEST(SolverStyle, FallbackIsCountedAndTold)
{
  const Scene scene = open_tank(2, 16).jitter(0.2);
  Simulation sim(scene);
  Script script = free_script(scene);
  script.body = "fix g all gravity 1.0 vector 0 -1 0";
  script.ppe = "fix ppe all aleisph/ppe preconditioner ilu0 maxiter 3 failure warn";
  script.timestep = "timestep 0.002";
  sim.run(script.text() + "run 0");
  EXPECT_EQ(sim.fix("ppe", 11), 1.0);
  EXPECT_EQ(sim.fix("ppe", 10), 2.0);
  EXPECT_EQ(sim.fix("ppe", 1), 6.0);
  expect_words(sim.log(),
               {"preconditioner ilu0 failed at step 0", "iteration limit reached",
                "jacobi was used", "pressure not converged"});
}

// Information goes one particle further in each iteration: a long tank needs as many at least.
// Before, the limit was 1000 for every scene.
TEST(SolverStyle, LongScenesHaveMoreIterations)
{
  constexpr int LENGTH = 1200;
  Scene scene;
  scene.d = 1.0;
  scene.boundary = "f p p";
  scene.low = {-0.5, 0.0, -0.5};
  scene.high = {LENGTH + 0.5, 4.0, 0.5};
  for (int i = 0; i <= LENGTH; i++)
    for (int j = 0; j < 4; j++)
      scene.add(i == 0 || i == LENGTH ? Scene::WALL : Scene::FLUID, i, j + 0.5);
  scene.jitter(0.1);
  Simulation sim(scene);
  Script script = script_of(scene);
  script.body = "fix g all gravity 1.0 vector 1 0 0";
  script.ppe = "fix ppe all aleisph/ppe tol 1e-8 preconditioner jacobi";
  script.timestep = "timestep 0.01";
  sim.run(script.text() + "run 0");
  EXPECT_GT(sim.fix("ppe", 1), 1000.0);
  EXPECT_EQ(sim.fix("ppe", 8), 0.0);
  // a number in the script is obeyed
  script.ppe += " maxiter 1000";
  expect_words(Simulation(scene).error_of(script.text() + "run 0"),
               {"not converged", "1000 iterations"});
}

// the viscous velocity does not depend on it either
TEST(SolverStyle, ViscousSolve)
{
  std::vector<double> expected;
  for (const std::string name : {"jacobi", "auto", "none", "ilu0", "amg"}) {
    if (name == "amg" && !aleisph::amg_available()) continue;
    const Scene scene = channel(8, 12);
    Simulation sim(scene);
    Script script = script_of(scene);
    script.predictor += " nu 0.5 scheme be preconditioner " + name;
    script.timestep = "timestep 0.02";
    sim.run(script.text() + STIR + "run 5");
    EXPECT_EQ(sim.fix("pred", 6), 0.0) << name;
    if (expected.empty())
      expected = sim.v(0);
    else
      EXPECT_LE(relative_l2(sim.v(0), expected), 1.0e-9) << name;
  }
}
