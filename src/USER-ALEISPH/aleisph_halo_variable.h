/* ----------------------------------------------------------------------
   LAMMPS - Large-scale Atomic/Molecular Massively Parallel Simulator
   USER-ALEISPH package
   SPDX-License-Identifier: GPL-2.0-only

   A value that a script gives as a number or as v_NAME: an equal-style variable,
   or, where it may differ between particles, an equal- or atom-style one.
------------------------------------------------------------------------- */

#ifndef LMP_ALEISPH_HALO_VARIABLE_H
#define LMP_ALEISPH_HALO_VARIABLE_H

#include "pointers.h"

#include <string>
#include <vector>

namespace LAMMPS_NS {

class AleisphVariable : protected Pointers {
 public:
  enum class Kind { EQUAL, EQUAL_OR_ATOM };

  /* Variables are evaluated while one of these exists. A compute in a variable must be current: it
     runs again now, and is told that the next step asks for it, too (some computes need to know
     before, as they collect during the step). */
  class Evaluation {
   public:
    // active: there are variables among the values, not only numbers
    Evaluation(LAMMPS *lmp, bool active);
    ~Evaluation();
    Evaluation(const Evaluation &) = delete;
    Evaluation &operator=(const Evaluation &) = delete;

   private:
    LAMMPS *lmp_;
  };

  // caller and what: as messages name them, "Fix aleisph/wall" and "keyword velocity"; word: a
  // number or v_NAME
  AleisphVariable(LAMMPS *lmp, const std::string &caller, const std::string &what, Kind kind,
                  const std::string &word);

  // in init(): an error unless the variable exists and is of the right style
  void check() const;

  bool constant() const { return name_.empty(); }
  const std::string &name() const { return name_; }    // of the variable, empty if constant
  std::string text() const;                            // as in a script

  // during an Evaluation
  double equal() const;    // of kind EQUAL
  // per owned particle; those outside of the group of this index may have any value
  void evaluate(int igroup, std::vector<double> &values) const;

 private:
  int find() const;

  std::string caller_, what_;
  Kind kind_;
  double value_;
  std::string name_;
};

}    // namespace LAMMPS_NS

#endif
