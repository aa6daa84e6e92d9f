// SPDX-License-Identifier: GPL-2.0-only
/* ----------------------------------------------------------------------
   Surface particles next to walls are not pushed into them.
------------------------------------------------------------------------- */

#include "aleisph_surface_hold.h"

#include "cloud.h"

#include <gtest/gtest.h>

#include <cmath>

using namespace aleisph;
using namespace aleisph_test;

namespace {

constexpr double ROUNDING = 1.0e-14;    // a few operations on numbers of size 1

// A particle on the surface, the first one, at `height` [D] above a wall y = 0, `aside` [D] off the
// normals of its particles; the wall moves at (0.5, 0.25)
struct OnWall {
  OnWall(double height, double aside = 0.0) :
      points(positions(height, aside), 4, 2.4 * D),
      cloud(make_cloud(Kernel(KernelType::CUBIC_SPLINE, 2, H), D, points,
                       {{FLUID | SURFACE, WALL, WALL, WALL}, {0, 0, 0, 0, 1, 0, 0, 1, 0, 0, 1, 0}}))
  {
  }

  static Points positions(double height, double aside)
  {
    return {{aside * D, height * D, 0.0}, {0.0, 0.0, 0.0}, {-D, 0.0, 0.0}, {-2.0 * D, 0.0, 0.0}};
  }

  // velocity of the particle afterwards; reach: one spacing
  Point hold(double vx, double vy, int changed) const
  {
    std::vector<double> v = {vx, vy, 0.0, 0.5, 0.25, 0.0, 0.5, 0.25, 0.0, 0.5, 0.25, 0.0};
    const std::vector<double> before = v;
    EXPECT_EQ(hold_surface(cloud, {0}, D, v.data()), changed);
    for (int k = 3; k < 12; k++) EXPECT_EQ(v[k], before[k]) << "a wall";
    return {v[0], v[1], v[2]};
  }

  PointSet points;
  Cloud cloud;
};

}    // namespace

// Relative to the wall, what points into it is taken away, and nothing else
TEST(SurfaceHold, NothingPassesTheWall)
{
  const OnWall low(0.9);
  const Point held = low.hold(2.0, -1.0, 1);
  EXPECT_NEAR(held[0], 2.0, ROUNDING);
  EXPECT_NEAR(held[1], 0.25, ROUNDING);
  EXPECT_EQ(low.hold(2.0, 0.3, 0), (Point{2.0, 0.3, 0.0}));
  // as fast as the wall away from rest, slower than the wall
  EXPECT_NEAR(low.hold(0.5, 0.1, 1)[1], 0.25, ROUNDING);
}

// beyond reach, half a spacing below the wall, beside its particles
TEST(SurfaceHold, OthersAreFree)
{
  for (const OnWall &one : {OnWall(1.1), OnWall(-0.6), OnWall(0.9, 0.9)})
    EXPECT_EQ(one.hold(0.0, -1.0, 0), (Point{0.0, -1.0, 0.0}));
  OnWall(0.9, 0.7).hold(0.0, -1.0, 1);
}

// Two walls at right angles: no part into either
TEST(SurfaceHold, CornersHoldBothWays)
{
  const PointSet points({{0.9 * D, 0.9 * D, 0.0}, {0.9 * D, 0.0, 0.0}, {0.0, 0.9 * D, 0.0}}, 3,
                        2.4 * D);
  const Cloud cloud = make_cloud(Kernel(KernelType::CUBIC_SPLINE, 2, H), D, points,
                                 {{FLUID | SURFACE, WALL, WALL}, {0, 0, 0, 0, 1, 0, 1, 0, 0}});
  std::vector<double> v = {-1.0, -2.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0};
  EXPECT_EQ(hold_surface(cloud, {0}, D, v.data()), 1);
  EXPECT_NEAR(v[0], 0.0, ROUNDING);
  EXPECT_NEAR(v[1], 0.0, ROUNDING);
}
