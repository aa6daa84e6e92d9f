// SPDX-License-Identifier: GPL-2.0-only

#include "aleisph_tension_published.h"

#include "aleisph_eigenvalue_normal.h"
#include "aleisph_tension_parts.h"

namespace aleisph {

using Vec3 = Eigen::Vector3d;

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
  const double *contact = result_.contact.empty() ? nullptr : result_.contact.data();
  result_.undirected = eigenvalue_normals(scene.cloud, result_.rows, contact, scene.exchange, N);
  scene.exchange(N, 3);
}

void PublishedTension::find_curvature(const TensionScene &scene)
{
  result_.count = published_curvature(scene.cloud, result_.rows, result_.N.data(), factor_,
                                      result_.K.data());
}

}    // namespace aleisph
