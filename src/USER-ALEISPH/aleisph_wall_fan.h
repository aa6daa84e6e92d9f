// SPDX-License-Identifier: GPL-2.0-only
/* ----------------------------------------------------------------------
   The wall around a wall particle, as seen from it on the unit sphere.

   The nearest wall particles are vertices, unless another wall particle lies on
   the way to them along the wall: at equal distances two vertices are at least
   50 degrees apart. Two vertices that span a facet of the wall are joined by an
   arc. The arcs cut the sphere into sides. A plane wall has two, and the fluid
   is on one of them; where a wall stands on another one that continues behind
   it, there are three. A side that is not closed by arcs, at the rim of a wall,
   ends where its last arc ends. Normal and shape on a side are computed from
   the arcs that bound it, so that a wall behind another one has no effect.

   In 2d a line of particles stands for a wall that extends along z: +z and -z
   are vertices, too.
------------------------------------------------------------------------- */

#ifndef LMP_ALEISPH_WALL_FAN_H
#define LMP_ALEISPH_WALL_FAN_H

#include "aleisph_roles.h"
#include "aleisph_stencil.h"

#include <Eigen/Core>
#include <vector>

namespace aleisph {

struct FanParams {
  double reach = 1.75;       // wall neighbours within reach * d can be vertices
  double detour = 0.85;      // unless another one, nearer to i, is within detour * r_ij of them
  double max_gap = 150.0;    // degrees; no facet is that wide
};

class WallFan {
 public:
  using Vec3 = Eigen::Vector3d;
  static constexpr int NONE = -1;

  struct Vertex {
    Vec3 u;
    int k;                   // the pair of the stencil, -1 for +z and -z in 2d
    std::vector<int> out;    // arcs that leave it, counter-clockwise as seen from outside
  };

  // The angle-weighted mean of the unit normals of the facets, into this side. Its length is 1 on
  // a plane wall and the sine of half the opening angle of an edge.
  struct Mean {
    Vec3 n = Vec3::Zero();
    double lean = 0.0;    // > 0: the facets lean towards n (concave), < 0: away (convex)
  };

  WallFan(const Stencil &s, const Role *role, int i, double d, const FanParams &params);

  int sides() const { return nsides_; }
  int side_of(const Vec3 &direction) const;    // on which it lies, or NONE
  Mean mean(int side) const;
  std::vector<int> boundary(int side) const;    // pairs of the stencil that bound it
  const std::vector<Vertex> &vertices() const { return vertices_; }

 private:
  // An arc has two directions, 2 a and 2 a + 1; the side of a direction lies to its left as seen
  // from outside, where its normal from x to points.
  struct Arc {
    int from, to;
    Vec3 normal;    // unit
    double width;
    int side = NONE;
  };

  void select_vertices(const Stencil &s, const Role *role, int i, double d,
                       const FanParams &params);
  void join_2d();
  void join_3d(const FanParams &params);
  bool is_facet(int v, int w, double width) const;
  void add_arc(int from, int to, double width);
  void sort_around(Vertex &vertex) const;
  void prune();
  void trace_sides();
  int next(int arc) const;
  int previous(int arc) const;
  int side_at(const Vertex &vertex, const Vec3 &p) const;

  std::vector<Vertex> vertices_;
  std::vector<Arc> arcs_;
  std::vector<Vec3> witnesses_;
  int nsides_ = 0;
};

}    // namespace aleisph
#endif
