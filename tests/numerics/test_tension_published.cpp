// SPDX-License-Identifier: GPL-2.0-only
/* ----------------------------------------------------------------------
   Model published of surface tension: its sums against loops written here, and
   contact normals on its contact particles.
------------------------------------------------------------------------- */

#include "aleisph_tension_published.h"

#include "aleisph_vectors.h"
#include "caps.h"
#include "patch.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

using namespace aleisph;
using namespace aleisph_test;

namespace {

constexpr double ROUNDING = 1.0e-12;    // sums of some ten to hundred terms

}    // namespace

class PublishedTest : public testing::TestWithParam<int> {
 protected:
  int dim_ = GetParam();
};

// eq 27 against a loop; K = (dim - 1) kappa, bounded by 1/d
TEST_P(PublishedTest, CurvatureIsTheSumOverTheSurface)
{
  const Patch patch = random_patch(dim_, 4);
  const Cloud &cloud = patch.cloud;
  const Stencil &s = cloud.stencil();
  std::vector<double> K(patch.points.total(), 0.0);
  const CurvatureCount count = published_curvature(cloud, patch.points.rows(), patch.N.data(), 0.41,
                                                   K.data());
  int limited = 0;
  for (int i : patch.points.rows()) {
    double kappa = 0.0;
    for (int k = s.begin(i); k < s.end(i); k++) {
      const int j = s.col()[k];
      if ((cloud.role()[j] & (SURFACE | BALLISTIC)) != SURFACE) continue;
      for (int a = 0; a < dim_; a++)
        kappa += 0.41 * (patch.N[3 * j + a] - patch.N[3 * i + a]) *
            pair_gradient(s, cloud.gradient(), i, k)[a];
    }
    const double expected = (dim_ - 1) * kappa;
    limited += std::abs(expected) > 1.0 / D;
    EXPECT_NEAR(K[i] * D, std::clamp(expected * D, -1.0, 1.0), ROUNDING) << i;
  }
  EXPECT_EQ(count.limited, limited);
  EXPECT_EQ(count.few, 0);
}

// N of contact particles is their contact normal, and N of the others is not
TEST_P(PublishedTest, ContactParticlesHaveTheContactNormal)
{
  const double theta = M_PI / 3.0;
  const CapShape shape = CapShape::of_volume(dim_, 6.0, theta);
  Contact cap(dim_, full_cap(shape, 1), {0.0, 1.0, 0.0}, theta);
  PublishedTension model(0.41);
  cap.measure(model);
  int contacts = 0;
  for (const int i : cap.rows()) {
    if (cap.contact[4 * i + 3] == 0.0) continue;
    for (int a = 0; a < 3; a++) EXPECT_EQ(cap.N[3 * i + a], cap.contact[4 * i + a]);
    EXPECT_NEAR(cap.N[3 * i + 1], std::cos(theta), ROUNDING);
    contacts++;
  }
  EXPECT_EQ(contacts, model.result().contacts);
  EXPECT_GE(contacts, dim_ == 2 ? 2 : 20);
  EXPECT_LT(contacts, cap.surface());
  EXPECT_TRUE(cap.share.empty());
  EXPECT_EQ(model.reach(), 0.0);
}

INSTANTIATE_TEST_SUITE_P(Dimensions, PublishedTest, testing::Values(2, 3));
