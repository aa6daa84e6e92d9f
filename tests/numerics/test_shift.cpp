// SPDX-License-Identifier: GPL-2.0-only
/* ----------------------------------------------------------------------
   Particle shifting: what leaves a lattice alone, in which direction and
   how far a displaced particle goes, limits, walls, surface.
------------------------------------------------------------------------- */

#include "shifting.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>

using namespace aleisph;
using namespace aleisph_test;

namespace {

constexpr double ROUNDING = 1e-13;    // sums of up to 60 terms of size 1, C = 1
constexpr double INF = std::numeric_limits<double>::infinity();

// lattice with the origin displaced
Scene displaced(int dim, const Point &delta)
{
  Scene scene;
  scene.dim = dim;
  scene.d = D;
  for (const Point &p : lattice(dim, 4, D)) scene.add(p, FLUID);
  for (int a = 0; a < dim; a++) scene.points[0][a] += delta[a];
  return scene;
}

}    // namespace

/* ----------------------------------------------------------------------
   Lattices
------------------------------------------------------------------------- */

TEST(Shift, NothingMovesOnTheFullLattice)
{
  for (int dim : {2, 3})
    for (ShiftModel model : MODELS)
      for (bool published : {false, true}) {
        const Shifting shifting(displaced(dim, {0.0, 0.0, 0.0}));
        ShiftParams params = unbounded(model);
        params.published = published;
        EXPECT_NEAR(length(at(full_shift(shifting, params), 0)) / D, 0.0, ROUNDING);
      }
}

// Density: S* is complete but for the row above the surface, whose effect is normal: even
// spreading removes it, and eps = 0. OPS does the same in both rows, Fickian and tvf on the
// surface; their second row is drawn outwards by the missing row at 2 d.
TEST(Shift, AFlatSurfaceStaysFlat)
{
  for (int dim : {2, 3})
    for (ShiftModel model : MODELS) {
      const Shifting shifting(half_lattice(dim));
      ShiftParams params = unbounded(model);
      params.smoothing = 0.5;
      const auto dr = full_shift(shifting, params);
      for (int row = 0; row <= 3; row++) {
        Point x{};
        x[dim - 1] = -row * D;
        const Point moved = at(dr, shifting.nearest(x));
        const bool drawn = row == 1 && (model == ShiftModel::FICKIAN || model == ShiftModel::TVF);
        if (drawn)
          EXPECT_GT(moved[dim - 1], 1e-3 * D);
        else
          EXPECT_NEAR(length(moved) / D, 0.0, ROUNDING) << dim << "d, row " << row;
      }
    }
}

// The row that the second row lacks: at (0, 2) and (+-1, 2) d in 2d, at (0, 0, 2), (+-1, 0, 2)
// and (0, +-1, 2) d in 3d. dr = -C h^2 V sum (1 + 0.2 (W/W(d))^4) W' e, so the missing points
// give dr = C h^2 V sum (...) W' e with e_n = -2/(r/d).
TEST(Shift, FickianDrawsTheSecondRowToTheSurface)
{
  for (int dim : {2, 3}) {
    const Shifting shifting(half_lattice(dim));
    const Kernel &kernel = shifting.kernel();
    double sum = 0.0;
    for (double r2 : {4.0, 5.0}) {
      const double r = std::sqrt(r2) * D, pairing = std::pow(kernel.w(r) / kernel.w(D), 4);
      const double count = r2 < 4.5 ? 1.0 : 2.0 * (dim - 1);
      sum += count * (1.0 + 0.2 * pairing) * kernel.dw(r) * -2.0 / std::sqrt(r2);
    }
    Point x{};
    x[dim - 1] = -D;
    const auto dr = full_shift(shifting, unbounded(ShiftModel::FICKIAN));
    EXPECT_NEAR(at(dr, shifting.nearest(x))[dim - 1] / D, H * H * shifting.volume() * sum / D,
                ROUNDING);
  }
}

// Published: eps = e < 0 on the surface, 0 below (S* complete); the surface particle meets
// q = e with its neighbour(s) below, at e_n = 1 straight down, 1/sqrt 2 twice (2d) or four times
// (3d) and 1/sqrt 3 four times (3d): dr_n = C h e (1 + sum e_n). Pairs in the row cancel.
// With positive_surface q = max(e, 0) = 0.
TEST(Shift, PublishedFormPullsAFlatSurfaceDown)
{
  for (int dim : {2, 3}) {
    const Shifting shifting(half_lattice(dim));
    const double e = shifting.deviation(true)[shifting.nearest({0.0, 0.0, 0.0})];
    const double sum = 1.0 +
        (dim == 2 ? std::sqrt(2.0) : 2.0 * std::sqrt(2.0) + 4.0 / std::sqrt(3.0));
    ShiftParams params = unbounded(ShiftModel::DENSITY);
    params.published = true;
    const Point down = at(full_shift(shifting, params), shifting.nearest({0.0, 0.0, 0.0}));
    EXPECT_NEAR(down[dim - 1] / D, 1.2 * e * sum, ROUNDING);
    EXPECT_NEAR(down[0] / D, 0.0, ROUNDING);

    params.positive_surface = true;
    const auto dr = full_shift(shifting, params);
    for (int row = 0; row <= 2; row++) {
      Point x{};
      x[dim - 1] = -row * D;
      EXPECT_NEAR(length(at(dr, shifting.nearest(x))) / D, 0.0, ROUNDING);
    }
  }
}

// Nothing of S* is missing next to a wall, corners included, and the concentration has images. What
// is left comes from the lattice points at sqrt(5) d that no image stands for (test_density.cpp),
// 2 in a corner in 2d, 6 in 3d. Bounds, in d: Fickian C h^2 (1 + ...) V |W'(sqrt(5) d)| for each
// of them; density h sum_j |eps_i + eps_j| < h 8 2 4.03e-4 in 2d, h 26 2 7.04e-4 in 3d
TEST(Shift, WallsAndCornersOfATankLeaveALatticeAlone)
{
  for (int dim : {2, 3})
    for (ShiftModel model : MODELS) {
      const Shifting shifting(closed_box(dim, 7));
      const auto dr = full_shift(shifting, unbounded(model));
      const double d = shifting.scene().d, h = 1.2;
      const double points = dim == 2 ? 2.0 : 6.0;
      const double slope = -shifting.volume() * d * shifting.kernel().dw(std::sqrt(5.0) * d);
      const double eps = dim == 2 ? 4.03e-4 : 7.04e-4;
      const double bound = model == ShiftModel::DENSITY ? h * (dim == 2 ? 8.0 : 26.0) * 2.0 * eps
                                                        : h * h * points * 1.001 * slope;
      double largest = 0.0;
      for (int i : shifting.fluid()) largest = std::max(largest, length(at(dr, i)) / d);
      EXPECT_LT(largest, bound);
      EXPECT_LT(bound, 0.06);    // at C = 1; C is 0.1 or less
      // away from the corners: nothing at all
      Point x{0.5 - 0.5 * d, d, 0.5 - 0.5 * d};
      EXPECT_NEAR(length(at(dr, shifting.nearest(x))) / d, 0.0, ROUNDING);
    }
}

TEST(Shift, PublishedFormLeavesABoxAlone)
{
  for (int dim : {2, 3}) {
    const Shifting shifting(closed_box(dim, 7));
    ShiftParams params = unbounded(ShiftModel::DENSITY);
    params.published = true;
    const auto dr = full_shift(shifting, params);
    for (int i : shifting.fluid())
      ASSERT_NEAR(length(at(dr, i)) / shifting.scene().d, 0.0, ROUNDING);
  }
}

/* ----------------------------------------------------------------------
   Direction and size
------------------------------------------------------------------------- */

// The lattice without the origin is symmetric: dr(-delta) = -dr(delta), and for delta along an
// axis dr lies on it. Back towards the gap that it has left.
TEST(Shift, ADisplacedParticleGoesBack)
{
  for (int dim : {2, 3})
    for (ShiftModel model : MODELS)
      for (bool published : {false, true})
        for (double s : {0.05, 0.2, 0.35}) {
          ShiftParams params = unbounded(model);
          params.published = published;
          Point delta{};
          delta[1] = s * D;
          const Point there = at(full_shift(Shifting(displaced(dim, delta)), params), 0);
          delta[1] = -delta[1];
          const Point back = at(full_shift(Shifting(displaced(dim, delta)), params), 0);
          EXPECT_LT(there[1], 0.0) << dim << "d, model " << static_cast<int>(model) << ", " << s;
          for (int a = 0; a < 3; a++) EXPECT_NEAR(there[a] + back[a], 0.0, ROUNDING * D);
          EXPECT_NEAR(there[0], 0.0, ROUNDING * D);
        }
}

// The neighbours of the displaced one give way: the one ahead forwards, the one behind follows
TEST(Shift, NeighboursGiveWay)
{
  for (ShiftModel model : MODELS) {
    const Shifting shifting(displaced(2, {0.2 * D, 0.0, 0.0}));
    const auto dr = full_shift(shifting, unbounded(model));
    EXPECT_GT(at(dr, shifting.nearest({D, 0.0, 0.0}))[0], 0.0);
    EXPECT_GT(at(dr, shifting.nearest({-D, 0.0, 0.0}))[0], 0.0);
  }
}

TEST(Shift, IsProportionalToTheCoefficient)
{
  for (ShiftModel model : MODELS) {
    const Shifting shifting(rough(2, 3));
    ShiftParams params = unbounded(model);
    const auto one = full_shift(shifting, params);
    params.coefficient = 0.013;
    const auto small = full_shift(shifting, params);
    for (int i = 0; i < 3 * shifting.size(); i++)
      ASSERT_NEAR(small[i], 0.013 * one[i], ROUNDING * D);
  }
}

TEST(Shift, TheLimitShortensAndCounts)
{
  for (ShiftModel model : MODELS) {
    const Shifting shifting(rough(2, 5));
    ShiftParams params = unbounded(model);
    ShiftCount count;
    const auto free = full_shift(shifting, params, &count);
    EXPECT_EQ(count.limited, 0);
    params.limit = 0.1;
    const auto limited = full_shift(shifting, params, &count);
    int longer = 0;
    for (int i = 0; i < shifting.size(); i++) {
      const Point a = at(free, i), b = at(limited, i);
      const double factor = std::min(1.0, 0.1 * D / length(a));
      longer += length(a) > 0.1 * D;
      for (int c = 0; c < 3; c++) ASSERT_NEAR(b[c], factor * a[c], ROUNDING * D);
    }
    EXPECT_GT(longer, 0);
    EXPECT_LT(longer, shifting.size());
    EXPECT_EQ(count.limited, longer);
  }
}

// |dr| <= 0.25 |v| dt; the direction is that of fickian with the same C
TEST(Shift, TvfIsBoundedByTheVelocity)
{
  const Shifting shifting(rough(2, 6));
  const auto fickian = full_shift(shifting, unbounded(ShiftModel::FICKIAN));
  ShiftParams params = unlimited(ShiftModel::TVF);
  params.dt = 0.01;
  const double V = 80.0 * D;    // 0.25 V dt = 0.2 D
  ShiftCount count;
  const auto dr = shifting.shift(params, {}, streaming(shifting, V), &count);
  EXPECT_EQ(count.limited, 0);    // the bound belongs to the model
  int bounded = 0;
  for (int i = 0; i < shifting.size(); i++) {
    const Point a = at(fickian, i), b = at(dr, i);
    const double factor = std::min(1.0, 0.2 * D / length(a));
    bounded += factor < 1.0;
    for (int c = 0; c < 3; c++) ASSERT_NEAR(b[c], factor * a[c], ROUNDING * D);
  }
  EXPECT_GT(bounded, 0);
  EXPECT_LT(bounded, shifting.size());
  for (double x : shifting.shift(params, {}, streaming(shifting, 0.0))) EXPECT_EQ(x, 0.0);
}

TEST(Shift, BallisticParticlesFlyFreely)
{
  for (ShiftModel model : MODELS) {
    Scene scene = rough(2, 7);
    scene.role[0] |= SURFACE | BALLISTIC;
    scene.role[5] |= SURFACE | BALLISTIC;
    const Shifting shifting(scene);
    ShiftParams params = unbounded(model);
    params.limit = INF;
    const auto free = full_shift(shifting, params);
    int moved = 0;
    for (int i = 0; i < shifting.size(); i++) moved += length(at(free, i)) > 0.0;
    EXPECT_GE(moved, shifting.size() - 6);    // the two, and at most the four corners
    params.limit = 0.0;    // all that move are limited: the count leaves the two out
    ShiftCount count;
    full_shift(shifting, params, &count);
    EXPECT_EQ(count.limited, moved);
    for (int i : {0, 5}) EXPECT_EQ(length(at(free, i)), 0.0);
    EXPECT_GT(length(at(free, 1)), 0.0);
  }
}

/* ----------------------------------------------------------------------
   Walls and surface
------------------------------------------------------------------------- */

// Particle with deviation a, a wall particle below at d, a fluid particle beside at d with
// deviation b, both within S*: the wall has the deviation of the particle itself.
//   dr/(C h) = w(d) (e_wall + e_fluid) + 2a e_wall + (a + b) e_fluid
TEST(Shift, AWallMirrorsTheDeviation)
{
  Scene scene;
  scene.add({0.0, 0.0, 0.0}, FLUID);
  scene.add({0.0, -1.0, 0.0}, WALL, {0.0, 1.0, 0.0});
  scene.add({1.0, 0.0, 0.0}, FLUID);
  const double a = 0.07, b = -0.02, raw = 55.0;    // raw: of the wall, must not be read
  const Shifting shifting(scene);
  const Point dr = at(shifting.shift(unlimited(ShiftModel::DENSITY), {a, raw, b}), 0);
  EXPECT_NEAR(dr[0], -1.2 * (weight(shifting, 1.0) + a + b), ROUNDING);
  EXPECT_NEAR(dr[1], 1.2 * (weight(shifting, 1.0) + 2.0 * a), ROUNDING);
}

// min(wall_distance d - s, wall_step d) along the normal of the wall below; a wall particle beside
// it or behind the particle does not count
TEST(Shift, MovesParticlesOffWalls)
{
  for (double s : {0.2, 0.68, 0.75}) {
    Scene scene;
    scene.add({0.0, s, 0.0}, FLUID);
    scene.add({0.1, 0.0, 0.0}, WALL, {0.0, 1.0, 0.0});
    scene.add({1.0, 0.1, 0.0}, WALL, {0.0, 1.0, 0.0});
    scene.add({0.3, 1.2, 0.0}, WALL, {0.0, 1.0, 0.0});
    const Shifting shifting(scene);
    ShiftParams params = unlimited(ShiftModel::DENSITY);
    const std::vector<double> eps(4, 0.0);
    const Point without = at(shifting.shift(params, eps), 0);
    params.wall_step = 0.05;
    const Point with = at(shifting.shift(params, eps), 0);
    EXPECT_NEAR(with[0], without[0], ROUNDING);
    EXPECT_NEAR(with[1] - without[1], std::max(0.0, std::min(0.7 - s, 0.05)), ROUNDING) << s;
  }
}

// a buffer particle is no fluid row, its deviation is not known either
TEST(Shift, ABufferMirrorsTheDeviation)
{
  Scene scene;
  scene.add({0.0, 0.0, 0.0}, FLUID);
  scene.add({-1.0, 0.0, 0.0}, FLUID | BUFFER | DIRICHLET);
  const Shifting shifting(scene);
  const Point dr = at(shifting.shift(unlimited(ShiftModel::DENSITY), {0.07, 55.0}), 0);
  EXPECT_NEAR(dr[0], 1.2 * (weight(shifting, 1.0) + 0.14), ROUNDING);
}

// pairs with a member on the surface: max(eps_i + eps_j, 0); others keep their sign
TEST(Shift, PositiveSurfaceOnlyRepels)
{
  for (Role role : {FLUID, FLUID | SURFACE})
    for (double eps : {-0.1, 0.1}) {
      Scene scene;
      scene.add({0.0, 0.0, 0.0}, FLUID);
      scene.add({-1.0, 0.0, 0.0}, role, {0.0, 1.0, 0.0});
      const Shifting shifting(scene);
      ShiftParams params = unlimited(ShiftModel::DENSITY);
      params.positive_surface = true;
      const double q = role & SURFACE ? std::max(2.0 * eps, 0.0) : 2.0 * eps;
      EXPECT_NEAR(at(shifting.shift(params, {eps, eps}), 0)[0], 1.2 * (weight(shifting, 1.0) + q),
                  ROUNDING);
    }
}

// eps = 0: what is left of the density model on the surface is the even spreading
TEST(Shift, EvenSpreadingIsTangentialOnTheSurface)
{
  for (int dim : {2, 3})
    for (unsigned seed : {1u, 2u, 3u}) {
      const Shifting shifting(rough(dim, seed));
      const std::vector<double> none(shifting.size(), 0.0);
      const auto dr = shifting.shift(unlimited(ShiftModel::DENSITY), none);
      double below = 0.0;
      for (int i : shifting.fluid())
        if (shifting.scene().role[i] & SURFACE)
          ASSERT_NEAR(dr[3 * i + dim - 1] / D, 0.0, ROUNDING);
        else
          below = std::max(below, std::fabs(dr[3 * i + dim - 1]) / D);
      EXPECT_GT(below, 0.01);
    }
}

// The density term keeps its normal part on the surface: eps = 1 everywhere gives
// 2 sum_S* e, of which the flat surface has (1 + sqrt 2) upwards in 2d
TEST(Shift, TheDensityTermKeepsItsNormalPart)
{
  const Shifting shifting(half_lattice(2));
  const std::vector<double> one(shifting.size(), 1.0);
  const auto dr = shifting.shift(unlimited(ShiftModel::DENSITY), one);
  EXPECT_NEAR(at(dr, shifting.nearest({0.0, 0.0, 0.0}))[1] / D, 1.2 * 2.0 * (1.0 + std::sqrt(2.0)),
              ROUNDING);
}

TEST(Shift, ConcentrationModelsAreTangentialOnTheSurface)
{
  for (int dim : {2, 3})
    for (ShiftModel model : {ShiftModel::OPS, ShiftModel::FICKIAN, ShiftModel::TVF}) {
      const Shifting shifting(rough(dim, 4));
      const auto dr = full_shift(shifting, unbounded(model));
      double tangential = 0.0;
      for (int i : shifting.fluid())
        if (shifting.scene().role[i] & SURFACE) {
          ASSERT_NEAR(dr[3 * i + dim - 1] / D, 0.0, ROUNDING);
          tangential = std::max(tangential, length(at(dr, i)) / D);
        }
      EXPECT_GT(tangential, 0.01);
    }
}

// OPS takes the normal of the surface particles within S* for a particle that has some, and is
// fickian elsewhere and along the surface. Here all N are the same, so the mean is N.
TEST(Shift, OpsRemovesTheNormalPartNextToTheSurface)
{
  for (int dim : {2, 3}) {
    const Shifting shifting(rough(dim, 8));
    const auto ops = full_shift(shifting, unbounded(ShiftModel::OPS));
    const auto fickian = full_shift(shifting, unbounded(ShiftModel::FICKIAN));
    const double reach = nearest_reach(dim, D);
    int next = 0;
    for (int i : shifting.fluid()) {
      bool near = false;
      for (int k = shifting.s().begin(i); k < shifting.s().end(i); k++)
        near |= shifting.s().r()[k] < reach &&
            (shifting.scene().role[shifting.s().col()[k]] & SURFACE);
      if (shifting.scene().role[i] & SURFACE) continue;
      next += near;
      for (int a = 0; a < 3; a++)
        ASSERT_NEAR(ops[3 * i + a] / D, near && a == dim - 1 ? 0.0 : fickian[3 * i + a] / D,
                    ROUNDING);
    }
    EXPECT_GT(next, 5);
  }
}

// Two surface neighbours with N at +-30 degrees from the vertical: their mean is the vertical.
// With N nearly opposite (a film three particles thick; |mean N| = 0.14) nothing is removed.
TEST(Shift, OpsUsesTheMeanNormal)
{
  const double s = 0.5, c = std::sqrt(0.75);
  const Point pairs[2][2] = {{{s, c, 0.0}, {-s, c, 0.0}}, {{0.0, 1.0, 0.0}, {0.28, -0.96, 0.0}}};
  for (int film : {0, 1}) {
    Scene scene;
    scene.add({0.0, 0.0, 0.0}, FLUID);
    scene.add({0.7, 0.8, 0.0}, FLUID | SURFACE, pairs[film][0]);
    scene.add({-0.2, 1.0, 0.0}, FLUID | SURFACE, pairs[film][1]);
    const Shifting shifting(scene);
    const Point ops = at(shifting.shift(unlimited(ShiftModel::OPS), {}), 0);
    const Point fickian = at(shifting.shift(unlimited(ShiftModel::FICKIAN), {}), 0);
    EXPECT_LT(fickian[1], -0.1);
    EXPECT_NEAR(ops[0], fickian[0], ROUNDING);
    EXPECT_NEAR(ops[1], film ? fickian[1] : 0.0, ROUNDING);
  }
}
