// SPDX-License-Identifier: GPL-2.0-only
/* ----------------------------------------------------------------------
   Contact angle: where a free surface meets a wall, the fluid is continued
   into the wall along the tangent that the angle prescribes. The normals of
   the surface near the line then turn towards N_c, and its curvature drives
   the line until they agree. N itself is never overwritten.

   1. A contact particle is a particle on the surface closer than `reach` d to
      a wall, measured along the wall's normal n. Its contact normal is
        N_c = t sin(theta) + n cos(theta)
      (theta through the fluid; t: direction of N along the wall), the contact
      plane goes through x_c = x_i + (d/2) N_c.
   2. Each wall particle j takes the plane of the contact particle nearest to it
      along the wall: plane[2*j] = (x_j - x_c).N_c/d, plane[2*j+1] = n_j.N_c. Far
      from all contact particles the wall is covered (wet) or not (DRY):
      plane[2*j] = -COVERED or +COVERED, plane[2*j+1] = 0.
   3. Sources of the wide colour gradient at x_j - k d n_j, k = 0..4, with the
      weight clip(1/2 - (plane[2*j] - k plane[2*j+1]), 0, 1).
------------------------------------------------------------------------- */

#ifndef LMP_ALEISPH_CONTACT_H
#define LMP_ALEISPH_CONTACT_H

#include "aleisph_operators.h"

namespace aleisph {

struct ContactParams {
  double reach = 1.5;    // in spacings
  int depth = 4;         // rows of sources below the wall
};
constexpr double COVERED = 1.0e3;

// contact[4*i..4*i+2] = N_c of owned surface particle i, contact[4*i+3] = 1; all zero if it is
// no contact particle. cosine: cos(theta) of walls, owned and ghost. normal: walls into the fluid,
// surface particles outward. Returns the number of contact particles.
int contact_normals(const Stencil &s, const Rows &surface, const Role *role, const double *normal,
                    const double *cosine, double d, const ContactParams &params, double *contact);

// plane[2*j], plane[2*j+1] of the wall rows listed (owned). wide: their rows with all neighbours
// within 4.8 d. contact: owned and ghost.
void contact_planes(const Stencil &wide, const Rows &walls, const Role *role, const double *normal,
                    const double *contact, double d, double *plane);

// Adds the sources on and below the wall neighbours of the rows listed to N = -G; plane: owned
// and ghost.
void add_continuation(const Stencil &wide, const Kernel &kernel, const Rows &surface,
                      const Role *role, const double *normal, const double *plane, double volume,
                      double d, const ContactParams &params, double *N);

}    // namespace aleisph
#endif
