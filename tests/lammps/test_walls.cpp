// SPDX-License-Identifier: GPL-2.0-only

#include "script.h"
#include "simulation.h"

#include <gtest/gtest.h>

#include <cmath>

// Uniform flow along walls without friction has no cause to change
TEST(Walls, SlipKeepsUniformFlow)
{
  for (const char *frame : {"frame lagrangian", "frame eulerian", "frame ale transport 0.3 0 0",
                            "frame lagrangian scheme be", "frame eulerian integrator ab2"})
    for (const double jitter : {0.0, 0.2}) {
      SCOPED_TRACE(fmt::format("{}, jitter {}", frame, jitter));
      const Scene scene = channel(5, 10).jitter(jitter);
      Simulation sim(scene);
      Script script = script_of(scene);
      script.wall += " condition slip";
      script.predictor += fmt::format(" nu 1.0 {}", frame);
      script.timestep = "timestep 0.004\nvelocity fluid set 1.0 0 0";
      sim.run(script.text() + "run 50");
      const auto type = sim.type();
      std::vector<double> expected;
      for (const double t : type) expected.push_back(t == Scene::FLUID ? 1.0 : 0.0);
      EXPECT_LE(largest(sim.v(0), expected), 1e-12);
      EXPECT_LE(largest(sim.v(1)), 1e-12);
    }
}

// Vortices between slip walls: the walls exert no force, and viscosity cannot make energy. Particles
// that move crowd at the stagnation points after half this time, if they are not shifted.
TEST(Walls, SlipMakesNoEnergy)
{
  for (const char *frame : {"frame ale", "frame eulerian"}) {
    SCOPED_TRACE(frame);
    const bool moves = std::string(frame) == "frame ale";
    const Scene scene = channel(5, 10).jitter(0.1);
    Simulation sim(scene);
    Script script = script_of(scene);
    script.wall += " condition slip";
    script.predictor += fmt::format(" nu 0.01 {}", frame);
    if (moves) script.shift = "fix shift fluid aleisph/shift density velocity 1.0";
    script.timestep = "timestep 0.01\nvariable u atom sin(PI*x)*cos(PI*y)\n"
                      "variable w atom -cos(PI*x)*sin(PI*y)\nvelocity fluid set v_u v_w 0\nrun 0";
    sim.run(script.text());
    const auto energy = [&sim] {
      double sum = 0.0;
      for (int a = 0; a < 2; a++)
        for (const double v : sim.v(a)) sum += v * v;
      return sum;
    };
    const double start = energy();
    sim.run("run 100");
    EXPECT_LE(energy(), start);
    EXPECT_GE(energy(), 0.5 * start);
  }
}

// A no-slip wall does slow the same flow down
TEST(Walls, NoSlipStopsUniformFlow)
{
  const Scene scene = channel(5, 10);
  Simulation sim(scene);
  Script script = script_of(scene);
  script.predictor += " nu 1.0";
  script.timestep = "timestep 0.01\nvelocity fluid set 1.0 0 0";
  sim.run(script.text() + "run 50");
  // 4/pi exp(-pi^2/4 nu t/H^2) in the middle
  EXPECT_NEAR(largest(sim.v(0)), 4.0 / M_PI * std::exp(-0.25 * M_PI * M_PI * 0.5), 0.02);
}

/* ----------------------------------------------------------------------
   A decaying Stokes mode, where the viscous force has a normal component
   at the wall. With explicit viscosity v* of the wall has it.
------------------------------------------------------------------------- */

namespace {

double stokes_pressure_error(const std::string &vstar)
{
  Scene scene = channel(10, 20);
  for (auto &position : scene.x) position[1] += 1.0;
  scene.low[1] += 1.0;
  scene.high[1] += 1.0;
  Simulation sim(scene);
  Script script = script_of(scene);
  script.wall += " vstar " + vstar;
  script.predictor += " frame eulerian nu 1.0";
  // a velocity of 1e-6: convection is negligible
  sim.run(script.text() +
          "timestep 0.001\n"
          "compute ex all aleisph/exact stokes 2.0 2.0 1e-6 1.0 1.0\nrun 0\n"
          "variable u atom c_ex[1]\nvariable w atom c_ex[2]\nvelocity fluid set v_u v_w 0\nrun 50");
  return relative_l2(without_mean(sim.pressure()), without_mean(sim.compute("ex", 4)));
}

}    // namespace

TEST(Walls, ViscousForceInThePressure)
{
  // 0.047 and 0.055: ten spacings between the walls
  EXPECT_LE(stokes_pressure_error("default"), 0.06);
  EXPECT_LE(stokes_pressure_error("curlcurl"), 0.06);
}

// where nothing is viscous, or nothing moves, curlcurl changes nothing
TEST(Walls, CurlCurlOfNothing)
{
  const Scene scene = tank(2, 8).jitter(0.1);
  std::vector<double> p[2];
  for (int k = 0; k < 2; k++) {
    Simulation sim(scene);
    Script script = script_of(scene);
    script.wall += k ? " vstar curlcurl" : " vstar default";
    script.body = "fix g all gravity 1.0 vector 0 -1 0";
    script.timestep = "timestep 0.01";
    sim.run(script.text() + "run 3");
    p[k] = sim.pressure();
  }
  EXPECT_EQ(p[0], p[1]);
}

/* ---------------------------------------------------------------------- */

// Normals that the wall finds, given back to it: the same run to the last bit
TEST(Walls, GivenNormals)
{
  for (const int dimension : {2, 3}) {
    const Scene scene = tank(dimension, 6).jitter(0.1);
    Script script = script_of(scene);
    script.body = fmt::format("fix g all gravity 1.0 vector 0 {} -1", dimension == 2 ? "-1" : "0");
    if (dimension == 2) script.body = "fix g all gravity 1.0 vector 0 -1 0";
    script.timestep = "timestep 0.01\nfix np all property/atom d2_nrm 3";
    Simulation automatic(scene), given(scene);
    automatic.run(script.text() + "run 3");

    given.run(script.text() +
              "compute n all aleisph/atom nx ny nz\nrun 0\n"
              "variable nx atom c_n[1]\nvariable ny atom c_n[2]\nvariable nz atom c_n[3]\n"
              "set group wall d2_nrm[1] v_nx d2_nrm[2] v_ny d2_nrm[3] v_nz\n"
              "unfix ppe\nunfix pred\nunfix g\nunfix wall\nunfix sph");
    script.wall += " normals given nrm";
    script.timestep = "";
    given.run(script.text() + "run 3");
    EXPECT_EQ(given.pressure(), automatic.pressure());
    for (int a = 0; a < 3; a++) EXPECT_EQ(given.v(a), automatic.v(a));
  }
}

// A wall of its own fix for each side is the same as one fix for all
TEST(Walls, SeveralWallFixes)
{
  const Scene scene = tank(2, 8).jitter(0.1);
  Script script = script_of(scene);
  script.body = "fix g all gravity 1.0 vector 0.6 -0.8 0";
  script.predictor += " nu 0.1";
  script.timestep = "timestep 0.01\nvariable u atom sin(PI*x)\nvelocity fluid set v_u 0 0";
  Simulation one(scene), two(scene);
  one.run(script.text() + "run 5");
  script.wall = "region low block INF INF INF 0.45 INF INF\ngroup low region low\n"
                "group wlow intersect wall low\ngroup whigh subtract wall wlow\n"
                "fix wlow wlow aleisph/wall\nfix whigh whigh aleisph/wall";
  two.run(script.text() + "run 5");
  EXPECT_EQ(two.pressure(), one.pressure());
  EXPECT_EQ(two.v(0), one.v(0));
}

// slip on one side, no-slip on the other: half of a channel of twice the width
TEST(Walls, SlipAndNoSlip)
{
  const Scene scene = channel(5, 8);
  Simulation sim(scene);
  Script script = script_of(scene);
  script.wall = "region up block INF INF 0.5 INF INF INF\ngroup up region up\n"
                "group top intersect up wall\ngroup bottom subtract wall top\n"
                "fix bottom bottom aleisph/wall\nfix top top aleisph/wall condition slip";
  script.body = fmt::format("fix push all addforce {} 0 0", scene.d * scene.d);
  script.predictor += " nu 1.0 scheme be";
  script.timestep = "timestep 0.5";
  sim.run(script.text() + "run 100");
  // u = (1 + y)(3 - y)/2; the no-friction condition holds at the last fluid particle, d from the
  // wall, only to first order: 1 - d <= y_slip <= 1
  const auto y = sim.x(1), v = sim.v(0), type = sim.type();
  for (std::size_t i = 0; i < y.size(); i++)
    if (type[i] == Scene::FLUID) {
      EXPECT_LE(v[i], 0.5 * (1.0 + y[i]) * (3.0 - y[i]) * (1.0 + 1e-9));
      EXPECT_GE(v[i], 0.5 * (1.0 + y[i]) * (3.0 - 2.0 * scene.d - y[i]) * (1.0 - 1e-9));
    }
}
