/* ----------------------------------------------------------------------
   LAMMPS - Large-scale Atomic/Molecular Massively Parallel Simulator
   USER-ALEISPH package
   SPDX-License-Identifier: GPL-2.0-only

   The owner's part about walls: their normals, which stay with the
   particles as long as no wall moves, and which of them are dry.
------------------------------------------------------------------------- */

#include "fix_aleisph.h"

#include "atom.h"
#include "domain.h"
#include "error.h"
#include "neigh_list.h"

#include <algorithm>
#include <cmath>

using namespace LAMMPS_NS;
using aleisph::Part;
using aleisph::Role;

namespace {
constexpr char WALL_SHAPE[] = "aleisph_n";    // normal and shape
constexpr int COLUMNS = 4;
// Fluid above a wall particle wets it from 1.5 spacings, fluid beside it from 1.2: above is within
// 30 degrees of the normal. Measured on tanks with jitter to 0.3 d.
constexpr double REACH_ABOVE = 1.25, ABOVE = 0.866;

bool is_fluid(Role role)
{
  return (role & (aleisph::FLUID | aleisph::WALL)) == aleisph::FLUID;
}

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
  if (walls_.empty()) return;
  const double *stored = custom(WALL_SHAPE);
  shape_.assign(nall(), 0.0);
  for (int i = 0; i < atom->nlocal; i++) {
    if (!(role_[i] & aleisph::WALL)) continue;
    std::copy(stored + COLUMNS * i, stored + COLUMNS * i + 3, &normal_[3 * i]);
    shape_[i] = stored[COLUMNS * i + 3];
  }
}

// of this rank
bool FixAleisph::walls_changed()
{
  if (walls_.empty()) return false;
  bool changed = !walls_located_;
  for (int i = 0; i < atom->nlocal && !changed; i++)
    if (role_[i] & aleisph::WALL) changed = is_zero(&normal_[3 * i]) || !is_zero(atom->v[i]);
  walls_located_ = true;
  return changed;
}

void FixAleisph::locate_walls(bool changed)
{
  if (walls_.empty()) return;
  aleisph::Timers::Scope scope(timers_, Part::OPERATORS);
  if (changed) {
    find_normals();
    double *stored = custom(WALL_SHAPE);
    for (int i = 0; i < atom->nlocal; i++) {
      if (!(role_[i] & aleisph::WALL)) continue;
      std::copy(&normal_[3 * i], &normal_[3 * i] + 3, stored + COLUMNS * i);
      stored[COLUMNS * i + 3] = shape_[i];
    }
  }
  forward(normal_.data(), 3);
  forward(shape_.data(), 1);
}

// Each sweep goes one particle further along walls that no fluid is near.
void FixAleisph::find_normals()
{
  previous_normal_.assign(normal_.begin(), normal_.begin() + 3 * atom->nlocal);
  for (int i = 0; i < atom->nlocal; i++)
    if (role_[i] & aleisph::WALL) std::fill_n(&normal_[3 * i], 3, shape_[i] = 0.0);

  aleisph::Stencil stencil;
  stencil.build(cloud_->kernel(), atom->nlocal, atom->x,
                {list_->numneigh, list_->firstneigh, NEIGHMASK}, {role_.data(), aleisph::WALL, 0});
  long found = 1;
  while (found) {
    forward(normal_.data(), 3);
    forward(shape_.data(), 1);
    found = 0;
    for (auto *wall : walls_) found += wall->find_normals(stencil);
    found = sum(found);
  }
  tally_.wall_passes++;
  previous_normal_.clear();
}

/* ----------------------------------------------------------------------
   A wall particle takes part as long as there is fluid within `dry_reach`
   (1.2 spacings), or that distance from each of the walls that meet in a
   concave edge or corner. Farther ones would be neighbours without pressure.
   Jitter can move all fluid a little further off a wetted wall: there it is
   still above the wall particle, and at a contact line beside it.
------------------------------------------------------------------------- */

// whether the fluid within the support lies above wall particle i, not beside it
bool FixAleisph::below_fluid(int i) const
{
  const double support = cloud_->kernel().support();
  double up[3] = {0.0, 0.0, 0.0};
  for (int m = 0; m < list_->numneigh[i]; m++) {
    const int j = list_->firstneigh[i][m] & NEIGHMASK;
    if (!is_fluid(role_[j])) continue;
    double r[3], r2 = 0.0;
    for (int a = 0; a < 3; a++) {
      r[a] = a < domain->dimension ? atom->x[j][a] - atom->x[i][a] : 0.0;
      r2 += r[a] * r[a];
    }
    if (r2 == 0.0 || r2 >= support * support) continue;
    const double weight = -cloud_->kernel().dw(std::sqrt(r2)) / std::sqrt(r2);
    for (int a = 0; a < 3; a++) up[a] += weight * r[a];
  }
  const double *n = &normal_[3 * i];
  const double length = std::hypot(up[0], up[1], up[2]);
  return up[0] * n[0] + up[1] * n[1] + up[2] * n[2] > ABOVE * length;
}

void FixAleisph::mark_dry_walls()
{
  if (!dry_rule() || walls_.empty()) return;
  aleisph::Timers::Scope scope(timers_, Part::STENCIL);
  double **x = atom->x;
  const int dim = domain->dimension;
  ndry_ = 0;
  for (int i = 0; i < atom->nlocal; i++) {
    if (!(role_[i] & aleisph::WALL)) continue;
    const double reach = surface_.dry_reach * spacing_ * std::max(shape_[i], 1.0);
    double nearest2 = INFINITY;
    for (int m = 0; m < list_->numneigh[i]; m++) {
      const int j = list_->firstneigh[i][m] & NEIGHMASK;
      if (!is_fluid(role_[j])) continue;
      double r2 = 0.0;
      for (int a = 0; a < dim; a++) r2 += (x[i][a] - x[j][a]) * (x[i][a] - x[j][a]);
      nearest2 = std::min(nearest2, r2);
    }
    if (nearest2 < reach * reach) continue;
    if (nearest2 < REACH_ABOVE * REACH_ABOVE * reach * reach && below_fluid(i)) continue;
    role_[i] |= aleisph::DRY;
    ndry_++;
  }
  forward_roles();
}

void FixAleisph::forward_roles()
{
  std::vector<double> bits(role_.begin(), role_.end());
  forward(bits.data(), 1);
  for (int i = atom->nlocal; i < nall(); i++) role_[i] = static_cast<Role>(bits[i]);
  cloud_->roles_changed();
}
