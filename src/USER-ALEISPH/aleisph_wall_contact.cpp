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

// function(j, omega, x_j - x_i in spacings) for the neighbours j of row i that are fluid as `is_fluid`
// has it
template <class Is, class F> void for_fluid(const Cloud &cloud, int i, Is &&is_fluid, F &&function)
{
  const Stencil &s = cloud.stencil();
  const double d = cloud.spacing();
  for (int k = s.begin(i); k < s.end(i); k++) {
    const int j = s.col()[k];
    if (!is_fluid(cloud.role()[j])) continue;
    const double omega = -cloud.volume() * s.dw()[k] * d * d / s.r()[k];
    function(j, omega, Eigen::Vector3d(-separation(s, k) / d));
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
  for_fluid(cloud, i, any_fluid, [&](int j, double omega, const Eigen::Vector3d &) {
    mean.weight += omega;
    mean.v += omega * at(v, j);
  });
  if (mean.weight > 0.0) mean.v /= mean.weight;
  return mean;
}

// of value(j) over the fluid neighbours of particle i, at i; NaN is not known
template <int D, class F> void fit(const Cloud &cloud, int i, const F &value, double &at_i)
{
  using Vector = Eigen::Matrix<double, D + 1, 1>;
  using Matrix = Eigen::Matrix<double, D + 1, D + 1>;
  Matrix moments = Matrix::Zero();
  Vector right = Vector::Zero();
  for_fluid(cloud, i, bound_fluid, [&](int j, double omega, const Eigen::Vector3d &r) {
    const double of_j = value(j);
    if (std::isnan(of_j)) return;
    Vector f;
    f << 1.0, r.head<D>();
    moments += omega * f * f.transpose();
    right += omega * of_j * f;
  });
  if (moments(0, 0) == 0.0) return;
  const Eigen::LDLT<Matrix> solver(moments);
  const Vector pivots = solver.vectorD();
  const bool determined = pivots.minCoeff() > MIN_PIVOT * pivots.maxCoeff();
  at_i = determined ? Vector(solver.solve(right))[0] : right[0] / moments(0, 0);
}

template <class F> void fit(const Cloud &cloud, int i, const F &value, double &at_i)
{
  if (cloud.dim() == 2)
    fit<2>(cloud, i, value, at_i);
  else
    fit<3>(cloud, i, value, at_i);
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

void normal_part_of_fluid(const Cloud &cloud, const Rows &walls, const double *v, double *out)
{
  for_rows(walls, [&](int i) {
    const Eigen::Vector3d n = at(cloud.normal(), i);
    fit(
        cloud, i, [&](int j) { return n.dot(at(v, j)); }, out[i]);
  });
}

void fit_to_fluid(const Cloud &cloud, const Rows &rows, double *f)
{
  for_rows(rows, [&](int i) {
    fit(
        cloud, i, [f](int j) { return f[j]; }, f[i]);
  });
}

void mean_of_fluid(const Cloud &cloud, const Rows &walls, double *f)
{
  for_rows(walls, [&](int i) {
    double sum = 0.0, weights = 0.0;
    for_fluid(cloud, i, bound_fluid, [&](int j, double omega, const Eigen::Vector3d &) {
      if (cloud.role()[j] & SURFACE) return;
      sum += omega * f[j];
      weights += omega;
    });
    f[i] = weights > 0.0 ? sum / weights : 0.0;
  });
}

}    // namespace aleisph
