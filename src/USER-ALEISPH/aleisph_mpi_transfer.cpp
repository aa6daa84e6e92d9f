// SPDX-License-Identifier: GPL-2.0-only

#include "aleisph_mpi_transfer.h"

#include <algorithm>
#include <map>
#include <unordered_map>

namespace aleisph {
namespace {

// Where a row went, or where it came from
struct Moved {
  std::int64_t id;
  int peer, row;
};

// The rows of one layout that other ranks have in the other one, message after message
class Side {
 public:
  void set(std::vector<Moved> moved)
  {
    std::sort(moved.begin(), moved.end(), [](const Moved &a, const Moved &b) {
      return a.peer != b.peer ? a.peer < b.peer : a.id < b.id;
    });
    for (const Moved &row : moved) {
      const int k = static_cast<int>(rows_.size());
      if (peers_.empty() || peers_.back().rank != row.peer) peers_.push_back({row.peer, k, k});
      peers_.back().end = k + 1;
      rows_.push_back(row.row);
    }
    buffer_.resize(rows_.size());
  }

  void pack(const double *x)
  {
    for (std::size_t k = 0; k < rows_.size(); k++) buffer_[k] = x[rows_[k]];
  }
  void unpack(double *x) const
  {
    for (std::size_t k = 0; k < rows_.size(); k++) x[rows_[k]] = buffer_[k];
  }
  // start(buffer, count, rank) for every message
  template <class Start> void each(const Start &start)
  {
    for (const Peer &peer : peers_)
      start(buffer_.data() + peer.begin, peer.end - peer.begin, peer.rank);
  }

  int messages() const { return static_cast<int>(peers_.size()); }
  double bytes() const
  {
    return static_cast<double>(rows_.capacity()) * (sizeof(int) + sizeof(double));
  }

 private:
  struct Peer {
    int rank, begin, end;
  };
  std::vector<Peer> peers_;
  std::vector<int> rows_;
  std::vector<double> buffer_;
};

class MpiTransfer : public RowTransfer {
 public:
  MpiTransfer(SparseExchange &exchange, const RowIds &before, const RowIds &after) :
      exchange_(exchange), place_(after.size(), -1)
  {
    std::vector<Moved> left, came;    // peers: not known yet
    compare(before, after, left, came);
    complete_ = meet(left, came);
    left_.set(std::move(left));
    came_.set(std::move(came));
  }

  bool complete() const { return complete_; }    // as far as this rank knows

  void to_built(const double *now, double *built) override
  {
    for (std::size_t j = 0; j < place_.size(); j++)
      if (place_[j] >= 0) built[place_[j]] = now[j];
    send(came_, now, left_, built);
  }
  void to_present(const double *built, double *now) override
  {
    for (std::size_t j = 0; j < place_.size(); j++)
      if (place_[j] >= 0) now[j] = built[place_[j]];
    send(left_, built, came_, now);
  }

  double bytes() const override
  {
    return static_cast<double>(place_.capacity()) * sizeof(int) + left_.bytes() + came_.bytes();
  }

 private:
  // most rows are where they were
  void compare(const RowIds &before, const RowIds &after, std::vector<Moved> &left,
               std::vector<Moved> &came)
  {
    std::unordered_map<std::int64_t, int> elsewhere;
    for (std::size_t i = 0; i < before.size(); i++) {
      if (i < after.size() && before[i] == after[i])
        place_[i] = static_cast<int>(i);
      else
        elsewhere[before[i]] = static_cast<int>(i);
    }
    for (std::size_t j = 0; j < after.size(); j++) {
      if (place_[j] >= 0) continue;
      const auto found = elsewhere.find(after[j]);
      if (found == elsewhere.end()) {
        came.push_back({after[j], -1, static_cast<int>(j)});
      } else {
        place_[j] = found->second;
        elsewhere.erase(found);
      }
    }
    for (const auto &row : elsewhere) left.push_back({row.first, -1, row.second});
  }

  // A rank that follows from the ID brings together the rank where a row was and that where it is.
  // false: it knows one of them only.
  bool meet(std::vector<Moved> &left, std::vector<Moved> &came)
  {
    constexpr int LEFT = 0, CAME = 1;
    std::map<int, std::vector<std::int64_t>> questions;    // of (side, place on that side, ID)
    const auto ask = [&](int side, const std::vector<Moved> &rows) {
      for (std::size_t k = 0; k < rows.size(); k++) {
        auto &question = questions[static_cast<int>(rows[k].id % exchange_.ranks())];
        question.insert(question.end(), {side, static_cast<std::int64_t>(k), rows[k].id});
      }
    };
    ask(LEFT, left);
    ask(CAME, came);

    struct End {
      int rank;
      std::int64_t place;
    };
    std::map<std::int64_t, std::vector<End>> ends[2];    // by ID
    for (const auto &message : exchange_.round(messages(questions)))
      for (std::size_t k = 0; k < message.data.size(); k += 3)
        ends[message.data[k]][message.data[k + 2]].push_back({message.rank, message.data[k + 1]});

    bool complete = ends[LEFT].size() == ends[CAME].size();
    std::map<int, std::vector<std::int64_t>> answers;    // of (side, place, the other's rank)
    for (const auto &[id, from] : ends[LEFT]) {
      const auto to = ends[CAME].find(id);
      if (to == ends[CAME].end() || from.size() != 1 || to->second.size() != 1) {
        complete = false;
        continue;
      }
      const End &a = from.front(), &b = to->second.front();
      auto &to_a = answers[a.rank];
      to_a.insert(to_a.end(), {LEFT, a.place, b.rank});
      auto &to_b = answers[b.rank];
      to_b.insert(to_b.end(), {CAME, b.place, a.rank});
    }
    for (const auto &message : exchange_.round(messages(answers)))
      for (std::size_t k = 0; k < message.data.size(); k += 3)
        (message.data[k] == LEFT ? left : came)[message.data[k + 1]].peer = static_cast<int>(
            message.data[k + 2]);
    return complete;
  }

  static std::vector<SparseExchange::Message>
  messages(const std::map<int, std::vector<std::int64_t>> &by_rank)
  {
    std::vector<SparseExchange::Message> list;
    for (const auto &[rank, data] : by_rank) list.push_back({rank, data});
    return list;
  }

#ifdef MPI_STUBS    // LAMMPS without MPI: one rank, no row leaves it
  void send(Side &, const double *, Side &, double *)
  {
  }
#else
  void send(Side &from, const double *x, Side &to, double *y)
  {
    std::vector<MPI_Request> requests;
    requests.reserve(from.messages() + to.messages());
    const auto next = [&requests] {
      requests.push_back(MPI_REQUEST_NULL);
      return &requests.back();
    };
    constexpr int TAG = SparseExchange::TAG;
    to.each([&](double *values, int n, int rank) {
      MPI_Irecv(values, n, MPI_DOUBLE, rank, TAG, exchange_.comm(), next());
    });
    from.pack(x);
    from.each([&](double *values, int n, int rank) {
      MPI_Isend(values, n, MPI_DOUBLE, rank, TAG, exchange_.comm(), next());
    });
    MPI_Waitall(static_cast<int>(requests.size()), requests.data(), MPI_STATUSES_IGNORE);
    to.unpack(y);
  }
#endif

  SparseExchange &exchange_;
  std::vector<int> place_;    // of a row of today, when it was built; -1: on another rank
  Side left_, came_;          // rows of then, rows of today
  bool complete_ = true;
};

}    // namespace

std::unique_ptr<RowTransfer> make_transfer(SparseExchange &exchange, const RowIds &before,
                                           const RowIds &after)
{
  auto transfer = std::make_unique<MpiTransfer>(exchange, before, after);
  int incomplete = !transfer->complete(), any;
  MPI_Allreduce(&incomplete, &any, 1, MPI_INT, MPI_MAX, exchange.comm());
  if (any) return nullptr;
  return transfer;
}

}    // namespace aleisph
