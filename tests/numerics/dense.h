// SPDX-License-Identifier: GPL-2.0-only
/* ----------------------------------------------------------------------
   One row of the corrected operators, written down directly from Morikawa,
   Tsuji & Asai eqs 8-14 with all tensor indices and Gaussian elimination in
   long double: slow, and independent of the code under test except for the
   kernel.
------------------------------------------------------------------------- */

#ifndef ALEISPH_TEST_DENSE_H
#define ALEISPH_TEST_DENSE_H

#include "cloud.h"

namespace aleisph_test {

struct DenseRow {
  std::vector<Point> g;      // g_ij, one per point of the cloud; zero for strangers
  std::vector<double> a;     // A*_ij
  double lambda = 0.0;       // smallest eigenvalue of M
  double condition = 0.0;    // 2-norm condition number of the map B -> B:[...] of eq. 14
};

DenseRow dense_row(const aleisph::Kernel &kernel, double volume, const PointSet &cloud, int i);

}    // namespace aleisph_test
#endif
