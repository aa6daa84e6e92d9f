// SPDX-License-Identifier: GPL-2.0-only

#include "aleisph_surface_hold.h"

#include "aleisph_vectors.h"
#include "aleisph_wall_cone.h"

#include <Eigen/Dense>

namespace aleisph {
namespace {

using Vec = Eigen::Vector3d;
constexpr double ABOVE =
    0.8;    // a particle is above a wall particle if it is off its normal by less

// normals of the walls that particle i is close to; nearest: the closest of their particles, or -1
void walls_below(const Stencil &s, const Role *role, const double *normal, int i, double reach,
                 double d, std::vector<Vec> &walls, int &nearest)
{
  walls.clear();
  nearest = -1;
  double closest = reach;
  for (int k = s.begin(i); k < s.end(i); k++) {
    const int j = s.col()[k];
    if (!(role[j] & WALL)) continue;
    const Vec n = at(normal, j), r = separation(s, k);
    const double height = n.dot(r);
    if (height >= reach || height < -0.5 * d || (r - height * n).norm() > ABOVE * d) continue;
    walls.push_back(n);
    if (nearest >= 0 && height >= closest) continue;
    closest = height;
    nearest = j;
  }
}

}    // namespace

int hold_surface(const Stencil &s, const Rows &surface, const Role *role, const double *normal,
                 double reach, double d, double *v)
{
  std::vector<Vec> walls;
  int nearest, changed = 0;
  for (const int i : surface) {
    walls_below(s, role, normal, i, reach, d, walls, nearest);
    if (nearest < 0) continue;
    const Vec wall = at(v, nearest), relative = at(v, i) - wall;
    const Vec held = without_parts_into_walls(relative, walls);
    if (held == relative) continue;
    for (int a = 0; a < s.dim(); a++) v[3 * i + a] = wall[a] + held[a];
    changed++;
  }
  return changed;
}

}    // namespace aleisph
