// SPDX-License-Identifier: GPL-2.0-only
/* ----------------------------------------------------------------------
   The smoothing kernels of aleisph_kernel.h as functions of q = r/h inside
   the support: W = sigma/h^dim value(q), dW/dr = sigma/h^(dim+1) slope(q).
   Inline and almost free of branches, for loops over pairs.
------------------------------------------------------------------------- */

#ifndef LMP_ALEISPH_KERNEL_SHAPES_H
#define LMP_ALEISPH_KERNEL_SHAPES_H

namespace aleisph {

struct CubicSpline {
  static double value(double q)
  {
    const double u = 2.0 - q;
    return q < 1.0 ? 1.0 + q * q * (0.75 * q - 1.5) : 0.25 * u * u * u;
  }
  static double slope(double q)
  {
    const double u = 2.0 - q;
    return q < 1.0 ? q * (2.25 * q - 3.0) : -0.75 * u * u;
  }
};

struct QuinticSpline {
  static double value(double q)
  {
    double f = power5(3.0 - q);
    if (q < 2.0) f -= 6.0 * power5(2.0 - q);
    if (q < 1.0) f += 15.0 * power5(1.0 - q);
    return f;
  }
  // the three terms cancel at q = 0 only up to rounding: there, the expanded form
  static double slope(double q)
  {
    const double inner = q * (-120.0 + q * q * (120.0 - 50.0 * q));
    const double outer = -5.0 * power4(3.0 - q) + (q < 2.0 ? 30.0 * power4(2.0 - q) : 0.0);
    return q < 1.0 ? inner : outer;
  }

 private:
  static double power4(double x) { return (x * x) * (x * x); }
  static double power5(double x) { return x * power4(x); }
};

struct WendlandC2 {
  static double value(double q)
  {
    const double u = 1.0 - 0.5 * q, u2 = u * u;
    return u2 * u2 * (1.0 + 2.0 * q);
  }
  static double slope(double q)
  {
    const double u = 1.0 - 0.5 * q;
    return -5.0 * q * u * u * u;
  }
};

struct WendlandC4 {
  static double value(double q)
  {
    const double u = 1.0 - 0.5 * q, u2 = u * u;
    return u2 * u2 * u2 * (1.0 + q * (3.0 + 35.0 / 12.0 * q));
  }
  static double slope(double q)
  {
    const double u = 1.0 - 0.5 * q, u2 = u * u;
    return -7.0 / 3.0 * q * (2.0 + 5.0 * q) * (u2 * u2 * u);
  }
};

}    // namespace aleisph
#endif
