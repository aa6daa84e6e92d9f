// SPDX-License-Identifier: GPL-2.0-only
/* ----------------------------------------------------------------------
   Rows that change ranks and places: their values, and a preconditioner that
   was built before.
------------------------------------------------------------------------- */

#include "aleisph_mpi_amg.h"
#include "aleisph_mpi_transfer.h"
#include "rank_matrix.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <numeric>
#include <random>

using namespace aleisph;
using namespace aleisph_test;

namespace {

// of all ranks, from a seed that all have
using Layout = std::vector<RowIds>;

// share: of the IDs that change places
Layout shuffled(Layout layout, double share, unsigned seed)
{
  std::mt19937 random(seed);
  std::vector<std::int64_t *> places;
  for (RowIds &ids : layout)
    for (auto &id : ids)
      if (random() < share * random.max()) places.push_back(&id);
  RowIds moving;
  for (const auto *place : places) moving.push_back(*place);
  std::shuffle(moving.begin(), moving.end(), random);
  for (std::size_t k = 0; k < places.size(); k++) *places[k] = moving[k];
  return layout;
}

void give(RowIds &from, RowIds &to, std::size_t rows)
{
  if (&from == &to) return;
  to.insert(to.begin(), from.end() - rows, from.end());
  from.resize(from.size() - rows);
}

// also the order within a rank
Layout shuffled_within(Layout layout, unsigned seed)
{
  std::mt19937 random(seed);
  for (RowIds &ids : layout) std::shuffle(ids.begin(), ids.end(), random);
  return layout;
}

double value(std::int64_t id)
{
  return 1.0 / static_cast<double>(id);
}

void expect_values(const RowIds &ids, const std::vector<double> &x)
{
  for (std::size_t i = 0; i < ids.size(); i++) EXPECT_EQ(x[i], value(ids[i]));
}

class TransferTest : public testing::Test {
 protected:
  TransferTest() : exchange_(MPI_COMM_WORLD), before_(exchange_.ranks())
  {
    std::int64_t id = 7;    // any numbers, not in order
    for (RowIds &ids : before_)
      for (int i = 0; i < 200; i++) ids.push_back(id += 1 + id % 5);
    before_ = shuffled(before_, 1.0, 1);
  }

  std::unique_ptr<RowTransfer> to(const Layout &after)
  {
    return make_transfer(exchange_, mine(before_), mine(after));
  }

  void expect_transfer(const Layout &after)
  {
    const auto transfer = to(after);
    ASSERT_NE(transfer, nullptr);
    std::vector<double> built(mine(before_).size()), now(mine(after).size());
    std::transform(mine(after).begin(), mine(after).end(), now.begin(), value);
    transfer->to_built(now.data(), built.data());
    expect_values(mine(before_), built);
    std::fill(now.begin(), now.end(), 0.0);
    transfer->to_present(built.data(), now.data());
    expect_values(mine(after), now);
    EXPECT_EQ(transfer->messages() > 0, transfer->message_bytes() > 0.0);
  }

  const RowIds &mine(const Layout &layout) const { return layout[exchange_.rank()]; }
  int ranks() const { return exchange_.ranks(); }

  SparseExchange exchange_;
  Layout before_;
};

}    // namespace

TEST_F(TransferTest, Values)
{
  for (const double share : {0.0, 0.02, 0.05})
    for (const std::size_t given : {0, 10})
      for (const bool within : {false, true}) {
        SCOPED_TRACE(testing::Message() << share << " " << given << " " << within);
        Layout after = shuffled(before_, share, 2);
        give(after.front(), after.back(), given);
        expect_transfer(within ? shuffled_within(after, 3) : after);
      }
}

// before, after, or both
TEST_F(TransferTest, RankWithoutRows)
{
  Layout empty = before_;
  give(empty.back(), empty.front(), ranks() > 1 ? 200 : 0);
  Layout few = empty;
  give(few.front(), few.back(), 15);
  before_ = empty;
  expect_transfer(empty);
  expect_transfer(few);
  before_ = few;
  expect_transfer(empty);
}

// a row that is lost, one that is added, one instead of another: on one rank, and known to all
TEST_F(TransferTest, OtherRowsAreNoTransfer)
{
  Layout less = before_, more = before_, another = before_;
  less.back().pop_back();
  more.front().push_back(2);
  another.front().front() = 2;
  for (const Layout &after : {less, more, another}) EXPECT_EQ(to(after), nullptr);
  EXPECT_NE(to(before_), nullptr);
}

TEST_F(TransferTest, ManyRowsOnOtherRanksAreNoTransfer)
{
  EXPECT_EQ(to(shuffled(before_, 1.0, 4)) == nullptr, ranks() > 1);
}

// -lap u + strength u_x with rows in another order, some of them on other ranks: multigrid and
// ILU(0) that were built before do as well as on the first day
TEST(Transfer, PreconditionerIsThatOfTheSameRows)
{
  constexpr int N = 24, ROWS = N * N;
  const Sparse A = convection_diffusion(N, 0.5);
  std::vector<int> order(ROWS);
  std::iota(order.begin(), order.end(), 0);
  std::mt19937 random(3);
  int ranks;
  MPI_Comm_size(MPI_COMM_WORLD, &ranks);
  for (int r = 0; r < ranks; r++)
    std::shuffle(order.begin() + ROWS / ranks * r, order.begin() + ROWS / ranks * (r + 1), random);
  for (int k = 0; k < 10; k++) std::swap(order[random() % ROWS], order[random() % ROWS]);
  std::vector<Eigen::Triplet<double>> entries;
  for (int i = 0; i < ROWS; i++)
    for (Sparse::InnerIterator it(A, i); it; ++it)
      entries.emplace_back(order[i], order[it.col()], it.value());
  Sparse B(ROWS, ROWS);
  B.setFromTriplets(entries.begin(), entries.end());
  std::vector<int> row_of(ROWS);    // of A, in B
  for (int i = 0; i < ROWS; i++) row_of[order[i]] = i;

  SparseExchange exchange(MPI_COMM_WORLD);
  for (const PrecondType type : {PrecondType::ILU0, PrecondType::AMG}) {
    if (type == PrecondType::AMG && !amg_available()) continue;
    SCOPED_TRACE(to_string(type));
    LinearSolver solver;
    solver.set_type(type);
    const Vector b = random_vector(ROWS, 4);
    const auto solve = [&](const Sparse &matrix, bool moved) {
      RankMatrix rows(matrix);
      RowIds ids(rows.rows());
      for (int i = 0; i < rows.rows(); i++) {
        const int k = rows.first() + i;
        ids[i] = 1 + (moved ? row_of[k] : k);
      }
      std::vector<double> x(rows.columns(), 0.0), rhs(rows.rows());
      for (int i = 0; i < rows.rows(); i++) rhs[i] = b[ids[i] - 1];
      solver.matrix_changed(ids);
      const auto make = [&](PrecondType which, PrecondReport &report) {
        return which == PrecondType::AMG
            ? make_amg(MPI_COMM_WORLD, rows.csr(), rows.global(), AmgOptions(), report)
            : make_preconditioner(which, rows.csr(), report);
      };
      const auto move = [&](const RowIds &before, const RowIds &after) {
        return make_transfer(exchange, before, after);
      };
      const SolveReport report = solver.solve(rows, {make, move}, MpiSum(), rhs.data(), x.data(),
                                              tolerance(1.0e-9));
      EXPECT_TRUE(report.ok());
      Vector r = -matrix * rows.gather(x.data());
      for (int k = 0; k < ROWS; k++) r[k] += b[moved ? row_of[k] : k];
      EXPECT_LE(r.norm(), 1.0e-9 * b.norm());
      return report.iterations;
    };
    const int iterations = solve(A, false);
    // sums in another order
    EXPECT_NEAR(solve(B, true), iterations, 1);
    EXPECT_NEAR(solve(B, true), iterations, 1);
    EXPECT_NEAR(solve(A, false), iterations, 1);
    EXPECT_EQ(solver.counts().builds, 1);
    EXPECT_EQ(solver.counts().fallbacks, 0);
  }
}
