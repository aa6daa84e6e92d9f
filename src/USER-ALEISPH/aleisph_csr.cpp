// SPDX-License-Identifier: GPL-2.0-only

#include "aleisph_csr.h"

#include <utility>

namespace aleisph {

void CsrMatrix::reset(int rows, const int *ptr, const int *col)
{
  rows_ = rows;
  ptr_ = ptr;
  col_ = col;
  val_.assign(rows > 0 ? ptr[rows] : 0, 0.0);
  diag_.assign(rows, 0.0);
}

void CsrMatrix::reset(int rows, const int *ptr, const int *col, std::vector<double> &&values)
{
  rows_ = rows;
  ptr_ = ptr;
  col_ = col;
  val_ = std::move(values);
  val_.resize(rows > 0 ? ptr[rows] : 0);
  diag_.assign(rows, 0.0);
}

std::vector<double> CsrMatrix::release()
{
  rows_ = 0;
  return std::move(val_);
}

double CsrMatrix::bytes() const
{
  return static_cast<double>(val_.capacity() + diag_.capacity()) * sizeof(double);
}

// The diagonal is added last: where diag is minus the sum of val in this order, a constant x
// gives exactly zero.
void CsrMatrix::multiply(const double *x, double *y) const
{
  for (int i = 0; i < rows_; i++) {
    double sum = 0.0;
    for (int k = ptr_[i]; k < ptr_[i + 1]; k++) sum += val_[k] * x[col_[k]];
    y[i] = sum + diag_[i] * x[i];
  }
}

}    // namespace aleisph
