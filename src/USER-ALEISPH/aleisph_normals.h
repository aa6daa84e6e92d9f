// SPDX-License-Identifier: GPL-2.0-only
/* ----------------------------------------------------------------------
   Unit wall normals, into the fluid, of single-layer walls, from particle
   positions alone. The wall particles next to i form a fan around it; each
   pair of neighbours in the fan spans a facet; n_i is the angle-weighted
   sum of the facet normals (Thuermer & Wuethrich, J. Graphics Tools 3
   (1998) 43), which on an edge or corner of a box is the normalised sum of
   the face normals. The side on which the fluid lies orients the facets;
   where it is elsewhere it has no influence, unless there is no facet.
------------------------------------------------------------------------- */

#ifndef LMP_ALEISPH_NORMALS_H
#define LMP_ALEISPH_NORMALS_H

#include "aleisph_operators.h"

namespace aleisph {

enum class NormalStatus : char {
  FAN,       // from the facets
  FLUID,     // too few wall neighbours: the direction to the fluid
  UNKNOWN    // no fluid within the support: which side it is on is not known, n = 0
};

struct NormalParams {
  double reach = 1.4;         // wall neighbours within reach * d form the fan
  double min_angle = 50.0;    // degrees between two members of a fan, at least
  double max_gap = 150.0;     // degrees between neighbours in a fan; wider: a rim (3d)
};

// Writes normal[3*i+a] and status[i] for the owned rows listed (all WALL).
// role: owned and ghost. d: particle spacing.
void wall_normals(const Stencil &s, const Rows &rows, const Role *role, double d,
                  const NormalParams &params, double *normal, std::vector<NormalStatus> &status);

}    // namespace aleisph
#endif
