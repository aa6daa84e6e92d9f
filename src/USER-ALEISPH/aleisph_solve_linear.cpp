// SPDX-License-Identifier: GPL-2.0-only

#include "aleisph_solve_linear.h"

#include <algorithm>
#include <utility>

namespace aleisph {
namespace {

// Cost of a build in iterations, measured in 2d and 3d with 1e4 to 1e6 rows: ILU(0) 5 and 13,
// multigrid 10 and 12. Jacobi's costs less than to compare the rows.
int cost_of_build(PrecondType type)
{
  return type == PrecondType::ILU0 || type == PrecondType::AMG ? 10 : 0;
}

// Multigrid converges in a dozen iterations or stagnates; none is worth this many
constexpr int MAX_AMG_ITERATIONS = 200;

bool hopeless(const SolveReport &report)    // the right hand side or the guess is not finite
{
  return report.status == SolveStatus::NOT_FINITE && report.iterations == 0;
}

}    // namespace

void MovedPreconditioner::apply(const double *r, double *z)
{
  transfer_->to_built(r, r_.data());
  built_.apply(r_.data(), z_.data());
  transfer_->to_present(z_.data(), z);
}

double MovedPreconditioner::bytes() const
{
  return transfer_->bytes() + static_cast<double>(r_.capacity() + z_.capacity()) * sizeof(double);
}

void LinearSolver::set_type(PrecondType type)
{
  if (type != type_) stale_ = true;
  type_ = type;
}

void LinearSolver::matrix_changed(RowIds row_ids)
{
  changed_ = true;
  if (forget_ || !reuse_ || cost_of_build(type_) == 0) stale_ = true;
  if (row_ids != row_ids_) moved_ = true;
  forget_ = false;
  age_++;
  row_ids_ = std::move(row_ids);
}

// what is stale on one rank is stale on all of them, and rows do not move on one rank alone
void LinearSolver::settle_stale(const Mover &move, const InnerProduct &ip)
{
  if (!changed_) return;
  double ranks[] = {stale_ || !precond_ ? 1.0 : 0.0, moved_ ? 1.0 : 0.0};
  ip.sum(2, ranks);
  stale_ = ranks[0] > 0.0 || (ranks[1] > 0.0 && !follow(move));
  changed_ = moved_ = false;
}

bool LinearSolver::follow(const Mover &move)
{
  moved_precond_.reset();
  auto transfer = move ? move(built_ids_, row_ids_) : nullptr;
  if (!transfer) return false;
  moved_precond_ = std::make_unique<MovedPreconditioner>(std::move(transfer), *precond_,
                                                         built_ids_.size());
  return true;
}

bool LinearSolver::build(PrecondType type, const Maker &make)
{
  moved_precond_.reset();
  precond_.reset();    // before the next one: the memory is that of one
  precond_ = make(type, precond_report_);
  built_ids_ = row_ids_;
  counts_.builds++;
  stale_ = false;
  age_ = fewest_ = excess_ = 0;
  return precond_ != nullptr;
}

int LinearSolver::attempt_limit(int max_iterations) const
{
  if (old()) return std::min(max_iterations, 4 * fewest_ + 2 * cost_of_build(type_));
  if (type_ == PrecondType::AMG) return std::min(max_iterations, MAX_AMG_ITERATIONS);
  return max_iterations;
}

void LinearSolver::attempt(LinearOperator &A, const InnerProduct &ip, const double *b, double *x,
                           KrylovParams params, SolveReport &total)
{
  const SolveReport before = total;
  if (params.largest > 0.0 && before.target > 0.0) {    // by the start of the first attempt
    params.largest = before.target;
    params.share = 1.0;
  }
  Preconditioner &M = moved_precond_ ? *moved_precond_ : *precond_;
  total = krylov_.solve(A, M, ip, b, x, params);
  counts_.iterations += total.iterations;
  if (total.ok()) judge(total.iterations);
  total.iterations += before.iterations;
  total.restarts += before.restarts;
}

// after a solve with success: is it time for a new preconditioner?
void LinearSolver::judge(int iterations)
{
  if (iterations > 0) fewest_ = fewest_ ? std::min(fewest_, iterations) : iterations;
  if (!old()) return;
  excess_ += std::max(0, iterations - fewest_);
  if (excess_ > cost_of_build(type_)) forget_ = true;
}

SolveReport LinearSolver::solve(LinearOperator &A, const Builder &builder, const InnerProduct &ip,
                                const double *b, double *x, const KrylovParams &params)
{
  settle_stale(builder.move, ip);
  const Maker &make = builder.make;
  fallback_reason_ = nullptr;
  SolveReport total;
  const auto limited = [&] {
    KrylovParams limited = params;
    limited.max_iterations = attempt_limit(params.max_iterations);
    return limited;
  };

  const bool kept = !stale_ && precond_ && old();
  bool built = !stale_ && precond_;
  if (!built) built = build(type_, make);
  if (built) {
    attempt(A, ip, b, x, limited(), total);
    if (total.ok() || hopeless(total)) return total;
    if (kept && build(type_, make)) {
      attempt(A, ip, b, x, limited(), total);
      if (total.ok()) return total;
    }
    if (type_ == PrecondType::JACOBI || type_ == PrecondType::NONE) return total;
  }

  fallback_reason_ = precond_ ? to_string(total.status) : precond_report_.failure;
  counts_.fallbacks++;
  build(PrecondType::JACOBI, make);
  attempt(A, ip, b, x, params, total);
  stale_ = changed_ = true;    // the next solve tries again
  return total;
}

double LinearSolver::bytes() const
{
  return krylov_.bytes() + precond_report_.bytes +
      (moved_precond_ ? moved_precond_->bytes() : 0.0) +
      static_cast<double>(row_ids_.capacity() + built_ids_.capacity()) * sizeof(std::int64_t);
}

}    // namespace aleisph
