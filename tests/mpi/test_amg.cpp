// SPDX-License-Identifier: GPL-2.0-only
/* ----------------------------------------------------------------------
   Multigrid on the pressure matrices of jittered tanks, against a direct
   solve; on matrices that it cannot be built for.
------------------------------------------------------------------------- */

#include "aleisph_mpi_amg.h"
#include "aleisph_solve_linear.h"
#include "aleisph_solve_ppe.h"
#include "cloud.h"
#include "rank_matrix.h"
#include "scenes.h"

#include <gtest/gtest.h>

#include <Eigen/SparseLU>

#include <cmath>
#include <limits>

using namespace aleisph;
using namespace aleisph_test;

namespace {

Sparse pressure_matrix(const Scene &scene)
{
  const Discretized ops(scene);
  CsrMatrix A;
  PpeLayout layout;
  assemble_ppe(ops.cloud(), weights(ops.l(), ops.s()), PpeOptions(), A, layout);
  return to_eigen(A);
}

// closed box whose uppermost layer of fluid has a prescribed pressure
Sparse open_matrix(int dim, int n)
{
  Scene scene = closed_box(dim, n, 0.2);
  for (std::size_t i = 0; i < scene.points.size(); i++)
    if ((scene.role[i] & FLUID) && scene.points[i][dim - 1] > 1.0 - 1.4 * scene.d)
      scene.role[i] |= DIRICHLET;
  return pressure_matrix(scene);
}

struct Result {
  SolveReport report;
  LinearSolver::Counts counts;
  Vector x;
};

Result solve_with(PrecondType type, const Sparse &A, const Vector &b, KrylovParams params,
                  bool without_last = false)
{
  RankMatrix matrix(A, without_last);
  LinearSolver solver;
  solver.set_type(type);
  AmgOptions options;
  options.singular = params.remove_mean;
  const auto make = [&](PrecondType which, PrecondReport &report) {
    return which == PrecondType::AMG
        ? make_amg(MPI_COMM_WORLD, matrix.csr(), matrix.global(), options, report)
        : make_preconditioner(which, matrix.csr(), report);
  };
  std::vector<double> x(matrix.columns(), 0.0);
  Result result;
  result.report = solver.solve(matrix, {make}, MpiSum(), b.data() + matrix.first(), x.data(),
                               params);
  result.counts = solver.counts();
  result.x = matrix.gather(x.data());
  return result;
}

Vector direct(const Sparse &A, const Vector &b)
{
  Eigen::SparseLU<Eigen::SparseMatrix<double>> lu;
  lu.compute(Eigen::SparseMatrix<double>(A));
  return lu.solve(b);
}

class AmgTest : public testing::Test {
 protected:
  void SetUp() override
  {
    if (!amg_available()) GTEST_SKIP() << "compiled without hypre";
  }
};

}    // namespace

// fewer iterations than ILU(0) would take on one rank, and no more in the larger tank
TEST_F(AmgTest, OpenTank)
{
  for (const int dim : {2, 3})
    for (const int n : {dim == 2 ? 24 : 9, dim == 2 ? 48 : 14})
      for (const bool without_last : {false, true}) {
        SCOPED_TRACE(testing::Message() << dim << "d " << n << " " << without_last);
        const Sparse A = open_matrix(dim, n);
        const Vector b = random_vector(static_cast<int>(A.rows()), 3);
        const Result result = solve_with(PrecondType::AMG, A, b, tolerance(1.0e-10), without_last);
        EXPECT_EQ(result.report.status, SolveStatus::CONVERGED);
        EXPECT_LE(result.report.iterations, 12);
        EXPECT_EQ(result.counts.fallbacks, 0);
        // |A^-1| is about n^2/10 in these units
        EXPECT_LE((result.x - direct(A, b)).norm(), 1.0e-10 * n * n * b.norm());
      }
}

// The matrix of a closed tank is singular; rows are fulfilled up to a common constant
TEST_F(AmgTest, ClosedTank)
{
  for (const int dim : {2, 3})
    for (const int n : {dim == 2 ? 24 : 9, dim == 2 ? 48 : 14}) {
      SCOPED_TRACE(testing::Message() << dim << "d " << n);
      const Sparse A = pressure_matrix(closed_box(dim, n, 0.2));
      const int rows = static_cast<int>(A.rows());
      const Vector b = random_vector(rows, 4);
      KrylovParams params = tolerance(1.0e-10);
      params.remove_mean = true;
      const Result result = solve_with(PrecondType::AMG, A, b, params);
      EXPECT_EQ(result.report.status, SolveStatus::CONVERGED);
      EXPECT_LE(result.report.iterations, 15);
      EXPECT_EQ(result.report.restarts, 0);
      EXPECT_EQ(result.counts.fallbacks, 0);
      EXPECT_NEAR(result.x.mean(), 0.0, 1.0e-10 * result.x.cwiseAbs().maxCoeff());
      const Vector r = b - A * result.x;
      EXPECT_LE((r.array() - r.mean()).matrix().norm(), 1.1e-10 * b.norm());

      // [A 1; 1 0] is regular: the constant, and the mean of p
      Sparse B(rows + 1, rows + 1);
      std::vector<Eigen::Triplet<double>> entries;
      for (int i = 0; i < rows; i++) {
        for (Sparse::InnerIterator it(A, i); it; ++it)
          entries.emplace_back(i, it.col(), it.value());
        entries.emplace_back(i, rows, 1.0);
        entries.emplace_back(rows, i, 1.0);
      }
      B.setFromTriplets(entries.begin(), entries.end());
      Vector c = Vector::Zero(rows + 1);
      c.head(rows) = b;
      EXPECT_LE((result.x - direct(B, c).head(rows)).norm(), 1.0e-10 * n * n * b.norm());
    }
}

// a mean of zero on the right does not keep the constant out: the left null vector is another one
TEST_F(AmgTest, ClosedTankReachesRounding)
{
  const Sparse A = pressure_matrix(closed_box(2, 30, 0.2));
  const Vector b = A * random_vector(static_cast<int>(A.rows()), 5);
  KrylovParams params = tolerance(1.0e-13);
  params.remove_mean = true;
  const Result result = solve_with(PrecondType::AMG, A, b, params);
  EXPECT_EQ(result.report.status, SolveStatus::CONVERGED);
  EXPECT_EQ(result.counts.fallbacks, 0);
}

// Rows that depend on nothing, among others
TEST_F(AmgTest, OnlyDiagonal)
{
  Sparse A(40, 40);
  for (int i = 0; i < 40; i++) A.coeffRef(i, i) = 1.0 + i;
  A.makeCompressed();
  const Vector b = random_vector(40, 6);
  const Result result = solve_with(PrecondType::AMG, A, b, tolerance(1.0e-12));
  EXPECT_EQ(result.report.status, SolveStatus::CONVERGED);
  for (int i = 0; i < 40; i++) EXPECT_NEAR(result.x[i], b[i] / (1.0 + i), 1.0e-12);
}

TEST_F(AmgTest, NotFiniteIsRefusedOnAllRanks)
{
  Sparse A = open_matrix(2, 12);
  A.coeffRef(0, 0) = std::numeric_limits<double>::quiet_NaN();
  RankMatrix matrix(A);
  PrecondReport report;
  EXPECT_EQ(make_amg(MPI_COMM_WORLD, matrix.csr(), matrix.global(), AmgOptions(), report), nullptr);
  EXPECT_STREQ(report.failure, "the matrix is not finite");
}

// a matrix with zeros on the diagonal: whatever multigrid makes of it, the solver goes on with
// Jacobi and says so, or has got the solution
TEST_F(AmgTest, UselessHierarchyIsCounted)
{
  Sparse A = open_matrix(2, 16);
  const int rows = static_cast<int>(A.rows());
  for (int i = 0; i < rows; i++)
    for (Sparse::InnerIterator it(A, i); it; ++it)
      if (it.col() != i) it.valueRef() = (i + it.col()) % 2 ? 3.0 : -3.0;
  for (int i = 0; i < rows; i++) A.coeffRef(i, i) = i % 3 ? 40.0 : 0.0;
  const Vector b = random_vector(rows, 7);
  const Result result = solve_with(PrecondType::AMG, A, b, tolerance(1.0e-8));
  EXPECT_TRUE(result.x.allFinite());
  EXPECT_TRUE(result.report.ok() || result.counts.fallbacks == 1);
}

TEST(Amg, NotAvailableIsSaid)
{
  if (amg_available()) GTEST_SKIP() << "compiled with hypre";
  RankMatrix matrix(diagonally_dominant(30, 1));
  PrecondReport report;
  EXPECT_EQ(make_amg(MPI_COMM_WORLD, matrix.csr(), matrix.global(), AmgOptions(), report), nullptr);
  EXPECT_NE(report.failure, nullptr);
}
