// SPDX-License-Identifier: GPL-2.0-only

#include "blocks.h"

#include <cmath>

namespace aleisph_test {

using namespace aleisph;

namespace {

struct Facets {
  Point sum{}, middle{};
  int number = 0, fluid = 0;

  Facets(const Blocks &blocks, const Index &at)
  {
    for (int m = 0; m < 1 << blocks.dim; m++) {
      if (cell(blocks, at, m) != Cell::FLUID) continue;
      fluid++;
      for (int a = 0; a < blocks.dim; a++) {
        if (cell(blocks, at, m ^ (1 << a)) != Cell::SOLID) continue;
        number++;
        sum[a] += sign(m, a);
        for (int b = 0; b < blocks.dim; b++)
          if (b != a) middle[b] += sign(m, b);
      }
    }
  }

  double shape() const
  {
    double square = 0.0, lean = 0.0;
    for (int a = 0; a < 3; a++) {
      square += sum[a] * sum[a];
      lean += sum[a] * middle[a];
    }
    const double c = std::sqrt(square) / number;
    return lean > 0.0 ? 1.0 / c : c;
  }

 private:
  // the cell m around a lattice point lies on this side of it along axis a
  static double sign(int m, int a) { return (m >> a) & 1 ? 1.0 : -1.0; }
  static Cell cell(const Blocks &blocks, Index at, int m)
  {
    for (int a = 0; a < blocks.dim; a++) at[a] += ((m >> a) & 1) - 1;
    return blocks.cells(at);
  }
};

// the last axis is up
Blocks tank(const std::string &name, int dim, const Index &size, const Predicate &solid)
{
  return {name, dim, size, [=](const Index &c) {
            if (c[dim - 1] >= size[dim - 1]) return Cell::OUTSIDE;
            for (int a = 0; a < dim; a++)
              if (c[a] < 0 || c[a] >= size[a]) return Cell::SOLID;
            return solid(c) ? Cell::SOLID : Cell::FLUID;
          }};
}

}    // namespace

bool within(const Index &c, const Index &low, const Index &high)
{
  for (int a = 0; a < 3; a++)
    if (c[a] < low[a] || c[a] >= high[a]) return false;
  return true;
}

BlockScene fill(const Blocks &blocks, const Predicate &wet, const Predicate &hidden)
{
  BlockScene scene;
  scene.dim = blocks.dim;
  for (int k = 0; k <= blocks.size[2]; k++)
    for (int j = 0; j <= blocks.size[1]; j++)
      for (int i = 0; i <= blocks.size[0]; i++) {
        const Index at = {i, j, k};
        const Point x = {1.0 * i, 1.0 * j, 1.0 * k};
        const Facets facets(blocks, at);
        if (facets.number > 0) {
          scene.add(x, WALL, facets.sum, 1);
          scene.shape.push_back(facets.shape());
        } else if (facets.fluid > 0 ? wet(at) : hidden && hidden(at)) {
          scene.add(x, facets.fluid > 0 ? FLUID : WALL);
          scene.shape.push_back(0.0);
        }
      }
  return scene;
}

std::vector<Blocks> obstacles()
{
  const Index flat = {16, 9, 0}, deep = {14, 10, 7};
  const auto block = [](const Index &low, const Index &high) {
    return [=](const Index &c) { return within(c, low, high); };
  };
  return {
      tank("2d box on the floor", 2, flat, block({9, 0, 0}, {12, 4, 1})),
      tank("2d stairs", 2, flat, [](const Index &c) { return c[0] - 7 > 3 * (c[1] / 2); }),
      tank("2d shelf", 2, flat, block({10, 3, 0}, {16, 6, 1})),
      tank("empty tank", 3, deep, [](const Index &) { return false; }),
      tank("box on the floor", 3, deep, block({8, 3, 0}, {11, 6, 3})),
      tank("box in a corner", 3, deep, block({10, 6, 0}, {14, 10, 3})),
      tank("sill from side to side", 3, deep, block({8, 0, 0}, {11, 10, 3})),
      tank("pier as high as the tank", 3, deep, block({7, 4, 0}, {10, 7, 7})),
      tank("stairs", 3, deep, [](const Index &c) { return c[0] - 5 > 3 * (c[2] / 2); }),
      tank("shelf", 3, deep, block({5, 7, 2}, {9, 10, 5})),
      tank("tunnel", 3, deep,
           [](const Index &c) {
             return within(c, {5, 0, 0}, {10, 10, 6}) && !within(c, {0, 3, 0}, {14, 7, 3});
           }),
      tank("stairs into a corner", 3, deep,
           [](const Index &c) { return c[0] / 3 + c[1] / 3 + c[2] / 2 >= 5; }),
  };
}

}    // namespace aleisph_test
