// SPDX-License-Identifier: GPL-2.0-only
/* ----------------------------------------------------------------------
   Square sparse matrix of the rows that a rank owns, in compressed rows,
   with the diagonal apart: y_i = diag_i x_i + sum_k val_k x_col(k).
   The pattern (ptr, col) is borrowed, normally from a Stencil, and must
   outlive the matrix. Columns may be ghosts (col >= rows).
------------------------------------------------------------------------- */

#ifndef LMP_ALEISPH_SOLVE_CSR_H
#define LMP_ALEISPH_SOLVE_CSR_H

#include <vector>

namespace aleisph {

// Rows in ascending order, as runs of consecutive ones
class RowRuns {
 public:
  void clear() { runs_.clear(); }
  void add(int row);
  int rows() const;

  struct Run {
    int begin, end;
  };
  const std::vector<Run> &runs() const { return runs_; }

 private:
  std::vector<Run> runs_;
};

// Rows whose columns are all at hand, and those with a column that is still on its way
struct RowSplit {
  RowRuns interior, boundary;
};

// awaited: one entry per column from `rows` on, not zero if it is on its way
RowSplit split_rows(int rows, const int *ptr, const int *col, const std::vector<char> &awaited);

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

  // the sum of val in row i in the order of multiply(): where diag is minus this sum, a constant
  // x gives exactly zero
  double row_sum(int i) const;

  // x must be valid on all columns; y has rows() entries and is not x
  void multiply(const double *x, double *y) const { multiply(0, rows_, x, y); }
  // these rows only; each is summed as multiply() of all does
  void multiply(const RowRuns &subset, const double *x, double *y) const;

 private:
  void multiply(int begin, int end, const double *x, double *y) const;

  int rows_ = 0;
  const int *ptr_ = nullptr, *col_ = nullptr;
  std::vector<double> val_, diag_;
};

}    // namespace aleisph
#endif
