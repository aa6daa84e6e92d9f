// SPDX-License-Identifier: GPL-2.0-only
/* ----------------------------------------------------------------------
   Surface tension: outward normals N and curvature K = div_s N of the free
   surface, which is 1/R on a cylinder (and in 2d) and 2/R on a sphere. The
   pressure inside is sigma K above that outside.

   model `tangent`: with no factor that is fitted,
   1. N_i = -G_i/|G_i|, G a colour gradient over the wide support 4.8 d
      (Wendland C2), sources below walls included (aleisph_contact.h);
   2. A_i = sym[ (sum_j V (N_j - N_i) (x) gradW_ij) (sum_j V gradW_ij (x) r_ji)^-1 ]
      in the tangent plane of i, j on the surface with N_i.N_j > 0.3; its
      eigenvalues k are the principal curvatures of the layer of particles;
   3. to the true surface, half a spacing outside of the layer:
      K_i = sum k/(1 + k d/2), exact for spheres and for cylinders;
   4. one mean over i and its neighbours on the surface, weights 1 - r/(2.4 d).
      It takes away noise, and with it 6 % (2d, R = 10 d) to 13 % (3d, R = 8 d)
      of the change of K when a drop is stretched to the mode n = 2.
   model `published`: Morikawa, Tsuji & Asai, eqs 25 and 27 with the sign of N
   mended,
      N_i = -N* / |N*|, N* = sum_j V (lambda_j - lambda_i) L_i gradW_ij,
      kappa_i = factor sum_j V (N_j - N_i).L_i gradW_ij, j on the surface,
   K = (dim - 1) kappa in the meaning above (kappa: mean curvature; the paper
   writes 2 sigma kappa for the pressure in three dimensions).

   Conventions: s is the stencil of the operators, fields have 3 doubles per
   particle, input valid on owned and ghost particles, output written on the
   rows listed (owned particles on the surface).
------------------------------------------------------------------------- */

#ifndef LMP_ALEISPH_TENSION_H
#define LMP_ALEISPH_TENSION_H

#include "aleisph_operators.h"

namespace aleisph {

// kernel of the wide colour gradient
constexpr double WIDE_H = 2.4;    // smoothing length in spacings; support 4.8 d
Kernel wide_kernel(int dim, double d);

// Normals further apart (73 degrees) belong to different surfaces: the other side of a film, the
// other flank of a cusp. It must let pass 45 degrees, the turn between the rim and the edge of a
// cube.
constexpr double SAME_SURFACE = 0.3;

// owned fluid particles that are on the surface and not ballistic
Rows surface_rows(const Rows &fluid, const Role *role);

// -G_i, not normalised [1/length]; wide: rows with all neighbours, fluid and wall. Fluid
// neighbours count fully, what is on and below walls is added by add_continuation(). Zero where
// |G| is below 1e-6 of the sum of the moduli of its terms, which leaves no direction.
void wide_gradient(const Stencil &wide, const Rows &rows, const Role *role, double volume,
                   double *N);
// Normalises; returns the number of rows without a direction (N = 0)
int normalise(const Rows &rows, double *N);

// -N* of eq 25, not normalised, zero as in wide_gradient(). lambda: owned and ghost.
void eigenvalue_gradient(const Stencil &s, const GradientWeights &g, const Rows &rows,
                         const double *lambda, double *N);

struct CurvatureCount {
  int few = 0;        // fewer than three fluid neighbours: K = 0
  int unknown = 0;    // no N, or the second bracket has no inverse: mean of neighbours with K
  int limited = 0;    // a principal curvature below -2/(3 d), or |K| > 1/d
};

// Steps 2 and 3. volume: d^dim. K: NaN-free; known[i] = 1 if K_i could be computed, else 0 (and
// K_i = 0); both one per particle, doubles, so that ghosts can be exchanged.
CurvatureCount tangent_curvature(const Stencil &s, const Rows &rows, const Role *role,
                                 const double *N, double volume, double *K, double *known);
// Step 4 and the bound |K| <= 1/d; neighbours with N_i.N_j > 0.3 as far as K is known there. K and
// known valid on owned and ghost
void smooth_curvature(const Stencil &s, const Rows &rows, const Role *role, const double *N,
                      const double *K, const double *known, double d, double *mean,
                      CurvatureCount &count);
// eq 27 with its factor, as K = (dim - 1) kappa
CurvatureCount published_curvature(const Stencil &s, const GradientWeights &g, const Rows &rows,
                                   const Role *role, const double *N, double factor, double d,
                                   double *K);

// N.(grad v).N: strain rate along the normal, grad_v[9*i+3*a+b] = d v_a/d x_b
double normal_strain(const double *N, const double *grad_v, int dim);

}    // namespace aleisph
#endif
