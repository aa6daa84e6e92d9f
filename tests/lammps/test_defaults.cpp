// SPDX-License-Identifier: GPL-2.0-only
/* ----------------------------------------------------------------------
   What fix aleisph sets in LAMMPS where the script has not: masses, skin,
   sorting. What the script says counts.
------------------------------------------------------------------------- */

#include "atom.h"
#include "neighbor.h"
#include "script.h"
#include "simulation.h"

#include <gtest/gtest.h>

#include <cmath>

namespace {

constexpr double D = 0.02;    // spacing

// 3 x 3 particles of type 1, one of type 2, without mass and neighbor settings
std::string particles(const std::string &units)
{
  return fmt::format("units {}\ndimension 2\nboundary p p p\natom_style atomic\n"
                     "region box block 0 {} 0 {} {} {} units box\ncreate_box 2 box\n"
                     "lattice sq {}\ncreate_atoms 1 box\nset atom 1 type 2\n",
                     units, 3 * D, 3 * D, -0.5 * D, 0.5 * D, units == "lj" ? 1.0 / (D * D) : D);
}

std::string owner(const std::string &keywords = "")
{
  return fmt::format("fix sph all aleisph spacing {} rho0 3.0 {}\n", D, keywords);
}

double skin_after(const std::string &units, const std::string &before,
                  const std::string &after = "")
{
  Simulation sim;
  sim.run(particles(units) + before + owner() + after);
  return sim.lammps().neighbor->skin;
}

}    // namespace

TEST(Defaults, MassesThatAreNotSet)
{
  Simulation sim;
  sim.run(particles("si") + "mass 2 7.0\n" + owner());
  const LAMMPS_NS::Atom &atom = *sim.lammps().atom;
  EXPECT_DOUBLE_EQ(atom.mass[1], 3.0 * D * D);
  EXPECT_EQ(atom.mass[2], 7.0);
  sim.run("mass 1 2.0");    // afterwards, too
  EXPECT_EQ(atom.mass[1], 2.0);
}

TEST(Defaults, ARunNeedsNoMass)
{
  Simulation sim;
  sim.run(particles("si") + owner() +
          "fix pred all aleisph/predictor\nfix ppe all aleisph/ppe\nrun 1");
  EXPECT_EQ(sim.fix("sph", 1), 9.0);
}

// atom style sphere has a mass per atom, which the script must give
TEST(Defaults, MassPerAtomIsLeftAlone)
{
  Simulation sim;
  sim.run(
      "atom_style sphere\n" +
      particles("lj").replace(particles("lj").find("atom_style atomic"), 17, "atom_style sphere") +
      owner());
  EXPECT_EQ(sim.lammps().atom->mass, nullptr);
}

TEST(Defaults, SkinFollowsTheSpacing)
{
  // 0.3 in units lj, 0.001 in units si: 15 and 0.05 spacings
  EXPECT_DOUBLE_EQ(skin_after("lj", ""), 0.5 * D);
  EXPECT_DOUBLE_EQ(skin_after("si", ""), 0.5 * D);
  EXPECT_DOUBLE_EQ(skin_after("cgs", ""), 0.5 * D);
}

TEST(Defaults, SkinOfTheScript)
{
  EXPECT_DOUBLE_EQ(skin_after("si", "neighbor 0.004 bin\n"), 0.004);
  EXPECT_DOUBLE_EQ(skin_after("si", "", "neighbor 0.001 bin\n"), 0.001);
  EXPECT_DOUBLE_EQ(skin_after("lj", "neighbor 0.4 bin\n"), 0.4);
}

// LAMMPS' own is right where it is between 0.2 and 1 spacings
TEST(Defaults, SkinOfLammps)
{
  Simulation sim;
  sim.run("units lj\nregion box block 0 4 0 4 0 4\ncreate_box 1 box\n"
          "fix sph all aleisph spacing 1.0 rho0 1.0");
  EXPECT_EQ(sim.lammps().neighbor->skin, 0.3);
}

TEST(Defaults, Sorting)
{
  const auto bin = [](const std::string &before, const std::string &after) {
    Simulation sim;
    sim.run(particles("si") + before + owner() + after);
    return sim.lammps().atom->userbinsize;
  };
  EXPECT_DOUBLE_EQ(bin("", ""), 2.0 * D);
  EXPECT_EQ(bin("atom_modify sort 1000 0.5\n", ""), 0.5);
  EXPECT_EQ(bin("atom_modify sort 0 0.0\n", ""), 0.0);
  EXPECT_EQ(bin("", "atom_modify sort 1000 0.5\n"), 0.5);
}

TEST(Defaults, ParticlesAreSorted)
{
  Simulation sim;
  sim.run(particles("si") + owner() +
          "fix pred all aleisph/predictor\nfix ppe all aleisph/ppe\nrun 1");
  EXPECT_EQ(sim.log().find("sorting therefore disabled"), std::string::npos);
  EXPECT_GT(sim.lammps().atom->sortfreq, 0);
}
