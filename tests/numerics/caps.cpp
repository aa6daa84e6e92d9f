// SPDX-License-Identifier: GPL-2.0-only

#include "caps.h"

#include "aleisph_tension_contact_continuation.h"
#include "aleisph_tension_contact_curvature.h"
#include "aleisph_tension_contact_walls.h"
#include "aleisph_tension_tangent.h"
#include "aleisph_wall_cone.h"

#include <algorithm>
#include <cmath>
#include <random>

namespace aleisph_test {

using namespace aleisph;

namespace {

// What a particle may do while the inside comes to rest
enum class Bound { FIXED, SHELL, ROW, INSIDE };

double distance(const Point &p, const Point &q)
{
  return std::hypot(p[0] - q[0], p[1] - q[1], p[2] - q[2]);
}

// lengths in spacings until the end
class Filling {
 public:
  Filling(const CapShape &shape, unsigned seed) :
      dim_(shape.dim), row_(shape.row), R_(shape.radius / D), angle_(shape.angle),
      centre_({0.0, shape.height() / D, 0.0}), random_(seed)
  {
    polar_ = std::acos(std::clamp((row_ - centre_[1]) / layer(), -1.0, 1.0));
    rim_ = layer() * std::sin(polar_);
  }

  void shell()
  {
    if (dim_ == 2)
      arc();
    else
      sphere();
    surface_ = points_.size();
  }

  void inside()
  {
    const int n = static_cast<int>(std::lround(volume()));
    bottom();
    while (static_cast<int>(points_.size()) < n) {
      const Point p = {layer() * uniform(), centre_[1] + layer() * uniform(),
                       dim_ == 3 ? layer() * uniform() : 0.0};
      if (p[1] > row_ + 0.4 && distance(p, centre_) < layer() - 0.4) add(p, Bound::INSIDE);
    }
    const int passes = dim_ == 2 ? 400 : 250;
    for (int k = 0; k < passes; k++) push(0.5 * (1.0 - 0.7 * k / passes), k % 20 == 0);
  }

  CapPoints points() const
  {
    CapPoints all;
    for (size_t i = 0; i < points_.size(); i++) {
      Point p = points_[i];
      for (double &x : p) x *= D;
      (i < surface_ ? all.surface : all.inner).push_back(p);
    }
    return all;
  }

 private:
  double layer() const { return R_ - 0.5; }
  double uniform() { return std::uniform_real_distribution<double>(-1.0, 1.0)(random_); }

  void add(const Point &p, Bound bound)
  {
    points_.push_back(p);
    bound_.push_back(bound);
  }

  void arc()
  {
    const int n = static_cast<int>(std::lround(2.0 * polar_ * layer()));
    for (int k = 0; k <= n; k++) {
      const double t = polar_ * (2.0 * k / n - 1.0);
      add({layer() * std::sin(t), centre_[1] + layer() * std::cos(t), 0.0}, Bound::FIXED);
    }
    if (wedge_beyond() < 0.4) return;
    for (const double side : {-1.0, 1.0}) add({side * (rim_ + 1.0), 0.7, 0.0}, Bound::FIXED);
  }

  // Area of fluid beyond the last cell of the first row, above the cells of the wall: where the
  // angle is small it has room for another particle, which is found at a height of 0.7
  double wedge_beyond() const
  {
    if (angle_ > 1.0) return 0.0;
    const double slope = std::tan(angle_), base = R_ * std::sin(angle_) - rim_ - 0.5;
    const double height = base * slope - 0.5;
    return height > 0.0 ? 0.5 * height * height / slope : 0.0;
  }

  void sphere()
  {
    const int n = static_cast<int>(std::lround(2.0 * M_PI * rim_));
    for (int k = 0; k < n; k++) {
      const double phi = 2.0 * M_PI * k / n;
      add({rim_ * std::cos(phi), row_, rim_ * std::sin(phi)}, Bound::FIXED);
    }
    const double part = 1.0 - std::cos(polar_);
    const int rest = static_cast<int>(std::lround(2.0 * M_PI * layer() * layer() * part - 0.5 * n));
    for (int k = 0; k < rest; k++) {
      const double z = 1.0 - part * (k + 0.5) / rest, rho = layer() * std::sqrt(1.0 - z * z);
      const double phi = M_PI * (3.0 - std::sqrt(5.0)) * k;
      add({rho * std::cos(phi), centre_[1] + layer() * z, rho * std::sin(phi)}, Bound::SHELL);
    }
  }

  void bottom()
  {
    if (dim_ == 2) {
      const int n = static_cast<int>(std::lround(2.0 * rim_));
      for (int k = 1; k < n; k++) add({rim_ * (2.0 * k / n - 1.0), row_, 0.0}, Bound::FIXED);
      return;
    }
    const int n = static_cast<int>(std::lround(M_PI * rim_ * (rim_ - 1.0)));
    for (int k = 0; k < n; k++) {
      const double rho = (rim_ - 0.5) * std::sqrt((k + 0.5) / n);
      const double phi = M_PI * (3.0 - std::sqrt(5.0)) * k;
      add({rho * std::cos(phi), row_, rho * std::sin(phi)}, Bound::ROW);
    }
  }

  // that of the particles: without the cells of the wall
  double volume() const
  {
    const double c = std::cos(angle_), a = R_ * std::sin(angle_), below = row_ - 0.5;
    if (dim_ == 2) return R_ * R_ * (angle_ - std::sin(angle_) * c) - 2.0 * a * below;
    return M_PI / 3.0 * std::pow(R_, 3) * (1.0 - c) * (1.0 - c) * (2.0 + c) - M_PI * a * a * below;
  }

  void list()
  {
    near_.assign(points_.size(), {});
    for (size_t i = 0; i < points_.size(); i++)
      for (size_t j = 0; j < points_.size(); j++)
        if (i != j && distance(points_[i], points_[j]) < 2.2) near_[i].push_back(j);
  }

  Point repulsion(const Points &old, size_t i) const
  {
    Point sum = {0.0, 0.0, 0.0};
    for (const size_t j : near_[i]) {
      const double r = distance(old[i], old[j]) + 1.0e-9;
      const double w = std::pow(std::max(0.0, 1.0 - r / 1.6), 2) / r;
      for (int a = 0; a < dim_; a++) sum[a] += w * (old[i][a] - old[j][a]);
    }
    return sum;
  }

  void push(double step, bool relist)
  {
    if (relist) list();
    const Points old = points_;
    for (size_t i = 0; i < points_.size(); i++) {
      if (bound_[i] == Bound::FIXED) continue;
      const Point force = repulsion(old, i);
      for (int a = 0; a < dim_; a++) points_[i][a] += std::clamp(step * force[a], -0.2, 0.2);
      hold(points_[i], bound_[i]);
    }
  }

  void hold(Point &p, Bound bound) const
  {
    const double most = bound == Bound::SHELL ? layer() : layer() - 0.3;
    const double r = distance(p, centre_);
    if (bound == Bound::SHELL || (bound == Bound::INSIDE && r > most))
      for (int a = 0; a < 3; a++) p[a] = centre_[a] + (p[a] - centre_[a]) * most / r;
    p[1] = bound == Bound::ROW ? row_ : std::max(p[1], row_);
  }

  int dim_;
  double row_, R_, angle_, polar_, rim_;
  Point centre_;
  std::mt19937 random_;
  Points points_;
  std::vector<Bound> bound_;
  std::vector<std::vector<size_t>> near_;
  size_t surface_ = 0;
};

Points wall_points(const CapShape &shape)
{
  Points points;
  const double reach = shape.radius / D + 9.0;
  const int n = static_cast<int>(std::ceil(reach)), nz = shape.dim == 3 ? n : 0;
  for (int k = -nz; k <= nz; k++)
    for (int i = -n; i <= n; i++)
      if (std::hypot(i, k) < reach)
        points.push_back({(i + shape.offset) * D, 0.0, (nz ? k + 0.7 * shape.offset : 0.0) * D});
  return points;
}

Points together(const CapPoints &points)
{
  Points all = points.surface;
  all.insert(all.end(), points.inner.begin(), points.inner.end());
  all.insert(all.end(), points.wall.begin(), points.wall.end());
  return all;
}

}    // namespace

CapShape CapShape::of_volume(int dim, double n, double angle)
{
  const double c = std::cos(angle);
  const double ratio = dim == 2 ? std::sqrt(0.5 * M_PI / (angle - std::sin(angle) * c))
                                : std::cbrt(2.0 / ((1.0 - c) * (1.0 - c) * (2.0 + c)));
  CapShape shape;
  shape.dim = dim;
  shape.radius = n * D * ratio;
  shape.angle = angle;
  return shape;
}

CapPoints cap_shell(const CapShape &shape)
{
  Filling filling(shape, 1);
  filling.shell();
  CapPoints points = filling.points();
  points.wall = wall_points(shape);
  return points;
}

CapPoints full_cap(const CapShape &shape, unsigned seed)
{
  Filling filling(shape, seed);
  filling.shell();
  filling.inside();
  CapPoints points = filling.points();
  points.wall = wall_points(shape);
  return points;
}

void rotate(CapPoints &points, double angle)
{
  const double c = std::cos(angle), s = std::sin(angle);
  for (Points *list : {&points.surface, &points.inner, &points.wall})
    for (Point &p : *list) p = {c * p[0] - s * p[1], s * p[0] + c * p[1], p[2]};
}

/* ---------------------------------------------------------------------- */

Contact::Contact(int dim, const CapPoints &points, const Point &n, double theta) :
    Contact(dim, points, std::vector<WallSide>(points.wall.size(), {n}), theta)
{
}

Contact::Contact(int dim, const CapPoints &points, const std::vector<WallSide> &walls,
                 double theta) :
    cloud(empty_cloud(Kernel(KernelType::CUBIC_SPLINE, dim, H), D)),
    nsurface_(static_cast<int>(points.surface.size())),
    points_(together(points),
            static_cast<int>(points.surface.size() + points.inner.size() + points.wall.size()),
            4.8 * D),
    wide_(dim, D)
{
  const int total = points_.total(), fluid = total - static_cast<int>(points.wall.size());
  cloud.reset(total, total);
  std::fill_n(cloud.role(), fluid, FLUID);
  contact.assign(4 * total, 0.0);
  plane.assign(2 * total, 0.0);
  N.assign(3 * total, 0.0);
  cosine_.assign(total, std::cos(theta));
  K.assign(total, 0.0);
  share = K;
  for (int i = 0; i < nsurface_; i++) {
    cloud.role()[i] |= SURFACE;
    rows_.push_back(i);
  }
  for (int j = fluid; j < total; j++) {
    cloud.role()[j] = WALL;
    walls_.push_back(j);
    const WallSide &side = walls[j - fluid];
    std::copy(side.n.begin(), side.n.end(), cloud.normal() + 3 * j);
    cloud.shape()[j] = side.shape;
    const Eigen::Vector3d n(side.n.data());
    if (std::find(directions_.begin(), directions_.end(), n) == directions_.end())
      directions_.push_back(n);
  }
  mark_dry();
  cloud.update(points_.x(), points_.list(), true);
  wide_.build(cloud, points_.x(), points_.list());
}

void Contact::mark_dry()
{
  for (const int j : walls_) {
    const double reach = 1.2 * cloud.shape()[j] * D;
    bool dry = true;
    for (const int i : points_.candidates(j))
      if ((cloud.role()[i] & FLUID) && distance(point(i), point(j)) < reach) dry = false;
    if (dry) cloud.role()[j] |= DRY;
  }
}

void Contact::set_normal(int i, const Point &n)
{
  std::copy(n.begin(), n.end(), &N[3 * i]);
}

int Contact::set_contact_normals()
{
  return contact_normals(ContactWalls(cloud, cloud.stencil(), cosine_.data()), rows_,
                         ContactParams(), contact.data());
}

void Contact::set_planes()
{
  contact_planes(cloud, wide_, contact.data(), ContactParams(), plane.data());
}

int Contact::set_curvature()
{
  return contact_curvature(ContactWalls(cloud, wide_.pairs, cosine_.data()), rows_, ContactParams(),
                           N.data(), share.data(), K.data());
}

// as detect_surface() does: the colour gradient of the fluid without its part into walls
void Contact::outward()
{
  wide_gradient(cloud, wide_, rows_, cloud.normal());
  for (const int i : rows_) {
    Eigen::Map<Eigen::Vector3d> v(cloud.normal() + 3 * i);
    v = without_parts_into_walls(v, directions_);
  }
  normalise(rows_, cloud.normal());
}

void Contact::measure()
{
  TangentTension model(cloud.dim(), D);
  measure(model);
}

void Contact::measure(TensionModel &model)
{
  outward();
  model.update(
      {cloud, points_.x(), points_.list(), cosine_.data(), [](double * /*field*/, int /*n*/) {}});
  contact = model.result().contact;
  N = model.result().N;
  K = model.result().K;
  share = model.result().share;
}

}    // namespace aleisph_test
