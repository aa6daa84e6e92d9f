// SPDX-License-Identifier: GPL-2.0-only
/* ----------------------------------------------------------------------
   Several ranks as threads: each holds some rows and copies of the others'
   entries that they need.
------------------------------------------------------------------------- */

#include "solver.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <condition_variable>
#include <limits>
#include <mutex>
#include <thread>

using namespace aleisph;
using namespace aleisph_test;

namespace {

constexpr PrecondType PRECONDITIONERS[] = {PrecondType::NONE, PrecondType::JACOBI,
                                           PrecondType::ILU0};

class Team {
 public:
  explicit Team(int size) : size_(size) {}

  void barrier()
  {
    std::unique_lock<std::mutex> lock(mutex_);
    const long round = round_;
    if (++waiting_ == size_) {
      waiting_ = 0;
      round_++;
      all_here_.notify_all();
    } else {
      all_here_.wait(lock, [this, round] { return round_ != round; });
    }
  }

  // in the order of the ranks, so that all get the same bits
  void sum(int rank, int n, double *values)
  {
    parts_[rank].assign(values, values + n);
    barrier();
    for (int k = 0; k < n; k++) {
      values[k] = 0.0;
      for (int r = 0; r < size_; r++) values[k] += parts_[r][k];
    }
    barrier();
  }

  void max(int rank, int n, double *values)
  {
    parts_[rank].assign(values, values + n);
    barrier();
    for (int k = 0; k < n; k++)
      for (int r = 0; r < size_; r++) values[k] = std::max(values[k], parts_[r][k]);
    barrier();
  }

  // gathers the owned entries of all ranks
  void exchange(int first, int n, const double *x, Vector &all)
  {
    for (int i = 0; i < n; i++) shared_[first + i] = x[i];
    barrier();
    all = Eigen::Map<const Vector>(shared_.data(), all.size());
    barrier();
  }

  static constexpr int MAX = 8;

 private:
  int size_, waiting_ = 0;
  long round_ = 0;
  std::mutex mutex_;
  std::condition_variable all_here_;
  std::vector<double> parts_[MAX];
  std::vector<double> shared_ = std::vector<double>(10000);
};

class TeamSum : public InnerProduct {
 public:
  TeamSum(Team &team, int rank) : team_(team), rank_(rank) {}
  void sum(int n, double *values) const override { team_.sum(rank_, n, values); }
  void max(int n, double *values) const override { team_.max(rank_, n, values); }

 private:
  Team &team_;
  int rank_;
};

// rows [first, first + n) of A; columns: these, then all other ones as ghosts
class RankOperator : public LinearOperator {
 public:
  RankOperator(const Sparse &A, int first, int n, Team &team) :
      team_(team), first_(first), n_(n), all_(A.rows())
  {
    ptr_.push_back(0);
    std::vector<double> values, diagonal;
    for (int i = first; i < first + n; i++) {
      for (Sparse::InnerIterator it(A, i); it; ++it)
        if (it.col() != i) {
          col_.push_back(local(static_cast<int>(it.col())));
          values.push_back(it.value());
        }
      ptr_.push_back(static_cast<int>(col_.size()));
      diagonal.push_back(A.coeff(i, i));
    }
    A_.reset(n, ptr_.data(), col_.data());
    for (size_t k = 0; k < values.size(); k++) A_.val(static_cast<int>(k)) = values[k];
    for (int i = 0; i < n; i++) A_.diag(i) = diagonal[i];
  }

  int rows() const override { return n_; }
  int columns() const override { return static_cast<int>(all_.size()); }
  void apply(double *x, double *y) override
  {
    team_.exchange(first_, n_, x, all_);
    for (int j = 0; j < columns(); j++) x[local(j)] = all_[j];
    A_.multiply(x, y);
  }
  const CsrMatrix &csr() const { return A_; }
  int local(int j) const
  {
    return j >= first_ && j < first_ + n_ ? j - first_ : j < first_ ? n_ + j : j;
  }

 private:
  Team &team_;
  int first_, n_;
  Vector all_;
  std::vector<int> ptr_, col_;
  CsrMatrix A_;
};

struct TeamResult {
  std::vector<SolveReport> reports;
  Vector x;
  bool ghosts_valid = true;
};

TeamResult solve_in_team(const Sparse &A, const Vector &b, const std::vector<int> &first,
                         PrecondType type, const KrylovParams &params)
{
  const int size = static_cast<int>(first.size()) - 1, n = static_cast<int>(A.rows());
  Team team(size);
  TeamResult result;
  result.reports.resize(size);
  std::vector<Vector> x(size, Vector::Constant(n, 0.25));
  std::vector<std::vector<double>> global(size);
  std::vector<std::thread> threads;
  for (int rank = 0; rank < size; rank++)
    threads.emplace_back([&, rank] {
      RankOperator op(A, first[rank], first[rank + 1] - first[rank], team);
      PrecondReport unused;
      const auto M = make_preconditioner(type, op.csr(), unused);
      const TeamSum ip(team, rank);
      BiCGStab solver;
      result.reports[rank] = solver.solve(op, *M, ip, b.data() + first[rank], x[rank].data(),
                                          params);
      for (int j = 0; j < n; j++) global[rank].push_back(x[rank][op.local(j)]);
    });
  for (std::thread &t : threads) t.join();
  result.x = Eigen::Map<const Vector>(global[0].data(), n);
  for (int rank = 1; rank < size; rank++) result.ghosts_valid &= global[rank] == global[0];
  return result;
}

}    // namespace

TEST(BiCGStabRanks, AgreeWithOneRank)
{
  const Sparse A = convection_diffusion(20, 0.5);
  const Vector b = random_vector(400, 21);
  for (PrecondType type : PRECONDITIONERS)
    for (const std::vector<int> &first :
         {std::vector<int>{0, 400}, std::vector<int>{0, 170, 400},
          std::vector<int>{0, 170, 170, 400}, std::vector<int>{0, 0, 400}}) {
      const TeamResult team = solve_in_team(A, b, first, type, tolerance(1.0e-11));
      for (const SolveReport &report : team.reports) {
        EXPECT_EQ(report.status, SolveStatus::CONVERGED);
        EXPECT_EQ(report.iterations, team.reports[0].iterations);
        EXPECT_EQ(report.residual, team.reports[0].residual);
      }
      EXPECT_TRUE(team.ghosts_valid);    // on return, on all ranks
      // both have a residual of 1e-11 |b|; the lowest eigenvalue is 4 (1 - cos(pi/21))
      Matrix matrix(A);
      Vector x = Vector::Constant(400, 0.25);
      ASSERT_TRUE(solve(matrix.csr(), type, b, x, tolerance(1.0e-11)).ok());
      EXPECT_LE((team.x - x).norm(), 2.0e-11 * b.norm() / (4.0 * (1.0 - std::cos(M_PI / 21.0))));
    }
}

// the largest entry lies on one rank, and ends the iterations of all
TEST(BiCGStabRanks, LargestEntry)
{
  const Sparse A = convection_diffusion(20, 0.5);
  const Vector b = random_vector(400, 21);
  KrylovParams params;
  params.largest = 1.0e-4;
  for (const std::vector<int> &first :
       {std::vector<int>{0, 400}, std::vector<int>{0, 170, 400}, std::vector<int>{0, 170, 170, 400},
        std::vector<int>{0, 0, 400}}) {
    const TeamResult team = solve_in_team(A, b, first, PrecondType::ILU0, params);
    const double largest = (b - A * team.x).cwiseAbs().maxCoeff();
    EXPECT_LE(largest, params.largest);
    for (const SolveReport &report : team.reports) {
      EXPECT_EQ(report.status, SolveStatus::CONVERGED);
      EXPECT_EQ(report.iterations, team.reports[0].iterations);
      EXPECT_EQ(report.inspected, team.reports[0].inspected);
      EXPECT_NEAR(report.largest, largest, 1.0e-13);
    }
  }
}

TEST(BiCGStabRanks, ClosedSystem)
{
  const Sparse A = closed_interval(90);
  const Vector b = random_vector(90, 22);
  KrylovParams params = tolerance(1.0e-10);
  params.remove_mean = true;
  const TeamResult team = solve_in_team(A, b, {0, 30, 30, 90}, PrecondType::ILU0, params);
  for (const SolveReport &report : team.reports) {
    EXPECT_EQ(report.status, SolveStatus::CONVERGED);
    EXPECT_EQ(report.iterations, team.reports[0].iterations);
    EXPECT_NEAR(report.rhs_mean, b.mean(), 1.0e-14);
  }
  EXPECT_TRUE(team.ghosts_valid);
  const Vector r = b - A * team.x;
  EXPECT_LE((r.array() - r.mean()).matrix().norm(), 1.01e-10 * b.norm());
  EXPECT_NEAR(team.x.mean(), 0.0, 1.0e-12 * team.x.norm());
}

TEST(BiCGStabRanks, AllLeaveTogetherOnNaN)
{
  const Sparse A = convection_diffusion(10, 0.5);
  Vector b = random_vector(100, 23);
  b[99] = std::numeric_limits<double>::quiet_NaN();    // only the last rank sees it
  KrylovParams largest;
  largest.largest = 1.0e-6;
  for (const KrylovParams &params : {KrylovParams(), largest}) {
    const TeamResult team = solve_in_team(A, b, {0, 50, 100}, PrecondType::ILU0, params);
    for (const SolveReport &report : team.reports)
      EXPECT_EQ(report.status, SolveStatus::NOT_FINITE);
  }
}
