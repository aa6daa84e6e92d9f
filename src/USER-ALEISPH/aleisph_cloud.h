// SPDX-License-Identifier: GPL-2.0-only
/* ----------------------------------------------------------------------
   One configuration of particles and what is derived from it: stencil,
   gradient and Laplacian weights, and the rows by role. The weights are
   built when they are first asked for after an update, so that a scene
   pays for what it uses only; while no particle moves nobody calls update()
   and nothing is built again. counts() says how often each was.
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
  // volume V = spacing^dim of every particle
  Cloud(const Kernel &kernel, double spacing, Timers &timers);

  // L of fluid rows is bounded: eigenvalues of M count as `floor` at least
  void set_floor(double floor) { floor_ = floor; }

  // x, role: owned and ghost particles; role must live until the next update.
  // dry: particles with role DRY are in no pair.
  void update(int nowned, const double *const *x, const CandidateList &list, const Role *role,
              bool dry = false);

  const Kernel &kernel() const { return kernel_; }
  double spacing() const { return spacing_; }
  double volume() const { return volume_; }

  const Stencil &stencil() const { return stencil_; }
  const GradientWeights &gradient();
  // rows of particles that are on the surface when it is first asked for are those of Morris
  const LaplacianWeights &laplacian();
  // The pair array of the Laplacian's weights, into a; only fluid rows are written. keep: a copy, as
  // others use them, too. Else they are built in the memory of a, and laplacian() would build them
  // again.
  void laplacian_weights(bool keep, std::vector<double> &a);
  // what is known of its rows besides their weights; does not build it anew
  const LaplacianWeights &laplacian_rows();
  double floor() const { return floor_; }

  // table of SeenRoles, of the roles there are when it is first asked for after update() or
  // roles_changed()
  const Role *seen();
  void roles_changed() { have_seen_ = false; }

  // a buffer or wall particle is not in fluid(); a wall particle with
  // prescribed pressure is in wall(), a dry one is not
  const Rows &fluid() const { return fluid_; }
  const Rows &wall() const { return wall_; }
  const Rows &buffer() const { return buffer_; }
  const Rows &all() const { return all_; }

  const BuildCounts &counts() const { return counts_; }
  double bytes() const { return stencil_.bytes() + gradient_.bytes() + laplacian_.bytes(); }

 private:
  void sort_rows(int nowned, const Role *role);

  Kernel kernel_;
  double spacing_, volume_, floor_ = 0.0;
  const Role *role_ = nullptr;
  Timers &timers_;
  Stencil stencil_;
  GradientWeights gradient_;
  LaplacianWeights laplacian_;
  bool have_gradient_ = false, have_laplacian_ = false, have_weights_ = false;
  bool have_seen_ = false;
  std::vector<Role> seen_;
  Rows fluid_, wall_, buffer_, all_;
  BuildCounts counts_;
};

}    // namespace aleisph
#endif
