// SPDX-License-Identifier: GPL-2.0-only
/* ----------------------------------------------------------------------
   Model tangent of surface tension: the sums against loops written here, fields
   for which they are exact, and what is counted.
------------------------------------------------------------------------- */

#include "drops.h"
#include "patch.h"

#include <gtest/gtest.h>

#include <Eigen/Dense>

#include <algorithm>
#include <cmath>

using namespace aleisph;
using namespace aleisph_test;

namespace {

using Vec3 = Eigen::Vector3d;

// Sums of some ten to hundred terms and the inverse of a well conditioned 2x2 matrix
constexpr double ROUNDING = 1.0e-12;

Kernel spline(int dim)
{
  return Kernel(KernelType::CUBIC_SPLINE, dim, H);
}

double cell(int dim)
{
  return std::pow(D, dim);
}

Vec3 vec(const std::vector<double> &v, int i)
{
  return Vec3::Map(&v[3 * i]);
}

// orthonormal vectors across N
Eigen::MatrixXd frame(const Vec3 &N, int dim)
{
  const Vec3 first = dim == 2 ? Vec3(-N[1], N[0], 0.0) : N.unitOrthogonal();
  const Vec3 second = N.cross(first);
  Eigen::MatrixXd t(3, dim - 1);
  for (int a = 0; a < 3; a++) {
    t(a, 0) = first[a];
    if (dim == 3) t(a, 1) = second[a];
  }
  return t;
}

// steps 2 and 3 in the frame of the tangent plane
double curvature_in_frame(const Patch &p, int i)
{
  const int m = p.cloud.dim() - 1;
  const Kernel kernel = spline(p.cloud.dim());
  const Vec3 Ni = p.normal(i);
  const Eigen::MatrixXd t = frame(Ni, p.cloud.dim());
  Eigen::MatrixXd turn = Eigen::MatrixXd::Zero(m, m), moment = turn;
  for (int j = 0; j < p.points.total(); j++) {
    if (j == i || (p.cloud.role()[j] & (SURFACE | BALLISTIC)) != SURFACE) continue;
    if (Ni.dot(p.normal(j)) <= 0.3) continue;
    const Vec3 r = Eigen::Map<const Vec3>(p.points.point(i).data()) -
        Eigen::Map<const Vec3>(p.points.point(j).data());
    const Vec3 grad_w = kernel.dw(r.norm()) / r.norm() * r;
    turn += cell(p.cloud.dim()) * t.transpose() * (p.normal(j) - Ni) * grad_w.transpose() * t;
    moment -= cell(p.cloud.dim()) * t.transpose() * grad_w * r.transpose() * t;
  }
  const Eigen::MatrixXd A = turn * moment.inverse();
  const Eigen::VectorXd k =
      Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd>(0.5 * (A + A.transpose())).eigenvalues();
  double K = 0.0;
  for (int a = 0; a < m; a++)
    K += k[a] < -2.0 / (3.0 * D) ? -1.0 / D : k[a] / (1.0 + 0.5 * D * k[a]);
  return K;
}

}    // namespace

class TangentTest : public testing::TestWithParam<int> {
 protected:
  int dim_ = GetParam();
};

// Against a loop over all pairs, with walls left out
TEST_P(TangentTest, WideGradientSumsOverFluidAlone)
{
  const Kernel wide = wide_kernel(dim_, D);
  EXPECT_DOUBLE_EQ(wide.support(), 4.8 * D);
  const Points points = block(dim_, 4, 3).points();
  const int n = static_cast<int>(points.size());
  const PointSet far(points, n, wide.support(), 1);
  std::vector<Role> role(n, FLUID | SURFACE);
  for (int j = 0; j < n; j += 4) role[j] = j % 8 == 0 ? WALL : WALL | FLUID;
  const Cloud cloud = make_cloud(spline(dim_), D, far, {role});
  WideStencil s(dim_, D);
  s.build(cloud, far.x(), far.list());
  std::vector<double> N(3 * n, 7.0);
  wide_gradient(cloud, s, {1, 2, 5}, N.data());
  for (int i : {1, 2, 5}) {
    Vec3 G = Vec3::Zero();
    for (int j = 0; j < n; j++) {
      const Vec3 r = Vec3::Map(points[i].data()) - Vec3::Map(points[j].data());
      if (j != i && !(role[j] & WALL)) G += cell(dim_) * wide.dw(r.norm()) / r.norm() * r;
    }
    EXPECT_LT((vec(N, i) + G).norm(), ROUNDING / D) << i;
  }
  EXPECT_EQ(vec(N, 3), Vec3(7.0, 7.0, 7.0)) << "not a row";
}

// In the middle of a lattice the terms cancel but for rounding, which must give no direction
TEST_P(TangentTest, NoDirectionIsCounted)
{
  const Points points = lattice(dim_, 5, D);
  const PointSet far(points, static_cast<int>(points.size()), 4.8 * D);
  const Cloud cloud = make_cloud(spline(dim_), D, far,
                                 {std::vector<Role>(points.size(), FLUID | SURFACE)});
  WideStencil s(dim_, D);
  s.build(cloud, far.x(), far.list());
  std::vector<double> N(3 * points.size(), 7.0);
  const int corner = far.owned() - 1;
  wide_gradient(cloud, s, {0, corner}, N.data());
  EXPECT_EQ(normalise({0, corner}, N.data()), 1);
  EXPECT_EQ(vec(N, 0), Vec3(0.0, 0.0, 0.0));
  EXPECT_NEAR(vec(N, corner).norm(), 1.0, ROUNDING);
}

TEST_P(TangentTest, CurvatureAgreesWithAFrameInTheTangentPlane)
{
  for (unsigned seed = 1; seed < 4; seed++) {
    Patch patch = random_patch(dim_, seed);
    const CurvatureCount count = patch.curvature();
    int known = 0;
    for (int i : patch.points.rows()) {
      if (patch.known[i] == 0.0) continue;
      const double K = curvature_in_frame(patch, i);
      // the bracket is at least 0.02 where it is inverted
      EXPECT_NEAR(patch.K[i], K, ROUNDING / 0.02 * std::max(1.0 / D, std::abs(K))) << i;
      known++;
    }
    EXPECT_EQ(known + count.few + count.unknown, patch.points.total());
    EXPECT_GT(known, patch.points.total() / 2);
  }
}

// Particles of one layer with N_j = N_i + B r_ji: the brackets give B, whatever their places.
// Principal curvatures k and m k, normal turned along with the layer. A bends both ways (m = -1).
TEST_P(TangentTest, LinearTurnOfTheNormalIsExact)
{
  const double d = D;
  for (double m : {1.0, 0.0, -1.0})
    for (double k : {0.3 / d, 0.05 / d, -0.2 / d}) {
      Points points = keep(lattice(dim_, 4, d),
                           [this](const Point &p) { return p[dim_ - 1] == 0.0; });
      jitter(points, dim_ - 1, 0.2 * d, 7);
      Patch patch(dim_, PointSet(points, 1, 2.4 * d));
      for (int j = 0; j < patch.points.total(); j++) {
        Vec3 n = Vec3::Zero();
        n[0] = k * (points[j][0] - points[0][0]);
        if (dim_ == 3) n[1] = m * k * (points[j][1] - points[0][1]);
        n[dim_ - 1] = 1.0;
        patch.set_normal(j, n);
      }
      const CurvatureCount count = patch.curvature();
      const double second = dim_ == 3 ? m * k / (1.0 + 0.5 * d * m * k) : 0.0;
      EXPECT_NEAR(patch.K[0] * d, (k / (1.0 + 0.5 * d * k) + second) * d, ROUNDING) << k << m;
      EXPECT_EQ(count.few + count.unknown + count.limited, 0);
    }
}

// A layer bent to 1.5 d around a centre outside: that of the true surface would be d, the bound
TEST_P(TangentTest, HollowsAreBounded)
{
  const double line[] = {-0.6, -0.7, -1.9,
                         -2.1};    // k d: within the bound, beyond it, at the pole
  for (double k : line) {
    Points points = keep(lattice(dim_, 1, D),
                         [this](const Point &p) { return p[dim_ - 1] <= 0.0; });
    Patch patch(dim_, PointSet(points, 1, 1.1 * D));
    for (int j = 0; j < patch.points.total(); j++) {
      if (points[j][dim_ - 1] < 0.0) patch.cloud.role()[j] = FLUID;
      Vec3 n = Vec3::Zero();
      n[0] = k / D * points[j][0];
      n[dim_ - 1] = 1.0;
      patch.set_normal(j, n);
    }
    const CurvatureCount count = patch.curvature();
    EXPECT_EQ(count.limited, k < -2.0 / 3.0 ? 1 : 0) << k;
    EXPECT_NEAR(patch.K[0] * D, k < -2.0 / 3.0 ? -1.0 : k / (1.0 + 0.5 * k), ROUNDING) << k;
  }
}

// Three fluid neighbours are wanted, and neighbours on the surface in all directions along it
TEST_P(TangentTest, FewAndUnknownAreCounted)
{
  const Points row = {{0.0, 0.0, 0.0}, {D, 0.0, 0.0}, {2.0 * D, 0.0, 0.0}, {3.0 * D, 0.0, 0.0}};
  Patch pair(dim_, PointSet({row[0], row[1], row[2]}, 3, 3.0 * D));
  for (int i = 0; i < 3; i++) pair.set_normal(i, Vec3::Unit(dim_ - 1));
  const CurvatureCount few = pair.curvature();
  EXPECT_EQ(few.few, 3);
  EXPECT_EQ(few.unknown, 0);

  // the first is 2.2 d from the second: enough neighbours, below it, but none along the surface
  const double x = 2.2 * D;
  Points points = {{0.0, 0.0, 0.0}, {x, 0.0, 0.0}};
  for (double dx : {-0.4, 0.0, 0.4}) {
    points.push_back({dx * D, dx * D, 0.0});
    points.back()[dim_ - 1] = -D;
  }
  Patch lone(dim_, PointSet(points, 1, 2.4 * D));
  for (int i = 0; i < 5; i++) lone.set_normal(i, Vec3::Unit(dim_ - 1));
  for (int i = 2; i < 5; i++) lone.cloud.role()[i] = FLUID;
  EXPECT_EQ(lone.curvature().unknown, 1);
  EXPECT_EQ(lone.known[0], 0.0);
  EXPECT_EQ(lone.K[0], 0.0);

  lone.cloud.role()[2] |= SURFACE;
  lone.set_normal(0, Vec3::Zero());
  EXPECT_EQ(lone.curvature().unknown, 1) << "no normal";
}

// Weights 1, 1 - 1/2.4, 1 - 2/2.4 in a row of three with one particle below; only what is known,
// on the surface and of like normal counts
TEST_P(TangentTest, MeanOverTheSurface)
{
  Points points = {{0.0, 0.0, 0.0}, {D, 0.0, 0.0}, {2.0 * D, 0.0, 0.0}, {D, 0.0, 0.0}};
  points[3][dim_ - 1] = -D;
  Patch patch(dim_, PointSet(points, 4, 2.4 * D));
  patch.cloud.role()[3] = FLUID;
  for (int i = 0; i < 4; i++) patch.set_normal(i, Vec3::Unit(dim_ - 1));
  patch.K = {0.1 / D, 0.4 / D, 0.2 / D, 9.0 / D};
  const double w1 = 1.0 - 1.0 / 2.4, w2 = 1.0 - 2.0 / 2.4;
  const auto mean = [&patch](const std::vector<double> &known, int &limited) {
    std::vector<double> out(4, -1.0);
    limited = smooth_curvature(patch.cloud, {0, 1, 2}, patch.N.data(), patch.K.data(), known.data(),
                               out.data());
    for (double &K : out) K *= D;
    return out;
  };
  int limited = 0;
  const auto all = mean({1.0, 1.0, 1.0, 1.0}, limited);
  EXPECT_NEAR(all[0], (0.1 + w1 * 0.4 + w2 * 0.2) / (1.0 + w1 + w2), ROUNDING);
  EXPECT_NEAR(all[1], (0.4 + w1 * 0.3) / (1.0 + 2.0 * w1), ROUNDING);
  const auto some = mean({1.0, 0.0, 1.0, 1.0}, limited);
  EXPECT_NEAR(some[1], 0.15, ROUNDING) << "from its neighbours";
  EXPECT_NEAR(some[0], (0.1 + w2 * 0.2) / (1.0 + w2), ROUNDING);
  EXPECT_EQ(mean({0.0, 0.0, 0.0, 1.0}, limited), std::vector<double>({0.0, 0.0, 0.0, -D}));

  patch.set_normal(0, -Vec3::Unit(dim_ - 1));    // the other side of a film
  EXPECT_NEAR(mean({1.0, 1.0, 1.0, 1.0}, limited)[0], 0.1, ROUNDING);
  EXPECT_EQ(limited, 0);
  patch.K = {0.0, -4.0 / D, 0.0, 0.0};
  EXPECT_NEAR(mean({1.0, 1.0, 1.0, 1.0}, limited)[1], -1.0, ROUNDING);
  EXPECT_EQ(limited, 2) << "K = -4/(1 + w1) of 1, -4 w1/(1 + w1) of 2";
}

// A particle with one neighbour counts as having too few: K = 0 whatever the neighbour has
TEST_P(TangentTest, IsolatedParticlesHaveNoCurvature)
{
  Patch patch(dim_, PointSet({{0.0, 0.0, 0.0}, {D, 0.0, 0.0}}, 2, 2.4 * D));
  for (int i = 0; i < 2; i++) patch.set_normal(i, Vec3::Unit(dim_ - 1));
  CurvatureCount count = patch.curvature();
  EXPECT_EQ(count.few, 2);
  patch.known = {0.0, 1.0};
  patch.K = {0.0, 0.5 / D};
  std::vector<double> mean(2, -1.0);
  smooth_curvature(patch.cloud, {0, 1}, patch.N.data(), patch.K.data(), patch.known.data(),
                   mean.data());
  EXPECT_EQ(mean, std::vector<double>({0.0, 0.0}));

  Points points = lattice(dim_, 3, D);
  points.push_back({8.0 * D, 0.0, 0.0});
  const Drop drop(dim_, D, points);
  EXPECT_EQ(std::count(drop.surface().begin(), drop.surface().end(), drop.owned() - 1), 0);
}

INSTANTIATE_TEST_SUITE_P(Dimensions, TangentTest, testing::Values(2, 3));
