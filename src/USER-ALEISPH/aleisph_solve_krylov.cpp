// SPDX-License-Identifier: GPL-2.0-only
/* ----------------------------------------------------------------------
   Names as in van der Vorst (1992): r residual, r0 shadow residual, p, v
   = A M p, t = A M s; s overwrites r, y = M p, z = M s.

   Two reductions an iteration: with r0.t and r0.s summed beside t.s, t.t
   and s.s, r = s - omega t has r.r = s.s - omega t.s and r0.r = r0.s -
   omega r0.t. Where these cancel, they are summed from r itself.

   remove_mean: A has a constant right null vector, its left null vector is
   not constant. P = 1 - mean projects b and every product, so that P A x =
   P b is solved among vectors of zero mean, where it has a solution for
   any b. The mean of a product is summed together with its dot products,
   which are corrected for it, and subtracted where the product is used; r,
   r0 and p have no mean.

   The largest |r_i| of n entries lies between |r|/sqrt(n) and |r|. Where
   it decides, it is looked for only if the first is small enough and the
   second is not.
------------------------------------------------------------------------- */

#include "aleisph_solve_krylov.h"

#include "aleisph_solve_krylov_loops.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace aleisph {
namespace {

constexpr double EPS = std::numeric_limits<double>::epsilon();
// A difference of sums this small against its terms has lost half of its digits
constexpr double CANCELS = 1.0e-8;

// A dot product this small against the lengths of its factors is rounding error.
bool vanishes(double dot, double length_a, double length_b)
{
  return std::fabs(dot) <= EPS * length_a * length_b;
}

}    // namespace

const char *to_string(SolveStatus status)
{
  switch (status) {
    case SolveStatus::CONVERGED: return "converged";
    case SolveStatus::ZERO_RHS: return "zero right-hand side";
    case SolveStatus::MAX_ITERATIONS: return "iteration limit reached";
    case SolveStatus::BREAKDOWN: return "breakdown";
    case SolveStatus::NOT_FINITE: return "not finite";
  }
  return "unknown";
}

class BiCGStab::Run {
 public:
  Run(BiCGStab &work, LinearOperator &A, Preconditioner &M, const InnerProduct &ip,
      const KrylovParams &params, double *x);
  SolveReport solve(const double *b);

 private:
  // why a cycle, the iterations between two restarts, ended
  enum class Exit { NONE, CONVERGED, BREAKDOWN, NOT_FINITE, LIMIT };

  bool load_rhs(const double *b);
  bool stuck(Exit exit, double norm);
  SolveReport finish(SolveStatus status, double norm);
  double subtract_mean(double *v, double *square = nullptr);
  double true_residual();
  bool converged(double norm) const;
  bool may_have_converged(double norm) const;
  bool inspect(double omega, double t_mean);

  Exit cycle(double norm);
  Exit bicg_step(bool first);
  Exit stabilize();
  void recompute(double omega, double t_mean, double &r_r, double &rho);
  double turn_shadow(double v_length);

  LinearOperator &A_;
  Preconditioner &M_;
  const InnerProduct &ip_;
  const KrylovParams &params_;
  const int n_, columns_;
  double *x_;
  std::vector<double> &b_, &r_, &r0_, &p_, &v_, &t_, &y_, &z_, &best_;

  SolveReport report_;
  double n_global_ = 0.0, target_ = 0.0, best_norm_ = 0.0, cycle_norm_ = 0.0;
  double largest_ = 0.0, best_largest_ = 0.0;    // entry of the true residual, or a bound on it
  int idle_ = 0;
  double rho_ = 0.0, alpha_ = 0.0, v_mean_ = 0.0, r0_length_ = 0.0;
};

BiCGStab::Run::Run(BiCGStab &w, LinearOperator &A, Preconditioner &M, const InnerProduct &ip,
                   const KrylovParams &params, double *x) :
    A_(A),
    M_(M), ip_(ip), params_(params), n_(A.rows()), columns_(A.columns()), x_(x), b_(w.b_), r_(w.r_),
    r0_(w.r0_), p_(w.p_), v_(w.v_), t_(w.t_), y_(w.y_), z_(w.z_), best_(w.best_)
{
  for (std::vector<double> *v : {&b_, &r_, &r0_, &p_, &v_, &t_}) v->resize(n_);
  for (std::vector<double> *v : {&y_, &z_, &best_}) v->resize(columns_);
}

SolveReport BiCGStab::Run::solve(const double *b)
{
  const bool zero = load_rhs(b);
  if (!std::isfinite(report_.rhs_norm)) {
    report_.status = SolveStatus::NOT_FINITE;
    report_.residual = report_.initial_residual = report_.largest = report_.rhs_norm;
    return report_;
  }
  if (zero) {
    std::fill(x_, x_ + columns_, 0.0);
    report_.status = SolveStatus::ZERO_RHS;
    report_.residual = report_.initial_residual = report_.largest = report_.rhs_norm;
    return report_;
  }

  best_norm_ = std::numeric_limits<double>::infinity();
  double norm = report_.initial_residual = true_residual();
  target_ = params_.largest > 0.0 ? std::min(params_.largest, params_.share * largest_)
                                  : params_.rtol * report_.rhs_norm;
  report_.target = target_ = std::max(target_, params_.atol);
  for (Exit exit = Exit::NONE;;) {
    if (converged(norm)) return finish(SolveStatus::CONVERGED, norm);
    if (exit == Exit::NOT_FINITE || !std::isfinite(norm))
      return finish(SolveStatus::NOT_FINITE, norm);
    if (report_.iterations >= params_.max_iterations)
      return finish(SolveStatus::MAX_ITERATIONS, norm);
    if (exit != Exit::NONE) {
      if (stuck(exit, norm)) return finish(SolveStatus::BREAKDOWN, norm);
      report_.restarts++;
    }
    if (norm < best_norm_) {
      std::copy(x_, x_ + columns_, best_.begin());
      best_norm_ = norm;
      best_largest_ = largest_;
    }
    exit = cycle(norm);
    norm = true_residual();
  }
}

// b_ = b, or P b; true if nothing but rounding error is left of it
bool BiCGStab::Run::load_rhs(const double *b)
{
  double sums[3];
  product_sums(n_, b, b, sums);
  sums[0] = n_;
  ip_.sum(3, sums);
  n_global_ = std::max(sums[0], 1.0);
  report_.rhs_norm = std::sqrt(sums[1]);
  report_.rhs_mean = sums[2] / n_global_;
  std::copy(b, b + n_, b_.begin());
  if (!params_.remove_mean || !std::isfinite(sums[1])) return sums[1] == 0.0;

  // twice, as the first mean has the rounding error of a long sum
  for (double &value : b_) value -= report_.rhs_mean;
  const double raw_norm = report_.rhs_norm;
  double square;
  report_.rhs_mean += subtract_mean(b_.data(), &square);
  report_.rhs_norm = std::sqrt(square);
  return report_.rhs_norm <= 2.0 * EPS * raw_norm;
}

// If a cycle has converged by its updated residual, but the true residual has (almost) not
// changed, this is the rounding error of A x; after two such cycles in a row the solve ends. Breakdowns have max_restarts attempts.
bool BiCGStab::Run::stuck(Exit exit, double norm)
{
  idle_ = exit == Exit::CONVERGED && norm > 0.5 * cycle_norm_ ? idle_ + 1 : 0;
  return idle_ == 2 || report_.restarts >= params_.max_restarts;
}

SolveReport BiCGStab::Run::finish(SolveStatus status, double norm)
{
  report_.status = status;
  report_.residual = norm;
  report_.largest = largest_;
  if (status != SolveStatus::CONVERGED && best_norm_ < std::numeric_limits<double>::infinity() &&
      !(norm <= best_norm_)) {
    std::copy(best_.begin(), best_.end(), x_);
    report_.residual = best_norm_;
    report_.largest = best_largest_;
  }
  return report_;
}

// From the owned entries; returns the mean, and what is left of v.v. A NaN stays where it is.
double BiCGStab::Run::subtract_mean(double *v, double *square)
{
  double sums[3];
  product_sums(n_, v, v, sums);
  ip_.sum(3, sums);
  const double mean = sums[2] / n_global_;
  if (std::isfinite(mean))
    for (int i = 0; i < n_; i++) v[i] -= mean;
  if (!square) return mean;

  *square = sums[1] - n_global_ * mean * mean;
  if (*square < 0.5 * sums[1]) {
    product_sums(n_, v, v, sums);
    ip_.sum(3, sums);
    *square = sums[1];
  }
  return mean;
}

// of the true residual
bool BiCGStab::Run::converged(double norm) const
{
  return norm <= target_ || (params_.largest > 0.0 && largest_ <= target_);
}

// of a norm above the target: is a look at the entries worth a reduction?
bool BiCGStab::Run::may_have_converged(double norm) const
{
  return params_.largest > 0.0 && norm <= std::sqrt(n_global_) * target_;
}

// r = b - A x; its norm, and its largest entry where that decides
double BiCGStab::Run::true_residual()
{
  if (params_.remove_mean) subtract_mean(x_);
  A_.apply(x_, r_.data());
  for (int i = 0; i < n_; i++) r_[i] = b_[i] - r_[i];
  double square, sums[3];
  if (params_.remove_mean)
    subtract_mean(r_.data(), &square);
  else {
    product_sums(n_, r_.data(), r_.data(), sums);
    ip_.sum(3, sums);
    square = sums[1];
  }
  largest_ = std::sqrt(square);
  if (params_.largest > 0.0 && std::isfinite(square)) {
    const double *r = r_.data();
    largest_ = largest_size(n_, [=](auto at) { return at(r); });
    ip_.max(1, &largest_);
  }
  return std::sqrt(square);
}

// iterations from the true residual r of this norm, with r as shadow residual
BiCGStab::Run::Exit BiCGStab::Run::cycle(double norm)
{
  cycle_norm_ = r0_length_ = norm;
  rho_ = norm * norm;
  r0_ = r_;
  p_ = r_;
  for (bool first = true;; first = false) {
    if (report_.iterations >= params_.max_iterations) return Exit::LIMIT;
    report_.iterations++;
    const Exit exit = bicg_step(first);
    if (exit != Exit::NONE) return exit;
    const Exit end = stabilize();
    if (end != Exit::NONE) return end;
  }
}

// v = A M p, alpha = (r0.r)/(r0.v), s = r - alpha v
BiCGStab::Run::Exit BiCGStab::Run::bicg_step(bool first)
{
  M_.apply(p_.data(), y_.data());
  A_.apply(y_.data(), v_.data());
  double sums[3];
  product_sums(n_, r0_.data(), v_.data(), sums);
  ip_.sum(3, sums);
  if (!std::isfinite(sums[1])) return Exit::NOT_FINITE;
  v_mean_ = params_.remove_mean ? sums[2] / n_global_ : 0.0;
  const double v_length = std::sqrt(std::max(sums[1] - n_global_ * v_mean_ * v_mean_, 0.0));

  double r0_v = sums[0];
  if (vanishes(r0_v, r0_length_, v_length)) {
    if (!first || v_length == 0.0) return Exit::BREAKDOWN;
    r0_v = turn_shadow(v_length);
  }
  alpha_ = rho_ / r0_v;
  half_step(n_, alpha_, v_.data(), v_mean_, r_.data());
  return Exit::NONE;
}

// At the start of a cycle r0 = r = p. If then r.v = 0, the shadow r + (|r|/|v|) v is as good as
// any: it makes an angle of 45 degrees with both r and v. Returns the new r0.v.
double BiCGStab::Run::turn_shadow(double v_length)
{
  const double r_length = r0_length_;
  half_step(n_, -r_length / v_length, v_.data(), v_mean_, r0_.data());
  r0_length_ = std::sqrt(2.0) * r_length;    // rho = r0.r stays |r|^2
  return r_length * v_length;
}

// t = A M s, omega = (t.s)/(t.t), then the next x, r and p
BiCGStab::Run::Exit BiCGStab::Run::stabilize()
{
  M_.apply(r_.data(), z_.data());
  A_.apply(z_.data(), t_.data());
  double sums[6];
  stabilizer_sums(n_, t_.data(), r_.data(), r0_.data(), sums);
  ip_.sum(6, sums);
  const double t_s = sums[0], s_s = sums[2], s_length = std::sqrt(s_s);
  if (!std::isfinite(sums[1] + s_s)) return Exit::NOT_FINITE;
  const double t_mean = params_.remove_mean ? sums[3] / n_global_ : 0.0;
  const double t_t = sums[1] - n_global_ * t_mean * t_mean;
  if (s_length <= target_ || t_t <= 0.0) {
    advance(n_, alpha_, y_.data(), 0.0, z_.data(), x_);
    return s_length <= target_ ? Exit::CONVERGED : Exit::BREAKDOWN;
  }

  const double omega = t_s / t_t;
  double r_r = s_s - omega * t_s, rho = sums[5] - omega * sums[4];
  const double terms = s_length + std::fabs(omega) * std::sqrt(sums[1]);
  const bool cancelled = !(r_r > CANCELS * terms * terms) ||
      !(std::fabs(rho) > CANCELS * r0_length_ * terms);
  if (cancelled) recompute(omega, t_mean, r_r, rho);
  const double r_length = std::sqrt(r_r);
  if (!std::isfinite(r_length)) return Exit::NOT_FINITE;

  const bool converged = r_length <= target_ ||
      (may_have_converged(r_length) && inspect(omega, t_mean));
  if (converged || vanishes(t_s, std::sqrt(t_t), s_length) || vanishes(rho, r0_length_, r_length)) {
    advance(n_, alpha_, y_.data(), omega, z_.data(), x_);
    return converged ? Exit::CONVERGED : Exit::BREAKDOWN;
  }
  const double beta = rho / rho_ * (alpha_ / omega);
  rho_ = rho;
  full_step(n_, {alpha_, omega, beta, v_mean_, t_mean}, y_.data(), z_.data(), t_.data(), v_.data(),
            x_, r_.data(), p_.data());
  return Exit::NONE;
}

// Are all entries of r = s - omega t, which the full step makes again, below the target?
bool BiCGStab::Run::inspect(double omega, double t_mean)
{
  const double *t = t_.data(), *s = r_.data();
  double largest = largest_size(n_, [=](auto at) { return at(s) - omega * (at(t) - t_mean); });
  ip_.max(1, &largest);
  report_.inspected++;
  return largest <= target_;
}

// r.r and r0.r of r = s - omega t, which the full step makes again
void BiCGStab::Run::recompute(double omega, double t_mean, double &r_r, double &rho)
{
  double sums[2];
  const double *t = t_.data(), *s = r_.data(), *r0 = r0_.data();
  sum_terms<2>(n_, sums, [=](auto at, auto *term) {
    const auto r = at(s) - omega * (at(t) - t_mean);
    term[0] = r * r;
    term[1] = at(r0) * r;
  });
  ip_.sum(2, sums);
  r_r = sums[0];
  rho = sums[1];
  report_.recomputed++;
}

SolveReport BiCGStab::solve(LinearOperator &A, Preconditioner &M, const InnerProduct &ip,
                            const double *b, double *x, const KrylovParams &params)
{
  return Run(*this, A, M, ip, params, x).solve(b);
}

double BiCGStab::bytes() const
{
  size_t n = 0;
  for (const std::vector<double> *v : {&b_, &r_, &r0_, &p_, &v_, &t_, &y_, &z_, &best_})
    n += v->capacity();
  return static_cast<double>(n) * sizeof(double);
}

}    // namespace aleisph
