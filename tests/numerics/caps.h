// SPDX-License-Identifier: GPL-2.0-only
/* ----------------------------------------------------------------------
   Drops at rest on the wall y = 0, without gravity: caps of a circle or sphere
   that meet the wall at an angle, made of particles, and the normals and curvature
   that the contact angle of the wall gives them, without LAMMPS. Spacing D.
------------------------------------------------------------------------- */

#ifndef ALEISPH_TEST_CAPS_H
#define ALEISPH_TEST_CAPS_H

#include "aleisph_tension_contact.h"
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

// Fluid on a wall with normal n, whose contact angle is theta. normal, N, share, K: per particle,
// those on the surface first, then the inner ones and the wall.
class Contact {
 public:
  Contact(int dim, const CapPoints &points, const Point &n, double theta);
  // walls: one per wall particle
  Contact(int dim, const CapPoints &points, const std::vector<WallSide> &walls, double theta);

  // contact particles, planes, N, K as in fix aleisph/tension
  void measure();
  // contact_curvature() alone, on what is in N and K
  int set_curvature();

  int surface() const { return nsurface_; }
  const Point &point(int i) const { return cloud_.point(i); }
  const aleisph::Stencil &near() const { return s_; }
  const aleisph::Stencil &wide() const { return wide_; }
  const aleisph::Rows &rows() const { return rows_; }
  const aleisph::Rows &walls() const { return walls_; }
  void set_normal(int i, const Point &n);

  aleisph::ContactParams params;
  std::vector<aleisph::Role> role;
  std::vector<double> normal, cosine, shape, contact, plane, N, K, share;

 private:
  void mark_dry();
  void outward();

  int dim_, nsurface_;
  PointSet cloud_;
  aleisph::Stencil s_, wide_;
  aleisph::Rows rows_, walls_;
  std::vector<Eigen::Vector3d> directions_;    // of the walls, each once
};

}    // namespace aleisph_test
#endif
