/* ----------------------------------------------------------------------
   LAMMPS - Large-scale Atomic/Molecular Massively Parallel Simulator
   USER-ALEISPH package
   SPDX-License-Identifier: GPL-2.0-only

   What the owner sets in LAMMPS where the script has not set it: masses, the
   skin of neighbor lists, the bins in which particles are sorted. All follow
   from spacing and density. What the script sets later replaces it.
------------------------------------------------------------------------- */

#include "aleisph_halo_owner.h"

#include "atom.h"
#include "neighbor.h"
#include "update.h"

#include <map>

using namespace LAMMPS_NS;

namespace {

// of LAMMPS (Update::set_units), for the units that this package knows
const std::map<std::string, double> DEFAULT_SKIN = {
    {"lj", 0.3}, {"si", 1.0e-3}, {"cgs", 0.1}, {"micro", 0.1}, {"nano", 0.1}};

// In spacings. Between the first two LAMMPS' own skin may stay: below, lists are rebuilt in every
// step of moving particles (0.2 at a Courant number of 0.1); above, most of a list is out of reach.
// The third is every second step at a Courant number of 0.2.
constexpr double SMALLEST_SKIN = 0.2, LARGEST_SKIN = 1.0, SKIN = 0.5;
// Bins of about the support keep neighbors near each other in memory.
constexpr double SORT_BIN = 2.0;

}    // namespace

void FixAleisph::set_masses()
{
  if (!atom->mass) return;    // a mass per atom
  for (int type = 1; type <= atom->ntypes; type++)
    if (!atom->mass_setflag[type]) atom->set_mass(FLERR, type, particle_mass(*this));
}

// LAMMPS does not say whether a skin was set; one that is just its default counts as not set.
void FixAleisph::set_skin()
{
  const auto found = DEFAULT_SKIN.find(update->unit_style);
  if (found == DEFAULT_SKIN.end() || neighbor->skin != found->second) return;
  const double skin = neighbor->skin / cloud_->spacing();
  if (skin < SMALLEST_SKIN || skin > LARGEST_SKIN) neighbor->skin = SKIN * cloud_->spacing();
}

// Without a pair style LAMMPS has no size of its own, and would not sort.
void FixAleisph::set_sorting()
{
  if (atom->sortfreq > 0 && atom->userbinsize == 0.0)
    atom->userbinsize = SORT_BIN * cloud_->spacing();
}
