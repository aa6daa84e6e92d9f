/* ----------------------------------------------------------------------
   LAMMPS - Large-scale Atomic/Molecular Massively Parallel Simulator
   USER-ALEISPH package
   SPDX-License-Identifier: GPL-2.0-only

   The right-hand side of the pressure equation.
------------------------------------------------------------------------- */

#include "fix_aleisph_ppe.h"

#include "aleisph_halo_owner.h"
#include "aleisph_solve_ppe.h"
#include "aleisph_wall_contact.h"
#include "atom.h"
#include "update.h"

using namespace LAMMPS_NS;
using aleisph::Part;

void FixAleisphPPE::right_hand_side()
{
  const aleisph::Field predicted = owner_->fields().predicted();
  owner_->complete_velocity(predicted);
  slide_with_fluid(*owner_, predicted);
  aleisph::Timers::Scope scope(owner_->timers(), Part::ASSEMBLY);
  find_laplacian();
  // before the first pressure v* holds an acceleration, relative to the wall's
  std::vector<double> at_rest;
  const double *vwall = owner_->fields().velocity().owned();
  if (!owner_->fields().pressure_known()) {
    at_rest.assign(3 * static_cast<std::size_t>(atom->nlocal), 0.0);
    vwall = at_rest.data();
  }
  aleisph::PpeFields fields;
  fields.rho_over_dt = owner_->fluid().rho0 / update->dt;
  fields.vstar = predicted.owned();
  fields.vwall = vwall;
  fields.div = div_.data();
  fields.second_order = params_.second_order;
  fields.p = owner_->fields().pressure().owned();
  fields.p_surf = owner_->scene().surface().pressure;
  if (const auto *load = owner_->scene().load()) fields.load = load->surface_pressure();
  rhs_.resize(atom->nlocal);
  aleisph::ppe_rhs(owner_->cloud(), owner_->fields().ppe_layout(), fields, rhs_.data());
}

// dt/rho0 lap p, as the equation makes it: div v* and what is given back
void FixAleisphPPE::find_laplacian()
{
  auto &cloud = owner_->cloud();
  const double *vstar = owner_->fields().predicted().all();
  div_.resize(cloud.size());
  aleisph::divergence(cloud, cloud.fluid(), vstar, div_.data());
  if (gives_back() && owner_->fields().pressure_known()) {
    const double *given = owner_->fields().given_back();
    const double factor = update->dt / owner_->fluid().rho0;
    aleisph::for_rows(cloud.fluid(), [&](int i) { div_[i] += factor * given[i]; });
  }
  // on walls it is that of the fluid beside them, to the order of the row: alpha is half a spacing
  if (!params_.second_order || !owner_->scene().has(aleisph::WALL)) return;
  owner_->ranks().forward(div_.data(), 1);
  aleisph::mean_of_fluid(cloud, cloud.wall(), div_.data());
}
