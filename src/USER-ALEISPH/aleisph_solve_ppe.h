// SPDX-License-Identifier: GPL-2.0-only
/* ----------------------------------------------------------------------
   The pressure Poisson equation, Morikawa, Tsuji & Asai eqs 5 and 15-18:
     fluid      -d^2 (lap p)_i       = -d^2 rho0/dt (div v*)_i
     wall       -d R_i(p)            = -d rho0/dt [(v*_i - v_wall).n_i + alpha_i (div v*)_i]
     dirichlet  p_i                  = p_prescribed
     surface    p_i + a N_i.(grad p)_i = p_surf
   R is n.grad p by the corrected gradient and alpha = 0 as published, else as in
   aleisph_wall_row.h. The free surface lies a length a outside of its particles: half a spacing
   if each fills the volume around it, and what the flow makes of that, see
   aleisph_surface_layer.h; a = 0 is the published row.
   Rows are scaled by d^2 and d, so that every entry is of order one, every
   diagonal is positive and a residual r [pressure] means, times
   dt^2/(rho0 d^2), an error of |div v| dt in the fluid or of |v.n| dt/d at
   the wall. A singular wall row (|diagonal| < MIN_WALL_DIAGONAL) becomes
   p = p_surf and is counted; so does a fluid row without neighbours. A surface row
   whose diagonal 1 - a sum_j N.g_ij is not above 1, and one without normal, is
   p_i = p_surf.
------------------------------------------------------------------------- */

#ifndef LMP_ALEISPH_SOLVE_PPE_H
#define LMP_ALEISPH_SOLVE_PPE_H

#include "aleisph_operators.h"
#include "aleisph_solve_csr.h"

namespace aleisph {

enum class RowType : char { NONE, FLUID, WALL, DIRICHLET, SINGULAR, SURFACE };

struct PpeRows {
  int fluid = 0, wall = 0, dirichlet = 0, singular = 0, surface = 0;
  int limited = 0;    // of the wall rows, see MAX_WRONG_SIGN
};

// What each owned row is
struct PpeLayout {
  std::vector<RowType> type;
  std::vector<double> alpha;    // of wall rows, in spacings: see aleisph_wall_row.h
};

// How rows next to a free surface are made; the defaults are those of a scene without one
struct PpeOptions {
  double surface_offset = 0.0;     // a [length], where the layer is that of a lattice
  const double *layer = nullptr;   // see aleisph_surface_layer.h; null: it is so everywhere
  double min_wall_lambda = 0.0;    // wall rows below are singular
  int min_wall_fluid = 0;          // and those with fewer fluid neighbours
  bool isotropic_walls = false;    // wall rows by isotropic_wall_row(), where no surface is near
};

// The largest pressure that makes sense at a time step: the gradient of one that is rounded to 16
// digits moves fluid by eps p dt^2/(rho0 d^2) spacings in a step, 2e-4 at this limit.
inline double largest_pressure(double rho0, double d, double dt)
{
  return 1.0e12 * rho0 * (d / dt) * (d / dt);
}

constexpr double MIN_WALL_DIAGONAL = 0.1;
// With isotropic_walls, in wall rows next to a free surface: the largest sum of the weights whose sign
// makes the diagonal smaller, over the sum of the others
constexpr double MAX_WRONG_SIGN = 0.5;

// laplacian: pair array of a_ij of the fluid rows; its memory becomes that of the matrix.
// layout: one entry per owned row, written.
PpeRows assemble_ppe(const Cloud &cloud, std::vector<double> &&laplacian, const PpeOptions &options,
                     CsrMatrix &A, PpeLayout &layout);

// What the right-hand side is made of; owned particles
struct PpeFields {
  double rho_over_dt = 0.0;
  const double *vstar = nullptr;      // v* on fluid and wall, 3 per particle
  const double *vwall = nullptr;      // velocity of the wall on wall rows, 3 per particle
  const double *div = nullptr;        // dt/rho0 lap p: div v* on fluid rows, for second_order on
  bool second_order = false;          // wall rows, too
  const double *p = nullptr;          // prescribed, on dirichlet rows
  double p_surf = 0.0;                // on surface and singular rows
  const double *load = nullptr;       // added on surface rows; null if there is none
};

void ppe_rhs(const Cloud &cloud, const PpeLayout &layout, const PpeFields &fields, double *b);

}    // namespace aleisph
#endif
