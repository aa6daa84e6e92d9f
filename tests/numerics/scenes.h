// SPDX-License-Identifier: GPL-2.0-only
/* ----------------------------------------------------------------------
   Particles with their roles and exact wall normals: fluid, and one layer
   of wall particles on the surface.
------------------------------------------------------------------------- */

#ifndef ALEISPH_TEST_SCENES_H
#define ALEISPH_TEST_SCENES_H

#include "cloud.h"

#include <memory>

namespace aleisph_test {

struct Scene {
  int dim = 2;
  double d = 1.0;
  Points points;
  std::vector<aleisph::Role> role;
  std::vector<double> normal;    // exact; zero on fluid particles
  std::vector<int> faces;        // number of flat walls that meet in a wall particle; else 0

  void add(const Point &x, aleisph::Role r, const Point &n = {0.0, 0.0, 0.0}, int nfaces = 0);
  // displaces the fluid by up to amplitude * d per direction
  void jitter_fluid(double amplitude, unsigned seed);
  aleisph::Rows rows(aleisph::Role r) const;    // the particles with one of these roles
};

// [0, 1]^dim, closed, n cells a side; wall normals on edges and corners are the normalised sum
// of the face normals
Scene closed_box(int dim, int n, double jitter = 0.0, unsigned seed = 1);

// [-1/2, 1/2]^dim is solid, n cells a side, in fluid that reaches three spacings beyond it
Scene box_obstacle(int dim, int n, double jitter = 0.0, unsigned seed = 1);

// Tank without lid, in 2d and 3d: the last axis is up, walls on [0, 1] x ... x [0, height d],
// fluid up to the layer `level`
Scene open_tank(int dim, int n, int height, int level, double jitter = 0.0, unsigned seed = 1);

// Circle (2d) or cylinder along z of radius R, of equal chords near d; fluid on a lattice inside
// or outside, half a spacing away at least. The cylinder ends at both ends with a free rim.
Scene cylinder(int dim, double R, double d, bool inside, double jitter = 0.0, unsigned seed = 1);

// Sphere of radius R in fluid, or filled with it, of quasi-uniform (Fibonacci) points
Scene sphere(double R, double d, bool inside, double jitter = 0.0, unsigned seed = 1);

// the operators on all particles of a scene, cubic spline, h = 1.2 d
class Discretized {
 public:
  explicit Discretized(const Scene &scene,
                       const aleisph::LaplacianLimits &limits = aleisph::LaplacianLimits(),
                       bool laplacian = true);
  const aleisph::Cloud &cloud() const { return cloud_; }
  aleisph::Cloud &cloud() { return cloud_; }
  const aleisph::Kernel &kernel() const { return cloud_.kernel(); }
  const aleisph::Stencil &s() const { return cloud_.stencil(); }
  const aleisph::GradientWeights &g() const { return cloud_.gradient(); }
  const aleisph::LaplacianWeights &l() const { return cloud_.laplacian_rows(); }
  const aleisph::Rows &all() const { return cloud_.all(); }

 private:
  aleisph::Cloud cloud_;
};

}    // namespace aleisph_test
#endif
