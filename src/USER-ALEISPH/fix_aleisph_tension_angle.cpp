/* ----------------------------------------------------------------------
   LAMMPS - Large-scale Atomic/Molecular Massively Parallel Simulator
   USER-ALEISPH package
   SPDX-License-Identifier: GPL-2.0-only

   Keyword angle of fix aleisph/tension
------------------------------------------------------------------------- */

#include "fix_aleisph_tension.h"

#include "aleisph_halo_owner.h"
#include "aleisph_halo_variable.h"
#include "atom.h"
#include "error.h"
#include "group.h"
#include "modify.h"
#include "update.h"

#include <algorithm>
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
  Angle angle = {name, group->bitmask[id],
                 std::make_unique<AleisphVariable>(lmp, "Fix aleisph/tension", "keyword angle",
                                                   AleisphVariable::Kind::EQUAL_OR_ATOM, value)};
  if (angle.degrees->constant() && !is_angle(angle.degrees->equal()))
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
    const long count = aleisph::count_rows(atom->nlocal, [&](int i) {
      return (atom->mask[i] & angle.groupbit) && (atom->mask[i] & walls);
    });
    if (owner_->ranks().sum(count) == 0)
      error->all(FLERR, "Fix aleisph/tension: keyword angle: there are no walls in group {}",
                 angle.group);
    angle.degrees->check();
    owner_->scene().add_claim({fmt::format("{} ({}) for group {}", id, style, angle.group), "angle",
                               angle.degrees->text(), angle.groupbit, aleisph::WALL});
  }
}

// cosine of the angle on owned and ghost walls
void FixAleisphTension::evaluate_angles()
{
  cosine_.assign(owner_->cloud().size(), NEUTRAL);
  std::vector<double> values;
  const aleisph::Role *role = owner_->cloud().role();
  const bool varies = std::any_of(angles_.begin(), angles_.end(),
                                  [](const Angle &angle) { return !angle.degrees->constant(); });
  const AleisphVariable::Evaluation evaluation(lmp, varies);
  for (const auto &angle : angles_) {
    angle.degrees->evaluate(group->find(angle.group), values);
    const aleisph::Rows rows = aleisph::select_rows(atom->nlocal, [&](int i) {
      return (atom->mask[i] & angle.groupbit) && (role[i] & aleisph::WALL);
    });
    aleisph::for_rows(rows, [&](int i) { cosine_[i] = std::cos(values[i] * DEGREE); });
    if (angle.degrees->constant()) continue;
    const tagint mine = aleisph::max_rows(
        rows, [&](int i) { return is_angle(values[i]) ? 0 : atom->tag[i]; }, tagint(0));
    const tagint outside = owner_->ranks().largest(mine);
    if (outside)
      error->all(FLERR,
                 "Fix aleisph/tension: variable {} must lie between 0 and 180 degrees, for atom {} "
                 "it does not at step {}",
                 angle.degrees->name(), outside, update->ntimestep);
  }
  owner_->ranks().forward(cosine_.data(), 1);
}
