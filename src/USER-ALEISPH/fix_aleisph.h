/* -*- c++ -*- ----------------------------------------------------------
   LAMMPS - Large-scale Atomic/Molecular Massively Parallel Simulator
   USER-ALEISPH package
   SPDX-License-Identifier: GPL-2.0-only

   Owner of everything that the aleisph styles share: parameters, particle
   roles, neighbor list, stencil and operators of the present positions,
   scratch fields, halo exchange. It has no equation of motion in it.
------------------------------------------------------------------------- */

#ifdef FIX_CLASS
// clang-format off
FixStyle(aleisph,FixAleisph);
// clang-format on
#else

#ifndef LMP_FIX_ALEISPH_H
#define LMP_FIX_ALEISPH_H

#include "aleisph_cloud.h"
#include "aleisph_fluid.h"
#include "aleisph_krylov.h"
#include "aleisph_mpi_halo.h"
#include "aleisph_ppe.h"
#include "aleisph_timestep.h"
#include "fix.h"

#include <memory>
#include <string>
#include <utility>
#include <vector>

namespace LAMMPS_NS {

// A condition that fixes the velocity of some owned particles from that of others
class AleisphVelocityCondition {
 public:
  // sets v (3 doubles per particle) on its owned particles; ghosts valid on return
  virtual void impose(double *v) = 0;
  // local index that owned particle i copies from, -1 if it is not one of its particles
  virtual int source(int i) const = 0;

 protected:
  ~AleisphVelocityCondition() = default;    // never deleted through this interface
};

// Walls that can find their normals
class AleisphWall {
 public:
  // Sets normal and shape of those of its owned particles whose normal is still zero, as far as
  // it is known by now on which side the fluid is; returns how many it has set. walls: rows of all
  // wall particles with all their neighbours, also dry ones.
  virtual int find_normals(const aleisph::Stencil &walls) = 0;

 protected:
  ~AleisphWall() = default;
};

// A contribution to the acceleration in the predictor
class AleisphAcceleration {
 public:
  // adds to a (3 per owned particle) on fluid rows; velocities of ghosts are valid
  virtual void add_acceleration(double *a) = 0;

 protected:
  ~AleisphAcceleration() = default;
};

// What may be done to a pressure and its gradient before they act on the velocity
class AleisphPressureGuard {
 public:
  // p: owned and ghost particles, ghosts valid before and after; grad: 3 per owned particle.
  // Called with the gradient of p already in grad; on return they belong together again.
  virtual void guard_pressure(double *p, double *grad) = 0;

 protected:
  ~AleisphPressureGuard() = default;
};

// What holds particles after the pressure has corrected their velocity
class AleisphVelocityGuard {
 public:
  // changes v (3 per particle) of owned fluid particles; of ghosts, those of walls are valid
  virtual void guard_velocity(double *v) = 0;

 protected:
  ~AleisphVelocityGuard() = default;
};

// A style that knows what limits the time step
class AleisphTimeStepLimit {
 public:
  // lowers the limits that it knows, from the present state; called on all ranks together
  virtual void time_step_limits(aleisph::StepBounds &limits) const = 0;

 protected:
  ~AleisphTimeStepLimit() = default;
};

// Surface tension. Fields of owned particles, zero away from the surface, valid from pre_force on.
class AleisphTension {
 public:
  virtual const double *surface_pressure() const = 0;    // above that outside
  virtual const double *curvature() const = 0;           // K = div_s N
  virtual const double *surface_normal() const = 0;      // N, outward; 3 per particle
  // N_c and whether it is a contact particle, 4 per particle; null without walls
  virtual const double *contact() const = 0;

 protected:
  ~AleisphTension() = default;
};

// What a free surface means to other styles
struct AleisphSurface {
  bool present = false;
  double offset = 0.5;       // of the surface from its particles, in spacings
  double pressure = 0.0;     // outside
  double floor = 0.2;        // of the eigenvalues of M in L
  double dry_reach = 1.2;    // wall particles farther from all fluid, in spacings, are dry; 0: none
};

// What other styles count and the owner reports
struct AleisphTally {
  long ppe_builds = 0, precond_builds = 0, viscous_builds = 0, viscous_passes = 0, wall_passes = 0;
  int singular_rows = 0, dirichlet_rows = 0;    // of this rank, last assembly
  int surface_rows = 0;
  int replaced_pivots = 0;    // of this rank, last preconditioner
};

// Communication of this rank since the start of the run, as far as it goes through the owner
struct AleisphTraffic {
  long reductions = 0, exchanges = 0, messages = 0;    // messages received
  double bytes = 0.0;
};

class FixAleisph : public Fix {
 public:
  FixAleisph(class LAMMPS *, int, char **);
  ~FixAleisph() override;
  int setmask() override;
  void post_constructor() override;
  void init() override;
  void init_list(int, class NeighList *) override;
  void setup_pre_force(int) override;
  void pre_force(int) override;
  void post_run() override;
  double compute_vector(int) override;
  double memory_usage() override;
  int pack_forward_comm(int, int *, double *, int, int *) override;
  void unpack_forward_comm(int, int, double *) override;
  void write_restart(FILE *) override;
  void restart(char *) override;

  // the one fix aleisph of this simulation, or an error that names the caller
  static FixAleisph *find(class LAMMPS *lmp, const std::string &caller);

  // an error unless it is the only fix of its style and has the group of the predictor
  void check_fluid_fix(const Fix *fix) const;

  // -- set by other styles in their init(), which comes after the owner's
  void add_role(aleisph::Role role, int groupbit);
  void add_velocity_condition(AleisphVelocityCondition *condition);
  void add_acceleration(AleisphAcceleration *term) { accelerations_.push_back(term); }
  void add_wall(AleisphWall *wall) { walls_.push_back(wall); }
  void set_pressure_guard(AleisphPressureGuard *guard) { pressure_guard_ = guard; }
  void set_velocity_guard(AleisphVelocityGuard *guard) { velocity_guard_ = guard; }
  void set_surface(const AleisphSurface &surface);
  void set_tension(const AleisphTension *tension) { tension_ = tension; }
  void remove_tension(const AleisphTension *tension)
  {
    if (tension_ == tension) tension_ = nullptr;
  }
  void set_viscosity(double nu) { nu_ = nu; }
  // neighbours up to this distance are asked for: ghosts must reach as far
  void require_reach(double reach);
  void add_time_step_limit(const AleisphTimeStepLimit *limit) { step_limits_.push_back(limit); }
  void set_adaptive_time_step() { adaptive_ = true; }
  void set_moving() { moving_ = true; }

  // -- parameters
  double rho0() const { return fluid_.rho0; }
  const aleisph::FluidProperties &fluid() const { return fluid_; }
  double particle_mass() const;

  // -- valid from pre_force on, until particles move or migrate
  aleisph::Cloud &cloud() { return *cloud_; }
  bool ready() const;    // there is a stencil, and it is that of the present particles
  // while normals are being found: those of the step before (3 per owned particle), zero if none
  const double *previous_normal() const { return previous_normal_.data(); }
  const AleisphTension *tension() const { return tension_; }    // null if there is none
  double viscosity() const { return nu_; }                      // kinematic, of the predictor
  const AleisphSurface &surface() const { return surface_; }
  void forward_roles();                        // of the cloud, to its ghosts
  int dry_walls() const { return ndry_; }      // of this rank
  double *vstar() { return vstar_.data(); }    // 3 per particle, owned and ghost
  double *pressure();                          // d_aleisph_p, owned and ghost
  double *velocity();                          // atom->v as one array
  double *previous_wall_velocity();    // d2_aleisph_vw: v of owned walls at the last step's end
  // what the last PPE made of each owned particle; empty before the first assembly
  std::vector<aleisph::RowType> &row_types() { return row_types_; }
  bool moving() const { return moving_; }

  // -- pressure has been solved for, or came from a restart file
  bool pressure_valid() const { return pressure_valid_; }
  void set_pressure_valid() { pressure_valid_ = true; }

  // -- halo exchange of ncomp (1 or 3) doubles per particle
  void forward(double *field, int ncomp);
  // the same of one double for linear solves, which work in between: see HaloExchange
  void start_halo(double *field);
  void finish_halo(double *field);
  const aleisph::HaloExchange &halo() const { return *halo_; }    // of the present local indices
  // received otherwise: for the report after a run
  void count_messages(int messages, double bytes);
  const aleisph::RowSplit &row_split();    // rows of the stencil; boundary: with remote columns
  // impose the velocity conditions on v, then make its ghosts valid
  void complete_velocity(double *v);
  const std::vector<AleisphVelocityCondition *> &velocity_conditions() const { return conditions_; }
  const std::vector<AleisphAcceleration *> &accelerations() const { return accelerations_; }
  AleisphPressureGuard *pressure_guard() const { return pressure_guard_; }
  AleisphVelocityGuard *velocity_guard() const { return velocity_guard_; }
  // of all styles that know one; valid from setup() on
  aleisph::StepBounds time_step_limits() const;
  bool adaptive_time_step() const { return adaptive_; }    // the time step is chosen by a fix

  // -- for errors that name an atom: the largest of all ranks' IDs, 0 if nobody has one
  tagint largest(tagint tag) const;
  // an error in the caller's name if v (3 per particle) is not finite on an owned particle
  void require_finite(const double *v, const std::string &caller, const std::string &what) const;
  long sum(long value) const;                       // over all ranks
  bool any(bool mine) const;                        // on any rank
  double *custom(const std::string &name) const;    // d2_NAME as one array, null if there is none

  const aleisph::InnerProduct &inner_product() const { return *inner_product_; }
  aleisph::Timers &timers() { return timers_; }
  AleisphTally &tally() { return tally_; }

 private:
  struct Params {
    aleisph::KernelType kernel;
    double h_over_d;
  };

  void parse(int narg, char **arg);
  void read_fluid_file(const char *filename);
  void check_integrator() const;
  void check_companions() const;
  void check_fix_order() const;
  void check_masses() const;
  void check_atoms();
  void assign_roles();
  void wrong_roles(tagint *atoms) const;
  void refuse_roles(const tagint *atoms) const;
  bool positions_changed();
  aleisph::CandidateList candidates() const;
  void rebuild();
  void build_halo();
  void reduce_max(int n, tagint *values) const;
  void restore_walls();
  void locate_walls(bool changed);
  bool walls_changed();
  void find_normals();
  void mark_dry_walls();
  bool dry_rule() const { return surface_.present && surface_.dry_reach > 0.0; }
  void report_timing();
  std::string report_traffic() const;

  Params params_;
  double spacing_;
  aleisph::FluidProperties fluid_;

  class NeighList *list_;
  std::vector<std::pair<aleisph::Role, int>> role_groups_;
  std::vector<AleisphVelocityCondition *> conditions_;
  std::vector<AleisphAcceleration *> accelerations_;
  std::vector<AleisphWall *> walls_;
  std::vector<const AleisphTimeStepLimit *> step_limits_;
  AleisphPressureGuard *pressure_guard_;
  AleisphVelocityGuard *velocity_guard_;
  const AleisphTension *tension_;
  AleisphSurface surface_;
  double nu_, reach_;
  bool moving_, adaptive_, pressure_valid_, walls_located_;
  int ndry_;
  double own_cutoff_;    // ghost cutoff that this fix has set, 0 if none

  aleisph::Timers timers_;
  std::unique_ptr<aleisph::Cloud> cloud_;
  std::unique_ptr<aleisph::InnerProduct> inner_product_;
  std::vector<double> previous_normal_, vstar_, x_built_;
  std::vector<aleisph::RowType> row_types_;
  AleisphTally tally_;

  std::unique_ptr<aleisph::HaloExchange> halo_;
  aleisph::RowSplit split_;
  long split_version_;
  double *halo_field_;
  int halo_ncomp_;
  const double *packed_;    // where the last message was packed
  mutable AleisphTraffic traffic_;
};

}    // namespace LAMMPS_NS

#endif
#endif
