/* -*- c++ -*- ----------------------------------------------------------
   LAMMPS - Large-scale Atomic/Molecular Massively Parallel Simulator
   USER-ALEISPH package
   SPDX-License-Identifier: GPL-2.0-only

   Particle shifting (Morikawa, Tsuji & Asai, eqs 7, 19-25, and others to
   compare with). The shift dr of a step becomes the velocity dr/dt by which
   particles move relative to the fluid in the step after it; the predictor
   of frame ale moves them and adds dr/dt.grad v.
------------------------------------------------------------------------- */

#ifdef FIX_CLASS
// clang-format off
FixStyle(aleisph/shift,FixAleisphShift);
// clang-format on
#else

#ifndef LMP_FIX_ALEISPH_SHIFT_H
#define LMP_FIX_ALEISPH_SHIFT_H

#include "aleisph_scene.h"
#include "fix.h"

#include <array>
#include <memory>
#include <set>
#include <string>
#include <vector>

namespace aleisph {
struct ShiftParams;
}

namespace LAMMPS_NS {

class AleisphVariable;

class FixAleisphShift : public Fix, private aleisph::Acceleration {
 public:
  FixAleisphShift(class LAMMPS *, int, char **);
  ~FixAleisphShift() override;
  int setmask() override;
  void init() override;
  void setup(int) override;
  void final_integrate() override;
  double compute_vector(int) override;
  double memory_usage() override;
  void write_restart(FILE *) override;
  void restart(char *) override;

 private:
  void parse(int narg, char **arg);
  void check_keywords(const std::set<std::string> &words) const;
  void add_acceleration(double *a) override;
  void set_defaults(const std::set<std::string> &words);
  void shift();
  const double *find_normals();
  double velocity_scale();
  double flow_scale();
  std::array<double, 3> mean_force() const;
  void remove_work();
  bool strain() const;
  double bounded(double coefficient);
  double largest_speed() const;
  double head() const;
  double largest_head(const double *g) const;
  double rate() const;
  double dt_over_d() const;

  std::unique_ptr<aleisph::ShiftParams> params_;
  bool eigenvalue_normal_;                       // N of eq 25
  double rate_, step_;                           // C = rate() U dt/d, or step; < 0: not given
  double smoothing_, filter_;                    // rates, < 0: the variant's own
  std::unique_ptr<AleisphVariable> velocity_;    // U, null if not given as a number or variable
  std::string of_;                               // else strain, max or head; empty: not given
  class FixAleisph *owner_;
  bool started_;    // d2_aleisph_u has been set, now or before a restart
  double coefficient_, scale_, limited_total_;    // scale_: U of the last shift
  double largest_ = 0.0;                          // C, of U from the flow; 0: not known yet
  int limited_;
  std::vector<double> eps_, dr_, grad_v_, grad_p_, sliding_, work_, normal_, energy_;
  aleisph::Rows rows_;    // on or next to the surface
};

}    // namespace LAMMPS_NS

#endif
#endif
