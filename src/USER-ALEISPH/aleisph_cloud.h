// SPDX-License-Identifier: GPL-2.0-only
/* ----------------------------------------------------------------------
   The particles of one instant and what is derived from their positions: roles,
   normals, wall shapes, stencil, gradient and Laplacian weights, and the rows
   by role. Operators are functions of a Cloud and of fields.

   A new instant is made in two steps: reset(), after which the caller fills in
   roles, normals and wall shapes; then update(), which builds the stencil.
   Weights are built when they are first needed after an update, so that what a
   scene does not use costs nothing. While no particle moves, update() is not
   called and nothing is built again. counts() has the number of builds of each.
------------------------------------------------------------------------- */

#ifndef LMP_ALEISPH_CLOUD_H
#define LMP_ALEISPH_CLOUD_H

#include "aleisph_operators.h"
#include "aleisph_seen.h"
#include "aleisph_timers.h"

namespace aleisph {

struct BuildCounts {
  long stencil = 0, gradient = 0, laplacian = 0;
};

class Cloud {
 public:
  // In spacings. Two particles that are nearer to each other count as one that was made twice: the
  // same point from two commands, or written with six digits in a scene of 1e4 spacings. No lattice,
  // no jitter and no irregular wall comes near it.
  static constexpr double CLOSE = 0.01;

  // volume V = spacing^dim of every particle
  Cloud(const Kernel &kernel, double spacing, Timers &timers);

  // L of fluid rows is bounded: eigenvalues of M count as `floor` at least
  void set_floor(double floor) { floor_ = floor; }
  double floor() const { return floor_; }
  // when the corrected Laplacian is not trusted
  void set_limits(const LaplacianLimits &limits) { limits_ = limits; }

  // n particles, the first nowned of them owned, the others ghosts; roles, normals and shapes zero
  void reset(int nowned, int n);

  // x: owned and ghost particles. dry: particles with role DRY are in no pair.
  void update(const double *const *x, const CandidateList &list, bool dry = false);

  // changes with every update; 0 before the first one
  long version() const { return version_; }

  const Kernel &kernel() const { return kernel_; }
  int dim() const { return kernel_.dim(); }
  double spacing() const { return spacing_; }
  double volume() const { return volume_; }
  int owned() const { return nowned_; }
  int size() const { return static_cast<int>(role_.size()); }    // with ghosts

  // Of owned and ghost particles; who changes them makes the ghosts valid, and calls
  // roles_changed() after a change of roles.
  Role *role() { return role_.data(); }
  const Role *role() const { return role_.data(); }
  void roles_changed() { have_seen_ = false; }
  // unit vectors into the fluid on walls, outward on the free surface, else zero; 3 per particle
  double *normal() { return normal_.data(); }
  const double *normal() const { return normal_.data(); }
  // of wall particles: 1 flat, > 1 concave (distance of the nearest fluid in spacings), < 1 convex;
  // 0 if not known, and on fluid
  double *shape() { return shape_.data(); }
  const double *shape() const { return shape_.data(); }

  const Stencil &stencil() const { return stencil_; }
  const GradientWeights &gradient() const;
  // rows of particles that are on the surface when it is first asked for are those of Morris
  const LaplacianWeights &laplacian() const;
  // The pair array of the Laplacian's weights, into a; only fluid rows are written. keep: a copy, as
  // others use them, too. Else they are built in the memory of a, and laplacian() would build them
  // again.
  void laplacian_weights(bool keep, std::vector<double> &a) const;
  // what is known of its rows besides their weights; does not build it anew
  const LaplacianWeights &laplacian_rows() const;

  // which roles the neighbours of owned particles have, as they were when it was first asked for
  // after update() or roles_changed()
  SeenRoles neighbours() const;

  // owned particles. A buffer or wall particle is not in fluid(); a wall particle with
  // prescribed pressure is in wall(), a dry one is not
  const Rows &fluid() const { return fluid_; }
  const Rows &wall() const { return wall_; }
  const Rows &buffer() const { return buffer_; }
  const Rows &all() const { return all_; }

  const BuildCounts &counts() const { return counts_; }
  double bytes() const;

 private:
  void sort_rows();

  Kernel kernel_;
  double spacing_, volume_, floor_ = 0.0;
  LaplacianLimits limits_;
  Timers &timers_;
  int nowned_ = 0;
  long version_ = 0;
  std::vector<Role> role_;
  std::vector<double> normal_, shape_;
  Stencil stencil_;
  Rows fluid_, wall_, buffer_, all_;

  // built on demand
  mutable GradientWeights gradient_;
  mutable LaplacianWeights laplacian_;
  mutable bool have_gradient_ = false, have_laplacian_ = false, have_weights_ = false;
  mutable bool have_seen_ = false;
  mutable std::vector<Role> seen_;
  mutable BuildCounts counts_;
};

}    // namespace aleisph
#endif
