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

#include "aleisph_scene.h"
#include "fix.h"

#include <string>
#include <vector>

namespace LAMMPS_NS {

class AleisphVariable;

class FixAleisphWall : public Fix, public aleisph::NormalFinder {
 public:
  FixAleisphWall(class LAMMPS *, int, char **);
  ~FixAleisphWall() override;
  int setmask() override;
  void init() override;
  void setup_pre_force(int) override;
  void setup(int) override;
  void pre_force(int) override;
  void end_of_step() override;
  double compute_scalar() override;
  double compute_vector(int) override;
  int find_normals(const aleisph::Stencil &walls, const double *previous) override;

 private:
  void parse(int narg, char **arg);
  void add_claims() const;
  void set_velocity();
  aleisph::Rows group_rows() const;
  bool is_known(int i) const;
  int copy_given_normals(const aleisph::Stencil &walls, const aleisph::Rows &rows);
  int compute_normals(const aleisph::Stencil &walls, const aleisph::Rows &rows,
                      const double *previous);
  void require_fluid(const aleisph::Stencil &walls, const aleisph::Rows &rows) const;
  void check_normals();
  void warn_of_contradictions();

  bool slip_, curlcurl_;
  std::vector<AleisphVariable> velocity_;    // 3 components, or none if it is not prescribed
  std::string given_;                        // name of the custom property, empty: automatic
  class FixAleisph *owner_;
  bool searched_;    // normals were looked for since they were last checked
  bool watching_;    // some are not known: fluid may come to where they are needed
  bool warned_;      // in this run
  // of this rank, at the last search: normals that are not from facets, not known, and at odds
  // with that of a neighbour; the ID of one of the last
  bigint fallback_, unknown_, contradictory_;
  tagint wrong_;
};

}    // namespace LAMMPS_NS

#endif
#endif
