// SPDX-License-Identifier: GPL-2.0-only
/* ----------------------------------------------------------------------
   Gradient weights and the first-order operators: exactness on linear
   fields, an independent dense evaluation, the smallest eigenvalue,
   singular rows, slip walls.
------------------------------------------------------------------------- */

#include "aleisph_vectors.h"
#include "cloud.h"
#include "dense.h"

#include <gtest/gtest.h>

#include <cmath>

using namespace aleisph;
using namespace aleisph_test;

namespace {

Points affine_matrix(int dim)
{
  Points A = {{1.3, -0.7, 0.4}, {0.6, 2.1, -1.1}, {-0.9, 0.5, 0.8}};
  if (dim == 2)
    for (Point &row : A) row[2] = 0.0;    // nothing depends on z; v_z may depend on x, y
  return A;
}

// v = b + A x/D
std::vector<double> affine_field(const PointSet &cloud, const Points &A)
{
  return sample_vector(cloud, [&](const Point &p) {
    Point v = {0.3, -0.2, 0.1};
    for (int a = 0; a < 3; a++)
      for (int b = 0; b < 3; b++) v[a] += A[a][b] * p[b] / D;
    return v;
  });
}

}    // namespace

// Rounding: M is inverted with an error of eps/lambda, and lambda >= 0.09 in this sample;
// a few dozen terms of size 1/d are added.
TEST(Gradient, ExactForLinearFields)
{
  for (int dim : {2, 3})
    for (KernelType type : KERNELS)
      for (int planes = 0; planes <= dim; planes++)
        for (unsigned seed = 1; seed <= 20; seed++) {
          const Kernel kernel(type, dim, H);
          const PointSet cloud = one_row(kernel, planes, 0.2 * D, seed);
          const Discrete op(kernel, D, cloud);
          const Point c = {1.7, -0.6, dim == 3 ? 0.9 : 0.0};
          const auto f = sample(cloud, [&](const Point &p) {
            return 4.0 + (c[0] * p[0] + c[1] * p[1] + c[2] * p[2]) / D;
          });
          double grad[3] = {7.0, 7.0, 7.0};
          gradient(op.cloud(), {0}, f.data(), grad);
          for (int a = 0; a < 3; a++)
            ASSERT_NEAR(grad[a] * D, c[a], 1e-12) << dim << "d, kernel " << static_cast<int>(type)
                                                  << ", " << SUPPORT[planes] << ", seed " << seed;
        }
}

TEST(Gradient, WeightsAgreeWithTheDenseEvaluation)
{
  for (int dim : {2, 3})
    for (KernelType type : KERNELS) {
      const Kernel kernel(type, dim, H);
      const PointSet cloud = block(dim, dim == 2 ? 4 : 2, 11);
      const Discrete op(kernel, D, cloud);
      for (int i = 0; i < cloud.owned(); i += 5) {
        const DenseRow row = dense_row(kernel, op.volume(), cloud, i);
        EXPECT_NEAR(op.g().lambda(i), row.lambda, 1e-14);
        for (int k = op.s().begin(i); k < op.s().end(i); k++)
          for (int a = 0; a < dim; a++)    // eps/lambda with lambda > 0.05
            EXPECT_NEAR(pair_gradient(op.s(), op.g(), i, k)[a] * D, row.g[op.s().col()[k]][a] * D,
                        1e-13);
      }
    }
}

TEST(Gradient, WritesTheListedRowsOnly)
{
  const Kernel kernel(KernelType::CUBIC_SPLINE, 3, H);
  const PointSet cloud = block(3, 2, 2);
  const Discrete op(kernel, D, cloud);
  const std::vector<double> f = random_field(cloud.total(), 1);
  std::vector<double> grad(3 * cloud.owned(), -77.0);
  gradient(op.cloud(), {3, 5}, f.data(), grad.data());
  for (int i = 0; i < cloud.owned(); i++)
    for (int a = 0; a < 3; a++) EXPECT_EQ(grad[3 * i + a] != -77.0, i == 3 || i == 5);
}

/* ----------------------------------------------------------------------
   lambda, the smallest eigenvalue of M. Reference: an independent
   prototype, cubic spline, h = 1.2 d; two digits are compared.
------------------------------------------------------------------------- */

TEST(Lambda, TellsBulkSurfaceEdgeAndCorner)
{
  const double expected[2][4] = {{0.991, 0.495, 0.292, 0.0}, {0.982, 0.491, 0.290, 0.230}};
  for (int dim : {2, 3}) {
    const Kernel kernel(KernelType::CUBIC_SPLINE, dim, H);
    for (int planes = 0; planes <= dim; planes++) {
      const Discrete op(kernel, D, one_row(kernel, planes, 0.0, 1));
      EXPECT_NEAR(op.g().lambda(0), expected[dim - 2][planes], 0.001) << SUPPORT[planes];
    }
    const PointSet second(cut(lattice(dim, 4, D), 1, 1.5 * D), 1, kernel.support());
    EXPECT_NEAR(Discrete(kernel, D, second).g().lambda(0), dim == 2 ? 0.934 : 0.941, 0.001);
  }
}

// The normal moment of a particle on a plane surface is one half of the bulk's, because
// the neighbours in the plane do not contribute to it: exact, for every kernel.
TEST(Lambda, FlatSurfaceIsHalfTheBulk)
{
  for (int dim : {2, 3})
    for (KernelType type : KERNELS) {
      const Kernel kernel(type, dim, H);
      const Discrete bulk(kernel, D, one_row(kernel, 0, 0.0, 1));
      const Discrete flat(kernel, D, one_row(kernel, 1, 0.0, 1));
      EXPECT_NEAR(flat.g().lambda(0), 0.5 * bulk.g().lambda(0), 1e-14);
    }
}

/* ----------------------------------------------------------------------
   Singular moments
------------------------------------------------------------------------- */

namespace {

// every row is singular: zero weights, zero gradient, counted; the Laplacian is Morris'
void expect_singular(int dim, const Points &points)
{
  const Kernel kernel(KernelType::CUBIC_SPLINE, dim, H);
  const int n = static_cast<int>(points.size());
  const PointSet cloud(points, n, 10.0 * D);
  const Discrete op(kernel, D, cloud);
  EXPECT_EQ(op.g().singular(), n);
  EXPECT_EQ(op.l().morris_count().lambda, n);
  EXPECT_EQ(op.l().morris_count().total(), n);
  for (int k = 0; k < GradientWeights::PACKED * n; k++) EXPECT_EQ(op.g().inverse()[k], 0.0);
  for (int k = 0; k < op.s().pairs(); k++) EXPECT_LT(op.l().a()[k], 0.0);
  const std::vector<double> f = random_field(3 * n, 3);
  std::vector<double> grad(3 * n, 7.0), lap(3 * n, 7.0);
  gradient(op.cloud(), cloud.rows(), f.data(), grad.data());
  laplacian(op.cloud(), cloud.rows(), f.data(), lap.data());
  for (int i = 0; i < n; i++) {
    EXPECT_NEAR(op.g().lambda(i), 0.0, 1e-15);
    EXPECT_TRUE(op.l().morris(i));
    for (int a = 0; a < 3; a++) {
      EXPECT_EQ(grad[3 * i + a], 0.0);
      EXPECT_TRUE(std::isfinite(lap[3 * i + a]));
    }
  }
}

}    // namespace

TEST(SingularRows, OneParticleAlone)
{
  for (int dim : {2, 3}) {
    expect_singular(dim, {{0.1, 0.2, 0.0}});
    const Kernel kernel(KernelType::CUBIC_SPLINE, dim, H);
    const Discrete op(kernel, D, PointSet({{0.1, 0.2, 0.0}}, 1, D), LaplacianLimits());
    EXPECT_EQ(op.l().diagonal(0), 0.0);
    EXPECT_EQ(op.l().morris_count().lambda, 1);
  }
}

TEST(SingularRows, TwoParticlesAlone)
{
  for (int dim : {2, 3}) expect_singular(dim, {{0.0, 0.0, 0.0}, {0.7 * D, 0.4 * D, 0.0}});
}

TEST(SingularRows, ParticlesOnALine)
{
  Points points;
  for (int i = 0; i < 6; i++) points.push_back({0.7 * i * D, 0.3 * i * D, 0.0});
  expect_singular(2, points);
  for (int i = 0; i < 6; i++) points[i][2] = 0.45 * i * D;
  expect_singular(3, points);
}

TEST(SingularRows, ParticlesInAPlane)
{
  Points points = lattice(2, 2, D);
  jitter(points, 2, 0.2 * D, 9);
  for (Point &p : points) p[2] = 0.3 * p[0] - 0.2 * p[1];
  expect_singular(3, points);
}

TEST(SingularRows, OthersAreNotAffected)
{
  const Kernel kernel(KernelType::CUBIC_SPLINE, 2, H);
  Points points = lattice(2, 3, D);
  points.push_back({100.0 * D, 0.0, 0.0});
  const int n = static_cast<int>(points.size());
  const Discrete op(kernel, D, PointSet(points, n, kernel.support()));
  EXPECT_EQ(op.g().singular(), 1);
  EXPECT_EQ(op.g().lambda(n - 1), 0.0);
  EXPECT_GT(op.g().lambda(0), 0.98);
}

/* ----------------------------------------------------------------------
   Vector operators
------------------------------------------------------------------------- */

TEST(VectorOperators, ExactForLinearFields)
{
  for (int dim : {2, 3})
    for (KernelType type : KERNELS) {
      const Kernel kernel(type, dim, H);
      const PointSet cloud = block(dim, dim == 2 ? 4 : 2, 4);
      const Discrete op(kernel, D, cloud);
      const Points A = affine_matrix(dim);
      const auto v = affine_field(cloud, A);
      const auto c = random_field(3 * cloud.total(), 8);
      std::vector<double> div(cloud.owned()), conv(3 * cloud.owned()), rot(3 * cloud.owned());
      divergence(op.cloud(), cloud.rows(), v.data(), div.data());
      convection(op.cloud(), cloud.rows(), c.data(), v.data(), conv.data());
      curl(op.cloud(), cloud.rows(), v.data(), rot.data());
      const Point omega = {A[2][1] - A[1][2], A[0][2] - A[2][0], A[1][0] - A[0][1]};
      const double trace = A[0][0] + A[1][1] + (dim == 3 ? A[2][2] : 0.0);
      for (int i = 0; i < cloud.owned(); i++) {    // 1e-12: as for the gradient
        EXPECT_NEAR(div[i] * D, trace, 1e-12);
        for (int a = 0; a < 3; a++) {
          double exact = 0.0;
          for (int b = 0; b < dim; b++) exact += c[3 * i + b] * A[a][b];
          EXPECT_NEAR(conv[3 * i + a] * D, exact, 1e-12);
          EXPECT_NEAR(rot[3 * i + a] * D, omega[a], 1e-12);
        }
      }
    }
}

// In the plane the curl of (u, v, 0) has a z component only, that of (0, 0, w) lies in the plane
TEST(VectorOperators, CurlInThePlane)
{
  const Kernel kernel(KernelType::CUBIC_SPLINE, 2, H);
  const PointSet cloud = block(2, 4, 4);
  const Discrete op(kernel, D, cloud);
  auto v = random_field(3 * cloud.total(), 5), w = v;
  for (int j = 0; j < cloud.total(); j++) v[3 * j + 2] = w[3 * j] = w[3 * j + 1] = 0.0;
  std::vector<double> rot_v(3 * cloud.owned()), rot_w(3 * cloud.owned());
  curl(op.cloud(), cloud.rows(), v.data(), rot_v.data());
  curl(op.cloud(), cloud.rows(), w.data(), rot_w.data());
  for (int i = 0; i < cloud.owned(); i++) {
    EXPECT_EQ(rot_v[3 * i], 0.0);
    EXPECT_EQ(rot_v[3 * i + 1], 0.0);
    EXPECT_NE(rot_v[3 * i + 2], 0.0);
    EXPECT_NE(rot_w[3 * i], 0.0);
    EXPECT_NE(rot_w[3 * i + 1], 0.0);
    EXPECT_EQ(rot_w[3 * i + 2], 0.0);
  }
}

// Random fields, so that nothing cancels. Sums of up to 200 terms of size up to 5/d: the
// tolerance 1e-12/d is a few thousand eps.
TEST(VectorOperators, AgreeWithTheDenseEvaluation)
{
  for (int dim : {2, 3}) {
    const Kernel kernel(KernelType::QUINTIC_SPLINE, dim, H);
    const PointSet cloud = block(dim, dim == 2 ? 4 : 2, 6);
    const Discrete op(kernel, D, cloud);
    const auto v = random_field(3 * cloud.total(), 1), c = random_field(3 * cloud.total(), 2);
    const int n = cloud.owned();
    std::vector<double> grad(3 * n), div(n), conv(3 * n), rot(3 * n);
    gradient(op.cloud(), cloud.rows(), v.data(), grad.data());
    divergence(op.cloud(), cloud.rows(), v.data(), div.data());
    convection(op.cloud(), cloud.rows(), c.data(), v.data(), conv.data());
    curl(op.cloud(), cloud.rows(), v.data(), rot.data());
    for (int i = 0; i < n; i += 7) {
      const DenseRow row = dense_row(kernel, op.volume(), cloud, i);
      double dense_div = 0.0;
      Point dense_grad = {}, dense_conv = {}, dense_rot = {};
      for (int j = 0; j < cloud.total(); j++) {
        const Point &g = row.g[j];
        double dv[3];
        for (int a = 0; a < 3; a++) dv[a] = v[3 * j + a] - v[3 * i + a];
        for (int a = 0; a < 3; a++) {
          const int b = (a + 1) % 3, e = (a + 2) % 3;
          dense_grad[a] += g[a] * (v[j] - v[i]);
          dense_div += g[a] * dv[a];
          for (int q = 0; q < 3; q++) dense_conv[a] += c[3 * i + q] * g[q] * dv[a];
          dense_rot[a] += g[b] * dv[e] - g[e] * dv[b];
        }
      }
      EXPECT_NEAR(div[i] * D, dense_div * D, 1e-12);
      for (int a = 0; a < 3; a++) {
        EXPECT_NEAR(grad[3 * i + a] * D, dense_grad[a] * D, 1e-12);
        EXPECT_NEAR(conv[3 * i + a] * D, dense_conv[a] * D, 1e-12);
        EXPECT_NEAR(rot[3 * i + a] * D, dense_rot[a] * D, 1e-12);
      }
    }
  }
}

// a plane slip wall may slide along itself at any speed without being felt
TEST(SlipWall, TangentialVelocityIsNotFelt)
{
  const Kernel kernel(KernelType::CUBIC_SPLINE, 3, H);
  const PointSet cloud(cut(lattice(3, 4, D), 1, 1.5 * D), 1, kernel.support());    // wall: x = d
  Discrete op(kernel, D, cloud);
  std::vector<Role> role(cloud.total(), FLUID);
  std::vector<double> normal(3 * cloud.total(), 0.0), v(3 * cloud.total(), 0.0);
  for (int j = 0; j < cloud.total(); j++) {
    if (cloud.point(j)[0] < 0.5 * D) continue;
    role[j] = WALL | SLIP;
    normal[3 * j] = -1.0;
    v[3 * j + 1] = 1000.0 * std::sin(j);
    v[3 * j + 2] = 1000.0 * std::cos(j);
  }
  set_particles(op.cloud(), role, normal);
  const std::vector<double> c = {1.0, 2.0, 3.0};
  double out[3];
  convection(op.cloud(), {0}, c.data(), v.data(), out);    // as if it did not slip
  EXPECT_GT(std::fabs(out[1]) * D, 1.0);
  for (int j = 0; j < cloud.total(); j++)
    if (role[j] & SLIP) std::fill_n(&v[3 * j], 3, 0.0);    // as the fluid, which is at rest
  convection(op.cloud(), {0}, c.data(), v.data(), out);
  for (double value : out) EXPECT_EQ(value, 0.0);
}
