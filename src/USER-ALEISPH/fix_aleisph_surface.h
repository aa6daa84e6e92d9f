/* -*- c++ -*- ----------------------------------------------------------
   LAMMPS - Large-scale Atomic/Molecular Massively Parallel Simulator
   USER-ALEISPH package
   SPDX-License-Identifier: GPL-2.0-only

   Free surface: which fluid particles are on it, its outward normals, and its
   parameters in the pressure equation, the inverse moments and the dry walls.
------------------------------------------------------------------------- */

#ifdef FIX_CLASS
// clang-format off
FixStyle(aleisph/surface,FixAleisphSurface);
// clang-format on
#else

#ifndef LMP_FIX_ALEISPH_SURFACE_H
#define LMP_FIX_ALEISPH_SURFACE_H

#include "fix.h"

#include <memory>

namespace aleisph {
struct FreeSurface;
struct SurfaceCount;
struct SurfaceParams;
}    // namespace aleisph

namespace LAMMPS_NS {

class FixAleisphSurface : public Fix {
 public:
  FixAleisphSurface(class LAMMPS *, int, char **);
  ~FixAleisphSurface() override;
  int setmask() override;
  void init() override;
  void setup_pre_force(int) override;
  void pre_force(int) override;
  double compute_vector(int) override;

 private:
  void parse(int narg, char **arg);
  void detect();

  std::unique_ptr<aleisph::SurfaceParams> params_;
  std::unique_ptr<aleisph::FreeSurface> surface_;
  double offset_, reach_;    // as given, < 0: the default
  class FixAleisph *owner_;
  long version_;    // of the positions that the flags belong to
  std::unique_ptr<aleisph::SurfaceCount> count_;
};

}    // namespace LAMMPS_NS

#endif
#endif
