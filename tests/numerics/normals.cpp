// SPDX-License-Identifier: GPL-2.0-only

#include "normals.h"

#include <gtest/gtest.h>

#include <Eigen/Geometry>

#include <algorithm>
#include <cmath>

namespace aleisph_test {

using namespace aleisph;

namespace {

void sweep(const Scene &scene, const std::vector<double> &previous, Normals &result)
{
  Discretized ops(scene, LaplacianLimits(), false);
  std::copy(result.n.begin(), result.n.end(), ops.cloud().normal());
  std::copy(result.shape.begin(), result.shape.end(), ops.cloud().shape());
  const auto is_known = [&result](int i) { return result.shape[i] != 0.0; };
  Rows left = scene.rows(WALL);
  for (;;) {
    left.erase(std::remove_if(left.begin(), left.end(), is_known), left.end());
    const NormalCount count = wall_normals(
        ops.s(), left, previous.empty() ? nullptr : previous.data(), ops.cloud(), result.status);
    std::copy_n(ops.cloud().normal(), result.n.size(), result.n.begin());
    std::copy_n(ops.cloud().shape(), result.shape.size(), result.shape.begin());
    if (!count.found) return;
    result.sweeps++;
    result.contradictory += static_cast<int>(count.contradictory.size());
  }
}

}    // namespace

Normals find_normals(const Scene &scene, const std::vector<double> &previous,
                     const std::vector<double> &known)
{
  const size_t size = scene.points.size();
  Normals result;
  result.n = known.empty() ? std::vector<double>(3 * size, 0.0) : known;
  result.shape.assign(size, 0.0);
  for (size_t k = 0; k < known.size(); k++)
    if (known[k] != 0.0) result.shape[k / 3] = 1.0;
  result.status.assign(size, NormalStatus::UNKNOWN);
  sweep(scene, previous, result);

  const Rows walls = scene.rows(WALL);
  for (int i : walls) {
    double square = 0.0;
    for (int a = 0; a < 3; a++)
      square += std::pow(result.n[3 * i + a] - scene.normal[3 * i + a], 2);
    if (result.status[i] == NormalStatus::FAN) result.from_fan++;
    if (result.status[i] == NormalStatus::FLUID) result.fallback++;
    if (result.status[i] == NormalStatus::UNKNOWN) {
      result.unknown++;
      continue;
    }
    result.largest = std::max(result.largest, std::sqrt(square));
    result.rms += square / static_cast<double>(walls.size());
  }
  result.rms = std::sqrt(result.rms);
  return result;
}

void expect_exact(const Scene &scene, const std::string &name)
{
  const Normals found = find_normals(scene);
  EXPECT_EQ(found.from_fan, static_cast<int>(scene.rows(WALL).size())) << name;
  EXPECT_EQ(found.contradictory, 0) << name;
  EXPECT_LE(found.largest, ROUNDING) << name;
}

Scene turned(Scene scene, double angle)
{
  using Eigen::Vector3d;
  const Vector3d axis = scene.dim == 2 ? Vector3d::UnitZ().eval() : Vector3d(1, 2, 3).normalized();
  const Eigen::Matrix3d R = Eigen::AngleAxisd(angle, axis).toRotationMatrix();
  for (size_t i = 0; i < scene.points.size(); i++) {
    Eigen::Map<Vector3d> x(scene.points[i].data()), n(&scene.normal[3 * i]);
    x = R * x.eval();
    n = R * n.eval();
  }
  return scene;
}

}    // namespace aleisph_test
