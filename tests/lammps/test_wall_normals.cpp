// SPDX-License-Identifier: GPL-2.0-only
/* ----------------------------------------------------------------------
   Normals of walls that are dry, that move, and after a restart. That the
   normals themselves are right is tested without LAMMPS; here, that they
   spread over ranks and fixes, and stay with the particles.
------------------------------------------------------------------------- */

#include "aleisph_halo_owner.h"
#include "errors.h"
#include "script.h"
#include "simulation.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

namespace {

// directions of unit length that are known to eps
constexpr double ROUNDING = 1e-14;

// An open tank with a box on its floor, fluid in all of it up to the rim or in the first corner
// only; the last axis is up. With `floor` the floor goes on under the box.
Scene tank_with_box(int dimension, bool full, bool floor = false)
{
  const int up = dimension - 1;
  const std::array<int, 3> size = {12, dimension == 3 ? 8 : 6, dimension == 3 ? 5 : 0};
  const std::array<int, 3> low = {6, dimension == 3 ? 3 : 0, 0};
  const std::array<int, 3> high = {9, dimension == 3 ? 5 : 3, 3};
  Scene scene;
  scene.dimension = dimension;
  scene.d = 1.0 / 8.0;
  scene.boundary = dimension == 3 ? "f f f" : "f f p";
  for (int a = 0; a < 3; a++) {
    scene.low[a] = -0.5 * scene.d;
    scene.high[a] = (size[a] + 0.5) * scene.d;
  }
  scene.high[up] += 4.0 * scene.d;
  for (int k = 0; k <= size[2]; k++)
    for (int j = 0; j <= size[1]; j++)
      for (int i = 0; i <= size[0]; i++) {
        const int at[3] = {i, j, k};
        bool wall = false, in_box = true, on_box = false, wet = true;
        for (int a = 0; a < dimension; a++) {
          wall |= at[a] == 0 || (a != up && at[a] == size[a]);
          in_box &= at[a] >= low[a] && at[a] <= high[a];
          on_box |= at[a] == high[a] || (a != up && at[a] == low[a]);
          wet &= full || at[a] <= 3;
        }
        if (in_box && !on_box && !(floor && at[up] == 0)) continue;
        if (wall || in_box)
          scene.add(Scene::WALL, i * scene.d, j * scene.d, k * scene.d);
        else if (wet)
          scene.add(Scene::FLUID, i * scene.d, j * scene.d, k * scene.d);
      }
  return scene;
}

Script surface_script(const Scene &scene)
{
  Script script = script_of(scene);
  script.body = "fix surface fluid aleisph/surface\n" +
      fmt::format("fix g all gravity 1.0 vector 0 {} {}", scene.dimension == 2 ? -1 : 0,
                  scene.dimension == 3 ? -1 : 0);
  script.timestep = "timestep 0.005\ncompute q all aleisph/atom nx ny nz";
  return script;
}

// nx ny nz of the wall particles, by their positions in the scene
std::vector<double> wall_normals(const Simulation &sim)
{
  const auto type = sim.type();
  std::vector<double> all;
  for (int a = 1; a <= 3; a++) {
    const auto n = sim.compute("q", a);
    for (std::size_t i = 0; i < n.size(); i++)
      if (type[i] == Scene::WALL) all.push_back(n[i]);
  }
  return all;
}

double unknown(const Simulation &sim, const std::string &wall = "wall")
{
  return sim.fix(wall, 2);
}

}    // namespace

// The same normals as when all walls are wet, whoever owns the walls in between
TEST(WallNormals, SpreadAlongDryWalls)
{
  for (const int dimension : {2, 3}) {
    SCOPED_TRACE(fmt::format("{}d", dimension));
    const Scene full = tank_with_box(dimension, true), corner = tank_with_box(dimension, false);
    Simulation wet(full), dry(corner), parts(corner);
    wet.run(surface_script(full).text() + "run 0");
    EXPECT_EQ(unknown(wet), 0.0);

    Script script = surface_script(corner);
    dry.run(script.text() + "run 0");
    EXPECT_EQ(unknown(dry), 0.0);
    EXPECT_EQ(dry.fix("wall", 1), 0.0);
    EXPECT_LE(largest(wall_normals(dry), wall_normals(wet)), ROUNDING);

    script.wall = "region near block INF 0.45 INF INF INF INF\ngroup near region near\n"
                  "group wnear intersect wall near\ngroup wfar subtract wall wnear\n"
                  "fix wfar wfar aleisph/wall\nfix wnear wnear aleisph/wall";
    parts.run(script.text() + "run 0");
    EXPECT_EQ(unknown(parts, "wnear") + unknown(parts, "wfar"), 0.0);
    EXPECT_LE(largest(wall_normals(parts), wall_normals(wet)), ROUNDING);
  }
}

// Under the box no side is that of the fluid. These particles take part in nothing.
TEST(WallNormals, HiddenFloorStaysUnknown)
{
  for (const int dimension : {2, 3}) {
    const Scene with = tank_with_box(dimension, true, true);
    const Scene without = tank_with_box(dimension, true, false);
    Simulation a(with), b(without);
    a.run(surface_script(with).text() + "run 5");
    b.run(surface_script(without).text() + "run 5");
    EXPECT_EQ(unknown(a), static_cast<double>(with.x.size() - without.x.size()));
    // searched for once, not in every step
    EXPECT_EQ(LAMMPS_NS::FixAleisph::find(&a.lammps(), "test")->tally().wall_passes, 1);
    const auto pa = a.pressure(), pb = b.pressure();
    EXPECT_NEAR(*std::max_element(pa.begin(), pa.end()), *std::max_element(pb.begin(), pb.end()),
                1e-9);
  }
}

// They are kept while the fluid moves, and found again to the bit when a run or a restart begins.
TEST(WallNormals, StayWithTheParticles)
{
  const Scene scene = tank_with_box(2, false).jitter(0.1);
  const Script script = surface_script(scene);
  Simulation one(scene), two(scene), restarted;
  one.run(script.text() + "run 0");
  const auto start = wall_normals(one);
  one.run("run 10");
  EXPECT_EQ(wall_normals(one), start);

  const std::string file = scratch_file("wall_normals.restart");
  two.run(script.text() + "run 6\nwrite_restart " + file + "\nrun 4");
  restarted.run("read_restart " + file + "\nneighbor 0.0375 bin\n" +
                "neigh_modify every 1 delay 0 check yes\n" + script.text() + "run 4");
  EXPECT_EQ(wall_normals(two), start);
  EXPECT_EQ(wall_normals(restarted), start);
  // both begin their second run with the same numbers; ranks may share them out differently
  if (one.ranks() == 1) {
    EXPECT_EQ(restarted.pressure(), two.pressure());
  }
  EXPECT_LE(largest(restarted.pressure(), two.pressure()), 1e-9);
}

// ---------------------------------------------------------------------------------------------

// A closed tank of fluid that moves as a whole, from the first step on: v* is uniform up to
// rounding, so that nothing happens in it, and no normal changes.
TEST(WallNormals, TankInUniformMotion)
{
  for (const int dimension : {2, 3}) {
    SCOPED_TRACE(fmt::format("{}d", dimension));
    Scene scene = tank(dimension, 7).jitter(0.2);
    scene.high[0] = 2.0;
    scene.low[1] -= 0.5;
    Simulation sim(scene);
    Script script = script_of(scene);
    script.wall = "fix m wall move linear 1.0 -0.5 NULL\nfix wall wall aleisph/wall";
    script.timestep = "timestep 0.01\ncompute q all aleisph/atom nx ny nz\n"
                      "velocity all set 1.0 -0.5 0.0";
    sim.run(script.text() + "run 0");
    const auto start = wall_normals(sim);
    sim.run("run 20");
    EXPECT_EQ(wall_normals(sim), start);
    const double expected[] = {1.0, -0.5, 0.0};
    for (int a = 0; a < 3; a++) {
      auto v = sim.v(a);
      for (double &value : v) value -= expected[a];
      EXPECT_LE(largest(v), 1e-11);
    }
  }
}

/* ----------------------------------------------------------------------
   A quarter of a turn about the middle of the tank: the normals turn with
   it. The positions, of order 1, are known to eps, the directions between
   neighbours therefore to eps/d. The fluid turns as a solid does, to first
   order: a step along the tangent leads off the circle by w^2 dt^2 r/2, and
   the walls push it back by as much, each time in a step of dt.
------------------------------------------------------------------------- */
TEST(WallNormals, TankThatTurns)
{
  for (const int dimension : {2, 3}) {
    SCOPED_TRACE(fmt::format("{}d", dimension));
    constexpr int STEPS = 50;
    constexpr double OMEGA = 0.5 * M_PI;
    const Scene inside = tank(dimension, 7).jitter(0.1);
    Scene scene = inside;
    for (int a = 0; a < 2; a++) {
      scene.low[a] = -0.5;
      scene.high[a] = 1.5;
    }
    Simulation sim(scene);
    Script script = script_of(scene);
    script.wall = "fix m wall move rotate 0.5 0.5 0.5 0 0 1 4.0\nfix wall wall aleisph/wall";
    script.timestep = fmt::format(
        "timestep {}\ncompute q all aleisph/atom nx ny nz\n"
        "variable u atom -0.5*PI*(y-0.5)\nvariable w atom 0.5*PI*(x-0.5)\n"
        "velocity all set v_u v_w 0\n",
        1.0 / STEPS);
    sim.run(script.text() + "run 0");
    const auto start = wall_normals(sim);
    sim.run(fmt::format("run {}", STEPS));
    const auto end = wall_normals(sim);
    const std::size_t n = start.size() / 3;
    for (std::size_t i = 0; i < n; i++) {
      EXPECT_NEAR(end[i], -start[n + i], 1e-13);
      EXPECT_NEAR(end[n + i], start[i], 1e-13);
      EXPECT_NEAR(end[2 * n + i], start[2 * n + i], 1e-13);
    }
    EXPECT_EQ(sim.fix("wall", 3), 0.0);

    const auto u = sim.at_particles([](double, double y, double) { return -OMEGA * (y - 0.5); });
    const auto w = sim.at_particles([](double x, double, double) { return OMEGA * (x - 0.5); });
    EXPECT_LE(largest(sim.v(0), u), OMEGA * OMEGA * std::sqrt(0.5) / STEPS);
    EXPECT_LE(largest(sim.v(1), w), OMEGA * OMEGA * std::sqrt(0.5) / STEPS);
  }
}

// The same for a tank that is nearly empty: 1/40 of a turn, from dry walls alone
TEST(WallNormals, DryTankThatTurns)
{
  Scene scene = tank_with_box(2, false);
  for (int a = 0; a < 2; a++) {
    scene.low[a] -= 1.0;
    scene.high[a] += 1.0;
  }
  Simulation sim(scene);
  Script script = surface_script(scene);
  script.wall = "fix m wall move rotate 0 0 0 0 0 1 2.0\nfix wall wall aleisph/wall";
  sim.run(script.text() + "run 0");
  const auto start = wall_normals(sim);
  sim.run("run 10");
  const auto end = wall_normals(sim);
  const double turn = 2.0 * M_PI * 10.0 * 0.005 / 2.0, c = std::cos(turn), s = std::sin(turn);
  const std::size_t n = start.size() / 3;
  for (std::size_t i = 0; i < n; i++) {
    EXPECT_NEAR(end[i], c * start[i] - s * start[n + i], 1e-13);
    EXPECT_NEAR(end[n + i], s * start[i] + c * start[n + i], 1e-13);
  }
  EXPECT_EQ(unknown(sim), 0.0);
}

// ---------------------------------------------------------------------------------------------

// With fluid on both sides of a wall, neighbours can see it on different ones.
TEST(WallNormals, FluidOnBothSides)
{
  Scene scene = tank(2, 8).jitter(0.2);
  for (std::size_t i = 0; i < scene.x.size(); i++)
    if (scene.x[i][1] > 0.5 - 0.5 * scene.d && scene.x[i][1] < 0.5 + 0.5 * scene.d) {
      scene.type[i] = Scene::WALL;
      scene.x[i][0] = scene.d * std::round(scene.x[i][0] / scene.d);
      scene.x[i][1] = 0.5;
    }
  Simulation sim(scene);
  Script script = script_of(scene);
  script.timestep = "timestep 0.01";
  sim.run(script.text() + "run 1");
  EXPECT_GE(sim.fix("wall", 3), 1.0);
  const std::string log = sim.log();
  EXPECT_NE(log.find("Fix aleisph/wall: "), std::string::npos);
  EXPECT_NE(log.find("more than 120 degrees"), std::string::npos);
}

// A second layer behind the first one sees no fluid.
TEST(WallNormals, SecondLayer)
{
  Scene scene = small_channel();
  scene.low[1] -= scene.d;
  for (int i = 0; i < 10; i++) scene.add(Scene::WALL, (i + 0.5) * scene.d, -1.0 - scene.d);
  Simulation sim(scene);
  expect_words(sim.error_of(script_of(scene).text() + "run 0"),
               {"ix aleisph/wall", "hide the fluid from atom", "normals given"});
}
