// SPDX-License-Identifier: GPL-2.0-only
/* ----------------------------------------------------------------------
   A piece of free surface for the tests of curvature: particles that are all
   fluid, on the surface or not, with normals of any direction.
------------------------------------------------------------------------- */

#ifndef ALEISPH_TEST_PATCH_H
#define ALEISPH_TEST_PATCH_H

#include "aleisph_tension_tangent.h"
#include "cloud.h"

#include <Eigen/Core>
#include <vector>

namespace aleisph_test {

struct Patch {
  Patch(int dim, PointSet all);    // all on the surface, without normals

  aleisph::CurvatureCount curvature();    // K, known: those of model tangent, before the mean
  void set_normal(int i, const Eigen::Vector3d &n) { Eigen::Vector3d::Map(&N[3 * i]) = n; }
  Eigen::Vector3d normal(int i) const { return Eigen::Vector3d::Map(&N[3 * i]); }

  PointSet points;
  aleisph::Cloud cloud;
  std::vector<double> N, K, known;
};

// In a jittered block, two thirds of the particles are on the surface, some are ballistic; normals
// of random direction but upward on the whole
Patch random_patch(int dim, unsigned seed);

}    // namespace aleisph_test
#endif
