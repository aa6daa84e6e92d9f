/* ----------------------------------------------------------------------
   LAMMPS - Large-scale Atomic/Molecular Massively Parallel Simulator
   USER-ALEISPH package
   SPDX-License-Identifier: GPL-2.0-only

   v* of walls, which their rows of the pressure equation are made with: what the
   fluid at this place would have without pressure.
------------------------------------------------------------------------- */

#include "fix_aleisph_predictor.h"

#include "aleisph_halo_owner.h"
#include "aleisph_wall_contact.h"
#include "atom.h"
#include "update.h"

#include <algorithm>
#include <cmath>
#include <limits>

using namespace LAMMPS_NS;

/* ----------------------------------------------------------------------
   The velocity before the step and the acceleration of the fluid. With the
   velocity after the step the acceleration of a wall would not push the fluid.
------------------------------------------------------------------------- */

void FixAleisphPredictor::predict_walls()
{
  const auto &wall = owner_->cloud().wall();
  const double *before = owner_->fields().wall_velocity();
  double *vstar = owner_->fields().predicted().edit();
  aleisph::for_rows(wall, [&](int i) {
    for (int k = 3 * i; k < 3 * i + 3; k++) vstar[k] = before[k] + update->dt * a_[k];
  });
  meet_walls(vstar);
}

/* ----------------------------------------------------------------------
   A wall particle that meets the fluid only now, in the first step of a
   simulation or after it was dry, need not have had its velocity: what comes
   together is stopped by the pressure of this step. So its v* is formed with
   the normal velocity of the fluid. After it was dry only what approaches counts:
   fluid that leaves, at the edge of the support, would be drawn back at once. And
   there it is the mean over the neighbors: from a sheet that leaves the wall a
   linear fit leads to fluid that approaches.
------------------------------------------------------------------------- */

void FixAleisphPredictor::meet_walls(double *vstar)
{
  const auto &cloud = owner_->cloud();
  const double *memory = owner_->fields().memory(), *before = owner_->fields().wall_velocity();
  const auto walls_that = [&](double state) {
    return aleisph::select_rows(cloud.wall(),
                                [&](int i) { return memory[4 * i + 3] == state; });
  };
  const aleisph::Rows first = walls_that(AleisphFields::SOLVED);
  const aleisph::Rows wetted = walls_that(AleisphFields::NEW);
  if (first.empty() && wetted.empty()) return;
  const double *fluid = owner_->fields().velocity().all();
  std::vector<double> speed(atom->nlocal, std::numeric_limits<double>::quiet_NaN());
  aleisph::normal_part_of_fluid(cloud, aleisph::fit_to_walls(cloud, first), fluid, speed.data());
  aleisph::mean_normal_part(cloud, wetted, fluid, speed.data());
  const auto meet = [&](int i, double most) {
    if (std::isnan(speed[i])) return;    // no fluid beside it
    const double *n = cloud.normal() + 3 * i, *v = before + 3 * i;
    const double jump = speed[i] - (v[0] * n[0] + v[1] * n[1] + v[2] * n[2]);
    for (int c = 0; c < 3; c++) vstar[3 * i + c] += std::min(jump, most) * n[c];
  };
  aleisph::for_rows(first, [&](int i) { meet(i, std::numeric_limits<double>::max()); });
  aleisph::for_rows(wetted, [&](int i) { meet(i, 0.0); });
}

/* ----------------------------------------------------------------------
   The viscous force on no-slip walls, that the pressure gradient balances:
     curlcurl   lap v = -curl curl v, for a divergence-free v, at the wall itself.
                The Laplacian there is one-sided, which is unstable.
     default    its normal part. Where no particle moves that of the fluid beside
                the wall, by a linear fit to lap v there, which is exact in channels
                up to their open ends; among particles that move this is unstable
                at viscous steps, and it is that of curlcurl.
------------------------------------------------------------------------- */

void FixAleisphPredictor::add_wall_viscosity(std::vector<double> &a)
{
  if (nu_ == 0.0 || !owner_->scene().has(aleisph::WALL)) return;
  const aleisph::Role *role = owner_->cloud().role();
  std::vector<double> lap(a.size(), 0.0);
  const bool moving = owner_->scene().moving();
  if (!moving) find_wall_laplacian(lap.data());
  if (moving || owner_->scene().has(aleisph::CURLCURL)) find_wall_curl(lap.data());
  const aleisph::Rows rows = aleisph::select_rows(
      owner_->cloud().wall(), [role](int i) { return !(role[i] & aleisph::SLIP); });
  if (params_.theta > 0.0) approach_gradually(rows, lap.data());
  aleisph::for_rows(rows, [&](int i) {
    for (int k = 3 * i; k < 3 * i + 3; k++) a[k] += nu_ * lap[k];
  });
}

// its normal part; work_ holds lap v of the fluid where viscosity is explicit
void FixAleisphPredictor::find_wall_laplacian(double *lap)
{
  const auto &cloud = owner_->cloud();
  const double *v = owner_->fields().velocity().all();
  if (params_.theta > 0.0) aleisph::laplacian(cloud, cloud.fluid(), v, work_.data());
  owner_->ranks().forward(work_.data(), 3);
  const aleisph::Rows rows = aleisph::select_rows(cloud.wall(), [&](int i) {
    return !(cloud.role()[i] & (aleisph::SLIP | aleisph::CURLCURL));
  });
  if (fit_version_ != cloud.version()) *fit_ = aleisph::fit_to_walls(cloud, rows);
  fit_version_ = cloud.version();
  std::vector<double> part(atom->nlocal, 0.0);
  aleisph::normal_part_of_fluid(cloud, *fit_, work_.data(), part.data());
  aleisph::for_rows(rows, [&](int i) {
    for (int c = 0; c < 3; c++) lap[3 * i + c] = part[i] * cloud.normal()[3 * i + c];
  });
}

// On walls that ask for it, and where particles move its normal part on the others. The vorticity is
// needed on walls and on what sees them.
void FixAleisphPredictor::find_wall_curl(double *lap)
{
  auto &cloud = owner_->cloud();
  const aleisph::Role *role = cloud.role();
  const bool moving = owner_->scene().moving();
  const aleisph::Rows rows = aleisph::select_rows(cloud.wall(), [&](int i) {
    return (role[i] & aleisph::CURLCURL) || (moving && !(role[i] & aleisph::SLIP));
  });
  const aleisph::SeenRoles neighbours = cloud.neighbours();
  const aleisph::Rows beside = aleisph::select_rows(cloud.all(), [&](int i) {
    return (role[i] & aleisph::WALL) || neighbours.any(i, aleisph::WALL);
  });
  std::vector<double> vorticity(3 * static_cast<std::size_t>(cloud.size()), 0.0);
  std::vector<double> curls(3 * static_cast<std::size_t>(atom->nlocal));
  aleisph::curl(cloud, beside, owner_->fields().velocity().all(), vorticity.data());
  owner_->ranks().forward(vorticity.data(), 3);
  aleisph::curl(cloud, rows, vorticity.data(), curls.data());
  aleisph::for_rows(rows, [&](int i) {
    const double *n = cloud.normal() + 3 * i, *curl = &curls[3 * i];
    const bool whole = role[i] & aleisph::CURLCURL;
    const double normal = curl[0] * n[0] + curl[1] * n[1] + curl[2] * n[2];
    for (int c = 0; c < 3; c++) lap[3 * i + c] = whole ? -curl[c] : -normal * n[c];
  });
}

/* ----------------------------------------------------------------------
   lap is of the velocity before the step. In an implicit step of more than
   d^2/nu the fluid answers to the pressure with several times what it was
   before, so that what acts must approach lap gradually; steady states do not
   depend on the share. Flow past cylinders, nu dt/d^2 = 5 and 20: shares of 0.3
   and 0.1 are unstable, 0.1 and 0.03 stable; taken are 0.09 and 0.024.
------------------------------------------------------------------------- */

void FixAleisphPredictor::approach_gradually(const aleisph::Rows &rows, double *lap)
{
  double *memory = owner_->fields().memory();
  const double share = 1.0 / (1.0 + 2.0 * params_.theta * viscous_number());
  aleisph::for_rows(rows, [&](int i) {
    double *acts = memory + 4 * i;
    const double taken = acts[3] == AleisphFields::NEW ? 1.0 : share;
    for (int c = 0; c < 3; c++) {
      acts[c] += taken * (lap[3 * i + c] - acts[c]);
      lap[3 * i + c] = acts[c];
    }
  });
}
