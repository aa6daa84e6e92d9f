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

#include "aleisph_scene.h"
#include "aleisph_surface.h"
#include "fix.h"

namespace LAMMPS_NS {

class FixAleisphSurface : public Fix {
 public:
  FixAleisphSurface(class LAMMPS *, int, char **);
  int setmask() override;
  void init() override;
  void setup_pre_force(int) override;
  void pre_force(int) override;
  double compute_vector(int) override;

 private:
  void parse(int narg, char **arg);
  void detect();

  aleisph::SurfaceParams params_;
  aleisph::FreeSurface surface_;
  double offset_, reach_;    // as given, < 0: the default
  class FixAleisph *owner_;
  long version_;    // of the positions that the flags belong to
  aleisph::SurfaceCount count_;
};

}    // namespace LAMMPS_NS

#endif
#endif
