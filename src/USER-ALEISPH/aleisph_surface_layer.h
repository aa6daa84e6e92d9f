// SPDX-License-Identifier: GPL-2.0-only
/* ----------------------------------------------------------------------
   The layer of fluid between the particles of a free surface and the surface
   itself. On a lattice its thickness a is half a spacing. It is made of fluid:
   the flow stretches it along the normal N,
     da/dt = a N.(grad v).N ,
   and what moves a particle relative to the fluid (shifting, velocity u) takes it
   nearer to the surface, -u.N. With a constant thickness waves of wave number k
   are too slow by k d/4: the pressure at the particles lacks rho g times what the
   crests gain in thickness.

   Kept with each particle: s = ln(2 a/d), and its last change by strain, from
   which Adams-Bashforth extrapolates. As shifting mixes the layer with what is
   below, s forgets its past, by RELAXATION per spacing of shift: with 5 and less, a
   wave of half a spacing grows after 60 periods. It is a property of smooth
   surfaces: where less than MIN_LAMBDA of the support is filled (0.49 on a plane,
   lambda is the smallest eigenvalue of the moments), at edges, in sheets and
   splashes, it is zero, and at most MAX_STRETCH elsewhere. Without these two limits
   a dam break gains energy.
------------------------------------------------------------------------- */

#ifndef LMP_ALEISPH_SURFACE_LAYER_H
#define LMP_ALEISPH_SURFACE_LAYER_H

#include "aleisph_rows.h"

namespace aleisph {

class Cloud;

struct SurfaceLayer {
  static constexpr double RELAXATION = 10.0, MAX_STRETCH = 0.2, MIN_LAMBDA = 0.45;
};

// Rows whose particles have such a layer
Rows layered_rows(const Cloud &cloud);

// The change in a time step. rows: those of layered_rows(); grad_v: 9 per particle, as
// velocity_gradient() gives it, of the fluid; u: 3 per particle, null for none; layer: 2 per owned
// particle, set to zero on rows not listed. Returns how many are at MAX_STRETCH.
int follow_layer(const Cloud &cloud, const Rows &rows, const double *grad_v, const double *u,
                 double dt, double *layer);

}    // namespace aleisph
#endif
