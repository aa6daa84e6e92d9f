// SPDX-License-Identifier: GPL-2.0-only
/* ----------------------------------------------------------------------
   The direct halo exchange: by itself with ghosts of all kinds, and beside
   LAMMPS' own in simulations.
------------------------------------------------------------------------- */

#include "aleisph_halo_owner.h"
#include "aleisph_mpi_halo.h"
#include "atom.h"
#include "comm.h"
#include "script.h"
#include "simulation.h"

#include <gtest/gtest.h>

#include <map>
#include <random>
#include <set>

using aleisph::HaloExchange;
using namespace LAMMPS_NS;

namespace {

constexpr double STALE = -1.0;

struct World {
  int rank, size;
  World()
  {
    MPI_Comm_rank(MPI_COMM_WORLD, &rank);
    MPI_Comm_size(MPI_COMM_WORLD, &size);
  }
};

// rank 0 owns nothing if there are others
int owned(const World &world, int rank)
{
  return world.size == 1 ? 5 : 7 * rank;
}

double value(const HaloExchange::Owner &o)
{
  return 1000.0 * o.rank + o.index;
}

std::vector<HaloExchange::Owner> random_ghosts(const World &world, int n, unsigned seed)
{
  std::mt19937 random(seed + 17 * world.rank);
  std::vector<HaloExchange::Owner> owner;
  while (static_cast<int>(owner.size()) < n) {
    const int rank = static_cast<int>(random() % world.size);
    if (const int there = owned(world, rank))
      owner.push_back({rank, static_cast<int>(random() % there)});
  }
  return owner;
}

// ncomp values per particle; component c of an owner is value() + 1e6 c
void expect_exchange(HaloExchange &halo, const World &world,
                     const std::vector<HaloExchange::Owner> &owner, int ncomp)
{
  const int nlocal = owned(world, world.rank), nghost = static_cast<int>(owner.size());
  const auto expected = [](const HaloExchange::Owner &o, int c) { return value(o) + 1.0e6 * c; };
  std::vector<double> x;
  for (int i = 0; i < nlocal; i++)
    for (int c = 0; c < ncomp; c++) x.push_back(expected({world.rank, i}, c));
  x.resize(ncomp * (nlocal + owner.size()), STALE);
  ASSERT_EQ(halo.columns(), nlocal + nghost);
  halo.start(x.data(), ncomp);
  for (int g = 0; g < nghost; g++) {
    EXPECT_EQ(halo.remote()[g] != 0, owner[g].rank != world.rank);
    for (int c = 0; c < ncomp; c++)
      EXPECT_EQ(x[ncomp * (nlocal + g) + c], halo.remote()[g] ? STALE : expected(owner[g], c));
  }
  halo.finish(x.data(), ncomp);
  for (int g = 0; g < nghost; g++)
    for (int c = 0; c < ncomp; c++) EXPECT_EQ(x[ncomp * (nlocal + g) + c], expected(owner[g], c));
}

void expect_canonical(const HaloExchange &halo, const World &world,
                      const std::vector<HaloExchange::Owner> &owner)
{
  const int nlocal = owned(world, world.rank);
  std::map<double, int> first;
  for (int i = 0; i < nlocal; i++) {
    EXPECT_EQ(halo.canonical()[i], i);
    first[value({world.rank, i})] = i;
  }
  for (std::size_t g = 0; g < owner.size(); g++) {
    const int index = nlocal + static_cast<int>(g);
    EXPECT_EQ(halo.canonical()[index], first.emplace(value(owner[g]), index).first->second);
  }
}

}    // namespace

// also none at all, on some ranks or on all
TEST(Halo, RandomGhosts)
{
  const World world;
  HaloExchange halo(MPI_COMM_WORLD);
  for (unsigned round = 0; round < 30; round++) {
    const int n = round % 3 == 0 ? 0 : round % 3 == 1 ? 40 : 9 * world.rank;
    const auto owner = random_ghosts(world, n, 100 * round);
    halo.build(owned(world, world.rank), owner);
    for (const int ncomp : {1, 3, 1, 9}) expect_exchange(halo, world, owner, ncomp);
    expect_canonical(halo, world, owner);

    std::set<int> ranks;
    std::set<double> entries;
    for (const auto &o : owner)
      if (o.rank != world.rank) {
        ranks.insert(o.rank);
        entries.insert(value(o));
      }
    EXPECT_EQ(halo.messages(), static_cast<int>(ranks.size()));
    EXPECT_EQ(halo.message_bytes(), 8.0 * entries.size());
  }
}

namespace {

// a wave of particles, so that they migrate and lists are built anew
void expect_lammps_halo(const Scene &scene, const std::string &more)
{
  Simulation sim(scene);
  sim.run(more + script_of(scene).text() +
          "timestep 0.01\nvariable u atom 1+sin(2*PI*y)\nvelocity fluid set v_u 0 0\nrun 12");
  LAMMPS &lmp = sim.lammps();
  FixAleisph *fix = FixAleisph::find(&lmp, "test");
  const int nlocal = lmp.atom->nlocal, nall = fix->cloud().size();
  aleisph::Ranks &ranks = fix->ranks();
  ASSERT_EQ(ranks.halo().columns(), nall);

  // what a ghost must have is told by its atom ID, which LAMMPS gives it
  const auto expected = [&lmp](int i, int c) {
    return std::sin(3.0 * static_cast<double>(lmp.atom->tag[i]) + c);
  };
  for (const int ncomp : {1, 3, 2, 9}) {
    std::vector<double> field(ncomp * nall, STALE);
    for (int i = 0; i < nlocal; i++)
      for (int c = 0; c < ncomp; c++) field[ncomp * i + c] = expected(i, c);
    ranks.forward(field.data(), ncomp);
    for (int i = 0; i < nall; i++)
      for (int c = 0; c < ncomp; c++) ASSERT_EQ(field[ncomp * i + c], expected(i, c));
  }

  for (int i = 0; i < nall; i++)
    EXPECT_EQ(lmp.atom->tag[ranks.halo().canonical()[i]], lmp.atom->tag[i]);
  // the rows that wait are those with columns of other ranks, and only these
  const auto &s = fix->cloud().stencil();
  const auto &split = ranks.split(s.rows(), s.ptr(), s.col(), fix->cloud().version());
  EXPECT_EQ(split.interior.rows() + split.boundary.rows(), nlocal);
  if (sim.ranks() == 1) {
    EXPECT_EQ(split.boundary.rows(), 0);
    EXPECT_EQ(ranks.halo().messages(), 0);
  }
}

}    // namespace

TEST(Halo, AgreesWithLammps)
{
  {
    SCOPED_TRACE("periodic, 2d");
    expect_lammps_halo(periodic_square(10), "");
  }
  {
    SCOPED_TRACE("ghosts beyond the neighbouring rank, images of images");
    expect_lammps_halo(periodic_square(8), "comm_modify cutoff 1.2\n");
  }
  {
    SCOPED_TRACE("tiled");
    expect_lammps_halo(periodic_square(12), "comm_style tiled\nbalance 1.0 rcb\n");
  }
  {
    SCOPED_TRACE("walls, 3d");
    expect_lammps_halo(tank(3, 6), "");
  }
  {
    SCOPED_TRACE("a rank without particles");
    Scene scene = patch(8);
    scene.low[0] = -30.0;
    expect_lammps_halo(scene, "");
  }
}

namespace {

// the numbers of the line "ALEISPH communication per step: ..." of the last report
std::vector<double> traffic(Simulation &sim)
{
  sim.run("fix_modify sph report now");
  const std::string log = sim.log(), head = "ALEISPH communication per step: ";
  const auto line = log.rfind(head);
  if (line == std::string::npos) return {};
  std::vector<double> numbers(4, -1.0);
  std::sscanf(log.c_str() + line + head.size(),
              "%lf reductions, %lf halo exchanges, %lf messages, %lf bytes per rank", &numbers[0],
              &numbers[1], &numbers[2], &numbers[3]);
  return numbers;
}

}    // namespace

TEST(Halo, ReportOfCommunication)
{
  const Scene scene = periodic_square(12);
  Simulation sim(scene);
  sim.run(script_of(scene).text() +
          "timestep 0.002\nthermo 1000\nvariable u atom sin(2*PI*y)*cos(2*PI*x)\n"
          "variable w atom sin(2*PI*x)\nvelocity fluid set v_u v_w 0\nrun 1");
  const double before = sim.fix("ppe", 9);
  sim.run("run 10 pre no");
  const double iterations = (sim.fix("ppe", 9) - before) / 10.0;
  const auto numbers = traffic(sim);
  ASSERT_EQ(numbers.size(), 4u);
  EXPECT_GT(iterations, 3.0);
  // two an iteration; the rest: right-hand side, residuals, rounding level, roles, the like
  EXPECT_GE(numbers[0], 2.0 * iterations);
  EXPECT_LE(numbers[0], 2.0 * iterations + 16.0);
  // two products an iteration, two residuals
  EXPECT_GE(numbers[1], 2.0 * iterations + 2.0);
  EXPECT_LE(numbers[1], 2.0 * iterations + 12.0);
  if (sim.ranks() == 1) {
    EXPECT_EQ(numbers[2], 0.0);
    EXPECT_EQ(numbers[3], 0.0);
  } else {
    EXPECT_GE(numbers[2], 2.0 * iterations);
    EXPECT_GE(numbers[3], 8.0 * 12 * numbers[2]);
  }
}
