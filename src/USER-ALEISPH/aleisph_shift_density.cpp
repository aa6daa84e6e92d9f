// SPDX-License-Identifier: GPL-2.0-only
/* ----------------------------------------------------------------------
   Numerical density of the shifting, Morikawa, Tsuji & Asai eq 19, over the
   nearest neighbours or over the full support.
------------------------------------------------------------------------- */

#include "aleisph_cloud.h"
#include "aleisph_seen.h"
#include "aleisph_shift.h"
#include "aleisph_shift_images.h"
#include "aleisph_surface_shape.h"

#include <cmath>

namespace aleisph {
namespace {

// What images leave of the deviation on a lattice in concave edges and corners (7.0e-4 at most
// for a support of 2.4 d), so that it is not taken for a deviation of the fluid.
constexpr double IMAGE_ERROR = 1.0e-3;

double sum_near(const Stencil &s, const Kernel &kernel, int i, double reach)
{
  double sum = 0.0;
  const double *const r = s.r();
  for (int k = s.begin(i); k < s.end(i); k++)
    if (r[k] < reach) sum += kernel.w(r[k]);
  return sum;
}

}    // namespace

double nearest_reach(int dim, double d)
{
  return 1.1 * std::sqrt(static_cast<double>(dim)) * d;
}

DensityScale density_scale(const Kernel &kernel, double d, double reach)
{
  const int n = static_cast<int>(std::ceil(kernel.support() / d));
  const int nz = kernel.dim() == 3 ? n : 0;
  double full = 0.0, half = 0.0, curved = 0.0;
  for (int k = -nz; k <= nz; k++)
    for (int j = -n; j <= n; j++)
      for (int i = -n; i <= n; i++) {
        const double r = d * std::sqrt(static_cast<double>(i * i + j * j + k * k));
        const double w = r < reach ? kernel.w(r) : 0.0;
        full += w;
        if (i <= 0) half += w;
        if (i < 0) curved -= 0.5 * i * w;
      }
  return {1.0 / (std::pow(d, kernel.dim()) * full), half / full, curved / full};
}

void density_deviation(const Cloud &cloud, bool published, double *eps, const double *curvature)
{
  const Stencil &s = cloud.stencil();
  const Kernel &kernel = cloud.kernel();
  const Role *const role = cloud.role();
  const double d = cloud.spacing();
  const double reach = published ? nearest_reach(kernel.dim(), d) : kernel.support();
  const DensityScale scale = density_scale(kernel, d, reach);
  Images images(cloud, true);
  const SurfaceShape shape(kernel, d);
  const SeenRoles neighbours = cloud.neighbours();
  for_rows(cloud.fluid(), [&](int i) {
    double sum = kernel.w(0.0) + sum_near(s, kernel, i, reach), expected = 1.0;
    const bool wall = !published && neighbours.any(i, WALL);
    if (wall || (!published && neighbours.any(i, SURFACE)))
      for (const Eigen::Vector3d &r : images.of(i)) sum += kernel.w(r.norm());
    if (!published && (role[i] & SURFACE))
      expected = wall ? scale.flat : shape.density(shape.asymmetry(s, i));
    if (!published && curvature && (role[i] & SURFACE)) expected -= scale.curved * curvature[i] * d;
    eps[i] = scale.beta * cloud.volume() * sum - expected;
    if (wall && std::fabs(eps[i]) < IMAGE_ERROR) eps[i] = 0.0;
  });
}

}    // namespace aleisph
