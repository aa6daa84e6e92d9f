/* ----------------------------------------------------------------------
   LAMMPS - Large-scale Atomic/Molecular Massively Parallel Simulator
   USER-ALEISPH package
   SPDX-License-Identifier: GPL-2.0-only
------------------------------------------------------------------------- */

#include "compute_aleisph_atom.h"

#include "aleisph_halo_owner.h"
#include "aleisph_shift.h"
#include "atom.h"
#include "error.h"
#include "memory.h"
#include "update.h"
#include "utils.h"

#include <algorithm>
#include <iterator>

using namespace LAMMPS_NS;

ComputeAleisphAtom::ComputeAleisphAtom(LAMMPS *lmp, int narg, char **arg) :
    Compute(lmp, narg, arg), owner_(nullptr), nmax_(0)
{
  if (narg < 4) utils::missing_cmd_args(FLERR, "compute aleisph/atom", error);
  for (int iarg = 3; iarg < narg; iarg++) {
    Field field;
    if (!parse(arg[iarg], field))
      error->all(FLERR,
                 "Compute aleisph/atom: unknown field {}, use p, divv, lambda, cond, nx, ny, nz, "
                 "row, nneigh, surface, rho, ux, uy, uz, kappa, ptension, tnx, tny, tnz or contact",
                 arg[iarg]);
    fields_.push_back(field);
  }
  peratom_flag = 1;
  size_peratom_cols = fields_.size() == 1 ? 0 : static_cast<int>(fields_.size());
}

ComputeAleisphAtom::~ComputeAleisphAtom()
{
  memory->destroy(vector_atom);
  memory->destroy(array_atom);
}

bool ComputeAleisphAtom::parse(const std::string &word, Field &field)
{
  static const char *const names[] = {"p",     "divv",     "lambda",  "cond", "nx",  "ny",     "nz",
                                      "row",   "nneigh",   "surface", "rho",  "ux",  "uy",     "uz",
                                      "kappa", "ptension", "tnx",     "tny",  "tnz", "contact"};
  const auto found = std::find(std::begin(names), std::end(names), word);
  if (found == std::end(names)) return false;
  field = static_cast<Field>(found - std::begin(names));
  return true;
}

void ComputeAleisphAtom::init()
{
  owner_ = FixAleisph::find(lmp, "Compute aleisph/atom");
}

void ComputeAleisphAtom::compute_peratom()
{
  invoked_peratom = update->ntimestep;
  owner_ = FixAleisph::find(lmp, "Compute aleisph/atom");
  if (!owner_->ready())
    error->all(FLERR,
               "Compute aleisph/atom: no stencil for the present particles; use run 0 first");
  require_tension();
  const int ncols = static_cast<int>(fields_.size());
  if (atom->nmax > nmax_) {
    nmax_ = atom->nmax;
    memory->destroy(vector_atom);
    memory->destroy(array_atom);
    if (ncols == 1)
      memory->create(vector_atom, nmax_, "aleisph/atom:vector_atom");
    else
      memory->create(array_atom, nmax_, ncols, "aleisph/atom:array_atom");
  }
  if (nmax_ == 0) return;
  double *out = ncols == 1 ? vector_atom : &array_atom[0][0];
  for (int c = 0; c < ncols; c++) fill(fields_[c], out + c, ncols);
}

void ComputeAleisphAtom::fill(Field field, double *out, int stride)
{
  if (field == Field::DIVV || field == Field::RHO) {
    const std::vector<double> values = field == Field::DIVV ? divergence() : density();
    aleisph::for_rows(atom->nlocal, [&](int i) {
      out[static_cast<std::size_t>(stride) * i] = atom->mask[i] & groupbit ? values[i] : 0.0;
    });
    return;
  }
  aleisph::for_rows(atom->nlocal, [&](int i) {
    out[static_cast<std::size_t>(stride) * i] = atom->mask[i] & groupbit ? value(field, i) : 0.0;
  });
}

// In a step, curvature and contact lines come after walls and prescribed pressures
void ComputeAleisphAtom::require_tension() const
{
  const auto *tension = owner_->scene().tension();
  if (!tension || tension->ready()) return;
  for (const Field field :
       {Field::KAPPA, Field::PTENSION, Field::TNX, Field::TNY, Field::TNZ, Field::CONTACT})
    if (std::find(fields_.begin(), fields_.end(), field) != fields_.end())
      error->all(FLERR,
                 "Compute aleisph/atom: fix aleisph/tension has not been through this step yet; "
                 "use its fields in output, or in fixes that are defined after it");
}

// 0 elsewhere, 1 on the free surface, 2 ballistic, 3 dry wall
double ComputeAleisphAtom::surface_kind(int i) const
{
  const aleisph::Role role = owner_->cloud().role()[i];
  if (role & aleisph::DRY) return 3.0;
  if (role & aleisph::BALLISTIC) return 2.0;
  return role & aleisph::SURFACE ? 1.0 : 0.0;
}

// numerical density over the nearest neighbours (Morikawa, Tsuji & Asai, eq 19) relative to rho0;
// zero on particles that are not fluid
std::vector<double> ComputeAleisphAtom::density() const
{
  const auto &cloud = owner_->cloud();
  std::vector<double> rho(atom->nlocal, 0.0);
  aleisph::density_deviation(cloud, true, rho.data());
  aleisph::for_rows(cloud.fluid(), [&](int i) { rho[i] += 1.0; });
  return rho;
}

std::vector<double> ComputeAleisphAtom::divergence() const
{
  std::vector<double> div(atom->nlocal, 0.0);
  velocity_divergence(*owner_, div.data());
  return div;
}

double ComputeAleisphAtom::value(Field field, int i)
{
  auto &cloud = owner_->cloud();
  const auto &s = cloud.stencil();
  switch (field) {
    case Field::P: return owner_->fields().pressure().owned()[i];
    case Field::LAMBDA: return cloud.gradient().lambda(i);
    case Field::COND: return cloud.laplacian_rows().condition(i);
    case Field::NX: return cloud.normal()[3 * i];
    case Field::NY: return cloud.normal()[3 * i + 1];
    case Field::NZ: return cloud.normal()[3 * i + 2];
    case Field::NNEIGH: return s.end(i) - s.begin(i);
    case Field::SURFACE: return surface_kind(i);
    case Field::UX:
    case Field::UY:
    case Field::UZ: {
      const double *u = owner_->fields().property("aleisph_u");
      return u ? u[3 * i + static_cast<int>(field) - static_cast<int>(Field::UX)] : 0.0;
    }
    case Field::KAPPA:
    case Field::PTENSION:
    case Field::TNX:
    case Field::TNY:
    case Field::TNZ:
    case Field::CONTACT: return tension_value(field, i);
    default:
      return owner_->fields().row_types().empty()
          ? 0
          : static_cast<int>(owner_->fields().row_types()[i]);
  }
}

// zero if there is no surface tension
double ComputeAleisphAtom::tension_value(Field field, int i) const
{
  const aleisph::SurfaceTension *tension = owner_->scene().tension();
  if (!tension) return 0.0;
  switch (field) {
    case Field::KAPPA: return tension->curvature()[i];
    case Field::PTENSION: return tension->surface_pressure()[i];
    case Field::CONTACT: return tension->contact() ? tension->contact()[4 * i + 3] : 0.0;
    default:
      return tension
          ->surface_normal()[3 * i + static_cast<int>(field) - static_cast<int>(Field::TNX)];
  }
}

double ComputeAleisphAtom::memory_usage()
{
  return sizeof(double) * static_cast<double>(nmax_) * fields_.size();
}
