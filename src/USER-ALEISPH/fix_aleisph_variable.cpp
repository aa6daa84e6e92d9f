/* ----------------------------------------------------------------------
   LAMMPS - Large-scale Atomic/Molecular Massively Parallel Simulator
   USER-ALEISPH package
   SPDX-License-Identifier: GPL-2.0-only
------------------------------------------------------------------------- */

#include "aleisph_halo_variable.h"

#include "atom.h"
#include "error.h"
#include "fmt/format.h"
#include "input.h"
#include "lammps.h"
#include "modify.h"
#include "update.h"
#include "utils.h"
#include "variable.h"

using namespace LAMMPS_NS;

AleisphVariable::Evaluation::Evaluation(LAMMPS *lmp, bool active) : lmp_(active ? lmp : nullptr)
{
  if (lmp_) lmp_->modify->clearstep_compute();
}

AleisphVariable::Evaluation::~Evaluation()
{
  if (lmp_) lmp_->modify->addstep_compute(lmp_->update->ntimestep + 1);
}

AleisphVariable::AleisphVariable(LAMMPS *lmp, const std::string &caller, const std::string &what,
                                 Kind kind, const std::string &word) :
    Pointers(lmp),
    caller_(caller), what_(what), kind_(kind), value_(0.0)
{
  if (utils::strmatch(word, "^v_"))
    name_ = word.substr(2);
  else
    value_ = utils::numeric(FLERR, word, false, lmp);
}

int AleisphVariable::find() const
{
  const int index = input->variable->find(name_.c_str());
  if (index < 0) return -1;
  if (input->variable->equalstyle(index)) return index;
  return kind_ == Kind::EQUAL_OR_ATOM && input->variable->atomstyle(index) ? index : -1;
}

void AleisphVariable::check() const
{
  if (constant() || find() >= 0) return;
  error->all(FLERR, "{}: {} is not an {} variable; {} needs one of this name", caller_, name_,
             kind_ == Kind::EQUAL ? "equal-style" : "equal- or atom-style", what_);
}

std::string AleisphVariable::text() const
{
  return constant() ? fmt::format("{}", value_) : "v_" + name_;
}

double AleisphVariable::equal() const
{
  if (constant()) return value_;
  check();    // it may have been redefined or deleted since init()
  return input->variable->compute_equal(find());
}

void AleisphVariable::evaluate(int igroup, std::vector<double> &values) const
{
  values.assign(atom->nlocal, value_);
  if (constant()) return;
  check();
  const int index = find();
  if (input->variable->equalstyle(index))
    values.assign(atom->nlocal, input->variable->compute_equal(index));
  else
    input->variable->compute_atom(index, igroup, values.data(), 1, 0);
}
