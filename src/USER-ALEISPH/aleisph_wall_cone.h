// SPDX-License-Identifier: GPL-2.0-only
/* ----------------------------------------------------------------------
   The vector nearest to v that has no component into any of the walls, v.n >= 0
   for all unit normals n: v itself, its part along one wall, its part along the
   edge of two, or zero. Removing one component after the other would give a
   result that depends on the order of the neighbours where walls meet.
------------------------------------------------------------------------- */

#ifndef LMP_ALEISPH_WALL_CONE_H
#define LMP_ALEISPH_WALL_CONE_H

#include <Eigen/Dense>
#include <vector>

namespace aleisph {

Eigen::Vector3d without_parts_into_walls(const Eigen::Vector3d &v,
                                         const std::vector<Eigen::Vector3d> &normals);

}    // namespace aleisph
#endif
