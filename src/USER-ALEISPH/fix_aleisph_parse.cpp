/* ----------------------------------------------------------------------
   LAMMPS - Large-scale Atomic/Molecular Massively Parallel Simulator
   USER-ALEISPH package
   SPDX-License-Identifier: GPL-2.0-only

   The command of the owner, and the fluid property file that it may name
------------------------------------------------------------------------- */

#include "fix_aleisph.h"

#include "aleisph_halo_owner.h"
#include "comm.h"
#include "domain.h"
#include "error.h"
#include "platform.h"
#include "update.h"
#include "utils.h"

#include <algorithm>
#include <cmath>
#include <fstream>

using namespace LAMMPS_NS;

namespace {
// of the longest edge of the box: beyond, neighbor bins and IDs have no numbers
constexpr double SMALLEST_SPACING = 1.0e-9;
}    // namespace

void FixAleisph::parse(int narg, char **arg)
{
  aleisph::KernelType kernel = aleisph::KernelType::CUBIC_SPLINE;
  double h_over_d = 1.2, spacing = 0.0;
  for (int iarg = 3; iarg < narg; iarg += 2) {
    const std::string key = arg[iarg];
    if (iarg + 1 >= narg) utils::missing_cmd_args(FLERR, "fix aleisph " + key, error);
    const char *value = arg[iarg + 1];
    if (key == "spacing") {
      spacing = utils::numeric(FLERR, value, false, lmp);
      if (!(spacing > 0.0) || !std::isfinite(spacing))
        error->all(FLERR, "Fix aleisph: spacing must be positive, not {}", value);
    } else if (key == "kernel") {
      if (!aleisph::Kernel::parse(value, kernel))
        error->all(FLERR, "Fix aleisph: unknown kernel {}, use one of {}", value,
                   aleisph::Kernel::names());
    } else if (key == "h/d") {
      h_over_d = utils::numeric(FLERR, value, false, lmp);
      if (!(h_over_d >= 0.8) || !(h_over_d <= 3.0))
        error->all(FLERR, "Fix aleisph: h/d must lie between 0.8 and 3, not {}", value);
    } else if (key == "rho0") {
      fluid_->rho0 = utils::numeric(FLERR, value, false, lmp);
      if (!(fluid_->rho0 > 0.0) || !std::isfinite(fluid_->rho0))
        error->all(FLERR, "Fix aleisph: rho0 must be positive, not {}", value);
    } else if (key == "fluid") {
      read_fluid_file(value);
    } else
      error->all(FLERR, "Fix aleisph: unknown keyword {}", key);
  }
  if (spacing == 0.0) error->all(FLERR, "Fix aleisph: keyword spacing is required");
  if (fluid_->rho0 == 0.0) error->all(FLERR, "Fix aleisph: keyword rho0 or fluid is required");
  check_scales(spacing);
  cloud_ = std::make_unique<aleisph::Cloud>(
      aleisph::Kernel(kernel, domain->dimension, h_over_d * spacing), spacing, *timers_);
}

// Values that no scene can have, before anything is computed with them
void FixAleisph::check_scales(double spacing) const
{
  double edge = 0.0;
  for (int a = 0; a < domain->dimension; a++) edge = std::max(edge, domain->prd[a]);
  if (spacing > edge || spacing < SMALLEST_SPACING * edge)
    error->all(FLERR,
               "Fix aleisph: spacing {} does not fit a box whose longest edge is {}: it must lie "
               "between {} and 1 of it; look at the units",
               spacing, edge, SMALLEST_SPACING);
  if (!std::isnormal(fluid_->rho0 * std::pow(spacing, domain->dimension)))
    error->all(FLERR, "Fix aleisph: rho0 {} with spacing {} gives a mass that is no number",
               fluid_->rho0, spacing);
}

void FixAleisph::read_fluid_file(const char *filename)
{
  std::string message, units;
  if (comm->me == 0) {
    const std::string path = utils::get_potential_file_path(filename);
    std::ifstream in(path);
    if (!path.empty() && platform::path_is_directory(path)) {
      message = "is a directory";
    } else if (path.empty() || !in) {
      message = "cannot be opened (looked here and in LAMMPS_POTENTIALS)";
    } else {
      units = utils::get_potential_units(path, "fluid property");
      message = aleisph::read_fluid(in, *fluid_);
      if (message.empty() && units.empty())
        message = "names no UNITS in its first line";
      else if (message.empty() && units != update->unit_style)
        message = fmt::format("is in units '{}' but the script uses units {}", units,
                              update->unit_style);
    }
  }
  double values[3] = {fluid_->rho0, fluid_->nu, fluid_->sigma};
  MPI_Bcast(values, 3, MPI_DOUBLE, 0, world);
  *fluid_ = {values[0], values[1], values[2]};

  int length = message.size();
  MPI_Bcast(&length, 1, MPI_INT, 0, world);
  message.resize(length);
  MPI_Bcast(&message[0], length, MPI_CHAR, 0, world);
  if (length) error->all(FLERR, "Fix aleisph: fluid property file {} {}", filename, message);
}
