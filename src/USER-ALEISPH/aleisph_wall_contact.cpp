// SPDX-License-Identifier: GPL-2.0-only

#include "aleisph_wall_contact.h"

#include "aleisph_cloud.h"
#include "aleisph_vectors.h"

#include <Eigen/Dense>

#include <cmath>

namespace aleisph {
namespace {

// Smallest over largest pivot of the moments of a fit that is trusted. On plane walls of a lattice,
// where two layers are within the support, it is 0.02; where there is one layer, zero.
constexpr double MIN_PIVOT = 2.0e-3;

// function(k, omega, x_j - x_i in spacings) for the pairs k of row i whose j is fluid as `is_fluid`
// has it
template <class Is, class F> void for_fluid(const Cloud &cloud, int i, Is &&is_fluid, F &&function)
{
  const Stencil &s = cloud.stencil();
  const double d = cloud.spacing();
  for (int k = s.begin(i); k < s.end(i); k++) {
    if (!is_fluid(cloud.role()[s.col()[k]])) continue;
    const double omega = -cloud.volume() * s.dw()[k] * d * d / s.r()[k];
    function(k, omega, Eigen::Vector3d(-separation(s, k) / d));
  }
}

// what flies freely slides along walls, too
bool any_fluid(Role role)
{
  return (role & FLUID) && !(role & (WALL | BUFFER));
}

struct Mean {
  double weight = 0.0;
  Eigen::Vector3d v = Eigen::Vector3d::Zero();
};

Mean mean_velocity(const Cloud &cloud, int i, const double *v)
{
  Mean mean;
  for_fluid(cloud, i, any_fluid, [&](int k, double omega, const Eigen::Vector3d &) {
    mean.weight += omega;
    mean.v += omega * at(v, cloud.stencil().col()[k]);
  });
  if (mean.weight > 0.0) mean.v /= mean.weight;
  return mean;
}

// set(k, weight) for the pairs k of the fit at particle i to those fluid neighbours j that are known(j)
template <int D, class Known, class Set>
void fit(const Cloud &cloud, int i, const Known &known, const Set &set)
{
  using Vector = Eigen::Matrix<double, D + 1, 1>;
  using Matrix = Eigen::Matrix<double, D + 1, D + 1>;
  const auto for_known = [&](const auto &function) {
    for_fluid(cloud, i, bound_fluid, [&](int k, double omega, const Eigen::Vector3d &r) {
      if (!known(cloud.stencil().col()[k])) return;
      Vector f;
      f << 1.0, r.head<D>();
      function(k, omega, f);
    });
  };
  Matrix moments = Matrix::Zero();
  for_known([&](int, double omega, const Vector &f) { moments += omega * f * f.transpose(); });
  if (moments(0, 0) == 0.0) return;
  const Eigen::LDLT<Matrix> solver(moments);
  const Vector pivots = solver.vectorD();
  const bool determined = pivots.minCoeff() > MIN_PIVOT * pivots.maxCoeff();
  const Vector constant = Vector::Unit(0);
  const Vector c = determined ? Vector(solver.solve(constant)) : Vector(constant / moments(0, 0));
  for_known([&](int k, double omega, const Vector &f) { set(k, omega * c.dot(f)); });
}

template <class Known, class Set>
void fit(const Cloud &cloud, int i, const Known &known, const Set &set)
{
  if (cloud.dim() == 2)
    fit<2>(cloud, i, known, set);
  else
    fit<3>(cloud, i, known, set);
}

}    // namespace

Rows slip_walls(const Cloud &cloud)
{
  return select_rows(cloud.wall(), [&](int i) { return cloud.role()[i] & SLIP; });
}

void slide_with_fluid(const Cloud &cloud, const Rows &walls, double *v)
{
  for_rows(walls, [&](int i) {
    const Mean mean = mean_velocity(cloud, i, v);
    if (mean.weight == 0.0) return;
    const Eigen::Vector3d n = at(cloud.normal(), i);
    Eigen::Map<Eigen::Vector3d> own(v + 3 * i);
    own = mean.v + n * n.dot(own - mean.v);
  });
}

FluidFit fit_to_walls(const Cloud &cloud, const Rows &walls)
{
  const Stencil &s = cloud.stencil();
  FluidFit result{walls, {}, {}};
  std::size_t pairs = 0;
  for_rows(walls, [&](int i) {
    result.offset.push_back(pairs);
    pairs += s.end(i) - s.begin(i);
  });
  result.weight.assign(pairs, 0.0);
  for_rows(static_cast<int>(walls.size()), [&](int n) {
    double *const weight = result.weight.data() + result.offset[n];
    const int first = s.begin(walls[n]);
    fit(
        cloud, walls[n], [](int) { return true; }, [&](int k, double w) { weight[k - first] = w; });
  });
  return result;
}

void normal_part_of_fluid(const Cloud &cloud, const FluidFit &fit, const double *v, double *out)
{
  const Stencil &s = cloud.stencil();
  for_rows(static_cast<int>(fit.walls.size()), [&](int n) {
    const int i = fit.walls[n], first = s.begin(i);
    const double *const weight = fit.weight.data() + fit.offset[n];
    const Eigen::Vector3d normal = at(cloud.normal(), i);
    double sum = 0.0;
    bool any = false;
    for (int k = first; k < s.end(i); k++) {
      if (weight[k - first] == 0.0) continue;
      any = true;
      sum += weight[k - first] * normal.dot(at(v, s.col()[k]));
    }
    if (any) out[i] = sum;
  });
}

void mean_normal_part(const Cloud &cloud, const Rows &walls, const double *v, double *out)
{
  for_rows(walls, [&](int i) {
    const Mean mean = mean_velocity(cloud, i, v);
    if (mean.weight > 0.0) out[i] = mean.v.dot(at(cloud.normal(), i));
  });
}

void fit_to_fluid(const Cloud &cloud, const Rows &rows, double *f)
{
  const int *col = cloud.stencil().col();
  for_rows(rows, [&](int i) {
    double sum = 0.0;
    bool any = false;
    fit(
        cloud, i, [f](int j) { return !std::isnan(f[j]); },
        [&](int k, double weight) {
          sum += weight * f[col[k]];
          any = true;
        });
    if (any) f[i] = sum;
  });
}

void mean_of_fluid(const Cloud &cloud, const Rows &walls, double *f)
{
  for_rows(walls, [&](int i) {
    double sum = 0.0, weights = 0.0;
    for_fluid(cloud, i, bound_fluid, [&](int k, double omega, const Eigen::Vector3d &) {
      const int j = cloud.stencil().col()[k];
      if (cloud.role()[j] & SURFACE) return;
      sum += omega * f[j];
      weights += omega;
    });
    f[i] = weights > 0.0 ? sum / weights : 0.0;
  });
}

}    // namespace aleisph
