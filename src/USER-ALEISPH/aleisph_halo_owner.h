/* ----------------------------------------------------------------------
   LAMMPS - Large-scale Atomic/Molecular Massively Parallel Simulator
   USER-ALEISPH package
   SPDX-License-Identifier: GPL-2.0-only

   The owner and what it lends to styles. The headers of styles name these
   classes only, their sources include this.
------------------------------------------------------------------------- */

#ifndef LMP_ALEISPH_HALO_OWNER_H
#define LMP_ALEISPH_HALO_OWNER_H

#include "aleisph_cloud.h"            // IWYU pragma: export
#include "aleisph_fluid.h"            // IWYU pragma: export
#include "aleisph_halo_fields.h"      // IWYU pragma: export
#include "aleisph_halo_warnings.h"    // IWYU pragma: export
#include "aleisph_mpi_ranks.h"        // IWYU pragma: export
#include "aleisph_scene.h"            // IWYU pragma: export
#include "aleisph_timers.h"           // IWYU pragma: export
#include "fix_aleisph.h"              // IWYU pragma: export

namespace LAMMPS_NS {

// rho0 d^dim, which every particle must have
inline double particle_mass(FixAleisph &owner)
{
  return owner.fluid().rho0 * owner.cloud().volume();
}

}    // namespace LAMMPS_NS

#endif
