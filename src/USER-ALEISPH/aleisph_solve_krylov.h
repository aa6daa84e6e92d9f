// SPDX-License-Identifier: GPL-2.0-only
/* ----------------------------------------------------------------------
   BiCGSTAB, van der Vorst, SIAM J. Sci. Stat. Comput. 13 (1992) 631, with
   right preconditioning, restart on near-breakdown and a recomputed true
   residual. It is given an operator, a preconditioner and an inner product.
   Several ranks differ from one only in the inner product and in the halo
   exchange of the operator.
------------------------------------------------------------------------- */

#ifndef LMP_ALEISPH_SOLVE_KRYLOV_H
#define LMP_ALEISPH_SOLVE_KRYLOV_H

#include <vector>

namespace aleisph {

class LinearOperator {
 public:
  virtual ~LinearOperator() = default;
  virtual int rows() const = 0;       // owned entries
  virtual int columns() const = 0;    // owned and ghost entries, >= rows()
  // y = A x. x has columns() entries, of which the first rows() are given;
  // the operator fills the rest (halo exchange).
  virtual void apply(double *x, double *y) = 0;
};

class Preconditioner {
 public:
  virtual ~Preconditioner() = default;
  virtual void apply(const double *r, double *z) = 0;    // z = M^-1 r, owned entries
};

class InnerProduct {
 public:
  virtual ~InnerProduct() = default;
  // replaces the n rank-local sums by their global sums: one reduction a call
  virtual void sum(int n, double *values) const = 0;
  // the largest of all ranks, likewise
  virtual void max(int n, double *values) const = 0;
};

struct KrylovParams {
  double rtol = 1.0e-8;    // converged if |r| <= max(rtol |b|, atol), 2-norms
  double atol = 0.0;       // of both criteria
  double largest = 0.0;    // if above 0, converged instead if no |r_i| is above this, and
  double share = 1.0;      // none above this share of the largest at the start, or atol
  int max_iterations = 1000;
  int max_restarts = 20;
  bool remove_mean = false;    // singular system with constant null vector: the mean is
                               // taken from b and from every product, and from x at the end
};

enum class SolveStatus { CONVERGED, ZERO_RHS, MAX_ITERATIONS, BREAKDOWN, NOT_FINITE };
const char *to_string(SolveStatus status);

struct SolveReport {
  SolveStatus status = SolveStatus::CONVERGED;
  int iterations = 0;
  int restarts = 0;
  int recomputed = 0;               // iterations whose sums cancelled: one reduction more
  int inspected = 0;                // iterations whose largest |r_i| was looked for: one more
  double rhs_norm = 0.0;            // |b| after remove_mean
  double rhs_mean = 0.0;            // what remove_mean took from b, else the mean of b
  double initial_residual = 0.0;    // |b - A x0|
  double residual = 0.0;            // true |b - A x| at the end, recomputed
  double largest = 0.0;             // and its largest entry if that was asked for, else as residual
  double target = 0.0;              // which the one or the other had to meet
  bool ok() const { return status == SolveStatus::CONVERGED || status == SolveStatus::ZERO_RHS; }
};

// Solves A x = b. x: on entry the initial guess, on return the solution,
// columns() entries, valid on ghosts too if A's halo exchange is; b: rows()
// entries. All branches are taken on globally summed numbers, so that all
// ranks leave together. A solve that fails returns the best x it knows the
// true residual of. Two reductions an iteration, three where sums cancel, and
// one more where the largest entry of the residual may be small enough.
// Work vectors are kept between calls.
class BiCGStab {
 public:
  SolveReport solve(LinearOperator &A, Preconditioner &M, const InnerProduct &ip, const double *b,
                    double *x, const KrylovParams &params);
  double bytes() const;

 private:
  class Run;                                      // one solve
  std::vector<double> b_, r_, r0_, p_, v_, t_;    // rows() entries
  std::vector<double> y_, z_, best_;              // columns() entries
};

}    // namespace aleisph
#endif
