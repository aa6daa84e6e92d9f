/* ----------------------------------------------------------------------
   LAMMPS - Large-scale Atomic/Molecular Massively Parallel Simulator
   USER-ALEISPH package
   SPDX-License-Identifier: GPL-2.0-only

   The record of a fix in restart files, for its write_restart() and restart()
------------------------------------------------------------------------- */

#ifndef LMP_ALEISPH_HALO_RECORD_H
#define LMP_ALEISPH_HALO_RECORD_H

#include "aleisph_record.h"

#include <cstdio>
#include <vector>

namespace LAMMPS_NS {

class Error;
class Fix;

// on rank 0, which alone has the file
void write_record(std::FILE *fp, const aleisph::Record &record, const std::vector<double> &values);

// on all ranks; an error that names the fix unless the record is right
std::vector<double> read_record(Error *error, const Fix *fix, const aleisph::Record &record,
                                const char *data);

}    // namespace LAMMPS_NS

#endif
