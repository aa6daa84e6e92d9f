// SPDX-License-Identifier: GPL-2.0-only

#include "aleisph_contact.h"

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>

namespace aleisph {
namespace {

using Eigen::Vector3d;

constexpr double REACH = 4.8;         // of the fit of K_c, in spacings: all of the wide stencil
constexpr double PARALLEL = 0.25;     // sin of 14.5 degrees between N and n
constexpr double TIP_REACH = 1.7;     // in spacings: nearest neighbours
constexpr double MIN_COSINE = 0.3;    // normals further apart belong to different surfaces

Vector3d vector_at(const double *field, int i)
{
  return {field[3 * i], field[3 * i + 1], field[3 * i + 2]};
}

// x_i - x_j of pair k
Vector3d separation(const Stencil &s, int k)
{
  return s.r()[k] * Vector3d(s.e(0)[k], s.e(1)[k], s.dim() == 3 ? s.e(2)[k] : 0.0);
}

inline bool is_surface(Role role)
{
  return (role & FLUID) && (role & SURFACE) && !(role & BALLISTIC);
}

// from 0 at x <= 0 to 1 at x >= 1
double smooth_step(double x)
{
  x = std::clamp(x, 0.0, 1.0);
  return x * x * (3.0 - 2.0 * x);
}

// pair of i with the nearest wall particle, -1 if there is none
int nearest_wall(const Stencil &s, int i, const Role *role)
{
  int nearest = -1;
  for (int k = s.begin(i); k < s.end(i); k++)
    if ((role[s.col()[k]] & WALL) && (nearest < 0 || s.r()[k] < s.r()[nearest])) nearest = k;
  return nearest;
}

/* ----------------------------------------------------------------------
   The wall at particle i: a mean of the wall particles that are less than d
   farther than the nearest, so that it changes smoothly as i moves along a
   curved wall.
------------------------------------------------------------------------- */
struct WallBelow {
  Vector3d n = Vector3d::Zero();
  double height = 0.0;    // [length]
  double cosine = 0.0;
};

bool wall_below(const Stencil &wide, const Role *role, const double *normal, const double *cosine,
                double d, int i, WallBelow &wall)
{
  const int nearest = nearest_wall(wide, i, role);
  if (nearest < 0) return false;
  double weights = 0.0;
  for (int k = wide.begin(i); k < wide.end(i); k++) {
    const int j = wide.col()[k];
    const double beyond = (wide.r()[k] - wide.r()[nearest]) / d;
    if (!(role[j] & WALL) || beyond >= 1.0) continue;
    const double w = (1.0 - beyond) * (1.0 - beyond);
    const Vector3d n = vector_at(normal, j);
    wall.n += w * n;
    wall.height += w * separation(wide, k).dot(n);
    wall.cosine += w * cosine[j];
    weights += w;
  }
  const double length = wall.n.norm();
  if (!(length > 0.0)) return false;
  wall.n /= length;
  wall.height /= weights;
  wall.cosine /= weights;
  return true;
}

// Sums of K_c at one particle
class ContactCurvature {
 public:
  // dim 2: nothing is summed along the line
  ContactCurvature(const WallBelow &wall, const Vector3d &N, double d, int dim) :
      wall_(wall), N_(N), d_(d), along_(dim == 3 ? Vector3d(N.cross(wall.n)) : Vector3d::Zero())
  {
    const double length = along_.norm();
    if (length > 0.0) along_ /= length;
  }

  // a particle on the surface at x_i + r with the normal N
  void add(const Vector3d &r, const Vector3d &N, double reach)
  {
    const double w = std::pow(1.0 - r.norm() / reach, 2);
    const double height = wall_.height + r.dot(wall_.n);
    const double h = height + 0.5 * d_ * N.dot(wall_.n), s = r.dot(along_);
    ascent_ += w * h * (N.dot(wall_.n) - wall_.cosine);
    heights_ += w * h * h;
    turn_ += w * s * (N - N_).dot(along_);
    lengths_ += w * s * s;
    touching_ = std::max(touching_, smooth_step((TOUCHING - height / d_) / FADE));
  }

  // 1 where a particle is low enough to touch the wall and N is not normal to it
  double share() const
  {
    const double slope = (N_ - N_.dot(wall_.n) * wall_.n).norm();
    return touching_ * std::min(1.0, slope / PARALLEL);
  }

  // within 1/d; limited: whether it was beyond
  double value(bool &limited) const
  {
    const double bound = 1.0 / d_;
    double K = heights_ > 0.0 ? ascent_ / heights_ : 0.0;
    // particles lie d/2 inside the surface; the pole at -2/d is out of reach
    const double k = lengths_ > 0.0 ? turn_ / lengths_ : 0.0;
    K += std::max(k, -bound) / (1.0 + 0.5 * d_ * std::max(k, -bound));
    limited = std::abs(K) > bound;
    return std::clamp(K, -bound, bound);
  }

 private:
  static constexpr double TOUCHING = 1.9, FADE = 0.5;    // heights in spacings

  const WallBelow wall_;
  const Vector3d N_;
  const double d_;
  Vector3d along_;    // the line
  double ascent_ = 0.0, heights_ = 0.0, turn_ = 0.0, lengths_ = 0.0, touching_ = 0.0;
};

}    // namespace

int bind_tips(const Stencil &s, const Rows &fluid, double d, Role *role)
{
  Rows bound;
  for (const int i : fluid) {
    if (!(role[i] & BALLISTIC)) continue;
    int walls = 0, others = 0;
    for (int k = s.begin(i); k < s.end(i); k++) {
      if (s.r()[k] >= TIP_REACH * d) continue;
      const Role r = role[s.col()[k]];
      walls += (r & WALL) != 0;
      others += (r & (FLUID | WALL)) == FLUID;
    }
    if (others > 0 && walls >= s.dim()) bound.push_back(i);
  }
  for (const int i : bound) role[i] &= ~BALLISTIC;
  return static_cast<int>(bound.size());
}

int contact_normals(const Stencil &s, const Rows &surface, const Role *role, const double *normal,
                    const double *cosine, double d, const ContactParams &params, double *contact)
{
  int count = 0;
  for (const int i : surface) {
    std::fill(contact + 4 * i, contact + 4 * i + 4, 0.0);
    const int k = nearest_wall(s, i, role);
    if (k < 0) continue;
    const int j = s.col()[k];
    const Vector3d n = vector_at(normal, j), N = vector_at(normal, i);
    if (separation(s, k).dot(n) >= params.reach * d) continue;
    const Vector3d along = N - N.dot(n) * n;
    const double length = along.norm();
    if (!(length > PARALLEL)) continue;
    const double c = cosine[j], sine = std::sqrt(1.0 - c * c);
    const Vector3d Nc = sine / length * along + c * n;
    for (int a = 0; a < 3; a++) contact[4 * i + a] = Nc[a];
    contact[4 * i + 3] = 1.0;
    count++;
  }
  return count;
}

void contact_planes(const Stencil &wide, const Rows &walls, const Role *role, const double *normal,
                    const double *contact, double d, double *plane)
{
  for (const int j : walls) {
    plane[2 * j] = (role[j] & DRY) ? COVERED : -COVERED;
    plane[2 * j + 1] = 0.0;
    const Vector3d n = vector_at(normal, j);
    double nearest2 = 0.0;
    int pair = -1;
    for (int k = wide.begin(j); k < wide.end(j); k++) {
      if (contact[4 * wide.col()[k] + 3] == 0.0) continue;
      const Vector3d r = separation(wide, k);
      const double along2 = (r - r.dot(n) * n).squaredNorm();
      if (pair >= 0 && along2 >= nearest2) continue;
      nearest2 = along2;
      pair = k;
    }
    if (pair < 0) continue;
    const double *c = contact + 4 * wide.col()[pair];
    const Vector3d Nc(c[0], c[1], c[2]);
    plane[2 * j] = separation(wide, pair).dot(Nc) / d - 0.5;
    plane[2 * j + 1] = n.dot(Nc);
  }
}

void add_continuation(const Stencil &wide, const Kernel &kernel, const Rows &surface,
                      const Role *role, const double *normal, const double *plane, double volume,
                      double d, const ContactParams &params, double *N)
{
  for (const int i : surface) {
    Vector3d sum = Vector3d::Zero();
    for (int k = wide.begin(i); k < wide.end(i); k++) {
      const int j = wide.col()[k];
      if (!(role[j] & WALL)) continue;
      const Vector3d r0 = separation(wide, k), n = vector_at(normal, j);
      for (int m = 0; m <= params.depth; m++) {
        const double weight = std::clamp(0.5 - (plane[2 * j] - m * plane[2 * j + 1]), 0.0, 1.0);
        const Vector3d r = r0 + m * d * n;
        const double distance = r.norm();
        if (weight == 0.0 || distance == 0.0) continue;
        sum -= volume * weight * kernel.dw(distance) / distance * r;
      }
    }
    for (int a = 0; a < 3; a++) N[3 * i + a] += sum[a];
  }
}

int contact_curvature(const Stencil &wide, const Rows &surface, const Role *role,
                      const double *normal, const double *cosine, const double *N, double d,
                      const ContactParams &params, double *share, double *K)
{
  int count = 0;
  for (const int i : surface) {
    share[i] = 0.0;
    WallBelow wall;
    if (!wall_below(wide, role, normal, cosine, d, i, wall)) continue;
    if (!(wall.height < params.far * d)) continue;
    const Vector3d Ni = vector_at(N, i);
    ContactCurvature sums(wall, Ni, d, wide.dim());
    sums.add(Vector3d::Zero(), Ni, REACH * d);
    for (int k = wide.begin(i); k < wide.end(i); k++) {
      const int j = wide.col()[k];
      if (!is_surface(role[j]) || !(wide.r()[k] < REACH * d)) continue;
      const Vector3d Nj = vector_at(N, j);
      if (Ni.dot(Nj) > MIN_COSINE) sums.add(-separation(wide, k), Nj, REACH * d);
    }
    const double fade = (params.far - wall.height / d) / (params.far - params.near);
    share[i] = sums.share() * smooth_step(fade);
    bool limited = false;
    K[i] += share[i] * (sums.value(limited) - K[i]);
    count += limited && share[i] > 0.0;
  }
  return count;
}

void contact_surface_normals(const Rows &surface, const double *share, const double *N,
                             double *normal)
{
  for (const int i : surface) {
    const Vector3d mean = (1.0 - share[i]) * vector_at(normal, i) + share[i] * vector_at(N, i);
    const double length = mean.norm();
    if (share[i] > 0.0 && length > 0.0)
      for (int a = 0; a < 3; a++) normal[3 * i + a] = mean[a] / length;
  }
}

}    // namespace aleisph
