// SPDX-License-Identifier: GPL-2.0-only
/* ----------------------------------------------------------------------
   Area of the free surface, and of the wall under a drop, from the particles.
------------------------------------------------------------------------- */

#include "aleisph_surface_area.h"
#include "caps.h"
#include "drops.h"

#include <gtest/gtest.h>

#include <cmath>

using namespace aleisph;
using namespace aleisph_test;

namespace {

constexpr double DEGREE = M_PI / 180.0;

// of a disc (its circumference) or ball
double sphere_area(int dim, double R)
{
  return dim == 2 ? 2.0 * M_PI * R : 4.0 * M_PI * R * R;
}

// A slab of fluid, n spacings long in each periodic direction
Drop slab(int dim, int n, double d)
{
  Points points;
  for (int i = 0; i < n; i++)
    for (int k = 0; k < 6; k++)
      for (int j = 0; j < (dim == 2 ? 1 : n); j++) {
        if (dim == 2) points.push_back({i * d, k * d, 0.0});
        if (dim == 3) points.push_back({i * d, k * d, j * d});
      }
  return {dim, d, points, {n * d, 0.0, dim == 2 ? 0.0 : n * d}};
}

}    // namespace

// Cells of a lattice are squares: exact. Two sides, whose normals cancel.
TEST(SurfaceArea, FlatSurface)
{
  for (const int dim : {2, 3}) {
    SCOPED_TRACE(dim);
    constexpr int N = 8;
    Drop drop = slab(dim, N, D);
    drop.tangent();
    const SurfaceArea found = drop.area();
    const double exact = 2.0 * std::pow(N * D, dim - 1);
    EXPECT_NEAR(found.area, exact, 1.0e-12 * exact);    // rounding of some hundred terms
    EXPECT_LE(found.vector.norm(), 1.0e-12 * exact);
  }
}

// The layer of particles is exactly half a spacing inside. N and K are those of model tangent. What is
// left is of second order in d/R; its coefficient is 0.06 to 0.09 where R is 5 or 10 d.
TEST(SurfaceArea, RoundDropsAreOfSecondOrder)
{
  for (const auto &[dim, n] : {std::pair{2, 5}, {2, 10}, {2, 20}, {3, 5}, {3, 10}}) {
    SCOPED_TRACE(testing::Message() << dim << "d, R = " << n << " d");
    Drop drop(dim, D, relaxed_ball(dim, n, D));
    drop.tangent();
    const SurfaceArea found = drop.area();
    const double exact = sphere_area(dim, n * D);
    EXPECT_NEAR(found.area, exact, 0.1 / (n * n) * exact);
    EXPECT_LE(found.vector.norm(), 1.0e-3 * exact);    // closed; shells are not quite symmetric
  }
}

// Cut from a lattice, the surface has steps of up to d, which N smooths and cells do not see: less
// than the 4/pi (2d), 3/2 (3d) of the steps themselves, 2 % at most
TEST(SurfaceArea, StepsDoNotCount)
{
  for (const int dim : {2, 3}) {
    SCOPED_TRACE(dim);
    Drop drop(dim, D, lattice_ball(dim, 10.0 * D, D));
    drop.tangent();
    const double volume = drop.owned() * std::pow(D, dim);
    const double R = dim == 2 ? std::sqrt(volume / M_PI) : std::cbrt(0.75 * volume / M_PI);
    EXPECT_NEAR(drop.area().area, sphere_area(dim, R), 0.02 * sphere_area(dim, R));
  }
}

// Free and wet area of sessile caps, and the energy A - cos(theta) A_wet. That particles are half a
// spacing below the surface is true within e = 0.07 d in these scenes. This moves the surface by e
// and its end on the wall by e/sin(theta): relative to the half width R sin(theta), e/(R sin^2). In 3d
// both count twice, as areas are squares of lengths.
TEST(SurfaceArea, Caps)
{
  constexpr double DEPTH = 0.07 * D;
  for (const int dim : {2, 3})
    for (const int angle : {45, 60, 75, 90, 105, 120, 135}) {
      SCOPED_TRACE(testing::Message() << dim << "d, " << angle << " degrees");
      const double theta = angle * DEGREE, c = std::cos(theta), s = std::sin(theta);
      const CapShape shape = CapShape::of_volume(dim, dim == 2 ? 12.0 : 8.0, theta);
      Contact cap(dim, full_cap(shape, 1), {0.0, 1.0, 0.0}, theta);
      cap.measure();
      const SurfaceArea found = surface_area(cap.cloud,
                                             {cap.N.data(), cap.K.data(), cap.contact.data()});
      const double R = shape.radius;
      const double area = dim == 2 ? 2.0 * theta * R : 2.0 * M_PI * R * R * (1.0 - c);
      const double wet = dim == 2 ? 2.0 * R * s : M_PI * R * R * s * s;
      const double tolerance = (dim - 1) * DEPTH * (1.0 + 1.0 / (s * s)) / R;
      EXPECT_NEAR(found.area / area, 1.0, tolerance);
      EXPECT_NEAR(found.vector[1] / wet, 1.0, tolerance);
      EXPECT_NEAR((found.area - c * found.vector[1]) / (area - c * wet), 1.0, tolerance);
      for (const int a : {0, 2}) EXPECT_LE(std::abs(found.vector[a]), tolerance * area);
    }
}
