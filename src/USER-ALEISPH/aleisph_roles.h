// SPDX-License-Identifier: GPL-2.0-only
/* ----------------------------------------------------------------------
   What a particle is. Bits of one unsigned per particle, known for owned
   and ghost particles alike.
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

}    // namespace aleisph
#endif
