/* ----------------------------------------------------------------------
   LAMMPS - Large-scale Atomic/Molecular Massively Parallel Simulator
   USER-ALEISPH package
   SPDX-License-Identifier: GPL-2.0-only

   What a script must fulfil before the equations make sense: commands of
   LAMMPS that do not fit, fixes that are missing or out of order, particles
   that are neither fluid nor wall. Part of the owner, which calls it.
------------------------------------------------------------------------- */

#ifndef LMP_ALEISPH_HALO_CHECKS_H
#define LMP_ALEISPH_HALO_CHECKS_H

#include "pointers.h"

namespace LAMMPS_NS {

class FixAleisph;

class AleisphChecks : protected Pointers {
 public:
  AleisphChecks(LAMMPS *lmp, FixAleisph &owner) : Pointers(lmp), owner_(owner) {}

  // the commands of the script, at the start of each run; errors are those of all ranks
  void script() const;
  // the particles, when a run starts
  void atoms() const;
  // The roles of the particles, at each new instant: of this rank the ID of an atom for each
  // fault, 0 if there is none; then, with the largest of all ranks, the error.
  static constexpr int ROLE_FAULTS = 3;
  void find_wrong_roles(long long *atoms) const;
  void refuse_roles(const long long *atoms) const;

 private:
  void integrator() const;
  void neighbors() const;
  void companions() const;
  void fix_order() const;

  FixAleisph &owner_;
};

}    // namespace LAMMPS_NS

#endif
