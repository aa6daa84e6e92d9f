/* ----------------------------------------------------------------------
   LAMMPS - Large-scale Atomic/Molecular Massively Parallel Simulator
   USER-ALEISPH package
   SPDX-License-Identifier: GPL-2.0-only

   The velocity scale U of fix aleisph/shift: from strain and pressure
   gradient, the largest velocity, that after a fall, or a given one
------------------------------------------------------------------------- */

#include "fix_aleisph_shift.h"

#include "aleisph_halo_owner.h"
#include "aleisph_halo_variable.h"
#include "aleisph_shift.h"
#include "aleisph_shift_rate.h"
#include "atom.h"
#include "error.h"
#include "update.h"

#include <algorithm>
#include <cmath>
#include <limits>

using namespace LAMMPS_NS;

namespace {

// Steps from one U of strain to the next: particles lose their order over tens of spacings
constexpr bigint INTERVAL = 8;
constexpr double MAX_VELOCITY = 1.0e4;    // spacings in a time step; beyond, a slip of the pen

double dot(const double *a, const double *b)
{
  return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}

}    // namespace

bool FixAleisphShift::strain() const
{
  return !velocity_ && of_ == "strain";
}

// C from the flow is cut to what shifts stably; a given scale counts as it is.
double FixAleisphShift::bounded(double coefficient)
{
  if (!strain()) return coefficient;
  const auto &cloud = owner_->cloud();
  if (largest_ == 0.0) largest_ = aleisph::largest_coefficient(cloud.kernel(), cloud.spacing());
  return std::min(coefficient, largest_);
}

double FixAleisphShift::flow_scale()
{
  auto &cloud = owner_->cloud();
  auto &ranks = owner_->ranks();
  ranks.forward(owner_->fields().velocity());
  ranks.forward(owner_->fields().pressure());
  grad_v_.resize(9 * cloud.size());
  grad_p_.resize(3 * static_cast<std::size_t>(atom->nlocal));
  aleisph::velocity_gradient(cloud, cloud.fluid(), sliding_velocity(*owner_, sliding_),
                             grad_v_.data());
  aleisph::gradient(cloud, cloud.fluid(), owner_->fields().pressure().all(), grad_p_.data());
  aleisph::FlowSums sums = aleisph::flow_sums(cloud, grad_v_.data(), grad_p_.data());
  double values[3] = {sums.strain, sums.gradient, sums.count};
  ranks.sum(3, values);
  sums = {values[0], values[1], values[2]};
  return aleisph::flow_scale(sums, cloud.spacing(), owner_->fluid().rho0);
}

double FixAleisphShift::largest_speed() const
{
  return std::sqrt(owner_->ranks().max(largest_head(nullptr)));
}

// The velocity that the fluid has, or would have after it has fallen to its lowest point: for
// gravity g, the largest sqrt(v^2 + 2 g h). The lowest particle is one spacing above the floor, as
// particles on a lattice are.
double FixAleisphShift::head() const
{
  const auto &ranks = owner_->ranks();
  const auto &fluid = owner_->cloud().fluid();
  const auto force = mean_force();
  if (ranks.sum(static_cast<long>(fluid.size())) == 0) return 0.0;
  const double *g = force.data();

  const double lowest = ranks.max(aleisph::max_rows(
      fluid, [&](int i) { return dot(g, atom->x[i]); }, -std::numeric_limits<double>::max()));
  const double floor = lowest + std::sqrt(dot(g, g)) * owner_->cloud().spacing();
  return std::sqrt(std::max(0.0, ranks.max(largest_head(g)) + 2.0 * floor));
}

// of this rank: max (v^2 - 2 g.x); g: null for none
double FixAleisphShift::largest_head(const double *g) const
{
  const double *v = owner_->fields().velocity().owned();
  const auto head = [&](int i) {
    return dot(v + 3 * i, v + 3 * i) - (g ? 2.0 * dot(g, atom->x[i]) : 0.0);
  };
  return aleisph::max_rows(owner_->cloud().fluid(), head,
                           g ? -std::numeric_limits<double>::max() : 0.0);
}

// U
double FixAleisphShift::velocity_scale()
{
  if (!velocity_) {
    if (strain()) return started_ && update->ntimestep % INTERVAL ? scale_ : flow_scale();
    const bool falls = of_.empty() ? owner_->scene().surface().present : of_ == "head";
    return falls ? head() : largest_speed();
  }
  const AleisphVariable::Evaluation evaluation(lmp, !velocity_->constant());
  const double value = velocity_->equal();
  if (!(value >= 0.0) || !std::isfinite(value))
    error->all(FLERR, "Fix aleisph/shift: variable {} must not be negative, it is {} at step {}",
               velocity_->name(), value, update->ntimestep);
  const double most = MAX_VELOCITY / dt_over_d();
  if (value > most)
    error->all(FLERR,
               "Fix aleisph/shift: velocity {} is above {:.4g} at step {}, {} spacings in a time "
               "step; look at the units",
               value, most, update->ntimestep, MAX_VELOCITY);
  return value;
}

// of gravity and other forces on the fluid, per mass
std::array<double, 3> FixAleisphShift::mean_force() const
{
  const auto &fluid = owner_->cloud().fluid();
  double mean[4] = {0.0, 0.0, 0.0, static_cast<double>(fluid.size())};
  for (int a = 0; a < 3; a++)
    mean[a] = aleisph::sum_rows(fluid, [this, a](int i) { return atom->f[i][a]; });
  owner_->ranks().sum(4, mean);
  std::array<double, 3> g{};
  for (int a = 0; a < 3 && mean[3] > 0.0; a++) g[a] = mean[a] / (mean[3] * particle_mass(*owner_));
  return g;
}

// Of the shift on the surface, see aleisph_shift_rate.h; phi is that of a uniform force. Without a
// force there are no waves to feed, and a rotating patch loses more energy with this than without.
void FixAleisphShift::remove_work()
{
  const auto &cloud = owner_->cloud();
  const auto &ranks = owner_->ranks();
  const aleisph::Rows rows = aleisph::surface_that_works(cloud);
  const auto g = mean_force();
  if (dot(g.data(), g.data()) == 0.0) return;
  const double *v = owner_->fields().velocity().owned();
  energy_.assign(atom->nlocal, 0.0);
  aleisph::for_rows(rows, [&](int i) {
    energy_[i] = 0.5 * dot(v + 3 * i, v + 3 * i) - dot(g.data(), atom->x[i]);
  });
  double mean[2] = {aleisph::sum_rows(rows, [this](int i) { return energy_[i]; }),
                    static_cast<double>(rows.size())};
  ranks.sum(2, mean);
  if (mean[1] == 0.0) return;
  mean[0] /= mean[1];
  const auto mine = aleisph::surface_work(cloud, rows, energy_.data(), mean[0], dr_.data());
  double total[2] = {mine.work, mine.square};
  ranks.sum(2, total);
  aleisph::remove_surface_work(cloud, rows, energy_.data(), mean[0], {total[0], total[1]},
                               dr_.data());
}
