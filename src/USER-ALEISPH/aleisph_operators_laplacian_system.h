// SPDX-License-Identifier: GPL-2.0-only
/* ----------------------------------------------------------------------
   The systems for B, Morikawa, Tsuji & Asai eq 14, of LANES rows at a time.

   B_i is symmetric, so it has K = 3 (2d) or 6 (3d) unknowns. They are kept
   as the vector beta of its components in the orthonormal basis of the
   symmetric matrices (Mandel's: off-diagonal entries times sqrt 2), so that
   B : S = beta.m(S), and so that neither the system nor its condition
   number depends on the orientation of the axes. With w = V dW/dr and
   m_ij = m(e_ij (x) e_ij):
     A_ij  = 2 w/r beta.m_ij                                            (12)
     P     = sum_k A_ik r_ik = 2 T^t beta,  T = sum_j w m_ij (x) e_ij
     A*_ij = A_ij + P.g_ij                                              (13)
     G^t beta = -m(I),  G = sum_j w r m_ij (x) m_ij + T R^t,
     R     = sum_j r^2 m_ij (x) g_ij                                    (14)
   G is dimensionless; in the limit of many neighbours in the bulk it is
   -(2 id + m(I) m(I)^t)/(D + 2), whose condition number is (D + 2)/2.
------------------------------------------------------------------------- */

#ifndef LMP_ALEISPH_OPERATORS_LAPLACIAN_SYSTEM_H
#define LMP_ALEISPH_OPERATORS_LAPLACIAN_SYSTEM_H

#include "aleisph_operators.h"

#include <array>

namespace aleisph {

// What makes the corrected row of particle i, apart from the scale of w:
//   A*_ij = w (2/r e_ij.B e_ij + q.e_ij),  q = L P
template <int D> struct LaplacianRow {
  double condition = 0.0;                       // of G, see LaplacianWeights::condition()
  std::array<double, D *(D + 1) / 2> b = {};    // B as xx yy xy, in 3d xx yy zz yz xz xy,
                                                // off-diagonal entries twice
  std::array<double, D> q = {};
};

// row[n] of rows[n], n < count. Where the condition number is above max_cond or not finite, only
// the condition number is set.
template <int D>
void solve_laplacian_systems(const Stencil &s, const GradientWeights &g, const int *rows, int count,
                             double max_cond, LaplacianRow<D> *row);

}    // namespace aleisph
#endif
