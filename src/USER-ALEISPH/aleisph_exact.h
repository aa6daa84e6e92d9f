// SPDX-License-Identifier: GPL-2.0-only
/* ----------------------------------------------------------------------
   Exact solutions that the examples are compared with. All are per unit of
   the caller's choice; lengths, nu [length^2/time] and G = body force or
   -dp/dx/rho [length/time^2] in one consistent system.
------------------------------------------------------------------------- */

#ifndef LMP_ALEISPH_EXACT_H
#define LMP_ALEISPH_EXACT_H

namespace aleisph {
namespace exact {

// Axial velocity at radius r of the start-up from rest in a pipe of radius R;
// t < 0 means the steady profile. Szymanski, J. Math. Pures Appl. 11 (1932) 67.
double pipe_poiseuille(double r, double t, double R, double G, double nu);
// Velocity at distance y from the mid-plane, walls at +-H; t < 0: steady.
double plane_poiseuille(double y, double t, double H, double G, double nu);
// Velocity at height y, wall y = 0 at rest, wall y = H moving with U from t = 0; t < 0: steady.
double couette(double y, double t, double H, double U, double nu);

// Taylor-Green vortices on a square of side L, period L:
// u = U sin(kx) cos(ky) f, v = -U cos(kx) sin(ky) f, f = exp(-2 nu k^2 t), k = 2 pi/L,
// p = rho U^2/4 (cos 2kx + cos 2ky) f^2
struct Place2d {
  double x, y, t;
};
struct Flow2d {
  double u, v, p;
};
Flow2d taylor_green(const Place2d &at, double L, double U, double rho, double nu);

// Slowest decaying Stokes mode that is symmetric in u about the mid-plane, in a
// channel with no-slip walls at y = 0 and y = H, periodic in x with wavelength
// Lx; amplitude U. The wall pressure is not linear: dp/dn = rho nu n.lap v != 0.
Flow2d stokes_mode(const Place2d &at, double Lx, double H, double U, double rho, double nu);

}    // namespace exact
}    // namespace aleisph
#endif
