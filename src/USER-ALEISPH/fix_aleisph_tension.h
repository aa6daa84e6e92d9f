/* -*- c++ -*- ----------------------------------------------------------
   LAMMPS - Large-scale Atomic/Molecular Massively Parallel Simulator
   USER-ALEISPH package
   SPDX-License-Identifier: GPL-2.0-only

   Surface tension: curvature of the free surface, the pressure and force
   that it exerts, and contact angles on walls.
------------------------------------------------------------------------- */

#ifdef FIX_CLASS
// clang-format off
FixStyle(aleisph/tension,FixAleisphTension);
// clang-format on
#else

#ifndef LMP_FIX_ALEISPH_TENSION_H
#define LMP_FIX_ALEISPH_TENSION_H

#include "aleisph_scene.h"
#include "fix.h"

#include <memory>
#include <string>
#include <vector>

namespace aleisph {
class TensionModel;
struct TensionResult;
}    // namespace aleisph

namespace LAMMPS_NS {

class AleisphVariable;

class FixAleisphTension :
    public Fix,
    public aleisph::SurfaceTension,
    public aleisph::Acceleration,
    public aleisph::VelocityGuard,
    public aleisph::TimeStepLimit {
 public:
  FixAleisphTension(class LAMMPS *, int, char **);
  ~FixAleisphTension() override;
  int setmask() override;
  void init() override;
  void init_list(int, class NeighList *) override;
  void setup_pre_force(int) override;
  void setup(int) override;
  void pre_force(int) override;
  void post_force(int) override;
  void reset_dt() override;
  double compute_vector(int) override;
  double memory_usage() override;

  // aleisph::SurfaceTension, owned particles, zero away from the surface
  bool ready() const override;
  const double *surface_pressure() const override { return p_.data(); }
  const double *curvature() const override;
  const double *surface_normal() const override;
  const double *contact() const override;
  double sigma() const override { return sigma_; }
  const double *contact_cosine() const override { return walls_ ? cosine_.data() : nullptr; }
  void add_acceleration(double *a) override;
  void guard_velocity(double *v) override;
  void time_step_limits(aleisph::StepBounds &limits) const override;

 private:
  // the angle on the walls of a group: a number, or an equal- or atom-style variable
  struct Angle {
    std::string group;
    int groupbit;
    std::unique_ptr<AleisphVariable> degrees;
  };

  void parse(int narg, char **arg);
  Angle parse_angle(const std::string &group, const std::string &value);
  void set_form(const std::string &word);
  void resolve_angles() const;
  void evaluate_angles();
  void make_model();
  const aleisph::TensionResult &result() const;
  void rebuild();
  void find_pressure();
  void find_velocity_gradient(const aleisph::Rows &rows);
  void check_sigma() const;
  void check_time_step() const;

  bool published_;        // the model: published or tangent
  double given_sigma_;    // by the command, < 0: that of the fluid
  double sigma_;          // in force
  double factor_, delta_, filter_;
  bool pressure_form_, force_form_, viscous_, form_given_, viscous_given_;
  std::vector<Angle> angles_;

  class FixAleisph *owner_;
  class NeighList *list_;
  std::unique_ptr<aleisph::TensionModel> model_;
  bool walls_;
  int held_;
  long version_;    // of the positions that the model has seen

  std::vector<double> cosine_;    // of the contact angle, owned and ghost
  std::vector<double> p_;         // of the surface, owned
  std::vector<double> grad_v_, sliding_;
};

}    // namespace LAMMPS_NS

#endif
#endif
