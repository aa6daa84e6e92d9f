/* ----------------------------------------------------------------------
   LAMMPS - Large-scale Atomic/Molecular Massively Parallel Simulator
   USER-ALEISPH package
   SPDX-License-Identifier: GPL-2.0-only

   The command of fix aleisph/shift
------------------------------------------------------------------------- */

#include "fix_aleisph_shift.h"

#include "aleisph_halo_variable.h"
#include "aleisph_shift.h"
#include "error.h"
#include "utils.h"

#include <cmath>

using namespace LAMMPS_NS;
using aleisph::ShiftModel;

namespace {

// rates of the accurate variant, per U dt/d
constexpr double SMOOTHING = 1.5, FILTER = 3.0;
constexpr double STEP_PUBLISHED = 0.005;    // C of the paper, whatever the time step
// Beyond, a value is a slip of the pen: all act in full long before, or reach past the support.
constexpr double MAX_RATE = 1.0e4, MAX_DISTANCE = 10.0;    // per U dt/d; in spacings

}    // namespace

void FixAleisphShift::parse(int narg, char **arg)
{
  if (narg < 4) utils::missing_cmd_args(FLERR, "fix aleisph/shift", error);
  const std::string model = arg[3];
  if (model == "density")
    params_->model = ShiftModel::DENSITY;
  else if (model == "ops")
    params_->model = ShiftModel::OPS;
  else if (model == "fickian")
    params_->model = ShiftModel::FICKIAN;
  else if (model == "tvf")
    params_->model = ShiftModel::TVF;
  else
    error->all(FLERR, "Fix aleisph/shift: model must be density, ops, fickian or tvf, not {}",
               model);

  std::set<std::string> words;
  for (int iarg = 4; iarg < narg; iarg += 2) {
    const std::string key = arg[iarg];
    words.insert(key);
    if (iarg + 1 >= narg) utils::missing_cmd_args(FLERR, "fix aleisph/shift " + key, error);
    const std::string value = arg[iarg + 1];
    const auto positive = [&]() {
      const double x = utils::numeric(FLERR, value, false, lmp);
      if (!(x >= 0.0) || !std::isfinite(x))
        error->all(FLERR, "Fix aleisph/shift: {} must not be negative, it is {}", key, value);
      return x;
    };
    const auto at_most = [&](double most) {
      const double x = positive();
      if (x > most)
        error->all(FLERR, "Fix aleisph/shift: {} must be at most {}, it is {}", key, most, value);
      return x;
    };
    const auto first_of = [&](const char *first, const char *second) {
      if (value != first && value != second)
        error->all(FLERR, "Fix aleisph/shift: {} must be {} or {}, not {}", key, first, second,
                   value);
      return value == first;
    };
    if (key == "variant") {
      params_->published = !first_of("accurate", "published");
    } else if (key == "rate") {
      rate_ = at_most(MAX_RATE);
    } else if (key == "step") {
      step_ = at_most(MAX_RATE);
    } else if (key == "velocity") {
      velocity_.reset();
      of_.clear();
      if (value == "max" || value == "head" || value == "strain") {
        of_ = value;
      } else {
        if (!utils::strmatch(value, "^v_")) positive();
        velocity_ = std::make_unique<AleisphVariable>(lmp, "Fix aleisph/shift", "keyword velocity",
                                                      AleisphVariable::Kind::EQUAL, value);
      }
    } else if (key == "surface") {
      params_->positive_surface = !first_of("full", "positive");
    } else if (key == "pair") {
      params_->printed_pair = first_of("printed", "symmetric");
    } else if (key == "normal") {
      eigenvalue_normal_ = first_of("lambda", "color");
    } else if (key == "smoothing") {
      smoothing_ = at_most(MAX_RATE);
    } else if (key == "filter") {
      filter_ = at_most(MAX_RATE);
    } else if (key == "walls") {
      params_->wall_distance = at_most(MAX_DISTANCE);
    } else if (key == "limit") {
      params_->limit = at_most(MAX_DISTANCE);
    } else
      error->all(FLERR, "Fix aleisph/shift: unknown keyword {}", key);
  }
  check_keywords(words);
  set_defaults(words);
}

void FixAleisphShift::set_defaults(const std::set<std::string> &words)
{
  const bool accurate = params_->model == ShiftModel::DENSITY && !params_->published;
  if (smoothing_ < 0.0) smoothing_ = accurate ? SMOOTHING : 0.0;
  if (filter_ < 0.0) filter_ = accurate ? FILTER : 0.0;
  if (accurate && !words.count("velocity")) of_ = "strain";
  if (!params_->published) return;
  if (!words.count("pair")) params_->printed_pair = true;
  if (!words.count("normal")) eigenvalue_normal_ = true;
  if (!words.count("walls")) params_->wall_distance = 0.0;
  if (rate_ < 0.0 && step_ < 0.0) step_ = STEP_PUBLISHED;
}

// what would have no effect is not taken silently
void FixAleisphShift::check_keywords(const std::set<std::string> &words) const
{
  const bool density = params_->model == ShiftModel::DENSITY;
  for (const char *key : {"variant", "surface"})
    if (words.count(key) && !density)
      error->all(FLERR, "Fix aleisph/shift: keyword {} needs model density", key);
  for (const char *key : {"smoothing", "filter"})
    if (words.count(key) && (!density || params_->published))
      error->all(FLERR, "Fix aleisph/shift: keyword {} needs model density, variant accurate", key);
  for (const char *key : {"pair", "normal"})
    if (words.count(key) && !params_->published)
      error->all(FLERR, "Fix aleisph/shift: keyword {} needs model density, variant published",
                 key);
  if (of_ == "strain" && (!density || params_->published))
    error->all(FLERR,
               "Fix aleisph/shift: velocity strain needs model density, variant accurate; use a "
               "number, max or head");
  if (words.count("rate") && words.count("step"))
    error->all(FLERR, "Fix aleisph/shift: use either keyword rate or keyword step");
}
