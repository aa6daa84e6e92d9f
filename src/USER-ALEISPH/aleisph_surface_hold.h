// SPDX-License-Identifier: GPL-2.0-only
/* ----------------------------------------------------------------------
   Surface particles next to walls. The pressure of a particle on the surface is
   prescribed, so that the pressure does not keep a contact line from moving into
   the wall. For surface particles closer to walls than `reach` [length], measured along
   the normals of wall particles that they lie above (tangential offset below
   0.8 d), the velocity relative to the nearest of these is replaced by the
   nearest vector with v.n >= 0 for all their normals.

   v: of walls owned and ghost, the velocity of a wall particle is that of the
   wall; changed on the owned rows listed. Returns the number of particles changed.
------------------------------------------------------------------------- */

#ifndef LMP_ALEISPH_SURFACE_HOLD_H
#define LMP_ALEISPH_SURFACE_HOLD_H

#include "aleisph_cloud.h"

namespace aleisph {

// The first row lies at one spacing from a wall. Below 0.8 contact lines are pinned.
constexpr double HOLD_REACH = 1.0;    // in spacings

int hold_surface(const Cloud &cloud, const Rows &surface, double reach, double *v);

}    // namespace aleisph
#endif
