// SPDX-License-Identifier: GPL-2.0-only
/* ----------------------------------------------------------------------
   Values that a script gives as variables: what a compute in them gives is
   that of the step, whatever the output asks for.
------------------------------------------------------------------------- */

#include "errors.h"

#include <algorithm>

namespace {

// c_now: the step at which it has been computed last
const std::string CLOCK = "variable s atom step\n"
                          "compute now all reduce max v_s\n"
                          "variable u equal c_now\n"
                          "variable ua atom v_u\n"
                          "thermo 100\n";

constexpr int STEPS = 5;

}    // namespace

TEST(Variables, WallVelocityIsThatOfTheStep)
{
  const Scene scene = small_channel();
  Simulation sim(scene);
  Script script = small_script();
  script.wall = CLOCK + "fix wall wall aleisph/wall velocity v_u 0 0";
  sim.run(script.text() + fmt::format("run {}", STEPS));
  const auto type = sim.type(), vx = sim.v(0);
  for (std::size_t i = 0; i < type.size(); i++)
    if (type[i] == Scene::WALL) {
      ASSERT_EQ(vx[i], STEPS);
    }
}

TEST(Variables, PressureIsThatOfTheStep)
{
  for (const char *name : {"v_u", "v_ua"}) {
    SCOPED_TRACE(name);
    Simulation sim(small_channel());
    Script script = small_script();
    script.pressure = CLOCK + "group some id 1\nfix p some aleisph/pressure " + name;
    sim.run(script.text() + fmt::format("run {}", STEPS));
    EXPECT_EQ(sim.pressure()[0], STEPS);
  }
}

// w = step: x grows by dt (0 + 1 + ... + 4)
TEST(Variables, TransportIsThatOfTheStep)
{
  for (const char *name : {"v_u", "v_ua"}) {
    SCOPED_TRACE(name);
    Simulation sim(small_channel());
    Script script = small_script();
    script.timestep = "timestep 1e-3";
    script.predictor = CLOCK + script.predictor + " frame ale transport " + name + " 0 0";
    const auto type = sim.type();
    const auto fluid = std::find(type.begin(), type.end(), Scene::FLUID) - type.begin();
    const double before = sim.x(0)[fluid];
    sim.run(script.text() + fmt::format("run {}", STEPS));
    EXPECT_NEAR(sim.x(0)[fluid] - before, 1e-3 * 10.0, 1e-12);
  }
}

TEST(Variables, VelocityScaleOfShiftingIsThatOfTheStep)
{
  Simulation sim(small_channel());
  Script script = small_script();
  script.predictor = CLOCK + "variable U equal 1.5-c_now\n" + script.predictor + " frame ale";
  script.shift = "fix shift fluid aleisph/shift density velocity v_U";
  expect_words(sim.error_of(script.text() + "run 5"),
               {"ix aleisph/shift: variable U must not be negative", "-0.5 at step 2"});
}

TEST(Variables, ContactAngleIsThatOfTheStep)
{
  for (const char *style : {"equal", "atom"}) {
    SCOPED_TRACE(style);
    const Scene scene = open_tank(2, 8);
    Simulation sim(scene);
    Script script = free_script(scene);
    script.surface += fmt::format("\n{}variable theta {} 178.5+v_u\n"
                                  "fix tens fluid aleisph/tension sigma 1e-3 angle wall v_theta",
                                  CLOCK, style);
    script.timestep = "timestep 1e-4";
    expect_words(sim.error_of(script.text() + "run 5"),
                 {"ix aleisph/tension: variable theta must lie between", "at step 2"});
  }
}

// Some computes collect while a step runs, and stop with an error if they were not told before
TEST(Variables, ComputesAreTold)
{
  const std::string pressure = "variable u equal 0.0*c_thermo_press\nthermo 100\n";
  Simulation sim(small_channel());
  Script script = small_script();
  script.wall = pressure + "fix wall wall aleisph/wall velocity v_u 0 0";
  EXPECT_EQ(sim.error_of(script.text() + "run 3"), "");

  Simulation moved(small_channel());
  script = small_script();
  script.predictor = pressure + script.predictor + " frame ale transport v_u 0 0";
  EXPECT_EQ(moved.error_of(script.text() + "run 3"), "");
}

// One form of message for all of them, also for a variable that is deleted between two runs
TEST(Variables, Missing)
{
  Simulation sim(small_channel());
  Script script = small_script();
  script.wall = "variable u equal 0.0\nfix wall wall aleisph/wall velocity v_u 0 0";
  sim.run(script.text() + "run 1\nvariable u delete");
  expect_words(sim.error_of("run 1"),
               {"ix aleisph/wall: u is not an equal-style variable; keyword velocity needs one"});
}
