/* ----------------------------------------------------------------------
   LAMMPS - Large-scale Atomic/Molecular Massively Parallel Simulator
   USER-ALEISPH package
   SPDX-License-Identifier: GPL-2.0-only

   Keyword angle of fix aleisph/tension
------------------------------------------------------------------------- */

#include "fix_aleisph_tension.h"

#include "aleisph_halo_owner.h"
#include "atom.h"
#include "error.h"
#include "group.h"
#include "input.h"
#include "modify.h"
#include "update.h"
#include "utils.h"
#include "variable.h"

#include <cmath>

using namespace LAMMPS_NS;

namespace {

constexpr double DEGREE = 3.14159265358979323846 / 180.0;
constexpr double NEUTRAL = 0.0;    // cosine on walls that no keyword angle names: 90 degrees

bool is_angle(double degrees)
{
  return degrees > 0.0 && degrees < 180.0;
}

}    // namespace

FixAleisphTension::Angle FixAleisphTension::parse_angle(const std::string &name,
                                                        const std::string &value)
{
  const int id = group->find(name);
  if (id < 0)
    error->all(FLERR, "Fix aleisph/tension: keyword angle: there is no group {} of walls", name);
  Angle angle = {group->bitmask[id], name, "", 0.0};
  if (utils::strmatch(value, "^v_")) {
    angle.variable = value.substr(2);
    return angle;
  }
  angle.degrees = utils::numeric(FLERR, value, false, lmp);
  if (!is_angle(angle.degrees))
    error->all(FLERR, "Fix aleisph/tension: angle must lie between 0 and 180 degrees, not {}",
               value);
  return angle;
}

void FixAleisphTension::resolve_angles() const
{
  if (!walls_ && !angles_.empty())
    error->all(FLERR, "Fix aleisph/tension: keyword angle needs a fix aleisph/wall");
  int walls = 0;
  for (const Fix *wall : modify->get_fix_by_style("^aleisph/wall$")) walls |= wall->groupbit;
  for (const auto &angle : angles_) {
    bigint count = 0;
    for (int i = 0; i < atom->nlocal; i++)
      count += (atom->mask[i] & angle.groupbit) && (atom->mask[i] & walls);
    if (owner_->ranks().sum(count) == 0)
      error->all(FLERR, "Fix aleisph/tension: keyword angle: there are no walls in group {}",
                 angle.group);
    if (angle.variable.empty()) continue;
    const int ivar = input->variable->find(angle.variable.c_str());
    if (ivar < 0 || !(input->variable->equalstyle(ivar) || input->variable->atomstyle(ivar)))
      error->all(FLERR, "Fix aleisph/tension: {} is not an equal- or atom-style variable",
                 angle.variable);
  }
}

// cosine of the angle on owned and ghost walls
void FixAleisphTension::evaluate_angles()
{
  cosine_.assign(owner_->cloud().size(), NEUTRAL);
  std::vector<double> values(atom->nlocal);
  tagint outside = 0;
  for (const auto &angle : angles_) {
    const int ivar = angle.variable.empty() ? -1 : input->variable->find(angle.variable.c_str());
    if (ivar < 0)
      values.assign(atom->nlocal, angle.degrees);
    else if (input->variable->equalstyle(ivar))
      values.assign(atom->nlocal, input->variable->compute_equal(ivar));
    else
      input->variable->compute_atom(ivar, group->find(angle.group), values.data(), 1, 0);
    for (int i = 0; i < atom->nlocal; i++) {
      if (!(atom->mask[i] & angle.groupbit) || !(owner_->cloud().role()[i] & aleisph::WALL))
        continue;
      if (!is_angle(values[i])) outside = atom->tag[i];
      cosine_[i] = std::cos(values[i] * DEGREE);
    }
    if (ivar >= 0 && (outside = owner_->ranks().largest(outside)))
      error->all(FLERR,
                 "Fix aleisph/tension: variable {} must lie between 0 and 180 degrees, for atom {} "
                 "it does not at step {}",
                 angle.variable, outside, update->ntimestep);
  }
  owner_->ranks().forward(cosine_.data(), 1);
}
