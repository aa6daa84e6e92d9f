// SPDX-License-Identifier: GPL-2.0-only
// Dry walls: one wall particle at the origin, and fluid where a test puts it.

#include "aleisph_wall_dry.h"
#include "cloud.h"

#include <gtest/gtest.h>

#include <cmath>

using namespace aleisph;
using namespace aleisph_test;

namespace {

constexpr double REACH = 1.2;    // in spacings

// Whether the wall particle with normal y (2d) or z (3d) and this shape is dry. The particles are at
// places in spacings.
bool is_dry(int dim, const Points &fluid, double shape = 1.0, Role role = FLUID)
{
  Points points = {{0.0, 0.0, 0.0}};
  for (const Point &p : fluid) points.push_back({D * p[0], D * p[1], D * p[2]});
  const Kernel kernel(KernelType::CUBIC_SPLINE, dim, H);
  static Timers timers;
  Cloud cloud(kernel, D, timers);
  const PointSet set(points, 1, 10.0 * D);
  cloud.reset(1, set.total());
  std::fill_n(cloud.role(), set.total(), role);
  cloud.role()[0] = WALL;
  cloud.normal()[dim - 1] = 1.0;
  cloud.shape()[0] = shape;
  const int count = mark_dry_walls(set.x(), set.list(), REACH, cloud);
  EXPECT_EQ(count, (cloud.role()[0] & DRY) != 0);
  return count == 1;
}

Point above(int dim, double x, double height)
{
  return dim == 2 ? Point{x, height, 0.0} : Point{x, 0.0, height};
}

}    // namespace

TEST(DryWalls, FluidWithinReachWets)
{
  for (int dim : {2, 3}) {
    EXPECT_TRUE(is_dry(dim, {}));
    EXPECT_FALSE(is_dry(dim, {above(dim, 0.0, 1.0)}));
    EXPECT_FALSE(is_dry(dim, {above(dim, 1.19, 0.0)}));    // beside it, too
    EXPECT_TRUE(is_dry(dim, {above(dim, 1.21, 0.0)}));
  }
}

// to 1.25 of the reach, within 30 degrees of the normal
TEST(DryWalls, FluidAboveWetsFromFartherAway)
{
  for (int dim : {2, 3}) {
    EXPECT_FALSE(is_dry(dim, {above(dim, 0.0, 1.49)}));
    EXPECT_TRUE(is_dry(dim, {above(dim, 0.0, 1.51)}));
    const double degree = 3.14159265358979323846 / 180.0, r = 1.4;
    EXPECT_FALSE(
        is_dry(dim, {above(dim, r * std::sin(29.0 * degree), r * std::cos(29.0 * degree))}));
    EXPECT_TRUE(
        is_dry(dim, {above(dim, r * std::sin(31.0 * degree), r * std::cos(31.0 * degree))}));
    // the mean of what the support holds counts: here it lies along the normal
    EXPECT_FALSE(is_dry(dim, {above(dim, 1.0, 1.0), above(dim, -1.0, 1.0)}));
  }
}

// In a concave edge the fluid is a diagonal away from both walls; on a convex one it is as near
// as on a plane.
TEST(DryWalls, ReachGrowsWithConcaveShapes)
{
  const double diagonal = std::sqrt(2.0);
  for (int dim : {2, 3}) {
    EXPECT_TRUE(is_dry(dim, {above(dim, diagonal, 0.0)}, 1.0));
    EXPECT_FALSE(is_dry(dim, {above(dim, diagonal, 0.0)}, diagonal));
    EXPECT_FALSE(is_dry(dim, {above(dim, 1.19, 0.0)}, 1.0 / diagonal));
  }
}

TEST(DryWalls, OnlyFluidWets)
{
  EXPECT_TRUE(is_dry(2, {{0.0, 1.0, 0.0}}, 1.0, WALL));
  EXPECT_FALSE(is_dry(2, {{0.0, 1.0, 0.0}}, 1.0, FLUID | BUFFER));
}
