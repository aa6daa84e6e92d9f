// SPDX-License-Identifier: GPL-2.0-only

#include "aleisph_wall_normals.h"

#include "aleisph_wall_fan.h"

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>

namespace aleisph {
namespace {

using Vec3 = Eigen::Vector3d;

// A mean of directions shorter than this has no direction.
// sums of votes that differ by less, relative, are equal up to rounding
constexpr double SAME_VOTES = 1.0e-9;
constexpr double NO_DIRECTION = 1.0e-6;

// The centre of a square of wall particles is at 0.707 d from them: a line that passes closer to
// one goes through the wall, or grazes it.
constexpr double OPAQUE = 0.72;

// From the neighbour at u_j towards its normal; along a wall that bends this stays on the side of
// the fluid whichever way it bends.
constexpr double INTO_FLUID = 0.5;

// A neighbour that is this concave may have walls behind the one that bounds its fluid.
constexpr double CONCAVE = 1.03;

// cosine of the angle between the normals of wall particles next to each other that is too large
constexpr double OPPOSITE = -0.5;

// Rotations by less are rounding.
constexpr double SAME_NORMAL = 1.0e-9;

struct Wall {
  const Stencil &s;
  const Role *role;
  double d;
  const double *normal, *shape;

  bool is_fluid(int k) const { return (role[s.col()[k]] & (FLUID | WALL)) == FLUID; }
  bool is_wall(int k) const { return role[s.col()[k]] & WALL; }

  Vec3 direction(int k) const
  {
    Vec3 u = Vec3::Zero();
    for (int a = 0; a < s.dim(); a++) u[a] = -s.e(a)[k];
    return u;
  }
};

Vec3 at(const double *v, int i)
{
  return Eigen::Map<const Vec3>(v + 3 * i);
}

// along sum gradW over the fluid; zero if there is no fluid
Vec3 fluid_direction(const Wall &wall, int i)
{
  Vec3 sum = Vec3::Zero();
  double weight = 0.0;
  for (int k = wall.s.begin(i); k < wall.s.end(i); k++) {
    if (!wall.is_fluid(k)) continue;
    sum -= wall.s.dw()[k] * wall.direction(k);
    weight -= wall.s.dw()[k];
  }
  return sum.norm() > NO_DIRECTION * weight ? sum.normalized() : Vec3::Zero();
}

// from i to the neighbour of pair k, past all wall particles
bool can_see(const Wall &wall, int i, int k)
{
  const Stencil &s = wall.s;
  const Vec3 u = wall.direction(k);
  for (int m = s.begin(i); m < s.end(i); m++) {
    if (!wall.is_wall(m) || m == k) continue;
    const Vec3 r = s.r()[m] * wall.direction(m);
    const double along = r.dot(u);
    if (along > 0.0 && along < s.r()[k] &&
        (r - along * u).squaredNorm() < OPAQUE * OPAQUE * wall.d * wall.d)
      return false;
  }
  return true;
}

// the first of those with the most votes, up to rounding; sides are numbered by their places
int largest(const std::vector<double> &votes)
{
  if (votes.empty()) return WallFan::NONE;
  const double most = *std::max_element(votes.begin(), votes.end());
  if (!(most > 0.0)) return WallFan::NONE;
  const auto first = std::find_if(votes.begin(), votes.end(),
                                  [most](double n) { return n >= (1.0 - SAME_VOTES) * most; });
  return static_cast<int>(first - votes.begin());
}

int side_of_fluid(const Wall &wall, int i, const WallFan &fan)
{
  std::vector<double> votes(fan.sides(), 0.0);
  for (int k = wall.s.begin(i); k < wall.s.end(i); k++) {
    if (!wall.is_fluid(k) || !can_see(wall, i, k)) continue;
    const int side = fan.side_of(wall.direction(k));
    if (side != WallFan::NONE) votes[side] -= wall.s.dw()[k];
  }
  return largest(votes);
}

/* ----------------------------------------------------------------------
   Does i, at -u from j, bound the fluid of j? In a concave edge of half
   opening beta = asin(1/shape) the walls that do lie at beta from n_j, and
   the continuation of one of them behind the other at pi - beta. Where more
   walls meet, as at the foot of a column, they come closer to one another;
   in between is half of cos(pi - beta).
------------------------------------------------------------------------- */
bool bounds_same_fluid(const Vec3 &u, const Vec3 &n_j, double shape_j)
{
  if (shape_j <= CONCAVE) return true;
  return -u.dot(n_j) > -0.5 * std::sqrt(1.0 - 1.0 / (shape_j * shape_j));
}

int side_of_neighbours(const Wall &wall, const WallFan &fan)
{
  std::vector<double> votes(fan.sides(), 0.0);
  for (const WallFan::Vertex &vertex : fan.vertices()) {
    if (vertex.k == WallFan::NONE || vertex.out.empty()) continue;
    const int j = wall.s.col()[vertex.k];
    const Vec3 n_j = at(wall.normal, j);
    if (n_j.isZero(0.0) || !bounds_same_fluid(vertex.u, n_j, wall.shape[j])) continue;
    const int side = fan.side_of(vertex.u + INTO_FLUID * n_j);
    if (side != WallFan::NONE) votes[side] += 1.0;
  }
  return largest(votes);
}

int find_side(const Wall &wall, int i, const WallFan &fan, const Vec3 &previous)
{
  int side = previous.isZero(0.0) ? WallFan::NONE : fan.side_of(previous);
  if (side == WallFan::NONE) side = side_of_fluid(wall, i, fan);
  if (side == WallFan::NONE) side = side_of_neighbours(wall, fan);
  return side;
}

struct Found {
  Vec3 n = Vec3::Zero();
  double shape = 0.0;
  NormalStatus status = NormalStatus::UNKNOWN;
  std::vector<int> around;    // pairs with wall particles next to it that bound the same fluid
};

bool take_mean(const WallFan::Mean &mean, Found &found)
{
  const double c = mean.n.norm();
  if (c <= NO_DIRECTION) return false;
  found.n = mean.n / c;
  found.shape = mean.lean > 0.0 ? 1.0 / c : c;
  found.status = NormalStatus::FAN;
  return true;
}

Found find(const Wall &wall, int i, const Vec3 &previous)
{
  Found found;
  const WallFan fan(wall.s, wall.role, i, wall.d, FanParams());
  const int side = find_side(wall, i, fan, previous);
  if (side == WallFan::NONE && fan.sides() > 0) return found;
  if (side != WallFan::NONE) found.around = fan.boundary(side);
  if (side == WallFan::NONE || !take_mean(fan.mean(side), found)) {
    const Vec3 n = previous.isZero(0.0) ? fluid_direction(wall, i) : previous;
    if (!n.isZero(0.0)) {
      found.n = n;
      found.shape = 1.0;
      found.status = NormalStatus::FLUID;
    }
  }
  if ((found.n - previous).norm() < SAME_NORMAL) found.n = previous;
  return found;
}

bool contradicts(const Wall &wall, const Found &found)
{
  return std::any_of(found.around.begin(), found.around.end(), [&](int k) {
    const int j = wall.s.col()[k];
    const Vec3 n_j = at(wall.normal, j);
    return n_j.dot(found.n) < OPPOSITE && bounds_same_fluid(wall.direction(k), n_j, wall.shape[j]);
  });
}

}    // namespace

NormalCount wall_normals(const Stencil &walls, const Rows &rows, const double *previous,
                         Cloud &cloud, std::vector<NormalStatus> &status)
{
  double *const normal = cloud.normal();
  const Wall wall{walls, cloud.role(), cloud.spacing(), normal, cloud.shape()};
  // m: place in rows
  const int n = static_cast<int>(rows.size());
  std::vector<Found> found(n);
  for_rows(n, [&](int m) {
    found[m] = find(wall, rows[m], previous ? at(previous, rows[m]) : Vec3::Zero());
  });
  for_rows(n, [&](int m) {
    const int i = rows[m];
    for (int a = 0; a < 3; a++) normal[3 * i + a] = found[m].n[a];
    cloud.shape()[i] = found[m].shape;
    status[i] = found[m].status;
  });
  const auto has = [&status](NormalStatus which) {
    return [&status, which](int i) { return status[i] == which; };
  };
  NormalCount count;
  count.found = n - count_rows(rows, has(NormalStatus::UNKNOWN));
  count.fallback = count_rows(rows, has(NormalStatus::FLUID));
  count.contradictory = select_rows(n, [&](int m) { return contradicts(wall, found[m]); });
  for (int &row : count.contradictory) row = rows[row];
  return count;
}

bool normals_in_sight(const Stencil &walls, const Rows &unknown, const Cloud &cloud)
{
  const Wall wall{walls, cloud.role(), cloud.spacing(), cloud.normal(), cloud.shape()};
  const int found = count_rows(unknown, [&](int i) {
    // without fluid nothing has changed for it
    bool fluid = false;
    for (int k = walls.begin(i); k < walls.end(i) && !fluid; k++) fluid = wall.is_fluid(k);
    return fluid && find(wall, i, Vec3::Zero()).status != NormalStatus::UNKNOWN;
  });
  return found > 0;
}

void wall_shapes(const Stencil &walls, const Rows &rows, Cloud &cloud)
{
  for_rows(rows, [&](int i) {
    const WallFan fan(walls, cloud.role(), i, cloud.spacing(), FanParams());
    const int side = fan.side_of(at(cloud.normal(), i));
    Found found;
    cloud.shape()[i] = side != WallFan::NONE && take_mean(fan.mean(side), found) ? found.shape
                                                                                 : 1.0;
  });
}

}    // namespace aleisph
