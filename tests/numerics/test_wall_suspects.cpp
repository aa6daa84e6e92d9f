// SPDX-License-Identifier: GPL-2.0-only
/* ----------------------------------------------------------------------
   Walls that the pressure equation suffers from are found, others are not.
------------------------------------------------------------------------- */

#include "aleisph_wall_suspects.h"
#include "scenes.h"

#include <gtest/gtest.h>

using namespace aleisph;
using namespace aleisph_test;

namespace {

WallSuspects suspects(const Scene &scene)
{
  return wall_suspects(Discretized(scene, LaplacianLimits(), false).cloud());
}

void expect_none(const Scene &scene)
{
  const WallSuspects found = suspects(scene);
  EXPECT_EQ(found.dense, -1);
  EXPECT_EQ(found.sparse, -1);
  EXPECT_EQ(found.facing, -1);
}

// a row of wall particles in 2d, so many spacings apart, at height y, that looks up or down
void add_row(Scene &scene, double apart, double y, double up)
{
  for (int i = 0; i < 8; i++) scene.add({apart * i, y, 0.0}, WALL, {0.0, up, 0.0}, 1);
}

}    // namespace

TEST(WallSuspects, NoneInScenesThatAreLaidOutWell)
{
  for (const int dim : {2, 3}) {
    expect_none(closed_box(dim, 6));
    expect_none(box_obstacle(dim, 6));
  }
  expect_none(cylinder(2, 5.0, 1.0, true));
}

TEST(WallSuspects, DenseAndSparse)
{
  for (const double apart : {0.5, 1.0, 1.6}) {
    Scene scene;
    add_row(scene, apart, 0.0, 1.0);
    const WallSuspects found = suspects(scene);
    EXPECT_EQ(found.dense >= 0, apart < WallSuspects::DENSE) << apart;
    EXPECT_EQ(found.sparse >= 0, apart > WallSuspects::SPARSE) << apart;
    EXPECT_EQ(found.facing, -1) << apart;
  }
}

// plates (the lower face looks down) and gaps (it looks up); the support is 2.4 spacings
TEST(WallSuspects, FacesWithinTheSupport)
{
  for (const double up : {1.0, -1.0})
    for (const double thickness : {2.0, 3.0}) {
      Scene scene;
      add_row(scene, 1.0, 0.0, up);
      add_row(scene, 1.0, thickness, -up);
      EXPECT_EQ(suspects(scene).facing >= 0, thickness < 2.4) << up << ' ' << thickness;
    }
}
