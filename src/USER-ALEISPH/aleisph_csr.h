// SPDX-License-Identifier: GPL-2.0-only
/* ----------------------------------------------------------------------
   Square sparse matrix of the rows that a rank owns, in compressed rows,
   with the diagonal apart: y_i = diag_i x_i + sum_k val_k x_col(k).
   The pattern (ptr, col) is borrowed, normally from a Stencil, and must
   outlive the matrix. Columns may be ghosts (col >= rows).
------------------------------------------------------------------------- */

#ifndef LMP_ALEISPH_CSR_H
#define LMP_ALEISPH_CSR_H

#include <vector>

namespace aleisph {

class CsrMatrix {
 public:
  // resizes and zeroes val and diag for this pattern
  void reset(int rows, const int *ptr, const int *col);
  // the same with these values; their memory becomes that of val
  void reset(int rows, const int *ptr, const int *col, std::vector<double> &&values);
  // the memory of val, to be used for the next values; the matrix is empty then
  std::vector<double> release();

  int rows() const { return rows_; }
  int begin(int i) const { return ptr_[i]; }
  int end(int i) const { return ptr_[i + 1]; }
  int col(int k) const { return col_[k]; }
  double val(int k) const { return val_[k]; }
  double &val(int k) { return val_[k]; }
  double diag(int i) const { return diag_[i]; }
  double &diag(int i) { return diag_[i]; }
  double bytes() const;

  // x must be valid on all columns; y has rows() entries and is not x
  void multiply(const double *x, double *y) const;

 private:
  int rows_ = 0;
  const int *ptr_ = nullptr, *col_ = nullptr;
  std::vector<double> val_, diag_;
};

}    // namespace aleisph
#endif
