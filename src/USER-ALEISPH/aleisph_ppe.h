// SPDX-License-Identifier: GPL-2.0-only
/* ----------------------------------------------------------------------
   The pressure Poisson equation, Morikawa, Tsuji & Asai eqs 5 and 15-18:
     fluid      -d^2 (lap p)_i       = -d^2 rho0/dt (div v*)_i
     wall       -d (n.grad p)_i      = -d rho0/dt (v*_i - v_wall).n_i
     dirichlet  p_i                  = p_prescribed
     surface    p_i + a N_i.(grad p)_i = p_surf
   The free surface lies a length a outside of its particles: half a spacing
   if each fills the volume around it; a = 0 is the published row.
   Rows are scaled by d^2 and d, so that every entry is of order one, every
   diagonal is positive and a residual r [pressure] means, times
   dt^2/(rho0 d^2), an error of |div v| dt in the fluid or of |v.n| dt/d at
   the wall. A singular wall row (|diagonal| < MIN_WALL_DIAGONAL) becomes
   p = p_surf and is counted; so does a fluid row without neighbours. A surface row
   whose diagonal 1 - a sum_j N.g_ij is not above 1, and one without normal, is
   p_i = p_surf.
------------------------------------------------------------------------- */

#ifndef LMP_ALEISPH_PPE_H
#define LMP_ALEISPH_PPE_H

#include "aleisph_csr.h"
#include "aleisph_operators.h"

namespace aleisph {

enum class RowType : char { NONE, FLUID, WALL, DIRICHLET, SINGULAR, SURFACE };

struct PpeRows {
  int fluid = 0, wall = 0, dirichlet = 0, singular = 0, surface = 0;
};

// How rows next to a free surface are made; the defaults are those of a scene without one
struct PpeOptions {
  double surface_offset = 0.0;     // a [length]
  double min_wall_lambda = 0.0;    // wall rows below are singular
  int min_wall_fluid = 0;          // and those with fewer fluid neighbours
};

constexpr double MIN_WALL_DIAGONAL = 0.1;

// role: owned and ghost; normal: 3 doubles per particle, read on wall and surface rows.
// laplacian: pair array of a_ij of the fluid rows; its memory becomes that of the matrix.
// type: one entry per owned row, written.
PpeRows assemble_ppe(const Stencil &s, const GradientWeights &g, std::vector<double> &&laplacian,
                     const Role *role, const double *normal, double d, CsrMatrix &A,
                     std::vector<RowType> &type, const PpeOptions &options = PpeOptions());

// vstar: v* on fluid and wall; vwall: wall velocity v_wall on wall rows (3 doubles
// per particle); div: (div v*) on fluid rows; p: prescribed on dirichlet rows;
// p_surf: on surface and singular rows; tension: added on surface rows, null if there is none.
void ppe_rhs(const std::vector<RowType> &type, const double *normal, const double *vstar,
             const double *vwall, const double *div, const double *p, double d, double rho_over_dt,
             double *b, double p_surf = 0.0, const double *tension = nullptr);

}    // namespace aleisph
#endif
