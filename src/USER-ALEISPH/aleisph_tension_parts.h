// SPDX-License-Identifier: GPL-2.0-only
/* ----------------------------------------------------------------------
   What the models of surface tension share: sums that may have no direction,
   particles with too few neighbours, normals of one surface.
------------------------------------------------------------------------- */

#ifndef LMP_ALEISPH_TENSION_PARTS_H
#define LMP_ALEISPH_TENSION_PARTS_H

#include "aleisph_cloud.h"
#include "aleisph_vectors.h"

#include <Eigen/Dense>
#include <algorithm>

namespace aleisph {

// Normals further apart (73 degrees) belong to different surfaces: the other side of a film, the
// other flank of a cusp. It must let pass 45 degrees, the turn between the rim and the edge of a
// cube.
constexpr double SAME_SURFACE = 0.3;

// a buffer counts, too
inline bool is_fluid(Role role)
{
  return (role & FLUID) && !(role & WALL);
}

// fewer than three in the fluid: spray, a thread
inline bool few_neighbours(const Cloud &cloud, int i)
{
  constexpr int FEW = 3;
  const Stencil &s = cloud.stencil();
  const Role *role = cloud.role();
  const int *col = s.col();
  return std::count_if(col + s.begin(i), col + s.end(i),
                       [role](int j) { return is_fluid(role[j]); }) < FEW;
}

// sum of vectors that is zero where only rounding or cancellation is left
class Direction {
 public:
  void add(const Eigen::Vector3d &term)
  {
    sum_ += term;
    moduli_ += term.norm();
  }
  void store(double *v, int i) const
  {
    const bool none = !(sum_.norm() > NO_DIRECTION * moduli_);
    Eigen::Map<Eigen::Vector3d>(v + 3 * i) = none ? Eigen::Vector3d(Eigen::Vector3d::Zero()) : sum_;
  }

 private:
  // A sum shorter than this part of the sum of the moduli of its terms has no direction.
  static constexpr double NO_DIRECTION = 1.0e-6;

  Eigen::Vector3d sum_ = Eigen::Vector3d::Zero();
  double moduli_ = 0.0;
};

}    // namespace aleisph
#endif
