// SPDX-License-Identifier: GPL-2.0-only
/* ----------------------------------------------------------------------
   Images: points that continue a lattice behind walls and beyond the surface.

   Walls are a single layer, so that a sum over the full support lacks what
   lies behind them. Therefore each wall neighbour j of particle i also counts
   at a second point, x_j - d n_j. In the same way each SURFACE neighbour j of
   a fluid particle that is not on the surface also counts at x_j + d N_j: the
   row below the surface then has the sum of a full lattice, and is not drawn
   to the surface. A particle on the surface has no images of the surface, as
   its target is the value on a flat one.

   An image is left out if its place is taken: closer than 0.9 d to another
   wall particle (image of a wall: convex edges, thin plates) or to a fluid
   particle, i itself included (image of the surface: folds, layers that
   touch), or closer than 0.5 d to another image (two faces that meet in a
   convex edge). The nearest particle to the image of a flat wall or surface
   is at d, as is the nearest image. Only neighbours of i are tested: an image
   near the rim of the support may remain.
------------------------------------------------------------------------- */

#ifndef LMP_ALEISPH_SHIFT_IMAGES_H
#define LMP_ALEISPH_SHIFT_IMAGES_H

#include "aleisph_cloud.h"

#include <Eigen/Core>
#include <vector>

namespace aleisph {

class Images {
 public:
  // place taken by a particle, by another image; in spacings
  static constexpr double TAKEN = 0.9, DUPLICATE = 0.5;

  // surface: whether the surface has images (walls have them always)
  Images(const Cloud &cloud, bool surface) :
      s_(cloud.stencil()), role_(cloud.role()), normal_(cloud.normal()), d_(cloud.spacing()),
      support_(cloud.kernel().support()), surface_(surface)
  {
  }

  // x_i - x of the images within the support of owned particle i; valid until the next call
  const std::vector<Eigen::Vector3d> &of(int i);

 private:
  void add(int i, int k, Role kind, double side);
  void remove_duplicates();
  bool taken(int i, int k, Role kind, const Eigen::Vector3d &r) const;

  const Stencil &s_;
  const Role *role_;
  const double *normal_;
  double d_, support_;
  bool surface_;
  std::vector<Eigen::Vector3d> found_;
};

}    // namespace aleisph
#endif
