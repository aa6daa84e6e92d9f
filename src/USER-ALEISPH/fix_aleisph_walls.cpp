/* ----------------------------------------------------------------------
   LAMMPS - Large-scale Atomic/Molecular Massively Parallel Simulator
   USER-ALEISPH package
   SPDX-License-Identifier: GPL-2.0-only

   The owner's part about walls: their normals, which stay with the
   particles as long as no wall moves, and which of them are dry.
------------------------------------------------------------------------- */

#include "fix_aleisph.h"

#include "aleisph_halo_owner.h"
#include "aleisph_wall_dry.h"
#include "atom.h"
#include "neigh_list.h"

#include <algorithm>
#include <cmath>

using namespace LAMMPS_NS;
using aleisph::Part;
using aleisph::Role;

namespace {
constexpr int COLUMNS = 4;

bool is_zero(const double *n)
{
  return n[0] == 0.0 && n[1] == 0.0 && n[2] == 0.0;
}

}    // namespace

/* ----------------------------------------------------------------------
   Normals into the fluid and shapes of all wall particles, owned and ghost.
   They are found at the start of a run, while one is unknown, and whenever a
   wall moves; else those kept with the particles are taken.
------------------------------------------------------------------------- */

void FixAleisph::restore_walls()
{
  if (scene_->walls().empty()) return;
  const double *stored = fields_->wall_normals();
  for (int i = 0; i < atom->nlocal; i++) {
    if (!(cloud_->role()[i] & aleisph::WALL)) continue;
    std::copy(stored + COLUMNS * i, stored + COLUMNS * i + 3, cloud_->normal() + 3 * i);
    cloud_->shape()[i] = stored[COLUMNS * i + 3];
  }
}

// of this rank
bool FixAleisph::walls_changed()
{
  if (scene_->walls().empty()) return false;
  bool changed = !walls_located_;
  for (int i = 0; i < atom->nlocal && !changed; i++)
    if (cloud_->role()[i] & aleisph::WALL)
      changed = is_zero(cloud_->normal() + 3 * i) || !is_zero(atom->v[i]);
  walls_located_ = true;
  return changed;
}

void FixAleisph::locate_walls(bool changed)
{
  if (scene_->walls().empty()) return;
  aleisph::Timers::Scope scope(*timers_, Part::OPERATORS);
  if (changed) {
    find_normals();
    double *stored = fields_->wall_normals();
    for (int i = 0; i < atom->nlocal; i++) {
      if (!(cloud_->role()[i] & aleisph::WALL)) continue;
      std::copy(cloud_->normal() + 3 * i, cloud_->normal() + 3 * i + 3, stored + COLUMNS * i);
      stored[COLUMNS * i + 3] = cloud_->shape()[i];
    }
  }
  ranks_->forward(cloud_->normal(), 3);
  ranks_->forward(cloud_->shape(), 1);
}

// Each sweep goes one particle further along walls that no fluid is near.
void FixAleisph::find_normals()
{
  const double *normal = cloud_->normal();
  const std::vector<double> previous(normal, normal + 3 * atom->nlocal);
  for (int i = 0; i < atom->nlocal; i++)
    if (cloud_->role()[i] & aleisph::WALL)
      std::fill_n(cloud_->normal() + 3 * i, 3, cloud_->shape()[i] = 0.0);

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
