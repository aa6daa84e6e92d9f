// SPDX-License-Identifier: GPL-2.0-only

#include "aleisph_lattice.h"

#include "aleisph_operators.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>

namespace aleisph {

namespace {

constexpr double PI = 3.14159265358979323846;
constexpr double INF = std::numeric_limits<double>::infinity();
constexpr LaplacianLimits NO_LIMITS = {0.0, INF, -INF, INF, 0.0};

// the lattice points within the support of the first one, which is the origin
std::vector<double> lattice_points(const Kernel &kernel, double d, bool corner)
{
  const int n = static_cast<int>(std::ceil(kernel.support() / d)), low = corner ? 0 : -n;
  const bool deep = kernel.dim() == 3;
  std::vector<double> x = {0.0, 0.0, 0.0};
  for (int k = deep ? low : 0; k <= (deep ? n : 0); k++)
    for (int j = low; j <= n; j++)
      for (int i = low; i <= n; i++)
        if (i != 0 || j != 0 || k != 0) x.insert(x.end(), {i * d, j * d, k * d});
  return x;
}

// of the particle at the origin of the lattice, or of its corner
Stencil lattice_stencil(const Kernel &kernel, double d, bool corner)
{
  std::vector<double> points = lattice_points(kernel, d, corner);
  const int n = static_cast<int>(points.size()) / 3;
  std::vector<double *> x(n);
  for (int j = 0; j < n; j++) x[j] = &points[3 * j];
  std::vector<int> others(n - 1);
  std::iota(others.begin(), others.end(), 1);
  const int count = n - 1, *first = others.data();
  Stencil stencil;
  stencil.build(kernel, 1, x.data(), {&count, &first, ~0});
  return stencil;
}

// the one row of the Laplacian of the particle at the origin
class LatticeRow {
 public:
  LatticeRow(const Kernel &kernel, double d) : stencil_(lattice_stencil(kernel, d, false))
  {
    GradientWeights g;
    g.build(stencil_, std::pow(d, kernel.dim()));
    laplacian_.build(stencil_, g, {0}, laplacian_bounds(NO_LIMITS, kernel, d));
  }

  double diagonal() const { return laplacian_.diagonal(0); }

  double mu(const std::array<double, 3> &k) const
  {
    double sum = 0.0;
    for (int n = stencil_.begin(0); n < stencil_.end(0); n++) {
      double phase = 0.0;
      for (int c = 0; c < stencil_.dim(); c++) phase += k[c] * stencil_.r()[n] * stencil_.e(c)[n];
      sum -= laplacian_.a()[n] * (1.0 - std::cos(phase));
    }
    return sum;
  }

 private:
  Stencil stencil_;
  LaplacianWeights laplacian_;
};

}    // namespace

double lattice_diagonal(const Kernel &kernel, double d)
{
  return -d * d * LatticeRow(kernel, d).diagonal();
}

double lattice_spectral_radius(const Kernel &kernel, double d)
{
  const LatticeRow row(kernel, d);
  constexpr int N = 8;    // wave numbers per direction, 0 to pi/d
  const double unit = PI / (N * d);
  double largest = 0.0;
  for (int k = 0; k <= (kernel.dim() == 3 ? N : 0); k++)
    for (int j = 0; j <= N; j++)
      for (int i = 0; i <= N; i++)
        largest = std::max(largest, row.mu({i * unit, j * unit, k * unit}));
  return largest * d * d;
}

double lattice_corner_lambda(const Kernel &kernel, double d)
{
  GradientWeights g;
  g.build(lattice_stencil(kernel, d, true), std::pow(d, kernel.dim()));
  return g.lambda(0);
}

}    // namespace aleisph
