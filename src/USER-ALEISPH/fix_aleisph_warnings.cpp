/* ----------------------------------------------------------------------
   LAMMPS - Large-scale Atomic/Molecular Massively Parallel Simulator
   USER-ALEISPH package
   SPDX-License-Identifier: GPL-2.0-only
------------------------------------------------------------------------- */

#include "aleisph_halo_warnings.h"

#include "aleisph_halo_owner.h"
#include "aleisph_timestep.h"
#include "aleisph_vectors.h"
#include "aleisph_wall_suspects.h"
#include "atom.h"
#include "comm.h"
#include "error.h"
#include "update.h"

#include <algorithm>
#include <cmath>

using namespace LAMMPS_NS;
using aleisph::StepBound;
using Eigen::Vector3d;

namespace {

// The force on a wall is missing if its part along the normal is smaller than this share of that of
// the fluid beside it, which must not itself lie in the wall: sine of 6 degrees.
constexpr double MISSING = 0.01, IN_WALL = 0.1;
// Forces of fluid particles that point the same way: a body force, not one of their own each
constexpr double SAME_FORCE = 0.9;
// Of the velocity change that the force on a wall makes in a step: it is this one, up to rounding
constexpr double SAME_CHANGE = 1.0e-9;
// Where particles move by more than half their distance in a step, they jump over one another's
// pressure, whatever the solver does.
constexpr double LARGEST_COURANT = 0.5;
// Where they do not move, the fluid must not pass more than one of them in a step.
constexpr double LARGEST_AT_REST = 1.0;
// The time step is above a limit: by more than the rounding of the six digits that messages give
constexpr double ABOVE = 1.0 + 1.0e-5;
// Above this ratio, and from so many particles per rank on, it is worth a line in the script
constexpr double IMBALANCE = 1.5, MIN_LOAD = 1000.0;
// The time step is looked at in the first steps, 1, 2, 4, ..., and then every so many
constexpr bigint STRIDE = 128;

}    // namespace

void AleisphWarnings::start()
{
  body_force();
  imbalance();
  time_step();
}

/* ----------------------------------------------------------------------
   The pressure gradient on a wall balances the force on the wall particle;
   without that, the fluid beside it falls through its own pressure.
------------------------------------------------------------------------- */
void AleisphWarnings::body_force()
{
  const auto &cloud = owner_.cloud();
  const auto &s = cloud.stencil();
  const double *f = atom->nmax ? &atom->f[0][0] : nullptr;
  const auto lacks_force = [&](int i) {
    if (cloud.role()[i] & aleisph::DIRICHLET) return false;
    Vector3d sum = Vector3d::Zero();
    double size = 0.0;
    for (int k = s.begin(i); k < s.end(i); k++) {
      const int j = s.col()[k];
      if (j >= atom->nlocal || (cloud.role()[j] & aleisph::WALL)) continue;
      sum += aleisph::at(f, j);
      size += aleisph::at(f, j).norm();
    }
    const Vector3d n = aleisph::at(cloud.normal(), i);
    const double fluid = std::abs(sum.dot(n)) / std::max(1, s.end(i) - s.begin(i));
    return sum.norm() > SAME_FORCE * size && std::abs(sum.dot(n)) > IN_WALL * size &&
        std::abs(aleisph::at(f, i).dot(n)) < MISSING * fluid;
  };
  const tagint mine = aleisph::max_rows(
      cloud.wall(), [&](int i) { return lacks_force(i) ? atom->tag[i] : 0; }, tagint(0));
  const tagint found = owner_.ranks().largest(mine);
  if (found && first("force") && comm->me == 0)
    error->warning(
        FLERR,
        "Fix aleisph: there is a body force on the fluid and none on wall atom {} beside "
        "it, so that the pressure cannot balance it; let it act on group all, without fix "
        "setforce or freeze on walls",
        found);
}

void AleisphWarnings::moved_walls(int groupbit, const double *previous)
{
  const double per_mass = update->dt / particle_mass(owner_);
  const auto falls = [&](int i) {
    if (!(atom->mask[i] & groupbit)) return false;
    for (int a = 0; a < 3; a++) {
      const double fall = per_mass * atom->f[i][a];
      const double change = atom->v[i][a] - previous[3 * i + a];
      const double rounding = SAME_CHANGE * (std::abs(fall) + std::abs(atom->v[i][a]));
      if (fall != 0.0 && change != 0.0 && std::abs(change - fall) <= rounding &&
          std::abs(fall) > rounding)
        return true;
    }
    return false;
  };
  const tagint mine = aleisph::max_rows(
      atom->nlocal, [&](int i) { return falls(i) ? atom->tag[i] : 0; }, tagint(0));
  const tagint found = owner_.ranks().largest(mine);
  if (found && first("fall") && comm->me == 0)
    error->warning(
        FLERR,
        "Fix aleisph/wall: wall atom {} is moved by the force on it, as by fix nve or by "
        "NULL in fix move; the fluid does not act on it. Write 0 instead of NULL, or take "
        "walls out of the group of the integrator",
        found);
}

void AleisphWarnings::imbalance()
{
  const double mean = static_cast<double>(atom->natoms) / comm->nprocs;
  if (comm->nprocs == 1 || mean < MIN_LOAD) return;
  const double ratio = owner_.ranks().max(atom->nlocal) / mean;
  if (ratio > IMBALANCE && first("imbalance") && comm->me == 0)
    error->warning(FLERR,
                   "Fix aleisph: one rank has {:.3g} times the mean number of particles, and the "
                   "others wait for it; use fix balance, or the command processors",
                   ratio);
}

void AleisphWarnings::step()
{
  const bigint n = update->ntimestep - update->firststep;
  const bool look = n < STRIDE ? (n & (n - 1)) == 0 : n % STRIDE == 0;
  if (look || update->ntimestep == update->laststep) time_step();
}

/* ----------------------------------------------------------------------
   A step that fix aleisph/dt chooses obeys all limits. The others are told once that they are above
   the advisable step, as the predictor gives it, and once more if the flow becomes unstable. Of
   viscosity and tension the styles tell themselves. Where particles are at rest, only the full
   Courant limit counts: a share of it is a matter of accuracy, and flows along walls, which are
   what such particles are used for, have no convection that could lose any.
------------------------------------------------------------------------- */
void AleisphWarnings::time_step()
{
  if (owner_.scene().adaptive_step() || said_.count("unstable")) return;
  const bool moving = owner_.scene().moving();
  const auto limits = owner_.scene().step_limits();
  const auto shares = limits.scaled(aleisph::DEFAULT_STEP_SHARES);
  aleisph::StepBounds most;
  for (const auto bound : {StepBound::FORCE, StepBound::CONVECTION})
    most.lower(bound, shares[bound]);
  most.lower(StepBound::CFL,
             moving ? shares[StepBound::CFL] : LARGEST_AT_REST * limits[StepBound::CFL]);
  const double dt = update->dt, courant = dt / limits[StepBound::CFL];
  const bool unstable = courant > (moving ? LARGEST_COURANT : LARGEST_AT_REST) ||
      dt > ABOVE * shares[StepBound::CONVECTION];
  if (!(dt > ABOVE * most.smallest()) || !first(unstable ? "unstable" : "advisable")) return;

  const double *v = atom->nmax ? &atom->v[0][0] : nullptr;
  const auto speed = [v](int i) { return aleisph::at(v, i).norm(); };
  const double highest = owner_.ranks().max(aleisph::max_rows(atom->nlocal, speed, 0.0));
  const tagint mine = aleisph::max_rows(
      atom->nlocal, [&](int i) { return speed(i) == highest ? atom->tag[i] : 0; }, tagint(0));
  const tagint found = owner_.ranks().largest(mine);
  const auto bound = most.tightest();
  if (comm->me == 0)
    error->warning(
        FLERR,
        "Fix aleisph: timestep {:.6g} is {} at step {}: {} allows {:.6g} (Courant number {:.3g}, "
        "atom {} is the fastest); reduce it, or use fix aleisph/dt",
        dt, unstable ? "too large" : "above the advisable one", update->ntimestep, to_string(bound),
        shares[bound], courant, found);
}

std::string AleisphWarnings::likely_cause()
{
  const auto suspects = aleisph::wall_suspects(owner_.cloud());
  const auto tag = [this](int i) { return i < 0 ? 0LL : static_cast<long long>(atom->tag[i]); };
  long long atoms[] = {tag(suspects.facing), tag(suspects.dense), tag(suspects.sparse)};
  owner_.ranks().largest(3, atoms);
  const long singular = owner_.ranks().sum(owner_.tally().singular_rows);

  std::string text;
  const auto add = [&text](const std::string &cause) {
    text += (text.empty() ? "; look at the walls first: " : ", ") + cause;
  };
  const double d = owner_.cloud().spacing();
  if (atoms[0])
    add(fmt::format("atom {} is within the support ({:.4g}) of a face that looks the other way",
                    atoms[0], owner_.cloud().kernel().support()));
  if (atoms[1])
    add(fmt::format("atom {} is nearer than {:.4g} to another wall particle", atoms[1],
                    aleisph::WallSuspects::DENSE * d));
  if (atoms[2])
    add(fmt::format("atom {} has no other wall particle within {:.4g}", atoms[2],
                    aleisph::WallSuspects::SPARSE * d));
  if (singular) add(fmt::format("{} rows of the equation are singular", singular));
  return text;
}
