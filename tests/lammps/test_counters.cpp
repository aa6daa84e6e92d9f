// SPDX-License-Identifier: GPL-2.0-only
/* ----------------------------------------------------------------------
   A scene pays for what it uses only. f_sph[7..11]: stencils, gradients,
   PPE matrices, preconditioners and Laplacians built so far.
------------------------------------------------------------------------- */

#include "script.h"
#include "simulation.h"

#include <gtest/gtest.h>

namespace {

// of stencil, gradient, PPE matrix, preconditioner, Laplacian
constexpr int PRECONDITIONER = 3;
std::vector<double> builds(const Simulation &sim)
{
  std::vector<double> counts;
  for (int k = 7; k <= 11; k++) counts.push_back(sim.fix("sph", k));
  return counts;
}

std::vector<double> each(double n)
{
  return std::vector<double>(5, n);
}

// the number before a comma behind `what` in the last report of builds
int reported(Simulation &sim, const std::string &what)
{
  sim.run("fix_modify sph report now");
  const std::string log = sim.log();
  const auto line = log.rfind("ALEISPH builds:");
  if (line == std::string::npos) return -1;
  const auto at = log.find(what + " ", line);
  if (at == std::string::npos) return -1;
  return std::stoi(log.substr(at + what.size() + 1));
}

constexpr char STIR[] = "timestep 0.01\nvariable u atom sin(PI*x)*(1-y^2)\n"
                        "velocity fluid set v_u 0 0\n";

}    // namespace

TEST(Counters, EulerianBuildsOnce)
{
  for (const char *keywords : {"", " nu 0.1", " nu 0.1 scheme be", " nu 0.1 integrator ab2"}) {
    SCOPED_TRACE(keywords);
    const Scene scene = channel(5, 10);
    Simulation sim(scene);
    Script script = script_of(scene);
    script.predictor += std::string(" frame eulerian") + keywords;
    sim.run(script.text() + STIR + "run 20");
    EXPECT_EQ(builds(sim), each(1));
    EXPECT_EQ(reported(sim, "wall passes"), 1);

    // a set-up may find other particles, and builds anew, once; the preconditioner is kept as the
    // particles are the same
    std::vector<double> again = each(2);
    again[PRECONDITIONER] = 1;
    sim.run("run 20");
    EXPECT_EQ(builds(sim), again);
    sim.run("run 20 pre no");
    EXPECT_EQ(builds(sim), again);
  }
}

// also with moving wall velocities, prescribed pressures and output in between
TEST(Counters, EulerianBuildsOnceWithEverything)
{
  const Scene scene = channel(5, 10);
  Simulation sim(scene);
  Script script = script_of(scene);
  script.wall = "variable uw equal 0.01*step\n" + script.wall + " velocity v_uw 0 0 vstar curlcurl";
  script.pressure = "variable p0 equal 0.01*step\ngroup one id 42\nfix p one aleisph/pressure v_p0";
  script.predictor += " frame eulerian nu 0.1";
  sim.run(script.text() + STIR +
          "compute c all aleisph/atom p divv lambda cond nx row nneigh\n"
          "compute r all reduce max c_c[*]\n"
          "thermo_style custom step f_ppe[1] f_ppe[3] f_sph[7] c_r[*]\nthermo 1\nrun 20");
  EXPECT_EQ(builds(sim), each(1));
}

TEST(Counters, LagrangianBuildsOnceAStep)
{
  for (const char *frame : {" frame lagrangian", " frame ale transport 0.5 0 0"}) {
    SCOPED_TRACE(frame);
    const Scene scene = channel(5, 10);
    Simulation sim(scene);
    Script script = script_of(scene);
    script.predictor += std::string(" nu 0.1") + frame;
    script.ppe += " reuse no";
    sim.run(script.text() + STIR + "run 20");
    EXPECT_EQ(builds(sim), each(21));              // and once for the set-up
    EXPECT_EQ(reported(sim, "wall passes"), 1);    // walls at rest keep their normals

    // the set-up of the second run needs no pressure, so that the stencil is all that is built
    sim.run("run 10");
    auto expected = each(31);
    expected[0] = 32;
    EXPECT_EQ(builds(sim), expected);
  }
}

// A preconditioner is kept while the particles move a little
TEST(Counters, PreconditionerIsKept)
{
  const Scene scene = channel(5, 10);
  double kept = 0.0, fresh = 0.0;
  for (const char *reuse : {"yes", "no"}) {
    Simulation sim(scene);
    Script script = script_of(scene);
    script.ppe += std::string(" reuse ") + reuse;
    sim.run(script.text() + STIR + "run 20");
    (*reuse == 'y' ? kept : fresh) = sim.fix("sph", 10);
    EXPECT_EQ(sim.fix("ppe", 10), sim.fix("sph", 10));
    EXPECT_EQ(sim.fix("ppe", 11), 0.0);    // no solve needed Jacobi
  }
  EXPECT_EQ(fresh, 21.0);
  EXPECT_LT(kept, 11.0);
}

// Walls that move change the geometry in an Eulerian frame, too
TEST(Counters, EulerianWithMovingWall)
{
  const Scene scene = channel(5, 10);
  Simulation sim(scene);
  Script script = script_of(scene);
  script.wall += "\nfix m wall move linear 0.5 0 0";
  script.predictor += " frame eulerian nu 0.1";
  script.ppe += " reuse no";
  sim.run(script.text() + STIR + "run 10");
  EXPECT_EQ(builds(sim), each(11));
  EXPECT_EQ(reported(sim, "wall passes"), 11);
}

TEST(Counters, ViscousPasses)
{
  struct Case {
    const char *keywords;
    int passes, matrices;
  };
  // 10 steps, and one for the first pressure
  for (const auto &item : {Case{"", 0, 0}, Case{" nu 0.0", 0, 0}, Case{" nu 0.1", 11, 0},
                           Case{" nu 0.1 scheme be", 1, 1}, Case{" nu 0.1 scheme cn", 11, 1}}) {
    SCOPED_TRACE(item.keywords);
    const Scene scene = channel(5, 10);
    Simulation sim(scene);
    Script script = script_of(scene);
    script.predictor += std::string(" frame eulerian") + item.keywords;
    sim.run(script.text() + STIR + "run 10");
    EXPECT_EQ(reported(sim, "viscous passes"), item.passes);
    EXPECT_EQ(reported(sim, "viscous matrix"), item.matrices);
  }
}

TEST(Counters, NoWalls)
{
  const Scene scene = periodic_square(10);
  Simulation sim(scene);
  sim.run(script_of(scene).text() + STIR + "run 5");
  EXPECT_EQ(reported(sim, "wall passes"), 0);
  EXPECT_EQ(sim.fix("sph", 1), 100.0);
  EXPECT_EQ(sim.fix("sph", 2), 0.0);
}

TEST(Counters, Rows)
{
  const Scene scene = tank(2, 8);
  Simulation sim(scene);
  sim.run(script_of(scene).text() + "run 0");
  EXPECT_EQ(sim.fix("sph", 1), 49.0);
  EXPECT_EQ(sim.fix("sph", 2), 32.0);
  for (int k = 3; k <= 6; k++) EXPECT_EQ(sim.fix("sph", k), 0.0);    // nothing prescribed or ill
}

// the report at the end of a run agrees with the fix
TEST(Counters, Report)
{
  const Scene scene = channel(5, 10);
  Simulation sim(scene);
  sim.run(script_of(scene).text() + STIR + "run 7");
  const char *const names[] = {"stencil", "gradient", "PPE matrix", "preconditioner", "Laplacian"};
  for (int k = 0; k < 5; k++) EXPECT_EQ(reported(sim, names[k]), sim.fix("sph", 7 + k));
}

// total iterations are the sum over all solves; the last solve alone is f_ppe[1]
TEST(Counters, Iterations)
{
  const Scene scene = channel(5, 10);
  Simulation sim(scene);
  sim.run(script_of(scene).text() + STIR + "run 0");
  double total = sim.fix("ppe", 9);
  EXPECT_EQ(total, sim.fix("ppe", 1));
  for (int k = 0; k < 5; k++) {
    sim.run("run 1");
    total += sim.fix("ppe", 1);
    EXPECT_EQ(sim.fix("ppe", 9), total);
  }
  EXPECT_GT(total, 0.0);
  EXPECT_EQ(sim.fix("ppe", 8), 0.0);
}
