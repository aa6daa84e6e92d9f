// SPDX-License-Identifier: GPL-2.0-only

#include "aleisph_solve_precond.h"

#include <algorithm>
#include <cmath>
#include <utility>
#include <vector>

namespace aleisph {
namespace {

// Smallest pivot relative to the largest entry of its row. The pivots of the matrices of this
// package are of the size of the diagonal; only that of a singular system comes near zero.
constexpr double MIN_PIVOT = 1.0e-6;

// a particle may be its own neighbour across a periodic boundary
double diagonal(const CsrMatrix &A, int i)
{
  double sum = A.diag(i);
  for (int k = A.begin(i); k < A.end(i); k++)
    if (A.col(k) == i) sum += A.val(k);
  return sum;
}

double largest_entry(const CsrMatrix &A, int i)
{
  double largest = std::fabs(diagonal(A, i));
  for (int k = A.begin(i); k < A.end(i); k++) largest = std::max(largest, std::fabs(A.val(k)));
  return largest;
}

// The pivot itself, or what stands in for it if it (almost) vanishes: the row's diagonal
// magnitude, failing that its largest entry, failing that one. A NaN is kept.
double safe_pivot(double pivot, double diagonal, double largest, int &replaced)
{
  const double bound = MIN_PIVOT * largest;
  if (std::fabs(pivot) > bound || std::isnan(pivot)) return pivot;
  replaced++;
  if (std::fabs(diagonal) > bound) return std::fabs(diagonal);
  return largest > 0.0 ? largest : 1.0;
}

double held(const std::vector<double> &v)
{
  return static_cast<double>(v.capacity()) * sizeof(double);
}

double held(const std::vector<int> &v)
{
  return static_cast<double>(v.capacity()) * sizeof(int);
}

class Identity : public Preconditioner {
 public:
  explicit Identity(int rows) : rows_(rows) {}
  void apply(const double *r, double *z) override { std::copy(r, r + rows_, z); }

 private:
  int rows_;
};

class Jacobi : public Preconditioner {
 public:
  Jacobi(const CsrMatrix &A, PrecondReport &report) : inverse_(A.rows())
  {
    for (int i = 0; i < A.rows(); i++) {
      const double d = diagonal(A, i);
      inverse_[i] = 1.0 / safe_pivot(d, d, largest_entry(A, i), report.replaced_pivots);
    }
    report.bytes = held(inverse_);
  }

  void apply(const double *r, double *z) override
  {
    for (size_t i = 0; i < inverse_.size(); i++) z[i] = inverse_[i] * r[i];
  }

 private:
  std::vector<double> inverse_;
};

/* ----------------------------------------------------------------------
   A = L U + (what falls outside the pattern of A). Row i of the factors is
   [begin_[i], begin_[i+1]) in order of columns: L without its unit diagonal,
   U at and after upper_[i]; the diagonal of U is kept as its inverse.
------------------------------------------------------------------------- */
class Ilu0 : public Preconditioner {
 public:
  Ilu0(const CsrMatrix &A, PrecondReport &report)
  {
    copy_block(A);
    factorize(A, report.replaced_pivots);
    report.bytes = held(begin_) + held(upper_) + held(col_) + held(val_) + held(inverse_);
  }

  void apply(const double *r, double *z) override
  {
    const int n = static_cast<int>(inverse_.size());
    for (int i = 0; i < n; i++) {
      double sum = r[i];
      for (int k = begin_[i]; k < upper_[i]; k++) sum -= val_[k] * z[col_[k]];
      z[i] = sum;
    }
    for (int i = n - 1; i >= 0; i--) {
      double sum = z[i];
      for (int k = upper_[i]; k < begin_[i + 1]; k++) sum -= val_[k] * z[col_[k]];
      z[i] = sum * inverse_[i];
    }
  }

 private:
  // the rank's own block, diagonal apart, rows sorted, entries of one column added
  void copy_block(const CsrMatrix &A)
  {
    const int n = A.rows();
    begin_.assign(1, 0);
    std::vector<std::pair<int, double>> row;
    for (int i = 0; i < n; i++) {
      row.clear();
      for (int k = A.begin(i); k < A.end(i); k++)
        if (A.col(k) < n && A.col(k) != i) row.emplace_back(A.col(k), A.val(k));
      std::sort(row.begin(), row.end());
      int lower = 0;
      for (const auto &entry : row) {
        if (col_.size() > static_cast<std::size_t>(begin_.back()) && col_.back() == entry.first) {
          val_.back() += entry.second;
          continue;
        }
        if (entry.first < i) lower++;
        col_.push_back(entry.first);
        val_.push_back(entry.second);
      }
      upper_.push_back(begin_.back() + lower);
      begin_.push_back(static_cast<int>(col_.size()));
    }
  }

  // row by row: subtract multiples of the rows above, where row i has an entry
  void factorize(const CsrMatrix &A, int &replaced)
  {
    const int n = A.rows();
    inverse_.resize(n);
    std::vector<int> place(n, -1);    // of a column in row i
    for (int i = 0; i < n; i++) {
      for (int k = begin_[i]; k < begin_[i + 1]; k++) place[col_[k]] = k;
      const double d = diagonal(A, i);
      double pivot = d;
      for (int k = begin_[i]; k < upper_[i]; k++) {
        const int above = col_[k];
        const double factor = val_[k] *= inverse_[above];
        for (int m = upper_[above]; m < begin_[above + 1]; m++) {
          if (col_[m] == i)
            pivot -= factor * val_[m];
          else if (place[col_[m]] >= 0)
            val_[place[col_[m]]] -= factor * val_[m];
        }
      }
      inverse_[i] = 1.0 / safe_pivot(pivot, d, largest_entry(A, i), replaced);
      for (int k = begin_[i]; k < begin_[i + 1]; k++) place[col_[k]] = -1;
    }
  }

  std::vector<int> begin_, upper_, col_;
  std::vector<double> val_, inverse_;
};

}    // namespace

bool parse_precond(const std::string &name, PrecondType &type)
{
  if (name == "none")
    type = PrecondType::NONE;
  else if (name == "jacobi")
    type = PrecondType::JACOBI;
  else if (name == "ilu0")
    type = PrecondType::ILU0;
  else if (name == "amg")
    type = PrecondType::AMG;
  else
    return false;
  return true;
}

const char *precond_names()
{
  return "none, jacobi, ilu0, amg";
}

const char *to_string(PrecondType type)
{
  switch (type) {
    case PrecondType::NONE: return "none";
    case PrecondType::JACOBI: return "jacobi";
    case PrecondType::ILU0: return "ilu0";
    case PrecondType::AMG: return "amg";
  }
  return "";
}

std::unique_ptr<Preconditioner> make_preconditioner(PrecondType type, const CsrMatrix &A,
                                                    PrecondReport &report)
{
  report = PrecondReport();
  if (type == PrecondType::JACOBI) return std::make_unique<Jacobi>(A, report);
  if (type == PrecondType::ILU0) return std::make_unique<Ilu0>(A, report);
  if (type == PrecondType::NONE) return std::make_unique<Identity>(A.rows());
  report.failure = "not made by a rank alone";
  return nullptr;
}

}    // namespace aleisph
