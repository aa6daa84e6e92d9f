// SPDX-License-Identifier: GPL-2.0-only
/* ----------------------------------------------------------------------
   Walls between unit cells that are fluid or solid, with d = 1. The 2^dim
   cells around a lattice point meet in quarter squares (in 2d: in half
   lines); those between a fluid and a solid cell are the facets, all of the
   same angle. With the sum S of their normals, n = S/|S| and c = |S|/number;
   they lean towards n if the sum of the directions from the point to their
   centres does.
------------------------------------------------------------------------- */

#ifndef ALEISPH_TEST_BLOCKS_H
#define ALEISPH_TEST_BLOCKS_H

#include "scenes.h"

#include <string>

namespace aleisph_test {

using Index = std::array<int, 3>;
using Predicate = std::function<bool(const Index &)>;

enum class Cell { FLUID, SOLID, OUTSIDE };    // OUTSIDE: above the rim of a tank
using Cells = std::function<Cell(const Index &)>;

struct Blocks {
  std::string name;
  int dim;
  Index size;    // of the tank
  Cells cells;
};

struct BlockScene : Scene {
  std::vector<double> shape;    // 1/c where the facets lean towards n, else c; 0: no facets
};

// Wall particles on all facets, and on lattice points inside the solid if they are `hidden`.
// Fluid particles on those inside the fluid if they are `wet`.
BlockScene fill(const Blocks &blocks, const Predicate &wet, const Predicate &hidden = {});

// low <= c < high
bool within(const Index &c, const Index &low, const Index &high);

// open tanks with solid blocks in them: boxes, sills, stairs, a tunnel, ...
std::vector<Blocks> obstacles();

}    // namespace aleisph_test
#endif
