/* -*- c++ -*- ----------------------------------------------------------
   LAMMPS - Large-scale Atomic/Molecular Massively Parallel Simulator
   USER-ALEISPH package
   SPDX-License-Identifier: GPL-2.0-only

   Motion and prediction (Morikawa, Tsuji & Asai, eqs 3, 6):
     x += dt w,    v* = v + dt (nu lap v + f/m - c.grad v),    c = v - w,
   with the transport velocity w = v (lagrangian), 0 (eulerian), or (ale)
   prescribed, or v plus the velocity of shifting, d2_aleisph_u. Viscosity is
   explicit, or implicit by backward Euler or Crank-Nicolson; the implicit
   forms include -grad p^n/rho0 in the solve for the viscous velocity and take
   it out again afterwards, so that the pressure equation is the same for all.
------------------------------------------------------------------------- */

#ifdef FIX_CLASS
// clang-format off
FixStyle(aleisph/predictor,FixAleisphPredictor);
// clang-format on
#else

#ifndef LMP_FIX_ALEISPH_PREDICTOR_H
#define LMP_FIX_ALEISPH_PREDICTOR_H

#include "aleisph_scene.h"
#include "fix.h"

#include <memory>
#include <string>
#include <vector>

namespace aleisph {
class CsrMatrix;
struct FluidFit;
}

namespace LAMMPS_NS {

class AleisphHaloSolver;
class AleisphVariable;

class FixAleisphPredictor : public Fix, private aleisph::TimeStepLimit {
 public:
  FixAleisphPredictor(class LAMMPS *, int, char **);
  ~FixAleisphPredictor() override;
  int setmask() override;
  void post_constructor() override;
  void init() override;
  void setup(int) override;
  void initial_integrate(int) override;
  void final_integrate() override;
  void end_of_step() override;
  void reset_dt() override;
  double compute_vector(int) override;
  double memory_usage() override;
  void write_restart(FILE *) override;
  void write_restart_file(const char *) override;
  void restart(char *) override;

 private:
  // custom properties, 3 per particle: acceleration of the step before, prescribed transport
  // velocity, velocity of shifting, rate of change of the velocity in the step before
  static constexpr char ACCELERATION[] = "aleisph_a", TRANSPORT[] = "aleisph_w",
                        SHIFT[] = "aleisph_u", CHANGE[] = "aleisph_dv";

  enum class Frame { LAGRANGIAN, EULERIAN, ALE };
  struct Params {
    Frame frame = Frame::LAGRANGIAN;
    double nu = -1.0;              // viscosity; < 0: that of the fluid property file
    bool dynamic = false;          // nu is the dynamic viscosity mu
    double theta = 0.0;            // share of the new time level in nu lap v; 0 explicit
    bool verlet = true;            // motion and pressure of second order in time
    bool ab2 = false;              // explicit terms by Adams-Bashforth 2 instead of forward Euler
    double tolerance = 1.0e-12;    // of the implicit solve, relative to |v|
    std::vector<AleisphVariable> transport;    // 3 components, or none: not prescribed
  };

  void parse(int narg, char **arg);
  bool prescribed() const;
  bool shifted() const { return params_.frame == Frame::ALE && !prescribed(); }
  void lose_shift(const Fix *property) const;
  void check_transport() const;
  void check_shift() const;
  void check_other_integrators() const;
  void check_viscosity() const;
  void check_viscous_limit() const;

  void start(std::vector<double> &a);
  void add_body(std::vector<double> &a);
  void add_convection(std::vector<double> &a);
  void add_viscosity(double share, std::vector<double> &a);
  void add_wall_viscosity(std::vector<double> &a);
  void find_wall_laplacian(double *lap);
  void find_wall_curl(double *lap);
  void approach_gradually(const aleisph::Rows &rows, double *lap);
  void add_other_terms(std::vector<double> &a);
  void extrapolate(std::vector<double> &a);
  void predict_explicit();
  void predict_implicit();
  void predict_walls();
  void meet_walls(double *vstar);
  bool remembers() const;
  void complete_pressure();
  void find_known_gradient();
  void start_memory();
  void add_memory(std::vector<double> &a);
  void assemble_viscous();
  void solve_viscous(std::vector<double> &rhs);
  void evaluate_transport();
  double largest_norm(const aleisph::Rows &rows, const double *v, const double *w = nullptr) const;
  double largest_speed() const;
  double viscous_number() const;
  void time_step_limits(aleisph::StepBounds &limits) const override;
  double advisable_time_step() const;

  Params params_;
  class FixAleisph *owner_;
  double nu_;               // in force
  double viscous_limit_;    // time step at which explicit viscosity is unstable on the lattice
  double previous_dt_;      // of the stored acceleration, 0 if there is none
  double memory_dt_;        // of the step that the memory is of; 0: of an instant

  std::vector<double> a_, work_, known_, relative_, sliding_;    // 3 per owned particle
  std::unique_ptr<aleisph::CsrMatrix> viscous_;
  std::unique_ptr<AleisphHaloSolver> solver_;
  std::unique_ptr<aleisph::FluidFit> fit_;    // of no-slip walls, where no particle moves
  long fit_version_;
  long viscous_version_;
  double viscous_dt_;
  int viscous_iterations_;
};

}    // namespace LAMMPS_NS

#endif
#endif
