// SPDX-License-Identifier: GPL-2.0-only

#include "aleisph_solve_viscous.h"

#include "aleisph_cloud.h"
#include "aleisph_scene.h"

#include <algorithm>

namespace aleisph {

void assemble_viscous(Cloud &cloud, double share,
                      const std::vector<VelocityCondition *> &conditions, CsrMatrix &matrix)
{
  const auto &s = cloud.stencil();
  const double *weight = cloud.laplacian().a();
  const Role *role = cloud.role();

  matrix.reset(s.rows(), s.ptr(), s.col());
  for_rows(s.rows(), [&](int i) { matrix.diag(i) = 1.0; });
  for_rows(cloud.fluid(), [&](int i) {
    for (int k = s.begin(i); k < s.end(i); k++) {
      if (role[s.col()[k]] & SLIP) continue;
      matrix.diag(i) -= share * weight[k];
      matrix.val(k) = share * weight[k];
    }
  });
  for_rows(cloud.buffer(), [&](int i) {
    for (const auto *condition : conditions) {
      const int *const end = s.col() + s.end(i);
      const int *const place = std::find(s.col() + s.begin(i), end, condition->source(i));
      if (place != end) matrix.val(static_cast<int>(place - s.col())) = -1.0;
    }
  });
}

}    // namespace aleisph
