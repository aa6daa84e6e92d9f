// SPDX-License-Identifier: GPL-2.0-only

#include "aleisph_mpi_halo.h"

#include <algorithm>
#include <numeric>

namespace aleisph {

void HaloExchange::build(int nlocal, const std::vector<Owner> &owner)
{
  std::vector<int> wanted;
  sort_ghosts(nlocal, owner, wanted);
  ask_owners(wanted);
  in_.resize(wanted.size());
  out_.resize(send_index_.size());
  requests_.resize(receives_.size() + sends_.size());
}

// wanted: the owners' indices of the entries of in_, rank after rank
void HaloExchange::sort_ghosts(int nlocal, const std::vector<Owner> &owner,
                               std::vector<int> &wanted)
{
  const int nghost = static_cast<int>(owner.size());
  receives_.clear();
  images_.clear();
  fill_.clear();
  remote_.assign(nghost, 0);
  canonical_.resize(nlocal + nghost);
  std::iota(canonical_.begin(), canonical_.end(), 0);

  std::vector<int> order;
  for (int g = 0; g < nghost; g++) {
    remote_[g] = owner[g].rank != exchange_.rank();
    if (remote_[g]) {
      order.push_back(g);
    } else {
      images_.push_back({owner[g].index, nlocal + g});
      canonical_[nlocal + g] = owner[g].index;
    }
  }
  std::sort(order.begin(), order.end(), [&owner](int a, int b) {
    if (owner[a].rank != owner[b].rank) return owner[a].rank < owner[b].rank;
    return owner[a].index != owner[b].index ? owner[a].index < owner[b].index : a < b;
  });

  int first = -1;    // ghost of the present owner
  for (const int g : order) {
    const bool same_rank = first >= 0 && owner[first].rank == owner[g].rank;
    if (!same_rank || owner[first].index != owner[g].index) {
      first = g;
      wanted.push_back(owner[g].index);
    }
    const int entry = static_cast<int>(wanted.size()) - 1;
    if (!same_rank) receives_.push_back({owner[g].rank, entry, entry});
    receives_.back().end = entry + 1;
    fill_.push_back({entry, nlocal + g});
    canonical_[nlocal + g] = nlocal + first;
  }
}

void HaloExchange::ask_owners(const std::vector<int> &wanted)
{
  std::vector<SparseExchange::Message> asked;
  for (const Peer &peer : receives_)
    asked.push_back({peer.rank, {wanted.begin() + peer.begin, wanted.begin() + peer.end}});
  sends_.clear();
  send_index_.clear();
  for (const auto &request : exchange_.round(asked)) {
    const int begin = static_cast<int>(send_index_.size());
    send_index_.insert(send_index_.end(), request.data.begin(), request.data.end());
    sends_.push_back({request.rank, begin, static_cast<int>(send_index_.size())});
  }
}

#ifdef MPI_STUBS    // LAMMPS without MPI: one rank, nothing is remote

void HaloExchange::start_messages(const double *)
{
}
void HaloExchange::await_messages()
{
}

#else

void HaloExchange::start_messages(const double *x)
{
  constexpr int TAG = SparseExchange::TAG;
  MPI_Comm comm = exchange_.comm();
  MPI_Request *request = requests_.data();
  for (const Peer &peer : receives_)
    MPI_Irecv(in_.data() + peer.begin, peer.end - peer.begin, MPI_DOUBLE, peer.rank, TAG, comm,
              request++);
  for (const Peer &peer : sends_) {
    for (int k = peer.begin; k < peer.end; k++) out_[k] = x[send_index_[k]];
    MPI_Isend(out_.data() + peer.begin, peer.end - peer.begin, MPI_DOUBLE, peer.rank, TAG, comm,
              request++);
  }
}

void HaloExchange::await_messages()
{
  MPI_Waitall(static_cast<int>(requests_.size()), requests_.data(), MPI_STATUSES_IGNORE);
}

#endif

void HaloExchange::start(double *x)
{
  start_messages(x);
  for (const Copy &copy : images_) x[copy.to] = x[copy.from];
}

void HaloExchange::finish(double *x)
{
  await_messages();
  for (const Copy &copy : fill_) x[copy.to] = in_[copy.from];
}

double HaloExchange::bytes() const
{
  return static_cast<double>((send_index_.capacity() + canonical_.capacity()) * sizeof(int) +
                             (images_.capacity() + fill_.capacity()) * sizeof(Copy) +
                             (in_.capacity() + out_.capacity()) * sizeof(double) +
                             remote_.capacity());
}

}    // namespace aleisph
