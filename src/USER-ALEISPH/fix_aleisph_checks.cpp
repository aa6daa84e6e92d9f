/* ----------------------------------------------------------------------
   LAMMPS - Large-scale Atomic/Molecular Massively Parallel Simulator
   USER-ALEISPH package
   SPDX-License-Identifier: GPL-2.0-only
------------------------------------------------------------------------- */

#include "aleisph_halo_checks.h"

#include "aleisph_halo_owner.h"
#include "atom.h"
#include "atom_vec.h"
#include "comm.h"
#include "domain.h"
#include "error.h"
#include "group.h"
#include "modify.h"
#include "molecule.h"
#include "neighbor.h"
#include "update.h"
#include "utils.h"

#include <algorithm>
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
  box();
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
  if (neighbor->includegroup)
    error->all(FLERR,
               "Fix aleisph cannot be used with neigh_modify include {}: particles would miss "
               "neighbors; use neigh_modify include all",
               group->names[neighbor->includegroup]);
  if (comm->mode != Comm::SINGLE) error->all(FLERR, "Fix aleisph needs comm_modify mode single");
  // bins of multi are made for the cutoffs of pair styles: of which there may be none
  if (neighbor->style != Neighbor::BIN && neighbor->style != Neighbor::NSQ)
    error->all(FLERR, "Fix aleisph needs neighbor style bin or nsq: use neighbor {} bin",
               neighbor->skin);
}

// The box may follow the particles, and ranks may share it anew. If it changes under them, their
// volumes or their images do.
void AleisphChecks::box() const
{
  for (const Fix *fix : modify->get_fix_list())
    if (fix->box_change & (Fix::BOX_CHANGE_SIZE | Fix::BOX_CHANGE_SHAPE))
      error->all(FLERR,
                 "Fix aleisph cannot be used with fix {} ({}), which changes the box during a run: "
                 "the volume of particles is constant; unfix it, or use change_box between runs",
                 fix->id, fix->style);
}

void AleisphChecks::setup()
{
  if (owner_.scene().moving()) refuse_late_lists();
  find_contradictions();
}

// Whether particles can move by more than half the skin before LAMMPS looks
bool AleisphChecks::late_lists() const
{
  return neighbor->build_once || neighbor->delay > 1 || neighbor->every > 1;
}

void AleisphChecks::refuse_late_lists() const
{
  if (late_lists())
    error->all(FLERR,
               "Fix aleisph: with neigh_modify every {} delay {} once {} particles can come near "
               "each other unnoticed; use neigh_modify every 1 delay 0 once no",
               neighbor->every, neighbor->delay, neighbor->build_once ? "yes" : "no");
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

/* ---------------------------------------------------------------------- */

void AleisphChecks::find_contradictions()
{
  contradictions_.clear();
  const auto &claims = owner_.scene().claims();
  const int n = static_cast<int>(claims.size());
  for (int a = 0; a < n; a++)
    for (int b = a + 1; b < n; b++)
      if (claims[a].what == claims[b].what && claims[a].value != claims[b].value)
        contradictions_.emplace_back(a, b);
}

// ID of an atom of this rank of which this is true: the largest, 0 if there is none
template <class F> long long AleisphChecks::largest(F &&is_wrong) const
{
  return aleisph::max_rows(
      atom->nlocal, [&](int i) { return is_wrong(i) ? atom->tag[i] : 0; }, 0LL);
}

// One pass where all is well; which fault it is and of which atom, is found out afterwards.
void AleisphChecks::find_faults(bool fresh, long long *atoms) const
{
  const auto is_wrong = [&](int i) {
    for (int fault = fresh ? 0 : FIRST_LASTING; fault < FAULTS; fault++)
      if (has(static_cast<Fault>(fault), i)) return true;
    return false;
  };
  const aleisph::Rows wrong = aleisph::select_rows(atom->nlocal, is_wrong);
  for (int fault = fresh ? 0 : FIRST_LASTING; fault < CONTRADICTION; fault++)
    atoms[fault] = aleisph::max_rows(
        wrong, [&](int i) { return has(static_cast<Fault>(fault), i) ? atom->tag[i] : 0; }, 0LL);
  // the atom and the pair in one number
  const auto pairs = static_cast<long long>(contradictions_.size());
  atoms[CONTRADICTION] = aleisph::max_rows(
      wrong,
      [&](int i) {
        const int pair = contradiction(i);
        return pair < 0 ? 0 : atom->tag[i] * pairs + pair;
      },
      0LL);
}

bool AleisphChecks::has(Fault fault, int i) const
{
  const Role role = owner_.cloud().role()[i];
  switch (fault) {
    case NOT_FINITE: {
      const double *const x = atom->x[i], *const v = atom->v[i];
      const auto finite = [](double value) { return std::isfinite(value); };
      return !std::all_of(x, x + 3, finite) || !std::all_of(v, v + 3, finite);
    }
    case OUT_OF_PLANE: return domain->dimension == 2 && atom->v[i][2] != 0.0;
    case MASS: {
      const double m = particle_mass(owner_);
      const double mass = atom->rmass ? atom->rmass[i] : atom->mass[atom->type[i]];
      return !(std::fabs(mass - m) <= MASS_TOLERANCE * m);
    }
    case SPECIAL: return atom->molecular != Atom::ATOMIC && loses_neighbors(i);
    case NO_ROLE:
      return !(atom->mask[i] & owner_.groupbit) || !(role & (aleisph::FLUID | aleisph::WALL));
    case TWO_ROLES: return (role & aleisph::WALL) && (role & (aleisph::FLUID | aleisph::BUFFER));
    case BUFFER: return (role & aleisph::BUFFER) && !(role & aleisph::DIRICHLET);
    default: return contradiction(i) >= 0;
  }
}

// the last of the pairs of claims that contradict each other on this particle, -1 if there is none
int AleisphChecks::contradiction(int i) const
{
  const auto &claims = owner_.scene().claims();
  const Role role = owner_.cloud().role()[i];
  const auto concerns = [&](int k) {
    return (atom->mask[i] & claims[k].groupbit) && (role & claims[k].role) == claims[k].role;
  };
  for (int k = static_cast<int>(contradictions_.size()) - 1; k >= 0; k--)
    if (concerns(contradictions_[k].first) && concerns(contradictions_[k].second)) return k;
  return -1;
}

// LAMMPS leaves bonded pairs with zero special_bonds weights out of all neighbor lists
bool AleisphChecks::loses_neighbors(int i) const
{
  const int *count = nullptr;    // of partners at one, two and three bonds, each with those before
  if (atom->molecular == Atom::MOLECULAR)
    count = atom->nspecial[i];
  else if (atom->molindex[i] >= 0)
    count = atom->avec->onemols[atom->molindex[i]]->nspecial[atom->molatom[i]];
  if (!count) return false;
  for (int k = 0; k < 3; k++)
    if (neighbor->special_flag[k + 1] == 0 && count[k] > (k ? count[k - 1] : 0)) return true;
  return false;
}

// In a violent flow particles may come close: this is counted. New ones must not, be it at the start
// of a run or later; LAMMPS gives them higher IDs than those that are there.
void AleisphChecks::arrivals(bool close, const aleisph::CandidateList &list)
{
  if (natoms_ == 0 && owner_.fields().pressure_known()) natoms_ = -1;    // from a restart file
  if (close && natoms_ >= 0) refuse_close(list);
  if (natoms_ == atom->natoms) return;
  const long long newest = aleisph::max_rows(
      atom->nlocal, [this](int i) { return atom->tag[i]; }, 0LL);
  known_ = std::max(known_, owner_.ranks().largest(newest));
  natoms_ = atom->natoms;
}

void AleisphChecks::refuse_close(const aleisph::CandidateList &list) const
{
  const double close = aleisph::Cloud::CLOSE * owner_.cloud().spacing();
  const auto is_close = [&](int i) {
    for (int m = 0; m < list.count[i]; m++) {
      const int j = list.first[i][m] & list.mask;
      const double *const a = atom->x[i], *const b = atom->x[j];
      const double z = domain->dimension == 3 ? a[2] - b[2] : 0.0;
      if (std::max(atom->tag[i], atom->tag[j]) > known_ &&
          std::hypot(a[0] - b[0], a[1] - b[1], z) <= close)
        return true;
    }
    return false;
  };
  const long long found = owner_.ranks().largest(largest(is_close));
  if (found)
    error->all(
        FLERR,
        "Fix aleisph: atom {} is nearer than {} to another one, {} spacings; use delete_atoms "
        "overlap, or regions that do not overlap",
        found, close, aleisph::Cloud::CLOSE);
}

void AleisphChecks::refuse(const long long *atoms) const
{
  if (atoms[NOT_FINITE])
    error->all(FLERR, "Fix aleisph: position or velocity of atom {} is not finite at step {}",
               atoms[NOT_FINITE], update->ntimestep);
  if (atoms[OUT_OF_PLANE])
    error->all(FLERR,
               "Fix aleisph: atom {} has a velocity in z in a 2d simulation; use velocity set or "
               "fix enforce2d",
               atoms[OUT_OF_PLANE]);
  if (atoms[MASS])
    error->all(FLERR, "Fix aleisph: mass of atom {} must be rho0 * spacing^{} = {:.10g}",
               atoms[MASS], domain->dimension, particle_mass(owner_));
  if (atoms[SPECIAL])
    error->all(FLERR,
               "Fix aleisph: special_bonds removes neighbors of atom {}, which has bonds; use "
               "special_bonds lj/coul 1 1 1, or weights of 1.0e-50",
               atoms[SPECIAL]);
  if (atoms[NO_ROLE])
    error->all(FLERR,
               "Fix aleisph: atom {} is neither fluid (group of fix aleisph/predictor) nor wall "
               "(group of fix aleisph/wall), or not in group {}",
               atoms[NO_ROLE], group->names[owner_.igroup]);
  if (atoms[TWO_ROLES])
    error->all(FLERR, "Fix aleisph: atom {} is both fluid and wall", atoms[TWO_ROLES]);
  if (atoms[BUFFER])
    error->all(FLERR, "Fix aleisph: buffer atom {} is not in the group of its fix aleisph/pressure",
               atoms[BUFFER]);
  if (atoms[CONTRADICTION]) refuse_contradiction(atoms[CONTRADICTION]);
}

void AleisphChecks::refuse_contradiction(long long code) const
{
  const auto pairs = static_cast<long long>(contradictions_.size());
  const auto &pair = contradictions_[code % pairs];
  const auto &one = owner_.scene().claims()[pair.first];
  const auto &other = owner_.scene().claims()[pair.second];
  error->all(
      FLERR,
      "Fix aleisph: atom {} is given two values of {}: {} by fix {} and {} by fix {}; take it out "
      "of the group of one of them",
      code / pairs, one.what, one.value, one.fix, other.value, other.fix);
}
