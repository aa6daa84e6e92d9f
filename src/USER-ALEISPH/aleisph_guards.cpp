// SPDX-License-Identifier: GPL-2.0-only
/* ----------------------------------------------------------------------
   The guards that act on velocities: collisions, wall guard, cap.

   Energy of a collision, with a_ij = v_ij.e_ij: the change of sum v_i^2 is
   -2 sum_pairs w a^2 + sum_i |sum_j w a e|^2, and by Jensen's inequality
   |sum_j w a e|^2 <= n_i sum_j w^2 a^2, so that the second sum is at most
   sum_pairs (n_i + n_j) w^2 a^2 <= sum_pairs w a^2.
------------------------------------------------------------------------- */

#include "aleisph_guards.h"

#include "aleisph_cloud.h"
#include "aleisph_nearest.h"
#include "aleisph_vectors.h"

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>
#include <vector>

namespace aleisph {
namespace {

using Vec3 = Eigen::Vector3d;

// tangential offset up to which a wall particle lies below, in spacings: less than 1, so that a
// face does not reach beyond a convex edge, and more than sqrt(2)/2, the middle of a cell
constexpr double BELOW = 0.8;
// the same for the faces that meet in a concave corner, whose particle has no normal of a face;
// more than sqrt(2), the offset of the nearest particle of the face from a corner in 3d
constexpr double BELOW_IN_CORNER = 1.5;
// a neighbour that stands out from the tangent plane by more than this makes a concave corner
constexpr double CONCAVE = 0.3;
constexpr double CONVEX = 0.95;          // shape below which a wall particle lies on a convex edge
constexpr double OTHER_SIDE = -0.5;      // so far behind a wall is not held
constexpr int MAX_PASSES = 20;           // over the walls that hold a particle
constexpr double TOLERANCE = 1.0e-12;    // of a distance, in spacings

inline void store(const Vec3 &value, double *v, int i)
{
  for (int a = 0; a < 3; a++) v[3 * i + a] = value[a];
}

// v_ij.e_ij where pair k collides, else 0
double approach(const Cloud &cloud, int i, int k, const double *v, double reach)
{
  const Stencil &s = cloud.stencil();
  const Role *const role = cloud.role();
  const int j = s.col()[k];
  if (!(s.r()[k] < reach) || !(role[j] & (FLUID | WALL))) return 0.0;
  return std::min((at(v, i) - at(v, j)).dot(direction(s, k)), 0.0);
}

/* ----------------------------------------------------------------------
   wall guard
------------------------------------------------------------------------- */

struct WallNeighbour {
  Vec3 n;           // direction of the distance
  Vec3 v;           // of the wall
  Vec3 end;         // r_ij after the motion
  double s;         // distance after the motion
  double target;    // the distance to be reached at least
  bool convex;
};
using WallNeighbours = std::vector<WallNeighbour>;

// continuous; its slope is 1/2 at most below q, so that a particle held comes to rest on the way
double soft_distance(double s, double q)
{
  return s < q ? q * (0.5 + 0.5 * std::exp((s - q) / q)) : s;
}

// seen from outside
bool convex_edge(double shape)
{
  return shape > 0.0 && shape < CONVEX;
}

// the wall particles on whose fluid side particle i is
WallNeighbours wall_neighbours(const Cloud &cloud, const WallGuard &guard, int i)
{
  const Stencil &s = cloud.stencil();
  WallNeighbours walls;
  for (int k = s.begin(i); k < s.end(i); k++) {
    const int j = s.col()[k];
    if (!(cloud.role()[j] & WALL)) continue;
    WallNeighbour wall;
    const Vec3 r_ij = s.r()[k] * direction(s, k);
    wall.convex = convex_edge(cloud.shape()[j]);
    wall.n = wall.convex ? direction(s, k) : at(cloud.normal(), j);
    wall.v = at(guard.v, j);
    wall.end = r_ij + guard.dt * (at(guard.w, i) - wall.v);
    wall.s = wall.end.dot(wall.n);
    wall.target = soft_distance(wall.s, guard.distance);
    if (wall.n.squaredNorm() > 0.0 && r_ij.dot(wall.n) > OTHER_SIDE * cloud.spacing())
      walls.push_back(wall);
  }
  return walls;
}

// Does the plane of this wall particle continue below the particle? nearest: of all wall particles.
bool below(const WallNeighbour &wall, const WallNeighbour &nearest, double d)
{
  const double offset = (wall.end - wall.s * wall.n).norm();
  if (offset < BELOW * d) return true;
  const bool corner = !nearest.convex && nearest.n.dot(nearest.end - wall.end) > CONCAVE * d;
  return corner && offset < BELOW_IN_CORNER * d;
}

// those of them that hold the particle
WallNeighbours holding(const WallNeighbours &walls, double distance, double d)
{
  WallNeighbours found;
  if (walls.empty()) return found;
  const auto nearest = std::min_element(
      walls.begin(), walls.end(), [d](const WallNeighbour &a, const WallNeighbour &b) {
        return nearer(a.end.norm(), a.end, b.end.norm(), b.end, d);
      });
  for (const WallNeighbour &wall : walls)
    if (wall.s < distance && below(wall, *nearest, d)) found.push_back(wall);
  return found;
}

struct Held {
  Vec3 dx = Vec3::Zero(), dv = Vec3::Zero();
};

// Corrects for the wall whose distance is violated most, until none is: the result does not depend
// on the order of the walls, and particles of one plane act once.
Held hold(const WallNeighbours &walls, const Vec3 &v_i, double d)
{
  Held held;
  const auto missing = [&held](const WallNeighbour &wall) {
    return wall.target - (wall.s + held.dx.dot(wall.n));
  };
  for (int pass = 0; pass < MAX_PASSES; pass++) {
    const auto worst = std::min_element(
        walls.begin(), walls.end(), [&missing, d](const WallNeighbour &a, const WallNeighbour &b) {
          return nearer(-missing(a), a.end, -missing(b), b.end, d);
        });
    if (!(missing(*worst) > TOLERANCE * d)) break;
    held.dx += missing(*worst) * worst->n;
    held.dv -= std::min((v_i + held.dv - worst->v).dot(worst->n), 0.0) * worst->n;
  }
  return held;
}

}    // namespace

void count_approaching(const Cloud &cloud, const double *v, double reach, double *n)
{
  const Stencil &s = cloud.stencil();
  for_rows(cloud.fluid(), [&](int i) {
    n[i] = 0.0;
    for (int k = s.begin(i); k < s.end(i); k++)
      if (approach(cloud, i, k, v, reach) < 0.0) n[i] += 1.0;
  });
}

int collide(const Cloud &cloud, const double *v, const double *n, double reach, double *dv)
{
  const Stencil &s = cloud.stencil();
  return count_rows(cloud.fluid(), [&](int i) {
    Vec3 sum = Vec3::Zero();
    bool collides = false;
    for (int k = s.begin(i); k < s.end(i); k++) {
      const double a_ij = approach(cloud, i, k, v, reach);
      if (!(a_ij < 0.0)) continue;
      const int j = s.col()[k];
      const double w_ij = (cloud.role()[j] & WALL) ? 1.0 / n[i] : 0.5 / std::max(n[i], n[j]);
      sum -= w_ij * a_ij * direction(s, k);
      collides = true;
    }
    store(sum, dv, i);
    return collides;
  });
}

int hold_off_walls(const Cloud &cloud, const WallGuard &guard, double *dv, double *dw)
{
  const double d = cloud.spacing();
  return count_rows(cloud.fluid(), [&](int i) {
    const WallNeighbours walls = holding(wall_neighbours(cloud, guard, i), guard.distance, d);
    const Held held = walls.empty() ? Held() : hold(walls, at(guard.v, i), d);
    store(held.dv, dv, i);
    store(held.dx / guard.dt, dw, i);
    return !walls.empty();
  });
}

int cap_velocity(const Rows &fluid, int dim, double speed, double *v)
{
  return count_rows(fluid, [&](int i) {
    double v2 = 0.0;
    for (int a = 0; a < dim; a++) v2 += v[3 * i + a] * v[3 * i + a];
    if (!(v2 > speed * speed)) return false;
    for (int a = 0; a < dim; a++) v[3 * i + a] *= speed / std::sqrt(v2);
    return true;
  });
}

}    // namespace aleisph
