// SPDX-License-Identifier: GPL-2.0-only
/* ----------------------------------------------------------------------
   The matrix of implicit viscosity, against the operator that explicit
   viscosity uses.
------------------------------------------------------------------------- */

#include "aleisph_scene.h"
#include "aleisph_solve_viscous.h"
#include "cloud.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

using namespace aleisph;
using namespace aleisph_test;

namespace {

// every particle copies from the first neighbour of its row
class FirstNeighbour : public VelocityCondition {
 public:
  explicit FirstNeighbour(const Stencil &s) : s_(s) {}
  void impose(const Field &) override {}
  int source(int i) const override { return s_.col()[s_.begin(i)]; }

 private:
  const Stencil &s_;
};

}    // namespace

TEST(ViscousSolve, IsTheLaplacianOfFluidAndTheConditionsOfOthers)
{
  for (int dim : {2, 3}) {
    const Kernel kernel(KernelType::CUBIC_SPLINE, dim, H);
    const PointSet points = block(dim, 3, 8);
    const int n = points.owned();
    std::vector<Role> role(n, FLUID);
    for (int j = 0; j < n; j += 4) role[j] = WALL | SLIP;
    for (int j = 1; j < n; j += 4) role[j] = WALL;
    for (int j = 2; j < n; j += 8) role[j] = BUFFER | DIRICHLET;
    Cloud cloud = make_cloud(kernel, D, points, {role});
    FirstNeighbour condition(cloud.stencil());

    const double share = 0.3 * D * D;
    CsrMatrix matrix;
    assemble_viscous(cloud, share, {&condition}, matrix);
    const auto u = random_field(n, 1);
    std::vector<double> product(n), v(3 * n, 0.0), lap(3 * n, 0.0);
    for (int i = 0; i < n; i++) v[3 * i] = u[i];
    matrix.multiply(u.data(), product.data());
    laplacian(cloud, cloud.fluid(), v.data(), lap.data());

    for (int i = 0; i < n; i++) {
      double expected = u[i], sum = 1.0;
      if (role[i] == FLUID) expected -= share * lap[3 * i];
      if (role[i] & BUFFER) expected -= u[condition.source(i)];
      for (int k = matrix.begin(i); k < matrix.end(i); k++) sum += 2.0 * std::fabs(matrix.val(k));
      // sums of up to 200 terms of |u| < 1, in another order
      EXPECT_NEAR(product[i], expected, 200.0 * std::numeric_limits<double>::epsilon() * sum) << i;
    }
  }
}
