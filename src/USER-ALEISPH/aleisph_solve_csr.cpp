// SPDX-License-Identifier: GPL-2.0-only

#include "aleisph_solve_csr.h"

#include <algorithm>
#include <utility>

namespace aleisph {

void RowRuns::add(int row)
{
  if (!runs_.empty() && runs_.back().end == row)
    runs_.back().end++;
  else
    runs_.push_back({row, row + 1});
}

int RowRuns::rows() const
{
  int n = 0;
  for (const Run &run : runs_) n += run.end - run.begin;
  return n;
}

RowSplit split_rows(int rows, const int *ptr, const int *col, const std::vector<char> &awaited)
{
  RowSplit split;
  const bool any = std::any_of(awaited.begin(), awaited.end(), [](char wait) { return wait != 0; });
  for (int i = 0; i < rows; i++) {
    bool waits = false;
    for (int k = ptr[i]; any && k < ptr[i + 1] && !waits; k++)
      waits = col[k] >= rows && awaited[col[k] - rows];
    (waits ? split.boundary : split.interior).add(i);
  }
  return split;
}

void CsrMatrix::reset(int rows, const int *ptr, const int *col)
{
  std::vector<double> values = release();
  values.assign(rows > 0 ? ptr[rows] : 0, 0.0);
  reset(rows, ptr, col, std::move(values));
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

// Four sums, so that an addition need not wait for the one before
double CsrMatrix::row_sum(int i) const
{
  double part[4] = {0.0, 0.0, 0.0, 0.0};
  int k = ptr_[i];
  for (; k + 4 <= ptr_[i + 1]; k += 4)
    for (int lane = 0; lane < 4; lane++) part[lane] += val_[k + lane];
  for (; k < ptr_[i + 1]; k++) part[0] += val_[k];
  return (part[0] + part[1]) + (part[2] + part[3]);
}

// As row_sum() does, and the diagonal last
void CsrMatrix::multiply(int first, int last, const double *x, double *y) const
{
  const double *const val = val_.data();
  for (int i = first; i < last; i++) {
    double part[4] = {0.0, 0.0, 0.0, 0.0};
    int k = ptr_[i];
    for (const int end = ptr_[i + 1]; k + 4 <= end; k += 4)
      for (int lane = 0; lane < 4; lane++) part[lane] += val[k + lane] * x[col_[k + lane]];
    for (const int end = ptr_[i + 1]; k < end; k++) part[0] += val[k] * x[col_[k]];
    y[i] = ((part[0] + part[1]) + (part[2] + part[3])) + diag_[i] * x[i];
  }
}

void CsrMatrix::multiply(const RowRuns &subset, const double *x, double *y) const
{
  for (const RowRuns::Run &run : subset.runs()) multiply(run.begin, run.end, x, y);
}

}    // namespace aleisph
