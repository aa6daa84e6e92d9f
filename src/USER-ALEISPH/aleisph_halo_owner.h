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
#include "update.h"

namespace LAMMPS_NS {

// rho0 d^dim, which every particle must have
inline double particle_mass(FixAleisph &owner)
{
  return owner.fluid().rho0 * owner.cloud().volume();
}

// Slip walls of v get the tangential velocity of the fluid: see aleisph_wall_contact.h. v: ghosts
// valid before and after.
void slide_with_fluid(FixAleisph &owner, const aleisph::Field &v);

// the velocity of the particles, whose ghosts are valid, with slip walls that slide; in work, if there
// are any
const double *sliding_velocity(FixAleisph &owner, std::vector<double> &work);

// div[i] = div v on fluid rows
void velocity_divergence(FixAleisph &owner, double *div);

/* In the destructor of a fix. LAMMPS keeps the places of fixes in lists until it sets up a run: with
   "run N pre no" after unfix, it would call other fixes, or what is no more. A first run is set up
   whatever pre says: so is the next one, then. */
inline void set_up_next_run(Update *update)
{
  if (update) update->first_update = 0;    // null: LAMMPS ends
}

}    // namespace LAMMPS_NS

#endif
