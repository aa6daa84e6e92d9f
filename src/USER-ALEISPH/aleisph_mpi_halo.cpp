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
}

// wanted: the owners' indices of the entries of in_, rank after rank
void HaloExchange::sort_ghosts(int nlocal, const std::vector<Owner> &owner,
                               std::vector<int> &wanted)
{
  const int nghost = static_cast<int>(owner.size());
  in_.clear();
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
      in_.append(owner[g].rank);
    }
    fill_.push_back({in_.size() - 1, nlocal + g});
    canonical_[nlocal + g] = nlocal + first;
  }
}

void HaloExchange::ask_owners(const std::vector<int> &wanted)
{
  std::vector<SparseExchange::Message> asked;
  for (const auto &from : in_.messages())
    asked.push_back({from.rank, {wanted.begin() + from.begin, wanted.begin() + from.end}});
  out_.clear();
  send_index_.clear();
  for (const auto &request : exchange_.round(asked)) {
    out_.append(request.rank, static_cast<int>(request.data.size()));
    send_index_.insert(send_index_.end(), request.data.begin(), request.data.end());
  }
}

namespace {

// entry `from` of x becomes entry `to` of y
inline void copy_entry(const double *x, std::size_t from, double *y, std::size_t to, int ncomp)
{
  for (int c = 0; c < ncomp; c++) y[ncomp * to + c] = x[ncomp * from + c];
}

}    // namespace

void HaloExchange::start(double *x, int ncomp)
{
  if (out_.width() != ncomp) out_.set_width(ncomp);
  if (in_.width() != ncomp) in_.set_width(ncomp);
  for (std::size_t k = 0; k < send_index_.size(); k++)
    copy_entry(x, send_index_[k], out_.data(), k, ncomp);
  values_.start(exchange_.comm(), SparseExchange::TAG, out_, in_);
  for (const Copy &copy : images_) copy_entry(x, copy.from, x, copy.to, ncomp);
}

void HaloExchange::finish(double *x, int ncomp)
{
  values_.finish();
  for (const Copy &copy : fill_) copy_entry(in_.data(), copy.from, x, copy.to, ncomp);
}

double HaloExchange::bytes() const
{
  return static_cast<double>((send_index_.capacity() + canonical_.capacity()) * sizeof(int) +
                             (images_.capacity() + fill_.capacity()) * sizeof(Copy) +
                             remote_.capacity()) +
      in_.bytes() + out_.bytes();
}

}    // namespace aleisph
