// SPDX-License-Identifier: GPL-2.0-only

#include "aleisph_wall_cone.h"

#include <algorithm>

namespace aleisph {
namespace {

using Vec3 = Eigen::Vector3d;

// The component into a wall that is allowed: rounding, and differences of wall normals that should
// be equal. Also the square of the sine of the angle between normals that are parallel.
constexpr double INTO_WALL = 1.0e-10;

}    // namespace

Vec3 without_parts_into_walls(const Vec3 &v, const std::vector<Vec3> &normals)
{
  const double tolerance = INTO_WALL * v.norm();
  const auto allowed = [&normals, tolerance](const Vec3 &u) {
    return std::all_of(normals.begin(), normals.end(),
                       [&u, tolerance](const Vec3 &n) { return u.dot(n) >= -tolerance; });
  };
  if (allowed(v)) return v;
  for (const Vec3 &n : normals) {
    Vec3 along = v - v.dot(n) * n;
    if (v.dot(n) < 0.0 && allowed(along)) return along;
  }
  Vec3 longest = Vec3::Zero();    // of the parts along edges that are allowed: the nearest
  for (size_t a = 1; a < normals.size(); a++)
    for (size_t b = 0; b < a; b++) {
      const Vec3 edge = normals[a].cross(normals[b]);
      if (edge.squaredNorm() < INTO_WALL) continue;
      const Vec3 along = v.dot(edge) / edge.squaredNorm() * edge;
      if (along.squaredNorm() > longest.squaredNorm() && allowed(along)) longest = along;
    }
  return longest;
}

}    // namespace aleisph
