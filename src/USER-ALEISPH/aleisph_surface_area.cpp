// SPDX-License-Identifier: GPL-2.0-only

#include "aleisph_surface_area.h"

#include "aleisph_tension.h"
#include "aleisph_vectors.h"

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>
#include <vector>

namespace aleisph {
namespace {

using Eigen::Vector2d;
using Eigen::Vector3d;

// on the same side of a sheet, as for the curvature (aleisph_tension_tangent.h)
constexpr double SAME_SIDE = 0.3;
// Half a cell, in spacings, where there is no neighbour on one side: more than half the diagonal of
// a square lattice. Towards a wall it ends there, or after this; contact angles above 11 degrees.
constexpr double EDGE = 1.0, TO_WALL = 5.0;

// A convex polygon around the origin
class Cell {
 public:
  // from -back to front along the first axis, and between -half and half along the second
  void start(double back, double front, double half)
  {
    corners_ = {{-back, -half}, {front, -half}, {front, half}, {-back, half}};
  }

  // keeps p.n <= c
  void cut(const Vector2d &n, double c)
  {
    next_.clear();
    for (std::size_t k = 0; k < corners_.size(); k++) {
      const Vector2d &p = corners_[k], &q = corners_[(k + 1) % corners_.size()];
      const double sp = p.dot(n) - c, sq = q.dot(n) - c;
      if (sp <= 0.0) next_.push_back(p);
      if ((sp < 0.0 && sq > 0.0) || (sp > 0.0 && sq < 0.0))
        next_.push_back(p + (q - p) * (sp / (sp - sq)));
    }
    corners_.swap(next_);
  }

  double area() const
  {
    double sum = 0.0;
    for (std::size_t k = 0; k < corners_.size(); k++) {
      const Vector2d &p = corners_[k], &q = corners_[(k + 1) % corners_.size()];
      sum += 0.5 * (p[0] * q[1] - p[1] * q[0]);
    }
    return sum;
  }

 private:
  std::vector<Vector2d> corners_, next_;
};

// The tangent plane of a particle: axes in it, the first one towards the nearest wall if there is
// one. In 2d the second one is z, and cells are one unit wide along it.
struct Plane {
  Vector3d axis[2];
  Vector2d operator()(const Vector3d &r) const { return {r.dot(axis[0]), r.dot(axis[1])}; }
};

Plane tangent_plane(int dim, const Vector3d &N, const Vector3d &wall)
{
  Plane plane;
  Vector3d first = N.dot(wall) * N - wall;
  if (!(first.norm() > 1.0e-6)) {    // no wall, or it is parallel: any
    first = dim == 2 ? Vector3d(-N[1], N[0], 0.0) : N.unitOrthogonal();
  }
  plane.axis[0] = first.normalized();
  plane.axis[1] = dim == 2 ? Vector3d::UnitZ() : N.cross(plane.axis[0]);
  return plane;
}

// The nearest wall: its normal (zero: there is none) and the height of the particle above it
struct Wall {
  Vector3d n = Vector3d::Zero();
  double height = 0.0;
};

Wall nearest_wall(const Cloud &cloud, int i)
{
  const Stencil &s = cloud.stencil();
  Wall wall;
  int nearest = -1;
  for (int k = s.begin(i); k < s.end(i); k++)
    if ((cloud.role()[s.col()[k]] & WALL) && at(cloud.normal(), s.col()[k]).norm() > 0.5 &&
        (nearest < 0 || s.r()[k] < s.r()[nearest]))
      nearest = k;
  if (nearest < 0) return wall;
  wall.n = at(cloud.normal(), s.col()[nearest]);
  wall.height = separation(s, nearest).dot(wall.n);
  return wall;
}

class Measure {
 public:
  Measure(const Cloud &cloud, const SurfaceFields &fields) :
      cloud_(cloud), fields_(fields), offset_(0.5 * cloud.spacing())
  {
  }

  double of(int i)
  {
    const int dim = cloud_.dim();
    const double a = flat(i);
    const double mean = fields_.K[i] / (dim - 1);
    const double k = mean / (1.0 - mean * offset_);    // of the layer of particles
    const double wider = dim == 2 ? 1.0 + k * k * a * a / 6.0
                                  : std::pow(1.0 + k * k * a * 2.0 / (6.0 * std::sqrt(3.0)), 2);
    return a * wider / std::pow(1.0 - mean * offset_, dim - 1);
  }

 private:
  // in the tangent plane
  double flat(int i)
  {
    const Stencil &s = cloud_.stencil();
    const double d = cloud_.spacing();
    const Vector3d N = at(fields_.N, i);
    const Wall wall = nearest_wall(cloud_, i);
    const Plane plane = tangent_plane(cloud_.dim(), N, wall.n);
    const bool contact = fields_.contact && fields_.contact[4 * i + 3] != 0.0;
    cell_.start(EDGE * d, (contact ? TO_WALL : EDGE) * d, cloud_.dim() == 2 ? 0.5 : EDGE * d);
    for (int k = s.begin(i); k < s.end(i); k++) {
      const int j = s.col()[k];
      if (!on_surface(j) || !(N.dot(at(fields_.N, j)) > SAME_SIDE)) continue;
      const Vector2d u = plane(-separation(s, k));
      const double square = u.squaredNorm();
      if (square > 0.0) cell_.cut(u, 0.5 * square);
    }
    if (wall.n.norm() > 0.5) cell_.cut(-plane(wall.n), wall.height + offset_ * N.dot(wall.n));
    return cell_.area();
  }

  bool on_surface(int j) const
  {
    const Role role = cloud_.role()[j];
    return (role & SURFACE) && !(role & (BALLISTIC | WALL));
  }

  const Cloud &cloud_;
  const SurfaceFields &fields_;
  double offset_;    // delta
  Cell cell_;
};

}    // namespace

SurfaceArea surface_area(const Cloud &cloud, const SurfaceFields &fields)
{
  Measure measure(cloud, fields);
  return sum_rows(surface_rows(cloud), [&](int i) {
    SurfaceArea mine;
    const Vector3d N = at(fields.N, i);
    if (!(N.norm() > 0.5)) return mine;    // without a direction
    mine.area = measure.of(i);
    mine.vector = mine.area * N;
    return mine;
  });
}

}    // namespace aleisph
