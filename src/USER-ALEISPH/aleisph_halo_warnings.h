/* ----------------------------------------------------------------------
   LAMMPS - Large-scale Atomic/Molecular Massively Parallel Simulator
   USER-ALEISPH package
   SPDX-License-Identifier: GPL-2.0-only

   What runs without an error and is wrong all the same, or slow: told once,
   with an atom and the remedy. Part of the owner. All functions are
   collective.
------------------------------------------------------------------------- */

#ifndef LMP_ALEISPH_HALO_WARNINGS_H
#define LMP_ALEISPH_HALO_WARNINGS_H

#include "pointers.h"

#include <set>
#include <string>

namespace LAMMPS_NS {

class FixAleisph;

class AleisphWarnings : protected Pointers {
 public:
  AleisphWarnings(LAMMPS *lmp, FixAleisph &owner) : Pointers(lmp), owner_(owner) {}

  // when a run starts, with the forces complete
  void start();
  // in every step; looks at the time step in some of them
  void step();
  // At the end of a step, before the velocity of walls is kept for the next one: do walls of this
  // group move by their forces? previous: 3 per owned particle.
  void moved_walls(int groupbit, const double *previous);

  // of a pressure that has not converged, to be added to the message: walls that it suffers from
  std::string likely_cause();

 private:
  void body_force();
  void imbalance();
  void time_step();
  // true if it has not been said before
  bool first(const std::string &what) { return said_.insert(what).second; }

  FixAleisph &owner_;
  std::set<std::string> said_;
};

}    // namespace LAMMPS_NS

#endif
