// SPDX-License-Identifier: GPL-2.0-only
/* ----------------------------------------------------------------------
   The start-up flows are eigenfunction series in exp(-lambda_n^2 tau),
   tau = nu t/length^2. As their terms grow in number like tau^(-1/2), the
   first instants are computed instead from the layer that diffuses from a
   plane wall (Carslaw & Jaeger, Conduction of Heat in Solids, 2.4-2.9):
     wall suddenly moved           u = U erfc(z)
     fluid suddenly accelerated    u = G t (1 - 4 i2erfc(z))
   with z = (distance to the wall)/(2 sqrt(nu t)).
------------------------------------------------------------------------- */

#include "aleisph_exact.h"

#include <algorithm>
#include <cmath>
#include <math.h>    // j0, j1 of POSIX; libstdc++'s std::cyl_bessel_j has errors of 1e-11
#include <vector>

namespace aleisph {
namespace exact {
namespace {

constexpr double PI = 3.14159265358979323846;

// exp(-40) = 4e-18 is below the rounding error of a sum of order one
constexpr double NEGLIGIBLE = 40.0;

// Between walls at distance 2 H, for tau = nu t/H^2 below this, what one wall does at the other
// is below erfc(1/sqrt(tau)) = 2e-23, and the images at 3 H are below that.
constexpr double EARLY_CHANNEL = 0.02;

// 4 i2erfc(z): 1 on the wall, 0 far from it
double acceleration_deficit(double z)
{
  return (1.0 + 2.0 * z * z) * std::erfc(z) - 2.0 / std::sqrt(PI) * z * std::exp(-z * z);
}

struct BesselZero {
  double lambda, j1;    // J0(lambda) = 0, J1(lambda)
};

// McMahon's expansion (Abramowitz & Stegun 9.5.12), then Newton with J0' = -J1
BesselZero bessel_zero(int n)
{
  const double b = (n - 0.25) * PI;
  double x = b + 1.0 / (8.0 * b) - 124.0 / (3.0 * std::pow(8.0 * b, 3));
  for (int k = 0; k < 4; k++) x += ::j0(x) / ::j1(x);
  return {x, ::j1(x)};
}

constexpr int BESSEL_ZEROS = 1000;

const std::vector<BesselZero> &bessel_zeros()
{
  static const std::vector<BesselZero> zeros = [] {
    std::vector<BesselZero> z;
    for (int n = 1; n <= BESSEL_ZEROS; n++) z.push_back(bessel_zero(n));
    return z;
  }();
  return zeros;
}

// tau at which the last zero is just negligible: 4e-6. Before it the layer is 500 times thinner
// than the radius; the plane layer times sqrt(R/r) leaves an error of order tau u.
const double EARLY_PIPE = NEGLIGIBLE / std::pow(BESSEL_ZEROS * PI, 2);

}    // namespace

double pipe_poiseuille(double r, double t, double R, double G, double nu)
{
  const double s = r / R, u_max = G * R * R / (4.0 * nu), steady = 1.0 - s * s;
  if (t < 0.0) return u_max * steady;
  if (t == 0.0) return 0.0;
  const double tau = nu * t / (R * R);
  if (tau < EARLY_PIPE) {
    const double z = 0.5 * (1.0 - s) / std::sqrt(tau);
    return G * t * (1.0 - acceleration_deficit(z) / std::sqrt(std::max(s, 0.1)));
  }
  double sum = 0.0;
  for (const BesselZero &zero : bessel_zeros()) {
    const double l = zero.lambda, decay = l * l * tau;
    if (decay > NEGLIGIBLE) break;
    sum += 8.0 * ::j0(l * s) / (l * l * l * zero.j1) * std::exp(-decay);
  }
  return u_max * (steady - sum);
}

double plane_poiseuille(double y, double t, double H, double G, double nu)
{
  const double s = y / H, u_max = 0.5 * G * H * H / nu, steady = 1.0 - s * s;
  if (t < 0.0) return u_max * steady;
  if (t == 0.0) return 0.0;
  const double tau = nu * t / (H * H);
  if (tau < EARLY_CHANNEL) {
    const double z = 0.5 / std::sqrt(tau);
    return G * t *
        (1.0 - acceleration_deficit(z * (1.0 - s)) - acceleration_deficit(z * (1.0 + s)));
  }
  double sum = 0.0;
  for (int n = 0;; n++) {
    const double l = (n + 0.5) * PI, decay = l * l * tau, sign = n % 2 ? -1.0 : 1.0;
    if (decay > NEGLIGIBLE) break;
    sum += sign * 4.0 / (l * l * l) * std::cos(l * s) * std::exp(-decay);
  }
  return u_max * (steady - sum);
}

double couette(double y, double t, double H, double U, double nu)
{
  const double s = y / H;
  if (t < 0.0) return U * s;
  if (t == 0.0) return s < 1.0 ? 0.0 : U;
  const double tau = nu * t / (H * H);
  if (tau < EARLY_CHANNEL) {
    // the moving wall and its image, which keeps the wall at rest
    const double z = 0.5 / std::sqrt(tau);
    return U * (std::erfc(z * (1.0 - s)) - std::erfc(z * (1.0 + s)));
  }
  double sum = 0.0;
  for (int n = 1;; n++) {
    const double l = n * PI, decay = l * l * tau, sign = n % 2 ? -1.0 : 1.0;
    if (decay > NEGLIGIBLE) break;
    sum += sign * 2.0 / l * std::sin(l * s) * std::exp(-decay);
  }
  return U * (s + sum);
}

Flow2d taylor_green(const Place2d &at, double L, double U, double rho, double nu)
{
  const auto [x, y, t] = at;
  const double k = 2.0 * PI / L, f = std::exp(-2.0 * nu * k * k * t);
  return {U * std::sin(k * x) * std::cos(k * y) * f, -U * std::cos(k * x) * std::sin(k * y) * f,
          0.25 * rho * U * U * (std::cos(2.0 * k * x) + std::cos(2.0 * k * y)) * f * f};
}

namespace {

// The root of tan(q)/q = tanh(c)/c in (pi, 3 pi/2), where the left side grows from 0 to infinity;
// below pi there is none but q = 0, as tan(q)/q >= 1 > tanh(c)/c and then tan(q) < 0.
double stokes_wavenumber(double c)
{
  double low = PI, high = 1.5 * PI;
  for (int n = 0; n < 100 && high - low > 0.0; n++) {
    const double q = 0.5 * (low + high);
    if (q == low || q == high) break;
    // sin and cos, not tan: no pole at the end of the bracket; cos(q) < 0 in it
    (std::sin(q) * c > std::tanh(c) * q * std::cos(q) ? low : high) = q;
  }
  return 0.5 * (low + high);
}

// cosh(x)/sinh(c) and sinh(x)/sinh(c) for |x| <= c, without overflow
double cosh_ratio(double x, double c)
{
  return (std::exp(x - c) + std::exp(-x - c)) / -std::expm1(-2.0 * c);
}

double sinh_ratio(double x, double c)
{
  return (std::exp(x - c) - std::exp(-x - c)) / -std::expm1(-2.0 * c);
}

}    // namespace

/* ----------------------------------------------------------------------
   Stream function f(z) cos(kx) exp(-s t), z = y - H/2, a = H/2:
     f = A sinh(kz)/sinh(ka) + B sin(mz),   s = nu (k^2 + m^2),
   the first part harmonic, with the pressure rho s A cosh(kz)/sinh(ka)
   sin(kx), the second without pressure. f = f' = 0 at z = +-a gives
   A = -B sin(ma) and tan(ma)/ma = tanh(ka)/ka. |f'| is largest at z = 0.
------------------------------------------------------------------------- */
Flow2d stokes_mode(const Place2d &at, double Lx, double H, double U, double rho, double nu)
{
  const auto [x, y, t] = at;
  const double a = 0.5 * H, z = y - a, k = 2.0 * PI / Lx, c = k * a;
  const double q = stokes_wavenumber(c), m = q / a;
  const double A1 = -std::sin(q);    // for B = 1
  const double B = U / (A1 * k / std::sinh(c) + m), A = A1 * B;
  const double rate = nu * (k * k + m * m), decay = std::exp(-rate * t);
  const double f = A * sinh_ratio(k * z, c) + B * std::sin(m * z);
  const double df = A * k * cosh_ratio(k * z, c) + B * m * std::cos(m * z);
  return {df * std::cos(k * x) * decay, k * f * std::sin(k * x) * decay,
          rho * rate * A * cosh_ratio(k * z, c) * std::sin(k * x) * decay};
}

}    // namespace exact
}    // namespace aleisph
