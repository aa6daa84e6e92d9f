// SPDX-License-Identifier: GPL-2.0-only
/* ----------------------------------------------------------------------
   Contact angle theta (through the fluid) where a free surface meets a wall.

   1. Near the line the curvature of the surface is replaced by the one that
      theta demands (aleisph_tension_contact_curvature.h).
   2. Below the wall the fluid is continued along the tangent that theta
      prescribes, so that the wide colour gradient gives N near the line
      (aleisph_tension_contact_continuation.h). It starts from contact particles:
      those on the surface closer than `reach` to a wall, along the wall's
      normal n, where the surface is not parallel to the wall. Below an overhang
      the lowest particle on the surface may be 1.5 d above the wall. The contact
      normal of such a particle is
        N_c = t sin(theta) + n cos(theta),   t: direction of N along the wall.
      Where walls meet in a concave edge or corner (aleisph_tension_contact_walls.h)
      it has the angles to all of them.
   3. The tip of a thin wedge has few neighbours in the fluid and would count as
      ballistic. Beside the fluid and above a wall it is part of the contact line
      (bind_tips).
   4. N of the colour gradient of the surface has no part into walls and is wrong
      on overhangs. Near the line it is replaced by the N of 2.
      (contact_surface_normals), in the pressure row and in shifting.
------------------------------------------------------------------------- */

#ifndef LMP_ALEISPH_TENSION_CONTACT_H
#define LMP_ALEISPH_TENSION_CONTACT_H

#include "aleisph_cloud.h"

namespace aleisph {

class ContactWalls;

struct ContactParams {
  double reach = 1.9;              // of contact particles, in spacings
  int depth = 4;                   // rows of sources below the wall
  double near = 1.5, far = 3.0;    // heights over which K_c fades out, in spacings
};

// sin of 14.5 degrees: a surface at less to a wall is parallel to it
constexpr double PARALLEL = 0.25;

// Clears BALLISTIC on the fluid rows that have fluid and at least dim wall particles within 1.7 d;
// returns their number. Reads roles of owned and ghost; the caller updates ghosts.
int bind_tips(Cloud &cloud);

// contact[4*i..4*i+2] = N_c of owned surface particle i, contact[4*i+3] = 1; all zero if it is
// no contact particle. Of the cloud, the normals of walls and of surface particles are read.
// Returns the number of contact particles.
int contact_normals(const ContactWalls &walls, const Rows &surface, const ContactParams &params,
                    double *contact);

// normal_i = (1 - share_i) normal_i + share_i N_i, normalised, on the rows listed
void contact_surface_normals(const Rows &surface, const double *share, const double *N,
                             double *normal);

}    // namespace aleisph
#endif
