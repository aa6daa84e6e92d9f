// SPDX-License-Identifier: GPL-2.0-only
/* ----------------------------------------------------------------------
   fix aleisph/tension: drops at rest, what the pressure equation and the
   forces make of the curvature, contact angles, time step, and what it
   costs a scene that has it and one that has not.
------------------------------------------------------------------------- */

#include "aleisph_timestep.h"
#include "atom.h"
#include "comm.h"
#include "errors.h"
#include "fix_aleisph.h"
#include "neighbor.h"
#include "update.h"

#include <algorithm>
#include <cmath>
#include <numeric>

namespace {

constexpr double PI = 3.14159265358979323846;
constexpr double ROUNDING = 1.0e-13;    // relative, of a few dozen operations
// Pressures differ by what the solver leaves: 1e-12 of the scaled right hand side, times |A^-1|,
// which is at most (2 * 10 d/(pi d))^2 = 40
constexpr double SOLVER = 1.0e-10;
constexpr double D = 0.1, SIGMA = 0.5;

constexpr char FIELDS[] =
    "\ncompute k all aleisph/atom kappa ptension tnx tny tnz contact surface\n";
enum Column { KAPPA = 1, PTENSION, TNX, TNY, TNZ, CONTACT, KIND };

/* ----------------------------------------------------------------------
   Scenes
------------------------------------------------------------------------- */

Scene empty_box(int dimension, double half)
{
  Scene scene;
  scene.dimension = dimension;
  scene.d = D;
  scene.boundary = dimension == 2 ? "p p p" : "p p p";
  const double z = dimension == 2 ? 0.5 * D : half;
  scene.low = {-half, -half, -z};
  scene.high = {half, half, z};
  return scene;
}

// Rings of radius d, 2 d, ..., rings d about a point, spaced d along each. The disc ends half a
// spacing outside of the last one, and has the area of its particles up to rounding of their number.
Scene disc(int rings, double cx = 0.0)
{
  Scene scene = empty_box(2, (rings + 6) * D);
  const double half = scene.high[0];
  const auto put = [&](double x, double y) {
    scene.add(Scene::FLUID, x - 2.0 * half * std::floor((x + half) / (2.0 * half)), y);
  };
  put(cx, 0.0);
  for (int m = 1; m <= rings; m++) {
    const int n = static_cast<int>(std::lround(2.0 * PI * m));
    for (int k = 0; k < n; k++) {
      const double angle = 2.0 * PI * (k + 0.37 * m) / n;
      put(cx + m * D * std::cos(angle), m * D * std::sin(angle));
    }
  }
  return scene;
}

// The same with shells; on each a spiral with constant steps of the height
Scene ball(int shells)
{
  Scene scene = empty_box(3, (shells + 6) * D);
  scene.add(Scene::FLUID, 0.0, 0.0, 0.0);
  const double golden = PI * (3.0 - std::sqrt(5.0));
  for (int m = 1; m <= shells; m++) {
    const int n = static_cast<int>(std::lround(4.0 * PI * m * m));
    for (int k = 0; k < n; k++) {
      const double z = 1.0 - (2.0 * k + 1.0) / n, s = std::sqrt(1.0 - z * z), angle = golden * k;
      scene.add(Scene::FLUID, m * D * s * std::cos(angle), m * D * s * std::sin(angle), m * D * z);
    }
  }
  return scene;
}

double radius(int layers)
{
  return (layers + 0.5) * D;
}

/* ----------------------------------------------------------------------
   Scripts. Time steps are half of the capillary limit or less.
------------------------------------------------------------------------- */

double capillary(double sigma = SIGMA, double d = D, double rho = 1.0)
{
  return std::sqrt(rho * d * d * d / (2.0 * PI * sigma));
}

Script tension_script(const Scene &scene, const std::string &words = "")
{
  Script script = free_script(scene);
  script.surface += fmt::format("\nfix tens fluid aleisph/tension sigma {} {}", SIGMA, words);
  script.timestep = fmt::format("timestep {}", 0.4 * capillary(SIGMA, scene.d));
  return script;
}

std::vector<double> where(const std::vector<double> &values, const std::vector<double> &flag,
                          double wanted)
{
  std::vector<double> some;
  for (std::size_t i = 0; i < values.size(); i++)
    if (flag[i] == wanted) some.push_back(values[i]);
  return some;
}

double deviation(const std::vector<double> &values)
{
  double squares = 0.0;
  for (const double x : without_mean(values)) squares += x * x;
  return std::sqrt(squares / static_cast<double>(values.size()));
}

// open_tank(), in y as wide as it is long and periodic: walls without vertical edges, where the
// continuation of the fluid is not that of the lattice
Scene open_slab()
{
  const Scene tank = open_tank(2, 12);
  Scene scene = tank;
  scene.dimension = 3;
  scene.boundary = "f p f";
  scene.low = {tank.low[0], 0.0, tank.low[1]};
  scene.high = {tank.high[0], 6.0 * tank.d, tank.high[1]};
  scene.x.clear();
  scene.type.clear();
  for (int row = 0; row < 6; row++)
    for (std::size_t i = 0; i < tank.x.size(); i++)
      scene.add(static_cast<Scene::Type>(tank.type[i]), tank.x[i][0], (row + 0.5) * tank.d,
                tank.x[i][1]);
  return scene;
}

// everything that a set-up makes of a scene: K, p, N, contact flags, pressure
std::vector<double> fields(const Scene &scene, const std::string &script, MPI_Comm comm)
{
  Simulation sim(scene, comm);
  sim.run(script + FIELDS + "run 0");
  std::vector<double> all = sim.pressure();
  for (const int column : {KAPPA, PTENSION, TNX, TNY, TNZ, CONTACT}) {
    const auto field = sim.compute("k", column);
    all.insert(all.end(), field.begin(), field.end());
  }
  return all;
}

std::vector<double> fields(const Scene &scene, const std::string &script)
{
  return fields(scene, script, MPI_COMM_WORLD);
}

std::vector<double> report(const Simulation &sim)
{
  std::vector<double> all;
  for (int k = 1; k <= 8; k++) all.push_back(sim.fix("tens", k));
  return all;
}

}    // namespace

/* ----------------------------------------------------------------------
   Discs and balls at rest
------------------------------------------------------------------------- */

// The layer of surface particles is a circle. Where N is radial, each neighbour gives exactly 1/r,
// and the step to the surface 1/(r + d/2) = 1/R. N is radial but for the way in which particles of
// one ring lie beside those of the next: a tilt that varies along the ring with the period of the
// Moire pattern. What is asked for is a mean within 0.5 % and a scatter of at most 3 %.
TEST(Tension, Disc)
{
  for (const int rings : {6, 10, 15}) {
    SCOPED_TRACE(rings);
    const Scene scene = disc(rings);
    const double exact = 1.0 / radius(rings);
    Simulation sim(scene);
    sim.run(tension_script(scene).text() + FIELDS + "run 0");
    const auto kind = sim.compute("k", KIND), all = sim.compute("k", KAPPA),
               p = sim.compute("k", PTENSION), tnx = sim.compute("k", TNX),
               tny = sim.compute("k", TNY), x = sim.x(0), y = sim.x(1);
    const auto K = where(all, kind, 1.0);
    EXPECT_EQ(K.size(), std::lround(2.0 * PI * rings));
    EXPECT_NEAR(mean(K), exact, 0.005 * exact);
    EXPECT_LE(deviation(K), 0.03 * exact);
    EXPECT_EQ(largest(where(all, kind, 0.0)), 0.0);
    for (std::size_t i = 0; i < x.size(); i++) {
      EXPECT_NEAR(p[i], SIGMA * all[i], ROUNDING);
      if (kind[i] == 0.0) continue;
      const double r = std::hypot(x[i], y[i]);
      EXPECT_NEAR((tnx[i] * x[i] + tny[i] * y[i]) / r, 1.0, 0.002);    // 3.6 degrees
      EXPECT_NEAR(std::hypot(tnx[i], tny[i]), 1.0, ROUNDING);
    }
    EXPECT_EQ(largest(sim.compute("k", TNZ)), 0.0);
    EXPECT_EQ(largest(sim.compute("k", CONTACT)), 0.0);
  }
}

// On a spiral the number of neighbours varies by a few percent, and so does each sum
TEST(Tension, Ball)
{
  for (const int shells : {5, 7}) {
    SCOPED_TRACE(shells);
    const Scene scene = ball(shells);
    const double exact = 2.0 / radius(shells);
    Simulation sim(scene);
    sim.run(tension_script(scene).text() + FIELDS + "run 0");
    const auto K = where(sim.compute("k", KAPPA), sim.compute("k", KIND), 1.0);
    EXPECT_EQ(K.size(), std::lround(4.0 * PI * shells * shells));
    EXPECT_NEAR(mean(K), exact, 0.005 * exact);
    EXPECT_LE(deviation(K), 0.03 * exact);
  }
}

// sigma K inside, in either row: at rest the pressure has no gradient. It is a mean of the values on
// the surface, so its error is that of their mean.
TEST(Tension, LaplacePressure)
{
  for (const char *row : {"half", "centre"})
    for (const int dimension : {2, 3}) {
      SCOPED_TRACE(fmt::format("{} {}d", row, dimension));
      const int layers = dimension == 2 ? 10 : 5;
      const Scene scene = dimension == 2 ? disc(layers) : ball(layers);
      const double exact = SIGMA * (dimension - 1) / radius(layers);
      Script script = tension_script(scene);
      script.surface.insert(script.surface.find('\n'), fmt::format(" row {} pressure 3.0", row));
      Simulation sim(scene);
      sim.run(script.text() + FIELDS + "run 0");
      const auto p = sim.pressure(), kind = sim.compute("k", KIND);
      EXPECT_NEAR(mean(where(p, kind, 0.0)), 3.0 + exact, 0.005 * exact);
      for (const double value : p) EXPECT_NEAR(value, 3.0 + exact, 0.1 * exact);
    }
}

// A flat surface, and a fluid without any
TEST(Tension, NoneOnAFlatSurface)
{
  const Scene scene = open_tank(2, 12);
  Simulation sim(scene);
  sim.run(tension_script(scene).text() + FIELDS + "run 0");
  EXPECT_LE(largest(sim.compute("k", KAPPA)), 1e-10);
  EXPECT_LE(largest(sim.pressure()), 1e-10);

  const Scene closed = small_channel();
  Simulation none(closed);
  none.run(tension_script(closed).text() + FIELDS + "run 2");
  for (int column = KAPPA; column <= CONTACT; column++)
    EXPECT_EQ(largest(none.compute("k", column)), 0.0);
  EXPECT_EQ(report(none), std::vector<double>(8, 0.0));
}

// without the fix the fields are zero
TEST(Tension, FieldsWithoutTension)
{
  const Scene scene = disc(4);
  Simulation sim(scene);
  sim.run(free_script(scene).text() + "timestep 0.01" + FIELDS + "run 1");
  for (int column = KAPPA; column <= CONTACT; column++)
    EXPECT_EQ(largest(sim.compute("k", column)), 0.0);
}

// mean and largest |K|, surface particles, contact particles, few neighbours, unknown, limited,
// without normal
TEST(Tension, Report)
{
  const Scene scene = disc(6);
  Simulation sim(scene);
  sim.run(tension_script(scene).text() + FIELDS + "run 0");
  const auto K = where(sim.compute("k", KAPPA), sim.compute("k", KIND), 1.0);
  const auto told = report(sim);
  EXPECT_NEAR(told[0], mean(K), ROUNDING / D);
  EXPECT_EQ(told[1], largest(K));
  EXPECT_EQ(told[2], static_cast<double>(K.size()));
  for (int k = 3; k < 8; k++) EXPECT_EQ(told[k], 0.0) << k + 1;
}

// A drop of four has no curvature that means anything: K is bounded by 1/d, and this is counted.
// Each has three neighbours, so that it is not too few.
TEST(Tension, LimitIsCounted)
{
  Scene scene = empty_box(2, 1.0);
  for (const auto &at : {std::array<double, 2>{0, 0}, {1, 0}, {1, 1}, {0, 1}})
    scene.add(Scene::FLUID, D * at[0], D * at[1]);
  Simulation sim(scene);
  sim.run(tension_script(scene).text() + FIELDS + "run 0");
  const auto K = sim.compute("k", KAPPA);
  const auto told = report(sim);
  EXPECT_EQ(told[2], 4.0);
  for (const double k : K) EXPECT_LE(std::fabs(k), 1.0 / D * (1.0 + ROUNDING));
  EXPECT_EQ(told[6], static_cast<double>(std::count_if(K.begin(), K.end(), [](double k) {
              return std::fabs(k) >= 1.0 / D * (1.0 - ROUNDING);
            })));
}

// Ballistic particles have no tension
TEST(Tension, NotOnBallisticParticles)
{
  Scene scene = disc(5);
  scene.add(Scene::FLUID, radius(5) + 0.4, 0.0);
  Simulation sim(scene);
  sim.run(tension_script(scene).text() + "set atom " + std::to_string(scene.x.size()) + " vx 0.1" +
          FIELDS + "run 3");
  EXPECT_EQ(sim.compute("k", KIND).back(), 2.0);
  EXPECT_EQ(sim.compute("k", KAPPA).back(), 0.0);
  EXPECT_EQ(sim.v(0).back(), 0.1);
  EXPECT_EQ(sim.fix("tens", 3), sim.fix("surf", 1) - 1.0);
}

/* ----------------------------------------------------------------------
   Boundaries and ranks
------------------------------------------------------------------------- */

// Half on one side of the periodic boundary, half on the other. Sums are the same up to their order.
TEST(Tension, AcrossAPeriodicBoundary)
{
  const auto middle = fields(disc(6), tension_script(disc(6)).text());
  const Scene scene = disc(6, disc(6).high[0]);
  const auto split = fields(scene, tension_script(scene).text());
  EXPECT_GT(largest(middle), 0.5);
  EXPECT_LE(largest(split, middle), SOLVER);
}

// Each rank alone finds what all find together
TEST(Tension, RanksAgree)
{
  int ranks;
  MPI_Comm_size(MPI_COMM_WORLD, &ranks);
  if (ranks == 1) GTEST_SKIP() << "several ranks";
  for (const char *words : {"", "model published", "form both filter 0.5"})
    for (const int dimension : {2, 3}) {
      SCOPED_TRACE(fmt::format("{} {}d", words, dimension));
      const Scene scene = (dimension == 2 ? disc(6) : ball(4)).jitter(0.1);
      const std::string script = tension_script(scene, words).text();
      EXPECT_LE(largest(fields(scene, script), fields(scene, script, MPI_COMM_SELF)),
                SOLVER / D);    // of K, which is 1/d at most
    }
}

/* ----------------------------------------------------------------------
   Forms
------------------------------------------------------------------------- */

namespace {

std::vector<double> pressure_with(const Scene &scene, const std::string &words)
{
  Simulation sim(scene);
  sim.run(tension_script(scene, words).text() + "run 0");
  return sim.pressure();
}

}    // namespace

// f = -sigma K delta N per volume, and the pressure outside on the surface. Model published has
// kappa = K/(D - 1) in the force, and delta = 0.1/d; tangent has 1/d.
TEST(Tension, Force)
{
  for (const int dimension : {2, 3})
    for (const bool published : {false, true}) {
      SCOPED_TRACE(fmt::format("{}d {}", dimension, published));
      const Scene scene = dimension == 2 ? disc(6) : ball(4);
      const double volume = std::pow(D, dimension);
      const double factor = published ? 0.1 / (dimension - 1) : 1.0;
      Simulation sim(scene);
      sim.run(
          tension_script(scene, published ? "model published form force" : "form force").text() +
          FIELDS + "variable f atom fx\nvariable g atom fy\nvariable h atom fz\n" +
          "compute f all property/atom fx fy fz\nrun 0");
      const auto K = sim.compute("k", KAPPA);
      EXPECT_GT(mean(where(K, sim.compute("k", KIND), 1.0)), 0.0);
      EXPECT_EQ(largest(sim.compute("k", PTENSION)), 0.0);
      for (int a = 0; a < 3; a++) {
        auto expected = sim.compute("k", TNX + a);
        for (std::size_t i = 0; i < K.size(); i++)
          expected[i] *= -volume * SIGMA * K[i] * factor / D;
        EXPECT_LE(largest(sim.compute("f", a + 1), expected), ROUNDING * volume * SIGMA / D / D);
      }
    }
}

// The pressure equation is linear: both forms together give the sum of what each gives
TEST(Tension, FormsAddUp)
{
  for (const std::string model : {"", "model published "})
    for (const int dimension : {2, 3}) {
      SCOPED_TRACE(fmt::format("{}{}d", model, dimension));
      const Scene scene = dimension == 2 ? disc(8) : ball(4);
      const auto pressure = pressure_with(scene, model + "form pressure"),
                 force = pressure_with(scene, model + "form force"),
                 both = pressure_with(scene, model + "form both");
      std::vector<double> sum = pressure;
      for (std::size_t i = 0; i < sum.size(); i++) sum[i] += force[i];
      EXPECT_GT(mean(force), 0.0);
      EXPECT_LE(largest(both, sum), SOLVER * largest(sum));
      // tension once
      EXPECT_EQ(pressure_with(scene, model), model.empty() ? pressure : both);
    }
}

// As a force the tension acts within the layer of surface particles, so that the pressure rises
// to sigma K across it; half of it is lost at most, as the layer is as thin as the operators see.
TEST(Tension, ForceGivesALaplacePressure)
{
  const Scene scene = disc(10);
  const auto p = pressure_with(scene, "form force");
  const double exact = SIGMA / radius(10);
  EXPECT_GT(p[0], 0.5 * exact);
  EXPECT_LT(p[0], 1.5 * exact);
}

TEST(Tension, DeltaScalesTheForce)
{
  const Scene scene = disc(6);
  auto once = pressure_with(scene, "model published form force");
  const auto thrice = pressure_with(scene, "model published form force delta 0.3");
  for (double &p : once) p *= 3.0;
  EXPECT_LE(largest(thrice, once), SOLVER);
}

/* ----------------------------------------------------------------------
   Model published
------------------------------------------------------------------------- */

// N outwards, K positive on a drop and in proportion to the factor. On balls the paper's 0.41 gives
// 0.82 to 0.73 of 2/R, on discs less than half of 1/R: no factor is right for both.
TEST(Tension, Published)
{
  for (const int dimension : {2, 3}) {
    SCOPED_TRACE(dimension);
    const int layers = dimension == 2 ? 10 : 6;
    const Scene scene = dimension == 2 ? disc(layers) : ball(layers);
    Simulation sim(scene), twice(scene);
    sim.run(tension_script(scene, "model published").text() + FIELDS + "run 0");
    twice.run(tension_script(scene, "model published factor 0.82").text() + FIELDS + "run 0");
    const auto K = sim.compute("k", KAPPA), kind = sim.compute("k", KIND);
    const auto K2 = twice.compute("k", KAPPA);
    const double exact = (dimension - 1) / radius(layers), found = mean(where(K, kind, 1.0));
    EXPECT_GT(found, (dimension == 2 ? 0.3 : 0.7) * exact);
    EXPECT_LT(found, (dimension == 2 ? 0.5 : 0.9) * exact);
    EXPECT_EQ(sim.fix("tens", 7), 0.0);    // or the next line says nothing
    for (std::size_t i = 0; i < K.size(); i++) EXPECT_NEAR(K2[i], 2.0 * K[i], ROUNDING / D);
    for (std::size_t i = 0; i < K.size(); i++) {
      if (kind[i] == 0.0) continue;
      double outward = 0.0;
      for (int a = 0; a < 3; a++) outward += sim.compute("k", TNX + a)[i] * sim.x(a)[i];
      ASSERT_GT(outward, 0.0);
    }
  }
}

/* ----------------------------------------------------------------------
   Viscous normal stress
------------------------------------------------------------------------- */

namespace {

// p - sigma K on a disc that is strained by v = (a x, -a y) with viscosity nu
void expect_stress(const std::string &words, const std::string &scheme, double nu, double factor)
{
  SCOPED_TRACE(words + scheme);
  const Scene scene = disc(6);
  Script script = tension_script(scene, words);
  script.predictor += fmt::format(" nu {}{}", nu, scheme);
  Simulation sim(scene);
  sim.run(script.text() + FIELDS +
          "variable u atom 0.3*x\nvariable w atom -0.3*y\nvelocity all set v_u v_w 0\nrun 0");
  const auto p = sim.compute("k", PTENSION), K = sim.compute("k", KAPPA),
             nx = sim.compute("k", TNX), ny = sim.compute("k", TNY);
  for (std::size_t i = 0; i < p.size(); i++) {
    const double strain = 0.3 * (nx[i] * nx[i] - ny[i] * ny[i]);
    EXPECT_NEAR(p[i] - SIGMA * K[i], factor * 2.0 * nu * strain, 1e-12);
  }
}

}    // namespace

// 2 rho nu N.(grad v).N, with a gradient that is exact for linear velocities
TEST(Tension, ViscousStress)
{
  expect_stress("", "", 0.05, 1.0);
  expect_stress("", " scheme be", 0.05, 1.0);
  expect_stress("viscous yes", "", 0.05, 1.0);
  expect_stress("viscous no", "", 0.05, 0.0);
  expect_stress("", "", 0.0, 0.0);
  expect_stress("model published", "", 0.05, 0.0);
  expect_stress("model published viscous yes", "", 0.05, 1.0);
}

/* ----------------------------------------------------------------------
   Filter
------------------------------------------------------------------------- */

namespace {

struct Filtered {
  std::vector<double> momentum;
  double energy;
};

// velocities after a step; sigma is so small that nothing else moves
Filtered filtered(const std::string &filter, const std::string &stir)
{
  const Scene scene = patch(10);
  Script script = free_script(scene, "density step 0 velocity 1.0 smoothing 0 filter 0");
  script.surface += "\nfix tens fluid aleisph/tension sigma 1e-3 " + filter;
  script.timestep = "timestep 0.1";
  Simulation sim(scene);
  sim.run(script.text() + stir + "velocity all set v_u v_w 0\nrun 1");
  Filtered result = {{}, 0.0};
  for (int a = 0; a < 2; a++) {
    const auto v = sim.v(a);
    result.momentum.push_back(mean(v));
    for (const double value : v) result.energy += value * value;
  }
  return result;
}

}    // namespace

// Where the velocity is linear the filter does nothing; where it is rough it takes energy
TEST(Tension, Filter)
{
  const char *turn = "variable u atom -0.01*y\nvariable w atom 0.01*x\n";
  const char *rough = "variable u atom 0.01*sin(40*x)*cos(37*y)\n"
                      "variable w atom 0.01*cos(35*x+20*y)\n";
  const Filtered still = filtered("", turn), same = filtered("filter 0.5", turn);
  EXPECT_NEAR(same.energy, still.energy, 1e-10 * still.energy);
  const Filtered none = filtered("filter 0", rough), some = filtered("filter 0.5", rough),
                 more = filtered("filter 1.0", rough);
  EXPECT_LT(some.energy, 0.99 * none.energy);
  EXPECT_LT(more.energy, some.energy);
}

/* ----------------------------------------------------------------------
   Contact angle
------------------------------------------------------------------------- */

namespace {

constexpr int WIDE = 20;    // spacings between the walls of the tank

// the walls of an open tank in two groups
Script angle_script(const Scene &scene, const std::string &angles, const std::string &before = "")
{
  Script script = tension_script(scene, angles);
  script.wall += "\nregion lefthalf block INF 0.5 INF INF INF INF\ngroup lh region lefthalf\n"
                 "group left intersect wall lh\ngroup right subtract wall left\n" +
      before;
  return script;
}

// K on the surface of the tank from left to right
std::vector<double> surface_curvature(const std::string &angles, const std::string &before = "")
{
  const Scene scene = open_tank(2, WIDE);
  Simulation sim(scene);
  sim.run(angle_script(scene, angles, before).text() + FIELDS + "run 0");
  return where(sim.compute("k", KAPPA), sim.compute("k", KIND), 1.0);
}

std::vector<double> left_half(std::vector<double> values)
{
  values.resize(values.size() / 4);
  return values;
}

std::vector<double> reversed(std::vector<double> values)
{
  std::reverse(values.begin(), values.end());
  return values;
}

}    // namespace

// At 90 degrees the fluid goes straight on through the wall, as on an infinite lattice: no
// curvature, and the tank stays at rest under gravity as without tension.
TEST(ContactAngle, NeutralTankStaysAtRest)
{
  for (const int dimension : {2, 3}) {
    SCOPED_TRACE(dimension);
    const Scene scene = dimension == 2 ? open_tank(2, 12) : open_slab();
    Script script = tension_script(scene, "angle wall 90");
    script.body = fmt::format("fix g all gravity 1.0 vector {}",
                              dimension == 2 ? "0 -1 0" : "0 0 -1");
    script.ppe = "fix ppe all aleisph/ppe tol 1e-13";
    Simulation sim(scene);
    sim.run(script.text() + FIELDS + "run 20");
    EXPECT_LE(largest(sim.compute("k", KAPPA)), 1e-10 / D);
    EXPECT_LE(std::max(largest(sim.v(0)), largest(sim.v(dimension - 1))), 1e-10);
  }
}

// The particle next to each wall, a spacing away; the second is 2 d away
TEST(ContactAngle, ContactParticles)
{
  const Scene scene = open_tank(2, 12);
  const double d = scene.d;
  Simulation sim(scene);
  sim.run(tension_script(scene, "angle wall 60").text() + FIELDS + "run 0");
  const auto contact = sim.compute("k", CONTACT), kind = sim.compute("k", KIND), x = sim.x(0);
  for (std::size_t i = 0; i < x.size(); i++) {
    const bool near = kind[i] == 1.0 && (x[i] < 1.5 * d || x[i] > 1.0 - 1.5 * d);
    EXPECT_EQ(contact[i], near ? 1.0 : 0.0);
  }
  EXPECT_EQ(sim.fix("tens", 4), 2.0);
}

// Fluid that wets the wall is hollow there, and is drawn up; fluid that does not is pushed down.
// N turns by less than 90 - theta over a few spacings.
TEST(ContactAngle, SignOfTheCurvature)
{
  const auto wet = surface_curvature("angle wall 60"), dry = surface_curvature("angle wall 120"),
             neutral = surface_curvature("");
  EXPECT_LE(largest(neutral), 1e-10 * WIDE);
  for (const auto *K : {&wet, &dry}) {
    const double sign = K == &wet ? -1.0 : 1.0;
    EXPECT_GT(sign * K->front(), 0.0);
    EXPECT_NEAR(K->front(), K->back(), 1e-9 * WIDE);
    EXPECT_GT(std::fabs(K->front()), 10.0 * std::fabs((*K)[WIDE / 2]));
    // integral of K along the surface: the turn of N, at most 30 degrees at each end
    const double turn = sign * std::accumulate(K->begin(), K->end(), 0.0) / WIDE;
    EXPECT_GT(turn, 0.0);
    EXPECT_LT(turn, 2.0 * PI / 6.0);
  }
}

TEST(ContactAngle, StrongerWithTheAngle)
{
  double before = 0.0;
  for (const int angle : {75, 60, 45, 30}) {
    const double K = surface_curvature(fmt::format("angle wall {}", angle)).front();
    EXPECT_LT(K, before) << angle;
    before = K;
  }
}

// Groups of walls have their own angles; what the other wall does is not seen a quarter of the
// surface away
TEST(ContactAngle, Groups)
{
  const auto wet = surface_curvature("angle wall 60"), dry = surface_curvature("angle wall 120");
  const auto mixed = surface_curvature("angle left 60 angle right 120");
  EXPECT_EQ(left_half(mixed), left_half(wet));
  EXPECT_EQ(left_half(reversed(mixed)), left_half(reversed(dry)));
  // the last one counts
  EXPECT_EQ(surface_curvature("angle wall 120 angle left 60"), mixed);
  EXPECT_EQ(surface_curvature("angle left 60 angle wall 120"), dry);
  // walls without a keyword are neutral
  const auto half = surface_curvature("angle left 60");
  EXPECT_EQ(left_half(half), left_half(wet));
  EXPECT_LE(largest(left_half(reversed(half))), 1e-10 * WIDE);
}

TEST(ContactAngle, Variables)
{
  const auto wet = surface_curvature("angle wall 60");
  EXPECT_EQ(surface_curvature("angle wall v_theta", "variable theta equal 60"), wet);
  EXPECT_EQ(surface_curvature("angle wall v_theta", "variable theta atom 60"), wet);
  EXPECT_EQ(surface_curvature("angle wall v_theta", "variable theta atom 60+60*(x>0.5)"),
            surface_curvature("angle left 60 angle right 120"));
}

// Evaluated in every step
TEST(ContactAngle, VariableOfTime)
{
  const Scene scene = open_tank(2, 12);
  Simulation sim(scene);
  Script script = angle_script(scene, "angle wall v_theta",
                               "variable theta equal 90-30*(step>2.5)");
  sim.run(script.text() + FIELDS + "run 2");
  EXPECT_LE(largest(sim.compute("k", KAPPA)), 1e-9);
  sim.run("run 1");
  EXPECT_LT(where(sim.compute("k", KAPPA), sim.compute("k", KIND), 1.0).front(), -0.1);
}

// One rank alone finds what all find together, with contact lines on the boundary of ranks
TEST(ContactAngle, RanksAgree)
{
  int ranks;
  MPI_Comm_size(MPI_COMM_WORLD, &ranks);
  if (ranks == 1) GTEST_SKIP() << "several ranks";
  for (const int dimension : {2, 3})
    for (const char *words :
         {"angle wall 60", "angle left 60 angle right 120", "angle wall 60 model published"}) {
      SCOPED_TRACE(fmt::format("{}d {}", dimension, words));
      const Scene scene = open_tank(dimension, dimension == 2 ? 12 : 6).jitter(0.1);
      const std::string script = angle_script(scene, words).text();
      for (const char *cut : {"processors 2 1 1\n", "processors 1 2 1\n"}) {
        Simulation sim(scene);
        const std::string shift = *(cut + 11) == '2' ? "x" : "y";
        sim.run(fmt::format("balance 1.0 shift {} 20 1.01\n", shift) + script + FIELDS + "run 0");
        Simulation alone(scene, MPI_COMM_SELF);
        alone.run(script + FIELDS + "run 0");
        for (int column = KAPPA; column <= CONTACT; column++)
          EXPECT_LE(largest(sim.compute("k", column), alone.compute("k", column)), SOLVER / D);
        EXPECT_LE(largest(sim.pressure(), alone.pressure()), SOLVER / D);
      }
    }
}

/* ----------------------------------------------------------------------
   Time step
------------------------------------------------------------------------- */

TEST(TensionTimeStep, CapillaryLimit)
{
  const Scene scene = disc(5);
  Script script = tension_script(scene);
  script.timestep = "timestep 1000";
  script.dt = "fix dt all aleisph/dt 1";
  Simulation sim(scene);
  sim.run(script.text() + "run 0");
  EXPECT_EQ(sim.fix("dt", 1), static_cast<double>(aleisph::StepBound::CAPILLARY));
  EXPECT_NEAR(sim.lammps().update->dt, 0.5 * capillary(), ROUNDING);
  EXPECT_EQ(sim.fix("dt", 6), sim.lammps().update->dt);
  sim.run("unfix dt\nfix dt all aleisph/dt 1 capillary 0.25\nrun 1");
  EXPECT_NEAR(sim.lammps().update->dt, 0.25 * capillary(), ROUNDING);
  EXPECT_EQ(sim.log().find("capillary limit"), std::string::npos);
}

// between runs, with a step that will be chosen
TEST(TensionTimeStep, TimestepCommandBetweenRuns)
{
  const Scene scene = disc(5);
  Script script = tension_script(scene);
  script.dt = "fix dt all aleisph/dt 1";
  Simulation sim(scene);
  sim.run(script.text() + "run 1");
  EXPECT_EQ(sim.error_of("timestep 1000\nrun 1"), "");
  EXPECT_NEAR(sim.lammps().update->dt, 0.5 * capillary(), ROUNDING);
}

// after a run, before the fix has been part of one
TEST(TensionTimeStep, TimestepCommandBeforeItsFirstRun)
{
  const Scene scene = disc(5);
  Simulation sim(scene);
  sim.run(free_script(scene).text() + "timestep 0.001\nrun 1");
  sim.run("unfix pred\nunfix ppe\nunfix shift\n");
  Script script = tension_script(scene);
  script.owner = "";
  script.surface = script.surface.substr(script.surface.find('\n') + 1);
  sim.run(script.text() + "run 1");
}

TEST(TensionTimeStep, Fixed)
{
  const auto message = [](double share, std::string &log) {
    const Scene scene = disc(5);
    Script script = tension_script(scene);
    script.timestep = fmt::format("timestep {:.16g}", share * capillary());
    Simulation sim(scene);
    const std::string error = sim.error_of(script.text() + "run 0");
    log = sim.log();
    return error;
  };
  std::string log;
  const std::string error = message(1.01, log);
  expect_words(error, {"ix aleisph/tension: timestep", "above the capillary limit", "use at most"});
  EXPECT_NEAR(number_after(error, "timestep "), 1.01 * capillary(), 1e-5 * capillary());
  EXPECT_NEAR(number_after(error, "limit "), capillary(), 1e-5 * capillary());
  const double safe = number_after(error, "use at most ");
  EXPECT_NEAR(safe, 0.5 * capillary(), 1e-5 * capillary());

  EXPECT_EQ(message(0.9, log), "");
  EXPECT_NE(log.find("WARNING: Fix aleisph/tension: timestep"), std::string::npos);
  // what the message says can be used
  EXPECT_EQ(message(safe / capillary(), log), "");
  EXPECT_EQ(log.find("WARNING: Fix aleisph/tension"), std::string::npos);
}

// a step that another fix makes larger during the run
TEST(TensionTimeStep, RaisedDuringTheRun)
{
  const Scene scene = disc(5);
  Script script = tension_script(scene);
  script.dt = fmt::format("fix r all dt/reset 1 {} {} 1.0", 2.0 * capillary(), 3.0 * capillary());
  Simulation sim(scene);
  expect_words(sim.error_of(script.text() + "run 2"),
               {"ix aleisph/tension: timestep", "above the capillary limit"});
}

/* ----------------------------------------------------------------------
   Where sigma comes from
------------------------------------------------------------------------- */

TEST(TensionSigma, OfTheFluidFile)
{
  const std::string path = scratch_file("drop.aleisph");
  write_text(path,
             "# DATE: 2026-11-22 UNITS: lj CONTRIBUTOR: nobody CITATION: none\n"
             "rho0 1.0\nsigma 0.25\n");
  const Scene scene = disc(5);
  const auto largest_pressure = [&](const std::string &fluid, const std::string &sigma) {
    Script script = free_script(scene);
    script.owner = "fix sph all aleisph spacing 0.1 " + fluid;
    script.surface += "\nfix tens fluid aleisph/tension " + sigma;
    script.timestep = "timestep 0.001";
    Simulation sim(scene);
    sim.run(script.text() + FIELDS + "run 0");
    return largest(sim.compute("k", PTENSION));
  };
  const double expected = largest_pressure("rho0 1.0", "sigma 0.25");
  EXPECT_GT(expected, 0.0);
  EXPECT_EQ(largest_pressure("fluid " + path, ""), expected);
  EXPECT_EQ(largest_pressure("fluid " + path, "sigma 0.5"), 2.0 * expected);
  EXPECT_EQ(largest_pressure("rho0 1.0", "sigma 0"), 0.0);
}

// another fluid from here on
TEST(TensionSigma, ChangesBetweenRuns)
{
  const std::string header = "# DATE: 2026-11-22 UNITS: lj CONTRIBUTOR: nobody CITATION: none\n";
  const std::string thin = scratch_file("thin.aleisph"), thick = scratch_file("thick.aleisph");
  write_text(thin, header + "rho0 1.0\nsigma 0.25\n");
  write_text(thick, header + "rho0 1.0\nsigma 0.5\n");
  const Scene scene = disc(5);
  Script script = free_script(scene);
  script.owner = "fix sph all aleisph spacing 0.1 fluid " + thin;
  script.surface += "\nfix tens fluid aleisph/tension";
  script.timestep = "timestep 0.001";
  Simulation sim(scene);
  sim.run(script.text() + FIELDS + "run 0");
  const double p = largest(sim.compute("k", PTENSION));
  sim.run("unfix sph\nunfix tens\nunfix surf\nunfix pred\nunfix ppe\nunfix shift\n");
  script.owner = "fix sph all aleisph spacing 0.1 fluid " + thick;
  sim.run(script.text() + "run 0");
  EXPECT_EQ(largest(sim.compute("k", PTENSION)), 2.0 * p);
}

namespace {

// a square that begins to become round, in units of length L, time T and density rho
std::vector<double> drop(const std::string &units, double length, double time, double rho0)
{
  Scene scene = patch(8).scale(length);
  scene.units = units;
  scene.rho0 = rho0;
  const double speed = length / time;
  Script script = free_script(scene, fmt::format("density velocity {}", speed));
  script.surface += fmt::format("\nfix tens fluid aleisph/tension sigma {} filter 0.3",
                                0.3 * rho0 * speed * speed * length);
  script.predictor += fmt::format(" nu {}", 0.02 * speed * length);
  script.timestep = fmt::format("timestep {}", 0.01 * time);
  Simulation sim(scene);
  sim.run(script.text() + "run 10");
  std::vector<double> all;
  for (int a = 0; a < 2; a++)
    for (const double v : sim.v(a)) all.push_back(v / speed);
  for (const double p : sim.pressure()) all.push_back(p / (rho0 * speed * speed));
  return all;
}

}    // namespace

// as in test_units.cpp: the solver stops at 1e-12
TEST(TensionSigma, UnitsDoNotMatter)
{
  const auto reference = drop("lj", 1.0, 1.0, 1.0);
  EXPECT_GT(largest(reference), 0.5);
  EXPECT_LE(largest(drop("si", 1.0, 1.0, 1.0), reference), 1e-9);
  EXPECT_LE(largest(drop("si", 1e-3, 1e-2, 1000.0), reference), 1e-9);
  EXPECT_LE(largest(drop("cgs", 1e-1, 1e-2, 1.0), reference), 1e-9);
  EXPECT_LE(largest(drop("micro", 30.0, 2.0, 1e-3), reference), 1e-9);
  EXPECT_LE(largest(drop("nano", 50.0, 3.0, 1.0), reference), 1e-9);
}

/* ----------------------------------------------------------------------
   Costs
------------------------------------------------------------------------- */

namespace {

double ghost_cutoff(const Simulation &sim)
{
  return sim.lammps().comm->cutghostuser;
}

int lists(const Simulation &sim)
{
  return sim.lammps().neighbor->nlist;
}

}    // namespace

// A second neighbour list and wide ghosts come and go with the fix. The skin is 0.3 d.
TEST(TensionCost, WideListOnlyWhereNeeded)
{
  const Scene scene = disc(5);
  const auto expect = [](const Simulation &sim, int number, double cutoff) {
    EXPECT_EQ(lists(sim), number);
    EXPECT_NEAR(ghost_cutoff(sim), cutoff * D, ROUNDING);
  };
  Simulation sim(scene), published(scene);
  sim.run(free_script(scene).text() + "timestep 0.001\nrun 1");
  expect(sim, 1, 2.4 + 0.3);
  EXPECT_EQ(sim.log().find("  tension "), std::string::npos);
  sim.run("unfix pred\nunfix ppe\nunfix shift");
  Script script = tension_script(scene);
  script.owner = "";
  script.surface = script.surface.substr(script.surface.find('\n') + 1);
  script.timestep = "";
  sim.run(script.text() + "run 1");
  expect(sim, 2, 4.8 + 0.3);
  EXPECT_NE(sim.log().find("  tension "), std::string::npos);
  sim.run("unfix tens\nrun 1");
  expect(sim, 1, 2.4 + 0.3);

  published.run(tension_script(scene, "model published").text() + "run 1");
  expect(published, 1, 2.4 + 0.3);
}

// Stencil, operators, pressure matrix and preconditioner: once a step and once for the set-up
TEST(TensionCost, BuildsOnceAStep)
{
  const Scene scene = disc(5);
  Simulation sim(scene);
  sim.run(tension_script(scene, "filter 0.5").text() + FIELDS +
          "thermo_style custom step f_tens[*] f_surf[*]\nthermo 1\nrun 10");
  for (int k = 7; k <= 11; k++) EXPECT_EQ(sim.fix("sph", k), 11.0) << k;
}

TEST(TensionCost, GhostCutoff)
{
  const Scene scene = disc(5);
  Simulation sim(scene);
  const std::string message = sim.error_of("comm_modify cutoff 0.4\n" +
                                           tension_script(scene).text() + "run 0");
  expect_words(message,
               {"ix aleisph: communication cutoff 0.4 is smaller than", "comm_modify cutoff 0.51"});
  EXPECT_EQ(sim.error_of("comm_modify cutoff 0.51\nrun 0"), "");
  EXPECT_EQ(ghost_cutoff(sim), 0.51);
  Simulation narrow(scene);
  EXPECT_EQ(narrow.error_of("comm_modify cutoff 0.4\n" + free_script(scene).text() +
                            "timestep 0.001\nrun 0"),
            "");
}

/* ----------------------------------------------------------------------
   Runs that go on
------------------------------------------------------------------------- */

namespace {

struct Setting {
  const char *name, *words, *nu, *dt;
};

const std::vector<Setting> &settings()
{
  static const std::vector<Setting> all = {
      {"tangent", "angle wall 60", " nu 0.02", ""},
      {"force", "form force angle left 60 angle right 120 filter 0.5", "", ""},
      {"published", "model published form pressure", " nu 0.2 scheme be", ""},
      {"variable", "angle wall v_theta filter 0.5", "", "fix dt all aleisph/dt 3 cfl 0.1"}};
  return all;
}

// a block on the floor of a tank, disordered
Scene rough_block()
{
  return dam(8).jitter(0.15);
}

std::string block_script(const Setting &setting)
{
  const Scene scene = rough_block();
  Script script = angle_script(scene, setting.words, "variable theta equal 60+10*step/20");
  script.body = "fix g all gravity 0.2 vector 0 -1 0";
  script.predictor += setting.nu;
  script.dt = setting.dt;
  return script.text() + FIELDS;
}

std::vector<double> state(const Simulation &sim)
{
  std::vector<double> all = sim.pressure();
  const auto append = [&all](const std::vector<double> &field) {
    all.insert(all.end(), field.begin(), field.end());
  };
  for (int a = 0; a < 2; a++) {
    append(sim.x(a));
    append(sim.v(a));
    append(sim.compute("k", TNX + a));
  }
  append(sim.compute("k", KAPPA));
  append(sim.compute("k", PTENSION));
  append(report(sim));
  return all;
}

constexpr char AFTER_RESTART[] = "\nneighbor 0.0375 bin\nneigh_modify every 1 delay 0 check yes\n";
// neighbour lists are made in every step and atoms stay in their order, so that a new set-up
// changes nothing
constexpr char SAME_ORDER[] = "atom_modify sort 0 0.0\nneigh_modify every 1 delay 0 check no\n";

}    // namespace

// Bitwise, in serial
TEST(TensionRuns, TwoRunsAreOne)
{
  for (const auto &setting : settings()) {
    SCOPED_TRACE(setting.name);
    Simulation one(rough_block()), two(rough_block());
    const std::string script = SAME_ORDER + block_script(setting);
    one.run(script + "run 20");
    two.run(script + "run 10\nrun 0\nrun 10");
    EXPECT_GT(largest(one.v(0)), 1e-3);
    if (one.ranks() == 1)
      EXPECT_EQ(state(two), state(one));
    else
      EXPECT_LE(largest(state(two), state(one)), 1e-7);
  }
}

TEST(TensionRuns, RestartContinues)
{
  for (const auto &setting : settings()) {
    SCOPED_TRACE(setting.name);
    const std::string file = scratch_file("tension.restart");
    Simulation first(rough_block()), second;
    first.run(block_script(setting) + "run 10\nwrite_restart " + file + "\nrun 10");
    // groups come from the file
    second.run("read_restart " + file + AFTER_RESTART + block_script(setting) + "run 10");
    EXPECT_EQ(second.variable("step"), 20.0);
    if (first.ranks() == 1)
      EXPECT_EQ(state(second), state(first));
    else
      EXPECT_LE(largest(state(second), state(first)), 1e-7);
  }
}

// Each rank alone does what all do together, up to the tolerance of the solver
TEST(TensionRuns, RanksAgree)
{
  for (const auto &setting : settings()) {
    SCOPED_TRACE(setting.name);
    Simulation all(rough_block()), one(rough_block(), MPI_COMM_SELF);
    if (all.ranks() == 1) GTEST_SKIP() << "several ranks";
    // between the ranks there is fluid
    all.run("balance 1.0 shift xy 20 1.01\n" + block_script(setting) + "run 20");
    one.run(block_script(setting) + "run 20");
    EXPECT_LE(largest(state(all), state(one)), 1e-7);
  }
}

// The pressure jump alone moves nothing: what is left is the scatter of K, a few percent of
// sigma/R, which gives velocities of its square root at the very most.
TEST(TensionRuns, DiscStaysAtRest)
{
  const Scene scene = disc(8);
  const double scale = std::sqrt(SIGMA / radius(8));
  Script script = tension_script(scene);
  script.predictor += fmt::format(" nu {}", 0.05 * std::sqrt(SIGMA * D));
  Simulation sim(scene);
  sim.run(script.text() + FIELDS + "run 60");
  EXPECT_LE(std::hypot(largest(sim.v(0)), largest(sim.v(1))), 0.1 * scale);
  const auto K = where(sim.compute("k", KAPPA), sim.compute("k", KIND), 1.0);
  EXPECT_NEAR(mean(K), 1.0 / radius(8), 0.01 / radius(8));
}

TEST(TensionRuns, OutputBeforeTheFirstRun)
{
  const Scene scene = disc(5);
  Simulation sim(scene);
  sim.run(tension_script(scene).text());
  EXPECT_EQ(report(sim), std::vector<double>(8, 0.0));
  EXPECT_NE(sim.error_of("unfix sph\nprint \"$(f_tens[1])\"").find("needs a fix aleisph"),
            std::string::npos);
}

// What is left of the fix is not asked
TEST(TensionRuns, FieldsAfterItHasGone)
{
  const Scene scene = disc(5);
  Simulation sim(scene);
  sim.run(tension_script(scene).text() + FIELDS + "run 1\nunfix tens");
  EXPECT_EQ(largest(sim.compute("k", KAPPA)), 0.0);
  sim.run("run 1");
  EXPECT_EQ(largest(sim.compute("k", KAPPA)), 0.0);
}

/* ----------------------------------------------------------------------
   Errors
------------------------------------------------------------------------- */

namespace {

// in small_channel(), which has walls
std::function<void(Script &)> line(const std::string &words)
{
  return [words](Script &s) {
    s.surface = "fix surf fluid aleisph/surface\nfix tens fluid aleisph/tension " + words;
  };
}

}    // namespace

TEST(TensionErrors, Command)
{
  std::vector<ErrorCase> cases = {
      {"keyword", line("colour red"), {"ix aleisph/tension", "unknown keyword colour"}},
      {"model",
       line("sigma 1 model best"),
       {"ix aleisph/tension", "model must be tangent or published", "best"}},
      {"form",
       line("sigma 1 form strong"),
       {"ix aleisph/tension", "form must be pressure, force or both", "strong"}},
      {"viscous", line("sigma 1 viscous maybe"), {"maybe"}},
      {"sigma word", line("sigma water"), {"water"}},
      {"no sigma",
       line(""),
       {"ix aleisph/tension", "sigma is required", "fluid of fix aleisph has no surface tension"}},
      {"unknown group", line("sigma 1 angle roof 60"), {"ix aleisph/tension", "angle", "roof"}},
      {"no variable",
       line("sigma 1 angle wall v_theta"),
       {"ix aleisph/tension", "theta is not an equal- or atom-style variable"}},
  };
  for (const char *key :
       {"sigma", "model", "form", "angle", "angle wall", "filter", "viscous", "factor", "delta"}) {
    const std::string word = std::string(key).substr(0, 5) == "angle" ? "angle" : key;
    cases.push_back({"value missing " + std::string(key),
                     line("sigma 1 " + std::string(key)),
                     {"fix aleisph/tension " + word, "issing"}});
  }
  for (const char *key : {"sigma", "filter", "factor", "delta"})
    for (const char *value : {"-0.5", "-1e-30"})
      cases.push_back(
          {key,
           line(fmt::format("sigma 1 model published {} {}", key, value)),
           {"ix aleisph/tension", fmt::format("{} must not be negative, it is {}", key, value)}});
  for (const char *key : {"factor", "delta"})
    cases.push_back({key,
                     line(fmt::format("sigma 1 {} 0.3", key)),
                     {"ix aleisph/tension", fmt::format("keyword {} needs model published", key)}});
  for (const char *angle : {"0", "180", "-1", "190", "1e9"})
    cases.push_back({angle,
                     line(fmt::format("sigma 1 angle wall {}", angle)),
                     {"ix aleisph/tension", "angle must lie between 0 and 180 degrees",
                      fmt::format("not {}", angle)}});
  for (const char *value : {"nan", "inf", "many"})
    cases.push_back({value, line(fmt::format("sigma 1 angle wall {}", value)), {value}});
  expect_errors(cases);
}

TEST(TensionErrors, Variables)
{
  const auto with = [](const std::string &definition) {
    return [definition](Script &s) {
      line("sigma 1e-6 angle wall v_theta")(s);
      s.owner = definition + "\n" + s.owner;
    };
  };
  const Words outside = {"ix aleisph/tension: variable theta must lie between 0 and 180 degrees",
                         "for atom "};
  expect_errors({
      {"string style",
       with("variable theta string 60"),
       {"ix aleisph/tension", "theta is not an equal- or atom-style variable"}},
      {"zero", with("variable theta equal 0"), outside},
      {"large", with("variable theta equal 180"), outside},
      {"infinite", with("variable theta equal exp(1000)"), outside},
      {"later", with("variable theta equal 60-60*(step>0.5)"), outside},
      {"of atoms", with("variable theta atom 200"), outside},
      // on one rank only
      {"of one atom",
       with("variable theta atom 60-90*(id==1)"),
       {"ix aleisph/tension: variable theta must lie between 0 and 180 degrees", "for atom 1 "}},
  });
}

TEST(TensionErrors, Setup)
{
  const std::string tension = "\nfix tens fluid aleisph/tension sigma 1e-6";
  const std::string surface = "fix surf fluid aleisph/surface";
  expect_errors({
      {"no owner",
       [&](Script &s) { s = Script{}, s.surface = tension.substr(1); },
       {"ix aleisph/tension needs a fix aleisph", "defined before"}},
      {"no surface",
       [&](Script &s) { s.surface = tension.substr(1); },
       {"ix aleisph/tension needs a fix aleisph/surface", "defined before"}},
      {"two",
       [&](Script &s) {
         s.surface = surface + tension + "\nfix t2 fluid aleisph/tension sigma 1e-6";
       },
       {"ix aleisph/tension: there must be only one"}},
      {"group",
       [&](Script &s) { s.surface = surface + "\nfix tens all aleisph/tension sigma 1e-6"; },
       {"ix aleisph/tension: group must be that of fix pred, fluid"}},
      {"before surface",
       [&](Script &s) { s.surface = tension.substr(1) + "\n" + surface; },
       {"surf (aleisph/surface)", "must be defined before", "tens (aleisph/tension)"}},
      {"after predictor",
       [&](Script &s) { s.surface = surface, s.predictor += tension; },
       {"tens (aleisph/tension)", "must be defined before", "pred (aleisph/predictor)"}},
      {"force after predictor",
       [&](Script &s) { s.surface = surface, s.predictor += tension + " form force"; },
       {"tens (aleisph/tension)", "must be defined before", "pred (aleisph/predictor)"}},
      {"angle of no wall",
       [&](Script &s) { s.surface = surface + tension + " angle fluid 60"; },
       {"ix aleisph/tension", "angle", "fluid"}},
  });
}

TEST(TensionErrors, AngleWithoutWalls)
{
  const Scene scene = disc(4);
  Simulation sim(scene);
  expect_words(sim.error_of(tension_script(scene, "angle all 60").text() + "run 0"),
               {"ix aleisph/tension", "angle needs a fix aleisph/wall"});
}

// The surface may be inside of a frame that follows the fluid, without shifting
TEST(TensionErrors, OtherFramesAreRight)
{
  const Scene scene = disc(4);
  Script script = script_of(scene);
  script.surface = tension_script(scene).surface;
  script.timestep = tension_script(scene).timestep;
  Simulation sim(scene);
  EXPECT_EQ(sim.error_of(script.text() + "run 2"), "");
}
