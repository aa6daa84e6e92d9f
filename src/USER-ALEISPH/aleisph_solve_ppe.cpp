// SPDX-License-Identifier: GPL-2.0-only

#include "aleisph_solve_ppe.h"

#include "aleisph_cloud.h"
#include "aleisph_vectors.h"
#include "aleisph_wall_row.h"

#include <algorithm>
#include <cmath>
#include <utility>

namespace aleisph {
namespace {

// the off-diagonal entries of row i of -d^2 lap, where A has those of -lap
void fluid_row(const Stencil &s, int i, double d, CsrMatrix &A)
{
  for (int k = s.begin(i); k < s.end(i); k++) A.val(k) *= d * d;
}

// of length n.grad: the offset of a free surface, a row that p_i is added to
void normal_row(const Cloud &cloud, int i, double length, CsrMatrix &A)
{
  const Stencil &s = cloud.stencil();
  const GradientWeights &g = cloud.gradient();
  const Eigen::Vector3d n_L = length * g.volume() *
      (packed_matrix(g.inverse(), i) * at(cloud.normal(), i));
  for (int k = s.begin(i); k < s.end(i); k++) A.val(k) = s.dw()[k] * n_L.dot(direction(s, k));
}

void identity_row(CsrMatrix &A, int i)
{
  for (int k = A.begin(i); k < A.end(i); k++) A.val(k) = 0.0;
  A.diag(i) = 1.0;
}

RowType wanted_type(Role role)
{
  if (role & DIRICHLET) return RowType::DIRICHLET;
  if (role & DRY) return RowType::NONE;
  if (role & WALL) return RowType::WALL;
  if (role & SURFACE) return RowType::SURFACE;
  if (role & FLUID) return RowType::FLUID;
  return RowType::NONE;
}

bool too_few_fluid(const Stencil &s, const Role *role, int i, int needed)
{
  for (int k = s.begin(i); k < s.end(i) && needed > 0; k++)
    if ((role[s.col()[k]] & (FLUID | WALL)) == FLUID) needed--;
  return needed > 0;
}

// A NaN is not singular: it must reach the solver, which reports it.
bool singular_wall(const Cloud &cloud, int i, double diagonal, const PpeOptions &options)
{
  return std::fabs(diagonal) < MIN_WALL_DIAGONAL ||
      cloud.gradient().lambda(i) < options.min_wall_lambda ||
      too_few_fluid(cloud.stencil(), cloud.role(), i, options.min_wall_fluid);
}

// Where the fluid lies to one side, the exactness for linear functions is bought with wall neighbours
// of the wrong sign. A few such rows together make the matrix nearly singular. Here they weigh at most
// MAX_WRONG_SIGN of those of the right sign: the diagonal is at least a third of the sum of all.
bool limit_wrong_signs(CsrMatrix &A, int i)
{
  double right = 0.0, wrong = 0.0;
  for (int k = A.begin(i); k < A.end(i); k++)
    (A.val(k) < 0.0 ? right : wrong) += std::fabs(A.val(k));
  if (wrong <= MAX_WRONG_SIGN * right) return false;
  for (int k = A.begin(i); k < A.end(i); k++)
    if (A.val(k) > 0.0) A.val(k) *= MAX_WRONG_SIGN * right / wrong;
  return true;
}

// the off-diagonal entries of row i of -d n.grad; returns alpha/d
double wall_row(const Cloud &cloud, int i, bool isotropic, CsrMatrix &A)
{
  if (A.begin(i) == A.end(i)) return 0.0;
  double *const w = &A.val(A.begin(i));
  double alpha = isotropic ? isotropic_wall_row(cloud, i, w) : -1.0;
  if (alpha < 0.0) alpha = gradient_wall_row(cloud, i, w);
  for (int k = A.begin(i); k < A.end(i); k++) A.val(k) = -A.val(k);
  return alpha;
}

struct WallRow {
  double alpha = 0.0;
  bool limited = false;
};

// Next to a free surface the neighbours are too one-sided for isotropic rows: they would feed energy
// into the flow
WallRow wall_row(const Cloud &cloud, int i, const PpeOptions &options, CsrMatrix &A)
{
  WallRow row;
  const bool surface = options.isotropic_walls && cloud.neighbours().any(i, SURFACE);
  row.alpha = wall_row(cloud, i, options.isotropic_walls && !surface, A);
  row.limited = surface && limit_wrong_signs(A, i);
  return row;
}

// of the surface from its particle i
double surface_offset(const Cloud &cloud, int i, const PpeOptions &options)
{
  if (cloud.role()[i] & BALLISTIC) return 0.0;
  return options.surface_offset * (options.layer ? std::exp(options.layer[2 * i]) : 1.0);
}

RowType assemble_row(const Cloud &cloud, int i, const PpeOptions &options, CsrMatrix &A,
                     WallRow &wall)
{
  const Role role = cloud.role()[i];
  const double d = cloud.spacing();
  const RowType type = wanted_type(role);
  if (type == RowType::FLUID) fluid_row(cloud.stencil(), i, d, A);
  if (type == RowType::WALL) wall = wall_row(cloud, i, options, A);
  if (type == RowType::SURFACE) normal_row(cloud, i, surface_offset(cloud, i, options), A);

  const bool derivative = type == RowType::FLUID || type == RowType::WALL ||
      type == RowType::SURFACE;
  // the row of a derivative has zero sum: a constant pressure has no effect, to the last bit
  const double diagonal = derivative ? -A.row_sum(i) : 0.0;
  if (type == RowType::SURFACE && diagonal > 0.0)
    A.diag(i) = 1.0 + diagonal;
  else if (type == RowType::FLUID || type == RowType::WALL)
    A.diag(i) = diagonal;
  else
    identity_row(A, i);

  if ((type == RowType::FLUID && diagonal == 0.0) ||
      (type == RowType::WALL && singular_wall(cloud, i, diagonal, options))) {
    identity_row(A, i);
    return RowType::SINGULAR;
  }
  return type;
}

PpeRows count(const std::vector<RowType> &type)
{
  const auto rows = [&type](RowType which) {
    return static_cast<int>(std::count(type.begin(), type.end(), which));
  };
  return {rows(RowType::FLUID),    rows(RowType::WALL),    rows(RowType::DIRICHLET),
          rows(RowType::SINGULAR), rows(RowType::SURFACE), 0};
}

}    // namespace

PpeRows assemble_ppe(const Cloud &cloud, std::vector<double> &&laplacian, const PpeOptions &options,
                     CsrMatrix &A, PpeLayout &layout)
{
  const Stencil &s = cloud.stencil();
  A.reset(s.rows(), s.ptr(), s.col(), std::move(laplacian));
  layout.type.resize(s.rows());
  layout.alpha.assign(s.rows(), 0.0);
  const int limited = count_rows(s.rows(), [&](int i) {
    WallRow wall;
    layout.type[i] = assemble_row(cloud, i, options, A, wall);
    layout.alpha[i] = wall.alpha;
    return wall.limited && layout.type[i] == RowType::WALL;
  });
  PpeRows rows = count(layout.type);
  rows.limited = limited;
  return rows;
}

void ppe_rhs(const Cloud &cloud, const PpeLayout &layout, const PpeFields &fields, double *b)
{
  const double d = cloud.spacing();
  const auto &type = layout.type;
  for_rows(static_cast<int>(type.size()), [&](int i) {
    b[i] = 0.0;
    if (type[i] == RowType::FLUID) b[i] = -d * d * fields.rho_over_dt * fields.div[i];
    if (type[i] == RowType::DIRICHLET) b[i] = fields.p[i];
    if (type[i] == RowType::SURFACE || type[i] == RowType::SINGULAR) b[i] = fields.p_surf;
    if (fields.load && type[i] == RowType::SURFACE) b[i] += fields.load[i];
    if (type[i] == RowType::WALL) {
      double v_n = 0.0;
      for (int k = 3 * i; k < 3 * i + 3; k++)
        v_n += (fields.vstar[k] - fields.vwall[k]) * cloud.normal()[k];
      if (fields.second_order) v_n += d * layout.alpha[i] * fields.div[i];
      b[i] = -d * fields.rho_over_dt * v_n;
    }
  });
}

}    // namespace aleisph
