// SPDX-License-Identifier: GPL-2.0-only
/* ----------------------------------------------------------------------
   Drops, their scripts with fix aleisph/tension, and what is asked of them.
------------------------------------------------------------------------- */

#ifndef LMP_ALEISPH_TEST_TENSION_SCRIPT_H
#define LMP_ALEISPH_TEST_TENSION_SCRIPT_H

#include "script.h"
#include "simulation.h"

#include <cmath>

namespace tension {

constexpr double PI = 3.14159265358979323846;
constexpr double ROUNDING = 1.0e-13;    // relative, of a few dozen operations
// Pressures differ by what the solver leaves: 1e-12 of the scaled right hand side, times |A^-1|,
// which is at most (2 * 10 d/(pi d))^2 = 40
constexpr double SOLVER = 1.0e-10;
constexpr double D = 0.1, SIGMA = 0.5;

constexpr char FIELDS[] =
    "\ncompute k all aleisph/atom kappa ptension tnx tny tnz contact surface\n";
enum Column { KAPPA = 1, PTENSION, TNX, TNY, TNZ, CONTACT, KIND };

/* ----------------------------------------------------------------------
   Scenes
------------------------------------------------------------------------- */

inline Scene empty_box(int dimension, double half)
{
  Scene scene;
  scene.dimension = dimension;
  scene.d = D;
  const double z = dimension == 2 ? 0.5 * D : half;
  scene.low = {-half, -half, -z};
  scene.high = {half, half, z};
  return scene;
}

// Rings of radius d, 2 d, ..., rings d about a point, spaced d along each. The disc ends half a
// spacing outside of the last one, and has the area of its particles up to rounding of their number.
inline Scene disc(int rings, double cx = 0.0)
{
  Scene scene = empty_box(2, (rings + 6) * D);
  const double half = scene.high[0];
  const auto put = [&](double x, double y) {
    scene.add(Scene::FLUID, x - 2.0 * half * std::floor((x + half) / (2.0 * half)), y);
  };
  put(cx, 0.0);
  for (int m = 1; m <= rings; m++) {
    const int n = static_cast<int>(std::lround(2.0 * PI * m));
    for (int k = 0; k < n; k++) {
      const double angle = 2.0 * PI * (k + 0.37 * m) / n;
      put(cx + m * D * std::cos(angle), m * D * std::sin(angle));
    }
  }
  return scene;
}

// The same with shells; on each a spiral with constant steps of the height
inline Scene ball(int shells)
{
  Scene scene = empty_box(3, (shells + 6) * D);
  scene.add(Scene::FLUID, 0.0, 0.0, 0.0);
  const double golden = PI * (3.0 - std::sqrt(5.0));
  for (int m = 1; m <= shells; m++) {
    const int n = static_cast<int>(std::lround(4.0 * PI * m * m));
    for (int k = 0; k < n; k++) {
      const double z = 1.0 - (2.0 * k + 1.0) / n, s = std::sqrt(1.0 - z * z), angle = golden * k;
      scene.add(Scene::FLUID, m * D * s * std::cos(angle), m * D * s * std::sin(angle), m * D * z);
    }
  }
  return scene;
}

inline double radius(int layers)
{
  return (layers + 0.5) * D;
}

/* ----------------------------------------------------------------------
   Scripts. Time steps are half of the capillary limit or less.
------------------------------------------------------------------------- */

inline double capillary(double sigma = SIGMA, double d = D, double rho = 1.0)
{
  return std::sqrt(rho * d * d * d / (2.0 * PI * sigma));
}

inline Script tension_script(const Scene &scene, const std::string &words = "")
{
  Script script = free_script(scene);
  script.surface += fmt::format("\nfix tens fluid aleisph/tension sigma {} {}", SIGMA, words);
  script.timestep = fmt::format("timestep {}", 0.4 * capillary(SIGMA, scene.d));
  return script;
}

inline std::vector<double> where(const std::vector<double> &values, const std::vector<double> &flag,
                                 double wanted)
{
  std::vector<double> some;
  for (std::size_t i = 0; i < values.size(); i++)
    if (flag[i] == wanted) some.push_back(values[i]);
  return some;
}

inline double deviation(const std::vector<double> &values)
{
  double squares = 0.0;
  for (const double x : without_mean(values)) squares += x * x;
  return std::sqrt(squares / static_cast<double>(values.size()));
}

// open_tank(), in y as wide as it is long and periodic: walls without vertical edges, where the
// continuation of the fluid is not that of the lattice
inline Scene open_slab()
{
  const Scene tank = open_tank(2, 12);
  Scene scene = tank;
  scene.dimension = 3;
  scene.boundary = "f p f";
  scene.low = {tank.low[0], 0.0, tank.low[1]};
  scene.high = {tank.high[0], 6.0 * tank.d, tank.high[1]};
  scene.x.clear();
  scene.type.clear();
  for (int row = 0; row < 6; row++)
    for (std::size_t i = 0; i < tank.x.size(); i++)
      scene.add(static_cast<Scene::Type>(tank.type[i]), tank.x[i][0], (row + 0.5) * tank.d,
                tank.x[i][1]);
  return scene;
}

// everything that a set-up makes of a scene: K, p, N, contact flags, pressure
inline std::vector<double> fields(const Scene &scene, const std::string &script, MPI_Comm comm)
{
  Simulation sim(scene, comm);
  sim.run(script + FIELDS + "run 0");
  std::vector<double> all = sim.pressure();
  for (const int column : {KAPPA, PTENSION, TNX, TNY, TNZ, CONTACT}) {
    const auto field = sim.compute("k", column);
    all.insert(all.end(), field.begin(), field.end());
  }
  return all;
}

inline std::vector<double> fields(const Scene &scene, const std::string &script)
{
  return fields(scene, script, MPI_COMM_WORLD);
}

inline std::vector<double> report(const Simulation &sim)
{
  std::vector<double> all;
  for (int k = 1; k <= 9; k++) all.push_back(sim.fix("tens", k));
  return all;
}

// the walls of an open tank in two groups
inline Script angle_script(const Scene &scene, const std::string &angles,
                           const std::string &before = "")
{
  Script script = tension_script(scene, angles);
  script.wall += "\nregion lefthalf block INF 0.5 INF INF INF INF\ngroup lh region lefthalf\n"
                 "group left intersect wall lh\ngroup right subtract wall left\n" +
      before;
  return script;
}

}    // namespace tension
#endif
