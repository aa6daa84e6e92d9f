// SPDX-License-Identifier: GPL-2.0-only
/* ----------------------------------------------------------------------
   fix aleisph/shift: how far particles are shifted, what the flow notices of
   it, and runs that go on. The sums over neighbours are tested with the
   numerics.
------------------------------------------------------------------------- */

#include "aleisph_kernel.h"
#include "errors.h"

#include <algorithm>
#include <cmath>

namespace {

constexpr double PI = 3.14159265358979323846;
constexpr double ROUNDING = 1.0e-12;
constexpr char FIELDS[] = "compute c all aleisph/atom ux uy uz surface rho\n";

const std::vector<std::string> &models()
{
  static const std::vector<std::string> all = {"density", "density variant published", "ops",
                                               "fickian", "tvf"};
  return all;
}

// disordered, at rest, no force: only the shift moves particles
Scene disorder(double jitter = 0.2)
{
  return periodic_square(10).jitter(jitter);
}

Script still_script(const std::string &shift, const std::string &timestep = "timestep 0.01")
{
  Script script = shifted_script(disorder(), shift);
  script.timestep = timestep;
  return script;
}

// a component of the shift velocity; a = 0, 1, 2
std::vector<double> u(const Simulation &sim, int a)
{
  return sim.compute("c", a + 1);
}

std::vector<double> norms(const std::vector<double> &a, const std::vector<double> &b)
{
  std::vector<double> values(a.size());
  for (std::size_t i = 0; i < a.size(); i++) values[i] = std::hypot(a[i], b[i]);
  return values;
}

std::vector<double> shift_speed(const Simulation &sim)
{
  return norms(u(sim, 0), u(sim, 1));
}

// b - a in a box of period 1
std::vector<double> way(const std::vector<double> &a, const std::vector<double> &b)
{
  std::vector<double> values(a.size());
  for (std::size_t i = 0; i < a.size(); i++) values[i] = std::remainder(b[i] - a[i], 1.0);
  return values;
}

constexpr char TAYLOR_GREEN[] = "variable u atom sin(2*PI*x)*cos(2*PI*y)\n"
                                "variable w atom -cos(2*PI*x)*sin(2*PI*y)\n"
                                "velocity all set v_u v_w 0\n"
                                "compute ex all aleisph/exact taylor-green 1 1 1 0.01\n";

}    // namespace

/* ----------------------------------------------------------------------
   How much
------------------------------------------------------------------------- */

// C = R U dt/d, with the R of the model unless it is given
TEST(Shift, Coefficient)
{
  struct Case {
    const char *words;
    double C;
  };
  // dt = 0.01, d = 0.1
  for (const auto &item :
       {Case{"density velocity 2.0", 2.0 * 0.2}, Case{"density velocity 2.0 rate 0.7", 0.7 * 0.2},
        Case{"density variant published velocity 2.0", 0.005},
        Case{"density variant published velocity 2.0 rate 0.1", 0.1 * 0.2},
        Case{"density variant published step 0.01", 0.01}, Case{"ops velocity 2.0", 2.0 * 0.2},
        Case{"fickian velocity 2.0", 2.0 * 0.2}, Case{"tvf velocity 2.0", 2.0 * 0.2},
        Case{"density step 0.005", 0.005}, Case{"density step 0.005 velocity 7", 0.005},
        Case{"density velocity 0", 0.0}, Case{"density step 0", 0.0}}) {
    SCOPED_TRACE(item.words);
    Simulation sim(disorder());
    sim.run(still_script(item.words).text() + FIELDS + "run 0");
    EXPECT_NEAR(sim.fix("shift", 1), item.C, ROUNDING);
    EXPECT_EQ(largest(shift_speed(sim)) > 0.0, item.C > 0.0 && item.words[0] != 't');
    sim.run("run 2");
    EXPECT_NEAR(sim.fix("shift", 1), item.C, ROUNDING);
    sim.run("timestep 0.005\nrun 1");
    const std::string words = item.words;
    const bool fixed = words.find("step") != std::string::npos ||
        (words.find("published") != std::string::npos && words.find("rate") == std::string::npos);
    EXPECT_NEAR(sim.fix("shift", 1), fixed ? item.C : 0.5 * item.C, ROUNDING);
  }
}

// less, by default, where there is a surface that more would disturb
TEST(Shift, CoefficientWithAFreeSurface)
{
  const Scene scene = open_tank(2, 10);
  for (const auto &[words, rate] : {std::pair{"density", 0.3},
                                    {"density variant published rate 0.1", 0.1},
                                    {"density rate 0.7", 0.7},
                                    {"ops", 2.0}}) {
    SCOPED_TRACE(words);
    Script script = free_script(scene);
    script.shift = fmt::format("fix shift fluid aleisph/shift {} velocity 2.0", words);
    script.timestep = "timestep 0.01";
    Simulation sim(scene);
    sim.run(script.text() + "run 0");
    EXPECT_NEAR(sim.fix("shift", 1), rate * 2.0 * 0.01 / scene.d, ROUNDING);
  }
}

// the displacement is proportional to C as long as it is not limited
TEST(Shift, IsProportionalToTheCoefficient)
{
  for (const char *model : {"density", "density variant published", "ops", "fickian"}) {
    SCOPED_TRACE(model);
    const auto of = [model](double C) {
      Simulation sim(disorder());
      sim.run(still_script(fmt::format("{} step {}", model, C)).text() + FIELDS + "run 0");
      return u(sim, 0);
    };
    auto small = of(1e-4);
    for (double &value : small) value *= 50.0;
    const auto big = of(5e-3);
    EXPECT_LE(largest(small, big), ROUNDING * largest(big));
    EXPECT_GT(largest(big), 0.0);
  }
}

TEST(Shift, VelocityMax)
{
  const Scene scene = periodic_square(10);
  Simulation sim(scene);
  Script script = shifted_script(scene, "density velocity max");
  script.timestep = "timestep 0.002";
  sim.run(script.text() + TAYLOR_GREEN);
  for (const int steps : {0, 5}) {
    sim.run(fmt::format("run {}", steps));
    const double fastest = largest(norms(sim.v(0), sim.v(1)));
    EXPECT_GT(fastest, 0.8);
    EXPECT_NEAR(sim.fix("shift", 1), 2.0 * fastest * 0.002 / scene.d, ROUNDING);
  }
}

namespace {

// U of particles with a free surface: column 1 of fix shift over its rate
double scale(const Simulation &sim, const Scene &scene, double dt)
{
  return sim.fix("shift", 1) / 0.3 * scene.d / dt;
}

}    // namespace

// sqrt(2 g H) at rest, with the depth H that the particles have: n spacings
TEST(Shift, VelocityHead)
{
  constexpr double G = 3.0, DT = 1.0e-4;
  for (const int dimension : {2, 3})
    for (const char *words : {"density velocity head", "density variant published rate 0.3"}) {
      SCOPED_TRACE(words);
      const Scene scene = open_tank(dimension, 6);
      Script script = free_script(scene, words);
      script.body = fmt::format("fix g all gravity {} vector 0 0 -1", G);
      if (dimension == 2) script.body = fmt::format("fix g all gravity {} vector 0 -1 0", G);
      script.timestep = fmt::format("timestep {}", DT);
      Simulation sim(scene);
      sim.run(script.text() + "run 0");
      const auto height = sim.x(dimension - 1);
      double low = 1.0e9, high = -1.0e9;
      const auto type = sim.type();
      for (std::size_t i = 0; i < height.size(); i++)
        if (type[i] == Scene::FLUID) {
          low = std::min(low, height[i]);
          high = std::max(high, height[i]);
        }
      EXPECT_NEAR(scale(sim, scene, DT), std::sqrt(2.0 * G * (high - low + scene.d)), 1.0e-9);
    }
}

// what moves has its velocity besides
TEST(Shift, VelocityHeadOfMovingFluid)
{
  constexpr double DT = 1.0e-4;
  const Scene scene = patch(8);
  Script script = free_script(scene, "density velocity head");
  script.timestep = fmt::format("timestep {}", DT);
  Simulation sim(scene);
  sim.run(script.text() + "variable w atom -0.7*x\nvelocity all set 0 v_w 0\nrun 0");
  const double fastest = largest(norms(sim.v(0), sim.v(1)));
  EXPECT_NEAR(scale(sim, scene, DT), fastest, 1.0e-9);    // no force

  // as high as they are above the lowest ones, and one spacing
  sim.run("unfix shift\nunfix ppe\nunfix pred\nfix g all gravity 2.0 vector -1 0 0\n" +
          script.predictor + "\n" + script.ppe + "\n" + script.shift + "\nrun 0");
  const auto vx = sim.v(0), vy = sim.v(1), x = sim.x(0);
  double low = 1.0e9, head = 0.0;
  for (const double place : x) low = std::min(low, place);
  for (std::size_t i = 0; i < x.size(); i++)
    head = std::max(head, vx[i] * vx[i] + vy[i] * vy[i] + 4.0 * (x[i] - low + scene.d));
  EXPECT_NEAR(scale(sim, scene, DT), std::sqrt(head), 1.0e-9);
}

// in closed flow a body force drives, and nothing falls
TEST(Shift, VelocityWithoutSurfaceIsTheLargest)
{
  const Scene scene = periodic_square(10);
  Simulation sim(scene);
  Script script = shifted_script(scene, "ops");
  script.body = "fix g all gravity 5.0 vector 1 0 0";
  script.timestep = "timestep 1.0e-4";
  sim.run(script.text() + "run 0");
  EXPECT_EQ(sim.fix("shift", 1), 0.0);
}

// The default, also in closed flow: C = 0.3 U dt/d, U = 33 d S + sqrt(a d). Taylor-Green vortices of
// wave number k = 2 pi: S = k, and a = k/2 of p = (cos 2 k x + cos 2 k y)/4. On 40 particles a wave
// the gradients of the scheme are too small by up to 3 % (k, kh = 0.19) and 8 % (2 k).
TEST(Shift, VelocityOfTheStrain)
{
  constexpr double DT = 1.0e-4, K = 2.0 * PI;
  const Scene scene = periodic_square(40);
  for (const char *words : {"density", "density velocity strain"}) {
    SCOPED_TRACE(words);
    Script script = shifted_script(scene, words);
    script.timestep = fmt::format("timestep {}", DT);
    Simulation sim(scene);
    sim.run(script.text() + TAYLOR_GREEN + "run 1");
    const double strain = 33.0 * scene.d * K, pressure = std::sqrt(0.5 * K * scene.d);
    EXPECT_NEAR(scale(sim, scene, DT), strain + pressure, 0.03 * strain + 0.04 * pressure);
  }
}

// Neither a uniform motion nor a fall shifts anything.
TEST(Shift, NoScaleOfUniformMotion)
{
  const Scene scene = patch(8);
  Script script = free_script(scene, "density");
  script.body = "fix g all gravity 5.0 vector 1 0 0";
  script.timestep = "timestep 1.0e-4";
  Simulation sim(scene);
  sim.run(script.text() + "velocity all set 3 -1 0\nrun 3");
  EXPECT_LE(sim.fix("shift", 1), 1.0e-9);
}

// however large the step, C is what shifts stably: 0.169 in 2d
TEST(Shift, CoefficientOfTheFlowIsBounded)
{
  const Scene scene = periodic_square(10);
  Script script = shifted_script(scene, "density");
  script.timestep = "timestep 0.02";
  Simulation sim(scene);
  sim.run(script.text() + TAYLOR_GREEN + "run 0");
  EXPECT_NEAR(sim.fix("shift", 1), 0.168961, 1.0e-6);
}

TEST(Shift, VelocityOfAVariable)
{
  Simulation sim(disorder());
  sim.run("variable U equal 1+0.25*step\n" + still_script("density velocity v_U").text() + "run 0");
  EXPECT_NEAR(sim.fix("shift", 1), 2.0 * 0.1, ROUNDING);
  sim.run("run 3");
  EXPECT_NEAR(sim.fix("shift", 1), 2.0 * 1.75 * 0.1, ROUNDING);
}

// A step moves particles with v + u of its start
// dx = dt (v + u + dt/2 dv/dt)
constexpr char RATES[] = "compute rates all property/atom d2_aleisph_dv[1] d2_aleisph_dv[2]\n";

TEST(Shift, MovesTheParticles)
{
  for (const auto &model : models()) {
    SCOPED_TRACE(model);
    const Scene scene = periodic_square(10).jitter(0.1);
    Simulation sim(scene);
    Script script = shifted_script(scene, model + " velocity 1.0");
    script.timestep = "timestep 0.002";
    sim.run(script.text() + TAYLOR_GREEN + FIELDS + RATES + "run 1");
    for (int a = 0; a < 2; a++) {
      const auto x = sim.x(a), v = sim.v(a), shift = u(sim, a), rate = sim.compute("rates", a + 1);
      EXPECT_GT(largest(shift), 1e-4);
      Simulation copy(scene);
      copy.run(script.text() + TAYLOR_GREEN + "run 2");
      auto expected = v;
      for (std::size_t i = 0; i < v.size(); i++)
        expected[i] = 0.002 * (v[i] + shift[i] + 0.001 * rate[i]);
      EXPECT_LE(largest(way(x, copy.x(a)), expected), ROUNDING);
    }
  }
}

// The fluid does not notice that its particles are moved: at rest it stays at rest
TEST(Shift, FluidAtRestStaysAtRest)
{
  for (const auto &model : models()) {
    SCOPED_TRACE(model);
    Simulation sim(disorder());
    sim.run(still_script(model + " velocity 1.0").text() + "run 20");
    for (int a = 0; a < 2; a++) EXPECT_EQ(largest(sim.v(a)), 0.0);
    EXPECT_EQ(largest(sim.pressure()), 0.0);
  }
}

// A uniform velocity is exact for every operator
TEST(Shift, UniformFlowStaysUniform)
{
  for (const auto &model : models()) {
    SCOPED_TRACE(model);
    Simulation sim(disorder());
    sim.run(still_script(model + " velocity 1.0", "timestep 0.002").text() +
            "velocity all set 1.0 0.5 0\nrun 20");
    auto v = sim.v(0), w = sim.v(1);
    for (double &value : v) value -= 1.0;
    for (double &value : w) value -= 0.5;
    EXPECT_LE(std::max(largest(v), largest(w)), ROUNDING);
  }
}

// With a rate the shift is a motion dx/dt = R U/d h sum(x), which Euler's method follows with the
// time step of the flow: first order, so that halving dt halves the difference. With `step` the
// way would double. A jitter of 0.04 d keeps pairs from crossing the edge of the nearest
// neighbours, 1.556 d, where the density model jumps (1.414 d + 2 sqrt(2) 0.04 d = 1.527 d).
TEST(Shift, DoesNotDependOnTheTimeStep)
{
  for (const char *model : {"density", "density variant published rate 0.1", "ops", "fickian"}) {
    SCOPED_TRACE(model);
    const auto moved = [model](int steps) {
      Simulation sim(disorder(0.04));
      sim.run(still_script(fmt::format("{} velocity 1.0", model),
                           fmt::format("timestep {}", 0.08 / steps))
                  .text());
      const auto start = sim.x(0);
      sim.run(fmt::format("run {}", steps));
      EXPECT_EQ(sim.fix("shift", 3), 0.0);
      return way(start, sim.x(0));
    };
    const auto first = moved(16), second = moved(32), third = moved(64);
    const double coarse = largest(first, second), fine = largest(second, third);
    EXPECT_NEAR(std::log2(coarse / fine), 1.0, 0.25);
    EXPECT_LE(coarse, 0.1 * largest(third));
  }
}

// disorder gets less: the spread of the numerical density falls
TEST(Shift, EvensOutDisorder)
{
  for (const char *model : {"density", "density variant published rate 0.1", "ops", "fickian"}) {
    SCOPED_TRACE(model);
    Simulation sim(disorder());
    sim.run(still_script(fmt::format("{} velocity 1.0", model)).text() + FIELDS + "run 0");
    const double before = largest(without_mean(sim.compute("c", 5)));
    sim.run("run 100");
    EXPECT_LE(largest(without_mean(sim.compute("c", 5))), 0.5 * before);
  }
}

TEST(Shift, LimitIsCounted)
{
  for (const char *model : {"density", "ops"}) {
    SCOPED_TRACE(model);
    Simulation sim(disorder());
    sim.run(still_script(fmt::format("{} step 0.1 limit 0.01", model)).text() + FIELDS);
    double sum = 0.0;
    for (const char *run : {"run 0", "run 1", "run 1", "run 1"}) {
      sim.run(run);
      double limited = 0.0;
      for (const double speed : shift_speed(sim)) {
        const double share = speed * 0.01 / 0.1;    // |dr|/d
        EXPECT_LE(share, 0.01 * (1.0 + ROUNDING));
        limited += share > 0.01 * (1.0 - ROUNDING);
      }
      EXPECT_GT(limited, 0.0);
      EXPECT_LT(limited, 100.0);
      sum += limited;
      EXPECT_EQ(sim.fix("shift", 2), limited);
      EXPECT_EQ(sim.fix("shift", 3), sum);
      EXPECT_NEAR(sim.fix("shift", 4), 0.01, ROUNDING);
    }
  }
}

TEST(Shift, LargestAndMean)
{
  Simulation sim(disorder());
  sim.run(still_script("density variant published velocity 1.0").text() + FIELDS + "run 3");
  EXPECT_NEAR(sim.fix("shift", 4), largest(shift_speed(sim)) * 0.01 / 0.1, ROUNDING);
  EXPECT_NEAR(sim.fix("shift", 5), mean(sim.compute("c", 5)) - 1.0, ROUNDING);
  EXPECT_NE(sim.fix("shift", 5), 0.0);
  Simulation other(disorder());
  other.run(still_script("fickian velocity 1.0").text() + "run 3");
  EXPECT_EQ(other.fix("shift", 5), 0.0);
}

// |u| <= |v|/4, whatever the rate
TEST(Shift, TransportVelocityIsBounded)
{
  const Scene scene = periodic_square(10).jitter(0.2);
  Simulation sim(scene);
  Script script = shifted_script(scene, "tvf velocity 1.0 rate 1000 limit 10");
  script.timestep = "timestep 0.002";
  sim.run(script.text() + TAYLOR_GREEN + FIELDS + "run 1");
  const auto shift = shift_speed(sim), speed = norms(sim.v(0), sim.v(1));
  for (std::size_t i = 0; i < shift.size(); i++) EXPECT_NEAR(shift[i], 0.25 * speed[i], ROUNDING);
}

// A particle alone, half a spacing above a floor: the model does not move it, the wall does, by
// min(walls d - s, 0.05 d min(1, 5 U dt/d))
TEST(Shift, OffWalls)
{
  Scene scene = patch(10);
  scene.x.clear();
  scene.type.clear();
  for (int i = -10; i <= 10; i++) scene.add(Scene::WALL, i * scene.d, 0.0);
  scene.add(Scene::FLUID, 0.0, 0.5 * scene.d);
  struct Case {
    const char *words;
    double step;    // in spacings
  };
  // U dt/d = 0.1, 0.5
  for (const auto &item :
       {Case{"ops velocity 1.0", 0.025}, Case{"ops velocity 5.0", 0.05},
        Case{"ops velocity 5.0 walls 0.51", 0.01}, Case{"ops velocity 5.0 walls 0", 0.0},
        Case{"ops velocity 5.0 walls 0.5", 0.0}, Case{"density velocity 1.0", 0.025},
        Case{"density variant published velocity 1.0", 0.0},
        Case{"density variant published velocity 1.0 walls 0.7", 0.025}}) {
    SCOPED_TRACE(item.words);
    Simulation sim(scene);
    Script script = free_script(scene, item.words);
    script.timestep = "timestep 0.01";
    sim.run(script.text() + FIELDS + "run 0");
    EXPECT_NEAR(u(sim, 0)[21], 0.0, ROUNDING);
    EXPECT_NEAR(u(sim, 1)[21], item.step * scene.d / 0.01, ROUNDING);
  }
}

/* ----------------------------------------------------------------------
   At a free surface
------------------------------------------------------------------------- */

/* Published variant, flat surface on a lattice: rho* - 1 = e on the surface, zero below, over the
   eight nearest neighbours; the even part has no share along N. With `pair symmetric`, pairs beside
   a surface particle cancel, and three below have e + 0: dr = C h e (1 + 2/sqrt 2) along y. As
   printed they have 2 eps_j = 0, and nothing moves. This holds off the walls: pairs with a wall count
   2 eps_i, up to the nearest neighbours; N of eq 25 is tilted by what lambda is less than in the
   bulk, which is where the support (2.4 d) reaches behind the wall, seen from up to 2.4 d away: to
   3.8 d from it. With `positive` and N of the color gradient there is nothing, walls or not. */
TEST(Shift, PublishedSurface)
{
  const Scene scene = open_tank(2, 10);
  const double d = scene.d, C = 0.005, dt = 0.01;
  const aleisph::Kernel kernel(aleisph::KernelType::CUBIC_SPLINE, 2, 1.2 * d);
  const double w0 = kernel.w(0.0), w1 = kernel.w(d), w2 = kernel.w(std::sqrt(2.0) * d);
  const double e = (w0 + 3.0 * w1 + 2.0 * w2) / (w0 + 4.0 * w1 + 4.0 * w2) - 1.0;
  const double down = C * 1.2 * d * e * (1.0 + std::sqrt(2.0)) / dt;
  struct Case {
    const char *words;
    double expected;
    double off;    // walls, in spacings
  };
  for (const auto &item :
       {Case{"", 0.0, 3.8}, Case{" pair printed", 0.0, 3.8}, Case{" normal color", 0.0, 1.5},
        Case{" pair symmetric", down, 3.8}, Case{" pair symmetric normal color", down, 1.5},
        Case{" surface positive", 0.0, 3.8}, Case{" surface positive normal color", 0.0, 0.0},
        Case{" surface positive pair symmetric normal color", 0.0, 0.0}}) {
    SCOPED_TRACE(item.words);
    Simulation sim(scene);
    Script script = free_script(scene, std::string("density variant published") + item.words);
    script.timestep = fmt::format("timestep {}", dt);
    sim.run(script.text() + FIELDS + "run 0");
    const auto kind = sim.compute("c", 4), shift = u(sim, 1), x = sim.x(0);
    int seen = 0;
    for (std::size_t i = 0; i < kind.size(); i++) {
      if (kind[i] != 1.0 || x[i] < item.off * d || x[i] > 1.0 - item.off * d) continue;
      EXPECT_NEAR(shift[i], item.expected, ROUNDING);
      seen++;
    }
    EXPECT_GE(seen, 3);
    if (item.off == 0.0) {
      EXPECT_LE(largest(shift_speed(sim)), ROUNDING);
    }
  }
}

// The two normals of the published variant differ on a rough surface, and act there alone
TEST(Shift, PublishedNormal)
{
  const Scene scene = patch(10).jitter(0.2);
  const auto with = [&scene](const char *words, std::vector<double> &kind) {
    Simulation sim(scene);
    Script script = free_script(scene, std::string("density variant published") + words);
    script.timestep = "timestep 0.01";
    sim.run(script.text() + FIELDS + "run 0");
    kind = sim.compute("c", 4);
    auto both = u(sim, 0);
    const auto y = u(sim, 1);
    both.insert(both.end(), y.begin(), y.end());
    return both;
  };
  std::vector<double> kind;
  const auto standard = with("", kind), lambda = with(" normal lambda", kind),
             color = with(" normal color", kind);
  EXPECT_EQ(standard, lambda);
  double most = 0.0;
  for (std::size_t i = 0; i < kind.size(); i++)
    for (const std::size_t k : {i, i + kind.size()}) {
      if (kind[i] != 1.0) {
        EXPECT_EQ(lambda[k], color[k]);
      }
      most = std::max(most, std::fabs(lambda[k] - color[k]));
    }
  EXPECT_GT(most, 1.0e-3 * largest(color));
}

// Accurate variant: nothing at all on a flat surface, farther from the corners of a patch than the
// support and once more the nearest neighbours, 4 d
TEST(Shift, AccurateSurface)
{
  const Scene scene = patch(20);
  Simulation sim(scene);
  Script script = free_script(scene, "density velocity 1.0 smoothing 0");
  script.timestep = "timestep 0.01";
  sim.run(script.text() + FIELDS + "run 0");
  const auto shift = shift_speed(sim), x = sim.x(0), y = sim.x(1);
  EXPECT_GT(largest(shift), 1e-4);
  for (std::size_t i = 0; i < x.size(); i++)
    if (std::fabs(x[i]) < 0.25 || std::fabs(y[i]) < 0.25) {
      EXPECT_LE(shift[i], ROUNDING);
    }
}

// A share above 1/2 is not taken: any large smoothing is the same
TEST(Shift, SmoothingIsBounded)
{
  const auto shift_with = [](const char *smoothing) {
    const Scene scene = patch(10).jitter(0.1);
    Simulation sim(scene);
    Script script = free_script(scene, fmt::format("density velocity 1.0 limit 10 {}", smoothing));
    script.timestep = "timestep 0.01";    // U dt/d = 0.1
    sim.run(script.text() + FIELDS + "run 0");
    return u(sim, 0);
  };
  const auto none = shift_with("smoothing 0"), normal = shift_with(""),
             given = shift_with("smoothing 1.5"), most = shift_with("smoothing 6.0"),
             more = shift_with("smoothing 60.0"), half = shift_with("smoothing 0.75");
  EXPECT_EQ(normal, given);
  EXPECT_EQ(most, more);
  // linear below: 1.5 U dt/d is twice 0.75 U dt/d, where the limit of the shift is not met
  std::vector<double> once(none.size()), twice(none.size());
  for (std::size_t i = 0; i < none.size(); i++) {
    once[i] = 2.0 * (half[i] - none[i]);
    twice[i] = normal[i] - none[i];
  }
  EXPECT_GT(largest(twice), 1e-3);
  EXPECT_LE(largest(once, twice), ROUNDING);
}

// Where the velocity is linear the filter does nothing; where it is rough it takes energy
TEST(Shift, VelocityFilter)
{
  const auto energy = [](const char *filter, const char *stir) {
    const Scene scene = patch(10);
    Simulation sim(scene);
    Script script = free_script(scene,
                                fmt::format("density step 0 velocity 1.0 smoothing 0 {}", filter));
    script.timestep = "timestep 0.005";
    script.predictor += " motion euler";    // else the places, and v of them, are not linear
    sim.run(script.text() + stir + "velocity all set v_u v_w 0\nrun 1");
    double sum = 0.0;
    for (int a = 0; a < 2; a++)
      for (const double value : sim.v(a)) sum += value * value;
    return sum;
  };
  const char *turn = "variable u atom -y\nvariable w atom x\n";
  const char *rough = "variable u atom sin(40*x)*cos(37*y)\nvariable w atom cos(35*x+20*y)\n";
  const double e0 = energy("filter 0", turn);
  EXPECT_NEAR(energy("filter 3", turn), e0, 1e-10 * e0);
  EXPECT_LT(energy("filter 3", rough), 0.99 * energy("filter 0", rough));
  EXPECT_EQ(energy("filter 3", rough), energy("", rough));
  // at U dt/d = 0.05 a filter of 20 is all there is
  EXPECT_EQ(energy("filter 25", rough), energy("filter 1000", rough));
  EXPECT_NE(energy("filter 19", rough), energy("filter 10", rough));
}

/* ----------------------------------------------------------------------
   Flows
------------------------------------------------------------------------- */

// Lagrangian particles crowd at the stagnation points; at t = 0.16 the run is lost
TEST(Shift, TaylorGreen)
{
  const auto error = [](const std::string &shift) {
    const Scene scene = periodic_square(20);
    Simulation sim(scene);
    Script script = shift.empty() ? script_of(scene)
                                  : shifted_script(scene, shift + " velocity 1.0");
    script.predictor += " nu 0.01";
    script.timestep = "timestep 0.004";
    const std::string message = sim.error_of(script.text() + TAYLOR_GREEN + "run 75");
    return message.empty() ? relative_l2(sim.v(0), sim.compute("ex", 1)) : 1.0;
  };
  EXPECT_GE(error(""), 0.5);
  EXPECT_LE(error("density"), 0.02);
  EXPECT_LE(error("fickian"), 0.02);
}

// Flow between plates, steady: the particles near the walls lag by several spacings
TEST(Shift, Channel)
{
  const Scene scene = channel(8, 10);
  for (const auto &model : models()) {
    SCOPED_TRACE(model);
    Simulation sim(scene);
    Script script = shifted_script(scene, model + " velocity 0.5");
    script.body = fmt::format("fix push all addforce {} 0 0", scene.d * scene.d);
    script.predictor += " nu 1.0";
    script.timestep = fmt::format("timestep {}\nvariable u atom 0.5*(1-y^2)\n"
                                  "velocity fluid set v_u 0 0",
                                  0.2 * scene.d * scene.d);
    sim.run(script.text() + "run 320");    // to t = 1
    const auto exact = sim.at_particles(
        [](double, double y, double) { return 0.5 * (1.0 - y * y); });
    EXPECT_LE(relative_l2(sim.v(0), exact), 0.01);
  }
}

/* ----------------------------------------------------------------------
   Runs that go on
------------------------------------------------------------------------- */

namespace {

struct Setting {
  const char *name, *shift, *guard, *dt;
};

const std::vector<Setting> &settings()
{
  static const std::vector<Setting> all = {
      {"density", "density velocity 2.0 limit 0.02", "", ""},
      {"strain", "density limit 0.02", "", ""},
      {"ops", "ops velocity 2.0", "", ""},
      {"all guards", "density velocity 2.0 surface positive limit 0.02",
       "fix guard fluid aleisph/guard walls 0.6 collision 0.9 pressure 0 selfterm yes "
       "symmetric 0.5 cap 0.7",
       ""},
      {"steps chosen", "density velocity 2.0", "fix guard fluid aleisph/guard walls 0.6",
       "fix dt all aleisph/dt 3 cfl 0.1"},
      {"max", "density velocity max limit 0.02", "", ""}};
  return all;
}

Scene rough_dam()
{
  return dam(8).jitter(0.15);
}

Script dam_script(const Setting &setting)
{
  Script script = free_script(rough_dam(), setting.shift);
  script.body = "fix g all gravity 1.0 vector 0 -1 0";
  script.predictor += " nu 0.001";
  script.guard = setting.guard;
  script.timestep = "timestep 0.01";
  script.dt = setting.dt;
  return script;
}

// everything that is stored, and what the fixes say
std::vector<double> state(const Simulation &sim)
{
  std::vector<double> all = sim.pressure();
  const auto append = [&all](const std::vector<double> &field) {
    all.insert(all.end(), field.begin(), field.end());
  };
  for (int a = 0; a < 2; a++) {
    append(sim.x(a));
    append(sim.v(a));
    append(u(sim, a));
  }
  return all;
}

std::vector<double> totals(const Simulation &sim, bool guard)
{
  std::vector<double> all;
  for (int k = 1; k <= 5; k++) all.push_back(sim.fix("shift", k));
  for (int k = 1; k <= (guard ? 18 : 0); k++) all.push_back(sim.fix("guard", k));
  return all;
}

constexpr char AFTER_RESTART[] = "\nneighbor 0.0375 bin\nneigh_modify every 1 delay 0 check yes\n";
// neighbour lists are made in every step and atoms stay in their order, so that a new set-up
// changes nothing
constexpr char SAME_ORDER[] = "atom_modify sort 0 0.0\nneigh_modify every 1 delay 0 check no\n";

}    // namespace

// Bitwise, in serial
TEST(ShiftRuns, TwoRunsAreOne)
{
  for (const auto &setting : settings()) {
    SCOPED_TRACE(setting.name);
    Simulation one(rough_dam()), two(rough_dam());
    const std::string script = SAME_ORDER + dam_script(setting).text() + FIELDS;
    one.run(script + "run 20");
    two.run(script + "run 10\nrun 0\nrun 10");
    if (one.ranks() == 1) {
      EXPECT_EQ(state(two), state(one));
      EXPECT_EQ(totals(two, *setting.guard), totals(one, *setting.guard));
    } else {
      EXPECT_LE(largest(state(two), state(one)), 1e-7);
    }
  }
}

TEST(ShiftRuns, RestartContinues)
{
  for (const auto &setting : settings()) {
    SCOPED_TRACE(setting.name);
    const std::string file = scratch_file("shift.restart");
    const Script script = dam_script(setting);
    Simulation first(rough_dam()), second;
    first.run(script.text() + FIELDS + "run 10\nwrite_restart " + file + "\nrun 10");
    second.run("read_restart " + file + AFTER_RESTART + script.text() + FIELDS + "run 10");
    EXPECT_EQ(second.variable("step"), 20.0);
    const auto a = totals(first, *setting.guard), b = totals(second, *setting.guard);
    if (first.ranks() == 1) {
      EXPECT_EQ(state(second), state(first));
      EXPECT_EQ(b, a);
    } else {
      EXPECT_LE(largest(state(second), state(first)), 1e-7);
      for (std::size_t k = 0; k < a.size(); k++) EXPECT_NEAR(a[k], b[k], 1e-7);
    }
  }
}

// run 0 after a restart: the shift of the step before, not a new one
TEST(ShiftRuns, RestartKeepsTheShift)
{
  const std::string file = scratch_file("u.restart");
  const Script script = dam_script(settings()[3]);
  Simulation first(rough_dam()), second;
  first.run(script.text() + FIELDS + "run 5\nwrite_restart " + file);
  second.run("read_restart " + file + AFTER_RESTART + script.text() + FIELDS + "run 0");
  for (int a = 0; a < 2; a++) EXPECT_EQ(u(second, a), u(first, a));
  EXPECT_EQ(second.fix("shift", 3), first.fix("shift", 3));
  for (int k = 7; k <= 12; k++) EXPECT_EQ(second.fix("guard", k), first.fix("guard", k));
  for (int k = 13; k <= 18; k++) EXPECT_NEAR(second.fix("guard", k), first.fix("guard", k), 1e-15);
}

// Each rank alone does what all do together, up to the tolerance of the solver
TEST(ShiftRuns, RanksAgree)
{
  for (const auto &setting : settings()) {
    SCOPED_TRACE(setting.name);
    const std::string script = dam_script(setting).text() + FIELDS + "run 20";
    Simulation all(rough_dam()), one(rough_dam(), MPI_COMM_SELF);
    if (all.ranks() == 1) GTEST_SKIP() << "several ranks";
    // between the ranks there is fluid
    all.run("balance 1.0 shift xy 20 1.01\n" + script);
    one.run(script);
    EXPECT_EQ(one.ranks(), 1);
    EXPECT_LE(largest(state(all), state(one)), 1e-7);
    const auto a = totals(all, *setting.guard), b = totals(one, *setting.guard);
    for (std::size_t k = 0; k < a.size(); k++) EXPECT_NEAR(a[k], b[k], 1e-7) << k;
  }
}

// another model from here on; and without the fix particles follow the fluid in frame lagrangian
TEST(ShiftRuns, ChangesBetweenRuns)
{
  Simulation sim(disorder());
  sim.run(still_script("density velocity 1.0").text() + FIELDS + "run 3");
  sim.run("unfix shift\nfix shift fluid aleisph/shift ops velocity 3.0\nrun 1");
  EXPECT_NEAR(sim.fix("shift", 1), 2.0 * 3.0 * 0.01 / 0.1, ROUNDING);
  sim.run("unfix shift\nunfix pred\nunfix ppe\nfix pred fluid aleisph/predictor\n"
          "fix ppe all aleisph/ppe");
  const auto x = sim.x(0);
  sim.run("run 3");
  EXPECT_EQ(sim.x(0), x);
  EXPECT_EQ(largest(u(sim, 0)), 0.0);
}

TEST(ShiftRuns, OutputBeforeTheFirstRun)
{
  Simulation sim(disorder());
  sim.run(still_script("density").text());
  for (int k = 1; k <= 5; k++) EXPECT_EQ(sim.fix("shift", k), 0.0);
  EXPECT_NE(sim.error_of("unfix sph\nprint \"$(f_shift[1])\"").find("needs a fix aleisph"),
            std::string::npos);
}

/* ----------------------------------------------------------------------
   Errors
------------------------------------------------------------------------- */

TEST(ShiftErrors, Command)
{
  const auto line = [](const std::string &words) {
    return [words](Script &s) {
      s.predictor += " frame ale";
      s.shift = "fix shift fluid aleisph/shift " + words;
    };
  };
  std::vector<ErrorCase> cases = {
      {"nothing", line(""), {"fix aleisph/shift", "issing"}},
      {"model",
       line("colour"),
       {"ix aleisph/shift", "model must be density, ops, fickian or tvf", "not colour"}},
      {"keyword", line("ops colour red"), {"ix aleisph/shift", "unknown keyword colour"}},
      {"value missing", line("ops rate"), {"fix aleisph/shift rate", "issing"}},
      {"variant",
       line("density variant best"),
       {"ix aleisph/shift", "variant must be accurate or published", "best"}},
      {"surface",
       line("density surface none"),
       {"ix aleisph/shift", "surface must be full or positive", "none"}},
      {"pair",
       line("density variant published pair odd"),
       {"ix aleisph/shift", "pair must be printed or symmetric", "odd"}},
      {"normal",
       line("density variant published normal up"),
       {"ix aleisph/shift", "normal must be lambda or color", "up"}},
      {"pair of another variant",
       line("density pair printed"),
       {"ix aleisph/shift: keyword pair needs model density, variant published"}},
      {"normal of another model",
       line("ops normal lambda"),
       {"ix aleisph/shift: keyword normal needs model density, variant published"}},
      {"velocity word", line("density velocity fast"), {"fast"}},
      {"variant of another model",
       line("ops variant accurate"),
       {"ix aleisph/shift: keyword variant needs model density"}},
      {"surface of another model",
       line("tvf surface full"),
       {"ix aleisph/shift: keyword surface needs model density"}},
      {"smoothing of another model",
       line("fickian smoothing 1"),
       {"ix aleisph/shift: keyword smoothing needs model density, variant accurate"}},
      {"filter of another variant",
       line("density filter 1 variant published"),
       {"ix aleisph/shift: keyword filter needs model density, variant accurate"}},
      {"both coefficients",
       line("density rate 0.3 step 0.005"),
       {"ix aleisph/shift: use either keyword rate or keyword step"}},
      {"velocity",
       line("density velocity -1"),
       {"ix aleisph/shift", "velocity must not be negative", "-1"}},
      {"strain of another model",
       line("ops velocity strain"),
       {"ix aleisph/shift: velocity strain needs model density, variant accurate"}},
      {"no variable",
       line("density velocity v_U"),
       {"ix aleisph/shift", "U is not an equal-style variable"}},
  };
  for (const char *key : {"rate", "step", "smoothing", "filter", "walls", "limit"})
    cases.push_back(
        {key,
         line(fmt::format("density {} -0.5", key)),
         {"ix aleisph/shift", fmt::format("{} must not be negative, it is -0.5", key)}});
  expect_errors(cases);
}

TEST(ShiftErrors, Variables)
{
  const auto with = [](const std::string &definition) {
    return [definition](Script &s) {
      s.owner = definition + "\n" + s.owner;
      s.predictor += " frame ale";
      s.shift = "fix shift fluid aleisph/shift density velocity v_U";
    };
  };
  expect_errors({
      {"atom style",
       with("variable U atom vx"),
       {"ix aleisph/shift", "U is not an equal-style variable"}},
      {"negative",
       with("variable U equal -1"),
       {"ix aleisph/shift", "variable U must not be negative", "-1", "step 0"}},
      {"negative later",
       with("variable U equal 0.5-step"),
       {"ix aleisph/shift", "variable U must not be negative", "-0.5", "step 1"}},
      {"infinite",
       with("variable U equal exp(1000)"),
       {"ix aleisph/shift", "variable U must not be negative", "inf", "step 0"}},
  });
}

TEST(ShiftErrors, Setup)
{
  const std::string shift = "\nfix shift fluid aleisph/shift density";
  const auto ale = [](Script &s) { s.predictor += " frame ale"; };
  expect_errors({
      {"no owner",
       [&](Script &s) { s = Script{}, s.shift = shift.substr(1); },
       {"ix aleisph/shift needs a fix aleisph", "defined before"}},
      {"ale without shift",
       ale,
       {"ix aleisph/predictor", "frame ale needs keyword transport or a fix aleisph/shift"}},
      {"lagrangian",
       [&](Script &s) { s.shift = shift.substr(1); },
       {"ix aleisph/shift needs frame ale in fix aleisph/predictor"}},
      {"eulerian",
       [&](Script &s) { s.shift = shift.substr(1), s.predictor += " frame eulerian"; },
       {"ix aleisph/shift needs frame ale in fix aleisph/predictor"}},
      {"transport",
       [&](Script &s) { s.shift = shift.substr(1), s.predictor += " frame ale transport 0 0 0"; },
       {"ix aleisph/predictor", "transport cannot be used with fix aleisph/shift"}},
      {"two",
       [&](Script &s) {
         ale(s);
         s.shift = shift.substr(1) + "\nfix s2 fluid aleisph/shift ops";
       },
       {"ix aleisph/shift: there must be only one"}},
      {"group",
       [&](Script &s) { ale(s), s.shift = "fix shift all aleisph/shift density"; },
       {"ix aleisph/shift: group must be that of fix pred, fluid"}},
      {"before ppe",
       [&](Script &s) { ale(s), s.predictor += shift; },
       {"ppe (aleisph/ppe)", "must be defined before", "shift (aleisph/shift)"}},
      {"after guard",
       [&](Script &s) {
         ale(s);
         s.guard = "fix guard fluid aleisph/guard" + shift;
       },
       {"shift (aleisph/shift)", "must be defined before", "guard (aleisph/guard)"}},
  });
}

// a velocity that is not finite is seen before particles move
TEST(ShiftErrors, NotFinite)
{
  Simulation sim(small_channel());
  Script script = small_script();
  script.predictor += " frame ale";
  script.shift = "fix shift fluid aleisph/shift density";
  script.body = "variable bad equal exp(1000*(step>2.5))-exp(1000*(step>2.5))\n"
                "group one id 42\nfix push one addforce v_bad 0 0";
  expect_words(sim.error_of(script.text() + "run 5"),
               {"ix aleisph", "atom 42", "finite", "step 3"});
}

TEST(ShiftErrors, ShiftNotFinite)
{
  // no pressure, but a square that overflows
  Simulation sim(disorder());
  expect_words(
      sim.error_of(still_script("ops velocity max").text() + "velocity all set 1e155 0 0\nrun 0"),
      {"ix aleisph/shift", "shift of atom", "is not finite at step 0"});
}
