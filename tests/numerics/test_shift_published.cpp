// SPDX-License-Identifier: GPL-2.0-only
/* ----------------------------------------------------------------------
   The readings of the published shift, eqs 19-23, by hand on four particles:
   d = V = 1, h = 1.2, C = 1; particle 0 at the origin, its neighbours at
   (1, 0), (0, 1) and (-1, -1). With W1 = W(1), W2 = W(sqrt 2):
     dr_w = (-W1 + W2/sqrt 2) (1, 1)
     dr_dens = q_1 (-1, 0) + q_2 (0, -1) + q_3 (1, 1)/sqrt 2
   q_j = 2 eps_j as printed, eps_0 + eps_j if symmetric.
------------------------------------------------------------------------- */

#include "shifting.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

using namespace aleisph;
using namespace aleisph_test;

namespace {

constexpr double ROUNDING = 1e-14;    // a few terms of size 1
const double ROOT2 = std::sqrt(2.0);

Scene four(Role first = FLUID, Role second = FLUID)
{
  Scene scene;
  scene.add({0.0, 0.0, 0.0}, first, {0.0, first & SURFACE ? 1.0 : 0.0, 0.0});
  scene.add({1.0, 0.0, 0.0}, FLUID);
  scene.add({0.0, 1.0, 0.0}, second);
  scene.add({-1.0, -1.0, 0.0}, FLUID);
  return scene;
}

ShiftParams params(bool printed, bool positive = false)
{
  ShiftParams p = unlimited(ShiftModel::DENSITY);
  p.published = true;
  p.printed_pair = printed;
  p.positive_surface = positive;
  p.wall_distance = 0.0;
  return p;
}

const std::vector<double> EPS = {0.5, 0.1, -0.2, 0.3};

// dr of particle 0: h times the even part and the pairs
void expect_shift(const Shifting &shifting, const ShiftParams &p, const std::vector<double> &q,
                  const std::vector<double> &eps = EPS)
{
  const double even = -weight(shifting, 1.0) + weight(shifting, ROOT2) / ROOT2;
  const Point dr = at(shifting.shift(p, eps), 0);
  EXPECT_NEAR(dr[0], 1.2 * (even - q[0] + q[2] / ROOT2), ROUNDING);
  EXPECT_NEAR(dr[1], 1.2 * (even - q[1] + q[2] / ROOT2), ROUNDING);
  EXPECT_EQ(dr[2], 0.0);
}

}    // namespace

TEST(ShiftPublished, Pairs)
{
  const Shifting shifting(four());
  expect_shift(shifting, params(true), {0.2, -0.4, 0.6});
  expect_shift(shifting, params(false), {0.6, 0.3, 0.8});
}

// The sums are those over S* of eqs 19 and 23, with eps = rho* - 1: by hand, of all four
TEST(ShiftPublished, PairsOfTheNumericalDensity)
{
  const Shifting shifting(four());
  const double W0 = weight(shifting, 0.0), W1 = weight(shifting, 1.0), W2 = weight(shifting, ROOT2);
  const double beta = 1.0 / (W0 + 4.0 * W1 + 4.0 * W2);
  const double corner = beta * (W0 + W1 + W2) - 1.0;    // the other at (0, 1) or (1, 0)
  const std::vector<double> eps = {beta * (W0 + 2.0 * W1 + W2) - 1.0, corner, corner,
                                   beta * (W0 + W2) - 1.0};
  const auto found = shifting.deviation(true);
  for (int i = 0; i < 4; i++) EXPECT_NEAR(found[i], eps[i], ROUNDING) << i;
  expect_shift(shifting, params(true), {2.0 * eps[1], 2.0 * eps[2], 2.0 * eps[3]}, found);
  expect_shift(shifting, params(false), {eps[0] + eps[1], eps[0] + eps[2], eps[0] + eps[3]}, found);
}

// `surface positive`: no attraction in pairs with a member on the surface
TEST(ShiftPublished, PositivePairs)
{
  const Shifting shifting(four(FLUID, FLUID | SURFACE));
  expect_shift(shifting, params(true, true), {0.2, 0.0, 0.6});
  expect_shift(shifting, params(false, true), {0.6, 0.3, 0.8});
}

// a wall has the deviation of the particle itself, in both
TEST(ShiftPublished, WallsInPairs)
{
  const Shifting shifting(four(FLUID, WALL));
  expect_shift(shifting, params(true), {0.2, 1.0, 0.6});
  expect_shift(shifting, params(false), {0.6, 1.0, 0.8});
}

// On the surface the even part alone loses its part along N, whichever N is given: that of the
// cloud is (0, 1), the other one (0.6, 0.8). Its sign does not matter.
TEST(ShiftPublished, NormalOfTheSurface)
{
  const Shifting shifting(four(FLUID | SURFACE));
  const double even = -weight(shifting, 1.0) + weight(shifting, ROOT2) / ROOT2;
  const double dens[2] = {-0.2 + 0.6 / ROOT2, 0.4 + 0.6 / ROOT2};
  const auto expect = [&](const double *normal, double x, double y) {
    std::vector<double> dr(12, 0.0);
    compute_shift(shifting.cloud(), params(true), EPS.data(), nullptr, dr.data(), normal);
    EXPECT_NEAR(dr[0], 1.2 * (x * even + dens[0]), ROUNDING);
    EXPECT_NEAR(dr[1], 1.2 * (y * even + dens[1]), ROUNDING);
  };
  expect(nullptr, 1.0, 0.0);
  // (1, 1) - 1.4 (0.6, 0.8)
  for (double sign : {1.0, -1.0}) {
    std::vector<double> normal(12, 0.0);
    normal[0] = 0.6 * sign;
    normal[1] = 0.8 * sign;
    expect(normal.data(), 0.16, -0.12);
  }
}

// eps = e < 0 on a flat surface, 0 below. As printed the surface is not moved, as pairs with the row
// below have 2 eps = 0 and those beside cancel; the second row meets 2 e in the row above and is
// drawn out by C h 2 e sum e_n. Symmetric: both meet e, and approach each other.
TEST(ShiftPublished, RowsBelowAFlatSurface)
{
  for (int dim : {2, 3}) {
    const Shifting shifting(half_lattice(dim));
    const double d = D, e = shifting.deviation(true)[shifting.nearest({0.0, 0.0, 0.0})];
    const double sum = 1.0 + (dim == 2 ? ROOT2 : 2.0 * ROOT2 + 4.0 / std::sqrt(3.0));
    Point below{};
    below[dim - 1] = -d;
    ShiftParams printed = params(true), symmetric = params(false);
    const auto once = full_shift(shifting, printed), both = full_shift(shifting, symmetric);
    const int top = shifting.nearest({0.0, 0.0, 0.0}), second = shifting.nearest(below);
    EXPECT_NEAR(length(at(once, top)) / d, 0.0, 1e-13);
    EXPECT_NEAR(at(once, second)[dim - 1] / d, -1.2 * 2.0 * e * sum, 1e-13);
    EXPECT_NEAR(at(both, top)[dim - 1] / d, 1.2 * e * sum, 1e-13);
    EXPECT_NEAR(at(both, second)[dim - 1] / d, -1.2 * e * sum, 1e-13);
  }
}
