// SPDX-License-Identifier: GPL-2.0-only
/* ----------------------------------------------------------------------
   The roughness of a velocity field: what it leaves alone and what it damps.
------------------------------------------------------------------------- */

#include "aleisph_tension_roughness.h"

#include "cloud.h"

#include <gtest/gtest.h>

#include <cmath>

using namespace aleisph;
using namespace aleisph_test;

namespace {

// sums of up to 60 terms of size 1
constexpr double ROUNDING = 1e-13;

struct Field {
  std::vector<double> v, grad;
};

// v_a = A_ab x_b + c_a, with its gradient
Field linear_field(const PointSet &cloud, int dim)
{
  const double A[3][3] = {{0.3, -1.1, 0.7}, {0.9, -0.4, 0.2}, {-0.5, 0.6, 0.8}};
  Field f;
  f.v.assign(3 * cloud.total(), 0.0);
  f.grad.assign(9 * cloud.total(), 0.0);
  for (int i = 0; i < cloud.total(); i++)
    for (int a = 0; a < dim; a++) {
      f.v[3 * i + a] = 2.0 - a;
      for (int b = 0; b < dim; b++) {
        f.v[3 * i + a] += A[a][b] / D * cloud.point(i)[b];
        f.grad[9 * i + 3 * a + b] = A[a][b] / D;
      }
    }
  return f;
}

std::vector<double> roughness(const Cloud &cloud, const Field &f)
{
  // twice the rate, added to 1
  std::vector<double> out(f.v.size(), 1.0);
  add_roughness(cloud, 2.0, f.v.data(), f.grad.data(), out.data());
  for (double &x : out) x = 0.5 * (x - 1.0);
  return out;
}

}    // namespace

TEST(Roughness, LinearFieldsAreLeftAlone)
{
  for (int dim : {2, 3}) {
    const Kernel kernel(KernelType::CUBIC_SPLINE, dim, H);
    const PointSet cloud = block(dim, 2, 7);
    const auto out = roughness(make_cloud(kernel, D, cloud), linear_field(cloud, dim));
    for (int i : cloud.rows())
      for (int a = 0; a < dim; a++) EXPECT_NEAR(out[3 * i + a], 0.0, ROUNDING);
  }
}

// One particle that moves alone: all its neighbours are at rest, and grad v vanishes at the
// centre of a lattice, so that out_i = -v_i whatever the weights. A neighbour at distance r takes
// its share w(r)/sum w of it; d and sqrt 2 d, support 2.4 d: 1 - 1/2.4 and 1 - sqrt 2/2.4, and in
// 2d a lattice point has 4 neighbours at each of d, sqrt 2 d and 2 d, and none between 2 d and 2.4 d
// but the 8 at sqrt 5 d.
TEST(Roughness, TakesAwayWhatMovesAlone)
{
  const Kernel kernel(KernelType::CUBIC_SPLINE, 2, H);
  const Points points = lattice(2, 6, D);
  const PointSet cloud(points, static_cast<int>(points.size()), 2.4 * D);
  Field f;
  f.v.assign(3 * cloud.total(), 0.0);
  f.grad.assign(9 * cloud.total(), 0.0);
  f.v[0] = 1.5;
  const auto out = roughness(make_cloud(kernel, D, cloud), f);
  EXPECT_NEAR(out[0], -1.5, ROUNDING);
  EXPECT_NEAR(out[1], 0.0, ROUNDING);
  const auto w = [](double r) { return 1.0 - r / 2.4; };
  const double sum = 4.0 * w(1.0) + 4.0 * w(std::sqrt(2.0)) + 4.0 * w(2.0) +
      8.0 * w(std::sqrt(5.0));
  for (int j = 1; j < 5; j++) EXPECT_NEAR(out[3 * j], 1.5 * w(1.0) / sum, ROUNDING);
}

// walls, buffers and ballistic particles neither feel it nor act
TEST(Roughness, KeepsToTheBoundFluid)
{
  const Kernel kernel(KernelType::CUBIC_SPLINE, 2, H);
  const Points points = {{0.0, 0.0, 0.0}, {D, 0.0, 0.0}, {0.0, D, 0.0}};
  const PointSet cloud(points, 3, 2.4 * D);
  Field f;
  f.v = {1.0, 0.0, 0.0, 3.0, 0.0, 0.0, 0.0, 0.0, 0.0};
  f.grad.assign(27, 0.0);
  for (Role other : {FLUID, WALL, FLUID | BUFFER, FLUID | SURFACE | BALLISTIC}) {
    const auto out = roughness(make_cloud(kernel, D, cloud, {{FLUID, other, WALL}}), f);
    EXPECT_NEAR(out[0], other == FLUID ? 2.0 : 0.0, ROUNDING) << other;
  }
  const Role flying = FLUID | SURFACE | BALLISTIC;
  EXPECT_EQ(roughness(make_cloud(kernel, D, cloud, {{flying, FLUID, FLUID}}), f)[0], 0.0);
}

// filter sqrt(sigma/(rho d^3)), which no time step takes more than once
TEST(Roughness, RateIsBoundedByTheTimeStep)
{
  EXPECT_DOUBLE_EQ(roughness_rate(0.5, 8.0, 2.0, 0.25, 1.0e-3), 8.0);
  EXPECT_DOUBLE_EQ(roughness_rate(0.5, 8.0, 2.0, 0.25, 0.25), 4.0);
  EXPECT_EQ(roughness_rate(0.5, 0.0, 2.0, 0.25, 0.25), 0.0);
}
