// SPDX-License-Identifier: GPL-2.0-only
// Rows by role, weights built on demand and kept, and timers that add up.

#include "aleisph_cloud.h"

#include <algorithm>
#include <array>
#include <gtest/gtest.h>

namespace {

using namespace aleisph;

// a 5 x 5 lattice of unit spacing; everybody is everybody's candidate
class Patch {
 public:
  Patch()
  {
    for (int k = 0; k < N; k++) points_[k] = {1.0 * (k % 5), 1.0 * (k / 5), 0.0};
    for (int k = 0; k < N; k++) {
      x_[k] = points_[k].data();
      for (int j = 0; j < N; j++)
        if (j != k) lists_[k].push_back(j);
      count_[k] = N - 1;
      first_[k] = lists_[k].data();
    }
    role.fill(FLUID);
  }
  void update(Cloud &cloud) const
  {
    cloud.reset(N, N);
    std::copy(role.begin(), role.end(), cloud.role());
    cloud.update(x_.data(), {count_.data(), first_.data(), ~0});
  }

  static constexpr int N = 25;
  std::array<Role, N> role;

 private:
  std::array<std::array<double, 3>, N> points_;
  std::array<const double *, N> x_;
  std::array<std::vector<int>, N> lists_;
  std::array<int, N> count_;
  std::array<const int *, N> first_;
};

TEST(Cloud, SortsRowsByRole)
{
  Timers timers;
  Cloud cloud(Kernel(KernelType::CUBIC_SPLINE, 2, 1.2), 1.0, timers);
  Patch patch;
  patch.role[0] = WALL | DIRICHLET;
  patch.role[1] = FLUID | BUFFER | DIRICHLET;
  patch.role[2] = FLUID | DIRICHLET;
  patch.update(cloud);
  EXPECT_EQ(cloud.wall(), Rows({0}));
  EXPECT_EQ(cloud.buffer(), Rows({1}));
  EXPECT_EQ(cloud.fluid().size(), 23u);
  EXPECT_EQ(cloud.fluid().front(), 2);
  EXPECT_EQ(cloud.all().size(), 25u);
}

TEST(Cloud, BuildsOnceAndOnlyWhatIsAskedFor)
{
  Timers timers;
  Cloud cloud(Kernel(KernelType::CUBIC_SPLINE, 2, 1.2), 1.0, timers);
  const Patch patch;
  patch.update(cloud);
  EXPECT_EQ(cloud.counts().stencil, 1);
  EXPECT_EQ(cloud.counts().gradient, 0);
  cloud.laplacian();    // needs the gradient
  cloud.laplacian();
  cloud.gradient();
  EXPECT_EQ(cloud.counts().gradient, 1);
  EXPECT_EQ(cloud.counts().laplacian, 1);
  patch.update(cloud);
  cloud.gradient();
  EXPECT_EQ(cloud.counts().stencil, 2);
  EXPECT_EQ(cloud.counts().gradient, 2);
  EXPECT_EQ(cloud.counts().laplacian, 1);
  EXPECT_GT(cloud.bytes(), 0.0);
}

// The matrix may take the memory of the weights; who asks for them later gets the same ones.
TEST(Cloud, LaplacianWeightsAreCopiedOrGivenAway)
{
  Timers timers;
  Cloud cloud(Kernel(KernelType::CUBIC_SPLINE, 2, 1.2), 1.0, timers);
  const Patch patch;
  patch.update(cloud);
  std::vector<double> copy, taken;
  cloud.laplacian_weights(true, copy);
  ASSERT_EQ(static_cast<int>(copy.size()), cloud.stencil().pairs());
  for (int k = 0; k < cloud.stencil().pairs(); k++) EXPECT_EQ(copy[k], cloud.laplacian().a()[k]);
  EXPECT_EQ(cloud.counts().laplacian, 1);

  cloud.laplacian_weights(false, taken);
  EXPECT_EQ(taken, copy);
  const double diagonal = cloud.laplacian_rows().diagonal(12);
  EXPECT_LT(diagonal, 0.0);
  EXPECT_EQ(cloud.counts().laplacian, 1);
  for (int k = 0; k < cloud.stencil().pairs(); k++) EXPECT_EQ(copy[k], cloud.laplacian().a()[k]);
  EXPECT_EQ(cloud.counts().laplacian, 2);

  patch.update(cloud);
  const double *const memory = taken.data();
  cloud.laplacian_weights(false, taken);
  EXPECT_EQ(taken, copy);
  patch.update(cloud);
  cloud.laplacian_weights(false, taken);
  EXPECT_EQ(taken.data(), memory) << "not built in the memory given";
}

TEST(Cloud, RolesSeenAreThoseOfTheNeighbours)
{
  Timers timers;
  Cloud cloud(Kernel(KernelType::CUBIC_SPLINE, 2, 1.2), 1.0, timers);
  Patch patch;
  patch.role[0] = WALL;
  patch.update(cloud);
  const auto expect = [&] {
    const Stencil &s = cloud.stencil();
    for (int i = 0; i < Patch::N; i++) {
      Role expected = 0;
      for (int k = s.begin(i); k < s.end(i); k++) expected |= patch.role[s.col()[k]];
      for (Role wanted : {WALL, SURFACE, FLUID}) {
        EXPECT_EQ(cloud.neighbours().any(i, wanted), (expected & wanted) != 0) << i;
        EXPECT_EQ(SeenRoles(s, patch.role.data()).any(i, wanted), (expected & wanted) != 0);
      }
    }
  };
  expect();
  EXPECT_FALSE(cloud.neighbours().any(Patch::N - 1, WALL));
  patch.role[Patch::N - 1] |= SURFACE;
  cloud.role()[Patch::N - 1] |= SURFACE;
  cloud.roles_changed();
  expect();
}

TEST(Timers, InnerScopeIsNotCountedInTheOuterOne)
{
  using Clock = std::chrono::steady_clock;
  const auto wait = [](double seconds) {
    const auto start = Clock::now();
    while (std::chrono::duration<double>(Clock::now() - start).count() < seconds) {
    }
  };
  Timers timers;
  const auto start = Clock::now();
  {
    Timers::Scope solve(timers, Part::SOLVE);
    wait(0.02);
    {
      Timers::Scope comm(timers, Part::COMM);
      wait(0.03);
    }
    wait(0.01);
  }
  const double total = std::chrono::duration<double>(Clock::now() - start).count();
  // lower bounds are what was waited for, the upper one is the whole: no other clock is involved
  EXPECT_GE(timers.seconds(Part::SOLVE), 0.03);
  EXPECT_GE(timers.seconds(Part::COMM), 0.03);
  EXPECT_LE(timers.seconds(Part::SOLVE) + timers.seconds(Part::COMM), total);
  EXPECT_EQ(timers.seconds(Part::MOMENTUM), 0.0);
}

}    // namespace
