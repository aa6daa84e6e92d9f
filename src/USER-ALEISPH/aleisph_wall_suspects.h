// SPDX-License-Identifier: GPL-2.0-only
/* ----------------------------------------------------------------------
   Walls that the pressure equation is known to suffer from. Looked for where
   it has not converged: walls are one layer of particles at the spacing of
   the fluid, and their faces lie farther apart than the support.
------------------------------------------------------------------------- */

#ifndef LMP_ALEISPH_WALL_SUSPECTS_H
#define LMP_ALEISPH_WALL_SUSPECTS_H

#include "aleisph_cloud.h"

namespace aleisph {

// owned wall particles, -1: none
struct WallSuspects {
  // In spacings: another wall particle is nearer, none is as near. Walls that end on a round body
  // keep 0.65 d; the diagonal of a square face is 1.41 d.
  static constexpr double DENSE = 0.6, SPARSE = 1.5;

  int dense = -1;
  int sparse = -1;
  int facing = -1;    // sees a face that looks the other way within the support
};

WallSuspects wall_suspects(const Cloud &cloud);

}    // namespace aleisph
#endif
