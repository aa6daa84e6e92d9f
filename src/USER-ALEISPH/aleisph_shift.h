// SPDX-License-Identifier: GPL-2.0-only
/* ----------------------------------------------------------------------
   Particle shifting. dr_i [length] is the displacement of fluid particle i
   in this step beyond v dt. Sums run over all neighbours, fluid and wall.

   density  Morikawa, Tsuji & Asai eqs 19-24,
              rho*_i = beta sum_j V W_ij (self included),
              dr = C h (dr_w + dr_dens),
              dr_w = sum_{S*} V W_ij e_ij, without its normal part on the surface,
              dr_dens = sum_{S*} (eps_i + eps_j) e_ij,   S*: |r_ij| < 1.1 sqrt(dim) d
            published: rho* is summed over S* and eps = rho* - 1 everywhere. Eq 23 is printed with
            the index j twice: 2 eps_j; the normal is that of eq 25, aleisph_eigenvalue_normal.h.
            Both can be as in the accurate form: eps_i + eps_j, the gradient of the color function.
            accurate: rho* is summed over the full support; eps = rho* - flat on the surface,
            with the value on a flat surface; a position filter smooths the surface:
              dr += smoothing * b_i N_i,
              b_i = sum_j w r_ji.(N_i + N_j)/2 / sum_j w over surface neighbours with
              N_i.N_j > 0.9 that are not ballistic, w = V W_ij; at corners of the surface eps
              expects less and dr fades out, see aleisph_surface_shape.h
   fickian  Lind, Xu, Stansby & Rogers, J. Comput. Phys. 231 (2012) 1499:
            dr = -D grad C, grad C = sum_j V (1 + 0.2 (W_ij/W(d))^4) gradW_ij,
            on the surface only the tangential part; D = C h^2
   ops      Khayyer, Gotoh & Shimizu, J. Comput. Phys. 332 (2017) 236: fickian, its normal part
            removed on the surface and on particles with surface neighbours within S*, where the
            normal is the mean of theirs (none if they oppose each other, |mean N| < 0.3)
   tvf      Oger, Marrone, Le Touze & de Leffe, J. Comput. Phys. 313 (2016) 76: fickian as a
            transport velocity, |dr| <= 0.25 |v| dt

   The full-support sums (accurate density; grad C) include images of the
   wall particles, since walls are a single layer, and the density also
   images of the surface; see aleisph_shift_images.h. On a lattice at h = 1.2 d
   eps then vanishes to rounding in the bulk, next to walls, on convex edges
   (2e-5 off their ends in 3d) and in all rows of a flat surface. In concave
   corners it is -4.0e-4 (2d; 3d: -2.3e-4 along edges, -7.0e-4 in corners):
   lattice points at sqrt(5) d that no image stands for. Without images it would be -3.3e-3
   (2d), -2.2e-3 (3d) beside every wall and below every surface. With wider
   kernels more is missing in concave corners: -1e-2 at a support of 3 d or
   more. The published sum over S* needs no images.
------------------------------------------------------------------------- */

#ifndef LMP_ALEISPH_SHIFT_H
#define LMP_ALEISPH_SHIFT_H

#include "aleisph_operators.h"

namespace aleisph {

enum class ShiftModel { DENSITY, OPS, FICKIAN, TVF };

struct ShiftParams {
  ShiftModel model = ShiftModel::DENSITY;
  bool published = false;           // density model: S*, eps = rho* - 1
  bool printed_pair = false;        // eq 23 as printed, 2 eps_j
  bool positive_surface = false;    // pairs with a surface member: max(eps_i + eps_j, 0)
  double coefficient = 0.0;         // C, of this step
  double smoothing = 0.0;           // of the surface positions, of this step; accurate density only
  double wall_distance = 0.7;       // fluid closer to a wall, in spacings, is moved off it,
  double wall_step = 0.0;           // by so many spacings in this step, at most
  double limit = 0.1;               // |dr| <= limit * d
  double dt = 0.0;                  // tvf: |dr| <= 0.25 |v| dt
};

struct ShiftCount {
  int limited = 0;    // particles that met limit * d; tvf's own bound is not counted
};

// beta such that beta sum_lattice V W = 1, and the value of beta sum V W on the outermost row of
// a half lattice, both over |r| < reach. On a curved surface this value is flat - curved K d, to
// first order in the curvature K = div_s N: of a sphere of radius R, seen from its outermost
// layer, the layer m d below has 1 - m d/R times what a plane has (R_m/R int W(q) 2 pi q dq,
// q > m d), of a cylinder 1 - m d/(2 R); both are 1 - m d K/2.
struct DensityScale {
  double beta, flat, curved;
};
DensityScale density_scale(const Kernel &kernel, double d, double reach);

// |r_ij| < this: the nearest neighbours S*
double nearest_reach(int dim, double d);

// eps_i of the fluid rows; eps of other particles is not written. curvature: K of owned particles on
// the surface if it is known (with surface tension); without it the shift shrinks a ball of radius
// R = 6 d by 2 % of its volume.
void density_deviation(const Cloud &cloud, bool published, double *eps,
                       const double *curvature = nullptr);

// dr of the fluid rows (3 per particle); zero on ballistic ones, which count as neighbours all the
// same. A wall or buffer neighbour has the deviation of the particle itself: its own would draw the
// fluid into the wall. eps (owned and ghost) is read by the density model only, v (owned) by tvf
// only; what is not read may be null. normal (owned): of the surface, in the published form; null:
// those of the cloud.
ShiftCount compute_shift(const Cloud &cloud, const ShiftParams &params, const double *eps,
                         const double *v, double *dr, const double *normal = nullptr);

// The velocity filter of the accurate density model: acceleration-like sum
//   out_i = sum_j V W_ij (v_j - v_i + (grad v_i + grad v_j).r_ij/2)
// over fluid pairs with a member on the surface and none ballistic. It conserves momentum, and
// vanishes where v is linear (quadratic, if grad_v is exact). The caller scales it.
// grad_v[9*i+3*a+b] = d v_a/d x_b, owned and ghost. out is written on the rows listed.
void surface_velocity_filter(const Cloud &cloud, const Rows &rows, const double *v,
                             const double *grad_v, double *out);

}    // namespace aleisph
#endif
