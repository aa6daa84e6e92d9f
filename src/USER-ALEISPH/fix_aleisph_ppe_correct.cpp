/* ----------------------------------------------------------------------
   LAMMPS - Large-scale Atomic/Molecular Massively Parallel Simulator
   USER-ALEISPH package
   SPDX-License-Identifier: GPL-2.0-only

   After the solve: the velocity is corrected, and what the next step needs is
   kept.
------------------------------------------------------------------------- */

#include "fix_aleisph_ppe.h"

#include "aleisph_halo_owner.h"
#include "aleisph_solve_leftover.h"
#include "atom.h"
#include "update.h"

#include <algorithm>
#include <cmath>

using namespace LAMMPS_NS;
using aleisph::Part;

namespace {
// Of what is not smooth. One is unstable on irregular particles beside walls within 740 steps, 0.97
// is stable: see the documentation.
constexpr double SHARE = 0.95;
}    // namespace

void FixAleisphPPE::find_gradient()
{
  auto &cloud = owner_->cloud();
  grad_.resize(3 * static_cast<std::size_t>(atom->nlocal));
  aleisph::gradient(cloud, cloud.fluid(), owner_->fields().pressure().all(), grad_.data());
  if (!owner_->scene().surface().present) return;
  const aleisph::Role *role = cloud.role();
  aleisph::for_rows(cloud.fluid(), [&](int i) {
    if (role[i] & aleisph::BALLISTIC) std::fill_n(&grad_[3 * i], 3, 0.0);
  });
}

void FixAleisphPPE::correct_velocity()
{
  const aleisph::Field velocity = owner_->fields().velocity();
  double *v = velocity.edit();
  {
    aleisph::Timers::Scope scope(owner_->timers(), Part::MOMENTUM);
    find_gradient();
    if (auto *guard = owner_->scene().pressure_guard())
      guard->guard_pressure(owner_->fields().pressure(), grad_.data());
    const double *vstar = owner_->fields().predicted().owned();
    const double factor = update->dt / owner_->fluid().rho0;
    double *change = owner_->fields().property("aleisph_dv");
    aleisph::for_rows(owner_->cloud().fluid(), [&](int i) {
      for (int k = 3 * i; k < 3 * i + 3; k++) {
        const double before = v[k];
        v[k] = vstar[k] - factor * grad_[k];
        if (change) change[k] = (v[k] - before) / update->dt;
      }
    });
    remember();
  }
  if (auto *guard = owner_->scene().velocity_guard()) guard->guard_velocity(v);
  if (!owner_->scene().conditions().empty()) owner_->complete_velocity(velocity);
  if (gives_back()) keep_leftover();
}

// The predictor has left in the memory what it took of it, and the force; see there.
void FixAleisphPPE::remember()
{
  const auto &cloud = owner_->cloud();
  double *memory = owner_->fields().memory();
  if (owner_->scene().memory())
    aleisph::for_rows(cloud.fluid(), [&](int i) {
      for (int a = 0; a < 3; a++) memory[4 * i + a] += grad_[3 * i + a];
    });
  if (!owner_->fields().pressure_known()) {
    start_motion(memory);
    aleisph::for_rows(cloud.wall(), [&](int i) { memory[4 * i + 3] = AleisphFields::SOLVED; });
    return;
  }
  aleisph::for_rows(cloud.wall(), [&](int i) { memory[4 * i + 3] = AleisphFields::MET; });
  if (!owner_->scene().dry_rule()) return;
  aleisph::for_rows(atom->nlocal, [&](int i) {
    if (cloud.role()[i] & aleisph::DRY) memory[4 * i + 3] = AleisphFields::NEW;
  });
}

// The acceleration that the first step begins with; viscosity, left out, changes the place after it
// by nu dt^2/2 lap v.
void FixAleisphPPE::start_motion(const double *memory)
{
  double *change = owner_->fields().property("aleisph_dv");
  if (!change) return;
  const double factor = -1.0 / owner_->fluid().rho0;
  aleisph::for_rows(owner_->cloud().fluid(), [&](int i) {
    for (int a = 0; a < 3; a++) change[3 * i + a] = factor * memory[4 * i + a];
  });
}

// In a frame that moves, what is left stays behind with the places of the particles.
bool FixAleisphPPE::gives_back() const
{
  return params_.gives_back && !owner_->scene().moving();
}

void FixAleisphPPE::keep_leftover()
{
  auto &cloud = owner_->cloud();
  find_divergence();
  aleisph::Timers::Scope scope(owner_->timers(), Part::MOMENTUM);
  double *given = owner_->fields().given_back();
  const double factor = owner_->fluid().rho0 / update->dt;
  const aleisph::Rows rows = aleisph::leftover_rows(cloud, owner_->fields().ppe_layout());
  left_.assign(cloud.size(), 0.0);
  aleisph::for_rows(rows, [&](int i) { left_[i] = given[i] + factor * div_[i]; });
  owner_->ranks().forward(left_.data(), 1);
  std::fill_n(given, atom->nlocal, 0.0);
  aleisph::given_back(cloud, rows, SHARE, left_.data(), given);
}

// of the velocity, on fluid
void FixAleisphPPE::find_divergence()
{
  div_.resize(owner_->cloud().size());
  velocity_divergence(*owner_, div_.data());
}

double FixAleisphPPE::max_divergence()
{
  find_divergence();
  const auto &types = owner_->fields().row_types();
  const auto divergence = [&](int i) {
    return types.empty() || types[i] == aleisph::RowType::FLUID ? std::fabs(div_[i]) : 0.0;
  };
  return owner_->ranks().max(aleisph::max_rows(owner_->cloud().fluid(), divergence, 0.0));
}
