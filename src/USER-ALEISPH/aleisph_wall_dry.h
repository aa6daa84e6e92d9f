// SPDX-License-Identifier: GPL-2.0-only
/* ----------------------------------------------------------------------
   Which wall particles are dry, next to a free surface.

   A wall particle is wet if there is fluid within `reach` times its shape; so in
   a concave edge or corner the fluid may be at the distance `reach` from each of
   the walls that meet there. Wall particles farther away are dry: they would be
   neighbours without pressure. Jitter can move all fluid a little farther away
   from a wetted wall. Then the fluid is still above the wall particle, whereas
   at a contact line it is beside it. So a particle is also wet up to 1.25 times
   that distance if the mean direction to the fluid within the support is within
   30 degrees of its normal (measured on tanks with jitter to 0.3 d).
------------------------------------------------------------------------- */

#ifndef LMP_ALEISPH_WALL_DRY_H
#define LMP_ALEISPH_WALL_DRY_H

#include "aleisph_cloud.h"

namespace aleisph {

// Adds DRY to the roles of owned wall particles, before the cloud has its stencil; those of ghosts
// must be exchanged afterwards. x: owned and ghost particles; list: their candidates, as
// Cloud::update() takes them; reach in spacings. Reads roles, normals and shapes. Returns the number
// of dry particles.
int mark_dry_walls(const double *const *x, const CandidateList &list, double reach, Cloud &cloud);

}    // namespace aleisph
#endif
