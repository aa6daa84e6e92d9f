/* ----------------------------------------------------------------------
   LAMMPS - Large-scale Atomic/Molecular Massively Parallel Simulator
   USER-ALEISPH package
   SPDX-License-Identifier: GPL-2.0-only
------------------------------------------------------------------------- */

#include "fix_aleisph_ppe.h"

#include "aleisph_halo_owner.h"
#include "aleisph_halo_solver.h"
#include "aleisph_lattice.h"
#include "aleisph_solve_ppe.h"
#include "atom.h"
#include "comm.h"
#include "domain.h"
#include "error.h"
#include "group.h"
#include "modify.h"
#include "update.h"
#include "utils.h"

#include <algorithm>
#include <cmath>

using namespace LAMMPS_NS;
using namespace FixConst;
using aleisph::Part;
using aleisph::PrecondType;
using aleisph::SolveStatus;

namespace {
// largest relative change of volume of a particle that a solve leaves: see the documentation
constexpr double DIVERGENCE = 1.0e-5;
// Wall rows at the edge of the fluid that are not trusted: lambda below this share of that of an
// intact corner (0.2 for the default kernel in 2d), or fewer fluid neighbours than this; an intact
// corner has three in 2d and one in 3d.
constexpr double MIN_WALL_LAMBDA = 0.7;
constexpr int MIN_WALL_FLUID_2D = 2, MIN_WALL_FLUID_3D = 1;
// From this number of unknowns on multigrid takes less time than ILU(0), in 2d and in 3d
constexpr double MIN_AMG_UNKNOWNS = 2000;
// Without keyword maxiter: so many iterations, or so many per particle along the longest side of the
// box. Jacobi needs most. Measured in 2d and 3d, open and closed, with 10 to 1600 particles across
// and tolerances of 1e-8 and 1e-12: 1 to 3.5 of them; three times that for scenes in disorder.
constexpr int LEAST_ITERATIONS = 1000;
constexpr double ITERATIONS_ACROSS = 10.0;
}    // namespace

FixAleisphPPE::FixAleisphPPE(LAMMPS *lmp, int narg, char **arg) :
    Fix(lmp, narg, arg), params_(), owner_(nullptr), version_(-1), closed_(false),
    matrix_(std::make_unique<aleisph::CsrMatrix>()),
    solver_(std::make_unique<AleisphHaloSolver>(lmp, "Fix aleisph/ppe")),
    krylov_(std::make_unique<aleisph::KrylovParams>()),
    report_(std::make_unique<aleisph::SolveReport>()), failures_(0), max_iterations_(0)
{
  params_.second_order = params_.gives_back = true;
  params_.reuse = true;
  params_.divergence = DIVERGENCE;
  params_.error_on_failure = true;
  parse(narg, arg);

  scalar_flag = vector_flag = 1;
  size_vector = 14;
  restart_file = 1;    // to be told when one is written
  global_freq = 1;
  extscalar = extvector = 0;
}

FixAleisphPPE::~FixAleisphPPE()
{
  set_up_next_run(update);
}

void FixAleisphPPE::parse(int narg, char **arg)
{
  std::string tol = "auto", divergence;
  for (int iarg = 3; iarg < narg; iarg += 2) {
    const std::string key = arg[iarg];
    if (iarg + 1 >= narg) utils::missing_cmd_args(FLERR, "fix aleisph/ppe " + key, error);
    const std::string value = arg[iarg + 1];
    if (key == "divergence") {
      divergence = value;
      params_.divergence = utils::numeric(FLERR, value, false, lmp);
      if (!(params_.divergence > 0.0) || !(params_.divergence < 1.0))
        error->all(FLERR, "Fix aleisph/ppe: divergence must lie between 0 and 1, not {}", value);
    } else if (key == "tol") {
      tol = value;
      if (tol == "auto") continue;
      krylov_->rtol = utils::numeric(FLERR, value, false, lmp);
      if (!(krylov_->rtol > 0.0) || !(krylov_->rtol < 1.0))
        error->all(FLERR, "Fix aleisph/ppe: tol must lie between 0 and 1, not {}", value);
    } else if (key == "maxiter") {
      max_iterations_ = utils::inumeric(FLERR, value, false, lmp);
      if (max_iterations_ < 1)
        error->all(FLERR, "Fix aleisph/ppe: maxiter must be at least 1, not {}", value);
    } else if (key == "preconditioner") {
      solver_->parse_preconditioner(value);
    } else if (key == "walls") {
      if (value != "second" && value != "first")
        error->all(FLERR, "Fix aleisph/ppe: walls must be second or first, not {}", value);
      params_.second_order = value == "second";
    } else if (key == "increment") {
      params_.gives_back = utils::logical(FLERR, value, false, lmp) == 1;
    } else if (key == "reuse") {
      params_.reuse = utils::logical(FLERR, value, false, lmp) == 1;
    } else if (key == "failure") {
      if (value != "error" && value != "warn")
        error->all(FLERR, "Fix aleisph/ppe: failure must be error or warn, not {}", value);
      params_.error_on_failure = value == "error";
    } else
      error->all(FLERR, "Fix aleisph/ppe: unknown keyword {}", key);
  }
  if (tol == "auto") return;
  if (!divergence.empty())
    error->all(FLERR, "Fix aleisph/ppe: tol {} and divergence {} exclude each other, give one", tol,
               divergence);
  params_.divergence = 0.0;
}

int FixAleisphPPE::setmask()
{
  return FINAL_INTEGRATE;
}

void FixAleisphPPE::init()
{
  owner_ = FixAleisph::find(lmp, "Fix aleisph/ppe");
  if (modify->get_fix_by_style("^aleisph/ppe$").size() > 1)
    error->all(FLERR, "Fix aleisph/ppe: there must be only one");
  if (igroup != owner_->igroup)
    error->all(FLERR, "Fix aleisph/ppe: group must be that of fix {}, {}", owner_->id,
               group->names[owner_->igroup]);
  version_ = -1;
  choose_preconditioner();
  choose_max_iterations();
}

void FixAleisphPPE::choose_max_iterations()
{
  const double side = std::max(
      {domain->prd[0], domain->prd[1], domain->dimension == 3 ? domain->prd[2] : 0.0});
  const double across = std::min(side / owner_->cloud().spacing(),
                                 static_cast<double>(atom->natoms));
  krylov_->max_iterations = max_iterations_
      ? max_iterations_
      : std::max(LEAST_ITERATIONS, static_cast<int>(std::min(1.0e9, ITERATIONS_ACROSS * across)));
}

// The preconditioner is kept from one run to the next: two runs give what one run gives
void FixAleisphPPE::choose_preconditioner()
{
  auto &solver = solver_->solver();
  solver.set_reuse(params_.reuse);
  if (!solver_->automatic()) return;
  const bool multigrid = aleisph::amg_available() && atom->natoms >= MIN_AMG_UNKNOWNS;
  solver.set_type(multigrid ? PrecondType::AMG : PrecondType::ILU0);
  if (comm->me == 0)
    utils::logmesg(lmp,
                   fmt::format("Fix aleisph/ppe: preconditioner {} for {} unknowns",
                               to_string(solver.type()), atom->natoms) +
                       "\n");
}

// The continued run starts with a new preconditioner: so must this one, for the same results
void FixAleisphPPE::write_restart_file(const char *)
{
  solver_->solver().forget();
}

/* ----------------------------------------------------------------------
   The first pressure of a simulation, so that run 0 has one and the first
   step a good initial guess. The predictor leaves dt times the acceleration
   without pressure in v*; the velocity itself is not touched.
------------------------------------------------------------------------- */

void FixAleisphPPE::setup(int)
{
  owner_->warnings().start();
  if (owner_->fields().pressure_known()) return;
  solve();
  find_gradient();
  remember();
  owner_->fields().set_pressure_known(true);
}

void FixAleisphPPE::final_integrate()
{
  solve();
  correct_velocity();
  owner_->warnings().step();
}

void FixAleisphPPE::solve()
{
  if (owner_->cloud().version() != version_) assemble();
  right_hand_side();

  set_target();
  krylov_->remove_mean = closed_;

  aleisph::Timers::Scope scope(owner_->timers(), Part::SOLVE);
  const aleisph::Field pressure = owner_->fields().pressure();
  const double *p = pressure.owned();
  p_.assign(p, p + owner_->cloud().size());
  const long builds = solver_->solver().counts().builds;
  *report_ = solver_->solve(*matrix_, *owner_, rhs_.data(), p_.data(), *krylov_);
  auto &tally = owner_->tally();
  tally.precond_builds += solver_->solver().counts().builds - builds;
  tally.replaced_pivots = solver_->solver().precond_report().replaced_pivots;
  act_on(*report_);
  std::copy(p_.begin(), p_.begin() + atom->nlocal, pressure.edit());
  owner_->ranks().forward(pressure);
}

void FixAleisphPPE::assemble()
{
  auto &cloud = owner_->cloud();
  // with viscosity the weights serve the predictor, too
  std::vector<double> laplacian = matrix_->release();
  cloud.laplacian_weights(owner_->scene().viscosity() > 0.0, laplacian);
  aleisph::PpeRows rows;
  {
    aleisph::Timers::Scope scope(owner_->timers(), Part::ASSEMBLY);
    rows = aleisph::assemble_ppe(cloud, std::move(laplacian), options(), *matrix_,
                                 owner_->fields().ppe_layout());
  }
  closed_ = !owner_->ranks().any(rows.dirichlet + rows.singular + rows.surface > 0);
  solver_->matrix_changed();

  auto &tally = owner_->tally();
  tally.ppe_builds++;
  tally.dirichlet_rows = rows.dirichlet;
  tally.singular_rows = rows.singular;
  tally.surface_rows = rows.surface;
  tally.limited_rows = rows.limited;
  version_ = cloud.version();
}

// Next to a free surface wall rows can lose their fluid neighbours
aleisph::PpeOptions FixAleisphPPE::options() const
{
  aleisph::PpeOptions options;
  options.isotropic_walls = params_.second_order;
  if (!owner_->scene().surface().present) return options;
  options.surface_offset = owner_->scene().surface().offset * owner_->cloud().spacing();
  if (owner_->scene().surface().follows) options.layer = owner_->fields().surface_layer();
  const auto &cloud = owner_->cloud();
  options.min_wall_lambda = MIN_WALL_LAMBDA *
      aleisph::lattice_corner_lambda(cloud.kernel(), cloud.spacing());
  options.min_wall_fluid = domain->dimension == 2 ? MIN_WALL_FLUID_2D : MIN_WALL_FLUID_3D;
  return options;
}

void FixAleisphPPE::act_on(const aleisph::SolveReport &report)
{
  if (report.ok()) return;
  if (report.status == SolveStatus::NOT_FINITE)
    owner_->fields().require_finite(owner_->fields().predicted().owned(), "Fix aleisph/ppe",
                                    "predicted velocity");
  failures_++;
  const std::string text = fmt::format(
      "Fix aleisph/ppe: pressure not converged at step {} ({}): {} iterations, residual {:.4g} of "
      "{:.4g}, {}",
      update->ntimestep, to_string(report.status), report.iterations, report.residual,
      report.rhs_norm, criterion());
  const std::string cause = owner_->warnings().likely_cause();
  if (params_.error_on_failure || report.status == SolveStatus::NOT_FINITE)
    error->all(FLERR, "{}{}; {}reduce the time step, or raise the tolerance or maxiter", text,
               cause, cause.empty() ? "" : "if that is not it, ");
  if (comm->me == 0) error->warning(FLERR, text + cause);
}

/* ---------------------------------------------------------------------- */

double FixAleisphPPE::compute_scalar()
{
  return report_->iterations;
}

double FixAleisphPPE::compute_vector(int n)
{
  owner_ = FixAleisph::find(lmp, "Fix aleisph/ppe");
  if (!owner_->ready()) return 0.0;
  switch (n) {
    case 0: return report_->iterations;
    case 1:
      return report_->rhs_norm > 0.0 ? report_->residual / report_->rhs_norm : report_->residual;
    case 2: return max_divergence();
    case 3: return report_->restarts;
    case 4: return report_->rhs_mean;
    case 5: return volume_change(report_->largest);
    case 6: return closed_;
    case 7: return failures_;
    case 8: return solver_->solver().counts().iterations;
    case 9: return solver_->solver().counts().builds;
    case 10: return solver_->solver().counts().fallbacks;
    case 11: return volume_change(report_->target);
    case 12: return max_divergence() * update->dt;
    default: return owner_->ranks().sum(owner_->tally().limited_rows);
  }
}

double FixAleisphPPE::memory_usage()
{
  return matrix_->bytes() + solver_->solver().bytes() +
      sizeof(double) * (rhs_.size() + div_.size() + grad_.size() + p_.size() + left_.size());
}
