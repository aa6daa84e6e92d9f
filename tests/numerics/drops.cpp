// SPDX-License-Identifier: GPL-2.0-only

#include "drops.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <numeric>

namespace aleisph_test {

using namespace aleisph;

namespace {

constexpr double REACH = 4.8;        // of the wide colour gradient, in spacings
constexpr double SMOOTHING = 1.2;    // length of the operators

double length(const Point &p)
{
  return std::hypot(p[0], p[1], p[2]);
}

// n points on the unit circle or, by Fibonacci, on the unit sphere
Points directions(int dim, int n, double phase)
{
  Points points;
  for (int k = 0; k < n; k++) {
    if (dim == 2) {
      const double phi = 2.0 * M_PI * k / n + phase;
      points.push_back({std::cos(phi), std::sin(phi), 0.0});
      continue;
    }
    const double z = 1.0 - (2.0 * k + 1.0) / n, rho = std::sqrt(1.0 - z * z);
    const double phi = M_PI * (3.0 - std::sqrt(5.0)) * k + phase;
    points.push_back({rho * std::cos(phi), rho * std::sin(phi), z});
  }
  return points;
}

void set_length(Point &p, double r)
{
  const double factor = r / length(p);
  for (double &x : p) x *= factor;
}

// Displacement of i in spacings by neighbours closer than 1.5 d, largest for the nearest
Point repulsion(const Points &points, int i, const std::vector<int> &neighbours, double d)
{
  Point sum = {0.0, 0.0, 0.0};
  for (int j : neighbours) {
    Point e;
    for (int a = 0; a < 3; a++) e[a] = points[i][a] - points[j][a];
    const double r = length(e) / d;
    if (!(r < 1.5) || r == 0.0) continue;
    const double w = (1.0 - r / 1.5) * (1.0 - r / 1.5);
    for (int a = 0; a < 3; a++) sum[a] += w * e[a] / (r * d);
  }
  return sum;
}

// the first `outer` points keep their radius, the others stay within it
void relax(Points &points, int outer, double R, double d, int passes)
{
  const int n = static_cast<int>(points.size());
  for (int pass = 0; pass < passes; pass++) {
    const Neighbours near(points, n, 1.5 * d);
    const Points old = points;
    for (int i = 0; i < n; i++) {
      const Point move = repulsion(old, i, near.of(i), d);
      for (int a = 0; a < 3; a++) points[i][a] += 0.2 * d * move[a];
      if (i < outer || length(points[i]) > R) set_length(points[i], R);
    }
  }
}

}    // namespace

Neighbours::Neighbours(const Points &points, int owned, double reach) : owned_(owned), lists_(owned)
{
  using Cell = std::array<long, 3>;
  const auto cell = [reach](const Point &p) {
    return Cell{std::lround(p[0] / reach), std::lround(p[1] / reach), std::lround(p[2] / reach)};
  };
  std::map<Cell, std::vector<int>> cells;
  for (size_t j = 0; j < points.size(); j++) {
    cells[cell(points[j])].push_back(static_cast<int>(j));
    x_.push_back(points[j].data());
  }
  for (int i = 0; i < owned; i++) {
    const Cell c = cell(points[i]);
    for (int m = 0; m < 27; m++) {
      const auto found = cells.find({c[0] + m % 3 - 1, c[1] + m / 3 % 3 - 1, c[2] + m / 9 - 1});
      if (found == cells.end()) continue;
      for (int j : found->second) {
        const Point r = {points[i][0] - points[j][0], points[i][1] - points[j][1],
                         points[i][2] - points[j][2]};
        if (j != i && length(r) < reach) lists_[i].push_back(j);
      }
    }
    count_.push_back(static_cast<int>(lists_[i].size()));
    first_.push_back(lists_[i].data());
  }
}

Points relaxed_ball(int dim, int n, double d)
{
  Points points;
  int outer = 0;
  for (int shell = n; shell > 0; shell--) {
    const double cells = dim == 2 ? M_PI * (2.0 * shell - 1.0)
                                  : 4.0 / 3.0 * M_PI * (3.0 * shell * (shell - 1.0) + 1.0);
    const int count = static_cast<int>(std::lround(cells));
    for (const Point &e : directions(dim, count, 0.7 * shell))
      points.push_back(
          {(shell - 0.5) * d * e[0], (shell - 0.5) * d * e[1], (shell - 0.5) * d * e[2]});
    if (shell == n) outer = count;
  }
  relax(points, outer, (n - 0.5) * d, d, 40);
  return points;
}

Points lattice_ball(int dim, double R, double d)
{
  return keep(lattice(dim, static_cast<int>(R / d) + 1, d),
              [R](const Point &p) { return length(p) < R; });
}

Drop::Drop(int dimension, double spacing, const Points &all, int rows) :
    dim(dimension), owned(rows < 0 ? static_cast<int>(all.size()) : rows), d(spacing),
    volume(std::pow(spacing, dimension)), points(all), role(all.size(), FLUID)
{
  const Neighbours near(points, owned, REACH * d);
  s.build(Kernel(KernelType::CUBIC_SPLINE, dim, SMOOTHING * d), owned, near.x(), near.list());
  g.build(s, volume);
  Rows fluid(owned);
  std::iota(fluid.begin(), fluid.end(), 0);
  N.assign(3 * all.size(), 0.0);
  detect_surface(s, g, fluid, d, SurfaceParams(), role.data(), N.data());
  surface = surface_rows(fluid, role.data());
  PairFilter filter;
  filter.role = role.data();
  filter.rows = SURFACE;
  wide.build(wide_kernel(dim, d), owned, near.x(), near.list(), filter);
  std::fill(N.begin(), N.end(), 0.0);
  K.assign(all.size(), 0.0);
  known = mean = K;
}

void Drop::tangent()
{
  wide_gradient(wide, surface, role.data(), volume, N.data());
  normalise(surface, N.data());
  count = tangent_curvature(s, surface, role.data(), N.data(), volume, K.data(), known.data());
  smooth_curvature(s, surface, role.data(), N.data(), K.data(), known.data(), d, mean.data(),
                   count);
}

void Drop::published(double factor)
{
  std::vector<double> lambda(points.size());
  for (int i = 0; i < owned; i++) lambda[i] = g.lambda(i);
  eigenvalue_gradient(s, g, surface, lambda.data(), N.data());
  normalise(surface, N.data());
  count = published_curvature(s, g, surface, role.data(), N.data(), factor, d, mean.data());
}

std::vector<double> Drop::values() const
{
  std::vector<double> list;
  for (int i : surface) list.push_back(mean[i]);
  return list;
}

Statistics statistics(const std::vector<double> &values)
{
  Statistics result;
  const double n = static_cast<double>(values.size());
  for (double v : values) result.mean += v / n;
  for (double v : values) result.deviation += (v - result.mean) * (v - result.mean) / n;
  result.deviation = std::sqrt(result.deviation);
  const auto ends = std::minmax_element(values.begin(), values.end());
  result.least = *ends.first;
  result.most = *ends.second;
  return result;
}

}    // namespace aleisph_test
