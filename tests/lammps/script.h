// SPDX-License-Identifier: GPL-2.0-only
/* ----------------------------------------------------------------------
   The fixes of a test case in the order that they must have. A test
   changes the lines that it is about.
------------------------------------------------------------------------- */

#ifndef LMP_ALEISPH_TEST_SCRIPT_H
#define LMP_ALEISPH_TEST_SCRIPT_H

#include "fmt/format.h"
#include "scene.h"

#include <string>

struct Script {
  std::string owner, wall, body, pressure, surface, predictor, ppe, shift, guard, timestep, dt;

  std::string text() const
  {
    std::string all;
    for (const auto *line : {&owner, &wall, &body, &pressure, &surface, &predictor, &ppe, &shift,
                             &guard, &timestep, &dt})
      if (!line->empty()) all += *line + "\n";
    return all;
  }
};

// Lagrangian and inviscid, without body force; walls if the scene has them
inline Script script_of(const Scene &scene)
{
  Script s;
  s.owner = fmt::format("fix sph all aleisph spacing {} rho0 {}", scene.d, scene.rho0);
  for (const int type : scene.type)
    if (type == Scene::WALL) s.wall = "fix wall wall aleisph/wall";
  s.predictor = "fix pred fluid aleisph/predictor";
  s.ppe = "fix ppe all aleisph/ppe tol 1e-12";
  return s;
}

// particles that are shifted
inline Script shifted_script(const Scene &scene, const std::string &shift)
{
  Script s = script_of(scene);
  s.predictor += " frame ale";
  s.shift = "fix shift fluid aleisph/shift " + shift;
  return s;
}

// the same with a free surface
inline Script free_script(const Scene &scene, const std::string &shift = "density velocity 1.0")
{
  Script s = shifted_script(scene, shift);
  s.surface = "fix surf fluid aleisph/surface";
  return s;
}

#endif
