// SPDX-License-Identifier: GPL-2.0-only

#include "solver.h"

#include <gtest/gtest.h>

#include <Eigen/Dense>

#include <cmath>
#include <limits>
#include <random>

using namespace aleisph;
using namespace aleisph_test;

namespace {

Sparse random_matrix(int n, int per_row, unsigned seed)
{
  std::mt19937 random(seed);
  std::uniform_real_distribution<double> deviate(-1.0, 1.0);
  std::uniform_int_distribution<int> column(0, n - 1);
  Sparse A(n, n);
  for (int i = 0; i < n; i++) {
    for (int k = 0; k < per_row; k++) A.coeffRef(i, column(random)) = deviate(random);
    A.coeffRef(i, i) = per_row;
  }
  A.makeCompressed();
  return A;
}

Vector apply(PrecondType type, const CsrMatrix &A, const Vector &r, PrecondReport &report)
{
  const auto M = make_preconditioner(type, A, report);
  Vector z(r.size());
  M->apply(r.data(), z.data());
  return z;
}

// ILU(0) from its definition, on a dense copy: (L U)_ij = a_ij on the pattern of A, zero outside
Eigen::MatrixXd reference_ilu0(const Sparse &A)
{
  const int n = static_cast<int>(A.rows());
  Eigen::MatrixXd F(A), pattern = F.cwiseAbs();
  for (int i = 1; i < n; i++)
    for (int k = 0; k < i; k++) {
      if (pattern(i, k) == 0.0) continue;
      F(i, k) /= F(k, k);
      for (int j = k + 1; j < n; j++)
        if (pattern(i, j) != 0.0) F(i, j) -= F(i, k) * F(k, j);
    }
  return F;
}

Vector substitute(const Eigen::MatrixXd &F, Vector r)
{
  F.triangularView<Eigen::UnitLower>().solveInPlace(r);
  F.triangularView<Eigen::Upper>().solveInPlace(r);
  return r;
}

}    // namespace

TEST(Preconditioner, Names)
{
  PrecondType type = PrecondType::ILU0;
  EXPECT_TRUE(parse_precond("none", type));
  EXPECT_EQ(type, PrecondType::NONE);
  EXPECT_TRUE(parse_precond("jacobi", type));
  EXPECT_EQ(type, PrecondType::JACOBI);
  EXPECT_TRUE(parse_precond("ilu0", type));
  EXPECT_EQ(type, PrecondType::ILU0);
  EXPECT_FALSE(parse_precond("ilu", type));
  EXPECT_FALSE(parse_precond("", type));
  EXPECT_EQ(type, PrecondType::ILU0);
  EXPECT_TRUE(parse_precond("amg", type));
  EXPECT_EQ(type, PrecondType::AMG);
  EXPECT_STREQ(precond_names(), "none, jacobi, ilu0, amg");
  for (PrecondType each :
       {PrecondType::NONE, PrecondType::JACOBI, PrecondType::ILU0, PrecondType::AMG}) {
    ASSERT_TRUE(parse_precond(to_string(each), type));
    EXPECT_EQ(type, each);
  }
}

TEST(Preconditioner, NoneAndJacobi)
{
  Matrix matrix(random_matrix(40, 5, 1));
  const Vector r = random_vector(40, 2);
  PrecondReport report;
  EXPECT_EQ(apply(PrecondType::NONE, matrix.csr(), r, report), r);
  const Vector z = apply(PrecondType::JACOBI, matrix.csr(), r, report);
  for (int i = 0; i < 40; i++) EXPECT_DOUBLE_EQ(z[i], r[i] / matrix.csr().diag(i));
  EXPECT_EQ(report.replaced_pivots, 0);
  EXPECT_GE(report.bytes, 40 * sizeof(double));
}

TEST(Preconditioner, Ilu0IsTheFactorizationOnThePattern)
{
  for (unsigned seed = 1; seed <= 4; seed++) {
    const Sparse A = random_matrix(60, 6, seed);
    Matrix matrix(A);
    const Vector r = random_vector(60, seed + 10);
    PrecondReport report;
    const Vector z = apply(PrecondType::ILU0, matrix.csr(), r, report);
    // the same operations in another order; factors of order one, rows of seven entries
    EXPECT_LE((z - substitute(reference_ilu0(A), r)).cwiseAbs().maxCoeff(), 1.0e-14);
    EXPECT_EQ(report.replaced_pivots, 0);
    EXPECT_GE(report.bytes, A.nonZeros() * sizeof(double));
  }
}

// no fill-in outside a tridiagonal pattern: ILU(0) is LU
TEST(Preconditioner, Ilu0IsExactWithoutFillIn)
{
  const int n = 50;
  Sparse A(n, n);
  for (int i = 0; i < n; i++) {
    A.coeffRef(i, i) = 3.0;
    if (i > 0) A.coeffRef(i, i - 1) = -1.5;
    if (i < n - 1) A.coeffRef(i, i + 1) = -1.0;
  }
  A.makeCompressed();
  Matrix matrix(A);
  const Vector r = random_vector(n, 4);
  PrecondReport report;
  const Vector z = apply(PrecondType::ILU0, matrix.csr(), r, report);
  EXPECT_LE((A * z - r).cwiseAbs().maxCoeff(), 1.0e-14);
}

// couplings to columns that the rank does not own are left out
TEST(Preconditioner, Ilu0UsesTheOwnBlockOnly)
{
  const Sparse A = random_matrix(60, 6, 7);
  const int owned = 40;
  std::vector<int> ptr = {0}, col;
  std::vector<double> values;
  for (int i = 0; i < owned; i++) {
    for (Sparse::InnerIterator it(A, i); it; ++it)
      if (it.col() != i) {
        col.push_back(static_cast<int>(it.col()));
        values.push_back(it.value());
      }
    ptr.push_back(static_cast<int>(col.size()));
  }
  CsrMatrix part;
  part.reset(owned, ptr.data(), col.data());
  for (size_t k = 0; k < values.size(); k++) part.val(static_cast<int>(k)) = values[k];
  for (int i = 0; i < owned; i++) part.diag(i) = A.coeff(i, i);

  const Sparse block = A.topLeftCorner(owned, owned);
  const Vector r = random_vector(owned, 8);
  PrecondReport report;
  const Vector z = apply(PrecondType::ILU0, part, r, report);
  EXPECT_LE((z - substitute(reference_ilu0(block), r)).cwiseAbs().maxCoeff(), 1.0e-14);
}

// entries of a row with the same column, its own one included, count together
TEST(Preconditioner, EqualColumnsAreAdded)
{
  const Sparse A = random_matrix(50, 5, 9);
  std::vector<int> ptr = {0}, col;
  std::vector<double> values;
  const auto put = [&](int j, double value) {
    col.push_back(j);
    values.push_back(value);
  };
  for (int i = 0; i < 50; i++) {
    for (Sparse::InnerIterator it(A, i); it; ++it)
      put(static_cast<int>(it.col()), 0.25 * it.value());
    for (Sparse::InnerIterator it(A, i); it; ++it)
      if (it.col() != i) put(static_cast<int>(it.col()), 0.75 * it.value());
    ptr.push_back(static_cast<int>(col.size()));
  }
  CsrMatrix twice;
  twice.reset(50, ptr.data(), col.data());
  for (size_t k = 0; k < values.size(); k++) twice.val(static_cast<int>(k)) = values[k];
  for (int i = 0; i < 50; i++) twice.diag(i) = 0.75 * A.coeff(i, i);

  Matrix once(A);
  const Vector r = random_vector(50, 10);
  for (PrecondType type : {PrecondType::JACOBI, PrecondType::ILU0}) {
    PrecondReport report;
    const Vector expected = apply(type, once.csr(), r, report);
    // quarters and three quarters add up exactly or to within rounding
    EXPECT_LE((apply(type, twice, r, report) - expected).cwiseAbs().maxCoeff(), 1.0e-14);
  }
}

TEST(Preconditioner, MultigridIsMadeElsewhere)
{
  Matrix matrix(random_matrix(10, 3, 1));
  PrecondReport report;
  EXPECT_EQ(make_preconditioner(PrecondType::AMG, matrix.csr(), report), nullptr);
  EXPECT_NE(report.failure, nullptr);
}

TEST(Preconditioner, KeepsItsValuesWhenTheMatrixChanges)
{
  Matrix matrix(random_matrix(30, 4, 3));
  const Vector r = random_vector(30, 4);
  for (PrecondType type : {PrecondType::JACOBI, PrecondType::ILU0}) {
    PrecondReport report;
    const auto M = make_preconditioner(type, matrix.csr(), report);
    Vector before(30), after(30);
    M->apply(r.data(), before.data());
    matrix.csr().diag(3) *= 2.0;
    M->apply(r.data(), after.data());
    EXPECT_EQ(before, after);
    matrix.csr().diag(3) *= 0.5;
  }
}

// A closed interval: the last pivot of the exact factorization is zero
TEST(Preconditioner, SingularMatrix)
{
  const int n = 20;
  Sparse A(n, n);
  for (int i = 0; i < n; i++)
    for (int j : {i - 1, i + 1})
      if (j >= 0 && j < n) {
        A.coeffRef(i, j) = -1.0;
        A.coeffRef(i, i) += 1.0;
      }
  A.makeCompressed();
  Matrix matrix(A);
  PrecondReport report;
  const Vector z = apply(PrecondType::ILU0, matrix.csr(), random_vector(n, 5), report);
  EXPECT_EQ(report.replaced_pivots, 1);
  EXPECT_TRUE(z.allFinite());
  EXPECT_LE(z.cwiseAbs().maxCoeff(), n * n);    // of the order of the regular part of A^-1
}

TEST(Preconditioner, ZeroPivots)
{
  // zero diagonal; zero row; diagonal small beside the row
  Sparse A(4, 4);
  A.coeffRef(0, 1) = 2.0;
  A.coeffRef(1, 0) = 1.0;
  A.coeffRef(1, 1) = 1.0;
  A.coeffRef(3, 3) = 1.0e-9;
  A.coeffRef(3, 0) = -5.0;
  A.makeCompressed();
  Matrix matrix(A);
  const Vector r = Vector::Ones(4);
  PrecondReport report;
  const Vector z = apply(PrecondType::JACOBI, matrix.csr(), r, report);
  EXPECT_EQ(report.replaced_pivots, 3);
  EXPECT_DOUBLE_EQ(z[0], 0.5);
  EXPECT_DOUBLE_EQ(z[1], 1.0);
  EXPECT_DOUBLE_EQ(z[2], 1.0);
  EXPECT_DOUBLE_EQ(z[3], 0.2);
  // row 1 with row 0's pivot replaced by 2: the pivot is 1 - (1/2) 2 = 0, replaced by its diagonal
  EXPECT_TRUE(apply(PrecondType::ILU0, matrix.csr(), r, report).allFinite());
  EXPECT_EQ(report.replaced_pivots, 4);
}

// a NaN must not be taken for a zero pivot and mended
TEST(Preconditioner, NaNIsKept)
{
  Matrix matrix(random_matrix(10, 3, 1));
  matrix.csr().diag(4) = std::numeric_limits<double>::quiet_NaN();
  for (PrecondType type : {PrecondType::JACOBI, PrecondType::ILU0}) {
    PrecondReport report;
    EXPECT_TRUE(std::isnan(apply(type, matrix.csr(), Vector::Ones(10), report)[4]));
    EXPECT_EQ(report.replaced_pivots, 0);
  }
}

TEST(Preconditioner, NoRows)
{
  CsrMatrix A;
  A.reset(0, nullptr, nullptr);
  for (PrecondType type : {PrecondType::NONE, PrecondType::JACOBI, PrecondType::ILU0}) {
    PrecondReport report;
    const auto M = make_preconditioner(type, A, report);
    M->apply(nullptr, nullptr);
    EXPECT_EQ(report.replaced_pivots, 0);
  }
}
