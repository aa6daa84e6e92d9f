// SPDX-License-Identifier: GPL-2.0-only
/* ----------------------------------------------------------------------
   The walls that a contact line near particle i can meet. Normally it is one: the
   nearest, or a mean of those near, so that it changes smoothly along a curved
   wall and around a convex edge. In a concave edge or corner there are several;
   the normals of the particles on the edge, which lie between those of the faces,
   belong to none of these walls.
------------------------------------------------------------------------- */

#ifndef LMP_ALEISPH_TENSION_CONTACT_WALLS_H
#define LMP_ALEISPH_TENSION_CONTACT_WALLS_H

#include "aleisph_cloud.h"

#include <Eigen/Core>
#include <vector>

namespace aleisph {

struct ContactWall {
  Eigen::Vector3d n = Eigen::Vector3d::Zero();
  double height = 0.0;    // of i above it [length]
  double cosine = 0.0;
};

// All by what row i of the stencil sees, that of the cloud or a wider one
class ContactWalls {
 public:
  // A face of the wall next to an edge particle
  struct Face {
    Eigen::Vector3d n;
    int pair;           // of i with the particle on it that is nearest to the edge particle
    double distance;    // between these two
  };

  // cosine: of the contact angle of walls; may be null where only faces() is asked for
  ContactWalls(const Cloud &cloud, const Stencil &s, const double *cosine) :
      cloud_(cloud), s_(s), cosine_(cosine)
  {
  }

  const Cloud &cloud() const { return cloud_; }
  const Stencil &stencil() const { return s_; }

  // by the lowest height first
  std::vector<ContactWall> nearest(int i) const { return walls(i, 0.0); }
  // means over the wall particles that are less than d farther than the nearest
  std::vector<ContactWall> mean(int i) const { return walls(i, cloud_.spacing()); }

  // those that meet at the wall particle of pair k of i; none if that is not on a concave edge
  std::vector<Face> faces(int i, int k) const;

 private:
  std::vector<ContactWall> walls(int i, double depth) const;
  std::vector<Eigen::Vector3d> face_normals(int i) const;
  bool wall(int i, double depth, const Eigen::Vector3d *face, ContactWall &found) const;
  bool is_nearer(int k, int m) const;
  int nearest_pair(int i, const Eigen::Vector3d *face) const;
  bool belongs(int k, const Eigen::Vector3d *face) const;
  bool is_edge(int k) const;
  Eigen::Vector3d normal_at(int k) const;

  const Cloud &cloud_;
  const Stencil &s_;
  const double *cosine_;
};

}    // namespace aleisph
#endif
