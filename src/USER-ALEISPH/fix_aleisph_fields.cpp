/* ----------------------------------------------------------------------
   LAMMPS - Large-scale Atomic/Molecular Massively Parallel Simulator
   USER-ALEISPH package
   SPDX-License-Identifier: GPL-2.0-only
------------------------------------------------------------------------- */

#include "aleisph_halo_fields.h"

#include "atom.h"
#include "fmt/format.h"
#include "modify.h"

using namespace LAMMPS_NS;

namespace {

constexpr char PRESSURE[] = "aleisph_p";

// a custom property and the fix that keeps it
struct Property {
  const char *fix, *definition;
};
constexpr Property PROPERTIES[] = {
    {"ALEISPH_P", "d_aleisph_p ghost yes"},
    {"ALEISPH_VW", "d2_aleisph_vw 3"},
    {"ALEISPH_N", "d2_aleisph_n 4"},
};

}    // namespace

void AleisphFields::add_properties()
{
  for (const Property &p : PROPERTIES)
    modify->add_fix(fmt::format("{} all property/atom {} writedata no", p.fix, p.definition));
}

void AleisphFields::delete_properties()
{
  if (!modify) return;
  for (const Property &p : PROPERTIES)
    if (modify->get_fix_by_id(p.fix)) modify->delete_fix(p.fix);
}

void AleisphFields::expire()
{
  pressure_valid_ = velocity_valid_ = predicted_valid_ = false;
}

void AleisphFields::reset(int n)
{
  expire();
  predicted_.assign(3 * static_cast<std::size_t>(n), 0.0);
  row_types_.clear();
}

aleisph::Field AleisphFields::pressure()
{
  int flag, cols;
  return {atom->dvector[atom->find_custom(PRESSURE, flag, cols)], 1, pressure_valid_};
}

aleisph::Field AleisphFields::velocity()
{
  return {atom->nmax ? &atom->v[0][0] : nullptr, 3, velocity_valid_};
}

double *AleisphFields::property(const std::string &name) const
{
  int flag, cols;
  const int index = atom->find_custom(name.c_str(), flag, cols);
  if (index < 0 || atom->nmax == 0) return nullptr;
  return &atom->darray[index][0][0];
}

double AleisphFields::bytes() const
{
  return static_cast<double>(sizeof(double)) * predicted_.capacity() + row_types_.capacity();
}
