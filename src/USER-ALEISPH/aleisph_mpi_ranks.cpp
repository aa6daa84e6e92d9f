// SPDX-License-Identifier: GPL-2.0-only

#include "aleisph_mpi_ranks.h"

namespace aleisph {

void Ranks::sum(int n, double *values) const
{
  Timers::Scope scope(timers_, Part::COMM);
  traffic_.reductions++;
  MPI_Allreduce(MPI_IN_PLACE, values, n, MPI_DOUBLE, MPI_SUM, comm_);
}

void Ranks::max(int n, double *values) const
{
  Timers::Scope scope(timers_, Part::COMM);
  traffic_.reductions++;
  MPI_Allreduce(MPI_IN_PLACE, values, n, MPI_DOUBLE, MPI_MAX, comm_);
}

double Ranks::total(double value) const
{
  traffic_.reductions++;
  MPI_Allreduce(MPI_IN_PLACE, &value, 1, MPI_DOUBLE, MPI_SUM, comm_);
  return value;
}

double Ranks::max(double value) const
{
  traffic_.reductions++;
  MPI_Allreduce(MPI_IN_PLACE, &value, 1, MPI_DOUBLE, MPI_MAX, comm_);
  return value;
}

double Ranks::min(double value) const
{
  return -max(-value);
}

long Ranks::sum(long value) const
{
  traffic_.reductions++;
  MPI_Allreduce(MPI_IN_PLACE, &value, 1, MPI_LONG, MPI_SUM, comm_);
  return value;
}

void Ranks::largest(int n, long long *tags) const
{
  traffic_.reductions++;
  MPI_Allreduce(MPI_IN_PLACE, tags, n, MPI_LONG_LONG, MPI_MAX, comm_);
}

long long Ranks::largest(long long tag) const
{
  largest(1, &tag);
  return tag;
}

bool Ranks::any(bool mine) const
{
  return largest(mine) != 0;
}

/* ---------------------------------------------------------------------- */

void Ranks::plan(int nlocal, const std::vector<HaloExchange::Owner> &owner)
{
  Timers::Scope scope(timers_, Part::COMM);
  halo_.build(nlocal, owner);
  split_version_ = -1;
}

void Ranks::forward(double *field, int ncomp)
{
  start(field, ncomp);
  finish(field, ncomp);
}

void Ranks::forward_roles(Cloud &cloud)
{
  Role *role = cloud.role();
  std::vector<double> bits(role, role + cloud.size());
  forward(bits.data(), 1);
  for (int i = cloud.owned(); i < cloud.size(); i++) role[i] = static_cast<Role>(bits[i]);
  cloud.roles_changed();
}

void Ranks::start(double *field, int ncomp)
{
  Timers::Scope scope(timers_, Part::COMM);
  traffic_.exchanges++;
  traffic_.messages += halo_.messages();
  traffic_.bytes += ncomp * halo_.message_bytes();
  halo_.start(field, ncomp);
}

void Ranks::finish(double *field, int ncomp)
{
  Timers::Scope scope(timers_, Part::COMM);
  halo_.finish(field, ncomp);
}

const RowSplit &Ranks::split(int rows, const int *ptr, const int *col, long version)
{
  if (split_version_ == version) return split_;
  split_ = split_rows(rows, ptr, col, halo_.remote());
  split_version_ = version;
  return split_;
}

Traffic Ranks::mean_traffic() const
{
  double mean[4] = {traffic_.reductions, traffic_.exchanges, traffic_.messages, traffic_.bytes};
  int ranks;
  MPI_Comm_size(comm_, &ranks);
  MPI_Allreduce(MPI_IN_PLACE, mean, 4, MPI_DOUBLE, MPI_SUM, comm_);
  return {mean[0] / ranks, mean[1] / ranks, mean[2] / ranks, mean[3] / ranks};
}

}    // namespace aleisph
