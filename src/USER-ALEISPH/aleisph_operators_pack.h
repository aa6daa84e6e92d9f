// SPDX-License-Identifier: GPL-2.0-only
/* ----------------------------------------------------------------------
   Eight rows at a time. A Pack holds one number of each of LANES rows; every
   lane does what a scalar loop over the pairs of its row would do, in the
   same order, so that results do not depend on the vector instructions that
   the compiler uses. Vector extension of GCC and Clang.
------------------------------------------------------------------------- */

#ifndef LMP_ALEISPH_OPERATORS_PACK_H
#define LMP_ALEISPH_OPERATORS_PACK_H

#include "aleisph_stencil.h"

#include <algorithm>
#include <cmath>

namespace aleisph {

constexpr int LANES = 8;
typedef double Pack __attribute__((vector_size(LANES * sizeof(double))));

inline void set_all(Pack &p, double value)
{
  for (int l = 0; l < LANES; l++) p[l] = value;
}

inline void square_root(const Pack &x, Pack &root)
{
  for (int l = 0; l < LANES; l++) root[l] = std::sqrt(x[l]);
}

// Up to LANES rows of a stencil; lanes without a row have no pairs.
class RowBlock {
 public:
  RowBlock(const Stencil &s, const int *rows, int count)
  {
    for (int l = 0; l < LANES; l++) {
      const int i = rows[std::min(l, count - 1)];
      length_[l] = l < count ? s.end(i) - s.begin(i) : 0;
      begin_[l] = length_[l] > 0 ? s.begin(i) : 0;
      longest_ = std::max(longest_, length_[l]);
    }
  }

  int longest() const { return longest_; }

  // the m-th pair of each row; of shorter rows, some other pair of theirs
  void locate(int m, int (&k)[LANES]) const
  {
    for (int l = 0; l < LANES; l++) k[l] = begin_[l] + std::max(0, std::min(m, length_[l] - 1));
  }

  // 1 where there is an m-th pair, else 0
  void present(int m, Pack &mask) const
  {
    for (int l = 0; l < LANES; l++) mask[l] = m < length_[l] ? 1.0 : 0.0;
  }

 private:
  int begin_[LANES], length_[LANES], longest_ = 0;
};

inline void gather(const double *values, const int (&k)[LANES], Pack &p)
{
  for (int l = 0; l < LANES; l++) p[l] = values[k[l]];
}

}    // namespace aleisph
#endif
