// SPDX-License-Identifier: GPL-2.0-only
/* ----------------------------------------------------------------------
   Laplacian weights, Morikawa, Tsuji & Asai eqs 11-14, and their fallback,
   the row of Morris, Fox & Zhu, J. Comput. Phys. 136 (1997) 214.

   B_i is symmetric, so it has K = 3 (2d) or 6 (3d) unknowns. They are kept
   as the vector beta of its components in the orthonormal basis of the
   symmetric matrices (Mandel's: off-diagonal entries times sqrt 2), so that
   B : S = beta.m(S), and so that neither the system nor its condition
   number depends on the orientation of the axes. With w = V dW/dr and
   m_ij = m(e_ij (x) e_ij):
     A_ij  = 2 w/r beta.m_ij                                            (12)
     P     = sum_k A_ik r_ik = 2 T^t beta,  T = sum_j w m_ij (x) e_ij
     A*_ij = A_ij + P.g_ij                                              (13)
     G^t beta = -m(I),  G = sum_j w r m_ij (x) m_ij + T R^t,
     R     = sum_j r^2 m_ij (x) g_ij                                    (14)
   G is dimensionless; in the limit of many neighbours in the bulk it is
   -(2 id + m(I) m(I)^t)/(D + 2), whose condition number is (D + 2)/2.
------------------------------------------------------------------------- */

#include "aleisph_lattice.h"
#include "aleisph_operators.h"

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>
#include <limits>

namespace aleisph {
namespace {

constexpr double INF = std::numeric_limits<double>::infinity();

template <int D> struct Space {
  static constexpr int K = D * (D + 1) / 2;
  using Vector = Eigen::Matrix<double, D, 1>;
  using Sym = Eigen::Matrix<double, K, 1>;    // symmetric matrix in Mandel's basis
  using System = Eigen::Matrix<double, K, K>;
  using Mixed = Eigen::Matrix<double, K, D>;
};

template <class T> double held(const std::vector<T> &v)
{
  return static_cast<double>(v.capacity()) * sizeof(T);
}

// e (x) e in Mandel's basis
inline Space<2>::Sym mandel(const Space<2>::Vector &e)
{
  static const double sqrt2 = std::sqrt(2.0);
  return {e[0] * e[0], e[1] * e[1], sqrt2 * e[0] * e[1]};
}

inline Space<3>::Sym mandel(const Space<3>::Vector &e)
{
  static const double sqrt2 = std::sqrt(2.0);
  Space<3>::Sym m;
  m << e[0] * e[0], e[1] * e[1], e[2] * e[2], sqrt2 * e[1] * e[2], sqrt2 * e[0] * e[2],
      sqrt2 * e[0] * e[1];
  return m;
}

// everything that a row is computed from
template <int D> class Geometry {
 public:
  Geometry(const Stencil &s, const GradientWeights &g, double volume) :
      s_(s), r_(s.r()), dw_(s.dw()), volume_(volume)
  {
    for (int a = 0; a < D; a++) {
      e_[a] = s.e(a);
      g_[a] = g.g(a);
    }
  }
  int begin(int i) const { return s_.begin(i); }
  int end(int i) const { return s_.end(i); }
  double r(int k) const { return r_[k]; }
  double w(int k) const { return volume_ * dw_[k]; }
  typename Space<D>::Vector e(int k) const { return gather(e_, k); }
  typename Space<D>::Vector g(int k) const { return gather(g_, k); }

 private:
  static typename Space<D>::Vector gather(const double *const *c, int k)
  {
    typename Space<D>::Vector v;
    for (int a = 0; a < D; a++) v[a] = c[a][k];
    return v;
  }

  const Stencil &s_;
  const double *r_, *dw_, *e_[D], *g_[D];
  double volume_;
};

template <int D> struct Moments {
  typename Space<D>::System G;
  typename Space<D>::Mixed T;
};

template <int D> Moments<D> moments(const Geometry<D> &geo, int i)
{
  typename Space<D>::System Q = Space<D>::System::Zero();
  typename Space<D>::Mixed T = Space<D>::Mixed::Zero(), R = Space<D>::Mixed::Zero();
  for (int k = geo.begin(i); k < geo.end(i); k++) {
    const double r = geo.r(k), w = geo.w(k);
    const typename Space<D>::Vector e_ij = geo.e(k);
    const typename Space<D>::Sym m_ij = mandel(e_ij);
    Q.noalias() += (w * r) * m_ij * m_ij.transpose();
    T.noalias() += w * m_ij * e_ij.transpose();
    R.noalias() += (r * r) * m_ij * geo.g(k).transpose();
  }
  Q.noalias() += T * R.transpose();
  return {Q, T};
}

// The condition number of G: the Frobenius bound |G||G^-1|, at most K times
// the 2-norm one, where that suffices to accept the row, else the 2-norm one.
template <class System>
double condition_number(const System &G, const System &inverse, double limit)
{
  const double bound = G.norm() * inverse.norm();
  if (bound <= limit) return bound;
  const auto sigma = Eigen::JacobiSVD<System>(G).singularValues();
  const double smallest = sigma[sigma.size() - 1];
  return smallest > 0.0 ? sigma[0] / smallest : INF;
}

// false also for a system that is singular to working precision
bool acceptable(double condition, double limit)
{
  return condition <= limit && std::isfinite(condition);
}

// Writes the corrected row and returns its diagonal; condition receives the
// condition number of its system. If that is not acceptable, nothing is written.
template <int D>
double corrected_row(const Geometry<D> &geo, int i, double max_cond, double *a, double &condition)
{
  using Sym = typename Space<D>::Sym;
  using System = typename Space<D>::System;
  const Moments<D> m = moments<D>(geo, i);
  const Eigen::PartialPivLU<System> lu(m.G.transpose());
  condition = condition_number<System>(m.G, lu.inverse(), max_cond);
  if (!acceptable(condition, max_cond)) return 0.0;

  Sym rhs = Sym::Zero();
  rhs.template head<D>().setConstant(-1.0);
  const Sym beta = lu.solve(rhs);
  const typename Space<D>::Vector P = 2.0 * m.T.transpose() * beta;
  double sum = 0.0;
  for (int k = geo.begin(i); k < geo.end(i); k++) {
    a[k] = 2.0 * geo.w(k) / geo.r(k) * beta.dot(mandel(geo.e(k))) + P.dot(geo.g(k));
    sum += a[k];
  }
  return sum;
}

template <int D> double morris_row(const Geometry<D> &geo, int i, double eta_h2, double *a)
{
  double sum = 0.0;
  for (int k = geo.begin(i); k < geo.end(i); k++) {
    const double r = geo.r(k);
    a[k] = 2.0 * geo.w(k) * r / (r * r + eta_h2);
    sum += a[k];
  }
  return sum;
}

enum class RowKind { CORRECTED, LAMBDA, CONDITION, DIAGONAL, SURFACE };

// LaplacianLimits in the units of the row
struct Thresholds {
  double lambda, cond;
  double min_diagonal, max_diagonal;    // of sum_j a_ij [1/length^2]
  double eta_h2;
};

Thresholds thresholds(const LaplacianLimits &limits, const Kernel &kernel, double d)
{
  Thresholds t;
  // a singular M has no g_ij, hence no corrected row, whatever the limits
  t.lambda = std::max(limits.min_lambda, GradientWeights::MIN_LAMBDA);
  t.cond = limits.max_cond;
  t.min_diagonal = -INF;
  t.max_diagonal = INF;
  t.eta_h2 = limits.eta * kernel.h() * kernel.h();
  if (limits.min_diagonal == -INF && limits.max_diagonal == INF) return t;    // the lattice itself
  const double lattice = lattice_diagonal(kernel, d) / (d * d);
  t.max_diagonal = -limits.min_diagonal * lattice;
  t.min_diagonal = -limits.max_diagonal * lattice;
  return t;
}

// where the results go: a per pair, the others per row
struct Target {
  double *a, *diagonal, *condition;
  char *morris;
};

template <int D>
RowKind try_corrected_row(const Geometry<D> &geo, int i, double lambda, const Thresholds &t,
                          const Target &out)
{
  if (!(lambda >= t.lambda)) return RowKind::LAMBDA;
  out.diagonal[i] = corrected_row<D>(geo, i, t.cond, out.a, out.condition[i]);
  if (!acceptable(out.condition[i], t.cond)) return RowKind::CONDITION;
  const bool good = out.diagonal[i] >= t.min_diagonal && out.diagonal[i] <= t.max_diagonal;
  return good ? RowKind::CORRECTED : RowKind::DIAGONAL;
}

template <int D>
MorrisCount build_rows(const Stencil &s, const GradientWeights &g, const Rows &rows, double volume,
                       const Thresholds &t, const Role *role, const Target &out)
{
  const Geometry<D> geo(s, g, volume);
  MorrisCount count;
  for (int i : rows) {
    const bool surface = role && (role[i] & SURFACE);
    const RowKind kind = surface ? RowKind::SURFACE
                                 : try_corrected_row<D>(geo, i, g.lambda(i), t, out);
    if (kind == RowKind::CORRECTED) continue;
    count.lambda += kind == RowKind::LAMBDA;
    count.condition += kind == RowKind::CONDITION;
    count.diagonal += kind == RowKind::DIAGONAL;
    count.surface += kind == RowKind::SURFACE;
    out.morris[i] = 1;
    out.diagonal[i] = morris_row<D>(geo, i, t.eta_h2, out.a);
  }
  return count;
}

}    // namespace

void LaplacianWeights::build(const Stencil &s, const GradientWeights &g, const Rows &rows,
                             double volume, const Kernel &kernel, double d,
                             const LaplacianLimits &limits, const Role *role)
{
  a_.assign(s.pairs(), 0.0);
  diagonal_.assign(s.rows(), 0.0);
  condition_.assign(s.rows(), 0.0);
  morris_.assign(s.rows(), 0);
  const Thresholds t = thresholds(limits, kernel, d);
  const Target out = {a_.data(), diagonal_.data(), condition_.data(), morris_.data()};
  count_ = s.dim() == 2 ? build_rows<2>(s, g, rows, volume, t, role, out)
                        : build_rows<3>(s, g, rows, volume, t, role, out);
}

double LaplacianWeights::bytes() const
{
  return held(a_) + held(diagonal_) + held(condition_) + held(morris_);
}

void laplacian(const Stencil &s, const LaplacianWeights &w, const Rows &rows, const double *v,
               const Role *role, double *out)
{
  using Map = Eigen::Map<const Eigen::Vector3d>;
  const double *a = w.a();
  const int *col = s.col();
  for (int i : rows) {
    const Eigen::Vector3d v_i = Map(v + 3 * i);
    Eigen::Vector3d sum = Eigen::Vector3d::Zero();
    for (int k = s.begin(i); k < s.end(i); k++) {
      const int j = col[k];
      if (!(role[j] & SLIP)) sum += a[k] * (v_i - Map(v + 3 * j));
    }
    Eigen::Map<Eigen::Vector3d>(out + 3 * i) = sum;
  }
}

}    // namespace aleisph
