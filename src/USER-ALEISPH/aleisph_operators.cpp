// SPDX-License-Identifier: GPL-2.0-only
/* ----------------------------------------------------------------------
   First-order operators, Morikawa, Tsuji & Asai eq 9. As g_ij = V dW/dr L_i e_ij
   with a symmetric L_i, the sums run over dW/dr e_ij, and V L_i is applied to
   their result: sum_j g_ij f_ij = V L_i sum_j dW/dr e_ij f_ij.
   In 2d all weights lie in the plane; vector fields keep three components.
------------------------------------------------------------------------- */

#include "aleisph_operators.h"

#include "aleisph_cloud.h"
#include "aleisph_vectors.h"

#include <Eigen/Dense>
#include <array>
#include <type_traits>

namespace aleisph {
namespace {

template <int D> using Vec = Eigen::Matrix<double, D, 1>;
template <int D> using Mat = Eigen::Matrix<double, D, D>;

// components beyond D are zero
template <int D> inline void store(const Vec<D> &value, double *v, int i)
{
  for (int a = 0; a < 3; a++) v[3 * i + a] = a < D ? value[a] : 0.0;
}

// V L_i
template <int D> inline Mat<D> correction(const GradientWeights &g, int i)
{
  return g.volume() * packed_matrix(g.inverse(), i).topLeftCorner<D, D>();
}

// sum V L_i as a matrix of space
template <int D>
inline Mat<3> in_space(const Eigen::Matrix<double, 3, D> &sum, const Mat<D> &correction)
{
  Mat<3> product = Mat<3>::Zero();
  for (int a = 0; a < 3; a++)
    for (int b = 0; b < D; b++)
      for (int c = 0; c < D; c++) product(a, b) += sum(a, c) * correction(c, b);
  return product;
}

// Sums over the pairs of a row
template <int D> class KernelSums {
 public:
  explicit KernelSums(const Cloud &cloud) : s_(cloud.stencil()), col_(s_.col()), dw_(s_.dw())
  {
    for (int b = 0; b < D; b++) e_[b] = s_.e(b);
  }

  static constexpr int DIM = D;

  // sum_j (f_j - f_i) dW/dr e_ij, in four independent sums
  Vec<D> scalar(int i, const double *f) const
  {
    constexpr int WIDTH = 4;
    double sum[D][WIDTH] = {};
    const double f_i = f[i];
    int k = s_.begin(i);
    for (; k + WIDTH <= s_.end(i); k += WIDTH)
      for (int l = 0; l < WIDTH; l++) {
        const double weight = (f[col_[k + l]] - f_i) * dw_[k + l];
        for (int b = 0; b < D; b++) sum[b][l] += weight * e_[b][k + l];
      }
    for (; k < s_.end(i); k++)
      for (int b = 0; b < D; b++) sum[b][0] += (f[col_[k]] - f_i) * dw_[k] * e_[b][k];
    Vec<D> total;
    for (int b = 0; b < D; b++) total[b] = (sum[b][0] + sum[b][1]) + (sum[b][2] + sum[b][3]);
    return total;
  }

  // sum_j (v_j - v_i) (x) dW/dr e_ij of the first C components of v
  template <int C> Eigen::Matrix<double, C, D> vector(int i, const double *v) const
  {
    double sum[C][D] = {};
    const double *const v_i = v + 3 * i;
    for (int k = s_.begin(i); k < s_.end(i); k++) {
      const int j = col_[k];
      double dv[C];
      for (int a = 0; a < C; a++) dv[a] = v[3 * j + a] - v_i[a];
      for (int b = 0; b < D; b++) {
        const double weight = dw_[k] * e_[b][k];
        for (int a = 0; a < C; a++) sum[a][b] += dv[a] * weight;
      }
    }
    Eigen::Matrix<double, C, D> total;
    for (int a = 0; a < C; a++)
      for (int b = 0; b < D; b++) total(a, b) = sum[a][b];
    return total;
  }

 private:
  const Stencil &s_;
  const int *col_;
  const double *dw_;
  std::array<const double *, D> e_;
};

// calls function with the sums of this dimension, so that a loop over rows decides once
template <class Function> void with_sums(const Cloud &cloud, Function function)
{
  if (cloud.dim() == 2)
    function(KernelSums<2>(cloud));
  else
    function(KernelSums<3>(cloud));
}

}    // namespace

void gradient(const Cloud &cloud, const Rows &rows, const double *f, double *grad)
{
  const GradientWeights &g = cloud.gradient();
  with_sums(cloud, [&](const auto &sums) {
    constexpr int D = std::decay_t<decltype(sums)>::DIM;
    for_rows(rows, [&](int i) { store<D>(correction<D>(g, i) * sums.scalar(i, f), grad, i); });
  });
}

void divergence(const Cloud &cloud, const Rows &rows, const double *v, double *div)
{
  const GradientWeights &g = cloud.gradient();
  with_sums(cloud, [&](const auto &sums) {
    constexpr int D = std::decay_t<decltype(sums)>::DIM;
    for_rows(rows, [&](int i) {
      div[i] = sums.template vector<D>(i, v).cwiseProduct(correction<D>(g, i)).sum();
    });
  });
}

void convection(const Cloud &cloud, const Rows &rows, const double *c, const double *v, double *out)
{
  const GradientWeights &g = cloud.gradient();
  with_sums(cloud, [&](const auto &sums) {
    constexpr int D = std::decay_t<decltype(sums)>::DIM;
    for_rows(rows, [&](int i) {
      const Vec<D> weight = correction<D>(g, i) * Eigen::Map<const Vec<D>>(c + 3 * i);
      store<3>(sums.template vector<3>(i, v) * weight, out, i);
    });
  });
}

void velocity_gradient(const Cloud &cloud, const Rows &rows, const double *v, double *out)
{
  const GradientWeights &g = cloud.gradient();
  with_sums(cloud, [&](const auto &sums) {
    constexpr int D = std::decay_t<decltype(sums)>::DIM;
    for_rows(rows, [&](int i) {
      Eigen::Map<Eigen::Matrix<double, 3, 3, Eigen::RowMajor>>(out + 9 * i) = in_space<D>(
          sums.template vector<3>(i, v), correction<D>(g, i));
    });
  });
}

void curl(const Cloud &cloud, const Rows &rows, const double *v, double *out)
{
  const GradientWeights &g = cloud.gradient();
  with_sums(cloud, [&](const auto &sums) {
    constexpr int D = std::decay_t<decltype(sums)>::DIM;
    for_rows(rows, [&](int i) {
      const Mat<3> grad = in_space<D>(sums.template vector<3>(i, v), correction<D>(g, i));
      store<3>(Vec<3>(grad(2, 1) - grad(1, 2), grad(0, 2) - grad(2, 0), grad(1, 0) - grad(0, 1)),
               out, i);
    });
  });
}

}    // namespace aleisph
