// SPDX-License-Identifier: GPL-2.0-only

#include "aleisph_wall_dry.h"

#include "aleisph_vectors.h"

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>

namespace aleisph {
namespace {

using Vec = Eigen::Vector3d;

constexpr double REACH_ABOVE = 1.25;
constexpr double ABOVE = 0.866;    // cosine of 30 degrees

// The candidates of one wall particle that are fluid
class FluidAround {
 public:
  FluidAround(const double *const *x, const CandidateList &list, const Cloud &cloud) :
      x_(x), list_(list), cloud_(cloud)
  {
  }

  double nearest_squared(int i) const
  {
    double nearest = INFINITY;
    visit(i, [&nearest](const double *, double r2) { nearest = std::min(nearest, r2); });
    return nearest;
  }

  // whether the fluid within the support lies above wall particle i, not beside it
  bool above(int i) const
  {
    const Kernel &kernel = cloud_.kernel();
    Vec up = Vec::Zero();
    visit(i, [&](const double *r, double r2) {
      if (r2 == 0.0 || r2 >= kernel.support() * kernel.support()) return;
      const double weight = -kernel.dw(std::sqrt(r2)) / std::sqrt(r2);
      for (int a = 0; a < 3; a++) up[a] += weight * r[a];
    });
    const double *n = cloud_.normal() + 3 * i;
    return up[0] * n[0] + up[1] * n[1] + up[2] * n[2] > ABOVE * std::hypot(up[0], up[1], up[2]);
  }

 private:
  // calls function(x_j - x_i, its square) of the fluid candidates j
  template <class Function> void visit(int i, Function function) const
  {
    for (int m = 0; m < list_.count[i]; m++) {
      const int j = list_.first[i][m] & list_.mask;
      if ((cloud_.role()[j] & (FLUID | WALL)) != FLUID) continue;
      double r[3] = {0.0, 0.0, 0.0}, r2 = 0.0;
      for (int a = 0; a < cloud_.dim(); a++) {
        r[a] = x_[j][a] - x_[i][a];
        r2 += r[a] * r[a];
      }
      function(r, r2);
    }
  }

  const double *const *x_;
  const CandidateList &list_;
  const Cloud &cloud_;
};

}    // namespace

int mark_dry_walls(const double *const *x, const CandidateList &list, double reach, Cloud &cloud)
{
  const FluidAround fluid(x, list, cloud);
  const Rows dry = select_rows(cloud.owned(), [&](int i) {
    if (!(cloud.role()[i] & WALL)) return false;
    const double wet = reach * cloud.spacing() * std::max(cloud.shape()[i], 1.0);
    const double nearest2 = fluid.nearest_squared(i);
    if (nearest2 < wet * wet) return false;
    return !(nearest2 < REACH_ABOVE * REACH_ABOVE * wet * wet && fluid.above(i));
  });
  for_rows(dry, [&](int i) { cloud.role()[i] |= DRY; });
  cloud.roles_changed();
  return static_cast<int>(dry.size());
}

}    // namespace aleisph
