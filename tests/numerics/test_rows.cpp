// SPDX-License-Identifier: GPL-2.0-only
// Running over rows: each row once, sums in the order of the rows, lists, blocks.

#include "aleisph_rows.h"

#include <gtest/gtest.h>

namespace {

using namespace aleisph;

const Rows ROWS = {7, 2, 5, 11};
const auto is_odd = [](int i) { return i % 2 == 1; };

TEST(Rows, each_is_run_once)
{
  std::vector<int> calls(12, 0);
  for_rows(ROWS, [&calls](int i) { calls[i]++; });
  EXPECT_EQ(calls, (std::vector<int>{0, 0, 1, 0, 0, 1, 0, 1, 0, 0, 0, 1}));
}

TEST(Rows, number_stands_for_the_first_rows)
{
  std::vector<int> calls(4, 0);
  for_rows(3, [&calls](int i) { calls[i]++; });
  EXPECT_EQ(calls, (std::vector<int>{1, 1, 1, 0}));
  EXPECT_EQ(sum_rows(4, [](int i) { return i; }), 6);
  EXPECT_EQ(select_rows(5, is_odd), (Rows{1, 3}));
  EXPECT_EQ(count_rows(0, is_odd), 0);
}

// 1 is lost in 2^53 + 1 = 2^53, but not in 1 + 1 + 2^53: any other order gives another sum
TEST(Rows, sum_is_in_the_order_of_the_rows)
{
  constexpr double large = 9007199254740992.0;
  const double value[] = {1.0, 1.0, large, -large};
  const auto sum = [&value](const Rows &rows) {
    return sum_rows(rows, [&value](int i) { return value[i]; });
  };
  EXPECT_EQ(sum({0, 1, 2, 3}), 2.0);
  EXPECT_EQ(sum({2, 0, 1, 3}), 0.0);
  EXPECT_EQ(sum({0, 2, 1, 3}), 0.0);
  EXPECT_EQ(sum({2, 3, 0, 1}), 2.0);
  EXPECT_EQ(sum({}), 0.0);
}

struct Tally {
  int rows = 0;
  double total = 0.0;
  Tally &operator+=(const Tally &other)
  {
    rows += other.rows;
    total += other.total;
    return *this;
  }
};

TEST(Rows, several_sums_at_once)
{
  const Tally tally = sum_rows(ROWS, [](int i) { return Tally{1, 0.5 * i}; });
  EXPECT_EQ(tally.rows, 4);
  EXPECT_EQ(tally.total, 12.5);
}

TEST(Rows, count)
{
  EXPECT_EQ(count_rows(ROWS, is_odd), 3);
  EXPECT_EQ(count_rows(Rows(), is_odd), 0);
  // whatever is true counts once
  EXPECT_EQ(count_rows(ROWS, [](int i) { return i & ~1; }), 4);
}

TEST(Rows, extremes_and_their_bounds)
{
  const auto value = [](int i) { return 0.1 * i; };
  EXPECT_EQ(max_rows(ROWS, value, 0.0), value(11));
  EXPECT_EQ(max_rows(ROWS, value, 5.0), 5.0);
  EXPECT_EQ(min_rows(ROWS, value, 5.0), value(2));
  EXPECT_EQ(min_rows(ROWS, value, 0.0), 0.0);
  EXPECT_EQ(max_rows(Rows(), value, -3.0), -3.0);
  // of the type of the bound
  EXPECT_EQ(max_rows(
                ROWS, [](int i) { return i; }, 0L),
            11L);
}

TEST(Rows, selected_keep_their_order)
{
  EXPECT_EQ(select_rows(ROWS, is_odd), (Rows{7, 5, 11}));
  EXPECT_EQ(select_rows(ROWS, [](int) { return false; }), Rows());
}

TEST(Rows, blocks_hold_all_rows_in_their_order)
{
  std::vector<Rows> blocks;
  const auto keep = [&blocks](const int *rows, int n) {
    blocks.emplace_back(rows, rows + n);
    return n;
  };
  EXPECT_EQ(sum_blocks<3>(ROWS, keep), 4);
  EXPECT_EQ(blocks, (std::vector<Rows>{{7, 2, 5}, {11}}));
  blocks.clear();
  EXPECT_EQ(sum_blocks<2>(4, keep), 4);
  EXPECT_EQ(blocks, (std::vector<Rows>{{0, 1}, {2, 3}}));
  blocks.clear();
  EXPECT_EQ(sum_blocks<8>(0, keep), 0);
  EXPECT_EQ(sum_blocks<8>(Rows(), keep), 0);
  EXPECT_TRUE(blocks.empty());
}

}    // namespace
