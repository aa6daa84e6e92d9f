// SPDX-License-Identifier: GPL-2.0-only
/* ----------------------------------------------------------------------
   Smoothing kernels W(r, h) and their derivatives, in two and three
   dimensions. Integral of W over space is 1.
     cubic-spline    support 2h   Monaghan & Lattanzio, A&A 149 (1985) 135
     quintic-spline  support 3h   Morris, Fox & Zhu, JCP 136 (1997) 214
     wendland-c2     support 2h   Wendland, Adv. Comput. Math. 4 (1995) 389
     wendland-c4     support 2h   (same; both as used by Dehnen & Aly,
                                  MNRAS 425 (2012) 1068)
   Symbols: h smoothing length [length], r distance [length],
   W [1/length^dim], dW/dr [1/length^(dim+1)].
------------------------------------------------------------------------- */

#ifndef LMP_ALEISPH_KERNEL_H
#define LMP_ALEISPH_KERNEL_H

#include "aleisph_kernel_shapes.h"

#include <string>

namespace aleisph {

enum class KernelType { CUBIC_SPLINE, QUINTIC_SPLINE, WENDLAND_C2, WENDLAND_C4 };

class Kernel {
 public:
  // dim is 2 or 3, h > 0; anything else throws std::invalid_argument
  Kernel(KernelType type, int dim, double h);

  // false if the name is unknown; type is then untouched
  static bool parse(const std::string &name, KernelType &type);
  // the names parse() knows, separated by ", " (for error messages)
  static const char *names();
  // support radius divided by h: 2 or 3
  static double support_over_h(KernelType type);

  double w(double r) const;     // 0 for r >= support()
  double dw(double r) const;    // dW/dr <= 0; 0 at r = 0 and for r >= support()
  double h() const { return h_; }
  double support() const { return support_; }
  int dim() const { return dim_; }
  double inverse_h() const { return inverse_h_; }
  double slope_norm() const { return norm_ * inverse_h_; }    // dW/dr = slope_norm() slope(r/h)

  // calls function with the shape of this kernel (see aleisph_kernel_shapes.h), so that a loop
  // over pairs decides once
  template <class Function> auto with_shape(Function function) const
  {
    switch (type_) {
      case KernelType::CUBIC_SPLINE: return function(CubicSpline());
      case KernelType::QUINTIC_SPLINE: return function(QuinticSpline());
      case KernelType::WENDLAND_C2: return function(WendlandC2());
      case KernelType::WENDLAND_C4: break;
    }
    return function(WendlandC4());
  }

 private:
  KernelType type_;
  int dim_;
  double h_, inverse_h_, support_, norm_;
};

inline double Kernel::w(double r) const
{
  if (r >= support_) return 0.0;
  const double q = r * inverse_h_;
  return norm_ * with_shape([q](auto shape) { return decltype(shape)::value(q); });
}

inline double Kernel::dw(double r) const
{
  if (r >= support_) return 0.0;
  const double q = r * inverse_h_;
  return slope_norm() * with_shape([q](auto shape) { return decltype(shape)::slope(q); });
}

}    // namespace aleisph
#endif
