// SPDX-License-Identifier: GPL-2.0-only

#include "aleisph_timestep.h"

#include "aleisph_lattice.h"

#include <algorithm>
#include <cmath>

namespace aleisph {

namespace {

constexpr double PI = 3.14159265358979323846;
constexpr double INF = std::numeric_limits<double>::infinity();
// Rounding of sums of time steps, relative to the step. LAMMPS takes the same to tell whether a
// dump at a given time is due.
constexpr double SAME_TIME = 1.0e-6;
// The same where steps to the next multiple are counted: 10.000000001 are 10
constexpr double SAME_COUNT = 1.0e-9;

}    // namespace

const char *to_string(StepBound bound)
{
  static const char *const names[NUM_STEP_BOUNDS] = {"none",       "cfl",       "force", "viscous",
                                                     "convection", "capillary", "max",   "grow"};
  return names[static_cast<int>(bound)];
}

void StepBounds::lower(StepBound bound, double dt)
{
  double &now = dt_[static_cast<int>(bound)];
  now = std::min(now, dt);
}

StepBounds StepBounds::scaled(const StepShares &share) const
{
  StepBounds result = *this;
  for (int k = 0; k < NUM_STEP_BOUNDS; k++) result.dt_[k] *= share[k];
  return result;
}

StepBound StepBounds::tightest() const
{
  return static_cast<StepBound>(std::min_element(dt_.begin(), dt_.end()) - dt_.begin());
}

/* ---------------------------------------------------------------------- */

double cfl_limit(double d, double speed)
{
  return speed > 0.0 ? d / speed : INF;
}

double force_limit(double d, double acceleration)
{
  return acceleration > 0.0 ? std::sqrt(d / acceleration) : INF;
}

double viscous_limit(const Kernel &kernel, double d, double nu, bool adams_bashforth)
{
  if (nu == 0.0) return INF;
  return (adams_bashforth ? 1.0 : 2.0) / lattice_spectral_radius(kernel, d) * d * d / nu;
}

double convection_limit(double nu, double speed)
{
  return speed > 0.0 ? 2.0 * nu / (speed * speed) : INF;
}

double capillary_limit(double rho, double d, double sigma)
{
  return sigma > 0.0 ? std::sqrt(rho * d * d * d / (2.0 * PI * sigma)) : INF;
}

/* ---------------------------------------------------------------------- */

void StepControl::start(double dt)
{
  state.dt = state.unbounded = state.ceiling = dt;
}

StepBounds StepControl::bounds(const StepBounds &limits) const
{
  StepBounds all = limits.scaled(params.share);
  all.lower(StepBound::MAX, params.max);
  return all;
}

bool StepControl::choose(const StepBounds &limits, double time)
{
  StepBounds &all = state.bounds = bounds(limits);
  StepBound acting = all.tightest();
  double dt = std::max(std::min(state.unbounded, state.ceiling), params.min);
  if (acting != StepBound::NONE) {
    // growth does not hold the step below min
    all.lower(StepBound::GROW, std::max(state.ceiling, params.min));
    acting = all.tightest();
    state.unbounded = dt = all[acting];
  }
  state.acting = static_cast<int>(acting);
  if (!(dt > 0.0) || dt < params.min) return false;

  state.acted[static_cast<int>(acting)]++;
  const double step = aligned(dt, time);
  if (step != state.dt) state.changes++;
  state.dt = step;
  // a first step that a near multiple makes short does not limit the growth of the next ones
  state.ceiling = params.grow * std::max(step, 0.5 * dt);
  return true;
}

bool StepControl::at_multiple(double &time) const
{
  if (params.align == 0.0) return false;
  const double multiple = params.align * std::round(time / params.align);
  if (std::fabs(time - multiple) > SAME_TIME * state.dt) return false;
  time = multiple;
  return true;
}

double StepControl::aligned(double dt, double time) const
{
  if (params.align == 0.0) return dt;
  const double next = params.align * (std::floor(time / params.align + SAME_COUNT) + 1.0);
  const double left = next - time;
  const double steps = std::max(1.0, std::ceil(left / dt - SAME_COUNT));
  // rounding alone does not change the step, and what other styles keep for it
  const bool same = std::fabs(left - steps * state.dt) <= SAME_COUNT * state.dt;
  return same ? state.dt : left / steps;
}

}    // namespace aleisph
