/* ----------------------------------------------------------------------
   LAMMPS - Large-scale Atomic/Molecular Massively Parallel Simulator
   USER-ALEISPH package
   SPDX-License-Identifier: GPL-2.0-only
------------------------------------------------------------------------- */

#include "fix_aleisph_filter.h"

#include "aleisph_shift.h"
#include "fix_aleisph.h"

using namespace LAMMPS_NS;

void AleisphVelocityFilter::add(FixAleisph &owner, aleisph::Role which, double rate, double *a)
{
  auto &disc = owner.discretization();
  grad_v_.assign(9 * static_cast<std::size_t>(owner.nall()), 0.0);
  aleisph::velocity_gradient(disc.stencil(), disc.gradient(), disc.fluid(), owner.velocity(),
                             owner.role(), owner.normal(), grad_v_.data());
  owner.forward(grad_v_.data(), 9);
  work_.assign(3 * static_cast<std::size_t>(disc.stencil().rows()), 0.0);
  aleisph::velocity_filter(disc.stencil(), disc.kernel(), disc.fluid(), owner.role(), which,
                           owner.velocity(), grad_v_.data(), disc.volume(), work_.data());
  for (const int i : disc.fluid())
    for (int k = 3 * i; k < 3 * i + 3; k++) a[k] += rate * work_[k];
}
