// SPDX-License-Identifier: GPL-2.0-only
/* ----------------------------------------------------------------------
   BiCGSTAB with a preconditioner that is kept over several solves.

   A preconditioner built for one matrix is also good for the matrices of later
   steps, as long as the rows are the same particles. If these have changed
   places or ranks, vectors are transferred to the layout of the build and back.
   The preconditioner is built again if particles were added or lost; if the
   additional iterations, compared with the fewest since the build, add up to
   the cost of a build; if a solve fails. A solve that also fails with a new
   preconditioner is repeated with Jacobi. All decisions depend on global sums
   and numbers of iterations, never on measured time: runs are reproducible.
------------------------------------------------------------------------- */

#ifndef LMP_ALEISPH_SOLVE_LINEAR_H
#define LMP_ALEISPH_SOLVE_LINEAR_H

#include "aleisph_solve_krylov.h"
#include "aleisph_solve_precond.h"

#include <cstdint>
#include <functional>
#include <memory>
#include <utility>
#include <vector>

namespace aleisph {

// positive, each of them once on all ranks
using RowIds = std::vector<std::int64_t>;

// Values of the rows in the layout of a preconditioner's build and in the present one. Called by
// all ranks together.
class RowTransfer {
 public:
  virtual ~RowTransfer() = default;
  virtual void to_built(const double *present, double *built) = 0;
  virtual void to_present(const double *built, double *present) = 0;
  // what this rank receives in the two together
  virtual int messages() const = 0;
  virtual double message_bytes() const = 0;
  virtual double bytes() const = 0;    // memory held
};

// A preconditioner of rows that have moved since it was built
class MovedPreconditioner : public Preconditioner {
 public:
  // rows: of this rank, when it was built
  MovedPreconditioner(std::unique_ptr<RowTransfer> transfer, Preconditioner &built,
                      std::size_t rows) :
      transfer_(std::move(transfer)),
      built_(built), r_(rows), z_(rows)
  {
  }
  void apply(const double *r, double *z) override;
  double bytes() const;

 private:
  std::unique_ptr<RowTransfer> transfer_;
  Preconditioner &built_;
  std::vector<double> r_, z_;    // as built
};

class LinearSolver {
 public:
  // Builds a preconditioner of this type for the present matrix, on all ranks together; null, on
  // all ranks together, with report.failure set, if that is not possible.
  using Maker = std::function<std::unique_ptr<Preconditioner>(PrecondType, PrecondReport &)>;
  // From the rows of a build to those of today, on all ranks together; null, on all ranks
  // together, if a new preconditioner is to be built instead.
  using Mover = std::function<std::unique_ptr<RowTransfer>(const RowIds &, const RowIds &)>;
  struct Builder {
    Maker make;
    Mover move = nullptr;    // none: rows in another order need a new preconditioner
  };
  struct Counts {
    long builds = 0;        // of preconditioners, those of Jacobi after a failure included
    long fallbacks = 0;     // solves that were repeated with Jacobi
    long iterations = 0;    // of all attempts
  };

  void set_type(PrecondType type);
  PrecondType type() const { return type_; }
  void set_reuse(bool reuse) { reuse_ = reuse; }

  // The matrix has changed; row_ids: of the owned rows in their order
  void matrix_changed(RowIds row_ids);
  // The preconditioner does not outlive the present matrix, so that the next solves are those of a
  // solver that starts with the next matrix.
  void forget() { forget_ = true; }

  // As BiCGStab::solve(). The iterations and restarts reported are those of all attempts; each
  // attempt has params.max_iterations, one with a kept preconditioner less.
  SolveReport solve(LinearOperator &A, const Builder &builder, const InnerProduct &ip,
                    const double *b, double *x, const KrylovParams &params);

  const Counts &counts() const { return counts_; }
  const PrecondReport &precond_report() const { return precond_report_; }
  // why the last solve needed Jacobi, null if it did not
  const char *fallback_reason() const { return fallback_reason_; }
  double bytes() const;

 private:
  void settle_stale(const Mover &move, const InnerProduct &ip);
  bool follow(const Mover &move);
  bool build(PrecondType type, const Maker &make);
  void attempt(LinearOperator &A, const InnerProduct &ip, const double *b, double *x,
               KrylovParams params, SolveReport &total);
  void judge(int iterations);
  int attempt_limit(int max_iterations) const;
  bool old() const { return age_ > 0; }

  PrecondType type_ = PrecondType::ILU0;
  bool reuse_ = true;
  bool changed_ = true;    // matrix, since the last solve
  bool stale_ = true;      // of this rank, until the next solve
  bool moved_ = false;     // rows of this rank, since the last solve
  bool forget_ = false;
  int age_ = 0;                   // matrices since the build
  int fewest_ = 0;                // iterations of a solve since the build
  int excess_ = 0;                // iterations beyond these since the build
  RowIds row_ids_, built_ids_;    // of today, of the build
  std::unique_ptr<Preconditioner> precond_;
  std::unique_ptr<MovedPreconditioner> moved_precond_;    // null: the rows are those of the build
  PrecondReport precond_report_;
  const char *fallback_reason_ = nullptr;
  BiCGStab krylov_;
  Counts counts_;
};

}    // namespace aleisph
#endif
