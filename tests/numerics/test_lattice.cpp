// SPDX-License-Identifier: GPL-2.0-only
/* ----------------------------------------------------------------------
   Explicit limit of the viscous term. On the lattice B is a multiple of the
   unit matrix and the first-order correction vanishes, both by symmetry, so
   that a_0j is proportional to W'(r)/r with the factor that makes lap x^2 = 2.
   The spectrum of that closed form on a finer grid of wave vectors is the
   reference.
------------------------------------------------------------------------- */

#include "aleisph_lattice.h"
#include "cloud.h"

#include <algorithm>
#include <cmath>
#include <gtest/gtest.h>

namespace {

using namespace aleisph;
using namespace aleisph_test;

double closed_form_radius(const Kernel &kernel, double d)
{
  const int dim = kernel.dim();
  const Points points = lattice(dim, static_cast<int>(kernel.support() / d) + 1, d);
  std::vector<double> a(points.size(), 0.0);
  double second_moment = 0.0;
  for (std::size_t j = 1; j < points.size(); j++) {
    const Point &x = points[j];
    const double r = std::sqrt(x[0] * x[0] + x[1] * x[1] + x[2] * x[2]);
    a[j] = kernel.dw(r) / r;
    second_moment -= a[j] * x[0] * x[0];
  }
  constexpr int N = 16;
  double largest = 0.0;
  for (int i = 0; i <= N; i++)
    for (int j = 0; j <= i; j++)
      for (int k = 0; k <= (dim == 3 ? j : 0); k++) {
        double mu = 0.0;
        for (std::size_t n = 1; n < points.size(); n++) {
          const Point &x = points[n];
          const double unit = 3.14159265358979323846 / (N * d);
          mu -= a[n] * (1.0 - std::cos(unit * (i * x[0] + j * x[1] + k * x[2])));
        }
        largest = std::max(largest, 2.0 * mu / second_moment);
      }
  return largest * d * d;
}

// The grid of 8 wave numbers per direction is half of the reference's. The maximum lies on or near
// the edge of the zone, where mu is flat; next to it a step of pi/(8 d) changes mu by less than
// (pi/16)^2/2 = 2 % of its size.
// Cubic spline, h = 1.2 d, 2d: M_11 = M_22 = m, M_12 = c, lambda = m - c, from the neighbours at
// (1,0) (0,1) (1,1) (2,0) (0,2) (2,1) (1,2) with w = -V dW/dr r at q = r/1.2
TEST(Lattice, CornerLambda)
{
  const double h = 1.2, scale = 10.0 / (7.0 * M_PI * h * h * h);
  const auto w = [&](double r) {
    const double q = r / h;
    return scale * r * (q < 1.0 ? 3.0 * q - 2.25 * q * q : 0.75 * (2.0 - q) * (2.0 - q));
  };
  const double r5 = std::sqrt(5.0), r2 = std::sqrt(2.0);
  const double m = w(1.0) + w(2.0) + 0.5 * w(r2) + w(r5), c = 0.5 * w(r2) + 0.8 * w(r5);
  EXPECT_NEAR(lattice_corner_lambda(Kernel(KernelType::CUBIC_SPLINE, 2, H), D), m - c, 1e-12);
}

TEST(Lattice, SpectralRadiusAgreesWithTheClosedForm)
{
  for (const KernelType type : KERNELS)
    for (const int dim : {2, 3})
      for (const double h_over_d : {1.0, 1.2, 1.5}) {
        const Kernel kernel(type, dim, h_over_d * D);
        const double reference = closed_form_radius(kernel, D);
        const double radius = lattice_spectral_radius(kernel, D);
        EXPECT_LE(radius, reference * (1.0 + 1.0e-12));
        EXPECT_GE(radius, reference * 0.98);
      }
}

// an eigenvalue computation of the matrix of a channel in 2d gave 4.04 (three digits)
TEST(Lattice, SpectralRadiusMatchesTheMatrixOfAChannel)
{
  EXPECT_NEAR(lattice_spectral_radius(Kernel(KernelType::CUBIC_SPLINE, 2, H), D), 4.04, 0.005);
}

TEST(Lattice, SpectralRadiusDoesNotDependOnTheUnitOfLength)
{
  for (const int dim : {2, 3}) {
    const double one = lattice_spectral_radius(Kernel(KernelType::WENDLAND_C2, dim, 1.2), 1.0);
    EXPECT_NEAR(lattice_spectral_radius(Kernel(KernelType::WENDLAND_C2, dim, 1.2e-5), 1.0e-5), one,
                1.0e-9 * one);
  }
}

}    // namespace
