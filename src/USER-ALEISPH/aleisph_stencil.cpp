// SPDX-License-Identifier: GPL-2.0-only
/* ----------------------------------------------------------------------
   Two passes over the candidates: the first counts the pairs of each row,
   so that the pair arrays get their final size at once; the second fills
   them. Squared distances decide, by the same expression in both passes.
------------------------------------------------------------------------- */

#include "aleisph_stencil.h"

#include <cmath>
#include <limits>
#include <stdexcept>

namespace aleisph {
namespace {

inline double distance2(int dim, const double *xi, const double *xj)
{
  const double dx = xi[0] - xj[0], dy = xi[1] - xj[1];
  const double dz = dim == 3 ? xi[2] - xj[2] : 0.0;
  return dx * dx + dy * dy + dz * dz;
}

template <class T> double held(const std::vector<T> &v)
{
  return static_cast<double>(v.capacity()) * sizeof(T);
}

inline bool wanted_row(const PairFilter &f, int i)
{
  return !f.role || ((f.role[i] & f.rows) && !(f.role[i] & f.drop));
}

inline bool wanted_column(const PairFilter &f, int j)
{
  return !f.role || !(f.role[j] & f.drop);
}

// row pointers of the pairs within the support; returns the number of coincident pairs
int count_pairs(const Kernel &kernel, const double *const *x, const CandidateList &list,
                const PairFilter &filter, std::vector<int> &ptr)
{
  const int nowned = static_cast<int>(ptr.size()) - 1, dim = kernel.dim();
  const double support2 = kernel.support() * kernel.support();
  int coincident = 0;
  long long pairs = 0;
  ptr[0] = 0;
  for (int i = 0; i < nowned; i++) {
    const int candidates = wanted_row(filter, i) ? list.count[i] : 0;
    for (int m = 0; m < candidates; m++) {
      const int j = list.first[i][m] & list.mask;
      if (!wanted_column(filter, j)) continue;
      const double r2 = distance2(dim, x[i], x[j]);
      if (r2 == 0.0)
        coincident++;
      else if (r2 < support2)
        pairs++;
    }
    if (pairs > std::numeric_limits<int>::max())
      throw std::length_error("too many neighbour pairs for one rank");
    ptr[i + 1] = static_cast<int>(pairs);
  }
  return coincident;
}

}    // namespace

void Stencil::build(const Kernel &kernel, int nowned, const double *const *x,
                    const CandidateList &list, const PairFilter &filter)
{
  dim_ = kernel.dim();
  ptr_.resize(nowned + 1);
  coincident_ = count_pairs(kernel, x, list, filter, ptr_);
  col_.resize(pairs());
  r_.resize(pairs());
  dw_.resize(pairs());
  for (int a = 0; a < 3; a++) e_[a].resize(a < dim_ ? pairs() : 0);

  const double support2 = kernel.support() * kernel.support();
  int k = 0;
  for (int i = 0; i < nowned; i++) {
    const int candidates = wanted_row(filter, i) ? list.count[i] : 0;
    for (int m = 0; m < candidates; m++) {
      const int j = list.first[i][m] & list.mask;
      if (!wanted_column(filter, j)) continue;
      const double r2 = distance2(dim_, x[i], x[j]);
      if (r2 == 0.0 || !(r2 < support2)) continue;
      const double r = std::sqrt(r2);
      col_[k] = j;
      r_[k] = r;
      dw_[k] = kernel.dw(r);
      for (int a = 0; a < dim_; a++) e_[a][k] = (x[i][a] - x[j][a]) / r;
      k++;
    }
  }
}

double Stencil::bytes() const
{
  return held(ptr_) + held(col_) + held(r_) + held(dw_) + held(e_[0]) + held(e_[1]) + held(e_[2]);
}

}    // namespace aleisph
