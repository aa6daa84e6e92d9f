// SPDX-License-Identifier: GPL-2.0-only

#include "solver.h"

#include <random>

namespace aleisph_test {

using namespace aleisph;

Vector random_vector(int n, unsigned seed)
{
  std::mt19937 random(seed);
  std::uniform_real_distribution<double> deviate(-1.0, 1.0);
  Vector v(n);
  for (int i = 0; i < n; i++) v[i] = deviate(random);
  return v;
}

Sparse diagonally_dominant(int n, unsigned seed)
{
  std::mt19937 random(seed);
  std::uniform_real_distribution<double> deviate(-1.0, 1.0);
  std::uniform_int_distribution<int> column(0, n - 1);
  Sparse A(n, n);
  for (int i = 0; i < n; i++) {
    for (int k = 0; k < 8; k++) A.coeffRef(i, column(random)) = deviate(random);
    A.coeffRef(i, i) = 0.0;
    A.coeffRef(i, i) = A.row(i).cwiseAbs().sum() + 0.1;
  }
  A.makeCompressed();
  return A;
}

Sparse convection_diffusion(int n, double cell_peclet)
{
  std::vector<Eigen::Triplet<double>> entries;
  const auto index = [n](int i, int j) { return i + n * j; };
  for (int j = 0; j < n; j++)
    for (int i = 0; i < n; i++) {
      entries.emplace_back(index(i, j), index(i, j), 4.0);
      if (i > 0) entries.emplace_back(index(i, j), index(i - 1, j), -1.0 - 0.5 * cell_peclet);
      if (i < n - 1) entries.emplace_back(index(i, j), index(i + 1, j), -1.0 + 0.5 * cell_peclet);
      if (j > 0) entries.emplace_back(index(i, j), index(i, j - 1), -1.0);
      if (j < n - 1) entries.emplace_back(index(i, j), index(i, j + 1), -1.0);
    }
  Sparse A(n * n, n * n);
  A.setFromTriplets(entries.begin(), entries.end());
  return A;
}

Sparse closed_interval(int n)
{
  Sparse A(n, n);
  for (int i = 0; i < n; i++) {
    const double scale = i == 0 ? 3.0 : 1.0;
    for (int j : {i - 1, i + 1}) {
      if (j < 0 || j >= n) continue;
      A.coeffRef(i, j) = -scale;
      A.coeffRef(i, i) += scale;
    }
  }
  A.makeCompressed();
  return A;
}

KrylovParams tolerance(double rtol)
{
  KrylovParams params;
  params.rtol = rtol;
  return params;
}

}    // namespace aleisph_test
