// SPDX-License-Identifier: GPL-2.0-only
/* ----------------------------------------------------------------------
   Drops for the tests of surface tension: points filling a disc or ball up
   to its true surface, the outermost layer half a spacing inside; and all
   that is measured on them, without LAMMPS.
------------------------------------------------------------------------- */

#ifndef ALEISPH_TEST_DROPS_H
#define ALEISPH_TEST_DROPS_H

#include "aleisph_surface.h"
#include "aleisph_surface_area.h"
#include "aleisph_tension.h"
#include "cloud.h"

#include <memory>

namespace aleisph_test {

// As PointSet, but with cells: for the ten thousand particles of a ball
class Neighbours {
 public:
  Neighbours(const Points &points, int owned, double reach);
  const double *const *x() const { return x_.data(); }
  const std::vector<int> &of(int i) const { return lists_[i]; }
  aleisph::CandidateList list() const { return {count_.data(), first_.data(), ~0}; }

 private:
  std::vector<const double *> x_;
  std::vector<std::vector<int>> lists_;
  std::vector<int> count_;
  std::vector<const int *> first_;
};

// Circles or spheres around the origin of radius (k - 1/2) d, k = first ... last, each with as many
// particles as its shell of thickness d holds, quasi-uniform; the outermost first
Points shells(int dim, int first, int last, double d);
// Disc or ball of radius R = n d: shells, whose inner particles then repel each other to rest
Points relaxed_ball(int dim, int n, double d);
// the points of a lattice of spacing d within R
Points lattice_ball(int dim, double R, double d);

// Surface, normals and curvature of fluid of spacing d, without LAMMPS. Along axes with a period
// > 0 there are ghosts, which get their values from their owners.
class Drop {
 public:
  Drop(int dim, double d, const Points &points, const Point &period = {0.0, 0.0, 0.0});

  void tangent();
  void published(double factor);
  void measure(aleisph::TensionModel &model);

  // of the surface, from what the model gave
  aleisph::SurfaceArea area() const;

  int owned() const { return owned_; }
  const Point &point(int i) const { return points_[i]; }
  const aleisph::Rows &surface() const { return result_.rows; }
  const aleisph::CurvatureCount &count() const { return result_.count; }
  double N(int i, int a) const { return result_.N[3 * i + a]; }
  double K(int i) const { return result_.K[i]; }    // as the model gives it
  // K of the particles on the surface for which the predicate holds
  std::vector<double> values(const std::function<bool(const Point &)> &predicate) const;
  std::vector<double> values() const;

 private:
  void add_ghosts(const Point &period);
  void detect();
  // components doubles per particle
  template <class T> void exchange(T *field, int components) const
  {
    for (size_t j = owned_; j < owner_.size(); j++)
      for (int c = 0; c < components; c++)
        field[components * j + c] = field[components * owner_[j] + c];
  }

  int dim_, owned_;
  double d_;
  Points points_;
  std::vector<int> owner_;    // of each particle: itself, or that of a ghost
  std::unique_ptr<Neighbours> near_;
  aleisph::Cloud cloud_;
  aleisph::TensionResult result_;
};

struct Statistics {
  double mean = 0.0, deviation = 0.0;
};
Statistics statistics(const std::vector<double> &values);

}    // namespace aleisph_test
#endif
