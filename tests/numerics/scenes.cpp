// SPDX-License-Identifier: GPL-2.0-only

#include "scenes.h"

#include <cmath>
#include <map>
#include <random>

namespace aleisph_test {

using namespace aleisph;

void Scene::add(const Point &x, Role r, const Point &n, int nfaces)
{
  const double length = std::sqrt(n[0] * n[0] + n[1] * n[1] + n[2] * n[2]);
  points.push_back(x);
  role.push_back(r);
  for (double component : n) normal.push_back(length > 0.0 ? component / length : 0.0);
  faces.push_back(nfaces);
}

void Scene::jitter_fluid(double amplitude, unsigned seed)
{
  std::mt19937 random(seed);
  std::uniform_real_distribution<double> deviate(-amplitude * d, amplitude * d);
  for (size_t i = 0; i < points.size(); i++)
    if (role[i] & FLUID)
      for (int a = 0; a < dim; a++) points[i][a] += deviate(random);
}

Rows Scene::rows(Role r) const
{
  Rows rows;
  for (size_t i = 0; i < role.size(); i++)
    if (role[i] & r) rows.push_back(static_cast<int>(i));
  return rows;
}

Scene closed_box(int dim, int n, double jitter, unsigned seed)
{
  Scene scene;
  scene.dim = dim;
  scene.d = 1.0 / n;
  for (int k = 0; k <= (dim == 3 ? n : 0); k++)
    for (int j = 0; j <= n; j++)
      for (int i = 0; i <= n; i++) {
        const int index[3] = {i, j, k};
        Point x{}, normal{};
        int nfaces = 0;
        for (int a = 0; a < dim; a++) {
          x[a] = index[a] * scene.d;
          normal[a] = index[a] == 0 ? 1.0 : index[a] == n ? -1.0 : 0.0;
          nfaces += normal[a] != 0.0;
        }
        scene.add(x, nfaces > 0 ? WALL : FLUID, normal, nfaces);
      }
  scene.jitter_fluid(jitter, seed);
  return scene;
}

Scene box_obstacle(int dim, int n, double jitter, unsigned seed)
{
  Scene scene;
  scene.dim = dim;
  scene.d = 1.0 / n;
  const int m = n + 3;
  for (int k = dim == 3 ? -3 : 0; k <= (dim == 3 ? m : 0); k++)
    for (int j = -3; j <= m; j++)
      for (int i = -3; i <= m; i++) {
        const int index[3] = {i, j, k};
        Point x{}, normal{};
        int nfaces = 0;
        bool outside = false;
        for (int a = 0; a < dim; a++) {
          x[a] = index[a] * scene.d - 0.5;
          normal[a] = index[a] == 0 ? -1.0 : index[a] == n ? 1.0 : 0.0;
          nfaces += normal[a] != 0.0;
          outside |= index[a] < 0 || index[a] > n;
        }
        if (outside) scene.add(x, FLUID);
        if (!outside && nfaces > 0) scene.add(x, WALL, normal, nfaces);
      }
  scene.jitter_fluid(jitter, seed);
  return scene;
}

Scene open_tank(int dim, int n, int height, int level, double jitter, unsigned seed)
{
  Scene scene;
  scene.dim = dim;
  scene.d = 1.0 / n;
  const int size[3] = {n, dim == 3 ? n : height, dim == 3 ? height : 0};
  for (int k = 0; k <= size[2]; k++)
    for (int j = 0; j <= size[1]; j++)
      for (int i = 0; i <= size[0]; i++) {
        const int index[3] = {i, j, k};
        Point x{}, normal{};
        int nfaces = 0;
        for (int a = 0; a < dim; a++) {
          x[a] = index[a] * scene.d;
          normal[a] = index[a] == 0 ? 1.0 : a < dim - 1 && index[a] == n ? -1.0 : 0.0;
          nfaces += normal[a] != 0.0;
        }
        if (nfaces > 0)
          scene.add(x, WALL, normal, nfaces);
        else if (index[dim - 1] <= level)
          scene.add(x, FLUID);
      }
  scene.jitter_fluid(jitter, seed);
  return scene;
}

namespace {

void add_ring(Scene &scene, double R, double z, bool inside)
{
  const int n = static_cast<int>(std::lround(2.0 * M_PI * R / scene.d));
  const double sign = inside ? -1.0 : 1.0;
  for (int i = 0; i < n; i++) {
    const double phi = 2.0 * M_PI * i / n, c = std::cos(phi), s = std::sin(phi);
    scene.add({R * c, R * s, z}, WALL, {sign * c, sign * s, 0.0}, 1);
  }
}

// lattice points between the radii r0 and r1 from the axis (in 2d and on a cylinder) or origin
void add_lattice(Scene &scene, double r0, double r1, int kmin, int kmax, bool round)
{
  const int m = static_cast<int>(r1 / scene.d) + 1;
  for (int k = kmin; k <= kmax; k++)
    for (int j = -m; j <= m; j++)
      for (int i = -m; i <= m; i++) {
        const Point x = {i * scene.d, j * scene.d, k * scene.d};
        const double r = std::sqrt(x[0] * x[0] + x[1] * x[1] + (round ? x[2] * x[2] : 0.0));
        if (r > r0 && r < r1) scene.add(x, FLUID);
      }
}

}    // namespace

Scene cylinder(int dim, double R, double d, bool inside, double jitter, unsigned seed)
{
  Scene scene;
  scene.dim = dim;
  scene.d = d;
  const int top = dim == 3 ? 6 : 0;
  for (int k = 0; k <= top; k++) add_ring(scene, R, k * d, inside);
  if (inside)
    add_lattice(scene, -1.0, R - 0.5 * d, 0, top, false);
  else
    add_lattice(scene, R + 0.5 * d, R + 4.0 * d, 0, top, false);
  scene.jitter_fluid(jitter, seed);
  return scene;
}

Scene sphere(double R, double d, bool inside, double jitter, unsigned seed)
{
  Scene scene;
  scene.dim = 3;
  scene.d = d;
  const int n = static_cast<int>(std::lround(4.0 * M_PI * R * R / (d * d)));
  const double golden = M_PI * (3.0 - std::sqrt(5.0)), sign = inside ? -1.0 : 1.0;
  for (int i = 0; i < n; i++) {
    const double z = 1.0 - (2.0 * i + 1.0) / n, s = std::sqrt(1.0 - z * z);
    const Point u = {s * std::cos(golden * i), s * std::sin(golden * i), z};
    scene.add({R * u[0], R * u[1], R * u[2]}, WALL, {sign * u[0], sign * u[1], sign * u[2]}, 1);
  }
  const int m = static_cast<int>(R / d) + 4;
  if (inside)
    add_lattice(scene, -1.0, R - 0.5 * d, -m, m, true);
  else
    add_lattice(scene, R + 0.5 * d, R + 3.0 * d, -m, m, true);
  scene.jitter_fluid(jitter, seed);
  return scene;
}

namespace {

// candidates by bins of the size of the support
struct Candidates {
  std::vector<std::vector<int>> lists;
  std::vector<int> count;
  std::vector<const int *> first;
  std::vector<const double *> x;

  Candidates(const Points &points, double support) : lists(points.size())
  {
    std::map<std::array<int, 3>, std::vector<int>> bins;
    const auto bin = [support](const Point &p) {
      std::array<int, 3> b{};
      for (int a = 0; a < 3; a++) b[a] = static_cast<int>(std::floor(p[a] / support));
      return b;
    };
    const int n = static_cast<int>(points.size());
    for (int i = 0; i < n; i++) bins[bin(points[i])].push_back(i);
    for (int i = 0; i < n; i++) {
      const std::array<int, 3> b = bin(points[i]);
      for (int m = 0; m < 27; m++) {
        const auto found = bins.find({b[0] + m % 3 - 1, b[1] + m / 3 % 3 - 1, b[2] + m / 9 - 1});
        if (found == bins.end()) continue;
        for (int j : found->second)
          if (j != i) lists[i].push_back(j);
      }
      count.push_back(static_cast<int>(lists[i].size()));
      first.push_back(lists[i].data());
      x.push_back(points[i].data());
    }
  }
};

Cloud scene_cloud(const Scene &scene)
{
  static Timers timers;    // nobody looks at them
  Cloud cloud(Kernel(KernelType::CUBIC_SPLINE, scene.dim, 1.2 * scene.d), scene.d, timers);
  const Candidates c(scene.points, cloud.kernel().support());
  const int n = static_cast<int>(scene.points.size());
  cloud.reset(n, n);
  set_particles(cloud, scene.role, scene.normal);
  cloud.update(c.x.data(), {c.count.data(), c.first.data(), 0x1FFFFFFF});
  return cloud;
}

}    // namespace

Discretized::Discretized(const Scene &scene, const LaplacianLimits &limits, bool laplacian) :
    cloud_(scene_cloud(scene))
{
  cloud_.set_limits(limits);
  if (laplacian) cloud_.laplacian();
}

}    // namespace aleisph_test
