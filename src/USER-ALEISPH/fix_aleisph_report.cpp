/* ----------------------------------------------------------------------
   LAMMPS - Large-scale Atomic/Molecular Massively Parallel Simulator
   USER-ALEISPH package
   SPDX-License-Identifier: GPL-2.0-only

   The owner's report after a run: where the time went, what was built how
   often, what was exchanged with other ranks.

   LAMMPS calls Fix::post_run() between the last line of thermo output and
   "Loop time", where programs that read logs expect lines of numbers only,
   and calls no fix after that. So post_run() only stores the text. It
   is printed when the next run is set up or the fix goes, which is at the
   end of the script at the latest.
------------------------------------------------------------------------- */

#include "fix_aleisph.h"

#include "aleisph_halo_owner.h"
#include "atom.h"
#include "comm.h"
#include "error.h"
#include "input.h"
#include "update.h"
#include "utils.h"

#include <algorithm>
#include <cstring>

using namespace LAMMPS_NS;
using aleisph::Part;

namespace {

// The keyword post of the command that is being executed, if that is a run; a run with interleaved
// commands ("every") executes them in between, so that the value of before stays in force.
bool post_keyword(LAMMPS *lmp, bool before)
{
  const Input *input = lmp->input;
  if (!input || !input->command || strcmp(input->command, "run") != 0) return before;
  bool post = true;
  for (int i = 1; i + 1 < input->narg; i++) {
    if (strcmp(input->arg[i], "every") == 0) break;    // what follows are commands
    if (strcmp(input->arg[i], "post") == 0)
      post = utils::logical(FLERR, input->arg[i + 1], false, lmp);
  }
  return post;
}

}    // namespace

int FixAleisph::modify_param(int narg, char **arg)
{
  if (strcmp(arg[0], "report") != 0) return 0;
  if (narg < 2) utils::missing_cmd_args(FLERR, "fix_modify report", error);
  if (strcmp(arg[1], "now") == 0) {
    print_report();
    return 2;
  }
  report_.wanted = utils::logical(FLERR, arg[1], false, lmp);
  if (!report_.wanted) report_.text.clear();
  return 2;
}

void FixAleisph::begin_report()
{
  timers_->reset();
  ranks_->traffic() = aleisph::Traffic();
  report_.post = post_keyword(lmp, report_.post);
}

// run ... pre no does not come through init(): the reports of such runs are printed together
void FixAleisph::post_run()
{
  report_.post = post_keyword(lmp, report_.post);
  if (report_.wanted && report_.post)
    report_.text += time_report() + build_report() + traffic_report() + guard_report();
  begin_report();
}

// without communication: also in the destructor
void FixAleisph::print_report()
{
  if (!report_.text.empty() && comm->me == 0) utils::logmesg(lmp, report_.text);
  report_.text.clear();
}

std::string FixAleisph::time_report() const
{
  double seconds[aleisph::NUM_PARTS];
  double total = 0.0;
  for (int k = 1; k < aleisph::NUM_PARTS; k++)
    seconds[k] = timers_->seconds(static_cast<Part>(k)) / comm->nprocs;
  MPI_Allreduce(MPI_IN_PLACE, seconds + 1, aleisph::NUM_PARTS - 1, MPI_DOUBLE, MPI_SUM, world);
  for (int k = 1; k < aleisph::NUM_PARTS; k++) total += seconds[k];

  const double steps = static_cast<double>(std::max<bigint>(1, update->nsteps));
  const double particle_steps = steps * std::max<bigint>(1, atom->natoms) / comm->nprocs;
  std::string text = fmt::format(
      "\nALEISPH time: {:.4g} s for {} steps to step {}, {:.4g} us per particle-step "
      "and rank\n",
      total, update->nsteps, update->ntimestep, 1.0e6 * total / particle_steps);
  for (int k = 1; k < aleisph::NUM_PARTS; k++)
    if (seconds[k] > 0.0)
      text += fmt::format("  {:<15}{:>10.4g} s {:>6.1f} %\n", to_string(static_cast<Part>(k)),
                          seconds[k], total > 0.0 ? 100.0 * seconds[k] / total : 0.0);
  return text;
}

std::string FixAleisph::build_report() const
{
  const auto &counts = cloud_->counts();
  return fmt::format("ALEISPH builds: stencil {}, gradient {}, Laplacian {}, PPE matrix {}, "
                     "preconditioner {}, viscous matrix {}, viscous passes {}, wall passes {}\n",
                     counts.stencil, counts.gradient, counts.laplacian, tally_.ppe_builds,
                     tally_.precond_builds, tally_.viscous_builds, tally_.viscous_passes,
                     tally_.wall_passes);
}

std::string FixAleisph::traffic_report() const
{
  const aleisph::Traffic mean = ranks_->mean_traffic();
  const double steps = static_cast<double>(std::max<bigint>(1, update->nsteps));
  return fmt::format("ALEISPH communication per step: {:.4g} reductions, {:.4g} halo exchanges, "
                     "{:.4g} messages, {:.4g} bytes per rank\n",
                     mean.reductions / steps, mean.exchanges / steps, mean.messages / steps,
                     mean.bytes / steps);
}

std::string FixAleisph::guard_report() const
{
  const long morris = cloud_->counts().laplacian
      ? ranks_->sum(cloud_->laplacian_rows().morris_count().total())
      : 0;
  const long singular = ranks_->sum(tally_.singular_rows),
             pivots = ranks_->sum(tally_.replaced_pivots);
  if (!morris && !singular && !pivots) return "";
  return fmt::format("ALEISPH guards in the last step: {} rows of Morris, {} singular rows, {} "
                     "replaced pivots\n",
                     morris, singular, pivots);
}
