// SPDX-License-Identifier: GPL-2.0-only
/* ----------------------------------------------------------------------
   Guards of the velocity: collisions, wall guard, cap.
------------------------------------------------------------------------- */

#include "aleisph_guards.h"
#include "scenes.h"

#include <gtest/gtest.h>

#include <Eigen/Dense>

#include <cmath>

using namespace aleisph;
using namespace aleisph_test;

namespace {

using Vec3 = Eigen::Vector3d;
using Field = std::vector<double>;

constexpr double EPS = 1.0e-15;

Vec3 at(const Field &v, int i)
{
  return Vec3(v[3 * i], v[3 * i + 1], v[3 * i + 2]);
}

void set(Field &v, int i, const Vec3 &value)
{
  for (int a = 0; a < 3; a++) v[3 * i + a] = value[a];
}

Vec3 position(const Scene &scene, int i)
{
  return Vec3(scene.points[i][0], scene.points[i][1], scene.points[i][2]);
}

Field zeros(const Scene &scene)
{
  return Field(3 * scene.points.size(), 0.0);
}

Scene empty_scene(int dim)
{
  Scene scene;
  scene.dim = dim;
  scene.d = D;
  return scene;
}

Scene fluid_at(const Points &points)
{
  Scene scene = empty_scene(2);
  for (const Point &x : points) scene.add(x, FLUID);
  return scene;
}

/* ----------------------------------------------------------------------
   collisions
------------------------------------------------------------------------- */

constexpr double REACH = 0.7 * D;

struct Collision {
  Field n, dv;
  int changed = 0;
};

Collision collide(const Scene &scene, const Field &v)
{
  const Discretized op(scene, LaplacianLimits(), false);
  Collision c;
  c.n.assign(scene.points.size(), 0.0);
  c.dv = zeros(scene);
  count_approaching(op.cloud(), v.data(), REACH, c.n.data());
  c.changed = aleisph::collide(op.cloud(), v.data(), c.n.data(), REACH, c.dv.data());
  return c;
}

// a block compressed so that every particle has several others within reach; of its lowest layer
// a part is made wall
Scene crowd(int dim, unsigned seed, bool walls)
{
  Scene scene = empty_scene(dim);
  Points points = lattice(dim, dim == 2 ? 4 : 2, 0.45 * D);
  jitter(points, dim, 0.15 * D, seed);
  for (const Point &x : points) {
    const bool wall = walls && x[dim - 1] < -0.5 * D;
    scene.add(x, wall ? WALL : FLUID, {0.0, dim == 2 ? 1.0 : 0.0, dim == 3 ? 1.0 : 0.0});
  }
  return scene;
}

Field random_velocity(const Scene &scene, unsigned seed)
{
  Field v = random_field(static_cast<int>(3 * scene.points.size()), seed);
  for (size_t i = 0; i < scene.points.size(); i++)
    for (int a = 0; a < 3; a++)
      if (a >= scene.dim || (scene.role[i] & WALL)) v[3 * i + a] = 0.0;
  return v;
}

// sum over pairs of w a^2, by brute force
double least_loss(const Scene &scene, const Field &v, const Field &n)
{
  double sum = 0.0;
  const int N = static_cast<int>(scene.points.size());
  for (int i = 0; i < N; i++)
    for (int j = 0; j < N; j++) {
      const Vec3 r_ij = position(scene, i) - position(scene, j);
      if (i == j || r_ij.norm() >= REACH || !(scene.role[i] & FLUID)) continue;
      const double a = (at(v, i) - at(v, j)).dot(r_ij.normalized());
      if (a >= 0.0) continue;
      if (scene.role[j] & WALL)
        sum += a * a / n[i];
      else
        sum += 0.5 * 0.5 * a * a / std::max(n[i], n[j]);    // each pair is met twice
    }
  return sum;
}

}    // namespace

TEST(Collision, ConservesMomentum)
{
  for (int dim : {2, 3})
    for (unsigned seed = 1; seed <= 10; seed++) {
      const Scene scene = crowd(dim, seed, false);
      const Collision c = collide(scene, random_velocity(scene, seed + 100));
      Vec3 linear = Vec3::Zero(), angular = Vec3::Zero();
      double size = 0.0;
      for (int i : scene.rows(FLUID)) {
        linear += at(c.dv, i);
        angular += position(scene, i).cross(at(c.dv, i)) / D;
        size += at(c.dv, i).norm();
      }
      EXPECT_GT(size, 0.1 * scene.points.size());    // many collide
      EXPECT_LT(linear.norm(), 10.0 * EPS * size);
      EXPECT_LT(angular.norm(), 50.0 * EPS * size);    // arms of up to 2.5 d
    }
}

// The bound is derived at the head of aleisph_guards.cpp; it makes the loss positive whenever
// two particles collide.
TEST(Collision, LosesEnergyByTheBoundAtLeast)
{
  for (int dim : {2, 3})
    for (bool walls : {false, true})
      for (unsigned seed = 1; seed <= 10; seed++) {
        const Scene scene = crowd(dim, seed, walls);
        const Field v = random_velocity(scene, seed + 200);
        const Collision c = collide(scene, v);
        double change = 0.0;
        for (int i : scene.rows(FLUID))
          change += (at(v, i) + at(c.dv, i)).squaredNorm() - at(v, i).squaredNorm();
        const double bound = least_loss(scene, v, c.n);
        EXPECT_GT(bound, 1.0);
        EXPECT_LE(change, -bound * (1.0 - 1.0e-12)) << dim << "d, seed " << seed;
      }
}

TEST(Collision, TwoParticlesLoseTheirApproach)
{
  const double x = 0.3 * D, y = 0.4 * D;    // r = 0.5 d, e = (-3, -4)/5
  const Scene scene = fluid_at({{0.0, 0.0, 0.0}, {x, y, 0.0}});
  Field v = {2.0, 1.0, 0.0, -1.0, -0.5, 0.0};
  const Collision c = collide(scene, v);
  // v_01.e = -(3*3 + 1.5*4)/5 = -3, so 1.5 e is taken from the first and given to the second
  EXPECT_EQ(c.changed, 2);
  EXPECT_EQ(c.n[0], 1.0);
  EXPECT_NEAR(c.dv[0], -0.9, 5.0 * EPS);
  EXPECT_NEAR(c.dv[1], -1.2, 5.0 * EPS);
  EXPECT_NEAR(c.dv[3], 0.9, 5.0 * EPS);
  EXPECT_NEAR(c.dv[4], 1.2, 5.0 * EPS);
}

TEST(Collision, OnlyWhatIsCloseAndApproaches)
{
  for (double r : {0.69, 0.71})
    for (double sign : {1.0, -1.0}) {
      const Scene scene = fluid_at({{0.0, 0.0, 0.0}, {r * D, 0.0, 0.0}});
      const Collision c = collide(scene, {sign, 0.3, 0.0, 0.0, 0.0, 0.0});
      const bool expected = r < 0.7 && sign > 0.0;
      EXPECT_EQ(c.changed, expected ? 2 : 0);
      EXPECT_EQ(c.n[0], expected ? 1.0 : 0.0);
      if (!expected) {
        EXPECT_EQ(c.dv, Field(6, 0.0));
      }
    }
}

// Two particles meet a third one between them, so that n = 1, 2, 1 and w = 1/4: the outer ones
// keep 3/4 of their velocity, the middle one is hit from both sides.
TEST(Collision, SharedByTheNumberOfPartners)
{
  const Scene scene = fluid_at({{-0.6 * D, 0.0, 0.0}, {0.0, 0.0, 0.0}, {0.6 * D, 0.0, 0.0}});
  const Collision c = collide(scene, {1.0, 0.0, 0.0, 0.0, 0.0, 0.0, -1.0, 0.0, 0.0});
  EXPECT_EQ(c.n, (Field{1.0, 2.0, 1.0}));
  EXPECT_NEAR(c.dv[0], -0.25, EPS);
  EXPECT_NEAR(c.dv[3], 0.0, EPS);
  EXPECT_NEAR(c.dv[6], 0.25, EPS);
}

// The wall does not react, so the particle gets its whole normal velocity.
TEST(Collision, WithAMovingWall)
{
  Scene scene = fluid_at({{0.0, 0.5 * D, 0.0}});
  scene.add({0.0, 0.0, 0.0}, WALL, {0.0, 1.0, 0.0});
  const Collision c = collide(scene, {0.7, -1.0, 0.0, 5.0, 2.0, 0.0});
  EXPECT_EQ(c.changed, 1);
  EXPECT_NEAR(c.dv[0], 0.0, EPS);
  EXPECT_NEAR(c.dv[1], 3.0, 5.0 * EPS);
  EXPECT_EQ(at(c.dv, 1), Vec3::Zero());
}

/* ----------------------------------------------------------------------
   wall guard
------------------------------------------------------------------------- */

namespace {

constexpr double Q = 0.3 * D;
constexpr double DT = 0.01;

double softened(double s)
{
  return s < Q ? Q * (0.5 + 0.5 * std::exp((s - Q) / Q)) : s;
}

struct Held {
  Field dv, dw, end;    // end: positions relative to the wall after the motion
  int count = 0;
};

// v: of fluid and wall; the fluid's transport velocity is w
Held hold(const Scene &scene, const Field &v, const Field &w, const Field &convex)
{
  Discretized op(scene, LaplacianLimits(), false);
  for (size_t j = 0; j < convex.size(); j++) op.cloud().shape()[j] = convex[j] != 0.0 ? 0.7 : 1.0;
  Held h;
  h.dv = h.dw = h.end = zeros(scene);
  h.count = hold_off_walls(op.cloud(), {Q, DT, v.data(), w.data()}, h.dv.data(), h.dw.data());
  for (int i : scene.rows(FLUID)) set(h.end, i, position(scene, i) + DT * (at(w, i) + at(h.dw, i)));
  return h;
}

// the first particle is fluid, the others are the flat wall y = 0 or z = 0 around the origin
Scene over_wall(int dim, const Point &x)
{
  Scene scene = empty_scene(dim);
  scene.add(x, FLUID);
  for (const Point &p : lattice(dim - 1, 3, D))
    if (dim == 3 || p[1] == 0.0)
      scene.add(p, WALL, {0.0, dim == 2 ? 1.0 : 0.0, dim == 3 ? 1.0 : 0.0}, 1);
  return scene;
}

Point over(int dim, double x, double height)
{
  return dim == 2 ? Point{x, height, 0.0} : Point{x, x, height};
}

// the corner of the walls x_a = 0, the fluid particle first
Scene in_corner(int dim, const Point &x)
{
  Scene scene = empty_scene(dim);
  scene.add(x, FLUID);
  for (int k = 0; k <= (dim == 3 ? 3 : 0); k++)
    for (int j = 0; j <= 3; j++)
      for (int i = 0; i <= 3; i++) {
        const Point n = {i == 0 ? 1.0 : 0.0, j == 0 ? 1.0 : 0.0, dim == 3 && k == 0 ? 1.0 : 0.0};
        const int faces = static_cast<int>(n[0] + n[1] + n[2]);
        if (faces > 0) scene.add({i * D, j * D, k * D}, WALL, n, faces);
      }
  return scene;
}

// the body x <= 0, y <= 0: its edge is the origin
struct Edge {
  Scene scene;
  Field convex;
};

Edge around_edge(const Point &x)
{
  Edge edge = {empty_scene(2), {}};
  edge.scene.add(x, FLUID);
  edge.scene.add({0.0, 0.0, 0.0}, WALL, {1.0, 1.0, 0.0}, 2);
  for (int k = 1; k <= 3; k++) {
    edge.scene.add({-k * D, 0.0, 0.0}, WALL, {0.0, 1.0, 0.0}, 1);
    edge.scene.add({0.0, -k * D, 0.0}, WALL, {1.0, 0.0, 0.0}, 1);
  }
  edge.convex.assign(edge.scene.points.size(), 0.0);
  edge.convex[1] = 1.0;
  return edge;
}

Field no_edges(const Scene &scene)
{
  return Field(scene.points.size(), 0.0);
}

}    // namespace

// Wherever the particle stands over the lattice of the wall, the distance that its motion leads
// to, in front of the wall or behind it, is replaced by that of the formula; what is tangential,
// and the part of w that is not v, stays.
TEST(WallGuard, NewDistanceOnAFlatWall)
{
  for (int dim : {2, 3})
    for (double x : {0.0, 0.2, 0.5})
      for (double s : {-0.2, 0.0, 0.1, 0.25, 0.299}) {
        const Scene scene = over_wall(dim, over(dim, x * D, 0.5 * D));
        const int up = dim - 1;
        Field v = zeros(scene), w = zeros(scene);
        v[0] = w[0] = 0.1 * D / DT;
        w[up] = (s - 0.5) * D / DT;
        v[up] = w[up] + 0.05;    // still towards the wall
        const Held h = hold(scene, v, w, no_edges(scene));
        EXPECT_EQ(h.count, 1);
        EXPECT_NEAR(h.end[up], softened(s * D), 1e-14 * D) << dim << "d, x " << x << ", s " << s;
        EXPECT_NEAR(h.dv[up], -v[up], 1e-14 * std::fabs(v[up]));
        for (int a = 0; a < up; a++) {
          EXPECT_EQ(h.dw[a], 0.0);
          EXPECT_EQ(h.dv[a], 0.0);
        }
      }
}

TEST(WallGuard, NothingBeyondTheDistance)
{
  for (int dim : {2, 3})
    for (double s : {0.3001, 0.5, 1.5}) {
      const Scene scene = over_wall(dim, over(dim, 0.2 * D, 0.6 * D));
      Field w = zeros(scene);
      w[dim - 1] = (s - 0.6) * D / DT;
      const Held h = hold(scene, w, w, no_edges(scene));
      EXPECT_EQ(h.count, 0);
      EXPECT_EQ(h.dv, zeros(scene));
      EXPECT_EQ(h.dw, zeros(scene));
    }
}

// Two particles that a clamp would put side by side keep their order, and one that moves away
// keeps its velocity.
TEST(WallGuard, KeepsTheOrderAndOutwardVelocities)
{
  double below = 0.5 * Q;    // what an infinite depth would be mapped to
  for (double s : {-0.4, -0.1, 0.0, 0.05, 0.2, 0.29}) {
    const Scene scene = over_wall(2, {0.0, 0.2 * D, 0.0});
    Field v = zeros(scene), w = zeros(scene);
    w[1] = (s - 0.2) * D / DT;
    v[1] = 0.4;
    const Held h = hold(scene, v, w, no_edges(scene));
    EXPECT_EQ(h.dv[1], 0.0);
    EXPECT_GT(h.end[1], below);
    below = h.end[1];
  }
  EXPECT_LT(below, Q);
}

// Seen from the wall it is the same as with the wall at rest.
TEST(WallGuard, MovingWall)
{
  const Scene scene = over_wall(2, {0.3 * D, 0.5 * D, 0.0});
  const double U = 0.4 * D / DT;
  Field v = zeros(scene), w = zeros(scene);
  for (int j : scene.rows(WALL)) set(v, j, {3.0 * U, U, 0.0});
  w[1] = 0.05 * D / DT;
  v[1] = 0.25 * U;
  const Held h = hold(scene, v, w, no_edges(scene));
  EXPECT_EQ(h.count, 1);
  EXPECT_NEAR(h.end[1] - DT * U, softened((0.5 + 0.05 - 0.4) * D), 1e-14 * D);
  EXPECT_NEAR(v[1] + h.dv[1], U, 1e-14 * U);
  EXPECT_EQ(h.dw[0], 0.0);
}

// In a corner every face has its distance, although the nearest wall particle has the normal of
// none of them and those of the faces are farther than 0.8 d along the wall.
TEST(WallGuard, Corner)
{
  for (int dim : {2, 3})
    for (double x : {-0.1, 0.05, 0.2}) {
      Point start = {0.5 * D, 0.6 * D, dim == 3 ? 0.45 * D : 0.0};
      const Point goal = {x * D, 0.1 * D, dim == 3 ? 0.15 * D : 0.0};
      const Scene scene = in_corner(dim, start);
      Field w = zeros(scene);
      for (int a = 0; a < dim; a++) w[a] = (goal[a] - start[a]) / DT;
      const Held h = hold(scene, w, w, no_edges(scene));
      EXPECT_EQ(h.count, 1);
      for (int a = 0; a < dim; a++) {
        EXPECT_NEAR(h.end[a], softened(goal[a]), 1e-13 * D) << dim << "d, x " << x;
        EXPECT_NEAR(h.dv[a], -w[a], 1e-13 * std::fabs(w[a]));
      }
    }
}

// towards the edge, the distance along the line that joins the two is that of the formula
TEST(WallGuard, ConvexEdge)
{
  for (double s : {-0.1, 0.1, 0.25}) {
    const Vec3 e(0.6, 0.8, 0.0);
    const Edge edge = around_edge({0.5 * D * e[0], 0.5 * D * e[1], 0.0});
    Field w = zeros(edge.scene);
    set(w, 0, (s - 0.5) * D / DT * e);
    const Held h = hold(edge.scene, w, w, edge.convex);
    EXPECT_EQ(h.count, 1);
    EXPECT_LT((at(h.end, 0) - softened(s * D) * e).norm(), 1e-13 * D);
    EXPECT_LT((at(w, 0) + at(h.dv, 0)).norm(), 1e-13 * at(w, 0).norm());
  }
}

// A face ends at the edge: what falls past it is not held by its extension.
TEST(WallGuard, FaceDoesNotReachBeyondAConvexEdge)
{
  const Edge edge = around_edge({0.4 * D, 0.1 * D, 0.0});
  Field w = zeros(edge.scene);
  w[1] = -0.3 * D / DT;
  const Held h = hold(edge.scene, w, w, edge.convex);
  EXPECT_EQ(h.count, 0);
}

// A plate of two layers 1.5 d apart: the fluid on top does not belong to the lower side.
TEST(WallGuard, ThinPlate)
{
  Scene scene = over_wall(2, {0.0, 0.6 * D, 0.0});
  for (int k = -3; k <= 3; k++) scene.add({k * D, -1.5 * D, 0.0}, WALL, {0.0, -1.0, 0.0}, 1);
  const Held h = hold(scene, zeros(scene), zeros(scene), no_edges(scene));
  EXPECT_EQ(h.count, 0);
}

TEST(Cap, ScalesDownWhatIsFaster)
{
  Field v = {3.0, 4.0, 0.0, 0.3, 0.4, 0.0, -6.0, 8.0, 0.0};
  EXPECT_EQ(cap_velocity({0, 1}, 2, 2.5, v.data()), 1);
  EXPECT_DOUBLE_EQ(v[0], 1.5);
  EXPECT_DOUBLE_EQ(v[1], 2.0);
  EXPECT_EQ(at(v, 1), Vec3(0.3, 0.4, 0.0));
  EXPECT_EQ(at(v, 2), Vec3(-6.0, 8.0, 0.0));    // not listed
  EXPECT_EQ(cap_velocity({0, 1}, 2, 2.5001, v.data()), 0);

  Field u = {1.0, 2.0, 2.0};
  EXPECT_EQ(cap_velocity({0}, 3, 1.5, u.data()), 1);
  EXPECT_DOUBLE_EQ(u[2], 1.0);
}
