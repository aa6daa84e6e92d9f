// SPDX-License-Identifier: GPL-2.0-only

#include "aleisph_wall_suspects.h"

#include "aleisph_vectors.h"

#include <algorithm>
#include <cmath>

namespace aleisph {
namespace {

constexpr double OPPOSITE = -0.5;    // more than 120 degrees apart
constexpr double ACROSS = 0.5;       // and the two lie in front of or behind each other

}    // namespace

WallSuspects wall_suspects(const Cloud &cloud)
{
  const Stencil &s = cloud.stencil();
  const double d = cloud.spacing();
  const auto is_facing = [&](int i) {
    const Eigen::Vector3d n = at(cloud.normal(), i);
    for (int k = s.begin(i); k < s.end(i); k++) {
      const int j = s.col()[k];
      const bool across = std::abs(direction(s, k).dot(n)) > ACROSS;
      if ((cloud.role()[j] & WALL) && across && n.dot(at(cloud.normal(), j)) < OPPOSITE)
        return true;
    }
    return false;
  };
  const auto nearest = [&](int i) {
    double r = cloud.kernel().support();
    for (int k = s.begin(i); k < s.end(i); k++)
      if (cloud.role()[s.col()[k]] & WALL) r = std::min(r, s.r()[k]);
    return r;
  };
  const auto last = [&](const auto &suspect) {
    return max_rows(
        cloud.wall(), [&suspect](int i) { return suspect(i) ? i : -1; }, -1);
  };
  WallSuspects found;
  found.facing = last(is_facing);
  found.dense = last([&](int i) { return nearest(i) < WallSuspects::DENSE * d; });
  found.sparse = last([&](int i) { return nearest(i) > WallSuspects::SPARSE * d; });
  return found;
}

}    // namespace aleisph
