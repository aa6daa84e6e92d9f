// SPDX-License-Identifier: GPL-2.0-only
/* ----------------------------------------------------------------------
   Drops for the tests of surface tension: points filling a disc or ball up
   to its true surface, the outermost layer half a spacing inside; and all
   that is measured on them, without LAMMPS.
------------------------------------------------------------------------- */

#ifndef ALEISPH_TEST_DROPS_H
#define ALEISPH_TEST_DROPS_H

#include "aleisph_surface.h"
#include "aleisph_tension.h"
#include "cloud.h"

namespace aleisph_test {

// As Cloud, but with cells: for the ten thousand particles of a ball. All are rows.
class Neighbours {
 public:
  Neighbours(const Points &points, int owned, double reach);
  const double *const *x() const { return x_.data(); }
  int owned() const { return owned_; }
  int total() const { return static_cast<int>(x_.size()); }
  const std::vector<int> &of(int i) const { return lists_[i]; }
  aleisph::CandidateList list() const { return {count_.data(), first_.data(), ~0}; }

 private:
  int owned_;
  std::vector<const double *> x_;
  std::vector<std::vector<int>> lists_;
  std::vector<int> count_;
  std::vector<const int *> first_;
};

// Disc or ball of radius R = n d (n whole): shells of thickness d, each with as many particles as
// its volume holds, quasi-uniform on the shell; then the inner ones repel each other to rest
Points relaxed_ball(int dim, int n, double d);
// the points of a lattice of spacing d (with one cell centred on the origin) within R
Points lattice_ball(int dim, double R, double d);

// Surface, normals and curvature of points of spacing d, all fluid
struct Drop {
  Drop(int dim, double d, const Points &points, int owned = -1);

  int dim, owned;
  double d, volume;
  Points points;
  std::vector<aleisph::Role> role;
  aleisph::Stencil s, wide;
  aleisph::GradientWeights g;
  aleisph::Rows surface;
  std::vector<double> N, K, known, mean;    // K: of the layer; mean: what the model gives
  aleisph::CurvatureCount count;

  void tangent();
  void published(double factor);
  std::vector<double> values() const;    // mean on the surface
};

struct Statistics {
  double mean = 0.0, deviation = 0.0, least = 0.0, most = 0.0;
};
Statistics statistics(const std::vector<double> &values);

}    // namespace aleisph_test
#endif
