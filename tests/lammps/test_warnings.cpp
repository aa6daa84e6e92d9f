// SPDX-License-Identifier: GPL-2.0-only
/* ----------------------------------------------------------------------
   What runs and is wrong all the same is told, once, with the remedy; and
   nothing is told where all is well.
------------------------------------------------------------------------- */

#include "errors.h"

#include <cmath>

namespace {

constexpr char GRAVITY[] = "fix g all gravity 1.0 vector 0 -1 0";

// warnings of the package in the log
int warnings(const std::string &log)
{
  int count = 0;
  for (auto at = log.find("WARNING: Fix aleisph"); at != std::string::npos;
       at = log.find("WARNING: Fix aleisph", at + 1))
    count++;
  return count;
}

// what is said in two runs of a tank that is open at the top
std::string log_of(const std::string &body, const std::string &runs = "run 2\nrun 2",
                   const std::string &step = "timestep 0.01")
{
  const Scene scene = open_tank(2, 8);
  Simulation sim(scene);
  Script script = free_script(scene);
  script.body = body;
  script.timestep = step;
  sim.error_of(script.text() + runs);    // what is warned of may end in an error
  return sim.log();
}

void expect_one_warning(const std::string &log, const Words &words)
{
  expect_words(log, words);
  EXPECT_EQ(warnings(log), 1) << log;
}

}    // namespace

TEST(Warnings, NoneWhereAllIsWell)
{
  EXPECT_EQ(warnings(log_of(GRAVITY)), 0);
  EXPECT_EQ(warnings(log_of("")), 0);
  // along the walls nothing must be balanced
  for (const char *group : {"all", "fluid"}) {
    Simulation sim(small_channel());
    Script script = small_script();
    script.body = std::string("fix push ") + group + " gravity 1.0 vector 1 0 0";
    sim.run(script.text() + "run 3");
    EXPECT_EQ(warnings(sim.log()), 0);
  }
}

TEST(Warnings, BodyForceOnFluidOnly)
{
  const Words words = {"body force on the fluid and none on wall atom", "group all"};
  expect_one_warning(log_of("fix g fluid gravity 1.0 vector 0 -1 0"), words);
  expect_one_warning(log_of(std::string(GRAVITY) + "\nfix s wall setforce 0 0 0"), words);
  // walls that are held before the force acts have it
  EXPECT_EQ(warnings(log_of(std::string("fix s wall setforce 0 0 0\n") + GRAVITY)), 0);
}

TEST(Warnings, WallsThatFall)
{
  const Words words = {"wall atom", "moved by the force on it", "NULL", "fix move"};
  expect_one_warning(log_of(std::string(GRAVITY) + "\nfix m wall move linear 0.1 NULL NULL"),
                     words);
  expect_one_warning(log_of(std::string(GRAVITY) + "\nfix m wall nve"), words);
  EXPECT_EQ(warnings(log_of(std::string(GRAVITY) + "\nfix m wall move linear 0.1 0 0")), 0);
  EXPECT_EQ(warnings(log_of(std::string(GRAVITY) + "\nfix m wall move wiggle 0.1 0 0 1.0")), 0);
  // without a force they do not
  EXPECT_EQ(warnings(log_of("fix m wall nve")), 0);
}

TEST(Warnings, TimeStep)
{
  const std::string stir = "velocity fluid set 10.0 0 0\nrun 1\nrun 1";
  expect_one_warning(log_of("", stir),
                     {"timestep 0.01 is too large at step 0", "cfl allows 0.0025",
                      "Courant number 0.8", "atom", "fix aleisph/dt"});
  // above the advisable step, and below half a spacing: Courant number 0.4
  expect_one_warning(log_of("", "velocity fluid set 5.0 0 0\nrun 0\nrun 0"),
                     {"timestep 0.01 is above the advisable one at step 0", "cfl allows 0.005",
                      "Courant number 0.4", "atom", "fix aleisph/dt"});
  // the advisable step, as the predictor gives it, is no reason for a warning, whatever bounds it
  for (const char *speed : {"0.1", "2.0"}) {
    const std::string advisable = "velocity fluid set " + std::string(speed) +
        " 0 0\nrun 0\nvariable most equal f_pred[4]\n";
    const auto said = [&](const char *factor) {
      return warnings(log_of(GRAVITY, advisable + "timestep $(" + factor + "*v_most:%.6g)\nrun 0",
                             "timestep 1e-6"));
    };
    EXPECT_EQ(said("1.0"), 0);
    EXPECT_EQ(said("1.001"), 1);
  }
  EXPECT_EQ(warnings(log_of("", "fix dt all aleisph/dt 1\n" + stir)), 0);
  // sqrt(d/a)/4
  expect_one_warning(log_of(GRAVITY, "run 1", "timestep 0.1"),
                     {"above the advisable one", "force allows 0.0883883"});
  // 2 nu/v^2 with forward Euler, particles at rest: ten times the step
  Simulation sim(small_channel());
  Script script = small_script();
  script.predictor += " frame eulerian nu 0.1";
  script.timestep = "timestep 0.02\nvelocity fluid set 10.0 0 0";
  sim.error_of(script.text() + "run 1");
  expect_one_warning(sim.log(), {"too large", "convection allows 0.002"});
}

// A scene that gets faster during the run: above the advisable step from Courant number 0.2 on, and
// too large from 0.5 on
TEST(Warnings, TimeStepDuringTheRun)
{
  Simulation sim(small_channel());
  Script script = small_script();
  script.body = "fix push all gravity 5.0 vector 1 0 0";
  sim.run(script.text() + "run 70");    // Courant number 0.175
  EXPECT_EQ(warnings(sim.log()), 0);
  sim.run("run 80");    // 0.375; looked at after 16 steps
  expect_one_warning(sim.log(), {"timestep 0.01 is above the advisable one at step 86"});
  sim.run("run 150\nrun 10");
  expect_words(sim.log(), {"timestep 0.01 is too large at step 2", "Courant number 0.5"});
  EXPECT_EQ(warnings(sim.log()), 2) << sim.log();
}

TEST(Warnings, Imbalance)
{
  // a lump in one corner of the box: all on one rank
  Scene scene = patch(60);
  scene.low[0] = -0.6;
  scene.low[1] = -0.6;
  scene.high[0] = scene.high[1] = 4.0;
  Simulation sim(scene);
  Script script = free_script(scene);
  script.timestep = "timestep 0.001";
  sim.run(script.text() + "run 0\nrun 0");
  if (sim.ranks() == 1)
    EXPECT_EQ(warnings(sim.log()), 0);
  else
    expect_one_warning(sim.log(), {"times the mean number of particles", "fix balance"});
}

// a pressure that does not converge, on purpose
TEST(Warnings, LikelyCauseOfFailure)
{
  const auto message = [](const Scene &scene, const std::string &walls) {
    Simulation sim(scene);
    Script script = script_of(scene);
    script.body = GRAVITY;
    script.wall += walls;
    script.ppe += " maxiter 1";
    script.timestep = "timestep 0.01";
    return sim.error_of(script.text() + "run 0");
  };
  const std::string plain = message(tank(2, 8).jitter(0.2), "");
  expect_words(plain, {"not converged", "; reduce the time step"});
  EXPECT_EQ(plain.find("walls"), std::string::npos) << plain;

  // a plate whose faces are one spacing apart
  Scene plate = channel(8, 12);
  for (std::size_t i = 0; i < plate.x.size(); i++)
    if (std::abs(plate.x[i][1] - 0.5 * plate.d) < plate.d) plate.type[i] = Scene::WALL;
  expect_words(message(plate.jitter(0.2), ""),
               {"not converged", "look at the walls first", "atom",
                "is within the support (0.3) of a face that looks the other way"});

  Scene dense = tank(2, 8).jitter(0.2);
  for (int i = 0; i < 4; i++) dense.add(Scene::WALL, (i + 2.5) * dense.d, 0.0);
  expect_words(message(dense, ""),
               {"not converged", "look at the walls first", "atom",
                "nearer than 0.075 to another wall particle"});
}
