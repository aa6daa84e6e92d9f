/* -*- c++ -*- ----------------------------------------------------------
   LAMMPS - Large-scale Atomic/Molecular Massively Parallel Simulator
   USER-ALEISPH package
   SPDX-License-Identifier: GPL-2.0-only

   Energy of the fluid: kinetic, potential in a given gravity, and of its
   surface (aleisph_surface_area.h).
------------------------------------------------------------------------- */

#ifdef COMPUTE_CLASS
// clang-format off
ComputeStyle(aleisph/energy,ComputeAleisphEnergy);
// clang-format on
#else

#ifndef LMP_COMPUTE_ALEISPH_ENERGY_H
#define LMP_COMPUTE_ALEISPH_ENERGY_H

#include "compute.h"

namespace LAMMPS_NS {

class ComputeAleisphEnergy : public Compute {
 public:
  ComputeAleisphEnergy(class LAMMPS *, int, char **);
  ~ComputeAleisphEnergy() override;
  void init() override;
  double compute_scalar() override;
  void compute_vector() override;

 private:
  enum Part { KINETIC, POTENTIAL, SURFACE, NUM_PARTS };

  void parse(int narg, char **arg);
  void add_particles(double *mine) const;
  double surface_energy() const;
  void check_walls(const double *cosine, double *wall) const;

  double gravity_[3], origin_[3];
  bool surface_;
  class FixAleisph *owner_;
};

}    // namespace LAMMPS_NS

#endif
#endif
