// SPDX-License-Identifier: GPL-2.0-only

#include "aleisph_tension_contact_curvature.h"

#include "aleisph_tension_contact_walls.h"
#include "aleisph_tension_parts.h"
#include "aleisph_vectors.h"

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>

namespace aleisph {
namespace {

using Eigen::Vector3d;

constexpr double REACH = 4.8;    // of the fit of K_c, in spacings: all of the wide stencil

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
ContactCurvature near_wall(const ContactWalls &walls, const double *N, int i,
                           const ContactWall &wall)
{
  const Cloud &cloud = walls.cloud();
  const Stencil &wide = walls.stencil();
  const double d = cloud.spacing();
  const Vector3d Ni = at(N, i);
  ContactCurvature sums(wall, Ni, d, wide.dim());
  sums.add(Vector3d::Zero(), Ni, REACH * d);
  for (int k = wide.begin(i); k < wide.end(i); k++) {
    const int j = wide.col()[k];
    if (!bound_surface(cloud.role()[j]) || !(wide.r()[k] < REACH * d)) continue;
    const Vector3d Nj = at(N, j);
    if (Ni.dot(Nj) > SAME_SURFACE) sums.add(-separation(wide, k), Nj, REACH * d);
  }
  return sums;
}

}    // namespace

int contact_curvature(const ContactWalls &walls, const Rows &surface, const ContactParams &params,
                      const double *N, double *share, double *K)
{
  const double d = walls.cloud().spacing();
  return count_rows(surface, [&](int i) {
    EdgeCurvature edge;
    for (const ContactWall &wall : walls.mean(i)) {
      if (!(wall.height < params.far * d)) continue;
      const ContactCurvature sums = near_wall(walls, N, i, wall);
      const double fade = (params.far - wall.height / d) / (params.far - params.near);
      edge.add(sums, sums.share() * smooth_step(fade));
    }
    share[i] = edge.share();
    bool limited = false;
    K[i] += share[i] * (edge.value(d, limited) - K[i]);
    return limited && share[i] > 0.0;
  });
}

}    // namespace aleisph
