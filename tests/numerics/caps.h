// SPDX-License-Identifier: GPL-2.0-only
/* ----------------------------------------------------------------------
   Drops at rest on the wall y = 0, without gravity: caps of a circle or sphere
   that meet the wall at an angle, made of particles, and the normals and curvature
   that the contact angle of the wall gives them, without LAMMPS. Spacing D.
------------------------------------------------------------------------- */

#ifndef ALEISPH_TEST_CAPS_H
#define ALEISPH_TEST_CAPS_H

#include "aleisph_tension.h"
#include "aleisph_tension_wide.h"
#include "cloud.h"

#include <Eigen/Core>
#include <cmath>
#include <vector>

namespace aleisph_test {

struct CapShape {
  int dim;
  double radius;          // of the true surface
  double angle;           // through the fluid [radians]
  double row = 1.0;       // height of the first row of fluid [D]
  double offset = 0.0;    // of the wall particles along the wall [D]

  // of the volume of half a disc or ball of n spacings
  static CapShape of_volume(int dim, double n, double angle);
  double height() const { return -radius * std::cos(angle); }    // of the centre
  double width() const { return radius * std::sin(angle); }      // where it meets the wall
};

struct CapPoints {
  Points surface, inner, wall;
};

// The outermost layer D/2 inside the surface, down to the first row, nothing else
CapPoints cap_shell(const CapShape &shape);
// All of it: the inside is at rest under mutual repulsion
CapPoints full_cap(const CapShape &shape, unsigned seed);
void rotate(CapPoints &points, double angle);    // about the z axis

// Of wall particles; shape: sqrt 2 in a concave edge, sqrt 3 in a corner
struct WallSide {
  Point n;
  double shape = 1.0;
};

// Fluid on a wall with normal n, whose contact angle is theta. Particles: those on the surface first,
// then the inner ones and the wall. N, share, K, contact, plane: per particle.
class Contact {
 public:
  Contact(int dim, const CapPoints &points, const Point &n, double theta);
  // walls: one per wall particle
  Contact(int dim, const CapPoints &points, const std::vector<WallSide> &walls, double theta);

  // contact particles, N, share, K as model tangent finds them
  void measure();
  void measure(aleisph::TensionModel &model);
  // contact_normals(), contact_planes(), contact_curvature() alone, on what is there
  int set_contact_normals();
  void set_planes();
  int set_curvature();

  int surface() const { return nsurface_; }
  const Point &point(int i) const { return points_.point(i); }
  const aleisph::Rows &rows() const { return rows_; }
  const aleisph::Rows &walls() const { return walls_; }
  void set_normal(int i, const Point &n);    // N

  aleisph::Cloud cloud;
  std::vector<double> contact, plane, N, K, share;

 private:
  void mark_dry();
  void outward();

  int nsurface_;
  PointSet points_;
  aleisph::WideStencil wide_;
  aleisph::Rows rows_, walls_;
  std::vector<double> cosine_;
  std::vector<Eigen::Vector3d> directions_;    // of the walls, each once
};

}    // namespace aleisph_test
#endif
