// SPDX-License-Identifier: GPL-2.0-only
/* ----------------------------------------------------------------------
   The corrected Laplacian on the infinite square/cubic lattice of spacing d: the
   reference for the diagonal of a row, and the limit of explicit viscosity.
   A wave exp(i k.x) has lap = -mu(k), mu(k) = -sum_j a_0j (1 - cos k.r_0j).
------------------------------------------------------------------------- */

#ifndef LMP_ALEISPH_LATTICE_H
#define LMP_ALEISPH_LATTICE_H

#include "aleisph_kernel.h"

namespace aleisph {

// -d^2 sum_j a_0j: 2.87 in 2d and 3.56 in 3d for the cubic spline at h = 1.2 d
double lattice_diagonal(const Kernel &kernel, double d);

// d^2 max_k mu(k): 4.04 in 2d and 4.28 in 3d for the cubic spline at h = 1.2 d.
// Forward Euler is stable for nu dt/d^2 < 2/lattice_spectral_radius, Adams-Bashforth 2
// for half of it.
double lattice_spectral_radius(const Kernel &kernel, double d);

// lambda of the particle in the corner of a quarter (2d) or an eighth (3d) of the lattice, as in
// the corner of a full tank: 0.29 and 0.23 for the cubic spline at h = 1.2 d
double lattice_corner_lambda(const Kernel &kernel, double d);

}    // namespace aleisph
#endif
