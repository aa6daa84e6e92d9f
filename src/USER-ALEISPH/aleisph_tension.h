// SPDX-License-Identifier: GPL-2.0-only
/* ----------------------------------------------------------------------
   Surface tension: outward normals N and curvature K = div_s N of the free
   surface, which is 1/R on a cylinder (and in 2d) and 2/R on a sphere. The
   pressure inside is sigma K above that outside.

   A model is a class derived from TensionModel. update() finds, in this order,
   the particles on the surface, the contact lines on walls, N and K. The models:
   aleisph_tension_tangent.h and aleisph_tension_published.h; contact angles:
   aleisph_tension_contact.h.

   Conventions: fields have 3 doubles per particle, input valid on owned and
   ghost particles, output written on the rows listed (owned particles on the
   surface).
------------------------------------------------------------------------- */

#ifndef LMP_ALEISPH_TENSION_H
#define LMP_ALEISPH_TENSION_H

#include "aleisph_cloud.h"
#include "aleisph_tension_contact.h"

#include <functional>
#include <vector>

namespace aleisph {

// Makes the ghosts of a field with n doubles per particle valid
using GhostExchange = std::function<void(double *field, int n)>;

// What a model works on: the particles of one instant
struct TensionScene {
  const Cloud &cloud;
  const double *const *x;    // of owned and ghost
  CandidateList far;         // neighbours up to TensionModel::reach(), where it has one
  const double *cosine;      // of the contact angle of walls; null: there are no walls
  GhostExchange exchange;
};

struct CurvatureCount {
  int few = 0;        // fewer than three fluid neighbours: K = 0
  int unknown = 0;    // no N, or no inverse of what it is found from: mean of neighbours with K
  int limited = 0;    // a principal curvature below -2/(3 d), or |K| > 1/d

  // K, or the bound on its modulus; counted where that acts
  double limit(double K, double bound);

  CurvatureCount &operator+=(const CurvatureCount &other)
  {
    few += other.few;
    unknown += other.unknown;
    limited += other.limited;
    return *this;
  }
};

struct TensionResult {
  Rows rows;                      // owned surface particles that feel tension
  std::vector<double> N;          // owned and ghost
  std::vector<double> K;          // as this, zero but on rows
  std::vector<double> contact;    // as contact_normals() has it; empty without walls
  std::vector<double> share;      // of the contact angle in K, owned; empty if it has none
  CurvatureCount count;
  int contacts = 0;      // contact particles
  int undirected = 0;    // rows without a direction: N = 0

  double total_curvature() const;      // sum of K
  double largest_curvature() const;    // of |K|; 0 without rows
};

class TensionModel {
 public:
  virtual ~TensionModel() = default;

  // up to where it looks for neighbours [length]; 0: the stencil of the cloud is enough
  virtual double reach() const { return 0.0; }
  // Whether the tips of fluid on walls feel tension, so that bind_tips() is to go before update()
  virtual bool binds_tips() const { return false; }
  // of K in a force on the particles of the surface
  virtual double force_share(int /*dim*/) const { return 1.0; }

  void update(const TensionScene &scene);
  const TensionResult &result() const { return result_; }
  virtual double bytes() const;

 protected:
  virtual void find_normals(const TensionScene &scene) = 0;      // N, with ghosts
  virtual void find_curvature(const TensionScene &scene) = 0;    // K and its counts

  ContactParams contact_params_;
  TensionResult result_;
};

// owned fluid particles that are on the surface and not ballistic
Rows surface_rows(const Cloud &cloud);

// Normalises; returns the number of rows without a direction (N = 0)
int normalise(const Rows &rows, double *N);

// Added to p of the row of a surface particle in the PPE: sigma K
void add_capillary_pressure(const TensionResult &tension, double sigma, double *p);
// As a force on the particles of the surface: f_i -= factor K_i N_i
void add_tension_force(const TensionResult &tension, double factor, int dim, double *const *f);

}    // namespace aleisph
#endif
