// SPDX-License-Identifier: GPL-2.0-only
/* ----------------------------------------------------------------------
   Of equally near particles the place decides, not the order in which they
   come: sorting, restarts and other ranks change that order.
------------------------------------------------------------------------- */

#include "aleisph_nearest.h"

#include "aleisph_guards.h"
#include "aleisph_shift_images.h"
#include "aleisph_surface_hold.h"
#include "aleisph_tension_contact_walls.h"
#include "aleisph_wall_normals.h"
#include "scenes.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <functional>

using namespace aleisph;
using namespace aleisph_test;
using Eigen::Vector3d;

namespace {

using Field = std::vector<double>;

// Sums over neighbours in another order; a tie that is broken otherwise changes results by 1e-3
// and more
constexpr double ROUNDING = 1.0e-12;
constexpr unsigned ORDERS = 6;

// A tank on a lattice, whose walls have different velocities and angles everywhere, and fluid that
// flies towards them
struct Tank {
  explicit Tank(int dim, unsigned order) :
      scene(open_tank(dim, 6, 6, 5)),
      points(scene.points, static_cast<int>(scene.points.size()), 2.4 * scene.d, order),
      cloud(make_cloud(Kernel(KernelType::CUBIC_SPLINE, dim, 1.2 * scene.d), scene.d, points,
                       {scene.role, scene.normal}))
  {
    wall_shapes(cloud.stencil(), scene.rows(WALL), cloud);
    for (const Point &x : scene.points) {
      angle.push_back(0.3 * std::sin(7.0 * x[0] + 5.0 * x[1] + 3.0 * x[2]));
      v.push_back(std::cos(3.0 * x[1]) - 2.0 * x[0]);
      v.push_back(std::sin(4.0 * x[0]) - 3.0 * x[1]);
      v.push_back(dim == 3 ? std::cos(5.0 * x[0]) - 2.0 * x[2] : 0.0);
    }
  }

  Scene scene;
  PointSet points;
  Cloud cloud;
  Field angle, v;
};

// The result must be that of the first order
void expect_one_result(const std::function<Field(Tank &)> &result)
{
  for (const int dim : {2, 3}) {
    Tank first(dim, 1);
    const Field expected = result(first);
    ASSERT_FALSE(expected.empty());
    for (unsigned order = 2; order <= ORDERS; order++) {
      Tank tank(dim, order);
      const Field found = result(tank);
      ASSERT_EQ(found.size(), expected.size());
      double worst = 0.0;
      for (size_t k = 0; k < found.size(); k++)
        worst = std::max(worst, std::abs(found[k] - expected[k]));
      EXPECT_LE(worst, ROUNDING) << "in " << dim << "d, order " << order;
    }
  }
}

}    // namespace

TEST(Nearest, ThePlaceDecidesUpToRounding)
{
  const Vector3d a(1.0, 0.0, 0.0), b(0.0, 1.0, 0.0);
  EXPECT_TRUE(nearer(1.0, a, 1.1, b, 1.0));
  EXPECT_FALSE(nearer(1.1, a, 1.0, b, 1.0));
  for (const double rounding : {-1e-13, 0.0, 1e-13}) {
    EXPECT_FALSE(nearer(1.0, a, 1.0 + rounding, b, 1.0));
    EXPECT_TRUE(nearer(1.0, b, 1.0 + rounding, a, 1.0));
    EXPECT_FALSE(nearer(1.0, a, 1.0 + rounding, a * (1.0 + rounding), 1.0));
  }
}

TEST(Nearest, HoldsSurfacesOffWalls)
{
  expect_one_result([](Tank &tank) {
    hold_surface(tank.cloud, tank.cloud.fluid(), 1.2 * tank.scene.d, tank.v.data());
    return tank.v;
  });
}

TEST(Nearest, HoldsParticlesOffWalls)
{
  expect_one_result([](Tank &tank) {
    Field dv(tank.v.size(), 0.0), dw(tank.v.size(), 0.0);
    const WallGuard guard = {1.3 * tank.scene.d, 0.1 * tank.scene.d, tank.v.data(), tank.v.data()};
    hold_off_walls(tank.cloud, guard, dv.data(), dw.data());
    dv.insert(dv.end(), dw.begin(), dw.end());
    return dv;
  });
}

TEST(Nearest, WallsOfContactParticles)
{
  expect_one_result([](Tank &tank) {
    const ContactWalls walls(tank.cloud, tank.cloud.stencil(), tank.angle.data());
    Field all;
    for (const int i : tank.cloud.fluid())
      for (const auto &list : {walls.nearest(i), walls.mean(i)})
        for (const ContactWall &wall : list)
          for (const double value : {wall.n[0], wall.n[1], wall.n[2], wall.height, wall.cosine})
            all.push_back(value);
    return all;
  });
}

TEST(Nearest, FacesOfEdges)
{
  expect_one_result([](Tank &tank) {
    const Stencil &s = tank.cloud.stencil();
    const ContactWalls walls(tank.cloud, s, nullptr);
    Field all;
    for (const int i : tank.cloud.fluid()) {
      Vector3d sum = Vector3d::Zero();
      for (int k = s.begin(i); k < s.end(i); k++)
        for (const auto &face : walls.faces(i, k)) sum += tank.angle[s.col()[face.pair]] * face.n;
      all.insert(all.end(), sum.data(), sum.data() + 3);
    }
    return all;
  });
}

// Of two images that are nearly in one place, one stays
TEST(Nearest, Images)
{
  Scene scene;
  scene.add({0.0, 0.0, 0.0}, FLUID);
  scene.add({0.3, -1.0, 0.0}, WALL, {-0.6, 0.8, 0.0});
  scene.add({0.35, -1.0, 0.0}, WALL, {-0.6, 0.8, 0.0});
  const auto images = [&scene](unsigned order) {
    const PointSet points(scene.points, 3, 2.4, order);
    const Cloud cloud = make_cloud(Kernel(KernelType::CUBIC_SPLINE, 2, 1.2), 1.0, points,
                                   {scene.role, scene.normal});
    Images all(cloud, true);
    Vector3d sum = Vector3d::Zero();
    for (const Vector3d &image : all.of(0)) sum += image;
    return sum;
  };
  EXPECT_NEAR(images(1)[0], -0.9, ROUNDING);    // the nearer one
  for (unsigned order = 2; order <= 4 * ORDERS; order++)
    EXPECT_LE((images(order) - images(1)).norm(), ROUNDING) << order;
}
