// SPDX-License-Identifier: GPL-2.0-only
/* ----------------------------------------------------------------------
   Flow between two plates. The corrected Laplacian is exact for quadratic
   fields, so the steady profiles have no spatial error.
------------------------------------------------------------------------- */

#include "script.h"
#include "simulation.h"

#include <gtest/gtest.h>

#include <array>

namespace {

// rho = nu = 1, half width 1, body force 1: u = (1 - y^2)/2
double parabola(double, double y, double)
{
  return 0.5 * (1.0 - y * y);
}

Script driven_script(const Scene &scene, const std::string &keywords)
{
  Script script = script_of(scene);
  script.body = fmt::format("fix push all addforce {} 0 0", scene.d * scene.d);
  script.predictor += " nu 1.0 " + keywords;
  return script;
}

}    // namespace

// 200 steps; rounding errors of 1e-16 u per step do not grow
TEST(Channel, SteadyProfileDoesNotChange)
{
  for (const char *keywords : {"frame eulerian", "frame eulerian integrator ab2",
                               "frame eulerian scheme be", "frame eulerian scheme cn"}) {
    SCOPED_TRACE(keywords);
    const Scene scene = channel(6, 8);
    Simulation sim(scene);
    Script script = driven_script(scene, keywords);
    script.timestep = fmt::format("timestep {}\nvariable u atom 0.5*(1-y^2)\n"
                                  "velocity fluid set v_u 0 0",
                                  0.1 * scene.d * scene.d);
    sim.run(script.text() + "run 200");
    EXPECT_LE(largest(sim.v(0), sim.at_particles(parabola)), 1e-9);
    EXPECT_LE(largest(sim.v(1)), 1e-9);
    EXPECT_LE(largest(sim.pressure()), 1e-9);
  }
}

// The same seen from an observer that moves with -3 along x: particles and walls all move with 3
TEST(Channel, SteadyProfileInAMovingFrame)
{
  for (const char *keywords : {"", " integrator ab2", " scheme be"}) {
    SCOPED_TRACE(keywords);
    const Scene scene = channel(6, 8);
    Simulation sim(scene);
    Script script = driven_script(scene, std::string("frame ale transport 3.0 0 0") + keywords);
    script.wall += "\nfix carry wall move linear 3.0 0 0";
    script.timestep = fmt::format("timestep {}\nvariable u atom 3.0+0.5*(1-y^2)\n"
                                  "velocity all set v_u 0 0",
                                  0.1 * scene.d * scene.d);
    sim.run(script.text() + "run 200");
    const auto exact = sim.at_particles(
        [](double, double y, double) { return 3.0 + parabola(0, y, 0); });
    EXPECT_LE(largest(sim.v(0), exact), 1e-9);
    EXPECT_LE(largest(sim.v(1)), 1e-9);
    EXPECT_LE(largest(sim.pressure()), 1e-9);
  }
}

// Particles that follow the flow shear the lattice. The gradient is exact for linear fields only,
// so that div u of the quadratic profile is then not zero, but of order d^2 u'' d/H = 1/n^3.
TEST(Channel, SteadyProfileInALagrangianFrame)
{
  const Scene scene = channel(6, 8);
  Simulation sim(scene);
  Script script = driven_script(scene, "frame lagrangian");
  script.timestep = fmt::format("timestep {}\nvariable u atom 0.5*(1-y^2)\n"
                                "velocity fluid set v_u 0 0",
                                0.1 * scene.d * scene.d);
  sim.run(script.text() + "run 200");
  EXPECT_LE(largest(sim.v(0), sim.at_particles(parabola)), 5e-3);
  EXPECT_LE(largest(sim.v(1)), 5e-3);
}

namespace {

// Between prescribed pressures, x = 0 and x = 2: dp/dx = -1. Marches from rest to the steady state.
Script pressure_driven_script(const Scene &scene, const std::string &keywords,
                              double viscous_number)
{
  Script script = script_of(scene);
  script.pressure = "region left block INF 1.0 INF INF INF INF\ngroup left region left\n"
                    "group right subtract all left\ngroup lin intersect left inlet\n"
                    "group rin intersect right inlet\ngroup lbuf intersect left buffer\n"
                    "group rbuf intersect right buffer\nvariable p0 atom 2-x\n"
                    "fix lin lin aleisph/pressure v_p0 buffer lbuf 1 0 0\n"
                    "fix rin rin aleisph/pressure v_p0 buffer rbuf -1 0 0";
  script.predictor += " frame eulerian nu 1.0 " + keywords;
  script.timestep = fmt::format("timestep {}", viscous_number * scene.d * scene.d);
  return script;
}

}    // namespace

// The slowest mode decays as exp(-2.47 t). Backward Euler takes from it a factor 1/(1 + 2.47 dt)
// in a step; `steps` bring 1e-8 of 0.5 with a margin of 100. Crank-Nicolson hardly damps the
// fastest modes when dt is large, so that it is meant for up to 10 times the explicit limit, 0.4.
TEST(Channel, ImplicitSteadyStateDoesNotDependOnTheTimeStep)
{
  struct Case {
    const char *keywords;
    double times_limit;
    int steps;
  };
  for (const auto &item :
       {Case{"scheme be", 1.0, 400}, Case{"scheme be", 10.0, 60}, Case{"scheme be", 100.0, 30},
        Case{"scheme cn", 1.0, 400}, Case{"scheme cn", 10.0, 100}}) {
    SCOPED_TRACE(fmt::format("{}, {} times the limit", item.keywords, item.times_limit));
    const Scene scene = open_channel(4, 8);
    Simulation sim(scene);
    const Script script = pressure_driven_script(scene, item.keywords, 0.4 * item.times_limit);
    sim.run(script.text() + fmt::format("run {}", item.steps));
    EXPECT_LE(largest(sim.v(0), sim.at_particles(parabola)), 0.5e-8);
    EXPECT_LE(largest(sim.v(1)), 0.5e-8);
    const auto exact = sim.at_particles([](double x, double, double) { return 2.0 - x; });
    EXPECT_LE(largest(sim.pressure(), exact), 1e-7);
  }
}

TEST(Channel, ExplicitPressureDriven)
{
  const Scene scene = open_channel(4, 8);
  Simulation sim(scene);
  sim.run(pressure_driven_script(scene, "", 0.3).text() + "run 500");
  EXPECT_LE(largest(sim.v(0), sim.at_particles(parabola)), 0.5e-8);
  EXPECT_EQ(sim.fix("sph", 3), 2 * 4 * 7);    // Dirichlet rows: 4 columns of 7 at each end
  EXPECT_EQ(sim.fix("sph", 4), 2 * 3 * 7);    // of which buffer
}

/* ----------------------------------------------------------------------
   Couette flow: u = (1 + y)/2 when the upper wall moves with 1
------------------------------------------------------------------------- */

namespace {

Script couette_script(const Scene &scene, const std::string &upper)
{
  Script script = script_of(scene);
  script.wall = "region up block INF INF 0.5 INF INF INF\ngroup up region up\n"
                "group top intersect up wall\ngroup bottom subtract wall top\n"
                "fix bottom bottom aleisph/wall\n" +
      upper;
  return script;
}

void expect_couette(const Simulation &sim, double tolerance)
{
  EXPECT_LE(
      largest(sim.v(0), sim.at_particles([](double, double y, double) { return 0.5 * (1.0 + y); })),
      tolerance);
  EXPECT_LE(largest(sim.v(1)), tolerance);
}

}    // namespace

// a wall that has been accelerated, and the four ways to say so
TEST(Channel, Couette)
{
  const std::string wall = "fix top top aleisph/wall";
  for (const std::string &upper :
       {wall + " velocity 1.0 0.0 0.0",
        "variable uw equal time*(time<1)+(time>=1)\n" + wall + " velocity v_uw 0.0 0.0",
        wall + "\nvelocity top set 1.0 0 0",    // velocity of the wall atoms themselves
        wall + "\nfix m top move linear 1.0 0.0 0.0"}) {
    SCOPED_TRACE(upper);
    const Scene scene = channel(4, 8);
    Simulation sim(scene);
    Script script = couette_script(scene, upper);
    script.predictor += " nu 1.0 scheme be";
    script.timestep = "timestep 0.1";
    sim.run(script.text() + "run 100");
    expect_couette(sim, 1e-9);
  }
}

// walls have the velocity of this step, not of the one before
TEST(Channel, WallVelocityIsThatOfTheStep)
{
  const Scene scene = channel(4, 8);
  Simulation sim(scene);
  Script script = script_of(scene);
  script.wall = "variable uw equal 0.5*step\nfix wall wall aleisph/wall velocity v_uw 0 0";
  sim.run(script.text() + "run 3");
  const auto type = sim.type();
  const auto v = sim.v(0);
  for (std::size_t i = 0; i < v.size(); i++) EXPECT_EQ(v[i], type[i] == Scene::WALL ? 1.5 : 0.0);
}

// Narrower than the support of 2.4 d a particle meets its own images
TEST(Channel, NarrowPeriodicBox)
{
  const auto flow = [](int columns) {
    const Scene scene = channel(5, columns);
    Simulation sim(scene);
    Script script = script_of(scene);
    script.body = "fix g all gravity 1.0 vector 0.6 -0.8 0";
    script.predictor += " nu 1.0 frame eulerian";
    script.timestep = "timestep 0.004";
    sim.run(script.text() + "run 20");
    return std::array<double, 3>{largest(sim.v(0)), largest(sim.v(1)), largest(sim.pressure())};
  };
  const auto wide = flow(10);
  EXPECT_GT(wide[0], 0.01);
  for (const int columns : {1, 2, 3})
    for (int k = 0; k < 3; k++) EXPECT_NEAR(flow(columns)[k], wide[k], 1e-9);
}

// Start-up against the series solution; second order, about 1/n^2 of the largest velocity
TEST(Channel, StartUp)
{
  double error[2];
  for (int k = 0; k < 2; k++) {
    const int n = k ? 10 : 5;
    const Scene scene = channel(n, 8);
    Simulation sim(scene);
    Script script = driven_script(scene, "frame eulerian integrator ab2");
    script.timestep = fmt::format("timestep {}", 0.05 / (n * n));
    sim.run(script.text() + "compute ex fluid aleisph/exact plane 1.0 1.0 1.0\n" +
            fmt::format("run {}", 4 * n * n));    // t = 0.2
    error[k] = relative_l2(sim.v(0), sim.compute("ex", 1));
  }
  EXPECT_LE(error[1], 0.01);
  EXPECT_GE(error[0] / error[1], 3.0);
}
