// SPDX-License-Identifier: GPL-2.0-only

#include "aleisph_shift_images.h"

#include "aleisph_nearest.h"
#include "aleisph_vectors.h"

#include <algorithm>
#include <numeric>

namespace aleisph {

// by a particle
bool Images::taken(int i, int k, Role kind, const Eigen::Vector3d &r) const
{
  const double near2 = TAKEN * TAKEN * d_ * d_;
  if (kind == FLUID && r.squaredNorm() < near2) return true;
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
  remove_duplicates();
  return found_;
}

// The nearest image stays, whatever the order; the others keep theirs.
void Images::remove_duplicates()
{
  const double same2 = DUPLICATE * DUPLICATE * d_ * d_;
  const auto same = [same2](const Eigen::Vector3d &a, const Eigen::Vector3d &b) {
    return (a - b).squaredNorm() < same2;
  };
  const int n = static_cast<int>(found_.size());
  bool any = false;
  for (int a = 0; a < n && !any; a++)
    for (int b = 0; b < a && !any; b++) any = same(found_[a], found_[b]);
  if (!any) return;

  std::vector<int> order(n);
  std::iota(order.begin(), order.end(), 0);
  std::stable_sort(order.begin(), order.end(), [this](int a, int b) {
    return nearer(found_[a].norm(), found_[a], found_[b].norm(), found_[b], d_);
  });
  std::vector<int> kept;
  for (const int a : order)
    if (std::none_of(kept.begin(), kept.end(), [&](int b) { return same(found_[a], found_[b]); }))
      kept.push_back(a);
  std::sort(kept.begin(), kept.end());
  for (std::size_t m = 0; m < kept.size(); m++) found_[m] = found_[kept[m]];
  found_.resize(kept.size());
}

}    // namespace aleisph
