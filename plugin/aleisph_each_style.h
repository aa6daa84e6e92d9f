// SPDX-License-Identifier: GPL-2.0-only
/* ----------------------------------------------------------------------
   All styles of the package with their names, taken from the FixStyle and
   ComputeStyle macros of their headers. Used by the plugin and by the tests.
------------------------------------------------------------------------- */

#ifndef LMP_ALEISPH_EACH_STYLE_H
#define LMP_ALEISPH_EACH_STYLE_H

#include "aleisph_style_headers.h"
#include "modify.h"

namespace aleisph {

// Calls on_fix(name, creator) and on_compute(name, creator) for every style; the names are string
// literals, the creators are what Modify::fix_map and Modify::compute_map hold.
template <class OnFix, class OnCompute> void each_style(OnFix on_fix, OnCompute on_compute)
{
  using namespace LAMMPS_NS;

#define FIX_CLASS
#define FixStyle(key, Class) \
  on_fix(#key, [](LAMMPS *lmp, int narg, char **arg) -> Fix * { return new Class(lmp, narg, arg); })
#include "aleisph_style_headers.h"
#undef FixStyle
#undef FIX_CLASS

#define COMPUTE_CLASS
#define ComputeStyle(key, Class)                                        \
  on_compute(#key, [](LAMMPS *lmp, int narg, char **arg) -> Compute * { \
    return new Class(lmp, narg, arg);                                   \
  })
#include "aleisph_style_headers.h"
#undef ComputeStyle
#undef COMPUTE_CLASS
}

}    // namespace aleisph
#endif
