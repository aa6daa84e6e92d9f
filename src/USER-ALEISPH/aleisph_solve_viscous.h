// SPDX-License-Identifier: GPL-2.0-only
/* ----------------------------------------------------------------------
   The matrix of implicit viscosity, the same for each component of v:
     fluid   v_i - share (lap v)_i, without slip walls, share = theta dt nu
     buffer  v_i - v_source
     others  v_i
------------------------------------------------------------------------- */

#ifndef LMP_ALEISPH_SOLVE_VISCOUS_H
#define LMP_ALEISPH_SOLVE_VISCOUS_H

#include "aleisph_solve_csr.h"

#include <vector>

namespace aleisph {

class Cloud;
class VelocityCondition;

// The largest viscosity that makes sense at a time step: of nu dt lap v, which is rounded to 16
// digits, eps nu dt/d^2 |v| is noise, 2e-4 |v| at this limit.
inline double largest_viscosity(double d, double dt)
{
  return 1.0e12 * d * d / dt;
}

// conditions: they know the sources of buffer particles
void assemble_viscous(Cloud &cloud, double share,
                      const std::vector<VelocityCondition *> &conditions, CsrMatrix &matrix);

}    // namespace aleisph
#endif
