// SPDX-License-Identifier: GPL-2.0-only
/* ----------------------------------------------------------------------
   Repeated messages to, or from, a fixed set of ranks that expect them. Which
   ranks these are can be found by SparseExchange.
------------------------------------------------------------------------- */

#ifndef LMP_ALEISPH_MPI_MESSAGES_H
#define LMP_ALEISPH_MPI_MESSAGES_H

#include <mpi.h>

#include <cstddef>
#include <vector>

namespace aleisph {

// The entries of all messages of one direction, message after message; `width` doubles an entry
class RankValues {
 public:
  struct Message {
    int rank, begin, end;    // entries
  };

  void clear();
  // for this rank: to its message if it is the last one, else to a new message
  void append(int rank, int count = 1);
  // 1 after clear(); what was in is lost
  void set_width(int width);

  const std::vector<Message> &messages() const { return messages_; }
  int size() const { return size_; }    // entries
  int width() const { return width_; }
  double &operator[](std::size_t k) { return values_[k]; }
  const double &operator[](std::size_t k) const { return values_[k]; }
  double *data() { return values_.data(); }

  double message_bytes() const { return static_cast<double>(sizeof(double)) * size_; }    // width 1
  double bytes() const { return static_cast<double>(sizeof(double)) * values_.capacity(); }

 private:
  std::vector<Message> messages_;
  std::vector<double> values_;
  int size_ = 0, width_ = 1;
};

class ValueExchange {
 public:
  // out and in must stay as they are until finish(); then in has what came
  void start(MPI_Comm comm, int tag, const RankValues &out, RankValues &in);
  void finish();

 private:
  std::vector<MPI_Request> requests_;
};

}    // namespace aleisph
#endif
