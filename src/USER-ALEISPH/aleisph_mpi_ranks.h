// SPDX-License-Identifier: GPL-2.0-only
/* ----------------------------------------------------------------------
   The ranks of a simulation: reductions, the halo exchange of particle fields,
   and how many of them there were. All functions but the last group are
   collective.
------------------------------------------------------------------------- */

#ifndef LMP_ALEISPH_MPI_RANKS_H
#define LMP_ALEISPH_MPI_RANKS_H

#include "aleisph_cloud.h"
#include "aleisph_fields.h"
#include "aleisph_mpi_halo.h"
#include "aleisph_solve_csr.h"
#include "aleisph_solve_krylov.h"
#include "aleisph_timers.h"

#include <vector>

namespace aleisph {

// Communication of this rank since the last reset, as far as it goes through Ranks
struct Traffic {
  double reductions = 0, exchanges = 0, messages = 0, bytes = 0;    // messages received
};

class Ranks : public InnerProduct {
 public:
  Ranks(MPI_Comm comm, Timers &timers) : comm_(comm), timers_(timers), halo_(comm) {}

  // -- reductions over all ranks
  void sum(int n, double *values) const override;
  void max(int n, double *values) const override;
  long sum(long value) const;
  double total(double value) const;
  double max(double value) const;
  double min(double value) const;
  bool any(bool mine) const;
  // for errors that name an atom: the largest ID, 0 if nobody has one
  long long largest(long long tag) const;
  void largest(int n, long long *tags) const;

  // -- halo exchange. The plan belongs to one set of local indices: see HaloExchange::build().
  void plan(int nlocal, const std::vector<HaloExchange::Owner> &owner);
  const HaloExchange &halo() const { return halo_; }
  // ncomp doubles per particle from their owners to all ghosts
  void forward(double *field, int ncomp);
  void forward(const Field &field) { forward(field.exchanged(), field.width()); }
  void forward_roles(Cloud &cloud);
  // the same in two parts, for linear solves that work in between: see HaloExchange
  void start(double *field, int ncomp = 1);
  void finish(double *field, int ncomp = 1);
  // rows of a matrix with these columns that need nothing of other ranks, and the others; kept
  // while the version is the same
  const RowSplit &split(int rows, const int *ptr, const int *col, long version);

  // -- for the report after a run
  Traffic &traffic() { return traffic_; }
  Traffic mean_traffic() const;    // collective: over the ranks
  double bytes() const { return halo_.bytes(); }

 private:
  MPI_Comm comm_;
  Timers &timers_;
  HaloExchange halo_;
  RowSplit split_;
  long split_version_ = -1;
  mutable Traffic traffic_;
};

}    // namespace aleisph
#endif
