/* ----------------------------------------------------------------------
   LAMMPS - Large-scale Atomic/Molecular Massively Parallel Simulator
   USER-ALEISPH package
   SPDX-License-Identifier: GPL-2.0-only

   Records of fixes in restart files, and that of the owner
------------------------------------------------------------------------- */

#include "aleisph_halo_record.h"

#include "aleisph_halo_owner.h"
#include "comm.h"
#include "error.h"
#include "fix.h"

#include <limits>
#include <string>
#include <vector>

using namespace LAMMPS_NS;

namespace {

aleisph::Record record_of_owner()
{
  constexpr double MAX = std::numeric_limits<double>::max();
  std::vector<aleisph::Record::Value> values = {{"whether the pressure is known", 0.0, 1.0},
                                                {"the communication cutoff", 0.0, MAX}};
  for (int k = 0; k < AleisphFields::WRITTEN_FIELDS; k++)
    values.push_back({"the writers of a field", 0.0, std::numeric_limits<std::uint32_t>::max()});
  return {"aleisph", 2, values};
}

}    // namespace

void LAMMPS_NS::write_record(std::FILE *fp, const aleisph::Record &record,
                             const std::vector<double> &values)
{
  const std::vector<char> data = record.pack(values);
  const int size = static_cast<int>(data.size());
  std::fwrite(&size, sizeof(int), 1, fp);
  std::fwrite(data.data(), sizeof(char), data.size(), fp);
}

std::vector<double> LAMMPS_NS::read_record(Error *error, const Fix *fix,
                                           const aleisph::Record &record, const char *data)
{
  std::vector<double> values;
  const std::string wrong = record.unpack(data, values);
  if (!wrong.empty())
    error->all(FLERR,
               "Fix {}: the state of fix {} in the restart file {}; to start without "
               "it, give the fix another ID",
               fix->style, fix->id, wrong);
  return values;
}

// of the owner

void FixAleisph::write_restart(FILE *fp)
{
  if (comm->me) return;
  std::vector<double> values = {static_cast<double>(fields_->pressure_known()), own_cutoff_};
  for (const double mark : fields_->writers()) values.push_back(mark);
  write_record(fp, record_of_owner(), values);
}

void FixAleisph::restart(char *buf)
{
  const auto values = read_record(error, this, record_of_owner(), buf);
  fields_->set_pressure_known(values[0] != 0.0);
  own_cutoff_ = values[1];
  fields_->set_writers(&values[2]);
}
