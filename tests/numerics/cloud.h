// SPDX-License-Identifier: GPL-2.0-only
/* ----------------------------------------------------------------------
   Particle clouds for the tests: lattices, jitter, cuts by planes, and
   neighbour candidates by brute force in the form of a LAMMPS full list.
------------------------------------------------------------------------- */

#ifndef ALEISPH_TEST_CLOUD_H
#define ALEISPH_TEST_CLOUD_H

#include "aleisph_cloud.h"

#include <array>
#include <functional>
#include <vector>

namespace aleisph_test {

using Point = std::array<double, 3>;
using Points = std::vector<Point>;

constexpr aleisph::KernelType KERNELS[] = {
    aleisph::KernelType::CUBIC_SPLINE, aleisph::KernelType::QUINTIC_SPLINE,
    aleisph::KernelType::WENDLAND_C2, aleisph::KernelType::WENDLAND_C4};

// particle spacing and smoothing length of the tests: not 1, so that powers of d are tested
constexpr double D = 0.01;
constexpr double H = 1.2 * D;

// the limits switched off: every row is the corrected one, unless its moments are singular
aleisph::LaplacianLimits no_limits();

// the pair array of the Laplacian
inline std::vector<double> weights(const aleisph::LaplacianWeights &l, const aleisph::Stencil &s)
{
  return std::vector<double>(l.a(), l.a() + s.pairs());
}

// the (2n+1)^dim points of the lattice of spacing d around the origin, the origin first,
// the others by increasing distance; z = 0 in 2d
Points lattice(int dim, int n, double d);

// moves every point by a uniform deviate in [-amplitude, amplitude] per direction
void jitter(Points &points, int dim, double amplitude, unsigned seed);

// the points for which the predicate holds, in their order
Points keep(const Points &points, const std::function<bool(const Point &)> &predicate);

// Half spaces around the origin: the part x_a <= c for the first `planes` axes a.
// planes = 0: all space; 1: a plane; 2: an edge (in 2d: a corner); 3: a corner in 3d
Points cut(const Points &points, int planes, double c);

/* ----------------------------------------------------------------------
   The first `owned` points are the rows, the rest are ghosts. Candidates of
   a row are all other points within `reach`, as indices with garbage in the
   bits above the mask, in random order if seed > 0.
------------------------------------------------------------------------- */
class PointSet {
 public:
  PointSet(Points points, int owned, double reach, unsigned seed = 0);

  int owned() const { return owned_; }
  int total() const { return static_cast<int>(points_.size()); }
  const Point &point(int j) const { return points_[j]; }
  const Points &points() const { return points_; }
  const double *const *x() const { return x_.data(); }
  const std::vector<int> &candidates(int i) const { return lists_[i]; }    // without the garbage
  aleisph::CandidateList list() const { return {count_.data(), first_.data(), MASK}; }
  aleisph::Rows rows() const;    // 0 ... owned-1

  static constexpr int MASK = 0x1FFFFFFF;

 private:
  int owned_;
  Points points_;
  std::vector<const double *> x_;
  std::vector<std::vector<int>> lists_, masked_;
  std::vector<int> count_;
  std::vector<const int *> first_;
};

// One row: the particle near the origin, on the rim of what `planes` planes leave of a lattice
// of spacing D with jitter; SUPPORT[planes] names the support.
constexpr const char *SUPPORT[] = {"full", "plane", "edge", "corner"};
PointSet one_row(const aleisph::Kernel &kernel, int planes, double amplitude, unsigned seed);

// A block of (2n+1)^dim particles with jitter 0.2 D and free surfaces on all sides, all of
// them rows; candidates in random order.
PointSet block(int dim, int n, unsigned seed);

// roles and normals of all particles; without roles all are fluid, without normals these are zero
void set_particles(aleisph::Cloud &cloud, const std::vector<aleisph::Role> &role,
                   const std::vector<double> &normal = {});

// What a cloud of these points is made with, besides kernel and spacing
struct CloudOptions {
  std::vector<aleisph::Role> role = {};
  std::vector<double> normal = {};
  bool dry = false;    // particles with role DRY are in no pair
};
aleisph::Cloud empty_cloud(const aleisph::Kernel &kernel, double d);
aleisph::Cloud make_cloud(const aleisph::Kernel &kernel, double d, const PointSet &points,
                          const CloudOptions &options = CloudOptions());

// Stencil, gradient and Laplacian weights of all owned rows, which are fluid; volume = d^dim
class Discrete {
 public:
  Discrete(const aleisph::Kernel &kernel, double d, const PointSet &cloud,
           const aleisph::LaplacianLimits &limits = no_limits());

  const aleisph::Cloud &cloud() const { return cloud_; }
  aleisph::Cloud &cloud() { return cloud_; }
  const aleisph::Stencil &s() const { return cloud_.stencil(); }
  const aleisph::GradientWeights &g() const { return cloud_.gradient(); }
  const aleisph::LaplacianWeights &l() const { return cloud_.laplacian(); }
  double volume() const { return cloud_.volume(); }

 private:
  aleisph::Cloud cloud_;
};

// n values between -1 and 1
std::vector<double> random_field(int n, unsigned seed);
// f at every point of the cloud
std::vector<double> sample(const PointSet &cloud, const std::function<double(const Point &)> &f);
// three components per point
std::vector<double> sample_vector(const PointSet &cloud,
                                  const std::function<Point(const Point &)> &f);

}    // namespace aleisph_test
#endif
