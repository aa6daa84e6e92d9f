// SPDX-License-Identifier: GPL-2.0-only

#include "aleisph_surface_stress.h"

namespace aleisph {

void add_viscous_pressure(const Rows &rows, const double *N, double mu, const double *grad_v,
                          int dim, double *p)
{
  for_rows(rows, [&](int i) { p[i] += 2.0 * mu * normal_strain(N + 3 * i, grad_v + 9 * i, dim); });
}

double normal_strain(const double *N, const double *grad_v, int dim)
{
  double rate = 0.0;
  for (int a = 0; a < dim; a++)
    for (int b = 0; b < dim; b++) rate += N[a] * grad_v[3 * a + b] * N[b];
  return rate;
}

}    // namespace aleisph
