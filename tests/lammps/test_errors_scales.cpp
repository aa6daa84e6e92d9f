// SPDX-License-Identifier: GPL-2.0-only
/* ----------------------------------------------------------------------
   Values that are numbers, but that no scene can have: the message says what
   is too large or too small, before anything is computed with it.
------------------------------------------------------------------------- */

#include "errors.h"

#include <filesystem>

TEST(ScaleErrors, SpacingThatDoesNotFitTheBox)
{
  for (const char *spacing : {"1e308", "1e150", "100", "1e-12", "1e-300"})
    expect_errors({{spacing,
                    [spacing](Script &s) {
                      s.owner = fmt::format("fix sph all aleisph spacing {} rho0 1.0", spacing);
                    },
                    {"ix aleisph: spacing", "does not fit a box whose longest edge is", "units"}}});
  for (const char *rho0 : {"1e-307", "2e-307"})
    expect_errors({{rho0,
                    [rho0](Script &s) {
                      s.owner = fmt::format("fix sph all aleisph spacing 0.2 rho0 {}", rho0);
                    },
                    {"ix aleisph: rho0", "mass that is no number"}}});
}

TEST(ScaleErrors, FluidFileThatIsADirectory)
{
  const std::string folder = scratch_file("folder.aleisph");
  std::filesystem::create_directories(folder);
  expect_errors({{"directory",
                  [&](Script &s) { s.owner = "fix sph all aleisph spacing 0.2 fluid " + folder; },
                  {"ix aleisph: fluid property file", folder, "is a directory"}}});
}

TEST(ScaleErrors, Pressure)
{
  expect_errors(
      {{"prescribed",
        [](Script &s) { s.pressure = "group one id 1\nfix p one aleisph/pressure 1e150"; },
        {"ix aleisph/pressure: pressure of atom 1 is above", "at step 0", "units"}},
       {"surface",
        [](Script &s) { s.surface = "fix surf fluid aleisph/surface pressure 1e150"; },
        {"ix aleisph/surface: pressure 1e+150 is above", "units"}},
       {"guard",
        [](Script &s) { s.guard = "fix guard fluid aleisph/guard pressure -1e150"; },
        {"ix aleisph/guard: pressure -1e+150 is above", "units"}}});
}

// 1e12 rho0 (d/dt)^2 = 4e14 here
TEST(ScaleErrors, LargestPressure)
{
  for (const double share : {0.99, 1.01}) {
    Simulation sim(small_channel());
    Script script = small_script();
    script.surface = fmt::format("fix surf fluid aleisph/surface pressure {}", share * 4.0e14);
    const std::string message = sim.error_of(script.text() + "run 0");
    if (share > 1.0)
      expect_words(message, {"is above 4e+14"});
    else
      EXPECT_EQ(message.find("is above"), std::string::npos);
  }
}

TEST(ScaleErrors, Shifting)
{
  const auto line = [](const std::string &text) {
    return [text](Script &s) {
      s.predictor += " frame ale";
      s.shift = "fix shift fluid aleisph/shift density velocity 1 " + text;
    };
  };
  for (const char *key : {"walls", "limit"})
    expect_errors({{key,
                    line(fmt::format("{} 1e308", key)),
                    {"ix aleisph/shift:", key, "must be at most 10, it is 1e308"}}});
  for (const char *key : {"rate", "step", "smoothing", "filter"})
    expect_errors({{key,
                    line(fmt::format("{} 1e308", key)),
                    {"ix aleisph/shift:", key, "must be at most 10000, it is 1e308"}}});
}

// a number and a variable, at the start and when it becomes too large: 1e4 d/dt is 2e5
TEST(ScaleErrors, ShiftVelocity)
{
  const auto message = [](const std::string &velocity) {
    Simulation sim(small_channel());
    Script script = small_script();
    script.predictor += " frame ale";
    script.shift =
        "variable U equal 1e5*(step+1)\nfix shift fluid aleisph/shift density velocity " + velocity;
    return sim.error_of(script.text() + "run 3");
  };
  for (const char *velocity : {"1e150", "1e308"})
    expect_words(
        message(velocity),
        {"ix aleisph/shift: velocity 1e+", "is above 2e+05 at step 0", "10000 spacings", "units"});
  expect_words(message("v_U"), {"ix aleisph/shift: velocity 300000", "is above 2e+05 at step 2"});
  EXPECT_EQ(message("1.9e5"), "");
}

TEST(ScaleErrors, Tension)
{
  const auto line = [](const std::string &text) {
    return [text](Script &s) {
      s.surface = "fix surf fluid aleisph/surface\nfix tens fluid aleisph/tension " + text;
    };
  };
  for (const char *key : {"filter", "factor", "delta"})
    expect_errors({{key,
                    line(fmt::format("sigma 1 model published {} 1e308", key)),
                    {"ix aleisph/tension:", key, "must be at most 10000, it is 1e308"}}});
  // 1e12 rho0 d^3/dt^2 = 8e13
  for (const char *sigma : {"1e14", "1e150", "1e308"})
    for (const char *dt : {"", "fix dt all aleisph/dt 1"})
      expect_errors({{sigma,
                      [&](Script &s) {
                        line(fmt::format("sigma {}", sigma))(s);
                        s.dt = dt;
                      },
                      {"ix aleisph/tension: sigma 1", "is above 8e+13", "units"}}});
  expect_errors({{"7e13", line("sigma 7e13"), {"above the capillary limit"}}});
}

TEST(ScaleErrors, Viscosity)
{
  // 1e12 d^2/dt = 4e12, whatever gives it and whatever the scheme
  for (const char *nu : {"nu 1e13", "nu 1e150", "nu 1e308", "mu 1e150"})
    for (const char *scheme : {"explicit", "be", "cn"})
      for (const char *dt : {"", "fix dt all aleisph/dt 1"})
        expect_errors({{nu,
                        [&](Script &s) {
                          s.predictor += fmt::format(" {} scheme {}", nu, scheme);
                          s.dt = dt;
                        },
                        {"ix aleisph/predictor: viscosity 1", "is above 4e+12", "units"}}});
  expect_errors(
      {{"3e12", [](Script &s) { s.predictor += " nu 3e12"; }, {"explicit viscosity is unstable"}}});
}

TEST(ScaleErrors, AlignBelowMin)
{
  expect_errors({{"align",
                  [](Script &s) { s.dt = "fix dt all aleisph/dt 10 min 1e-3 align 1e-6"; },
                  {"ix aleisph/dt: align 1e-06 is below min 0.001", "larger align"}}});
}
