// SPDX-License-Identifier: GPL-2.0-only

#include "scene.h"

#include <random>

void Scene::add(Type kind, double px, double py, double pz)
{
  type.push_back(kind);
  x.push_back({px, py, pz});
}

Scene &Scene::jitter(double share)
{
  std::mt19937 generator(20231);    // its output is laid down by the standard
  const auto uniform = [&] { return 2.0 * (generator() / 4294967295.0) - 1.0; };
  for (std::size_t i = 0; i < x.size(); i++)
    for (int a = 0; a < dimension; a++)
      if (type[i] == FLUID) x[i][a] += share * d * uniform();
  return *this;
}

Scene &Scene::scale(double factor)
{
  d *= factor;
  for (int a = 0; a < 3; a++) {
    low[a] *= factor;
    high[a] *= factor;
    for (auto &position : x) position[a] *= factor;
  }
  return *this;
}

Scene periodic_square(int n)
{
  Scene scene;
  scene.d = 1.0 / n;
  scene.low = {0.0, 0.0, -0.5 * scene.d};
  scene.high = {1.0, 1.0, 0.5 * scene.d};
  for (int j = 0; j < n; j++)
    for (int i = 0; i < n; i++) scene.add(Scene::FLUID, (i + 0.5) * scene.d, (j + 0.5) * scene.d);
  return scene;
}

Scene channel(int n, int columns)
{
  Scene scene;
  scene.d = 1.0 / n;
  scene.boundary = "p f p";
  scene.low = {0.0, -1.0 - 0.5 * scene.d, -0.5 * scene.d};
  scene.high = {columns * scene.d, 1.0 + 0.5 * scene.d, 0.5 * scene.d};
  for (int j = -n; j <= n; j++)
    for (int i = 0; i < columns; i++)
      scene.add(j == -n || j == n ? Scene::WALL : Scene::FLUID, (i + 0.5) * scene.d, j * scene.d);
  return scene;
}

Scene open_channel(int n, int columns)
{
  constexpr int LAYERS = 3;    // the support is 2.4 d
  Scene scene;
  scene.d = 1.0 / n;
  scene.boundary = "f f p";
  scene.low = {-(LAYERS + 0.5) * scene.d, -1.0 - 0.5 * scene.d, -0.5 * scene.d};
  scene.high = {(columns + LAYERS + 0.5) * scene.d, 1.0 + 0.5 * scene.d, 0.5 * scene.d};
  for (int j = -n; j <= n; j++)
    for (int i = -LAYERS; i <= columns + LAYERS; i++) {
      Scene::Type type = Scene::FLUID;
      if (i == 0 || i == columns) type = Scene::INLET;
      if (i < 0 || i > columns) type = Scene::BUFFER;
      if (j == -n || j == n) type = Scene::WALL;
      scene.add(type, i * scene.d, j * scene.d);
    }
  return scene;
}

Scene tank(int dimension, int n)
{
  Scene scene;
  scene.dimension = dimension;
  scene.d = 1.0 / n;
  scene.boundary = dimension == 2 ? "f f p" : "f f f";
  scene.low.fill(-0.5 * scene.d);
  scene.high.fill(1.0 + 0.5 * scene.d);
  if (dimension == 2) scene.high[2] = 0.5 * scene.d;
  const auto end = [n](int k) { return k == 0 || k == n; };
  for (int k = 0; k <= (dimension == 3 ? n : 0); k++)
    for (int j = 0; j <= n; j++)
      for (int i = 0; i <= n; i++) {
        const bool wall = end(i) || end(j) || (dimension == 3 && end(k));
        scene.add(wall ? Scene::WALL : Scene::FLUID, i * scene.d, j * scene.d, k * scene.d);
      }
  return scene;
}

Scene open_tank(int dimension, int n, int above)
{
  Scene scene;
  scene.dimension = dimension;
  scene.d = 1.0 / n;
  scene.boundary = dimension == 2 ? "f f p" : "f f f";
  scene.low.fill(-0.5 * scene.d);
  scene.high.fill(1.0 + 0.5 * scene.d);
  scene.high[dimension - 1] += (above + 1) * scene.d;
  if (dimension == 2) scene.high[2] = 0.5 * scene.d;
  const int levels = n + above;
  for (int k = 0; k <= (dimension == 3 ? levels : 0); k++)
    for (int j = 0; j <= (dimension == 2 ? levels : n); j++)
      for (int i = 0; i <= n; i++) {
        const int level = dimension == 2 ? j : k;
        const bool side = i == 0 || i == n || (dimension == 3 && (j == 0 || j == n));
        if (!side && level > n) continue;
        scene.add(side || level == 0 ? Scene::WALL : Scene::FLUID, i * scene.d, j * scene.d,
                  k * scene.d);
      }
  return scene;
}

Scene dam(int n)
{
  Scene scene;
  scene.d = 1.0 / n;
  scene.boundary = "f f p";
  scene.low.fill(-0.5 * scene.d);
  scene.high = {4.0 + 0.5 * scene.d, 4.0 + 0.5 * scene.d, 0.5 * scene.d};
  for (int j = 0; j <= 3 * n; j++)
    for (int i = 0; i <= 4 * n; i++) {
      const bool wall = i == 0 || i == 4 * n || j == 0;
      if (!wall && (i > n || j > 2 * n)) continue;
      scene.add(wall ? Scene::WALL : Scene::FLUID, i * scene.d, j * scene.d);
    }
  return scene;
}

Scene patch(int n)
{
  Scene scene;
  scene.d = 1.0 / n;
  scene.boundary = "f f p";
  scene.low = {-1.5, -1.5, -0.5 * scene.d};
  scene.high = {1.5, 1.5, 0.5 * scene.d};
  for (int j = 0; j < n; j++)
    for (int i = 0; i < n; i++)
      scene.add(Scene::FLUID, (i + 0.5) * scene.d - 0.5, (j + 0.5) * scene.d - 0.5);
  return scene;
}
