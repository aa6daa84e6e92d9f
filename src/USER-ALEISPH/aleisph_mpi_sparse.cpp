// SPDX-License-Identifier: GPL-2.0-only

#include "aleisph_mpi_sparse.h"

#include <algorithm>

namespace aleisph {

SparseExchange::SparseExchange(MPI_Comm comm)
{
  MPI_Comm_dup(comm, &comm_);
  MPI_Comm_rank(comm_, &rank_);
  MPI_Comm_size(comm_, &ranks_);
}

SparseExchange::~SparseExchange()
{
  MPI_Comm_free(&comm_);
}

#ifdef MPI_STUBS    // LAMMPS without MPI: one rank

std::vector<SparseExchange::Message> SparseExchange::round(const std::vector<Message> &sent)
{
  return sent;
}

#else

namespace {

void receive(MPI_Comm comm, int tag, std::vector<SparseExchange::Message> &received)
{
  int there, count;
  MPI_Status status;
  MPI_Iprobe(MPI_ANY_SOURCE, tag, comm, &there, &status);
  if (!there) return;
  MPI_Get_count(&status, MPI_INT64_T, &count);
  received.push_back({status.MPI_SOURCE, std::vector<std::int64_t>(count)});
  MPI_Recv(received.back().data.data(), count, MPI_INT64_T, status.MPI_SOURCE, tag, comm,
           MPI_STATUS_IGNORE);
}

}    // namespace

// Who sends something to this rank is not known. All messages of a round have arrived when all
// ranks have entered the barrier, which they do when theirs have been taken. A rank may be one
// round ahead of another, hence two tags.
std::vector<SparseExchange::Message> SparseExchange::round(const std::vector<Message> &sent)
{
  tag_ = !tag_;
  std::vector<Message> received;
  std::vector<MPI_Request> requests(sent.size());
  for (std::size_t k = 0; k < sent.size(); k++)
    MPI_Issend(sent[k].data.data(), static_cast<int>(sent[k].data.size()), MPI_INT64_T,
               sent[k].rank, tag_, comm_, &requests[k]);
  MPI_Request barrier = MPI_REQUEST_NULL;
  for (int entered = 0, done = 0; !done;) {
    receive(comm_, tag_, received);
    if (entered) {
      MPI_Test(&barrier, &done, MPI_STATUS_IGNORE);
    } else {
      MPI_Testall(static_cast<int>(requests.size()), requests.data(), &entered,
                  MPI_STATUSES_IGNORE);
      if (entered) MPI_Ibarrier(comm_, &barrier);
    }
  }
  // messages arrive in any order
  std::sort(received.begin(), received.end(),
            [](const Message &a, const Message &b) { return a.rank < b.rank; });
  return received;
}

#endif

}    // namespace aleisph
