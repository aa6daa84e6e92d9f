// SPDX-License-Identifier: GPL-2.0-only

#include "aleisph_mpi_halo.h"

#include <algorithm>
#include <numeric>

namespace aleisph {

HaloExchange::HaloExchange(MPI_Comm comm)
{
  MPI_Comm_dup(comm, &comm_);
  MPI_Comm_rank(comm_, &rank_);
}

HaloExchange::~HaloExchange()
{
  MPI_Comm_free(&comm_);
}

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
    remote_[g] = owner[g].rank != rank_;
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

#ifdef MPI_STUBS    // LAMMPS without MPI: one rank, nothing is remote

void HaloExchange::ask_owners(const std::vector<int> &)
{
}
void HaloExchange::receive_request()
{
}
void HaloExchange::start_messages(const double *)
{
}
void HaloExchange::await_messages()
{
}

#else

// Who wants something of this rank is not known. All requests of a round have arrived when all
// ranks have entered the barrier, which they do when theirs have been taken. A rank may be one
// round ahead of another, hence two tags.
void HaloExchange::ask_owners(const std::vector<int> &wanted)
{
  sends_.clear();
  send_index_.clear();
  tag_ = !tag_;
  std::vector<MPI_Request> asked(receives_.size());
  for (std::size_t k = 0; k < receives_.size(); k++) {
    const Peer &peer = receives_[k];
    MPI_Issend(wanted.data() + peer.begin, peer.end - peer.begin, MPI_INT, peer.rank, tag_, comm_,
               &asked[k]);
  }
  MPI_Request barrier = MPI_REQUEST_NULL;
  for (int entered = 0, done = 0; !done;) {
    receive_request();
    if (entered) {
      MPI_Test(&barrier, &done, MPI_STATUS_IGNORE);
    } else {
      MPI_Testall(static_cast<int>(asked.size()), asked.data(), &entered, MPI_STATUSES_IGNORE);
      if (entered) MPI_Ibarrier(comm_, &barrier);
    }
  }
  // the order in which requests came in is chance
  std::sort(sends_.begin(), sends_.end(),
            [](const Peer &a, const Peer &b) { return a.rank < b.rank; });
}

void HaloExchange::receive_request()
{
  int there, count;
  MPI_Status status;
  MPI_Iprobe(MPI_ANY_SOURCE, tag_, comm_, &there, &status);
  if (!there) return;
  MPI_Get_count(&status, MPI_INT, &count);
  const int begin = static_cast<int>(send_index_.size());
  send_index_.resize(begin + count);
  sends_.push_back({status.MPI_SOURCE, begin, begin + count});
  MPI_Recv(send_index_.data() + begin, count, MPI_INT, status.MPI_SOURCE, tag_, comm_,
           MPI_STATUS_IGNORE);
}

void HaloExchange::start_messages(const double *x)
{
  constexpr int DATA = 2;    // a tag that no request has
  MPI_Request *request = requests_.data();
  for (const Peer &peer : receives_)
    MPI_Irecv(in_.data() + peer.begin, peer.end - peer.begin, MPI_DOUBLE, peer.rank, DATA, comm_,
              request++);
  for (const Peer &peer : sends_) {
    for (int k = peer.begin; k < peer.end; k++) out_[k] = x[send_index_[k]];
    MPI_Isend(out_.data() + peer.begin, peer.end - peer.begin, MPI_DOUBLE, peer.rank, DATA, comm_,
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
