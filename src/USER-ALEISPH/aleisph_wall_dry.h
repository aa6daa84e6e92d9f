// SPDX-License-Identifier: GPL-2.0-only
/* ----------------------------------------------------------------------
   Which wall particles are dry, next to a free surface.

   A wall particle takes part as long as there is fluid within `reach`, or that
   distance from each of the walls that meet in a concave edge or corner: reach
   times its shape. Farther ones would be neighbours without pressure. Jitter
   can move all fluid a little further off a wetted wall: there it is still
   above the wall particle, and at a contact line beside it. So a particle is
   wet up to 1.25 times that distance, too, if the fluid within the support
   lies within 30 degrees of its normal (measured on tanks with jitter to
   0.3 d).
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
