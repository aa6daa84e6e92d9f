// SPDX-License-Identifier: GPL-2.0-only

#include "aleisph_tension_wide.h"

#include "aleisph_tension_parts.h"

namespace aleisph {

Kernel wide_kernel(int dim, double d)
{
  return Kernel(KernelType::WENDLAND_C2, dim, WIDE_H * d);
}

void WideStencil::build(const Cloud &cloud, const double *const *x, const CandidateList &list)
{
  pairs.build(kernel, cloud.owned(), x, list, {cloud.role(), SURFACE | WALL, 0});
}

void wide_gradient(const Cloud &cloud, const WideStencil &wide, const Rows &rows, double *N)
{
  const Stencil &s = wide.pairs;
  for_rows(rows, [&](int i) {
    Direction outward;
    for (int k = s.begin(i); k < s.end(i); k++)
      if (is_fluid(cloud.role()[s.col()[k]]))
        outward.add(-cloud.volume() * s.dw()[k] * direction(s, k));
    outward.store(N, i);
  });
}

}    // namespace aleisph
