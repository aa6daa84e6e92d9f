/* -*- c++ -*- ----------------------------------------------------------
   LAMMPS - Large-scale Atomic/Molecular Massively Parallel Simulator
   USER-ALEISPH package
   SPDX-License-Identifier: GPL-2.0-only

   Chooses the time step. The limits come from the styles that cause them
   (aleisph::TimeStepLimit); the choice of the next step is in aleisph_timestep.h.
------------------------------------------------------------------------- */

#ifdef FIX_CLASS
// clang-format off
FixStyle(aleisph/dt,FixAleisphDt);
// clang-format on
#else

#ifndef LMP_FIX_ALEISPH_DT_H
#define LMP_FIX_ALEISPH_DT_H

#include "fix.h"

#include <memory>

namespace aleisph {
class StepControl;
}

namespace LAMMPS_NS {

class FixAleisphDt : public Fix {
 public:
  FixAleisphDt(class LAMMPS *, int, char **);
  ~FixAleisphDt() override;
  int setmask() override;
  void init() override;
  void setup(int) override;
  void end_of_step() override;
  void post_run() override;
  double compute_scalar() override;
  double compute_vector(int) override;
  void write_restart(FILE *) override;
  void restart(char *) override;

 private:
  void parse(int narg, char **arg);
  void adopt_timestep();
  double time() const;
  double present_limit() const;
  void remember();
  void choose();
  void apply(double dt);
  void reschedule_dumps();

  int every_;
  std::unique_ptr<aleisph::StepControl> control_;
  class FixAleisph *owner_;
  double script_dt_;      // the last one that a timestep command has set
  double limit_;          // smallest bound at the end of the last run; < 0: choose anew
  double limit_align_;    // keyword align then
  bool warned_;           // in this run
};

}    // namespace LAMMPS_NS

#endif
#endif
