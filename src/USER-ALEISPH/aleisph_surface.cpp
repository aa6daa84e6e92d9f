// SPDX-License-Identifier: GPL-2.0-only
/* ----------------------------------------------------------------------
   Scratch arrays live as long as
   one call, so that no particle allocates memory.
------------------------------------------------------------------------- */

#include "aleisph_surface.h"

#include "aleisph_cloud.h"
#include "aleisph_wall_cone.h"

#include <Eigen/Dense>
#include <algorithm>
#include <array>
#include <cmath>

namespace aleisph {
namespace {

using Vec3 = Eigen::Vector3d;

constexpr double PI = 3.14159265358979323846;
constexpr double DEGREE = PI / 180.0;

// A gap of exactly the allowed width does not count, up to rounding: 90 degrees is frequent on
// lattices.
constexpr double TIE = 1.0e-9;    // radians

// A colour gradient shorter than this part of the sum of its terms has no direction.
constexpr double NO_DIRECTION = 1.0e-6;

constexpr int DIRECTIONS = 96;
using Directions = std::array<Vec3, DIRECTIONS>;

// quasi-uniform on the unit sphere: equal steps in z, azimuth by the golden angle
const Directions &fibonacci_directions()
{
  static const Directions directions = [] {
    const double golden = PI * (3.0 - std::sqrt(5.0));
    Directions all;
    for (int k = 0; k < DIRECTIONS; k++) {
      const double z = 1.0 - (2.0 * k + 1.0) / DIRECTIONS, s = std::sqrt(1.0 - z * z);
      all[k] = Vec3(s * std::cos(golden * k), s * std::sin(golden * k), z);
    }
    return all;
  }();
  return directions;
}

/* ----------------------------------------------------------------------
   Is there an empty direction around a particle? Directions through a wall are
   never empty, even if the particle lies almost on the wall: each wall
   neighbour also counts at a point d behind it.
------------------------------------------------------------------------- */
class AllRoundTest {
 public:
  AllRoundTest(const Cloud &cloud, double reach, double half_angle) :
      s_(cloud.stencil()), role_(cloud.role()), normal_(cloud.normal()), d_(cloud.spacing()),
      reach_(reach), half_angle_(half_angle), cosine_(std::cos(half_angle)),
      directions_(fibonacci_directions())
  {
  }

  bool open(int i)
  {
    collect(i);
    return s_.dim() == 2 ? open_2d() : open_3d();
  }

 private:
  // unit vectors to the neighbours
  void collect(int i)
  {
    near_.clear();
    for (int k = s_.begin(i); k < s_.end(i); k++) {
      if (s_.r()[k] > reach_) continue;
      Vec3 u = Vec3::Zero();
      for (int a = 0; a < s_.dim(); a++) u[a] = -s_.e(a)[k];
      near_.push_back(u);
      const int j = s_.col()[k];
      if (!(role_[j] & WALL)) continue;
      const Vec3 behind = s_.r()[k] * u - d_ * Eigen::Map<const Vec3>(normal_ + 3 * j);
      const double distance = behind.norm();
      if (distance > 0.0 && distance <= reach_) near_.push_back(behind / distance);
    }
  }

  bool open_2d()
  {
    azimuth_.clear();
    for (const Vec3 &u : near_) azimuth_.push_back(std::atan2(u[1], u[0]));
    if (azimuth_.empty()) return true;
    std::sort(azimuth_.begin(), azimuth_.end());
    double widest = azimuth_.front() + 2.0 * PI - azimuth_.back();
    for (size_t m = 1; m < azimuth_.size(); m++)
      widest = std::max(widest, azimuth_[m] - azimuth_[m - 1]);
    return widest > 2.0 * half_angle_ + TIE;
  }

  bool open_3d() const
  {
    return std::any_of(directions_.begin(), directions_.end(), [this](const Vec3 &direction) {
      return std::none_of(near_.begin(), near_.end(),
                          [this, &direction](const Vec3 &u) { return u.dot(direction) > cosine_; });
    });
  }

  const Stencil &s_;
  const Role *role_;
  const double *normal_;
  const double d_, reach_, half_angle_, cosine_;
  const Directions &directions_;
  std::vector<double> azimuth_;
  std::vector<Vec3> near_;
};

class SurfaceNormal {
 public:
  SurfaceNormal(const Stencil &s, const Role *role, double wall_reach) :
      s_(s), role_(role), wall_reach_(wall_reach)
  {
  }

  // zero if there is no direction
  Vec3 at(int i, const double *normal)
  {
    Vec3 N = Vec3::Zero();
    double weight = 0.0;
    walls_.clear();
    for (int k = s_.begin(i); k < s_.end(i); k++) {
      const int j = s_.col()[k];
      for (int a = 0; a < s_.dim(); a++) N[a] -= s_.dw()[k] * s_.e(a)[k];
      weight -= s_.dw()[k];
      if ((role_[j] & WALL) && s_.r()[k] <= wall_reach_)
        walls_.push_back(Eigen::Map<const Vec3>(normal + 3 * j));
    }
    N = without_parts_into_walls(N, walls_);
    return N.norm() > NO_DIRECTION * weight ? N.normalized() : Vec3::Zero();
  }

 private:
  const Stencil &s_;
  const Role *role_;
  const double wall_reach_;
  std::vector<Vec3> walls_;    // normals of the walls near the particle
};

int fluid_neighbours(const Stencil &s, const Role *role, int i)
{
  return static_cast<int>(std::count_if(s.col() + s.begin(i), s.col() + s.end(i),
                                        [role](int j) { return (role[j] & FLUID) != 0; }));
}

}    // namespace

SurfaceCount detect_surface(Cloud &cloud, const SurfaceParams &params)
{
  const Stencil &s = cloud.stencil();
  const GradientWeights &g = cloud.gradient();
  const double d = cloud.spacing();
  Role *const role = cloud.role();
  double *const normal = cloud.normal();
  const int least = params.min_neighbours > 0 ? params.min_neighbours : s.dim() + 1;
  AllRoundTest test(cloud, params.reach * d, params.half_angle * DEGREE);
  SurfaceNormal outward(s, role, params.wall_reach * d);
  // of each row; added when no row reads the roles of others any more
  std::vector<Role> found(cloud.owned());
  for_rows(cloud.fluid(), [&](int i) {
    const bool ballistic = fluid_neighbours(s, role, i) < least;
    const bool surface = ballistic || (g.lambda(i) < params.max_lambda && test.open(i));
    found[i] = (ballistic ? BALLISTIC : 0) | (surface ? SURFACE : 0);
    Eigen::Map<Vec3>(normal + 3 * i) = surface ? outward.at(i, normal) : Vec3(Vec3::Zero());
  });
  for_rows(cloud.fluid(), [&](int i) { role[i] |= found[i]; });
  cloud.roles_changed();
  const auto count = [&](Role which) {
    return count_rows(cloud.fluid(), [&](int i) { return found[i] & which; });
  };
  return {count(SURFACE), count(BALLISTIC)};
}

bool in_film(const Cloud &cloud, int i)
{
  const Role *const role = cloud.role();
  if (!(role[i] & SURFACE)) return false;
  const Stencil &s = cloud.stencil();
  for (int k = s.begin(i); k < s.end(i); k++)
    if (bound_fluid(role[s.col()[k]]) && !(role[s.col()[k]] & SURFACE)) return false;
  return true;
}

}    // namespace aleisph
