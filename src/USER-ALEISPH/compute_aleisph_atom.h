/* -*- c++ -*- ----------------------------------------------------------
   LAMMPS - Large-scale Atomic/Molecular Massively Parallel Simulator
   USER-ALEISPH package
   SPDX-License-Identifier: GPL-2.0-only

   Per-particle quantities of the aleisph fixes, for dumps and variables.
------------------------------------------------------------------------- */

#ifdef COMPUTE_CLASS
// clang-format off
ComputeStyle(aleisph/atom,ComputeAleisphAtom);
// clang-format on
#else

#ifndef LMP_COMPUTE_ALEISPH_ATOM_H
#define LMP_COMPUTE_ALEISPH_ATOM_H

#include "compute.h"

#include <vector>

namespace LAMMPS_NS {

class ComputeAleisphAtom : public Compute {
 public:
  ComputeAleisphAtom(class LAMMPS *, int, char **);
  ~ComputeAleisphAtom() override;
  void init() override;
  void compute_peratom() override;
  double memory_usage() override;

 private:
  enum class Field {
    P,
    DIVV,
    LAMBDA,
    COND,
    NX,
    NY,
    NZ,
    ROW,
    NNEIGH,
    SURFACE,
    RHO,
    UX,
    UY,
    UZ,
    KAPPA,
    PTENSION,
    TNX,
    TNY,
    TNZ,
    CONTACT
  };

  static bool parse(const std::string &word, Field &field);
  void fill(Field field, double *out, int stride);
  std::vector<double> divergence() const;
  std::vector<double> density() const;
  void require_tension() const;
  double surface_kind(int i) const;
  double value(Field field, int i);
  double tension_value(Field field, int i) const;

  std::vector<Field> fields_;
  class FixAleisph *owner_;
  int nmax_;
};

}    // namespace LAMMPS_NS

#endif
#endif
