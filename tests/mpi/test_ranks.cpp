// SPDX-License-Identifier: GPL-2.0-only
// Reductions and halo exchange of particle fields; each rank has ghosts of the next one

#include "aleisph_mpi_ranks.h"

#include <gtest/gtest.h>

using namespace aleisph;

namespace {

struct World {
  int rank, size;
  World()
  {
    MPI_Comm_rank(MPI_COMM_WORLD, &rank);
    MPI_Comm_size(MPI_COMM_WORLD, &size);
  }
  int next() const { return (rank + 1) % size; }
};

constexpr int OWNED = 3;

// two ghosts: particle 2 and particle 0 of the next rank
void plan_ring(Ranks &ranks, const World &world)
{
  ranks.plan(OWNED, {{world.next(), 2}, {world.next(), 0}});
}

}    // namespace

TEST(Ranks, Reductions)
{
  const World world;
  Timers timers;
  Ranks ranks(MPI_COMM_WORLD, timers);
  const int n = world.size;
  EXPECT_EQ(ranks.sum(static_cast<long>(world.rank + 1)), n * (n + 1) / 2);
  EXPECT_EQ(ranks.total(0.5), 0.5 * n);
  EXPECT_EQ(ranks.max(-1.0 * world.rank), 0.0);
  EXPECT_EQ(ranks.min(-1.0 * world.rank), 1.0 - n);
  EXPECT_TRUE(ranks.any(world.rank == n - 1));
  EXPECT_FALSE(ranks.any(false));
  // IDs beyond 32 bits
  const long long big = 5000000000LL;
  EXPECT_EQ(ranks.largest(world.rank == 0 ? big : 7), big);
  long long tags[] = {world.rank, -world.rank};
  ranks.largest(2, tags);
  EXPECT_EQ(tags[0], n - 1);
  EXPECT_EQ(tags[1], 0);
  double values[] = {1.0, 2.0};
  ranks.sum(2, values);
  EXPECT_EQ(values[1], 2.0 * n);
  EXPECT_EQ(ranks.traffic().reductions, 9);
}

TEST(Ranks, FieldsAreExchangedAndValid)
{
  const World world;
  Timers timers;
  Ranks ranks(MPI_COMM_WORLD, timers);
  plan_ring(ranks, world);
  for (const int width : {3, 1}) {
    std::vector<double> data(width * (OWNED + 2), -1.0);
    for (int k = 0; k < width * OWNED; k++) data[k] = 100.0 * world.rank + k;
    bool valid = false;
    const Field field(data.data(), width, valid);
    ranks.forward(field);
    EXPECT_TRUE(valid);
    for (int c = 0; c < width; c++) {
      EXPECT_EQ(field.all()[width * OWNED + c], 100.0 * world.next() + 2 * width + c);
      EXPECT_EQ(field.all()[width * (OWNED + 1) + c], 100.0 * world.next() + c);
    }
  }
  EXPECT_EQ(ranks.traffic().exchanges, 2);
  // what comes from this very rank is no message: two entries of 3 + 1 doubles
  EXPECT_EQ(ranks.traffic().messages, world.size > 1 ? 2 : 0);
  EXPECT_EQ(ranks.traffic().bytes, world.size > 1 ? 8.0 * 2 * (3 + 1) : 0.0);
}

TEST(Ranks, RolesOfGhosts)
{
  const World world;
  Timers timers;
  Ranks ranks(MPI_COMM_WORLD, timers);
  plan_ring(ranks, world);
  Cloud cloud(Kernel(KernelType::CUBIC_SPLINE, 2, 1.2), 1.0, timers);
  cloud.reset(OWNED, OWNED + 2);
  cloud.role()[2] = FLUID | SURFACE;
  cloud.role()[0] = world.rank % 2 ? WALL : WALL | DRY;
  ranks.forward_roles(cloud);
  EXPECT_EQ(cloud.role()[OWNED], FLUID | SURFACE);
  EXPECT_EQ(cloud.role()[OWNED + 1], world.next() % 2 ? WALL : WALL | DRY);
}
