/* ----------------------------------------------------------------------
   LAMMPS - Large-scale Atomic/Molecular Massively Parallel Simulator
   USER-ALEISPH package
   SPDX-License-Identifier: GPL-2.0-only

   The owner's part about other ranks: halo exchanges and reductions, and
   how many there were.
------------------------------------------------------------------------- */

#include "fix_aleisph.h"

#include "atom.h"
#include "comm.h"
#include "update.h"

#include <algorithm>
#include <cstring>

using namespace LAMMPS_NS;
using aleisph::Part;

void FixAleisph::forward(double *field, int ncomp)
{
  aleisph::Timers::Scope scope(timers_, Part::COMM);
  halo_field_ = field;
  halo_ncomp_ = ncomp;
  traffic_.exchanges++;
  comm->forward_comm(this, ncomp);
}

int FixAleisph::pack_forward_comm(int n, int *list, double *buf, int, int *)
{
  int m = 0;
  for (int k = 0; k < n; k++)
    for (int a = 0; a < halo_ncomp_; a++) buf[m++] = halo_field_[halo_ncomp_ * list[k] + a];
  packed_ = buf;
  return m;
}

// What a rank sends to itself is unpacked from where it was packed: no message
void FixAleisph::unpack_forward_comm(int n, int first, double *buf)
{
  if (n == 0) return;    // there may be no buffer
  const std::size_t bytes = sizeof(double) * n * halo_ncomp_;
  std::memcpy(halo_field_ + static_cast<std::size_t>(halo_ncomp_) * first, buf, bytes);
  if (buf == packed_) return;
  count_messages(1, static_cast<double>(bytes));
}

/* ----------------------------------------------------------------------
   Ghosts are told rank and index of their owner by LAMMPS' own exchange,
   which knows ghosts of ghosts and periodic images.
------------------------------------------------------------------------- */

void FixAleisph::build_halo()
{
  const int nlocal = atom->nlocal;
  std::vector<double> source(2 * static_cast<std::size_t>(nlocal + atom->nghost));
  for (int i = 0; i < nlocal; i++) {
    source[2 * i] = comm->me;
    source[2 * i + 1] = i;
  }
  forward(source.data(), 2);
  aleisph::Timers::Scope scope(timers_, Part::COMM);
  std::vector<aleisph::HaloExchange::Owner> owner(atom->nghost);
  for (int g = 0; g < atom->nghost; g++)
    owner[g] = {static_cast<int>(source[2 * (nlocal + g)]),
                static_cast<int>(source[2 * (nlocal + g) + 1])};
  halo_->build(nlocal, owner);
}

void FixAleisph::start_halo(double *field)
{
  aleisph::Timers::Scope scope(timers_, Part::COMM);
  traffic_.exchanges++;
  count_messages(halo_->messages(), halo_->message_bytes());
  halo_->start(field);
}

void FixAleisph::finish_halo(double *field)
{
  aleisph::Timers::Scope scope(timers_, Part::COMM);
  halo_->finish(field);
}

void FixAleisph::count_messages(int messages, double bytes)
{
  traffic_.messages += messages;
  traffic_.bytes += bytes;
}

const aleisph::RowSplit &FixAleisph::row_split()
{
  if (split_version_ == cloud_->version()) return split_;
  const auto &stencil = cloud_->stencil();
  split_ = aleisph::split_rows(stencil.rows(), stencil.ptr(), stencil.col(), halo_->remote());
  split_version_ = cloud_->version();
  return split_;
}

/* ---------------------------------------------------------------------- */

void FixAleisph::reduce_max(int n, tagint *values) const
{
  traffic_.reductions++;
  MPI_Allreduce(MPI_IN_PLACE, values, n, MPI_LMP_TAGINT, MPI_MAX, world);
}

tagint FixAleisph::largest(tagint tag) const
{
  reduce_max(1, &tag);
  return tag;
}

long FixAleisph::sum(long value) const
{
  traffic_.reductions++;
  MPI_Allreduce(MPI_IN_PLACE, &value, 1, MPI_LONG, MPI_SUM, world);
  return value;
}

bool FixAleisph::any(bool mine) const
{
  return largest(mine);
}

std::string FixAleisph::report_traffic() const
{
  double mean[4] = {static_cast<double>(traffic_.reductions),
                    static_cast<double>(traffic_.exchanges), static_cast<double>(traffic_.messages),
                    traffic_.bytes};
  MPI_Allreduce(MPI_IN_PLACE, mean, 4, MPI_DOUBLE, MPI_SUM, world);
  const double steps = static_cast<double>(std::max<bigint>(1, update->nsteps));
  for (double &value : mean) value /= steps * comm->nprocs;
  return fmt::format("ALEISPH communication per step: {:.4g} reductions, {:.4g} halo exchanges, "
                     "{:.4g} messages, {:.4g} bytes per rank\n",
                     mean[0], mean[1], mean[2], mean[3]);
}
