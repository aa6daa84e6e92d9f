// SPDX-License-Identifier: GPL-2.0-only

#include "aleisph_mpi_transfer.h"

#include "aleisph_mpi_messages.h"

#include <algorithm>
#include <map>
#include <tuple>
#include <utility>

namespace aleisph {
namespace {

// Beyond this share of rows on other ranks than at the build, these ranks may have other shares of
// the work, too: a new preconditioner is the better one
constexpr double MAX_LEFT = 0.1;

// A row that went to another rank, or came from there
struct Migrant {
  std::int64_t id;
  int row;     // where it was, or where it is
  int peer;    // that rank
};
using Migrants = std::vector<Migrant>;

// Who went and who came: a rank that follows from the ID brings the two ranks of a row together
class Rendezvous {
 public:
  explicit Rendezvous(SparseExchange &exchange) : exchange_(exchange) {}

  // Sets the peers; false on the rank that knows a row which went but did not come, or the reverse
  bool meet(Migrants &left, Migrants &came)
  {
    ask(LEFT, left);
    ask(CAME, came);
    std::vector<Guest> guests = receive();
    const bool complete = introduce(guests);
    for (const auto &message : exchange_.round(take()))
      for (std::size_t k = 0; k < message.data.size(); k += WORDS)
        (message.data[k] == LEFT ? left : came)[message.data[k + 1]].peer = static_cast<int>(
            message.data[k + 2]);
    return complete;
  }

 private:
  static constexpr int LEFT = 0, CAME = 1;
  static constexpr std::size_t WORDS = 3;    // side, place in the list of that side, ID or rank

  struct Guest {
    std::int64_t id, side, place;
    int rank;
  };

  void say(int rank, std::int64_t side, std::int64_t place, std::int64_t what)
  {
    auto &words = words_[rank];
    words.insert(words.end(), {side, place, what});
  }

  void ask(int side, const Migrants &rows)
  {
    for (std::size_t k = 0; k < rows.size(); k++)
      say(static_cast<int>(rows[k].id % exchange_.ranks()), side, static_cast<std::int64_t>(k),
          rows[k].id);
  }

  // what was said, to be sent
  std::vector<SparseExchange::Message> take()
  {
    std::vector<SparseExchange::Message> list;
    for (auto &[rank, words] : words_) list.push_back({rank, std::move(words)});
    words_.clear();
    return list;
  }

  std::vector<Guest> receive()
  {
    std::vector<Guest> guests;
    for (const auto &message : exchange_.round(take()))
      for (std::size_t k = 0; k < message.data.size(); k += WORDS)
        guests.push_back({message.data[k + 2], message.data[k], message.data[k + 1], message.rank});
    return guests;
  }

  // pairs of one that went and one that came
  bool introduce(std::vector<Guest> &guests)
  {
    std::sort(guests.begin(), guests.end(), [](const Guest &a, const Guest &b) {
      return std::tie(a.id, a.side, a.rank) < std::tie(b.id, b.side, b.rank);
    });
    std::size_t k = 0;
    for (; k + 1 < guests.size(); k += 2) {
      const Guest &from = guests[k], &to = guests[k + 1];
      if (from.id != to.id || from.side != LEFT || to.side != CAME) return false;
      say(from.rank, LEFT, from.place, to.rank);
      say(to.rank, CAME, to.place, from.rank);
    }
    return k == guests.size();
  }

  SparseExchange &exchange_;
  std::map<int, std::vector<std::int64_t>> words_;    // to each rank
};

// The values of the rows that one layout has on this rank and the other one elsewhere
class Side {
 public:
  void set(Migrants migrants)
  {
    std::sort(migrants.begin(), migrants.end(), [](const Migrant &a, const Migrant &b) {
      return std::tie(a.peer, a.id) < std::tie(b.peer, b.id);
    });
    for (const Migrant &one : migrants) {
      rows_.push_back(one.row);
      values_.append(one.peer);
    }
  }

  void pack(const double *x)
  {
    for (std::size_t k = 0; k < rows_.size(); k++) values_[k] = x[rows_[k]];
  }
  void unpack(double *x) const
  {
    for (std::size_t k = 0; k < rows_.size(); k++) x[rows_[k]] = values_[k];
  }

  RankValues &values() { return values_; }
  const RankValues &values() const { return values_; }
  int size() const { return values_.size(); }
  double bytes() const
  {
    return static_cast<double>(rows_.capacity() * sizeof(int)) + values_.bytes();
  }

 private:
  std::vector<int> rows_;
  RankValues values_;
};

class MpiTransfer : public RowTransfer {
 public:
  MpiTransfer(SparseExchange &exchange, const RowIds &before, const RowIds &after) :
      exchange_(exchange), place_(after.size(), -1)
  {
    Migrants left, came;
    compare(before, after, left, came);
    complete_ = Rendezvous(exchange).meet(left, came);
    left_.set(std::move(left));
    came_.set(std::move(came));
  }

  bool complete() const { return complete_; }    // as far as this rank knows
  int left() const { return left_.size(); }

  void to_built(const double *present, double *built) override
  {
    for (std::size_t j = 0; j < place_.size(); j++)
      if (place_[j] >= 0) built[place_[j]] = present[j];
    send(came_, present, left_, built);
  }
  void to_present(const double *built, double *present) override
  {
    for (std::size_t j = 0; j < place_.size(); j++)
      if (place_[j] >= 0) present[j] = built[place_[j]];
    send(left_, built, came_, present);
  }

  int messages() const override
  {
    return static_cast<int>(left_.values().messages().size() + came_.values().messages().size());
  }
  double message_bytes() const override
  {
    return left_.values().message_bytes() + came_.values().message_bytes();
  }
  double bytes() const override
  {
    return static_cast<double>(place_.capacity() * sizeof(int)) + left_.bytes() + came_.bytes();
  }

 private:
  // most rows are where they were, or elsewhere on this rank
  void compare(const RowIds &before, const RowIds &after, Migrants &left, Migrants &came)
  {
    std::vector<std::pair<std::int64_t, int>> others;    // ID and place before
    for (std::size_t i = 0; i < before.size(); i++) {
      if (i < after.size() && before[i] == after[i])
        place_[i] = static_cast<int>(i);
      else
        others.emplace_back(before[i], static_cast<int>(i));
    }
    std::sort(others.begin(), others.end());
    std::vector<char> found(others.size(), 0);
    for (std::size_t j = 0; j < after.size(); j++) {
      if (place_[j] >= 0) continue;
      const auto other = std::lower_bound(others.begin(), others.end(),
                                          std::make_pair(after[j], 0));
      if (other == others.end() || other->first != after[j]) {
        came.push_back({after[j], static_cast<int>(j), -1});
      } else {
        place_[j] = other->second;
        found[other - others.begin()] = 1;
      }
    }
    for (std::size_t k = 0; k < others.size(); k++)
      if (!found[k]) left.push_back({others[k].first, others[k].second, -1});
  }

  void send(Side &from, const double *x, Side &to, double *y)
  {
    from.pack(x);
    values_.start(exchange_.comm(), SparseExchange::TAG, from.values(), to.values());
    values_.finish();
    to.unpack(y);
  }

  SparseExchange &exchange_;
  ValueExchange values_;
  std::vector<int> place_;    // of a row of today, when it was built; -1: on another rank
  Side left_, came_;          // rows of then, rows of today
  bool complete_ = true;
};

}    // namespace

std::unique_ptr<RowTransfer> make_transfer(SparseExchange &exchange, const RowIds &before,
                                           const RowIds &after)
{
  auto transfer = std::make_unique<MpiTransfer>(exchange, before, after);
  double sums[] = {transfer->complete() ? 0.0 : 1.0, static_cast<double>(transfer->left()),
                   static_cast<double>(before.size())};
  MPI_Allreduce(MPI_IN_PLACE, sums, 3, MPI_DOUBLE, MPI_SUM, exchange.comm());
  if (sums[0] > 0.0 || sums[1] > MAX_LEFT * sums[2]) return nullptr;
  return transfer;
}

}    // namespace aleisph
