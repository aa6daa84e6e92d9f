// SPDX-License-Identifier: GPL-2.0-only
/* ----------------------------------------------------------------------
   The life of a preconditioner: when it is built, kept, built anew, and
   replaced by Jacobi.
------------------------------------------------------------------------- */

#include "aleisph_solve_linear.h"
#include "solver.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <numeric>

using namespace aleisph;
using namespace aleisph_test;

namespace {

// returns what it is told to
class Useless : public Preconditioner {
 public:
  Useless(int rows, double value) : rows_(rows), value_(value) {}
  void apply(const double *, double *z) override { std::fill_n(z, rows_, value_); }

 private:
  int rows_;
  double value_;
};

// the first two rows have changed places
class Swap : public RowTransfer {
 public:
  explicit Swap(std::size_t rows) : rows_(rows) {}
  void to_built(const double *present, double *built) override { swap(present, built); }
  void to_present(const double *built, double *present) override { swap(built, present); }
  int messages() const override { return 0; }
  double message_bytes() const override { return 0.0; }
  double bytes() const override { return 0.0; }

 private:
  void swap(const double *from, double *to) const
  {
    std::copy_n(from, rows_, to);
    std::swap(to[0], to[1]);
  }
  std::size_t rows_;
};

// A solver with a sequence of matrices, and the types that were asked for
class Sequence {
 public:
  explicit Sequence(PrecondType type, int n = 30) : n_(n), ids_(n * n)
  {
    solver_.set_type(type);
    std::iota(ids_.begin(), ids_.end(), 1);
    b_ = random_vector(n * n, 3);
  }

  // -lap u + strength u_x: the next matrix
  void next(double strength)
  {
    matrix_ = std::make_unique<Matrix>(convection_diffusion(n_, strength));
    solver_.matrix_changed(ids_);
  }

  SolveReport solve(double rtol = 1.0e-8, int maxiter = 1000)
  {
    KrylovParams params = tolerance(rtol);
    params.max_iterations = maxiter;
    return solve(params);
  }

  SolveReport solve(const KrylovParams &params)
  {
    x_ = Vector::Zero(n_ * n_);
    SerialOperator op(matrix_->csr());
    const auto make = [this](PrecondType type, PrecondReport &report) {
      made_.push_back(type);
      if (type == broken_) {
        report.failure = "broken";
        return std::unique_ptr<Preconditioner>();
      }
      if (type == useless_)
        return std::unique_ptr<Preconditioner>(std::make_unique<Useless>(n_ * n_, value_));
      return make_preconditioner(type, matrix_->csr(), report);
    };
    return solver_.solve(op, {make, move_}, ip_, b_.data(), x_.data(), params);
  }

  double error() const
  {
    Vector r(b_.size());
    matrix_->csr().multiply(x_.data(), r.data());
    return (b_ - r).norm() / b_.norm();
  }

  LinearSolver &solver() { return solver_; }
  std::vector<std::int64_t> &ids() { return ids_; }
  Vector &b() { return b_; }
  const std::vector<PrecondType> &made() const { return made_; }
  void breaks(PrecondType type) { broken_ = type; }
  void moves_with(LinearSolver::Mover move) { move_ = std::move(move); }
  void is_useless(PrecondType type, double value)
  {
    useless_ = type;
    value_ = value;
  }

 private:
  int n_;
  std::vector<std::int64_t> ids_;
  Vector b_, x_;
  LinearSolver solver_;
  SerialSum ip_;
  std::unique_ptr<Matrix> matrix_;
  std::vector<PrecondType> made_;
  PrecondType broken_ = PrecondType::AMG, useless_ = PrecondType::AMG;
  double value_ = 0.0;
  LinearSolver::Mover move_;
};

using Types = std::vector<PrecondType>;

}    // namespace

TEST(LinearSolver, KeepsWhatWorks)
{
  Sequence steps(PrecondType::ILU0);
  for (int step = 0; step < 10; step++) {
    steps.next(0.1 + 0.001 * step);
    EXPECT_TRUE(steps.solve().ok());
    EXPECT_LE(steps.error(), 1.0e-8);
  }
  EXPECT_EQ(steps.solver().counts().builds, 1);
  EXPECT_EQ(steps.solver().counts().fallbacks, 0);
}

// and for the same matrix whatever it costs
TEST(LinearSolver, OneMatrixOneBuild)
{
  Sequence steps(PrecondType::ILU0);
  steps.next(0.1);
  for (int step = 0; step < 5; step++) {
    steps.b() = random_vector(900, 10 + step);
    EXPECT_TRUE(steps.solve(step % 2 ? 1.0e-2 : 1.0e-12).ok());
  }
  EXPECT_EQ(steps.solver().counts().builds, 1);
}

TEST(LinearSolver, WithoutReuse)
{
  Sequence steps(PrecondType::ILU0);
  steps.solver().set_reuse(false);
  for (int step = 0; step < 4; step++) {
    steps.next(0.1);
    steps.solve();
    steps.solve();
  }
  EXPECT_EQ(steps.solver().counts().builds, 4);
}

// the second attempt has the aim of the first, not a share of what that left
TEST(LinearSolver, FallbackKeepsTheTarget)
{
  Sequence steps(PrecondType::ILU0);
  steps.next(0.1);
  KrylovParams params;
  params.largest = 1.0;
  params.share = 1.0e-3;
  const double target = 1.0e-3 * steps.b().cwiseAbs().maxCoeff();
  params.max_iterations = 200;
  const int needed = steps.solve(params).iterations;
  ASSERT_GT(needed, 4);
  Sequence again(PrecondType::ILU0);
  again.next(0.1);
  params.max_iterations = needed - 2;    // the residual has fallen then
  const SolveReport report = again.solve(params);
  EXPECT_EQ(again.made().back(), PrecondType::JACOBI);
  EXPECT_DOUBLE_EQ(report.target, target);
}

TEST(LinearSolver, CheapOnesAreNotKept)
{
  for (const PrecondType type : {PrecondType::NONE, PrecondType::JACOBI}) {
    Sequence steps(type);
    for (int step = 0; step < 3; step++) {
      steps.next(0.1);
      EXPECT_TRUE(steps.solve().ok());
    }
    EXPECT_EQ(steps.solver().counts().builds, 3);
  }
}

// other rows, the same ones in another order, another type, and when it is told so
TEST(LinearSolver, BuildsAnewForOtherRows)
{
  Sequence steps(PrecondType::ILU0);
  steps.next(0.1);
  steps.solve();
  std::swap(steps.ids()[3], steps.ids()[4]);
  steps.next(0.1);
  steps.solve();
  EXPECT_EQ(steps.solver().counts().builds, 2);
  steps.ids()[899] = 12345;
  steps.next(0.1);
  steps.solve();
  EXPECT_EQ(steps.solver().counts().builds, 3);
  steps.solver().set_type(PrecondType::JACOBI);
  steps.next(0.1);
  steps.solve();
  steps.solver().set_type(PrecondType::ILU0);
  steps.next(0.1);
  steps.solve();
  EXPECT_EQ(steps.solver().counts().builds, 5);
  steps.solver().forget();
  steps.solve();    // still the same matrix
  EXPECT_EQ(steps.solver().counts().builds, 5);
  steps.next(0.1);
  steps.solve();
  EXPECT_EQ(steps.solver().counts().builds, 6);
}

// rows that only changed places are followed, from the build on; others are not
TEST(LinearSolver, FollowsRows)
{
  Sequence steps(PrecondType::ILU0);
  std::vector<RowIds> from;
  bool possible = true;
  steps.moves_with([&](const RowIds &before, const RowIds &) {
    from.push_back(before);
    return possible ? std::make_unique<Swap>(before.size()) : nullptr;
  });
  const RowIds first = steps.ids();
  steps.next(0.1);
  const int iterations = steps.solve().iterations;
  EXPECT_TRUE(from.empty());
  std::swap(steps.ids()[0], steps.ids()[1]);
  for (int step = 0; step < 3; step++) {
    steps.next(0.1);
    EXPECT_NEAR(steps.solve().iterations, iterations, 5);    // two rows are in each other's place
    EXPECT_LE(steps.error(), 1.0e-8);
  }
  EXPECT_EQ(from, std::vector<RowIds>{first});    // they moved once
  EXPECT_EQ(steps.solver().counts().builds, 1);

  possible = false;
  std::swap(steps.ids()[7], steps.ids()[8]);
  steps.next(0.1);
  EXPECT_EQ(steps.solve().iterations, iterations);
  EXPECT_EQ(from, (std::vector<RowIds>{first, first}));
  EXPECT_EQ(steps.solver().counts().builds, 2);
}

// one of rows that have moved, too, is built anew before anything else, for the rows of today
TEST(LinearSolver, NewOneWhenAMovedOneFails)
{
  Sequence steps(PrecondType::ILU0);
  int moves = 0;
  steps.moves_with([&](const RowIds &before, const RowIds &) {
    moves++;
    return std::make_unique<Swap>(before.size());
  });
  steps.next(0.1);
  steps.solve();
  std::swap(steps.ids()[0], steps.ids()[1]);
  steps.next(400.0);    // far off
  EXPECT_TRUE(steps.solve().ok());
  EXPECT_LE(steps.error(), 1.0e-8);
  EXPECT_EQ(steps.made(), (Types{PrecondType::ILU0, PrecondType::ILU0}));
  EXPECT_EQ(steps.solver().counts().fallbacks, 0);
  steps.next(400.0);
  EXPECT_TRUE(steps.solve().ok());
  EXPECT_EQ(moves, 1);
}

// and is forgotten like any other one
TEST(LinearSolver, ForgetsAMovedOne)
{
  Sequence going(PrecondType::ILU0), fresh(PrecondType::ILU0);
  going.moves_with(
      [](const RowIds &before, const RowIds &) { return std::make_unique<Swap>(before.size()); });
  going.next(0.1);
  going.solve();
  std::swap(going.ids()[0], going.ids()[1]);
  going.next(0.1);
  going.solve();
  going.solver().forget();
  for (int step = 0; step < 3; step++) {
    for (Sequence *steps : {&going, &fresh}) steps->next(0.1);
    EXPECT_EQ(going.solve().residual, fresh.solve().residual);
  }
  EXPECT_EQ(going.solver().counts().builds, 2);
}

// The matrix drifts away: iterations rise, and a new one brings them down again. Never more than
// what a new one costs is lost.
TEST(LinearSolver, BuildsAnewWhenIterationsRise)
{
  Sequence steps(PrecondType::ILU0);
  int most = 0, fewest = 1000;
  for (int step = 0; step < 40; step++) {
    steps.next(0.05 * step);
    const auto report = steps.solve();
    ASSERT_TRUE(report.ok());
    most = std::max(most, report.iterations);
    fewest = std::min(fewest, report.iterations);
  }
  EXPECT_GT(steps.solver().counts().builds, 1);
  EXPECT_LT(steps.solver().counts().builds, 30);
  EXPECT_LE(most, 3 * fewest + 10);
  EXPECT_EQ(steps.solver().counts().fallbacks, 0);
}

TEST(LinearSolver, ContinuesAfterForgettingLikeANewOne)
{
  Sequence going(PrecondType::ILU0), fresh(PrecondType::ILU0);
  for (int step = 0; step < 5; step++) {
    going.next(0.1 * step);
    going.solve();
  }
  going.solver().forget();
  for (int step = 5; step < 30; step++) {
    for (Sequence *steps : {&going, &fresh}) steps->next(0.1 * step);
    const auto a = going.solve(), b = fresh.solve();
    EXPECT_EQ(a.iterations, b.iterations);
    EXPECT_EQ(a.residual, b.residual);
  }
}

TEST(LinearSolver, FallsBackToJacobi)
{
  // not a number; a direction that has nothing to do with the residual; zero
  for (const double value : {std::numeric_limits<double>::quiet_NaN(), 1.0, 0.0}) {
    SCOPED_TRACE(value);
    Sequence steps(PrecondType::ILU0);
    steps.is_useless(PrecondType::ILU0, value);
    steps.next(0.1);
    const auto report = steps.solve();
    EXPECT_TRUE(report.ok());
    EXPECT_LE(steps.error(), 1.0e-8);
    EXPECT_EQ(steps.solver().counts().fallbacks, 1);
    EXPECT_EQ(steps.solver().counts().iterations, report.iterations);
    EXPECT_NE(steps.solver().fallback_reason(), nullptr);
    EXPECT_EQ(steps.made(), (Types{PrecondType::ILU0, PrecondType::JACOBI}));

    // the next solve tries again
    steps.is_useless(PrecondType::AMG, 0.0);
    steps.next(0.1);
    EXPECT_TRUE(steps.solve().ok());
    EXPECT_EQ(steps.solver().counts().fallbacks, 1);
    EXPECT_EQ(steps.solver().fallback_reason(), nullptr);
    EXPECT_EQ(steps.made().back(), PrecondType::ILU0);
  }
}

TEST(LinearSolver, FallsBackIfThereIsNone)
{
  Sequence steps(PrecondType::ILU0);
  steps.breaks(PrecondType::ILU0);
  steps.next(0.1);
  EXPECT_TRUE(steps.solve().ok());
  EXPECT_STREQ(steps.solver().fallback_reason(), "broken");
  EXPECT_EQ(steps.solver().counts().fallbacks, 1);
}

// one that was kept is built anew before anything else
TEST(LinearSolver, NewOneBeforeJacobi)
{
  Sequence steps(PrecondType::ILU0);
  steps.is_useless(PrecondType::ILU0, 1.0);
  steps.next(0.1);
  steps.solve();    // with Jacobi in the end
  steps.is_useless(PrecondType::AMG, 0.0);
  steps.next(0.1);
  steps.solve();
  steps.next(400.0);    // far off
  const auto report = steps.solve();
  EXPECT_TRUE(report.ok());
  EXPECT_EQ(steps.made(),
            (Types{PrecondType::ILU0, PrecondType::JACOBI, PrecondType::ILU0, PrecondType::ILU0}));
  EXPECT_EQ(steps.solver().counts().fallbacks, 1);
}

// nothing helps against a right hand side that is not finite, and nothing is tried
TEST(LinearSolver, NotFinite)
{
  Sequence steps(PrecondType::ILU0);
  steps.next(0.1);
  steps.b()[7] = std::numeric_limits<double>::quiet_NaN();
  EXPECT_EQ(steps.solve().status, SolveStatus::NOT_FINITE);
  EXPECT_EQ(steps.made(), Types{PrecondType::ILU0});
  EXPECT_EQ(steps.solver().counts().fallbacks, 0);
}

TEST(LinearSolver, FailureWithJacobiIsAFailure)
{
  Sequence steps(PrecondType::ILU0);
  steps.next(0.1);
  const auto report = steps.solve(1.0e-8, 3);
  EXPECT_EQ(report.status, SolveStatus::MAX_ITERATIONS);
  EXPECT_EQ(report.iterations, 6);
  EXPECT_EQ(steps.solver().counts().fallbacks, 1);
  Sequence jacobi(PrecondType::JACOBI);
  jacobi.next(0.1);
  EXPECT_EQ(jacobi.solve(1.0e-8, 3).iterations, 3);
  EXPECT_EQ(jacobi.solver().counts().fallbacks, 0);
}
