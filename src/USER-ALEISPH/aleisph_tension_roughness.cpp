// SPDX-License-Identifier: GPL-2.0-only

#include "aleisph_tension_roughness.h"

#include <algorithm>
#include <cmath>

namespace aleisph {
namespace {

// of a component of v with this gradient, towards the neighbour of pair k
double slope_to(const Stencil &s, int k, const double *gradient)
{
  double slope = 0.0;
  for (int b = 0; b < s.dim(); b++) slope -= gradient[b] * s.e(b)[k];
  return slope;
}

}    // namespace

double roughness_rate(double filter, double sigma, double rho, double d, double dt)
{
  return std::min(filter * std::sqrt(sigma / (rho * d * d * d)), 1.0 / dt);
}

void add_roughness(const Cloud &cloud, double rate, const double *v, const double *grad_v,
                   double *a)
{
  const Stencil &s = cloud.stencil();
  for_rows(cloud.fluid(), [&](int i) {
    if (!bound_fluid(cloud.role()[i])) return;
    double out[3] = {0.0, 0.0, 0.0}, weights = 0.0;
    for (int k = s.begin(i); k < s.end(i); k++) {
      const int j = s.col()[k];
      if (!bound_fluid(cloud.role()[j])) continue;
      const double w = 1.0 - s.r()[k] / cloud.kernel().support();
      for (int c = 0; c < cloud.dim(); c++) {
        const double slope = slope_to(s, k, &grad_v[9 * i + 3 * c]);
        out[c] += w * (v[3 * j + c] - v[3 * i + c] - s.r()[k] * slope);
      }
      weights += w;
    }
    for (int c = 0; c < 3 && weights > 0.0; c++) a[3 * i + c] += rate * (out[c] / weights);
  });
}

}    // namespace aleisph
