// SPDX-License-Identifier: GPL-2.0-only
/* ----------------------------------------------------------------------
   The fluid continued below walls along the tangent that the contact angle
   prescribes, as sources of the wide colour gradient. The contact plane of a
   contact particle (aleisph_tension_contact.h) goes through
   x_c = x_i + (d/2) N_c at right angles to its contact normal N_c.
   1. Each wall particle j takes the plane of the contact particle nearest
      to it along the wall: plane[2*j] = (x_j - x_c).N_c/d, plane[2*j+1] =
      n_j.N_c. Far from all contact particles the wall is covered or DRY:
      plane[2*j] = -COVERED or +COVERED, plane[2*j+1] = 0.
   2. Sources at x_j - k d n_j, k = 0..depth, with the weight
      clip(1/2 - (plane[2*j] - k plane[2*j+1]), 0, 1).
   3. Behind a particle on a concave edge there is a whole quadrant of sources, at
      x_j - d (a n + b n'), a, b = 0..depth, n and n' of the faces next to it, and
      in a corner an octant. The normal of the edge particle itself, between n
      and n', is not used.
------------------------------------------------------------------------- */

#ifndef LMP_ALEISPH_TENSION_CONTACT_CONTINUATION_H
#define LMP_ALEISPH_TENSION_CONTACT_CONTINUATION_H

#include "aleisph_tension_contact.h"
#include "aleisph_tension_wide.h"

namespace aleisph {

constexpr double COVERED = 1.0e3;

// plane[2*j], plane[2*j+1] of owned walls. contact: owned and ghost; those as high as reach above the
// wall belong to another.
void contact_planes(const Cloud &cloud, const WideStencil &wide, const double *contact,
                    const ContactParams &params, double *plane);

// Adds the sources on and below the wall neighbours of the rows listed to N = -G; plane: owned
// and ghost.
void add_continuation(const Cloud &cloud, const WideStencil &wide, const Rows &surface,
                      const double *plane, const ContactParams &params, double *N);

}    // namespace aleisph
#endif
