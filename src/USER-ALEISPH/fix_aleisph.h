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

#include "fix.h"

#include <memory>
#include <string>
#include <vector>

namespace aleisph {
class Cloud;
class Field;
class Ranks;
class Scene;
class Timers;
struct CandidateList;
struct FluidProperties;
}    // namespace aleisph

namespace LAMMPS_NS {

class AleisphChecks;
class AleisphFields;
class AleisphWarnings;

// What other styles count and the owner reports
struct AleisphTally {
  long ppe_builds = 0, precond_builds = 0, viscous_builds = 0, viscous_passes = 0, wall_passes = 0;
  int singular_rows = 0, dirichlet_rows = 0;    // of this rank, last assembly
  int surface_rows = 0, limited_rows = 0;
  int dry_walls = 0;          // of this rank
  int replaced_pivots = 0;    // of this rank, last preconditioner
};

// The report after a run: whether there is one, and what is not printed yet
struct AleisphReport {
  bool wanted = true;    // fix_modify report
  bool post = true;      // keyword of the last command run
  std::string text;
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
  void pre_exchange() override;
  void pre_force(int) override;
  void post_run() override;
  int modify_param(int, char **) override;
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

  // what the styles of this run contribute: they sign up in their init(), which comes after the
  // owner's
  aleisph::Scene &scene() { return *scene_; }
  // a full neighbor list of this cutoff, for the run that begins: ghosts must reach as far
  void request_list(Fix *fix, double reach);

  // -- parameters
  const aleisph::FluidProperties &fluid() const { return *fluid_; }

  // -- valid from pre_force on, until particles move or migrate
  aleisph::Cloud &cloud() { return *cloud_; }
  bool ready() const;    // there is a stencil, and it is that of the present particles
  // impose the velocity conditions on v, then make its ghosts valid
  void complete_velocity(const aleisph::Field &v);

  AleisphFields &fields() { return *fields_; }
  aleisph::Ranks &ranks() { return *ranks_; }
  aleisph::Timers &timers() { return *timers_; }
  AleisphTally &tally() { return tally_; }
  AleisphWarnings &warnings() { return *warnings_; }

 private:
  void initial_integrate(int) override;
  void parse(int narg, char **arg);
  void check_scales(double spacing) const;
  void read_fluid_file(const char *filename);
  void release_cutoff();
  void set_masses();
  void set_skin();
  void set_sorting();
  void assign_roles();
  bool positions_changed();
  aleisph::CandidateList candidates() const;
  void begin_frame();
  void require_reach(double reach);
  void rebuild();
  void check_distances();
  void build_halo();
  void restore_walls();
  void locate_walls(bool changed);
  bool walls_changed();
  bool in_sight(const std::vector<int> &unknown) const;
  void find_normals();
  void mark_dry_walls();
  void begin_report();
  void print_report();
  std::string time_report() const;
  std::string build_report() const;
  std::string traffic_report() const;
  std::string guard_report() const;

  class NeighList *list_;
  double reach_;
  bool walls_located_;
  double own_cutoff_;           // ghost cutoff that this fix has set, maybe before a restart, or 0
  double close_pairs_ = 0.0;    // of all ranks, see Cloud::CLOSE

  std::unique_ptr<aleisph::FluidProperties> fluid_;
  std::unique_ptr<aleisph::Timers> timers_;
  std::unique_ptr<aleisph::Scene> scene_;
  std::unique_ptr<aleisph::Cloud> cloud_;
  std::unique_ptr<aleisph::Ranks> ranks_;
  std::unique_ptr<AleisphFields> fields_;
  std::unique_ptr<AleisphChecks> checks_;
  std::unique_ptr<AleisphWarnings> warnings_;
  std::vector<double> x_built_;
  AleisphTally tally_;
  AleisphReport report_;

  double *halo_plan_;    // two doubles per particle, while the halo exchange is planned
};

}    // namespace LAMMPS_NS

#endif
#endif
