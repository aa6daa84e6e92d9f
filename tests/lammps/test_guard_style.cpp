// SPDX-License-Identifier: GPL-2.0-only
/* ----------------------------------------------------------------------
   fix aleisph/guard: each guard acts where it should, counts it, and says
   what it did to the energy.
------------------------------------------------------------------------- */

#include "errors.h"

#include <algorithm>
#include <cmath>

namespace {

constexpr double ROUNDING = 1.0e-12;

enum Guard { WALLS = 1, COLLISION, PRESSURE, SYMMETRIC, SELFTERM, CAP };

double now(const Simulation &sim, Guard guard)
{
  return sim.fix("guard", guard);
}

double total(const Simulation &sim, Guard guard)
{
  return sim.fix("guard", 6 + guard);
}

double energy(const Simulation &sim, Guard guard)
{
  return sim.fix("guard", 12 + guard);
}

Script guarded(const Scene &scene, const std::string &guard)
{
  Script script = free_script(scene);
  script.ppe = "fix ppe all aleisph/ppe tol 1e-13";
  script.guard = "fix guard fluid aleisph/guard " + guard;
  script.timestep = "timestep 0.001";
  return script;
}

double mass(const Scene &scene)
{
  return scene.rho0 * std::pow(scene.d, scene.dimension);
}

double kinetic_energy(const Simulation &sim, const Scene &scene)
{
  const auto type = sim.type();
  double sum = 0.0;
  for (int a = 0; a < 3; a++) {
    const auto v = sim.v(a);
    for (std::size_t i = 0; i < v.size(); i++)
      if (type[i] == Scene::FLUID) sum += v[i] * v[i];
  }
  return 0.5 * mass(scene) * sum;
}

// a box without anything in it; spacing 0.1
Scene empty_box()
{
  Scene scene = patch(10);
  scene.x.clear();
  scene.type.clear();
  return scene;
}

// rough motion in a jittered dam
Scene rough()
{
  return dam(8).jitter(0.25);
}

constexpr char STIR[] = "variable u atom sin(40*x)*cos(37*y)\nvariable w atom cos(35*x+20*y)\n"
                        "velocity fluid set v_u v_w 0\n";
constexpr char TURN[] = "variable u atom -y\nvariable w atom x\nvelocity all set v_u v_w 0\n";
constexpr char EVERYTHING[] = "walls 0.7 collision 1.0 pressure 0 selfterm yes symmetric 0.6 "
                              "cap 0.8";

// One step of the same state with and without the guard. What comes after the guard in a step
// (nothing but the other guards) does not see the difference.
void expect_energy_of_one_step(const Scene &scene, const std::string &stir,
                               const std::string &words, const std::vector<Guard> &guards)
{
  Simulation with(scene), without(scene);
  Script script = guarded(scene, words);
  with.run(script.text() + stir + "run 1");
  script.guard = "";
  without.run(script.text() + stir + "run 1");
  double sum = 0.0;
  for (const Guard guard : guards) {
    EXPECT_GT(now(with, guard), 0.0);
    EXPECT_NE(energy(with, guard), 0.0);
    sum += energy(with, guard);
  }
  const double before = kinetic_energy(without, scene),
               change = kinetic_energy(with, scene) - before;
  EXPECT_GT(std::fabs(change), 1e-9 * before);
  EXPECT_NEAR(sum, change, ROUNDING * before);
}

}    // namespace

/* ----------------------------------------------------------------------
   Nothing without a keyword
------------------------------------------------------------------------- */

TEST(Guard, OffIsAsWithout)
{
  for (const char *words : {"", "walls 0 collision 0 pressure no selfterm no symmetric 0",
                            "cap 1000 symmetric 0.0001 pressure -1000"}) {
    SCOPED_TRACE(words);
    Simulation with(rough()), without(rough());
    Script script = guarded(rough(), words);
    with.run(script.text() + STIR + "run 10");
    script.guard = "";
    without.run(script.text() + STIR + "run 10");
    for (int a = 0; a < 2; a++) {
      EXPECT_EQ(with.v(a), without.v(a));
      EXPECT_EQ(with.x(a), without.x(a));
    }
    for (int k = 1; k <= 18; k++) EXPECT_EQ(with.fix("guard", k), 0.0);
  }
}

// the sums are those of the steps
TEST(Guard, SumsSinceTheStart)
{
  Simulation sim(rough());
  Script script = guarded(rough(), EVERYTHING);
  script.timestep = "timestep 0.005";
  sim.run(script.text() + STIR + "run 0");
  double sum[7] = {}, most[7] = {};
  for (int k = 0; k <= 15; k++) {
    if (k) sim.run("run 1");
    for (int guard = WALLS; guard <= CAP; guard++) {
      sum[guard] += now(sim, static_cast<Guard>(guard));
      most[guard] = std::max(most[guard], now(sim, static_cast<Guard>(guard)));
      EXPECT_EQ(total(sim, static_cast<Guard>(guard)), sum[guard]);
    }
  }
  // an incompressible fluid does not come closer to its walls; see below for those
  for (int guard = COLLISION; guard <= CAP; guard++) EXPECT_GT(most[guard], 0.0) << guard;
  EXPECT_LE(energy(sim, CAP), 0.0);
  EXPECT_LE(energy(sim, COLLISION), 0.0);
  EXPECT_LE(energy(sim, WALLS), 0.0);
}

TEST(Guard, EnergyOfOneStep)
{
  expect_energy_of_one_step(rough(), STIR, "pressure 0", {PRESSURE});
  expect_energy_of_one_step(rough(), STIR, "symmetric 0.6", {SYMMETRIC});
  expect_energy_of_one_step(rough(), STIR, "selfterm yes", {SELFTERM});
  expect_energy_of_one_step(rough(), STIR, "collision 1.0", {COLLISION});
  expect_energy_of_one_step(rough(), STIR, "cap 0.8", {CAP});
  expect_energy_of_one_step(rough(), STIR,
                            "collision 1.0 pressure 0 selfterm yes symmetric 0.6 cap 0.8",
                            {PRESSURE, SYMMETRIC, SELFTERM, COLLISION, CAP});
}

// Only differences of pressure move the fluid, also through the guards
TEST(Guard, PressureOutside)
{
  const auto run = [](double p0) {
    Simulation sim(rough());
    Script script = guarded(
        rough(), fmt::format("collision 1.0 pressure {} selfterm yes symmetric 0.6", p0));
    script.surface += fmt::format(" pressure {}", p0);
    sim.run(script.text() + STIR + "run 3");
    EXPECT_GT(total(sim, SELFTERM), 0.0);
    EXPECT_GT(total(sim, SYMMETRIC), 0.0);
    EXPECT_GT(total(sim, PRESSURE), 0.0);
    return sim.v(0);
  };
  EXPECT_LE(largest(run(0.0), run(50.0)), 1e-8);
}

/* ----------------------------------------------------------------------
   One after the other
------------------------------------------------------------------------- */

// 36 particles with 2 are scaled to 1, in a patch that has no pressure
TEST(Guard, Cap)
{
  const Scene scene = patch(6);
  Simulation sim(scene);
  sim.run(guarded(scene, "cap 1.0").text() + "velocity all set 1.6 1.2 0\nrun 1");
  EXPECT_EQ(now(sim, CAP), 36.0);
  EXPECT_NEAR(energy(sim, CAP), -36.0 * 0.5 * mass(scene) * 3.0, ROUNDING);
  for (const double v : sim.v(0)) EXPECT_NEAR(v, 0.8, ROUNDING);
  for (const double v : sim.v(1)) EXPECT_NEAR(v, 0.6, ROUNDING);
}

// Two ballistic particles 0.6 d apart: the part of their relative velocity along the line that
// joins them is gone, all else is as before. Two that part, or are farther apart, do not collide.
TEST(Guard, Collision)
{
  Scene scene = empty_box();
  scene.add(Scene::FLUID, 0.0, 0.0);
  scene.add(Scene::FLUID, 0.05, 0.04);
  scene.add(Scene::FLUID, 0.0, 1.0);
  scene.add(Scene::FLUID, 0.05, 1.0);
  scene.add(Scene::FLUID, 1.0, 0.0);
  scene.add(Scene::FLUID, 1.08, 0.0);
  Simulation sim(scene);
  sim.run(guarded(scene, "collision 0.7").text() +
          "set atom 1 vx 1.0 vy 0.3\nset atom 2 vx -0.5 vy 0.1\n"
          "set atom 3 vx -1.0\nset atom 4 vx 1.0\nset atom 5 vx 1.0\nset atom 6 vx -1.0\nrun 1");
  const auto x = sim.x(0), y = sim.x(1), v = sim.v(0), w = sim.v(1);
  double e[2] = {x[1] - x[0], y[1] - y[0]};
  const double r = std::hypot(e[0], e[1]);
  for (double &value : e) value /= r;
  const double approach = -1.5 * e[0] - 0.2 * e[1];    // of particle 2 relative to 1
  EXPECT_NEAR(v[0], 1.0 + 0.5 * approach * e[0], ROUNDING);
  EXPECT_NEAR(w[0], 0.3 + 0.5 * approach * e[1], ROUNDING);
  EXPECT_NEAR(v[1], -0.5 - 0.5 * approach * e[0], ROUNDING);
  EXPECT_NEAR(w[1], 0.1 - 0.5 * approach * e[1], ROUNDING);
  for (int i = 2; i < 6; i++) EXPECT_EQ(std::fabs(v[i]), 1.0);
  EXPECT_EQ(now(sim, COLLISION), 2.0);
  // reduced mass m/2
  EXPECT_NEAR(energy(sim, COLLISION), -0.25 * mass(scene) * approach * approach, ROUNDING);
}

// linear momentum of a stirred patch: collisions do not change it
TEST(Guard, CollisionsConserveMomentum)
{
  const Scene scene = patch(10).jitter(0.25);
  const auto momentum = [&scene](const char *words, int a) {
    Simulation sim(scene);
    sim.run(guarded(scene, words).text() + STIR + "run 1");
    EXPECT_EQ(now(sim, COLLISION) > 0.0, std::string(words) != "");
    return mean(sim.v(a));
  };
  for (int a = 0; a < 2; a++) EXPECT_NEAR(momentum("", a), momentum("collision 1.0", a), ROUNDING);
}

// A rotating patch is under suction everywhere: all of it is raised to 0, and nothing is left to
// keep particles on their circles
TEST(Guard, Pressure)
{
  const Scene scene = patch(10);
  Simulation none(scene), sim(scene), part(scene);
  none.run(guarded(scene, "").text() + TURN + "run 1");
  sim.run(guarded(scene, "pressure 0").text() + TURN + "run 1");
  part.run(guarded(scene, "pressure -0.1").text() + TURN + "run 1");
  const auto p = none.pressure(), raised = part.pressure();
  EXPECT_EQ(now(sim, PRESSURE), 100.0);
  EXPECT_EQ(largest(sim.pressure()), 0.0);
  EXPECT_NEAR(now(part, PRESSURE),
              std::count_if(p.begin(), p.end(), [](double value) { return value < -0.1; }), 0.0);
  EXPECT_GT(now(part, PRESSURE), 0.0);
  for (std::size_t i = 0; i < p.size(); i++) EXPECT_EQ(raised[i], std::max(p[i], -0.1));
  EXPECT_GT(energy(sim, PRESSURE), 0.0);    // they fly apart
}

// lambda is 0.29 in the corners of a patch, 0.49 on its sides
TEST(Guard, SymmetricCounts)
{
  const Scene scene = patch(10);
  for (const auto &item : {std::pair<double, double>{0.2, 0.0}, {0.35, 4.0}, {0.6, 36.0}}) {
    Simulation sim(scene);
    sim.run(guarded(scene, fmt::format("symmetric {}", item.first)).text() + TURN +
            "compute c all aleisph/atom lambda surface\nrun 1");
    const auto lambda = sim.compute("c", 1);
    EXPECT_EQ(now(sim, SYMMETRIC), item.second);
    EXPECT_EQ(std::count_if(lambda.begin(), lambda.end(),
                            [&item](double value) { return value < item.first; }),
              item.second);
  }
}

// on a lattice no row is concerned
TEST(Guard, SelfTermLeavesALatticeAlone)
{
  const Scene scene = patch(10);
  Simulation with(scene), without(scene);
  with.run(guarded(scene, "selfterm yes").text() + TURN + "run 1");
  without.run(guarded(scene, "").text() + TURN + "run 1");
  EXPECT_EQ(total(with, SELFTERM), 0.0);
  for (int a = 0; a < 2; a++) EXPECT_EQ(with.v(a), without.v(a));
}

// ballistic particles have no pressure gradient, whatever the guard
TEST(Guard, BallisticParticlesStayFree)
{
  Scene scene = patch(10);
  const double corner = 0.5 - 0.5 * scene.d;
  scene.add(Scene::FLUID, corner + 1.6 * scene.d, corner + 1.6 * scene.d);
  Simulation sim(scene);
  sim.run(guarded(scene, "pressure -0.01 selfterm yes symmetric 1.0").text() + TURN +
          "set atom 101 vx 0.25 vy -0.125\nrun 3");
  EXPECT_EQ(sim.fix("surf", 2), 1.0);
  EXPECT_EQ(sim.v(0)[100], 0.25);
  EXPECT_EQ(sim.v(1)[100], -0.125);
}

/* ----------------------------------------------------------------------
   Walls
------------------------------------------------------------------------- */

namespace {

constexpr double D = 0.1, Q = 0.3 * D;

// a floor along x; corner: also a wall along y, both begin at -1
Scene floor_scene(bool corner = false)
{
  Scene scene = empty_box();
  for (int i = -10; i <= 10; i++) scene.add(Scene::WALL, i * D, corner ? -1.0 : 0.0);
  for (int j = -9; j <= (corner ? 10 : -10); j++) scene.add(Scene::WALL, -1.0, j * D);
  return scene;
}

// Walls that slip: the fluid has no viscosity, and a displacement off a wall that it sticks to
// would change its velocity along the wall
Script floor_script(const Scene &scene, const std::string &guard)
{
  Script script = guarded(scene, guard);
  script.wall += " condition slip";
  script.shift = "fix shift fluid aleisph/shift density velocity 1.0 walls 0";
  script.timestep = "timestep 0.01";
  return script;
}

double held(double s)
{
  return s < Q ? 0.5 * Q * (1.0 + std::exp((s - Q) / Q)) : s;
}

}    // namespace

// 5 * 0.01 is d/2: the particle would be on the floor after two steps and go through it. Instead
// it comes to the distance of the formula, and creeps back to q.
TEST(Guard, WallsHoldAParticleOff)
{
  for (const bool shifted : {true, false}) {
    SCOPED_TRACE(shifted);
    Scene scene = floor_scene();
    scene.add(Scene::FLUID, 0.0, D);
    const int id = static_cast<int>(scene.x.size());
    Script script = floor_script(scene, "walls 0.3");
    if (!shifted) script.shift = "";
    const std::string shot = fmt::format("set atom {} vx 0.5 vy -5.0\n", id);
    Simulation sim(scene), free(scene);
    sim.run(script.text() + shot);
    sim.run("run 1");
    EXPECT_NEAR(sim.x(1)[id - 1], 0.5 * D, ROUNDING);
    EXPECT_EQ(now(sim, WALLS), 1.0);
    EXPECT_NEAR(sim.v(1)[id - 1], 0.0, ROUNDING);
    EXPECT_NEAR(energy(sim, WALLS), -0.5 * mass(scene) * 25.0, ROUNDING);
    double y = held(0.0);
    for (int k = 0; k < 5; k++) {
      sim.run("run 1");
      EXPECT_NEAR(sim.x(1)[id - 1], y, ROUNDING);
      y = held(y);
    }
    EXPECT_NEAR(sim.x(0)[id - 1], 6 * 0.01 * 0.5, ROUNDING);    // along the wall it is free
    EXPECT_NEAR(sim.v(0)[id - 1], 0.5, ROUNDING);
    EXPECT_EQ(total(sim, WALLS), 6.0);
    EXPECT_NEAR(energy(sim, WALLS), -0.5 * mass(scene) * 25.0, ROUNDING);

    script.guard = "";
    script.shift = "fix shift fluid aleisph/shift density velocity 1.0 walls 0";
    free.run(script.text() + shot + "run 3");
    EXPECT_LT(free.x(1)[id - 1], 0.0);
  }
}

// the first shift, at the set-up, is held as well
TEST(Guard, WallsInTheFirstStep)
{
  Scene scene = floor_scene();
  scene.add(Scene::FLUID, 0.0, D);
  const int id = static_cast<int>(scene.x.size());
  Script script = floor_script(scene, "walls 0.3");
  Simulation sim(scene);
  sim.run(script.text() + fmt::format("set atom {} vy -15.0\nrun 0", id));
  EXPECT_EQ(total(sim, WALLS), 1.0);
  sim.run("run 1");
  EXPECT_NEAR(sim.x(1)[id - 1], held(-0.5 * D), ROUNDING);
}

TEST(Guard, WallsHoldAParticleInACorner)
{
  Scene scene = floor_scene(true);
  scene.add(Scene::FLUID, -1.0 + D, -1.0 + D);
  const int id = static_cast<int>(scene.x.size());
  Script script = floor_script(scene, "walls 0.3");
  Simulation sim(scene);
  sim.run(script.text() + fmt::format("set atom {} vx -5.0 vy -4.0\n", id));
  for (int k = 0; k < 10; k++) {
    sim.run("run 1");
    for (int a = 0; a < 2; a++) EXPECT_GE(sim.x(a)[id - 1] + 1.0, 0.5 * Q);
  }
  for (int a = 0; a < 2; a++) EXPECT_NEAR(sim.v(a)[id - 1], 0.0, ROUNDING);
  EXPECT_NEAR(energy(sim, WALLS), -0.5 * mass(scene) * 41.0, ROUNDING);
}

// With a body force: what the guard does to the kinetic energy in a step, and the height by which
// it changes the next position, against the same step without the guard
TEST(Guard, WorkOfTheDisplacement)
{
  Scene scene = floor_scene();
  scene.add(Scene::FLUID, 0.0, D);
  const int id = static_cast<int>(scene.x.size());
  Simulation with(scene), without(scene);
  Script script = floor_script(scene, "walls 0.3");
  script.body = "fix g all gravity 3.0 vector 0 -1 0";
  script.timestep += fmt::format("\nset atom {} vy -5.0\n", id);
  with.run(script.text() + "run 1");
  script.guard = "";
  without.run(script.text() + "run 1");
  const double kinetic = kinetic_energy(with, scene) - kinetic_energy(without, scene);
  const double reported = energy(with, WALLS);
  with.run("run 1");
  without.run("run 1");
  const double lift = with.x(1)[id - 1] - without.x(1)[id - 1];
  EXPECT_GT(lift, 0.1 * D);
  EXPECT_NEAR(reported, kinetic + mass(scene) * 3.0 * lift, ROUNDING);
}

// a wall that comes towards a particle at rest takes it along
TEST(Guard, MovingWall)
{
  Scene scene = floor_scene();
  scene.add(Scene::FLUID, 0.0, D);
  const int id = static_cast<int>(scene.x.size());
  Script script = floor_script(scene, "walls 0.3");
  script.wall += "\nfix m wall move linear 0 1.0 0";
  script.timestep = "timestep 0.005";
  Simulation sim(scene);
  sim.run(script.text());
  for (int k = 0; k < 10; k++) {
    sim.run("run 4");
    EXPECT_GE(sim.x(1)[id - 1] - sim.x(1)[0], 0.5 * Q);
  }
  EXPECT_GT(total(sim, WALLS), 0.0);
  EXPECT_NEAR(sim.v(1)[id - 1], 1.0, ROUNDING);
  EXPECT_NEAR(energy(sim, WALLS), 0.5 * mass(scene), ROUNDING);
}

// A particle that hits a wall: it takes no part of the motion away from the wall
TEST(Guard, CollisionWithAWall)
{
  Scene scene = floor_scene();
  scene.add(Scene::FLUID, 0.0, D);
  const int id = static_cast<int>(scene.x.size());
  Script script = floor_script(scene, "collision 0.7");
  script.timestep += fmt::format("\nset atom {} vx 0.25 vy -4.0\n", id);
  Simulation sim(scene);
  sim.run(script.text() + "run 1");    // now 0.6 d above particle 11, beside it by 0.025 d
  const double e[2] = {0.0025, 0.06}, r = std::hypot(e[0], e[1]);
  const double approach = (0.25 * e[0] - 4.0 * e[1]) / r;
  EXPECT_EQ(now(sim, COLLISION), 1.0);
  EXPECT_NEAR(sim.v(0)[id - 1], 0.25 - approach * e[0] / r, 1e-10);
  EXPECT_NEAR(sim.v(1)[id - 1], -4.0 - approach * e[1] / r, 1e-10);
  EXPECT_NEAR(energy(sim, COLLISION), -0.5 * mass(scene) * approach * approach, 1e-10);
}

// a dam break with all of them: nobody gets lost or through a wall
TEST(Guard, DamBreak)
{
  const Scene scene = dam(8);
  Script script = guarded(scene, "walls 0.3 collision 0.7 pressure 0 selfterm yes symmetric 0.35");
  script.body = "fix g all gravity 1.0 vector 0 -1 0";
  script.shift = "fix shift fluid aleisph/shift density velocity 2.0 surface positive";
  Simulation sim(scene);
  sim.run(script.text());
  for (int k = 0; k < 10; k++) {
    sim.run("run 40");    // to t = 4, when the front has come back from the right wall
    const auto x = sim.x(0), y = sim.x(1);
    for (std::size_t i = 0; i < x.size(); i++) {
      if (scene.type[i] != Scene::FLUID) continue;
      EXPECT_GE(y[i], 0.15 * scene.d);
      EXPECT_GE(x[i], 0.15 * scene.d);
      EXPECT_LE(x[i], 4.0 - 0.15 * scene.d);
    }
    EXPECT_EQ(sim.fix("sph", 1), 128.0);
  }
  EXPECT_GT(total(sim, COLLISION) + total(sim, PRESSURE), 0.0);
}

TEST(Guard, OutputBeforeTheFirstRun)
{
  Simulation sim(rough());
  sim.run(guarded(rough(), EVERYTHING).text());
  for (int k = 1; k <= 18; k++) EXPECT_EQ(sim.fix("guard", k), 0.0);
}

TEST(Guard, ChangesBetweenRuns)
{
  const Scene scene = patch(6);
  Simulation sim(scene);
  sim.run(guarded(scene, "cap 1.0").text() + "velocity all set 2 0 0\nrun 1");
  sim.run("unfix guard\nfix guard fluid aleisph/guard cap 0.5\nrun 1");
  EXPECT_EQ(total(sim, CAP), 36.0);    // of the new fix
  EXPECT_NEAR(largest(sim.v(0)), 0.5, ROUNDING);
  sim.run("unfix guard\nrun 1");
  EXPECT_NEAR(largest(sim.v(0)), 0.5, 1e-10);
}

/* ----------------------------------------------------------------------
   Errors
------------------------------------------------------------------------- */

TEST(GuardErrors, Command)
{
  const auto line = [](const std::string &words) {
    return [words](Script &s) { s.guard = "fix guard fluid aleisph/guard " + words; };
  };
  const auto range = [&](const std::string &key, const std::string &value,
                         const std::string &high) {
    return ErrorCase{key + " " + value,
                     line(key + " " + value),
                     {"ix aleisph/guard", key + " must lie between 0 and " + high, "not " + value}};
  };
  expect_errors({
      {"keyword", line("colour red"), {"ix aleisph/guard", "unknown keyword colour"}},
      {"value missing", line("walls"), {"fix aleisph/guard walls", "issing"}},
      {"word", line("walls thick"), {"thick"}},
      {"nan", line("collision nan"), {"nan"}},
      {"pressure", line("pressure low"), {"low"}},
      {"selfterm", line("selfterm maybe"), {"maybe"}},
      {"cap", line("cap 0"), {"ix aleisph/guard", "cap must be positive", "0"}},
      {"cap negative", line("cap -2"), {"ix aleisph/guard", "cap must be positive", "-2"}},
      range("walls", "-0.1", "0.7"),
      range("walls", "0.8", "0.7"),
      range("collision", "-0.1", "1"),
      range("collision", "1.1", "1"),
      range("symmetric", "-0.1", "1"),
      range("symmetric", "1.1", "1"),
  });
}

TEST(GuardErrors, Setup)
{
  const std::string guard = "\nfix guard fluid aleisph/guard";
  expect_errors({
      {"no owner",
       [&](Script &s) { s = Script{}, s.guard = guard.substr(1); },
       {"ix aleisph/guard needs a fix aleisph", "defined before"}},
      {"two",
       [&](Script &s) { s.guard = guard.substr(1) + "\nfix g2 fluid aleisph/guard"; },
       {"ix aleisph/guard: there must be only one"}},
      {"group",
       [](Script &s) { s.guard = "fix guard all aleisph/guard cap 1"; },
       {"ix aleisph/guard: group must be that of fix pred, fluid"}},
      {"selfterm without surface",
       [&](Script &s) { s.guard = guard.substr(1) + " selfterm yes"; },
       {"ix aleisph/guard: keyword selfterm needs a fix aleisph/surface"}},
      {"walls, lagrangian",
       [&](Script &s) { s.guard = guard.substr(1) + " walls 0.3"; },
       {"ix aleisph/guard: keyword walls needs frame ale in fix aleisph/predictor"}},
      {"walls, eulerian",
       [&](Script &s) {
         s.predictor += " frame eulerian";
         s.guard = guard.substr(1) + " walls 0.3";
       },
       {"ix aleisph/guard: keyword walls needs frame ale in fix aleisph/predictor"}},
      {"transport",
       [&](Script &s) {
         s.predictor += " frame ale transport 0 0 0";
         s.guard = guard.substr(1) + " cap 1";
       },
       {"ix aleisph/predictor", "transport cannot be used with", "fix aleisph/guard"}},
      {"before ppe",
       [&](Script &s) { s.predictor += guard; },
       {"ppe (aleisph/ppe)", "must be defined before", "guard (aleisph/guard)"}},
  });
}

// the others do without a surface and without frame ale
TEST(GuardErrors, WhatIsAllowed)
{
  Script script = small_script();
  script.guard = "fix guard fluid aleisph/guard collision 0.7 pressure -5 symmetric 0.3 cap 9 "
                 "selfterm no";
  Simulation sim(small_channel());
  EXPECT_EQ(sim.error_of(script.text() + "run 2"), "");
}
