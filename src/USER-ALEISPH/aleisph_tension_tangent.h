// SPDX-License-Identifier: GPL-2.0-only
/* ----------------------------------------------------------------------
   Model `tangent` of surface tension. With no factor that is fitted,
   1. N_i = -G_i/|G_i|, G a colour gradient over the wide support 4.8 d
      (Wendland C2), sources below walls included
      (aleisph_tension_contact_continuation.h);
   2. A_i = sym[ (sum_j V (N_j - N_i) (x) gradW_ij) (sum_j V gradW_ij (x) r_ji)^-1 ]
      in the tangent plane of i, j on the surface with N_i.N_j > 0.3; its
      eigenvalues k are the principal curvatures of the layer of particles;
   3. to the true surface, half a spacing outside of the layer:
      K_i = sum k/(1 + k d/2), exact for spheres and for cylinders;
   4. one mean over i and its neighbours on the surface, weights 1 - r/(2.4 d).
      It takes away noise, and with it 6 % (2d, R = 10 d) to 13 % (3d, R = 8 d)
      of the change of K when a drop is stretched to the mode n = 2;
   5. near contact lines, the curvature that the contact angle demands
      (aleisph_tension_contact_curvature.h).

   Conventions: see aleisph_tension.h.
------------------------------------------------------------------------- */

#ifndef LMP_ALEISPH_TENSION_TANGENT_H
#define LMP_ALEISPH_TENSION_TANGENT_H

#include "aleisph_tension.h"
#include "aleisph_tension_wide.h"

namespace aleisph {

class TangentTension : public TensionModel {
 public:
  TangentTension(int dim, double d) : wide_(dim, d) {}

  double reach() const override { return wide_.kernel.support(); }
  bool binds_tips() const override { return true; }
  double bytes() const override;

 protected:
  void find_normals(const TensionScene &scene) override;
  void find_curvature(const TensionScene &scene) override;

 private:
  void find_planes(const TensionScene &scene);

  WideStencil wide_;
  std::vector<double> plane_;        // of contact, 2 per particle, owned and ghost
  std::vector<double> K_, known_;    // before the mean, owned and ghost
};

// Steps 2 and 3. K: NaN-free; known[i] = 1 if K_i could be computed, else 0 (and K_i = 0); both one
// per particle, doubles, so that ghosts can be exchanged.
CurvatureCount tangent_curvature(const Cloud &cloud, const Rows &rows, const double *N, double *K,
                                 double *known);
// Step 4 and the bound |K| <= 1/d; neighbours with N_i.N_j > 0.3 as far as K is known there. K and
// known valid on owned and ghost. Returns the number of rows where the bound acts.
int smooth_curvature(const Cloud &cloud, const Rows &rows, const double *N, const double *K,
                     const double *known, double *mean);

}    // namespace aleisph
#endif
