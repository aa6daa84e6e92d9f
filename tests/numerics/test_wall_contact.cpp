// SPDX-License-Identifier: GPL-2.0-only
/* ----------------------------------------------------------------------
   What is carried from the fluid to walls. Rounding: a fit that is trusted has
   pivots of 2e-3 of the largest at least; with fields of order ten, 1e-12 is a
   few eps over that.
------------------------------------------------------------------------- */

#include "aleisph_vectors.h"
#include "aleisph_wall_contact.h"
#include "scenes.h"

#include <gtest/gtest.h>

#include <Eigen/Dense>

#include <cmath>
#include <iterator>
#include <limits>

using namespace aleisph;
using namespace aleisph_test;
using Eigen::Vector3d;

namespace {

constexpr double ROUNDING = 1.0e-12;

// a + b.x
double linear(const Point &x, int dim)
{
  return 0.4 + 1.7 * x[0] - 2.3 * x[1] + (dim == 3 ? 3.1 * x[2] : 0.0);
}

std::vector<double> linear_field(const Scene &scene)
{
  std::vector<double> f;
  for (const Point &x : scene.points) f.push_back(linear(x, scene.dim));
  return f;
}

// three of them
std::vector<double> linear_velocity(const Scene &scene)
{
  std::vector<double> v;
  for (const Point &x : scene.points) {
    const double z = scene.dim == 3 ? x[2] : 0.0;
    v.push_back(0.3 + x[0] - 2.0 * x[1] + 0.5 * z);
    v.push_back(-0.2 + 3.0 * x[0] + 0.7 * x[1] - z);
    v.push_back(scene.dim == 3 ? 0.1 - x[0] + x[1] + 4.0 * z : 0.0);
  }
  return v;
}

// the same on fluid; on walls what must not be read
std::vector<double> spoil_walls(const Scene &scene, std::vector<double> f)
{
  const std::size_t width = f.size() / scene.points.size();
  for (const int i : scene.rows(WALL))
    for (std::size_t a = 0; a < width; a++) f[width * i + a] = 1.0e30;
  return f;
}

std::vector<Scene> scenes(int dim)
{
  return {closed_box(dim, 6, 0.2, 3), box_obstacle(dim, 4, 0.2, 4),
          cylinder(dim, 0.5, 0.1, true, 0.2, 5)};
}

// a wall particle, and one that is alone; fluid where a test puts it, in spacings
Scene one_wall(int dim, const Points &fluid, Role more = 0)
{
  Scene scene;
  scene.dim = dim;
  scene.d = D;
  Point up = {};
  up[dim - 1] = 1.0;
  scene.add({0.0, 0.0, 0.0}, WALL | more, up);
  scene.add({50.0 * D, 0.0, 0.0}, WALL | more, up);
  for (const Point &p : fluid) scene.add({p[0] * D, p[1] * D, p[2] * D}, FLUID);
  return scene;
}

}    // namespace

/* ----------------------------------------------------------------------
   Fits
------------------------------------------------------------------------- */

TEST(WallContact, FitIsExactForLinearFields)
{
  for (const int dim : {2, 3})
    for (const Scene &scene : scenes(dim)) {
      const Discretized ops(scene, LaplacianLimits(), false);
      const auto exact = linear_field(scene);
      auto f = spoil_walls(scene, exact);
      fit_to_fluid(ops.cloud(), ops.cloud().wall(), f.data());
      int exactly = 0;
      for (const int i : ops.cloud().wall()) exactly += std::fabs(f[i] - exact[i]) < ROUNDING * 10;
      // on edges of space and corners the fluid can lie in a plane or a line: then it is the mean
      EXPECT_GE(exactly, 0.9 * static_cast<double>(ops.cloud().wall().size()));
      for (const int i : ops.cloud().wall()) EXPECT_NEAR(f[i], exact[i], 5.0 * 3.0 * scene.d);
      for (const int i : scene.rows(FLUID)) EXPECT_EQ(f[i], exact[i]);
    }
}

// a particle of fluid, too; its own value is not used
TEST(WallContact, FitOfAFluidParticle)
{
  for (const int dim : {2, 3}) {
    const Scene scene = closed_box(dim, 6, 0.2, 3);
    const Discretized ops(scene, LaplacianLimits(), false);
    const auto exact = linear_field(scene);
    for (const int i : {ops.cloud().fluid().front(), ops.cloud().fluid().back()}) {
      auto f = spoil_walls(scene, exact);
      f[i] = 1.0e30;
      fit_to_fluid(ops.cloud(), {i}, f.data());
      EXPECT_NEAR(f[i], exact[i], 10.0 * ROUNDING);
    }
  }
}

TEST(WallContact, NormalPartIsExactForLinearVelocities)
{
  for (const int dim : {2, 3})
    for (const Scene &scene : scenes(dim)) {
      const Discretized ops(scene, LaplacianLimits(), false);
      const auto exact = linear_velocity(scene), v = spoil_walls(scene, exact);
      std::vector<double> out(scene.points.size(), 1.0e30);
      normal_part_of_fluid(ops.cloud(), fit_to_walls(ops.cloud(), ops.cloud().wall()), v.data(),
                         out.data());
      int exactly = 0;
      for (const int i : ops.cloud().wall()) {
        const double v_n = at(ops.cloud().normal(), i).dot(at(exact.data(), i));
        exactly += std::fabs(out[i] - v_n) < 10.0 * ROUNDING;
        EXPECT_NEAR(out[i], v_n, 5.0 * 3.0 * scene.d);
      }
      EXPECT_GE(exactly, 0.9 * static_cast<double>(ops.cloud().wall().size()));
    }
}

// one layer, or a single particle, does not determine a slope
TEST(WallContact, MeanWhereAFitIsNotDetermined)
{
  for (const int dim : {2, 3}) {
    const double h = dim == 3 ? 1.0 : 0.0;
    const Scene scene = one_wall(dim, {{-1.0, 1.0 - h, h}, {1.0, 1.0 - h, h}});
    const Discretized ops(scene, LaplacianLimits(), false);
    std::vector<double> f = {1.0e30, 7.0, 2.0, 5.0};
    fit_to_fluid(ops.cloud(), ops.cloud().wall(), f.data());
    EXPECT_DOUBLE_EQ(f[0], 3.5);    // equal distances
    EXPECT_EQ(f[1], 7.0);           // alone
    std::vector<double> v(3 * f.size(), 0.0), out = {8.0, 9.0};
    v[3 * 2 + dim - 1] = 2.0;
    v[3 * 3 + dim - 1] = 5.0;
    normal_part_of_fluid(ops.cloud(), fit_to_walls(ops.cloud(), ops.cloud().wall()), v.data(),
                         out.data());
    EXPECT_DOUBLE_EQ(out[0], 3.5);
    EXPECT_EQ(out[1], 9.0);
  }
}

// A sheet that leaves a wall, slower where it is nearer: by the fit it approaches at the wall, by the
// mean it leaves. In splashes the fit drove such sheets ever faster.
TEST(WallContact, MeanOfASheetThatLeaves)
{
  const Scene scene = one_wall(2, {{-1.0, 1.1, 0.0}, {1.0, 1.1, 0.0}, {0.0, 1.6, 0.0}});
  const Discretized ops(scene, LaplacianLimits(), false);
  std::vector<double> v(3 * scene.points.size(), 0.0), fitted(2, 7.0), mean(2, 7.0);
  for (std::size_t j = 2; j < scene.points.size(); j++)
    v[3 * j + 1] = 10.0 * (scene.points[j][1] / D - 1.0);    // 1 and 6
  normal_part_of_fluid(ops.cloud(), fit_to_walls(ops.cloud(), ops.cloud().wall()), v.data(),
                       fitted.data());
  mean_normal_part(ops.cloud(), ops.cloud().wall(), v.data(), mean.data());
  EXPECT_NEAR(fitted[0], -10.0, 10.0 * ROUNDING);
  EXPECT_GT(mean[0], 1.0);
  EXPECT_LT(mean[0], 6.0);
  EXPECT_EQ(mean[1], 7.0);    // alone
}

/* ----------------------------------------------------------------------
   Sliding
------------------------------------------------------------------------- */

TEST(WallContact, SlipWallsSlideWithTheMeanOfTheFluid)
{
  for (const int dim : {2, 3}) {
    Scene scene = closed_box(dim, 6, 0.2, 3);
    const Rows all = scene.rows(WALL);
    for (std::size_t k = 0; k < all.size(); k += 2) scene.role[all[k]] |= SLIP;
    const Discretized ops(scene, LaplacianLimits(), false);
    const Rows slip = slip_walls(ops.cloud());
    EXPECT_EQ(slip.size(), (all.size() + 1) / 2);
    const auto before = random_field(3 * static_cast<int>(scene.points.size()), 1);
    auto v = before;
    slide_with_fluid(ops.cloud(), slip, v.data());
    for (std::size_t i = 0; i < scene.points.size(); i++) {
      const int row = static_cast<int>(i);
      if (!(scene.role[i] & SLIP)) {
        for (int a = 0; a < 3; a++) EXPECT_EQ(v[3 * i + a], before[3 * i + a]);
        continue;
      }
      double weights = 0.0;
      Vector3d mean = Vector3d::Zero();
      const Stencil &s = ops.s();
      for (int k = s.begin(row); k < s.end(row); k++) {
        if (!(scene.role[s.col()[k]] & FLUID)) continue;
        const double omega = -s.dw()[k] / s.r()[k];
        weights += omega;
        mean += omega * at(before.data(), s.col()[k]);
      }
      const Vector3d n = at(ops.cloud().normal(), row), now = at(v.data(), row);
      if (weights > 0.0) mean /= weights;
      if (weights > 0.0) {
        const Vector3d tangential = now - mean - n * n.dot(now - mean);
        EXPECT_LE(tangential.norm(), 1.0e-14);
      }
      EXPECT_NEAR(n.dot(now), n.dot(at(before.data(), row)), 1.0e-14);
    }
  }
}

// Uniform flow along a wall has no divergence beside it, whatever the wall moves with
TEST(WallContact, SlidingWallsMakeNoDivergence)
{
  for (const int dim : {2, 3}) {
    Scene scene;
    scene.dim = dim;
    scene.d = D;
    Point up = {};
    up[dim - 1] = 1.0;
    for (const Point &p : lattice(dim, 3, D)) {
      const bool wall = p[dim - 1] < -2.5 * D;
      scene.add(p, wall ? WALL | SLIP : FLUID, wall ? up : Point{});
    }
    scene.jitter_fluid(0.2, 3);
    const Discretized ops(scene, LaplacianLimits(), false);
    std::vector<double> v(3 * scene.points.size(), 0.0), div(scene.points.size());
    for (std::size_t i = 0; i < scene.points.size(); i++)
      v[3 * i] = scene.role[i] & FLUID ? 1.0 : 1000.0 + static_cast<double>(i);
    const Rows &fluid = ops.cloud().fluid();
    const auto largest = [&] {
      divergence(ops.cloud(), fluid, v.data(), div.data());
      return D *
          max_rows(
                 fluid, [&](int i) { return std::fabs(div[i]); }, 0.0);
    };
    EXPECT_GT(largest(), 10.0);
    slide_with_fluid(ops.cloud(), slip_walls(ops.cloud()), v.data());
    EXPECT_LE(largest(), 1.0e-13);
  }
}

TEST(WallContact, WithoutFluidNothingChanges)
{
  for (const int dim : {2, 3}) {
    const Scene scene = one_wall(dim, {}, SLIP);
    const Discretized ops(scene, LaplacianLimits(), false);
    std::vector<double> v = {1.0, 2.0, 3.0, 4.0, 5.0, 6.0}, f = {7.0, 8.0}, out = f;
    const auto before = v;
    slide_with_fluid(ops.cloud(), slip_walls(ops.cloud()), v.data());
    normal_part_of_fluid(ops.cloud(), fit_to_walls(ops.cloud(), ops.cloud().wall()), v.data(),
                         out.data());
    fit_to_fluid(ops.cloud(), ops.cloud().wall(), f.data());
    EXPECT_EQ(v, before);
    EXPECT_EQ(out, (std::vector<double>{7.0, 8.0}));
    EXPECT_EQ(f, (std::vector<double>{7.0, 8.0}));
  }
}

/* ----------------------------------------------------------------------
   Means
------------------------------------------------------------------------- */

TEST(WallContact, MeanLeavesOutTheSurface)
{
  for (const int dim : {2, 3}) {
    const double h = dim == 3 ? 1.0 : 0.0;
    Scene scene = one_wall(dim, {{-1.0, 1.0 - h, h}, {1.0, 1.0 - h, h}, {0.0, 1.0 - h, h}});
    std::vector<double> f = {50.0, 60.0, 2.0, 5.0, 1000.0};
    scene.role[4] |= SURFACE;
    const Discretized ops(scene, LaplacianLimits(), false);
    mean_of_fluid(ops.cloud(), ops.cloud().wall(), f.data());
    EXPECT_DOUBLE_EQ(f[0], 3.5);
    EXPECT_EQ(f[1], 0.0);    // no fluid: nothing is known
  }
}

// Neither walls nor buffers nor what flies freely are the fluid beside a wall
TEST(WallContact, OnlyBoundFluidCounts)
{
  const Point places[] = {{-1.0, 1.0, 0.0}, {1.0, 1.0, 0.0}, {0.0, 1.0, 0.0}, {1.0, 0.0, 0.0}};
  Scene scene = one_wall(2, Points(std::begin(places), std::end(places)));
  scene.role[3] |= BUFFER;
  scene.role[4] |= SURFACE | BALLISTIC;
  scene.role[5] = WALL;
  const Discretized ops(scene, LaplacianLimits(), false);
  std::vector<double> mean = {0.0, 0.0, 2.0, 1e30, 1e30, 1e30}, fit = mean;
  mean_of_fluid(ops.cloud(), {0}, mean.data());
  fit_to_fluid(ops.cloud(), {0}, fit.data());
  EXPECT_EQ(mean[0], 2.0);
  EXPECT_EQ(fit[0], 2.0);
}

// what is not known, as the pressure of a particle that is new, is no number
TEST(WallContact, FitLeavesOutWhatIsNotKnown)
{
  for (const int dim : {2, 3}) {
    const Scene scene = closed_box(dim, 6, 0.2, 3);
    const Discretized ops(scene, LaplacianLimits(), false);
    const auto exact = linear_field(scene);
    const Rows &fluid = ops.cloud().fluid();
    const Rows unknown = {fluid[fluid.size() / 2], fluid[fluid.size() / 2 + 1]};
    auto f = exact;
    for (const int i : unknown) f[i] = std::numeric_limits<double>::quiet_NaN();
    fit_to_fluid(ops.cloud(), unknown, f.data());
    for (const int i : unknown) EXPECT_NEAR(f[i], exact[i], 10.0 * ROUNDING);
    std::vector<double> none(f.size(), std::numeric_limits<double>::quiet_NaN());
    fit_to_fluid(ops.cloud(), unknown, none.data());
    for (const int i : unknown) EXPECT_TRUE(std::isnan(none[i]));
  }
}
