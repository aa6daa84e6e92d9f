// SPDX-License-Identifier: GPL-2.0-only

#include "aleisph_images.h"

#include "aleisph_vectors.h"
namespace aleisph {

bool Images::taken(int i, int k, Role kind, const Eigen::Vector3d &r) const
{
  const double near2 = TAKEN * TAKEN * d_ * d_, same2 = DUPLICATE * DUPLICATE * d_ * d_;
  if (kind == FLUID && r.squaredNorm() < near2) return true;
  for (const Eigen::Vector3d &other : found_)
    if ((r - other).squaredNorm() < same2) return true;
  for (int m = s_.begin(i); m < s_.end(i); m++)
    if (m != k && (role_[s_.col()[m]] & kind) && (r - separation(s_, m)).squaredNorm() < near2)
      return true;
  return false;
}

// side: -1 against, +1 along the normal of the neighbour
void Images::add(int i, int k, Role kind, double side)
{
  const Eigen::Map<const Eigen::Vector3d> n(normal_ + 3 * s_.col()[k]);
  if (n.isZero(0.0)) return;    // no direction is known
  const Eigen::Vector3d r = separation(s_, k) - side * d_ * n;
  if (r.squaredNorm() < support_ * support_ && !taken(i, k, kind, r)) found_.push_back(r);
}

const std::vector<Eigen::Vector3d> &Images::of(int i)
{
  found_.clear();
  const bool below = surface_ && !(role_[i] & SURFACE);
  for (int k = s_.begin(i); k < s_.end(i); k++) {
    const Role r = role_[s_.col()[k]];
    if (r & WALL)
      add(i, k, WALL, -1.0);
    else if (below && (r & SURFACE))
      add(i, k, FLUID, 1.0);
  }
  return found_;
}

}    // namespace aleisph
