// SPDX-License-Identifier: GPL-2.0-only

#include "dense.h"

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>
#include <utility>

namespace aleisph_test {

using namespace aleisph;

namespace {

using Real = long double;
using Matrix = std::vector<std::vector<Real>>;

Matrix zeros(int rows, int columns)
{
  return Matrix(rows, std::vector<Real>(columns, 0.0L));
}

// A x = b by elimination with row pivoting
std::vector<Real> solve(Matrix A, std::vector<Real> b)
{
  const int n = static_cast<int>(b.size());
  for (int p = 0; p < n; p++) {
    int best = p;
    for (int q = p + 1; q < n; q++)
      if (std::fabs(A[q][p]) > std::fabs(A[best][p])) best = q;
    std::swap(A[p], A[best]);
    std::swap(b[p], b[best]);
    for (int q = p + 1; q < n; q++) {
      const Real factor = A[q][p] / A[p][p];
      for (int c = p; c < n; c++) A[q][c] -= factor * A[p][c];
      b[q] -= factor * b[p];
    }
  }
  for (int p = n - 1; p >= 0; p--) {
    for (int c = p + 1; c < n; c++) b[p] -= A[p][c] * b[c];
    b[p] /= A[p][p];
  }
  return b;
}

struct Pair {
  int j;
  std::array<Real, 3> r, gradw;    // r_ij and V gradW_ij
  Real r2;
};

std::vector<Pair> pairs_of(const Kernel &kernel, double volume, const PointSet &cloud, int i)
{
  std::vector<Pair> pairs;
  for (int j = 0; j < cloud.total(); j++) {
    Pair p = {j, {}, {}, 0.0L};
    for (int a = 0; a < kernel.dim(); a++) {
      p.r[a] = static_cast<Real>(cloud.point(i)[a]) - cloud.point(j)[a];
      p.r2 += p.r[a] * p.r[a];
    }
    const Real r = std::sqrt(p.r2);
    if (r == 0.0L || r >= kernel.support()) continue;
    for (int a = 0; a < 3; a++)
      p.gradw[a] = volume * kernel.dw(static_cast<double>(r)) * p.r[a] / r;
    pairs.push_back(p);
  }
  return pairs;
}

Matrix moment(const std::vector<Pair> &pairs, int D)
{
  Matrix M = zeros(D, D);
  for (const Pair &p : pairs)
    for (int a = 0; a < D; a++)
      for (int b = 0; b < D; b++) M[a][b] -= p.gradw[a] * p.r[b];
  return M;
}

using Tensor3 = Real[3][3][3];

struct Tensors {
  Real Q[3][3][3][3] = {};
  Tensor3 T = {}, LR = {};    // T_abc and L_cd R_mnd, the latter as [c][m][n]
};

Tensors tensors(const std::vector<Pair> &pairs, const std::vector<std::array<Real, 3>> &g, int D)
{
  Tensors t;
  for (std::size_t q = 0; q < pairs.size(); q++) {
    const Pair &p = pairs[q];
    for (int a = 0; a < D; a++)
      for (int b = 0; b < D; b++)
        for (int m = 0; m < D; m++) {
          const Real S = p.r[a] * p.gradw[b] / p.r2;
          t.T[a][b][m] += S * p.r[m];
          t.LR[a][b][m] += g[q][a] * p.r[b] * p.r[m];
          for (int n = 0; n < D; n++) t.Q[a][b][m][n] += S * p.r[m] * p.r[n];
        }
  }
  return t;
}

// eq. 14 for the unknowns B_ab, a <= b: one equation per (m, n), m <= n
struct SystemB {
  std::vector<std::pair<int, int>> index;
  Matrix A;
  std::vector<Real> rhs;
};

SystemB system_b(const Tensors &t, int D)
{
  SystemB s;
  for (int a = 0; a < D; a++)
    for (int b = a; b < D; b++) s.index.push_back({a, b});
  const int K = static_cast<int>(s.index.size());
  s.A = zeros(K, K);
  for (int l = 0; l < K; l++) {
    const auto [m, n] = s.index[l];
    for (int a = 0; a < D; a++)
      for (int b = 0; b < D; b++) {
        Real value = t.Q[a][b][m][n];
        for (int c = 0; c < D; c++) value += t.T[a][b][c] * t.LR[c][m][n];
        for (int k = 0; k < K; k++)
          if (s.index[k] == std::pair<int, int>(std::min(a, b), std::max(a, b))) s.A[l][k] += value;
      }
    s.rhs.push_back(m == n ? -1.0L : 0.0L);
  }
  return s;
}

// in an orthonormal basis of the symmetric matrices: off-diagonal unknowns and equations
// carry sqrt 2
double condition_number(const SystemB &s)
{
  const int K = static_cast<int>(s.index.size());
  Eigen::MatrixXd G(K, K);
  for (int l = 0; l < K; l++)
    for (int k = 0; k < K; k++) {
      const double row = s.index[l].first == s.index[l].second ? 1.0 : std::sqrt(2.0);
      const double column = s.index[k].first == s.index[k].second ? 1.0 : std::sqrt(2.0);
      G(l, k) = static_cast<double>(s.A[l][k]) * row / column;
    }
  const Eigen::VectorXd sigma = Eigen::JacobiSVD<Eigen::MatrixXd>(G).singularValues();
  return sigma[0] / sigma[K - 1];
}

double smallest_eigenvalue(const Matrix &M, int D)
{
  Eigen::MatrixXd E(D, D);
  for (int a = 0; a < D; a++)
    for (int b = 0; b < D; b++) E(a, b) = static_cast<double>(M[a][b]);
  return Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd>(E).eigenvalues()[0];
}

std::vector<std::array<Real, 3>> gradient_weights(const std::vector<Pair> &pairs, const Matrix &M)
{
  const int D = static_cast<int>(M.size());
  std::vector<std::array<Real, 3>> g;
  for (const Pair &p : pairs) {
    const std::vector<Real> x = solve(M, {p.gradw.begin(), p.gradw.begin() + D});
    std::array<Real, 3> g_ij = {};
    std::copy(x.begin(), x.end(), g_ij.begin());
    g.push_back(g_ij);
  }
  return g;
}

// A_ij of eq. 12 and its correction, eq. 13
std::vector<Real> laplacian_weights(const std::vector<Pair> &pairs,
                                    const std::vector<std::array<Real, 3>> &g, const SystemB &s)
{
  const std::vector<Real> B = solve(s.A, s.rhs);
  std::vector<Real> A;
  std::array<Real, 3> P = {};
  for (const Pair &p : pairs) {
    Real sum = 0.0L;
    for (std::size_t k = 0; k < B.size(); k++) {
      const auto [a, b] = s.index[k];
      sum += 2.0L * B[k] * p.r[a] * p.gradw[b] / p.r2 * (a == b ? 1.0L : 2.0L);
    }
    A.push_back(sum);
    for (int c = 0; c < 3; c++) P[c] += sum * p.r[c];
  }
  for (std::size_t q = 0; q < pairs.size(); q++)
    for (int c = 0; c < 3; c++) A[q] += P[c] * g[q][c];
  return A;
}

}    // namespace

DenseRow dense_row(const Kernel &kernel, double volume, const PointSet &cloud, int i)
{
  const int D = kernel.dim();
  const std::vector<Pair> pairs = pairs_of(kernel, volume, cloud, i);
  const Matrix M = moment(pairs, D);
  const auto g = gradient_weights(pairs, M);
  const SystemB system = system_b(tensors(pairs, g, D), D);
  const std::vector<Real> a = laplacian_weights(pairs, g, system);

  DenseRow row;
  row.g.assign(cloud.total(), {0.0, 0.0, 0.0});
  row.a.assign(cloud.total(), 0.0);
  for (std::size_t q = 0; q < pairs.size(); q++) {
    row.a[pairs[q].j] = static_cast<double>(a[q]);
    for (int c = 0; c < 3; c++) row.g[pairs[q].j][c] = static_cast<double>(g[q][c]);
  }
  row.lambda = smallest_eigenvalue(M, D);
  row.condition = condition_number(system);
  return row;
}

}    // namespace aleisph_test
