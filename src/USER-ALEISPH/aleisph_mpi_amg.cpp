// SPDX-License-Identifier: GPL-2.0-only

#include "aleisph_mpi_amg.h"

#ifndef ALEISPH_HYPRE

namespace aleisph {

bool amg_available()
{
  return false;
}

std::unique_ptr<Preconditioner> make_amg(MPI_Comm, const CsrMatrix &, const long long *,
                                         const AmgOptions &, PrecondReport &report)
{
  report = PrecondReport();
  report.failure = "the package was compiled without the library hypre";
  return nullptr;
}

}    // namespace aleisph

#else

#include <HYPRE.h>
#include <HYPRE_IJ_mv.h>
#include <HYPRE_parcsr_ls.h>
#include <HYPRE_parcsr_mv.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>
#include <utility>
#include <vector>

namespace aleisph {
namespace {

// BoomerAMG's numbers for what is used here
constexpr int HMIS = 10, EXTENDED_I = 6, TWO_STAGE_EXTENDED = 5;
constexpr int L1_FORWARD = 13, L1_BACKWARD = 14, ELIMINATION = 9;
constexpr int DOWN = 1, UP = 2, COARSEST = 3;    // parts of a cycle
constexpr int COARSEST_ROWS = 100;

// A row keeps its weak couplings if its diagonal would lose more than this share to them
constexpr double MIN_LUMPED_DIAGONAL = 0.1;

// bytes of the hierarchy per entry of the finest matrix: hypre does not tell. The operators of all
// levels have 1.2 times its entries, the interpolation adds 4 a row, and smoothing 40 bytes a row
constexpr double BYTES_PER_ENTRY = 1.2 * (sizeof(double) + sizeof(HYPRE_Int));
constexpr double BYTES_PER_ROW = 40.0 + 4.0 * (sizeof(double) + sizeof(HYPRE_Int));

/* ----------------------------------------------------------------------
   The rows that hypre gets: columns numbered over all ranks, equal ones
   added, weak ones lumped.
------------------------------------------------------------------------- */
class FilteredRows {
 public:
  FilteredRows(const CsrMatrix &A, const long long *global, const AmgOptions &options)
  {
    counts_.reserve(A.rows());
    for (int i = 0; i < A.rows(); i++) {
      gather(A, global, i);
      if (options.singular && global[i] == 0) diagonal_ *= 2.0;    // holds the constant
      append(global[i], options.drop);
    }
  }

  bool finite() const { return finite_; }
  HYPRE_Int *counts() { return counts_.data(); }
  const HYPRE_BigInt *columns() const { return columns_.data(); }
  const HYPRE_Complex *values() const { return values_.data(); }
  double entries() const { return static_cast<double>(values_.size()); }

 private:
  void gather(const CsrMatrix &A, const long long *global, int i)
  {
    diagonal_ = A.diag(i);
    row_.clear();
    for (int k = A.begin(i); k < A.end(i); k++) {
      const long long column = global[A.col(k)];
      if (column == global[i])
        diagonal_ += A.val(k);
      else if (A.val(k) != 0.0)
        row_.emplace_back(column, A.val(k));
    }
    std::sort(row_.begin(), row_.end());
    std::size_t n = 0;
    for (const auto &entry : row_) {
      if (n > 0 && row_[n - 1].first == entry.first)
        row_[n - 1].second += entry.second;
      else
        row_[n++] = entry;
    }
    row_.resize(n);
  }

  void append(long long i, double drop)
  {
    double largest = 0.0, lumped = 0.0;
    for (const auto &entry : row_) largest = std::max(largest, std::fabs(entry.second));
    for (const auto &entry : row_)
      if (std::fabs(entry.second) < drop * largest) lumped += entry.second;
    const bool lump = diagonal_ + lumped > MIN_LUMPED_DIAGONAL * diagonal_;
    const double bound = lump ? drop * largest : 0.0;

    const std::size_t start = values_.size();
    put(i, diagonal_ + (lump ? lumped : 0.0));
    for (const auto &entry : row_)
      if (!(std::fabs(entry.second) < bound)) put(entry.first, entry.second);
    counts_.push_back(static_cast<HYPRE_Int>(values_.size() - start));
  }

  void put(long long column, double value)
  {
    columns_.push_back(static_cast<HYPRE_BigInt>(column));
    values_.push_back(value);
    if (!std::isfinite(value)) finite_ = false;
  }

  bool finite_ = true;
  double diagonal_ = 0.0;
  std::vector<std::pair<long long, double>> row_;
  std::vector<HYPRE_Int> counts_;
  std::vector<HYPRE_BigInt> columns_;
  std::vector<HYPRE_Complex> values_;
};

class Amg : public Preconditioner {
 public:
  Amg(MPI_Comm comm, long long first, int n) :
      n_(n), first_(static_cast<HYPRE_BigInt>(first)), last_(first_ + n - 1), rows_(n)
  {
    std::iota(rows_.begin(), rows_.end(), first_);
    HYPRE_IJMatrixCreate(comm, first_, last_, first_, last_, &A_);
    HYPRE_IJMatrixSetObjectType(A_, HYPRE_PARCSR);
    for (auto *vector : {&b_, &x_}) create(comm, vector);
    HYPRE_IJVectorGetObject(b_, reinterpret_cast<void **>(&par_b_));
    HYPRE_IJVectorGetObject(x_, reinterpret_cast<void **>(&par_x_));
    HYPRE_BoomerAMGCreate(&solver_);
  }

  ~Amg() override
  {
    HYPRE_BoomerAMGDestroy(solver_);
    HYPRE_IJVectorDestroy(x_);
    HYPRE_IJVectorDestroy(b_);
    HYPRE_IJMatrixDestroy(A_);
  }
  Amg(const Amg &) = delete;
  Amg &operator=(const Amg &) = delete;

  void set_up(FilteredRows &rows, const AmgOptions &options)
  {
    HYPRE_IJMatrixSetRowSizes(A_, rows.counts());
    HYPRE_IJMatrixInitialize(A_);
    HYPRE_IJMatrixSetValues(A_, n_, rows.counts(), rows_.data(), rows.columns(), rows.values());
    HYPRE_IJMatrixAssemble(A_);
    HYPRE_IJMatrixGetObject(A_, reinterpret_cast<void **>(&par_A_));
    choose(options);
    HYPRE_BoomerAMGSetup(solver_, par_A_, par_b_, par_x_);
  }

  void apply(const double *r, double *z) override
  {
    HYPRE_IJVectorSetValues(b_, n_, rows_.data(), r);
    HYPRE_ParVectorSetConstantValues(par_x_, 0.0);
    HYPRE_BoomerAMGSolve(solver_, par_A_, par_b_, par_x_);
    HYPRE_IJVectorGetValues(x_, n_, rows_.data(), z);
    if (!HYPRE_GetError()) return;
    HYPRE_ClearAllErrors();
    std::fill(z, z + n_, std::numeric_limits<double>::quiet_NaN());
  }

 private:
  void create(MPI_Comm comm, HYPRE_IJVector *vector)
  {
    HYPRE_IJVectorCreate(comm, first_, last_, vector);
    HYPRE_IJVectorSetObjectType(*vector, HYPRE_PARCSR);
    HYPRE_IJVectorInitialize(*vector);
    HYPRE_IJVectorAssemble(*vector);
  }

  // one V-cycle, one forward sweep down and one backward sweep up, no check of convergence
  void choose(const AmgOptions &options)
  {
    HYPRE_BoomerAMGSetPrintLevel(solver_, 0);
    HYPRE_BoomerAMGSetMaxIter(solver_, 1);
    HYPRE_BoomerAMGSetTol(solver_, 0.0);
    HYPRE_BoomerAMGSetCoarsenType(solver_, HMIS);
    HYPRE_BoomerAMGSetStrongThreshold(solver_, options.strong_threshold);
    HYPRE_BoomerAMGSetInterpType(solver_, EXTENDED_I);
    HYPRE_BoomerAMGSetPMaxElmts(solver_, options.interpolation_entries);
    HYPRE_BoomerAMGSetAggNumLevels(solver_, options.aggressive_levels);
    HYPRE_BoomerAMGSetAggInterpType(solver_, TWO_STAGE_EXTENDED);
    HYPRE_BoomerAMGSetAggPMaxElmts(solver_, options.interpolation_entries);
    HYPRE_BoomerAMGSetAggP12MaxElmts(solver_, options.interpolation_entries);
    HYPRE_BoomerAMGSetMaxCoarseSize(solver_, COARSEST_ROWS);
    HYPRE_BoomerAMGSetNumSweeps(solver_, 1);
    HYPRE_BoomerAMGSetRelaxOrder(solver_, 0);
    HYPRE_BoomerAMGSetCycleRelaxType(solver_, L1_FORWARD, DOWN);
    HYPRE_BoomerAMGSetCycleRelaxType(solver_, L1_BACKWARD, UP);
    HYPRE_BoomerAMGSetCycleRelaxType(solver_, ELIMINATION, COARSEST);
    HYPRE_BoomerAMGSetKeepTranspose(solver_, 1);    // faster restriction
  }

  const HYPRE_Int n_;
  const HYPRE_BigInt first_, last_;
  std::vector<HYPRE_BigInt> rows_;
  HYPRE_IJMatrix A_ = nullptr;
  HYPRE_IJVector b_ = nullptr, x_ = nullptr;
  HYPRE_ParCSRMatrix par_A_ = nullptr;
  HYPRE_ParVector par_b_ = nullptr, par_x_ = nullptr;
  HYPRE_Solver solver_ = nullptr;
};

bool anywhere(MPI_Comm comm, bool here)
{
  int mine = here, any;
  MPI_Allreduce(&mine, &any, 1, MPI_INT, MPI_MAX, comm);
  return any != 0;
}

}    // namespace

bool amg_available()
{
  return true;
}

std::unique_ptr<Preconditioner> make_amg(MPI_Comm comm, const CsrMatrix &A, const long long *global,
                                         const AmgOptions &options, PrecondReport &report)
{
  static const HYPRE_Int started = HYPRE_Init();    // once in a process
  (void) started;
  report = PrecondReport();
  const int n = A.rows();
  const long long mine = n;
  long long end = 0;
  MPI_Scan(&mine, &end, 1, MPI_LONG_LONG, MPI_SUM, comm);
  if (anywhere(comm, end > std::numeric_limits<HYPRE_BigInt>::max())) {
    report.failure = "hypre was compiled with too short integers for so many rows";
    return nullptr;
  }
  FilteredRows rows(A, global, options);
  if (anywhere(comm, !rows.finite())) {    // hypre need not survive this
    report.failure = "the matrix is not finite";
    return nullptr;
  }

  HYPRE_ClearAllErrors();
  auto amg = std::make_unique<Amg>(comm, end - n, n);
  amg->set_up(rows, options);
  const bool failed = anywhere(comm, HYPRE_GetError() != 0);
  HYPRE_ClearAllErrors();
  if (failed) {
    report.failure = "hypre could not build the multigrid hierarchy";
    return nullptr;
  }
  report.bytes = BYTES_PER_ENTRY * rows.entries() + BYTES_PER_ROW * n;
  return amg;
}

}    // namespace aleisph

#endif
