// SPDX-License-Identifier: GPL-2.0-only
/* ----------------------------------------------------------------------
   R = S L with S = sum_j w r^2 m_ij (x) e_ij, so that one pass over the pairs
   is enough. Q = sum_j w r m_ij (x) m_ij, S and T are totally symmetric
   tensors; only their different entries are summed, which are monomials
   x^nx y^ny z^nz of the components of e_ij, of degree 3 or 4, in the order
   of monomial().
   In the bulk -G is near a positive definite matrix and is inverted without
   pivoting, LANES rows at a time; a row that meets a small pivot is inverted
   again, with pivoting.
------------------------------------------------------------------------- */

#include "aleisph_operators_laplacian_system.h"

#include "aleisph_operators_pack.h"
#include "aleisph_vectors.h"

#include <Eigen/Dense>
#include <cmath>
#include <limits>

namespace aleisph {
namespace {

constexpr double SQRT2 = 1.41421356237309504880;
constexpr double INF = std::numeric_limits<double>::infinity();

// A pivot below this share of the largest entry of G is small; the smallest in the bulk has 2/3.
// Growth by its inverse, 20, costs little more than one of 16 digits.
constexpr double SMALL_PIVOT = 0.05;

template <int D> constexpr int K = D *(D + 1) / 2;

// Mandel's basis: xx yy xy, in 3d xx yy zz yz xz xy, as powers of y and z
struct Powers {
  int y, z;
};
template <int D> constexpr Powers mandel(int m)
{
  constexpr Powers plane[] = {{0, 0}, {2, 0}, {1, 0}};
  constexpr Powers space[] = {{0, 0}, {2, 0}, {0, 2}, {1, 1}, {0, 1}, {1, 0}};
  return D == 2 ? plane[m] : space[m];
}
template <int D> constexpr double factor(int m)
{
  return m < D ? 1.0 : SQRT2;
}
constexpr Powers operator+(Powers a, Powers b)
{
  return {a.y + b.y, a.z + b.z};
}
constexpr Powers axis(int a)
{
  return {a == 1, a == 2};
}

// place of a monomial of this degree: by powers of z, then of y
constexpr int monomial(int degree, Powers p)
{
  return p.z * (degree + 1) - p.z * (p.z - 1) / 2 + p.y;
}
template <int D> constexpr int monomials(int degree)
{
  return D == 2 ? degree + 1 : (degree + 1) * (degree + 2) / 2;
}

template <int D> struct Sums {
  Pack t[monomials<D>(3)], s[monomials<D>(3)], q[monomials<D>(4)];
};

inline void add_pair(const Pack (&e)[2], const Pack &w, const Pack &r, Sums<2> &sums)
{
  const Pack &x = e[0], &y = e[1];
  const Pack xx = x * x, xy = x * y, yy = y * y;
  const Pack third[] = {xx * x, xx * y, xy * y, yy * y};
  const Pack fourth[] = {xx * xx, xx * xy, xx * yy, xy * yy, yy * yy};
  const Pack wr = w * r, wr2 = wr * r;
  for (int m = 0; m < 4; m++) sums.t[m] += w * third[m];
  for (int m = 0; m < 4; m++) sums.s[m] += wr2 * third[m];
  for (int m = 0; m < 5; m++) sums.q[m] += wr * fourth[m];
}

inline void add_pair(const Pack (&e)[3], const Pack &w, const Pack &r, Sums<3> &sums)
{
  const Pack &x = e[0], &y = e[1], &z = e[2];
  const Pack xx = x * x, yy = y * y, zz = z * z, xy = x * y, xz = x * z, yz = y * z;
  const Pack third[] = {xx * x, xx * y, xy * y, yy * y, xx * z,
                        xy * z, yy * z, x * zz, y * zz, z * zz};
  const Pack fourth[] = {xx * xx, xx * xy, xx * yy, xy * yy, yy * yy, xx * xz, xx * yz, xy * yz,
                         yy * yz, xx * zz, xy * zz, yy * zz, xz * zz, yz * zz, zz * zz};
  const Pack wr = w * r, wr2 = wr * r;
  for (int m = 0; m < 10; m++) sums.t[m] += w * third[m];
  for (int m = 0; m < 10; m++) sums.s[m] += wr2 * third[m];
  for (int m = 0; m < 15; m++) sums.q[m] += wr * fourth[m];
}

template <int D>
void sum_pairs(const Stencil &s, const RowBlock &block, double volume, Sums<D> &sums)
{
  for (Pack &p : sums.t) p = Pack{};
  for (Pack &p : sums.s) p = Pack{};
  for (Pack &p : sums.q) p = Pack{};
  for (int n = 0; n < block.longest(); n++) {
    int k[LANES];
    Pack w, r, e[D];
    block.locate(n, k);
    block.present(n, w);
    gather(s.r(), k, r);
    for (int a = 0; a < D; a++) gather(s.e(a), k, e[a]);
    Pack dw;
    gather(s.dw(), k, dw);
    w *= volume * dw;
    add_pair(e, w, r, sums);
  }
}

template <int D> struct System {
  Pack G[K<D>][K<D>], T[K<D>][D], inverse[K<D>][K<D>];
  Pack smallest_pivot;
};

template <int D>
void load_inverse(const GradientWeights &g, const int *rows, int count, Pack (&L)[D][D])
{
  for (int l = 0; l < LANES; l++) {
    const Eigen::Matrix3d inverse = packed_matrix(g.inverse(), rows[std::min(l, count - 1)]);
    for (int a = 0; a < D; a++)
      for (int b = 0; b < D; b++) L[a][b][l] = inverse(a, b);
  }
}

template <int D> void make_system(const Sums<D> &sums, const Pack (&L)[D][D], System<D> &system)
{
  Pack R[K<D>][D];
  for (int m = 0; m < K<D>; m++)
    for (int c = 0; c < D; c++) {
      system.T[m][c] = factor<D>(m) * sums.t[monomial(3, mandel<D>(m) + axis(c))];
      R[m][c] = Pack{};
      for (int b = 0; b < D; b++)
        R[m][c] += factor<D>(m) * L[c][b] * sums.s[monomial(3, mandel<D>(m) + axis(b))];
    }
  for (int m = 0; m < K<D>; m++)
    for (int n = 0; n < K<D>; n++) {
      const int place = monomial(4, mandel<D>(m) + mandel<D>(n));
      system.G[m][n] = factor<D>(m) * factor<D>(n) * sums.q[place];
      for (int c = 0; c < D; c++) system.G[m][n] += system.T[m][c] * R[n][c];
    }
}

inline void magnitude(const Pack &x, Pack &absolute)
{
  for (int l = 0; l < LANES; l++) absolute[l] = std::fabs(x[l]);
}

inline void lower(Pack &least, const Pack &x)
{
  for (int l = 0; l < LANES; l++) least[l] = std::min(least[l], x[l]);
}

// Gauss-Jordan in place
template <int D> void invert(System<D> &system)
{
  constexpr int N = K<D>;
  auto &A = system.inverse;
  for (int m = 0; m < N; m++)
    for (int n = 0; n < N; n++) A[m][n] = system.G[m][n];
  set_all(system.smallest_pivot, INF);
  for (int p = 0; p < N; p++) {
    Pack size;
    magnitude(A[p][p], size);
    lower(system.smallest_pivot, size);
    const Pack scale = 1.0 / A[p][p];
    set_all(A[p][p], 1.0);
    for (int n = 0; n < N; n++) A[p][n] *= scale;
    for (int m = 0; m < N; m++) {
      if (m == p) continue;
      const Pack multiple = A[m][p];
      A[m][p] = Pack{};
      for (int n = 0; n < N; n++) A[m][n] -= multiple * A[p][n];
    }
  }
}

template <int D> using Matrix = Eigen::Matrix<double, K<D>, K<D>>;

template <int D> Matrix<D> lane(const Pack (&A)[K<D>][K<D>], int l)
{
  Matrix<D> matrix;
  for (int m = 0; m < K<D>; m++)
    for (int n = 0; n < K<D>; n++) matrix(m, n) = A[m][n][l];
  return matrix;
}

// The condition number of G: the Frobenius bound |G||G^-1|, at most K times
// the 2-norm one, where that suffices to accept the row, else the 2-norm one.
template <int D> double condition_number(const Matrix<D> &G, const Matrix<D> &inverse, double limit)
{
  const double bound = G.norm() * inverse.norm();
  if (bound <= limit) return bound;
  const auto sigma = Eigen::JacobiSVD<Matrix<D>>(G).singularValues();
  const double smallest = sigma[sigma.size() - 1];
  return smallest > 0.0 ? sigma[0] / smallest : INF;
}

template <int D>
void finish_row(const System<D> &system, const Pack (&L)[D][D], int l, double max_cond,
                LaplacianRow<D> &row)
{
  const Matrix<D> G = lane<D>(system.G, l);
  Matrix<D> inverse = lane<D>(system.inverse, l);
  if (!(system.smallest_pivot[l] >= SMALL_PIVOT * G.cwiseAbs().maxCoeff()))
    inverse = Eigen::PartialPivLU<Matrix<D>>(G).inverse();
  row.condition = condition_number<D>(G, inverse, max_cond);
  if (!(row.condition <= max_cond) || !std::isfinite(row.condition)) return;

  double beta[K<D>], P[D];
  for (int n = 0; n < K<D>; n++) {
    beta[n] = -inverse.col(n).template head<D>().sum();
    row.b[n] = factor<D>(n) * beta[n];
  }
  for (int c = 0; c < D; c++) {
    P[c] = 0.0;
    for (int m = 0; m < K<D>; m++) P[c] += 2.0 * system.T[m][c][l] * beta[m];
  }
  for (int a = 0; a < D; a++) {
    row.q[a] = 0.0;
    for (int b = 0; b < D; b++) row.q[a] += L[a][b][l] * P[b];
  }
}

}    // namespace

template <int D>
void solve_laplacian_systems(const Stencil &s, const GradientWeights &g, const int *rows, int count,
                             double max_cond, LaplacianRow<D> *row)
{
  for (int first = 0; first < count; first += LANES) {
    const int n = std::min(LANES, count - first);
    Sums<D> sums;
    sum_pairs<D>(s, RowBlock(s, rows + first, n), g.volume(), sums);
    Pack L[D][D];
    load_inverse<D>(g, rows + first, n, L);
    System<D> system;
    make_system<D>(sums, L, system);
    invert<D>(system);
    for (int l = 0; l < n; l++) finish_row<D>(system, L, l, max_cond, row[first + l]);
  }
}

template void solve_laplacian_systems<2>(const Stencil &, const GradientWeights &, const int *, int,
                                         double, LaplacianRow<2> *);
template void solve_laplacian_systems<3>(const Stencil &, const GradientWeights &, const int *, int,
                                         double, LaplacianRow<3> *);

}    // namespace aleisph
