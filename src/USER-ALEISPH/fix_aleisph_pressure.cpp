/* ----------------------------------------------------------------------
   LAMMPS - Large-scale Atomic/Molecular Massively Parallel Simulator
   USER-ALEISPH package
   SPDX-License-Identifier: GPL-2.0-only
------------------------------------------------------------------------- */

#include "fix_aleisph_pressure.h"

#include "aleisph_halo_owner.h"
#include "aleisph_halo_variable.h"
#include "aleisph_nearest.h"
#include "aleisph_solve_ppe.h"
#include "aleisph_vectors.h"
#include "atom.h"
#include "domain.h"
#include "error.h"
#include "group.h"
#include "update.h"
#include "utils.h"

#include <cmath>
#include <cstring>

using namespace LAMMPS_NS;
using namespace FixConst;

namespace {
// a buffer particle's source lies one spacing away along the given direction;
// farther off than this share of the spacing it is a different particle
constexpr double MAX_OFFSET = 0.5;
constexpr int MAX_DEPTH = 100;
}    // namespace

FixAleisphPressure::FixAleisphPressure(LAMMPS *lmp, int narg, char **arg) :
    Fix(lmp, narg, arg), buffer_group_(-1), buffer_bit_(0), towards_{0.0, 0.0, 0.0},
    owner_(nullptr), version_(-1), depth_(0)
{
  if (narg < 4) utils::missing_cmd_args(FLERR, "fix aleisph/pressure", error);
  value_ = std::make_unique<AleisphVariable>(lmp, "Fix aleisph/pressure", "pressure",
                                             AleisphVariable::Kind::EQUAL_OR_ATOM, arg[3]);
  if (narg == 4) return;
  if (strcmp(arg[4], "buffer") != 0)
    error->all(FLERR, "Fix aleisph/pressure: unknown keyword {}", arg[4]);
  if (narg < 9) utils::missing_cmd_args(FLERR, "fix aleisph/pressure buffer", error);
  if (narg > 9) error->all(FLERR, "Fix aleisph/pressure: unknown keyword {}", arg[9]);
  buffer_group_ = group->find(arg[5]);
  if (buffer_group_ < 0) error->all(FLERR, "Fix aleisph/pressure: unknown buffer group {}", arg[5]);
  buffer_bit_ = group->bitmask[buffer_group_];
  double norm = 0.0;
  for (int a = 0; a < 3; a++) {
    towards_[a] = utils::numeric(FLERR, arg[6 + a], false, lmp);
    norm += towards_[a] * towards_[a];
  }
  if (!(norm > 0.0) || !std::isfinite(norm))
    error->all(FLERR, "Fix aleisph/pressure: buffer direction must not be zero");
  for (double &component : towards_) component /= std::sqrt(norm);
}

FixAleisphPressure::~FixAleisphPressure()
{
  set_up_next_run(update);
}

int FixAleisphPressure::setmask()
{
  return PRE_FORCE;
}

void FixAleisphPressure::init()
{
  owner_ = FixAleisph::find(lmp, "Fix aleisph/pressure");
  owner_->scene().add_role(aleisph::DIRICHLET, groupbit);
  if (buffer_bit_) {
    owner_->scene().add_role(aleisph::BUFFER, buffer_bit_);
    owner_->scene().add_condition(this);
  }
  add_claims();
  version_ = -1;

  if (group->count(igroup) == 0)
    error->all(FLERR, "Fix aleisph/pressure: group {} is empty", group->names[igroup]);
  if (buffer_group_ >= 0 && group->count(buffer_group_) == 0)
    error->all(FLERR, "Fix aleisph/pressure: buffer group {} is empty",
               group->names[buffer_group_]);
  value_->check();
}

// settings that must not contradict each other on one particle
void FixAleisphPressure::add_claims() const
{
  const std::string name = fmt::format("{} ({})", id, style);
  owner_->scene().add_claim({name, "pressure", value_->text(), groupbit});
  if (buffer_bit_)
    owner_->scene().add_claim({name, "buffer direction",
                               fmt::format("{} {} {}", towards_[0], towards_[1], towards_[2]),
                               buffer_bit_});
}

void FixAleisphPressure::setup_pre_force(int vflag)
{
  if (buffer_bit_ && owner_->scene().moving())
    error->all(FLERR, "Fix aleisph/pressure: a buffer needs fix aleisph/predictor frame eulerian");
  pre_force(vflag);
}

void FixAleisphPressure::pre_force(int)
{
  set_pressure();
  if (buffer_bit_ && owner_->cloud().version() != version_) find_sources();
}

// prescribed rows of the PPE keep the value that the pressure field holds
void FixAleisphPressure::set_pressure()
{
  std::vector<double> p;
  {
    const AleisphVariable::Evaluation evaluation(lmp, !value_->constant());
    value_->evaluate(igroup, p);
  }
  double *pressure = owner_->fields().pressure().edit();
  const double most = aleisph::largest_pressure(owner_->fluid().rho0, owner_->cloud().spacing(),
                                                update->dt);
  const aleisph::Rows prescribed = aleisph::select_rows(
      atom->nlocal, [this](int i) { return atom->mask[i] & groupbit; });
  aleisph::for_rows(prescribed, [&](int i) { pressure[i] = p[i]; });
  const auto named = [&](const auto &is_wrong) {
    return owner_->ranks().largest(aleisph::max_rows(
        prescribed, [&](int i) { return is_wrong(p[i]) ? atom->tag[i] : 0; }, tagint(0)));
  };
  const tagint bad = named([](double value) { return !std::isfinite(value); });
  if (bad)
    error->all(FLERR, "Fix aleisph/pressure: pressure of atom {} is not finite at step {}", bad,
               update->ntimestep);
  const tagint large = named([most](double value) { return std::fabs(value) > most; });
  if (large)
    error->all(FLERR,
               "Fix aleisph/pressure: pressure of atom {} is above {:.4g} at step {}, where its "
               "rounding alone moves fluid; look at the units",
               large, most, update->ntimestep);
}

/* ---------------------------------------------------------------------- */

void FixAleisphPressure::find_sources()
{
  const auto &cloud = owner_->cloud();
  buffer_ = aleisph::select_rows(cloud.buffer(),
                                 [this](int i) { return atom->mask[i] & buffer_bit_; });
  const int n = static_cast<int>(buffer_.size());
  source_.resize(n);
  slot_.assign(atom->nlocal, -1);
  aleisph::for_rows(n, [this](int m) {
    source_[m] = nearest_source(buffer_[m]);
    slot_[buffer_[m]] = m;
  });
  const tagint mine = aleisph::max_rows(
      n, [this](int m) { return source_[m] < 0 ? atom->tag[buffer_[m]] : 0; }, tagint(0));
  const tagint bad = owner_->ranks().largest(mine);
  if (bad)
    error->all(FLERR,
               "Fix aleisph/pressure: buffer atom {} has no fluid particle one spacing away in the "
               "buffer direction; align the layers or turn the direction towards the fluid",
               bad);
  find_depth();
  version_ = cloud.version();
}

int FixAleisphPressure::nearest_source(int i) const
{
  const auto &s = owner_->cloud().stencil();
  const double d = owner_->cloud().spacing();
  const aleisph::Role *role = owner_->cloud().role();
  double best = MAX_OFFSET * d;
  Eigen::Vector3d place = Eigen::Vector3d::Zero();
  int source = -1;
  for (int k = s.begin(i); k < s.end(i); k++) {
    const int j = s.col()[k];
    if (role[j] & aleisph::WALL) continue;
    const Eigen::Vector3d r = -aleisph::separation(s, k);
    const double miss = (r - d * Eigen::Vector3d(towards_)).norm();
    if (miss < MAX_OFFSET * d && (source < 0 || aleisph::nearer(miss, r, best, place, d))) {
      best = miss;
      place = r;
      source = j;
    }
  }
  return source;
}

// Layers to the fluid, counted through ghosts: as many sweeps of impose() are needed
void FixAleisphPressure::find_depth()
{
  constexpr double UNKNOWN = 1.0e9;
  std::vector<double> depth(owner_->cloud().size(), 0.0);
  aleisph::for_rows(buffer_, [&](int i) { depth[i] = UNKNOWN; });
  double deepest = 0.0;
  for (int sweep = 0; sweep <= MAX_DEPTH; sweep++) {
    owner_->ranks().forward(depth.data(), 1);
    double mine = 0.0;
    for (std::size_t k = 0; k < buffer_.size(); k++) {
      depth[buffer_[k]] = depth[source_[k]] + 1.0;
      mine = std::max(mine, depth[buffer_[k]]);
    }
    deepest = owner_->ranks().max(mine);
    if (deepest < UNKNOWN) break;
  }
  if (deepest >= UNKNOWN)
    error->all(FLERR, "Fix aleisph/pressure: buffer particles copy each other in a circle");
  depth_ = static_cast<int>(deepest);
}

void FixAleisphPressure::impose(const aleisph::Field &velocity)
{
  for (int sweep = 0; sweep < depth_; sweep++) {
    owner_->ranks().forward(velocity);
    double *v = velocity.edit();
    for (std::size_t k = 0; k < buffer_.size(); k++)
      for (int a = 0; a < 3; a++) v[3 * buffer_[k] + a] = v[3 * source_[k] + a];
  }
  owner_->ranks().forward(velocity);
}

int FixAleisphPressure::source(int i) const
{
  return slot_[i] < 0 ? -1 : source_[slot_[i]];
}
