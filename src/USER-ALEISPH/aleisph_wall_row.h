// SPDX-License-Identifier: GPL-2.0-only
/* ----------------------------------------------------------------------
   Weights of the normal derivative on a wall, whose support is one-sided:
     R(p) = sum_j w_j (p_j - p_i) = dp/dn + alpha lap p + O(d^2)
   As lap p is known from the pressure equation, alpha times it on the right-hand
   side makes the row second order. The weights are those nearest to zero in the
   norm sum_j w_j^2/omega_j, omega = V |W'|/r, that are exact for linear p and
   whose second moments are a multiple of the unit matrix:
     sum_j w_j r_j = n,   1/2 sum_j w_j r_j r_j = alpha 1,   r_j = x_j - x_i
   Without the second condition they are n.g_ij, the corrected gradient (Morikawa,
   Tsuji & Asai eqs 8-10, 16), for which
     R(p) = dp/dn + alpha p_nn + beta lap_t p,   alpha = 1/2 sum_j w_j (r_j.n)^2 .
------------------------------------------------------------------------- */

#ifndef LMP_ALEISPH_WALL_ROW_H
#define LMP_ALEISPH_WALL_ROW_H

namespace aleisph {

class Cloud;

// w: the weights times the particle spacing d, one for each pair of row i, from s.begin(i) on.
// Both return alpha/d.
double gradient_wall_row(const Cloud &cloud, int i, double *w);
// Not possible where the neighbours are too few or lie on a line: then a negative number, and w is
// not written.
double isotropic_wall_row(const Cloud &cloud, int i, double *w);

}    // namespace aleisph
#endif
