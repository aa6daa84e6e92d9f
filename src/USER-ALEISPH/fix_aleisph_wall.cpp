/* ----------------------------------------------------------------------
   LAMMPS - Large-scale Atomic/Molecular Massively Parallel Simulator
   USER-ALEISPH package
   SPDX-License-Identifier: GPL-2.0-only
------------------------------------------------------------------------- */

#include "fix_aleisph_wall.h"

#include "aleisph_halo_owner.h"
#include "aleisph_halo_variable.h"
#include "aleisph_wall_normals.h"
#include "atom.h"
#include "comm.h"
#include "domain.h"
#include "error.h"
#include "group.h"
#include "update.h"
#include "utils.h"

#include <algorithm>
#include <cmath>

using namespace LAMMPS_NS;
using namespace FixConst;

namespace {
// given normals are written with six digits at least
constexpr double UNIT_TOLERANCE = 1.0e-5;
}    // namespace

FixAleisphWall::FixAleisphWall(LAMMPS *lmp, int narg, char **arg) :
    Fix(lmp, narg, arg), slip_(false), curlcurl_(false), owner_(nullptr), searched_(false),
    watching_(false), warned_(false), fallback_(0), unknown_(0), contradictory_(0), wrong_(0)
{
  parse(narg, arg);
  nevery = 1;
  scalar_flag = vector_flag = 1;
  size_vector = 3;
  global_freq = 1;
  extscalar = extvector = 0;
}

FixAleisphWall::~FixAleisphWall()
{
  set_up_next_run(update);
}

void FixAleisphWall::parse(int narg, char **arg)
{
  int iarg = 3;
  const auto need = [&](int n) {
    if (iarg + n >= narg)
      utils::missing_cmd_args(FLERR, std::string("fix aleisph/wall ") + arg[iarg], error);
  };
  while (iarg < narg) {
    const std::string key = arg[iarg];
    need(1);
    const std::string value = arg[iarg + 1];
    if (key == "condition") {
      if (value != "slip" && value != "no-slip")
        error->all(FLERR, "Fix aleisph/wall: condition must be slip or no-slip, not {}", value);
      slip_ = value == "slip";
      iarg += 2;
    } else if (key == "velocity") {
      need(3);
      velocity_.clear();
      for (int a = 1; a <= 3; a++)
        velocity_.emplace_back(lmp, "Fix aleisph/wall", "keyword velocity",
                               AleisphVariable::Kind::EQUAL, arg[iarg + a]);
      iarg += 4;
    } else if (key == "normals") {
      if (value == "auto") {
        given_.clear();
        iarg += 2;
      } else if (value == "given") {
        need(2);
        given_ = arg[iarg + 2];
        iarg += 3;
      } else
        error->all(FLERR, "Fix aleisph/wall: normals must be auto or given, not {}", value);
    } else if (key == "vstar") {
      if (value != "default" && value != "curlcurl")
        error->all(FLERR, "Fix aleisph/wall: vstar must be default or curlcurl, not {}", value);
      curlcurl_ = value == "curlcurl";
      iarg += 2;
    } else
      error->all(FLERR, "Fix aleisph/wall: unknown keyword {}", key);
  }
}

int FixAleisphWall::setmask()
{
  return PRE_FORCE | END_OF_STEP;
}

void FixAleisphWall::init()
{
  owner_ = FixAleisph::find(lmp, "Fix aleisph/wall");
  aleisph::Role role = aleisph::WALL;
  if (slip_) role |= aleisph::SLIP;
  if (curlcurl_) role |= aleisph::CURLCURL;
  owner_->scene().add_role(role, groupbit);
  owner_->scene().add_walls(this);
  owner_->fields().add_writer("aleisph_n",
                              fmt::format("{} {} {}", id, group->names[igroup], given_));
  add_claims();
  searched_ = watching_ = warned_ = false;

  if (group->count(igroup) == 0)
    error->all(FLERR, "Fix aleisph/wall: group {} is empty", group->names[igroup]);
  for (const auto &component : velocity_) component.check();
  if (!given_.empty()) {
    int flag, cols;
    if (atom->find_custom(given_.c_str(), flag, cols) < 0 || flag != 1 || cols != 3)
      error->all(FLERR,
                 "Fix aleisph/wall: no custom property d2_{} with 3 columns; define it with fix "
                 "property/atom d2_{} 3",
                 given_, given_);
  }
}

// Settings that must not contradict each other on one particle. A wall without keyword velocity
// does not set it.
void FixAleisphWall::add_claims() const
{
  const std::string name = fmt::format("{} ({})", id, style);
  const auto claim = [&](const char *what, const std::string &value) {
    owner_->scene().add_claim({name, what, value, groupbit});
  };
  claim("condition", slip_ ? "slip" : "no-slip");
  claim("vstar", curlcurl_ ? "curlcurl" : "default");
  claim("normals", given_.empty() ? "auto" : "given " + given_);
  if (velocity_.empty()) return;
  std::string text;
  for (const auto &component : velocity_) text += (text.empty() ? "" : " ") + component.text();
  claim("velocity", text);
}

void FixAleisphWall::setup_pre_force(int vflag)
{
  pre_force(vflag);
}

void FixAleisphWall::pre_force(int)
{
  if (!velocity_.empty()) set_velocity();
  if (searched_ || watching_) check_normals();
}

void FixAleisphWall::setup(int)
{
  end_of_step();
}

// An accelerating wall changes the velocity of its particles before the predictor
// runs, in whatever fix; what the fluid felt in the step before is kept here.
void FixAleisphWall::end_of_step()
{
  double *previous = owner_->fields().wall_velocity();
  if (update->ntimestep == update->firststep + 1)
    owner_->warnings().moved_walls(groupbit, previous);
  aleisph::for_rows(group_rows(), [&](int i) {
    for (int a = 0; a < 3; a++) previous[3 * i + a] = atom->v[i][a];
  });
}

void FixAleisphWall::set_velocity()
{
  double vw[3];
  const bool varies = std::any_of(velocity_.begin(), velocity_.end(),
                                  [](const AleisphVariable &c) { return !c.constant(); });
  const AleisphVariable::Evaluation evaluation(lmp, varies);
  for (int a = 0; a < 3; a++) {
    vw[a] = velocity_[a].equal();
    if (!std::isfinite(vw[a]))
      error->all(FLERR, "Fix aleisph/wall: wall velocity is not finite at step {}",
                 update->ntimestep);
  }
  if (domain->dimension == 2 && vw[2] != 0.0)
    error->all(FLERR, "Fix aleisph/wall: velocity in z in a 2d simulation");
  aleisph::for_rows(group_rows(), [&](int i) {
    for (int a = 0; a < 3; a++) atom->v[i][a] = vw[a];
  });
}

/* ----------------------------------------------------------------------
   Called by the owner when the walls have moved or a normal is not known,
   and again as long as it finds some. At the first of these calls no normal
   of this group is known.
------------------------------------------------------------------------- */

int FixAleisphWall::find_normals(const aleisph::Stencil &walls, const double *previous)
{
  const aleisph::Rows all = group_rows();
  const aleisph::Rows rows = aleisph::select_rows(all, [this](int i) { return !is_known(i); });
  if (rows.size() == all.size()) fallback_ = contradictory_ = wrong_ = 0;
  searched_ = true;
  return given_.empty() ? compute_normals(walls, rows, previous) : copy_given_normals(walls, rows);
}

aleisph::Rows FixAleisphWall::group_rows() const
{
  return aleisph::select_rows(atom->nlocal, [this](int i) { return atom->mask[i] & groupbit; });
}

bool FixAleisphWall::is_known(int i) const
{
  const double *n = owner_->cloud().normal() + 3 * i;
  return n[0] != 0.0 || n[1] != 0.0 || n[2] != 0.0;
}

int FixAleisphWall::copy_given_normals(const aleisph::Stencil &walls, const aleisph::Rows &rows)
{
  int flag, cols;
  double **given = atom->darray[atom->find_custom(given_.c_str(), flag, cols)];
  double *normal = owner_->cloud().normal();
  const tagint wrong = aleisph::max_rows(
      rows,
      [&](int i) {
        double square = 0.0;
        for (int a = 0; a < 3; a++) {
          normal[3 * i + a] = given[i][a];
          square += given[i][a] * given[i][a];
        }
        return std::fabs(square - 1.0) < UNIT_TOLERANCE ? 0 : atom->tag[i];
      },
      tagint(0));
  const tagint bad = owner_->ranks().largest(wrong);
  if (bad) error->all(FLERR, "Fix aleisph/wall: given normal of atom {} is not a unit vector", bad);
  aleisph::wall_shapes(walls, rows, owner_->cloud());
  return rows.size();
}

int FixAleisphWall::compute_normals(const aleisph::Stencil &walls, const aleisph::Rows &rows,
                                    const double *previous)
{
  if (!owner_->scene().surface().present) require_fluid(walls, rows);
  std::vector<aleisph::NormalStatus> status(atom->nlocal);
  const aleisph::NormalCount count = aleisph::wall_normals(walls, rows, previous, owner_->cloud(),
                                                           status);
  fallback_ += count.fallback;
  contradictory_ += count.contradictory.size();
  wrong_ = aleisph::max_rows(
      count.contradictory, [this](int i) { return atom->tag[i]; }, wrong_);
  return count.found;
}

// Without a free surface there are no dry walls: each has a row in the pressure equation.
void FixAleisphWall::require_fluid(const aleisph::Stencil &walls, const aleisph::Rows &rows) const
{
  const aleisph::Role *role = owner_->cloud().role();
  const auto has_fluid = [&](int i) {
    const int *begin = walls.col() + walls.begin(i), *end = walls.col() + walls.end(i);
    return std::any_of(begin, end, [role](int j) { return role[j] & aleisph::FLUID; });
  };
  const tagint without = aleisph::max_rows(
      rows, [&](int i) { return has_fluid(i) ? 0 : atom->tag[i]; }, tagint(0));
  const tagint bad = owner_->ranks().largest(without);
  if (bad)
    error->all(FLERR,
               "Fix aleisph/wall: atom {} has no fluid particle within the support, so its normal "
               "is unknown; remove it or use normals given",
               bad);
}

void FixAleisphWall::check_normals()
{
  const aleisph::Role *role = owner_->cloud().role();
  const aleisph::Rows unknown = aleisph::select_rows(group_rows(),
                                                     [this](int i) { return !is_known(i); });
  unknown_ = unknown.size();
  const tagint wet = aleisph::max_rows(
      unknown, [&](int i) { return role[i] & aleisph::DRY ? 0 : atom->tag[i]; }, tagint(0));
  watching_ = owner_->ranks().any(unknown_ > 0);
  const tagint bad = watching_ ? owner_->ranks().largest(wet) : 0;
  if (bad)
    error->all(FLERR,
               "Fix aleisph/wall: other wall particles hide the fluid from atom {}, so its normal "
               "is unknown; remove it or use normals given",
               bad);
  if (searched_) warn_of_contradictions();
  searched_ = false;
}

void FixAleisphWall::warn_of_contradictions()
{
  const tagint wrong = owner_->ranks().largest(wrong_);
  if (wrong == 0 || warned_) return;
  warned_ = true;
  const auto number = static_cast<bigint>(compute_vector(2));
  if (comm->me == 0)
    error->warning(FLERR,
                   "Fix aleisph/wall: {} wall particles, among them atom {}, have neighbors whose "
                   "normal is more than 120 degrees from theirs; look at the normals and use "
                   "normals given if they are wrong",
                   number, wrong);
}

double FixAleisphWall::compute_scalar()
{
  return compute_vector(0);
}

double FixAleisphWall::compute_vector(int n)
{
  const bigint mine[3] = {fallback_, unknown_, contradictory_};
  return FixAleisph::find(lmp, "Fix aleisph/wall")->ranks().sum(static_cast<long>(mine[n]));
}
