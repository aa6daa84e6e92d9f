// SPDX-License-Identifier: GPL-2.0-only
/* ----------------------------------------------------------------------
   The outward normal of the surface by Morikawa, Tsuji & Asai, eqs 24, 25 with
   the sign mended (as printed it points into the fluid):
     N_i = -N* / |N*|, N* = sum_j V (lambda_j - lambda_i) L_i gradW_ij,
   lambda the smallest eigenvalue of M. On contact particles N is the contact
   normal (Fig. 9).
------------------------------------------------------------------------- */

#ifndef LMP_ALEISPH_EIGENVALUE_NORMAL_H
#define LMP_ALEISPH_EIGENVALUE_NORMAL_H

#include "aleisph_tension.h"

namespace aleisph {

// N of the rows, zero where it has no direction; returns how many of them have none. contact: as
// contact_normals() has it, null or no data if there are no contact particles.
int eigenvalue_normals(const Cloud &cloud, const Rows &rows, const double *contact,
                       const GhostExchange &exchange, double *N);

// -N* of eq 25, not normalised, zero where it has no direction. lambda: owned and ghost.
void eigenvalue_gradient(const Cloud &cloud, const Rows &rows, const double *lambda, double *N);

}    // namespace aleisph
#endif
