// SPDX-License-Identifier: GPL-2.0-only
/* ----------------------------------------------------------------------
   Model `published` of surface tension: Morikawa, Tsuji & Asai, eqs 25 and 27
   with the sign of N mended,
     N_i = -N* / |N*|, N* = sum_j V (lambda_j - lambda_i) L_i gradW_ij,
     kappa_i = factor sum_j V (N_j - N_i).L_i gradW_ij, j on the surface,
   K = (dim - 1) kappa in the meaning of aleisph_tension.h (kappa: mean curvature;
   the paper writes 2 sigma kappa for the pressure in three dimensions). On
   contact particles N is the contact normal (Fig. 9).
------------------------------------------------------------------------- */

#ifndef LMP_ALEISPH_TENSION_PUBLISHED_H
#define LMP_ALEISPH_TENSION_PUBLISHED_H

#include "aleisph_tension.h"

namespace aleisph {

class PublishedTension : public TensionModel {
 public:
  explicit PublishedTension(double factor) : factor_(factor) {}

  // kappa
  double force_share(int dim) const override { return 1.0 / (dim - 1); }
  double bytes() const override;

 protected:
  void find_normals(const TensionScene &scene) override;
  void find_curvature(const TensionScene &scene) override;

 private:
  double factor_;
  std::vector<double> lambda_;    // owned and ghost
};

// -N* of eq 25, not normalised, zero where it has no direction. lambda: owned and ghost.
void eigenvalue_gradient(const Cloud &cloud, const Rows &rows, const double *lambda, double *N);

// eq 27 with its factor, as K = (dim - 1) kappa, |K| <= 1/d
CurvatureCount published_curvature(const Cloud &cloud, const Rows &rows, const double *N,
                                   double factor, double *K);

}    // namespace aleisph
#endif
