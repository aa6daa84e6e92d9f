// SPDX-License-Identifier: GPL-2.0-only
/* ----------------------------------------------------------------------
   Free-surface detection by an all-round test: a fluid particle is on the
   surface if some direction is empty, that is if
     2d   the widest angular gap between neighbours within reach * d exceeds
          2 * half_angle,
     3d   one of 96 directions (Fibonacci points on the sphere) has no
          neighbour within reach * d closer to it than half_angle,
   and the smallest eigenvalue of its moments is below max_lambda; or if it
   has fewer than min_neighbours fluid neighbours in the stencil, which makes
   it ballistic. Neighbours are fluid and wall particles alike. Each wall
   particle also counts at a point d behind it, so that a particle pressed
   against a wall is not taken for one on the surface. Dry wall particles are
   not in the stencil: so the test is right at contact lines, too.
   In 3d an empty cone is always found if its half angle is half_angle + 15
   degrees or more, the resolution of the 96 directions.

   The outward normal N is that of the colour gradient, -sum V gradW, without
   the components that point into walls within wall_reach * d, normalised:
   the vector nearest to the gradient among those with N.n >= 0 for the
   normals n of all these walls.
------------------------------------------------------------------------- */

#ifndef LMP_ALEISPH_SURFACE_H
#define LMP_ALEISPH_SURFACE_H

#include "aleisph_operators.h"

namespace aleisph {

struct SurfaceParams {
  double half_angle = 45.0;    // degrees; 60 misses surface particles, which is fatal
  double reach = 2.0;          // in spacings
  double max_lambda = 0.75;    // 1: all but compressed particles are scanned
  int min_neighbours = 0;      // 0: dim + 1
  double wall_reach = 1.7;     // in spacings; >= support - d: nearer ones lack what is behind it
};

struct SurfaceCount {
  int surface = 0, ballistic = 0;    // ballistic particles are counted in both
};

// Adds SURFACE and BALLISTIC to the roles of the fluid rows (the caller clears them before) and
// writes their normals: N where SURFACE (zero if it has no direction), zero elsewhere. Reads the
// roles FLUID and WALL and the normals of walls, owned and ghost; those of ghosts must be
// exchanged afterwards.
SurfaceCount detect_surface(Cloud &cloud, const SurfaceParams &params);

// A particle on the surface, and so are all its fluid neighbours: a film of one layer. There the
// velocity off the layer is not known; only a wall gives its gradient a part along the normal, and
// what is shifted off the wall while the film approaches it would gain speed in every step.
bool in_film(const Cloud &cloud, int i);

}    // namespace aleisph
#endif
