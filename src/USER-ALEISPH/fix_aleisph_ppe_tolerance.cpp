/* ----------------------------------------------------------------------
   LAMMPS - Large-scale Atomic/Molecular Massively Parallel Simulator
   USER-ALEISPH package
   SPDX-License-Identifier: GPL-2.0-only

   When a pressure is good enough: what ends the solve.
------------------------------------------------------------------------- */

#include "fix_aleisph_ppe.h"

#include "aleisph_halo_owner.h"
#include "aleisph_halo_solver.h"
#include "atom.h"
#include "domain.h"
#include "update.h"

#include <cmath>
#include <limits>

using namespace LAMMPS_NS;
using aleisph::PrecondType;

namespace {
// The scaled right hand side carries the rounding of div v*, about epsilon rho0 d/dt |v*|, and
// the product A p that of the pressure. A relative tolerance must not chase a residual below
// this; the factor covers the few dozen terms of a row.
constexpr double ROUNDING = 64.0 * std::numeric_limits<double>::epsilon();
// Besides the largest change of volume, a solve leaves no more than this share of what the pressure
// of the last step would leave, so that the pressure is that of a time this share of a step ago,
// however slow the flow; the first pressure is its own measure. By measurement: see the
// documentation.
constexpr double STEP_SHARE = 3.0e-3, FIRST_SHARE = 1.0e-8;
}    // namespace

// of a residual r of the scaled rows: the |div v| dt, or |v.n| dt/d at a wall, that it leaves
double FixAleisphPPE::volume_change(double residual) const
{
  const double d = owner_->cloud().spacing();
  return residual * update->dt * update->dt / (owner_->fluid().rho0 * d * d);
}

// What ends the solve: tol and the norm of the residual, or divergence and its largest entry
void FixAleisphPPE::set_target()
{
  auto &krylov = *krylov_;
  krylov.atol = rounding_level();
  if (params_.divergence == 0.0) return;
  krylov.largest = params_.divergence / volume_change(1.0);
  krylov.share = owner_->fields().pressure_known() ? STEP_SHARE / smooth_rows() : FIRST_SHARE;
}

// Multigrid reduces all parts of the residual alike. The others leave the smooth ones, of which
// this many rows from one end of the domain to the other add up in the velocity.
double FixAleisphPPE::smooth_rows() const
{
  if (solver_->solver().type() == PrecondType::AMG) return 1.0;
  return std::pow(atom->natoms, 1.0 / domain->dimension);
}

// in the norm of the criterion
double FixAleisphPPE::rounding_level() const
{
  if (params_.divergence > 0.0) return largest_rounding();
  const double *vstar = owner_->fields().predicted().owned();
  const double *p = owner_->fields().pressure().owned();
  double squares[2] = {
      aleisph::sum_rows(3 * atom->nlocal, [vstar](int k) { return vstar[k] * vstar[k]; }),
      aleisph::sum_rows(atom->nlocal, [p](int i) { return p[i] * p[i]; })};
  owner_->ranks().sum(2, squares);
  return ROUNDING *
      (owner_->fluid().rho0 * owner_->cloud().spacing() / update->dt * std::sqrt(squares[0]) +
       std::sqrt(squares[1]));
}

double FixAleisphPPE::largest_rounding() const
{
  const double *vstar = owner_->fields().predicted().owned();
  const double *p = owner_->fields().pressure().owned();
  const auto square = [vstar](int i) {
    double sum = 0.0;
    for (int a = 0; a < 3; a++) sum += vstar[3 * i + a] * vstar[3 * i + a];
    return sum;
  };
  double largest[2] = {aleisph::max_rows(atom->nlocal, square, 0.0),
                       aleisph::max_rows(
                           atom->nlocal, [p](int i) { return std::fabs(p[i]); }, 0.0)};
  owner_->ranks().max(2, largest);
  return ROUNDING *
      (owner_->fluid().rho0 * owner_->cloud().spacing() / update->dt * std::sqrt(largest[0]) +
       largest[1]);
}

std::string FixAleisphPPE::criterion() const
{
  if (params_.divergence == 0.0) return fmt::format("tolerance {:.4g}", krylov_->rtol);
  return fmt::format("change of volume {:.4g} for {:.4g}", volume_change(report_->largest),
                     volume_change(report_->target));
}
