/* -*- c++ -*- ----------------------------------------------------------
   LAMMPS - Large-scale Atomic/Molecular Massively Parallel Simulator
   USER-ALEISPH package
   SPDX-License-Identifier: GPL-2.0-only

   Guards for splashing flow. Each is off unless its keyword is given; how often
   it acted and the energy that it added are counted.
------------------------------------------------------------------------- */

#ifdef FIX_CLASS
// clang-format off
FixStyle(aleisph/guard,FixAleisphGuard);
// clang-format on
#else

#ifndef LMP_FIX_ALEISPH_GUARD_H
#define LMP_FIX_ALEISPH_GUARD_H

#include "aleisph_scene.h"
#include "fix.h"

#include <array>
#include <vector>

namespace LAMMPS_NS {

class FixAleisphGuard : public Fix, private aleisph::PressureGuard {
 public:
  FixAleisphGuard(class LAMMPS *, int, char **);
  ~FixAleisphGuard() override;
  int setmask() override;
  void init() override;
  void setup(int) override;
  void final_integrate() override;
  double compute_vector(int) override;
  double memory_usage() override;
  void write_restart(FILE *) override;
  void restart(char *) override;

 private:
  enum Guard { WALLS, COLLISION, PRESSURE, SYMMETRIC, SELFTERM, CAP, NUM_GUARDS };
  struct Record {
    double now = 0.0, total = 0.0, energy = 0.0;    // of this rank; events, events, energy
  };

  void parse(int narg, char **arg);
  void guard_pressure(const aleisph::Field &p, double *grad) override;
  void limit_pressure(const aleisph::Field &pressure, double *grad);
  void replace_gradients(const double *p, double *grad);
  void correct_self_terms(const double *p, double *grad);
  aleisph::Rows free_rows() const;
  void complete_inverses();
  void collide();
  void cap();
  void hold_off_walls();
  double gradient_energy(const std::vector<double> &before, const double *grad) const;
  double change_velocity(const std::vector<double> &dv);
  void record(Guard guard, long events, double energy);

  double walls_, collision_, symmetric_, cap_;    // 0: off
  bool limit_pressure_, selfterm_, started_, shifted_;
  double least_pressure_;
  class FixAleisph *owner_;
  std::array<Record, NUM_GUARDS> records_;
  std::vector<double> work_, counts_, inverse_, gauge_;
};

}    // namespace LAMMPS_NS

#endif
#endif
