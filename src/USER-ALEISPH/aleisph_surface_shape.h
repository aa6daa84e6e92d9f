// SPDX-License-Identifier: GPL-2.0-only
/* ----------------------------------------------------------------------
   How much of the neighbourhood of a surface particle the fluid fills, from
   the directions of its neighbours alone:
     A_i = |sum_j q_ij e_ij| / sum_j q_ij,   q = -W'(r) r.
   A is 0 in the bulk and 1 for a particle with one neighbour. It does not
   change when the neighbours come closer. So it shows which part of a low
   density comes from the shape of the surface, and which from particles that
   are far apart. On the outermost particle of a lattice
   that fills the whole space, half of it, a quarter (corner in 2d, edge in
   3d) or an eighth, A and the density beta sum V W are known; in between,
   the density is interpolated linearly in A.
------------------------------------------------------------------------- */

#ifndef LMP_ALEISPH_SURFACE_SHAPE_H
#define LMP_ALEISPH_SURFACE_SHAPE_H

#include "aleisph_operators.h"

#include <Eigen/Core>
#include <array>

namespace aleisph {

class SurfaceShape {
 public:
  SurfaceShape(const Kernel &kernel, double d);

  // of owned particle i
  double asymmetry(const Stencil &s, int i) const;

  // density relative to rho0 of an undisturbed particle where the surface has this asymmetry
  double density(double asymmetry) const;

  // 0 on a flat surface, 1 on a right-angled corner (2d) or edge (3d) and beyond
  double corner(double asymmetry) const;

 private:
  struct Part {
    double asymmetry, density;
  };
  Part lattice(const Kernel &kernel, double d, int cuts) const;

  std::array<Part, 4> parts_;    // whole, half, quarter, eighth (2d: the quarter again)
};

}    // namespace aleisph
#endif
