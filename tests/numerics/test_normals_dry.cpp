// SPDX-License-Identifier: GPL-2.0-only
// Normals and shapes of walls that no fluid is near: from the walls next to them, or from before

#include "blocks.h"
#include "normals.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numeric>
#include <random>

using namespace aleisph;
using namespace aleisph_test;

namespace {

// all fluid, and fluid in the first corner of the tank only
constexpr int WET[] = {100, 3};

Predicate wet_to(int n)
{
  return [n](const Index &at) { return at[0] <= n && at[1] <= n && at[2] <= n; };
}

std::string name_of(const Blocks &blocks, int wet)
{
  return blocks.name + ", wet to " + std::to_string(wet);
}

void expect_normals_and_shapes(const BlockScene &scene, const std::string &name)
{
  const Normals found = find_normals(scene);
  EXPECT_EQ(found.contradictory, 0) << name;
  for (int i : scene.rows(WALL)) {
    const Point &x = scene.points[i];
    EXPECT_NEAR(found.shape[i], scene.shape[i], ROUNDING)
        << name << " at " << x[0] << " " << x[1] << " " << x[2];
    for (int a = 0; a < 3; a++)
      EXPECT_NEAR(found.n[3 * i + a], scene.normal[3 * i + a], ROUNDING)
          << name << " at " << x[0] << " " << x[1] << " " << x[2];
  }
}

// the particles for which the predicate holds
Scene keep(const Scene &scene, const std::function<bool(int)> &predicate)
{
  Scene kept;
  kept.dim = scene.dim;
  kept.d = scene.d;
  for (int i = 0; i < static_cast<int>(scene.points.size()); i++)
    if (predicate(i))
      kept.add(scene.points[i], scene.role[i],
               {scene.normal[3 * i], scene.normal[3 * i + 1], scene.normal[3 * i + 2]},
               scene.faces[i]);
  return kept;
}

Scene dry(const Scene &scene)
{
  return keep(scene, [&scene](int i) { return scene.role[i] & WALL; });
}

// the fluid with x > level taken away
Scene drained(const Scene &scene, double level)
{
  return keep(scene, [&](int i) { return (scene.role[i] & WALL) || scene.points[i][0] > level; });
}

}    // namespace

TEST(DryNormals, ObstaclesAreExact)
{
  for (const Blocks &blocks : obstacles())
    for (const int wet : WET) {
      BlockScene scene = fill(blocks, wet_to(wet));
      scene.jitter_fluid(0.2, 3);
      expect_normals_and_shapes(scene, name_of(blocks, wet));
    }
}

// The floor goes on under the obstacle: it takes no part, stays unknown, and does not lead to the
// far side.
TEST(DryNormals, FloorUnderObstacles)
{
  for (const Blocks &blocks : obstacles())
    for (const int wet : WET) {
      const int up = blocks.dim - 1;
      BlockScene scene = fill(blocks, wet_to(wet), [up](const Index &at) { return at[up] == 0; });
      scene.jitter_fluid(0.2, 3);
      expect_normals_and_shapes(scene, name_of(blocks, wet));
    }
}

/* ----------------------------------------------------------------------
   A closed curve of n chords: c is the cosine of half the angle between
   two of them. Concave inside: 1/c, convex outside: c.
------------------------------------------------------------------------- */
TEST(DryNormals, RoundWalls)
{
  for (const double R : {2.2, 5.0, 20.0})
    for (const int dim : {2, 3})
      for (const bool inside : {true, false}) {
        const Scene scene = drained(cylinder(dim, R, 1.0, inside, 0.2), R - 1.5);
        const std::string name = "R = " + std::to_string(R) + (inside ? " inside" : " outside");
        expect_exact(scene, name);
        const Normals found = find_normals(scene);
        EXPECT_GT(found.sweeps, 2) << name;
        const double c = std::cos(M_PI / std::lround(2.0 * M_PI * R));
        for (int i : scene.rows(WALL)) {
          if (dim == 3 && (scene.points[i][2] < 0.5 || scene.points[i][2] > 5.5)) continue;
          // 1 - c is what remains of numbers of order 1
          EXPECT_NEAR(found.shape[i], inside ? 1.0 / c : c, ROUNDING) << name;
        }
      }
}

// The fluid chooses the side, and nothing else: the same bits however much there is of it
TEST(DryNormals, SpheresToTheBit)
{
  for (const double R : {3.3, 10.0})
    for (const bool inside : {true, false}) {
      const Scene full = sphere(R, 1.0, inside), few = drained(full, R - 1.5);
      const Normals all = find_normals(full), some = find_normals(few);
      EXPECT_EQ(some.unknown, 0);
      EXPECT_EQ(some.contradictory, 0);
      EXPECT_GT(some.sweeps, 2);
      const Rows from = full.rows(WALL), to = few.rows(WALL);
      for (size_t m = 0; m < from.size(); m++) {
        for (int a = 0; a < 3; a++) EXPECT_EQ(some.n[3 * to[m] + a], all.n[3 * from[m] + a]);
        EXPECT_EQ(some.shape[to[m]], all.shape[from[m]]);
      }
    }
}

/* ----------------------------------------------------------------------
   Two plates that meet at an angle alpha, with fluid between them. On the
   edge n halves the angle, and c is the sine of alpha/2. Below 72 degrees
   the edge is no detour any more from the first particle of one plate to
   that of the other: 1 > 0.85 * 2 sin(alpha/2); the facet between them needs
   no witness below 75 degrees.
------------------------------------------------------------------------- */
TEST(DryNormals, EdgesOfAllAngles)
{
  constexpr int LENGTH = 6;
  for (int dim : {2, 3})
    for (double degrees = 76.0; degrees <= 284.0; degrees += 8.0) {
      const double alpha = degrees * M_PI / 180.0;
      BlockScene edge;
      edge.dim = dim;
      const auto add = [&](double r, double phi, int k, Role role, double normal, double shape) {
        edge.add({r * std::cos(phi), r * std::sin(phi), 1.0 * k}, role,
                 {std::cos(normal), std::sin(normal), 0.0}, 1);
        edge.shape.push_back(shape);
      };
      const double c = std::sin(0.5 * alpha);
      for (int k = 0; k <= (dim == 3 ? LENGTH : 0); k++) {
        add(0.0, 0.0, k, WALL, 0.5 * alpha, degrees < 180.0 ? 1.0 / c : c);
        for (int i = 1; i <= LENGTH; i++) {
          add(i, 0.0, k, WALL, 0.5 * M_PI, 1.0);
          add(i, alpha, k, WALL, alpha - 0.5 * M_PI, 1.0);
        }
      }
      for (int i = 1; i <= LENGTH; i++)    // above one end of the first plate
        edge.add({1.0 * i, 1.0, 0.0}, FLUID);
      edge.shape.resize(edge.points.size(), 0.0);
      expect_normals_and_shapes(edge, std::to_string(degrees) + " degrees");
    }
}

/* ----------------------------------------------------------------------
   A round pillar on a square floor. The second ring is no neighbour of the
   floor, nor the floor of it, if the way past the first ring is short: at
   the distance g from the pillar, d < 0.85 sqrt(g^2 + d^2), or g > 0.62 d.
   In the ring where they meet, a floor particle can be missing for the same
   reason, as its way past the next one of the ring is short; the normal is
   then that of the pillar, at 45 degrees from the mean.
------------------------------------------------------------------------- */
TEST(DryNormals, RoundPillarOnAFloor)
{
  constexpr int HALF = 8, HEIGHT = 4;
  for (const int wet : {100, -4})
    for (const double R : {2.4, 2.9, 3.3, 4.1, 5.0})
      for (const double gap : {0.63, 0.7, 0.8}) {
        Scene scene;
        scene.dim = 3;
        const int n = static_cast<int>(std::lround(2.0 * M_PI * R));
        for (int k = 0; k <= HEIGHT; k++)
          for (int m = 0; m < n; m++) {
            const double c = std::cos(2.0 * M_PI * m / n), s = std::sin(2.0 * M_PI * m / n);
            scene.add({R * c, R * s, 1.0 * k}, WALL, {c, s, k == 0 ? 1.0 : 0.0}, k == 0 ? 2 : 1);
          }
        for (int k = 0; k <= HEIGHT; k++)
          for (int j = -HALF; j <= HALF; j++)
            for (int i = -HALF; i <= HALF; i++) {
              const Point x = {1.0 * i, 1.0 * j, 1.0 * k};
              if (std::hypot(x[0], x[1]) < R + gap) continue;
              if (k == 0)
                scene.add(x, WALL, {0.0, 0.0, 1.0}, 1);
              else if (i <= wet)
                scene.add(x, FLUID);
            }
        const Normals found = find_normals(scene);
        EXPECT_EQ(found.unknown, 0);
        EXPECT_EQ(found.contradictory, 0);
        for (int i : scene.rows(WALL)) {
          double error = 0.0;
          for (int a = 0; a < 3; a++)
            error = std::hypot(error, found.n[3 * i + a] - scene.normal[3 * i + a]);
          EXPECT_LE(error, scene.faces[i] == 2 ? 2.0 * std::sin(M_PI / 8.0) + 0.01 : ROUNDING)
              << "R " << R << " gap " << gap << " at " << scene.points[i][0] << " "
              << scene.points[i][1] << " " << scene.points[i][2];
        }
      }
}

// ---------------------------------------------------------------------------------------------

TEST(DryNormals, NothingIsKnown)
{
  for (int dim : {2, 3}) {
    const Scene walls = dry(closed_box(dim, 6));
    const Normals found = find_normals(walls);
    EXPECT_EQ(found.sweeps, 0);
    EXPECT_EQ(found.unknown, static_cast<int>(walls.points.size()));
    EXPECT_EQ(std::count(found.n.begin(), found.n.end(), 0.0), 3 * found.unknown);
    EXPECT_EQ(std::count(found.shape.begin(), found.shape.end(), 0.0), found.unknown);
  }
}

// Walls that move by up to 20 degrees: the normal of before tells the side, the facets the rest
TEST(DryNormals, FromTheNormalBefore)
{
  for (int dim : {2, 3})
    for (double angle : {-0.35, 0.01, 0.35})
      for (const Scene &scene : {closed_box(dim, 6), box_obstacle(dim, 4),
                                 cylinder(dim, 3.3, 1.0, true), cylinder(dim, 3.3, 1.0, false)}) {
        const Scene before = dry(scene), after = turned(before, angle);
        const Normals found = find_normals(after, before.normal);
        EXPECT_EQ(found.sweeps, 1);
        EXPECT_EQ(found.from_fan, static_cast<int>(after.points.size()));
        EXPECT_LE(found.largest, ROUNDING);
      }
}

// a turn in small steps, and back to where it began
TEST(DryNormals, AWholeTurn)
{
  const Blocks box = obstacles()[4];
  const Scene start = dry(fill(box, wet_to(0)));
  std::vector<double> n = start.normal;
  const int steps = 60;
  for (int k = 1; k <= steps; k++) {
    const Scene now = turned(start, 2.0 * M_PI * k / steps);
    const Normals found = find_normals(now, n);
    ASSERT_EQ(found.from_fan, static_cast<int>(start.points.size()));
    EXPECT_LE(found.largest, ROUNDING);
    n = found.n;
  }
}

// Rounding must not change a restarted run; a rotation of 1e-8 is none.
TEST(DryNormals, TheNormalBeforeIsKeptToTheBit)
{
  const Scene box = closed_box(3, 6);
  for (double change : {1.0e-10, 1.0e-8}) {
    std::vector<double> before = box.normal;
    for (int i : box.rows(WALL)) before[3 * i] += change;
    const Normals found = find_normals(box, before);
    for (int i : box.rows(WALL)) EXPECT_EQ(found.n[3 * i] == before[3 * i], change < 1.0e-9);
    EXPECT_LE(found.largest, 1.01e-10);
  }
}

// Too few neighbours for a facet: the direction to the fluid when first found, then as it was
TEST(DryNormals, LonelyParticleKeepsItsNormal)
{
  Scene scene;
  scene.dim = 3;
  scene.add({0.0, 0.0, 0.0}, WALL, {0.0, 0.6, 0.8});
  scene.add({1.0, 0.0, 0.0}, FLUID);
  EXPECT_NEAR(find_normals(scene).n[0], 1.0, ROUNDING);
  const Normals found = find_normals(scene, scene.normal);
  EXPECT_EQ(found.n, scene.normal);
  EXPECT_EQ(found.fallback, 1);
  EXPECT_EQ(found.shape[0], 1.0);
}

// Ranks and restarts change the order of particles and of neighbours.
TEST(DryNormals, OrderOfParticlesHasNoInfluence)
{
  std::vector<Scene> scenes = {closed_box(3, 6, 0.2), sphere(5.0, 1.0, false, 0.2),
                               drained(cylinder(3, 4.0, 1.0, true, 0.2), 2.0)};
  for (const Blocks &blocks : obstacles()) scenes.push_back(fill(blocks, wet_to(3)));
  for (const Scene &scene : scenes) {
    std::vector<int> order(scene.points.size());
    std::iota(order.begin(), order.end(), 0);
    std::shuffle(order.begin(), order.end(), std::mt19937(5));
    Scene mixed;
    mixed.dim = scene.dim;
    mixed.d = scene.d;
    for (int i : order) mixed.add(scene.points[i], scene.role[i]);
    const Normals sorted = find_normals(scene), found = find_normals(mixed);
    EXPECT_EQ(found.sweeps, sorted.sweeps);
    for (size_t m = 0; m < order.size(); m++)
      for (int a = 0; a < 3; a++)
        EXPECT_NEAR(found.n[3 * m + a], sorted.n[3 * order[m] + a], ROUNDING);
  }
}

TEST(DryNormals, ShapesOfGivenNormals)
{
  for (const Blocks &blocks : obstacles()) {
    const BlockScene scene = fill(blocks, wet_to(0));
    Discretized ops(scene, LaplacianLimits(), false);
    wall_shapes(ops.s(), scene.rows(WALL), ops.cloud());
    const double *shape = ops.cloud().shape();
    for (int i : scene.rows(WALL)) EXPECT_NEAR(shape[i], scene.shape[i], ROUNDING) << blocks.name;
  }
}

// in the middle of a plane, where edges and corners of boxes have 45 or 55 degrees
TEST(DryNormals, ShapesOfPlanesEdgesAndCorners)
{
  for (int dim : {2, 3}) {
    const Scene box = closed_box(dim, 6), obstacle = box_obstacle(dim, 4);
    const Normals in = find_normals(box), out = find_normals(obstacle);
    for (int i : box.rows(WALL)) EXPECT_NEAR(in.shape[i], std::sqrt(box.faces[i]), ROUNDING);
    for (int i : obstacle.rows(WALL))
      EXPECT_NEAR(out.shape[i], 1.0 / std::sqrt(obstacle.faces[i]), ROUNDING);
  }
}

// Two ends of a strip that are known the wrong way round: somewhere they meet
TEST(DryNormals, ContradictionsAreCounted)
{
  for (int length : {7, 8})
    for (double other : {1.0, -1.0}) {
      Scene strip;
      strip.dim = 3;
      for (int j = 0; j < 5; j++)
        for (int i = 0; i < length; i++) strip.add({1.0 * i, 1.0 * j, 0.0}, WALL);
      std::vector<double> known(3 * strip.points.size(), 0.0);
      for (size_t i = 0; i < strip.points.size(); i++) {
        if (strip.points[i][0] == 0.0) known[3 * i + 2] = 1.0;
        if (strip.points[i][0] == length - 1.0) known[3 * i + 2] = other;
      }
      const Normals found = find_normals(strip, {}, known);
      EXPECT_EQ(found.contradictory > 0, other < 0.0);
    }
}
