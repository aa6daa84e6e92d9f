// SPDX-License-Identifier: GPL-2.0-only

#include "aleisph_eigenvalue_normal.h"

#include "aleisph_tension_parts.h"

#include <algorithm>

namespace aleisph {

void eigenvalue_gradient(const Cloud &cloud, const Rows &rows, const double *lambda, double *N)
{
  const Stencil &s = cloud.stencil();
  const GradientWeights &g = cloud.gradient();
  for_rows(rows, [&](int i) {
    Direction outward;
    for (int k = s.begin(i); k < s.end(i); k++) {
      const Eigen::Vector3d g_ij = pair_gradient(s, g, i, k);
      outward.add((lambda[i] - lambda[s.col()[k]]) * g_ij);
    }
    outward.store(N, i);
  });
}

int eigenvalue_normals(const Cloud &cloud, const Rows &rows, const double *contact,
                       const GhostExchange &exchange, double *N)
{
  const GradientWeights &g = cloud.gradient();
  std::vector<double> lambda(cloud.size(), 0.0);
  for_rows(cloud.all(), [&](int i) { lambda[i] = g.lambda(i); });
  exchange(lambda.data(), 1);
  eigenvalue_gradient(cloud, rows, lambda.data(), N);
  const int undirected = normalise(rows, N);
  if (contact)
    for_rows(rows, [&](int i) {
      if (contact[4 * i + 3] > 0.0) std::copy_n(contact + 4 * i, 3, N + 3 * i);
    });
  return undirected;
}

}    // namespace aleisph
