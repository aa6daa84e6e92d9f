// SPDX-License-Identifier: GPL-2.0-only

#include "rank_matrix.h"

#include <algorithm>

namespace aleisph_test {

RankMatrix::RankMatrix(const Sparse &A, bool without_last)
{
  MPI_Comm_rank(MPI_COMM_WORLD, &rank_);
  MPI_Comm_size(MPI_COMM_WORLD, &size_);
  const int n = static_cast<int>(A.rows());
  const int parts = without_last ? std::max(1, size_ - 1) : size_;
  for (int r = 0; r <= size_; r++) first_.push_back(std::min(n, n / parts * r));
  for (int r = parts; r <= size_; r++) first_[r] = n;
  const int begin = first_[rank_], end = first_[rank_ + 1];
  for (int i = begin; i < end; i++) global_.push_back(i);

  ptr_.push_back(0);
  std::vector<double> values;
  const auto put = [&](int j, double value, bool ghost) {
    col_.push_back(ghost ? static_cast<int>(global_.size()) : j - begin);
    if (ghost) global_.push_back(j);
    values.push_back(value);
  };
  for (int i = begin; i < end; i++) {
    bool split = false;
    for (Sparse::InnerIterator it(A, i); it; ++it) {
      const int j = static_cast<int>(it.col());
      if (j == i) continue;
      const bool ghost = j < begin || j >= end;
      put(j, split ? 0.25 * it.value() : it.value(), ghost);
      if (split) put(j, 0.75 * it.value(), true);
      split = !split;
    }
    ptr_.push_back(static_cast<int>(col_.size()));
  }
  A_.reset(end - begin, ptr_.data(), col_.data());
  for (std::size_t k = 0; k < values.size(); k++) A_.val(static_cast<int>(k)) = values[k];
  for (int i = begin; i < end; i++) A_.diag(i - begin) = A.coeff(i, i);
}

Vector RankMatrix::gather(const double *x) const
{
  std::vector<int> counts;
  for (int r = 0; r < size_; r++) counts.push_back(first_[r + 1] - first_[r]);
  Vector all(first_[size_]);
  MPI_Allgatherv(x, counts[rank_], MPI_DOUBLE, all.data(), counts.data(), first_.data(), MPI_DOUBLE,
                 MPI_COMM_WORLD);
  return all;
}

void RankMatrix::apply(double *x, double *y)
{
  const Vector all = gather(x);
  for (int j = rows(); j < columns(); j++) x[j] = all[global_[j]];
  A_.multiply(x, y);
}

}    // namespace aleisph_test
