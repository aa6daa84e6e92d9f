// SPDX-License-Identifier: GPL-2.0-only
/* ----------------------------------------------------------------------
   Guards for splashing flow, where particles have too few neighbours for the
   equations. Each guard returns how often it acted.

   Fields: 3 doubles per particle; input fields valid on owned and ghost
   particles, output on the owned rows listed. The velocity of a wall particle
   is that of the wall. Wall normals point into the fluid.
------------------------------------------------------------------------- */

#ifndef LMP_ALEISPH_GUARDS_H
#define LMP_ALEISPH_GUARDS_H

#include "aleisph_operators.h"

namespace aleisph {

/* ----------------------------------------------------------------------
   Inelastic collision of pairs closer than `reach` [length] that approach,
   v_ij.e_ij < 0:
     v_i -= sum_j w_ij (v_ij.e_ij) e_ij,
     w_ij = 0.5/max(n_i, n_j) between fluid, 1/n_i with a wall,
   n the number of approaching partners, fluid and wall; a wall does not react.
   Conserves linear and angular momentum among fluid. With walls at rest, twice
   the kinetic energy per mass falls by sum_pairs w_ij (v_ij.e_ij)^2 at least.
   First count n (owned rows; the caller makes ghosts valid), then resolve;
   dv is the change of v, zero where there is no collision. Returns the number
   of owned particles changed.
------------------------------------------------------------------------- */
void count_approaching(const Cloud &cloud, const double *v, double reach, double *n);
int collide(const Cloud &cloud, const double *v, const double *n, double reach, double *dv);

/* ----------------------------------------------------------------------
   The self term of the pressure gradient on truncated rows: fluid rows not
   on the surface that have a surface neighbour within near_surface * d. With
     S_i = sum_j g_ij, which points to where the neighbours are,
     S'_i = S_i without its parts along +n of walls within wall_reach * d: the
       vector nearest to S_i with S'.n <= 0 for all their normals n,
     P_i = -sum_j g_ij.g_ji (neighbours that are not fluid: +|g_ij|^2),
     c = |S'|^2/P, sigma = 1 - 2 clip((c - low)/(high - low), 0, 1),
     but not below min(0, (P - response |A|)/|S'|^2), A = sum_j a_ij,
   the self term -p_i S_i of the gradient becomes -p_i (S_i - S'_i) - sigma p_i S'_i:
     grad_i += (1 - sigma) p_i S'_i.
   Why: -dt/rho grad p contains +p_i S_i, a push of a compressed particle into
   its neighbours. Where c > 1 it compresses further, and the projection is
   not a contraction. With the opposite sign it pushes away from the neighbours;
   the part of S along +n is left out, as it would push into the wall.
   (P - sigma |S'|^2)/|A| is the part of a particle's own divergence that its
   own pressure removes, 0.11 on the lattice in 2d, 0.06 in 3d. The neighbours
   do the rest, so that rows with much more overshoot: hence the bound.
   inverse: L_i of owned and ghost fluid particles, 6 per particle, as from
   GradientWeights::inverse() with the floor of g; read of the fluid neighbours of the
   rows concerned. Returns the number of rows changed (sigma < 1).
------------------------------------------------------------------------- */
struct SelfTermParams {
  double low = 0.1, high = 0.3;
  double response = 0.17;
  double near_surface = 2.4, wall_reach = 1.7;    // in spacings
  bool bounded = true;                            // the bound that the Laplacian gives for sigma
};

int correct_self_term(const Cloud &cloud, const SelfTermParams &params, const double *inverse,
                      const double *p, double *grad);

/* ----------------------------------------------------------------------
   Pressure gradient by the symmetric form sum_j V (p_i + p_j) gradW_ij on
   those of the rows listed with lambda < max_lambda; replaces what grad holds there, so it
   comes after correct_self_term(). Returns the number of rows changed.
------------------------------------------------------------------------- */
int symmetric_gradient(const Cloud &cloud, const Rows &rows, double max_lambda, const double *p,
                       double *grad);

/* ----------------------------------------------------------------------
   Wall guard. It acts on a fluid particle that would come closer to a wall than
   q = distance [length] within dt. The distance s after its motion w dt
   (w = v + shift) relative to the wall is replaced by
     q (1/2 + 1/2 exp((s - q)/q)) for s < q,
   by a change dw of its transport velocity, and the approaching part of v
   relative to the wall is removed (dv). Where several walls meet, dw makes
   every distance at least the one of the formula. A fixed smallest distance
   would put several particles into one place in a corner; this map does not.
   The distance is measured along the normal of wall neighbours that lie
   below the particle (tangential offset < 0.8 d after the motion; next to a
   concave edge or corner < 1.5 d, as the faces there go on up to it), on
   convex edges (wall shape below 0.95) along the line that joins the two before the
   motion. A particle more than d/2 behind a wall particle is on the other side
   of a thin body and is not changed.
   dv, dw: zero on rows that are not held. The new transport velocity is
   w + dw; kept as v + shift velocity, the latter changes by dw - dv.
   Returns the number of particles held.
------------------------------------------------------------------------- */
struct WallGuard {
  double distance;        // q
  double dt;              // [time]
  const double *v, *w;    // w: owned particles
};
int hold_off_walls(const Cloud &cloud, const WallGuard &guard, double *dv, double *dw);

// velocities above `speed` are scaled down to it; returns the number of particles
int cap_velocity(const Rows &fluid, int dim, double speed, double *v);

}    // namespace aleisph
#endif
