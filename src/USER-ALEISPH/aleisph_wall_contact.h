// SPDX-License-Identifier: GPL-2.0-only
/* ----------------------------------------------------------------------
   What the fluid is beside a wall: fields of the fluid carried to wall particles,
   from their fluid neighbours alone. Weights omega = V |W'|/r. Fields have their
   ghosts valid; `walls` lists owned wall particles; one without fluid neighbours
   keeps what it has.
------------------------------------------------------------------------- */

#ifndef LMP_ALEISPH_WALL_CONTACT_H
#define LMP_ALEISPH_WALL_CONTACT_H

#include "aleisph_rows.h"

#include <cstddef>
#include <vector>

namespace aleisph {

class Cloud;

Rows slip_walls(const Cloud &cloud);

// Gives slip walls the tangential velocity of the fluid beside them, the mean over the neighbours,
// which the fluid would have there. Their normal velocity stays. v: 3 per particle.
void slide_with_fluid(const Cloud &cloud, const Rows &walls, double *v);

// Weights of the linear fit to the fluid neighbours of walls, which is exact for linear fields; those of
// the mean where the neighbours determine no fit. Of the present positions.
struct FluidFit {
  Rows walls;
  std::vector<std::size_t> offset;    // of the weights of the pairs of the n-th wall
  std::vector<double> weight;         // zero for pairs with other particles
};

FluidFit fit_to_walls(const Cloud &cloud, const Rows &walls);

// out[i]: part along the normal of a vector of the fluid, at the wall. v: 3 per particle.
void normal_part_of_fluid(const Cloud &cloud, const FluidFit &fit, const double *v, double *out);

// The same of the mean over the neighbours: between the least and the largest of them, wherever they are.
void mean_normal_part(const Cloud &cloud, const Rows &walls, const double *v, double *out);

// f[i]: mean of f over those neighbours that are not on the free surface, zero if there is none
void mean_of_fluid(const Cloud &cloud, const Rows &walls, double *f);

// f[i] by a linear fit to the neighbours, their mean where they determine none. For any owned
// particles. Neighbours whose f is NaN are left out.
void fit_to_fluid(const Cloud &cloud, const Rows &rows, double *f);

}    // namespace aleisph
#endif
