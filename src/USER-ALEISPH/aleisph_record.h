// SPDX-License-Identifier: GPL-2.0-only
/* ----------------------------------------------------------------------
   What a style keeps in a restart file: numbers, with all that is needed to
   refuse a record of another style, an older version, or one that is damaged.

     bytes  0  mark, 8 characters
            8  version of the style's record, number of values: 32 bits each
           16  checksum of the style's name, both numbers and the values
           24  the values, 8 bytes each
   Bytes are in the order of the machine, as in the rest of a restart file.
------------------------------------------------------------------------- */

#ifndef LMP_ALEISPH_RECORD_H
#define LMP_ALEISPH_RECORD_H

#include <cstdint>
#include <limits>
#include <string>
#include <vector>

namespace aleisph {

// FNV-1a, of n bytes; to go on: with the checksum of those before
std::uint64_t checksum(const void *data, std::size_t n,
                       std::uint64_t before = 14695981039346656037ull);

class Record {
 public:
  static constexpr double ANY = std::numeric_limits<double>::infinity();
  static constexpr double MANY = 9007199254740992.0;    // 2^53, the largest count

  struct Value {
    const char *name;    // as messages say it
    double low, high;    // inclusive; nan is never right
  };

  // style: of the fix; a record with another number of values needs another version
  Record(const std::string &style, int version, const std::vector<Value> &values);

  std::vector<char> pack(const std::vector<double> &values) const;
  // Empty if `values` are those of the record, else what is wrong with it. Of data only what the
  // mark and the numbers before the values vouch for is read.
  std::string unpack(const char *data, std::vector<double> &values) const;

 private:
  std::uint64_t sum(const char *numbers, const char *values) const;

  std::string style_;
  int version_;
  std::vector<Value> values_;
};

}    // namespace aleisph
#endif
