/* ----------------------------------------------------------------------
   LAMMPS - Large-scale Atomic/Molecular Massively Parallel Simulator
   USER-ALEISPH package
   SPDX-License-Identifier: GPL-2.0-only

   What a script must fulfil before the equations make sense: commands of
   LAMMPS that do not fit, fixes that are missing or out of order, particles
   that are neither fluid nor wall. Part of the owner, which calls it.
------------------------------------------------------------------------- */

#ifndef LMP_ALEISPH_HALO_CHECKS_H
#define LMP_ALEISPH_HALO_CHECKS_H

#include "aleisph_stencil.h"
#include "pointers.h"

#include <utility>
#include <vector>

namespace LAMMPS_NS {

class FixAleisph;

class AleisphChecks : protected Pointers {
 public:
  AleisphChecks(LAMMPS *lmp, FixAleisph &owner) : Pointers(lmp), owner_(owner) {}

  // the commands of the script, at the start of each run; errors are those of all ranks
  void script() const;
  // what can be told only when all fixes are known
  void setup();
  // particles have moved, and LAMMPS has not looked how far
  void refuse_late_lists() const;

  // Faults of particles, at each new instant: of this rank the ID of an atom for each of them, 0 if
  // there is none; then, with the largest of all ranks, the error. fresh: the neighbor lists are new,
  // so that there may be new particles.
  static constexpr int FAULTS = 8;
  void find_faults(bool fresh, long long *atoms) const;
  void refuse(const long long *atoms) const;

  // Particles that are new since the last call, at most as many as there are since the first one,
  // must not lie close to others. close: any pair does; list: of candidates for the stencil.
  void arrivals(bool close, const aleisph::CandidateList &list);

 private:
  enum Fault { NOT_FINITE, OUT_OF_PLANE, MASS, SPECIAL, NO_ROLE, TWO_ROLES, BUFFER, CONTRADICTION };
  static constexpr int FIRST_LASTING = NO_ROLE;    // those before it come with new particles only

  void integrator() const;
  void neighbors() const;
  void box() const;
  void companions() const;
  void fix_order() const;
  bool late_lists() const;
  void find_contradictions();
  bool has(Fault fault, int i) const;
  int contradiction(int i) const;
  template <class F> long long largest(F &&is_wrong) const;
  void refuse_close(const aleisph::CandidateList &list) const;
  bool loses_neighbors(int i) const;
  void refuse_contradiction(long long code) const;

  FixAleisph &owner_;
  std::vector<std::pair<int, int>> contradictions_;    // claims of the scene, by their numbers
  bigint natoms_ = 0;                                  // at the last call of arrivals()
  long long known_ = 0;                                // largest ID then
};

}    // namespace LAMMPS_NS

#endif
