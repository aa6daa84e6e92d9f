/* ----------------------------------------------------------------------
   LAMMPS - Large-scale Atomic/Molecular Massively Parallel Simulator
   USER-ALEISPH package
   SPDX-License-Identifier: GPL-2.0-only
------------------------------------------------------------------------- */

#include "compute_aleisph_exact.h"

#include "aleisph_exact.h"
#include "aleisph_rows.h"
#include "atom.h"
#include "error.h"
#include "memory.h"
#include "update.h"
#include "utils.h"

#include <cmath>
#include <cstring>
#include <map>

using namespace LAMMPS_NS;
namespace exact = aleisph::exact;

namespace {

constexpr int NCOLUMNS = 4;

void store(const exact::Flow2d &flow, double *out)
{
  out[0] = flow.u;
  out[1] = flow.v;
  out[3] = flow.p;
}

struct Case {
  int nargs;
  const char *positive;    // a + for each argument that must be positive
  std::function<std::function<void(const double *, double, double *)>(const double *)> make;
};

const std::map<std::string, Case> &cases()
{
  static const std::map<std::string, Case> table = {
      {"pipe",
       {3, "+.+",
        [](const double *p) {
          const double R = p[0], G = p[1], nu = p[2];
          return [=](const double *x, double t, double *out) {
            out[0] = exact::pipe_poiseuille(std::hypot(x[1], x[2]), t, R, G, nu);
          };
        }}},
      {"plane",
       {3, "+.+",
        [](const double *p) {
          const double H = p[0], G = p[1], nu = p[2];
          return [=](const double *x, double t, double *out) {
            out[0] = exact::plane_poiseuille(x[1], t, H, G, nu);
          };
        }}},
      {"couette",
       {3, "+.+",
        [](const double *p) {
          const double H = p[0], U = p[1], nu = p[2];
          return [=](const double *x, double t, double *out) {
            out[0] = exact::couette(x[1], t, H, U, nu);
          };
        }}},
      {"taylor-green",
       {4, "+.+.",
        [](const double *p) {
          const double L = p[0], U = p[1], rho = p[2], nu = p[3];
          return [=](const double *x, double t, double *out) {
            store(exact::taylor_green({x[0], x[1], t}, L, U, rho, nu), out);
          };
        }}},
      {"stokes",
       {5, "++.++",
        [](const double *p) {
          const double Lx = p[0], H = p[1], U = p[2], rho = p[3], nu = p[4];
          return [=](const double *x, double t, double *out) {
            store(exact::stokes_mode({x[0], x[1], t}, Lx, H, U, rho, nu), out);
          };
        }}},
  };
  return table;
}

}    // namespace

ComputeAleisphExact::ComputeAleisphExact(LAMMPS *lmp, int narg, char **arg) :
    Compute(lmp, narg, arg), steady_(false), nmax_(0)
{
  if (narg < 4) utils::missing_cmd_args(FLERR, "compute aleisph/exact", error);
  const auto found = cases().find(arg[3]);
  if (found == cases().end())
    error->all(FLERR,
               "Compute aleisph/exact: unknown case {}, use pipe, plane, couette, taylor-green or "
               "stokes",
               arg[3]);
  const int nargs = found->second.nargs;
  if (narg < 4 + nargs)
    utils::missing_cmd_args(FLERR, std::string("compute aleisph/exact ") + arg[3], error);
  double parameter[5];
  for (int k = 0; k < nargs; k++) {
    parameter[k] = utils::numeric(FLERR, arg[4 + k], false, lmp);
    if (!std::isfinite(parameter[k]))
      error->all(FLERR, "Compute aleisph/exact: parameter {} is not finite", arg[4 + k]);
    if (found->second.positive[k] == '+' && !(parameter[k] > 0.0))
      error->all(FLERR, "Compute aleisph/exact: parameter {} of case {} must be positive, not {}",
                 k + 1, arg[3], arg[4 + k]);
  }
  if (narg == 5 + nargs && strcmp(arg[4 + nargs], "steady") == 0)
    steady_ = true;
  else if (narg > 4 + nargs)
    error->all(FLERR, "Compute aleisph/exact: unknown keyword {}", arg[4 + nargs]);
  if (steady_ && nargs != 3)
    error->all(FLERR, "Compute aleisph/exact: case {} has no steady state", arg[3]);

  solution_ = found->second.make(parameter);
  peratom_flag = 1;
  size_peratom_cols = NCOLUMNS;
}

ComputeAleisphExact::~ComputeAleisphExact()
{
  memory->destroy(array_atom);
}

void ComputeAleisphExact::compute_peratom()
{
  invoked_peratom = update->ntimestep;
  if (atom->nmax > nmax_) {
    nmax_ = atom->nmax;
    memory->destroy(array_atom);
    memory->create(array_atom, nmax_, NCOLUMNS, "aleisph/exact:array_atom");
  }
  const double now = update->atime + (update->ntimestep - update->atimestep) * update->dt;
  const double t = steady_ ? -1.0 : now;
  aleisph::for_rows(atom->nlocal, [&](int i) {
    std::fill(array_atom[i], array_atom[i] + NCOLUMNS, 0.0);
    if (atom->mask[i] & groupbit) solution_(atom->x[i], t, array_atom[i]);
  });
}

double ComputeAleisphExact::memory_usage()
{
  return sizeof(double) * static_cast<double>(nmax_) * NCOLUMNS;
}
