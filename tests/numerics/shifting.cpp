// SPDX-License-Identifier: GPL-2.0-only

#include "shifting.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace aleisph_test {

using namespace aleisph;

Point at(const std::vector<double> &field, int i)
{
  return {field[3 * i], field[3 * i + 1], field[3 * i + 2]};
}

double dot(const Point &p, const Point &q)
{
  return p[0] * q[0] + p[1] * q[1] + p[2] * q[2];
}

double length(const Point &p)
{
  return std::sqrt(dot(p, p));
}

namespace {

double distance(const Point &p, const Point &q)
{
  return length({p[0] - q[0], p[1] - q[1], p[2] - q[2]});
}

double nearest_fluid(const Scene &scene, const Point &x)
{
  double nearest = std::numeric_limits<double>::infinity();
  for (int j : scene.rows(FLUID)) nearest = std::min(nearest, distance(x, scene.points[j]));
  return nearest;
}

void mark_surface(Scene &scene, double height)
{
  const int up = scene.dim - 1;
  for (int i : scene.rows(FLUID))
    if (std::fabs(scene.points[i][up] - height) < 0.5 * scene.d) {
      scene.role[i] |= SURFACE;
      scene.normal[3 * i + up] = 1.0;
    }
}

}    // namespace

Scene half_lattice(int dim)
{
  Scene scene;
  scene.dim = dim;
  scene.d = D;
  for (const Point &p : lattice(dim, 6, D))
    if (p[dim - 1] < 0.5 * D) scene.add(p, FLUID);
  mark_surface(scene, 0.0);
  return scene;
}

Scene filled_tank(int dim, int n, int level)
{
  Scene scene = open_tank(dim, n, level + 3, level);
  mark_surface(scene, level * scene.d);
  for (int i : scene.rows(WALL)) {
    const double wet = 1.2 * scene.d * std::sqrt(static_cast<double>(scene.faces[i]));
    if (nearest_fluid(scene, scene.points[i]) > wet) scene.role[i] |= DRY;
  }
  return scene;
}

namespace {

Cloud scene_cloud(const Scene &scene, const Kernel &kernel)
{
  const int n = static_cast<int>(scene.points.size());
  return make_cloud(kernel, scene.d, PointSet(scene.points, n, kernel.support()),
                    {scene.role, scene.normal, true});
}

}    // namespace

Shifting::Shifting(Scene scene, KernelType type, double h_over_d) :
    scene_(std::move(scene)),
    cloud_(scene_cloud(scene_, Kernel(type, scene_.dim, h_over_d * scene_.d)))
{
}

int Shifting::nearest(const Point &x) const
{
  int best = 0;
  for (int i = 1; i < size(); i++)
    if (distance(scene_.points[i], x) < distance(scene_.points[best], x)) best = i;
  return best;
}

std::vector<double> Shifting::deviation(bool published) const
{
  std::vector<double> eps(size(), 0.0);
  density_deviation(cloud_, published, eps.data());
  return eps;
}

std::vector<double> Shifting::shift(const ShiftParams &params, const std::vector<double> &eps,
                                    const std::vector<double> &v, ShiftCount *count) const
{
  std::vector<double> dr(3 * size(), 0.0);
  const ShiftCount counted = compute_shift(cloud_, params, eps.data(), v.data(), dr.data());
  if (count) *count = counted;
  return dr;
}

std::vector<double> Shifting::filter(const std::vector<double> &v,
                                     const std::vector<double> &grad_v) const
{
  std::vector<double> out(3 * size(), 0.0);
  surface_velocity_filter(cloud_, fluid(), v.data(), grad_v.data(), out.data());
  return out;
}

ShiftParams unlimited(ShiftModel model)
{
  ShiftParams params;
  params.model = model;
  params.coefficient = 1.0;
  params.limit = std::numeric_limits<double>::infinity();
  return params;
}

ShiftParams unbounded(ShiftModel model)
{
  ShiftParams params = unlimited(model);
  params.dt = std::numeric_limits<double>::infinity();
  return params;
}

Scene rough(int dim, unsigned seed)
{
  Scene scene = half_lattice(dim);
  scene.jitter_fluid(0.2, seed);
  return scene;
}

std::vector<double> streaming(const Shifting &shifting, double V)
{
  std::vector<double> v(3 * shifting.size(), 0.0);
  for (int i = 0; i < shifting.size(); i++) v[3 * i] = V;
  return v;
}

std::vector<double> full_shift(const Shifting &shifting, const ShiftParams &params,
                               ShiftCount *count)
{
  return shifting.shift(params, shifting.deviation(params.published), streaming(shifting, 1.0),
                        count);
}

double weight(const Shifting &shifting, double r)
{
  return shifting.volume() * shifting.kernel().w(r);
}

}    // namespace aleisph_test
