/* ----------------------------------------------------------------------
   LAMMPS - Large-scale Atomic/Molecular Massively Parallel Simulator
   USER-ALEISPH package
   SPDX-License-Identifier: GPL-2.0-only
------------------------------------------------------------------------- */

#include "fix_aleisph_predictor.h"

#include "aleisph_halo_owner.h"
#include "aleisph_halo_record.h"
#include "aleisph_halo_solver.h"
#include "aleisph_halo_variable.h"
#include "aleisph_solve_viscous.h"
#include "aleisph_wall_contact.h"
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
#include <limits>

using namespace LAMMPS_NS;
using namespace FixConst;
using aleisph::Part;
using aleisph::StepBound;

namespace {

constexpr char ACCELERATION_FIX[] = "ALEISPH_A";
constexpr char TRANSPORT_FIX[] = "ALEISPH_W";
constexpr char SHIFT_FIX[] = "ALEISPH_U";
constexpr char CHANGE_FIX[] = "ALEISPH_DV";
const aleisph::Record RECORD("aleisph/predictor", 3,
                             {{"the last time step", 0.0, std::numeric_limits<double>::max()},
                              {"the time of the memory", 0.0, std::numeric_limits<double>::max()}});
constexpr double SAFE_SHARE = aleisph::DEFAULT_STEP_SHARES[static_cast<int>(StepBound::VISCOUS)];

}    // namespace

FixAleisphPredictor::FixAleisphPredictor(LAMMPS *lmp, int narg, char **arg) :
    Fix(lmp, narg, arg), owner_(nullptr), nu_(0.0), viscous_limit_(0.0), previous_dt_(0.0),
    memory_dt_(0.0), viscous_(std::make_unique<aleisph::CsrMatrix>()),
    solver_(std::make_unique<AleisphHaloSolver>(lmp, "Fix aleisph/predictor")),
    fit_(std::make_unique<aleisph::FluidFit>()), fit_version_(-1), viscous_version_(-1), viscous_dt_(0.0), viscous_iterations_(0)
{
  parse(narg, arg);
  check_transport();

  time_integrate = 1;
  restart_global = restart_file = 1;    // the second: to be told when one is written
  nevery = 1;
  vector_flag = 1;
  size_vector = 6;
  global_freq = 1;
  extvector = 0;
}

FixAleisphPredictor::~FixAleisphPredictor()
{
  set_up_next_run(update);
  if (!modify) return;
  for (const char *id : {ACCELERATION_FIX, TRANSPORT_FIX, SHIFT_FIX, CHANGE_FIX})
    if (modify->get_fix_by_id(id)) modify->delete_fix(id);
}

void FixAleisphPredictor::parse(int narg, char **arg)
{
  int iarg = 3;
  while (iarg < narg) {
    const std::string key = arg[iarg];
    const int nvalues = key == "transport" ? 3 : 1;
    if (iarg + nvalues >= narg)
      utils::missing_cmd_args(FLERR, "fix aleisph/predictor " + key, error);
    const std::string value = arg[iarg + 1];
    if (key == "frame") {
      if (value == "lagrangian")
        params_.frame = Frame::LAGRANGIAN;
      else if (value == "eulerian")
        params_.frame = Frame::EULERIAN;
      else if (value == "ale")
        params_.frame = Frame::ALE;
      else
        error->all(FLERR,
                   "Fix aleisph/predictor: frame must be lagrangian, eulerian or ale, not {}",
                   value);
    } else if (key == "nu" || key == "mu") {
      const double viscosity = utils::numeric(FLERR, value, false, lmp);
      if (!(viscosity >= 0.0) || !std::isfinite(viscosity))
        error->all(FLERR, "Fix aleisph/predictor: {} must not be negative, it is {}", key, value);
      params_.nu = viscosity;
      params_.dynamic = key == "mu";
    } else if (key == "scheme") {
      if (value == "explicit")
        params_.theta = 0.0;
      else if (value == "be")
        params_.theta = 1.0;
      else if (value == "cn")
        params_.theta = 0.5;
      else
        error->all(FLERR, "Fix aleisph/predictor: scheme must be explicit, be or cn, not {}",
                   value);
    } else if (key == "integrator") {
      if (value != "euler" && value != "ab2")
        error->all(FLERR, "Fix aleisph/predictor: integrator must be euler or ab2, not {}", value);
      params_.ab2 = value == "ab2";
    } else if (key == "motion") {
      if (value != "verlet" && value != "euler")
        error->all(FLERR, "Fix aleisph/predictor: motion must be verlet or euler, not {}", value);
      params_.verlet = value == "verlet";
    } else if (key == "tol") {
      params_.tolerance = utils::numeric(FLERR, value, false, lmp);
      if (!(params_.tolerance > 0.0) || !(params_.tolerance < 1.0))
        error->all(FLERR, "Fix aleisph/predictor: tol must lie between 0 and 1, not {}", value);
    } else if (key == "preconditioner") {
      solver_->parse_preconditioner(value);    // of the implicit solve
    } else if (key == "transport") {
      params_.transport.clear();
      for (int a = 1; a <= 3; a++)
        params_.transport.emplace_back(lmp, "Fix aleisph/predictor", "keyword transport",
                                       AleisphVariable::Kind::EQUAL_OR_ATOM, arg[iarg + a]);
    } else
      error->all(FLERR, "Fix aleisph/predictor: unknown keyword {}", key);
    iarg += 1 + nvalues;
  }
}

bool FixAleisphPredictor::prescribed() const
{
  return !params_.transport.empty();
}

void FixAleisphPredictor::check_transport() const
{
  if (prescribed() && params_.frame != Frame::ALE)
    error->all(FLERR, "Fix aleisph/predictor: keyword transport needs frame ale");
}

// what moves the particles of frame ale: given velocities, or shifts on top of the fluid's
void FixAleisphPredictor::check_shift() const
{
  const bool shifted = !modify->get_fix_by_style("^aleisph/shift$").empty() ||
      !modify->get_fix_by_style("^aleisph/guard$").empty();
  if (params_.frame != Frame::ALE || prescribed() == !shifted) return;
  if (shifted)
    error->all(FLERR,
               "Fix aleisph/predictor: keyword transport cannot be used with fix aleisph/shift or "
               "fix aleisph/guard");
  error->all(FLERR,
             "Fix aleisph/predictor: frame ale needs keyword transport or a fix aleisph/shift");
}

int FixAleisphPredictor::setmask()
{
  int mask = FINAL_INTEGRATE;
  if (params_.frame != Frame::EULERIAN) mask |= INITIAL_INTEGRATE;
  if (prescribed()) mask |= END_OF_STEP;
  return mask;
}

void FixAleisphPredictor::post_constructor()
{
  const auto add = [this](const char *id, const char *name) {
    return modify->add_fix(fmt::format("{} all property/atom d2_{} 3 writedata no", id, name));
  };
  if (params_.ab2) add(ACCELERATION_FIX, ACCELERATION);
  if (remembers() && !prescribed()) add(CHANGE_FIX, CHANGE);
  if (prescribed())
    add(TRANSPORT_FIX, TRANSPORT);
  else if (params_.frame == Frame::ALE)
    lose_shift(add(SHIFT_FIX, SHIFT));
}

// A new field holds nothing, unless it came from a restart file
void FixAleisphPredictor::lose_shift(const Fix *property) const
{
  if (property->restart_reset) return;
  for (Fix *owner : modify->get_fix_by_style("^aleisph$"))
    dynamic_cast<FixAleisph *>(owner)->fields().lose(SHIFT);
}

/* ---------------------------------------------------------------------- */

void FixAleisphPredictor::init()
{
  owner_ = FixAleisph::find(lmp, "Fix aleisph/predictor");
  owner_->scene().add_role(aleisph::FLUID, groupbit);
  if (params_.frame != Frame::EULERIAN) owner_->scene().set_moving();
  if (remembers()) owner_->scene().set_memory();
  if (group->count(igroup) == 0)
    error->all(FLERR, "Fix aleisph/predictor: group {} is empty", group->names[igroup]);
  if (modify->get_fix_by_style("^aleisph/predictor$").size() > 1)
    error->all(FLERR, "Fix aleisph/predictor: there must be only one");

  nu_ = owner_->fluid().nu;
  if (params_.nu >= 0.0) nu_ = params_.dynamic ? params_.nu / owner_->fluid().rho0 : params_.nu;
  owner_->scene().set_viscosity(nu_);
  viscous_version_ = fit_version_ = -1;
  for (const auto &component : params_.transport) component.check();
  check_shift();
  check_other_integrators();
  const auto &cloud = owner_->cloud();
  viscous_limit_ = aleisph::viscous_limit(cloud.kernel(), cloud.spacing(), nu_, params_.ab2);
  owner_->scene().add_limit(this);
}

void FixAleisphPredictor::reset_dt()
{
  if (!(update->dt > 0.0) || !std::isfinite(update->dt))
    error->all(FLERR, "Fix aleisph/predictor: timestep must be positive, it is {}", update->dt);
  check_viscous_limit();
}

void FixAleisphPredictor::check_other_integrators() const
{
  for (const Fix *fix : modify->get_fix_list()) {
    if (!fix->time_integrate || fix == this) continue;
    const int shared = aleisph::count_rows(atom->nlocal, [&](int i) {
      return (atom->mask[i] & groupbit) && (atom->mask[i] & fix->groupbit);
    });
    if (owner_->ranks().any(shared > 0))
      error->all(FLERR, "Fix {} ({}) would integrate fluid atoms as well as fix {} ({})", fix->id,
                 fix->style, id, style);
  }
}

void FixAleisphPredictor::check_viscosity() const
{
  const double most = aleisph::largest_viscosity(owner_->cloud().spacing(), update->dt);
  if (!(nu_ <= most))
    error->all(FLERR,
               "Fix aleisph/predictor: viscosity {} is above {:.4g}, where the rounding of its "
               "force alone moves fluid; look at the units",
               nu_, most);
}

void FixAleisphPredictor::check_viscous_limit() const
{
  if (nu_ == 0.0 || params_.theta > 0.0) return;
  const double safe_dt = SAFE_SHARE * viscous_limit_;
  if (update->dt > viscous_limit_)
    error->all(FLERR,
               "Fix aleisph/predictor: explicit viscosity is unstable at nu dt/d^2 = {:.4g}; use a "
               "timestep of at most {:.6g}, or scheme be or cn",
               viscous_number(), safe_dt);
  // the message gives the safe step with six digits
  if (update->dt > safe_dt * (1.0 + 1.0e-5) && !owner_->scene().adaptive_step() && comm->me == 0)
    error->warning(FLERR,
                   "Fix aleisph/predictor: nu dt/d^2 = {:.4g} is near the limit of explicit "
                   "viscosity; a timestep of at most {:.6g} is safe",
                   viscous_number(), safe_dt);
}

void FixAleisphPredictor::initial_integrate(int)
{
  double **x = atom->x;
  const double *w = prescribed() ? owner_->fields().property(TRANSPORT)
                                 : owner_->fields().velocity().owned();
  const double *shift = shifted() ? owner_->fields().property(SHIFT) : nullptr;
  const double *change = owner_->fields().property(CHANGE);
  const int dim = domain->dimension;
  const double dt = update->dt;
  aleisph::for_rows(owner_->cloud().fluid(), [&](int i) {
    for (int a = 0; a < dim; a++) {
      const int k = 3 * i + a;
      x[i][a] += dt * (w[k] + (shift ? shift[k] : 0.0) + (change ? 0.5 * dt * change[k] : 0.0));
    }
  });
}

void FixAleisphPredictor::end_of_step()
{
  evaluate_transport();
}

void FixAleisphPredictor::evaluate_transport()
{
  double *w = owner_->fields().property(TRANSPORT);
  std::vector<double> values;
  const auto &transport = params_.transport;
  const bool varies = std::any_of(transport.begin(), transport.end(),
                                  [](const AleisphVariable &c) { return !c.constant(); });
  const AleisphVariable::Evaluation evaluation(lmp, varies);
  for (int a = 0; a < domain->dimension; a++) {
    transport[a].evaluate(igroup, values);
    aleisph::for_rows(atom->nlocal, [&](int i) { w[3 * i + a] = values[i]; });
  }
  owner_->fields().require_finite(w, "Fix aleisph/predictor", "transport velocity");
}

void FixAleisphPredictor::final_integrate()
{
  owner_->ranks().forward(owner_->fields().velocity());
  if (params_.theta > 0.0)
    predict_implicit();
  else
    predict_explicit();
}

/* ---------------------------------------------------------------------- */

void FixAleisphPredictor::write_restart(FILE *fp)
{
  if (comm->me) return;
  write_record(fp, RECORD, {params_.ab2 ? previous_dt_ : 0.0, memory_dt_});
}

// The continued run starts with a new preconditioner: so must this one, for the same results
void FixAleisphPredictor::write_restart_file(const char *)
{
  solver_->solver().forget();
}

void FixAleisphPredictor::restart(char *buf)
{
  const auto state = read_record(error, this, RECORD, buf);
  const double dt = state[0];
  memory_dt_ = state[1];
  previous_dt_ = params_.ab2 ? dt : 0.0;    // without the field it stands for nothing
}

double FixAleisphPredictor::viscous_number() const
{
  return nu_ * update->dt / (owner_->cloud().spacing() * owner_->cloud().spacing());
}

// max |v|, or max |v + w|
double FixAleisphPredictor::largest_norm(const aleisph::Rows &rows, const double *v,
                                         const double *w) const
{
  const auto square = [&](int i) {
    double sum = 0.0;
    for (int k = 3 * i; k < 3 * i + 3; k++) {
      const double component = v[k] + (w ? w[k] : 0.0);
      sum += component * component;
    }
    return sum;
  };
  return std::sqrt(owner_->ranks().max(aleisph::max_rows(rows, square, 0.0)));
}

// of fluid, particles and walls: a wall that starts to move meets fluid at rest
double FixAleisphPredictor::largest_speed() const
{
  const auto &cloud = owner_->cloud();
  const double *v = owner_->fields().velocity().owned();
  double speed = std::max(largest_norm(cloud.fluid(), v), largest_norm(cloud.wall(), v));
  if (prescribed())
    speed = std::max(speed, largest_norm(cloud.fluid(), owner_->fields().property(TRANSPORT)));
  if (shifted())
    speed = std::max(speed, largest_norm(cloud.fluid(), v, owner_->fields().property(SHIFT)));
  return speed;
}

void FixAleisphPredictor::time_step_limits(aleisph::StepBounds &limits) const
{
  const auto &cloud = owner_->cloud();
  const double d = cloud.spacing();
  const double *f = atom->nmax ? &atom->f[0][0] : nullptr;
  const double acceleration = largest_norm(cloud.fluid(), f) / particle_mass(*owner_);
  limits.lower(StepBound::CFL, aleisph::cfl_limit(d, largest_speed()));
  limits.lower(StepBound::FORCE, aleisph::force_limit(d, acceleration));
  if (params_.theta == 0.0) limits.lower(StepBound::VISCOUS, viscous_limit_);
  if (params_.frame == Frame::EULERIAN && !params_.ab2) {
    const double speed = largest_norm(cloud.fluid(), owner_->fields().velocity().owned());
    limits.lower(StepBound::CONVECTION, aleisph::convection_limit(nu_, speed));
  }
}

double FixAleisphPredictor::advisable_time_step() const
{
  aleisph::StepBounds limits;
  time_step_limits(limits);
  return std::min(1.0e30, limits.scaled(aleisph::DEFAULT_STEP_SHARES).smallest());
}

double FixAleisphPredictor::compute_vector(int n)
{
  owner_ = FixAleisph::find(lmp, "Fix aleisph/predictor");
  if (!owner_->ready()) return 0.0;
  const auto &fluid = owner_->cloud().fluid();
  switch (n) {
    case 0:
      return largest_norm(fluid, owner_->fields().velocity().owned()) * update->dt /
          owner_->cloud().spacing();
    case 1: return viscous_number();
    case 2: return largest_norm(fluid, owner_->fields().velocity().owned());
    case 3: return advisable_time_step();
    case 4: return viscous_iterations_;
    default: return solver_->solver().counts().fallbacks;
  }
}

double FixAleisphPredictor::memory_usage()
{
  return viscous_->bytes() + solver_->solver().bytes() +
      sizeof(double) * (a_.size() + work_.size() + known_.size() + relative_.size());
}
