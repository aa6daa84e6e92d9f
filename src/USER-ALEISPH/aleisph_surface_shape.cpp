// SPDX-License-Identifier: GPL-2.0-only

#include "aleisph_surface_shape.h"

#include <algorithm>
#include <cmath>

namespace aleisph {

// the lattice restricted to x >= 0 (1 cut), y >= 0 (2), z >= 0 (3); density not yet normalised
SurfaceShape::Part SurfaceShape::lattice(const Kernel &kernel, double d, int cuts) const
{
  const int n = static_cast<int>(std::ceil(kernel.support() / d));
  const int nz = kernel.dim() == 3 ? n : 0;
  double sum = 0.0, weights = 0.0;
  Eigen::Vector3d direction = Eigen::Vector3d::Zero();
  for (int k = cuts > 2 ? 0 : -nz; k <= nz; k++)
    for (int j = cuts > 1 ? 0 : -n; j <= n; j++)
      for (int i = cuts > 0 ? 0 : -n; i <= n; i++) {
        const Eigen::Vector3d x(i * d, j * d, k * d);
        const double r = x.norm();
        if (!(r < kernel.support())) continue;
        sum += kernel.w(r);
        if (r == 0.0) continue;
        const double q = -kernel.dw(r) * r;
        weights += q;
        direction += q / r * x;
      }
  return {direction.norm() / weights, sum};
}

SurfaceShape::SurfaceShape(const Kernel &kernel, double d)
{
  for (int cuts = 0; cuts < 4; cuts++)
    parts_[cuts] = lattice(kernel, d, std::min(cuts, kernel.dim()));
  const double full = parts_[0].density;
  for (Part &part : parts_) part.density /= full;
  parts_[0].asymmetry = 0.0;    // but for rounding
}

double SurfaceShape::asymmetry(const Stencil &s, int i) const
{
  double weights = 0.0;
  Eigen::Vector3d direction = Eigen::Vector3d::Zero();
  const auto add = [&](double q, const Eigen::Vector3d &e) {
    weights += q;
    direction += q * e;
  };
  for (int k = s.begin(i); k < s.end(i); k++) {
    const Eigen::Vector3d e(s.e(0)[k], s.e(1)[k], s.dim() == 3 ? s.e(2)[k] : 0.0);
    add(-s.dw()[k] * s.r()[k], e);
  }
  return weights > 0.0 ? direction.norm() / weights : 1.0;
}

double SurfaceShape::density(double a) const
{
  const int last = parts_[3].asymmetry > parts_[2].asymmetry ? 2 : 1;
  int k = 0;
  while (k < last && a > parts_[k + 1].asymmetry) k++;
  const Part &low = parts_[k], &high = parts_[k + 1];
  const double share = (a - low.asymmetry) / (high.asymmetry - low.asymmetry);
  return low.density + share * (high.density - low.density);
}

double SurfaceShape::corner(double a) const
{
  const double flat = parts_[1].asymmetry, right_angle = parts_[2].asymmetry;
  return std::clamp((a - flat) / (right_angle - flat), 0.0, 1.0);
}

}    // namespace aleisph
