// SPDX-License-Identifier: GPL-2.0-only
/* ----------------------------------------------------------------------
   Correction matrices of the gradient, Morikawa, Tsuji & Asai eqs 8-10, of
   LANES rows at a time. V = volume of a particle, w = V dW/dr, so that
   V gradW_ij = w e_ij and M_i = -sum_j w r e_ij (x) e_ij, which is
   symmetric, dimensionless and positive semi-definite.
   Symmetric matrices are packed as xx yy zz xy xz yz, in 2d xx yy xy.
------------------------------------------------------------------------- */

#include "aleisph_operators.h"
#include "aleisph_operators_pack.h"

#include <Eigen/Dense>
#include <algorithm>
#include <limits>

namespace aleisph {
namespace {

template <int D> struct Symmetric {
  static constexpr int SIZE = D * (D + 1) / 2;
  Pack m[SIZE];
};

template <int D>
void moments(const Stencil &s, const RowBlock &block, double volume, Symmetric<D> &M)
{
  for (Pack &m : M.m) m = Pack{};
  for (int n = 0; n < block.longest(); n++) {
    int k[LANES];
    Pack present, dw, r, e[D];
    block.locate(n, k);
    block.present(n, present);
    gather(s.dw(), k, dw);
    gather(s.r(), k, r);
    for (int a = 0; a < D; a++) gather(s.e(a), k, e[a]);
    const Pack weight = present * (dw * r);
    for (int a = 0; a < D; a++) M.m[a] -= weight * e[a] * e[a];
    M.m[D] -= weight * e[0] * e[1];
    if constexpr (D == 3) {
      M.m[4] -= weight * e[0] * e[2];
      M.m[5] -= weight * e[1] * e[2];
    }
  }
  for (Pack &m : M.m) m *= volume;
}

void smallest_eigenvalue(const Symmetric<2> &M, Pack &lambda)
{
  const Pack mean = 0.5 * (M.m[0] + M.m[1]), half = 0.5 * (M.m[0] - M.m[1]);
  Pack radius;
  square_root(half * half + M.m[2] * M.m[2], radius);
  lambda = mean - radius;
}

// One rotation of Jacobi's method (Golub & Van Loan, Matrix Computations, 8.5.2) that makes the
// entry pq zero; rp and rq are the entries that couple p and q to the third index.
void rotate(Pack &pp, Pack &qq, Pack &pq, Pack &rp, Pack &rq)
{
  constexpr double TINY = std::numeric_limits<double>::min();    // where pq = 0, too
  const Pack d = qq - pp;
  Pack length, sign, tangent, root;
  square_root(d * d + 4.0 * pq * pq, length);
  for (int l = 0; l < LANES; l++) sign[l] = d[l] < 0.0 ? -1.0 : 1.0;
  tangent = 2.0 * pq / (d + sign * length + sign * TINY);
  square_root(1.0 + tangent * tangent, root);
  const Pack c = 1.0 / root, s = tangent * c, old = rp;
  pp -= tangent * pq;
  qq += tangent * pq;
  pq = Pack{};
  rp = c * old - s * rq;
  rq = s * old + c * rq;
}

// Jacobi's method, to full precision also where eigenvalues coincide; from the closed form of
// the cubic half of the digits are lost there.
void smallest_eigenvalue(const Symmetric<3> &M, Pack &lambda)
{
  constexpr int SWEEPS = 8;
  Pack xx = M.m[0], yy = M.m[1], zz = M.m[2], xy = M.m[3], xz = M.m[4], yz = M.m[5];
  for (int sweep = 0; sweep < SWEEPS; sweep++) {
    const Pack rest = xy * xy + xz * xz + yz * yz, all = xx * xx + yy * yy + zz * zz;
    bool done = true;
    for (int l = 0; l < LANES; l++) done = done && !(rest[l] > 1.0e-36 * all[l]);
    if (done) break;
    rotate(xx, yy, xy, xz, yz);
    rotate(xx, zz, xz, xy, yz);
    rotate(yy, zz, yz, xy, xz);
  }
  for (int l = 0; l < LANES; l++) lambda[l] = std::min(std::min(xx[l], yy[l]), zz[l]);
}

// by cofactors; not finite where M is singular
void invert(const Symmetric<2> &M, Symmetric<2> &L)
{
  const Pack scale = 1.0 / (M.m[0] * M.m[1] - M.m[2] * M.m[2]);
  L.m[0] = scale * M.m[1];
  L.m[1] = scale * M.m[0];
  L.m[2] = -scale * M.m[2];
}

void invert(const Symmetric<3> &M, Symmetric<3> &L)
{
  const Pack &xx = M.m[0], &yy = M.m[1], &zz = M.m[2], &xy = M.m[3], &xz = M.m[4], &yz = M.m[5];
  const Pack a = yy * zz - yz * yz, b = xz * yz - xy * zz, c = xy * yz - yy * xz;
  const Pack scale = 1.0 / (xx * a + xy * b + xz * c);
  L.m[0] = scale * a;
  L.m[1] = scale * (xx * zz - xz * xz);
  L.m[2] = scale * (xx * yy - xy * xy);
  L.m[3] = scale * b;
  L.m[4] = scale * c;
  L.m[5] = scale * (xy * xz - xx * yz);
}

template <int D> Eigen::Matrix<double, D, D> lane(const Symmetric<D> &M, int l)
{
  Eigen::Matrix<double, D, D> matrix;
  for (int a = 0; a < D; a++) matrix(a, a) = M.m[a][l];
  matrix(0, 1) = matrix(1, 0) = M.m[D][l];
  if constexpr (D == 3) {
    matrix(0, 2) = matrix(2, 0) = M.m[4][l];
    matrix(1, 2) = matrix(2, 1) = M.m[5][l];
  }
  return matrix;
}

template <int D> void put(const Eigen::Matrix<double, D, D> &L, double *packed)
{
  std::fill(packed, packed + GradientWeights::PACKED, 0.0);
  for (int a = 0; a < D; a++) packed[a] = L(a, a);
  packed[3] = L(0, 1);
  if constexpr (D == 3) {
    packed[4] = L(0, 2);
    packed[5] = L(1, 2);
  }
}

// M^-1 with the eigenvalues of M not below floor
template <int D>
Eigen::Matrix<double, D, D> floored_inverse(const Eigen::Matrix<double, D, D> &M, double floor)
{
  const Eigen::SelfAdjointEigenSolver<Eigen::Matrix<double, D, D>> eigen(M);
  const Eigen::Matrix<double, D, 1> inverse = eigen.eigenvalues().cwiseMax(floor).cwiseInverse();
  return eigen.eigenvectors() * inverse.asDiagonal() * eigen.eigenvectors().transpose();
}

// floor of each row: `floor` for the rows listed, else 0; empty if there is none at all
std::vector<double> row_floors(int nrows, const Rows &floored, double floor)
{
  std::vector<double> floors;
  if (floor <= 0.0 || floored.empty()) return floors;
  floors.assign(nrows, 0.0);
  for_rows(floored, [&](int i) { floors[i] = floor; });
  return floors;
}

enum class Inverse { PLAIN, CLAMPED, SINGULAR };
struct InverseCount {
  int singular = 0, clamped = 0;
  InverseCount &operator+=(const InverseCount &other)
  {
    singular += other.singular;
    clamped += other.clamped;
    return *this;
  }
};

template <int D>
Inverse store(const Symmetric<D> &M, const Symmetric<D> &L, int l, double lambda, double floor,
              double *packed)
{
  if (floor > 0.0 && lambda < floor) {
    put<D>(floored_inverse<D>(lane<D>(M, l), floor), packed);
    return Inverse::CLAMPED;
  }
  if (lambda >= GradientWeights::MIN_LAMBDA) {
    put<D>(lane<D>(L, l), packed);
    return Inverse::PLAIN;
  }
  std::fill(packed, packed + GradientWeights::PACKED, 0.0);
  return Inverse::SINGULAR;
}

template <int D>
InverseCount build_rows(const Stencil &s, double volume, const std::vector<double> &floors,
                        double *inverse, double *lambda)
{
  return sum_blocks<LANES>(s.rows(), [&](const int *rows, int n) {
    InverseCount count;
    Symmetric<D> M, L;
    Pack smallest;
    moments<D>(s, RowBlock(s, rows, n), volume, M);
    smallest_eigenvalue(M, smallest);
    invert(M, L);
    for (int l = 0; l < n; l++) {
      const int i = rows[l];
      lambda[i] = smallest[l];
      const Inverse kind = store<D>(M, L, l, lambda[i], floors.empty() ? 0.0 : floors[i],
                                    inverse + GradientWeights::PACKED * i);
      count.clamped += kind == Inverse::CLAMPED;
      count.singular += kind == Inverse::SINGULAR;
    }
    return count;
  });
}

}    // namespace

void GradientWeights::build(const Stencil &s, double volume, const Rows &floored, double floor)
{
  volume_ = volume;
  inverse_.resize(static_cast<std::size_t>(PACKED) * s.rows());
  lambda_.resize(s.rows());
  const std::vector<double> floors = row_floors(s.rows(), floored, floor);
  const InverseCount count = s.dim() == 2
      ? build_rows<2>(s, volume, floors, inverse_.data(), lambda_.data())
      : build_rows<3>(s, volume, floors, inverse_.data(), lambda_.data());
  singular_ = count.singular;
  clamped_ = count.clamped;
}

double GradientWeights::bytes() const
{
  return static_cast<double>(inverse_.capacity() + lambda_.capacity()) * sizeof(double);
}

}    // namespace aleisph
