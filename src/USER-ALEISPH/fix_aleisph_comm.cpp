/* ----------------------------------------------------------------------
   LAMMPS - Large-scale Atomic/Molecular Massively Parallel Simulator
   USER-ALEISPH package
   SPDX-License-Identifier: GPL-2.0-only

   The owner's part about other ranks: the plan of the halo exchange.
------------------------------------------------------------------------- */

#include "fix_aleisph.h"

#include "aleisph_halo_owner.h"
#include "atom.h"
#include "comm.h"

#include <algorithm>

using namespace LAMMPS_NS;

/* ----------------------------------------------------------------------
   Ghosts are told rank and index of their owner by LAMMPS' own exchange,
   which knows ghosts of ghosts and periodic images. All fields then go
   straight from owner to ghost.
------------------------------------------------------------------------- */

void FixAleisph::build_halo()
{
  const int nlocal = atom->nlocal;
  std::vector<double> source(2 * static_cast<std::size_t>(nlocal + atom->nghost));
  aleisph::for_rows(nlocal, [&](int i) {
    source[2 * i] = comm->me;
    source[2 * i + 1] = i;
  });
  halo_plan_ = source.data();
  {
    aleisph::Timers::Scope scope(*timers_, aleisph::Part::COMM);
    comm->forward_comm(this, 2);
  }
  halo_plan_ = nullptr;
  std::vector<aleisph::HaloExchange::Owner> owner(atom->nghost);
  for (int g = 0; g < atom->nghost; g++)
    owner[g] = {static_cast<int>(source[2 * (nlocal + g)]),
                static_cast<int>(source[2 * (nlocal + g) + 1])};
  ranks_->plan(nlocal, owner);
}

int FixAleisph::pack_forward_comm(int n, int *list, double *buf, int, int *)
{
  for (int k = 0; k < n; k++) std::copy_n(halo_plan_ + 2 * list[k], 2, buf + 2 * k);
  return 2 * n;
}

void FixAleisph::unpack_forward_comm(int n, int first, double *buf)
{
  std::copy_n(buf, 2 * n, halo_plan_ + 2 * first);
}
