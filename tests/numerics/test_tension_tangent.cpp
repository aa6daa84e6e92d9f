// SPDX-License-Identifier: GPL-2.0-only
/* ----------------------------------------------------------------------
   Curvature of free surfaces: the sums against loops written here, fields for
   which they are exact, and what is counted.
------------------------------------------------------------------------- */

#include "aleisph_tension_published.h"
#include "aleisph_tension_tangent.h"
#include "aleisph_vectors.h"
#include "drops.h"

#include <gtest/gtest.h>

#include <Eigen/Dense>

#include <algorithm>
#include <cmath>
#include <random>

using namespace aleisph;
using namespace aleisph_test;

namespace {

using Vec3 = Eigen::Vector3d;
using Mat3 = Eigen::Matrix3d;

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
  return Eigen::Map<const Vec3>(&v[3 * i]);
}

// A cloud whose particles are all fluid, on the surface or not, and its fields
struct Patch {
  Patch(int dim, PointSet all) :
      cloud(std::move(all)), role(cloud.total(), FLUID | SURFACE), N(3 * cloud.total()),
      K(cloud.total()), known(cloud.total())
  {
    s.build(spline(dim), cloud.owned(), cloud.x(), cloud.list());
  }
  CurvatureCount curvature()
  {
    return tangent_curvature(s, cloud.rows(), role.data(), N.data(), cell(s.dim()), K.data(),
                             known.data());
  }
  void set_normal(int i, const Vec3 &n) { Vec3::Map(&N[3 * i]) = n; }

  PointSet cloud;
  std::vector<Role> role;
  Stencil s;
  std::vector<double> N, K, known;
};

// In a jittered block, two thirds of the particles are on the surface, some are ballistic; normals
// of random direction but upward on the whole
Patch random_patch(int dim, unsigned seed)
{
  Patch patch(dim, block(dim, dim == 2 ? 5 : 3, seed));
  std::mt19937 random(seed);
  std::uniform_real_distribution<double> deviate(-1.0, 1.0);
  for (int i = 0; i < patch.cloud.total(); i++) {
    if (i % 3 == 0) patch.role[i] = FLUID;
    if (i % 11 == 0) patch.role[i] |= BALLISTIC;
    Vec3 n = 0.8 * Vec3(deviate(random), deviate(random), deviate(random));
    n[dim - 1] += 1.0;
    if (dim == 2) n[2] = 0.0;
    patch.set_normal(i, n.normalized());
  }
  return patch;
}

// two orthonormal vectors across N; in 2d the first alone is wanted
Eigen::Matrix<double, 3, 2> frame(const Vec3 &N, int dim)
{
  Eigen::Matrix<double, 3, 2> t;
  t.col(0) = dim == 2 ? Vec3(-N[1], N[0], 0.0) : N.unitOrthogonal();
  t.col(1) = N.cross(t.col(0));
  return t;
}

// steps 2 and 3 in the frame of the tangent plane
double curvature_in_frame(const Patch &p, int i)
{
  const int m = p.s.dim() - 1;
  const Kernel kernel = spline(p.s.dim());
  const Vec3 Ni = vec(p.N, i);
  const Eigen::MatrixXd t = frame(Ni, p.s.dim()).leftCols(m);
  Eigen::MatrixXd turn = Eigen::MatrixXd::Zero(m, m), moment = turn;
  for (int j = 0; j < p.cloud.total(); j++) {
    if (j == i || (p.role[j] & (SURFACE | BALLISTIC)) != SURFACE) continue;
    if (Ni.dot(vec(p.N, j)) <= 0.3) continue;
    const Vec3 r = Eigen::Map<const Vec3>(p.cloud.point(i).data()) -
        Eigen::Map<const Vec3>(p.cloud.point(j).data());
    const Vec3 grad_w = kernel.dw(r.norm()) / r.norm() * r;
    turn += cell(p.s.dim()) * t.transpose() * (vec(p.N, j) - Ni) * grad_w.transpose() * t;
    moment -= cell(p.s.dim()) * t.transpose() * grad_w * r.transpose() * t;
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

class TensionTest : public testing::TestWithParam<int> {
 protected:
  int dim_ = GetParam();
};

TEST_P(TensionTest, SurfaceRowsAreFluidOnTheSurfaceAndNotBallistic)
{
  const Role role[] = {FLUID, FLUID | SURFACE, FLUID | SURFACE | BALLISTIC, WALL | SURFACE,
                       FLUID | SURFACE | DIRICHLET};
  EXPECT_EQ(surface_rows({0, 1, 2, 3, 4}, role), Rows({1, 4}));
}

// Against a loop over all pairs, with walls left out
TEST_P(TensionTest, WideGradientSumsOverFluidAlone)
{
  const Kernel wide = wide_kernel(dim_, D);
  EXPECT_DOUBLE_EQ(wide.support(), 4.8 * D);
  const PointSet cloud = block(dim_, 4, 3);
  const PointSet far(cloud.points(), cloud.owned(), wide.support(), 1);
  std::vector<Role> role(cloud.total(), FLUID);
  for (int j = 0; j < cloud.total(); j += 4) role[j] = j % 8 == 0 ? WALL : WALL | FLUID;
  Stencil s;
  s.build(wide, far.owned(), far.x(), far.list());
  std::vector<double> N(3 * cloud.total(), 7.0);
  wide_gradient(s, {1, 2, 5}, role.data(), cell(dim_), N.data());
  for (int i : {1, 2, 5}) {
    Vec3 G = Vec3::Zero();
    for (int j = 0; j < cloud.total(); j++) {
      const Vec3 r = Eigen::Map<const Vec3>(cloud.point(i).data()) -
          Eigen::Map<const Vec3>(cloud.point(j).data());
      if (j != i && role[j] == FLUID) G += cell(dim_) * wide.dw(r.norm()) / r.norm() * r;
    }
    EXPECT_LT((vec(N, i) + G).norm(), ROUNDING / D) << i;
  }
  EXPECT_EQ(vec(N, 3), Vec3(7.0, 7.0, 7.0)) << "not a row";
}

// In the middle of a lattice the terms cancel but for rounding, which must give no direction
TEST_P(TensionTest, NoDirectionIsCounted)
{
  const Points points = lattice(dim_, 5, D);
  const PointSet cloud(points, static_cast<int>(points.size()), 4.8 * D);
  const std::vector<Role> role(points.size(), FLUID);
  Stencil s;
  s.build(wide_kernel(dim_, D), cloud.owned(), cloud.x(), cloud.list());
  std::vector<double> N(3 * points.size(), 7.0);
  const int corner = cloud.owned() - 1;
  wide_gradient(s, {0, corner}, role.data(), cell(dim_), N.data());
  EXPECT_EQ(normalise({0, corner}, N.data()), 1);
  EXPECT_EQ(vec(N, 0), Vec3(0.0, 0.0, 0.0));
  EXPECT_NEAR(vec(N, corner).norm(), 1.0, ROUNDING);
}

// The corrected gradient is exact for linear fields
TEST_P(TensionTest, EigenvalueGradientPointsDownALinearField)
{
  const Discrete field(spline(dim_), D, block(dim_, 3, 5));
  const PointSet cloud = block(dim_, 3, 5);
  const Vec3 slope(3.0, -2.0, dim_ == 3 ? 1.0 : 0.0);
  std::vector<double> N(3 * cloud.total());
  const auto lambda = sample(cloud, [&slope](const Point &x) {
    return 0.9 + slope.dot(Eigen::Map<const Vec3>(x.data()));
  });
  eigenvalue_gradient(field.s(), field.g(), cloud.rows(), lambda.data(), N.data());
  for (int i : cloud.rows())
    EXPECT_LT((vec(N, i) + slope).norm(), ROUNDING / D) << i;    // lambda is 1, known to eps
}

TEST_P(TensionTest, CurvatureAgreesWithAFrameInTheTangentPlane)
{
  for (unsigned seed = 1; seed < 4; seed++) {
    Patch patch = random_patch(dim_, seed);
    const CurvatureCount count = patch.curvature();
    int known = 0;
    for (int i : patch.cloud.rows()) {
      if (patch.known[i] == 0.0) continue;
      const double K = curvature_in_frame(patch, i);
      // the bracket is at least 0.02 where it is inverted
      EXPECT_NEAR(patch.K[i], K, ROUNDING / 0.02 * std::max(1.0 / D, std::abs(K))) << i;
      known++;
    }
    EXPECT_EQ(known + count.few + count.unknown, patch.cloud.total());
    EXPECT_GT(known, patch.cloud.total() / 2);
  }
}

// Particles of one layer with N_j = N_i + B r_ji: the brackets give B, whatever their places.
// Principal curvatures k and m k, normal turned along with the layer. A bends both ways (m = -1).
TEST_P(TensionTest, LinearTurnOfTheNormalIsExact)
{
  const double d = D;
  for (double m : {1.0, 0.0, -1.0})
    for (double k : {0.3 / d, 0.05 / d, -0.2 / d}) {
      Points points = keep(lattice(dim_, 4, d),
                           [this](const Point &p) { return p[dim_ - 1] == 0.0; });
      jitter(points, dim_ - 1, 0.2 * d, 7);
      Patch patch(dim_, PointSet(points, 1, 2.4 * d));
      for (int j = 0; j < patch.cloud.total(); j++) {
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
TEST_P(TensionTest, HollowsAreBounded)
{
  const double line[] = {-0.6, -0.7, -1.9,
                         -2.1};    // k d: within the bound, beyond it, at the pole
  for (double k : line) {
    Points points = keep(lattice(dim_, 1, D),
                         [this](const Point &p) { return p[dim_ - 1] <= 0.0; });
    Patch patch(dim_, PointSet(points, 1, 1.1 * D));
    for (int j = 0; j < patch.cloud.total(); j++) {
      if (points[j][dim_ - 1] < 0.0) patch.role[j] = FLUID;
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
TEST_P(TensionTest, FewAndUnknownAreCounted)
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
  for (int i = 2; i < 5; i++) lone.role[i] = FLUID;
  EXPECT_EQ(lone.curvature().unknown, 1);
  EXPECT_EQ(lone.known[0], 0.0);
  EXPECT_EQ(lone.K[0], 0.0);

  lone.role[2] |= SURFACE;
  lone.set_normal(0, Vec3::Zero());
  EXPECT_EQ(lone.curvature().unknown, 1) << "no normal";
}

// Weights 1, 1 - 1/2.4, 1 - 2/2.4 in a row of three with one particle below; only what is known,
// on the surface and of like normal counts
TEST_P(TensionTest, MeanOverTheSurface)
{
  Points points = {{0.0, 0.0, 0.0}, {D, 0.0, 0.0}, {2.0 * D, 0.0, 0.0}, {D, 0.0, 0.0}};
  points[3][dim_ - 1] = -D;
  Patch patch(dim_, PointSet(points, 4, 2.4 * D));
  patch.role[3] = FLUID;
  for (int i = 0; i < 4; i++) patch.set_normal(i, Vec3::Unit(dim_ - 1));
  patch.K = {0.1 / D, 0.4 / D, 0.2 / D, 9.0 / D};
  const double w1 = 1.0 - 1.0 / 2.4, w2 = 1.0 - 2.0 / 2.4;
  const auto mean = [&patch](const std::vector<double> &known, CurvatureCount &count) {
    std::vector<double> out(4, -1.0);
    smooth_curvature(patch.s, {0, 1, 2}, patch.role.data(), patch.N.data(), patch.K.data(),
                     known.data(), D, out.data(), count);
    for (double &K : out) K *= D;
    return out;
  };
  CurvatureCount count;
  const auto all = mean({1.0, 1.0, 1.0, 1.0}, count);
  EXPECT_NEAR(all[0], (0.1 + w1 * 0.4 + w2 * 0.2) / (1.0 + w1 + w2), ROUNDING);
  EXPECT_NEAR(all[1], (0.4 + w1 * 0.3) / (1.0 + 2.0 * w1), ROUNDING);
  const auto some = mean({1.0, 0.0, 1.0, 1.0}, count);
  EXPECT_NEAR(some[1], 0.15, ROUNDING) << "from its neighbours";
  EXPECT_NEAR(some[0], (0.1 + w2 * 0.2) / (1.0 + w2), ROUNDING);
  EXPECT_EQ(mean({0.0, 0.0, 0.0, 1.0}, count), std::vector<double>({0.0, 0.0, 0.0, -D}));

  patch.set_normal(0, -Vec3::Unit(dim_ - 1));    // the other side of a film
  EXPECT_NEAR(mean({1.0, 1.0, 1.0, 1.0}, count)[0], 0.1, ROUNDING);
  EXPECT_EQ(count.limited, 0);
  patch.K = {0.0, -4.0 / D, 0.0, 0.0};
  EXPECT_NEAR(mean({1.0, 1.0, 1.0, 1.0}, count)[1], -1.0, ROUNDING);
  EXPECT_EQ(count.limited, 2) << "K = -4/(1 + w1) of 1, -4 w1/(1 + w1) of 2";
}

// A particle with one neighbour counts as having too few: K = 0 whatever the neighbour has
TEST_P(TensionTest, IsolatedParticlesHaveNoCurvature)
{
  Patch patch(dim_, PointSet({{0.0, 0.0, 0.0}, {D, 0.0, 0.0}}, 2, 2.4 * D));
  for (int i = 0; i < 2; i++) patch.set_normal(i, Vec3::Unit(dim_ - 1));
  CurvatureCount count = patch.curvature();
  EXPECT_EQ(count.few, 2);
  patch.known = {0.0, 1.0};
  patch.K = {0.0, 0.5 / D};
  std::vector<double> mean(2, -1.0);
  smooth_curvature(patch.s, {0, 1}, patch.role.data(), patch.N.data(), patch.K.data(),
                   patch.known.data(), D, mean.data(), count);
  EXPECT_EQ(mean, std::vector<double>({0.0, 0.0}));

  Points points = lattice(dim_, 3, D);
  points.push_back({8.0 * D, 0.0, 0.0});
  const Drop drop(dim_, D, points);
  EXPECT_EQ(std::count(drop.surface().begin(), drop.surface().end(), drop.owned() - 1), 0);
}

// eq 27 against a loop; K = (dim - 1) kappa, bounded by 1/d
TEST_P(TensionTest, PublishedCurvatureIsTheSumOverTheSurface)
{
  const Patch patch = random_patch(dim_, 4);
  const Discrete field(spline(dim_), D, patch.cloud);
  std::vector<double> K(patch.cloud.total(), 0.0);
  const CurvatureCount count = published_curvature(field.s(), field.g(), patch.cloud.rows(),
                                                   patch.role.data(), patch.N.data(), 0.41, D,
                                                   K.data());
  int limited = 0;
  for (int i : patch.cloud.rows()) {
    double kappa = 0.0;
    for (int k = field.s().begin(i); k < field.s().end(i); k++) {
      const int j = field.s().col()[k];
      if ((patch.role[j] & (SURFACE | BALLISTIC)) != SURFACE) continue;
      for (int a = 0; a < dim_; a++)
        kappa += 0.41 * (patch.N[3 * j + a] - patch.N[3 * i + a]) *
            pair_gradient(field.s(), field.g(), i, k)[a];
    }
    const double expected = (dim_ - 1) * kappa;
    limited += std::abs(expected) > 1.0 / D;
    EXPECT_NEAR(K[i] * D, std::clamp(expected * D, -1.0, 1.0), ROUNDING) << i;
  }
  EXPECT_EQ(count.limited, limited);
  EXPECT_EQ(count.few, 0);
}

// v = A x: N.A.N
TEST_P(TensionTest, NormalStrain)
{
  Mat3 A;
  A << 1.0, 2.0, 3.0, -4.0, 5.0, 6.0, 7.0, 8.0, -9.0;
  const Eigen::Matrix<double, 3, 3, Eigen::RowMajor> rows = A;
  Vec3 n(0.6, -0.8, 0.0);
  if (dim_ == 3) n = Vec3(2.0, -1.0, 2.0) / 3.0;
  EXPECT_NEAR(normal_strain(n.data(), rows.data(), dim_), n.dot(A * n), ROUNDING);
}

INSTANTIATE_TEST_SUITE_P(Dimensions, TensionTest, testing::Values(2, 3));
