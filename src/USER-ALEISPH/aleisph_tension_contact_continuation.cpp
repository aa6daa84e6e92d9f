// SPDX-License-Identifier: GPL-2.0-only

#include "aleisph_tension_contact_continuation.h"

#include "aleisph_tension_contact_walls.h"
#include "aleisph_vectors.h"

#include <Eigen/Dense>
#include <algorithm>

namespace aleisph {
namespace {

using Eigen::Vector3d;

/* ----------------------------------------------------------------------
   Sources below one wall particle: along n, and where several faces meet on
   the lattice that their normals span behind the edge. Its cells count by
   their volume; those of the lines below one face, half of which lie behind
   that face, by a mean.
------------------------------------------------------------------------- */
struct Sources {
  Vector3d n[3] = {Vector3d::Zero(), Vector3d::Zero(), Vector3d::Zero()};
  double slope[3] = {0.0, 0.0, 0.0};    // of the plane along each n
  int directions = 0;
  double cell = 1.0;

  void add(const Vector3d &normal, double slope_along)
  {
    n[directions] = normal;
    slope[directions++] = slope_along;
  }

  double volume(int a, int b, int c) const
  {
    return 1.0 - (1.0 - cell) * ((a > 0) + (b > 0) + (c > 0)) / directions;
  }
};

Sources sources_below(const Stencil &wide, const ContactWalls &walls, const double *normal,
                      const double *plane, int i, int k)
{
  Sources below;
  const auto faces = walls.faces(i, k);
  if (faces.size() < 2 || faces.size() > 3) {
    const int j = wide.col()[k];
    below.add(at(normal, j), plane[2 * j + 1]);
    return below;
  }
  for (const auto &face : faces) below.add(face.n, plane[2 * wide.col()[face.pair] + 1]);
  const Vector3d across = below.n[0].cross(below.n[1]);
  below.cell = faces.size() == 2 ? across.norm() : std::abs(across.dot(below.n[2]));
  return below;
}

}    // namespace

void contact_planes(const Stencil &wide, const Rows &walls, const Role *role, const double *normal,
                    const double *contact, double d, double *plane, const ContactParams &params)
{
  for (const int j : walls) {
    plane[2 * j] = (role[j] & DRY) ? COVERED : -COVERED;
    plane[2 * j + 1] = 0.0;
    const Vector3d n = at(normal, j);
    double nearest2 = 0.0;
    int pair = -1;
    for (int k = wide.begin(j); k < wide.end(j); k++) {
      if (contact[4 * wide.col()[k] + 3] == 0.0) continue;
      const Vector3d r = separation(wide, k);
      if (-r.dot(n) >= params.reach * d) continue;    // a particle on another wall
      const double along2 = (r - r.dot(n) * n).squaredNorm();
      if (pair >= 0 && along2 >= nearest2) continue;
      nearest2 = along2;
      pair = k;
    }
    if (pair < 0) continue;
    const double *c = contact + 4 * wide.col()[pair];
    const Vector3d Nc(c[0], c[1], c[2]);
    plane[2 * j] = separation(wide, pair).dot(Nc) / d - 0.5;
    plane[2 * j + 1] = n.dot(Nc);
  }
}

void add_continuation(const Stencil &wide, const Kernel &kernel, const Rows &surface,
                      const Role *role, const double *normal, const double *plane, double volume,
                      double d, const ContactParams &params, double *N, const double *shape)
{
  const ContactWalls walls(wide, role, normal, nullptr, shape, d);
  for (const int i : surface) {
    Vector3d sum = Vector3d::Zero();
    for (int k = wide.begin(i); k < wide.end(i); k++) {
      const int j = wide.col()[k];
      if (!(role[j] & WALL)) continue;
      const Sources below = sources_below(wide, walls, normal, plane, i, k);
      const int depth[3] = {params.depth, below.directions > 1 ? params.depth : 0,
                            below.directions > 2 ? params.depth : 0};
      for (int a = 0; a <= depth[0]; a++)
        for (int b = 0; b <= depth[1]; b++)
          for (int c = 0; c <= depth[2]; c++) {
            const double fall = a * below.slope[0] + b * below.slope[1] + c * below.slope[2];
            const double weight = std::clamp(0.5 - (plane[2 * j] - fall), 0.0, 1.0);
            const Vector3d r = separation(wide, k) +
                d * (a * below.n[0] + b * below.n[1] + c * below.n[2]);
            const double distance = r.norm();
            if (weight == 0.0 || distance == 0.0) continue;
            sum -= volume * below.volume(a, b, c) * weight * kernel.dw(distance) / distance * r;
          }
    }
    for (int a = 0; a < 3; a++) N[3 * i + a] += sum[a];
  }
}

}    // namespace aleisph
