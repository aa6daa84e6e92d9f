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

void velocity_roughness(const Cloud &cloud, const double *v, const double *grad_v, double *out)
{
  const Stencil &s = cloud.stencil();
  const int dim = cloud.dim();
  for (const int i : cloud.fluid()) {
    for (int a = 0; a < 3; a++) out[3 * i + a] = 0.0;
    if (!bound_fluid(cloud.role()[i])) continue;
    double weights = 0.0;
    for (int k = s.begin(i); k < s.end(i); k++) {
      const int j = s.col()[k];
      if (!bound_fluid(cloud.role()[j])) continue;
      const double w = 1.0 - s.r()[k] / cloud.kernel().support();
      for (int a = 0; a < dim; a++) {
        const double slope = slope_to(s, k, &grad_v[9 * i + 3 * a]);
        out[3 * i + a] += w * (v[3 * j + a] - v[3 * i + a] - s.r()[k] * slope);
      }
      weights += w;
    }
    for (int a = 0; a < 3 && weights > 0.0; a++) out[3 * i + a] /= weights;
  }
}

}    // namespace aleisph
