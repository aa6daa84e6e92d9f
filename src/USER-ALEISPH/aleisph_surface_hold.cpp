// SPDX-License-Identifier: GPL-2.0-only

#include "aleisph_surface_hold.h"

#include "aleisph_nearest.h"
#include "aleisph_vectors.h"
#include "aleisph_wall_cone.h"

#include <Eigen/Dense>

namespace aleisph {
namespace {

using Vec = Eigen::Vector3d;
// a particle is above a wall particle if it is off its normal by less, in spacings
constexpr double ABOVE = 0.8;

// normals of the walls that particle i is close to; returns the nearest of their particles, or -1
int walls_below(const Cloud &cloud, int i, double reach, std::vector<Vec> &walls)
{
  const Stencil &s = cloud.stencil();
  const double d = cloud.spacing();
  walls.clear();
  int nearest = -1;
  double closest = reach;
  Vec place = Vec::Zero();
  for (int k = s.begin(i); k < s.end(i); k++) {
    const int j = s.col()[k];
    if (!(cloud.role()[j] & WALL)) continue;
    const Vec n = at(cloud.normal(), j), r = separation(s, k);
    const double height = n.dot(r);
    if (height >= reach || height < -0.5 * d || (r - height * n).norm() > ABOVE * d) continue;
    walls.push_back(n);
    if (nearest >= 0 && !nearer(height, r, closest, place, d)) continue;
    closest = height;
    place = r;
    nearest = j;
  }
  return nearest;
}

}    // namespace

int hold_surface(const Cloud &cloud, const Rows &surface, double reach, double *v)
{
  std::vector<Vec> walls;
  return count_rows(surface, [&](int i) {
    const int nearest = walls_below(cloud, i, reach, walls);
    if (nearest < 0) return false;
    const Vec wall = at(v, nearest), relative = at(v, i) - wall;
    const Vec held = without_parts_into_walls(relative, walls);
    if (held == relative) return false;
    for (int a = 0; a < cloud.dim(); a++) v[3 * i + a] = wall[a] + held[a];
    return true;
  });
}

}    // namespace aleisph
