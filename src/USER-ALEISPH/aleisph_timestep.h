// SPDX-License-Identifier: GPL-2.0-only
/* ----------------------------------------------------------------------
   The limits of the time step, and the choice of the next one.

   A limit is the time step at which a process becomes unstable or badly
   resolved; a share of it is taken (default in brackets):
     cfl         d/|v|                              (0.2)
     force       sqrt(d/|a|), a the body force      (0.25)
     viscous     2 d^2/(mu nu), explicit viscosity  (0.7)  mu: spectral radius of the Laplacian on
                 the lattice; half of it for Adams-Bashforth 2. Walls half a spacing away and
                 jittered particles lower the limit by up to a quarter.
     convection  2 nu/|v|^2, forward Euler with central differences  (1)
     capillary   sqrt(rho d^3/(2 pi sigma))         (0.5)
                 Brackbill, Kothe & Zemach, J. Comput. Phys. 100 (1992) 335: the limit is 2^(-1/2)
                 of this if the other fluid has no density
   A process that does not act has an infinite limit.
------------------------------------------------------------------------- */

#ifndef LMP_ALEISPH_TIMESTEP_H
#define LMP_ALEISPH_TIMESTEP_H

#include "aleisph_kernel.h"

#include <array>
#include <limits>

namespace aleisph {

// NONE: nothing bounds it. The limits above, then what the user asks for.
enum class StepBound { NONE, CFL, FORCE, VISCOUS, CONVECTION, CAPILLARY, MAX, GROW };
constexpr int NUM_STEP_BOUNDS = 8;
constexpr StepBound FIRST_STEP_LIMIT = StepBound::CFL, LAST_STEP_LIMIT = StepBound::CAPILLARY;

// the keyword of a bound
const char *to_string(StepBound bound);

using StepShares = std::array<double, NUM_STEP_BOUNDS>;
constexpr StepShares DEFAULT_STEP_SHARES = {1.0, 0.2, 0.25, 0.7, 1.0, 0.5, 1.0, 1.0};

// One time step per bound, infinity where it does not act
class StepBounds {
 public:
  StepBounds() { dt_.fill(std::numeric_limits<double>::infinity()); }
  double operator[](StepBound bound) const { return dt_[static_cast<int>(bound)]; }
  void lower(StepBound bound, double dt);
  StepBounds scaled(const StepShares &share) const;
  StepBound tightest() const;    // NONE if all are infinite
  double smallest() const { return (*this)[tightest()]; }

 private:
  std::array<double, NUM_STEP_BOUNDS> dt_;
};

double cfl_limit(double d, double speed);
double force_limit(double d, double acceleration);
double viscous_limit(const Kernel &kernel, double d, double nu, bool adams_bashforth);
double convection_limit(double nu, double speed);
double capillary_limit(double rho, double d, double sigma);

/* ----------------------------------------------------------------------
   Chooses the time step: the smallest of the shares of the limits, of max,
   and of grow times the step in force. With align = T steps end on multiples
   of T: the time left to the next multiple is divided evenly. The last step
   before a multiple is then not smaller than half of the chosen step, unless
   the first choice is made just before a multiple.
------------------------------------------------------------------------- */
class StepControl {
 public:
  struct Params {
    StepShares share = DEFAULT_STEP_SHARES;
    double min = 0.0, max = std::numeric_limits<double>::infinity();
    double grow = 1.1;
    double align = 0.0;    // T; 0: off
  };

  // All that the next choice depends on, and what is reported. Doubles only: it is written to
  // files as it stands.
  struct State {
    double dt = 0.0;           // in force; 0 before start()
    double unbounded = 0.0;    // the step to take where nothing bounds it
    double ceiling = 0.0;      // the next choice is not above it, except for min
    double acting = 0.0;       // StepBound that made the last choice
    double changes = 0.0;      // of dt
    StepBounds bounds;         // at the last choice
    std::array<double, NUM_STEP_BOUNDS> acted = {};    // choices that each bound made
  };

  Params params;
  State state;

  // dt is in force: the next choice is not above it, and dt itself if nothing bounds it
  void start(double dt);
  // shares of the limits, and max
  StepBounds bounds(const StepBounds &limits) const;
  // Makes a choice at `time`; false if it is below min or zero. It is in state.dt.
  bool choose(const StepBounds &limits, double time);

  StepBound acting() const { return static_cast<StepBound>(static_cast<int>(state.acting)); }
  // time is a multiple of T, up to rounding; if so, exactly that multiple
  bool at_multiple(double &time) const;

 private:
  double aligned(double dt, double time) const;
};

}    // namespace aleisph
#endif
