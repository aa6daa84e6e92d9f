/* -*- c++ -*- ----------------------------------------------------------
   LAMMPS - Large-scale Atomic/Molecular Massively Parallel Simulator
   USER-ALEISPH package
   SPDX-License-Identifier: GPL-2.0-only

   The velocity filter of aleisph_shift.h as an acceleration, for the styles
   that offer it.
------------------------------------------------------------------------- */

#ifndef LMP_FIX_ALEISPH_FILTER_H
#define LMP_FIX_ALEISPH_FILTER_H

#include "aleisph_roles.h"

#include <vector>

namespace LAMMPS_NS {

class AleisphVelocityFilter {
 public:
  // Adds rate [1/time] times the sum over pairs of fluid particles of which one has one of the
  // roles `which`; a: 3 per owned particle. Velocities of ghosts are valid.
  void add(class FixAleisph &owner, aleisph::Role which, double rate, double *a);
  double bytes() const { return sizeof(double) * (grad_v_.size() + work_.size()); }

 private:
  std::vector<double> grad_v_, work_;
};

}    // namespace LAMMPS_NS

#endif
