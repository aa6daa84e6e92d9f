/* -*- c++ -*- ----------------------------------------------------------
   LAMMPS - Large-scale Atomic/Molecular Massively Parallel Simulator
   USER-ALEISPH package
   SPDX-License-Identifier: GPL-2.0-only

   Pressure Poisson equation and velocity correction (Morikawa, Tsuji &
   Asai, eqs 4, 5, 15-18): lap p = rho0/dt div v*, v = v* - dt/rho0 grad p.
   Fluid and wall pressures are solved for together with BiCGSTAB.
------------------------------------------------------------------------- */

#ifdef FIX_CLASS
// clang-format off
FixStyle(aleisph/ppe,FixAleisphPPE);
// clang-format on
#else

#ifndef LMP_FIX_ALEISPH_PPE_H
#define LMP_FIX_ALEISPH_PPE_H

#include "fix.h"

#include <memory>
#include <string>
#include <vector>

namespace aleisph {
class CsrMatrix;
struct KrylovParams;
struct PpeOptions;
struct SolveReport;
}    // namespace aleisph

namespace LAMMPS_NS {

class AleisphHaloSolver;

class FixAleisphPPE : public Fix {
 public:
  FixAleisphPPE(class LAMMPS *, int, char **);
  ~FixAleisphPPE() override;
  int setmask() override;
  void init() override;
  void setup(int) override;
  void final_integrate() override;
  double compute_scalar() override;
  double compute_vector(int) override;
  double memory_usage() override;
  void write_restart_file(const char *) override;

 private:
  struct Params {
    double divergence;    // bound on |div v| dt, 0: none, but the relative tolerance
    bool second_order;    // wall rows
    bool gives_back;      // what the projection leaves, where no particle moves
    bool reuse, error_on_failure;
  };

  void parse(int narg, char **arg);
  void assemble();
  aleisph::PpeOptions options() const;
  void choose_preconditioner();
  void choose_max_iterations();
  void right_hand_side();
  void solve();
  void set_target();
  double rounding_level() const;
  double largest_rounding() const;
  double smooth_rows() const;
  void act_on(const aleisph::SolveReport &report);
  std::string criterion() const;
  void find_laplacian();
  void find_gradient();
  void correct_velocity();
  void remember();
  void start_motion(const double *memory);
  bool gives_back() const;
  void keep_leftover();
  void find_divergence();
  double volume_change(double residual) const;
  double max_divergence();

  Params params_;
  class FixAleisph *owner_;
  long version_;    // of the positions that the matrix belongs to
  bool closed_;     // no pressure is prescribed anywhere
  std::unique_ptr<aleisph::CsrMatrix> matrix_;
  std::unique_ptr<AleisphHaloSolver> solver_;
  std::unique_ptr<aleisph::KrylovParams> krylov_;
  std::unique_ptr<aleisph::SolveReport> report_;    // of the last solve
  std::vector<double> rhs_, div_, grad_, p_, left_;
  long failures_;
  int max_iterations_;    // keyword maxiter, 0: not given
};

}    // namespace LAMMPS_NS

#endif
#endif
