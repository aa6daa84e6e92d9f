// SPDX-License-Identifier: GPL-2.0-only
/* ----------------------------------------------------------------------
   Curvature near contact lines, from the contact angle theta of the wall.

   The force balance of the surface between the wall and a height h above it
   gives its curvature there. Along the line of steepest ascent of a surface with
   curvature k,
     d(N.n)/dh = k,      so that the mean of k is  (N(h).n - cos(theta))/h:
   N.n is cos(theta) on the wall. This is exact, on an arc at all heights. N is
   that some spacings off the wall, where the surface is resolved. The places of
   the outermost particles do not enter: in their own curvature a particle out
   of place would have the effect of a wrong angle.

   Near the line K of the surface is replaced by
     K_c = k + K_a,
     k = sum_j w_ij h_j (N_j.n - cos(theta)) / sum_j w_ij h_j^2,
   h_j the height over the wall of x_j + (d/2) N_j, j on the surface,
   w_ij = (1 - r_ij/(4.8 d))^2, and K_a (3d) the curvature along the line,
   from the same particles. If the surface is steeper than theta, K_c is too
   small and the fluid is drawn to the line, which advances.
   The share of K_c is 1 up to the height `near` and 0 from `far` on. It goes to
   zero where no particle next to i is low enough to be on the wall, and where
   the surface is parallel to the wall.

   Where walls meet in a concave edge or corner a surface near two of them has k
   and k', and K_c = k + k': N.n and N.n' change with the heights over the two
   walls, which are coordinates across the edge; its div is the sum, whatever the
   angle between the walls.
------------------------------------------------------------------------- */

#ifndef LMP_ALEISPH_TENSION_CONTACT_CURVATURE_H
#define LMP_ALEISPH_TENSION_CONTACT_CURVATURE_H

#include "aleisph_tension_contact.h"

namespace aleisph {

// walls: seen through the wide stencil. K_i becomes share_i K_c + (1 - share_i) K_i on the rows listed, |K_c| <= 1/d. N: unit vectors,
// owned and ghost. share: 0..1, one per owned particle, written on these rows. Returns the number
// of rows where K_c met its bound.
int contact_curvature(const ContactWalls &walls, const Rows &surface, const ContactParams &params,
                      const double *N, double *share, double *K);

}    // namespace aleisph
#endif
