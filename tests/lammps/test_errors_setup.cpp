// SPDX-License-Identifier: GPL-2.0-only
/* ----------------------------------------------------------------------
   Commands that do not fit together, and groups that do not fit: the
   error comes at the start of the run.
------------------------------------------------------------------------- */

#include "errors.h"

// `line` alone, or behind other fixes, without the owner
TEST(SetupErrors, MissingOwner)
{
  const Words fix = {"needs a fix aleisph", "defined before"};
  const std::vector<std::pair<std::string, std::string>> cases = {
      {"fix wall wall aleisph/wall", "ix aleisph/wall"},
      {"fix p fluid aleisph/pressure 0.0", "ix aleisph/pressure"},
      {"fix pred fluid aleisph/predictor", "ix aleisph/predictor"},
      {"fix ppe all aleisph/ppe", "ix aleisph/ppe"},
      {"compute c all aleisph/atom p", "ompute aleisph/atom"}};
  for (const auto &item : cases) {
    SCOPED_TRACE(item.first);
    Simulation sim(small_channel());
    Words words = fix;
    words.push_back(item.second);
    expect_words(sim.error_of(item.first + "\nrun 0"), words);
  }
}

TEST(SetupErrors, FixesThatMustBeAlone)
{
  expect_errors({
      {"two owners",
       [](Script &s) { s.owner += "\nfix sph2 all aleisph spacing 0.2 rho0 1.0"; },
       {"ix aleisph", "2 fixes of style aleisph", "must be one"}},
      {"two predictors",
       [](Script &s) { s.predictor += "\nfix pred2 fluid aleisph/predictor"; },
       {"ix aleisph/predictor", "only one"}},
      {"two pressure solvers",
       [](Script &s) { s.ppe += "\nfix ppe2 all aleisph/ppe"; },
       {"ix aleisph/ppe", "only one"}},
  });
}

// A set of fixes that lacks one would run and not solve the equations
TEST(SetupErrors, FixesThatMustBeThere)
{
  expect_errors({
      {"no pressure solver", [](Script &s) { s.ppe = ""; }, {"needs a fix aleisph/ppe"}},
      {"no predictor", [](Script &s) { s.predictor = ""; }, {"aleisph/predictor"}},
      {"nothing that moves the particles",
       [](Script &s) { s.predictor += " frame ale"; },
       {"ix aleisph/predictor", "frame ale needs keyword transport or a fix aleisph/shift"}},
  });
}

TEST(SetupErrors, OrderOfFixes)
{
  const auto swap = [](std::string Script::*a, std::string Script::*b) {
    return [=](Script &s) { std::swap(s.*a, s.*b); };
  };
  expect_errors({
      {"predictor after ppe",
       swap(&Script::predictor, &Script::ppe),
       {"pred (aleisph/predictor)", "must be defined before", "ppe (aleisph/ppe)"}},
      {"wall after predictor",
       swap(&Script::wall, &Script::predictor),
       {"wall (aleisph/wall)", "must be defined before", "pred (aleisph/predictor)"}},
      {"owner after wall",
       swap(&Script::owner, &Script::wall),
       {"sph (aleisph)", "must be defined before", "wall (aleisph/wall)"}},
      {"pressure after ppe",
       [](Script &s) { s.ppe += "\nfix out wall aleisph/pressure 0.0"; },
       {"out (aleisph/pressure)", "must be defined before", "aleisph/p"}},
      {"body force after predictor",
       [](Script &s) { s.ppe += "\nfix push all addforce 0.01 0 0"; },
       {"push (addforce)", "must be defined before", "pred (aleisph/predictor)"}},
      {"gravity after predictor",
       [](Script &s) { s.predictor += "\nfix g all gravity 1.0 vector 0 -1 0"; },
       {"g (gravity)", "must be defined before", "pred (aleisph/predictor)"}},
  });
}

TEST(SetupErrors, Groups)
{
  expect_errors({
      {"empty wall",
       [](Script &s) { s.wall = "group none type 4\nfix wall none aleisph/wall"; },
       {"ix aleisph/wall", "group none is empty"}},
      {"empty inlet",
       [](Script &s) { s.pressure = "fix in inlet aleisph/pressure 1.0"; },
       {"ix aleisph/pressure", "group inlet is empty"}},
      {"empty buffer",
       [](Script &s) {
         s.pressure = "fix in fluid aleisph/pressure 1.0 buffer buffer 1 0 0";
         s.predictor += " frame eulerian";
       },
       {"ix aleisph/pressure", "group buffer is empty"}},
      {"empty fluid",
       [](Script &s) { s.predictor = "fix pred inlet aleisph/predictor"; },
       {"ix aleisph/predictor", "group inlet is empty"}},
      {"empty owner",
       [](Script &s) { s.owner = "fix sph inlet aleisph spacing 0.2 rho0 1.0"; },
       {"ix aleisph", "group inlet is empty"}},
      {"wall left out",
       [](Script &s) { s.wall = ""; },
       {"atom", "neither fluid (group of fix aleisph/predictor) nor wall"}},
      {"owner's group too small",
       [](Script &s) {
         s.owner = "fix sph fluid aleisph spacing 0.2 rho0 1.0";
         s.ppe = "fix ppe fluid aleisph/ppe";
       },
       {"ix aleisph", "not in group fluid"}},
      {"fluid and wall",
       [](Script &s) { s.predictor = "fix pred all aleisph/predictor"; },
       {"atom", "is both fluid and wall"}},
      {"ppe of some",
       [](Script &s) { s.ppe = "fix ppe fluid aleisph/ppe"; },
       {"ix aleisph/ppe", "group"}},
      {"slip and no-slip",
       [](Script &s) { s.wall += "\ngroup one id 3\nfix lid one aleisph/wall condition slip"; },
       {"ix aleisph: atom 3 is given two values of condition", "no-slip by fix wall",
        "slip by fix lid", "take it out"}},
      {"two velocities",
       [](Script &s) {
         s.wall += " velocity 0 0 0\ngroup one id 3\nfix lid one aleisph/wall velocity 1 0 0";
       },
       {"atom 3", "two values of velocity: 0 0 0 by fix wall", "1 0 0 by fix lid"}},
      {"two ways to find v*",
       [](Script &s) { s.wall += "\ngroup one id 3\nfix lid one aleisph/wall vstar curlcurl"; },
       {"atom 3", "two values of vstar"}},
      {"two pressures",
       [](Script &s) {
         s.pressure = "group one id 42\nvariable p equal 2\n"
                      "fix a fluid aleisph/pressure 1.0\nfix b one aleisph/pressure v_p";
       },
       {"atom 42", "two values of pressure: 1 by fix a", "v_p by fix b"}},
      {"buffer outside of its pressure group",
       [](Script &s) {
         s.pressure = "region right block 1.5 2 INF INF INF INF\ngroup right region right\n"
                      "group fright intersect right fluid\ngroup one id 15\n"
                      "fix in one aleisph/pressure 1.0 buffer fright -1 0 0";
         s.predictor += " frame eulerian";
       },
       {"buffer atom", "not in the group", "aleisph/pressure"}},
  });
}

TEST(SetupErrors, OtherCommandsOfLammps)
{
  expect_errors({
      {"respa",
       [](Script &s) { s.timestep += "\nrun_style respa 2 2"; },
       {"ix aleisph", "run_style respa", "use run_style verlet"}},
      {"exclude",
       [](Script &s) { s.timestep += "\nneigh_modify exclude type 1 2"; },
       {"ix aleisph", "neigh_modify exclude"}},
      {"include",
       [](Script &s) { s.timestep += "\natom_modify first fluid\nneigh_modify include fluid"; },
       {"ix aleisph", "neigh_modify include fluid", "use neigh_modify include all"}},
      {"neighbor multi",
       [](Script &s) { s.timestep += "\nneighbor 0.06 multi"; },
       {"ix aleisph", "use neighbor 0.06 bin"}},
      {"neighbor multi/old",
       [](Script &s) { s.timestep += "\nneighbor 0.06 multi/old"; },
       {"ix aleisph", "use neighbor 0.06 bin"}},
      {"lists every ten steps",
       [](Script &s) { s.timestep += "\nneigh_modify every 10"; },
       {"ix aleisph", "neigh_modify every 10 delay 0", "use neigh_modify every 1 delay 0"}},
      {"lists delayed",
       [](Script &s) { s.timestep += "\nneigh_modify delay 5"; },
       {"ix aleisph", "delay 5", "use neigh_modify every 1 delay 0"}},
      {"lists never",
       [](Script &s) { s.timestep += "\nneigh_modify once yes"; },
       {"ix aleisph", "once yes", "once no"}},
      {"box that is stretched",
       [](Script &s) { s.wall += "\nfix def all deform 1 x erate 0.5 remap x"; },
       {"ix aleisph", "fix def (deform)", "changes the box", "unfix it"}},
      {"box that grows round the particles",
       [](Script &s) { s.wall += "\nfix def all deform 1 x erate 0.5 remap none"; },
       {"ix aleisph", "fix def (deform)", "changes the box"}},
      {"multi",
       [](Script &s) { s.timestep += "\nneighbor 0.06 multi\ncomm_modify mode multi"; },
       {"ix aleisph", "comm_modify mode single"}},
      {"second integrator",
       [](Script &s) { s.predictor += "\nfix nve fluid nve"; },
       {"nve (nve)", "would integrate fluid atoms", "pred (aleisph/predictor)"}},
      {"integrator of all, first",
       [](Script &s) { s.wall += "\nfix nve all nve"; },
       {"nve (nve)", "would integrate fluid atoms", "pred (aleisph/predictor)"}},
  });
  expect_errors({{"minimize", [](Script &) {}, {"ix aleisph", "minimize", "unfix"}}},
                "minimize 1e-4 1e-4 10 10");
}

// Particles at rest may keep their lists; a wall that moves is noticed
TEST(SetupErrors, ListsThatAreKept)
{
  Simulation sim(small_channel());
  Script script = small_script();
  script.predictor += " frame eulerian";
  script.timestep += "\nneigh_modify every 10 delay 0";
  EXPECT_EQ(sim.error_of(script.text() + "run 3"), "");
  expect_words(sim.error_of("fix m wall move linear 0.1 0 0\nrun 3"),
               {"ix aleisph", "neigh_modify every 10", "use neigh_modify every 1"});
}

// The same point twice, up to rounding or so
TEST(SetupErrors, ParticlesInOnePlace)
{
  for (const double apart : {1e-15, 1e-12, 1e-6, 1.9e-3}) {    // spacing 0.2
    Simulation sim(small_channel());
    sim.run(fmt::format("create_atoms 1 single {:.17g} 0.2 0 units box\ngroup fluid type 1",
                        0.3 + apart));
    expect_words(sim.error_of(small_script().text() + "run 0"),
                 {"ix aleisph: atom", "nearer than 0.002 to another one", "0.01 spacings"});
  }
  Simulation sim(small_channel());
  sim.run("create_atoms 1 single 0.3021 0.2 0 units box\ngroup fluid type 1");
  EXPECT_EQ(sim.error_of(small_script().text() + "run 0"), "");
}

// walls may overlap where they say the same
TEST(SetupErrors, WallsThatAgree)
{
  Simulation sim(small_channel());
  Script script = small_script();
  script.wall += "\ngroup one id 3\nfix lid one aleisph/wall velocity 0 0 0\n"
                 "fix again one aleisph/wall velocity 0 0 0";
  EXPECT_EQ(sim.error_of(script.text() + "run 1"), "");
}

// LAMMPS itself looks at the exclusions only after the fixes have
TEST(SetupErrors, ExclusionBetweenRuns)
{
  Simulation sim(small_channel());
  sim.run(small_script().text() + "run 1\nneigh_modify exclude type 1 2");
  expect_words(sim.error_of("run 1"), {"ix aleisph", "neigh_modify exclude"});
  EXPECT_EQ(sim.error_of("neigh_modify exclude none\nrun 1"), "");
}

TEST(SetupErrors, Units)
{
  for (const std::string units : {"real", "metal", "electron"}) {
    Scene scene = small_channel();
    scene.units = units;
    Simulation sim(scene);
    expect_words(sim.error_of(small_script().text() + "run 0"),
                 {"ix aleisph", "units " + units, "use lj, si"});
  }
}
