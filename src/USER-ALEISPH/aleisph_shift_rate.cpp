// SPDX-License-Identifier: GPL-2.0-only
/* ----------------------------------------------------------------------
   The rate of shifting from strain and pressure gradient, and the largest
   coefficient. SPAN from measurements (documentation of fix aleisph/shift): a
   third of it opens voids in a stretched drop, twice as much costs accuracy in
   vortices.
------------------------------------------------------------------------- */

#include "aleisph_shift_rate.h"

#include "aleisph_cloud.h"
#include "aleisph_shift.h"
#include "aleisph_vectors.h"

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>
#include <vector>

namespace aleisph {
namespace {

constexpr double SPAN = 33.0;    // spacings
constexpr int WAVES = 8;         // wave vectors per axis from 0 to pi/d; one of them is pi/(2 d)

double strain_squared(const double *g)
{
  double sum = 0.0;
  for (int a = 0; a < 3; a++)
    for (int b = 0; b < 3; b++) {
      const double e = 0.5 * (g[3 * a + b] + g[3 * b + a]);
      sum += 2.0 * e * e;
    }
  return sum;
}

// A neighbour on the lattice: x_i - x_j = r e
struct Pair {
  Eigen::Vector3d e;
  double r, w, dw;
};

struct Sums {
  double volume, reach, beta;
  Eigen::Matrix3d identity;    // of the plane in 2d
};

std::vector<Pair> lattice_pairs(const Kernel &kernel, double d)
{
  const int n = static_cast<int>(std::ceil(kernel.support() / d)), nz = kernel.dim() == 3 ? n : 0;
  std::vector<Pair> pairs;
  for (int k = -nz; k <= nz; k++)
    for (int j = -n; j <= n; j++)
      for (int i = -n; i <= n; i++) {
        const Eigen::Vector3d x(i * d, j * d, k * d);
        const double r = x.norm();
        if (r > 0.0 && r < kernel.support()) pairs.push_back({x / r, r, kernel.w(r), kernel.dw(r)});
      }
  return pairs;
}

// dr/(C h) of displacements A exp(i k.x), to first order in A: a real matrix, since the lattice is
// its own mirror image. eps is that of an imaginary amplitude, its sum over S* imaginary again.
Eigen::Matrix3d response(const std::vector<Pair> &pairs, const Eigen::Vector3d &k, const Sums &sums)
{
  Eigen::Matrix3d even = Eigen::Matrix3d::Zero();
  Eigen::Vector3d eps = Eigen::Vector3d::Zero(), spread = Eigen::Vector3d::Zero();
  for (const Pair &p : pairs) {
    const double phase = p.r * k.dot(p.e);
    eps += sums.beta * sums.volume * p.dw * std::sin(phase) * p.e;
    if (!(p.r < sums.reach)) continue;
    const Eigen::Matrix3d along = p.e * p.e.transpose();
    const Eigen::Matrix3d across = sums.identity - along;
    even += sums.volume * (1.0 - std::cos(phase)) * (p.dw * along + p.w / p.r * across);
    spread += std::sin(phase) * p.e;
  }
  return even + spread * eps.transpose();
}

}    // namespace

FlowSums flow_sums(const Cloud &cloud, const double *grad_v, const double *grad_p)
{
  const Role *const role = cloud.role();
  const Rows rows = select_rows(cloud.fluid(), [role](int i) { return !(role[i] & BALLISTIC); });
  FlowSums sums;
  sums.count = static_cast<double>(rows.size());
  sums.strain = sum_rows(rows, [grad_v](int i) { return strain_squared(grad_v + 9 * i); });
  sums.gradient = sum_rows(rows, [grad_p](int i) {
    const double *g = grad_p + 3 * i;
    return g[0] * g[0] + g[1] * g[1] + g[2] * g[2];
  });
  return sums;
}

double flow_scale(const FlowSums &sums, double d, double rho0)
{
  if (!(sums.count > 0.0)) return 0.0;
  const double strain = std::sqrt(sums.strain / sums.count);
  const double acceleration = std::sqrt(sums.gradient / sums.count) / rho0;
  return SPAN * d * strain + std::sqrt(acceleration * d);
}

Rows surface_that_works(const Cloud &cloud)
{
  const Role *const role = cloud.role();
  return select_rows(cloud.fluid(),
                     [role](int i) { return (role[i] & SURFACE) && !(role[i] & BALLISTIC); });
}

SurfaceWork surface_work(const Cloud &cloud, const Rows &rows, const double *e, double e_mean,
                         const double *dr)
{
  SurfaceWork sums;
  sums.work = sum_rows(
      rows, [&](int i) { return at(dr, i).dot(at(cloud.normal(), i)) * (e[i] - e_mean); });
  sums.square = sum_rows(rows, [&](int i) { return (e[i] - e_mean) * (e[i] - e_mean); });
  return sums;
}

void remove_surface_work(const Cloud &cloud, const Rows &rows, const double *e, double e_mean,
                         const SurfaceWork &total, double *dr)
{
  if (!(total.work > 0.0 && total.square > 0.0)) return;
  const double share = total.work / total.square;
  for_rows(rows, [&](int i) {
    for (int a = 0; a < 3; a++)
      dr[3 * i + a] -= share * (e[i] - e_mean) * cloud.normal()[3 * i + a];
  });
}

double largest_coefficient(const Kernel &kernel, double d)
{
  const Sums sums{std::pow(d, kernel.dim()), nearest_reach(kernel.dim(), d),
                  density_scale(kernel, d, kernel.support()).beta,
                  Eigen::Vector3d(1.0, 1.0, kernel.dim() == 3 ? 1.0 : 0.0).asDiagonal()};
  const auto pairs = lattice_pairs(kernel, d);
  const int nz = kernel.dim() == 3 ? WAVES : 0;
  double most = 0.0;
  for (int k = 0; k <= nz; k++)
    for (int j = 0; j <= WAVES; j++)
      for (int i = 0; i <= WAVES; i++) {
        const Eigen::Vector3d wave = M_PI / (WAVES * d) * Eigen::Vector3d(i, j, k);
        const auto values = response(pairs, wave, sums).eigenvalues();
        most = std::max(most, values.cwiseAbs().maxCoeff());
      }
  return 1.0 / (kernel.h() * most);
}

}    // namespace aleisph
