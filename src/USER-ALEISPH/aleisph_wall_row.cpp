// SPDX-License-Identifier: GPL-2.0-only

#include "aleisph_wall_row.h"

#include "aleisph_cloud.h"
#include "aleisph_vectors.h"

#include <Eigen/Dense>

namespace aleisph {
namespace {

// The moments of a row that can be trusted: the smallest pivot over the largest. 0.03 on plane walls
// of a lattice, 0.01 on edges; the moments of points on a line give zero.
constexpr double MIN_PIVOT = 1.0e-3;

// x_j - x_i of pair k, in spacings
Eigen::Vector3d offset(const Cloud &cloud, int k)
{
  return -separation(cloud.stencil(), k) / cloud.spacing();
}

// linear functions, and the quadratic ones that have no Laplacian
template <int D> struct Harmonic {
  static constexpr int SIZE = D == 2 ? 4 : 8;
  using Vector = Eigen::Matrix<double, SIZE, 1>;
  using Matrix = Eigen::Matrix<double, SIZE, SIZE>;

  static Vector at(const Eigen::Vector3d &r)
  {
    const double x = r[0], y = r[1], z = r[2];
    Vector f;
    if constexpr (D == 2)
      f << x, y, x * x - y * y, x * y;
    else
      f << x, y, z, x * x - y * y, 2.0 * z * z - x * x - y * y, x * y, x * z, y * z;
    return f;
  }
};

template <int D> double solve_row(const Cloud &cloud, int i, double *w)
{
  using Basis = Harmonic<D>;
  const Stencil &s = cloud.stencil();
  const double V = cloud.volume(), d = cloud.spacing();
  typename Basis::Matrix moments = Basis::Matrix::Zero();
  for (int k = s.begin(i); k < s.end(i); k++) {
    const auto f = Basis::at(offset(cloud, k));
    const double omega = -V * s.dw()[k] * d / s.r()[k] * d;
    moments += omega * f * f.transpose();
  }
  const Eigen::LDLT<typename Basis::Matrix> solver(moments);
  const auto pivots = solver.vectorD();
  if (!(pivots.minCoeff() > MIN_PIVOT * pivots.maxCoeff())) return -1.0;

  typename Basis::Vector wanted = Basis::Vector::Zero();
  wanted.template head<D>() = at(cloud.normal(), i).head<D>();
  const typename Basis::Vector c = solver.solve(wanted);
  double trace = 0.0;
  for (int k = s.begin(i); k < s.end(i); k++) {
    const Eigen::Vector3d r = offset(cloud, k);
    const double omega = -V * s.dw()[k] * d / s.r()[k] * d;
    w[k - s.begin(i)] = omega * c.dot(Basis::at(r));
    trace += w[k - s.begin(i)] * r.squaredNorm();
  }
  return trace / (2.0 * D);
}

}    // namespace

double gradient_wall_row(const Cloud &cloud, int i, double *w)
{
  const Stencil &s = cloud.stencil();
  const GradientWeights &g = cloud.gradient();
  const Eigen::Vector3d n = at(cloud.normal(), i);
  const Eigen::Vector3d n_L = cloud.spacing() * g.volume() * (packed_matrix(g.inverse(), i) * n);
  double second = 0.0;
  for (int k = s.begin(i); k < s.end(i); k++) {
    const double weight = s.dw()[k] * n_L.dot(direction(s, k));
    w[k - s.begin(i)] = weight;
    const double height = n.dot(offset(cloud, k));
    second += weight * height * height;
  }
  return 0.5 * second;
}

double isotropic_wall_row(const Cloud &cloud, int i, double *w)
{
  return cloud.dim() == 2 ? solve_row<2>(cloud, i, w) : solve_row<3>(cloud, i, w);
}

}    // namespace aleisph
