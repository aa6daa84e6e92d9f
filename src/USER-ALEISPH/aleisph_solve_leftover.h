// SPDX-License-Identifier: GPL-2.0-only
/* ----------------------------------------------------------------------
   What the approximate projection leaves, and giving it back. The pressure
   equation has the Laplacian L, the velocity is corrected by the gradient G, and
   the divergence D is taken of it: after a step rho0/dt div v' = (L - DG) p + ...
   is a truncation error, proportional to dt. Added to the right-hand side of the
   next step, it is taken out there, as by an incremental pressure correction
   (Goda, J. Comput. Phys. 30 (1979) 76), so that steady states do not depend on dt.
   Taken out whole, it feeds pressures that G does not see, of the length of a
   spacing. So its smooth part S q is given back whole, S a mean over the support,
   and of the rest a share below one:
     q_n = g_n-1 + rho0/dt div v_n,   g_n = share q_n + (1 - share) S q_n
     L p = rho0/dt div v* + g_n
------------------------------------------------------------------------- */

#ifndef LMP_ALEISPH_SOLVE_LEFTOVER_H
#define LMP_ALEISPH_SOLVE_LEFTOVER_H

#include "aleisph_solve_ppe.h"

namespace aleisph {

// Fluid rows that are given back what was left: those with the corrected Laplacian that have a full
// support or one that walls complete. Next to a free surface L and DG differ too much.
Rows leftover_rows(const Cloud &cloud, const PpeLayout &layout);

// g_n on `rows` from q_n. q: one per particle, ghosts valid, zero off all ranks' `rows`.
void given_back(const Cloud &cloud, const Rows &rows, double share, const double *q, double *g);

}    // namespace aleisph
#endif
