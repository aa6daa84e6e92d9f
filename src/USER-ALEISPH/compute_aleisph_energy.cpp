/* ----------------------------------------------------------------------
   LAMMPS - Large-scale Atomic/Molecular Massively Parallel Simulator
   USER-ALEISPH package
   SPDX-License-Identifier: GPL-2.0-only
------------------------------------------------------------------------- */

#include "compute_aleisph_energy.h"

#include "aleisph_halo_owner.h"
#include "aleisph_surface_area.h"
#include "atom.h"
#include "domain.h"
#include "error.h"
#include "update.h"
#include "utils.h"

#include <algorithm>
#include <cmath>
#include <limits>

using namespace LAMMPS_NS;

namespace {

// of a component of a unit vector, or of a cosine: the same but for rounding
constexpr double SAME = 1.0e-6;

}    // namespace

ComputeAleisphEnergy::ComputeAleisphEnergy(LAMMPS *lmp, int narg, char **arg) :
    Compute(lmp, narg, arg), gravity_{0.0, 0.0, 0.0}, origin_{0.0, 0.0, 0.0}, surface_(true),
    owner_(nullptr)
{
  parse(narg, arg);
  scalar_flag = vector_flag = 1;
  size_vector = NUM_PARTS;
  extscalar = extvector = 1;
  vector = new double[NUM_PARTS];
}

ComputeAleisphEnergy::~ComputeAleisphEnergy()
{
  delete[] vector;
}

void ComputeAleisphEnergy::parse(int narg, char **arg)
{
  for (int iarg = 3; iarg < narg;) {
    const std::string key = arg[iarg];
    const int count = key == "surface" ? 1 : 3;
    if (key != "gravity" && key != "origin" && key != "surface")
      error->all(FLERR,
                 "Compute aleisph/energy: unknown keyword {}, use gravity, origin or surface", key);
    if (iarg + count >= narg)
      utils::missing_cmd_args(FLERR, "compute aleisph/energy " + key, error);
    if (key == "surface") {
      surface_ = utils::logical(FLERR, arg[iarg + 1], false, lmp);
    } else {
      double *value = key == "gravity" ? gravity_ : origin_;
      for (int a = 0; a < 3; a++) value[a] = utils::numeric(FLERR, arg[iarg + 1 + a], false, lmp);
    }
    iarg += 1 + count;
  }
  if (domain->dimension == 2 && gravity_[2] != 0.0)
    error->all(FLERR, "Compute aleisph/energy: gravity along z must be 0 in 2d, it is {}",
               gravity_[2]);
}

void ComputeAleisphEnergy::init()
{
  owner_ = FixAleisph::find(lmp, "Compute aleisph/energy");
}

double ComputeAleisphEnergy::compute_scalar()
{
  if (invoked_vector != update->ntimestep) compute_vector();
  invoked_scalar = update->ntimestep;
  scalar = 0.0;
  for (int k = 0; k < NUM_PARTS; k++) scalar += vector[k];
  return scalar;
}

void ComputeAleisphEnergy::compute_vector()
{
  invoked_vector = update->ntimestep;
  owner_ = FixAleisph::find(lmp, "Compute aleisph/energy");
  if (!owner_->ready())
    error->all(FLERR,
               "Compute aleisph/energy: no stencil for the present particles; use run 0 first");
  std::fill_n(vector, static_cast<int>(NUM_PARTS), 0.0);
  add_particles(vector);
  owner_->ranks().sum(NUM_PARTS, vector);
  if (surface_ && owner_->scene().tension()) vector[SURFACE] = surface_energy();
}

// Positions are not wrapped into the box: along a periodic axis the potential goes on.
void ComputeAleisphEnergy::add_particles(double *mine) const
{
  const double m = particle_mass(*owner_);
  const aleisph::Rows rows = aleisph::select_rows(
      owner_->cloud().fluid(), [this](int i) { return atom->mask[i] & groupbit; });
  mine[KINETIC] += aleisph::sum_rows(rows, [&](int i) {
    const double *v = atom->v[i];
    return 0.5 * m * (v[0] * v[0] + v[1] * v[1] + v[2] * v[2]);
  });
  mine[POTENTIAL] -= aleisph::sum_rows(rows, [&](int i) {
    double x[3], energy = 0.0;
    domain->unmap(atom->x[i], atom->image[i], x);
    for (int a = 0; a < 3; a++) energy += m * gravity_[a] * (x[a] - origin_[a]);
    return energy;
  });
}

/* ----------------------------------------------------------------------
   sigma times the free surface, minus sigma cos(theta) times the wall under
   the fluid, which is an energy of the wall: by Young's equation the tension
   of a wet wall is less than that of a dry one by sigma cos(theta).
------------------------------------------------------------------------- */

double ComputeAleisphEnergy::surface_energy() const
{
  const aleisph::SurfaceTension &tension = *owner_->scene().tension();
  const auto &cloud = owner_->cloud();
  const auto mine = aleisph::surface_area(
      cloud, {tension.surface_normal(), tension.curvature(), tension.contact()});
  double sums[4] = {mine.area, mine.vector[0], mine.vector[1], mine.vector[2]};
  owner_->ranks().sum(4, sums);
  double wall[4] = {0.0, 0.0, 0.0, 0.0};    // normal, cos(theta)
  if (tension.contact_cosine()) check_walls(tension.contact_cosine(), wall);
  const double wet = wall[0] * sums[1] + wall[1] * sums[2] + wall[2] * sums[3];
  return tension.sigma() * (sums[0] - wall[3] * wet);
}

// The normal and cosine that all walls have that attract or repel the fluid, zero if none does.
// Which part of several walls is wet is not known well enough: dry particles have no neighbors.
void ComputeAleisphEnergy::check_walls(const double *cosine, double *wall) const
{
  const auto &cloud = owner_->cloud();
  constexpr double NONE = -std::numeric_limits<double>::max();
  double largest[8];    // of normal and cosine, and of their negatives
  std::fill_n(largest, 8, NONE);
  const aleisph::Rows rows = aleisph::select_rows(cloud.owned(), [&](int i) {
    const double *n = cloud.normal() + 3 * i;
    const bool found = n[0] != 0.0 || n[1] != 0.0 || n[2] != 0.0;
    return (cloud.role()[i] & aleisph::WALL) && std::fabs(cosine[i]) >= SAME && found;
  });
  for (int k = 0; k < 4; k++) {
    const auto value = [&](int i) { return k < 3 ? cloud.normal()[3 * i + k] : cosine[i]; };
    largest[k] = aleisph::max_rows(rows, value, NONE);
    largest[4 + k] = aleisph::max_rows(
        rows, [&](int i) { return -value(i); }, NONE);
  }
  for (double &value : largest) value = owner_->ranks().max(value);
  if (largest[3] == NONE) return;
  for (int k = 0; k < 4; k++) {
    if (largest[k] + largest[4 + k] > SAME)
      error->all(FLERR,
                 "Compute aleisph/energy: the surface energy is known only for contact angles of "
                 "90 degrees and for walls of one plane with one angle; use keyword surface no");
    wall[k] = largest[k];
  }
}
