// SPDX-License-Identifier: GPL-2.0-only
/* ----------------------------------------------------------------------
   Unit wall normals, into the fluid, of single-layer walls, from particle
   positions alone. Each pair of wall particles next to each other and to i
   spans a facet; n_i is the angle-weighted sum of the facet normals
   (Thuermer & Wuethrich, J. Graphics Tools 3 (1998) 43), which on an edge
   or corner of a box is the normalised sum of the face normals.

   The side of the wall on which the fluid is, is found from, in this order,
     the normal of the step before,
     fluid particles within the support that no wall particle hides from i,
     wall neighbours whose normal is known.
   This selects the facets (WallFan) and has no other influence, unless there
   is no facet. By the last rule normals spread along dry walls, by one
   particle in each call.

   The shape of the wall at i is 1/|mean facet normal| where the facets lean
   towards n, and |mean facet normal| where they lean away: 1 on a plane,
   sqrt 2 in a concave right-angled edge, sqrt 3 in a corner, 1/sqrt 2 on a
   convex edge.
------------------------------------------------------------------------- */

#ifndef LMP_ALEISPH_WALL_NORMALS_H
#define LMP_ALEISPH_WALL_NORMALS_H

#include "aleisph_cloud.h"

namespace aleisph {

enum class NormalStatus : char {
  FAN,       // from the facets
  FLUID,     // too few wall neighbours: the direction to the fluid, or the normal before
  UNKNOWN    // not known on which side the fluid is: n = 0, shape 0
};

struct NormalCount {
  int found = 0, fallback = 0;    // fallback: with the status FLUID
  // found, but more than 120 degrees from that of a wall particle next to it: one of them is wrong
  Rows contradictory;
};

// walls: rows of all wall particles with all their neighbours, also dry ones. Normal and shape of
// the cloud are set for the owned rows listed (all WALL); neighbours, owned and ghost, count as they
// were on entry (zero where not known), so that the order of rows has no influence. status: per owned
// particle, set on these rows. previous: 3 per owned particle, zero if there is none; or null. Where
// it is the same as the new normal up to rounding, it is kept to the bit.
NormalCount wall_normals(const Stencil &walls, const Rows &rows, const double *previous,
                         Cloud &cloud, std::vector<NormalStatus> &status);

// Whether a search would now find the normal of one of these rows, which the last search did not:
// fluid may have come in sight. walls: at least their rows.
bool normals_in_sight(const Stencil &walls, const Rows &unknown, const Cloud &cloud);

// the shape on these rows where the normals are given
void wall_shapes(const Stencil &walls, const Rows &rows, Cloud &cloud);

}    // namespace aleisph
#endif
