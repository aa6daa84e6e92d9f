// SPDX-License-Identifier: GPL-2.0-only
/* ----------------------------------------------------------------------
   What a linear solve needs on one rank, and matrices taken from Eigen.
------------------------------------------------------------------------- */

#ifndef ALEISPH_TEST_SOLVER_H
#define ALEISPH_TEST_SOLVER_H

#include "aleisph_solve_csr.h"
#include "aleisph_solve_krylov.h"
#include "aleisph_solve_precond.h"

#include <Eigen/Sparse>
#include <vector>

namespace aleisph_test {

using Vector = Eigen::VectorXd;
using Sparse = Eigen::SparseMatrix<double, Eigen::RowMajor>;

// one rank: nothing to add; counts the reductions
class SerialSum : public aleisph::InnerProduct {
 public:
  void sum(int, double *) const override { calls_++; }
  void max(int, double *) const override { calls_++; }
  int calls() const { return calls_; }

 private:
  mutable int calls_ = 0;
};

class SerialOperator : public aleisph::LinearOperator {
 public:
  explicit SerialOperator(const aleisph::CsrMatrix &A) : A_(A) {}
  int rows() const override { return A_.rows(); }
  int columns() const override { return A_.rows(); }
  void apply(double *x, double *y) override { A_.multiply(x, y); }

 private:
  const aleisph::CsrMatrix &A_;
};

// A square matrix of Eigen's as a CsrMatrix, with the pattern it borrows. Columns within a row
// are in falling order: nothing may rely on sorted columns.
class Matrix {
 public:
  explicit Matrix(const Sparse &A)
  {
    ptr_.push_back(0);
    for (int i = 0; i < A.rows(); i++) {
      std::vector<int> row;
      for (Sparse::InnerIterator it(A, i); it; ++it)
        if (it.col() != i) row.push_back(static_cast<int>(it.col()));
      col_.insert(col_.end(), row.rbegin(), row.rend());
      ptr_.push_back(static_cast<int>(col_.size()));
    }
    A_.reset(static_cast<int>(A.rows()), ptr_.data(), col_.data());
    for (int i = 0; i < A.rows(); i++) {
      A_.diag(i) = A.coeff(i, i);
      for (int k = A_.begin(i); k < A_.end(i); k++) A_.val(k) = A.coeff(i, A_.col(k));
    }
  }
  Matrix(const Matrix &) = delete;
  Matrix &operator=(const Matrix &) = delete;

  aleisph::CsrMatrix &csr() { return A_; }

 private:
  std::vector<int> ptr_, col_;
  aleisph::CsrMatrix A_;
};

inline Sparse to_eigen(const aleisph::CsrMatrix &A)
{
  std::vector<Eigen::Triplet<double>> entries;
  for (int i = 0; i < A.rows(); i++) {
    entries.emplace_back(i, i, A.diag(i));
    for (int k = A.begin(i); k < A.end(i); k++) entries.emplace_back(i, A.col(k), A.val(k));
  }
  Sparse B(A.rows(), A.rows());
  B.setFromTriplets(entries.begin(), entries.end());
  return B;
}

// uniform in [-1, 1]
Vector random_vector(int n, unsigned seed);

// about eight entries a row, |a_ii| = sum |a_ij| + 0.1
Sparse diagonally_dominant(int n, unsigned seed);

// -lap u + peclet u_x on n x n points, central differences, u = 0 outside
Sparse convection_diffusion(int n, double cell_peclet);

// the second difference on n points of an interval whose ends are closed; singular. The first
// row is scaled by three, so that the left null vector is not constant.
Sparse closed_interval(int n);

aleisph::KrylovParams tolerance(double rtol);

// one rank, x is the initial guess
inline aleisph::SolveReport solve(const aleisph::CsrMatrix &A, aleisph::PrecondType type,
                                  const Vector &b, Vector &x, const aleisph::KrylovParams &params)
{
  SerialOperator op(A);
  SerialSum ip;
  aleisph::PrecondReport report;
  const auto M = aleisph::make_preconditioner(type, A, report);
  aleisph::BiCGStab solver;
  return solver.solve(op, *M, ip, b.data(), x.data(), params);
}

}    // namespace aleisph_test
#endif
