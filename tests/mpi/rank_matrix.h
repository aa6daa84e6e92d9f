// SPDX-License-Identifier: GPL-2.0-only
/* ----------------------------------------------------------------------
   A matrix that all ranks know, each holding some of its rows. Off-rank
   columns are ghosts, one per entry, and every other entry of a row is split
   into two columns with the same number, as those of periodic images are.
------------------------------------------------------------------------- */

#ifndef ALEISPH_TEST_RANK_MATRIX_H
#define ALEISPH_TEST_RANK_MATRIX_H

#include "solver.h"

#include <mpi.h>

#include <vector>

namespace aleisph_test {

class MpiSum : public aleisph::InnerProduct {
 public:
  void sum(int n, double *values) const override
  {
    MPI_Allreduce(MPI_IN_PLACE, values, n, MPI_DOUBLE, MPI_SUM, MPI_COMM_WORLD);
  }
  void max(int n, double *values) const override
  {
    MPI_Allreduce(MPI_IN_PLACE, values, n, MPI_DOUBLE, MPI_MAX, MPI_COMM_WORLD);
  }
};

class RankMatrix : public aleisph::LinearOperator {
 public:
  // rows in equal parts; without_last: the last rank has none
  explicit RankMatrix(const Sparse &A, bool without_last = false);
  RankMatrix(const RankMatrix &) = delete;
  RankMatrix &operator=(const RankMatrix &) = delete;

  int rows() const override { return A_.rows(); }
  int columns() const override { return static_cast<int>(global_.size()); }
  void apply(double *x, double *y) override;

  aleisph::CsrMatrix &csr() { return A_; }
  const long long *global() const { return global_.data(); }
  int first() const { return first_[rank_]; }
  // the owned entries of all ranks
  Vector gather(const double *x) const;

 private:
  int rank_ = 0, size_ = 1;
  std::vector<int> first_;
  std::vector<int> ptr_, col_;
  std::vector<long long> global_;
  aleisph::CsrMatrix A_;
};

}    // namespace aleisph_test
#endif
