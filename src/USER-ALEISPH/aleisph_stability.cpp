// SPDX-License-Identifier: GPL-2.0-only

#include "aleisph_stability.h"

#include "aleisph_operators.h"

#include <algorithm>
#include <cmath>

namespace aleisph {

namespace {

constexpr double PI = 3.14159265358979323846;

// the lattice within the support of one particle at the origin, which comes first
std::vector<std::array<double, 3>> lattice_patch(int dim, int reach, double d)
{
  std::vector<std::array<double, 3>> x = {{0.0, 0.0, 0.0}};
  const int kreach = dim == 3 ? reach : 0;
  for (int k = -kreach; k <= kreach; k++)
    for (int j = -reach; j <= reach; j++)
      for (int i = -reach; i <= reach; i++)
        if (i || j || k) x.push_back({i * d, j * d, k * d});
  return x;
}

double symbol(const Stencil &s, const double *a, const std::array<double, 3> &k)
{
  double mu = 0.0;
  for (int n = s.begin(0); n < s.end(0); n++) {
    double phase = 0.0;
    for (int c = 0; c < s.dim(); c++) phase += k[c] * s.r()[n] * s.e(c)[n];
    mu -= a[n] * (1.0 - std::cos(phase));
  }
  return mu;
}

}    // namespace

double lattice_spectral_radius(const Kernel &kernel, double d)
{
  const int dim = kernel.dim();
  const auto patch = lattice_patch(dim, static_cast<int>(kernel.support() / d) + 1, d);
  std::vector<const double *> x;
  std::vector<int> neighbours;
  for (const auto &point : patch) x.push_back(point.data());
  for (std::size_t j = 1; j < patch.size(); j++) neighbours.push_back(static_cast<int>(j));
  const int count = static_cast<int>(neighbours.size());
  const int *first = neighbours.data();

  Stencil s;
  s.build(kernel, 1, x.data(), {&count, &first, ~0});
  GradientWeights g;
  LaplacianWeights l;
  const double volume = std::pow(d, dim);
  g.build(s, volume);
  l.build(s, g, {0}, volume, kernel, d, LaplacianLimits());

  constexpr int N = 8;    // wave numbers per direction, 0 to pi/d
  double largest = 0.0;
  for (int k = 0; k <= (dim == 3 ? N : 0); k++)
    for (int j = 0; j <= N; j++)
      for (int i = 0; i <= N; i++) {
        const double unit = PI / (N * d);
        largest = std::max(largest, symbol(s, l.a(), {i * unit, j * unit, k * unit}));
      }
  return largest * d * d;
}

}    // namespace aleisph
