/* ----------------------------------------------------------------------
   LAMMPS - Large-scale Atomic/Molecular Massively Parallel Simulator
   USER-ALEISPH package
   SPDX-License-Identifier: GPL-2.0-only

   The predictor: terms of the acceleration, and the explicit step
------------------------------------------------------------------------- */

#include "fix_aleisph_predictor.h"

#include "aleisph_halo_owner.h"
#include "aleisph_surface.h"
#include "atom.h"
#include "domain.h"
#include "update.h"

using namespace LAMMPS_NS;
using aleisph::Part;

/* ----------------------------------------------------------------------
   Before the first pressure: v* := dt (nu lap v + f/m - v.grad v), the
   acceleration of the fluid without pressure, whatever the frame.
------------------------------------------------------------------------- */

void FixAleisphPredictor::setup(int)
{
  check_viscosity();
  // a time step that is chosen is checked in reset_dt()
  if (!owner_->scene().adaptive_step()) check_viscous_limit();
  if (prescribed()) evaluate_transport();
  if (owner_->fields().pressure_known()) return;
  const aleisph::Field velocity = owner_->fields().velocity();
  owner_->ranks().forward(velocity);
  const double *v = velocity.all();

  aleisph::Timers::Scope scope(owner_->timers(), Part::MOMENTUM);
  auto &cloud = owner_->cloud();
  start(a_);
  add_body(a_);
  aleisph::convection(cloud, cloud.fluid(), v, sliding_velocity(*owner_, sliding_), work_.data());
  aleisph::for_rows(cloud.fluid(), [&](int i) {
    for (int a = 0; a < 3; a++) a_[3 * i + a] -= work_[3 * i + a];
  });
  add_viscosity(1.0, a_);
  add_wall_viscosity(a_);
  add_other_terms(a_);
  start_memory();
  double *vstar = owner_->fields().predicted().edit();
  for (const auto *rows : {&cloud.fluid(), &cloud.wall()})
    aleisph::for_rows(*rows, [&](int i) {
      for (int a = 0; a < 3; a++) vstar[3 * i + a] = update->dt * a_[3 * i + a];
    });
}

void FixAleisphPredictor::start(std::vector<double> &a)
{
  const std::size_t n = 3 * static_cast<std::size_t>(atom->nlocal);
  a.assign(n, 0.0);
  work_.resize(3 * static_cast<std::size_t>(owner_->cloud().size()));
}

// Of the present positions and, as LAMMPS has it, of the end of the step: so it is not among the
// terms of the start of the step, which Adams-Bashforth extrapolates.
void FixAleisphPredictor::add_body(std::vector<double> &a)
{
  const auto &cloud = owner_->cloud();
  const double per_mass = 1.0 / particle_mass(*owner_);
  for (const auto *rows : {&cloud.fluid(), &cloud.wall()})
    aleisph::for_rows(*rows, [&](int i) {
      for (int c = 0; c < domain->dimension; c++) a[3 * i + c] += per_mass * atom->f[i][c];
    });
}

void FixAleisphPredictor::add_convection(std::vector<double> &a)
{
  if (params_.frame == Frame::LAGRANGIAN) return;
  auto &cloud = owner_->cloud();
  const double *v = owner_->fields().velocity().all();
  const double *c = v;
  if (params_.frame == Frame::ALE) {
    relative_.resize(a.size());
    const double *w = owner_->fields().property(shifted() ? SHIFT : TRANSPORT);
    for (std::size_t k = 0; k < a.size(); k++) relative_[k] = shifted() ? -w[k] : v[k] - w[k];
    c = relative_.data();
  }
  aleisph::convection(cloud, cloud.fluid(), c, sliding_velocity(*owner_, sliding_), work_.data());
  const bool carries = shifted();
  aleisph::for_rows(cloud.fluid(), [&](int i) {
    if (carries && aleisph::in_film(cloud, i)) return;
    for (int k = 3 * i; k < 3 * i + 3; k++) a[k] -= work_[k];
  });
}

void FixAleisphPredictor::add_viscosity(double share, std::vector<double> &a)
{
  if (nu_ == 0.0 || share == 0.0) return;
  auto &cloud = owner_->cloud();
  aleisph::laplacian(cloud, cloud.fluid(), owner_->fields().velocity().all(), work_.data());
  aleisph::for_rows(cloud.fluid(), [&](int i) {
    for (int k = 3 * i; k < 3 * i + 3; k++) a[k] += share * nu_ * work_[k];
  });
  owner_->tally().viscous_passes++;
}

void FixAleisphPredictor::add_other_terms(std::vector<double> &a)
{
  for (auto *term : owner_->scene().accelerations()) term->add_acceleration(a.data());
}

// Adams-Bashforth: replaces a by its second-order extrapolation to the middle of the step
void FixAleisphPredictor::extrapolate(std::vector<double> &a)
{
  if (!params_.ab2) return;
  double *old = owner_->fields().property(ACCELERATION);
  const double half_ratio = previous_dt_ > 0.0 ? 0.5 * update->dt / previous_dt_ : 0.0;
  for (std::size_t k = 0; k < a.size(); k++) {
    const double now = a[k];
    a[k] += half_ratio * (now - old[k]);
    old[k] = now;
  }
  previous_dt_ = update->dt;
}

void FixAleisphPredictor::predict_explicit()
{
  aleisph::Timers::Scope scope(owner_->timers(), Part::MOMENTUM);
  const auto &cloud = owner_->cloud();
  start(a_);
  add_convection(a_);
  add_viscosity(1.0, a_);
  add_wall_viscosity(a_);
  add_other_terms(a_);
  extrapolate(a_);
  add_body(a_);
  if (remembers()) {
    find_known_gradient();
    add_memory(a_);
  }
  const double *v = owner_->fields().velocity().all();
  double *vstar = owner_->fields().predicted().edit();
  aleisph::for_rows(cloud.fluid(), [&](int i) {
    for (int k = 3 * i; k < 3 * i + 3; k++) vstar[k] = v[k] + update->dt * a_[k];
  });
  predict_walls();
}
