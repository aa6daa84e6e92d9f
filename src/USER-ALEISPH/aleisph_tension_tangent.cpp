// SPDX-License-Identifier: GPL-2.0-only
/* ----------------------------------------------------------------------
   The tangent plane of i enters as the projector
   P = 1 - N (x) N (- z (x) z in 2d), so that both dimensions and all
   directions are treated alike and no frame has to be chosen.
------------------------------------------------------------------------- */

#include "aleisph_tension_tangent.h"

#include "aleisph_tension_contact_continuation.h"
#include "aleisph_tension_contact_curvature.h"
#include "aleisph_tension_contact_walls.h"
#include "aleisph_tension_parts.h"

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>

namespace aleisph {
namespace {

using Vec3 = Eigen::Vector3d;
using Mat3 = Eigen::Matrix3d;

// The second bracket along a direction t of the tangent plane, -sum V dW/dr (r_ij.t)^2/r_ij, has no
// unit. With the cubic spline and h = 1.2 d it is 0.58 on a straight line (2d) and on a flat square
// layer of particles (3d); 0.25 and 0.14 for a single neighbour at d, 0.044 and 0.026 at 2 d. It
// falls to 0.02 at 2.1 d: below, neighbours in that direction are at the rim of the support only.
constexpr double MIN_BRACKET = 0.02;

constexpr double MEAN_REACH = 2.4;    // of the averaging, in spacings

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

bool local_shape(const Cloud &cloud, const double *N, int i, Mat3 &A)
{
  const Stencil &s = cloud.stencil();
  const Vec3 Ni = at(N, i);
  if (Ni.isZero(0.0)) return false;
  Brackets brackets(Ni, s.dim());
  for (int k = s.begin(i); k < s.end(i); k++) {
    const int j = s.col()[k];
    if (!bound_surface(cloud.role()[j])) continue;
    const Vec3 Nj = at(N, j), e = direction(s, k);
    if (Ni.dot(Nj) > SAME_SURFACE) brackets.add(s.r()[k] * e, cloud.volume() * s.dw()[k] * e, Nj);
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
Mean local_mean(const Cloud &cloud, const double *N, const double *K, const double *known, int i)
{
  const Stencil &s = cloud.stencil();
  const double reach = MEAN_REACH * cloud.spacing();
  const Vec3 Ni = at(N, i);
  Mean mean;
  if (known[i] > 0.0) mean.add(1.0, K[i]);
  for (int k = s.begin(i); k < s.end(i); k++) {
    const int j = s.col()[k];
    if (s.r()[k] >= reach || !bound_surface(cloud.role()[j]) || !(known[j] > 0.0)) continue;
    if (Ni.dot(at(N, j)) > SAME_SURFACE) mean.add(1.0 - s.r()[k] / reach, K[j]);
  }
  return mean;
}

}    // namespace

CurvatureCount tangent_curvature(const Cloud &cloud, const Rows &rows, const double *N, double *K,
                                 double *known)
{
  // in 3d not spacing() to the last bit
  const double d = std::pow(cloud.volume(), 1.0 / cloud.dim());
  return sum_rows(rows, [&](int i) {
    CurvatureCount count;
    Mat3 A;
    const bool few = few_neighbours(cloud, i);
    const bool found = !few && local_shape(cloud, N, i, A);
    known[i] = found ? 1.0 : 0.0;
    K[i] = found ? outer_curvature(A, d, count) : 0.0;
    count.few = few;
    count.unknown = !few && !found;
    return count;
  });
}

int smooth_curvature(const Cloud &cloud, const Rows &rows, const double *N, const double *K,
                     const double *known, double *mean)
{
  return count_rows(rows, [&](int i) {
    CurvatureCount count;
    mean[i] = 0.0;
    if (few_neighbours(cloud, i)) return false;
    mean[i] = count.limit(local_mean(cloud, N, K, known, i).value(), 1.0 / cloud.spacing());
    return count.limited > 0;
  });
}

/* ---------------------------------------------------------------------- */

void TangentTension::find_normals(const TensionScene &scene)
{
  double *N = result_.N.data();
  wide_.build(scene.cloud, scene.x, scene.far);
  if (scene.cosine) find_planes(scene);
  wide_gradient(scene.cloud, wide_, result_.rows, N);
  if (scene.cosine)
    add_continuation(scene.cloud, wide_, result_.rows, plane_.data(), contact_params_, N);
  result_.undirected = normalise(result_.rows, N);
  scene.exchange(N, 3);
}

void TangentTension::find_planes(const TensionScene &scene)
{
  scene.exchange(result_.contact.data(), 4);
  plane_.assign(2 * result_.K.size(), 0.0);
  contact_planes(scene.cloud, wide_, result_.contact.data(), contact_params_, plane_.data());
  scene.exchange(plane_.data(), 2);
}

void TangentTension::find_curvature(const TensionScene &scene)
{
  const Cloud &cloud = scene.cloud;
  const double *N = result_.N.data();
  K_.assign(result_.K.size(), 0.0);
  known_.assign(result_.K.size(), 0.0);
  result_.count = tangent_curvature(cloud, result_.rows, N, K_.data(), known_.data());
  scene.exchange(K_.data(), 1);
  scene.exchange(known_.data(), 1);
  result_.count.limited += smooth_curvature(cloud, result_.rows, N, K_.data(), known_.data(),
                                            result_.K.data());
  if (!scene.cosine) return;
  result_.share.assign(cloud.owned(), 0.0);
  result_.count.limited += contact_curvature(ContactWalls(cloud, wide_.pairs, scene.cosine),
                                             result_.rows, contact_params_, N, result_.share.data(),
                                             result_.K.data());
}

double TangentTension::bytes() const
{
  return TensionModel::bytes() + wide_.pairs.bytes() +
      sizeof(double) * (plane_.size() + K_.size() + known_.size());
}

}    // namespace aleisph
