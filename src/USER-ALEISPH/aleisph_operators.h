// SPDX-License-Identifier: GPL-2.0-only
/* ----------------------------------------------------------------------
   Corrected SPH operators of Morikawa, Tsuji & Asai, eqs 8-14.
     M_i = sum_j V gradW_ij (x) r_ji,   L_i = M_i^-1
     (grad f)_i = sum_j g_ij (f_j - f_i),   g_ij = V L_i gradW_ij     (9)
     (lap f)_i  = sum_j a_ij (f_i - f_j),   a_ij = A*_ij              (11-14)
   Exact for linear (grad) and quadratic (lap) fields on any support whose
   moments are invertible. V = d^dim is the volume of every particle.

   Conventions: `rows` lists the owned rows to work on; vector fields have
   3 doubles per particle, v[3*j+a]; input fields must be valid on every
   particle that is a column of those rows (owned and ghost); output fields
   are written on `rows` only.
------------------------------------------------------------------------- */

#ifndef LMP_ALEISPH_OPERATORS_H
#define LMP_ALEISPH_OPERATORS_H

#include "aleisph_roles.h"
#include "aleisph_stencil.h"

#include <array>
#include <vector>

namespace aleisph {

class Cloud;

/* ----------------------------------------------------------------------
   g_ij = V L_i gradW_ij [1/length] and lambda_i, the smallest eigenvalue of
   M_i (0.98-0.99 in the bulk, 0.5 at a flat free surface, 0 for an isolated
   pair). Only L_i is kept; g_ij of a pair is made from it when it is needed
   (pair_gradient() in aleisph_vectors.h, or L_i after a sum over the row).
   On the rows listed in `floored`, eigenvalues of M below `floor` are
   replaced by it in L (lambda() stays the true one); such rows are counted
   in clamped(). A row whose M cannot be inverted (lambda < MIN_LAMBDA,
   no floor) gets L_i = 0 and is counted in singular().
------------------------------------------------------------------------- */
class GradientWeights {
 public:
  static constexpr double MIN_LAMBDA = 1.0e-8;
  static constexpr int PACKED = 6;

  void build(const Stencil &s, double volume, const Rows &floored = Rows(), double floor = 0.0);

  double volume() const { return volume_; }
  // L_i as xx yy zz xy xz yz, PACKED doubles for each owned row; in 2d z is zero
  const double *inverse() const { return inverse_.data(); }
  double lambda(int i) const { return lambda_[i]; }
  int singular() const { return singular_; }
  int clamped() const { return clamped_; }
  double bytes() const;

 private:
  double volume_ = 0.0;
  std::vector<double> inverse_, lambda_;
  int singular_ = 0, clamped_ = 0;
};

/* ----------------------------------------------------------------------
   When the corrected Laplacian row is not trusted, the row of Morris, Fox
   & Zhu (1997), a_ij = 2 V (r_ij.gradW_ij)/(r_ij^2 + eta h^2), is used.
   Its eigenvalues are never positive. Reasons, in the order they are
   tested and counted (a row counts once):
     lambda      lambda_i < min_lambda, or M_i is singular
     condition   2-norm condition number of the B system > max_cond (the
                 unknowns are scaled so that it does not depend on the axes)
     diagonal    -d^2 sum_j a_ij outside [min_diagonal, max_diagonal] times
                 the value on the full lattice; a diagonal far too large makes
                 explicit viscosity unstable
   Particles on the surface have Morris' row always; they are counted apart.
------------------------------------------------------------------------- */
struct LaplacianLimits {
  double min_lambda = 0.5;
  double max_cond = 200.0;
  double min_diagonal = 0.5;
  double max_diagonal = 8.0;
  double eta = 0.01;
};

// LaplacianLimits in the units of the rows
struct LaplacianBounds {
  double min_lambda, max_cond;
  double min_diagonal, max_diagonal;    // of sum_j a_ij [1/length^2]
  double eta_h2;                        // [length^2]
};
// kernel: the one of the stencil (Morris' eta h^2, value on the full lattice); d: particle spacing
LaplacianBounds laplacian_bounds(const LaplacianLimits &limits, const Kernel &kernel, double d);

struct MorrisCount {
  int lambda = 0, condition = 0, diagonal = 0, surface = 0;
  // untrusted rows, so without the surface
  int total() const { return lambda + condition + diagonal; }
  MorrisCount &operator+=(const MorrisCount &other)
  {
    lambda += other.lambda;
    condition += other.condition;
    diagonal += other.diagonal;
    surface += other.surface;
    return *this;
  }
};

class LaplacianWeights {
 public:
  // builds the rows listed; a() of other rows is not written. role: read for SURFACE, may be null
  void build(const Stencil &s, const GradientWeights &g, const Rows &rows,
             const LaplacianBounds &bounds, const Role *role = nullptr);

  const double *a() const { return a_.data(); }    // pair array [1/length^2]
  // exchanges the pair array of a() for another one, whose memory the next build uses
  void swap_weights(std::vector<double> &a) { a_.swap(a); }
  double diagonal(int i) const { return diagonal_[i]; }    // sum_j a_ij, < 0 for a good row
  // of the B system; 0 if never built. Where the cheap Frobenius bound |G||G^-1| (up to 6
  // times the 2-norm value) is within max_cond, that bound; else the 2-norm value.
  double condition(int i) const { return condition_[i]; }
  bool morris(int i) const { return morris_[i] != 0; }
  const MorrisCount &morris_count() const { return count_; }
  double bytes() const;

 private:
  std::vector<double> a_, diagonal_, condition_;
  std::vector<char> morris_;
  MorrisCount count_;
};

// grad[3*i+a] = (grad f)_i
void gradient(const Cloud &cloud, const Rows &rows, const double *f, double *grad);

// Derivatives of a velocity: slip walls have the tangential velocity of the fluid, see
// slide_with_fluid() in aleisph_wall_contact.h.

// div[i] = (div v)_i
void divergence(const Cloud &cloud, const Rows &rows, const double *v, double *div);

// out[3*i+a] = (c_i . grad) v_a
void convection(const Cloud &cloud, const Rows &rows, const double *c, const double *v,
                double *out);

// out[9*i+3*a+b] = d v_a/d x_b
void velocity_gradient(const Cloud &cloud, const Rows &rows, const double *v, double *out);

// out[3*i+a] = (lap v_a)_i, neighbours with role SLIP left out (v_j := v_i)
void laplacian(const Cloud &cloud, const Rows &rows, const double *v, double *out);

// out[3*i+a] = (curl v)_i; in 2d only the z component is non-zero if v lies
// in the plane, and the curl of a z-vector lies in the plane
void curl(const Cloud &cloud, const Rows &rows, const double *v, double *out);

}    // namespace aleisph
#endif
