// SPDX-License-Identifier: GPL-2.0-only

#include "aleisph_tension_contact_continuation.h"

#include "aleisph_nearest.h"
#include "aleisph_tension_contact_walls.h"
#include "aleisph_vectors.h"

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>

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

  // f(offset [d] along -n, fall of the plane there, volume of the cell [d^dim]), on the wall first
  template <class F> void for_each(int depth, F &&f) const
  {
    const int deep[3] = {depth, directions > 1 ? depth : 0, directions > 2 ? depth : 0};
    for (int a = 0; a <= deep[0]; a++)
      for (int b = 0; b <= deep[1]; b++)
        for (int c = 0; c <= deep[2]; c++)
          f(a * n[0] + b * n[1] + c * n[2], a * slope[0] + b * slope[1] + c * slope[2],
            volume(a, b, c));
  }

 private:
  double volume(int a, int b, int c) const
  {
    return 1.0 - (1.0 - cell) * ((a > 0) + (b > 0) + (c > 0)) / directions;
  }
};

Sources sources_below(const ContactWalls &walls, const double *plane, int i, int k)
{
  const int *col = walls.stencil().col();
  Sources below;
  const auto faces = walls.faces(i, k);
  if (faces.size() < 2 || faces.size() > 3) {
    const int j = col[k];
    below.add(at(walls.cloud().normal(), j), plane[2 * j + 1]);
    return below;
  }
  for (const auto &face : faces) below.add(face.n, plane[2 * col[face.pair] + 1]);
  const Vector3d across = below.n[0].cross(below.n[1]);
  below.cell = faces.size() == 2 ? across.norm() : std::abs(across.dot(below.n[2]));
  return below;
}

}    // namespace

void contact_planes(const Cloud &cloud, const WideStencil &wide, const double *contact,
                    const ContactParams &params, double *plane)
{
  const Stencil &s = wide.pairs;
  const double d = cloud.spacing();
  for_rows(cloud.all(), [&](int j) {
    const Role role = cloud.role()[j];
    if (!(role & WALL)) return;
    plane[2 * j] = (role & DRY) ? COVERED : -COVERED;
    plane[2 * j + 1] = 0.0;
    const Vector3d n = at(cloud.normal(), j);
    double nearest = 0.0;
    int pair = -1;
    for (int k = s.begin(j); k < s.end(j); k++) {
      if (contact[4 * s.col()[k] + 3] == 0.0) continue;
      const Vector3d r = separation(s, k);
      if (-r.dot(n) >= params.reach * d) continue;    // a particle on another wall
      const double along = (r - r.dot(n) * n).norm();
      if (pair >= 0 && !nearer(along, r, nearest, separation(s, pair), d)) continue;
      nearest = along;
      pair = k;
    }
    if (pair < 0) return;
    const double *c = contact + 4 * s.col()[pair];
    const Vector3d Nc(c[0], c[1], c[2]);
    plane[2 * j] = separation(s, pair).dot(Nc) / d - 0.5;
    plane[2 * j + 1] = n.dot(Nc);
  });
}

void add_continuation(const Cloud &cloud, const WideStencil &wide, const Rows &surface,
                      const double *plane, const ContactParams &params, double *N)
{
  const Stencil &s = wide.pairs;
  const double d = cloud.spacing();
  const ContactWalls walls(cloud, s, nullptr);
  for_rows(surface, [&](int i) {
    Vector3d sum = Vector3d::Zero();
    for (int k = s.begin(i); k < s.end(i); k++) {
      const int j = s.col()[k];
      if (!(cloud.role()[j] & WALL)) continue;
      const Sources below = sources_below(walls, plane, i, k);
      below.for_each(params.depth, [&](const Vector3d &offset, double fall, double volume) {
        const double weight = std::clamp(0.5 - (plane[2 * j] - fall), 0.0, 1.0);
        const Vector3d r = separation(s, k) + d * offset;
        const double distance = r.norm();
        if (weight == 0.0 || distance == 0.0) return;
        sum -= cloud.volume() * volume * weight * wide.kernel.dw(distance) / distance * r;
      });
    }
    for (int a = 0; a < 3; a++) N[3 * i + a] += sum[a];
  });
}

}    // namespace aleisph
