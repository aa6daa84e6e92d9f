// SPDX-License-Identifier: GPL-2.0-only

#include "aleisph_tension_contact.h"

#include "aleisph_tension_contact_walls.h"
#include "aleisph_vectors.h"

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>

namespace aleisph {
namespace {

using Eigen::Vector3d;

constexpr double TIP_REACH = 1.7;    // in spacings: nearest neighbours

// N_c: the part of N along all walls, turned so that N_c.n = cos(theta) on each of them. Walls to
// which the rest of it is parallel are left out.
class ContactNormal {
 public:
  explicit ContactNormal(const Vector3d &N) : along_(N) {}

  void add(const ContactWall &wall)
  {
    // n = across_.n + a q with a unit vector q at right angles to the walls before
    Vector3d q = wall.n;
    for (const Vector3d &p : basis_) q -= q.dot(p) * p;
    const double a = q.norm();
    if (!(a > PARALLEL)) return;
    q /= a;
    const Vector3d along = along_ - along_.dot(q) * q;
    if (!(along.norm() > PARALLEL)) return;
    along_ = along;
    across_ += (wall.cosine - across_.dot(wall.n)) / a * q;
    basis_.push_back(q);
  }

  bool found() const { return !basis_.empty(); }

  // If no N has the angles to both walls, the fluid runs along the edge without end (Concus & Finn,
  // Proc. Natl Acad. Sci. 63 (1969) 292), and N_c lies across it.
  Vector3d value() const
  {
    const double rest = 1.0 - across_.squaredNorm();
    if (!(rest > 0.0)) return across_.normalized();
    return std::sqrt(rest) / along_.norm() * along_ + across_;
  }

 private:
  Vector3d along_, across_ = Vector3d::Zero();
  std::vector<Vector3d> basis_;
};

}    // namespace

int bind_tips(Cloud &cloud)
{
  const Stencil &s = cloud.stencil();
  Role *role = cloud.role();
  const Rows bound = select_rows(cloud.fluid(), [&](int i) {
    if (!(role[i] & BALLISTIC)) return false;
    int walls = 0, others = 0;
    for (int k = s.begin(i); k < s.end(i); k++) {
      if (s.r()[k] >= TIP_REACH * cloud.spacing()) continue;
      const Role r = role[s.col()[k]];
      walls += (r & WALL) != 0;
      others += (r & (FLUID | WALL)) == FLUID;
    }
    return others > 0 && walls >= s.dim();
  });
  for_rows(bound, [role](int i) { role[i] &= ~BALLISTIC; });
  cloud.roles_changed();
  return static_cast<int>(bound.size());
}

int contact_normals(const ContactWalls &walls, const Rows &surface, const ContactParams &params,
                    double *contact)
{
  const Cloud &cloud = walls.cloud();
  return count_rows(surface, [&](int i) {
    std::fill(contact + 4 * i, contact + 4 * i + 4, 0.0);
    ContactNormal sum(at(cloud.normal(), i));
    for (const ContactWall &wall : walls.nearest(i))
      if (wall.height < params.reach * cloud.spacing()) sum.add(wall);
    if (!sum.found()) return false;
    const Vector3d Nc = sum.value();
    for (int a = 0; a < 3; a++) contact[4 * i + a] = Nc[a];
    contact[4 * i + 3] = 1.0;
    return true;
  });
}

void contact_surface_normals(const Rows &surface, const double *share, const double *N,
                             double *normal)
{
  for_rows(surface, [&](int i) {
    const Vector3d mean = (1.0 - share[i]) * at(normal, i) + share[i] * at(N, i);
    const double length = mean.norm();
    if (share[i] > 0.0 && length > 0.0)
      for (int a = 0; a < 3; a++) normal[3 * i + a] = mean[a] / length;
  });
}

}    // namespace aleisph
