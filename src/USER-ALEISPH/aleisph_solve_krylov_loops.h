// SPDX-License-Identifier: GPL-2.0-only
/* ----------------------------------------------------------------------
   The loops of BiCGSTAB over its vectors. Operations on the same vectors share
   one loop, so that each vector is read from memory as few times as possible.
   Sums have four parts in a fixed order: with one part each addition would wait
   for the one before, and a compiler may not reorder them.
   Names as in aleisph_solve_krylov.cpp; no two arguments overlap.
------------------------------------------------------------------------- */

#ifndef LMP_ALEISPH_SOLVE_KRYLOV_LOOPS_H
#define LMP_ALEISPH_SOLVE_KRYLOV_LOOPS_H

#include <cstddef>

namespace aleisph {

// four consecutive entries of a vector; any instruction set will do
#if defined(__GNUC__)
typedef double Quad __attribute__((vector_size(32), aligned(8), may_alias));
#else
typedef double Quad;
#endif

struct EntryAt {
  std::size_t i;
  double operator()(const double *v) const { return v[i]; }
};

// the four from i on
struct QuadAt {
  std::size_t i;
  const Quad &operator()(const double *v) const { return *reinterpret_cast<const Quad *>(v + i); }
};

// sums[m] = sum over i < n of term m; terms(at, out) writes the M terms of what at(vector) gives
template <int M, class Terms> void sum_terms(std::size_t n, double *sums, const Terms &terms)
{
  constexpr std::size_t width = sizeof(Quad) / sizeof(double);
  Quad part[M] = {}, quad[M];
  double term[M];
  std::size_t i = 0;
  for (; i + width <= n; i += width) {
    terms(QuadAt{i}, quad);
    for (int m = 0; m < M; m++) part[m] += quad[m];
  }
  for (int m = 0; m < M; m++) {
    sums[m] = 0.0;
    const double *lane = reinterpret_cast<const double *>(&part[m]);
    for (std::size_t l = 0; l < width; l++) sums[m] += lane[l];
  }
  for (; i < n; i++) {
    terms(EntryAt{i}, term);
    for (int m = 0; m < M; m++) sums[m] += term[m];
  }
}

// a.b, b.b, sum b
inline void product_sums(std::size_t n, const double *a, const double *b, double *sums)
{
  sum_terms<3>(n, sums, [=](auto at, auto *term) {
    const auto b_i = at(b);
    term[0] = at(a) * b_i;
    term[1] = b_i * b_i;
    term[2] = b_i;
  });
}

// t.s, t.t, s.s, sum t, r0.t, r0.s
inline void stabilizer_sums(std::size_t n, const double *t, const double *s, const double *r0,
                            double *sums)
{
  sum_terms<6>(n, sums, [=](auto at, auto *term) {
    const auto t_i = at(t), s_i = at(s), r0_i = at(r0);
    term[0] = t_i * s_i;
    term[1] = t_i * t_i;
    term[2] = s_i * s_i;
    term[3] = t_i;
    term[4] = r0_i * t_i;
    term[5] = r0_i * s_i;
  });
}

// the largest |value(at)| of i < n; a NaN is left to the sums
template <class Value> double largest_size(std::size_t n, const Value &value)
{
  constexpr std::size_t width = sizeof(Quad) / sizeof(double);
  const auto keep_larger = [](auto &largest, const auto v) {
    const auto size = v > -v ? v : -v;
    largest = size > largest ? size : largest;
  };
  Quad lanes = {};
  std::size_t i = 0;
  for (; i + width <= n; i += width) keep_larger(lanes, Quad(value(QuadAt{i})));
  double largest = 0.0;
  const double *lane = reinterpret_cast<const double *>(&lanes);
  for (std::size_t l = 0; l < width; l++) keep_larger(largest, lane[l]);
  for (; i < n; i++) keep_larger(largest, double(value(EntryAt{i})));
  return largest;
}

// r -= alpha (v - mean)
inline void half_step(std::size_t n, double alpha, const double *__restrict__ v, double mean,
                      double *__restrict__ r)
{
  for (std::size_t i = 0; i < n; i++) r[i] -= alpha * (v[i] - mean);
}

// x += alpha y + omega z
inline void advance(std::size_t n, double alpha, const double *__restrict__ y, double omega,
                    const double *__restrict__ z, double *__restrict__ x)
{
  for (std::size_t i = 0; i < n; i++) x[i] += alpha * y[i] + omega * z[i];
}

struct FullStep {
  double alpha, omega, beta, v_mean, t_mean;
};

// x += alpha y + omega z, r -= omega (t - t_mean), p = r + beta (p - omega (v - v_mean))
inline void full_step(std::size_t n, const FullStep &c, const double *__restrict__ y,
                      const double *__restrict__ z, const double *__restrict__ t,
                      const double *__restrict__ v, double *__restrict__ x, double *__restrict__ r,
                      double *__restrict__ p)
{
  const double alpha = c.alpha, omega = c.omega, beta = c.beta;
  const double v_mean = c.v_mean, t_mean = c.t_mean;
  for (std::size_t i = 0; i < n; i++) {
    x[i] += alpha * y[i] + omega * z[i];
    const double next = r[i] - omega * (t[i] - t_mean);
    r[i] = next;
    p[i] = next + beta * (p[i] - omega * (v[i] - v_mean));
  }
}

}    // namespace aleisph
#endif
