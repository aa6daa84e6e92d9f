// SPDX-License-Identifier: GPL-2.0-only
/* ----------------------------------------------------------------------
   How far the velocity of a particle is from the linear field that its own
   gradient predicts for its neighbours,
     out_i = sum_j w_ij (v_j - v_i - (grad v)_i.r_ji) / sum_j w_ij,
     w_ij = 1 - |r_ij|/support,
   over fluid neighbours that are not ballistic. It vanishes where v is
   linear, and is a diffusion of v elsewhere. In the fluid it is zero for a
   potential flow, since lap grad phi = 0, but it damps velocities that alternate
   between neighbours. With little viscosity surface tension amplifies such noise
   at the surface. It does not conserve momentum exactly.
   v: owned and ghost; grad_v[9*i+3*a+b] = d v_a/d x_b of the fluid rows.
------------------------------------------------------------------------- */

#ifndef LMP_ALEISPH_TENSION_ROUGHNESS_H
#define LMP_ALEISPH_TENSION_ROUGHNESS_H

#include "aleisph_cloud.h"

namespace aleisph {

// The share of it that a high-pass filter takes off in unit time: min(filter sqrt(sigma/(rho d^3)),
// 1/dt), more in one step would overshoot
double roughness_rate(double filter, double sigma, double rho, double d, double dt);

// a_i += rate out_i on the fluid rows
void add_roughness(const Cloud &cloud, double rate, const double *v, const double *grad_v,
                   double *a);

}    // namespace aleisph
#endif
