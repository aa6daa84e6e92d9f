// SPDX-License-Identifier: GPL-2.0-only
/* ----------------------------------------------------------------------
   Normals by the gradient of lambda, eq 25: on linear lambda, and by hand on
   four particles.
------------------------------------------------------------------------- */

#include "aleisph_eigenvalue_normal.h"

#include "aleisph_vectors.h"
#include "cloud.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

using namespace aleisph;
using namespace aleisph_test;

namespace {

constexpr double ROUNDING = 1.0e-12;    // sums of up to a hundred terms

/* A (-1,0)   O (0,0)   B (1,0)
              C (0,-1)            d = V = 1, every particle sees the others. With f(r) = -W'(r) r,
   M = sum f e x e, so that lambda is
     O  f(1):  diag(2 f(1), f(1))
     A  ((a + c) - sqrt(a^2 + c^2))/2 with a = f(1) + f(2), c = f(sqrt 2):
        a x x + c (x - y) (x - y)/2
     B  as A
     C  c:  diag(c, c + f(1))
   A and B cancel at O, where L = diag(1/(2 f(1)), 1/f(1)) and gradW of C is W'(1) y:
     -N* = (lambda_C - lambda_O) (-W'(1)) L y = (c - f(1)) y
   which points to C, as c < f(1).                                                            */
struct Tee {
  Kernel kernel{KernelType::CUBIC_SPLINE, 2, 1.2};
  Points points{{0.0, 0.0, 0.0}, {-1.0, 0.0, 0.0}, {1.0, 0.0, 0.0}, {0.0, -1.0, 0.0}};

  double f(double r) const { return -kernel.dw(r) * r; }
  double side() const
  {
    const double a = f(1.0) + f(2.0), c = f(std::sqrt(2.0));
    return 0.5 * (a + c - std::hypot(a, c));
  }
  std::vector<double> lambda() const { return {f(1.0), side(), side(), f(std::sqrt(2.0))}; }
  // the last particles are ghosts
  Cloud cloud(int owned) const
  {
    return make_cloud(kernel, 1.0, PointSet(points, owned, kernel.support()));
  }
};

const GhostExchange nothing = [](double *, int) {};

}    // namespace

// The corrected gradient is exact for linear fields
TEST(EigenvalueNormal, GradientPointsDownALinearField)
{
  for (int dim : {2, 3}) {
    const PointSet points = block(dim, 3, 5);
    const Cloud cloud = make_cloud(Kernel(KernelType::CUBIC_SPLINE, dim, H), D, points);
    const Eigen::Vector3d slope(3.0, -2.0, dim == 3 ? 1.0 : 0.0);
    std::vector<double> N(3 * points.total());
    const auto lambda = sample(points, [&slope](const Point &x) {
      return 0.9 + slope.dot(Eigen::Vector3d::Map(x.data()));
    });
    eigenvalue_gradient(cloud, points.rows(), lambda.data(), N.data());
    for (int i : points.rows())    // lambda is 1, known to eps
      EXPECT_LT((at(N.data(), i) + slope).norm(), ROUNDING / D) << dim << "d, " << i;
  }
}

TEST(EigenvalueNormal, ByHandOnFourParticles)
{
  const Tee tee;
  const Cloud cloud = tee.cloud(4);
  for (int i = 0; i < 4; i++) EXPECT_NEAR(cloud.gradient().lambda(i), tee.lambda()[i], ROUNDING);

  std::vector<double> N(12, 0.0);
  eigenvalue_gradient(cloud, {0}, tee.lambda().data(), N.data());
  const double c = tee.f(std::sqrt(2.0)), f1 = tee.f(1.0);
  EXPECT_LT((at(N.data(), 0) - Eigen::Vector3d(0.0, c - f1, 0.0)).norm(), ROUNDING);

  EXPECT_EQ(eigenvalue_normals(cloud, cloud.fluid(), nullptr, nothing, N.data()), 0);
  EXPECT_LT((at(N.data(), 0) - Eigen::Vector3d(0.0, -1.0, 0.0)).norm(), ROUNDING);
  for (int i = 0; i < 4; i++) EXPECT_NEAR(at(N.data(), i).norm(), 1.0, ROUNDING) << i;
  // mirrored
  EXPECT_NEAR(N[3], -N[6], ROUNDING);
  EXPECT_NEAR(N[4], N[7], ROUNDING);
}

// only rows are written; a row without neighbours has no direction
TEST(EigenvalueNormal, WithoutDirection)
{
  Tee tee;
  tee.points.push_back({10.0, 0.0, 0.0});
  const Cloud cloud = tee.cloud(5);
  std::vector<double> N(15, 7.0);
  EXPECT_EQ(eigenvalue_normals(cloud, {0, 4}, nullptr, nothing, N.data()), 1);
  EXPECT_EQ(at(N.data(), 4).norm(), 0.0);
  EXPECT_EQ(N[3], 7.0);
}

// lambda of ghosts is that of their owner; contact particles have the contact normal
TEST(EigenvalueNormal, GhostsAndContact)
{
  const Tee tee;
  const Cloud cloud = tee.cloud(3);
  const auto owner = [&tee](double *lambda, int n) {
    EXPECT_EQ(n, 1);
    EXPECT_EQ(lambda[3], 0.0);
    lambda[3] = tee.lambda()[3];
  };
  std::vector<double> N(12, 0.0), all(12, 0.0);
  eigenvalue_normals(tee.cloud(4), {0, 1, 2}, nullptr, nothing, all.data());
  eigenvalue_normals(cloud, {0, 1, 2}, nullptr, owner, N.data());
  for (int k = 0; k < 9; k++) EXPECT_NEAR(N[k], all[k], ROUNDING);

  const std::vector<double> contact = {0.0, 0.0, 0.0, 0.0, 0.6, 0.8, 0.0, 1.0, 0.0, 0.0, 0.0, 0.0};
  eigenvalue_normals(cloud, {0, 1, 2}, contact.data(), owner, N.data());
  EXPECT_EQ(at(N.data(), 1), Eigen::Vector3d(0.6, 0.8, 0.0));
  for (int i : {0, 2}) EXPECT_LT((at(N.data(), i) - at(all.data(), i)).norm(), ROUNDING);
}
