// SPDX-License-Identifier: GPL-2.0-only
/* ----------------------------------------------------------------------
   A scene with its surface and dry walls marked, its stencil, and the
   shifting on it.
------------------------------------------------------------------------- */

#ifndef ALEISPH_TEST_SHIFTING_H
#define ALEISPH_TEST_SHIFTING_H

#include "aleisph_shift.h"
#include "scenes.h"

namespace aleisph_test {

// Fluid up to the height 0 of the last axis, 6 spacings D to all sides and below; the top row is
// the surface
Scene half_lattice(int dim);

// open_tank() with its top row as the surface, normals up; wall particles farther than
// 1.2 d sqrt(faces) from all fluid are dry
Scene filled_tank(int dim, int n, int level);

class Shifting {
 public:
  explicit Shifting(Scene scene, aleisph::KernelType type = aleisph::KernelType::CUBIC_SPLINE,
                    double h_over_d = 1.2);

  const Scene &scene() const { return scene_; }
  const aleisph::Cloud &cloud() const { return cloud_; }
  const aleisph::Kernel &kernel() const { return cloud_.kernel(); }
  const aleisph::Stencil &s() const { return cloud_.stencil(); }
  const aleisph::Rows &fluid() const { return cloud_.fluid(); }
  int size() const { return static_cast<int>(scene_.points.size()); }
  double volume() const { return cloud_.volume(); }
  int nearest(const Point &x) const;    // the particle closest to x

  std::vector<double> deviation(bool published) const;
  // displacements, 3 per particle; v may be empty if it is not read
  std::vector<double> shift(const aleisph::ShiftParams &params, const std::vector<double> &eps,
                            const std::vector<double> &v = {},
                            aleisph::ShiftCount *count = nullptr) const;
  std::vector<double> filter(const std::vector<double> &v, const std::vector<double> &grad_v) const;

 private:
  Scene scene_;
  aleisph::Cloud cloud_;
};

constexpr aleisph::ShiftModel MODELS[] = {aleisph::ShiftModel::DENSITY, aleisph::ShiftModel::OPS,
                                          aleisph::ShiftModel::FICKIAN, aleisph::ShiftModel::TVF};

// parameters of a model with coefficient 1 and no limit; unbounded: nor that of tvf
aleisph::ShiftParams unlimited(aleisph::ShiftModel model);
aleisph::ShiftParams unbounded(aleisph::ShiftModel model);

// the half lattice with jitter 0.2 d; the surface keeps its roles and normals
Scene rough(int dim, unsigned seed);
// velocities (V, 0, 0) of all particles
std::vector<double> streaming(const Shifting &shifting, double V);
// the shift with the deviations that belong to it and velocity (1, 0, 0)
std::vector<double> full_shift(const Shifting &shifting, const aleisph::ShiftParams &params,
                               aleisph::ShiftCount *count = nullptr);
// V W at distance r
double weight(const Shifting &shifting, double r);

Point at(const std::vector<double> &field, int i);
double length(const Point &p);
double dot(const Point &p, const Point &q);

}    // namespace aleisph_test
#endif
