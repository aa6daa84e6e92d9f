// SPDX-License-Identifier: GPL-2.0-only
/* ----------------------------------------------------------------------
   Numbers that do not fit together, or do not fit the particles. Where a
   right number exists, the message says it, and it works.
------------------------------------------------------------------------- */

#include "atom.h"
#include "errors.h"

TEST(ValueErrors, CutoffTooSmall)
{
  Simulation sim(small_channel());
  const std::string script = small_script().text();
  const std::string message = sim.error_of("comm_modify cutoff 0.3\n" + script + "run 0");
  expect_words(message, {"ix aleisph", "0.3", "reach + skin"});
  const double needed = number_after(message, "use comm_modify cutoff ");
  EXPECT_NEAR(needed, 2.0 * 1.2 * 0.2 + 0.3 * 0.2, 1e-6);

  // as it is printed, it works
  Simulation again(small_channel());
  EXPECT_EQ(again.error_of(fmt::format("comm_modify cutoff {}\n", needed) + script + "run 1"), "");
}

TEST(ValueErrors, WrongMass)
{
  for (const char *mass : {"0.2", "0.0401"}) {
    Simulation sim(small_channel());
    sim.run(fmt::format("mass 2 {}", mass));
    const std::string message = sim.error_of(small_script().text() + "run 0");
    expect_words(message, {"ix aleisph", "mass of atom", "rho0 * spacing^2"});
    const double needed = number_after(message, "= ");
    EXPECT_NEAR(needed, 0.04, 1e-9);

    Simulation again(small_channel());
    again.run(fmt::format("mass * {}", needed));
    EXPECT_EQ(again.error_of(small_script().text() + "run 1"), "");
  }
}

// Particles of another spacing than the one that is said: their mass does not fit
TEST(ValueErrors, WrongSpacing)
{
  for (const double spacing : {0.1, 0.4}) {
    Simulation sim(small_channel());
    Script script = small_script();
    script.owner = fmt::format("fix sph all aleisph spacing {} rho0 1.0", spacing);
    expect_words(sim.error_of(script.text() + "run 0"), {"ix aleisph", "mass of atom", "spacing"});
  }
}

TEST(ValueErrors, MotionInZ)
{
  for (const int id : {105, 42}) {    // wall, fluid
    Simulation sim(small_channel());
    sim.set(sim.lammps().atom->v, id, 2, 0.1);
    expect_words(sim.error_of(small_script().text() + "run 0"),
                 {"ix aleisph", fmt::format("atom {} ", id), "velocity in z", "2d"});
  }
  expect_errors({
      {"wall",
       [](Script &s) { s.wall += " velocity 0 0 0.1"; },
       {"ix aleisph/wall", "velocity in z", "2d"}},
      {"wall, variable",
       [](Script &s) { s.wall = "variable w equal 0.1\n" + s.wall + " velocity 0 0 v_w"; },
       {"ix aleisph/wall", "velocity in z", "2d"}},
  });
}

TEST(ValueErrors, WallNormals)
{
  // atom 104 is in the upper wall
  const auto with_normals = [](double nx, double ny) {
    return [nx, ny](Script &s) {
      s.owner += fmt::format("\nfix np all property/atom d2_nrm 3\n"
                             "set group all d2_nrm[1] 0.0\nset group all d2_nrm[2] 1.0\n"
                             "set group all d2_nrm[3] 0.0\nset atom 104 d2_nrm[1] {}\n"
                             "set atom 104 d2_nrm[2] {}",
                             nx, ny);
      s.wall += " normals given nrm";
    };
  };
  const Words bad = {"ix aleisph/wall", "normal of atom 104", "not a unit vector"};
  expect_errors({
      {"half", with_normals(0.0, 0.5), bad},
      {"zero", with_normals(0.0, 0.0), bad},
      {"twice", with_normals(0.0, 2.0), bad},
      {"diagonal", with_normals(1.0, 1.0), bad},
      {"no property",
       [](Script &s) { s.wall += " normals given nrm"; },
       {"ix aleisph/wall", "d2_nrm", "fix property/atom d2_nrm 3"}},
      {"integer property",
       [](Script &s) {
         s.owner += "\nfix np all property/atom i2_nrm 3";
         s.wall += " normals given nrm";
       },
       {"ix aleisph/wall", "d2_nrm", "fix property/atom d2_nrm 3"}},
      {"two columns",
       [](Script &s) {
         s.owner += "\nfix np all property/atom d2_nrm 2";
         s.wall += " normals given nrm";
       },
       {"ix aleisph/wall", "d2_nrm", "fix property/atom d2_nrm 3"}},
  });
}

// two wall particles alone in the middle of a box that has fluid elsewhere
TEST(ValueErrors, WallWithoutFluid)
{
  Scene scene = periodic_square(10);
  scene.boundary = "p f p";
  scene.high[1] = 3.0;
  scene.add(Scene::WALL, 0.5, 2.0);
  scene.add(Scene::WALL, 0.6, 2.0);
  Simulation sim(scene);
  expect_words(
      sim.error_of(script_of(scene).text() + "run 0"),
      {"ix aleisph/wall", "atom 102", "no fluid particle", "normal is unknown", "normals given"});
}

TEST(ValueErrors, Variables)
{
  expect_errors({
      {"wall, none",
       [](Script &s) { s.wall += " velocity v_u 0 0"; },
       {"ix aleisph/wall", "u", "equal-style variable"}},
      {"wall, atom style",
       [](Script &s) { s.wall = "variable u atom x\n" + s.wall + " velocity v_u 0 0"; },
       {"ix aleisph/wall", "u", "equal-style variable"}},
      {"pressure, none",
       [](Script &s) { s.pressure = "fix p fluid aleisph/pressure v_p0"; },
       {"ix aleisph/pressure", "p0", "equal- or atom-style"}},
      {"pressure, vector",
       [](Script &s) {
         s.pressure = "variable p0 vector [1,2]\nfix p fluid aleisph/pressure v_p0";
       },
       {"ix aleisph/pressure", "p0", "equal- or atom-style"}},
      {"transport, none",
       [](Script &s) { s.predictor += " frame ale transport v_w 0 0"; },
       {"ix aleisph/predictor", "w", "variable"}},
      {"transport, string",
       [](Script &s) {
         s.predictor = "variable w string abc\n" + s.predictor + " frame ale transport v_w 0 0";
       },
       {"ix aleisph/predictor", "w", "variable"}},
      {"transport, no number",
       [](Script &s) { s.predictor += " frame ale transport 1 abc 0"; },
       {"abc"}},
  });
}

TEST(ValueErrors, Buffer)
{
  const auto with_buffer = [](const std::string &direction, const std::string &frame) {
    return [=](Script &s) {
      s.owner += "\nregion right block 1.5 2 INF INF INF INF\n"
                 "group right region right\ngroup outlet intersect right fluid";
      s.pressure = "fix out outlet aleisph/pressure 0.0 buffer outlet " + direction;
      s.predictor += frame;
    };
  };
  expect_errors({
      {"lagrangian",
       with_buffer("-1 0 0", ""),
       {"ix aleisph/pressure", "buffer", "frame eulerian"}},
      {"ale",
       with_buffer("-1 0 0", " frame ale transport 0 0 0"),
       {"ix aleisph/pressure", "buffer", "frame eulerian"}},
      {"between two particles",
       with_buffer("-1 1 0", " frame eulerian"),
       {"ix aleisph/pressure", "buffer atom", "one spacing away", "direction"}},
      {"along z",
       with_buffer("0 0 1", " frame eulerian"),
       {"ix aleisph/pressure", "buffer atom", "one spacing away", "direction"}},
  });
}

TEST(ValueErrors, ExplicitViscosity)
{
  // d^2/nu = 0.04; the limit of nu dt/d^2 is 0.49 in 2d
  Script script = small_script();
  script.predictor += " nu 1.0";
  const auto message_at = [&script](double dt) {
    Simulation sim(small_channel());
    script.timestep = fmt::format("timestep {}", dt);
    std::string message = sim.error_of(script.text() + "run 1");
    if (message.empty()) message = sim.log();
    return message;
  };
  const std::string refused = message_at(0.6 * 0.04);
  expect_words(refused, {"ERROR", "ix aleisph/predictor", "unstable", "= 0.6;", "be or cn"});
  const double safe = number_after(refused, "timestep of at most ");
  EXPECT_GT(safe, 0.3 * 0.04);
  EXPECT_EQ(message_at(safe).find("explicit viscosity"), std::string::npos);

  const std::string warned = message_at(0.45 * 0.04);
  expect_words(warned, {"WARNING", "ix aleisph/predictor", "near the limit"});
  EXPECT_EQ(warned.find("ERROR"), std::string::npos);
  EXPECT_NEAR(number_after(warned, "timestep of at most "), safe, 1e-6 * safe);
}

// an implicit scheme has no limit, an inviscid fluid neither
TEST(ValueErrors, NoViscousLimit)
{
  for (const char *keywords : {" nu 1.0 scheme be", " nu 1.0 scheme cn", " nu 0.0", ""}) {
    Script script = small_script();
    script.predictor += keywords;
    script.timestep = "timestep 1.0";
    Simulation sim(small_channel());
    EXPECT_EQ(sim.error_of(script.text() + "run 1"), "");
    EXPECT_EQ(sim.log().find("explicit viscosity"), std::string::npos);
  }
}

// fix dt/reset and the timestep command between runs change the step after init()
TEST(ValueErrors, TimeStepRaisedBetweenRuns)
{
  Script script = small_script();
  script.predictor += " nu 1.0";
  Simulation sim(small_channel());
  sim.run(script.text() + "run 1");
  expect_words(sim.error_of("timestep 0.04\nrun 1"), {"ix aleisph/predictor", "unstable"});
}

TEST(ValueErrors, TimeStepNotPositive)
{
  for (const char *dt : {"0.0", "-0.01"})
    expect_errors({{dt,
                    [dt](Script &s) { s.timestep = fmt::format("timestep {}", dt); },
                    {"ix aleisph", "timestep", "positive"}}});
}

TEST(ValueErrors, CoincidentParticles)
{
  Scene scene = small_channel();
  scene.x[25] = scene.x[24];
  Simulation sim(scene);
  expect_words(sim.error_of(small_script().text() + "run 0"),
               {"ix aleisph", "1 pairs of particles", "same place"});
}
