// SPDX-License-Identifier: GPL-2.0-only
/* ----------------------------------------------------------------------
   Numerical density of the shifting: its scale, its deviation on lattices
   with surfaces and walls, and the images beyond them.
------------------------------------------------------------------------- */

#include "aleisph_shift_images.h"
#include "shifting.h"

#include <gtest/gtest.h>

#include <cmath>
#include <set>

using namespace aleisph;
using namespace aleisph_test;

namespace {

constexpr KernelType CUBIC = KernelType::CUBIC_SPLINE;
constexpr double ROUNDING = 1e-13;    // sums of up to 400 positive terms that add up to 1

double near_beta(int dim)
{
  return density_scale(Kernel(CUBIC, dim, H), D, nearest_reach(dim, D)).beta;
}

DensityScale full_scale(int dim)
{
  const Kernel kernel(CUBIC, dim, H);
  return density_scale(kernel, D, kernel.support());
}

// d^dim W at r = q h for h = 1.2 d, written out from Monaghan & Lattanzio
double cubic_spline(int dim, double q)
{
  const double scale = dim == 2 ? 10.0 / (7.0 * M_PI * 1.44) : 1.0 / (M_PI * 1.728);
  if (q >= 2.0) return 0.0;
  return scale * (q < 1.0 ? 1.0 - 1.5 * q * q + 0.75 * q * q * q : 0.25 * std::pow(2.0 - q, 3));
}

}    // namespace

// S*, |r| < 1.1 sqrt(dim) d: 4 + 4 neighbours at d, sqrt(2) d in 2d; 6 + 12 + 8 in 3d, the last
// at sqrt(3) d
TEST(DensityScale, NearestNeighboursAreThoseOfTheUnitCells)
{
  const double flat = cubic_spline(2, 0.0) + 4.0 * cubic_spline(2, 1.0 / 1.2) +
      4.0 * cubic_spline(2, std::sqrt(2.0) / 1.2);
  EXPECT_NEAR(near_beta(2), 1.0 / flat, ROUNDING);
  const double solid = cubic_spline(3, 0.0) + 6.0 * cubic_spline(3, 1.0 / 1.2) +
      12.0 * cubic_spline(3, std::sqrt(2.0) / 1.2) + 8.0 * cubic_spline(3, std::sqrt(3.0) / 1.2);
  EXPECT_NEAR(near_beta(3), 1.0 / solid, ROUNDING);
}

// 1/2 sum m rho_m over the layers m = 1, 2 below the surface, relative to the whole lattice. 2d:
// offsets 0, 1, 2 along the layers, where within the support 2.4 d.
TEST(DensityScale, CurvedSurfacesLackPartOfTheLayersBelow)
{
  const auto w = [](int m, int n) { return cubic_spline(2, std::hypot(m, n) / 1.2); };
  const double first = w(1, 0) + 2.0 * w(1, 1) + 2.0 * w(1, 2), second = w(2, 0) + 2.0 * w(2, 1);
  const double surface = w(0, 0) + 2.0 * w(0, 1) + 2.0 * w(0, 2);
  const double full = surface + 2.0 * (first + second);
  EXPECT_NEAR(full_scale(2).curved, 0.5 * (first + 2.0 * second) / full, ROUNDING);
}

// A ring of layers at R - m d with as many particles per length as the lattice has: what its
// outermost particles lack against a flat surface is curved K d, K = 1/R. The next order is
// (d/R)^2; the factor covers its terms, of size one.
TEST(DensityScale, IsThatOfADisc)
{
  const Kernel kernel(CUBIC, 2, H);
  for (double R : {50.0, 200.0}) {
    double sum = 0.0, flat = 0.0;
    const int n = 200000;    // points per layer, for the integrals along them
    for (int m = 0; m <= 2; m++)
      for (int k = 0; k < n; k++) {
        const double s = (k + 0.5) / n * 6.0 - 3.0, angle = s / R;
        const double r = (R - m) * D;
        const double x = r * std::sin(angle), y = r * std::cos(angle) - R * D;
        sum += kernel.w(std::hypot(x, y)) * r / (R * D) * 6.0 / n * D * D;
        flat += kernel.w(D * std::hypot(s, m)) * 6.0 / n * D * D;
      }
    // integrals along layers and lattice sums differ by 1 %
    const double curved = full_scale(2).curved;
    EXPECT_NEAR((flat - sum) * R, curved, 0.02 * curved + 1.0 / R);
    EXPECT_GT((flat - sum) * R, 0.5 * curved);
  }
}

// Values found beforehand by an independent program (prototype of the method) to the digits
// shown: half a unit of the last one
TEST(DensityScale, AgreesWithKnownValues)
{
  EXPECT_NEAR(near_beta(2), 1.0137, 5e-5);
  EXPECT_NEAR(near_beta(3), 1.0124, 5e-5);
  EXPECT_NEAR(full_scale(2).beta, 1.0002, 5e-5);
  EXPECT_NEAR(full_scale(3).beta, 0.9992, 5e-5);
  EXPECT_NEAR(full_scale(2).flat, 0.7848, 5e-5);
  EXPECT_NEAR(full_scale(3).flat, 0.7914, 5e-5);
}

TEST(DensityScale, DoesNotDependOnTheUnitOfLength)
{
  for (KernelType type : KERNELS) {
    const DensityScale small = density_scale(Kernel(type, 3, H), D, 1e9);
    const DensityScale large = density_scale(Kernel(type, 3, 1.2), 1.0, 1e9);
    EXPECT_NEAR(small.beta, large.beta, ROUNDING);
    EXPECT_NEAR(small.flat, large.flat, ROUNDING);
  }
}

TEST(Density, TheFullLatticeHasNoDeviation)
{
  for (int dim : {2, 3})
    for (KernelType type : KERNELS) {
      Scene scene;
      scene.dim = dim;
      scene.d = D;
      for (const Point &p : lattice(dim, 4, D)) scene.add(p, FLUID);    // 4 d > 3.6 d, the support
      const Shifting shifting(scene, type);
      for (bool published : {false, true})
        EXPECT_NEAR(shifting.deviation(published)[0], 0.0, ROUNDING) << dim << "d";
    }
}

// Surface: the half lattice is what it is measured with. Second row: the row of lattice points at
// 2 d is missing, and the images of the surface are in its place. Deeper rows see a full lattice.
TEST(Density, AFlatSurfaceHasNoDeviation)
{
  for (int dim : {2, 3}) {
    const Shifting shifting(half_lattice(dim));
    const auto eps = shifting.deviation(false);
    for (int row = 0; row <= 3; row++) {
      Point x{};
      x[dim - 1] = -row * D;
      EXPECT_NEAR(eps[shifting.nearest(x)], 0.0, ROUNDING) << dim << "d, row " << row;
    }
  }
}

// Without a normal there is no image: -[W(2d) + 2 W(sqrt(5) d)] beta V in 2d, and in 3d
// -[W(2d) + 4 W(sqrt(5) d)] beta V; sqrt(6) d is beyond the support of 2.4 d
TEST(Density, TheImagesReplaceTheMissingRow)
{
  for (int dim : {2, 3}) {
    Scene scene = half_lattice(dim);
    std::fill(scene.normal.begin(), scene.normal.end(), 0.0);
    const Shifting shifting(scene);
    Point x{};
    x[dim - 1] = -D;
    const double row = cubic_spline(dim, 2.0 / 1.2) +
        (dim == 2 ? 2.0 : 4.0) * cubic_spline(dim, std::sqrt(5.0) / 1.2);
    EXPECT_NEAR(shifting.deviation(false)[shifting.nearest(x)], -full_scale(dim).beta * row,
                ROUNDING);
  }
}

// eq 19 as printed: the surface lacks the 3 of 8 neighbours above it in 2d, 9 of 26 in 3d, and is
// measured with 1; the second row has all its S*
TEST(Density, PublishedDeviationAtAFlatSurface)
{
  const double above2 = cubic_spline(2, 1.0 / 1.2) + 2.0 * cubic_spline(2, std::sqrt(2.0) / 1.2);
  const double above3 = cubic_spline(3, 1.0 / 1.2) + 4.0 * cubic_spline(3, std::sqrt(2.0) / 1.2) +
      4.0 * cubic_spline(3, std::sqrt(3.0) / 1.2);
  for (int dim : {2, 3}) {
    const Shifting shifting(half_lattice(dim));
    const auto eps = shifting.deviation(true);
    Point x{};
    EXPECT_NEAR(eps[shifting.nearest(x)], -near_beta(dim) * (dim == 2 ? above2 : above3), ROUNDING);
    x[dim - 1] = -D;
    EXPECT_NEAR(eps[shifting.nearest(x)], 0.0, ROUNDING);
  }
}

/* ----------------------------------------------------------------------
   Tank filled with a lattice. What a row lacks is counted: lattice points
   within the support that are neither fluid, nor wet wall, nor the image of
   a wet wall particle with a single face, nor (below the surface) straight
   above the surface. The images of edges and corners are no lattice points;
   the nearest, of an edge as seen from (d, d), is at (1 + 1/sqrt 2) sqrt 2 d
   = 2.414 d, beyond the support of 2.4 d.
------------------------------------------------------------------------- */
namespace {

using Index = std::array<int, 3>;

Index index_of(const Scene &scene, int i)
{
  Index n{};
  for (int a = 0; a < 3; a++) n[a] = static_cast<int>(std::lround(scene.points[i][a] / scene.d));
  return n;
}

// the lattice points that exist or have an image; above: whether the surface has images
std::set<Index> stood_for(const Scene &scene, bool above)
{
  std::set<Index> points;
  for (size_t i = 0; i < scene.points.size(); i++) {
    if (scene.role[i] & DRY) continue;
    const Index here = index_of(scene, static_cast<int>(i));
    points.insert(here);
    const bool wall = (scene.role[i] & WALL) && scene.faces[i] == 1;
    if (!wall && !(above && (scene.role[i] & SURFACE))) continue;
    Index image = here;
    for (int a = 0; a < 3; a++)
      image[a] += static_cast<int>(std::lround(scene.normal[3 * i + a])) * (wall ? -1 : 1);
    points.insert(image);
  }
  return points;
}

// sum of d^dim W over the lattice points in the support that are present
double sum_present(const Scene &scene, const Index &here, const std::set<Index> &points)
{
  double sum = 0.0;
  const int nz = scene.dim == 3 ? 2 : 0;
  for (int k = -nz; k <= nz; k++)
    for (int j = -2; j <= 2; j++)
      for (int i = -2; i <= 2; i++)
        if (points.count({here[0] + i, here[1] + j, here[2] + k}))
          sum += cubic_spline(scene.dim, std::sqrt(i * i + j * j + k * k) / 1.2);
  return sum;
}

}    // namespace

// What no image stands for is below the threshold next to walls, so that a tank at rest is one.
TEST(Density, TankLacksOnlyWhatNoImageStandsFor)
{
  for (int dim : {2, 3}) {
    const Scene scene = filled_tank(dim, 7, 5);
    const Shifting shifting(scene);
    const auto eps = shifting.deviation(false);
    const std::set<Index> below = stood_for(scene, true), surface = stood_for(scene, false);
    double largest = 0.0;
    for (int i : shifting.fluid()) {
      const bool top = scene.role[i] & SURFACE;
      const double sum = sum_present(scene, index_of(scene, i), top ? surface : below);
      const double expected = full_scale(dim).beta * sum - (top ? full_scale(dim).flat : 1.0);
      ASSERT_NEAR(eps[i], 0.0, ROUNDING) << dim << "d, particle " << i;
      largest = std::max(largest, std::fabs(expected));
    }
    // two points at sqrt(5) d in a corner in 2d, six in 3d
    const double point = full_scale(dim).beta * cubic_spline(dim, std::sqrt(5.0) / 1.2);
    EXPECT_NEAR(largest, (dim == 2 ? 2.0 : 6.0) * point, ROUNDING);
    EXPECT_LT(largest, 1e-3);
  }
}

// A deviation above the threshold is not touched: a fluid particle next to a flat wall that is
// pushed down by 0.1 d has one of its own.
TEST(Density, DeviationNextToAWallCounts)
{
  for (int dim : {2, 3}) {
    Scene scene = filled_tank(dim, 9, 7);
    Point x = {4.0 / 9.0, 4.0 / 9.0, 4.0 / 9.0};
    x[dim - 1] = 1.0 / 9.0;
    int i = Shifting(scene).nearest(x);
    scene.points[i][dim - 1] -= 0.1 * scene.d;
    const Shifting shifting(scene);
    EXPECT_GT(std::fabs(shifting.deviation(false)[i]), 1e-3) << dim;
  }
}

// the box's own wall particles complete S* everywhere
TEST(Density, PublishedDeviationVanishesNextToWalls)
{
  for (int dim : {2, 3}) {
    const Shifting shifting(closed_box(dim, 7));
    const auto eps = shifting.deviation(true);
    for (int i : shifting.fluid()) ASSERT_NEAR(eps[i], 0.0, ROUNDING);
  }
}

// On a convex edge the images of two faces coincide, and that of the edge particle is 0.765 d from
// the walls: with each place taken once the lattice is complete. In 3d a row beyond a corner may
// not see the wall particle whose place the corner's image takes: 2e-5 [measured].
TEST(Density, ConvexEdgesCountNoPlaceTwice)
{
  for (int dim : {2, 3}) {
    const Scene scene = box_obstacle(dim, 5);
    const Shifting shifting(scene);
    const auto eps = shifting.deviation(false);
    int rows = 0;
    for (int i : shifting.fluid()) {
      bool next = true;    // the first layer; outer ones have a free surface that is not marked
      for (int a = 0; a < dim; a++) next &= std::fabs(scene.points[i][a]) < 0.5 + 1.5 * scene.d;
      if (!next) continue;
      rows++;
      EXPECT_NEAR(eps[i], 0.0, dim == 2 ? ROUNDING : 5e-5);
    }
    EXPECT_EQ(rows, dim == 2 ? 28 : 296);    // 8^dim - 6^dim
  }
}

/* ---------------------------------------------------------------------- */

namespace {

// images of particle 0 in 2d, spacing 1
std::vector<Eigen::Vector3d> images_of_first(const Scene &scene, bool surface = true)
{
  const Shifting shifting(scene);
  return Images(shifting.cloud(), surface).of(0);
}

Scene at_origin(Role role = FLUID)
{
  Scene scene;
  scene.add({0.0, 0.0, 0.0}, role);
  return scene;
}

}    // namespace

TEST(Images, OfAWallLieBehindIt)
{
  Scene scene = at_origin();
  scene.add({0.5, -1.0, 0.0}, WALL, {0.0, 1.0, 0.0});
  for (bool surface : {true, false}) {
    const auto images = images_of_first(scene, surface);
    ASSERT_EQ(images.size(), 1u);    // x_i - x of the image at (0.5, -2)
    EXPECT_DOUBLE_EQ(images[0][0], -0.5);
    EXPECT_DOUBLE_EQ(images[0][1], 2.0);
    EXPECT_EQ(images[0][2], 0.0);
  }
}

TEST(Images, OfTheSurfaceAreSeenFromBelowOnly)
{
  for (Role role : {FLUID, FLUID | SURFACE}) {
    Scene scene = at_origin(role);
    scene.add({0.5, 1.0, 0.0}, FLUID | SURFACE, {0.0, 1.0, 0.0});
    const auto images = images_of_first(scene);
    ASSERT_EQ(images.size(), role & SURFACE ? 0u : 1u);
    if (!images.empty()) {
      EXPECT_DOUBLE_EQ(images[0][0], -0.5);
      EXPECT_DOUBLE_EQ(images[0][1], -2.0);
    }
    EXPECT_EQ(images_of_first(scene, false).size(), 0u);
  }
}

TEST(Images, NeedANormalAndLieWithinTheSupport)
{
  Scene scene = at_origin();
  scene.add({0.0, -1.0, 0.0}, WALL);                     // normal unknown
  scene.add({1.0, -1.5, 0.0}, WALL, {0.0, 1.0, 0.0});    // image at (1, -2.5), 2.69 > 2.4
  EXPECT_EQ(images_of_first(scene).size(), 0u);
}

TEST(Images, GiveWayToWhatIsThere)
{
  Scene fold = at_origin();    // the image at (0, 2) of the surface is where another particle is
  fold.add({0.0, 1.0, 0.0}, FLUID | SURFACE, {0.0, 1.0, 0.0});
  EXPECT_EQ(images_of_first(fold).size(), 1u);
  fold.add({0.8, 2.2, 0.0}, FLUID);    // at 0.82 d from the image
  EXPECT_EQ(images_of_first(fold).size(), 0u);

  Scene itself = at_origin();    // the image would be on the particle that looks
  itself.add({0.0, 1.0, 0.0}, FLUID | SURFACE, {0.0, -1.0, 0.0});
  EXPECT_EQ(images_of_first(itself).size(), 0u);

  Scene plate = at_origin();    // the other side of a plate of thickness d
  plate.add({0.0, -1.0, 0.0}, WALL, {0.0, 1.0, 0.0});
  plate.add({0.1, -2.0, 0.0}, WALL, {0.0, -1.0, 0.0});
  for (const Eigen::Vector3d &r : images_of_first(plate)) EXPECT_LT(r[1], 1.5);

  Scene twice =
      at_origin();    // two faces whose images nearly coincide, at (0, -1.8) and (0.1, -1.8)
  twice.add({-1.0, -1.8, 0.0}, WALL, {-1.0, 0.0, 0.0});
  twice.add({1.1, -1.8, 0.0}, WALL, {1.0, 0.0, 0.0});
  EXPECT_EQ(images_of_first(twice).size(), 1u);
}
