// SPDX-License-Identifier: GPL-2.0-only
/* ----------------------------------------------------------------------
   What the fixes of a script contribute to a step, each through a small
   interface. Fixes sign up at the start of a run. Without free surface, walls,
   tension or guards their entries are empty, and cost nothing.

   A time step, in the order in which it happens:
     positions   predictor      x += dt (v + u); u: velocity of shifting
     cloud       owner          roles, NormalFinder, dry walls, stencil
                 surface        which particles are on the FreeSurface, their normals
                 pressure       prescribed values
     forces      tension        SurfaceTension: pressure and force of the surface;
                                LAMMPS' own fixes: gravity, addforce, ...
     v*          predictor      force, viscosity, convection, every Acceleration, memory; of walls
                 owner          every VelocityCondition
     pressure    ppe            lap p = rho0/dt div v* and what the last step has left
     v           ppe            grad p, PressureGuard, v* - dt/rho0 grad p, VelocityGuard,
                                every VelocityCondition; memory, what is left
     u           shift, guard   for the positions of the next step
     dt          dt             from every TimeStepLimit
------------------------------------------------------------------------- */

#ifndef LMP_ALEISPH_SCENE_H
#define LMP_ALEISPH_SCENE_H

#include "aleisph_fields.h"
#include "aleisph_roles.h"
#include "aleisph_stencil.h"
#include "aleisph_timestep.h"

#include <algorithm>
#include <string>
#include <vector>

namespace aleisph {

// Objects behind these interfaces are fixes: they are never deleted through them.

// A condition that fixes the velocity of some owned particles from that of others
class VelocityCondition {
 public:
  // sets a velocity on its owned particles; ghosts valid on return
  virtual void impose(const Field &v) = 0;
  // local index that owned particle i copies from, -1 if it is not one of its particles
  virtual int source(int i) const = 0;

 protected:
  ~VelocityCondition() = default;
};

// Walls that can find their normals
class NormalFinder {
 public:
  // Sets normal and shape of those of its owned particles whose normal is still zero, as far as
  // it is known by now on which side the fluid is; returns how many it has set. walls: rows of all
  // wall particles with all their neighbours, also dry ones. previous: normals of the step before,
  // 3 per owned particle, zero if there was none.
  virtual int find_normals(const Stencil &walls, const double *previous) = 0;

 protected:
  ~NormalFinder() = default;
};

// A contribution to the acceleration in the predictor
class Acceleration {
 public:
  // adds to a (3 per owned particle) on fluid rows; velocities of ghosts are valid
  virtual void add_acceleration(double *a) = 0;

 protected:
  ~Acceleration() = default;
};

// What may be done to a pressure and its gradient before they act on the velocity
class PressureGuard {
 public:
  // p: ghosts valid before and after; grad: 3 per owned particle. Called with the gradient of p
  // already in grad; on return they belong together again.
  virtual void guard_pressure(const Field &p, double *grad) = 0;

 protected:
  ~PressureGuard() = default;
};

// What holds particles after the pressure has corrected their velocity
class VelocityGuard {
 public:
  // changes v (3 per particle) of owned fluid particles; of ghosts, those of walls are valid
  virtual void guard_velocity(double *v) = 0;

 protected:
  ~VelocityGuard() = default;
};

// A style that knows what limits the time step
class TimeStepLimit {
 public:
  // lowers the limits that it knows, from the present state; called on all ranks together
  virtual void time_step_limits(StepBounds &limits) const = 0;

 protected:
  ~TimeStepLimit() = default;
};

// What acts on the free surface beyond the pressure outside: of owned particles, zero away from the
// surface, valid from pre_force on. Null if nothing does.
class SurfaceLoad {
 public:
  virtual const double *surface_pressure() const = 0;

 protected:
  ~SurfaceLoad() = default;
};

// Fields of owned particles, zero away from the surface, valid from pre_force on
class SurfaceTension : public SurfaceLoad {
 public:
  virtual bool ready() const = 0;                 // they are, and those of the present positions
  virtual const double *curvature() const = 0;    // K = div_s N
  virtual const double *surface_normal() const = 0;    // N, outward; 3 per particle, ghosts, too
  // N_c and whether it is a contact particle, 4 per particle; null without walls
  virtual const double *contact() const = 0;
  virtual double sigma() const = 0;
  // of the contact angle of wall particles; null without walls
  virtual const double *contact_cosine() const = 0;

 protected:
  ~SurfaceTension() = default;
};

// What a free surface means to other styles
struct FreeSurface {
  bool present = false;
  double offset = 0.5;       // of the surface from its particles, in spacings
  bool follows = false;      // it does not stay there: see aleisph_surface_layer.h
  double pressure = 0.0;     // outside
  double floor = 0.2;        // of the eigenvalues of M in L
  double dry_reach = 1.2;    // wall particles farther from all fluid, in spacings, are dry; 0: none
};

struct RoleGroup {
  Role role;
  int groupbit;    // of LAMMPS: particles whose mask has it
};

// What a fix prescribes for the particles of a group. Two different values of the same thing on one
// particle contradict each other.
struct Claim {
  std::string fix;      // who says so, as messages name it
  std::string what;     // "condition", "velocity", ...
  std::string value;    // as the script gives it
  int groupbit;
  Role role = 0;    // of the group only particles that have this role; 0: all
};

// One run's: at the start of the next one it is emptied, and the fixes sign up again.
class Scene {
 public:
  void clear() { *this = Scene(); }

  void add_role(Role role, int groupbit) { roles_.push_back({role, groupbit}); }
  void add_claim(const Claim &claim) { claims_.push_back(claim); }
  void add_condition(VelocityCondition *condition) { conditions_.push_back(condition); }
  void add_walls(NormalFinder *walls) { walls_.push_back(walls); }
  void add_acceleration(Acceleration *term) { accelerations_.push_back(term); }
  void add_limit(const TimeStepLimit *limit) { limits_.push_back(limit); }
  void set_pressure_guard(PressureGuard *guard) { pressure_guard_ = guard; }
  void set_velocity_guard(VelocityGuard *guard) { velocity_guard_ = guard; }
  // with surface tension its pressure, which has the viscous stress in it, too
  void set_load(const SurfaceLoad *load) { load_ = load; }
  void set_tension(const SurfaceTension *tension) { tension_ = tension; }
  void set_surface(const FreeSurface &surface) { surface_ = surface; }
  void set_viscosity(double nu) { viscosity_ = nu; }
  void set_moving() { moving_ = true; }
  void set_memory() { memory_ = true; }
  void set_adaptive_step() { adaptive_step_ = true; }
  void remove_tension(const SurfaceTension *tension)
  {
    if (tension_ == tension) tension_ = nullptr;
  }

  const std::vector<RoleGroup> &roles() const { return roles_; }
  bool has(Role role) const
  {
    return std::any_of(roles_.begin(), roles_.end(),
                       [role](const RoleGroup &group) { return group.role & role; });
  }
  const std::vector<Claim> &claims() const { return claims_; }
  const std::vector<VelocityCondition *> &conditions() const { return conditions_; }
  const std::vector<NormalFinder *> &walls() const { return walls_; }
  const std::vector<Acceleration *> &accelerations() const { return accelerations_; }
  PressureGuard *pressure_guard() const { return pressure_guard_; }    // null if there is none
  VelocityGuard *velocity_guard() const { return velocity_guard_; }    // null if there is none
  const SurfaceTension *tension() const { return tension_; }           // null if there is none
  const SurfaceLoad *load() const { return tension_ ? tension_ : load_; }
  const FreeSurface &surface() const { return surface_; }
  double viscosity() const { return viscosity_; }    // kinematic, of the predictor
  bool memory() const { return memory_; }    // the fluid remembers what acted in the last step
  bool moving() const { return moving_; }    // particles move with the flow
  bool adaptive_step() const { return adaptive_step_; }    // the time step is chosen by a fix
  bool dry_rule() const { return surface_.present && surface_.dry_reach > 0.0 && !walls_.empty(); }

  // of all styles that know one; valid from setup() on
  StepBounds step_limits() const
  {
    StepBounds bounds;
    for (const auto *style : limits_) style->time_step_limits(bounds);
    return bounds;
  }

 private:
  std::vector<RoleGroup> roles_;
  std::vector<Claim> claims_;
  std::vector<VelocityCondition *> conditions_;
  std::vector<NormalFinder *> walls_;
  std::vector<Acceleration *> accelerations_;
  std::vector<const TimeStepLimit *> limits_;
  PressureGuard *pressure_guard_ = nullptr;
  VelocityGuard *velocity_guard_ = nullptr;
  const SurfaceTension *tension_ = nullptr;
  const SurfaceLoad *load_ = nullptr;
  FreeSurface surface_;
  double viscosity_ = 0.0;
  bool moving_ = false, memory_ = false, adaptive_step_ = false;
};

}    // namespace aleisph
#endif
