// SPDX-License-Identifier: GPL-2.0-only

#include "aleisph_solve_leftover.h"

#include "aleisph_cloud.h"

namespace aleisph {

Rows leftover_rows(const Cloud &cloud, const PpeLayout &layout)
{
  const SeenRoles neighbours = cloud.neighbours();
  const LaplacianWeights &laplacian = cloud.laplacian_rows();
  return select_rows(cloud.fluid(), [&](int i) {
    return layout.type[i] == RowType::FLUID && !laplacian.morris(i) && !neighbours.any(i, SURFACE);
  });
}

void given_back(const Cloud &cloud, const Rows &rows, double share, const double *q, double *g)
{
  const Stencil &s = cloud.stencil();
  const Role *role = cloud.role();
  const double per_support = 1.0 / cloud.kernel().support();
  for_rows(rows, [&](int i) {
    double sum = q[i], weights = 1.0;
    for (int k = s.begin(i); k < s.end(i); k++) {
      const int j = s.col()[k];
      if ((role[j] & (FLUID | WALL)) != FLUID) continue;
      const double x = s.r()[k] * per_support, weight = (1.0 - x * x) * (1.0 - x * x);
      weights += weight;
      sum += weight * q[j];
    }
    g[i] = share * q[i] + (1.0 - share) * sum / weights;
  });
}

}    // namespace aleisph
