// SPDX-License-Identifier: GPL-2.0-only
/* ----------------------------------------------------------------------
   The surroundings of surface and wall particles over the wide support 4.8 d
   (Wendland C2), and the colour gradient over them. With the support of the
   operators it points along the nearest particles, not along the surface.
------------------------------------------------------------------------- */

#ifndef LMP_ALEISPH_TENSION_WIDE_H
#define LMP_ALEISPH_TENSION_WIDE_H

#include "aleisph_cloud.h"

namespace aleisph {

constexpr double WIDE_H = 2.4;    // smoothing length in spacings
Kernel wide_kernel(int dim, double d);

struct WideStencil {
  WideStencil(int dim, double d) : kernel(wide_kernel(dim, d)) {}

  // Rows of surface and wall particles with all neighbours, dry ones included. x, list: as of the
  // stencil of the cloud, but the candidates reach as far as kernel.support().
  void build(const Cloud &cloud, const double *const *x, const CandidateList &list);

  Kernel kernel;
  Stencil pairs;
};

// -G_i, not normalised [1/length], on the rows listed. Fluid neighbours count fully; what is on and
// below walls is added by add_continuation(). Zero where |G| is below 1e-6 of the sum of the moduli
// of its terms, which leaves no direction.
void wide_gradient(const Cloud &cloud, const WideStencil &wide, const Rows &rows, double *N);

}    // namespace aleisph
#endif
