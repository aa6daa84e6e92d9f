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
  WallSuspects found;
  for (const int i : cloud.wall()) {
    const Eigen::Vector3d n = at(cloud.normal(), i);
    double nearest = cloud.kernel().support();
    for (int k = s.begin(i); k < s.end(i); k++) {
      const int j = s.col()[k];
      if (!(cloud.role()[j] & WALL)) continue;
      nearest = std::min(nearest, s.r()[k]);
      const bool across = std::abs(direction(s, k).dot(n)) > ACROSS;
      if (across && n.dot(at(cloud.normal(), j)) < OPPOSITE) found.facing = i;
    }
    if (nearest < WallSuspects::DENSE * d) found.dense = i;
    if (nearest > WallSuspects::SPARSE * d) found.sparse = i;
  }
  return found;
}

}    // namespace aleisph
