// SPDX-License-Identifier: GPL-2.0-only
/* ----------------------------------------------------------------------
   The layer between the particles of a free surface and the surface follows the
   flow.
------------------------------------------------------------------------- */

#include "aleisph_surface_layer.h"

#include "aleisph_surface.h"
#include "cloud.h"

#include <gtest/gtest.h>

#include <cmath>

using namespace aleisph;
using namespace aleisph_test;

namespace {

constexpr double ROUNDING = 1.0e-14;
constexpr int ROWS = 6, COLUMNS = 15;

// Six rows of fluid; the top and bottom ones are on the surface
struct Slab {
  Slab() :
      points(positions(), ROWS * COLUMNS, 2.4 * D),
      cloud(make_cloud(kernel(), D, points))
  {
    grad.assign(9 * points.points().size(), 0.0);
    layer.assign(2 * points.points().size(), 0.0);
    detect_surface(cloud, SurfaceParams());
    rows = layered_rows(cloud);
  }

  static Kernel kernel() { return Kernel(KernelType::CUBIC_SPLINE, 2, H); }
  static Points positions()
  {
    Points x;
    for (int j = 0; j < ROWS; j++)
      for (int i = 0; i < COLUMNS; i++) x.push_back({i * D, j * D, 0.0});
    return x;
  }

  // v = rate (-x, y)
  void stretch(double rate)
  {
    for (std::size_t i = 0; i < points.points().size(); i++) {
      grad[9 * i] = -rate;
      grad[9 * i + 4] = rate;
    }
  }

  int follow(double dt, const double *u = nullptr)
  {
    return follow_layer(cloud, rows, grad.data(), u, dt, layer.data());
  }

  static constexpr int TOP = (ROWS - 1) * COLUMNS + COLUMNS / 2;
  static constexpr int INSIDE = (ROWS / 2) * COLUMNS + COLUMNS / 2, CORNER = 0;

  PointSet points;
  Cloud cloud;
  std::vector<double> grad, layer;
  Rows rows;
};

}    // namespace

// Of a smooth surface only: neither inside nor at edges
TEST(SurfaceLayer, IsThatOfSmoothSurfaces)
{
  const Slab slab;
  EXPECT_EQ(count_rows(slab.rows, [](int i) { return i == Slab::TOP; }), 1);
  EXPECT_EQ(count_rows(slab.rows, [](int i) { return i == Slab::INSIDE || i == Slab::CORNER; }), 0);
}

// da/dt = a N.(grad v).N: exponential, to second order in the time step
TEST(SurfaceLayer, FollowsTheStrain)
{
  double error[2];
  for (int run = 0; run < 2; run++) {
    Slab slab;
    const int steps = 10 << run;
    const double dt = 0.1 / steps;
    double exact = 0.0;
    slab.layer[2 * Slab::TOP + 1] = dt * std::cos(-dt * 10.0);    // the step before
    for (int n = 0; n < steps; n++) {
      slab.stretch(std::cos(10.0 * n * dt));
      EXPECT_EQ(slab.follow(dt), 0);
      exact = 0.1 * std::sin(10.0 * (n + 1) * dt);
    }
    error[run] = std::fabs(slab.layer[2 * Slab::TOP] - exact);
  }
  EXPECT_LT(error[0], 1.0e-3);
  EXPECT_NEAR(error[0] / error[1], 4.0, 0.5);
}

// A particle that is shifted outward is nearer to a surface that stays where it is; shifts along the
// surface only make the layer forget
TEST(SurfaceLayer, StaysUnderShifts)
{
  Slab slab;
  std::vector<double> u(3 * slab.points.points().size(), 0.0);
  constexpr double DT = 0.01, SHIFT = 0.02 * D;
  u[3 * Slab::TOP + 1] = SHIFT / DT;
  slab.follow(DT, u.data());
  const double forgets = 1.0 + SurfaceLayer::RELAXATION * 0.02;
  EXPECT_NEAR(slab.layer[2 * Slab::TOP], -SHIFT / (0.5 * D) / forgets, ROUNDING);

  u[3 * Slab::TOP + 1] = 0.0;
  u[3 * Slab::TOP] = SHIFT / DT;
  const double before = slab.layer[2 * Slab::TOP];
  slab.follow(DT, u.data());
  EXPECT_NEAR(slab.layer[2 * Slab::TOP], before / forgets, ROUNDING);
}

// It has a limit, and what reaches it is counted; what is off the surface has no layer
TEST(SurfaceLayer, IsLimited)
{
  Slab slab;
  slab.layer[2 * Slab::INSIDE] = slab.layer[2 * Slab::INSIDE + 1] = 0.1;
  slab.stretch(1.0);
  EXPECT_EQ(slab.follow(1.0), static_cast<int>(slab.rows.size()));
  EXPECT_EQ(slab.layer[2 * Slab::TOP], SurfaceLayer::MAX_STRETCH);
  EXPECT_EQ(slab.layer[2 * Slab::INSIDE], 0.0);
  EXPECT_EQ(slab.layer[2 * Slab::INSIDE + 1], 0.0);
  slab.stretch(-1.0);
  slab.follow(1.0);
  EXPECT_EQ(slab.layer[2 * Slab::TOP], -SurfaceLayer::MAX_STRETCH);
}
