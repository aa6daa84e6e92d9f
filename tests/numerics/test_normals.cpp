// SPDX-License-Identifier: GPL-2.0-only

#include "normals.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

using namespace aleisph;
using namespace aleisph_test;

// Planes, edges and corners, seen from inside and outside, as lattices: exact, and untouched by
// where the fluid particles are
TEST(Normals, BoxesAreExact)
{
  for (double jitter : {0.0, 0.1, 0.2, 0.3})
    for (unsigned seed = 1; seed <= 3; seed++)
      for (int dim : {2, 3}) {
        const std::string name = std::to_string(dim) + "d jitter " + std::to_string(jitter);
        const Scene box = closed_box(dim, 7, jitter, seed);
        const Scene obstacle = box_obstacle(dim, 5, jitter, seed);
        expect_exact(box, "box " + name);
        expect_exact(turned(box), "turned box " + name);
        expect_exact(obstacle, "obstacle " + name);
        expect_exact(turned(obstacle), "turned obstacle " + name);
      }
}

// cells that are not quite square, as when a box is no multiple of d
TEST(Normals, StretchedBoxIsExact)
{
  for (int dim : {2, 3}) {
    Scene box = closed_box(dim, 8, 0.1);
    for (Point &x : box.points) {
      x[0] *= 1.12;
      x[1] *= 0.92;
      x[2] *= 1.08;
    }
    expect_exact(box, "stretched");
  }
}

// The rim: plain face normals up to the end of a wall, and in a vertical edge the mean of two
// faces, not of three. Level 5 leaves the last layer of wall dry, with fluid diagonally below.
TEST(Normals, OpenTank)
{
  for (double jitter : {0.0, 0.2})
    for (int dim : {2, 3})
      for (int level : {6, 5}) {
        const Scene tank = open_tank(dim, 8, 6, level, jitter);
        expect_exact(tank, "tank");
        expect_exact(turned(tank), "turned tank");
      }
}

TEST(Normals, PlateWithFreeRims)
{
  for (double jitter : {0.0, 0.2})
    for (bool triangular : {false, true}) {
      Scene plate;
      plate.dim = 3;
      for (int j = 0; j < 8; j++)
        for (int i = 0; i < 8; i++) {
          const double x = triangular ? i + 0.5 * (j % 2) : i, y = triangular ? 0.866 * j : j;
          plate.add({x, y, 0.0}, WALL, {0.0, 0.0, 1.0}, 1);
          for (int k = 1; k <= 3; k++) plate.add({1.0 * i, 1.0 * j, 1.0 * k}, FLUID);
        }
      plate.jitter_fluid(jitter, 5);
      expect_exact(plate, "plate");
      expect_exact(turned(plate), "turned plate");
    }
}

// The faces of an edge count alike, whether their facets are two squares or three triangles
TEST(Normals, EdgeOfUnlikeFaces)
{
  Scene edge;
  edge.dim = 3;
  const double row = 0.5 * std::sqrt(3.0);
  for (int k = 0; k <= 8; k++) {
    edge.add({0.0, 0.0, 1.0 * k}, WALL, {1.0, 1.0, 0.0}, 2);
    for (int i = 1; i <= 5; i++) {
      edge.add({1.0 * i, 0.0, 1.0 * k}, WALL, {0.0, 1.0, 0.0}, 1);
      edge.add({0.0, row * i, k + 0.5 * (i % 2)}, WALL, {1.0, 0.0, 0.0}, 1);
      for (int j = 1; j <= 5; j++) edge.add({1.0 * i, row * j, 1.0 * k}, FLUID);
    }
  }
  edge.jitter_fluid(0.2, 2);
  const Normals found = find_normals(edge);
  for (int i : edge.rows(WALL)) {
    if (edge.points[i][2] < 0.25 || edge.points[i][2] > 7.75) continue;
    for (int a = 0; a < 3; a++) EXPECT_NEAR(found.n[3 * i + a], edge.normal[3 * i + a], ROUNDING);
  }
}

TEST(Normals, Channel2d)
{
  Scene channel;
  for (int i = 0; i <= 10; i++)
    for (int j = 0; j <= 6; j++)
      channel.add({1.0 * i, 1.0 * j, 0.0}, j % 6 == 0 ? WALL : FLUID,
                  {0.0,
                   j == 0       ? 1.0
                       : j == 6 ? -1.0
                                : 0.0,
                   0.0},
                  j % 6 == 0);
  channel.jitter_fluid(0.2, 3);
  expect_exact(channel, "channel");
}

// By symmetry the mean of equal chords, and the rim's one-sided pairs of facets, are radial
TEST(Normals, RoundWallsOfRingsAreExact)
{
  for (double jitter : {0.0, 0.2})
    for (double R : {2.2, 3.3, 5.0, 10.0, 20.0})
      for (int dim : {2, 3})
        for (bool inside : {true, false})
          expect_exact(cylinder(dim, R, 1.0, inside, jitter),
                       "R = " + std::to_string(R) + (inside ? " inside" : " outside"));
}

/* ----------------------------------------------------------------------
   A facet of a sphere has the direction of its circumcentre, so its normal
   is off by circumradius/R: for facets up to a right angle, with sides up
   to the reach of 1.75 d, at most 1.75 d/(R sqrt(2)) = 1.24 d/R. In the
   weighted sum the errors of opposite facets cancel but for the
   irregularity of the points. Measured for R/d = 3.3 to 20: largest 0.5 d/R
   to 0.42 d/R, rms 0.13 d/R to 0.04 d/R.
------------------------------------------------------------------------- */
TEST(Normals, SphereOfIrregularPoints)
{
  for (double R : {3.3, 5.0, 10.0, 20.0})
    for (bool inside : {true, false}) {
      const Normals smooth = find_normals(sphere(R, 1.0, inside));
      EXPECT_EQ(smooth.fallback + smooth.unknown, 0);
      EXPECT_LE(smooth.largest, 0.75 / R);
      EXPECT_LE(smooth.rms, 0.2 / R);
      const Normals jittered = find_normals(sphere(R, 1.0, inside, 0.2));
      for (size_t k = 0; k < smooth.n.size(); k++)
        EXPECT_NEAR(smooth.n[k], jittered.n[k], ROUNDING);
    }
}

// A wall that ends on another one which goes on behind it, where there is no fluid: only the
// faces that the fluid touches count
TEST(Normals, WallOnAWall)
{
  for (int dim : {2, 3})
    for (double jitter : {0.0, 0.2})
      for (unsigned seed = 1; seed <= 5; seed++) {
        Scene scene;
        scene.dim = dim;
        for (int j = 0; j <= (dim == 3 ? 8 : 0); j++)
          for (int i = -4; i <= 5; i++)
            for (int k = 0; k <= 5; k++) {
              Point x = {1.0 * i, 1.0 * k, 0.0}, n = {i == 0 ? 1.0 : 0.0, k == 0 ? 1.0 : 0.0, 0.0};
              x[2] = j;
              if (i > 0 && k > 0) scene.add(x, FLUID);
              if (k == 0 || i == 0) scene.add(x, WALL, n, 1);
            }
        scene.jitter_fluid(jitter, seed);
        const Normals found = find_normals(scene);
        for (int i : scene.rows(WALL)) {
          const Point &x = scene.points[i];
          if (x[0] < -0.5) {    // the hidden part
            EXPECT_EQ(found.status[i], NormalStatus::UNKNOWN);
            continue;
          }
          for (int a = 0; a < 3; a++)
            EXPECT_NEAR(found.n[3 * i + a], scene.normal[3 * i + a], ROUNDING)
                << dim << "d, jitter " << jitter << " at " << x[0] << " " << x[1] << " " << x[2];
        }
      }
}

// The foot of a column on a floor that goes on under it: three quarters of a turn of floor, one
// quarter of each face
TEST(Normals, FootOfAColumn)
{
  for (double jitter : {0.0, 0.2})
    for (unsigned seed = 1; seed <= 5; seed++) {
      Scene scene;
      scene.dim = 3;
      for (int i = -5; i <= 5; i++)
        for (int j = -5; j <= 5; j++)
          for (int k = 0; k <= 4; k++) {
            const Point x = {1.0 * i, 1.0 * j, 1.0 * k};
            const bool face = (i == 0 && j <= 0) || (j == 0 && i <= 0), in = i < 0 && j < 0;
            if (k == 0)
              scene.add(x, WALL);
            else if (face)
              scene.add(x, WALL);
            else if (!in)
              scene.add(x, FLUID);
          }
      scene.jitter_fluid(jitter, seed);
      const Normals found = find_normals(scene);
      const double length = std::sqrt(11.0);
      for (int i : scene.rows(WALL)) {
        const Point &x = scene.points[i];
        const double *n = &found.n[3 * i];
        if (x == Point{0, 0, 0}) {    // the foot itself
          EXPECT_NEAR(n[0], 1.0 / length, ROUNDING);
          EXPECT_NEAR(n[1], 1.0 / length, ROUNDING);
          EXPECT_NEAR(n[2], 3.0 / length, ROUNDING);
        }
        if (x == Point{-2, 0, 0}) {    // where a face stands on the floor
          EXPECT_NEAR(n[1], std::sqrt(0.5), ROUNDING);
          EXPECT_NEAR(n[2], std::sqrt(0.5), ROUNDING);
        }
        if (x == Point{0, 0, 2}) {    // on its convex edge
          EXPECT_NEAR(n[0], std::sqrt(0.5), ROUNDING);
          EXPECT_NEAR(n[1], std::sqrt(0.5), ROUNDING);
        }
        if (x == Point{2, 1, 0}) {    // on the free floor
          EXPECT_NEAR(n[2], 1.0, ROUNDING);
        }
      }
    }
}

// for want of wall neighbours: towards the fluid
TEST(Normals, LonelyWallParticle)
{
  for (int dim : {2, 3}) {
    Scene scene;
    scene.dim = dim;
    scene.add({0.0, 0.0, 0.0}, WALL);
    for (int j = -3; j <= 3; j++)
      for (int i = 1; i <= 3; i++)
        for (int k = dim == 3 ? -3 : 0; k <= (dim == 3 ? 3 : 0); k++)
          scene.add({1.0 * i, 1.0 * j, 1.0 * k}, FLUID);
    const Normals found = find_normals(scene);
    EXPECT_EQ(found.status[0], NormalStatus::FLUID);
    EXPECT_NEAR(found.n[0], 1.0, ROUNDING);
    EXPECT_NEAR(found.n[1], 0.0, ROUNDING);
    EXPECT_NEAR(found.n[2], 0.0, ROUNDING);
  }
}

TEST(Normals, WritesTheListedRowsOnly)
{
  const Scene box = closed_box(2, 6);
  Discretized ops(box, LaplacianLimits(), false);
  std::fill_n(ops.cloud().normal(), 3 * box.points.size(), 7.0);
  std::fill_n(ops.cloud().shape(), box.points.size(), 7.0);
  std::vector<NormalStatus> status(box.points.size(), NormalStatus::UNKNOWN);
  const int i = box.rows(WALL)[3];
  EXPECT_EQ(wall_normals(ops.s(), {i}, nullptr, ops.cloud(), status).found, 1);
  const std::vector<double> n(ops.cloud().normal(), ops.cloud().normal() + 3 * box.points.size());
  const std::vector<double> shape(ops.cloud().shape(), ops.cloud().shape() + box.points.size());
  EXPECT_EQ(status[i], NormalStatus::FAN);
  EXPECT_EQ(std::count(n.begin(), n.end(), 7.0), static_cast<long>(n.size()) - 3);
  EXPECT_EQ(std::count(shape.begin(), shape.end(), 7.0), static_cast<long>(shape.size()) - 1);
  EXPECT_EQ(std::count(status.begin(), status.end(), NormalStatus::FAN), 1);
}
