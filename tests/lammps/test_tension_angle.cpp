// SPDX-License-Identifier: GPL-2.0-only
/* ----------------------------------------------------------------------
   fix aleisph/tension: contact angles, and contact lines on walls.
------------------------------------------------------------------------- */

#include "errors.h"
#include "tension_script.h"

#include <algorithm>
#include <numeric>

using namespace tension;

namespace {

constexpr int WIDE = 20;    // spacings between the walls of the tank

// K on the surface of the tank from left to right
std::vector<double> surface_curvature(const std::string &angles, const std::string &before = "")
{
  const Scene scene = open_tank(2, WIDE);
  Simulation sim(scene);
  sim.run(angle_script(scene, angles, before).text() + FIELDS + "run 0");
  return where(sim.compute("k", KAPPA), sim.compute("k", KIND), 1.0);
}

// open_tank() in 3d with n * n columns of `rows` particles. A spacing that is a power of 2: the second
// column is at the reach of contact particles, and must be so without rounding.
Scene shallow_tank(int n, int rows)
{
  Scene scene;
  scene.dimension = 3;
  scene.d = 0.125;
  scene.boundary = "f f f";
  scene.low.fill(-0.5 * scene.d);
  scene.high = {(n + 1.5) * scene.d, (n + 1.5) * scene.d, (rows + 3.5) * scene.d};
  for (int k = 0; k <= rows + 3; k++)
    for (int j = 0; j <= n + 1; j++)
      for (int i = 0; i <= n + 1; i++) {
        const bool side = i == 0 || i == n + 1 || j == 0 || j == n + 1;
        if (!side && k > rows) continue;
        scene.add(side || k == 0 ? Scene::WALL : Scene::FLUID, i * scene.d, j * scene.d,
                  k * scene.d);
      }
  return scene;
}

std::vector<double> left_end(std::vector<double> values)
{
  values.resize(values.size() / 4);
  return values;
}

std::vector<double> reversed(std::vector<double> values)
{
  std::reverse(values.begin(), values.end());
  return values;
}

}    // namespace

// At 90 degrees the fluid goes straight on through the wall, as on an infinite lattice: no
// curvature, and the tank stays at rest under gravity as without tension.
TEST(ContactAngle, NeutralTankStaysAtRest)
{
  for (const int dimension : {2, 3}) {
    SCOPED_TRACE(dimension);
    const Scene scene = dimension == 2 ? open_tank(2, 12) : open_slab();
    Script script = tension_script(scene, "angle wall 90");
    script.body = fmt::format("fix g all gravity 1.0 vector {}",
                              dimension == 2 ? "0 -1 0" : "0 0 -1");
    script.ppe = "fix ppe all aleisph/ppe tol 1e-13";
    Simulation sim(scene);
    sim.run(script.text() + FIELDS + "run 20");
    EXPECT_LE(largest(sim.compute("k", KAPPA)), 1e-10 / D);
    EXPECT_LE(std::max(largest(sim.v(0)), largest(sim.v(dimension - 1))), 1e-10);
  }
}

// The same in the edges and corners of a tank, shallow enough for the surface to see the floor;
// sigma/(rho g d^2) = 1
TEST(ContactAngle, NeutralTankWithEdgesStaysAtRest)
{
  const Scene scene = shallow_tank(6, 4);
  Script script = tension_script(scene, "angle wall 90");
  script.body = "fix g all gravity 32.0 vector 0 0 -1";
  script.ppe = "fix ppe all aleisph/ppe tol 1e-13";
  Simulation sim(scene);
  sim.run(script.text() + FIELDS + "run 50");
  EXPECT_LE(largest(sim.compute("k", KAPPA)), 1e-8 / scene.d);
  for (int a = 0; a < 3; a++) EXPECT_LE(largest(sim.v(a)), 1e-8) << a;
}

// Fluid that wets the walls is drawn up, above all in the edges, and the four of them are alike
TEST(ContactAngle, EdgesOfATank)
{
  for (const int angle : {60, 120}) {
    const Scene scene = shallow_tank(6, 4);
    Simulation sim(scene);
    sim.run(tension_script(scene, fmt::format("angle wall {}", angle)).text() + FIELDS + "run 0");
    const auto K = where(sim.compute("k", KAPPA), sim.compute("k", KIND), 1.0);
    ASSERT_EQ(K.size(), 36u);
    const double sign = angle < 90 ? -1.0 : 1.0;
    for (const double value : K) EXPECT_GT(sign * value, 0.0);
    EXPECT_GT(sign * K[0], sign * K[2]);
    for (const int corner : {5, 30, 35}) EXPECT_NEAR(K[corner], K[0], 1e-9 / scene.d);
    EXPECT_NEAR(K[1], K[6], 1e-9 / scene.d);
  }
}

// The particle next to each wall, a spacing away; the second is 2 d away
TEST(ContactAngle, ContactParticles)
{
  const Scene scene = open_tank(2, 12);
  const double d = scene.d;
  Simulation sim(scene);
  sim.run(tension_script(scene, "angle wall 60").text() + FIELDS + "run 0");
  const auto contact = sim.compute("k", CONTACT), kind = sim.compute("k", KIND), x = sim.x(0);
  for (std::size_t i = 0; i < x.size(); i++) {
    const bool near = kind[i] == 1.0 && (x[i] < 1.5 * d || x[i] > 1.0 - 1.5 * d);
    EXPECT_EQ(contact[i], near ? 1.0 : 0.0);
  }
  EXPECT_EQ(sim.fix("tens", 4), 2.0);
}

// Fluid that wets the wall is hollow there, and is drawn up; fluid that does not is pushed down.
// N turns by less than 90 - theta over a few spacings.
TEST(ContactAngle, SignOfTheCurvature)
{
  const auto wet = surface_curvature("angle wall 60"), dry = surface_curvature("angle wall 120"),
             neutral = surface_curvature("");
  EXPECT_LE(largest(neutral), 1e-10 * WIDE);
  for (const auto *K : {&wet, &dry}) {
    const double sign = K == &wet ? -1.0 : 1.0;
    EXPECT_GT(sign * K->front(), 0.0);
    EXPECT_NEAR(K->front(), K->back(), 1e-9 * WIDE);
    EXPECT_GT(std::fabs(K->front()), 10.0 * std::fabs((*K)[WIDE / 2]));
    // integral of K along the surface: the turn of N, at most 30 degrees at each end
    const double turn = sign * std::accumulate(K->begin(), K->end(), 0.0) / WIDE;
    EXPECT_GT(turn, 0.0);
    EXPECT_LT(turn, 2.0 * PI / 6.0);
  }
}

TEST(ContactAngle, StrongerWithTheAngle)
{
  double before = 0.0;
  for (const int angle : {75, 60, 45, 30}) {
    const double K = surface_curvature(fmt::format("angle wall {}", angle)).front();
    EXPECT_LT(K, before) << angle;
    before = K;
  }
}

// Groups of walls have their own angles; what the other wall does is not seen in the quarter
// of the surface next to the first
TEST(ContactAngle, Groups)
{
  const auto wet = surface_curvature("angle wall 60"), dry = surface_curvature("angle wall 120");
  const auto mixed = surface_curvature("angle left 60 angle right 120");
  EXPECT_EQ(left_end(mixed), left_end(wet));
  EXPECT_EQ(left_end(reversed(mixed)), left_end(reversed(dry)));
  // the same twice is no contradiction
  EXPECT_EQ(surface_curvature("angle wall 60 angle left 60"), wet);
  // walls without a keyword are neutral
  const auto half = surface_curvature("angle left 60");
  EXPECT_EQ(left_end(half), left_end(wet));
  EXPECT_LE(largest(left_end(reversed(half))), 1e-10 * WIDE);
}

// The script and the order of the keywords do not decide which of two angles is meant
TEST(ContactAngle, OverlappingGroupsAreRefused)
{
  const Scene scene = open_tank(2, WIDE);
  const auto error_of = [&](const std::string &angles, const std::string &before = "") {
    Simulation sim(scene);
    return sim.error_of(angle_script(scene, angles, before).text() + "run 0");
  };
  const Words words = {"atom",           "two values of angle", "120 by fix tens", "for group wall",
                       "60 by fix tens", "for group left",      "take it out"};
  expect_words(error_of("angle wall 120 angle left 60"), words);
  expect_words(error_of("angle left 60 angle wall 120"), words);
  expect_words(error_of("angle wall 60 angle left v_theta", "variable theta equal 60"),
               {"two values of angle", "v_theta"});
  // fluid in both groups has no angle
  EXPECT_EQ(
      error_of("angle a 60 angle b 120", "group a union left fluid\ngroup b union right fluid\n"),
      "");
}

TEST(ContactAngle, Variables)
{
  const auto wet = surface_curvature("angle wall 60");
  EXPECT_EQ(surface_curvature("angle wall v_theta", "variable theta equal 60"), wet);
  EXPECT_EQ(surface_curvature("angle wall v_theta", "variable theta atom 60"), wet);
  EXPECT_EQ(surface_curvature("angle wall v_theta", "variable theta atom 60+60*(x>0.5)"),
            surface_curvature("angle left 60 angle right 120"));
}

// Evaluated in every step
TEST(ContactAngle, VariableOfTime)
{
  const Scene scene = open_tank(2, 12);
  Simulation sim(scene);
  Script script = angle_script(scene, "angle wall v_theta",
                               "variable theta equal 90-30*(step>2.5)");
  sim.run(script.text() + FIELDS + "run 2");
  EXPECT_LE(largest(sim.compute("k", KAPPA)), 1e-9);
  sim.run("run 1");
  EXPECT_LT(where(sim.compute("k", KAPPA), sim.compute("k", KIND), 1.0).front(), -0.1);
}

// Surface particles closer than a spacing to a wall do not approach it further, here in a block that
// falls into a corner. Without tension some do.
TEST(ContactAngle, HeldAboveWalls)
{
  const auto lowest = [](bool tension, double &held) {
    const Scene scene = dam(8).jitter(0.15);
    const double d = scene.d;
    Script script = tension ? tension_script(scene, "angle wall 120") : free_script(scene);
    Simulation sim(scene);
    sim.run(script.text() + "timestep 0.005\nvelocity fluid set -1 -1 0" + FIELDS);
    double slowest = 0.0;
    held = 0.0;
    for (int step = 0; step < 20; step++) {
      sim.run("run 1 post no");
      const auto kind = sim.compute("k", KIND), x = sim.x(0), y = sim.x(1), u = sim.v(0),
                 v = sim.v(1);
      if (tension) held += sim.fix("tens", 9);
      for (std::size_t i = 0; i < x.size(); i++) {
        if (kind[i] != 1.0) continue;
        if (y[i] < 0.999 * d) slowest = std::min(slowest, v[i]);
        if (x[i] < 0.999 * d) slowest = std::min(slowest, u[i]);
      }
    }
    return slowest;
  };
  double held;
  EXPECT_LT(lowest(false, held), -1e-3);
  EXPECT_GE(lowest(true, held), -1e-14);
  EXPECT_GT(held, 0.0);
}

// One rank alone finds what all find together: with a wall on one rank and the fluid that touches it
// on the other, with fluid between them, and in 3d
TEST(ContactAngle, RanksAgree)
{
  int ranks;
  MPI_Comm_size(MPI_COMM_WORLD, &ranks);
  if (ranks == 1) GTEST_SKIP() << "several ranks";
  const Scene block = dam(8).jitter(0.1);
  const double share = (0.5 * block.d - block.low[0]) / (block.high[0] - block.low[0]);
  const std::vector<std::pair<Scene, std::string>> cases = {
      {block, "balance 1.0 shift x 20 1.01\n"},
      {block, ranks == 2 ? fmt::format("balance 1.0 x {}\n", share) : ""},
      {open_tank(3, 6).jitter(0.1), ""}};
  for (const char *words :
       {"angle wall 60", "angle left 60 angle right 120", "angle wall 60 model published"})
    for (const auto &item : cases) {
      SCOPED_TRACE(fmt::format("{} {}", words, item.second));
      const std::string script = angle_script(item.first, words).text();
      const auto all = fields(item.first, item.second + script);
      const auto one = fields(item.first, script, MPI_COMM_SELF);
      EXPECT_LE(largest(all, one), SOLVER / D);
    }
}
