// SPDX-License-Identifier: GPL-2.0-only
/* ----------------------------------------------------------------------
   Vectors of fields and pairs. Fields have 3 doubles per particle; in 2d the
   z component of a pair is zero.
------------------------------------------------------------------------- */

#ifndef LMP_ALEISPH_VECTORS_H
#define LMP_ALEISPH_VECTORS_H

#include "aleisph_operators.h"

#include <Eigen/Core>

namespace aleisph {

inline Eigen::Vector3d at(const double *field, int i)
{
  return {field[3 * i], field[3 * i + 1], field[3 * i + 2]};
}

// e_ij of pair k
inline Eigen::Vector3d direction(const Stencil &s, int k)
{
  return {s.e(0)[k], s.e(1)[k], s.dim() == 3 ? s.e(2)[k] : 0.0};
}

// x_i - x_j of pair k
inline Eigen::Vector3d separation(const Stencil &s, int k)
{
  return s.r()[k] * direction(s, k);
}

// the symmetric matrix that GradientWeights::inverse() holds of particle i
inline Eigen::Matrix3d packed_matrix(const double *packed, int i)
{
  const double *m = packed + GradientWeights::PACKED * i;    // xx yy zz xy xz yz
  Eigen::Matrix3d L;
  L << m[0], m[3], m[4], m[3], m[1], m[5], m[4], m[5], m[2];
  return L;
}

// g_ij of pair k, which is in row i
inline Eigen::Vector3d pair_gradient(const Stencil &s, const GradientWeights &g, int i, int k)
{
  return g.volume() * s.dw()[k] * (packed_matrix(g.inverse(), i) * direction(s, k));
}

}    // namespace aleisph
#endif
