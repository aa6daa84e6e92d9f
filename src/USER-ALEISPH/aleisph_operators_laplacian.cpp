// SPDX-License-Identifier: GPL-2.0-only
/* ----------------------------------------------------------------------
   Laplacian weights, Morikawa, Tsuji & Asai eqs 11-14 (the systems are solved
   in aleisph_operators_laplacian_system.cpp), and their fallback, the row of Morris,
   Fox & Zhu, J. Comput. Phys. 136 (1997) 214.
------------------------------------------------------------------------- */

#include "aleisph_cloud.h"
#include "aleisph_lattice.h"
#include "aleisph_operators.h"
#include "aleisph_operators_laplacian_system.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace aleisph {
namespace {

constexpr double INF = std::numeric_limits<double>::infinity();
constexpr int BATCH = 64;    // rows whose systems are solved together: their pairs stay in cache

template <class T> double held(const std::vector<T> &v)
{
  return static_cast<double>(v.capacity()) * sizeof(T);
}

enum class RowKind { CORRECTED, LAMBDA, CONDITION, DIAGONAL, SURFACE };

// where the results go: a per pair, the others per row
struct Target {
  double *a, *diagonal, *condition;
  char *morris;
};

// e.B e, with B as in LaplacianRow
inline double quadratic(const LaplacianRow<2> &row, double x, double y)
{
  return row.b[0] * x * x + row.b[1] * y * y + row.b[2] * x * y;
}

inline double quadratic(const LaplacianRow<3> &row, double x, double y, double z)
{
  return row.b[0] * x * x + row.b[1] * y * y + row.b[2] * z * z + row.b[3] * y * z +
      row.b[4] * x * z + row.b[5] * x * y;
}

template <int D> class RowBuilder {
 public:
  RowBuilder(const Stencil &s, const GradientWeights &g, const LaplacianBounds &bounds,
             const Role *role, const Target &out) :
      s_(s),
      g_(g), t_(bounds), role_(role), out_(out)
  {
  }

  MorrisCount build(const Rows &rows) const
  {
    return sum_blocks<BATCH>(rows, [this](const int *some, int n) { return build_batch(some, n); });
  }

 private:
  bool trusted(int i) const { return g_.lambda(i) >= t_.min_lambda; }
  bool surface(int i) const { return role_ && (role_[i] & SURFACE); }

  MorrisCount build_batch(const int *rows, int n) const
  {
    MorrisCount count;
    int solved[BATCH] = {}, m = 0;
    for (int k = 0; k < n; k++) {
      if (surface(rows[k]))
        count += morris_row(rows[k], RowKind::SURFACE);
      else if (!trusted(rows[k]))
        count += morris_row(rows[k], RowKind::LAMBDA);
      else
        solved[m++] = rows[k];
    }
    LaplacianRow<D> systems[BATCH];
    solve_laplacian_systems<D>(s_, g_, solved, m, t_.max_cond, systems);
    for (int k = 0; k < m; k++) count += corrected_row(solved[k], systems[k]);
    return count;
  }

  MorrisCount corrected_row(int i, const LaplacianRow<D> &row) const
  {
    out_.condition[i] = row.condition;
    if (!(row.condition <= t_.max_cond) || !std::isfinite(row.condition))
      return morris_row(i, RowKind::CONDITION);
    const double *const r = s_.r(), *const dw = s_.dw(), *const x = s_.e(0), *const y = s_.e(1);
    for (int k = s_.begin(i); k < s_.end(i); k++) {
      double sum = row.q[0] * x[k] + row.q[1] * y[k];
      if constexpr (D == 2) {
        sum += 2.0 / r[k] * quadratic(row, x[k], y[k]);
      } else {
        const double z = s_.e(2)[k];
        sum += row.q[2] * z + 2.0 / r[k] * quadratic(row, x[k], y[k], z);
      }
      out_.a[k] = g_.volume() * dw[k] * sum;
    }
    out_.diagonal[i] = row_sum(i);
    if (!(out_.diagonal[i] >= t_.min_diagonal && out_.diagonal[i] <= t_.max_diagonal))
      return morris_row(i, RowKind::DIAGONAL);
    return {};
  }

  MorrisCount morris_row(int i, RowKind reason) const
  {
    for (int k = s_.begin(i); k < s_.end(i); k++) {
      const double r = s_.r()[k];
      out_.a[k] = 2.0 * g_.volume() * s_.dw()[k] * r / (r * r + t_.eta_h2);
    }
    out_.morris[i] = 1;
    out_.diagonal[i] = row_sum(i);
    return {reason == RowKind::LAMBDA, reason == RowKind::CONDITION, reason == RowKind::DIAGONAL,
            reason == RowKind::SURFACE};
  }

  double row_sum(int i) const
  {
    double sum = 0.0;
    for (int k = s_.begin(i); k < s_.end(i); k++) sum += out_.a[k];
    return sum;
  }

  const Stencil &s_;
  const GradientWeights &g_;
  const LaplacianBounds &t_;
  const Role *role_;
  const Target &out_;
};

}    // namespace

LaplacianBounds laplacian_bounds(const LaplacianLimits &limits, const Kernel &kernel, double d)
{
  LaplacianBounds bounds;
  // a singular M has no g_ij, hence no corrected row, whatever the limits
  bounds.min_lambda = std::max(limits.min_lambda, GradientWeights::MIN_LAMBDA);
  bounds.max_cond = limits.max_cond;
  bounds.min_diagonal = -INF;
  bounds.max_diagonal = INF;
  bounds.eta_h2 = limits.eta * kernel.h() * kernel.h();
  // no bound: the lattice itself is of no interest
  if (limits.min_diagonal == -INF && limits.max_diagonal == INF) return bounds;
  const double lattice = lattice_diagonal(kernel, d) / (d * d);
  bounds.max_diagonal = -limits.min_diagonal * lattice;
  bounds.min_diagonal = -limits.max_diagonal * lattice;
  return bounds;
}

void LaplacianWeights::build(const Stencil &s, const GradientWeights &g, const Rows &rows,
                             const LaplacianBounds &bounds, const Role *role)
{
  a_.resize(s.pairs());
  diagonal_.assign(s.rows(), 0.0);
  condition_.assign(s.rows(), 0.0);
  morris_.assign(s.rows(), 0);
  const Target out = {a_.data(), diagonal_.data(), condition_.data(), morris_.data()};
  count_ = s.dim() == 2 ? RowBuilder<2>(s, g, bounds, role, out).build(rows)
                        : RowBuilder<3>(s, g, bounds, role, out).build(rows);
}

double LaplacianWeights::bytes() const
{
  return held(a_) + held(diagonal_) + held(condition_) + held(morris_);
}

void laplacian(const Cloud &cloud, const Rows &rows, const double *v, double *out)
{
  const Stencil &s = cloud.stencil();
  const Role *const role = cloud.role();
  const double *const a = cloud.laplacian().a();
  const int *const col = s.col();
  for_rows(rows, [&](int i) {
    double sum[3] = {};
    for (int k = s.begin(i); k < s.end(i); k++) {
      const int j = col[k];
      const double weight = role[j] & SLIP ? 0.0 : a[k];
      for (int c = 0; c < 3; c++) sum[c] += weight * (v[3 * i + c] - v[3 * j + c]);
    }
    for (int c = 0; c < 3; c++) out[3 * i + c] = sum[c];
  });
}

}    // namespace aleisph
