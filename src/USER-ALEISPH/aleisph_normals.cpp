// SPDX-License-Identifier: GPL-2.0-only
/* ----------------------------------------------------------------------
   u directions to wall neighbours, axis: roughly into the fluid. Where two
   walls meet, the facets that bound the fluid are those next to each other
   as seen along the axis; the sense of rotation about it orients them, so
   that a badly tilted axis cannot flip a single facet.
------------------------------------------------------------------------- */

#include "aleisph_normals.h"

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>

namespace aleisph {
namespace {

using Vec3 = Eigen::Vector3d;

constexpr double PI = 3.14159265358979323846;
constexpr double DEGREE = PI / 180.0;

// A sum of directions shorter than this part of their number has no direction.
constexpr double NO_DIRECTION = 1.0e-6;

// Members closer than this in azimuth hide one another: where a wall ends on another wall that
// goes on behind it, the part behind is no boundary of this fluid.
constexpr double HIDDEN = 20.0 * DEGREE;

// A facet wider than this is a piece of wall only if there is a wall particle in it, as there is
// on the diagonal of a square cell, and not on the free top of a tank's corner.
constexpr double NEEDS_WITNESS = 75.0 * DEGREE;
constexpr double WITNESS = 30.0 * DEGREE;    // so far from the bisector, at most
constexpr double WITNESS_REACH = 1.4;        // and in units of the reach of the fan

struct Neighbour {
  double r;
  Vec3 u;
};
using Fan = std::vector<Neighbour>;

Vec3 direction(const Stencil &s, int k)
{
  Vec3 u = Vec3::Zero();
  for (int a = 0; a < s.dim(); a++) u[a] = -s.e(a)[k];
  return u;
}

double angle(const Vec3 &u, const Vec3 &v)
{
  return std::atan2(u.cross(v).norm(), u.dot(v));
}

// along sum gradW over the fluid; zero if there is no fluid
Vec3 fluid_direction(const Stencil &s, const Role *role, int i)
{
  Vec3 sum = Vec3::Zero();
  double weight = 0.0;
  for (int k = s.begin(i); k < s.end(i); k++) {
    const Role role_j = role[s.col()[k]];
    if (!(role_j & FLUID) || (role_j & WALL)) continue;
    sum -= s.dw()[k] * direction(s, k);
    weight -= s.dw()[k];
  }
  return sum.norm() > NO_DIRECTION * weight ? sum.normalized() : Vec3::Zero();
}

// by distance
Fan wall_neighbours(const Stencil &s, const Role *role, int i, double reach)
{
  Fan all;
  for (int k = s.begin(i); k < s.end(i); k++)
    if ((role[s.col()[k]] & WALL) && s.r()[k] <= reach) all.push_back({s.r()[k], direction(s, k)});
  std::stable_sort(all.begin(), all.end(),
                   [](const Neighbour &a, const Neighbour &b) { return a.r < b.r; });
  return all;
}

// the nearest ones that keep the least angle to one another
Fan select_fan(const Fan &all, double reach, double min_angle)
{
  Fan fan;
  for (const Neighbour &candidate : all)
    if (candidate.r <= reach &&
        std::all_of(fan.begin(), fan.end(), [&candidate, min_angle](const Neighbour &member) {
          return angle(member.u, candidate.u) >= min_angle;
        }))
      fan.push_back(candidate);
  return fan;
}

// of u about the axis, in [0, 2 pi), from the direction e1 towards axis x e1
double azimuth(const Vec3 &u, const Vec3 &axis, const Vec3 &e1)
{
  const double phi = std::atan2(axis.cross(e1).dot(u), e1.dot(u));
  return phi < 0.0 ? phi + 2.0 * PI : phi;
}

/* ----------------------------------------------------------------------
   2d: the first wall segment on either side of the axis. Seen from the
   axis, the segment met counter-clockwise has its fluid side clockwise.
------------------------------------------------------------------------- */
Vec3 normal_2d(const Fan &fan, const Vec3 &axis)
{
  if (fan.empty()) return Vec3::Zero();
  const auto rotated = [](const Vec3 &u, double sign) {
    return Vec3(-sign * u[1], sign * u[0], 0.0);
  };
  if (fan.size() == 1) {
    const Vec3 n = rotated(fan[0].u, 1.0);
    return n.dot(axis) < 0.0 ? Vec3(-n) : n;
  }
  const auto turn = [&axis](const Neighbour &m) { return azimuth(m.u, Vec3::UnitZ(), axis); };
  const auto ends = std::minmax_element(
      fan.begin(), fan.end(),
      [&turn](const Neighbour &a, const Neighbour &b) { return turn(a) < turn(b); });
  return rotated(ends.first->u, -1.0) + rotated(ends.second->u, 1.0);
}

struct Member {
  Vec3 u;
  double phi, height;    // azimuth about the axis, component along it
};

// The fan lies to one side on an edge or corner; its middle is then a better axis than the
// direction to the fluid, which feels every displacement of a fluid particle.
Vec3 centred_axis(const Fan &fan, const Vec3 &to_fluid)
{
  Vec3 sum = Vec3::Zero();
  for (const Neighbour &m : fan) sum += m.u;
  return (to_fluid + (sum.dot(to_fluid) < 0.0 ? -1.0 : 1.0) * sum).normalized();
}

// the members by azimuth, without those hidden behind another
std::vector<Member> sort_fan(const Fan &fan, const Vec3 &axis)
{
  const Vec3 e1 = axis.unitOrthogonal();
  std::vector<Member> seen;
  for (const Neighbour &m : fan) seen.push_back({m.u, azimuth(m.u, axis, e1), m.u.dot(axis)});
  std::sort(seen.begin(), seen.end(),
            [](const Member &a, const Member &b) { return a.height > b.height; });
  std::vector<Member> kept;
  for (const Member &m : seen)
    if (std::all_of(kept.begin(), kept.end(), [&m](const Member &k) {
          return std::fabs(std::remainder(k.phi - m.phi, 2.0 * PI)) >= HIDDEN;
        }))
      kept.push_back(m);
  std::sort(kept.begin(), kept.end(),
            [](const Member &a, const Member &b) { return a.phi < b.phi; });
  return kept;
}

bool is_wall(const Vec3 &u, const Vec3 &v, double width, const Fan &all, double max_gap)
{
  if (width >= max_gap) return false;
  if (width <= NEEDS_WITNESS) return true;
  const Vec3 bisector = u + v;
  return std::any_of(all.begin(), all.end(),
                     [&bisector](const Neighbour &m) { return angle(m.u, bisector) <= WITNESS; });
}

// 3d: the sum of the normals of the facets, weighted by their angles at i
Vec3 normal_3d(const Fan &all, const Fan &fan, const Vec3 &to_fluid, double max_gap)
{
  Vec3 sum = Vec3::Zero();
  if (fan.size() < 2) return sum;
  const Vec3 axis = centred_axis(fan, to_fluid);
  const std::vector<Member> sorted = sort_fan(fan, axis);
  for (size_t m = 0; m < sorted.size(); m++) {
    const Vec3 &u = sorted[m].u, &v = sorted[(m + 1) % sorted.size()].u;
    const Vec3 n = u.cross(v);
    if (n.dot(axis) <= 0.0) continue;    // half a turn or more: there is no facet to the next one
    const double width = angle(u, v);
    if (is_wall(u, v, width, all, max_gap)) sum += width * n.normalized();
  }
  return sum;
}

}    // namespace

void wall_normals(const Stencil &s, const Rows &rows, const Role *role, double d,
                  const NormalParams &params, double *normal, std::vector<NormalStatus> &status)
{
  for (int i : rows) {
    const Vec3 to_fluid = fluid_direction(s, role, i);
    Vec3 n = Vec3::Zero();
    status[i] = NormalStatus::UNKNOWN;
    if (to_fluid.squaredNorm() > 0.0) {
      const Fan all = wall_neighbours(s, role, i, WITNESS_REACH * params.reach * d);
      const Fan fan = select_fan(all, params.reach * d, params.min_angle * DEGREE);
      n = s.dim() == 2 ? normal_2d(fan, to_fluid)
                       : normal_3d(all, fan, to_fluid, params.max_gap * DEGREE);
      status[i] = NormalStatus::FAN;
      if (n.norm() <= NO_DIRECTION) {
        n = to_fluid;
        status[i] = NormalStatus::FLUID;
      }
      n.normalize();
    }
    for (int a = 0; a < 3; a++) normal[3 * i + a] = n[a];
  }
}

}    // namespace aleisph
