/* ----------------------------------------------------------------------
   LAMMPS - Large-scale Atomic/Molecular Massively Parallel Simulator
   USER-ALEISPH package
   SPDX-License-Identifier: GPL-2.0-only

   The linear solver over all ranks, for a fix: keyword preconditioner, matrices
   of owned rows, which are identified by the IDs of their atoms, and a warning
   if Jacobi was used as a fallback.
------------------------------------------------------------------------- */

#ifndef LMP_ALEISPH_HALO_SOLVER_H
#define LMP_ALEISPH_HALO_SOLVER_H

#include "aleisph_halo_operator.h"
#include "aleisph_mpi_amg.h"
#include "aleisph_mpi_transfer.h"
#include "aleisph_solve_linear.h"
#include "atom.h"
#include "comm.h"
#include "error.h"
#include "pointers.h"
#include "update.h"

#include <memory>
#include <string>
#include <utility>
#include <vector>

namespace LAMMPS_NS {

// counts its messages, and the time that they take
class AleisphRowTransfer : public aleisph::RowTransfer {
 public:
  AleisphRowTransfer(std::unique_ptr<aleisph::RowTransfer> transfer, FixAleisph &owner) :
      transfer_(std::move(transfer)), owner_(owner)
  {
  }
  void to_built(const double *present, double *built) override
  {
    aleisph::Timers::Scope scope(owner_.timers(), aleisph::Part::COMM);
    transfer_->to_built(present, built);
  }
  void to_present(const double *built, double *present) override
  {
    aleisph::Timers::Scope scope(owner_.timers(), aleisph::Part::COMM);
    transfer_->to_present(built, present);
    owner_.ranks().traffic().messages += messages();
    owner_.ranks().traffic().bytes += message_bytes();
  }
  int messages() const override { return transfer_->messages(); }
  double message_bytes() const override { return transfer_->message_bytes(); }
  double bytes() const override { return transfer_->bytes(); }

 private:
  std::unique_ptr<aleisph::RowTransfer> transfer_;
  FixAleisph &owner_;
};

class AleisphHaloSolver : protected Pointers {
 public:
  // caller: the fix, as messages name it
  AleisphHaloSolver(LAMMPS *lmp, const std::string &caller) :
      Pointers(lmp), caller_(caller), exchange_(world)
  {
  }

  aleisph::LinearSolver &solver() { return solver_; }
  const aleisph::LinearSolver &solver() const { return solver_; }

  // the value of keyword preconditioner
  void parse_preconditioner(const std::string &value)
  {
    automatic_ = value == "auto";
    if (automatic_) return;
    aleisph::PrecondType type;
    if (!aleisph::parse_precond(value, type))
      error->all(FLERR, "{}: unknown preconditioner {}, use auto or one of {}", caller_, value,
                 aleisph::precond_names());
    if (type == aleisph::PrecondType::AMG && !aleisph::amg_available())
      error->all(FLERR,
                 "{}: preconditioner amg needs the library hypre, and this program was compiled "
                 "without it",
                 caller_);
    solver_.set_type(type);
  }
  // the caller chooses it, by solver().set_type()
  bool automatic() const { return automatic_; }

  void matrix_changed()
  {
    solver_.matrix_changed(aleisph::RowIds(atom->tag, atom->tag + atom->nlocal));
  }

  // x: owned and ghost particles, the initial guess
  aleisph::SolveReport solve(const aleisph::CsrMatrix &A, FixAleisph &owner, const double *b,
                             double *x, const aleisph::KrylovParams &params)
  {
    const auto make = [&](aleisph::PrecondType type, aleisph::PrecondReport &report) {
      aleisph::Timers::Scope scope(owner.timers(), aleisph::Part::PRECONDITIONER);
      if (type != aleisph::PrecondType::AMG) return aleisph::make_preconditioner(type, A, report);
      aleisph::AmgOptions options;
      options.singular = params.remove_mean;
      return aleisph::make_amg(world, A, row_numbers(A.rows(), owner).data(), options, report);
    };
    const auto move = [&](const aleisph::RowIds &before, const aleisph::RowIds &after) {
      aleisph::Timers::Scope scope(owner.timers(), aleisph::Part::PRECONDITIONER);
      std::unique_ptr<aleisph::RowTransfer> transfer = aleisph::make_transfer(exchange_, before,
                                                                              after);
      if (transfer) transfer = std::make_unique<AleisphRowTransfer>(std::move(transfer), owner);
      return transfer;
    };
    AleisphHaloOperator op(A, owner);
    const auto report = solver_.solve(op, {make, move}, owner.ranks(), b, x, params);
    tell_fallback();
    return report;
  }

 private:
  static constexpr long MAX_WARNINGS = 3;

  // Of every column: the rows of a rank follow those of the rank before. A double holds them.
  std::vector<long long> row_numbers(int rows, FixAleisph &owner) const
  {
    long long mine = rows;
    long long end = 0;
    MPI_Scan(&mine, &end, 1, MPI_LONG_LONG, MPI_SUM, world);
    std::vector<double> number(owner.cloud().size());
    for (int i = 0; i < rows; i++) number[i] = static_cast<double>(end - rows + i);
    owner.ranks().forward(number.data(), 1);
    return std::vector<long long>(number.begin(), number.end());
  }

  void tell_fallback() const
  {
    if (!solver_.fallback_reason() || comm->me || solver_.counts().fallbacks > MAX_WARNINGS) return;
    error->warning(FLERR, "{}: preconditioner {} failed at step {} ({}), jacobi was used", caller_,
                   to_string(solver_.type()), update->ntimestep, solver_.fallback_reason());
  }

  const std::string caller_;
  bool automatic_ = true;
  aleisph::SparseExchange exchange_;
  aleisph::LinearSolver solver_;
};

}    // namespace LAMMPS_NS

#endif
