// SPDX-License-Identifier: GPL-2.0-only
/* ----------------------------------------------------------------------
   Normals and curvature. The tangent plane of i enters as the projector
   P = 1 - N (x) N (- z (x) z in 2d), so that both dimensions and all
   directions are treated alike and no frame has to be chosen.
------------------------------------------------------------------------- */

#include "aleisph_tension.h"

#include "aleisph_vectors.h"
#include <Eigen/Dense>
#include <algorithm>
#include <cmath>

namespace aleisph {
namespace {

using Vec3 = Eigen::Vector3d;
using Mat3 = Eigen::Matrix3d;

// A sum shorter than this part of the sum of the moduli of its terms has no direction.
constexpr double NO_DIRECTION = 1.0e-6;

// The second bracket along a direction t of the tangent plane, -sum V dW/dr (r_ij.t)^2/r_ij, has no
// unit. With the cubic spline and h = 1.2 d it is 0.58 on a straight line (2d) and on a flat square
// layer of particles (3d); 0.25 and 0.14 for a single neighbour at d, 0.044 and 0.026 at 2 d. It
// falls to 0.02 at 2.1 d, so below there is nothing in that direction but on the brim.
constexpr double MIN_BRACKET = 0.02;

constexpr int FEW = 3;
constexpr double MEAN_REACH = 2.4;    // of the averaging, in spacings

inline bool is_fluid(Role role)
{
  return (role & FLUID) && !(role & WALL);
}

bool few_neighbours(const Stencil &s, const Role *role, int i)
{
  const int *col = s.col();
  return std::count_if(col + s.begin(i), col + s.end(i),
                       [role](int j) { return is_fluid(role[j]); }) < FEW;
}

// sum of vectors that is zero where only rounding or cancellation is left
class Direction {
 public:
  void add(const Vec3 &term)
  {
    sum_ += term;
    moduli_ += term.norm();
  }
  void store(double *v, int i) const
  {
    const bool none = !(sum_.norm() > NO_DIRECTION * moduli_);
    Eigen::Map<Vec3>(v + 3 * i) = none ? Vec3(Vec3::Zero()) : sum_;
  }

 private:
  Vec3 sum_ = Vec3::Zero();
  double moduli_ = 0.0;
};

// The brackets of step 2. Neighbours are added with r_ij, gradW_ij and N_j.
class Brackets {
 public:
  Brackets(const Vec3 &N, int dim) : N_(N), others_(N * N.transpose())
  {
    if (dim == 2) others_(2, 2) += 1.0;
    tangent_ = Mat3::Identity() - others_;
  }

  void add(const Vec3 &r, const Vec3 &v_grad_w, const Vec3 &N)
  {
    const Vec3 slope = tangent_ * v_grad_w;
    turn_ += (tangent_ * (N - N_)) * slope.transpose();
    moment_ -= slope * (tangent_ * r).transpose();
  }

  // the symmetric part of turn moment^-1; false if the moment has no inverse in the tangent plane.
  // Off the plane the moment is completed by 1, the turn is 0, and so is the result.
  bool shape(Mat3 &A) const
  {
    const Eigen::SelfAdjointEigenSolver<Mat3> eigen(moment_ + others_);
    if (!(eigen.eigenvalues()[0] > MIN_BRACKET)) return false;
    const Mat3 &u = eigen.eigenvectors();
    const Mat3 ratio = turn_ * u * eigen.eigenvalues().cwiseInverse().asDiagonal() * u.transpose();
    A = 0.5 * (ratio + ratio.transpose());
    return true;
  }

 private:
  const Vec3 N_;
  Mat3 others_, tangent_, turn_ = Mat3::Zero(), moment_ = Mat3::Zero();
};

bool local_shape(const Stencil &s, const Role *role, const double *N, double volume, int i, Mat3 &A)
{
  const Vec3 Ni = at(N, i);
  if (Ni.isZero(0.0)) return false;
  Brackets brackets(Ni, s.dim());
  for (int k = s.begin(i); k < s.end(i); k++) {
    const int j = s.col()[k];
    if (!bound_surface(role[j])) continue;
    const Vec3 Nj = at(N, j), e = direction(s, k);
    if (Ni.dot(Nj) > SAME_SURFACE) brackets.add(s.r()[k] * e, volume * s.dw()[k] * e, Nj);
  }
  return brackets.shape(A);
}

/* ----------------------------------------------------------------------
   From the layer of particles, with the shape operator A, to the parallel
   surface d/2 outside of it: each radius of curvature grows by d/2, 1/k -> 1/k + d/2.
   The pole at k = -2/d is where the centre of a hollow lies on the true
   surface. Long before it, at k = -2/(3 d), k is bounded by -1/d outside.
------------------------------------------------------------------------- */
double outer_curvature(const Mat3 &A, double d, CurvatureCount &count)
{
  const Eigen::SelfAdjointEigenSolver<Mat3> eigen(A, Eigen::EigenvaluesOnly);
  const Vec3 &k = eigen.eigenvalues();
  double K = 0.0;
  for (int a = 0; a < 3; a++)
    K += k[a] < -2.0 / (3.0 * d) ? -1.0 / d : k[a] / (1.0 + 0.5 * d * k[a]);
  if (k[0] < -2.0 / (3.0 * d)) count.limited++;
  return K;
}

struct Mean {
  double sum = 0.0, weights = 0.0;
  void add(double w, double value)
  {
    sum += w * value;
    weights += w;
  }
  bool known() const { return weights > 0.0; }
  double value() const { return known() ? sum / weights : 0.0; }
};

// over i and its neighbours with known K
Mean local_mean(const Stencil &s, const Role *role, const double *N, const double *K,
                const double *known, double reach, int i)
{
  const Vec3 Ni = at(N, i);
  Mean mean;
  if (known[i] > 0.0) mean.add(1.0, K[i]);
  for (int k = s.begin(i); k < s.end(i); k++) {
    const int j = s.col()[k];
    if (s.r()[k] >= reach || !bound_surface(role[j]) || !(known[j] > 0.0)) continue;
    if (Ni.dot(at(N, j)) > SAME_SURFACE) mean.add(1.0 - s.r()[k] / reach, K[j]);
  }
  return mean;
}

double limit(double K, double bound, CurvatureCount &count)
{
  if (std::abs(K) <= bound) return K;
  count.limited++;
  return std::copysign(bound, K);
}

}    // namespace

Kernel wide_kernel(int dim, double d)
{
  return Kernel(KernelType::WENDLAND_C2, dim, WIDE_H * d);
}

Rows surface_rows(const Rows &fluid, const Role *role)
{
  Rows rows;
  std::copy_if(fluid.begin(), fluid.end(), std::back_inserter(rows),
               [role](int i) { return bound_surface(role[i]); });
  return rows;
}

void wide_gradient(const Stencil &wide, const Rows &rows, const Role *role, double volume,
                   double *N)
{
  for (int i : rows) {
    Direction outward;
    for (int k = wide.begin(i); k < wide.end(i); k++)
      if (is_fluid(role[wide.col()[k]])) outward.add(-volume * wide.dw()[k] * direction(wide, k));
    outward.store(N, i);
  }
}

int normalise(const Rows &rows, double *N)
{
  int none = 0;
  for (int i : rows) {
    Eigen::Map<Vec3> n(N + 3 * i);
    const double length = n.norm();
    if (length > 0.0)
      n /= length;
    else
      none++;
  }
  return none;
}

void eigenvalue_gradient(const Stencil &s, const GradientWeights &g, const Rows &rows,
                         const double *lambda, double *N)
{
  for (int i : rows) {
    Direction outward;
    for (int k = s.begin(i); k < s.end(i); k++) {
      const Vec3 g_ij = pair_gradient(s, g, i, k);
      outward.add((lambda[i] - lambda[s.col()[k]]) * g_ij);
    }
    outward.store(N, i);
  }
}

CurvatureCount tangent_curvature(const Stencil &s, const Rows &rows, const Role *role,
                                 const double *N, double volume, double *K, double *known)
{
  const double d = std::pow(volume, 1.0 / s.dim());
  CurvatureCount count;
  for (int i : rows) {
    Mat3 A;
    const bool few = few_neighbours(s, role, i);
    const bool found = !few && local_shape(s, role, N, volume, i, A);
    known[i] = found ? 1.0 : 0.0;
    K[i] = found ? outer_curvature(A, d, count) : 0.0;
    count.few += few;
    count.unknown += !few && !found;
  }
  return count;
}

void smooth_curvature(const Stencil &s, const Rows &rows, const Role *role, const double *N,
                      const double *K, const double *known, double d, double *mean,
                      CurvatureCount &count)
{
  for (int i : rows) {
    mean[i] = 0.0;
    if (few_neighbours(s, role, i)) continue;
    mean[i] = limit(local_mean(s, role, N, K, known, MEAN_REACH * d, i).value(), 1.0 / d, count);
  }
}

CurvatureCount published_curvature(const Stencil &s, const GradientWeights &g, const Rows &rows,
                                   const Role *role, const double *N, double factor, double d,
                                   double *K)
{
  CurvatureCount count;
  for (int i : rows) {
    K[i] = 0.0;
    if (few_neighbours(s, role, i)) {
      count.few++;
      continue;
    }
    const Vec3 Ni = at(N, i);
    if (Ni.isZero(0.0)) continue;
    double kappa = 0.0;
    for (int k = s.begin(i); k < s.end(i); k++) {
      const int j = s.col()[k];
      if (!bound_surface(role[j])) continue;
      const Vec3 Nj = at(N, j);
      if (Nj.isZero(0.0)) continue;
      const Vec3 g_ij = pair_gradient(s, g, i, k);
      kappa += factor * (Nj - Ni).dot(g_ij);
    }
    K[i] = limit((s.dim() - 1) * kappa, 1.0 / d, count);
  }
  return count;
}

double normal_strain(const double *N, const double *grad_v, int dim)
{
  double rate = 0.0;
  for (int a = 0; a < dim; a++)
    for (int b = 0; b < dim; b++) rate += N[a] * grad_v[3 * a + b] * N[b];
  return rate;
}

}    // namespace aleisph
