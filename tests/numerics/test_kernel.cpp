// SPDX-License-Identifier: GPL-2.0-only
/* ----------------------------------------------------------------------
   Every kernel in two and three dimensions: normalisation, moments of the
   gradient, slope, values in the centre and at the support.
------------------------------------------------------------------------- */

#include "aleisph_kernel.h"

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <functional>
#include <limits>
#include <stdexcept>
#include <tuple>

using namespace aleisph;

namespace {

constexpr double PI = 3.14159265358979323846;
constexpr double H = 0.37;    // any value that is not 1

// Integral of f(r) over the support. The kernels are polynomials of degree 8 at most
// between multiples of h; with the surface element and r^2, degree 12. Eight Gauss points
// are exact up to degree 15.
double integrate(const Kernel &kernel, const std::function<double(double)> &f)
{
  static constexpr std::array<double, 4> NODE = {0.183434642495649805, 0.525532409916328986,
                                                 0.796666477413626740, 0.960289856497536232};
  static constexpr std::array<double, 4> WEIGHT = {0.362683783378361983, 0.313706645877887287,
                                                   0.222381034453374471, 0.101228536290376259};
  const int pieces = static_cast<int>(std::lround(kernel.support() / kernel.h()));
  double sum = 0.0;
  for (int p = 0; p < pieces; p++)
    for (int g = 0; g < 4; g++)
      for (int sign : {-1, 1})
        sum += 0.5 * WEIGHT[g] * f((p + 0.5 + 0.5 * sign * NODE[g]) * kernel.h());
  return sum * kernel.h();
}

double surface(int dim, double r)
{
  return dim == 2 ? 2.0 * PI * r : 4.0 * PI * r * r;
}

class KernelTest : public ::testing::TestWithParam<std::tuple<KernelType, int>> {
 protected:
  KernelType type() const { return std::get<0>(GetParam()); }
  int dim() const { return std::get<1>(GetParam()); }
  Kernel kernel() const { return Kernel(type(), dim(), H); }
};

// W(0) h^dim from the closed forms in the literature
double centre(KernelType type, int dim)
{
  const bool flat = dim == 2;
  switch (type) {
    case KernelType::CUBIC_SPLINE: return flat ? 10.0 / (7.0 * PI) : 1.0 / PI;
    case KernelType::QUINTIC_SPLINE:    // 3^5 - 6 2^5 + 15 = 66
      return 66.0 * (flat ? 7.0 / (478.0 * PI) : 1.0 / (120.0 * PI));
    case KernelType::WENDLAND_C2: return flat ? 7.0 / (4.0 * PI) : 21.0 / (16.0 * PI);
    case KernelType::WENDLAND_C4: return flat ? 9.0 / (4.0 * PI) : 495.0 / (256.0 * PI);
  }
  return 0.0;
}

}    // namespace

TEST_P(KernelTest, IntegralIsOne)
{
  const Kernel k = kernel();
  const double sum = integrate(k, [&](double r) { return surface(k.dim(), r) * k.w(r); });
  EXPECT_NEAR(sum, 1.0, 1e-14);    // exact quadrature: rounding of a dozen terms
}

// The zeroth moment of gradW vanishes by symmetry. The first is the integral of
// gradW (x) r = -I; its trace is the integral of W' r over space = -dim. The third,
// the integral of W' r^3, equals -(dim + 2) times the second moment of W.
TEST_P(KernelTest, MomentsOfTheGradient)
{
  const Kernel k = kernel();
  const double first = integrate(k, [&](double r) { return surface(k.dim(), r) * k.dw(r) * r; });
  EXPECT_NEAR(first, -k.dim(), 1e-13);
  const double third = integrate(
      k, [&](double r) { return surface(k.dim(), r) * k.dw(r) * r * r * r; });
  const double second = integrate(k,
                                  [&](double r) { return surface(k.dim(), r) * k.w(r) * r * r; });
  EXPECT_NEAR(third, -(k.dim() + 2) * second, 1e-13);
}

// Central differences with step s: error s^2/6 |W'''| + eps |W|/s. |W'''| h^3 is below 100 W(0)
// for every kernel here, so that s = 1e-5 h gives an error below 2e-9 + 1e-10 of W(0)/h.
TEST_P(KernelTest, SlopeIsTheDerivative)
{
  const Kernel k = kernel();
  const double scale = k.w(0.0) / H, s = 1e-5 * H;
  for (int n = 1; n < 400; n++) {
    const double r = n / 400.0 * k.support();
    const double difference = (k.w(r + s) - k.w(r - s)) / (2.0 * s);
    EXPECT_NEAR(k.dw(r), difference, 2e-9 * scale) << "r/h = " << r / H;
  }
}

TEST_P(KernelTest, DecreasesAndIsPositiveInside)
{
  const Kernel k = kernel();
  for (int n = 1; n < 400; n++) {
    const double r = n / 400.0 * k.support();
    EXPECT_GT(k.w(r), 0.0);
    EXPECT_LT(k.dw(r), 0.0);
  }
}

TEST_P(KernelTest, CentreAndSupport)
{
  const Kernel k = kernel();
  const double w0 = centre(type(), dim()) / std::pow(H, dim());
  EXPECT_NEAR(k.w(0.0), w0, 4e-16 * 4.0 * w0);    // a handful of roundings
  EXPECT_EQ(k.dw(0.0), 0.0);
  EXPECT_EQ(k.support(), Kernel::support_over_h(type()) * H);
  EXPECT_EQ(k.h(), H);
  for (double r : {k.support(), 1.0001 * k.support(), 10.0 * k.support()}) {
    EXPECT_EQ(k.w(r), 0.0);
    EXPECT_EQ(k.dw(r), 0.0);
  }
  // W and W' vanish continuously, W' at least as the square of the distance to the support
  const double inside = k.support() * (1.0 - 1e-4);
  EXPECT_LT(k.w(inside), 1e-9 * k.w(0.0));
  EXPECT_LT(-k.dw(inside), 1e-6 * k.w(0.0) / H);
}

INSTANTIATE_TEST_SUITE_P(
    AllKernels, KernelTest,
    ::testing::Combine(::testing::Values(KernelType::CUBIC_SPLINE, KernelType::QUINTIC_SPLINE,
                                         KernelType::WENDLAND_C2, KernelType::WENDLAND_C4),
                       ::testing::Values(2, 3)));

// The sum of d^dim W over the full lattice of spacing d = h/1.2, cubic spline: 1/1.0002 in
// 2d and 1/0.9992 in 3d (an independent prototype gave these four digits).
TEST(Kernel, LatticeSum)
{
  const double expected[] = {1.0 / 1.0002, 1.0 / 0.9992};
  for (int dim : {2, 3}) {
    const Kernel k(KernelType::CUBIC_SPLINE, dim, 1.2);
    const int n = 3, nz = dim == 3 ? n : 0;
    double sum = 0.0;
    for (int x = -n; x <= n; x++)
      for (int y = -n; y <= n; y++)
        for (int z = -nz; z <= nz; z++) sum += k.w(std::sqrt(x * x + y * y + z * z));
    EXPECT_NEAR(sum, expected[dim - 2], 6e-5) << dim;    // half of the last digit
  }
}

TEST(Kernel, NamesAreParsed)
{
  KernelType type = KernelType::WENDLAND_C4;
  EXPECT_TRUE(Kernel::parse("cubic-spline", type));
  EXPECT_EQ(type, KernelType::CUBIC_SPLINE);
  EXPECT_TRUE(Kernel::parse("quintic-spline", type));
  EXPECT_EQ(type, KernelType::QUINTIC_SPLINE);
  EXPECT_TRUE(Kernel::parse("wendland-c2", type));
  EXPECT_EQ(type, KernelType::WENDLAND_C2);
  EXPECT_TRUE(Kernel::parse("wendland-c4", type));
  EXPECT_EQ(type, KernelType::WENDLAND_C4);
  EXPECT_FALSE(Kernel::parse("gauss", type));
  EXPECT_FALSE(Kernel::parse("", type));
  EXPECT_EQ(type, KernelType::WENDLAND_C4);
  EXPECT_STREQ(Kernel::names(), "cubic-spline, quintic-spline, wendland-c2, wendland-c4");
}

TEST(Kernel, BadArgumentsThrow)
{
  const double nan = std::numeric_limits<double>::quiet_NaN();
  const double inf = std::numeric_limits<double>::infinity();
  EXPECT_THROW(Kernel(KernelType::CUBIC_SPLINE, 1, 1.0), std::invalid_argument);
  EXPECT_THROW(Kernel(KernelType::CUBIC_SPLINE, 4, 1.0), std::invalid_argument);
  for (double h : {0.0, -1.0, nan, inf})
    EXPECT_THROW(Kernel(KernelType::CUBIC_SPLINE, 3, h), std::invalid_argument) << h;
  EXPECT_THROW(Kernel(static_cast<KernelType>(17), 3, 1.0), std::invalid_argument);
}
