// SPDX-License-Identifier: GPL-2.0-only
/* ----------------------------------------------------------------------
   Each model is a class with one member: the displacement of particle i
   before the limit. w = V W_ij; sums are over all neighbours of the row,
   fluid and wall.
------------------------------------------------------------------------- */

#include "aleisph_shift.h"

#include "aleisph_cloud.h"
#include "aleisph_shift_images.h"
#include "aleisph_surface_shape.h"
#include "aleisph_vectors.h"

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>

namespace aleisph {
namespace {

using Vec = Eigen::Vector3d;
constexpr double ALIGNED = 0.9;    // cosine between normals of neighbours on one smooth surface

// a particle lies above a wall particle if it is off its normal by fewer spacings than this
constexpr double ABOVE = 0.8;

inline void put(const Vec &v, double *field, int i)
{
  for (int a = 0; a < 3; a++) field[3 * i + a] = v[a];
}

inline Vec tangential(const Vec &v, const Vec &n)
{
  return v - v.dot(n) * n;
}

struct Scene {
  Scene(const Cloud &of, const ShiftParams &with) :
      cloud(of), s(of.stencil()), kernel(of.kernel()), role(of.role()), normal(of.normal()),
      volume(of.volume()), d(of.spacing()), params(with), neighbours(of.neighbours())
  {
  }
  bool on_surface(int i) const { return role[i] & SURFACE; }

  const Cloud &cloud;
  const Stencil &s;
  const Kernel &kernel;
  const Role *role;
  const double *normal;
  double volume, d;
  const ShiftParams &params;
  SeenRoles neighbours;
};

/* ---------------------------------------------------------------------- */

class DensityShift {
 public:
  DensityShift(const Scene &scene, const double *eps, const double *normal) :
      c_(scene), eps_(eps), normal_(normal ? normal : scene.normal),
      reach_(nearest_reach(scene.s.dim(), scene.d)), shape_(scene.kernel, scene.d)
  {
  }

  Vec operator()(int i) const
  {
    Vec dr = c_.params.coefficient * c_.kernel.h() * spread(i);
    if (c_.params.published || !c_.on_surface(i)) return dr;
    const bool wall = c_.neighbours.any(i, WALL);
    const double corner = wall ? 0.0 : shape_.corner(shape_.asymmetry(c_.s, i));
    return (1.0 - corner) * (dr + smooth(i));
  }

 private:
  // eps_i + eps_j, or 2 eps_j; the deviation of a particle that is not in the fluid is not known (a
  // raw wall density would draw the fluid into the wall), it is that of i
  double pair(int i, int j) const
  {
    const bool known = (c_.role[j] & FLUID) && !(c_.role[j] & (WALL | BUFFER));
    const double eps_j = known ? eps_[j] : eps_[i];
    const double q = (c_.params.printed_pair ? eps_j : eps_[i]) + eps_j;
    const bool surface = c_.on_surface(i) || c_.on_surface(j);
    return surface && c_.params.positive_surface ? std::max(q, 0.0) : q;
  }

  // dr_w + dr_dens over S*
  Vec spread(int i) const
  {
    const Stencil &s = c_.s;
    Vec even = Vec::Zero(), density = Vec::Zero();
    for (int k = s.begin(i); k < s.end(i); k++) {
      if (!(s.r()[k] < reach_)) continue;
      const Vec e = direction(s, k);
      even += c_.volume * c_.kernel.w(s.r()[k]) * e;
      density += pair(i, s.col()[k]) * e;
    }
    if (c_.on_surface(i)) even = tangential(even, at(normal_, i));
    return even + density;
  }

  // b_i N_i: towards the mean height of the surface neighbours
  Vec smooth(int i) const
  {
    const Stencil &s = c_.s;
    const Vec N = at(c_.normal, i);
    double sum = 0.0, weights = 0.0;
    for (int k = s.begin(i); k < s.end(i); k++) {
      const int j = s.col()[k];
      if (!c_.on_surface(j) || !bound_fluid(c_.role[j])) continue;
      const Vec Nj = at(c_.normal, j);
      if (!(N.dot(Nj) > ALIGNED)) continue;
      const double w = c_.kernel.w(s.r()[k]);
      sum -= 0.5 * w * s.r()[k] * direction(s, k).dot(N + Nj);
      weights += w;
    }
    return weights > 0.0 ? Vec(c_.params.smoothing * sum / weights * N) : Vec(Vec::Zero());
  }

  const Scene &c_;
  const double *eps_, *normal_;
  double reach_;
  SurfaceShape shape_;
};

/* ---------------------------------------------------------------------- */

class ConcentrationShift {
 public:
  ConcentrationShift(const Scene &scene, const double *v) :
      c_(scene), v_(v), images_(scene.cloud, false),
      diffusion_(scene.params.coefficient * scene.kernel.h() * scene.kernel.h()),
      w_d_(scene.kernel.w(scene.d)), reach_(nearest_reach(scene.s.dim(), scene.d))
  {
  }

  Vec operator()(int i)
  {
    Vec dr = -diffusion_ * gradient(i);
    if (c_.on_surface(i))
      dr = tangential(dr, at(c_.normal, i));
    else if (c_.params.model == ShiftModel::OPS)
      dr = tangential(dr, normal_above(i));
    return c_.params.model == ShiftModel::TVF ? bounded(dr, i) : dr;
  }

 private:
  // dW/dr of the concentration, with the term against pairing
  double weight(double r, double dw) const
  {
    const double ratio = c_.kernel.w(r) / w_d_, square = ratio * ratio;
    return (1.0 + 0.2 * square * square) * dw;
  }

  Vec gradient(int i)
  {
    const Stencil &s = c_.s;
    Vec sum = Vec::Zero();
    for (int k = s.begin(i); k < s.end(i); k++)
      sum += weight(s.r()[k], s.dw()[k]) * direction(s, k);
    if (!c_.neighbours.any(i, WALL)) return c_.volume * sum;
    for (const Vec &r : images_.of(i)) {
      const double length = r.norm();
      sum += weight(length, c_.kernel.dw(length)) / length * r;
    }
    return c_.volume * sum;
  }

  // the mean normal of the surface next to i, zero if there is none or they oppose each other
  Vec normal_above(int i) const
  {
    const Stencil &s = c_.s;
    Vec sum = Vec::Zero();
    int count = 0;
    for (int k = s.begin(i); k < s.end(i); k++) {
      const int j = s.col()[k];
      if (!(s.r()[k] < reach_) || !c_.on_surface(j) || !bound_fluid(c_.role[j])) continue;
      sum += at(c_.normal, j);
      count++;
    }
    return sum.norm() > 0.3 * count ? Vec(sum.normalized()) : Vec(Vec::Zero());
  }

  Vec bounded(const Vec &dr, int i) const
  {
    const double most = 0.25 * at(v_, i).norm() * c_.params.dt, length = dr.norm();
    return length > most ? Vec(most / length * dr) : dr;
  }

  const Scene &c_;
  const double *v_;
  Images images_;
  double diffusion_, w_d_, reach_;
};

/* ---------------------------------------------------------------------- */

// Off the wall that fluid particle i is closest to, if it is too close. The distance is measured
// along the normals of wall particles that i lies above.
Vec away_from_wall(const Scene &c, int i)
{
  double closest = c.params.wall_distance * c.d;
  Vec n = Vec::Zero();
  for (int k = c.s.begin(i); k < c.s.end(i); k++) {
    const int j = c.s.col()[k];
    if (!(c.role[j] & WALL)) continue;
    const Vec n_j = at(c.normal, j), r = c.s.r()[k] * direction(c.s, k);
    const double height = n_j.dot(r);
    if (height < 0.0 || height >= closest || (r - height * n_j).norm() > ABOVE * c.d) continue;
    closest = height;
    n = n_j;
  }
  return std::min(c.params.wall_distance * c.d - closest, c.params.wall_step * c.d) * n;
}

template <class Model> ShiftCount shift_rows(const Scene &c, Model model, double *dr)
{
  const double most = c.params.limit * c.d;
  const int limited = count_rows(c.cloud.fluid(), [&](int i) {
    Vec step = Vec::Zero();
    if (!(c.role[i] & BALLISTIC)) step = model(i);
    if (c.params.wall_step > 0.0 && c.neighbours.any(i, WALL)) step += away_from_wall(c, i);
    const double length = step.norm();
    if (length > most) step *= most / length;
    put(step, dr, i);
    return length > most;
  });
  return {limited};
}

inline Vec apply(const double *gradient, const Vec &r)
{
  return Eigen::Map<const Eigen::Matrix<double, 3, 3, Eigen::RowMajor>>(gradient) * r;
}

}    // namespace

ShiftCount compute_shift(const Cloud &cloud, const ShiftParams &params, const double *eps,
                         const double *v, double *dr, const double *normal)
{
  const Scene scene(cloud, params);
  if (params.model == ShiftModel::DENSITY)
    return shift_rows(scene, DensityShift(scene, eps, normal), dr);
  return shift_rows(scene, ConcentrationShift(scene, v), dr);
}

void surface_velocity_filter(const Cloud &cloud, const Rows &rows, const double *v,
                             const double *grad_v, double *out)
{
  const Stencil &s = cloud.stencil();
  const Role *const role = cloud.role();
  for_rows(rows, [&](int i) {
    Vec sum = Vec::Zero();
    for (int k = s.begin(i); k < s.end(i); k++) {
      const int j = s.col()[k];
      if (!bound_fluid(role[i]) || !bound_fluid(role[j])) continue;
      if (!((role[i] | role[j]) & SURFACE)) continue;
      const Vec half = 0.5 * s.r()[k] * direction(s, k);
      const Vec linear = apply(grad_v + 9 * i, half) + apply(grad_v + 9 * j, half);
      sum += cloud.volume() * cloud.kernel().w(s.r()[k]) * (at(v, j) - at(v, i) + linear);
    }
    put(sum, out, i);
  });
}

}    // namespace aleisph
