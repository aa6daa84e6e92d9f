// SPDX-License-Identifier: GPL-2.0-only
/* ----------------------------------------------------------------------
   The filters of positions and velocities on the free surface: which pairs
   they act on, at what rate, and what they leave alone.
------------------------------------------------------------------------- */

#include "shifting.h"

#include <gtest/gtest.h>

#include <cmath>
#include <random>

using namespace aleisph;
using namespace aleisph_test;

namespace {

constexpr double ROUNDING = 1e-13;    // sums of up to 60 terms of size 1

}    // namespace

// Heights A sin(k x) of the top row, N straight up. With the weights w_m of the neighbours at
// m = +-1, +-2 spacings of the row, b = -A sin(k x) (1 - sum w_m cos(k m d)/sum w_m) to first
// order in A; distances change by (A/d)^2. 2d; in 3d with the ripple along x the weights are those
// of the neighbours (m, n) with m^2 + n^2 < 5.76.
TEST(Shift, PositionFilterSmoothsARipple)
{
  const double A = 1e-5 * D;
  for (int dim : {2, 3})
    for (double kd : {0.3, 1.0, M_PI}) {
      Scene scene = half_lattice(dim);
      for (int i : scene.rows(SURFACE))
        scene.points[i][dim - 1] = A * std::sin(kd * scene.points[i][0] / D + 0.7);
      const Shifting shifting(scene);
      const std::vector<double> none(shifting.size(), 0.0);
      ShiftParams params = unlimited(ShiftModel::DENSITY);
      const auto plain = shifting.shift(params, none);
      params.smoothing = 0.3;
      const auto smooth = shifting.shift(params, none);

      double weights = 0.0, waves = 0.0;
      for (int n = dim == 3 ? -2 : 0; n <= (dim == 3 ? 2 : 0); n++)
        for (int m = -2; m <= 2; m++)
          if (m != 0 || n != 0) {
            weights += shifting.kernel().w(D * std::sqrt(m * m + n * n));
            waves += shifting.kernel().w(D * std::sqrt(m * m + n * n)) * std::cos(kd * m);
          }
      for (int x : {-2, 0, 1}) {    // the row has its full set of neighbours
        const int i = shifting.nearest({x * D, 0.0, 0.0});
        const double height = A * std::sin(kd * x + 0.7);
        const double rate = 0.3 * (1.0 - waves / weights);
        // the fade towards corners changes by A/d = 1e-5 times a factor of order one
        EXPECT_NEAR((smooth[3 * i + dim - 1] - plain[3 * i + dim - 1]) / A, -rate * height / A,
                    2e-5);
        EXPECT_NEAR(smooth[3 * i], plain[3 * i], ROUNDING * A);
      }
    }
}

// published, other models, below the surface and ballistic: no filter; neighbours whose N
// is at more than acos 0.9, or that are ballistic, are not of this surface. The wall keeps the
// pair from being taken for a corner.
TEST(Shift, PositionFilterKeepsToItsSurface)
{
  const auto moved = [](Role role, const Point &N, bool published) {
    Scene scene;
    scene.add({0.0, 0.0, 0.0}, FLUID | SURFACE, {0.0, 1.0, 0.0});
    scene.add({1.0, 0.4, 0.0}, role, N);
    scene.add({0.0, -1.0, 0.0}, WALL, {0.0, 1.0, 0.0});
    const Shifting shifting(scene);
    ShiftParams params = unlimited(ShiftModel::DENSITY);
    params.coefficient = 0.0;
    params.smoothing = 0.5;
    params.published = published;
    return at(shifting.shift(params, {0.0, 0.0, 0.0}), 0)[1];
  };
  const Role surface = FLUID | SURFACE;
  EXPECT_NEAR(moved(surface, {0.0, 1.0, 0.0}, false), 0.2, ROUNDING);    // half of 0.4
  // N_j = (0.28, 0.96): r_ji.(N_i + N_j)/2 = (0.28 + 0.4 * 1.96)/2 = 0.532
  EXPECT_NEAR(moved(surface, {0.28, 0.96, 0.0}, false), 0.266, ROUNDING);
  EXPECT_EQ(moved(surface, {0.6, 0.8, 0.0}, false), 0.0);
  EXPECT_EQ(moved(surface | BALLISTIC, {0.0, 1.0, 0.0}, false), 0.0);
  EXPECT_EQ(moved(FLUID, {0.0, 1.0, 0.0}, false), 0.0);
  EXPECT_EQ(moved(surface, {0.0, 1.0, 0.0}, true), 0.0);
}

namespace {

std::vector<double> zeros(int n)
{
  return std::vector<double>(n, 0.0);
}

Scene splash(int dim, unsigned seed)    // surface, walls and ballistic particles at random
{
  Scene scene = rough(dim, seed);
  std::mt19937 random(seed);
  for (Role &role : scene.role) {
    const unsigned dice = random() % 8;
    if (dice < 2) role |= SURFACE;
    if (dice == 2) role |= SURFACE | BALLISTIC;
    if (dice == 3) role = WALL;
  }
  return scene;
}

}    // namespace

TEST(VelocityFilter, ConservesMomentum)
{
  for (int dim : {2, 3}) {
    const Shifting shifting(splash(dim, 2));
    const auto v = random_field(3 * shifting.size(), 1);
    const auto grad = random_field(9 * shifting.size(), 2);
    const auto out = shifting.filter(v, grad);
    Point sum{};
    double size = 0.0;
    for (int i : shifting.fluid()) {
      size += length(at(out, i));
      for (int a = 0; a < 3; a++) sum[a] += out[3 * i + a];
    }
    EXPECT_GT(size, 10.0);
    EXPECT_NEAR(length(sum) / size, 0.0, 1e-14);
  }
}

// v = b + A x with grad v = A, and, the gradients being exact, quadratic v: the mean of the
// gradients at both ends times the distance is the difference (trapezoidal rule)
TEST(VelocityFilter, VanishesForQuadraticVelocity)
{
  for (double curvature : {0.0, 3.0}) {
    const Shifting shifting(splash(2, 3));
    auto v = zeros(3 * shifting.size()), grad = zeros(9 * shifting.size());
    for (int i = 0; i < shifting.size(); i++) {
      const double x = shifting.scene().points[i][0] / D, y = shifting.scene().points[i][1] / D;
      v[3 * i] = 0.3 + 1.3 * x - 0.7 * y + curvature * x * y;
      v[3 * i + 1] = 0.6 * x + 2.1 * y + curvature * (x * x - 0.5 * y * y);
      grad[9 * i] = (1.3 + curvature * y) / D;
      grad[9 * i + 1] = (-0.7 + curvature * x) / D;
      grad[9 * i + 3] = (0.6 + 2.0 * curvature * x) / D;
      grad[9 * i + 4] = (2.1 - curvature * y) / D;
    }
    for (double a : shifting.filter(v, grad)) ASSERT_NEAR(a, 0.0, 1e-12);    // |v| up to 200
  }
}

// a pair at distance r: +-V W (v_j - v_i); what is not fluid, ballistic or without surface: nothing
TEST(VelocityFilter, ActsOnFluidPairsWithASurfaceMember)
{
  struct Case {
    Role i, j;
    bool acts;
  };
  const Role S = FLUID | SURFACE, B = S | BALLISTIC;
  for (const Case &c : {Case{FLUID, FLUID, false},
                        {S, FLUID, true},
                        {FLUID, S, true},
                        {S, S, true},
                        {S, WALL, false},
                        {S, B, false},
                        {B, S, false},
                        {S, FLUID | BUFFER, false}}) {
    Scene scene;
    scene.add({0.0, 0.0, 0.0}, c.i);
    scene.add({0.6, 0.8, 0.0}, c.j);
    const Shifting shifting(scene);
    const auto out = shifting.filter({1.0, 2.0, 3.0, 2.0, 0.0, 3.5}, zeros(18));
    const double expected = c.acts ? weight(shifting, 1.0) : 0.0;
    EXPECT_NEAR(out[0], expected, ROUNDING);
    EXPECT_NEAR(out[1], -2.0 * expected, ROUNDING);
    EXPECT_NEAR(out[2], 0.5 * expected, ROUNDING);
  }
}

// two particles at (0, 0) and (1, 0), v = 0, d v_a/d x_b = 1 for one a, b = x on one of them:
// out_i = V W r_ij/2 = -V W/2 in component a
TEST(VelocityFilter, ReadsTheGradientByRows)
{
  Scene scene;
  scene.add({0.0, 0.0, 0.0}, FLUID | SURFACE);
  scene.add({1.0, 0.0, 0.0}, FLUID);
  const Shifting shifting(scene);
  for (int side : {0, 1})
    for (int a : {0, 1, 2})
      for (int b : {0, 1, 2}) {
        auto grad = zeros(18);
        grad[9 * side + 3 * a + b] = 1.0;
        const auto out = shifting.filter(zeros(6), grad);
        for (int c : {0, 1, 2})
          EXPECT_NEAR(out[c], c == a && b == 0 ? -0.5 * weight(shifting, 1.0) : 0.0, ROUNDING);
      }
}
