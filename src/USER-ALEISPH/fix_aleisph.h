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

#include "aleisph_discretization.h"
#include "aleisph_fluid.h"
#include "aleisph_krylov.h"
#include "aleisph_ppe.h"
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

// What other styles count and the owner reports
struct AleisphTally {
  long ppe_builds = 0, precond_builds = 0, viscous_builds = 0, viscous_passes = 0, wall_passes = 0;
  int singular_rows = 0, dirichlet_rows = 0;    // of this rank, last assembly
  int replaced_pivots = 0;                      // of this rank, last preconditioner
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

  // -- set by other styles in their init(), which comes after the owner's
  void add_role(aleisph::Role role, int groupbit);
  void add_velocity_condition(AleisphVelocityCondition *condition);
  void set_moving() { moving_ = true; }

  // -- parameters
  double spacing() const { return spacing_; }
  double rho0() const { return fluid_.rho0; }
  const aleisph::FluidProperties &fluid() const { return fluid_; }
  double particle_mass() const;

  // -- valid from pre_force on, until particles move or migrate
  aleisph::Discretization &discretization() { return *discretization_; }
  bigint version() const { return version_; }    // changes with the positions
  bool ready() const;    // there is a stencil, and it is that of the present particles
  const aleisph::Role *role() const { return role_.data(); }    // owned and ghost
  double *normal() { return normal_.data(); }                   // 3 per particle, owned and ghost
  double *vstar() { return vstar_.data(); }                     // 3 per particle, owned and ghost
  double *pressure();                                           // d_aleisph_p, owned and ghost
  double *velocity();                                           // atom->v as one array
  double *previous_wall_velocity();    // d2_aleisph_vw: v of owned walls at the last step's end
  // what the last PPE made of each owned particle; empty before the first assembly
  std::vector<aleisph::RowType> &row_types() { return row_types_; }
  bool moving() const { return moving_; }
  int nall() const;

  // -- pressure has been solved for, or came from a restart file
  bool pressure_valid() const { return pressure_valid_; }
  void set_pressure_valid() { pressure_valid_ = true; }

  // -- halo exchange of ncomp (1 or 3) doubles per particle
  void forward(double *field, int ncomp);
  // impose the velocity conditions on v, then make its ghosts valid
  void complete_velocity(double *v);
  const std::vector<AleisphVelocityCondition *> &velocity_conditions() const { return conditions_; }

  // -- for errors that name an atom: the largest of all ranks' IDs, 0 if nobody has one
  tagint largest(tagint tag) const;
  // an error in the caller's name if v (3 per particle) is not finite on an owned particle
  void require_finite(const double *v, const std::string &caller, const std::string &what) const;

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
  void set_cutoff();
  void check_atoms();
  void assign_roles();
  bool positions_changed();
  void rebuild();
  long sum(long value) const;
  void report_timing();

  Params params_;
  double spacing_;
  aleisph::FluidProperties fluid_;

  class NeighList *list_;
  std::vector<std::pair<aleisph::Role, int>> role_groups_;
  std::vector<AleisphVelocityCondition *> conditions_;
  bool moving_, pressure_valid_;
  double own_cutoff_;    // ghost cutoff that this fix has set, 0 if none
  bigint version_;

  aleisph::Timers timers_;
  std::unique_ptr<aleisph::Discretization> discretization_;
  std::unique_ptr<aleisph::InnerProduct> inner_product_;
  std::vector<aleisph::Role> role_;
  std::vector<double> normal_, vstar_, x_built_;
  std::vector<aleisph::RowType> row_types_;
  AleisphTally tally_;

  double *halo_field_;
  int halo_ncomp_;
};

}    // namespace LAMMPS_NS

#endif
#endif
