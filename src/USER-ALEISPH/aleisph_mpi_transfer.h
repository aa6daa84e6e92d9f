// SPDX-License-Identifier: GPL-2.0-only
/* ----------------------------------------------------------------------
   Transfers the values of rows that have moved to other ranks or places: from
   the layout at the time a preconditioner was built to the present one, and back.
------------------------------------------------------------------------- */

#ifndef LMP_ALEISPH_MPI_TRANSFER_H
#define LMP_ALEISPH_MPI_TRANSFER_H

#include "aleisph_mpi_sparse.h"
#include "aleisph_solve_linear.h"

#include <memory>

namespace aleisph {

// before, after: IDs of the rows of this rank in their order. Called by all ranks together; null on
// all of them if the rows are not the same ones, or if many have left their rank. exchange: must
// live as long as what is returned.
std::unique_ptr<RowTransfer> make_transfer(SparseExchange &exchange, const RowIds &before,
                                           const RowIds &after);

}    // namespace aleisph
#endif
