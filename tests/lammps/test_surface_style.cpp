// SPDX-License-Identifier: GPL-2.0-only
/* ----------------------------------------------------------------------
   fix aleisph/surface: tanks at rest, pressure outside, dry walls, ballistic
   particles, a rotating patch.
------------------------------------------------------------------------- */

#include "aleisph_kernel.h"
#include "atom.h"
#include "errors.h"

#include <algorithm>
#include <cmath>

namespace {

constexpr double PI = 3.14159265358979323846;
// of p/(rho g H), as in test_hydrostatics.cpp: the scaled right hand side is of order rho g d, the
// solver leaves 1e-13 of it, and |A^-1| is at most (2 H/(pi d))^2, 40 for H/d = 10
constexpr double TOLERANCE = 1.0e-11, DT = 0.01;

int cells(int dimension)
{
  return dimension == 2 ? 10 : 6;
}

// rho = g = H = 1
Script tank_script(const Scene &scene)
{
  Script script = free_script(scene);
  const char *down = scene.dimension == 2 ? "0 -1 0" : "0 0 -1";
  script.body = fmt::format("fix g all gravity 1.0 vector {}", down);
  script.ppe = "fix ppe all aleisph/ppe tol 1e-13";
  script.timestep = fmt::format("timestep {}", DT);
  return script;
}

Script dam_script(const Scene &scene)
{
  Script script = tank_script(scene);
  script.shift = "fix shift fluid aleisph/shift density velocity 2.0";
  script.timestep = "timestep 0.005";
  return script;
}

double largest_speed(const Simulation &sim)
{
  return std::max({largest(sim.v(0)), largest(sim.v(1)), largest(sim.v(2))});
}

// max |p - (p0 + level - z)| over fluid
double pressure_error(const Simulation &sim, int dimension, double level, double p0 = 0.0)
{
  const auto p = sim.pressure(), z = sim.x(dimension - 1), type = sim.type();
  double worst = 0.0;
  for (std::size_t i = 0; i < p.size(); i++)
    if (type[i] == Scene::FLUID) worst = std::max(worst, std::fabs(p[i] - (p0 + level - z[i])));
  return worst;
}

std::vector<double> report(const Simulation &sim)
{
  std::vector<double> all;
  for (int k = 1; k <= 5; k++) all.push_back(sim.fix("surf", k));
  return all;
}

}    // namespace

/* ----------------------------------------------------------------------
   Tank at rest
------------------------------------------------------------------------- */

// On a lattice normals, gradients and all rows of the pressure equation are exact, and there is
// nothing to shift: particles stay where they are. The steps add up rounding, about 1e-16 each.
TEST(OpenTank, StaysAtRest)
{
  for (const int dimension : {2, 3}) {
    SCOPED_TRACE(dimension);
    const int n = cells(dimension), steps = dimension == 2 ? 300 : 100;
    const Scene scene = open_tank(dimension, n);
    Simulation sim(scene);
    sim.run(tank_script(scene).text() + "run 0");
    const auto start = sim.x(0), top = sim.x(dimension - 1);
    sim.run(fmt::format("run {}", steps));
    EXPECT_LE(largest_speed(sim), 1e-12);
    EXPECT_LE(largest(sim.x(0), start), 1e-12);
    EXPECT_LE(largest(sim.x(dimension - 1), top), 1e-12);
    EXPECT_LE(pressure_error(sim, dimension, 1.0 + 0.5 / n), TOLERANCE);
    EXPECT_EQ(sim.fix("ppe", 7), 0.0);    // the level of the pressure is known
    EXPECT_EQ(sim.fix("shift", 3), 0.0);
  }
}

// The surface is half a spacing above its particles, or on them
TEST(OpenTank, LevelOfTheSurface)
{
  for (const int dimension : {2, 3})
    for (const bool half : {true, false}) {
      SCOPED_TRACE(fmt::format("{}d {}", dimension, half));
      const int n = cells(dimension);
      const Scene scene = open_tank(dimension, n);
      Script script = tank_script(scene);
      script.surface += half ? " row half" : " row centre";
      for (const int steps : {0, 5}) {
        Simulation sim(scene);
        sim.run(script.text() + fmt::format("run {}", steps));
        EXPECT_LE(pressure_error(sim, dimension, half ? 1.0 + 0.5 / n : 1.0), TOLERANCE);
        EXPECT_LE(largest_speed(sim), 1e-12);
      }
    }
}

// particles of the top layer; three layers of wall above it; no clamped inverse
TEST(OpenTank, Counts)
{
  for (const int dimension : {2, 3})
    for (const int above : {0, 1, 3}) {
      SCOPED_TRACE(fmt::format("{}d, {} above", dimension, above));
      const int n = cells(dimension);
      const double top = dimension == 2 ? n - 1 : (n - 1) * (n - 1);
      const double layer = dimension == 2 ? 2 : 4 * n;
      const Scene scene = open_tank(dimension, n, above);
      Simulation sim(scene);
      sim.run(tank_script(scene).text() + "run 2");
      EXPECT_EQ(report(sim), (std::vector<double>{top, 0, layer * above, 0, top}));
      EXPECT_EQ(sim.fix("sph", 6), 0.0);    // no singular row
      EXPECT_EQ(sim.fix("sph", 2), static_cast<double>(scene.x.size()) - layer * above - top * n);
    }
}

// All walls stay wet. Those above the fluid have no neighbours but walls, and rows p = 0.
TEST(OpenTank, NoDryWalls)
{
  const Scene scene = open_tank(2, 10);
  Simulation sim(scene);
  Script script = tank_script(scene);
  script.surface += " dry no";
  sim.run(script.text() + "run 1");
  EXPECT_EQ(sim.fix("surf", 3), 0.0);
  EXPECT_EQ(sim.fix("sph", 2), 37.0);
}

// The pressure outside is added to all of the fluid and moves nothing
TEST(OpenTank, PressureOutside)
{
  for (const char *row : {"half", "centre"})
    for (const double p0 : {50.0, -3.0}) {
      SCOPED_TRACE(fmt::format("{} {}", row, p0));
      const Scene scene = open_tank(2, 10);
      Script script = tank_script(scene);
      script.surface += fmt::format(" row {} pressure {}", row, p0);
      Simulation sim(scene);
      sim.run(script.text() + "run 10");
      const double level = 1.0 + (*row == 'h' ? 0.05 : 0.0);
      EXPECT_LE(pressure_error(sim, 2, level, p0), TOLERANCE * std::fabs(p0));
      EXPECT_LE(largest_speed(sim), TOLERANCE * std::fabs(p0) * DT / scene.d);
    }
}

// Pure strain, u = x, w = -y: at rows in the middle of a side, whose normals are exact, the pressure is
// 2 mu N.(grad v).N, +2 mu on the right and -2 mu above. The gradient is exact for a linear field, and
// row centre prescribes p at the particle: rounding of mu and the coordinates remains.
TEST(Patch, ViscousStressOnTheSurface)
{
  const Scene scene = patch(11);
  for (const char *viscous : {"", " viscous no"}) {
    SCOPED_TRACE(viscous);
    Script script = free_script(scene);
    script.surface += std::string(" row centre") + viscous;
    script.predictor += " nu 0.25";
    script.timestep = "timestep 1e-4\nvariable u atom x\nvariable w atom -y\n"
                      "velocity all set v_u v_w 0";
    Simulation sim(scene);
    sim.run(script.text() + "run 0");
    const auto x = sim.x(0), y = sim.x(1), p = sim.pressure();
    const double right = *std::max_element(x.begin(), x.end()),
                 middle = 0.5 * (right + *std::min_element(x.begin(), x.end()));
    const double mu = 0.25 * scene.rho0, expected = *viscous ? 0.0 : 2.0 * mu;
    int found = 0;
    for (std::size_t i = 0; i < x.size(); i++) {
      const bool beside = x[i] == right && std::fabs(y[i] - middle) < 1e-12;
      const bool above = y[i] == right && std::fabs(x[i] - middle) < 1e-12;
      if (beside || above) {
        EXPECT_NEAR(p[i], beside ? expected : -expected, 1e-12 * mu);
        found++;
      }
    }
    EXPECT_EQ(found, 2);
  }
}

// Nor does it in a flow, where walls at the edge of the fluid lose their rows. Differences between
// the two runs are the solver's: 1e-13 of 50, for 60 steps, on a flow that does not amplify them.
TEST(Dam, PressureOutside)
{
  const Scene scene = dam(8);
  Simulation none(scene), high(scene);
  Script script = dam_script(scene);
  none.run(script.text());
  script.surface += " pressure 50";
  high.run(script.text());
  double singular = 0.0;
  for (int k = 0; k < 30; k++) {
    none.run("run 2 post no");
    high.run("run 2 post no");
    singular += none.fix("sph", 6);
  }
  EXPECT_GT(singular, 0.0);    // or nothing has been tested
  for (int a = 0; a < 2; a++) EXPECT_LE(largest(none.v(a), high.v(a)), 1e-8);
}

// What aleisph/pressure prescribes comes first: here the true values on half of the surface
TEST(OpenTank, PrescribedPressureOnTheSurface)
{
  const Scene scene = open_tank(2, 10);
  Script script = tank_script(scene);
  script.pressure = "region c block INF 0.55 0.95 INF INF INF\ngroup c region c\n"
                    "group left intersect c fluid\nvariable p atom 1.05-y\n"
                    "fix p left aleisph/pressure v_p";
  Simulation sim(scene);
  sim.run(script.text() + "run 5");
  EXPECT_EQ(sim.fix("surf", 1), 9.0);
  EXPECT_EQ(sim.fix("surf", 5), 4.0);
  EXPECT_EQ(sim.fix("sph", 3), 5.0);
  EXPECT_LE(pressure_error(sim, 2, 1.05), TOLERANCE);
}

// A jittered surface makes waves. Those of amplitude 0.2 d with the shortest length that particles
// have, 2 d, move the fluid with 0.2 d sqrt(g pi/d). All of the energy is in the initial state.
TEST(OpenTank, JitteredIsBounded)
{
  for (const int dimension : {2, 3}) {
    SCOPED_TRACE(dimension);
    const int n = cells(dimension);
    const Scene scene = open_tank(dimension, n).jitter(0.2);
    const double bound = 0.2 / n * std::sqrt(PI * n);
    Simulation sim(scene);
    sim.run(tank_script(scene).text());
    for (int k = 0; k < 5; k++) {
      sim.run("run 30");
      EXPECT_LE(largest_speed(sim), bound);
      EXPECT_EQ(sim.fix("surf", 1), dimension == 2 ? n - 1 : (n - 1) * (n - 1));
      EXPECT_EQ(sim.fix("surf", 2), 0.0);
      for (const double z : sim.x(dimension - 1)) EXPECT_LE(z, scene.high[dimension - 1]);
    }
  }
}

/* ----------------------------------------------------------------------
   compute aleisph/atom surface rho nx ny nz
------------------------------------------------------------------------- */

// rho: over the neighbours within 1.1 sqrt(D) d, in 2d eight. At the top three are missing, one at
// d and two at sqrt(2) d; fluid next to a wall has all of them.
TEST(OpenTank, Compute)
{
  const int n = 10;
  const double d = 1.0 / n;
  const Scene scene = open_tank(2, n);
  Simulation sim(scene);
  sim.run(tank_script(scene).text() +
          "compute c all aleisph/atom surface rho nx ny nz lambda\nrun 1");
  const aleisph::Kernel kernel(aleisph::KernelType::CUBIC_SPLINE, 2, 1.2 * d);
  const double w0 = kernel.w(0.0), w1 = kernel.w(d), w2 = kernel.w(std::sqrt(2.0) * d);
  const double flat = (w0 + 3.0 * w1 + 2.0 * w2) / (w0 + 4.0 * w1 + 4.0 * w2);
  const auto kind = sim.compute("c", 1), rho = sim.compute("c", 2), nx = sim.compute("c", 3),
             ny = sim.compute("c", 4), x = sim.x(0), y = sim.x(1);
  for (std::size_t i = 0; i < x.size(); i++) {
    SCOPED_TRACE(fmt::format("{} {}", x[i], y[i]));
    const bool wall = scene.type[i] == Scene::WALL, top = !wall && y[i] > 1.0 - 0.5 * d;
    double expected = top ? 1.0 : 0.0;
    if (y[i] > 1.0 + 0.5 * d) expected = 3.0;
    EXPECT_EQ(kind[i], expected);
    if (wall) {
      EXPECT_EQ(rho[i], 0.0);
      continue;
    }
    EXPECT_NEAR(rho[i], top ? flat : 1.0, 1e-12);
    EXPECT_NEAR(nx[i], 0.0, 1e-12);
    EXPECT_NEAR(ny[i], top ? 1.0 : 0.0, 1e-12);
  }
}

/* ----------------------------------------------------------------------
   Dam break
------------------------------------------------------------------------- */

// Walls with fluid within 1.2 d are wet, those without any within 1.5 d (times sqrt 2 in a corner)
// are dry; between them it depends on where the fluid lies.
TEST(Dam, DryWallsAreThoseWithoutFluid)
{
  const Scene scene = dam(8);
  const double d = scene.d;
  Simulation sim(scene);
  sim.run(dam_script(scene).text() + "compute c all aleisph/atom surface\n");
  std::array<double, 3> start;    // dry floor, dry walls left and right
  for (const int steps : {0, 60, 60, 60}) {
    sim.run(fmt::format("run {}", steps));
    const auto x = sim.x(0), y = sim.x(1), kind = sim.compute("c", 1);
    std::array<double, 3> dry = {};
    for (std::size_t i = 0; i < x.size(); i++) {
      if (kind[i] == 3.0) dry[y[i] < 0.5 * d ? 0 : x[i] < 0.5 * d ? 1 : 2]++;
      if (scene.type[i] != Scene::WALL) {
        EXPECT_NE(kind[i], 3.0);
        continue;
      }
      double nearest = 1e9;
      for (std::size_t j = 0; j < x.size(); j++)
        if (scene.type[j] == Scene::FLUID)
          nearest = std::min(nearest, std::hypot(x[i] - x[j], y[i] - y[j]));
      const bool corner = y[i] < 0.5 * d && (x[i] < 0.5 * d || x[i] > 4.0 - 0.5 * d);
      if (nearest < 1.2 * d) {
        EXPECT_NE(kind[i], 3.0) << x[i] << " " << y[i];
      }
      if (nearest > 1.5 * d * (corner ? std::sqrt(2.0) : 1.0)) {
        EXPECT_EQ(kind[i], 3.0) << x[i] << " " << y[i];
      }
    }
    EXPECT_EQ(sim.fix("surf", 3), dry[0] + dry[1] + dry[2]);
    if (steps == 0) {
      // floor 9..32, left wall 17..24, right wall 1..24
      EXPECT_EQ(dry, (std::array<double, 3>{24, 8, 24}));
      start = dry;
    } else if (sim.variable("step") == 180.0) {
      // fluid has come to 1/2 of the floor at least, and gone from the wall
      EXPECT_LE(dry[0], start[0] - 4);
      EXPECT_GE(dry[1], start[1] + 1);
      EXPECT_EQ(dry[2], start[2]);
    }
  }
}

// The front is held by nothing but its pressure equation
TEST(Dam, NobodyIsLost)
{
  const Scene scene = dam(10);
  Simulation sim(scene);
  sim.run(dam_script(scene).text());
  for (int k = 0; k < 10; k++) {
    sim.run("run 10");
    const auto x = sim.x(0), y = sim.x(1), type = sim.type();
    double lowest = 1e9, leftmost = 1e9;
    for (std::size_t i = 0; i < x.size(); i++) {
      if (type[i] != Scene::FLUID) continue;
      lowest = std::min(lowest, y[i]);
      leftmost = std::min(leftmost, x[i]);
    }
    EXPECT_GE(lowest, 0.5 * scene.d);
    EXPECT_GE(leftmost, 0.5 * scene.d);
    // no faster than a fall from the top of the fluid, sqrt(2 g H)
    EXPECT_LE(largest_speed(sim), 2.0);
    EXPECT_EQ(sim.fix("sph", 1), 200.0);
  }
  const auto y = sim.x(1), type = sim.type();
  double top = 0.0;
  for (std::size_t i = 0; i < y.size(); i++)
    if (type[i] == Scene::FLUID) top = std::max(top, y[i]);
  EXPECT_LT(top, 2.0);    // it has sunk
}

/* ----------------------------------------------------------------------
   Ballistic particles
------------------------------------------------------------------------- */

namespace {

// the exact parabola
double thrown(double x0, double v0, double g, int n)
{
  return x0 + n * DT * v0 + 0.5 * n * n * DT * DT * g;
}

Scene block_and_single(int dimension)
{
  Scene scene = patch(6);
  scene.d = 0.125;
  if (dimension == 3) {
    scene.dimension = 3;
    scene.boundary = "f f f";
    scene.low[2] = -1.5;
    scene.high[2] = 1.5;
  }
  scene.type.clear();
  scene.x.clear();
  for (int k = 0; k < (dimension == 3 ? 4 : 1); k++)
    for (int j = 0; j < 4; j++)
      for (int i = 0; i < 4; i++)
        scene.add(Scene::FLUID, scene.d * i, scene.d * j, dimension == 3 ? scene.d * k : 0.0);
  scene.add(Scene::FLUID, -1.0, 0.5, dimension == 3 ? -0.3 : 0.0);
  return scene;
}

}    // namespace

TEST(Ballistic, Parabola)
{
  for (const int dimension : {2, 3}) {
    SCOPED_TRACE(dimension);
    const Scene scene = block_and_single(dimension);
    const int id = static_cast<int>(scene.x.size());
    Simulation sim(scene);
    Script script = tank_script(scene);
    script.body = "fix g all gravity 1.0 vector 0 -1 0";
    sim.run(script.text() + fmt::format("set atom {} vx 1.5 vy 0.5\nrun 60", id));
    EXPECT_NEAR(sim.x(0)[id - 1], thrown(-1.0, 1.5, 0.0, 60), 1e-12);
    EXPECT_NEAR(sim.x(1)[id - 1], thrown(0.5, 0.5, -1.0, 60), 1e-12);
    EXPECT_EQ(sim.fix("surf", 2), 1.0);
    // the block falls as well, whatever its shape: without walls gravity makes no pressure
    const auto w = sim.v(1);
    for (int i = 0; i < id - 1; i++) EXPECT_NEAR(w[i], -0.6, 1e-10);
  }
}

// Particles with at most D neighbours are ballistic: pairs, threes; a square of four is not
TEST(Ballistic, Counts)
{
  Scene scene = patch(4);
  scene.d = 0.1;
  scene.x.clear();
  scene.type.clear();
  for (const auto &at : {std::array<double, 2>{0, 0}, {1, 0}, {1, 1}, {0, 1}})
    scene.add(Scene::FLUID, scene.d * at[0], scene.d * at[1]);
  const auto count = [&scene]() {
    Simulation sim(scene);
    sim.run(tank_script(scene).text() + "compute c all aleisph/atom surface\nrun 1");
    const auto kind = sim.compute("c", 1);
    EXPECT_EQ(std::count(kind.begin(), kind.end(), 2.0), sim.fix("surf", 2));
    EXPECT_EQ(sim.fix("surf", 1), static_cast<double>(scene.x.size()));
    return sim.fix("surf", 2);
  };
  EXPECT_EQ(count(), 0.0);
  for (int k = 0; k < 3; k++) {    // a row of three, more than a support away
    scene.add(Scene::FLUID, 0.6 + 0.1 * k, 0.0);
    EXPECT_EQ(count(), k + 1.0);
  }
  scene.add(Scene::FLUID, 0.7, 0.1);    // all have three neighbours now
  EXPECT_EQ(count(), 0.0);
}

// Next to a rotating patch, whose pressure is not zero on its corner, one neighbour away
TEST(Ballistic, FeelsNoPressure)
{
  Scene scene = patch(10);
  const double corner = 0.5 - 0.5 * scene.d;
  scene.add(Scene::FLUID, corner + 1.6 * scene.d, corner + 1.6 * scene.d);
  Script script = free_script(scene);
  script.timestep = "timestep 0.001\nvariable u atom -y\nvariable w atom x\n"
                    "velocity all set v_u v_w 0\nset atom 101 vx 0.25 vy -0.125";
  Simulation sim(scene);
  sim.run(script.text() + "run 5");
  EXPECT_EQ(sim.fix("surf", 2), 1.0);
  EXPECT_GT(std::fabs(sim.pressure()[99]), 1e-3);
  EXPECT_EQ(sim.v(0)[100], 0.25);
  EXPECT_EQ(sim.v(1)[100], -0.125);
}

/* ----------------------------------------------------------------------
   Rotating square patch
------------------------------------------------------------------------- */

// p in the centre at t = 0: lap p = 2 rho omega^2, p = 0 on the sides of the square (Le Touze et
// al., Int. J. Numer. Meth. Fluids 73 (2013) 660), as a double sine series
static double patch_centre(double rho, double omega, double L)
{
  double sum = 0.0;
  for (int m = 1; m < 400; m += 2)
    for (int n = 1; n < 400; n += 2) {
      const double wave = (m * m + n * n) * PI * PI / (L * L);
      sum -= 32.0 * rho * omega * omega / (m * n * PI * PI) / wave * std::sin(0.5 * m * PI) *
          std::sin(0.5 * n * PI);
    }
  return sum;
}

// The rows have the surface on the sides of the square, so that the error is of second order
TEST(Patch, PressureInTheCentre)
{
  const double exact = patch_centre(1.0, 1.0, 1.0);
  const auto error = [exact](int n) {
    const Scene scene = patch(n);
    Script script = free_script(scene);
    script.timestep = "timestep 0.001\nvariable u atom -y\nvariable w atom x\n"
                      "velocity all set v_u v_w 0";
    Simulation sim(scene);
    sim.run(script.text() + "run 0");
    EXPECT_EQ(sim.fix("surf", 1), 4.0 * (n - 1));
    const auto p = sim.pressure();
    const int middle = n / 2 * n + n / 2;
    return std::fabs(p[middle] / exact - 1.0);
  };
  const double coarse = error(11), fine = error(31);
  EXPECT_LE(coarse, std::pow(PI / 11.0, 2));
  EXPECT_LE(fine, coarse / 5.0);    // (31/11)^2 = 7.9
}

/* ----------------------------------------------------------------------
   Costs, and runs that go on
------------------------------------------------------------------------- */

// Stencil, gradient, pressure matrix, preconditioner and Laplacian: once a step, and once for the
// set-up, as without a surface
TEST(Surface, BuildsOnceAStep)
{
  const Scene scene = open_tank(2, 8);
  Simulation sim(scene);
  Script script = tank_script(scene);
  script.ppe += " reuse no";
  sim.run(script.text() +
          "compute c all aleisph/atom surface rho nx ux\ncompute r all reduce max c_c[*]\n"
          "thermo_style custom step f_surf[*] f_shift[*] c_r[*]\nthermo 1\nrun 20");
  for (int k = 7; k <= 11; k++) EXPECT_EQ(sim.fix("sph", k), 21.0);
}

// without these fixes there is no time spent on them
TEST(Surface, CostsNothingElsewhere)
{
  const auto parts_of = [](const Script &script) {
    Simulation sim(small_channel());
    sim.run(script.text() + "run 5\nfix_modify sph report now");
    return sim.log();
  };
  Script script = small_script();
  const std::string without = parts_of(script);
  EXPECT_NE(without.find("ALEISPH time"), std::string::npos);
  for (const char *part : {"  surface ", "  shift "})
    EXPECT_EQ(without.find(part), std::string::npos) << part;
  script.surface = "fix surf fluid aleisph/surface";
  script.predictor += " frame ale";
  script.shift = "fix shift fluid aleisph/shift density velocity 1.0";
  const std::string with = parts_of(script);
  for (const char *part : {"  surface ", "  shift "})
    EXPECT_NE(with.find(part), std::string::npos) << part;
}

// A fluid without surface keeps its closed pressure with the fix
TEST(Surface, NoneInAChannel)
{
  Simulation with(small_channel()), without(small_channel());
  Script script = small_script();
  script.timestep += "\nvariable u atom sin(PI*x)*(1-y^2)\nvelocity fluid set v_u 0 0";
  without.run(script.text() + "run 5");
  script.surface = "fix surf fluid aleisph/surface floor 0";
  with.run(script.text() + "run 5");
  EXPECT_EQ(report(with), std::vector<double>(5, 0.0));
  EXPECT_EQ(with.fix("ppe", 7), 1.0);
  EXPECT_LE(largest(with.v(0), without.v(0)), 1e-10);
}

// taken away between runs: a closed fluid again
TEST(Surface, ChangesBetweenRuns)
{
  const Scene scene = open_tank(2, 8, 0);
  Simulation sim(scene);
  Script script = tank_script(scene);
  sim.run(script.text() + "run 2");
  EXPECT_LE(pressure_error(sim, 2, 1.0625), TOLERANCE);
  sim.run("unfix surf\nfix surf fluid aleisph/surface row centre\n");
  EXPECT_NE(sim.error_of("run 1").find("must be defined before"), std::string::npos);
}

TEST(Surface, OutputBeforeTheFirstRun)
{
  const Scene scene = open_tank(2, 8);
  Simulation sim(scene);
  sim.run(tank_script(scene).text());
  for (int k = 1; k <= 6; k++) EXPECT_EQ(sim.fix("surf", k), 0.0);
  EXPECT_NE(sim.error_of("unfix sph\nprint \"$(f_surf[1])\"").find("needs a fix aleisph"),
            std::string::npos);
}

// A wave that rises at x = 0: at x = 1/4 the layer is stretched at the rate cos(pi/4), s = ln(2 a/d), in
// the first step by 3/2 of that (Adams-Bashforth without a step before). It stays through run 0 and
// the end of a run.
TEST(Surface, LayerFollowsTheFlow)
{
  const Scene scene = open_tank(2, 8);
  const auto stretch = [&scene](const std::string &words, int steps) {
    Simulation sim(scene);
    Script script = tank_script(scene);
    script.surface = "fix surf fluid aleisph/surface " + words;
    script.timestep = "timestep 0.005\n"
                      "variable e atom exp(PI*y)\n"
                      "variable u atom -sin(PI*x)*(v_e+1/v_e)/(PI*(exp(PI)+exp(-PI)))\n"
                      "variable w atom cos(PI*x)*(v_e-1/v_e)/(PI*(exp(PI)+exp(-PI)))\n"
                      "velocity fluid set v_u v_w 0";
    sim.run(script.text() + fmt::format("run {}\nrun 0", steps));
    sim.run("variable s atom d2_aleisph_s[1]*(abs(x-0.25)<0.01)\n"
            "compute s fluid reduce max v_s\nrun 0");
    return sim.variable("c_s");
  };
  const double rate = 0.005 * std::cos(M_PI / 4.0);    // per step
  EXPECT_EQ(stretch("", 0), 0.0);
  constexpr double ONE_SIDED = 0.2;    // error of the gradient on a surface: k d/2, d = 1/8
  EXPECT_NEAR(stretch("", 4), 4.5 * rate, ONE_SIDED * 4.5 * rate);
  EXPECT_NEAR(stretch("layer follow", 8), 8.5 * rate, ONE_SIDED * 8.5 * rate);
}

/* ----------------------------------------------------------------------
   Errors
------------------------------------------------------------------------- */

TEST(SurfaceErrors, Command)
{
  const auto line = [](const std::string &words) {
    return [words](Script &s) { s.surface = "fix surf fluid aleisph/surface " + words; };
  };
  const auto range = [&](const std::string &key, const std::string &value, const std::string &low,
                         const std::string &high) {
    return ErrorCase{
        key + " " + value,
        line(key + " " + value),
        {"ix aleisph/surface", key + " must lie between " + low + " and " + high, "not " + value}};
  };
  expect_errors({
      {"keyword", line("colour red"), {"ix aleisph/surface", "unknown keyword colour"}},
      {"value missing", line("row"), {"fix aleisph/surface row", "issing"}},
      {"row", line("row full"), {"ix aleisph/surface", "row must be half or centre", "full"}},
      {"layer", line("layer yes"), {"ix aleisph/surface", "layer must be follow or fixed", "yes"}},
      {"word", line("lambda much"), {"much"}},
      {"nan", line("lambda nan"), {"nan"}},
      {"pressure", line("pressure 1e999"), {"1e999", "out of range"}},
      {"pressure word", line("pressure high"), {"high"}},
      range("lambda", "-0.1", "0", "1"),
      range("lambda", "1.1", "0", "1"),
      range("angle", "19", "20", "90"),
      range("angle", "91", "20", "90"),
      range("reach", "0.9", "1", "3"),
      range("reach", "3.1", "1", "3"),
      range("floor", "-0.1", "0", "0.5"),
      range("floor", "0.6", "0", "0.5"),
      range("dry", "0.9", "1", "2"),
      range("dry", "2.1", "1", "2"),
  });
}

TEST(SurfaceErrors, Setup)
{
  const std::string surface = "\nfix surf fluid aleisph/surface";
  expect_errors({
      {"no owner",
       [&](Script &s) { s = Script{}, s.surface = "fix surf fluid aleisph/surface"; },
       {"ix aleisph/surface needs a fix aleisph", "defined before"}},
      {"two",
       [&](Script &s) { s.surface = surface.substr(1) + "\nfix s2 fluid aleisph/surface"; },
       {"ix aleisph/surface: there must be only one"}},
      {"group",
       [](Script &s) { s.surface = "fix surf all aleisph/surface"; },
       {"ix aleisph/surface: group must be that of fix pred, fluid"}},
      {"after predictor",
       [&](Script &s) { s.predictor += surface; },
       {"surf (aleisph/surface)", "must be defined before", "pred (aleisph/predictor)"}},
      {"before wall",
       [&](Script &s) { s.owner += surface; },
       {"wall (aleisph/wall)", "must be defined before", "surf (aleisph/surface)"}},
  });
}
