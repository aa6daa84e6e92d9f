// SPDX-License-Identifier: GPL-2.0-only
/* ----------------------------------------------------------------------
   Messages to ranks that do not expect them: sparse data exchange with
   non-blocking consensus, Hoefler, Siebert & Lumsdaine, PPoPP 2010, without a
   table of all ranks.
------------------------------------------------------------------------- */

#ifndef LMP_ALEISPH_MPI_SPARSE_H
#define LMP_ALEISPH_MPI_SPARSE_H

#include <mpi.h>

#include <cstdint>
#include <vector>

namespace aleisph {

class SparseExchange {
 public:
  // for the caller's messages in this communicator; 0 and 1 are those of the rounds
  static constexpr int TAG = 2;
  struct Message {
    int rank;
    std::vector<std::int64_t> data;
  };

  explicit SparseExchange(MPI_Comm comm);    // has a communicator of its own, like comm
  ~SparseExchange();
  SparseExchange(const SparseExchange &) = delete;
  SparseExchange &operator=(const SparseExchange &) = delete;

  MPI_Comm comm() const { return comm_; }
  int rank() const { return rank_; }
  int ranks() const { return ranks_; }

  // Collective. sent: one to a rank at most, also to this one. What this rank has been sent, in
  // the order of the ranks.
  std::vector<Message> round(const std::vector<Message> &sent);

 private:
  MPI_Comm comm_;
  int rank_, ranks_, tag_ = 0;
};

}    // namespace aleisph
#endif
