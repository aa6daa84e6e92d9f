/* ----------------------------------------------------------------------
   LAMMPS - Large-scale Atomic/Molecular Massively Parallel Simulator
   USER-ALEISPH package
   SPDX-License-Identifier: GPL-2.0-only

   A matrix of owned rows as a linear operator over all ranks. Each product has
   one halo exchange of one value per particle; rows without ghosts are worked
   on meanwhile. The matrix must have the pattern of the present stencil.
------------------------------------------------------------------------- */

#ifndef LMP_ALEISPH_HALO_OPERATOR_H
#define LMP_ALEISPH_HALO_OPERATOR_H

#include "aleisph_halo_owner.h"
#include "aleisph_solve_csr.h"
#include "aleisph_solve_krylov.h"

namespace LAMMPS_NS {

class AleisphHaloOperator : public aleisph::LinearOperator {
 public:
  AleisphHaloOperator(const aleisph::CsrMatrix &matrix, FixAleisph &owner) :
      matrix_(matrix), owner_(owner)
  {
  }
  int rows() const override { return matrix_.rows(); }
  int columns() const override { return owner_.cloud().size(); }
  void apply(double *x, double *y) override
  {
    const auto &cloud = owner_.cloud();
    const auto &s = cloud.stencil();
    const aleisph::RowSplit &split = owner_.ranks().split(s.rows(), s.ptr(), s.col(),
                                                          cloud.version());
    owner_.ranks().start(x);
    matrix_.multiply(split.interior, x, y);
    owner_.ranks().finish(x);
    matrix_.multiply(split.boundary, x, y);
  }

 private:
  const aleisph::CsrMatrix &matrix_;
  FixAleisph &owner_;
};

}    // namespace LAMMPS_NS

#endif
