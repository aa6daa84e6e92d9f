// SPDX-License-Identifier: GPL-2.0-only
// Fields that know whether their ghosts are valid

#include "aleisph_fields.h"

#include <gtest/gtest.h>

using namespace aleisph;

TEST(Field, KnowsWhetherItsGhostsAreValid)
{
  double data[] = {1.0, 2.0, 3.0, 4.0, 5.0, 6.0};    // one owned particle and a ghost
  bool valid = false;
  const Field field(data, 3, valid);
  EXPECT_EQ(field.width(), 3);
  EXPECT_FALSE(field.ghosts_valid());
  EXPECT_EQ(field.owned(), data);
  EXPECT_FALSE(field.ghosts_valid()) << "reading changes nothing";

  EXPECT_EQ(field.exchanged(), data);
  EXPECT_TRUE(field.ghosts_valid());
  EXPECT_EQ(field.all(), data);

  const Field again(data, 3, valid);    // another handle of the same field
  EXPECT_TRUE(again.ghosts_valid());
  EXPECT_EQ(again.edit(), data);
  EXPECT_FALSE(field.ghosts_valid());
}

#ifndef NDEBUG
TEST(FieldDeathTest, StaleGhostsAreNotRead)
{
  double data[] = {1.0};
  bool valid = true;
  const Field field(data, 1, valid);
  field.edit();
  EXPECT_DEATH(field.all(), "");
}
#endif
