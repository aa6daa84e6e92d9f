// SPDX-License-Identifier: GPL-2.0-only
/* ----------------------------------------------------------------------
   What all models of surface tension share: the rows, the pressure and force
   that the curvature makes.
------------------------------------------------------------------------- */

#include "aleisph_surface_stress.h"
#include "aleisph_tension.h"

#include "cloud.h"

#include <gtest/gtest.h>

#include <Eigen/Dense>

#include <cmath>

using namespace aleisph;
using namespace aleisph_test;

namespace {

using Vec3 = Eigen::Vector3d;

constexpr double ROUNDING = 1.0e-14;    // sums of nine terms of size 1

// two particles on the surface, 0 and 2
TensionResult two_on_the_surface()
{
  TensionResult result;
  result.rows = {0, 2};
  result.K = {2.0, 0.0, -1.0};
  result.N = {1.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.6, 0.8};
  return result;
}

}    // namespace

TEST(TensionTest, SurfaceRowsAreFluidOnTheSurfaceAndNotBallistic)
{
  const Points points(5, Point{0.0, 0.0, 0.0});
  const Cloud cloud = make_cloud(Kernel(KernelType::CUBIC_SPLINE, 2, H), D,
                                 PointSet(points, 5, 0.0),
                                 {{FLUID, FLUID | SURFACE, FLUID | SURFACE | BALLISTIC,
                                   WALL | SURFACE, FLUID | SURFACE | DIRICHLET}});
  EXPECT_EQ(surface_rows(cloud), Rows({1, 4}));
}

TEST(TensionTest, CurvatureIsLimitedAndCounted)
{
  CurvatureCount count;
  EXPECT_EQ(count.limit(3.0, 4.0), 3.0);
  EXPECT_EQ(count.limit(-4.0, 4.0), -4.0);
  EXPECT_EQ(count.limited, 0);
  EXPECT_EQ(count.limit(-5.0, 4.0), -4.0);
  EXPECT_EQ(count.limited, 1);
}

// v = A x: N.A.N
TEST(TensionTest, NormalStrain)
{
  Eigen::Matrix3d A;
  A << 1.0, 2.0, 3.0, -4.0, 5.0, 6.0, 7.0, 8.0, -9.0;
  const Eigen::Matrix<double, 3, 3, Eigen::RowMajor> rows = A;
  const Vec3 flat(0.6, -0.8, 0.0), n = Vec3(2.0, -1.0, 2.0) / 3.0;
  EXPECT_NEAR(normal_strain(flat.data(), rows.data(), 2), flat.dot(A * flat), ROUNDING * 9.0);
  EXPECT_NEAR(normal_strain(n.data(), rows.data(), 3), n.dot(A * n), ROUNDING * 9.0);
}

// p = sigma K + 2 mu N.(grad v).N, added to what is there, on the surface alone
TEST(TensionTest, PressureOfTheSurface)
{
  const TensionResult result = two_on_the_surface();
  std::vector<double> p = {1.0, 1.0, 1.0}, grad_v(27, 0.0);
  grad_v[0] = 4.0;         // d v_x/d x of 0
  grad_v[18 + 8] = 0.5;    // d v_z/d z of 2
  add_capillary_pressure(result, 10.0, p.data());
  EXPECT_EQ(p, std::vector<double>({21.0, 1.0, -9.0}));
  add_viscous_pressure(result.rows, result.N.data(), 3.0, grad_v.data(), 3, p.data());
  EXPECT_DOUBLE_EQ(p[0], 21.0 + 2.0 * 3.0 * 4.0);
  EXPECT_EQ(p[1], 1.0);
  EXPECT_DOUBLE_EQ(p[2], -9.0 + 2.0 * 3.0 * 0.5 * 0.64);
}

// f = -factor K N, in 2d without the third component
TEST(TensionTest, ForceOnTheSurface)
{
  const TensionResult result = two_on_the_surface();
  for (const int dim : {2, 3}) {
    std::vector<double> f(9, 1.0);
    double *rows[] = {&f[0], &f[3], &f[6]};
    add_tension_force(result, 5.0, dim, rows);
    const std::vector<double> expected = {
        -9.0, 1.0, 1.0, 1.0, 1.0, 1.0, 1.0, 4.0, dim == 3 ? 5.0 : 1.0};
    for (int k = 0; k < 9; k++) EXPECT_DOUBLE_EQ(f[k], expected[k]) << k;
  }
}
