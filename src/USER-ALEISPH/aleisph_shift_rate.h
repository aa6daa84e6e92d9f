// SPDX-License-Identifier: GPL-2.0-only
/* ----------------------------------------------------------------------
   How fast particles are to be shifted, from the flow itself. Two things
   disturb an arrangement of particles:
     S   the rate of strain, root of the mean of 2 e:e, e = (grad v + its
         transpose)/2: it distorts the arrangement whatever the spacing;
     a   the pressure gradient over the density, root of its mean square: where
         the pressure falls towards the surface from outside, ripples of the
         size d grow at a rate of the order sqrt(a/d), and so does disorder
         inside, by errors of the gradient.
   Neither depends on the frame of the observer, on a free fall or on a rigid
   rotation (S). The velocity scale of the rates per U dt/d is
     U = SPAN d S + sqrt(a d) .
   For fluid at rest S = 0, and the rest of U does not depend on the depth.
------------------------------------------------------------------------- */

#ifndef LMP_ALEISPH_SHIFT_RATE_H
#define LMP_ALEISPH_SHIFT_RATE_H

#include "aleisph_operators.h"

namespace aleisph {

// Sums over fluid rows that are not ballistic, to be added over ranks
struct FlowSums {
  double strain = 0.0;      // of 2 e:e
  double gradient = 0.0;    // of |grad p|^2
  double count = 0.0;
};

// grad_v as of velocity_gradient(), grad_p as of gradient(), of the fluid rows
FlowSums flow_sums(const Cloud &cloud, const double *grad_v, const double *grad_p);

// U; 0 without fluid
double flow_scale(const FlowSums &sums, double d, double rho0);

// The largest C of the accurate density model with which no mode of a small disorder of the lattice
// overshoots: 1/|the largest eigenvalue| of dr/C over all wave vectors. From twice as much on, modes
// of wave length 4 d grow from step to step. 0.17 in 2d, 0.07 in 3d (default kernel).
double largest_coefficient(const Kernel &kernel, double d);

// The work of the shift on the surface. What is on the surface has no pressure, so that moving it by
// dr_n along the normal changes the energy by that of the fluid there, e = v^2/2 + phi per mass. A
// shift that is the same everywhere restores the volume; the rest does the work
//   W = sum dr_n (e - <e>), over surface particles that are not ballistic.
// If W > 0 the shift feeds waves: the part of dr_n in proportion to e - <e> is taken away, which
// leaves W = 0. Work that is taken from the flow is left.
struct SurfaceWork {
  double work = 0.0, square = 0.0;    // W; sum (e - <e>)^2
};
Rows surface_that_works(const Cloud &cloud);
// e of the rows listed, e_mean their mean: sums to be added over ranks
SurfaceWork surface_work(const Cloud &cloud, const Rows &rows, const double *e, double e_mean,
                         const double *dr);
void remove_surface_work(const Cloud &cloud, const Rows &rows, const double *e, double e_mean,
                         const SurfaceWork &total, double *dr);

}    // namespace aleisph
#endif
