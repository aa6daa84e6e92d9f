/* ----------------------------------------------------------------------
   LAMMPS - Large-scale Atomic/Molecular Massively Parallel Simulator
   USER-ALEISPH package
   SPDX-License-Identifier: GPL-2.0-only
------------------------------------------------------------------------- */

#include "fix_aleisph_wall.h"

#include "aleisph_normals.h"
#include "atom.h"
#include "domain.h"
#include "error.h"
#include "fix_aleisph.h"
#include "group.h"
#include "input.h"
#include "update.h"
#include "utils.h"
#include "variable.h"

#include <cmath>

using namespace LAMMPS_NS;
using namespace FixConst;

namespace {
// given normals are written with six digits at least
constexpr double UNIT_TOLERANCE = 1.0e-5;
}    // namespace

FixAleisphWall::FixAleisphWall(LAMMPS *lmp, int narg, char **arg) :
    Fix(lmp, narg, arg), slip_(false), curlcurl_(false), prescribed_(false), owner_(nullptr),
    version_(-1), from_fluid_(0)
{
  parse(narg, arg);
  nevery = 1;
  scalar_flag = 1;
  global_freq = 1;
  extscalar = 0;
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
      prescribed_ = true;
      for (int a = 0; a < 3; a++) {
        const char *word = arg[iarg + 1 + a];
        if (utils::strmatch(word, "^v_"))
          velocity_[a].variable = word + 2;
        else
          velocity_[a].value = utils::numeric(FLERR, word, false, lmp);
      }
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
  owner_->add_role(role, groupbit);
  version_ = -1;

  if (group->count(igroup) == 0)
    error->all(FLERR, "Fix aleisph/wall: group {} is empty", group->names[igroup]);
  for (const auto &component : velocity_) {
    if (component.variable.empty()) continue;
    const int ivar = input->variable->find(component.variable.c_str());
    if (ivar < 0 || !input->variable->equalstyle(ivar))
      error->all(FLERR, "Fix aleisph/wall: {} is not an equal-style variable", component.variable);
  }
  if (!given_.empty()) {
    int flag, cols;
    if (atom->find_custom(given_.c_str(), flag, cols) < 0 || flag != 1 || cols != 3)
      error->all(FLERR,
                 "Fix aleisph/wall: no custom property d2_{} with 3 columns; define it with fix "
                 "property/atom d2_{} 3",
                 given_, given_);
  }
}

void FixAleisphWall::setup_pre_force(int vflag)
{
  pre_force(vflag);
}

void FixAleisphWall::pre_force(int)
{
  if (prescribed_) set_velocity();
  if (owner_->version() != version_) find_normals();
}

void FixAleisphWall::setup(int)
{
  end_of_step();
}

// An accelerating wall changes the velocity of its particles before the predictor
// runs, in whatever fix; what the fluid felt in the step before is kept here.
void FixAleisphWall::end_of_step()
{
  double *previous = owner_->previous_wall_velocity();
  for (int i = 0; i < atom->nlocal; i++)
    if (atom->mask[i] & groupbit)
      for (int a = 0; a < 3; a++) previous[3 * i + a] = atom->v[i][a];
}

void FixAleisphWall::set_velocity()
{
  double vw[3];
  for (int a = 0; a < 3; a++) {
    const auto &component = velocity_[a];
    vw[a] = component.variable.empty()
        ? component.value
        : input->variable->compute_equal(input->variable->find(component.variable.c_str()));
    if (!std::isfinite(vw[a]))
      error->all(FLERR, "Fix aleisph/wall: wall velocity is not finite at step {}",
                 update->ntimestep);
  }
  if (domain->dimension == 2 && vw[2] != 0.0)
    error->all(FLERR, "Fix aleisph/wall: velocity in z in a 2d simulation");
  for (int i = 0; i < atom->nlocal; i++)
    if (atom->mask[i] & groupbit)
      for (int a = 0; a < 3; a++) atom->v[i][a] = vw[a];
}

void FixAleisphWall::find_normals()
{
  aleisph::Timers::Scope scope(owner_->timers(), aleisph::Part::OPERATORS);
  if (given_.empty())
    compute_normals();
  else
    copy_given_normals();
  owner_->forward(owner_->normal(), 3);
  owner_->tally().wall_passes++;
  version_ = owner_->version();
}

void FixAleisphWall::copy_given_normals()
{
  int flag, cols;
  double **given = atom->darray[atom->find_custom(given_.c_str(), flag, cols)];
  double *normal = owner_->normal();
  tagint bad = 0;
  for (int i = 0; i < atom->nlocal; i++) {
    if (!(atom->mask[i] & groupbit)) continue;
    double square = 0.0;
    for (int a = 0; a < 3; a++) {
      normal[3 * i + a] = given[i][a];
      square += given[i][a] * given[i][a];
    }
    if (!(std::fabs(square - 1.0) < UNIT_TOLERANCE)) bad = atom->tag[i];
  }
  if ((bad = owner_->largest(bad)))
    error->all(FLERR, "Fix aleisph/wall: given normal of atom {} is not a unit vector", bad);
}

void FixAleisphWall::compute_normals()
{
  aleisph::Rows rows;
  for (int i = 0; i < atom->nlocal; i++)
    if (atom->mask[i] & groupbit) rows.push_back(i);

  std::vector<aleisph::NormalStatus> status(atom->nlocal);
  const auto &disc = owner_->discretization();
  aleisph::wall_normals(disc.stencil(), rows, owner_->role(), disc.spacing(),
                        aleisph::NormalParams(), owner_->normal(), status);
  tagint bad = 0;
  from_fluid_ = 0;
  for (const int i : rows) {
    if (status[i] == aleisph::NormalStatus::FLUID) from_fluid_++;
    if (status[i] == aleisph::NormalStatus::UNKNOWN) bad = atom->tag[i];
  }
  if ((bad = owner_->largest(bad)))
    error->all(FLERR,
               "Fix aleisph/wall: atom {} has no fluid particle within the support, so its normal "
               "is unknown; remove it or use normals given",
               bad);
}

// wall particles whose normal is the direction to the fluid, for want of wall neighbors
double FixAleisphWall::compute_scalar()
{
  double mine = from_fluid_, all;
  MPI_Allreduce(&mine, &all, 1, MPI_DOUBLE, MPI_SUM, world);
  return all;
}
