// SPDX-License-Identifier: GPL-2.0-only
/* ----------------------------------------------------------------------
   Particles of small test cases. Walls are one layer on the wall surface;
   the fluid begins one spacing away from it.
------------------------------------------------------------------------- */

#ifndef LMP_ALEISPH_TEST_SCENE_H
#define LMP_ALEISPH_TEST_SCENE_H

#include <array>
#include <string>
#include <vector>

struct Scene {
  enum Type { FLUID = 1, WALL = 2, INLET = 3, BUFFER = 4 };    // INLET: prescribed pressure

  int dimension = 2;
  double d = 0.1;    // spacing
  double rho0 = 1.0;
  std::string units = "lj", boundary = "p p p";
  std::array<double, 3> low = {}, high = {};    // of the box
  std::vector<std::array<double, 3>> x;
  std::vector<int> type;

  void add(Type kind, double px, double py, double pz = 0.0);
  // moves every fluid particle by up to share * d in each direction, always the same way
  Scene &jitter(double share);
  // all lengths times factor
  Scene &scale(double factor);
};

// fluid on [0, 1]^2 with period 1, n particles in each direction
Scene periodic_square(int n);
// -1 <= y <= 1 between walls, periodic in x with `columns` particles; spacing 1/n
Scene channel(int n, int columns = 10);
// the same, not periodic: pressure is prescribed on the columns x = 0 and x = length, and three
// columns of buffer lie outside of each; type INLET and BUFFER
Scene open_channel(int n, int columns);
// closed box [0, 1]^2 or [0, 1]^3 with walls all round
Scene tank(int dimension, int n);
// the same, open at the top: fluid up to particles at height 1, walls `above` spacings higher
Scene open_tank(int dimension, int n, int above = 3);
// dam break: n columns of 2n fluid particles each at the left wall of a tank 4n wide and 3n high;
// spacing 1/n
Scene dam(int n);
// n x n fluid particles about the origin, spacing 1/n, nothing else in a box 3 x 3
Scene patch(int n);

#endif
