// SPDX-License-Identifier: GPL-2.0-only
/* ----------------------------------------------------------------------
   The viscous stress along the normal of a free surface. A surface without
   stress has p - 2 mu N.(grad v).N = p_surf, with surface tension sigma K more:
   Batchelor, An Introduction to Fluid Dynamics (1967), 1.9. The paper omits it;
   without it waves and drops lose about half of what viscosity takes.
------------------------------------------------------------------------- */

#ifndef LMP_ALEISPH_SURFACE_STRESS_H
#define LMP_ALEISPH_SURFACE_STRESS_H

#include "aleisph_rows.h"

namespace aleisph {

// p[i] += 2 mu N_i.(grad v)_i.N_i on rows; N: 3, grad_v: 9 per particle, [9*i+3*a+b] = d v_a/d x_b
void add_viscous_pressure(const Rows &rows, const double *N, double mu, const double *grad_v,
                          int dim, double *p);

// N.(grad v).N: strain rate along the normal
double normal_strain(const double *N, const double *grad_v, int dim);

}    // namespace aleisph
#endif
