// SPDX-License-Identifier: GPL-2.0-only

#include "patch.h"

#include <random>

namespace aleisph_test {

using namespace aleisph;

Patch::Patch(int dim, PointSet all) :
    points(std::move(all)), cloud(make_cloud(Kernel(KernelType::CUBIC_SPLINE, dim, H), D, points,
                                             {std::vector<Role>(points.total(), FLUID | SURFACE)})),
    N(3 * points.total()), K(points.total()), known(points.total())
{
}

CurvatureCount Patch::curvature()
{
  return tangent_curvature(cloud, points.rows(), N.data(), K.data(), known.data());
}

Patch random_patch(int dim, unsigned seed)
{
  Patch patch(dim, block(dim, dim == 2 ? 5 : 3, seed));
  std::mt19937 random(seed);
  std::uniform_real_distribution<double> deviate(-1.0, 1.0);
  for (int i = 0; i < patch.points.total(); i++) {
    if (i % 3 == 0) patch.cloud.role()[i] = FLUID;
    if (i % 11 == 0) patch.cloud.role()[i] |= BALLISTIC;
    Eigen::Vector3d n = 0.8 * Eigen::Vector3d(deviate(random), deviate(random), deviate(random));
    n[dim - 1] += 1.0;
    if (dim == 2) n[2] = 0.0;
    patch.set_normal(i, n.normalized());
  }
  return patch;
}

}    // namespace aleisph_test
