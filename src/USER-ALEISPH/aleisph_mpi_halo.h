// SPDX-License-Identifier: GPL-2.0-only
/* ----------------------------------------------------------------------
   Halo exchange of some doubles per particle, straight from the rank that
   owns a particle to each rank with ghosts of it: one message per pair of
   ranks, one entry per owner however many periodic images there are. LAMMPS'
   own exchange needs two swaps a dimension, one after the other. Ghosts
   whose owner is this very rank are copied and need no message.

   The plan belongs to one set of local indices: build() it again after each
   re-neighboring.
------------------------------------------------------------------------- */

#ifndef LMP_ALEISPH_MPI_HALO_H
#define LMP_ALEISPH_MPI_HALO_H

#include "aleisph_mpi_messages.h"
#include "aleisph_mpi_sparse.h"

#include <vector>

namespace aleisph {

class HaloExchange {
 public:
  explicit HaloExchange(MPI_Comm comm) : exchange_(comm) {}

  // Collective. owner: of each ghost, rank and local index there; ghosts are the local indices
  // from nlocal on.
  struct Owner {
    int rank, index;
  };
  void build(int nlocal, const std::vector<Owner> &owner);

  // x: owned and ghost entries of ncomp doubles. Ghosts that are not remote() are valid after
  // start(), all after finish(). Collective among neighbours.
  void start(double *x, int ncomp = 1);
  void finish(double *x, int ncomp = 1);

  int columns() const { return static_cast<int>(canonical_.size()); }
  // per ghost: not zero if its owner is another rank
  const std::vector<char> &remote() const { return remote_; }
  // Per local index, one index for all copies of a particle: of an owned particle and its images
  // on this rank the owned one, else the first ghost
  const int *canonical() const { return canonical_.data(); }

  // what one exchange of one double receives
  int messages() const { return static_cast<int>(in_.messages().size()); }
  double message_bytes() const { return in_.message_bytes(); }
  double bytes() const;    // memory held

 private:
  struct Copy {
    int from, to;
  };

  void sort_ghosts(int nlocal, const std::vector<Owner> &owner, std::vector<int> &wanted);
  void ask_owners(const std::vector<int> &wanted);

  SparseExchange exchange_;
  ValueExchange values_;
  RankValues in_, out_;
  std::vector<int> send_index_;        // of the values of out_, owned entries
  std::vector<Copy> images_, fill_;    // x to x; in_ to x
  std::vector<char> remote_;
  std::vector<int> canonical_;
};

}    // namespace aleisph
#endif
