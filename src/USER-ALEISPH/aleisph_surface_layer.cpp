// SPDX-License-Identifier: GPL-2.0-only

#include "aleisph_surface_layer.h"

#include "aleisph_cloud.h"
#include "aleisph_surface_stress.h"
#include "aleisph_vectors.h"

#include <Eigen/Dense>

#include <algorithm>
#include <cmath>
#include <vector>

namespace aleisph {

Rows layered_rows(const Cloud &cloud)
{
  return select_rows(cloud.fluid(), [&](int i) {
    return bound_surface(cloud.role()[i]) &&
        cloud.gradient().lambda(i) >= SurfaceLayer::MIN_LAMBDA;
  });
}

int follow_layer(const Cloud &cloud, const Rows &rows, const double *grad_v, const double *u,
                 double dt, double *layer)
{
  constexpr double MOST = SurfaceLayer::MAX_STRETCH;
  const auto size = 2 * static_cast<std::size_t>(cloud.stencil().rows());
  const std::vector<double> before(layer, layer + size);
  std::fill_n(layer, size, 0.0);
  return count_rows(rows, [&](int i) {
    const double *N = cloud.normal() + 3 * i;
    const double s = before[2 * i], last = before[2 * i + 1];
    const double strain = dt * normal_strain(N, grad_v + 9 * i, cloud.dim());
    const double d = cloud.spacing(), thickness = 0.5 * d * std::exp(s);
    const Eigen::Vector3d shift = u ? Eigen::Vector3d(dt * at(u, i)) : Eigen::Vector3d::Zero();
    const double outward = shift.dot(at(cloud.normal(), i)) / thickness;
    const double wanted = (s + 1.5 * strain - 0.5 * last - outward) /
        (1.0 + SurfaceLayer::RELAXATION * shift.norm() / d);
    layer[2 * i] = std::clamp(wanted, -MOST, MOST);
    layer[2 * i + 1] = strain;
    return std::fabs(wanted) > MOST;
  });
}

}    // namespace aleisph
