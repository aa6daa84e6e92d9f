// SPDX-License-Identifier: GPL-2.0-only
/* ----------------------------------------------------------------------
   Guards of the pressure gradient, and what they are for: the spectral
   radius of one pressure correction.
------------------------------------------------------------------------- */

#include "aleisph_vectors.h"
#include "projection.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <memory>

using namespace aleisph;
using namespace aleisph_test;

namespace {

using Vec3 = Eigen::Vector3d;
using Field = std::vector<double>;

Vec3 e_ij(const Stencil &s, int k)
{
  return Vec3(s.e(0)[k], s.e(1)[k], s.dim() == 3 ? s.e(2)[k] : 0.0);
}

Field random_pressure(const FreeSurfaceFlow &flow, unsigned seed)
{
  Field p = random_field(flow.size(), seed);
  for (double &value : p) value += 1.5;    // positive
  return p;
}

// the change of the gradient of all particles; rows: how many changed
struct Correction {
  Field change;
  int rows;
};

Correction correction(const FreeSurfaceFlow &flow, SelfTerm kind, const Field &p)
{
  Correction c = {Field(3 * p.size(), 0.0), 0};
  c.rows = flow.correct_self_term(kind, p.data(), c.change);
  return c;
}

/* ----------------------------------------------------------------------
   The formulas of the header written down again. g_ji is looked up in the
   row of j. S' is that S - sum alpha n, alpha >= 0, over some of the normals
   with S'.n <= 0 for all of them: Kuhn and Tucker's condition for the nearest
   vector.
------------------------------------------------------------------------- */

bool nonpositive(const Eigen::VectorXd &values, double tolerance)
{
  return values.size() == 0 || values.maxCoeff() <= tolerance;
}

Vec3 nearest_inward(const Vec3 &S, const std::vector<Vec3> &normals)
{
  const int m = static_cast<int>(normals.size());
  Eigen::MatrixXd N(3, m);
  for (int k = 0; k < m; k++) N.col(k) = normals[k];
  const double tolerance = 1e-12 * S.norm();
  for (unsigned subset = 0; subset < (1u << m); subset++) {
    Eigen::MatrixXd A(3, 0);
    for (int k = 0; k < m; k++) {
      if (!(subset >> k & 1u)) continue;
      A.conservativeResize(3, A.cols() + 1);
      A.col(A.cols() - 1) = N.col(k);
    }
    if (A.cols() > 3) continue;
    Vec3 nearest = S;
    if (A.cols() > 0) {
      const Eigen::VectorXd alpha = A.colPivHouseholderQr().solve(S);
      if (!nonpositive(-alpha, tolerance)) continue;
      nearest -= A * alpha;
    }
    if (nonpositive(N.transpose() * nearest, tolerance)) return nearest;
  }
  ADD_FAILURE() << "no nearest vector";
  return S;
}

void add_if_new(const Vec3 &n, std::vector<Vec3> &normals)
{
  for (const Vec3 &known : normals)
    if ((known - n).norm() < 1e-6) return;
  normals.push_back(n);
}

struct Row {
  Vec3 S = Vec3::Zero();
  double P = 0.0;
  bool near_surface = false;
};

Row row_of(const FreeSurfaceFlow &flow, int i)
{
  const Stencil &s = flow.s();
  Row row;
  std::vector<Vec3> normals;
  for (int k = s.begin(i); k < s.end(i); k++) {
    const int j = s.col()[k];
    const Vec3 g = pair_gradient(s, flow.g(), i, k);
    row.S += g;
    row.near_surface |= (flow.role()[j] & SURFACE) != 0;    // 2.4 d is the support
    if (flow.role()[j] & WALL) {
      row.P += g.squaredNorm();
      if (s.r()[k] < 1.7 * flow.scene().d) add_if_new(at(flow.normal(), j), normals);
      continue;
    }
    for (int m = s.begin(j); m < s.end(j); m++)
      if (s.col()[m] == i) row.P -= g.dot(pair_gradient(s, flow.g(), j, m));
  }
  row.S = nearest_inward(row.S, normals);
  return row;
}

double sigma_of(const FreeSurfaceFlow &flow, SelfTerm kind, int i)
{
  const Row row = row_of(flow, i);
  if ((flow.role()[i] & SURFACE) || !row.near_surface) return 1.0;
  const double S2 = row.S.squaredNorm(), c = S2 / row.P;
  const double sigma = 1.0 - 2.0 * std::clamp((c - 0.1) / 0.2, 0.0, 1.0);
  if (kind == SelfTerm::UNBOUNDED) return sigma;
  return std::max(sigma, std::min(0.0, (row.P - 0.17 * std::fabs(flow.l().diagonal(i))) / S2));
}

SplashParams shape(int dim)
{
  SplashParams params;
  params.width = dim == 2 ? 12 : 6;
  params.height = dim == 2 ? 12 : 7;
  return params;
}

}    // namespace

// Rounding: g is known to eps/lambda with lambda >= 0.2 (the floor), c is compared with edges of
// a continuous function.
TEST(SelfTerm, IsTheFormula)
{
  for (int dim : {2, 3})
    for (SelfTerm kind : {SelfTerm::UNBOUNDED, SelfTerm::BOUNDED})
      for (unsigned seed = 1; seed <= (dim == 2 ? 10 : 2); seed++) {
        const FreeSurfaceFlow flow(splash(dim, shape(dim), seed));
        const Field p = random_pressure(flow, seed);
        const Correction c = correction(flow, kind, p);
        int changed = 0;
        for (int i : flow.fluid()) {
          const double sigma = sigma_of(flow, kind, i);
          const Vec3 expected = (1.0 - sigma) * p[i] * row_of(flow, i).S;
          EXPECT_LT((at(c.change.data(), i) - expected).norm() * D, 1e-11)
              << dim << "d, seed " << seed << ", row " << i;
          changed += sigma < 1.0;
        }
        EXPECT_GT(changed, 0);
        EXPECT_EQ(c.rows, changed);
      }
}

// the bound acts in some of these clouds, and only weakens the correction
TEST(SelfTerm, BoundOnlyWeakens)
{
  int weaker = 0;
  for (unsigned seed = 1; seed <= 30; seed++) {
    const FreeSurfaceFlow flow(splash(2, shape(2), seed));
    const Field p = random_pressure(flow, seed);
    const Correction full = correction(flow, SelfTerm::UNBOUNDED, p);
    const Correction bounded = correction(flow, SelfTerm::BOUNDED, p);
    EXPECT_EQ(full.rows, bounded.rows);
    for (int i : flow.fluid()) {
      const double ratio = at(bounded.change.data(), i).norm() /
          std::max(at(full.change.data(), i).norm(), 1e-300);
      EXPECT_LE(ratio, 1.0 + 1e-14);
      if (at(full.change.data(), i).norm() > 0.0) {
        EXPECT_GE(ratio, 0.5 - 1e-14);    // sigma from -1 to 0
        weaker += ratio < 0.99;
      }
    }
  }
  EXPECT_GT(weaker, 0);
}

// A positive pressure must not be turned into a push into a wall: -grad p changes outward only.
TEST(SelfTerm, NoPushIntoWalls)
{
  int next_to_wall = 0;
  for (int dim : {2, 3})
    for (unsigned seed = 11; seed <= (dim == 2 ? 30 : 13); seed++) {
      const FreeSurfaceFlow flow(splash(dim, shape(dim), seed));
      const Correction c = correction(flow, SelfTerm::BOUNDED, random_pressure(flow, seed));
      const Stencil &s = flow.s();
      for (int i : flow.fluid()) {
        const Vec3 change = at(c.change.data(), i);
        for (int k = s.begin(i); k < s.end(i); k++) {
          if (!(flow.role()[s.col()[k]] & WALL) || s.r()[k] >= 1.7 * D) continue;
          EXPECT_LE(change.dot(at(flow.normal(), s.col()[k])), 1e-11 * change.norm());
          next_to_wall += change.norm() > 0.0;
        }
      }
    }
  EXPECT_GT(next_to_wall, 100);
}

// Rows without a surface neighbour keep their gradient to the bit, however irregular they are.
TEST(SelfTerm, BulkIsUntouched)
{
  for (int dim : {2, 3}) {
    const FreeSurfaceFlow flow(open_tank(dim, dim == 2 ? 12 : 8, 12, dim == 2 ? 9 : 6, 0.3, 5));
    const Correction c = correction(flow, SelfTerm::BOUNDED, random_pressure(flow, 1));
    int bulk = 0, large = 0;
    for (int i : flow.fluid()) {
      const Row row = row_of(flow, i);
      if (row.near_surface) continue;
      EXPECT_EQ(at(c.change.data(), i), Vec3::Zero());
      bulk++;
      large += row.S.squaredNorm() > 0.1 * row.P;    // so it is the neighbours that decide
    }
    EXPECT_GT(bulk, 10);
    EXPECT_GT(large, 0);
  }
}

// |S|^2/P, at most 0.06 in 2d and 0.08 in 3d with jitter 0.1 d, stays below the threshold 0.1
// next to a flat surface: hydrostatics keep their exact gradient.
TEST(SelfTerm, HydrostaticsStayExact)
{
  for (int dim : {2, 3})
    for (double jitter : {0.0, 0.05, 0.1})
      for (unsigned seed = 1; seed <= (jitter == 0.0 ? 1 : 3); seed++) {
        const FreeSurfaceFlow flow(
            open_tank(dim, dim == 2 ? 12 : 8, 12, dim == 2 ? 8 : 6, jitter, seed));
        Field p;
        for (const Point &x : flow.scene().points) p.push_back(1.0 - x[dim - 1]);
        Field grad = flow.gradient(p.data());
        EXPECT_EQ(flow.correct_self_term(SelfTerm::BOUNDED, p.data(), grad), 0);
        for (int i : flow.fluid())
          for (int a = 0; a < 3; a++)
            EXPECT_NEAR(grad[3 * i + a], a == dim - 1 ? -1.0 : 0.0, 1e-12);
      }
}

// what the default of `response` is to be compared with
TEST(SelfTerm, ResponseOnTheLattice)
{
  for (int dim : {2, 3}) {
    const FreeSurfaceFlow flow(closed_box(dim, dim == 2 ? 12 : 10));
    for (int i : flow.fluid()) {
      const Point &x = flow.scene().points[i];
      if (std::fabs(x[0] - 0.5) + std::fabs(x[1] - 0.5) > 1e-9) continue;
      if (dim == 3 && std::fabs(x[2] - 0.5) > 1e-9) continue;
      const Row row = row_of(flow, i);
      EXPECT_LT(row.S.norm() * flow.scene().d, 1e-12);
      EXPECT_NEAR(row.P / std::fabs(flow.l().diagonal(i)), dim == 2 ? 0.11 : 0.06, 0.005);
    }
  }
}

/* ----------------------------------------------------------------------
   symmetric form
------------------------------------------------------------------------- */

// every pair force is opposite and equal, for all particles alike
TEST(SymmetricGradient, ConservesMomentum)
{
  for (int dim : {2, 3}) {
    const PointSet cloud = block(dim, dim == 2 ? 6 : 3, 3);
    const Kernel kernel(KernelType::CUBIC_SPLINE, dim, H);
    const Discrete op(kernel, D, cloud);
    const Field p = random_field(cloud.total(), 5);
    Field grad(3 * p.size(), 0.0);
    const int rows = symmetric_gradient(op.cloud(), cloud.rows(), 2.0, p.data(), grad.data());
    EXPECT_EQ(rows, cloud.owned());
    Vec3 sum = Vec3::Zero();
    double size = 0.0;
    for (int i = 0; i < rows; i++) {
      sum += at(grad.data(), i);
      size += at(grad.data(), i).norm();
    }
    EXPECT_GT(size * D, 1.0);
    EXPECT_LT(sum.norm(), 1e-14 * size);
  }
}

TEST(SymmetricGradient, ReplacesRowsBelowTheLimitOnly)
{
  const FreeSurfaceFlow flow(splash(2, shape(2), 4));
  const Field p = random_pressure(flow, 4), before = flow.gradient(p.data());
  Field grad = before;
  const int rows = symmetric_gradient(flow.cloud(), flow.fluid(), 0.35, p.data(), grad.data());
  int below = 0;
  for (int i : flow.fluid()) {
    Vec3 expected = at(before.data(), i);
    if (flow.g().lambda(i) < 0.35) {
      below++;
      expected = Vec3::Zero();
      for (int k = flow.s().begin(i); k < flow.s().end(i); k++)
        expected += flow.volume() * flow.s().dw()[k] * (p[i] + p[flow.s().col()[k]]) *
            e_ij(flow.s(), k);
    }
    EXPECT_LT((at(grad.data(), i) - expected).norm() * D, 1e-14);
  }
  EXPECT_EQ(rows, below);
  EXPECT_GT(below, 5);
}

/* ----------------------------------------------------------------------
   Spectral radius of P = I - G A^-1 D. On a lattice it is 1: divergence-free
   velocities are kept, gradients removed. On ragged clouds the published
   self term makes it larger than 1; 1.02 is a factor 7 in 100 steps.
------------------------------------------------------------------------- */

namespace {

constexpr unsigned FIRST = 101;    // none of these was used to choose parameters

Field radii(int dim, const SplashParams &params, int count, SelfTerm kind, double surface_offset)
{
  Field r;
  for (unsigned seed = FIRST; seed < FIRST + count; seed++)
    r.push_back(spectral_radius(
        projection(FreeSurfaceFlow(splash(dim, params, seed)), kind, surface_offset)));
  return r;
}

double largest(const Field &r)
{
  return *std::max_element(r.begin(), r.end());
}

long growing(const Field &r)
{
  return std::count_if(r.begin(), r.end(), [](double radius) { return radius > 1.001; });
}

}    // namespace

TEST(SpectralRadius, OneOnALattice)
{
  for (int dim : {2, 3})
    for (SelfTerm kind : {SelfTerm::PUBLISHED, SelfTerm::BOUNDED}) {
      const FreeSurfaceFlow flow(open_tank(dim, dim == 2 ? 10 : 5, 10, dim == 2 ? 7 : 4));
      EXPECT_NEAR(spectral_radius(projection(flow, kind, 0.0)), 1.0, 1e-4);
    }
}

TEST(SpectralRadius, SelfTermStopsTheGrowth2d)
{
  SplashParams mild = shape(2), free = shape(2);
  mild.jitter = 0.15;
  free.walls = false;
  for (const SplashParams &params : {shape(2), mild, free})
    for (double surface_offset : {0.0, 0.5}) {
      const Field published = radii(2, params, 12, SelfTerm::PUBLISHED, surface_offset);
      const Field corrected = radii(2, params, 12, SelfTerm::BOUNDED, surface_offset);
      EXPECT_GE(growing(published), 6);
      EXPECT_GT(largest(published), 1.02);
      EXPECT_LE(growing(corrected), 1);
      EXPECT_LT(largest(corrected), 1.005);
    }
}

// Without the bound the correction overshoots in a few very ragged clouds.
TEST(SpectralRadius, BoundStopsTheOvershoot)
{
  SplashParams params;
  params.jitter = 0.35;
  for (unsigned seed : {5, 72, 111}) {
    const FreeSurfaceFlow flow(splash(2, params, seed));
    EXPECT_GT(spectral_radius(projection(flow, SelfTerm::UNBOUNDED, 0.0)), 1.3);
    EXPECT_LT(spectral_radius(projection(flow, SelfTerm::BOUNDED, 0.0)), 1.005);
  }
}

TEST(SpectralRadius, SelfTermStopsTheGrowth3d)
{
  SplashParams params;
  params.width = 5;
  params.height = 6;
  const Field published = radii(3, params, 5, SelfTerm::PUBLISHED, 0.5);
  const Field corrected = radii(3, params, 5, SelfTerm::BOUNDED, 0.5);
  EXPECT_GE(growing(published), 4);
  EXPECT_GT(largest(published), 1.02);
  EXPECT_LE(growing(corrected), 1);
  EXPECT_LT(largest(corrected), 1.01);    // 1.007, where walls slide with a few fluid particles
}
