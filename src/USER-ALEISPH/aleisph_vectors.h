// SPDX-License-Identifier: GPL-2.0-only
/* ----------------------------------------------------------------------
   Vectors of fields and pairs. Fields have 3 doubles per particle; in 2d the
   z component of a pair is zero.
------------------------------------------------------------------------- */

#ifndef LMP_ALEISPH_VECTORS_H
#define LMP_ALEISPH_VECTORS_H

#include "aleisph_stencil.h"

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

}    // namespace aleisph
#endif
