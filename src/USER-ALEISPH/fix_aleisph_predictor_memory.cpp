/* ----------------------------------------------------------------------
   LAMMPS - Large-scale Atomic/Molecular Massively Parallel Simulator
   USER-ALEISPH package
   SPDX-License-Identifier: GPL-2.0-only

   Second order in time of particles that move. As in velocity Verlet with a
   constraint (RATTLE, Andersen, J. Comput. Phys. 52 (1983) 24), what acts in a
   step comes from both its ends: a share w is what acted in the step before, at
   the old place, and the rest the pressure gradient and the force at the new one,
     N_n = w N_n-1 + (1 - w) (grad p - f)_n .
   It is written as the gradient of the pressure p~_n = w p~_n-1 + (1 - w) p_n that
   acts, plus what the old vector has and the old pressure at the new place has not:
     N_n = (grad p~_n - f_n) + E_n,   E_n = w [N_n-1 - (grad p~_n-1 - f_n)] .
   So the pressure equation, its boundary conditions and p~, the pressure of the
   package, are those of the scheme as published, with -E_n/rho0 as one more
   acceleration. N_n-1 is older by tau, half a step on the average, than the place
   it was formed at; w = dt/2/(tau + dt), 1/3 for equal steps, makes that half a
   step again. Unlike in RATTLE, where p itself is split, an impulse has gone after
   one step.
------------------------------------------------------------------------- */

#include "fix_aleisph_predictor.h"

#include "aleisph_halo_owner.h"
#include "aleisph_wall_contact.h"
#include "atom.h"
#include "domain.h"
#include "update.h"

#include <algorithm>
#include <cmath>
#include <limits>

using namespace LAMMPS_NS;

bool FixAleisphPredictor::remembers() const
{
  return params_.verlet && params_.frame != Frame::EULERIAN;
}

// Of the pressure of the step before, at the present positions. It does not act on particles that
// fly freely.
void FixAleisphPredictor::find_known_gradient()
{
  const auto &cloud = owner_->cloud();
  if (remembers()) complete_pressure();
  owner_->ranks().forward(owner_->fields().pressure());
  known_.assign(3 * static_cast<std::size_t>(atom->nlocal), 0.0);
  aleisph::gradient(cloud, cloud.fluid(), owner_->fields().pressure().all(), known_.data());
  if (!owner_->scene().surface().present) return;
  aleisph::for_rows(cloud.fluid(), [&](int i) {
    if (cloud.role()[i] & aleisph::BALLISTIC) std::fill_n(&known_[3 * i], 3, 0.0);
  });
}

// What has come new into the flow has no pressure of the step before: it gets that of the fluid
// around, which is not new itself; the pressure outside if there is none. Walls that were dry, and
// particles that were created or flew freely.
void FixAleisphPredictor::complete_pressure()
{
  const auto &cloud = owner_->cloud();
  const double *memory = owner_->fields().memory();
  const auto is_new = [memory](int i) { return memory[4 * i + 3] == AleisphFields::NEW; };
  const aleisph::Rows walls = aleisph::select_rows(cloud.wall(), is_new);
  const aleisph::Rows fluid = aleisph::select_rows(cloud.fluid(), is_new);
  if (!owner_->ranks().any(!walls.empty() || !fluid.empty())) return;
  const aleisph::Field pressure = owner_->fields().pressure();
  double *p = pressure.edit();
  aleisph::for_rows(fluid, [p](int i) { p[i] = std::numeric_limits<double>::quiet_NaN(); });
  owner_->ranks().forward(pressure);
  aleisph::fit_to_fluid(cloud, fluid, pressure.edit());
  const double outside = owner_->scene().surface().pressure;
  aleisph::for_rows(fluid, [p, outside](int i) {
    if (std::isnan(p[i])) p[i] = outside;
  });
  owner_->ranks().forward(pressure);
  aleisph::fit_to_fluid(cloud, walls, pressure.edit());
}

// With the first pressure: that of an instant. The pressure equation adds its gradient.
void FixAleisphPredictor::start_memory()
{
  memory_dt_ = 0.0;
  if (!remembers()) return;
  double *memory = owner_->fields().memory();
  const double density = owner_->fluid().rho0 / particle_mass(*owner_);
  aleisph::for_rows(owner_->cloud().fluid(), [&](int i) {
    for (int c = 0; c < 3; c++) memory[4 * i + c] = -density * atom->f[i][c];
    memory[4 * i + 3] = AleisphFields::SOLVED;
  });
}

// a -= E/rho0, and N without grad p~, which the pressure equation adds. A particle that is new or has
// flown freely has none.
void FixAleisphPredictor::add_memory(std::vector<double> &a)
{
  const auto &cloud = owner_->cloud();
  double *memory = owner_->fields().memory();
  const double dt = update->dt, rho0 = owner_->fluid().rho0;
  const double share = dt / (memory_dt_ + 2.0 * dt);
  const double density = rho0 / particle_mass(*owner_);
  const int dim = domain->dimension;
  aleisph::for_rows(cloud.fluid(), [&](int i) {
    double *N = memory + 4 * i;
    const bool flies = cloud.role()[i] & aleisph::BALLISTIC;
    const double w = N[3] != AleisphFields::NEW && !flies ? share : 0.0;
    for (int c = 0; c < dim; c++) {
      const double f = density * atom->f[i][c];
      const double E = w * (N[c] - known_[3 * i + c] + f);
      a[3 * i + c] -= E / rho0;
      N[c] = E - f;
    }
    N[3] = flies ? AleisphFields::NEW : AleisphFields::MET;
  });
  memory_dt_ = dt;
}
