// SPDX-License-Identifier: GPL-2.0-only
/* ----------------------------------------------------------------------
   One step on an irregular patch against the prototype of the method: patch/final2.py (accurate)
   and patch/d2.py (published, eps = rho* - 1), 2d, cubic spline, h = 1.2 d, d = 0.1, dt = 0.005,
   U = 1, on 10 x 10 particles, q = 0 ... 99 with x fastest, displaced by
     0.12 d (sin(12.9 q + 0.3), cos(0.077 q^2 + 1.1 q)).
   C = 0.3 U dt/d = 0.015 with smoothing 1.5 U dt/d = 0.075, and C = 0.005. The prototype has no
   images: its full-support sum is written out below and given to the shift, so that the row below
   the surface can be compared too. The surface is the one that the prototype found.
------------------------------------------------------------------------- */

#include "shifting.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>

using namespace aleisph;
using namespace aleisph_test;

namespace {

constexpr double ROUNDING = 1e-13;    // sums of up to 30 terms of size 1

struct PrototypeRow {
  int particle;
  double accurate[3], published[3];    // eps, dr_x, dr_y
};

// clang-format off
constexpr PrototypeRow PROTOTYPE[] = {
    { 0, {-0.132683454, 1.985297e-03, 2.048485e-03}, {-0.353184082, 4.801889e-04, 4.641630e-04}},
    { 4, {0.041927416, -1.235541e-04, -1.011800e-03}, {-0.177634261, -6.810763e-05, 2.391548e-04}},
    {11, {-0.004141871, 1.433814e-04, -1.244302e-04}, {-0.014909303, -1.469680e-04, -2.143301e-04}},
    {22, {-0.035611318, 6.097054e-05, 4.984164e-05}, {-0.079225988, 5.457904e-05, 3.318463e-05}},
    {39, {-0.083974580, -2.342732e-03, -1.717850e-04}, {-0.299467961, -5.519269e-04, 1.014036e-04}},
    {44, {0.045495763, -1.302435e-04, 2.579146e-04}, {0.013946064, -6.699602e-05, 7.514564e-05}},
    {45, {0.044663123, 1.380166e-04, 2.147455e-04}, {0.037839672, 2.684851e-05, 6.974966e-05}},
    {57, {-0.006517474, -3.494468e-05, 6.874203e-05}, {-0.005595909, 6.847479e-06, 5.652200e-05}},
    {90, {-0.269857590, 4.441491e-03, -3.933640e-03}, {-0.495506589, 4.927355e-04, -5.017723e-04}},
    {95, {-0.037554498, 2.553380e-05, -3.976277e-04}, {-0.255542604, 9.850579e-06, -3.383874e-04}},
};
// clang-format on

Scene patch()
{
  Scene scene;
  scene.d = 0.1;
  for (int q = 0; q < 100; q++) {
    const int ix = q % 10, iy = q / 10;
    const bool rim = ix == 0 || ix == 9 || iy == 0 || iy == 9;
    scene.add({0.1 * (ix - 4.5) + 0.012 * std::sin(12.9 * q + 0.3),
               0.1 * (iy - 4.5) + 0.012 * std::cos(0.077 * q * q + 1.1 * q), 0.0},
              rim ? FLUID | SURFACE : FLUID);
  }
  return scene;
}

// N = -sum gradW/|...| on the surface
Scene with_normals(Scene scene)
{
  const Shifting shifting(scene);
  const Stencil &s = shifting.s();
  for (int i : scene.rows(SURFACE)) {
    double N[2] = {0.0, 0.0};
    for (int k = s.begin(i); k < s.end(i); k++)
      for (int a = 0; a < 2; a++) N[a] -= s.dw()[k] * s.e(a)[k];
    for (int a = 0; a < 2; a++) scene.normal[3 * i + a] = N[a] / std::hypot(N[0], N[1]);
  }
  return scene;
}

// beta V sum W over the full support, against 1 or the flat surface
std::vector<double> without_images(const Shifting &shifting)
{
  const Stencil &s = shifting.s();
  const DensityScale scale = density_scale(shifting.kernel(), 0.1, shifting.kernel().support());
  std::vector<double> eps;
  for (int i = 0; i < shifting.size(); i++) {
    double sum = weight(shifting, 0.0);
    for (int k = s.begin(i); k < s.end(i); k++) sum += weight(shifting, s.r()[k]);
    eps.push_back(scale.beta * sum - (shifting.scene().role[i] & SURFACE ? scale.flat : 1.0));
  }
  return eps;
}

}    // namespace

TEST(Shift, AgreesWithThePrototype)
{
  const Shifting shifting(with_normals(patch()));
  const auto eps = without_images(shifting), eps_published = shifting.deviation(true);
  ShiftParams params;
  params.coefficient = 0.015;
  params.smoothing = 0.075;
  ShiftCount count;
  const auto dr = shifting.shift(params, eps, {}, &count);
  EXPECT_EQ(count.limited, 0);
  params.published = true;
  params.coefficient = 0.005;
  const auto dr_published = shifting.shift(params, eps_published);

  // half a unit of the last digit stored, of eps and (the largest, at a corner) of dr
  constexpr double EPS = 5e-10, DR = 5e-10;
  const auto deviation = shifting.deviation(false);
  for (const PrototypeRow &row : PROTOTYPE) {
    const int i = row.particle;
    const int ix = i % 10, iy = i / 10, depth = std::min({ix, 9 - ix, iy, 9 - iy});
    EXPECT_NEAR(eps[i], row.accurate[0], EPS) << i;
    EXPECT_NEAR(eps_published[i], row.published[0], EPS) << i;
    for (int a : {0, 1}) {
      // the prototype does not know corners: it takes every surface for a flat one
      if (depth > 0) {
        EXPECT_NEAR(dr[3 * i + a], row.accurate[1 + a], DR) << i;
      }
      EXPECT_NEAR(dr_published[3 * i + a], row.published[1 + a], DR) << i;
    }
    // no images where the surface is farther than the support
    if (depth > 2) {
      EXPECT_NEAR(deviation[i], row.accurate[0], EPS) << i;
    }
  }
}

// rows that are ghosts, in any order of the neighbours, give the same result
TEST(Shift, DoesNotDependOnTheOrderOfTheNeighbours)
{
  const Scene scene = with_normals(patch());
  const Shifting shifting(scene);
  const Kernel &kernel = shifting.kernel();
  const Cloud cloud = make_cloud(kernel, scene.d, PointSet(scene.points, 60, kernel.support(), 9),
                                 {scene.role, scene.normal, false});
  const auto expected = shifting.deviation(false);
  auto eps = expected;    // those of the ghosts come from their owners
  density_deviation(cloud, false, eps.data());
  const auto v = streaming(shifting, 1.0);
  for (ShiftModel model : MODELS) {
    const auto all = shifting.shift(unbounded(model), expected, v);
    std::vector<double> dr(180);
    compute_shift(cloud, unbounded(model), eps.data(), v.data(), dr.data());
    for (int i = 0; i < 60; i++) {
      ASSERT_NEAR(eps[i], expected[i], ROUNDING);
      for (int a = 0; a < 3; a++) ASSERT_NEAR(dr[3 * i + a] / 0.1, all[3 * i + a] / 0.1, ROUNDING);
    }
  }
}
