// SPDX-License-Identifier: GPL-2.0-only
/* ----------------------------------------------------------------------
   Model `published` of surface tension: Morikawa, Tsuji & Asai, eqs 25 and 27,
     kappa_i = factor sum_j V (N_j - N_i).L_i gradW_ij, j on the surface,
   K = (dim - 1) kappa in the meaning of aleisph_tension.h (kappa: mean curvature;
   the paper writes 2 sigma kappa for the pressure in three dimensions), with the
   normals of aleisph_eigenvalue_normal.h.
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

 protected:
  void find_normals(const TensionScene &scene) override;
  void find_curvature(const TensionScene &scene) override;

 private:
  double factor_;
};

// eq 27 with its factor, as K = (dim - 1) kappa, |K| <= 1/d
CurvatureCount published_curvature(const Cloud &cloud, const Rows &rows, const double *N,
                                   double factor, double *K);

}    // namespace aleisph
#endif
