// SPDX-License-Identifier: GPL-2.0-only
/* ----------------------------------------------------------------------
   Fluid property file: lines "name value"; text after # is a comment.
     rho0   density              required, > 0
     nu     kinematic viscosity  optional, >= 0
     sigma  surface tension      optional, >= 0
------------------------------------------------------------------------- */

#ifndef LMP_ALEISPH_FLUID_H
#define LMP_ALEISPH_FLUID_H

#include <istream>
#include <string>

namespace aleisph {

struct FluidProperties {
  double rho0 = 0.0, nu = 0.0, sigma = 0.0;
};

// returns an empty string, or what is wrong and in which line
std::string read_fluid(std::istream &in, FluidProperties &fluid);

}    // namespace aleisph
#endif
