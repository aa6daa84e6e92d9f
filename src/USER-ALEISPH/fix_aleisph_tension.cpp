/* ----------------------------------------------------------------------
   LAMMPS - Large-scale Atomic/Molecular Massively Parallel Simulator
   USER-ALEISPH package
   SPDX-License-Identifier: GPL-2.0-only
------------------------------------------------------------------------- */

#include "fix_aleisph_tension.h"

#include "aleisph_halo_owner.h"
#include "aleisph_halo_variable.h"
#include "aleisph_solve_ppe.h"
#include "aleisph_surface_hold.h"
#include "aleisph_surface_stress.h"
#include "aleisph_tension_published.h"
#include "aleisph_tension_roughness.h"
#include "aleisph_tension_tangent.h"

#include "atom.h"
#include "comm.h"
#include "domain.h"
#include "error.h"
#include "modify.h"
#include "neigh_list.h"
#include "update.h"
#include "utils.h"

#include <algorithm>
#include <cmath>

using namespace LAMMPS_NS;
using namespace FixConst;
using aleisph::StepBound;

namespace {

// Of filter, factor and delta, which are about one: beyond, a value is a slip of the pen.
constexpr double MAX_RATE = 1.0e4;
constexpr double SAFE_SHARE = aleisph::DEFAULT_STEP_SHARES[static_cast<int>(StepBound::CAPILLARY)];

}    // namespace

FixAleisphTension::FixAleisphTension(LAMMPS *lmp, int narg, char **arg) :
    Fix(lmp, narg, arg), published_(false), given_sigma_(-1.0), sigma_(0.0), factor_(0.41),
    delta_(0.1), filter_(0.0), pressure_form_(true), force_form_(false), viscous_(true),
    form_given_(false), viscous_given_(false), owner_(nullptr), list_(nullptr), walls_(false),
    held_(0), version_(-1)
{
  parse(narg, arg);
  vector_flag = 1;
  size_vector = 9;
  global_freq = 1;
  extvector = 0;
}

FixAleisphTension::~FixAleisphTension()
{
  set_up_next_run(update);
  if (!modify) return;
  for (Fix *fix : modify->get_fix_by_style("^aleisph$"))
    dynamic_cast<FixAleisph *>(fix)->scene().remove_tension(this);
}

void FixAleisphTension::parse(int narg, char **arg)
{
  std::string published_only;
  int iarg = 3;
  while (iarg < narg) {
    const std::string key = arg[iarg];
    const int nvalues = key == "angle" ? 2 : 1;
    if (iarg + nvalues >= narg) utils::missing_cmd_args(FLERR, "fix aleisph/tension " + key, error);
    const std::string value = arg[iarg + 1];
    const auto positive = [&]() {
      const double x = utils::numeric(FLERR, value, false, lmp);
      if (!(x >= 0.0) || !std::isfinite(x))
        error->all(FLERR, "Fix aleisph/tension: {} must not be negative, it is {}", key, value);
      return x;
    };
    const auto rate = [&]() {
      const double x = positive();
      if (x > MAX_RATE)
        error->all(FLERR, "Fix aleisph/tension: {} must be at most {}, it is {}", key, MAX_RATE,
                   value);
      return x;
    };
    if (key == "sigma") {
      given_sigma_ = positive();
    } else if (key == "model") {
      if (value != "tangent" && value != "published")
        error->all(FLERR, "Fix aleisph/tension: model must be tangent or published, not {}", value);
      published_ = value == "published";
    } else if (key == "form") {
      set_form(value);
    } else if (key == "angle") {
      angles_.push_back(parse_angle(value, arg[iarg + 2]));
    } else if (key == "viscous") {
      viscous_ = utils::logical(FLERR, value, false, lmp);
      viscous_given_ = true;
    } else if (key == "filter") {
      filter_ = rate();
    } else if (key == "factor") {
      factor_ = rate();
      published_only = key;
    } else if (key == "delta") {
      delta_ = rate();
      published_only = key;
    } else
      error->all(FLERR, "Fix aleisph/tension: unknown keyword {}", key);
    iarg += 1 + nvalues;
  }
  if (!published_ && !published_only.empty())
    error->all(FLERR, "Fix aleisph/tension: keyword {} needs model published", published_only);
  if (published_ && !form_given_) set_form("both");
  if (published_ && !viscous_given_) viscous_ = false;
  if (!published_) delta_ = 1.0;    // the force acts on one layer of particles
}

void FixAleisphTension::set_form(const std::string &word)
{
  if (word != "pressure" && word != "force" && word != "both")
    error->all(FLERR, "Fix aleisph/tension: form must be pressure, force or both, not {}", word);
  pressure_form_ = word != "force";
  force_form_ = word != "pressure";
  form_given_ = true;
}

int FixAleisphTension::setmask()
{
  return force_form_ ? PRE_FORCE | POST_FORCE : PRE_FORCE;
}

/* ---------------------------------------------------------------------- */

void FixAleisphTension::init()
{
  owner_ = FixAleisph::find(lmp, "Fix aleisph/tension");
  owner_->check_fluid_fix(this);
  if (!owner_->scene().surface().present)
    error->all(FLERR, "Fix aleisph/tension needs a fix aleisph/surface, defined before it");
  sigma_ = given_sigma_ < 0.0 ? owner_->fluid().sigma : given_sigma_;
  if (given_sigma_ < 0.0 && sigma_ <= 0.0)
    error->all(FLERR,
               "Fix aleisph/tension: keyword sigma is required, the fluid of fix aleisph has no "
               "surface tension");
  walls_ = !modify->get_fix_by_style("^aleisph/wall$").empty();
  resolve_angles();
  version_ = -1;

  owner_->scene().set_tension(this);
  owner_->scene().add_limit(this);
  if (walls_) owner_->scene().set_velocity_guard(this);
  if (filter_ > 0.0) owner_->scene().add_acceleration(this);
  make_model();
}

void FixAleisphTension::make_model()
{
  if (published_)
    model_ = std::make_unique<aleisph::PublishedTension>(factor_);
  else
    model_ = std::make_unique<aleisph::TangentTension>(domain->dimension,
                                                       owner_->cloud().spacing());
  const double reach = model_->reach();
  if (reach == 0.0) return;
  owner_->request_list(this, reach);
}

void FixAleisphTension::init_list(int, NeighList *list)
{
  list_ = list;
}

/* ---------------------------------------------------------------------- */

void FixAleisphTension::setup_pre_force(int vflag)
{
  check_sigma();
  pre_force(vflag);
}

void FixAleisphTension::setup(int vflag)
{
  if (!owner_->scene().adaptive_step()) check_time_step();
  if (force_form_) post_force(vflag);
}

void FixAleisphTension::pre_force(int)
{
  aleisph::Timers::Scope scope(owner_->timers(), aleisph::Part::TENSION);
  if (owner_->cloud().version() != version_) rebuild();
  find_pressure();
}

const aleisph::TensionResult &FixAleisphTension::result() const
{
  return model_->result();
}

const double *FixAleisphTension::curvature() const
{
  return result().K.data();
}

const double *FixAleisphTension::surface_normal() const
{
  return result().N.data();
}

const double *FixAleisphTension::contact() const
{
  return result().contact.empty() ? nullptr : result().contact.data();
}

bool FixAleisphTension::ready() const
{
  return version_ >= 0 && version_ == owner_->cloud().version();
}

// everything that depends on the positions alone
void FixAleisphTension::rebuild()
{
  auto &cloud = owner_->cloud();
  if (walls_ && model_->binds_tips()) {
    aleisph::bind_tips(cloud);
    owner_->ranks().forward_roles(owner_->cloud());
  }
  if (walls_) evaluate_angles();
  aleisph::CandidateList far = {nullptr, nullptr, NEIGHMASK};
  if (list_) far = {list_->numneigh, list_->firstneigh, NEIGHMASK};
  model_->update({cloud, atom->x, far, walls_ ? cosine_.data() : nullptr,
                  [this](double *field, int n) { owner_->ranks().forward(field, n); }});
  if (!result().share.empty()) {
    aleisph::contact_surface_normals(result().rows, result().share.data(), result().N.data(),
                                     cloud.normal());
    owner_->ranks().forward(cloud.normal(), 3);
  }
  version_ = cloud.version();
}

void FixAleisphTension::find_pressure()
{
  p_.assign(atom->nlocal, 0.0);
  if (pressure_form_) aleisph::add_capillary_pressure(result(), sigma_, p_.data());
  const double mu = viscous_ ? owner_->fluid().rho0 * owner_->scene().viscosity() : 0.0;
  if (mu <= 0.0) return;
  owner_->ranks().forward(owner_->fields().velocity());
  find_velocity_gradient(result().rows);
  aleisph::add_viscous_pressure(result().rows, result().N.data(), mu, grad_v_.data(),
                                domain->dimension, p_.data());
}

void FixAleisphTension::find_velocity_gradient(const aleisph::Rows &rows)
{
  grad_v_.resize(9 * static_cast<std::size_t>(atom->nlocal));
  aleisph::velocity_gradient(owner_->cloud(), rows, sliding_velocity(*owner_, sliding_),
                             grad_v_.data());
}

// as a force the tension acts on the layer of surface particles
void FixAleisphTension::post_force(int)
{
  const double factor = model_->force_share(domain->dimension) * owner_->cloud().volume() * sigma_ *
      delta_ / owner_->cloud().spacing();
  aleisph::add_tension_force(result(), factor, domain->dimension, atom->f);
}

void FixAleisphTension::add_acceleration(double *a)
{
  auto &cloud = owner_->cloud();
  aleisph::Timers::Scope scope(owner_->timers(), aleisph::Part::TENSION);
  const double rate = aleisph::roughness_rate(filter_, sigma_, owner_->fluid().rho0,
                                              cloud.spacing(), update->dt);
  find_velocity_gradient(cloud.fluid());
  aleisph::add_roughness(cloud, rate, owner_->fields().velocity().all(), grad_v_.data(), a);
}

void FixAleisphTension::guard_velocity(double *v)
{
  auto &cloud = owner_->cloud();
  held_ = aleisph::hold_surface(cloud, result().rows, aleisph::HOLD_REACH * cloud.spacing(), v);
}

/* ---------------------------------------------------------------------- */

void FixAleisphTension::time_step_limits(aleisph::StepBounds &limits) const
{
  limits.lower(StepBound::CAPILLARY,
               aleisph::capillary_limit(owner_->fluid().rho0, owner_->cloud().spacing(), sigma_));
}

// Another fix has changed the time step during a run. That of fix aleisph/dt keeps the limit.
void FixAleisphTension::reset_dt()
{
  if (update->whichflag == 1 && owner_ && !owner_->scene().adaptive_step()) check_time_step();
}

// its pressure in a particle on the surface is at most about sigma/d
void FixAleisphTension::check_sigma() const
{
  const double d = owner_->cloud().spacing();
  const double most = d * aleisph::largest_pressure(owner_->fluid().rho0, d, update->dt);
  if (!(sigma_ <= most))
    error->all(FLERR,
               "Fix aleisph/tension: sigma {} is above {:.4g}, where the rounding of its pressure "
               "alone moves fluid; look at the units",
               sigma_, most);
}

void FixAleisphTension::check_time_step() const
{
  const double limit = aleisph::capillary_limit(owner_->fluid().rho0, owner_->cloud().spacing(),
                                                sigma_);
  const double dt = update->dt, safe = SAFE_SHARE * limit;
  // the messages give the safe step with six digits
  if (dt > limit * (1.0 + 1.0e-5))
    error->all(FLERR,
               "Fix aleisph/tension: timestep {:.6g} is above the capillary limit {:.6g}; use at "
               "most {:.6g}",
               dt, limit, safe);
  if (dt > safe * (1.0 + 1.0e-5) && !owner_->scene().adaptive_step() && comm->me == 0)
    error->warning(FLERR,
                   "Fix aleisph/tension: timestep {:.6g} is near the capillary limit {:.6g}; at "
                   "most {:.6g} is safe",
                   dt, limit, safe);
}

// mean K and largest |K| on the surface; particles that feel tension, contact particles, and those
// with too few neighbours, without their own curvature, with limited curvature, without normal;
// particles held above walls
double FixAleisphTension::compute_vector(int n)
{
  owner_ = FixAleisph::find(lmp, "Fix aleisph/tension");
  if (!owner_->ready() || version_ != owner_->cloud().version()) return 0.0;
  const aleisph::TensionResult &tension = result();
  const aleisph::CurvatureCount &count = tension.count;
  const int rows = static_cast<int>(tension.rows.size());
  const int counts[] = {rows,          tension.contacts,   count.few, count.unknown,
                        count.limited, tension.undirected, held_};
  auto &ranks = owner_->ranks();
  if (n == 0) return ranks.total(tension.total_curvature()) / std::max(1L, ranks.sum(rows));
  if (n == 1) return ranks.max(tension.largest_curvature());
  return ranks.sum(counts[n - 2]);
}

double FixAleisphTension::memory_usage()
{
  return (model_ ? model_->bytes() : 0.0) +
      sizeof(double) * (p_.size() + cosine_.size() + grad_v_.size());
}
