// SPDX-License-Identifier: GPL-2.0-only

#include "aleisph_mpi_messages.h"

namespace aleisph {

void RankValues::clear()
{
  messages_.clear();
  values_.clear();
  size_ = 0;
  width_ = 1;
}

void RankValues::append(int rank, int count)
{
  if (messages_.empty() || messages_.back().rank != rank)
    messages_.push_back({rank, size(), size()});
  size_ += count;
  values_.resize(static_cast<std::size_t>(size_) * width_);
  messages_.back().end = size();
}

void RankValues::set_width(int width)
{
  width_ = width;
  values_.resize(static_cast<std::size_t>(size_) * width_);
}

#ifdef MPI_STUBS    // LAMMPS without MPI: there is no other rank

void ValueExchange::start(MPI_Comm, int, const RankValues &, RankValues &)
{
}
void ValueExchange::finish()
{
}

#else

void ValueExchange::start(MPI_Comm comm, int tag, const RankValues &out, RankValues &in)
{
  requests_.resize(in.messages().size() + out.messages().size());
  MPI_Request *request = requests_.data();
  const std::size_t width = in.width();
  for (const auto &from : in.messages())
    MPI_Irecv(&in[width * from.begin], in.width() * (from.end - from.begin), MPI_DOUBLE, from.rank,
              tag, comm, request++);
  for (const auto &to : out.messages())
    MPI_Isend(&out[width * to.begin], out.width() * (to.end - to.begin), MPI_DOUBLE, to.rank, tag,
              comm, request++);
}

void ValueExchange::finish()
{
  MPI_Waitall(static_cast<int>(requests_.size()), requests_.data(), MPI_STATUSES_IGNORE);
}

#endif

}    // namespace aleisph
