// SPDX-License-Identifier: GPL-2.0-only
/* ----------------------------------------------------------------------
   Exact solutions: against independently made tables, against the equation
   by finite differences, boundary and initial values, and across the switch
   between their early and late forms.
   Unless stated, lengths are scaled by the half width or radius and times
   by its square over nu, so that tau = t.
------------------------------------------------------------------------- */

#include "aleisph_exact.h"

#include <gtest/gtest.h>

#include <cmath>
#include <fstream>
#include <functional>
#include <sstream>
#include <string>
#include <vector>

using namespace aleisph::exact;

namespace {

constexpr double PI = 3.14159265358979323846;

using Table = std::vector<std::vector<double>>;

// rows of numbers below the comments and the line of names
Table read_table(const std::string &name)
{
  std::ifstream file(std::string(ALEISPH_TEST_DATA) + "/reference/" + name);
  EXPECT_TRUE(file) << name;
  Table table;
  std::string line;
  while (std::getline(file, line)) {
    if (line.empty() || line[0] == '#' || std::isalpha(line[0])) continue;
    std::istringstream cells(line);
    std::vector<double> row;
    for (std::string cell; std::getline(cells, cell, ',');) row.push_back(std::stod(cell));
    table.push_back(row);
  }
  return table;
}

// the tables have six decimals
constexpr double PRINTED = 0.51e-6;

using Function = std::function<double(double)>;

// fourth order
double first(const Function &f, double x, double e)
{
  return (8.0 * (f(x + e) - f(x - e)) - (f(x + 2 * e) - f(x - 2 * e))) / (12.0 * e);
}

double second(const Function &f, double x, double e)
{
  return (16.0 * (f(x + e) + f(x - e)) - (f(x + 2 * e) + f(x - 2 * e)) - 30.0 * f(x)) /
      (12.0 * e * e);
}

}    // namespace

TEST(Exact, PipeTable)
{
  const Table table = read_table("hagen_poiseuille_startup.csv");
  ASSERT_GT(table.size(), 50u);
  const double R = 5.0e-4, G = 0.5, nu = 1.0e-6, u_max = 0.03125;
  for (const auto &row : table)
    EXPECT_NEAR(pipe_poiseuille(row[1] * R, row[0] * R * R / nu, R, G, nu) / u_max, row[2],
                PRINTED);
}

TEST(Exact, PlaneTable)
{
  const Table table = read_table("plane_poiseuille_startup.csv");
  ASSERT_GT(table.size(), 30u);
  // the table is in units of the whole width h = 2 H, y from a wall
  const double h = 1.0e-3, H = 0.5 * h, G = 1.0e-4, nu = 1.0e-6, u_max = G * h * h / (8.0 * nu);
  for (const auto &row : table)
    EXPECT_NEAR(plane_poiseuille(row[1] * h - H, row[0] * h * h / nu, H, G, nu) / u_max, row[2],
                PRINTED);
}

TEST(Exact, CouetteTable)
{
  const Table table = read_table("couette_startup.csv");
  ASSERT_GT(table.size(), 40u);
  const double H = 1.0e-3, U = 1.25e-5, nu = 1.0e-6;
  for (const auto &row : table)
    EXPECT_NEAR(couette(row[1] * H, row[0] * H * H / nu, H, U, nu) / U, row[2], PRINTED);
}

TEST(Exact, TaylorGreenTable)
{
  const Table table = read_table("taylor_green_decay.csv");
  ASSERT_GT(table.size(), 15u);
  for (const auto &row : table) {
    const double nu = 1.0 / row[0], t = row[1];
    // |u| is largest at x = L/4, y = 0; eight digits are printed
    EXPECT_NEAR(taylor_green({0.25, 0.0, t}, 1.0, 1.0, 1.0, nu).u, row[2], 1.0e-7 * row[2]);
    double energy = 0.0;
    const int n = 16;    // trapezoidal sums of trigonometric polynomials are exact
    for (int i = 0; i < n; i++)
      for (int j = 0; j < n; j++) {
        const Flow2d f = taylor_green({double(i) / n, double(j) / n, t}, 1.0, 1.0, 1.0, nu);
        energy += 0.5 * (f.u * f.u + f.v * f.v) / (n * n);
      }
    EXPECT_NEAR(energy / 0.25, row[3], 1.0e-7 * row[3]);
  }
}

// u_t = G + nu (u_rr + u_r/r). Steps of 1e-3 leave e^4 u^(6)/30 of the second difference, with
// layers of width sqrt(tau) that is about e^4 tau^-2, plus rounding 1e-15/e^2.
TEST(Exact, StartUpEquations)
{
  for (double t : {0.01, 0.019, 0.021, 0.05, 0.2, 1.0})
    for (double y : {0.1, 0.45, 0.7, 0.9}) {
      const double e = 1.0e-3, tolerance = 1.0e-8 + 1.0e-12 / (t * t);
      const Function pipe_r = [t](double r) { return pipe_poiseuille(r, t, 1.0, 4.0, 1.0); };
      const Function pipe_t = [y](double s) { return pipe_poiseuille(y, s, 1.0, 4.0, 1.0); };
      EXPECT_NEAR(first(pipe_t, t, 1e-3 * t), 4.0 + second(pipe_r, y, e) + first(pipe_r, y, e) / y,
                  20.0 * tolerance);
      const Function plane_y = [t](double z) { return plane_poiseuille(z, t, 1.0, 2.0, 1.0); };
      const Function plane_t = [y](double s) { return plane_poiseuille(y, s, 1.0, 2.0, 1.0); };
      EXPECT_NEAR(first(plane_t, t, 1e-3 * t), 2.0 + second(plane_y, y, e), 20.0 * tolerance);
      const Function couette_y = [t](double z) { return couette(z, t, 1.0, 1.0, 1.0); };
      const Function couette_t = [y](double s) { return couette(y, s, 1.0, 1.0, 1.0); };
      EXPECT_NEAR(first(couette_t, t, 1e-3 * t), second(couette_y, y, e), 20.0 * tolerance / t);
    }
}

TEST(Exact, StartUpBoundaryAndInitialValues)
{
  for (double t : {1.0e-8, 1.0e-5, 1.0e-3, 0.015, 0.1, 3.0}) {
    EXPECT_NEAR(pipe_poiseuille(1.0, t, 1.0, 4.0, 1.0), 0.0, 1.0e-13);
    EXPECT_NEAR(plane_poiseuille(1.0, t, 1.0, 2.0, 1.0), 0.0, 1.0e-14);
    EXPECT_NEAR(plane_poiseuille(-1.0, t, 1.0, 2.0, 1.0), 0.0, 1.0e-14);
    EXPECT_NEAR(couette(0.0, t, 1.0, 1.0, 1.0), 0.0, 1.0e-14);
    EXPECT_NEAR(couette(1.0, t, 1.0, 1.0, 1.0), 1.0, 1.0e-14);
  }
  for (double y : {0.0, 0.3, 0.9}) {
    EXPECT_EQ(pipe_poiseuille(y, 0.0, 1.0, 4.0, 1.0), 0.0);
    EXPECT_EQ(plane_poiseuille(y, 0.0, 1.0, 2.0, 1.0), 0.0);
    EXPECT_EQ(couette(y, 0.0, 1.0, 1.0, 1.0), 0.0);
    // away from the walls the fluid first falls freely
    EXPECT_NEAR(pipe_poiseuille(y, 1.0e-7, 1.0, 4.0, 1.0), 4.0e-7, 1.0e-18);
    EXPECT_NEAR(plane_poiseuille(y, 1.0e-7, 1.0, 2.0, 1.0), 2.0e-7, 1.0e-18);
    // the slowest mode is exp(-5.78 t), exp(-2.47 t) and exp(-9.87 t)
    EXPECT_NEAR(pipe_poiseuille(y, 8.0, 1.0, 4.0, 1.0), 1.0 - y * y, 1.0e-14);
    EXPECT_NEAR(plane_poiseuille(y, 16.0, 1.0, 2.0, 1.0), 1.0 - y * y, 1.0e-14);
    EXPECT_NEAR(couette(y, 4.0, 1.0, 1.0, 1.0), y, 1.0e-14);
    EXPECT_DOUBLE_EQ(pipe_poiseuille(y, -1.0, 1.0, 4.0, 1.0), 1.0 - y * y);
    EXPECT_DOUBLE_EQ(plane_poiseuille(y, -1.0, 1.0, 2.0, 1.0), 1.0 - y * y);
    EXPECT_DOUBLE_EQ(couette(y, -1.0, 1.0, 1.0, 1.0), y);
  }
  EXPECT_EQ(couette(1.0, 0.0, 1.0, 7.0, 1.0), 7.0);
}

// Where the early form hands over to the series, both must agree: what is left is the change in
// the tiny interval. In the pipe, where the change is at tau = 40/(1000 pi)^2 = 4e-6, the early
// form neglects a part of u = 4 tau u_max that is of order tau (measured: 0.023 tau).
TEST(Exact, EarlyFormsMeetTheSeries)
{
  const double tau = 40.0 / std::pow(1000.0 * PI, 2);
  for (double y : {0.0, 0.2, 0.6, 0.9, 0.97, 0.995, 0.998, 0.999}) {
    const double e = 1.0e-13;
    EXPECT_NEAR(plane_poiseuille(y, 0.02 - e, 1.0, 2.0, 1.0),
                plane_poiseuille(y, 0.02 + e, 1.0, 2.0, 1.0), 1.0e-12);
    EXPECT_NEAR(couette(y, 0.02 - e, 1.0, 1.0, 1.0), couette(y, 0.02 + e, 1.0, 1.0, 1.0), 1.0e-11);
    EXPECT_NEAR(pipe_poiseuille(y, (1.0 - 1.0e-9) * tau, 1.0, 4.0, 1.0),
                pipe_poiseuille(y, (1.0 + 1.0e-9) * tau, 1.0, 4.0, 1.0),
                8.0e-9 * tau + 0.2 * tau * tau);
  }
}

// The flow rate has a series of its own, 1/2 - sum 16/l^4 exp(-l^2 tau) with J0(l) = 0 (mean over
// the section, u_max = 1), summed here over 4000 zeros, far beyond the code's cut-off. The
// integral over the section is Simpson's: at t = 1e-4 the layer has 40 of its steps.
TEST(Exact, PipeFlowRate)
{
  for (double t : {1.0e-4, 1.0e-3, 1.0e-2, 0.1}) {
    double mean = 0.0;
    const int n = 4000;
    for (int k = 0; k <= n; k++) {
      const double r = double(k) / n, weight = k == 0 || k == n ? 1.0 : k % 2 ? 4.0 : 2.0;
      mean += weight / (3.0 * n) * 2.0 * r * pipe_poiseuille(r, t, 1.0, 4.0, 1.0);
    }
    double series = 0.5;
    for (int k = 1; k <= 4000; k++) {
      // McMahon's expansion with two more terms than in the code, and no Newton step
      const double b = (k - 0.25) * PI, c = 8.0 * b;
      double l = b + 1.0 / c - 124.0 / (3.0 * std::pow(c, 3)) + 120928.0 / (15.0 * std::pow(c, 5)) -
          401743168.0 / (105.0 * std::pow(c, 7));
      if (k == 1) l = 2.404825557695773;
      if (k == 2) l = 5.520078110286311;
      if (k == 3) l = 8.653727912911012;
      series -= 16.0 / std::pow(l, 4) * std::exp(-l * l * t);
    }
    EXPECT_NEAR(mean, series, 1.0e-10);
  }
}

TEST(Exact, TaylorGreenSolvesNavierStokes)
{
  const double L = 2.0, U = 3.0, rho = 5.0, nu = 0.1, e = 1.0e-3;
  for (double x : {0.1, 0.77, 1.6})
    for (double y : {0.3, 1.1})
      for (double t : {0.0, 0.4}) {
        const auto at = [&](double a, double b, double s) {
          return taylor_green({a, b, s}, L, U, rho, nu);
        };
        const Flow2d f = at(x, y, t);
        const auto in_x = [&](double Flow2d::*q) {
          return [=](double a) { return at(a, y, t).*q; };
        };
        const auto in_y = [&](double Flow2d::*q) {
          return [=](double b) { return at(x, b, t).*q; };
        };
        const auto in_t = [&](double Flow2d::*q) {
          return [=](double s) { return at(x, y, s).*q; };
        };
        EXPECT_NEAR(first(in_x(&Flow2d::u), x, e) + first(in_y(&Flow2d::v), y, e), 0.0, 1.0e-9);
        for (double Flow2d::*q : {&Flow2d::u, &Flow2d::v}) {
          const double px = q == &Flow2d::u ? first(in_x(&Flow2d::p), x, e)
                                            : first(in_y(&Flow2d::p), y, e);
          EXPECT_NEAR(first(in_t(q), t, e) + f.u * first(in_x(q), x, e) +
                          f.v * first(in_y(q), y, e),
                      -px / rho + nu * (second(in_x(q), x, e) + second(in_y(q), y, e)), 1.0e-8);
        }
      }
}

TEST(Exact, StokesModeSolvesStokes)
{
  for (double Lx : {0.4, 1.0, 3.0, 20.0}) {
    const double H = 1.0, U = 2.0, rho = 3.0, nu = 0.5;
    const double e = 2.0e-3 * std::min(1.0, Lx);
    const auto at = [&](double a, double b, double s) {
      return stokes_mode({a, b, s}, Lx, H, U, rho, nu);
    };
    const double rate = -first([&](double s) { return at(0.0, 0.5, s).u; }, 0.0, 1.0e-4) / U;
    for (double x : {0.0, 0.15 * Lx, 0.6 * Lx})
      for (double y : {0.05, 0.3, 0.5, 0.9})
        for (double t : {0.0, 1.0 / rate}) {
          const auto in_x = [&](double Flow2d::*q) {
            return [=](double a) { return at(a, y, t).*q; };
          };
          const auto in_y = [&](double Flow2d::*q) {
            return [=](double b) { return at(x, b, t).*q; };
          };
          const auto in_t = [&](double Flow2d::*q) {
            return [=](double s) { return at(x, y, s).*q; };
          };
          // all terms are at most of order rate * U; differences of fourth order
          const double small = 1.0e-7 * rate * U;
          EXPECT_NEAR(first(in_x(&Flow2d::u), x, e) + first(in_y(&Flow2d::v), y, e), 0.0, small);
          for (double Flow2d::*q : {&Flow2d::u, &Flow2d::v}) {
            const double px = q == &Flow2d::u ? first(in_x(&Flow2d::p), x, e)
                                              : first(in_y(&Flow2d::p), y, e);
            EXPECT_NEAR(first(in_t(q), t, 1.0e-3 / rate),
                        -px / rho + nu * (second(in_x(q), x, e) + second(in_y(q), y, e)), small);
          }
        }
  }
}

TEST(Exact, StokesModeBoundaryParityAmplitude)
{
  for (double Lx : {0.01, 0.4, 1.0, 3.0, 20.0, 1.0e3}) {
    const double H = 1.0, U = 2.0;
    const auto at = [&](double x, double y) {
      return stokes_mode({x, y, 0.0}, Lx, H, U, 1.0, 1.0);
    };
    double largest = 0.0;
    for (int i = 0; i <= 20; i++)
      for (int j = 0; j <= 200; j++) {
        const double x = Lx * i / 20.0, y = H * j / 200.0;
        const Flow2d f = at(x, y), mirror = at(x, H - y), shifted = at(x + Lx, y);
        largest = std::max(largest, std::fabs(f.u));
        EXPECT_NEAR(f.u, mirror.u, 1.0e-12 * U);    // symmetric
        EXPECT_NEAR(f.v, -mirror.v, 1.0e-12 * U * std::max(1.0, H / Lx));
        EXPECT_NEAR(f.u, shifted.u, 1.0e-12 * U);    // periodic
        if (j == 0) {
          EXPECT_NEAR(f.u, 0.0, 1.0e-13 * U);
          EXPECT_NEAR(f.v, 0.0, 1.0e-13 * U * std::max(1.0, H / Lx));
        }
      }
    EXPECT_NEAR(largest, U, 1.0e-12 * U);
    EXPECT_NEAR(at(0.0, 0.5 * H).u, U, 1.0e-12 * U);
  }
}

// For very long waves the mode is the second even one of parallel flow, cos(my) - 1 with
// tan(q) = q, q = m H/2 = 4.493409457909064: decay nu (2 q/H)^2. Modes with a mean flow in x
// belong to no wave.
TEST(Exact, StokesModeLongWaveRate)
{
  const double q = 4.493409457909064, nu = 1.0, Lx = 1.0e5;
  const double t = 0.01, ratio = stokes_mode({0.0, 0.5, t}, Lx, 1.0, 1.0, 1.0, nu).u;
  EXPECT_NEAR(-std::log(ratio) / t, 4.0 * q * q * nu, 1.0e-6);
}

// the wall pressure is not linear: this is what the mode is for
TEST(Exact, StokesModeWallPressureGradient)
{
  const double e = 1.0e-3;
  double largest = 0.0;
  for (double x : {0.1, 0.25, 0.6})
    largest = std::max(largest,
                       std::fabs(first(
                           [x](double y) {
                             return stokes_mode({x, y, 0.0}, 1.0, 1.0, 1.0, 1.0, 1.0).p;
                           },
                           0.0, e)));
  EXPECT_GT(largest, 1.0);
}
