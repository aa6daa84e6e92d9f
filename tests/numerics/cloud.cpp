// SPDX-License-Identifier: GPL-2.0-only

#include "cloud.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <random>

namespace aleisph_test {

using namespace aleisph;

LaplacianLimits no_limits()
{
  constexpr double inf = std::numeric_limits<double>::infinity();
  LaplacianLimits limits;
  limits.min_lambda = 0.0;
  limits.max_cond = inf;
  limits.min_diagonal = -inf;
  limits.max_diagonal = inf;
  return limits;
}

namespace {

double norm2(const Point &p)
{
  return p[0] * p[0] + p[1] * p[1] + p[2] * p[2];
}

}    // namespace

Points lattice(int dim, int n, double d)
{
  const int nz = dim == 3 ? n : 0;
  Points points;
  for (int k = -nz; k <= nz; k++)
    for (int j = -n; j <= n; j++)
      for (int i = -n; i <= n; i++) points.push_back({i * d, j * d, k * d});
  std::stable_sort(points.begin(), points.end(),
                   [](const Point &p, const Point &q) { return norm2(p) < norm2(q); });
  return points;
}

void jitter(Points &points, int dim, double amplitude, unsigned seed)
{
  std::mt19937 random(seed);
  std::uniform_real_distribution<double> deviate(-amplitude, amplitude);
  for (Point &p : points)
    for (int a = 0; a < dim; a++) p[a] += deviate(random);
}

Points keep(const Points &points, const std::function<bool(const Point &)> &predicate)
{
  Points kept;
  std::copy_if(points.begin(), points.end(), std::back_inserter(kept), predicate);
  return kept;
}

Points cut(const Points &points, int planes, double c)
{
  return keep(points, [planes, c](const Point &p) {
    for (int a = 0; a < planes; a++)
      if (p[a] > c) return false;
    return true;
  });
}

PointSet::PointSet(Points points, int owned, double reach, unsigned seed) :
    owned_(owned), points_(std::move(points)), lists_(owned), masked_(owned)
{
  std::mt19937 random(seed);
  for (const Point &p : points_) x_.push_back(p.data());
  for (int i = 0; i < owned_; i++) {
    for (int j = 0; j < total(); j++) {
      const Point r = {points_[i][0] - points_[j][0], points_[i][1] - points_[j][1],
                       points_[i][2] - points_[j][2]};
      if (j != i && norm2(r) <= reach * reach) lists_[i].push_back(j);
    }
    if (seed > 0) std::shuffle(lists_[i].begin(), lists_[i].end(), random);
    for (int j : lists_[i]) masked_[i].push_back(j | (j % 3) << 29);
    count_.push_back(static_cast<int>(lists_[i].size()));
    first_.push_back(masked_[i].data());
  }
}

Rows PointSet::rows() const
{
  Rows rows;
  for (int i = 0; i < owned_; i++) rows.push_back(i);
  return rows;
}

PointSet one_row(const Kernel &kernel, int planes, double amplitude, unsigned seed)
{
  const int n = static_cast<int>(std::ceil(kernel.support() / D)) + 1;
  Points points = cut(lattice(kernel.dim(), n, D), planes, 0.5 * D);
  jitter(points, kernel.dim(), amplitude, seed);
  return PointSet(points, 1, kernel.support() + 0.3 * D, seed);
}

PointSet block(int dim, int n, unsigned seed)
{
  Points points = lattice(dim, n, D);
  jitter(points, dim, 0.2 * D, seed);
  const int owned = static_cast<int>(points.size());
  return PointSet(points, owned, 4.0 * D, seed);
}

void set_particles(Cloud &cloud, const std::vector<Role> &role, const std::vector<double> &normal)
{
  if (role.empty())
    std::fill_n(cloud.role(), cloud.size(), FLUID);
  else
    std::copy_n(role.begin(), cloud.size(), cloud.role());
  if (!normal.empty()) std::copy_n(normal.begin(), 3 * cloud.size(), cloud.normal());
  cloud.roles_changed();
}

Cloud empty_cloud(const Kernel &kernel, double d)
{
  static Timers timers;    // nobody looks at them
  return Cloud(kernel, d, timers);
}

Cloud make_cloud(const Kernel &kernel, double d, const PointSet &points,
                 const CloudOptions &options)
{
  Cloud cloud = empty_cloud(kernel, d);
  cloud.reset(points.owned(), points.total());
  set_particles(cloud, options.role, options.normal);
  cloud.update(points.x(), points.list(), options.dry);
  return cloud;
}

Discrete::Discrete(const Kernel &kernel, double d, const PointSet &points,
                   const LaplacianLimits &limits) :
    cloud_(make_cloud(kernel, d, points))
{
  cloud_.set_limits(limits);
  cloud_.laplacian();
}

std::vector<double> random_field(int n, unsigned seed)
{
  std::mt19937 random(seed);
  std::uniform_real_distribution<double> deviate(-1.0, 1.0);
  std::vector<double> f(n);
  for (double &value : f) value = deviate(random);
  return f;
}

std::vector<double> sample(const PointSet &cloud, const std::function<double(const Point &)> &f)
{
  std::vector<double> values;
  for (const Point &p : cloud.points()) values.push_back(f(p));
  return values;
}

std::vector<double> sample_vector(const PointSet &cloud,
                                  const std::function<Point(const Point &)> &f)
{
  std::vector<double> values;
  for (const Point &p : cloud.points()) {
    const Point v = f(p);
    values.insert(values.end(), v.begin(), v.end());
  }
  return values;
}

}    // namespace aleisph_test
