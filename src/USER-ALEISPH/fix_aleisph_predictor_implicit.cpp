/* ----------------------------------------------------------------------
   LAMMPS - Large-scale Atomic/Molecular Massively Parallel Simulator
   USER-ALEISPH package
   SPDX-License-Identifier: GPL-2.0-only

   The predictor: the step with implicit viscosity
------------------------------------------------------------------------- */

#include "fix_aleisph_predictor.h"

#include "aleisph_halo_owner.h"
#include "aleisph_halo_solver.h"
#include "aleisph_solve_viscous.h"
#include "atom.h"
#include "domain.h"
#include "error.h"
#include "update.h"

#include <cmath>

using namespace LAMMPS_NS;
using aleisph::Part;
using aleisph::PrecondType;

namespace {
// From this theta nu dt/d^2 on ILU(0), kept over some steps, takes less time than Jacobi
constexpr double MIN_ILU_NUMBER = 0.5;
}    // namespace

/* ----------------------------------------------------------------------
   (1 - theta dt nu lap) v_nu = v + dt (f/m - c.grad v - grad p/rho0 + (1-theta) nu lap v)
   v* = v_nu + dt/rho0 grad p
   The pressure gradient must be in the viscous solve: without it the steady
   state is off by dt grad p/rho0 next to no-slip walls.
------------------------------------------------------------------------- */

void FixAleisphPredictor::predict_implicit()
{
  aleisph::Timers::Scope scope(owner_->timers(), Part::MOMENTUM);
  auto &cloud = owner_->cloud();
  const double dt = update->dt;
  start(a_);
  add_convection(a_);
  add_wall_viscosity(a_);
  add_other_terms(a_);
  extrapolate(a_);
  add_body(a_);
  find_known_gradient();
  if (remembers()) add_memory(a_);

  const double *v = owner_->fields().velocity().all();
  double *vstar = owner_->fields().predicted().edit();
  predict_walls();

  add_viscosity(1.0 - params_.theta, a_);
  std::vector<double> &rhs = a_;
  aleisph::for_rows(cloud.fluid(), [&](int i) {
    for (int k = 3 * i; k < 3 * i + 3; k++)
      rhs[k] = v[k] + dt * (a_[k] - known_[k] / owner_->fluid().rho0);
  });
  aleisph::for_rows(cloud.wall(), [&](int i) {
    for (int k = 3 * i; k < 3 * i + 3; k++) rhs[k] = v[k];
  });

  if (viscous_version_ != cloud.version() || viscous_dt_ != dt) assemble_viscous();
  solve_viscous(rhs);
  aleisph::for_rows(cloud.fluid(), [&](int i) {
    for (int k = 3 * i; k < 3 * i + 3; k++)
      vstar[k] = rhs[k] + dt / owner_->fluid().rho0 * known_[k];
  });
}

void FixAleisphPredictor::assemble_viscous()
{
  auto &cloud = owner_->cloud();
  aleisph::assemble_viscous(cloud, params_.theta * update->dt * nu_, owner_->scene().conditions(),
                            *viscous_);
  if (solver_->automatic()) {
    const bool stiff = params_.theta * viscous_number() >= MIN_ILU_NUMBER;
    solver_->solver().set_type(stiff ? PrecondType::ILU0 : PrecondType::JACOBI);
  }
  solver_->matrix_changed();
  owner_->tally().viscous_builds++;
  viscous_version_ = cloud.version();
  viscous_dt_ = update->dt;
}

// rhs: 3 per particle; on return the solution. Components are solved one after the other.
void FixAleisphPredictor::solve_viscous(std::vector<double> &rhs)
{
  double norm = 0.0;
  for (const double value : rhs) norm += value * value;
  owner_->ranks().sum(1, &norm);
  aleisph::KrylovParams krylov;
  krylov.rtol = 0.0;
  krylov.atol = params_.tolerance * std::sqrt(norm);

  const double *v = owner_->fields().velocity().all();
  std::vector<double> b(atom->nlocal), u(owner_->cloud().size());
  viscous_iterations_ = 0;
  for (int a = 0; a < domain->dimension; a++) {
    aleisph::for_rows(atom->nlocal, [&](int i) {
      b[i] = rhs[3 * i + a];
      u[i] = v[3 * i + a];
    });
    const auto report = solver_->solve(*viscous_, *owner_, b.data(), u.data(), krylov);
    viscous_iterations_ += report.iterations;
    if (report.status == aleisph::SolveStatus::NOT_FINITE)
      owner_->fields().require_finite(rhs.data(), "Fix aleisph/predictor", "acceleration");
    if (!report.ok())
      error->all(FLERR,
                 "Fix aleisph/predictor: viscous velocity not converged at step {} ({}): {} "
                 "iterations, residual {:.4g}, tolerance {:.4g}; reduce the time step",
                 update->ntimestep, to_string(report.status), report.iterations, report.residual,
                 krylov.atol);
    aleisph::for_rows(atom->nlocal, [&](int i) { rhs[3 * i + a] = u[i]; });
  }
}
