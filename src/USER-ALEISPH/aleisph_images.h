// SPDX-License-Identifier: GPL-2.0-only
/* ----------------------------------------------------------------------
   Images: where a lattice would go on if it did not end.

   A sum over the full support that is to be the same next to a wall as in
   the bulk needs what lies behind the wall, and walls are a single layer. So
   each wall neighbour j of particle i stands for a second point too, at
   x_j - d n_j. In the same way each SURFACE neighbour j of a fluid particle
   that is not on the surface stands for a point at x_j + d N_j: the row
   below the surface then sees a full lattice, and is not drawn to the
   surface by the deficit. A particle on the surface sees no images of the
   surface, for it is measured against the value of a flat one.

   An image is left out where its place is taken: closer than 0.9 d to
   another wall particle (image of a wall: convex edges, thin plates) or to
   a fluid particle, i itself included (image of the surface: folds, layers
   that touch), or closer than 0.5 d to another image (two faces that meet
   in a convex edge). The nearest particle to the image of a flat wall or
   surface is at d, as is the nearest image. Only neighbours of i are looked
   at: an image near the rim of the support may stay.
------------------------------------------------------------------------- */

#ifndef LMP_ALEISPH_IMAGES_H
#define LMP_ALEISPH_IMAGES_H

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
