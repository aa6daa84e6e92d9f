/* ----------------------------------------------------------------------
   LAMMPS - Large-scale Atomic/Molecular Massively Parallel Simulator
   USER-ALEISPH package
   SPDX-License-Identifier: GPL-2.0-only
------------------------------------------------------------------------- */

#include "fix_aleisph.h"

#include "aleisph_halo_checks.h"
#include "aleisph_halo_owner.h"
#include "aleisph_halo_warnings.h"
#include "atom.h"
#include "comm.h"
#include "domain.h"
#include "error.h"
#include "group.h"
#include "input.h"
#include "modify.h"
#include "neigh_list.h"
#include "neigh_request.h"
#include "neighbor.h"
#include "output.h"
#include "update.h"

#include <algorithm>
#include <cmath>
#include <cstring>

using namespace LAMMPS_NS;
using namespace FixConst;
using aleisph::Part;
using aleisph::Role;

/* ---------------------------------------------------------------------- */

FixAleisph::FixAleisph(LAMMPS *lmp, int narg, char **arg) :
    Fix(lmp, narg, arg), list_(nullptr), reach_(0.0), walls_located_(false), own_cutoff_(0.0),
    fluid_(std::make_unique<aleisph::FluidProperties>()),
    timers_(std::make_unique<aleisph::Timers>()), scene_(std::make_unique<aleisph::Scene>()),
    ranks_(std::make_unique<aleisph::Ranks>(world, *timers_)),
    fields_(std::make_unique<AleisphFields>(lmp, *ranks_)),
    checks_(std::make_unique<AleisphChecks>(lmp, *this)),
    warnings_(std::make_unique<AleisphWarnings>(lmp, *this)), halo_plan_(nullptr)
{
  parse(narg, arg);

  comm_forward = 2;
  restart_global = 1;
  vector_flag = 1;
  size_vector = 14;
  global_freq = 1;
  extvector = 0;
  set_masses();
  set_skin();
  set_sorting();
}

FixAleisph::~FixAleisph()
{
  set_up_next_run(update);
  print_report();
  release_cutoff();
  fields_->delete_properties();
}

int FixAleisph::setmask()
{
  return INITIAL_INTEGRATE | PRE_EXCHANGE | PRE_FORCE;
}

void FixAleisph::post_constructor()
{
  fields_->add_properties();
}

/* ---------------------------------------------------------------------- */

FixAleisph *FixAleisph::find(LAMMPS *lmp, const std::string &caller)
{
  const auto owners = lmp->modify->get_fix_by_style("^aleisph$");
  if (owners.empty()) lmp->error->all(FLERR, "{} needs a fix aleisph, defined before it", caller);
  if (owners.size() > 1)
    lmp->error->all(FLERR, "{}: there are {} fixes of style aleisph, there must be one", caller,
                    owners.size());
  return dynamic_cast<FixAleisph *>(owners[0]);
}

void FixAleisph::check_fluid_fix(const Fix *fix) const
{
  if (modify->get_fix_by_style(fmt::format("^{}$", fix->style)).size() > 1)
    error->all(FLERR, "Fix {}: there must be only one", fix->style);
  for (const Fix *predictor : modify->get_fix_by_style("^aleisph/predictor$"))
    if (predictor->igroup != fix->igroup)
      error->all(FLERR, "Fix {}: group must be that of fix {}, {}", fix->style, predictor->id,
                 group->names[predictor->igroup]);
}

bool FixAleisph::ready() const
{
  return !ranks_->any(cloud_->version() == 0 || cloud_->stencil().rows() != atom->nlocal);
}

/* ---------------------------------------------------------------------- */

void FixAleisph::init()
{
  print_report();    // of the run before
  FixAleisph::find(lmp, "Fix aleisph");
  scene_->clear();
  cloud_->set_floor(0.0);
  walls_located_ = false;

  checks_->script();
  fields_->forget_writers();
  release_cutoff();
  reach_ = 0.0;
  request_list(this, cloud_->kernel().support());
  begin_report();
}

// Each frame of a rerun is another instant, without the pressure of the one before. rerun calls
// init() for every frame, and LAMMPS looks at the requests only once: those that are left would be
// of fixes that may be gone when it looks again.
void FixAleisph::begin_frame()
{
  fields_->set_pressure_known(false);
  NeighRequest **first = neighbor->requests;
  for (const auto &fix : modify->get_fix_by_style("^aleisph"))
    if (const NeighRequest *request = neighbor->find_request(fix)) {
      NeighRequest **last = first + neighbor->nrequest;
      NeighRequest **place = std::find(first, last, request);
      delete *place;
      std::copy(place + 1, last, place);
      neighbor->nrequest--;
    }
}

void FixAleisph::request_list(Fix *fix, double reach)
{
  require_reach(reach);
  neighbor->add_request(fix, NeighConst::REQ_FULL)->set_cutoff(reach);
}

void FixAleisph::init_list(int, NeighList *list)
{
  list_ = list;
}

// A script that has set none is as free as before: another kernel, skin or fix may need another one.
void FixAleisph::release_cutoff()
{
  if (own_cutoff_ > 0.0 && comm->cutghostuser == own_cutoff_) comm->cutghostuser = 0.0;
  own_cutoff_ = 0.0;
}

void FixAleisph::require_reach(double reach)
{
  reach_ = std::max(reach_, reach);
  const double needed = reach_ + neighbor->skin;
  if (comm->cutghostuser == 0.0 || comm->cutghostuser == own_cutoff_) {
    comm->cutghostuser = own_cutoff_ = needed;
  } else if (comm->cutghostuser < needed) {
    error->all(FLERR,
               "Fix aleisph: communication cutoff {} is smaller than reach + skin; use "
               "comm_modify cutoff {} or none at all",
               comm->cutghostuser, needed);
  }
}

/* ---------------------------------------------------------------------- */

void FixAleisph::setup_pre_force(int)
{
  checks_->setup();
  if (strcmp(input->command, "rerun") == 0) begin_frame();
  fields_->settle();
  fields_->check_kept();
  build_halo();
  rebuild();
}

// The first function of all styles that a step calls
void FixAleisph::initial_integrate(int)
{
  if (update->first_update == 0)
    error->all(FLERR,
               "Fix aleisph: a fix of this package was deleted by a command of run every; use pre "
               "yes");
}

// A continued run begins with particles sorted by their places. So must this one go on, or the two
// would add in another order. LAMMPS renews the neighbor lists when a restart file is due.
void FixAleisph::pre_exchange()
{
  if (output->next_restart == update->ntimestep) atom->nextsort = update->ntimestep;
}

void FixAleisph::pre_force(int)
{
  fields_->expire();
  const bool reneighbored = neighbor->ago == 0;
  if (reneighbored) build_halo();
  if (!reneighbored && !positions_changed()) return;
  if (!reneighbored) checks_->refuse_late_lists();
  rebuild();
}

// of the stencil: images of a particle are one column
aleisph::CandidateList FixAleisph::candidates() const
{
  return {list_->numneigh, list_->firstneigh, NEIGHMASK, ranks_->halo().canonical()};
}

bool FixAleisph::positions_changed()
{
  if (scene_->moving()) return true;
  const std::size_t n = 3 * static_cast<std::size_t>(atom->nlocal + atom->nghost);
  return ranks_->any(x_built_.size() != n ||
                     (n && std::memcmp(x_built_.data(), &atom->x[0][0], n * sizeof(double)) != 0));
}

void FixAleisph::rebuild()
{
  assign_roles();
  const int n = cloud_->size();
  fields_->reset(n);
  restore_walls();
  constexpr int FAULTS = AleisphChecks::FAULTS;
  long long found[FAULTS + 1] = {};
  checks_->find_faults(neighbor->ago == 0, found);
  found[FAULTS] = walls_changed();
  ranks_->largest(FAULTS + 1, found);
  checks_->refuse(found);
  locate_walls(found[FAULTS]);
  mark_dry_walls();
  cloud_->update(atom->x, candidates(), scene_->dry_rule());
  check_distances();
  if (scene_->moving() || n == 0)
    x_built_.clear();
  else
    x_built_.assign(&atom->x[0][0], &atom->x[0][0] + 3 * n);
}

void FixAleisph::check_distances()
{
  const auto &stencil = cloud_->stencil();
  double pairs[2] = {0.5 * stencil.coincident(), 0.5 * stencil.close()};
  ranks_->sum(2, pairs);
  close_pairs_ = pairs[1];
  if (pairs[0] > 0.0)
    error->all(FLERR, "Fix aleisph: {} pairs of particles lie at the same place", pairs[0]);
  if (neighbor->ago == 0) checks_->arrivals(close_pairs_ > 0.0, candidates());
}

void FixAleisph::assign_roles()
{
  const int n = atom->nlocal + atom->nghost;
  const int *mask = atom->mask;
  cloud_->reset(atom->nlocal, n);
  Role *role = cloud_->role();
  for (const auto &group : scene_->roles())
    aleisph::for_rows(n, [&](int i) {
      if (mask[i] & group.groupbit) role[i] |= group.role;
    });
}

/* ---------------------------------------------------------------------- */

void FixAleisph::complete_velocity(const aleisph::Field &v)
{
  if (scene_->conditions().empty()) ranks_->forward(v);
  for (auto *condition : scene_->conditions()) condition->impose(v);
}

/* ---------------------------------------------------------------------- */

double FixAleisph::compute_vector(int n)
{
  const auto &cloud = *cloud_;
  const auto &counts = cloud.counts();
  if (!ready()) return 0.0;
  switch (n) {
    case 0: return ranks_->sum(cloud.fluid().size());
    case 1: return ranks_->sum(cloud.wall().size());
    case 2: return ranks_->sum(tally_.dirichlet_rows);
    case 3: return ranks_->sum(cloud.buffer().size());
    case 4: return ranks_->sum(cloud_->laplacian_rows().morris_count().total());
    case 5: return ranks_->sum(tally_.singular_rows);
    case 6: return counts.stencil;
    case 7: return counts.gradient;
    case 8: return tally_.ppe_builds;
    case 9: return tally_.precond_builds;
    case 10: return counts.laplacian;
    case 11: {
      const auto &gradient = cloud_->gradient();
      return ranks_->min(aleisph::min_rows(
          cloud.fluid(), [&](int i) { return gradient.lambda(i); }, 1.0));
    }
    case 12:
      return static_cast<double>(ranks_->sum(cloud.stencil().pairs())) /
          std::max(1L, ranks_->sum(atom->nlocal));
    default: return close_pairs_;
  }
}

double FixAleisph::memory_usage()
{
  return cloud_->bytes() + ranks_->bytes() + fields_->bytes() + sizeof(double) * x_built_.size();
}
