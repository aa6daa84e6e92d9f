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
#include "fix.h"

#include <memory>
#include <vector>

namespace aleisph {
struct SurfaceCount;
struct SurfaceParams;
}    // namespace aleisph

namespace LAMMPS_NS {

class FixAleisphSurface : public Fix, public aleisph::SurfaceLoad {
 public:
  FixAleisphSurface(class LAMMPS *, int, char **);
  ~FixAleisphSurface() override;
  void post_constructor() override;
  int setmask() override;
  void init() override;
  void setup_pre_force(int) override;
  void pre_force(int) override;
  double compute_vector(int) override;
  double memory_usage() override;

  // aleisph::SurfaceLoad: the normal viscous stress; null in a fluid without viscosity
  const double *surface_pressure() const override;

 private:
  void parse(int narg, char **arg);
  void detect();
  void find_particles();
  bool stressed() const;
  void find_stress();
  bool follows() const;
  void follow();
  void find_gradient(const std::vector<int> &rows);

  std::unique_ptr<aleisph::SurfaceParams> params_;
  std::unique_ptr<aleisph::FreeSurface> surface_;
  double offset_, reach_;    // as given, < 0: the default
  bool viscous_;             // with the viscous stress
  bool fixed_;               // the layer between particles and surface does not follow the flow
  class FixAleisph *owner_;
  long version_;    // of the positions that the flags belong to
  std::unique_ptr<aleisph::SurfaceCount> count_;
  long limited_;             // layers at their largest stretch, this rank
  std::vector<double> p_, grad_v_, sliding_;
};

}    // namespace LAMMPS_NS

#endif
#endif
