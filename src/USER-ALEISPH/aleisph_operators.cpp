// SPDX-License-Identifier: GPL-2.0-only
/* ----------------------------------------------------------------------
   Gradient weights, Morikawa, Tsuji & Asai eqs 8-10, and the first-order
   operators that use them. V = volume of a particle, w = V dW/dr, so that
   V gradW_ij = w e_ij and M_i = -sum_j w r e_ij (x) e_ij, which is
   symmetric, dimensionless and positive semi-definite.
   In 2d all weights lie in the plane; vector fields keep three components.
------------------------------------------------------------------------- */

#include "aleisph_operators.h"

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>

namespace aleisph {
namespace {

template <int D> using Vec = Eigen::Matrix<double, D, 1>;
template <int D> using Mat = Eigen::Matrix<double, D, D>;

template <class T> double held(const std::vector<T> &v)
{
  return static_cast<double>(v.capacity()) * sizeof(T);
}

template <int D> struct Pointers {
  const double *c[D];
  Vec<D> operator()(int k) const
  {
    Vec<D> v;
    for (int a = 0; a < D; a++) v[a] = c[a][k];
    return v;
  }
};

template <int D> Pointers<D> directions(const Stencil &s)
{
  Pointers<D> p;
  for (int a = 0; a < D; a++) p.c[a] = s.e(a);
  return p;
}

template <int D> Pointers<D> weights(const GradientWeights &g)
{
  Pointers<D> p;
  for (int a = 0; a < D; a++) p.c[a] = g.g(a);
  return p;
}

template <int D> Mat<D> moment(const Stencil &s, const Pointers<D> &e, int i, double volume)
{
  const double *r = s.r(), *dw = s.dw();
  Mat<D> M = Mat<D>::Zero();
  for (int k = s.begin(i); k < s.end(i); k++) {
    const Vec<D> e_ij = e(k);
    M.noalias() -= (dw[k] * r[k]) * e_ij * e_ij.transpose();
  }
  return volume * M;
}

double smallest_eigenvalue(const Mat<2> &M)
{
  const double mean = 0.5 * (M(0, 0) + M(1, 1));
  return mean - std::hypot(0.5 * (M(0, 0) - M(1, 1)), M(0, 1));
}

double smallest_eigenvalue(const Mat<3> &M)
{
  // the iterative solver: Eigen's closed form for 3x3 loses half of the digits
  return Eigen::SelfAdjointEigenSolver<Mat<3>>(M, Eigen::EigenvaluesOnly).eigenvalues()[0];
}

// M^-1 with the eigenvalues of M not below floor
template <int D> Mat<D> floored_inverse(const Mat<D> &M, double floor)
{
  const Eigen::SelfAdjointEigenSolver<Mat<D>> eigen(M);
  const Vec<D> inverse = eigen.eigenvalues().cwiseMax(floor).cwiseInverse();
  return eigen.eigenvectors() * inverse.asDiagonal() * eigen.eigenvectors().transpose();
}

struct InverseCount {
  int singular = 0, clamped = 0;
};

template <int D>
Mat<D> inverse_moment(const Mat<D> &M, double lambda, double floor, InverseCount &count)
{
  if (floor > 0.0 && lambda < floor) {
    count.clamped++;
    return floored_inverse<D>(M, floor);
  }
  if (lambda >= GradientWeights::MIN_LAMBDA) return M.inverse();
  count.singular++;
  return Mat<D>::Zero();
}

// floor of each row: `floor` for the rows listed, else 0; empty if there is none at all
std::vector<double> row_floors(int nrows, const Rows &floored, double floor)
{
  std::vector<double> floors;
  if (floor <= 0.0 || floored.empty()) return floors;
  floors.assign(nrows, 0.0);
  for (const int i : floored) floors[i] = floor;
  return floors;
}

// writes g of the pairs of every row and lambda
template <int D>
InverseCount build_gradient(const Stencil &s, double volume, const std::vector<double> &floors,
                            std::array<std::vector<double>, 3> &g, std::vector<double> &lambda)
{
  const Pointers<D> e = directions<D>(s);
  const double *dw = s.dw();
  InverseCount count;
  for (int i = 0; i < s.rows(); i++) {
    const Mat<D> M = moment<D>(s, e, i, volume);
    lambda[i] = smallest_eigenvalue(M);
    const Mat<D> L = inverse_moment<D>(M, lambda[i], floors.empty() ? 0.0 : floors[i], count);
    for (int k = s.begin(i); k < s.end(i); k++) {
      const Vec<D> g_ij = (volume * dw[k]) * (L * e(k));
      for (int a = 0; a < D; a++) g[a][k] = g_ij[a];
    }
  }
  return count;
}

template <int D>
void store_inverses(const Stencil &s, const Rows &rows, double volume, double floor,
                    double *inverse)
{
  const Pointers<D> e = directions<D>(s);
  InverseCount unused;
  for (const int i : rows) {
    const Mat<D> M = moment<D>(s, e, i, volume);
    Mat<3> L = Mat<3>::Zero();
    L.template topLeftCorner<D, D>() = inverse_moment<D>(M, smallest_eigenvalue(M), floor, unused);
    const double packed[6] = {L(0, 0), L(1, 1), L(2, 2), L(0, 1), L(0, 2), L(1, 2)};
    std::copy(packed, packed + 6, inverse + 6 * i);
  }
}

inline Vec<3> at(const double *v, int j)
{
  return Vec<3>(v[3 * j], v[3 * j + 1], v[3 * j + 2]);
}

inline void store(const Vec<3> &value, double *v, int i)
{
  for (int a = 0; a < 3; a++) v[3 * i + a] = value[a];
}

// g_ij as a space vector
template <int D> Vec<3> in_space(const Vec<D> &g_ij)
{
  Vec<3> v = Vec<3>::Zero();
  v.template head<D>() = g_ij;
  return v;
}

template <int D>
void gradient_rows(const Stencil &s, const Pointers<D> &g, const Rows &rows, const double *f,
                   double *grad)
{
  const int *col = s.col();
  for (int i : rows) {
    Vec<D> sum = Vec<D>::Zero();
    for (int k = s.begin(i); k < s.end(i); k++) sum += g(k) * (f[col[k]] - f[i]);
    store(in_space<D>(sum), grad, i);
  }
}

// v_j - v_i; of a slip wall only its normal part, as the tangential one follows the fluid
inline Vec<3> difference(const double *v, int i, int j, const Role *role, const double *normal)
{
  const Vec<3> dv = at(v, j) - at(v, i);
  if (!normal || !(role[j] & SLIP)) return dv;
  const Vec<3> n_j = at(normal, j);
  return n_j * n_j.dot(dv);
}

template <int D>
void divergence_rows(const Stencil &s, const Pointers<D> &g, const Rows &rows, const double *v,
                     const Role *role, const double *normal, double *div)
{
  const int *col = s.col();
  for (int i : rows) {
    double sum = 0.0;
    for (int k = s.begin(i); k < s.end(i); k++)
      sum += g(k).dot(difference(v, i, col[k], role, normal).template head<D>());
    div[i] = sum;
  }
}

template <int D>
void convection_rows(const Stencil &s, const Pointers<D> &g, const Rows &rows, const double *c,
                     const double *v, const Role *role, const double *normal, double *out)
{
  const int *col = s.col();
  for (int i : rows) {
    const Vec<D> c_i = at(c, i).template head<D>();
    Vec<3> sum = Vec<3>::Zero();
    for (int k = s.begin(i); k < s.end(i); k++)
      sum += c_i.dot(g(k)) * difference(v, i, col[k], role, normal);
    store(sum, out, i);
  }
}

template <int D>
void velocity_gradient_rows(const Stencil &s, const Pointers<D> &g, const Rows &rows,
                            const double *v, const Role *role, const double *normal, double *out)
{
  const int *col = s.col();
  for (int i : rows) {
    Mat<3> sum = Mat<3>::Zero();
    for (int k = s.begin(i); k < s.end(i); k++)
      sum += difference(v, i, col[k], role, normal) * in_space<D>(g(k)).transpose();
    Eigen::Map<Eigen::Matrix<double, 3, 3, Eigen::RowMajor>>(out + 9 * i) = sum;
  }
}

template <int D>
void curl_rows(const Stencil &s, const Pointers<D> &g, const Rows &rows, const double *v,
               double *out)
{
  const int *col = s.col();
  for (int i : rows) {
    Vec<3> sum = Vec<3>::Zero();
    for (int k = s.begin(i); k < s.end(i); k++)
      sum += in_space<D>(g(k)).cross(at(v, col[k]) - at(v, i));
    store(sum, out, i);
  }
}

}    // namespace

void GradientWeights::build(const Stencil &s, double volume, const Rows &floored, double floor)
{
  for (int a = 0; a < 3; a++) g_[a].resize(a < s.dim() ? s.pairs() : 0);
  lambda_.resize(s.rows());
  const std::vector<double> floors = row_floors(s.rows(), floored, floor);
  const InverseCount count = s.dim() == 2 ? build_gradient<2>(s, volume, floors, g_, lambda_)
                                          : build_gradient<3>(s, volume, floors, g_, lambda_);
  singular_ = count.singular;
  clamped_ = count.clamped;
}

void inverse_moments(const Stencil &s, const Rows &rows, double volume, double floor,
                     double *inverse)
{
  if (s.dim() == 2)
    store_inverses<2>(s, rows, volume, floor, inverse);
  else
    store_inverses<3>(s, rows, volume, floor, inverse);
}

double GradientWeights::bytes() const
{
  return held(g_[0]) + held(g_[1]) + held(g_[2]) + held(lambda_);
}

void gradient(const Stencil &s, const GradientWeights &g, const Rows &rows, const double *f,
              double *grad)
{
  if (s.dim() == 2)
    gradient_rows<2>(s, weights<2>(g), rows, f, grad);
  else
    gradient_rows<3>(s, weights<3>(g), rows, f, grad);
}

void divergence(const Stencil &s, const GradientWeights &g, const Rows &rows, const double *v,
                const Role *role, const double *normal, double *div)
{
  if (s.dim() == 2)
    divergence_rows<2>(s, weights<2>(g), rows, v, role, normal, div);
  else
    divergence_rows<3>(s, weights<3>(g), rows, v, role, normal, div);
}

void convection(const Stencil &s, const GradientWeights &g, const Rows &rows, const double *c,
                const double *v, const Role *role, const double *normal, double *out)
{
  if (s.dim() == 2)
    convection_rows<2>(s, weights<2>(g), rows, c, v, role, normal, out);
  else
    convection_rows<3>(s, weights<3>(g), rows, c, v, role, normal, out);
}

void velocity_gradient(const Stencil &s, const GradientWeights &g, const Rows &rows,
                       const double *v, const Role *role, const double *normal, double *out)
{
  if (s.dim() == 2)
    velocity_gradient_rows<2>(s, weights<2>(g), rows, v, role, normal, out);
  else
    velocity_gradient_rows<3>(s, weights<3>(g), rows, v, role, normal, out);
}

void curl(const Stencil &s, const GradientWeights &g, const Rows &rows, const double *v,
          double *out)
{
  if (s.dim() == 2)
    curl_rows<2>(s, weights<2>(g), rows, v, out);
  else
    curl_rows<3>(s, weights<3>(g), rows, v, out);
}

}    // namespace aleisph
