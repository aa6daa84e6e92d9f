// SPDX-License-Identifier: GPL-2.0-only
/* ----------------------------------------------------------------------
   The passes over memory of BiCGSTAB, each doing all that its vectors are
   read for. Sums have four accumulators in a fixed order: one would wait
   for the latency of each addition, and a compiler may not reorder.
   Names as in aleisph_krylov.cpp; no two arguments overlap.
------------------------------------------------------------------------- */

#ifndef LMP_ALEISPH_KRYLOV_LOOPS_H
#define LMP_ALEISPH_KRYLOV_LOOPS_H

#include <cstddef>

namespace aleisph {

// sums[m] = sum over i < n of term m; term(i, out) writes the M terms of i
template <int M, class Terms> void sum_terms(std::size_t n, double *sums, const Terms &terms)
{
  constexpr std::size_t LANES = 4;
  double part[M][LANES] = {}, term[M];
  std::size_t i = 0;
  for (; i + LANES <= n; i += LANES)
    for (std::size_t lane = 0; lane < LANES; lane++) {
      terms(i + lane, term);
      for (int m = 0; m < M; m++) part[m][lane] += term[m];
    }
  for (; i < n; i++) {
    terms(i, term);
    for (int m = 0; m < M; m++) part[m][0] += term[m];
  }
  for (int m = 0; m < M; m++) sums[m] = (part[m][0] + part[m][1]) + (part[m][2] + part[m][3]);
}

// a.b, b.b, sum b
inline void product_sums(std::size_t n, const double *a, const double *b, double *sums)
{
  sum_terms<3>(n, sums, [=](std::size_t i, double *term) {
    term[0] = a[i] * b[i];
    term[1] = b[i] * b[i];
    term[2] = b[i];
  });
}

// t.s, t.t, s.s, sum t, r0.t, r0.s
inline void stabilizer_sums(std::size_t n, const double *t, const double *s, const double *r0,
                            double *sums)
{
  sum_terms<6>(n, sums, [=](std::size_t i, double *term) {
    term[0] = t[i] * s[i];
    term[1] = t[i] * t[i];
    term[2] = s[i] * s[i];
    term[3] = t[i];
    term[4] = r0[i] * t[i];
    term[5] = r0[i] * s[i];
  });
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
