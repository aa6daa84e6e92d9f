// SPDX-License-Identifier: GPL-2.0-only
// What the projection leaves, and how much of it is given back

#include "aleisph_solve_leftover.h"
#include "scenes.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

using namespace aleisph;
using namespace aleisph_test;

namespace {

// rows of the fluid that lie inside, where only fluid is within the support
Rows inner_rows(const Discretized &ops)
{
  const SeenRoles seen = ops.cloud().neighbours();
  return select_rows(ops.cloud().fluid(), [&](int i) { return !seen.any(i, WALL); });
}

PpeLayout layout_of(const Discretized &ops)
{
  CsrMatrix A;
  PpeLayout layout;
  assemble_ppe(ops.cloud(), std::vector<double>(ops.l().a(), ops.l().a() + ops.s().pairs()),
               PpeOptions(), A, layout);
  return layout;
}

}    // namespace

TEST(Leftover, RowsAreThoseWithAFullSupport)
{
  for (const int dim : {2, 3}) {
    Scene scene = closed_box(dim, 8, 0.1, 3);
    const Rows fluid = scene.rows(FLUID);
    const int surface = fluid[fluid.size() / 2], prescribed = fluid.back();
    scene.role[surface] |= SURFACE;
    scene.role[prescribed] |= DIRICHLET;
    const Discretized ops(scene);
    const Rows rows = leftover_rows(ops.cloud(), layout_of(ops));
    const SeenRoles seen = ops.cloud().neighbours();
    EXPECT_GT(rows.size(), fluid.size() / 2);
    EXPECT_LT(rows.size(), fluid.size() - 2);
    for (const int i : fluid) {
      const bool expected = i != surface && i != prescribed && !seen.any(i, SURFACE);
      EXPECT_EQ(std::count(rows.begin(), rows.end(), i), expected) << i;
    }
  }
}

// rows of Morris: the gap to a free rim has not been marked as a surface
TEST(Leftover, NotTheRowsOfMorris)
{
  const Scene scene = cylinder(2, 0.5, 0.1, false);
  const Discretized ops(scene);
  EXPECT_GT(ops.l().morris_count().total(), 0);
  for (const int i : leftover_rows(ops.cloud(), layout_of(ops))) EXPECT_FALSE(ops.l().morris(i));
}

// The smooth part is given back whole: a constant, to rounding
TEST(Leftover, AConstantIsGivenBackWhole)
{
  for (const int dim : {2, 3})
    for (const double share : {0.0, 0.5, 0.95}) {
      const Discretized ops(closed_box(dim, 8, 0.2, 3));
      const std::vector<double> q(ops.cloud().size(), 3.7);
      std::vector<double> g(ops.cloud().size(), -77.0);
      given_back(ops.cloud(), ops.cloud().fluid(), share, q.data(), g.data());
      for (const int i : ops.cloud().fluid()) EXPECT_NEAR(g[i], 3.7, 1.0e-14);
      for (const int i : ops.cloud().wall()) EXPECT_EQ(g[i], -77.0);
    }
}

// With share one it is q itself; and the mean S q enters with the rest of the share
TEST(Leftover, ShareOfWhatIsRough)
{
  for (const int dim : {2, 3}) {
    const Discretized ops(closed_box(dim, 8, 0.2, 3));
    const auto q = random_field(ops.cloud().size(), 4);
    std::vector<double> whole(q.size()), mean(q.size()), half(q.size());
    const Rows &fluid = ops.cloud().fluid();
    given_back(ops.cloud(), fluid, 1.0, q.data(), whole.data());
    given_back(ops.cloud(), fluid, 0.0, q.data(), mean.data());
    given_back(ops.cloud(), fluid, 0.5, q.data(), half.data());
    for (const int i : fluid) {
      EXPECT_EQ(whole[i], q[i]);
      EXPECT_NEAR(half[i], 0.5 * (q[i] + mean[i]), 1.0e-15);
    }
  }
}

// The mean S by hand on the lattice, where it is the same everywhere inside: S of the wave of two
// spacings is less than a third of it; S x = x, and S x^2 = x^2 + c d^2, second order
TEST(Leftover, MeanDampsTheShortWaves)
{
  const double support = 2.4;    // spacings
  for (const int dim : {2, 3}) {
    double weights = 0.0, wave = 0.0, second = 0.0;
    for (const Point &p : lattice(dim, 2, 1.0)) {
      const double x = (p[0] * p[0] + p[1] * p[1] + p[2] * p[2]) / (support * support);
      if (x >= 1.0) continue;
      const double weight = (1.0 - x) * (1.0 - x);
      weights += weight;
      wave += std::lround(p[0] + p[1] + p[2]) % 2 == 0 ? weight : -weight;
      second += weight * p[0] * p[0];
    }
    EXPECT_LT(std::fabs(wave / weights), 1.0 / 3.0);

    const Scene scene = closed_box(dim, 10);
    const Discretized ops(scene);
    std::vector<double> alternating, slope, square, S(scene.points.size());
    for (const Point &x : scene.points) {
      const long parity = std::lround((x[0] + x[1] + x[2]) / scene.d);
      alternating.push_back(parity % 2 ? -1.0 : 1.0);
      slope.push_back(x[0] / scene.d);
      square.push_back(x[0] * x[0] / (scene.d * scene.d));
    }
    const Rows inner = inner_rows(ops);
    ASSERT_FALSE(inner.empty());
    const auto expect_mean = [&](const std::vector<double> &q, double factor, double change) {
      given_back(ops.cloud(), inner, 0.0, q.data(), S.data());
      for (const int i : inner) EXPECT_NEAR(S[i], factor * q[i] + change, 1.0e-12);
    };
    expect_mean(alternating, wave / weights, 0.0);
    expect_mean(slope, 1.0, 0.0);
    expect_mean(square, 1.0, second / weights);
  }
}
