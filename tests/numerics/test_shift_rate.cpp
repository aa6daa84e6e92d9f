// SPDX-License-Identifier: GPL-2.0-only
/* ----------------------------------------------------------------------
   The rate of shifting: strain and pressure gradient of the flow, and the
   largest coefficient.
------------------------------------------------------------------------- */

#include "aleisph_shift_rate.h"
#include "shifting.h"

#include <gtest/gtest.h>

#include <cmath>

using namespace aleisph;
using namespace aleisph_test;

namespace {

constexpr double ROUNDING = 1e-12;

// the same velocity gradient g and pressure gradient p for all particles
FlowSums sums_of(const Shifting &shifting, const std::vector<double> &g,
                 const std::vector<double> &p)
{
  std::vector<double> grad_v(9 * shifting.size()), grad_p(3 * shifting.size());
  for (std::size_t k = 0; k < grad_v.size(); k++) grad_v[k] = g[k % 9];
  for (std::size_t k = 0; k < grad_p.size(); k++) grad_p[k] = p[k % 3];
  return flow_sums(shifting.cloud(), grad_v.data(), grad_p.data());
}

}    // namespace

// U = 33 d S + sqrt(a d): S = 2 A for u = A x, v = -A y; S = q for a shear u = q y
TEST(ShiftRate, OfStrainAndPressureGradient)
{
  const Shifting shifting(half_lattice(2));
  const auto scale = [&](const std::vector<double> &g, const std::vector<double> &p) {
    return flow_scale(sums_of(shifting, g, p), D, 2.0);
  };
  const std::vector<double> still(9, 0.0), none(3, 0.0);
  EXPECT_EQ(scale(still, none), 0.0);
  EXPECT_NEAR(scale({3, 0, 0, 0, -3, 0, 0, 0, 0}, none), 33.0 * D * 6.0, ROUNDING);
  EXPECT_NEAR(scale({0, 3, 0, 0, 0, 0, 0, 0, 0}, none), 33.0 * D * 3.0, ROUNDING);
  EXPECT_NEAR(scale({0, 3, 0, -3, 0, 0, 0, 0, 0}, none), 0.0, ROUNDING);    // a rotation
  // a = 10/2
  EXPECT_NEAR(scale(still, {6, -8, 0}), std::sqrt(5.0 * D), ROUNDING);
  EXPECT_NEAR(scale({0, 3, 0, 0, 0, 0, 0, 0, 0}, {6, -8, 0}), 99.0 * D + std::sqrt(5.0 * D),
              ROUNDING);
  EXPECT_EQ(flow_scale(FlowSums(), D, 2.0), 0.0);
}

// what flies freely is not counted
TEST(ShiftRate, WithoutBallisticParticles)
{
  Scene scene = half_lattice(2);
  scene.role[0] |= BALLISTIC;
  const Shifting shifting(scene);
  const auto sums = sums_of(shifting, {0, 1, 0, 0, 0, 0, 0, 0, 0}, {1, 0, 0});
  EXPECT_EQ(sums.count, shifting.fluid().size() - 1.0);
  EXPECT_EQ(sums.strain, sums.count);
  EXPECT_EQ(sums.gradient, sums.count);
}

// With it, the stiffest wave of a small disorder, of wave length 4 d along an axis, is undone in one
// step. 1e-4: to first order in the amplitude 1e-5 d.
TEST(ShiftRate, LargestCoefficientUndoesTheStiffestWave)
{
  const double A = 1e-5 * D;
  for (int dim : {2, 3}) {
    Scene scene;
    scene.dim = dim;
    scene.d = D;
    for (Point p : lattice(dim, 4, D)) {
      p[1] += A * std::cos(0.5 * M_PI * p[1] / D);
      scene.add(p, FLUID);
    }
    const Shifting shifting(scene);
    ShiftParams params = unlimited(ShiftModel::DENSITY);
    params.coefficient = largest_coefficient(shifting.kernel(), D);
    const auto dr = shifting.shift(params, shifting.deviation(false));
    const int i = shifting.nearest({0.0, 0.0, 0.0});
    EXPECT_NEAR(dr[3 * i + 1] / A, -1.0, 1e-4);
    // an independent sum over the lattice
    EXPECT_NEAR(params.coefficient, dim == 2 ? 0.168961 : 0.0716327, 1e-6);
  }
}

// whatever the spacing
TEST(ShiftRate, LargestCoefficientIsANumber)
{
  for (int dim : {2, 3}) {
    const double one = largest_coefficient(Kernel(KernelType::CUBIC_SPLINE, dim, 1.2), 1.0);
    EXPECT_NEAR(largest_coefficient(Kernel(KernelType::CUBIC_SPLINE, dim, 1.2e-6), 1e-6), one,
                ROUNDING);
  }
}

// On a flat surface with e = x: what raises the surface by a + b x does the work b sum x^2, which goes,
// and a stays. What lowers it where e is large, and what does not fly with the fluid, is left.
TEST(ShiftRate, SurfaceDoesNoWork)
{
  Scene scene = half_lattice(2);
  const int ballistic = scene.rows(SURFACE).front();
  scene.role[ballistic] |= BALLISTIC;
  const Shifting shifting(scene);
  const Rows rows = surface_that_works(shifting.cloud());
  ASSERT_EQ(rows.size() + 1, scene.rows(SURFACE).size());
  std::vector<double> e(shifting.size());
  double mean = 0.0;
  for (int i = 0; i < shifting.size(); i++) e[i] = scene.points[i][0];
  for (int i : rows) mean += e[i] / static_cast<double>(rows.size());
  for (double b : {0.3, -0.3}) {
    std::vector<double> dr(3 * shifting.size());
    for (int i = 0; i < shifting.size(); i++) {
      dr[3 * i] = 0.7;
      dr[3 * i + 1] = 0.2 + b * (e[i] - mean);
    }
    const auto before = dr;
    const auto work = surface_work(shifting.cloud(), rows, e.data(), mean, dr.data());
    EXPECT_NEAR(work.work, b * work.square, ROUNDING);
    remove_surface_work(shifting.cloud(), rows, e.data(), mean, work, dr.data());
    auto expected = before;
    if (b > 0.0)
      for (int i : rows) expected[3 * i + 1] = 0.2;
    for (std::size_t k = 0; k < dr.size(); k++) EXPECT_NEAR(dr[k], expected[k], ROUNDING);
  }
}
