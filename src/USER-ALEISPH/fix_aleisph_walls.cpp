/* ----------------------------------------------------------------------
   LAMMPS - Large-scale Atomic/Molecular Massively Parallel Simulator
   USER-ALEISPH package
   SPDX-License-Identifier: GPL-2.0-only

   The owner's part about walls: their normals, which stay with the
   particles as long as no wall moves, and which of them are dry.
------------------------------------------------------------------------- */

#include "fix_aleisph.h"

#include "aleisph_halo_owner.h"
#include "aleisph_wall_contact.h"
#include "aleisph_wall_dry.h"
#include "aleisph_wall_normals.h"
#include "atom.h"
#include "neigh_list.h"

#include <algorithm>
#include <cmath>

using namespace LAMMPS_NS;
using aleisph::Part;
using aleisph::Role;

namespace {
constexpr int COLUMNS = 4;
// as stored shape: a search has not found the normal
constexpr double SEARCHED = -1.0;

bool is_zero(const double *n)
{
  return n[0] == 0.0 && n[1] == 0.0 && n[2] == 0.0;
}

}    // namespace

/* ----------------------------------------------------------------------
   Normals into the fluid and shapes of all wall particles, owned and ghost.
   They are found at the start of a run, whenever a wall moves, and when one
   that was not found comes in sight of fluid; else those kept with the
   particles are taken.
------------------------------------------------------------------------- */

void FixAleisph::restore_walls()
{
  if (scene_->walls().empty()) return;
  const double *stored = fields_->wall_normals();
  aleisph::for_rows(atom->nlocal, [&](int i) {
    if (!(cloud_->role()[i] & aleisph::WALL)) return;
    std::copy(stored + COLUMNS * i, stored + COLUMNS * i + 3, cloud_->normal() + 3 * i);
    cloud_->shape()[i] = std::max(0.0, stored[COLUMNS * i + 3]);
  });
}

// of this rank
bool FixAleisph::walls_changed()
{
  if (scene_->walls().empty()) return false;
  const bool first = !walls_located_;
  walls_located_ = true;
  if (first) return true;
  const double *stored = fields_->wall_normals();
  const auto is_unknown = [this](int i) {
    return (cloud_->role()[i] & aleisph::WALL) && is_zero(cloud_->normal() + 3 * i);
  };
  const aleisph::Rows unknown = aleisph::select_rows(atom->nlocal, is_unknown);
  const auto has_changed = [&](int i) {
    return (cloud_->role()[i] & aleisph::WALL) &&
        (!is_zero(atom->v[i]) || (is_unknown(i) && stored[COLUMNS * i + 3] != SEARCHED));
  };
  const bool changed = aleisph::count_rows(atom->nlocal, has_changed) > 0;
  return changed || (!unknown.empty() && in_sight(unknown));
}

// Their neighbours that are known have not changed, nor have ghosts that are not known.
bool FixAleisph::in_sight(const std::vector<int> &unknown) const
{
  constexpr aleisph::Role ASKED = 1u << 31;    // none of the roles
  std::vector<aleisph::Role> role(cloud_->role(), cloud_->role() + cloud_->size());
  aleisph::for_rows(unknown, [&](int i) { role[i] |= ASKED; });
  aleisph::Stencil stencil;
  stencil.build(cloud_->kernel(), atom->nlocal, atom->x,
                {list_->numneigh, list_->firstneigh, NEIGHMASK}, {role.data(), ASKED, 0});
  return aleisph::normals_in_sight(stencil, unknown, *cloud_);
}

void FixAleisph::locate_walls(bool changed)
{
  if (scene_->walls().empty()) return;
  aleisph::Timers::Scope scope(*timers_, Part::OPERATORS);
  if (changed) {
    find_normals();
    double *stored = fields_->wall_normals();
    aleisph::for_rows(atom->nlocal, [&](int i) {
      if (!(cloud_->role()[i] & aleisph::WALL)) return;
      std::copy(cloud_->normal() + 3 * i, cloud_->normal() + 3 * i + 3, stored + COLUMNS * i);
      stored[COLUMNS * i + 3] = is_zero(cloud_->normal() + 3 * i) ? SEARCHED : cloud_->shape()[i];
    });
  }
  ranks_->forward(cloud_->normal(), 3);
  ranks_->forward(cloud_->shape(), 1);
}

// Each sweep goes one particle further along walls that no fluid is near.
void FixAleisph::find_normals()
{
  const double *normal = cloud_->normal();
  const std::vector<double> previous(normal, normal + 3 * atom->nlocal);
  aleisph::for_rows(atom->nlocal, [this](int i) {
    if (cloud_->role()[i] & aleisph::WALL)
      std::fill_n(cloud_->normal() + 3 * i, 3, cloud_->shape()[i] = 0.0);
  });

  aleisph::Stencil stencil;
  stencil.build(cloud_->kernel(), atom->nlocal, atom->x,
                {list_->numneigh, list_->firstneigh, NEIGHMASK},
                {cloud_->role(), aleisph::WALL, 0});
  long found = 1;
  while (found) {
    ranks_->forward(cloud_->normal(), 3);
    ranks_->forward(cloud_->shape(), 1);
    found = 0;
    for (auto *walls : scene_->walls()) found += walls->find_normals(stencil, previous.data());
    found = ranks_->sum(found);
  }
  tally_.wall_passes++;
}

void FixAleisph::mark_dry_walls()
{
  if (!scene_->dry_rule()) return;
  aleisph::Timers::Scope scope(*timers_, Part::STENCIL);
  tally_.dry_walls = aleisph::mark_dry_walls(atom->x, candidates(), scene_->surface().dry_reach,
                                             *cloud_);
  ranks_->forward_roles(*cloud_);
}

/* ---------------------------------------------------------------------- */

void LAMMPS_NS::slide_with_fluid(FixAleisph &owner, const aleisph::Field &v)
{
  const auto &cloud = owner.cloud();
  if (!owner.scene().has(aleisph::SLIP)) return;
  aleisph::slide_with_fluid(cloud, aleisph::slip_walls(cloud), v.edit());
  owner.ranks().forward(v);
}

const double *LAMMPS_NS::sliding_velocity(FixAleisph &owner, std::vector<double> &work)
{
  const double *v = owner.fields().velocity().all();
  if (!owner.scene().has(aleisph::SLIP)) return v;
  work.assign(v, v + 3 * static_cast<std::size_t>(owner.cloud().size()));
  bool valid = true;
  slide_with_fluid(owner, {work.data(), 3, valid});
  return work.data();
}

void LAMMPS_NS::velocity_divergence(FixAleisph &owner, double *div)
{
  owner.ranks().forward(owner.fields().velocity());
  std::vector<double> work;
  const double *v = sliding_velocity(owner, work);
  aleisph::divergence(owner.cloud(), owner.cloud().fluid(), v, div);
}
