/* ----------------------------------------------------------------------
   LAMMPS - Large-scale Atomic/Molecular Massively Parallel Simulator
   USER-ALEISPH package
   SPDX-License-Identifier: GPL-2.0-only

   The linear solver over all ranks: matrices of owned rows, with the IDs of
   the atoms as what identifies the rows.
------------------------------------------------------------------------- */

#ifndef LMP_ALEISPH_HALO_SOLVER_H
#define LMP_ALEISPH_HALO_SOLVER_H

#include "aleisph_halo_operator.h"
#include "aleisph_linear_solver.h"
#include "aleisph_mpi_amg.h"
#include "atom.h"

#include <cstdint>
#include <memory>
#include <vector>

namespace LAMMPS_NS {

class AleisphHaloSolver {
 public:
  aleisph::LinearSolver &solver() { return solver_; }
  const aleisph::LinearSolver &solver() const { return solver_; }

  void matrix_changed(const Atom *atom)
  {
    solver_.matrix_changed(std::vector<std::int64_t>(atom->tag, atom->tag + atom->nlocal));
  }

  // x: owned and ghost particles, the initial guess
  aleisph::SolveReport solve(const aleisph::CsrMatrix &A, FixAleisph &owner, MPI_Comm comm,
                             const double *b, double *x, const aleisph::KrylovParams &params)
  {
    const auto make = [&](aleisph::PrecondType type, aleisph::PrecondReport &report) {
      aleisph::Timers::Scope scope(owner.timers(), aleisph::Part::PRECONDITIONER);
      if (type != aleisph::PrecondType::AMG) return aleisph::make_preconditioner(type, A, report);
      aleisph::AmgOptions options;
      options.singular = params.remove_mean;
      return aleisph::make_amg(comm, A, row_numbers(A.rows(), owner, comm).data(), options, report);
    };
    AleisphHaloOperator op(A, owner);
    return solver_.solve(op, make, owner.inner_product(), b, x, params);
  }

 private:
  // Of every column: the rows of a rank follow those of the rank before. A double holds them.
  static std::vector<long long> row_numbers(int rows, FixAleisph &owner, MPI_Comm comm)
  {
    long long mine = rows;
    long long end = 0;
    MPI_Scan(&mine, &end, 1, MPI_LONG_LONG, MPI_SUM, comm);
    std::vector<double> number(owner.nall());
    for (int i = 0; i < rows; i++) number[i] = static_cast<double>(end - rows + i);
    owner.forward(number.data(), 1);
    return std::vector<long long>(number.begin(), number.end());
  }

  aleisph::LinearSolver solver_;
};

}    // namespace LAMMPS_NS

#endif
