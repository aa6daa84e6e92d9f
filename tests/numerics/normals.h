// SPDX-License-Identifier: GPL-2.0-only
// Wall normals of a scene, found as the owner does it: in sweeps over what is not known yet

#ifndef ALEISPH_TEST_NORMALS_H
#define ALEISPH_TEST_NORMALS_H

#include "aleisph_wall_normals.h"
#include "scenes.h"

#include <string>

namespace aleisph_test {

// A few products and a normalisation of directions that are known to eps
constexpr double ROUNDING = 1.0e-14;

struct Normals {
  std::vector<double> n, shape;
  std::vector<aleisph::NormalStatus> status;
  int sweeps = 0, from_fan = 0, fallback = 0, unknown = 0, contradictory = 0;
  double largest = 0.0, rms = 0.0;    // |n - exact| over those not unknown
};

// `known`: n of some particles from the start (shape 1), zero on the others
Normals find_normals(const Scene &scene, const std::vector<double> &previous = {},
                     const std::vector<double> &known = {});

void expect_exact(const Scene &scene, const std::string &name);

// Turned by an angle about an axis that is none of the coordinates (in 2d: about z): equal
// distances then differ in the last bits.
Scene turned(Scene scene, double angle = 0.7);

}    // namespace aleisph_test
#endif
