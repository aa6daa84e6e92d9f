// SPDX-License-Identifier: GPL-2.0-only

#include "drops.h"

#include "aleisph_tension_published.h"
#include "aleisph_tension_tangent.h"

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

Point difference(const Point &p, const Point &q)
{
  return {p[0] - q[0], p[1] - q[1], p[2] - q[2]};
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
    const Point e = difference(points[i], points[j]);
    const double r = length(e) / d;
    if (!(r < 1.5) || r == 0.0) continue;
    const double w = (1.0 - r / 1.5) * (1.0 - r / 1.5);
    for (int a = 0; a < 3; a++) sum[a] += w * e[a] / (r * d);
  }
  return sum;
}

// one pass; the first `outer` points keep their radius R, the others stay within it
void push(Points &points, int outer, double R, double d, const Neighbours &near)
{
  const Points old = points;
  for (int i = 0; i < static_cast<int>(points.size()); i++) {
    const Point move = repulsion(old, i, near.of(i), d);
    for (int a = 0; a < 3; a++) points[i][a] += 0.2 * d * move[a];
    if (i < outer || length(points[i]) > R) set_length(points[i], R);
  }
}

// particles of a shell of thickness d: its area or volume in units of d
int shell_count(int dim, int k)
{
  const double cells = dim == 2 ? M_PI * (2.0 * k - 1.0)
                                : 4.0 / 3.0 * M_PI * (3.0 * k * (k - 1) + 1.0);
  return static_cast<int>(std::lround(cells));
}

}    // namespace

Neighbours::Neighbours(const Points &points, int owned, double reach) : lists_(owned)
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
      for (int j : found->second)
        if (j != i && length(difference(points[i], points[j])) < reach) lists_[i].push_back(j);
    }
    count_.push_back(static_cast<int>(lists_[i].size()));
    first_.push_back(lists_[i].data());
  }
}

Points shells(int dim, int first, int last, double d)
{
  Points points;
  for (int k = last; k >= first; k--)
    for (Point &x : directions(dim, shell_count(dim, k), 0.7 * k)) {
      set_length(x, (k - 0.5) * d);
      points.push_back(x);
    }
  return points;
}

Points relaxed_ball(int dim, int n, double d)
{
  Points points = shells(dim, 1, n, d);
  for (int list = 0; list < 4; list++) {    // none moves by half a margin of 0.5 d in 10 passes
    const Points listed = points;
    const Neighbours near(listed, static_cast<int>(points.size()), 2.0 * d);
    for (int pass = 0; pass < 10; pass++) push(points, shell_count(dim, n), (n - 0.5) * d, d, near);
  }
  return points;
}

Points lattice_ball(int dim, double R, double d)
{
  return keep(lattice(dim, static_cast<int>(R / d) + 1, d),
              [R](const Point &p) { return length(p) < R; });
}

Drop::Drop(int dim, double d, const Points &points, const Point &period) :
    dim_(dim), owned_(static_cast<int>(points.size())), d_(d), points_(points),
    owner_(points.size()),
    cloud_(empty_cloud(Kernel(KernelType::CUBIC_SPLINE, dim, SMOOTHING * d), d))
{
  std::iota(owner_.begin(), owner_.end(), 0);
  add_ghosts(period);
  near_ = std::make_unique<Neighbours>(points_, owned_, REACH * d);
  detect();
}

void Drop::add_ghosts(const Point &period)
{
  for (int a = 0; a < 3; a++) {
    const size_t n = points_.size();    // those of the axes before have images, too
    for (int side = -1; side < 2 && period[a] > 0.0; side += 2)
      for (size_t i = 0; i < n; i++) {
        const Point image = points_[i];
        points_.push_back(image);
        points_.back()[a] += side * period[a];
        owner_.push_back(owner_[i]);
      }
  }
}

void Drop::detect()
{
  cloud_.reset(owned_, static_cast<int>(points_.size()));
  set_particles(cloud_, {});
  cloud_.update(near_->x(), near_->list());
  detect_surface(cloud_, SurfaceParams());
  exchange(cloud_.role(), 1);
  cloud_.roles_changed();
  result_.rows = surface_rows(cloud_);
}

void Drop::measure(TensionModel &model)
{
  model.update({cloud_, near_->x(), near_->list(), nullptr,
                [this](double *field, int n) { exchange(field, n); }});
  result_ = model.result();
}

void Drop::tangent()
{
  TangentTension model(dim_, d_);
  measure(model);
}

void Drop::published(double factor)
{
  PublishedTension model(factor);
  measure(model);
}

SurfaceArea Drop::area() const
{
  return surface_area(cloud_, {result_.N.data(), result_.K.data(), nullptr});
}

std::vector<double> Drop::values(const std::function<bool(const Point &)> &predicate) const
{
  std::vector<double> list;
  for (int i : result_.rows)
    if (predicate(points_[i])) list.push_back(K(i));
  return list;
}

std::vector<double> Drop::values() const
{
  return values([](const Point &) { return true; });
}

Statistics statistics(const std::vector<double> &values)
{
  Statistics result;
  const double n = static_cast<double>(values.size());
  for (double v : values) result.mean += v / n;
  for (double v : values) result.deviation += (v - result.mean) * (v - result.mean) / n;
  result.deviation = std::sqrt(result.deviation);
  return result;
}

}    // namespace aleisph_test
