// SPDX-License-Identifier: GPL-2.0-only
/* ----------------------------------------------------------------------
   Entry point of the plugin: LAMMPS calls lammpsplugin_init() after loading
   aleisphplugin.so, and it registers every style of the package.
------------------------------------------------------------------------- */

#include "lammpsplugin.h"

#include "aleisph_each_style.h"
#include "version.h"

using namespace LAMMPS_NS;

extern "C" void lammpsplugin_init(void *lmp, void *handle, void *regfunc)
{
  auto register_plugin = (lammpsplugin_regfunc) regfunc;

  lammpsplugin_t plugin;
  plugin.version = LAMMPS_VERSION;
  plugin.info = "USER-ALEISPH: incompressible flow by corrected ISPH";
  plugin.author = "the USER-ALEISPH authors";
  plugin.handle = handle;

  // LAMMPS copies the struct and casts the creator back to the type that it has here
  auto add = [&](const char *style, const char *name, auto creator) {
    plugin.style = style;
    plugin.name = name;
    plugin.creator.v2 = (lammpsplugin_factory2 *) creator;
    (*register_plugin)(&plugin, lmp);
  };
  aleisph::each_style(
      [&](const char *name, Modify::FixCreator creator) { add("fix", name, creator); },
      [&](const char *name, Modify::ComputeCreator creator) { add("compute", name, creator); });
}
