// SPDX-License-Identifier: GPL-2.0-only
/* ----------------------------------------------------------------------
   Area of the free surface (2d: its length), from the particles on it.

   A particle i on the surface stands for a cell: what is nearer to i than to
   any other particle on the surface, seen along N_i, that is the Voronoi cell
   in the tangent plane of i. The cells tile the surface, so that their sum
   depends neither on how dense the particles lie, nor on their roughness
   along N, nor on single ones that are missing or too many. To the true
   surface, with a the area of a cell (2d: length) and k the mean of its
   principal curvatures:
   1. Seen along N_i, a neighbour at the arc s on a sphere is at
      sin(k s)/k = s (1 - (k s)^2/6). Neighbours are a apart in 2d, and
      sqrt(2 a/sqrt 3) in 3d, where cells are hexagons. So a is too small by
      (k a)^2/6 in 2d and, twice, by 2 k^2 a/(6 sqrt 3) in 3d.
   2. The true surface is delta = d/2 outside of the particles, and wider by
      (1 - K delta/(D - 1))^-(D - 1), K = div_s N its curvature: exact on spheres and,
      in 2d, circles; on a cylinder in 3d too small by (K delta)^2/4.
   3. On a wall it ends: cells of particles near it are cut where the plane at
      delta outside of the particle meets the wall.
   Spray is no surface.
------------------------------------------------------------------------- */

#ifndef LMP_ALEISPH_SURFACE_AREA_H
#define LMP_ALEISPH_SURFACE_AREA_H

#include "aleisph_cloud.h"

#include <Eigen/Core>

namespace aleisph {

struct SurfaceArea {
  double area = 0.0;
  // sum of N area. With walls of one plane of normal n (into the fluid) n.vector is the area that
  // the fluid covers on them: over a closed surface the integral of the normal is zero.
  Eigen::Vector3d vector = Eigen::Vector3d::Zero();

  SurfaceArea &operator+=(const SurfaceArea &other)
  {
    area += other.area;
    vector += other.vector;
    return *this;
  }
};

// What fix aleisph/tension knows of the surface: N on owned and ghost, K on owned particles,
// contact 4 per owned particle as contact_normals() has it, null without walls
struct SurfaceFields {
  const double *N, *K, *contact;
};

// of the owned particles
SurfaceArea surface_area(const Cloud &cloud, const SurfaceFields &fields);

}    // namespace aleisph
#endif
