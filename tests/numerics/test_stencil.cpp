// SPDX-License-Identifier: GPL-2.0-only
/* ----------------------------------------------------------------------
   The stencil against a loop over all points: shuffled candidates with a
   skin and mask bits, ghosts, coincident particles, pairs at the support.
------------------------------------------------------------------------- */

#include "cloud.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

using namespace aleisph;
using namespace aleisph_test;

namespace {

double distance(const PointSet &cloud, int i, int j)
{
  double sum = 0.0;
  for (int a = 0; a < 3; a++) sum += std::pow(cloud.point(i)[a] - cloud.point(j)[a], 2);
  return std::sqrt(sum);
}

// the candidates of row i within the support, in their order
std::vector<int> expected_columns(const PointSet &cloud, const Kernel &kernel, int i)
{
  std::vector<int> columns;
  for (int j : cloud.candidates(i)) {
    const double r = distance(cloud, i, j);
    if (r > 0.0 && r < kernel.support()) columns.push_back(j);
  }
  return columns;
}

void expect_same(const Stencil &s, const PointSet &cloud, const Kernel &kernel)
{
  ASSERT_EQ(s.rows(), cloud.owned());
  ASSERT_EQ(s.dim(), kernel.dim());
  EXPECT_EQ(s.begin(0), 0);
  EXPECT_EQ(s.end(s.rows() - 1), s.pairs());
  for (int i = 0; i < s.rows(); i++) {
    const std::vector<int> columns = expected_columns(cloud, kernel, i);
    ASSERT_EQ(s.end(i) - s.begin(i), static_cast<int>(columns.size())) << "row " << i;
    EXPECT_EQ(s.ptr()[i], s.begin(i));
    for (std::size_t m = 0; m < columns.size(); m++) {
      const int k = s.begin(i) + static_cast<int>(m), j = columns[m];
      const double r = distance(cloud, i, j);
      ASSERT_EQ(s.col()[k], j);
      EXPECT_NEAR(s.r()[k], r, 4e-16 * r);    // two roundings
      EXPECT_DOUBLE_EQ(s.dw()[k], kernel.dw(s.r()[k]));
      for (int a = 0; a < s.dim(); a++)
        EXPECT_NEAR(s.e(a)[k], (cloud.point(i)[a] - cloud.point(j)[a]) / r, 1e-15);
    }
  }
}

Stencil build(const Kernel &kernel, const PointSet &cloud)
{
  Stencil s;
  s.build(kernel, cloud.owned(), cloud.x(), cloud.list());
  return s;
}

}    // namespace

TEST(Stencil, EmptyBeforeBuild)
{
  const Stencil s;
  EXPECT_EQ(s.rows(), 0);
  EXPECT_EQ(s.pairs(), 0);
}

TEST(Stencil, AgreesWithBruteForce)
{
  const double d = 0.1;
  for (int dim : {2, 3})
    for (unsigned seed : {0u, 1u, 2u}) {
      Points points = lattice(dim, dim == 2 ? 6 : 3, d);
      jitter(points, dim, 0.2 * d, 7 + seed);
      const Kernel kernel(KernelType::CUBIC_SPLINE, dim, 1.2 * d);
      // about half of the points are ghosts; the skin is 0.3 d
      const int owned = static_cast<int>(points.size()) / 2;
      const PointSet cloud(points, owned, kernel.support() + 0.3 * d, seed);
      const Stencil s = build(kernel, cloud);
      expect_same(s, cloud, kernel);
      EXPECT_EQ(s.coincident(), 0);
      EXPECT_GT(*std::max_element(s.col(), s.col() + s.pairs()), owned) << "no ghost was met";
    }
}

TEST(Stencil, CandidatesBeyondTheSupportDoNotMatter)
{
  const double d = 0.1;
  Points points = lattice(3, 3, d);
  jitter(points, 3, 0.2 * d, 3);
  const Kernel kernel(KernelType::WENDLAND_C2, 3, 1.2 * d);
  const PointSet tight(points, 50, kernel.support()), wide(points, 50, 2.0 * kernel.support());
  const Stencil s = build(kernel, tight), t = build(kernel, wide);
  ASSERT_EQ(s.pairs(), t.pairs());
  for (int k = 0; k < s.pairs(); k++) EXPECT_EQ(s.col()[k], t.col()[k]);
}

TEST(Stencil, PairAtTheSupportIsOutside)
{
  const Kernel kernel(KernelType::CUBIC_SPLINE, 2, 1.0);    // support 2, exactly representable
  const Points points = {
      {0.0, 0.0, 0.0}, {2.0, 0.0, 0.0}, {0.0, std::nextafter(2.0, 0.0), 0.0}, {-2.5, 0.0, 0.0}};
  const PointSet cloud(points, 1, 3.0);
  const Stencil s = build(kernel, cloud);
  ASSERT_EQ(s.pairs(), 1);
  EXPECT_EQ(s.col()[0], 2);
}

TEST(Stencil, CoincidentPairsAreLeftOutAndCounted)
{
  const double d = 0.1;
  for (int dim : {2, 3}) {
    Points points = lattice(dim, 2, d);
    const int n = static_cast<int>(points.size());
    points.insert(points.begin() + n, points[0]);    // owned, on top of particle 0
    points.push_back(points[3]);                     // ghost, on top of particle 3
    const Kernel kernel(KernelType::CUBIC_SPLINE, dim, 1.2 * d);
    const PointSet cloud(points, n + 1, 1.5 * kernel.support(), 5);
    const Stencil s = build(kernel, cloud);
    EXPECT_EQ(s.coincident(), 3);    // rows 0 and n meet each other, row 3 meets the ghost
    expect_same(s, cloud, kernel);
    for (int k = 0; k < s.pairs(); k++) EXPECT_GT(s.r()[k], 0.0);
  }
}

TEST(Stencil, PlaneProblemsIgnoreZ)
{
  Points points = lattice(2, 3, 1.0);
  const Kernel kernel(KernelType::CUBIC_SPLINE, 2, 1.2);
  const PointSet flat(points, 10, 10.0);
  for (std::size_t j = 0; j < points.size(); j++) points[j][2] = 0.1 * (j % 7);
  const PointSet bent(points, 10, 10.0);
  const Stencil s = build(kernel, flat), t = build(kernel, bent);
  ASSERT_EQ(s.pairs(), t.pairs());
  for (int k = 0; k < s.pairs(); k++) EXPECT_EQ(s.r()[k], t.r()[k]);
}

TEST(Stencil, RowsWithoutNeighbours)
{
  const Points points = {{0.0, 0.0, 0.0}, {10.0, 0.0, 0.0}, {10.5, 0.0, 0.0}, {0.0, 20.0, 0.0}};
  const Kernel kernel(KernelType::CUBIC_SPLINE, 3, 1.0);
  const PointSet cloud(points, 4, 100.0);
  const Stencil s = build(kernel, cloud);
  expect_same(s, cloud, kernel);
  EXPECT_EQ(s.pairs(), 2);
}

TEST(Stencil, CanBeRebuilt)
{
  const double d = 0.1;
  Stencil s;
  for (int dim : {3, 2, 3})
    for (int n : {3, 1, 2}) {
      const Kernel kernel(KernelType::QUINTIC_SPLINE, dim, 1.2 * d);
      const Points points = lattice(dim, n, d);
      const PointSet cloud(points, static_cast<int>(points.size()), kernel.support());
      s.build(kernel, cloud.owned(), cloud.x(), cloud.list());
      expect_same(s, cloud, kernel);
    }
}

// the memory of the last build may be too small, too large, or fit
TEST(Stencil, ADifferentCloudInTheSameMemory)
{
  const Kernel kernel(KernelType::CUBIC_SPLINE, 2, 1.2);
  Points jittered = lattice(2, 4, 1.0);
  jitter(jittered, 2, 0.1, 5);
  Stencil s;
  for (const Points &points :
       {lattice(2, 3, 1.0), lattice(2, 6, 1.0), jittered, lattice(2, 1, 1.0)}) {
    const int n = static_cast<int>(points.size());
    const PointSet cloud(points, n, 3.0);
    s.build(kernel, n, cloud.x(), cloud.list());
    expect_same(s, cloud, kernel);
  }
}

TEST(Stencil, ColumnsOfPeriodicImagesAreThoseOfTheParticle)
{
  const Kernel kernel(KernelType::CUBIC_SPLINE, 2, 1.2);
  const Points points = lattice(2, 3, 1.0);
  const int n = static_cast<int>(points.size()), owned = 20;
  const PointSet cloud(points, owned, 3.0);
  std::vector<int> canonical(n);
  for (int j = 0; j < n; j++) canonical[j] = j < owned ? j : j % owned;
  CandidateList list = cloud.list();
  list.canonical = canonical.data();
  Stencil plain, folded;
  plain.build(kernel, owned, cloud.x(), cloud.list());
  folded.build(kernel, owned, cloud.x(), list);
  ASSERT_EQ(folded.pairs(), plain.pairs());
  for (int k = 0; k < plain.pairs(); k++) {
    EXPECT_EQ(folded.col()[k], canonical[plain.col()[k]]);
    EXPECT_EQ(folded.e(1)[k], plain.e(1)[k]);
  }
}

TEST(Stencil, NoParticles)
{
  Stencil s;
  s.build(Kernel(KernelType::CUBIC_SPLINE, 3, 1.0), 0, nullptr, {nullptr, nullptr, PointSet::MASK});
  EXPECT_EQ(s.rows(), 0);
  EXPECT_EQ(s.pairs(), 0);
}

TEST(Stencil, BytesCoverTheArrays)
{
  const Points points = lattice(3, 3, 1.0);
  const Kernel kernel(KernelType::CUBIC_SPLINE, 3, 1.2);
  const PointSet cloud(points, 100, kernel.support());
  const Stencil s = build(kernel, cloud);
  // per pair an int and five doubles (r, dw, e), per row an int; the arrays are made to fit and
  // do not grow by doubling
  const double needed = 44.0 * s.pairs() + 4.0 * (s.rows() + 1);
  EXPECT_GE(s.bytes(), needed);
  EXPECT_LT(s.bytes(), 1.1 * needed);
}
