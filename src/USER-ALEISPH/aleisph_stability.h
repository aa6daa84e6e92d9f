// SPDX-License-Identifier: GPL-2.0-only
/* ----------------------------------------------------------------------
   Stability limits of explicit viscosity, from the eigenvalues of the
   corrected Laplacian on the square/cubic lattice of spacing d: a wave
   exp(i k.x) has lap = -mu(k), mu(k) = -sum_j a_0j (1 - cos k.r_j).
------------------------------------------------------------------------- */

#ifndef LMP_ALEISPH_STABILITY_H
#define LMP_ALEISPH_STABILITY_H

#include "aleisph_kernel.h"

namespace aleisph {

// d^2 max_k mu(k): 4.04 in 2d and 4.39 in 3d for the cubic spline at h = 1.2 d.
// Forward Euler is stable for nu dt/d^2 < 2/lattice_spectral_radius, AB2 for half of it.
double lattice_spectral_radius(const Kernel &kernel, double d);

}    // namespace aleisph
#endif
