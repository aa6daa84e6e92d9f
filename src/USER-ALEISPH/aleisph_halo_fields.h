/* ----------------------------------------------------------------------
   LAMMPS - Large-scale Atomic/Molecular Massively Parallel Simulator
   USER-ALEISPH package
   SPDX-License-Identifier: GPL-2.0-only

   The fields that the styles share. Those that must follow a particle to other
   ranks, places and restart files are custom properties of LAMMPS (fix
   property/atom), where dump, set and read_data find them, too:

     pressure       d_aleisph_p    [pressure]    ghosts
     velocity       atom->v        [velocity]    ghosts
     wall velocity  d2_aleisph_vw  [velocity]    of owned walls at the end of the last step
     wall normals   d2_aleisph_n   3 components and shape of owned walls, while no wall moves
     memory         d2_aleisph_gp  [pressure/length] on owned fluid that moves: pressure gradient less
                                   body force, as they acted in the last step; on walls lap v of
                                   their viscous force. 4th component: NEW, SOLVED or MET
     given back     d_aleisph_gb   [pressure/length^2] of owned particles: aleisph_solve_leftover.h
     surface layer  d2_aleisph_s   2 of owned fluid: aleisph_surface_layer.h; by fix aleisph/surface
   and, of the present positions only:
     predicted      v*             [velocity]    ghosts
     row types      what the last pressure equation made of each owned particle
   and one that the fixes of a script write, so that the predictor keeps it:
     shift          d2_aleisph_u   [velocity]    of owned fluid relative to the flow
   Ghosts are stale at the start of each step, for LAMMPS and its other fixes may have changed any
   of these.
------------------------------------------------------------------------- */

#ifndef LMP_ALEISPH_HALO_FIELDS_H
#define LMP_ALEISPH_HALO_FIELDS_H

#include "aleisph_fields.h"
#include "aleisph_solve_ppe.h"
#include "pointers.h"

#include <cstdint>
#include <map>
#include <set>
#include <string>
#include <vector>

namespace aleisph {
class Ranks;
}

namespace LAMMPS_NS {

class AleisphFields : protected Pointers {
 public:
  AleisphFields(LAMMPS *lmp, const aleisph::Ranks &ranks) : Pointers(lmp), ranks_(ranks) {}

  void add_properties();    // by the owner's post_constructor()
  void delete_properties();

  // a new step or new positions: nothing is known of ghosts
  void expire();
  // new positions of n particles, owned and ghost: v* zero, no row types
  void reset(int n);

  aleisph::Field pressure();
  aleisph::Field velocity();
  aleisph::Field predicted() { return {predicted_.data(), 3, predicted_valid_}; }
  double *wall_velocity() { return property("aleisph_vw"); }    // 3 per owned particle
  double *wall_normals() { return property("aleisph_n"); }      // 4 per owned particle
  // Of a particle that is new in the flow, was dry or flew freely; that has a first pressure; that
  // has been through a step
  static constexpr double NEW = 0.0, SOLVED = 0.5, MET = 1.0;
  double *memory() { return property("aleisph_gp"); }    // 4 per owned particle
  double *given_back() const;                            // 1 per owned particle
  double *surface_layer() { return property("aleisph_s"); }    // 2 per owned particle, or null
  // d2_NAME as one array, owned particles; null if there is none
  double *property(const std::string &name) const;

  // A field that lasts from one run to the next belongs to the fixes that write it. They sign up in
  // their init(), as writer name anything that tells one from another. Where the writers are not
  // those of the run before, nobody owns what is in the field: it starts at zero.
  void forget_writers();    // by the owner's init()
  void add_writer(const std::string &field, const std::string &writer);
  void settle();    // at the start of a run, after every init()
  // it holds what its writers left there: they need not start anew
  bool kept(const std::string &field) const { return kept_.count(field) > 0; }
  // somebody has made this field anew
  void lose(const std::string &field) { owned_by_.erase(field); }
  // for restart files: who has written fields, one number each
  static constexpr int WRITTEN_FIELDS = 2;
  std::vector<double> writers() const;
  void set_writers(const double *writers);

  // an error if a number that has come with a particle, from a file or a command, is not finite
  void check_kept() const;
  // an error in the caller's name if v (3 per particle) is not finite on an owned particle
  void require_finite(const double *v, const std::string &caller, const std::string &what) const;

  // empty before the first assembly of the pressure equation
  const std::vector<aleisph::RowType> &row_types() const { return layout_.type; }
  aleisph::PpeLayout &ppe_layout() { return layout_; }

  // pressure has been solved for, or came from a restart file
  bool pressure_known() const { return pressure_known_; }
  void set_pressure_known(bool known) { pressure_known_ = known; }

  double bytes() const;

 private:
  // of atoms for which this does not hold, the largest ID of all ranks; 0 if there is none
  template <class Predicate> tagint violating(Predicate holds) const;

  const aleisph::Ranks &ranks_;
  std::map<std::string, std::string> writers_;       // of this run
  std::map<std::string, std::uint32_t> owned_by_;    // a checksum of them, of the run before
  std::set<std::string> kept_;
  void clear(const std::string &field);

  std::vector<double> predicted_;
  aleisph::PpeLayout layout_;
  bool pressure_valid_ = false, velocity_valid_ = false, predicted_valid_ = false;
  bool pressure_known_ = false;
};

}    // namespace LAMMPS_NS

#endif
