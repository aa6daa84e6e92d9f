// SPDX-License-Identifier: GPL-2.0-only
/* ----------------------------------------------------------------------
   The roles of a particle: bits of one unsigned per particle, known for owned
   and ghost particles alike. The first group is given by the script, the
   second is found anew from the positions of every step.
------------------------------------------------------------------------- */

#ifndef LMP_ALEISPH_ROLES_H
#define LMP_ALEISPH_ROLES_H

namespace aleisph {

using Role = unsigned;

constexpr Role FLUID = 1;        // momentum is integrated; PPE row: lap p = rho0/dt div v*
constexpr Role WALL = 2;         // lies on a wall; PPE row: n.grad p
constexpr Role SLIP = 4;         // with WALL: exerts no viscous force
constexpr Role DIRICHLET = 8;    // pressure is prescribed, whatever else the particle is
constexpr Role BUFFER = 16;      // velocity is copied from upstream (zero gradient)
constexpr Role CURLCURL = 32;    // with WALL: v* includes the viscous force -nu curl curl v

constexpr Role SURFACE = 64;       // with FLUID: on the free surface
constexpr Role BALLISTIC = 128;    // with FLUID and SURFACE: too few neighbours, flies freely
constexpr Role DRY = 256;          // with WALL: far from all fluid, in nobody's stencil

// takes part in the motion: neither a wall nor a buffer, and not flying freely
inline bool bound_fluid(Role r)
{
  return (r & FLUID) && !(r & (WALL | BUFFER | BALLISTIC));
}

// a fluid particle on a surface that holds together
inline bool bound_surface(Role r)
{
  return (r & FLUID) && (r & SURFACE) && !(r & BALLISTIC);
}

}    // namespace aleisph
#endif
