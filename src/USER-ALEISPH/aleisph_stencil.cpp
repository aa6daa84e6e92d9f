// SPDX-License-Identifier: GPL-2.0-only
/* ----------------------------------------------------------------------
   Row by row: the candidates within the support are picked first, by their
   squared distance and without branches; then a loop over these alone, which
   the compiler can vectorise, computes what is stored.
   From step to step the number of pairs hardly changes, so the arrays keep
   their size; when they do not suffice the pairs are counted to the end and
   the arrays made to fit.
------------------------------------------------------------------------- */

#include "aleisph_stencil.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <stdexcept>

namespace aleisph {
namespace {

// arrays are made this much longer than needed, and shortened when they are longer than that
constexpr double SPARE = 1.02, TOO_LONG = 1.2;

template <class T> double held(const std::vector<T> &v)
{
  return static_cast<double>(v.capacity()) * sizeof(T);
}

inline bool wanted_row(const PairFilter &f, int i)
{
  return !f.role || ((f.role[i] & f.rows) && !(f.role[i] & f.drop));
}

// the pairs of one row
struct Picked {
  std::vector<int> j;
  std::array<std::vector<double>, 3> dx;
  std::vector<double> r2, inverse;
  void resize(std::size_t n)
  {
    j.resize(n);
    r2.resize(n);
    inverse.resize(n);
    for (auto &component : dx) component.resize(n);
  }
};

}    // namespace

class Stencil::Builder {
 public:
  Builder(Stencil &s, const Kernel &kernel, const double *const *x, const CandidateList &list,
          const PairFilter &filter) :
      s_(s),
      kernel_(kernel), x_(x), list_(list), filter_(filter),
      support2_(kernel.support() * kernel.support())
  {
  }

  // fills the rows as far as the arrays go; returns the number of all pairs
  long long run(int nowned)
  {
    return kernel_.with_shape([this, nowned](auto shape) {
      return s_.dim_ == 2 ? rows<2, decltype(shape)>(nowned) : rows<3, decltype(shape)>(nowned);
    });
  }

 private:
  template <int D, class Shape> long long rows(int nowned)
  {
    const auto longest = std::max_element(list_.count, list_.count + nowned);
    picked_.resize(nowned > 0 ? *longest : 0);
    s_.coincident_ = s_.close_ = 0;
    long long pairs = 0;
    for (int i = 0; i < nowned; i++) {
      const int n = wanted_row(filter_, i) ? pick<D>(i) : 0;
      if (pairs + n <= static_cast<long long>(s_.slots()))
        store<D, Shape>(static_cast<int>(pairs), n);
      pairs += n;
      if (pairs > std::numeric_limits<int>::max())
        throw std::length_error("too many neighbour pairs for one rank");
      s_.ptr_[i + 1] = static_cast<int>(pairs);
    }
    return pairs;
  }

  template <int D> int pick(int i)
  {
    const double *const xi = x_[i];
    const int *const first = list_.first[i];
    const int count = list_.count[i], mask = list_.mask;
    const Role *const role = filter_.role;
    double *const r2 = picked_.r2.data();
    int *const picked = picked_.j.data();
    double *dx[D];
    for (int a = 0; a < D; a++) dx[a] = picked_.dx[a].data();
    const double close2 = s_.close2_;
    int n = 0, coincident = 0, close = 0;
    for (int m = 0; m < count; m++) {
      const int j = first[m] & mask;
      const double *const xj = x_[j];
      double square = 0.0;
      for (int a = 0; a < D; a++) {
        const double difference = xi[a] - xj[a];
        dx[a][n] = difference;
        square += difference * difference;
      }
      r2[n] = square;
      picked[n] = j;
      const bool wanted = !role || !(role[j] & filter_.drop);
      coincident += wanted && square == 0.0;
      close += wanted && square <= close2;
      n += wanted && square < support2_ && square > 0.0;
    }
    s_.coincident_ += coincident;
    s_.close_ += close;
    return n;
  }

  template <int D, class Shape> void store(int begin, int n)
  {
    const double inverse_h = kernel_.inverse_h(), norm = kernel_.slope_norm();
    const double *const r2 = picked_.r2.data();
    double *const r = s_.r_.data() + begin, *const dw = s_.dw_.data() + begin;
    double *const inverse = picked_.inverse.data();
    for (int m = 0; m < n; m++) {
      const double length = std::sqrt(r2[m]);
      r[m] = length;
      inverse[m] = 1.0 / length;
      dw[m] = norm * Shape::slope(length * inverse_h);
    }
    for (int a = 0; a < D; a++) {
      const double *const dx = picked_.dx[a].data();
      double *const e = s_.e_[a].data() + begin;
      for (int m = 0; m < n; m++) e[m] = dx[m] * inverse[m];
    }
    int *const col = s_.col_.data() + begin;
    for (int m = 0; m < n; m++) col[m] = picked_.j[m];
    if (list_.canonical)
      for (int m = 0; m < n; m++) col[m] = list_.canonical[col[m]];
  }

  Stencil &s_;
  const Kernel &kernel_;
  const double *const *x_;
  const CandidateList &list_;
  const PairFilter &filter_;
  const double support2_;
  Picked picked_;
};

void Stencil::set_slots(std::size_t n)
{
  // not resize() alone: nothing of the old contents is needed, and a vector keeps its capacity
  const auto fit = [](auto &v, std::size_t size) {
    std::remove_reference_t<decltype(v)>().swap(v);
    v.resize(size);
  };
  fit(col_, n);
  fit(r_, n);
  fit(dw_, n);
  for (int a = 0; a < 3; a++) fit(e_[a], a < dim_ ? n : 0);
}

void Stencil::build(const Kernel &kernel, int nowned, const double *const *x,
                    const CandidateList &list, const PairFilter &filter)
{
  if (dim_ != kernel.dim()) set_slots(0);
  dim_ = kernel.dim();
  ptr_.resize(nowned + 1);
  ptr_[0] = 0;
  Builder builder(*this, kernel, x, list, filter);
  const auto pairs = static_cast<double>(builder.run(nowned));
  if (pairs <= slots() && slots() <= TOO_LONG * pairs) return;
  set_slots(static_cast<std::size_t>(SPARE * pairs));
  builder.run(nowned);
}

double Stencil::bytes() const
{
  return held(ptr_) + held(col_) + held(r_) + held(dw_) + held(e_[0]) + held(e_[1]) + held(e_[2]);
}

}    // namespace aleisph
