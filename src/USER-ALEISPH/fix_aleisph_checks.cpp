/* ----------------------------------------------------------------------
   LAMMPS - Large-scale Atomic/Molecular Massively Parallel Simulator
   USER-ALEISPH package
   SPDX-License-Identifier: GPL-2.0-only
------------------------------------------------------------------------- */

#include "aleisph_halo_checks.h"

#include "atom.h"
#include "comm.h"
#include "domain.h"
#include "error.h"
#include "fix_aleisph.h"
#include "group.h"
#include "modify.h"
#include "neighbor.h"
#include "update.h"
#include "utils.h"

#include <cmath>
#include <cstring>
#include <string>
#include <utility>

using namespace LAMMPS_NS;
using namespace FixConst;
using aleisph::Role;

namespace {

// masses are typed or printed with seven digits at least
constexpr double MASS_TOLERANCE = 1.0e-6;

// position of a style in the order that a script must follow, -1 if not one of ours
int rank_in_script(const std::string &style)
{
  static const std::pair<const char *, int> order[] = {
      {"aleisph", 0},         {"aleisph/wall", 1},    {"aleisph/pressure", 1},
      {"aleisph/surface", 2}, {"aleisph/tension", 3}, {"aleisph/predictor", 4},
      {"aleisph/ppe", 5},     {"aleisph/shift", 6},   {"aleisph/guard", 7},
      {"aleisph/dt", 8}};
  for (const auto &entry : order)
    if (style == entry.first) return entry.second;
  return -1;
}

}    // namespace

void AleisphChecks::script() const
{
  integrator();
  neighbors();
  companions();
  fix_order();
}

void AleisphChecks::integrator() const
{
  if (update->whichflag == 2)
    error->all(FLERR, "Fix aleisph cannot be used with minimize; unfix it first");
  if (utils::strmatch(update->integrate_style, "^respa"))
    error->all(FLERR, "Fix aleisph cannot be used with run_style respa; use run_style verlet");
  const std::string units = update->unit_style;
  if (units == "real" || units == "metal" || units == "electron")
    error->all(FLERR, "Fix aleisph cannot be used with units {}; use lj, si, cgs, micro or nano",
               units);
  if (!(update->dt > 0.0) || !std::isfinite(update->dt))
    error->all(FLERR, "Fix aleisph: timestep must be positive, it is {}", update->dt);
  if (!atom->tag_enable) error->all(FLERR, "Fix aleisph needs atom IDs");
}

void AleisphChecks::neighbors() const
{
  if (neighbor->nex_type + neighbor->nex_group + neighbor->nex_mol > 0)
    error->all(FLERR,
               "Fix aleisph cannot be used with neigh_modify exclude: particles would miss "
               "neighbors; remove the exclusion");
  if (comm->mode != Comm::SINGLE) error->all(FLERR, "Fix aleisph needs comm_modify mode single");
}

void AleisphChecks::companions() const
{
  if (group->count(owner_.igroup) == 0)
    error->all(FLERR, "Fix aleisph: group {} is empty", group->names[owner_.igroup]);
  for (const char *other : {"aleisph/predictor", "aleisph/ppe"})
    if (modify->get_fix_by_style(fmt::format("^{}$", other)).empty())
      error->all(FLERR, "Fix aleisph needs a fix {}", other);
}

void AleisphChecks::fix_order() const
{
  const Fix *last = nullptr;
  const Fix *predictor = nullptr;
  for (const Fix *fix : modify->get_fix_list()) {
    // forces must be complete when the predictor reads them during setup
    if (predictor && (modify->fmask[modify->find_fix(fix->id)] & POST_FORCE))
      error->all(FLERR, "Fix {} ({}) changes forces and must be defined before fix {} ({})",
                 fix->id, fix->style, predictor->id, predictor->style);
    const int rank = rank_in_script(fix->style);
    if (rank < 0) continue;
    if (last && rank < rank_in_script(last->style))
      error->all(FLERR, "Fix {} ({}) must be defined before fix {} ({})", fix->id, fix->style,
                 last->id, last->style);
    last = fix;
    if (strcmp(fix->style, "aleisph/predictor") == 0) predictor = fix;
  }
}

// the ID of an atom of this rank, if there is one, for each of three faults
void AleisphChecks::find_wrong_roles(long long *atoms) const
{
  const int *mask = atom->mask;
  for (int i = 0; i < atom->nlocal; i++) {
    const Role r = owner_.cloud().role()[i];
    if (!(mask[i] & owner_.groupbit) || !(r & (aleisph::FLUID | aleisph::WALL)))
      atoms[0] = atom->tag[i];
    if ((r & aleisph::WALL) && (r & (aleisph::FLUID | aleisph::BUFFER))) atoms[1] = atom->tag[i];
    if ((r & aleisph::BUFFER) && !(r & aleisph::DIRICHLET)) atoms[2] = atom->tag[i];
  }
}

void AleisphChecks::refuse_roles(const long long *atoms) const
{
  if (atoms[0])
    error->all(FLERR,
               "Fix aleisph: atom {} is neither fluid (group of fix aleisph/predictor) nor wall "
               "(group of fix aleisph/wall), or not in group {}",
               atoms[0], group->names[owner_.igroup]);
  if (atoms[1]) error->all(FLERR, "Fix aleisph: atom {} is both fluid and wall", atoms[1]);
  if (atoms[2])
    error->all(FLERR, "Fix aleisph: buffer atom {} is not in the group of its fix aleisph/pressure",
               atoms[2]);
}

void AleisphChecks::atoms() const
{
  tagint nan = 0, plane = 0, heavy = 0;
  const double m = owner_.particle_mass();
  for (int i = 0; i < atom->nlocal; i++) {
    const double *const x = atom->x[i], *const v = atom->v[i];
    for (int a = 0; a < 3; a++)
      if (!std::isfinite(x[a]) || !std::isfinite(v[a])) nan = atom->tag[i];
    if (domain->dimension == 2 && v[2] != 0.0) plane = atom->tag[i];
    const double mass = atom->rmass ? atom->rmass[i] : atom->mass[atom->type[i]];
    if (std::fabs(mass - m) > MASS_TOLERANCE * m) heavy = atom->tag[i];
  }
  if ((nan = owner_.ranks().largest(nan)))
    error->all(FLERR, "Fix aleisph: position or velocity of atom {} is not finite", nan);
  if ((plane = owner_.ranks().largest(plane)))
    error->all(FLERR,
               "Fix aleisph: atom {} has a velocity in z in a 2d simulation; use velocity set or "
               "fix enforce2d",
               plane);
  if ((heavy = owner_.ranks().largest(heavy)))
    error->all(FLERR, "Fix aleisph: mass of atom {} must be rho0 * spacing^{} = {:.10g}", heavy,
               domain->dimension, m);
}
