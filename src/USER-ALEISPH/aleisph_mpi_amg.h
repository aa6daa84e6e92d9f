// SPDX-License-Identifier: GPL-2.0-only
/* ----------------------------------------------------------------------
   One V-cycle of algebraic multigrid over all ranks as a preconditioner:
   BoomerAMG of the library hypre (Henson & Yang, Appl. Numer. Math. 41
   (2002) 155), when the package is compiled with ALEISPH_HYPRE.

   The hierarchy is built for a sparser matrix: couplings that are weak compared
   with the largest one of their row are added to its diagonal. For smooth
   functions this makes hardly any difference, and a cycle costs half in 3d.
------------------------------------------------------------------------- */

#ifndef LMP_ALEISPH_MPI_AMG_H
#define LMP_ALEISPH_MPI_AMG_H

#include "aleisph_solve_precond.h"

#include <mpi.h>

#include <memory>

namespace aleisph {

// Defaults: chosen by time to solution on tanks with a free surface, 1e4 to 1e6 rows
struct AmgOptions {
  double drop = 0.1;    // couplings below this share of the row's largest are lumped
  double strong_threshold = 0.25;
  int aggressive_levels = 1;        // finest levels with aggressive coarsening
  int interpolation_entries = 4;    // per row, at most
  bool singular = false;            // constants are a null space of A
};

bool amg_available();

// global: the row number over all ranks of every column that A has, owned ones first; the rows of
// a rank follow each other in the order of the ranks. Several columns may have the same number:
// their entries are added. Called by all ranks together, and null on all of them together: then
// report.failure says why. A cycle that goes wrong returns values that are not finite.
std::unique_ptr<Preconditioner> make_amg(MPI_Comm comm, const CsrMatrix &A, const long long *global,
                                         const AmgOptions &options, PrecondReport &report);

}    // namespace aleisph
#endif
