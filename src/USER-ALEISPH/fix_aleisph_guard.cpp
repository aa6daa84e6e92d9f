/* ----------------------------------------------------------------------
   LAMMPS - Large-scale Atomic/Molecular Massively Parallel Simulator
   USER-ALEISPH package
   SPDX-License-Identifier: GPL-2.0-only
------------------------------------------------------------------------- */

#include "fix_aleisph_guard.h"

#include "aleisph_guards.h"
#include "aleisph_halo_owner.h"
#include "aleisph_halo_record.h"
#include "aleisph_solve_ppe.h"
#include "atom.h"
#include "comm.h"
#include "domain.h"
#include "error.h"
#include "modify.h"
#include "update.h"
#include "utils.h"

#include <algorithm>
#include <cmath>
#include <limits>

using namespace LAMMPS_NS;
using namespace FixConst;
using aleisph::Part;

namespace {

constexpr char SHIFT[] = "aleisph_u";

// of each guard
aleisph::Record record_of_totals(int guards)
{
  std::vector<aleisph::Record::Value> values;
  for (int k = 0; k < guards; k++) {
    values.push_back({"a number of events", 0.0, aleisph::Record::MANY});
    values.push_back(
        {"an energy", -std::numeric_limits<double>::max(), std::numeric_limits<double>::max()});
  }
  return {"aleisph/guard", 2, values};
}

}    // namespace

FixAleisphGuard::FixAleisphGuard(LAMMPS *lmp, int narg, char **arg) :
    Fix(lmp, narg, arg), walls_(0.0), collision_(0.0), symmetric_(0.0), cap_(0.0),
    limit_pressure_(false), selfterm_(false), started_(false), shifted_(false),
    least_pressure_(0.0), owner_(nullptr)
{
  parse(narg, arg);
  restart_global = 1;
  vector_flag = 1;
  size_vector = 3 * NUM_GUARDS;
  global_freq = 1;
  extvector = 0;
}

FixAleisphGuard::~FixAleisphGuard()
{
  set_up_next_run(update);
}

void FixAleisphGuard::parse(int narg, char **arg)
{
  for (int iarg = 3; iarg < narg; iarg += 2) {
    const std::string key = arg[iarg];
    if (iarg + 1 >= narg) utils::missing_cmd_args(FLERR, "fix aleisph/guard " + key, error);
    const std::string value = arg[iarg + 1];
    const auto number = [&](double low, double high) {
      const double x = utils::numeric(FLERR, value, false, lmp);
      if (!(x >= low) || !(x <= high))
        error->all(FLERR, "Fix aleisph/guard: {} must lie between {} and {}, not {}", key, low,
                   high, value);
      return x;
    };
    if (key == "walls") {
      walls_ = number(0.0, 0.7);
    } else if (key == "collision") {
      collision_ = number(0.0, 1.0);
    } else if (key == "pressure") {
      limit_pressure_ = value != "no";
      if (limit_pressure_) least_pressure_ = utils::numeric(FLERR, value, false, lmp);
    } else if (key == "symmetric") {
      symmetric_ = number(0.0, 1.0);
    } else if (key == "selfterm") {
      selfterm_ = utils::logical(FLERR, value, false, lmp);
    } else if (key == "cap") {
      cap_ = utils::numeric(FLERR, value, false, lmp);
      if (!(cap_ > 0.0))
        error->all(FLERR, "Fix aleisph/guard: cap must be positive, not {}", value);
    } else
      error->all(FLERR, "Fix aleisph/guard: unknown keyword {}", key);
  }
}

int FixAleisphGuard::setmask()
{
  return FINAL_INTEGRATE;
}

void FixAleisphGuard::init()
{
  owner_ = FixAleisph::find(lmp, "Fix aleisph/guard");
  owner_->check_fluid_fix(this);
  if (selfterm_ && !owner_->scene().surface().present)
    error->all(FLERR, "Fix aleisph/guard: keyword selfterm needs a fix aleisph/surface");
  shifted_ = !modify->get_fix_by_style("^aleisph/shift$").empty();
  int flag, cols;
  if (walls_ > 0.0 && atom->find_custom(SHIFT, flag, cols) < 0)
    error->all(FLERR, "Fix aleisph/guard: keyword walls needs frame ale in fix aleisph/predictor");
  if (walls_ > 0.0) owner_->fields().add_writer(SHIFT, style);
  if (limit_pressure_ || symmetric_ > 0.0 || selfterm_) owner_->scene().set_pressure_guard(this);
}

// What the first shift leads to is held off walls, too. A run that goes on has this done already.
void FixAleisphGuard::setup(int)
{
  const double most = aleisph::largest_pressure(owner_->fluid().rho0, owner_->cloud().spacing(),
                                                update->dt);
  if (limit_pressure_ && !(std::fabs(least_pressure_) <= most))
    error->all(FLERR,
               "Fix aleisph/guard: pressure {} is above {:.4g}, where its rounding alone moves "
               "fluid; look at the units",
               least_pressure_, most);
  if (walls_ > 0.0 && (!started_ || !owner_->fields().kept(SHIFT))) hold_off_walls();
  started_ = true;
}

void FixAleisphGuard::final_integrate()
{
  aleisph::Timers::Scope scope(owner_->timers(), Part::SHIFT);
  if (collision_ > 0.0) collide();
  if (cap_ > 0.0) cap();
  if (walls_ > 0.0) hold_off_walls();
}

void FixAleisphGuard::record(Guard guard, long events, double energy)
{
  records_[guard].now = events;
  records_[guard].total += events;
  records_[guard].energy += energy;
}

/* ----------------------------------------------------------------------
   Guards of the pressure
------------------------------------------------------------------------- */

void FixAleisphGuard::guard_pressure(const aleisph::Field &p, double *grad)
{
  if (limit_pressure_) limit_pressure(p, grad);
  if (!selfterm_ && symmetric_ == 0.0) return;
  // they contain the pressure itself: that above the pressure outside, which must not act
  gauge_.assign(p.all(), p.all() + owner_->cloud().size());
  for (double &value : gauge_) value -= owner_->scene().surface().pressure;
  if (selfterm_) correct_self_terms(gauge_.data(), grad);
  if (symmetric_ > 0.0) replace_gradients(gauge_.data(), grad);
}

// kinetic energy of v* - dt/rho0 grad minus that with the gradient before
double FixAleisphGuard::gradient_energy(const std::vector<double> &before, const double *grad) const
{
  const double *vstar = owner_->fields().predicted().owned();
  const double factor = update->dt / owner_->fluid().rho0;
  const double sum = aleisph::sum_rows(owner_->cloud().fluid(), [&](int i) {
    double change = 0.0;
    for (int k = 3 * i; k < 3 * i + 3; k++) {
      const double now = vstar[k] - factor * grad[k], then = vstar[k] - factor * before[k];
      change += now * now - then * then;
    }
    return change;
  });
  return 0.5 * particle_mass(*owner_) * sum;
}

void FixAleisphGuard::limit_pressure(const aleisph::Field &pressure, double *grad)
{
  const aleisph::Rows low = aleisph::select_rows(
      atom->nlocal, [&](int i) { return pressure.owned()[i] < least_pressure_; });
  double energy = 0.0;
  if (owner_->ranks().sum(static_cast<long>(low.size()))) {
    double *p = pressure.edit();
    aleisph::for_rows(low, [&](int i) { p[i] = least_pressure_; });
    owner_->ranks().forward(pressure);
    auto &cloud = owner_->cloud();
    work_.assign(grad, grad + 3 * static_cast<std::size_t>(atom->nlocal));
    aleisph::gradient(cloud, cloud.fluid(), pressure.all(), grad);
    aleisph::for_rows(cloud.fluid(), [&](int i) {
      if (cloud.role()[i] & aleisph::BALLISTIC) std::fill_n(grad + 3 * i, 3, 0.0);
    });
    energy = gradient_energy(work_, grad);
  }
  record(PRESSURE, static_cast<long>(low.size()), energy);
}

void FixAleisphGuard::replace_gradients(const double *p, double *grad)
{
  auto &cloud = owner_->cloud();
  work_.assign(grad, grad + 3 * static_cast<std::size_t>(atom->nlocal));
  const int rows = aleisph::symmetric_gradient(cloud, free_rows(), symmetric_, p, grad);
  record(SYMMETRIC, rows, gradient_energy(work_, grad));
}

void FixAleisphGuard::correct_self_terms(const double *p, double *grad)
{
  auto &cloud = owner_->cloud();
  complete_inverses();
  work_.assign(grad, grad + 3 * static_cast<std::size_t>(atom->nlocal));
  const int rows = aleisph::correct_self_term(cloud, aleisph::SelfTermParams(), inverse_.data(), p,
                                              grad);
  record(SELFTERM, rows, gradient_energy(work_, grad));
}

// fluid that has a pressure gradient
aleisph::Rows FixAleisphGuard::free_rows() const
{
  const auto &cloud = owner_->cloud();
  return aleisph::select_rows(cloud.fluid(),
                              [&](int i) { return !(cloud.role()[i] & aleisph::BALLISTIC); });
}

// L of ghosts, too
void FixAleisphGuard::complete_inverses()
{
  const double *owned = owner_->cloud().gradient().inverse();
  inverse_.assign(6 * static_cast<std::size_t>(owner_->cloud().size()), 0.0);
  std::copy(owned, owned + 6 * static_cast<std::size_t>(atom->nlocal), inverse_.begin());
  owner_->ranks().forward(inverse_.data(), 6);
}

/* ----------------------------------------------------------------------
   Guards of the velocity
------------------------------------------------------------------------- */

// returns the change of kinetic energy
double FixAleisphGuard::change_velocity(const std::vector<double> &dv)
{
  double *v = owner_->fields().velocity().edit();
  const double sum = aleisph::sum_rows(owner_->cloud().fluid(), [&](int i) {
    double change = 0.0;
    for (int k = 3 * i; k < 3 * i + 3; k++) {
      change += dv[k] * (2.0 * v[k] + dv[k]);
      v[k] += dv[k];
    }
    return change;
  });
  return 0.5 * particle_mass(*owner_) * sum;
}

void FixAleisphGuard::collide()
{
  auto &cloud = owner_->cloud();
  const aleisph::Field velocity = owner_->fields().velocity();
  owner_->ranks().forward(velocity);
  const double *v = velocity.all();
  const double reach = collision_ * cloud.spacing();
  counts_.assign(cloud.size(), 0.0);
  aleisph::count_approaching(cloud, v, reach, counts_.data());
  owner_->ranks().forward(counts_.data(), 1);
  work_.assign(3 * static_cast<std::size_t>(atom->nlocal), 0.0);
  const int events = aleisph::collide(cloud, v, counts_.data(), reach, work_.data());
  record(COLLISION, events, change_velocity(work_));
}

void FixAleisphGuard::cap()
{
  const auto &fluid = owner_->cloud().fluid();
  double *v = owner_->fields().velocity().edit();
  const auto energy = [&]() {
    const double sum = aleisph::sum_rows(fluid, [v](int i) {
      return v[3 * i] * v[3 * i] + v[3 * i + 1] * v[3 * i + 1] + v[3 * i + 2] * v[3 * i + 2];
    });
    return 0.5 * particle_mass(*owner_) * sum;
  };
  const double before = energy();
  const int events = aleisph::cap_velocity(fluid, domain->dimension, cap_, v);
  record(CAP, events, events ? energy() - before : 0.0);
}

void FixAleisphGuard::hold_off_walls()
{
  auto &cloud = owner_->cloud();
  const aleisph::Field velocity = owner_->fields().velocity();
  owner_->ranks().forward(velocity);
  const double *v = velocity.all();
  double *u = owner_->fields().property(SHIFT);
  const std::size_t n = 3 * static_cast<std::size_t>(atom->nlocal);
  std::vector<double> w(n, 0.0), dw(n, 0.0);
  work_.assign(n, 0.0);
  aleisph::for_rows(cloud.fluid(), [&](int i) {
    for (int k = 3 * i; k < 3 * i + 3; k++) {
      if (!shifted_) u[k] = 0.0;    // nobody else sets it anew
      w[k] = v[k] + u[k];
    }
  });
  const aleisph::WallGuard guard = {walls_ * cloud.spacing(), update->dt, v, w.data()};
  const int events = aleisph::hold_off_walls(cloud, guard, work_.data(), dw.data());
  // the work of body forces along the displacement is lost or gained
  const double work = aleisph::sum_rows(cloud.fluid(), [&](int i) {
    double mine = 0.0;
    for (int a = 0; a < domain->dimension; a++) {
      u[3 * i + a] += dw[3 * i + a] - work_[3 * i + a];
      mine += atom->f[i][a] * dw[3 * i + a] * update->dt;
    }
    return mine;
  });
  record(WALLS, events, change_velocity(work_) - work);
}

/* ---------------------------------------------------------------------- */

void FixAleisphGuard::write_restart(FILE *fp)
{
  double state[2 * NUM_GUARDS];
  for (int k = 0; k < NUM_GUARDS; k++) {
    state[2 * k] = records_[k].total;
    state[2 * k + 1] = records_[k].energy;
  }
  std::vector<double> total(2 * NUM_GUARDS);
  MPI_Reduce(state, total.data(), 2 * NUM_GUARDS, MPI_DOUBLE, MPI_SUM, 0, world);
  if (comm->me) return;
  write_record(fp, record_of_totals(NUM_GUARDS), total);
}

// the totals are those of all ranks: rank 0 goes on with them

void FixAleisphGuard::restart(char *buf)
{
  const auto state = read_record(error, this, record_of_totals(NUM_GUARDS), buf);
  started_ = true;
  if (comm->me) return;
  for (int k = 0; k < NUM_GUARDS; k++) {
    records_[k].total = state[2 * k];
    records_[k].energy = state[2 * k + 1];
  }
}

// for walls, collision, pressure, symmetric, selfterm, cap: events in this step, then events
// since the start, then energy added since the start
double FixAleisphGuard::compute_vector(int n)
{
  const Record &record = records_[n % NUM_GUARDS];
  double mine = n < NUM_GUARDS ? record.now : record.total;
  if (n >= 2 * NUM_GUARDS) mine = record.energy;
  return FixAleisph::find(lmp, "Fix aleisph/guard")->ranks().total(mine);
}

double FixAleisphGuard::memory_usage()
{
  return sizeof(double) * (work_.size() + counts_.size() + inverse_.size() + gauge_.size());
}
