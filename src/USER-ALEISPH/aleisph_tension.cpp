// SPDX-License-Identifier: GPL-2.0-only

#include "aleisph_tension.h"

#include "aleisph_tension_contact_walls.h"

#include <Eigen/Core>
#include <algorithm>
#include <cmath>

namespace aleisph {

void TensionModel::update(const TensionScene &scene)
{
  const Cloud &cloud = scene.cloud;
  const std::size_t n = cloud.size();
  result_.rows = surface_rows(cloud);
  result_.N.assign(3 * n, 0.0);
  result_.K.assign(n, 0.0);
  result_.count = {};
  result_.contacts = 0;
  result_.contact.clear();
  result_.share.clear();
  if (scene.cosine) {
    result_.contact.assign(4 * n, 0.0);
    result_.contacts = contact_normals(ContactWalls(cloud, cloud.stencil(), scene.cosine),
                                       result_.rows, contact_params_, result_.contact.data());
  }
  find_normals(scene);
  find_curvature(scene);
}

double TensionModel::bytes() const
{
  return sizeof(double) *
      (result_.N.size() + result_.K.size() + result_.contact.size() + result_.share.size());
}

double CurvatureCount::limit(double K, double bound)
{
  if (std::abs(K) <= bound) return K;
  limited++;
  return std::copysign(bound, K);
}

double TensionResult::total_curvature() const
{
  return sum_rows(rows, [this](int i) { return K[i]; });
}

double TensionResult::largest_curvature() const
{
  return max_rows(
      rows, [this](int i) { return std::abs(K[i]); }, 0.0);
}

Rows surface_rows(const Cloud &cloud)
{
  return select_rows(cloud.fluid(), [&](int i) { return bound_surface(cloud.role()[i]); });
}

int normalise(const Rows &rows, double *N)
{
  return count_rows(rows, [N](int i) {
    Eigen::Map<Eigen::Vector3d> n(N + 3 * i);
    const double length = n.norm();
    if (length > 0.0) n /= length;
    return !(length > 0.0);
  });
}

void add_capillary_pressure(const TensionResult &tension, double sigma, double *p)
{
  for_rows(tension.rows, [&](int i) { p[i] += sigma * tension.K[i]; });
}

void add_tension_force(const TensionResult &tension, double factor, int dim, double *const *f)
{
  for_rows(tension.rows, [&](int i) {
    for (int a = 0; a < dim; a++) f[i][a] -= factor * tension.K[i] * tension.N[3 * i + a];
  });
}

}    // namespace aleisph
