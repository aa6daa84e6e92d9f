// SPDX-License-Identifier: GPL-2.0-only
/* ----------------------------------------------------------------------
   Curvature on drops, films, columns and cavities, where it is known.
   Asked on relaxed balls of R/d = 6, 10, 15: the mean within 0.5 %, a scatter
   (standard deviation) of at most 3 %.
------------------------------------------------------------------------- */

#include "drops.h"

#include <gtest/gtest.h>

#include <Eigen/Dense>

#include <algorithm>
#include <cmath>
#include <map>

using namespace aleisph;
using namespace aleisph_test;

namespace {

using Vec3 = Eigen::Vector3d;
using Mat3 = Eigen::Matrix3d;

// Sums of some hundred terms of either sign, each known to eps, and a division by 0.5
constexpr double ROUNDING = 1.0e-12;

constexpr double MEAN = 0.005;      // asked
constexpr double SCATTER = 0.03;    // asked

Points ball(int dim, int n)
{
  static std::map<std::pair<int, int>, Points> made;
  Points &points = made[{dim, n}];
  if (points.empty()) points = relaxed_ball(dim, n, D);
  return points;
}

// radius of the disc or ball of n particles
double radius(int dim, size_t n)
{
  const double cells = static_cast<double>(n);
  return D * (dim == 2 ? std::sqrt(cells / M_PI) : std::cbrt(0.75 * cells / M_PI));
}

}    // namespace

class TensionDropTest : public testing::TestWithParam<int> {
 protected:
  int dim_ = GetParam();
};

// The wide gradient on a lattice is normal to the surface by symmetry, up to rounding; films have
// N of opposite signs on their two sides, down to two layers
TEST_P(TensionDropTest, PlaneSurfacesAndFilmsHaveNoCurvature)
{
  const int n = 6, across = dim_ - 1;
  Point period = {n * D, dim_ == 3 ? n * D : 0.0, 0.0};
  for (int layers : {2, 3, 12}) {
    Points points;
    for (int k = 0; k < layers; k++)
      for (int m = 0; m < (dim_ == 3 ? n * n : n); m++) {
        points.push_back({m % n * D, m / n * D, 0.0});
        points.back()[across] = k * D;
      }
    Drop film(dim_, D, points, period);
    film.tangent();
    EXPECT_EQ(film.surface().size(), 2 * points.size() / layers);
    for (int i : film.surface()) {
      const double side = film.point(i)[across] > 0.5 * D * (layers - 1) ? 1.0 : -1.0;
      EXPECT_NEAR(film.N(i, across), side, ROUNDING);
      EXPECT_NEAR(film.K(i) * D, 0.0, ROUNDING);
    }
  }
}

// What is asked. In 2d a normal is a mean over fewer particles than in 3d: the half disc and half
// ball of radius 4.8 d hold 36 and 232, so scatter from their places is sqrt(232/36) = 2.5 times that
// in 3d for the same quality of the cloud.
TEST_P(TensionDropTest, RelaxedDropsHaveTheirCurvature)
{
  for (int n : {6, 10, 15}) {
    Drop drop(dim_, D, ball(dim_, n));
    drop.tangent();
    const Statistics K = statistics(drop.values());
    const double R = radius(dim_, ball(dim_, n).size()), exact = (dim_ - 1) / R;
    EXPECT_NEAR(K.mean / exact, 1.0, MEAN) << n;
    EXPECT_LT(K.deviation / exact, dim_ == 3 ? SCATTER : 2.5 * SCATTER) << n;
    const CurvatureCount &count = drop.count();
    EXPECT_EQ(count.few + count.unknown + count.limited, 0) << n;
  }
}

// Moved and turned: the same up to rounding of the places, which are known to eps |x| and enter K
// through differences over d: eps |x|/d^2 for N_j - N_i, divided by the bracket
TEST_P(TensionDropTest, TranslationAndRotationChangeNothing)
{
  const Points &points = ball(dim_, 6);
  Drop drop(dim_, D, points);
  drop.tangent();
  const Mat3 turn = (dim_ == 3 ? Eigen::AngleAxisd(1.1, Vec3(1.0, 2.0, -3.0).normalized())
                               : Eigen::AngleAxisd(1.1, Vec3::UnitZ()))
                        .toRotationMatrix();
  Points moved = points;
  for (Point &x : moved) {
    Vec3::Map(x.data()) = turn * Vec3::Map(x.data()) + D * Vec3(3.0, -70.0, dim_ == 3 ? 11.0 : 0.0);
    if (dim_ == 2) x[2] = 0.0;
  }
  Drop other(dim_, D, moved);
  other.tangent();
  ASSERT_EQ(drop.surface(), other.surface());
  for (int i : drop.surface()) EXPECT_NEAR(drop.K(i) * D, other.K(i) * D, 1.0e-11) << i;
}

// Outside of a cavity of radius R, K = -(dim - 1)/R. The layer of particles has its radius R + d/2.
// Its shells are not relaxed: the mean alone is compared, within the scatter asked.
TEST_P(TensionDropTest, CavityHasNegativeCurvature)
{
  const int n = 8;
  Drop fluid(dim_, D, shells(dim_, n + 1, n + 7, D));
  fluid.tangent();
  const auto near = [](const Point &x) { return std::hypot(x[0], x[1], x[2]) < (n + 0.7) * D; };
  const Statistics K = statistics(fluid.values(near));
  EXPECT_NEAR(K.mean * n * D / (1.0 - dim_), 1.0, SCATTER);
}

// Noise of 0.1 d: K scatters, but that of the published sum at least three times as much; so on
// drops cut from a lattice. METHOD 7: 3 % against 16 %, 2-12 % against 23-61 %.
TEST_P(TensionDropTest, NoiseAndLatticesScatterLessThanPublished)
{
  for (int n : {6, 10})
    for (bool noise : {true, false}) {
      if (dim_ == 2 && !noise) continue;    // steps many spacings long are no disc
      Points points = noise ? ball(dim_, n) : lattice_ball(dim_, n * D, D);
      if (noise) jitter(points, dim_, 0.1 * D, 3);
      Drop drop(dim_, D, points);
      drop.tangent();
      const Statistics tangent = statistics(drop.values());
      drop.published(0.41);
      const Statistics published = statistics(drop.values());
      const double R = radius(dim_, points.size());
      EXPECT_NEAR(tangent.mean * R / (dim_ - 1), 1.0, SCATTER) << n << noise;
      EXPECT_LT(3.0 * tangent.deviation / tangent.mean, published.deviation / published.mean)
          << n << noise;
    }
}

// A drop stretched to the mode n = 2, r = R (1 + e cos 2 phi) in 2d, R (1 + e P_2(cos theta)) in 3d:
// K changes by 3 e/R cos 2 phi, 4 e/R P_2. The frequency goes with the root of this stiffness; 3 % are
// asked of it. The mean takes 1 - c (q d)^2 of a wave of wave number q = 2/R, with weights 1 - r/2.4 d
// on a line c = sum w r^2/(2 sum w) = (0.583 + 4 * 0.167)/(1 + 2 * 0.75) = 0.50, on a plane about 0.6;
// the wide N takes as much again (measured: 0.9 and 1.4 for all together). This makes 0.96 (2d) and
// 0.92 (3d) at most, 0.94 and 0.87 are what the steps leave. The row at the centres of the particles
// makes up for it, by d/(2 R).
TEST_P(TensionDropTest, StiffnessAgainstTheSlowestMode)
{
  const int n = dim_ == 2 ? 10 : 8;
  const double e = 0.03, R = radius(dim_, ball(dim_, n).size());
  const Points &round = ball(dim_, n);
  Points stretched = round;
  for (Point &x : stretched)
    for (int a = 0; a < dim_; a++)
      x[a] *= a == dim_ - 1 ? 1.0 + e : std::pow(1.0 + e, 1.0 / (1 - dim_));
  Drop before(dim_, D, round), after(dim_, D, stretched);
  before.tangent();
  after.tangent();
  ASSERT_EQ(before.surface(), after.surface());
  double change = 0.0, exact = 0.0;
  for (int i : before.surface()) {
    const Vec3 u = Vec3::Map(round[i].data()).normalized();
    const double c2 = u[dim_ - 1] * u[dim_ - 1], mode = dim_ == 2 ? 2.0 * c2 - 1.0 : 1.5 * c2 - 0.5;
    change += (after.K(i) - before.K(i)) * mode;
    exact += (dim_ + 1) * e / R * mode * mode;
  }
  EXPECT_LT(change / exact, 1.0);
  EXPECT_GT(change / exact, dim_ == 2 ? 0.93 : 0.86);
}

INSTANTIATE_TEST_SUITE_P(Dimensions, TensionDropTest, testing::Values(2, 3));

/* ----------------------------------------------------------------------
   Ellipsoid of half axes 1.25, 1, 0.8 times r through the particles of the
   outermost layer, sum x_a^2/h_a^2 = 1. With g_a = x_a/h_a^2, Gauss' and the
   sum of the principal curvatures are
     k1 k2 = 1/(h_1 h_2 h_3 |g|^2)^2,
     k1 + k2 = sum h_a^-2/|g| - sum g_a^2 h_a^-2/|g|^3.
------------------------------------------------------------------------- */
namespace {

constexpr double AXES[] = {1.25, 1.0, 0.8};

double ellipsoid_curvature(const Point &x, double r)
{
  Vec3 h, g;
  for (int a = 0; a < 3; a++) {
    h[a] = AXES[a] * r;
    g[a] = x[a] / (h[a] * h[a]);
  }
  const Vec3 squares = h.cwiseInverse().cwiseAbs2();
  const double G = g.norm(), sum = squares.sum() / G - g.cwiseAbs2().dot(squares) / (G * G * G);
  const double product = std::pow(h.prod() * G * G, -2.0);
  const double half = std::sqrt(std::max(0.0, 0.25 * sum * sum - product));
  const double k1 = 0.5 * sum + half, k2 = 0.5 * sum - half;
  return k1 / (1.0 + 0.5 * D * k1) + k2 / (1.0 + 0.5 * D * k2);
}

// a column of discs of radius n d along z, a spacing apart
Points column(int n, int height)
{
  Points points;
  for (int k = 0; k < height; k++)
    for (const Point &x : ball(2, n)) points.push_back({x[0], x[1], k * D});
  return points;
}

}    // namespace

// K varies by a factor of 2.3 over it. The error of each particle: the scatter asked of balls.
TEST(TensionShapeTest, Ellipsoid)
{
  const int n = 10;
  Points points = ball(3, n);
  for (Point &x : points)
    for (int a = 0; a < 3; a++) x[a] *= AXES[a];
  Drop drop(3, D, points);
  drop.tangent();
  double least = 1.0e9, most = 0.0, rms = 0.0, share = 1.0 / drop.surface().size();
  for (int i : drop.surface()) {
    const double exact = ellipsoid_curvature(drop.point(i), (n - 0.5) * D);
    least = std::min(least, exact);
    most = std::max(most, exact);
    rms += share * (drop.K(i) / exact - 1.0) * (drop.K(i) / exact - 1.0);
  }
  EXPECT_GT(most / least, 2.0);
  EXPECT_LT(std::sqrt(rms), SCATTER);
}

// One curvature is 1/R, the other 0: K = 1/R at the true surface. With both taken equal, as on a
// sphere, R/d = 6 would give 12/11 * 1/(1 + 1/22) = 1.043/R.
TEST(TensionShapeTest, Cylinder)
{
  for (int n : {4, 6}) {
    Drop drop(3, D, column(n, 6), {0.0, 0.0, 6.0 * D});
    drop.tangent();
    EXPECT_NEAR(statistics(drop.values()).mean * radius(2, ball(2, n).size()), 1.0, MEAN) << n;
  }
}

// Ghosts: a period of the column, and the middle of a long one. N, the curvature sum and three means
// reach 4.8 + 2.4 + 3 * 4.8 = 21.6 d: 24 discs on each side. Equal up to the order of sums.
TEST(TensionShapeTest, PeriodicCopiesGiveTheSame)
{
  Drop period(3, D, column(4, 6), {0.0, 0.0, 6.0 * D});
  Drop whole(3, D, column(4, 54));
  period.tangent();
  whole.tangent();
  const int first = 24 * static_cast<int>(ball(2, 4).size());
  ASSERT_GT(period.surface().size(), 100u);
  for (int i : period.surface()) EXPECT_NEAR(period.K(i) * D, whole.K(first + i) * D, 1e-11) << i;

  period.published(0.41);
  whole.published(0.41);
  for (int i : period.surface()) EXPECT_NEAR(period.K(i) * D, whole.K(first + i) * D, 1e-11) << i;
}

// What eqs 25 and 27 without factor, times R, are on balls: exact is 1 for kappa = 1/R. METHOD 7
// has 2.00, 1.83, 1.75 at R/d = 6, 10, 15 on relaxed balls and 1.91, 1.62, 1.50 on others: the sum
// depends on how the particles lie, by 14 %. That it falls by an eighth from 6 to 15 is why no
// single factor is right.
TEST(TensionShapeTest, PublishedSumNeedsAFactorThatDepends)
{
  const double method[] = {2.00, 1.83, 1.75};
  double sums[3];
  for (int m = 0; m < 3; m++) {
    const int n = m == 0 ? 6 : 5 * (m + 1);
    Drop drop(3, D, ball(3, n));
    drop.published(1.0);
    sums[m] = 0.5 * statistics(drop.values()).mean * radius(3, ball(3, n).size());
    EXPECT_NEAR(sums[m] / method[m], 1.0, 0.14) << n;
    EXPECT_EQ(drop.count().few + drop.count().limited, 0) << n;
  }
  EXPECT_GT(sums[0] / sums[2], 1.08);
}
