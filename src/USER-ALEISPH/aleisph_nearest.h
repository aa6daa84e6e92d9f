// SPDX-License-Identifier: GPL-2.0-only
/* ----------------------------------------------------------------------
   Which of two is nearer, where both may be equally near. On a lattice, and
   on a plane wall, ties are the rule. Who comes first among the neighbours
   depends on the order of particles, which sorting, restarts and the number
   of ranks change; so the place decides: x, then y, then z.
------------------------------------------------------------------------- */

#ifndef LMP_ALEISPH_NEAREST_H
#define LMP_ALEISPH_NEAREST_H

#include <Eigen/Core>
#include <cmath>

namespace aleisph {

// Lengths that differ by less, in spacings, are the same: coordinates of 1e4 d carry a rounding of
// 1e-12 d, some operations more of it.
constexpr double SAME_LENGTH = 1.0e-9;

// A strict weak order, the same on all ranks. a, b: distances, or what is to be small; at_a, at_b:
// places relative to the same particle; d: spacing.
inline bool nearer(double a, const Eigen::Vector3d &at_a, double b, const Eigen::Vector3d &at_b,
                   double d)
{
  const double unit = SAME_LENGTH * d;
  const auto differ = [unit](double p, double q) {
    // far apart in almost all cases: spares the rounding
    return std::abs(p - q) > 2.0 * unit || std::round(p / unit) != std::round(q / unit);
  };
  if (differ(a, b)) return a < b;
  for (int c = 0; c < 3; c++)
    if (differ(at_a[c], at_b[c])) return at_a[c] < at_b[c];
  return false;
}

}    // namespace aleisph
#endif
