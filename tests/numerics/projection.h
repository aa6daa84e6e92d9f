// SPDX-License-Identifier: GPL-2.0-only
/* ----------------------------------------------------------------------
   One pressure correction on particles that do not move, as a matrix: the
   velocity of the fluid becomes P v, P = I - G A^-1 D, with the divergence D,
   the pressure matrix A and the gradient G, here with the guards that change
   G. An eigenvalue of P beyond 1 grows in every step, however small it is.
------------------------------------------------------------------------- */

#ifndef ALEISPH_TEST_PROJECTION_H
#define ALEISPH_TEST_PROJECTION_H

#include "aleisph_guards.h"
#include "aleisph_solve_ppe.h"
#include "scenes.h"
#include "solver.h"

#include <Eigen/Dense>

namespace aleisph_test {

// Fluid in the corner of two (2d) or three (3d) slip walls, or without them in the air: a ragged
// surface, holes, spray, jitter, no two particles closer than 0.7 d.
struct SplashParams {
  int width = 12, height = 12;    // of the box that it fills in part, in spacings
  double jitter = 0.25;           // in spacings
  double holes = 0.05;            // part of the particles that is missing
  bool walls = true;
};
Scene splash(int dim, const SplashParams &params, unsigned seed);

enum class SelfTerm {
  PUBLISHED,    // as in the corrected gradient
  UNBOUNDED,    // corrected, whatever the row of the pressure equation
  BOUNDED
};

// A scene without its dry walls, with its free surface and the operators on it
class FreeSurfaceFlow {
 public:
  explicit FreeSurfaceFlow(const Scene &scene);
  FreeSurfaceFlow(const FreeSurfaceFlow &) = delete;
  FreeSurfaceFlow &operator=(const FreeSurfaceFlow &) = delete;

  const Scene &scene() const { return scene_; }
  const aleisph::Cloud &cloud() const { return cloud_; }
  const aleisph::Role *role() const { return cloud_.role(); }
  const double *normal() const { return cloud_.normal(); }
  const aleisph::Stencil &s() const { return cloud_.stencil(); }
  const aleisph::GradientWeights &g() const { return cloud_.gradient(); }
  const aleisph::LaplacianWeights &l() const { return cloud_.laplacian(); }
  const aleisph::Rows &fluid() const { return cloud_.fluid(); }
  const double *inverse() const { return g().inverse(); }
  double volume() const { return cloud_.volume(); }
  int size() const { return cloud_.size(); }

  std::vector<double> gradient(const double *p) const;    // without guards
  // adds the correction; returns the rows changed
  int correct_self_term(SelfTerm kind, const double *p, std::vector<double> &grad) const;

  static constexpr double FLOOR = 0.2;         // of the moments
  static constexpr double SYMMETRIC = 0.35;    // lambda below which the gradient is symmetric

 private:
  Scene scene_;
  aleisph::Cloud cloud_;
};

// surface_offset: of the free surface from its particles, in spacings
Eigen::MatrixXd projection(const FreeSurfaceFlow &flow, SelfTerm kind, double surface_offset);

double spectral_radius(const Eigen::MatrixXd &P);

}    // namespace aleisph_test
#endif
