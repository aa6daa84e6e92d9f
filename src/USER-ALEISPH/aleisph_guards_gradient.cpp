// SPDX-License-Identifier: GPL-2.0-only
/* ----------------------------------------------------------------------
   The guards that act on the pressure gradient. V gradW_ij = w e_ij with
   w = V dW/dr, so that g_ji = V L_j gradW_ji = -w L_j e_ij and
   -g_ij.g_ji = w g_ij.L_j e_ij.
------------------------------------------------------------------------- */

#include "aleisph_guards.h"

#include "aleisph_cloud.h"
#include "aleisph_vectors.h"
#include "aleisph_wall_cone.h"

#include <Eigen/Dense>
#include <algorithm>
#include <limits>
#include <vector>

namespace aleisph {
namespace {

using Vec3 = Eigen::Vector3d;

bool near_surface(const Stencil &s, const Role *role, int i, double reach)
{
  for (int k = s.begin(i); k < s.end(i); k++)
    if ((role[s.col()[k]] & SURFACE) && s.r()[k] < reach) return true;
  return false;
}

Vec3 sum_of_weights(const Stencil &s, const GradientWeights &g, int i)
{
  Vec3 sum = Vec3::Zero();
  for (int k = s.begin(i); k < s.end(i); k++) sum += pair_gradient(s, g, i, k);
  return sum;
}

// P_i
double divergence_of_gradient(const Cloud &cloud, const double *inverse, int i)
{
  const Stencil &s = cloud.stencil();
  const GradientWeights &g = cloud.gradient();
  double sum = 0.0;
  for (int k = s.begin(i); k < s.end(i); k++) {
    const int j = s.col()[k];
    const Vec3 g_ij = pair_gradient(s, g, i, k);
    if (cloud.role()[j] & FLUID)
      sum += cloud.volume() * s.dw()[k] * g_ij.dot(packed_matrix(inverse, j) * direction(s, k));
    else
      sum += g_ij.squaredNorm();
  }
  return sum;
}

// S without its parts along the normals of the walls next to i
Vec3 without_outward_parts(const Cloud &cloud, int i, double reach, const Vec3 &S)
{
  const Stencil &s = cloud.stencil();
  const Role *const role = cloud.role();
  std::vector<Vec3> normals;
  for (int k = s.begin(i); k < s.end(i); k++)
    if ((role[s.col()[k]] & WALL) && s.r()[k] < reach)
      normals.push_back(at(cloud.normal(), s.col()[k]));
  return -without_parts_into_walls(-S, normals);
}

// sigma of a row with |S'|^2 = S2; A <= 0 is the diagonal of the Laplacian
double self_weight(double S2, double P, double A, const SelfTermParams &params)
{
  if (!(S2 > params.low * P)) return 1.0;
  const bool full = !(S2 < params.high * P);    // also if P is not positive
  const double clip = full ? 1.0 : (S2 / P - params.low) / (params.high - params.low);
  const double bound = (P + params.response * A) / S2;
  return std::max(1.0 - 2.0 * clip, std::min(bound, 0.0));
}

}    // namespace

int correct_self_term(const Cloud &cloud, const SelfTermParams &params, const double *inverse,
                      const double *p, double *grad)
{
  const Stencil &s = cloud.stencil();
  const Role *const role = cloud.role();
  const double d = cloud.spacing();
  const LaplacianWeights *const l = params.bounded ? &cloud.laplacian_rows() : nullptr;
  constexpr double inf = std::numeric_limits<double>::infinity();
  return count_rows(cloud.fluid(), [&](int i) {
    if ((role[i] & SURFACE) || !near_surface(s, role, i, params.near_surface * d)) return false;
    const Vec3 S = without_outward_parts(cloud, i, params.wall_reach * d,
                                         sum_of_weights(s, cloud.gradient(), i));
    const double P = divergence_of_gradient(cloud, inverse, i);
    const double A = l ? l->diagonal(i) : -inf;
    const double sigma = self_weight(S.squaredNorm(), P, A, params);
    for (int a = 0; a < 3; a++) grad[3 * i + a] += (1.0 - sigma) * p[i] * S[a];
    return sigma < 1.0;
  });
}

int symmetric_gradient(const Cloud &cloud, const Rows &rows, double max_lambda, const double *p,
                       double *grad)
{
  const Stencil &s = cloud.stencil();
  return count_rows(rows, [&](int i) {
    if (!(cloud.gradient().lambda(i) < max_lambda)) return false;
    Vec3 sum = Vec3::Zero();
    for (int k = s.begin(i); k < s.end(i); k++)
      sum += cloud.volume() * s.dw()[k] * (p[i] + p[s.col()[k]]) * direction(s, k);
    for (int a = 0; a < 3; a++) grad[3 * i + a] = sum[a];
    return true;
  });
}

}    // namespace aleisph
