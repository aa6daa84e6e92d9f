// SPDX-License-Identifier: GPL-2.0-only
/* ----------------------------------------------------------------------
   Truncation error of the corrected gradient and Laplacian in the interior
   of a cloud, for a product of sines.
   The lattice is point symmetric, so that odd moments cancel: both are of
   second order. On a jittered cloud they do not: the gradient (exact for
   linear fields) and the Laplacian (exact for quadratic ones) are of first
   order. The jitter of 0.2 d is the same random cloud at every spacing, so
   that the only deviation from the order is the next term of the series.
------------------------------------------------------------------------- */

#include "cloud.h"

#include <gtest/gtest.h>

#include <cmath>

using namespace aleisph;
using namespace aleisph_test;

namespace {

struct Wave {
  double value, laplacian;
  Point gradient;
};

Wave wave(const Point &p)
{
  const double sx = std::sin(2.0 * p[0] + 0.9), cx = 2.0 * std::cos(2.0 * p[0] + 0.9);
  const double sy = std::sin(1.5 * p[1] + 0.8), cy = 1.5 * std::cos(1.5 * p[1] + 0.8);
  const double sz = std::sin(p[2] + 1.1), cz = std::cos(p[2] + 1.1);
  return {
      sx * sy * sz, -(4.0 + 2.25 + 1.0) * sx * sy * sz, {cx * sy * sz, sx * cy * sz, sx * sy * cz}};
}

struct Errors {
  double gradient, laplacian;    // root mean square
};

// at the particles within 3 d of the origin
Errors errors(KernelType type, int dim, double d, double amplitude)
{
  const Kernel kernel(type, dim, 1.2 * d);
  Points points = lattice(dim, 3 + static_cast<int>(std::ceil(kernel.support() / d)) + 1, d);
  int owned = 0;
  while (std::hypot(points[owned][0], points[owned][1], points[owned][2]) < 3.01 * d) owned++;
  jitter(points, dim, amplitude * d, 17);
  const PointSet cloud(points, owned, kernel.support());
  const Discrete op(kernel, d, cloud);

  // in 2d the wave is constant in z
  const double kz = dim == 2 ? 1.0 : 0.0;
  std::vector<double> f, v;
  for (const Point &p : cloud.points()) {
    f.push_back(wave(p).value);
    v.insert(v.end(), {wave(p).value, 0.0, 0.0});
  }
  std::vector<double> grad(3 * owned), lap(3 * owned);
  gradient(op.cloud(), cloud.rows(), f.data(), grad.data());
  laplacian(op.cloud(), cloud.rows(), v.data(), lap.data());

  Errors e = {0.0, 0.0};
  for (int i = 0; i < owned; i++) {
    const Wave exact = wave(cloud.point(i));
    for (int a = 0; a < dim; a++)
      e.gradient += std::pow(grad[3 * i + a] - exact.gradient[a], 2) / owned;
    e.laplacian += std::pow(lap[3 * i] - (exact.laplacian + kz * exact.value), 2) / owned;
  }
  return {std::sqrt(e.gradient), std::sqrt(e.laplacian)};
}

// three spacings, each half of the one before
void expect_order(KernelType type, int dim, double d, double amplitude, double order, double tol)
{
  const Errors e[] = {errors(type, dim, d, amplitude), errors(type, dim, d / 2.0, amplitude),
                      errors(type, dim, d / 4.0, amplitude)};
  for (int n = 0; n < 2; n++) {
    EXPECT_NEAR(std::log2(e[n].gradient / e[n + 1].gradient), order, tol)
        << "gradient, " << dim << "d, kernel " << static_cast<int>(type);
    EXPECT_NEAR(std::log2(e[n].laplacian / e[n + 1].laplacian), order, tol)
        << "Laplacian, " << dim << "d, kernel " << static_cast<int>(type);
  }
}

}    // namespace

// The next term is smaller by (2 d)^2 < 0.01.
TEST(Convergence, SecondOrderOnTheLattice)
{
  for (int dim : {2, 3})
    for (KernelType type : KERNELS) expect_order(type, dim, 0.04, 0.0, 2.0, 0.03);
}

// The next term, of second order, is smaller by c d with c of about 10 (the jitter is small
// against d); smaller spacings would show the rounding error eps/d^2 of the Laplacian.
TEST(Convergence, FirstOrderWithJitter)
{
  for (int dim : {2, 3})
    for (KernelType type : KERNELS) expect_order(type, dim, 0.004, 0.2, 1.0, 0.1);
}
