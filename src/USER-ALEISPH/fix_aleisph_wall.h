/* -*- c++ -*- ----------------------------------------------------------
   LAMMPS - Large-scale Atomic/Molecular Massively Parallel Simulator
   USER-ALEISPH package
   SPDX-License-Identifier: GPL-2.0-only

   Which particles are wall, their velocity and their normals (into the
   fluid). Walls are one layer of particles on the wall surface.
------------------------------------------------------------------------- */

#ifdef FIX_CLASS
// clang-format off
FixStyle(aleisph/wall,FixAleisphWall);
// clang-format on
#else

#ifndef LMP_FIX_ALEISPH_WALL_H
#define LMP_FIX_ALEISPH_WALL_H

#include "fix.h"

#include <array>
#include <string>

namespace LAMMPS_NS {

class FixAleisphWall : public Fix {
 public:
  FixAleisphWall(class LAMMPS *, int, char **);
  int setmask() override;
  void init() override;
  void setup_pre_force(int) override;
  void setup(int) override;
  void pre_force(int) override;
  void end_of_step() override;
  double compute_scalar() override;

 private:
  struct Component {
    double value = 0.0;
    std::string variable;    // equal-style, empty if constant
  };

  void parse(int narg, char **arg);
  void set_velocity();
  void find_normals();
  void copy_given_normals();
  void compute_normals();

  bool slip_, curlcurl_, prescribed_;
  std::array<Component, 3> velocity_;
  std::string given_;    // name of the custom property, empty: automatic
  class FixAleisph *owner_;
  bigint version_;    // of the positions that the normals belong to
  int from_fluid_;    // normals of this rank that fell back on the fluid direction
};

}    // namespace LAMMPS_NS

#endif
#endif
