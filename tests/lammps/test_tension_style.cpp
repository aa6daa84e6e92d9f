// SPDX-License-Identifier: GPL-2.0-only
/* ----------------------------------------------------------------------
   fix aleisph/tension without walls: curvature of drops at rest, what the
   pressure equation and the forces make of it, viscous stress, filter.
------------------------------------------------------------------------- */

#include "errors.h"
#include "tension_script.h"

#include <algorithm>

using namespace tension;

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

// With tension the pressure is that of the surface at the centres, unless the script says otherwise
TEST(Tension, RowIsCentreByDefault)
{
  const Scene scene = disc(6).jitter(0.2);
  const auto pressure = [&](const std::string &row) {
    Script script = tension_script(scene);
    script.surface.insert(script.surface.find('\n'), row);
    Simulation sim(scene);
    sim.run(script.text() + FIELDS + "run 0");
    const auto p = sim.pressure(), kind = sim.compute("k", KIND),
               expected = sim.compute("k", PTENSION);
    EXPECT_EQ(row != " row half",
              largest(where(p, kind, 1.0), where(expected, kind, 1.0)) < SOLVER);
    return p;
  };
  EXPECT_EQ(pressure(""), pressure(" row centre"));
  EXPECT_NE(pressure(""), pressure(" row half"));
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
  EXPECT_EQ(report(none), std::vector<double>(9, 0.0));
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
// without normal, held above walls
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
  for (int k = 3; k < 9; k++) EXPECT_EQ(told[k], 0.0) << k + 1;
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

// A force on the last layer of particles does not give all of sigma K. With second differences for
// the rows of the layers, p_0 the pressure of the last one and P that inside,
//   (p_0 - P)/d^2 = -sigma K/(2 d^2),  p_0 + (p_0 - P)/2 = 0  (row half)  or  p_0 = 0  (row centre),
// so that P is 3/4 or 1/2 of sigma K. The wider rows of the package change this by a tenth.
TEST(Tension, ForceGivesAPartOfTheLaplacePressure)
{
  for (const bool half : {false, true}) {
    const Scene scene = disc(10);
    Script script = tension_script(scene, "form force");
    script.surface.insert(script.surface.find('\n'), half ? " row half" : " row centre");
    Simulation sim(scene);
    sim.run(script.text() + "run 0");
    const double share = half ? 0.75 : 0.5;
    EXPECT_NEAR(sim.pressure()[0] * radius(10) / SIGMA, share, 0.1 * share);
  }
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
  script.predictor += " motion euler";    // else the places, and v of them, are not linear
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

// In a step, walls come before tension: its fields are not known there, which is said
TEST(TensionStyle, FieldsAreAskedForTooEarly)
{
  for (const char *field : {"kappa", "ptension", "tnx", "contact"}) {
    SCOPED_TRACE(field);
    const Scene scene = open_tank(2, 8);
    Simulation sim(scene);
    Script script = free_script(scene);
    script.wall = fmt::format(
        "compute k fluid aleisph/atom {} p\ncompute km fluid reduce max c_k[1]\n"
        "variable vw equal 0.0*c_km\n"
        "fix wall wall aleisph/wall velocity v_vw 0 0",
        field);
    script.surface += "\nfix tens fluid aleisph/tension sigma 1e-3";
    script.timestep = "timestep 1e-4";
    expect_words(sim.error_of(script.text() + "run 1"),
                 {"ompute aleisph/atom: fix aleisph/tension has not been through this step",
                  "use its fields in output"});

    // in output they are
    Simulation again(scene);
    script.wall = fmt::format("compute k fluid aleisph/atom {}\ncompute km fluid reduce max c_k\n"
                              "thermo_style custom step c_km\nthermo 1\n"
                              "fix wall wall aleisph/wall",
                              field);
    EXPECT_EQ(again.error_of(script.text() + "run 2"), "");
  }
}
