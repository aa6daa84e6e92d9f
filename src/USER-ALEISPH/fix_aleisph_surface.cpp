/* ----------------------------------------------------------------------
   LAMMPS - Large-scale Atomic/Molecular Massively Parallel Simulator
   USER-ALEISPH package
   SPDX-License-Identifier: GPL-2.0-only
------------------------------------------------------------------------- */

#include "fix_aleisph_surface.h"

#include "aleisph_halo_owner.h"
#include "aleisph_solve_ppe.h"
#include "aleisph_surface.h"
#include "aleisph_surface_layer.h"
#include "aleisph_surface_stress.h"
#include "atom.h"
#include "domain.h"
#include "error.h"
#include "modify.h"
#include "update.h"
#include "utils.h"

#include <algorithm>
#include <cmath>

using namespace LAMMPS_NS;
using namespace FixConst;
using aleisph::Part;

namespace {

// With surface tension the row at the centres gives better frequencies, as the cells of a layer
// that oscillates are stretched, and much less noise. Below a layer that has shrunk particles are
// loosely packed: with a shorter reach holes of one particle would count as surface, and their
// tension would destroy the drop.
constexpr double OFFSET = 0.5, OFFSET_TENSION = 0.0;
constexpr double REACH = 2.0, REACH_TENSION = 2.3;
constexpr char LAYER_FIX[] = "ALEISPH_S";

}    // namespace

FixAleisphSurface::FixAleisphSurface(LAMMPS *lmp, int narg, char **arg) :
    Fix(lmp, narg, arg), params_(std::make_unique<aleisph::SurfaceParams>()),
    surface_(std::make_unique<aleisph::FreeSurface>()), offset_(-1.0), reach_(-1.0), viscous_(true),
    fixed_(false), owner_(nullptr), version_(-1), count_(std::make_unique<aleisph::SurfaceCount>()),
    limited_(0)
{
  surface_->present = true;
  parse(narg, arg);
  vector_flag = 1;
  size_vector = 6;
  global_freq = 1;
  extvector = 0;
}

FixAleisphSurface::~FixAleisphSurface()
{
  set_up_next_run(update);
  if (modify && modify->get_fix_by_id(LAYER_FIX)) modify->delete_fix(LAYER_FIX);
}

void FixAleisphSurface::post_constructor()
{
  if (!fixed_ && offset_ != 0.0)
    modify->add_fix(fmt::format("{} all property/atom d2_aleisph_s 2 writedata no", LAYER_FIX));
}

void FixAleisphSurface::parse(int narg, char **arg)
{
  for (int iarg = 3; iarg < narg; iarg += 2) {
    const std::string key = arg[iarg];
    if (iarg + 1 >= narg) utils::missing_cmd_args(FLERR, "fix aleisph/surface " + key, error);
    const std::string value = arg[iarg + 1];
    const auto number = [&](double low, double high) {
      const double x = utils::numeric(FLERR, value, false, lmp);
      if (!(x >= low) || !(x <= high))
        error->all(FLERR, "Fix aleisph/surface: {} must lie between {} and {}, not {}", key, low,
                   high, value);
      return x;
    };
    if (key == "row") {
      if (value != "half" && value != "centre")
        error->all(FLERR, "Fix aleisph/surface: row must be half or centre, not {}", value);
      offset_ = value == "half" ? 0.5 : 0.0;
    } else if (key == "lambda") {
      params_->max_lambda = number(0.0, 1.0);
    } else if (key == "angle") {
      params_->half_angle = number(20.0, 90.0);
    } else if (key == "reach") {
      reach_ = number(1.0, 3.0);
    } else if (key == "pressure") {
      surface_->pressure = utils::numeric(FLERR, value, false, lmp);
    } else if (key == "floor") {
      surface_->floor = number(0.0, 0.5);
    } else if (key == "layer") {
      if (value != "follow" && value != "fixed")
        error->all(FLERR, "Fix aleisph/surface: layer must be follow or fixed, not {}", value);
      fixed_ = value == "fixed";
    } else if (key == "viscous") {
      viscous_ = utils::logical(FLERR, value, false, lmp) == 1;
    } else if (key == "dry") {
      surface_->dry_reach = value == "no" ? 0.0 : number(1.0, 2.0);
    } else
      error->all(FLERR, "Fix aleisph/surface: unknown keyword {}", key);
  }
}

int FixAleisphSurface::setmask()
{
  return PRE_FORCE;
}

void FixAleisphSurface::init()
{
  owner_ = FixAleisph::find(lmp, "Fix aleisph/surface");
  owner_->check_fluid_fix(this);
  const bool tension = !modify->get_fix_by_style("^aleisph/tension$").empty();
  surface_->offset = offset_ >= 0.0 ? offset_ : (tension ? OFFSET_TENSION : OFFSET);
  surface_->follows = !fixed_ && surface_->offset > 0.0;
  params_->reach = reach_ >= 0.0 ? reach_ : (tension ? REACH_TENSION : REACH);
  owner_->scene().set_surface(*surface_);
  owner_->scene().set_load(this);
  owner_->cloud().set_floor(surface_->floor);
  const double support = owner_->cloud().kernel().support() / owner_->cloud().spacing();
  params_->wall_reach = std::max(aleisph::SurfaceParams().wall_reach, support - 1.0);
  version_ = -1;
}

void FixAleisphSurface::setup_pre_force(int)
{
  const double most = aleisph::largest_pressure(owner_->fluid().rho0, owner_->cloud().spacing(),
                                                update->dt);
  if (!(std::fabs(surface_->pressure) <= most))
    error->all(FLERR,
               "Fix aleisph/surface: pressure {} is above {:.4g}, where its rounding alone moves "
               "fluid; look at the units",
               surface_->pressure, most);
  detect();
}

void FixAleisphSurface::pre_force(int)
{
  detect();
  if (follows()) follow();
}

// where particles move with the fluid, and what shifts them besides
bool FixAleisphSurface::follows() const
{
  return surface_->follows && owner_->scene().moving() && !owner_->fields().property("aleisph_w");
}

// to the places that the velocity at the start of the step has led to
void FixAleisphSurface::follow()
{
  const auto &cloud = owner_->cloud();
  const aleisph::Rows rows = aleisph::layered_rows(cloud);
  if (!stressed()) find_gradient(rows);    // else the stress has found it on the whole surface
  aleisph::Timers::Scope scope(owner_->timers(), Part::SURFACE);
  const double *shift = owner_->fields().property("aleisph_u");
  limited_ = aleisph::follow_layer(cloud, rows, grad_v_.data(), shift, update->dt,
                                   owner_->fields().surface_layer());
}

// of the velocity, at the start of the step
void FixAleisphSurface::find_gradient(const std::vector<int> &rows)
{
  owner_->ranks().forward(owner_->fields().velocity());
  aleisph::Timers::Scope scope(owner_->timers(), Part::SURFACE);
  grad_v_.resize(9 * static_cast<std::size_t>(atom->nlocal));
  aleisph::velocity_gradient(owner_->cloud(), rows, sliding_velocity(*owner_, sliding_),
                             grad_v_.data());
}

// fix aleisph/tension has this stress in its own pressure
bool FixAleisphSurface::stressed() const
{
  return viscous_ && owner_->scene().viscosity() > 0.0 && !owner_->scene().tension();
}

const double *FixAleisphSurface::surface_pressure() const
{
  return stressed() ? p_.data() : nullptr;
}

// Along the normal. Along the surface nothing is prescribed: the rows of Morris on the surface have
// no neighbors outside, so that no force acts there.
void FixAleisphSurface::find_stress()
{
  const auto &cloud = owner_->cloud();
  const aleisph::Rows rows = aleisph::select_rows(
      cloud.fluid(), [&](int i) { return aleisph::bound_surface(cloud.role()[i]); });
  find_gradient(rows);
  aleisph::Timers::Scope scope(owner_->timers(), Part::SURFACE);
  p_.assign(atom->nlocal, 0.0);
  const double mu = owner_->fluid().rho0 * owner_->scene().viscosity();
  aleisph::add_viscous_pressure(rows, cloud.normal(), mu, grad_v_.data(), domain->dimension,
                                p_.data());
}

double FixAleisphSurface::memory_usage()
{
  return sizeof(double) * (p_.capacity() + grad_v_.capacity());
}

void FixAleisphSurface::detect()
{
  if (owner_->cloud().version() != version_) find_particles();
  if (stressed()) find_stress();
}

void FixAleisphSurface::find_particles()
{
  auto &cloud = owner_->cloud();
  cloud.gradient();    // timed apart
  aleisph::Timers::Scope scope(owner_->timers(), Part::SURFACE);
  *count_ = aleisph::detect_surface(cloud, *params_);
  owner_->ranks().forward_roles(owner_->cloud());
  owner_->ranks().forward(cloud.normal(), 3);
  version_ = cloud.version();
}

// particles on the surface, ballistic ones, dry wall particles, clamped inverses, PPE surface rows,
// layers that are not stretched further
double FixAleisphSurface::compute_vector(int n)
{
  owner_ = FixAleisph::find(lmp, "Fix aleisph/surface");
  if (!owner_->ready()) return 0.0;
  switch (n) {
    case 0: return owner_->ranks().sum(count_->surface);
    case 1: return owner_->ranks().sum(count_->ballistic);
    case 2: return owner_->ranks().sum(owner_->tally().dry_walls);
    case 3: return owner_->ranks().sum(owner_->cloud().gradient().clamped());
    case 4: return owner_->ranks().sum(owner_->tally().surface_rows);
    default: return owner_->ranks().sum(limited_);
  }
}
