// SPDX-License-Identifier: GPL-2.0-only
/* ----------------------------------------------------------------------
   Asymmetry of the neighbourhood: on parts of a lattice, between them, and
   under what must not change it.
------------------------------------------------------------------------- */

#include "aleisph_shift.h"
#include "aleisph_surface_shape.h"
#include "cloud.h"

#include <gtest/gtest.h>

#include <cmath>

using namespace aleisph;
using namespace aleisph_test;

namespace {

// the origin alone is a row
Stencil stencil_of(const Points &points, const Kernel &kernel)
{
  const PointSet cloud(points, 1, kernel.support());
  Stencil s;
  s.build(kernel, 1, cloud.x(), cloud.list());
  return s;
}

Points part(int dim, int planes)
{
  return cut(lattice(dim, 4, D), planes, 0.0);
}

void scale(Points &points, double factor)
{
  for (Point &p : points)
    for (double &x : p) x *= factor;
}

}    // namespace

class SurfaceShapeTest : public testing::TestWithParam<int> {
 protected:
  int dim_ = GetParam();
  Kernel kernel_{KernelType::CUBIC_SPLINE, dim_, H};
  SurfaceShape shape_{kernel_, D};

  double asymmetry(const Points &points) const
  {
    return shape_.asymmetry(stencil_of(points, kernel_), 0);
  }
};

// Sums of at most 113 terms: equal to rounding. The density is that of the same part, summed here.
TEST_P(SurfaceShapeTest, PartsOfALatticeHaveTheirOwnDensity)
{
  double full = 0.0;
  for (int planes = 0; planes <= dim_; planes++) {
    double sum = 0.0;
    for (const Point &p : part(dim_, planes)) sum += kernel_.w(std::hypot(p[0], p[1], p[2]));
    if (planes == 0) full = sum;
    EXPECT_NEAR(shape_.density(asymmetry(part(dim_, planes))), sum / full, 1e-13) << planes;
  }
}

TEST_P(SurfaceShapeTest, FlatSurfaceAgreesWithTheDensityScale)
{
  const double flat = density_scale(kernel_, D, kernel_.support()).flat;
  EXPECT_NEAR(shape_.density(asymmetry(part(dim_, 1))), flat, 1e-13);
}

// All directions in a half space weighted alike give |mean e| = 2/pi (2d), 1/2 (3d). The lattice
// row through the particle itself, which has no normal direction, makes it smaller.
TEST_P(SurfaceShapeTest, FlatSurfaceIsBelowTheContinuum)
{
  const double a = asymmetry(part(dim_, 1)), continuum = dim_ == 2 ? 2.0 / M_PI : 0.5;
  EXPECT_LT(a, continuum);
  EXPECT_GT(a, 0.5 * continuum);
}

TEST_P(SurfaceShapeTest, CornerIsZeroOnAPlaneAndOneOnARightAngle)
{
  EXPECT_EQ(shape_.corner(asymmetry(part(dim_, 0))), 0.0);
  EXPECT_NEAR(shape_.corner(asymmetry(part(dim_, 1))), 0.0, 1e-13);
  EXPECT_NEAR(shape_.corner(asymmetry(part(dim_, 2))), 1.0, 1e-13);
  EXPECT_EQ(shape_.corner(1.0), 1.0);
}

TEST_P(SurfaceShapeTest, DensityFallsAsTheSurfaceSharpens)
{
  for (double a = 0.0; a < 0.99; a += 0.01)
    EXPECT_LT(shape_.density(a + 0.01), shape_.density(a)) << a;
}

// One neighbour, and none
TEST_P(SurfaceShapeTest, LonelyParticlesAreAllCorner)
{
  EXPECT_NEAR(asymmetry({{0.0, 0.0, 0.0}, {D, 0.0, 0.0}}), 1.0, 1e-13);
  EXPECT_EQ(asymmetry({{0.0, 0.0, 0.0}}), 1.0);
}

// What the particles do to the density must not be taken for the shape of the surface: where they
// are five per cent closer, what is expected moves by less than a tenth of what the density does.
TEST_P(SurfaceShapeTest, CompressionIsNotShape)
{
  const auto density = [this](const Points &points) {
    double sum = 0.0;
    for (const Point &p : points) sum += kernel_.w(std::hypot(p[0], p[1], p[2]));
    return density_scale(kernel_, D, kernel_.support()).beta * std::pow(D, dim_) * sum;
  };
  const Points plane = part(dim_, 1);
  Points close = plane;
  scale(close, 0.95);
  const double expected = shape_.density(asymmetry(close)) - shape_.density(asymmetry(plane));
  const double rise = density(close) - density(plane);
  EXPECT_GT(rise, 0.05);
  EXPECT_LT(std::abs(expected), 0.1 * rise);
}

INSTANTIATE_TEST_SUITE_P(Dimensions, SurfaceShapeTest, testing::Values(2, 3));
