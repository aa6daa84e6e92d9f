// SPDX-License-Identifier: GPL-2.0-only
/* ----------------------------------------------------------------------
   Preconditioners that a rank builds from its own rows: none, jacobi, ilu0
   (Meijerink & van der Vorst, Math. Comput. 31 (1977) 148; couplings to
   ghosts are left out, so that no exchange is needed). The one over all ranks,
   amg, is in aleisph_mpi_amg.h.
------------------------------------------------------------------------- */

#ifndef LMP_ALEISPH_SOLVE_PRECOND_H
#define LMP_ALEISPH_SOLVE_PRECOND_H

#include "aleisph_solve_csr.h"
#include "aleisph_solve_krylov.h"

#include <memory>
#include <string>

namespace aleisph {

enum class PrecondType { NONE, JACOBI, ILU0, AMG };
const char *to_string(PrecondType type);

bool parse_precond(const std::string &name, PrecondType &type);
const char *precond_names();    // for error messages

// Built from the values A has now; A may change afterwards. A zero pivot
// (relative to the row) is replaced by the row's diagonal magnitude and
// counted in replaced_pivots.
struct PrecondReport {
  int replaced_pivots = 0;
  double bytes = 0.0;
  const char *failure = nullptr;    // why there is none
};
// Entries of a row with the same column are added. Not for AMG.
std::unique_ptr<Preconditioner> make_preconditioner(PrecondType type, const CsrMatrix &A,
                                                    PrecondReport &report);

}    // namespace aleisph
#endif
