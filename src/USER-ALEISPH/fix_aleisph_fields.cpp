/* ----------------------------------------------------------------------
   LAMMPS - Large-scale Atomic/Molecular Massively Parallel Simulator
   USER-ALEISPH package
   SPDX-License-Identifier: GPL-2.0-only
------------------------------------------------------------------------- */

#include "aleisph_halo_fields.h"

#include "aleisph_mpi_ranks.h"
#include "aleisph_record.h"
#include "atom.h"
#include "domain.h"
#include "error.h"
#include "fmt/format.h"
#include "modify.h"
#include "update.h"

#include <algorithm>
#include <cmath>

using namespace LAMMPS_NS;

namespace {

constexpr char PRESSURE[] = "aleisph_p", GIVEN_BACK[] = "aleisph_gb";

// a custom property and the fix that keeps it
struct Property {
  const char *fix, *definition;
};
constexpr Property PROPERTIES[] = {
    {"ALEISPH_P", "d_aleisph_p ghost yes"}, {"ALEISPH_VW", "d2_aleisph_vw 3"},
    {"ALEISPH_N", "d2_aleisph_n 4"},        {"ALEISPH_GP", "d2_aleisph_gp 4"},
    {"ALEISPH_GB", "d_aleisph_gb"},
};

// those that more than one fix may write, or that keep what depends on who does
constexpr const char *WRITTEN[AleisphFields::WRITTEN_FIELDS] = {"aleisph_u", "aleisph_n"};

// all that are kept with the particles, if the script has a fix that asks for them
constexpr const char *KEPT[] = {"aleisph_p", "aleisph_vw", "aleisph_n", "aleisph_gp", "aleisph_gb",
                                "aleisph_u", "aleisph_a",  "aleisph_w", "aleisph_dv",
                                "aleisph_s"};

bool all_finite(const double *values, int n)
{
  return std::all_of(values, values + n, [](double value) { return std::isfinite(value); });
}

}    // namespace

void AleisphFields::forget_writers()
{
  writers_.clear();
}

void AleisphFields::add_writer(const std::string &field, const std::string &writer)
{
  writers_[field] += writer + "\n";
}

void AleisphFields::settle()
{
  kept_.clear();
  for (const std::string field : WRITTEN) {
    const std::string &now = writers_[field];
    // 32 bits: a double of a restart record holds them. No writers: 0
    const auto mark = now.empty()
        ? 0
        : static_cast<std::uint32_t>(aleisph::checksum(now.data(), now.size()));
    const auto before = owned_by_.find(field);
    if (mark != 0 && before != owned_by_.end() && before->second == mark)
      kept_.insert(field);
    else
      clear(field);
    owned_by_[field] = mark;
  }
}

void AleisphFields::clear(const std::string &field)
{
  int flag, cols;
  const int index = atom->find_custom(field.c_str(), flag, cols);
  if (index < 0 || atom->nmax == 0) return;
  std::fill_n(&atom->darray[index][0][0], static_cast<std::size_t>(cols) * atom->nmax, 0.0);
}

std::vector<double> AleisphFields::writers() const
{
  std::vector<double> marks;
  for (const char *field : WRITTEN) {
    const auto found = owned_by_.find(field);
    marks.push_back(found == owned_by_.end() ? 0.0 : found->second);
  }
  return marks;
}

void AleisphFields::set_writers(const double *writers)
{
  for (int k = 0; k < WRITTEN_FIELDS; k++)
    owned_by_[WRITTEN[k]] = static_cast<std::uint32_t>(writers[k]);
}

template <class Predicate> tagint AleisphFields::violating(Predicate holds) const
{
  const tagint mine = aleisph::max_rows(
      atom->nlocal, [&](int i) { return holds(i) ? 0 : atom->tag[i]; }, tagint(0));
  return static_cast<tagint>(ranks_.largest(mine));
}

void AleisphFields::check_kept() const
{
  for (const char *field : KEPT) {
    int flag, cols;
    const int index = atom->find_custom(field, flag, cols);
    if (index < 0) continue;
    const tagint bad = violating([&](int i) {
      const double *values = cols ? atom->darray[index][i] : &atom->dvector[index][i];
      return all_finite(values, std::max(cols, 1));
    });
    if (bad)
      error->all(FLERR,
                 "Fix aleisph: property {}_{} of atom {} is not finite; it came from a file or a "
                 "set command: set it to 0",
                 cols ? "d2" : "d", field, bad);
  }
}

void AleisphFields::require_finite(const double *v, const std::string &caller,
                                   const std::string &what) const
{
  const int dim = domain->dimension;
  const tagint bad = violating([v, dim](int i) { return all_finite(v + 3 * i, dim); });
  if (bad)
    error->all(FLERR, "{}: {} of atom {} is not finite at step {}", caller, what, bad,
               update->ntimestep);
}

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
  layout_.type.clear();
}

aleisph::Field AleisphFields::pressure()
{
  int flag, cols;
  return {atom->dvector[atom->find_custom(PRESSURE, flag, cols)], 1, pressure_valid_};
}

double *AleisphFields::given_back() const
{
  int flag, cols;
  return atom->dvector[atom->find_custom(GIVEN_BACK, flag, cols)];
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
  return static_cast<double>(sizeof(double)) * (predicted_.capacity() + layout_.alpha.capacity()) +
      layout_.type.capacity();
}
