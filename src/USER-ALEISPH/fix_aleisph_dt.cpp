/* ----------------------------------------------------------------------
   LAMMPS - Large-scale Atomic/Molecular Massively Parallel Simulator
   USER-ALEISPH package
   SPDX-License-Identifier: GPL-2.0-only
------------------------------------------------------------------------- */

#include "fix_aleisph_dt.h"

#include "aleisph_halo_owner.h"
#include "aleisph_halo_record.h"
#include "comm.h"
#include "error.h"
#include "force.h"
#include "group.h"
#include "modify.h"
#include "output.h"
#include "pair.h"
#include "update.h"
#include "utils.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <string>
#include <vector>

using namespace LAMMPS_NS;
using namespace FixConst;
using aleisph::StepBound;

namespace {

constexpr double NO_LIMIT = 1.0e30;    // what is shown for an infinite one
// two evaluations of the same state, on other ranks or after a restart
constexpr double SAME_LIMIT = 1.0e-9;

// the limit of this name, NONE if there is none
StepBound find_limit(const std::string &name)
{
  const int first = static_cast<int>(aleisph::FIRST_STEP_LIMIT);
  const int last = static_cast<int>(aleisph::LAST_STEP_LIMIT);
  for (int k = first; k <= last; k++)
    if (name == to_string(static_cast<StepBound>(k))) return static_cast<StepBound>(k);
  return StepBound::NONE;
}

// what a run that goes on needs, and what is reported
aleisph::Record record_of_choice()
{
  constexpr double MAX = std::numeric_limits<double>::max(), ANY = aleisph::Record::ANY;
  std::vector<aleisph::Record::Value> values = {
      {"the time step of the script", 0.0, MAX},
      {"the limit", -1.0, ANY},
      {"align", 0.0, MAX},
      {"the time step", 0.0, MAX},
      {"the time step without bound", 0.0, MAX},
      {"the ceiling", 0.0, ANY},
      {"the acting bound", 0.0, aleisph::NUM_STEP_BOUNDS - 1.0},
      {"the number of changes", 0.0, aleisph::Record::MANY}};
  for (int k = 0; k < aleisph::NUM_STEP_BOUNDS; k++) {
    values.push_back({"a bound", 0.0, ANY});
    values.push_back({"a number of choices", 0.0, aleisph::Record::MANY});
  }
  return {"aleisph/dt", 2, values};
}

// a share above 1 is unstable; the others are a matter of accuracy
bool is_stability_limit(StepBound bound)
{
  return bound == StepBound::VISCOUS || bound == StepBound::CONVECTION ||
      bound == StepBound::CAPILLARY;
}

}    // namespace

FixAleisphDt::FixAleisphDt(LAMMPS *lmp, int narg, char **arg) :
    Fix(lmp, narg, arg), every_(0), control_(std::make_unique<aleisph::StepControl>()),
    owner_(nullptr), script_dt_(0.0), limit_(-1.0), limit_align_(0.0), warned_(false)
{
  parse(narg, arg);

  nevery = 1;         // multiples of align and steps with restart files lie between
  time_depend = 1;    // LAMMPS adds up the time from step numbers since the last change
  restart_global = 1;
  scalar_flag = vector_flag = 1;
  size_vector = 14;
  global_freq = 1;
  extscalar = extvector = 0;
}

FixAleisphDt::~FixAleisphDt()
{
  set_up_next_run(update);
}

void FixAleisphDt::parse(int narg, char **arg)
{
  if (narg < 4) utils::missing_cmd_args(FLERR, "fix aleisph/dt", error);
  every_ = utils::inumeric(FLERR, arg[3], false, lmp);
  if (every_ < 1) error->all(FLERR, "Fix aleisph/dt: N must be at least 1, not {}", arg[3]);

  auto &params = control_->params;
  const std::map<std::string, double *> others = {
      {"min", &params.min}, {"max", &params.max}, {"grow", &params.grow}, {"align", &params.align}};
  for (int iarg = 4; iarg < narg; iarg += 2) {
    const std::string key = arg[iarg];
    const StepBound limit = find_limit(key);
    const auto other = others.find(key);
    if (limit == StepBound::NONE && other == others.end())
      error->all(FLERR, "Fix aleisph/dt: unknown keyword {}", key);
    if (iarg + 1 >= narg) utils::missing_cmd_args(FLERR, "fix aleisph/dt " + key, error);
    const char *text = arg[iarg + 1];
    const double value = utils::numeric(FLERR, text, false, lmp);
    if (!(value > 0.0) || !std::isfinite(value))
      error->all(FLERR, "Fix aleisph/dt: {} must be positive, not {}", key, text);
    if (is_stability_limit(limit) && value > 1.0)
      error->all(FLERR, "Fix aleisph/dt: {} must be at most 1, not {}", key, text);
    if (key == "grow" && !(value > 1.0))
      error->all(FLERR, "Fix aleisph/dt: grow must be greater than 1, not {}", text);
    (limit == StepBound::NONE ? *other->second : params.share[static_cast<int>(limit)]) = value;
  }
  if (params.min > params.max)
    error->all(FLERR, "Fix aleisph/dt: min {} is greater than max {}", params.min, params.max);
  if (params.align > 0.0 && params.align < params.min)
    error->all(
        FLERR,
        "Fix aleisph/dt: align {} is below min {}: no step could end on its multiples; use a "
        "larger align or a smaller min",
        params.align, params.min);
}

int FixAleisphDt::setmask()
{
  return END_OF_STEP;
}

/* ---------------------------------------------------------------------- */

void FixAleisphDt::init()
{
  owner_ = FixAleisph::find(lmp, "Fix aleisph/dt");
  if (modify->get_fix_by_style("^aleisph/dt$").size() > 1)
    error->all(FLERR, "Fix aleisph/dt: there must be only one");
  if (!modify->get_fix_by_style("^dt/reset").empty())
    error->all(FLERR, "Fix aleisph/dt cannot be used with fix dt/reset; unfix one of them");
  if (igroup != owner_->igroup)
    error->all(FLERR, "Fix aleisph/dt: group must be that of fix {}, {}", owner_->id,
               group->names[owner_->igroup]);
  owner_->scene().set_adaptive_step();
  warned_ = false;
  if (update->whichflag != 1) return;    // no run
  adopt_timestep();
  // now, as other styles use the time step in their setup
  apply(control_->state.dt);
}

// A timestep command bounds the next choice. Scripts that go on from a restart file often repeat
// the one of the first run; this does not count.
void FixAleisphDt::adopt_timestep()
{
  const double in_force = control_->state.dt;
  if (in_force > 0.0 && (update->dt == in_force || update->dt == script_dt_)) return;
  script_dt_ = update->dt;
  control_->start(script_dt_);
  limit_ = -1.0;
}

// A run that goes on where the last one ended, or was when its restart file was written, keeps
// the step and its place among the N steps. If anything has changed, there is a new choice.
void FixAleisphDt::setup(int)
{
  const double now = present_limit();
  const bool same = now == limit_ ||
      (std::isfinite(now) && std::fabs(now - limit_) <= SAME_LIMIT * now);
  if (!same || limit_align_ != control_->params.align) choose();
}

void FixAleisphDt::end_of_step()
{
  double multiple = time();
  const bool arrived = control_->at_multiple(multiple);
  if (arrived) {
    update->update_time();
    update->atime = multiple;    // without the rounding of the sum
  }
  if (arrived || update->ntimestep % every_ == 0) {
    adopt_timestep();
    const double before = update->dt;
    choose();
    if (update->dt != before) reschedule_dumps();
  }
  if (update->ntimestep == output->next_restart) remember();
}

void FixAleisphDt::post_run()
{
  remember();
}

double FixAleisphDt::time() const
{
  return update->atime + (update->ntimestep - update->atimestep) * update->dt;
}

double FixAleisphDt::present_limit() const
{
  return control_->bounds(owner_->scene().step_limits()).smallest();
}

void FixAleisphDt::remember()
{
  limit_ = present_limit();
  limit_align_ = control_->params.align;
}

/* ---------------------------------------------------------------------- */

void FixAleisphDt::choose()
{
  const bool possible = control_->choose(owner_->scene().step_limits(), time());
  const StepBound acting = control_->acting();
  const double dt = control_->state.bounds[acting];
  if (!possible && dt == 0.0)
    error->all(FLERR, "Fix aleisph/dt: limit {} allows no time step at step {}", to_string(acting),
               update->ntimestep);
  if (!possible)
    error->all(FLERR,
               "Fix aleisph/dt: time step {:.6g} at step {}, by limit {}, is below min {:.6g}; the "
               "run diverges, or min is too large",
               dt, update->ntimestep, to_string(acting), control_->params.min);
  if (acting == StepBound::NONE && !warned_ && comm->me == 0)
    error->warning(FLERR,
                   "Fix aleisph/dt: nothing limits the time step at step {}, it stays {:.6g}; use "
                   "keyword max",
                   update->ntimestep, control_->state.dt);
  if (acting == StepBound::NONE) warned_ = true;
  apply(control_->state.dt);
}

// what the timestep command does
void FixAleisphDt::apply(double dt)
{
  if (dt == update->dt) return;
  update->update_time();
  update->dt = dt;
  update->dt_default = 0;
  if (force->pair) force->pair->reset_dt();
  for (auto *fix : modify->get_fix_list()) fix->reset_dt();
}

// Dumps at given times. Output::reset_dt() finds their next step, but forgets it for dump styles
// without computes (dump atom) if it has come closer.
void FixAleisphDt::reschedule_dumps()
{
  output->reset_dt();
  for (int k = 0; k < output->ndump; k++)
    if (output->mode_dump[k])
      output->next_dump_any = std::min(output->next_dump_any, output->next_dump[k]);
  output->next = std::min(output->next, output->next_dump_any);
}

/* ---------------------------------------------------------------------- */

double FixAleisphDt::compute_scalar()
{
  return update->dt;
}

// acting bound; shares of the five limits; changes; choices by each of the
// seven bounds
double FixAleisphDt::compute_vector(int n)
{
  const auto &state = control_->state;
  if (n == 0) return state.acting;
  if (n <= 5) return std::min(state.bounds[static_cast<StepBound>(n)], NO_LIMIT);
  if (n == 6) return state.changes;
  return state.acted[n - 6];
}

void FixAleisphDt::write_restart(FILE *fp)
{
  if (comm->me) return;
  const auto &state = control_->state;
  std::vector<double> values = {script_dt_,      limit_,        limit_align_, state.dt,
                                state.unbounded, state.ceiling, state.acting, state.changes};
  for (int k = 0; k < aleisph::NUM_STEP_BOUNDS; k++) {
    values.push_back(state.bounds[static_cast<StepBound>(k)]);
    values.push_back(state.acted[k]);
  }
  write_record(fp, record_of_choice(), values);
}

void FixAleisphDt::restart(char *buf)
{
  const auto values = read_record(error, this, record_of_choice(), buf);
  auto next = values.begin();
  auto &state = control_->state;
  for (double *member : {&script_dt_, &limit_, &limit_align_, &state.dt, &state.unbounded,
                         &state.ceiling, &state.acting, &state.changes})
    *member = *next++;
  state.bounds = aleisph::StepBounds();
  for (int k = 0; k < aleisph::NUM_STEP_BOUNDS; k++) {
    state.bounds.lower(static_cast<StepBound>(k), *next++);
    state.acted[k] = *next++;
  }
}
