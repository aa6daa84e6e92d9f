/* -*- c++ -*- ----------------------------------------------------------
   LAMMPS - Large-scale Atomic/Molecular Massively Parallel Simulator
   USER-ALEISPH package
   SPDX-License-Identifier: GPL-2.0-only

   Exact solutions at the particles and the present time, to compare with:
   columns vx, vy, vz, p. Sources of the formulas: aleisph_exact.h
------------------------------------------------------------------------- */

#ifdef COMPUTE_CLASS
// clang-format off
ComputeStyle(aleisph/exact,ComputeAleisphExact);
// clang-format on
#else

#ifndef LMP_COMPUTE_ALEISPH_EXACT_H
#define LMP_COMPUTE_ALEISPH_EXACT_H

#include "compute.h"

#include <functional>

namespace LAMMPS_NS {

class ComputeAleisphExact : public Compute {
 public:
  ComputeAleisphExact(class LAMMPS *, int, char **);
  ~ComputeAleisphExact() override;
  void init() override {}
  void compute_peratom() override;
  double memory_usage() override;

 private:
  // x, time, out: vx, vy, vz, p
  using Solution = std::function<void(const double *, double, double *)>;

  Solution solution_;
  bool steady_;
  int nmax_;
};

}    // namespace LAMMPS_NS

#endif
#endif
