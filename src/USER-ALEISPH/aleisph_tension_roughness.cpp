// SPDX-License-Identifier: GPL-2.0-only

#include "aleisph_tension_roughness.h"

#include <algorithm>
#include <cmath>

namespace aleisph {
namespace {

// adds w (v_j - v_i - (grad v)_i.r_ji), pair k of row i
void add_pair(const Stencil &s, int i, int k, double w, const double *v, const double *grad_v,
              double *out)
{
  const int j = s.col()[k];
  for (int a = 0; a < s.dim(); a++) {
    double linear = 0.0;
    for (int b = 0; b < s.dim(); b++) linear -= grad_v[9 * i + 3 * a + b] * s.e(b)[k];
    out[3 * i + a] += w * (v[3 * j + a] - v[3 * i + a] - s.r()[k] * linear);
  }
}

}    // namespace

double roughness_rate(double filter, double sigma, double rho, double d, double dt)
{
  return std::min(filter * std::sqrt(sigma / (rho * d * d * d)), 1.0 / dt);
}

void velocity_roughness(const Stencil &s, const Kernel &kernel, const Rows &fluid, const Role *role,
                        const double *v, const double *grad_v, double *out)
{
  for (const int i : fluid) {
    for (int a = 0; a < 3; a++) out[3 * i + a] = 0.0;
    if (!bound_fluid(role[i])) continue;
    double weights = 0.0;
    for (int k = s.begin(i); k < s.end(i); k++) {
      if (!bound_fluid(role[s.col()[k]])) continue;
      const double w = 1.0 - s.r()[k] / kernel.support();
      add_pair(s, i, k, w, v, grad_v, out);
      weights += w;
    }
    for (int a = 0; a < 3 && weights > 0.0; a++) out[3 * i + a] /= weights;
  }
}

}    // namespace aleisph
