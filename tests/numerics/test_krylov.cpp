// SPDX-License-Identifier: GPL-2.0-only

#include "solver.h"

#include <gtest/gtest.h>

#include <Eigen/Dense>
#include <Eigen/SparseLU>

#include <cmath>
#include <limits>
#include <random>

using namespace aleisph;
using namespace aleisph_test;

namespace {

constexpr double EPS = std::numeric_limits<double>::epsilon();
constexpr double NOT_A_NUMBER = std::numeric_limits<double>::quiet_NaN();
constexpr PrecondType PRECONDITIONERS[] = {PrecondType::NONE, PrecondType::JACOBI,
                                           PrecondType::ILU0};

Sparse from_rows(const std::vector<std::vector<double>> &rows)
{
  const int n = static_cast<int>(rows.size());
  Sparse A(n, n);
  for (int i = 0; i < n; i++)
    for (int j = 0; j < n; j++) A.coeffRef(i, j) = rows[i][j];
  A.makeCompressed();
  return A;
}

double smallest_singular_value(const Sparse &A)
{
  const Eigen::MatrixXd dense(A);
  return std::sqrt(
      Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd>(dense.transpose() * dense).eigenvalues()[0]);
}

}    // namespace

TEST(Csr, ProductAndMemory)
{
  const Sparse A = diagonally_dominant(50, 1);
  Matrix matrix(A);
  const Vector x = random_vector(50, 2);
  Vector y(50);
  matrix.csr().multiply(x.data(), y.data());
  // rows of nine terms of order one, summed in another order
  EXPECT_LE((y - A * x).cwiseAbs().maxCoeff(), 9.0 * 8.0 * EPS);
  EXPECT_GE(matrix.csr().bytes(), sizeof(double) * A.nonZeros());
  matrix.csr().reset(0, nullptr, nullptr);
  EXPECT_EQ(matrix.csr().rows(), 0);
  matrix.csr().multiply(nullptr, nullptr);
}

// The same bits, whatever is done in between
TEST(Csr, SubsetsOfRowsAgreeWithTheProduct)
{
  const int n = 60, ghosts = 9;
  Sparse A = diagonally_dominant(n + ghosts, 4);
  Matrix square(A);
  CsrMatrix &full = square.csr();
  std::vector<int> ptr = {0}, col;
  for (int i = 0; i < n; i++) {
    for (int k = full.begin(i); k < full.end(i); k++) col.push_back(full.col(k));
    ptr.push_back(static_cast<int>(col.size()));
  }
  CsrMatrix matrix;
  matrix.reset(n, ptr.data(), col.data());
  for (int i = 0; i < n; i++) {
    matrix.diag(i) = full.diag(i);
    for (int k = matrix.begin(i); k < matrix.end(i); k++) matrix.val(k) = full.val(k);
  }
  Vector x = random_vector(n + ghosts, 5), whole(n), parts = Vector::Constant(n, NOT_A_NUMBER);
  matrix.multiply(x.data(), whole.data());

  std::vector<char> awaited(ghosts, 1);
  awaited[2] = awaited[7] = 0;
  const RowSplit split = split_rows(n, ptr.data(), col.data(), awaited);
  EXPECT_EQ(split.interior.rows() + split.boundary.rows(), n);
  EXPECT_GT(split.interior.rows(), 5);
  EXPECT_GT(split.boundary.rows(), 5);
  const Vector arrived = x;
  for (int g = 0; g < ghosts; g++)
    if (awaited[g]) x[n + g] = NOT_A_NUMBER;
  matrix.multiply(split.interior, x.data(), parts.data());
  for (const RowRuns::Run &run : split.boundary.runs())
    for (int i = run.begin; i < run.end; i++) {
      EXPECT_TRUE(std::isnan(parts[i]));
      bool waits = false;
      for (int k = ptr[i]; k < ptr[i + 1]; k++) waits |= col[k] >= n && awaited[col[k] - n];
      EXPECT_TRUE(waits);
    }
  matrix.multiply(split.boundary, arrived.data(), parts.data());
  EXPECT_EQ(parts, whole);
}

// rows of 0 to 20 entries of very different size
TEST(Csr, RowSumIsTheProductWithOnes)
{
  Sparse A(21, 21);
  for (int i = 0; i < 21; i++)
    for (int j = 0; j < i; j++) A.coeffRef(i, j) = std::sin(7.0 * i + j) * std::exp(3.0 * (j % 5));
  A.makeCompressed();
  Matrix matrix(A);
  Vector y(21);
  for (int i = 0; i < 21; i++) matrix.csr().diag(i) = -matrix.csr().row_sum(i);
  matrix.csr().multiply(Vector::Ones(21).eval().data(), y.data());
  EXPECT_EQ(y, Vector::Zero(21));
  EXPECT_NEAR(matrix.csr().row_sum(20), A.row(20).sum(), 1.0e-15 * A.row(20).cwiseAbs().sum() * 20);
}

TEST(BiCGStab, RandomSystemsAgreeWithDenseElimination)
{
  for (unsigned seed = 1; seed <= 5; seed++)
    for (PrecondType type : PRECONDITIONERS) {
      const Sparse A = diagonally_dominant(150, seed);
      const Vector b = random_vector(150, seed + 100);
      const Vector exact = Eigen::MatrixXd(A).partialPivLu().solve(b);
      Matrix matrix(A);
      Vector x = random_vector(150, seed + 200);
      const double initial = (b - A * x).norm();
      const SolveReport report = solve(matrix.csr(), type, b, x, tolerance(1.0e-10));
      ASSERT_EQ(report.status, SolveStatus::CONVERGED) << to_string(report.status);
      // what the solver says is true, to the rounding error of a residual
      const double noise = 20.0 * EPS * (b.norm() + A.norm() * x.norm());
      EXPECT_NEAR(report.residual, (b - A * x).norm(), noise);
      EXPECT_NEAR(report.initial_residual, initial, noise);
      EXPECT_NEAR(report.rhs_norm, b.norm(), 100.0 * EPS * b.norm());
      EXPECT_NEAR(report.rhs_mean, b.mean(), 100.0 * EPS);
      EXPECT_LE(report.residual, 1.0e-10 * report.rhs_norm);
      // |x - exact| <= |A^-1| |b - A x|
      EXPECT_LE((x - exact).norm(), (report.residual + noise) / smallest_singular_value(A));
    }
}

TEST(BiCGStab, ConvectionDiffusionAgreesWithSparseElimination)
{
  for (double peclet : {0.0, 0.5, 1.9})
    for (PrecondType type : PRECONDITIONERS) {
      const Sparse A = convection_diffusion(24, peclet);
      const Vector b = random_vector(24 * 24, 7);
      Eigen::SparseLU<Eigen::SparseMatrix<double>> lu{Eigen::SparseMatrix<double>(A)};
      const Vector exact = lu.solve(b);
      Matrix matrix(A);
      Vector x = Vector::Zero(b.size());
      const SolveReport report = solve(matrix.csr(), type, b, x, tolerance(1.0e-11));
      ASSERT_TRUE(report.ok()) << to_string(report.status);
      // symmetric part -lap: smallest eigenvalue 4 (1 - cos(pi/25)) bounds |A^-1| from above
      const double lowest = 4.0 * (1.0 - std::cos(M_PI / 25.0));
      EXPECT_LE((x - exact).norm(), (1.0e-11 + 100.0 * EPS) * b.norm() / lowest);
    }
}

TEST(BiCGStab, GoodGuessNeedsNoIteration)
{
  const Sparse A = diagonally_dominant(80, 3);
  const Vector exact = random_vector(80, 4), b = A * exact;
  Matrix matrix(A);
  Vector x = exact;
  const SolveReport report = solve(matrix.csr(), PrecondType::ILU0, b, x, tolerance(1.0e-12));
  EXPECT_EQ(report.status, SolveStatus::CONVERGED);
  EXPECT_EQ(report.iterations, 0);
  EXPECT_EQ(x, exact);
}

TEST(BiCGStab, ZeroRightHandSideGivesZero)
{
  Matrix matrix(diagonally_dominant(30, 5));
  for (double atol : {0.0, 1.0e3}) {
    Vector x = random_vector(30, 6);
    KrylovParams params;
    params.atol = atol;
    const SolveReport report = solve(matrix.csr(), PrecondType::JACOBI, Vector::Zero(30), x,
                                     params);
    EXPECT_EQ(report.status, SolveStatus::ZERO_RHS);
    EXPECT_TRUE(report.ok());
    EXPECT_EQ(report.iterations, 0);
    EXPECT_EQ(report.residual, 0.0);
    EXPECT_EQ(x, Vector::Zero(30));
  }
}

// what is left of a constant b is rounding error, which is no right-hand side
TEST(BiCGStab, ConstantRightHandSideOfClosedSystemIsZero)
{
  Matrix matrix(closed_interval(1001));
  KrylovParams params;
  params.remove_mean = true;
  for (double value : {1.0, 0.1, -1.0e7 / 3.0}) {
    Vector x = random_vector(1001, 6);
    const Vector b = Vector::Constant(1001, value);
    const SolveReport report = solve(matrix.csr(), PrecondType::ILU0, b, x, params);
    EXPECT_EQ(report.status, SolveStatus::ZERO_RHS);
    EXPECT_NEAR(report.rhs_mean, value, 4.0 * EPS * std::fabs(value));
    EXPECT_EQ(x, Vector::Zero(1001));
  }
}

TEST(BiCGStab, AbsoluteTolerance)
{
  const Sparse A = convection_diffusion(10, 0.5);
  Matrix matrix(A);
  const Vector b = random_vector(100, 8);
  KrylovParams params;
  params.rtol = 1.0e-14;
  params.atol = 1.0e-3;
  Vector x = Vector::Zero(100);
  const SolveReport report = solve(matrix.csr(), PrecondType::JACOBI, b, x, params);
  EXPECT_EQ(report.status, SolveStatus::CONVERGED);
  EXPECT_LE(report.residual, 1.0e-3);
  EXPECT_GT(report.residual, 1.0e-14 * report.rhs_norm);    // it did not go on for rtol

  const Vector guess = random_vector(100, 9) * 1.0e-5;
  x = guess;
  EXPECT_EQ(solve(matrix.csr(), PrecondType::JACOBI, b * 1.0e-5, x, params).iterations, 0);
  EXPECT_EQ(x, guess);
}

// No entry is above the bound in the end, and some entry was in every iteration before: those are
// the x of solves that are limited to fewer iterations. The norm of the residual need not obey it.
TEST(BiCGStab, LargestEntryEndsTheSolve)
{
  const Sparse A = convection_diffusion(24, 0.5);
  Matrix matrix(A);
  const Vector b = random_vector(24 * 24, 3);
  int norm_above = 0;
  for (PrecondType type : PRECONDITIONERS)
    for (double bound : {0.2, 1.0e-2, 1.0e-5, 1.0e-9}) {
      KrylovParams params;
      params.largest = bound;
      Vector x = Vector::Zero(b.size());
      const SolveReport report = solve(matrix.csr(), type, b, x, params);
      ASSERT_EQ(report.status, SolveStatus::CONVERGED);
      const Vector r = b - A * x;
      const double noise = 20.0 * EPS * (b.norm() + 8.0 * x.norm());
      EXPECT_LE(r.cwiseAbs().maxCoeff(), bound + noise);
      EXPECT_NEAR(report.largest, r.cwiseAbs().maxCoeff(), noise);
      EXPECT_NEAR(report.residual, r.norm(), noise);
      EXPECT_EQ(report.target, bound);
      norm_above += r.norm() > bound;

      ASSERT_GT(report.iterations, 0);
      for (params.max_iterations = 0; params.max_iterations < report.iterations;
           params.max_iterations++) {
        x = Vector::Zero(b.size());
        const SolveReport limited = solve(matrix.csr(), type, b, x, params);
        EXPECT_EQ(limited.status, SolveStatus::MAX_ITERATIONS);
        EXPECT_GT((b - A * x).cwiseAbs().maxCoeff(), bound);
        EXPECT_NEAR(limited.largest, (b - A * x).cwiseAbs().maxCoeff(), noise);
      }
    }
  EXPECT_GT(norm_above, 6);    // the criterion is not that of the norm
}

// of the residual of the guess, unless that is rounding error: then the guess is the solution
TEST(BiCGStab, LargestEntryAsAShareOfTheStart)
{
  const Sparse A = convection_diffusion(24, 0.5);
  Matrix matrix(A);
  const Vector b = random_vector(24 * 24, 3);
  KrylovParams params;
  params.largest = 1.0;
  params.share = 1.0e-2;
  Vector x = Vector::Zero(b.size());
  double start = b.cwiseAbs().maxCoeff();
  for (int repeat = 0; repeat < 4; repeat++) {
    const SolveReport report = solve(matrix.csr(), PrecondType::ILU0, b, x, params);
    ASSERT_TRUE(report.ok());
    const double noise = 20.0 * EPS * (b.norm() + 8.0 * x.norm());
    EXPECT_NEAR(report.target, params.share * start, params.share * noise);
    start = (b - A * x).cwiseAbs().maxCoeff();
    EXPECT_LE(start, report.target + noise);
    EXPECT_GT(report.iterations, 0);
  }
  params.largest = 1.0e-3 * start;    // the smaller bound counts
  EXPECT_EQ(solve(matrix.csr(), PrecondType::ILU0, b, x, params).target, params.largest);
  params.atol = 1.0e-5;    // but none below this one
  const Vector guess = x;
  const SolveReport report = solve(matrix.csr(), PrecondType::ILU0, b, x, params);
  EXPECT_EQ(report.status, SolveStatus::CONVERGED);
  EXPECT_EQ(report.iterations, 0);
  EXPECT_EQ(report.target, params.atol);
  EXPECT_EQ(x, guess);
}

// in a closed domain: of the residual without its mean
TEST(BiCGStab, LargestEntryOfClosedSystem)
{
  const int n = 101;
  const Sparse A = closed_interval(n);
  Matrix matrix(A);
  const Vector b = random_vector(n, 3);
  KrylovParams params;
  params.largest = 1.0e-6;
  params.remove_mean = true;
  for (PrecondType type : PRECONDITIONERS) {
    Vector x = random_vector(n, 5);
    const SolveReport report = solve(matrix.csr(), type, b, x, params);
    ASSERT_EQ(report.status, SolveStatus::CONVERGED);
    Vector r = b - A * x;
    r.array() -= r.mean();
    EXPECT_LE(r.cwiseAbs().maxCoeff(), 1.0e-6 + 100.0 * EPS * x.norm());
    EXPECT_NEAR(report.largest, r.cwiseAbs().maxCoeff(), 100.0 * EPS * x.norm());
  }
}

TEST(BiCGStab, NotFinite)
{
  Matrix matrix(diagonally_dominant(30, 5));
  const Vector guess = random_vector(30, 1);
  for (double bad : {NOT_A_NUMBER, std::numeric_limits<double>::infinity()})
    for (bool remove_mean : {false, true}) {
      KrylovParams params;
      params.remove_mean = remove_mean;
      Vector b = random_vector(30, 2), x = guess;
      b[17] = bad;
      EXPECT_EQ(solve(matrix.csr(), PrecondType::ILU0, b, x, params).status,
                SolveStatus::NOT_FINITE);
      EXPECT_EQ(x, guess);

      b = random_vector(30, 2);
      x[3] = bad;
      SolveReport report = solve(matrix.csr(), PrecondType::ILU0, b, x, params);
      EXPECT_EQ(report.status, SolveStatus::NOT_FINITE);
      EXPECT_FALSE(std::isfinite(report.residual));
      EXPECT_EQ(report.iterations, 0);
      EXPECT_EQ((x.array().isFinite()).count(), 29);    // the culprit can still be named

      params.largest = 1.0e3;    // what is not finite is not below it
      report = solve(matrix.csr(), PrecondType::ILU0, b, x, params);
      EXPECT_EQ(report.status, SolveStatus::NOT_FINITE);
      x = guess;
      b[17] = bad;
      EXPECT_EQ(solve(matrix.csr(), PrecondType::ILU0, b, x, params).status,
                SolveStatus::NOT_FINITE);
    }
}

TEST(BiCGStab, NotFiniteMatrix)
{
  for (PrecondType type : PRECONDITIONERS) {
    Matrix matrix(diagonally_dominant(30, 5));
    matrix.csr().val(7) = NOT_A_NUMBER;
    Vector x = Vector::Zero(30);
    const SolveReport report = solve(matrix.csr(), type, random_vector(30, 2), x, KrylovParams());
    EXPECT_EQ(report.status, SolveStatus::NOT_FINITE);
    EXPECT_FALSE(report.ok());
  }
}

// A preconditioner that turns bad while the matrix is fine: the guess survives
TEST(BiCGStab, NotFinitePreconditionerKeepsTheGuess)
{
  class Bad : public Preconditioner {
   public:
    void apply(const double *r, double *z) override
    {
      for (int i = 0; i < 30; i++) z[i] = calls_ < 3 ? r[i] : NOT_A_NUMBER;
      calls_++;
    }

   private:
    int calls_ = 0;
  } bad;
  Matrix matrix(diagonally_dominant(30, 5));
  SerialOperator op(matrix.csr());
  const Vector b = random_vector(30, 2), guess = random_vector(30, 3);
  Vector x = guess;
  BiCGStab solver;
  const SolveReport report = solver.solve(op, bad, SerialSum(), b.data(), x.data(), KrylovParams());
  EXPECT_EQ(report.status, SolveStatus::NOT_FINITE);
  EXPECT_TRUE(x.allFinite());
  EXPECT_LE(report.residual, report.initial_residual);
  EXPECT_NEAR(report.residual, (b - to_eigen(matrix.csr()) * x).norm(), 1.0e-13);
}

// r.A r = 0 in the first step: with r as shadow residual alpha would divide by zero
TEST(BiCGStab, FirstStepOrthogonal)
{
  Matrix matrix(from_rows({{1, 0}, {0, -1}}));
  Vector b(2), x = Vector::Zero(2);
  b << 1, 1;
  const SolveReport report = solve(matrix.csr(), PrecondType::NONE, b, x, tolerance(1.0e-12));
  EXPECT_EQ(report.status, SolveStatus::CONVERGED);
  EXPECT_NEAR(x[0], 1.0, 1.0e-12);
  EXPECT_NEAR(x[1], -1.0, 1.0e-12);
}

// Small integer matrices meet exact breakdowns of every kind. All regular ones with a positive
// definite symmetric part must be solved, restarts or not.
TEST(BiCGStab, BreakdownRestarts)
{
  std::mt19937 random(1);
  std::uniform_int_distribution<int> entry(-2, 2);
  int restarted = 0;
  for (int trial = 0; trial < 3000; trial++) {
    const int n = 4;
    Eigen::MatrixXd D(n, n);
    Vector b(n);
    for (int i = 0; i < n; i++) {
      b[i] = entry(random);
      for (int j = 0; j < n; j++) D(i, j) = entry(random) + (i == j ? 3 : 0);
    }
    const Eigen::MatrixXd symmetric = 0.5 * (D + D.transpose());
    if (Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd>(symmetric).eigenvalues()[0] < 0.1) continue;
    if (b.norm() == 0.0) continue;
    const Sparse A = D.sparseView(0.0, -1.0);
    Matrix matrix(A);
    Vector x = Vector::Zero(n);
    const SolveReport report = solve(matrix.csr(), PrecondType::NONE, b, x, tolerance(1.0e-10));
    EXPECT_EQ(report.status, SolveStatus::CONVERGED) << D << "\n" << b.transpose();
    EXPECT_LE((b - D * x).norm(), 1.01e-10 * b.norm());
    restarted += report.restarts > 0;
  }
  EXPECT_GT(restarted, 0);    // the path was taken
}

// BiCGSTAB cannot solve a skew-symmetric system: s.A s = 0 always
TEST(BiCGStab, HopelessSystemEndsAsBreakdown)
{
  Matrix matrix(from_rows({{0, 1, 0, 0}, {-1, 0, 0, 0}, {0, 0, 0, 2}, {0, 0, -2, 0}}));
  Vector b(4), x = Vector::Zero(4);
  b << 1, 2, 3, 4;
  const SolveReport report = solve(matrix.csr(), PrecondType::NONE, b, x, tolerance(1.0e-10));
  EXPECT_EQ(report.status, SolveStatus::BREAKDOWN);
  EXPECT_FALSE(report.ok());
  EXPECT_LE(report.restarts, KrylovParams().max_restarts);
  EXPECT_LE(report.residual, report.initial_residual);    // the best x, not the last
  EXPECT_NEAR(report.residual, (b - to_eigen(matrix.csr()) * x).norm(), 1.0e-12);
}

TEST(BiCGStab, ZeroMatrixEndsAsBreakdown)
{
  Matrix matrix(from_rows({{0, 0}, {0, 0}}));
  for (PrecondType type : PRECONDITIONERS) {
    Vector b = Vector::Ones(2), x = Vector::Zero(2);
    EXPECT_EQ(solve(matrix.csr(), type, b, x, KrylovParams()).status, SolveStatus::BREAKDOWN);
    EXPECT_EQ(x, Vector::Zero(2));
  }
}

// A tolerance below rounding error cannot be met: the solver says so, soon, with a residual at
// rounding level: a few times eps (|b| + |A| |x|)
TEST(BiCGStab, ToleranceBelowRounding)
{
  const Sparse A = convection_diffusion(24, 0.5);
  Matrix matrix(A);
  const Vector b = random_vector(24 * 24, 3);
  for (PrecondType type : PRECONDITIONERS) {
    Vector x = Vector::Zero(b.size());
    KrylovParams params = tolerance(1.0e-18);
    params.max_iterations = 100000;
    const SolveReport report = solve(matrix.csr(), type, b, x, params);
    EXPECT_EQ(report.status, SolveStatus::BREAKDOWN);
    EXPECT_LE(report.residual, 10.0 * EPS * (b.norm() + 8.0 * x.norm()));
    EXPECT_LT(report.restarts, params.max_restarts);    // it did not try again and again
  }
}

TEST(BiCGStab, IterationLimit)
{
  Matrix matrix(convection_diffusion(24, 0.5));
  const Vector b = random_vector(24 * 24, 3);
  for (int limit : {0, 1, 5}) {
    Vector x = Vector::Zero(b.size());
    KrylovParams params;
    params.max_iterations = limit;
    const SolveReport report = solve(matrix.csr(), PrecondType::NONE, b, x, params);
    EXPECT_EQ(report.status, SolveStatus::MAX_ITERATIONS);
    EXPECT_EQ(report.iterations, limit);
    EXPECT_LE(report.residual, report.initial_residual);
    EXPECT_NEAR(report.residual, (b - to_eigen(matrix.csr()) * x).norm(), 1.0e-12);
  }
}

TEST(BiCGStab, ClosedSystem)
{
  const int n = 101;
  const Sparse A = closed_interval(n);
  Matrix matrix(A);
  const Vector b = random_vector(n, 3);
  // some constant must be taken from b to make it consistent: which one is not known beforehand
  const Vector left =
      Eigen::FullPivLU<Eigen::MatrixXd>(Eigen::MatrixXd(A).transpose()).kernel().col(0);
  ASSERT_GT(std::fabs(left.dot(b)), 0.01 * left.norm());

  for (PrecondType type : PRECONDITIONERS) {
    KrylovParams params = tolerance(1.0e-10);
    Vector x = Vector::Zero(n);
    const SolveReport wrong = solve(matrix.csr(), type, b, x, params);
    EXPECT_FALSE(wrong.ok()) << to_string(wrong.status);
    EXPECT_TRUE(x.allFinite());
    EXPECT_GE(wrong.residual, 0.99 * std::fabs(left.dot(b)) / left.norm());

    x = random_vector(n, 5);
    params.remove_mean = true;
    const SolveReport report = solve(matrix.csr(), type, b, x, params);
    EXPECT_EQ(report.status, SolveStatus::CONVERGED);
    EXPECT_NEAR(report.rhs_mean, b.mean(), 1.0e-14);
    EXPECT_NEAR(x.mean(), 0.0, 1.0e-12 * x.norm());
    // A x = b - constant, and the constant is the one that the left null vector asks for
    const Vector r = b - A * x;
    EXPECT_LE((r.array() - r.mean()).matrix().norm(), 1.01e-10 * report.rhs_norm);
    EXPECT_NEAR(r.mean(), left.dot(b) / left.sum(), 1.0e-8);
  }
}

// remove_mean makes the sums of the projected system P A x = P b without a reduction of their own;
// the iterates are those of that system
TEST(BiCGStab, RemoveMeanIsTheProjectedSystem)
{
  class Projected : public SerialOperator {
   public:
    using SerialOperator::SerialOperator;
    void apply(double *x, double *y) override
    {
      SerialOperator::apply(x, y);
      Eigen::Map<Vector> v(y, rows());
      v.array() -= v.mean();
    }
  };
  const int n = 40;
  Sparse A = closed_interval(n);
  A.row(5) *= 50.0;    // a left null vector far from constant: products with a large mean
  Matrix matrix(A);
  Projected projected(matrix.csr());
  PrecondReport unused;
  const auto M = make_preconditioner(PrecondType::JACOBI, matrix.csr(), unused);
  const Vector b = random_vector(n, 3);
  for (int iterations = 1; iterations <= 5; iterations++) {
    KrylovParams params = tolerance(1.0e-14);
    params.max_iterations = iterations;
    Vector x = Vector::Zero(n), y = x;
    BiCGStab solver;
    const Vector Pb = b.array() - b.mean();
    solver.solve(projected, *M, SerialSum(), Pb.data(), x.data(), params);
    params.remove_mean = true;
    solve(matrix.csr(), PrecondType::JACOBI, b, y, params);
    x.array() -= x.mean();
    EXPECT_LE((x - y).norm(), 1.0e-10 * y.norm()) << iterations;    // few, well-behaved iterations
  }
}

TEST(BiCGStab, ReductionsPerIteration)
{
  Matrix matrix(closed_interval(60));
  SerialOperator op(matrix.csr());
  PrecondReport unused;
  const auto M = make_preconditioner(PrecondType::JACOBI, matrix.csr(), unused);
  const Vector b = random_vector(60, 3);
  for (bool remove_mean : {false, true}) {
    KrylovParams params;
    params.remove_mean = remove_mean;
    params.max_iterations = 10;
    SerialSum ip;
    Vector x = Vector::Zero(60);
    BiCGStab solver;
    const SolveReport report = solver.solve(op, *M, ip, b.data(), x.data(), params);
    ASSERT_EQ(report.iterations, 10);
    ASSERT_EQ(report.restarts, 0);
    EXPECT_EQ(report.recomputed, 0);
    // b: 1, two residuals: 1 each; with remove_mean x 1 more for each residual, b 1 or 2, and one
    // for each sum that is less than half of what the mean takes
    const int others = ip.calls() - 20;
    EXPECT_GE(others, remove_mean ? 6 : 3);
    EXPECT_LE(others, remove_mean ? 9 : 3);
    EXPECT_GE(solver.bytes(), 9 * 60 * sizeof(double));
  }
}

// The largest of n entries is looked for where the norm is between the bound and sqrt(n) times it:
// in the last iterations only
TEST(BiCGStab, LargestEntryIsLookedForAtTheEnd)
{
  Matrix matrix(convection_diffusion(40, 0.5));
  SerialOperator op(matrix.csr());
  PrecondReport unused;
  const auto M = make_preconditioner(PrecondType::ILU0, matrix.csr(), unused);
  const Vector b = random_vector(1600, 3);
  KrylovParams params;
  params.largest = 1.0e-8;
  SerialSum ip;
  Vector x = Vector::Zero(1600);
  BiCGStab solver;
  const SolveReport report = solver.solve(op, *M, ip, b.data(), x.data(), params);
  ASSERT_TRUE(report.ok());
  EXPECT_GT(report.inspected, 0);
  EXPECT_LT(report.inspected, report.iterations / 2);
  // b: 1, two residuals: a sum and a maximum each
  EXPECT_EQ(ip.calls(),
            2 * report.iterations + report.recomputed + report.inspected + 2 * report.restarts + 5);
}

// ILU(0) of a tridiagonal matrix is exact: one iteration takes the residual to rounding level, and
// s.s - omega t.s is the difference of two equal numbers. The sums of r itself are taken instead,
// and what is reported is the true residual.
TEST(BiCGStab, SumsThatCancelAreTakenAgain)
{
  const int n = 200;
  Sparse A = closed_interval(n);
  for (int i = 0; i < n; i++) A.coeffRef(i, i) += 0.01;
  const Vector b = random_vector(n, 3);
  for (double perturbation : {0.0, 1.0e-3, 1.0e-5, 1.0e-7}) {
    class Nearly : public Preconditioner {
     public:
      Nearly(Preconditioner &exact, double perturbation) : exact_(exact), factor_(perturbation) {}
      void apply(const double *r, double *z) override
      {
        exact_.apply(r, z);
        for (int i = 0; i < n; i++) z[i] *= 1.0 + factor_ * std::sin(i);
      }

     private:
      Preconditioner &exact_;
      double factor_;
    };
    Matrix matrix(A);
    SerialOperator op(matrix.csr());
    PrecondReport unused;
    const auto M = make_preconditioner(PrecondType::ILU0, matrix.csr(), unused);
    Nearly nearly(*M, perturbation);
    SerialSum ip;
    Vector x = Vector::Zero(n);
    BiCGStab solver;
    const SolveReport report = solver.solve(op, nearly, ip, b.data(), x.data(), tolerance(1.0e-12));
    EXPECT_TRUE(report.ok()) << perturbation;
    EXPECT_LE(report.iterations, perturbation > 1.0e-4 ? 4 : 3) << perturbation;
    if (perturbation == 1.0e-5) {
      EXPECT_GT(report.recomputed, 0);    // the path was taken
    }
    EXPECT_LE((b - A * x).norm(), 1.0e-12 * b.norm());
    EXPECT_NEAR(report.residual, (b - A * x).norm(), 20.0 * EPS * b.norm());
    EXPECT_EQ(ip.calls(), 2 * report.iterations + report.recomputed + 2 + 1 + report.restarts);
  }
}

// The sums that need no reduction of their own are as good as those that did: strong convergence
// takes as many iterations as BiCGSTAB in twice the precision would, give or take its irregularity
TEST(BiCGStab, IterationsOfTheTextbook)
{
  using Long = Eigen::Matrix<long double, Eigen::Dynamic, 1>;
  const Sparse A = convection_diffusion(24, 0.5);
  const Eigen::SparseMatrix<long double, Eigen::RowMajor> B = A.cast<long double>();
  for (unsigned seed : {3, 4, 5}) {
    const Vector b = random_vector(24 * 24, seed);
    Long r = b.cast<long double>(), r0 = r, p = r, x = Long::Zero(r.size());
    long double rho = r.dot(r);
    int expected = 0;
    while (r.norm() > 1.0e-12 * b.norm()) {
      const Long v = B * p;
      const long double alpha = rho / r0.dot(v);
      const Long s = r - alpha * v, t = B * s;
      const long double omega = t.dot(s) / t.dot(t);
      r = s - omega * t;
      const long double next = r0.dot(r);
      p = r + next / rho * (alpha / omega) * (p - omega * v);
      rho = next;
      expected++;
    }
    Matrix matrix(A);
    Vector y = Vector::Zero(b.size());
    const SolveReport report = solve(matrix.csr(), PrecondType::NONE, b, y, tolerance(1.0e-12));
    EXPECT_EQ(report.status, SolveStatus::CONVERGED);
    EXPECT_EQ(report.restarts, 0);
    EXPECT_NEAR(report.iterations, expected, 0.1 * expected);
  }
}

TEST(BiCGStab, WorkSpaceIsReusedForOtherSizes)
{
  BiCGStab solver;
  SerialSum ip;
  for (int n : {20, 200, 7, 90}) {
    const Sparse A = diagonally_dominant(n, 11);
    Matrix matrix(A);
    SerialOperator op(matrix.csr());
    PrecondReport unused;
    const auto M = make_preconditioner(PrecondType::ILU0, matrix.csr(), unused);
    const Vector b = random_vector(n, 12);
    Vector x = Vector::Zero(n), y = x;
    ASSERT_TRUE(solver.solve(op, *M, ip, b.data(), x.data(), KrylovParams()).ok());
    solve(matrix.csr(), PrecondType::ILU0, b, y, KrylovParams());
    EXPECT_EQ(x, y);
  }
}
