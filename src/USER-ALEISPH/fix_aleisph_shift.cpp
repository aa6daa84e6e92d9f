/* ----------------------------------------------------------------------
   LAMMPS - Large-scale Atomic/Molecular Massively Parallel Simulator
   USER-ALEISPH package
   SPDX-License-Identifier: GPL-2.0-only
------------------------------------------------------------------------- */

#include "fix_aleisph_shift.h"

#include "aleisph_eigenvalue_normal.h"
#include "aleisph_halo_owner.h"
#include "aleisph_halo_record.h"
#include "aleisph_halo_variable.h"
#include "aleisph_shift.h"
#include "atom.h"
#include "comm.h"
#include "domain.h"
#include "error.h"
#include "update.h"

#include <algorithm>
#include <cmath>
#include <limits>

using namespace LAMMPS_NS;
using namespace FixConst;
using aleisph::Part;
using aleisph::ShiftModel;

namespace {

constexpr char SHIFT[] = "aleisph_u";

// rate of the density model with a free surface, per U dt/d: more flips particles of the second layer
// between surface and fluid
constexpr double RATE_SURFACE = 0.3;
constexpr double MAX_SMOOTHING = 0.5, MAX_FILTER = 1.0;    // a larger share per step overshoots
// off walls, in spacings per U dt/d, and per step
constexpr double WALL_RATE = 0.25, WALL_STEP = 0.05;
// Skillen, Lind, Stansby & Rogers, Comput. Methods Appl. Mech. Engrg. 265 (2013) 163: D = 2 h |u| dt
constexpr double RATE_FULL = 2.0;

const aleisph::Record RECORD("aleisph/shift", 3,
                             {{"whether it has started", 0.0, 1.0},
                              {"the number of limited shifts", 0.0, aleisph::Record::MANY},
                              {"the velocity scale", 0.0, std::numeric_limits<double>::max()}});

}    // namespace

FixAleisphShift::FixAleisphShift(LAMMPS *lmp, int narg, char **arg) :
    Fix(lmp, narg, arg), params_(std::make_unique<aleisph::ShiftParams>()),
    eigenvalue_normal_(false), rate_(-1.0), step_(-1.0), smoothing_(-1.0), filter_(-1.0),
    owner_(nullptr), started_(false), coefficient_(0.0), scale_(0.0), limited_total_(0.0),
    limited_(0)
{
  parse(narg, arg);
  restart_global = 1;
  vector_flag = 1;
  size_vector = 5;
  global_freq = 1;
  extvector = 0;
}

FixAleisphShift::~FixAleisphShift()
{
  set_up_next_run(update);
}

int FixAleisphShift::setmask()
{
  return FINAL_INTEGRATE;
}

void FixAleisphShift::init()
{
  owner_ = FixAleisph::find(lmp, "Fix aleisph/shift");
  owner_->check_fluid_fix(this);
  int flag, cols;
  if (atom->find_custom(SHIFT, flag, cols) < 0)
    error->all(FLERR, "Fix aleisph/shift needs frame ale in fix aleisph/predictor");
  if (velocity_) velocity_->check();
  owner_->fields().add_writer(SHIFT, style);
  if (filter_ > 0.0 && owner_->scene().surface().present) owner_->scene().add_acceleration(this);
}

// A run that goes on keeps the shift that its last step left.
void FixAleisphShift::setup(int)
{
  if (!started_ || !owner_->fields().kept(SHIFT)) shift();
}

void FixAleisphShift::final_integrate()
{
  shift();
}

double FixAleisphShift::rate() const
{
  if (rate_ >= 0.0) return rate_;
  if (params_->model != ShiftModel::DENSITY) return RATE_FULL;
  return strain() || owner_->scene().surface().present ? RATE_SURFACE : RATE_FULL;
}

double FixAleisphShift::dt_over_d() const
{
  return update->dt / owner_->cloud().spacing();
}

void FixAleisphShift::shift()
{
  auto &cloud = owner_->cloud();
  const aleisph::Field velocity = owner_->fields().velocity();
  owner_->ranks().forward(velocity);
  const double *v = velocity.all();

  aleisph::Timers::Scope scope(owner_->timers(), Part::SHIFT);
  scale_ = velocity_scale();
  const double scale = scale_ * dt_over_d();
  params_->coefficient = coefficient_ = step_ >= 0.0 ? step_ : bounded(rate() * scale);
  params_->smoothing = std::min(smoothing_ * scale, MAX_SMOOTHING);
  params_->wall_step = params_->wall_distance > 0.0 ? std::min(WALL_RATE * scale, WALL_STEP) : 0.0;
  params_->dt = update->dt;
  if (params_->model == ShiftModel::DENSITY) {
    eps_.assign(cloud.size(), 0.0);
    aleisph::density_deviation(cloud, params_->published, eps_.data(),
                               owner_->scene().tension() ? owner_->scene().tension()->curvature()
                                                         : nullptr);
    owner_->ranks().forward(eps_.data(), 1);
  }
  dr_.assign(3 * static_cast<std::size_t>(atom->nlocal), 0.0);
  const auto count = aleisph::compute_shift(cloud, *params_, eps_.data(), v, dr_.data(),
                                            find_normals());
  if (strain() && owner_->scene().surface().present) remove_work();
  limited_ = count.limited;
  limited_total_ += count.limited;

  double *u = owner_->fields().property(SHIFT);
  aleisph::for_rows(cloud.fluid(), [&](int i) {
    for (int a = 0; a < 3; a++) u[3 * i + a] = dr_[3 * i + a] / update->dt;
  });
  owner_->fields().require_finite(dr_.data(), "Fix aleisph/shift", "shift");
  started_ = true;
}

// of eq 25; null: those of the cloud
const double *FixAleisphShift::find_normals()
{
  if (!eigenvalue_normal_ || !owner_->scene().surface().present) return nullptr;
  const auto &cloud = owner_->cloud();
  const auto *tension = owner_->scene().tension();
  normal_.assign(3 * static_cast<std::size_t>(atom->nlocal), 0.0);
  aleisph::eigenvalue_normals(
      cloud, aleisph::surface_rows(cloud), tension ? tension->contact() : nullptr,
      [this](double *field, int n) { owner_->ranks().forward(field, n); }, normal_.data());
  return normal_.data();
}

/* ----------------------------------------------------------------------
   The velocity filter acts on v* of this step: as an acceleration it is
   min(filter U dt/d, 1)/dt times the sum over pairs.
------------------------------------------------------------------------- */

void FixAleisphShift::add_acceleration(double *a)
{
  const double U = strain() ? scale_ : velocity_scale();
  const double share = std::min(filter_ * U * dt_over_d(), MAX_FILTER);
  auto &cloud = owner_->cloud();
  aleisph::Timers::Scope scope(owner_->timers(), Part::SHIFT);
  const std::size_t nall = cloud.size();
  grad_v_.assign(9 * nall, 0.0);
  const aleisph::SeenRoles neighbours = cloud.neighbours();
  rows_ = aleisph::select_rows(cloud.fluid(), [&](int i) {
    return (cloud.role()[i] & aleisph::SURFACE) || neighbours.any(i, aleisph::SURFACE);
  });
  aleisph::velocity_gradient(cloud, rows_, sliding_velocity(*owner_, sliding_), grad_v_.data());
  owner_->ranks().forward(grad_v_.data(), 9);
  work_.assign(3 * static_cast<std::size_t>(atom->nlocal), 0.0);
  aleisph::surface_velocity_filter(cloud, rows_, owner_->fields().velocity().all(), grad_v_.data(),
                                   work_.data());
  aleisph::for_rows(rows_, [&](int i) {
    for (int k = 3 * i; k < 3 * i + 3; k++) a[k] += share / update->dt * work_[k];
  });
}

/* ---------------------------------------------------------------------- */

void FixAleisphShift::write_restart(FILE *fp)
{
  double total;
  MPI_Reduce(&limited_total_, &total, 1, MPI_DOUBLE, MPI_SUM, 0, world);
  if (comm->me) return;
  write_record(fp, RECORD, {static_cast<double>(started_), total, scale_});
}

void FixAleisphShift::restart(char *buf)
{
  const auto state = read_record(error, this, RECORD, buf);
  started_ = state[0] != 0.0;
  limited_total_ = comm->me == 0 ? state[1] : 0.0;
  scale_ = state[2];
}

// C, shifts limited in this step and in all, largest |dr|/d, mean density deviation
double FixAleisphShift::compute_vector(int n)
{
  owner_ = FixAleisph::find(lmp, "Fix aleisph/shift");
  if (!owner_->ready()) return 0.0;
  const auto &fluid = owner_->cloud().fluid();
  switch (n) {
    case 0: return coefficient_;
    case 1: return owner_->ranks().sum(limited_);
    case 2: return owner_->ranks().sum(std::lround(limited_total_));
    case 3: {
      const auto length = [this](int i) {
        return 3 * static_cast<std::size_t>(i) < dr_.size()
            ? std::hypot(dr_[3 * i], dr_[3 * i + 1], dr_[3 * i + 2])
            : 0.0;
      };
      return owner_->ranks().max(aleisph::max_rows(fluid, length, 0.0)) / owner_->cloud().spacing();
    }
    default: {
      const double mine = aleisph::sum_rows(fluid, [this](int i) {
        return static_cast<std::size_t>(i) < eps_.size() ? eps_[i] : 0.0;
      });
      return owner_->ranks().total(mine) / std::max(1L, owner_->ranks().sum(fluid.size()));
    }
  }
}

double FixAleisphShift::memory_usage()
{
  return sizeof(double) *
      (eps_.size() + dr_.size() + grad_v_.size() + work_.size() + normal_.size() + grad_p_.size() +
       sliding_.size() + energy_.size());
}
