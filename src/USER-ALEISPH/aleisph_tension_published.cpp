// SPDX-License-Identifier: GPL-2.0-only

#include "aleisph_tension_published.h"

#include "aleisph_tension_parts.h"

#include <algorithm>

namespace aleisph {

using Vec3 = Eigen::Vector3d;

void eigenvalue_gradient(const Cloud &cloud, const Rows &rows, const double *lambda, double *N)
{
  const Stencil &s = cloud.stencil();
  const GradientWeights &g = cloud.gradient();
  for_rows(rows, [&](int i) {
    Direction outward;
    for (int k = s.begin(i); k < s.end(i); k++) {
      const Vec3 g_ij = pair_gradient(s, g, i, k);
      outward.add((lambda[i] - lambda[s.col()[k]]) * g_ij);
    }
    outward.store(N, i);
  });
}

CurvatureCount published_curvature(const Cloud &cloud, const Rows &rows, const double *N,
                                   double factor, double *K)
{
  const Stencil &s = cloud.stencil();
  const GradientWeights &g = cloud.gradient();
  return sum_rows(rows, [&](int i) {
    CurvatureCount count;
    K[i] = 0.0;
    count.few = few_neighbours(cloud, i);
    const Vec3 Ni = at(N, i);
    if (count.few || Ni.isZero(0.0)) return count;
    double kappa = 0.0;
    for (int k = s.begin(i); k < s.end(i); k++) {
      const int j = s.col()[k];
      if (!bound_surface(cloud.role()[j])) continue;
      const Vec3 Nj = at(N, j);
      if (Nj.isZero(0.0)) continue;
      const Vec3 g_ij = pair_gradient(s, g, i, k);
      kappa += factor * (Nj - Ni).dot(g_ij);
    }
    K[i] = count.limit((cloud.dim() - 1) * kappa, 1.0 / cloud.spacing());
    return count;
  });
}

void PublishedTension::find_normals(const TensionScene &scene)
{
  double *N = result_.N.data();
  lambda_.assign(result_.K.size(), 0.0);
  const GradientWeights &g = scene.cloud.gradient();
  for_rows(scene.cloud.all(), [&](int i) { lambda_[i] = g.lambda(i); });
  scene.exchange(lambda_.data(), 1);
  eigenvalue_gradient(scene.cloud, result_.rows, lambda_.data(), N);
  result_.undirected = normalise(result_.rows, N);
  const std::vector<double> &contact = result_.contact;
  if (!contact.empty())    // Morikawa, Tsuji & Asai, Fig. 9
    for_rows(result_.rows, [&](int i) {
      if (contact[4 * i + 3] > 0.0) std::copy_n(&contact[4 * i], 3, &N[3 * i]);
    });
  scene.exchange(N, 3);
}

void PublishedTension::find_curvature(const TensionScene &scene)
{
  result_.count = published_curvature(scene.cloud, result_.rows, result_.N.data(), factor_,
                                      result_.K.data());
}

double PublishedTension::bytes() const
{
  return TensionModel::bytes() + sizeof(double) * lambda_.size();
}

}    // namespace aleisph
