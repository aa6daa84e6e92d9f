// SPDX-License-Identifier: GPL-2.0-only

#include "aleisph_contact.h"
#include "aleisph_contact_walls.h"
#include "aleisph_tension.h"
#include "aleisph_vectors.h"

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>

namespace aleisph {
namespace {

using Eigen::Vector3d;

constexpr double REACH = 4.8;        // of the fit of K_c, in spacings: all of the wide stencil
constexpr double PARALLEL = 0.25;    // sin of 14.5 degrees between N and n
constexpr double TIP_REACH = 1.7;    // in spacings: nearest neighbours

// from 0 at x <= 0 to 1 at x >= 1
double smooth_step(double x)
{
  x = std::clamp(x, 0.0, 1.0);
  return x * x * (3.0 - 2.0 * x);
}

// Sums of K_c at one particle
class ContactCurvature {
 public:
  // dim 2: nothing is summed along the line
  ContactCurvature(const ContactWall &wall, const Vector3d &N, double d, int dim) :
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

  // k, across the wall
  double ascent() const { return heights_ > 0.0 ? ascent_ / heights_ : 0.0; }

  // K_a, along the line
  double turn() const
  {
    const double bound = 1.0 / d_, k = lengths_ > 0.0 ? turn_ / lengths_ : 0.0;
    // particles lie d/2 inside the surface; the pole at -2/d is out of reach
    return std::max(k, -bound) / (1.0 + 0.5 * d_ * std::max(k, -bound));
  }

 private:
  static constexpr double TOUCHING = 1.9, FADE = 0.5;    // heights in spacings

  const ContactWall wall_;
  const Vector3d N_;
  const double d_;
  Vector3d along_;    // the line
  double ascent_ = 0.0, heights_ = 0.0, turn_ = 0.0, lengths_ = 0.0, touching_ = 0.0;
};

// N_c: the part of N along all walls, turned so that N_c.n = cos(theta) on each of them. Walls to
// which the rest of it is parallel are left out.
class ContactNormal {
 public:
  explicit ContactNormal(const Vector3d &N) : along_(N) {}

  void add(const ContactWall &wall)
  {
    // n = across_.n + a q with a unit vector q at right angles to the walls before
    Vector3d q = wall.n;
    for (const Vector3d &p : basis_) q -= q.dot(p) * p;
    const double a = q.norm();
    if (!(a > PARALLEL)) return;
    q /= a;
    const Vector3d along = along_ - along_.dot(q) * q;
    if (!(along.norm() > PARALLEL)) return;
    along_ = along;
    across_ += (wall.cosine - across_.dot(wall.n)) / a * q;
    basis_.push_back(q);
  }

  bool found() const { return !basis_.empty(); }

  // Where both angles together cannot be had, the fluid runs along the edge without end (Concus &
  // Finn, Proc. Natl Acad. Sci. 63 (1969) 292), and N_c lies across it.
  Vector3d value() const
  {
    const double rest = 1.0 - across_.squaredNorm();
    if (!(rest > 0.0)) return across_.normalized();
    return std::sqrt(rest) / along_.norm() * along_ + across_;
  }

 private:
  Vector3d along_, across_ = Vector3d::Zero();
  std::vector<Vector3d> basis_;
};

/* ----------------------------------------------------------------------
   K_c from the two walls that have the largest shares s and s',
     (1 - s)(1 - s') K + s (1 - s')(k + K_a) + s' (1 - s)(k' + K_a') + s s'(k + k').
   Where both count in full, N.n and N.n' each change with the height over
   their own wall; these are coordinates across the edge, and div N is the sum.
------------------------------------------------------------------------- */
class EdgeCurvature {
 public:
  void add(const ContactCurvature &sums, double share)
  {
    Part part = {share, sums.ascent(), sums.turn()};
    if (part.share > first_.share) std::swap(part, first_);
    if (part.share > second_.share) std::swap(part, second_);
  }

  double share() const { return first_.share + second_.share - first_.share * second_.share; }

  // within 1/d; limited: whether it was beyond
  double value(double d, bool &limited) const
  {
    const double s = first_.share, t = second_.share;
    const double sum = s * (1.0 - t) * (first_.across + first_.along) +
        t * (1.0 - s) * (second_.across + second_.along) + s * t * (first_.across + second_.across);
    const double K = share() > 0.0 ? sum / share() : 0.0, bound = 1.0 / d;
    limited = std::abs(K) > bound;
    return std::clamp(K, -bound, bound);
  }

 private:
  struct Part {
    double share = 0.0, across = 0.0, along = 0.0;
  };
  Part first_, second_;
};

// at i, above one of the walls
ContactCurvature near_wall(const Stencil &wide, const Role *role, const double *N, double d, int i,
                           const ContactWall &wall)
{
  const Vector3d Ni = at(N, i);
  ContactCurvature sums(wall, Ni, d, wide.dim());
  sums.add(Vector3d::Zero(), Ni, REACH * d);
  for (int k = wide.begin(i); k < wide.end(i); k++) {
    const int j = wide.col()[k];
    if (!bound_surface(role[j]) || !(wide.r()[k] < REACH * d)) continue;
    const Vector3d Nj = at(N, j);
    if (Ni.dot(Nj) > SAME_SURFACE) sums.add(-separation(wide, k), Nj, REACH * d);
  }
  return sums;
}

/* ----------------------------------------------------------------------
   Sources below one wall particle: along n, and where several faces meet on
   the lattice that their normals span behind the edge. Its cells count by
   their volume; those of the lines below one face, half of which lie behind
   that face, by a mean.
------------------------------------------------------------------------- */
struct Sources {
  Vector3d n[3] = {Vector3d::Zero(), Vector3d::Zero(), Vector3d::Zero()};
  double slope[3] = {0.0, 0.0, 0.0};    // of the plane along each n
  int directions = 0;
  double cell = 1.0;

  void add(const Vector3d &normal, double slope_along)
  {
    n[directions] = normal;
    slope[directions++] = slope_along;
  }

  double volume(int a, int b, int c) const
  {
    return 1.0 - (1.0 - cell) * ((a > 0) + (b > 0) + (c > 0)) / directions;
  }
};

Sources sources_below(const Stencil &wide, const ContactWalls &walls, const double *normal,
                      const double *plane, int i, int k)
{
  Sources below;
  const auto faces = walls.faces(i, k);
  if (faces.size() < 2 || faces.size() > 3) {
    const int j = wide.col()[k];
    below.add(at(normal, j), plane[2 * j + 1]);
    return below;
  }
  for (const auto &face : faces) below.add(face.n, plane[2 * wide.col()[face.pair] + 1]);
  const Vector3d across = below.n[0].cross(below.n[1]);
  below.cell = faces.size() == 2 ? across.norm() : std::abs(across.dot(below.n[2]));
  return below;
}

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
                    const double *cosine, double d, const ContactParams &params, double *contact,
                    const double *shape)
{
  const ContactWalls walls(s, role, normal, cosine, shape, d);
  int count = 0;
  for (const int i : surface) {
    std::fill(contact + 4 * i, contact + 4 * i + 4, 0.0);
    ContactNormal sum(at(normal, i));
    for (const ContactWall &wall : walls.nearest(i))
      if (wall.height < params.reach * d) sum.add(wall);
    if (!sum.found()) continue;
    const Vector3d Nc = sum.value();
    for (int a = 0; a < 3; a++) contact[4 * i + a] = Nc[a];
    contact[4 * i + 3] = 1.0;
    count++;
  }
  return count;
}

void contact_planes(const Stencil &wide, const Rows &walls, const Role *role, const double *normal,
                    const double *contact, double d, double *plane, const ContactParams &params)
{
  for (const int j : walls) {
    plane[2 * j] = (role[j] & DRY) ? COVERED : -COVERED;
    plane[2 * j + 1] = 0.0;
    const Vector3d n = at(normal, j);
    double nearest2 = 0.0;
    int pair = -1;
    for (int k = wide.begin(j); k < wide.end(j); k++) {
      if (contact[4 * wide.col()[k] + 3] == 0.0) continue;
      const Vector3d r = separation(wide, k);
      if (-r.dot(n) >= params.reach * d) continue;    // a particle on another wall
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
                      double d, const ContactParams &params, double *N, const double *shape)
{
  const ContactWalls walls(wide, role, normal, nullptr, shape, d);
  for (const int i : surface) {
    Vector3d sum = Vector3d::Zero();
    for (int k = wide.begin(i); k < wide.end(i); k++) {
      const int j = wide.col()[k];
      if (!(role[j] & WALL)) continue;
      const Sources below = sources_below(wide, walls, normal, plane, i, k);
      const int depth[3] = {params.depth, below.directions > 1 ? params.depth : 0,
                            below.directions > 2 ? params.depth : 0};
      for (int a = 0; a <= depth[0]; a++)
        for (int b = 0; b <= depth[1]; b++)
          for (int c = 0; c <= depth[2]; c++) {
            const double fall = a * below.slope[0] + b * below.slope[1] + c * below.slope[2];
            const double weight = std::clamp(0.5 - (plane[2 * j] - fall), 0.0, 1.0);
            const Vector3d r = separation(wide, k) +
                d * (a * below.n[0] + b * below.n[1] + c * below.n[2]);
            const double distance = r.norm();
            if (weight == 0.0 || distance == 0.0) continue;
            sum -= volume * below.volume(a, b, c) * weight * kernel.dw(distance) / distance * r;
          }
    }
    for (int a = 0; a < 3; a++) N[3 * i + a] += sum[a];
  }
}

int contact_curvature(const Stencil &wide, const Rows &surface, const Role *role,
                      const double *normal, const double *cosine, const double *N, double d,
                      const ContactParams &params, double *share, double *K, const double *shape)
{
  const ContactWalls walls(wide, role, normal, cosine, shape, d);
  int count = 0;
  for (const int i : surface) {
    EdgeCurvature edge;
    for (const ContactWall &wall : walls.mean(i)) {
      if (!(wall.height < params.far * d)) continue;
      const ContactCurvature sums = near_wall(wide, role, N, d, i, wall);
      const double fade = (params.far - wall.height / d) / (params.far - params.near);
      edge.add(sums, sums.share() * smooth_step(fade));
    }
    share[i] = edge.share();
    bool limited = false;
    K[i] += share[i] * (edge.value(d, limited) - K[i]);
    count += limited && share[i] > 0.0;
  }
  return count;
}

void contact_surface_normals(const Rows &surface, const double *share, const double *N,
                             double *normal)
{
  for (const int i : surface) {
    const Vector3d mean = (1.0 - share[i]) * at(normal, i) + share[i] * at(N, i);
    const double length = mean.norm();
    if (share[i] > 0.0 && length > 0.0)
      for (int a = 0; a < 3; a++) normal[3 * i + a] = mean[a] / length;
  }
}

}    // namespace aleisph
