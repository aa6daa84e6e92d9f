// SPDX-License-Identifier: GPL-2.0-only
/* ----------------------------------------------------------------------
   Pair geometry of the owned particles in compressed rows: row i lists
   the neighbours j with 0 < |x_i - x_j| < support.
   r_ij = x_i - x_j [length], e_ij = r_ij/|r_ij|, dW/dr at |r_ij|.
   Columns are local indices: owned particles first, then ghosts. All
   arrays are pair arrays of length pairs(), indexed by k in
   [begin(i), end(i)). In 2d the z component is not stored. With periodic
   images as columns of the particles themselves, a row of a small box may
   have the same column more than once.
------------------------------------------------------------------------- */

#ifndef LMP_ALEISPH_STENCIL_H
#define LMP_ALEISPH_STENCIL_H

#include "aleisph_kernel.h"
#include "aleisph_roles.h"
#include "aleisph_rows.h"

#include <array>
#include <cstddef>
#include <vector>

namespace aleisph {

// Candidate neighbours as a LAMMPS full neighbor list stores them; a particle
// index is j = first[i][m] & mask, its column canonical[j]. Candidates beyond
// the support are filtered.
struct CandidateList {
  const int *count;           // per owned particle
  const int *const *first;    // per owned particle
  int mask;
  // per particle, owned and ghost: the particle that it is a periodic image of, or itself; all
  // fields must be the same on both, only positions differ. Null: every particle is itself.
  const int *canonical = nullptr;
};

// Which pairs are wanted, by role (owned and ghost); without roles: all
struct PairFilter {
  const Role *role = nullptr;
  Role rows = ~0u;    // the rows of particles with none of these roles stay empty
  Role drop = 0;      // particles with one of these roles are in no pair
};

class Stencil {
 public:
  // x: 3 doubles per particle (owned and ghost), [length].
  // Two particles at the same place cannot be handled; their pairs are left
  // out and counted in coincident(), once for each owned row that meets one; those that are
  // nearer to each other than set_close() says are counted in close(), these among them.
  // The order of the candidates is kept. One pass over them, as long as the pairs fit into the
  // memory of the last build; else a second one.
  void build(const Kernel &kernel, int nowned, const double *const *x, const CandidateList &list,
             const PairFilter &filter = PairFilter());

  int dim() const { return dim_; }
  int rows() const { return static_cast<int>(ptr_.size()) - 1; }
  int pairs() const { return ptr_.back(); }
  int begin(int i) const { return ptr_[i]; }
  int end(int i) const { return ptr_[i + 1]; }
  int coincident() const { return coincident_; }
  int close() const { return close_; }
  void set_close(double distance) { close2_ = distance * distance; }

  const int *ptr() const { return ptr_.data(); }
  const int *col() const { return col_.data(); }
  const double *r() const { return r_.data(); }            // |r_ij|
  const double *e(int a) const { return e_[a].data(); }    // component a of e_ij, a < dim()
  const double *dw() const { return dw_.data(); }          // dW/dr
  double bytes() const;                                    // memory held

 private:
  class Builder;
  std::size_t slots() const { return col_.size(); }
  void set_slots(std::size_t n);

  int dim_ = 0, coincident_ = 0, close_ = 0;
  double close2_ = 0.0;
  std::vector<int> ptr_ = {0}, col_;
  std::vector<double> r_, dw_;
  std::array<std::vector<double>, 3> e_;
};

}    // namespace aleisph
#endif
