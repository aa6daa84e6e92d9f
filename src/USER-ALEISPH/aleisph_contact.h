// SPDX-License-Identifier: GPL-2.0-only
/* ----------------------------------------------------------------------
   Contact angle theta (through the fluid) where a free surface meets a wall.

   The force balance of the surface between the wall and a height h above it
   gives its curvature there. Along the line of steepest ascent of a surface with
   curvature k,
     d(N.n)/dh = k,      so that the mean of k is  (N(h).n - cos(theta))/h:
   N.n is cos(theta) on the wall. This is exact, on an arc at all heights. It
   takes N from where the surface is resolved, some spacings off the wall, and
   does not depend on where the outermost particles are: their own
   curvature cannot tell a wrong angle from a particle out of place.

   1. Near the line (contact_curvature) K of the surface is replaced by
        K_c = k + K_a,
        k = sum_j w_ij h_j (N_j.n - cos(theta)) / sum_j w_ij h_j^2,
      h_j the height over the wall of x_j + (d/2) N_j, j on the surface,
      w_ij = (1 - r_ij/(4.8 d))^2, and K_a (3d) the curvature along the line,
      from the same particles. If the surface is steeper than theta, K_c is too
      small and the fluid is drawn to the line, which advances.
      The share of K_c is 1 up to the height `near`, 0 from `far` on, and fades
      where no particle next to i is low enough to be on the wall, and where
      the surface lies parallel to it.
   2. Below the wall the fluid is continued along the tangent that theta
      prescribes, so that the wide colour gradient gives N near the line:
      a. A contact particle is a particle on the surface closer than `reach` to
         a wall, along the wall's normal n, where the surface is not parallel to
         the wall. Below an overhang the lowest particle on the surface may be
         1.5 d above the wall. Its contact normal is
           N_c = t sin(theta) + n cos(theta)
         (t: direction of N along the wall), the contact plane goes through
         x_c = x_i + (d/2) N_c.
      b. Each wall particle j takes the plane of the contact particle nearest
         to it along the wall: plane[2*j] = (x_j - x_c).N_c/d, plane[2*j+1] =
         n_j.N_c. Far from all contact particles the wall is covered or DRY:
         plane[2*j] = -COVERED or +COVERED, plane[2*j+1] = 0.
      c. Sources of the wide colour gradient at x_j - k d n_j, k = 0..depth,
         with the weight clip(1/2 - (plane[2*j] - k plane[2*j+1]), 0, 1).
   3. The tip of a thin wedge has few neighbours in the fluid and passes for spray.
      Beside the fluid and above a wall it is part of the contact line (bind_tips).
   4. N of the colour gradient proper has no part into walls and is wrong on
      overhangs; near the line the N of 2. is to take its place
      (contact_surface_normals), in the pressure row and in shifting.
   5. Where walls meet in a concave edge or corner (aleisph_contact_walls.h)
      a surface near two of them has k and k', and K_c = k + k': N.n and N.n'
      change with the heights over the two walls, which are coordinates
      across the edge; its div is the sum, whatever the angle between the walls.
      N_c has both angles. Behind a particle on the edge there is a whole
      quadrant of sources, at x_j - d (a n + b n'), a, b = 0..depth, n and n' of the
      faces next to it, and in a corner an octant. The normal of the edge
      particle itself, between n and n', counts for nothing.
------------------------------------------------------------------------- */

#ifndef LMP_ALEISPH_CONTACT_H
#define LMP_ALEISPH_CONTACT_H

#include "aleisph_operators.h"

namespace aleisph {

struct ContactParams {
  double reach = 1.9;              // of contact particles, in spacings
  int depth = 4;                   // rows of sources below the wall
  double near = 1.5, far = 3.0;    // heights over which K_c fades out, in spacings
};
constexpr double COVERED = 1.0e3;

// shape: that of walls as wall_shapes() has it, owned and ghost; null: no wall has edges

// Clears BALLISTIC on those of the owned fluid rows listed that have fluid and at least dim wall
// particles within 1.7 d; returns their number. role: owned and ghost; the caller updates ghosts.
int bind_tips(const Stencil &s, const Rows &fluid, double d, Role *role);

// contact[4*i..4*i+2] = N_c of owned surface particle i, contact[4*i+3] = 1; all zero if it is
// no contact particle. cosine: cos(theta) of walls, owned and ghost. normal: walls into the fluid,
// surface particles outward. Returns the number of contact particles.
int contact_normals(const Stencil &s, const Rows &surface, const Role *role, const double *normal,
                    const double *cosine, double d, const ContactParams &params, double *contact,
                    const double *shape = nullptr);

// plane[2*j], plane[2*j+1] of the wall rows listed (owned). wide: their rows with all neighbours
// within 4.8 d. contact: owned and ghost; those as high as reach above the wall belong to another.
void contact_planes(const Stencil &wide, const Rows &walls, const Role *role, const double *normal,
                    const double *contact, double d, double *plane,
                    const ContactParams &params = ContactParams());

// Adds the sources on and below the wall neighbours of the rows listed to N = -G; plane: owned
// and ghost.
void add_continuation(const Stencil &wide, const Kernel &kernel, const Rows &surface,
                      const Role *role, const double *normal, const double *plane, double volume,
                      double d, const ContactParams &params, double *N,
                      const double *shape = nullptr);

// K_i becomes share_i K_c + (1 - share_i) K_i on the rows listed, |K_c| <= 1/d. N: unit vectors,
// owned and ghost. share: 0..1, one per owned particle, written on these rows. Returns the number
// of rows where K_c met its bound.
int contact_curvature(const Stencil &wide, const Rows &surface, const Role *role,
                      const double *normal, const double *cosine, const double *N, double d,
                      const ContactParams &params, double *share, double *K,
                      const double *shape = nullptr);

// normal_i = (1 - share_i) normal_i + share_i N_i, normalised, on the rows listed
void contact_surface_normals(const Rows &surface, const double *share, const double *N,
                             double *normal);

}    // namespace aleisph
#endif
