// SPDX-License-Identifier: GPL-2.0-only
/* ----------------------------------------------------------------------
   compute aleisph/atom against loops over all pairs, written here.
------------------------------------------------------------------------- */

#include "aleisph_kernel.h"
#include "script.h"
#include "simulation.h"

#include <gtest/gtest.h>

#include <cmath>

namespace {

// M = sum V gradW (x) r_ji and sum V (v_j - v_i) (x) gradW of one particle in 2d, no periodicity
struct Moments {
  double m[2][2] = {}, vw[2][2] = {};
  int neighbors = 0;
};

Moments moments(const Simulation &sim, double d, std::size_t i)
{
  const aleisph::Kernel kernel(aleisph::KernelType::CUBIC_SPLINE, 2, 1.2 * d);
  const std::vector<double> x[2] = {sim.x(0), sim.x(1)}, v[2] = {sim.v(0), sim.v(1)};
  Moments sum;
  for (std::size_t j = 0; j < x[0].size(); j++) {
    const double dx[2] = {x[0][i] - x[0][j], x[1][i] - x[1][j]};
    const double r = std::hypot(dx[0], dx[1]);
    if (i == j || r >= kernel.support()) continue;
    sum.neighbors++;
    for (int a = 0; a < 2; a++) {
      const double weight = d * d * kernel.dw(r) * dx[a] / r;
      for (int b = 0; b < 2; b++) {
        sum.m[a][b] -= weight * dx[b];
        sum.vw[a][b] += weight * (v[b][j] - v[b][i]);
      }
    }
  }
  return sum;
}

double smallest_eigenvalue(const double m[2][2])
{
  const double half_trace = 0.5 * (m[0][0] + m[1][1]), half_gap = 0.5 * (m[0][0] - m[1][1]);
  return half_trace - std::sqrt(half_gap * half_gap + m[0][1] * m[1][0]);
}

// div v = sum V (v_j - v_i).(M^-1 gradW)
double divergence(const Moments &s)
{
  const double det = s.m[0][0] * s.m[1][1] - s.m[0][1] * s.m[1][0];
  const double inverse[2][2] = {{s.m[1][1] / det, -s.m[0][1] / det},
                                {-s.m[1][0] / det, s.m[0][0] / det}};
  double sum = 0.0;
  for (int a = 0; a < 2; a++)
    for (int b = 0; b < 2; b++) sum += inverse[a][b] * s.vw[b][a];
  return sum;
}

}    // namespace

// fluid and wall rows of a jittered tank, in motion
TEST(ComputeAtom, AgainstPairLoops)
{
  const Scene scene = tank(2, 8).jitter(0.2);
  Simulation sim(scene);
  sim.run(script_of(scene).text() +
          "timestep 0.01\n"
          "variable u atom sin(PI*x)*y\nvariable w atom x*y^2\nvelocity fluid set v_u v_w 0\n"
          "compute c all aleisph/atom divv lambda nneigh row\nrun 0");
  const auto type = sim.type(), divv = sim.compute("c", 1), lambda = sim.compute("c", 2);
  const auto neighbors = sim.compute("c", 3), row = sim.compute("c", 4);
  for (std::size_t i = 0; i < type.size(); i++) {
    SCOPED_TRACE(fmt::format("atom {}", i + 1));
    const Moments expected = moments(sim, scene.d, i);
    const bool wall = type[i] == Scene::WALL;
    EXPECT_EQ(neighbors[i], expected.neighbors);
    EXPECT_NEAR(lambda[i], smallest_eigenvalue(expected.m), 1e-12);
    EXPECT_NEAR(divv[i], wall ? 0.0 : divergence(expected), 1e-11);
    EXPECT_EQ(row[i], wall ? 2.0 : 1.0);
  }
}

// 20 neighbors within 2.4 d on the square lattice, 56 on the cubic one
TEST(ComputeAtom, NeighborsOnTheLattice)
{
  const Scene square = periodic_square(8);
  Simulation sim(square);
  sim.run(script_of(square).text() + "compute c all aleisph/atom nneigh\nrun 0");
  for (const double n : sim.compute("c", 1)) EXPECT_EQ(n, 20.0);
  EXPECT_EQ(sim.fix("sph", 13), 20.0);

  const Scene cube = tank(3, 6);
  Simulation sim3(cube);
  sim3.run(script_of(cube).text() + "compute c all aleisph/atom nneigh\nrun 0");
  EXPECT_EQ(sim3.compute("c", 1)[3 * 49 + 3 * 7 + 3], 56.0);    // in the middle
}

TEST(ComputeAtom, PressureIsTheStoredOne)
{
  const Scene scene = tank(2, 8).jitter(0.2);
  Simulation sim(scene);
  Script script = script_of(scene);
  script.body = "fix g all gravity 1.0 vector 0 -1 0";
  sim.run(script.text() +
          "timestep 0.01\ncompute c all aleisph/atom p\n"
          "compute cf fluid aleisph/atom p lambda\nrun 2");
  EXPECT_GT(largest(sim.pressure()), 0.1);
  EXPECT_EQ(sim.compute("c", 1), sim.pressure());

  // outside of the group: zero
  const auto type = sim.type(), p = sim.compute("cf", 1), lambda = sim.compute("cf", 2);
  for (std::size_t i = 0; i < type.size(); i++) {
    EXPECT_EQ(p[i], type[i] == Scene::FLUID ? sim.pressure()[i] : 0.0);
    EXPECT_EQ(lambda[i] > 0.0, type[i] == Scene::FLUID);
  }
}

// faces, edges and corners: the normalised sum of the face normals
TEST(ComputeAtom, NormalsOfABox)
{
  for (const int dimension : {2, 3}) {
    const Scene scene = tank(dimension, 6).jitter(0.2);
    Simulation sim(scene);
    sim.run(script_of(scene).text() + "compute c all aleisph/atom nx ny nz\nrun 0");
    const std::vector<double> n[3] = {sim.compute("c", 1), sim.compute("c", 2),
                                      sim.compute("c", 3)};
    const auto type = sim.type();
    for (std::size_t i = 0; i < type.size(); i++) {
      SCOPED_TRACE(fmt::format("{}d, atom {}", dimension, i + 1));
      double expected[3] = {}, square = 0.0;
      for (int a = 0; a < dimension && type[i] == Scene::WALL; a++) {
        const double x = scene.x[i][a];
        expected[a] = x < 1e-9 ? 1.0 : x > 1.0 - 1e-9 ? -1.0 : 0.0;
        square += expected[a] * expected[a];
      }
      for (int a = 0; a < 3; a++)
        EXPECT_NEAR(n[a][i], square > 0.0 ? expected[a] / std::sqrt(square) : 0.0, 1e-12);
    }
  }
}

TEST(ComputeAtom, Rows)
{
  const Scene scene = tank(2, 6);
  Simulation sim(scene);
  Script script = script_of(scene);
  script.pressure =
      "group some id 9 22 25\nfix p some aleisph/pressure 0.0";    // 22 is a wall particle
  sim.run(script.text() + "compute c all aleisph/atom row\nrun 0");
  const auto row = sim.compute("c", 1), type = sim.type();
  for (std::size_t i = 0; i < row.size(); i++) {
    const bool prescribed = i == 8 || i == 21 || i == 24;
    EXPECT_EQ(row[i], prescribed ? 3.0 : type[i] == Scene::WALL ? 2.0 : 1.0);
  }
  EXPECT_EQ(sim.fix("sph", 3), 3.0);
}

// A wall particle with a single fluid particle in its support: its row is singular, and counted
TEST(ComputeAtom, SingularRow)
{
  Scene scene = periodic_square(10);
  scene.boundary = "p f p";
  scene.low[1] = -1.0;
  scene.high[1] = 2.0;
  for (int i = 0; i < 10; i++)    // lower wall; the upper side is open
    scene.add(Scene::WALL, (i + 0.5) * scene.d, -0.5 * scene.d);
  // far away at the open side, one fluid particle within 2.4 d
  scene.add(Scene::WALL, 0.5 * scene.d, 0.95 + 2.35 * scene.d);
  Simulation sim(scene);
  Script script = script_of(scene);
  script.pressure = "group top id 91:100\nfix p top aleisph/pressure 0.0";
  sim.run(script.text() + "compute c all aleisph/atom row p lambda\nrun 0");
  EXPECT_EQ(sim.fix("sph", 6), 1.0);
  EXPECT_EQ(sim.compute("c", 1).back(), 4.0);
  EXPECT_EQ(sim.compute("c", 2).back(), 0.0);
}

// The condition number: of order one on the lattice, the same all over, larger where it is
// one-sided, zero on walls, which have no Laplacian
TEST(ComputeAtom, Condition)
{
  const Scene scene = tank(2, 8);
  Simulation sim(scene);
  sim.run(script_of(scene).text() + "compute c all aleisph/atom cond\nrun 0");
  const auto cond = sim.compute("c", 1), type = sim.type();
  for (std::size_t i = 0; i < cond.size(); i++) {
    if (type[i] == Scene::WALL)
      EXPECT_EQ(cond[i], 0.0);
    else {
      EXPECT_GE(cond[i], 1.0);
      EXPECT_LE(cond[i], 200.0);    // beyond it the row would be replaced
    }
  }
  EXPECT_EQ(sim.fix("sph", 5), 0.0);
}

// largest |div v| is what fix aleisph/ppe reports
TEST(ComputeAtom, DivergenceAgreesWithTheSolver)
{
  const Scene scene = channel(5, 10).jitter(0.1);
  Simulation sim(scene);
  sim.run(script_of(scene).text() +
          "timestep 0.01\nvariable u atom sin(PI*x)*(1-y^2)\n"
          "velocity fluid set v_u 0 0\ncompute c all aleisph/atom divv\nrun 3");
  EXPECT_GT(sim.fix("ppe", 3), 0.0);
  EXPECT_EQ(sim.fix("ppe", 3), largest(sim.compute("c", 1)));
}

// No value is made up before there is a stencil
TEST(ComputeAtom, BeforeAnyRun)
{
  const Scene scene = tank(2, 6);
  Simulation sim(scene);
  sim.run(script_of(scene).text() + "compute c all aleisph/atom lambda");
  EXPECT_NE(sim.error_of("write_dump all custom " + scratch_file("early.dump") + " id c_c"), "");
}
