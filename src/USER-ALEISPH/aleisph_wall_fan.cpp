// SPDX-License-Identifier: GPL-2.0-only

#include "aleisph_wall_fan.h"

#include <Eigen/Dense>
#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

namespace aleisph {
namespace {

using Vec3 = WallFan::Vec3;

constexpr double PI = 3.14159265358979323846;
constexpr double DEGREE = PI / 180.0;

// A facet wider than this is a piece of wall only if there is a wall particle in it, as there is
// on the diagonal of a square cell, and not on the free top of a tank's corner.
constexpr double NEEDS_WITNESS = 75.0 * DEGREE;
constexpr double WITNESS = 30.0 * DEGREE;    // so far from the bisector, at most
constexpr double WITNESS_REACH = 1.96;       // and so many spacings from i

// Distances and directions that differ by less are the same up to rounding: the choice among them
// must not depend on the order of neighbours, which a restart or other ranks change.
constexpr double SAME = 1.0e-6;

// A direction closer to an arc or to a vertex lies on no side.
constexpr double ON_ARC = 1.0e-6;

Vec3 direction(const Stencil &s, int k)
{
  Vec3 u = Vec3::Zero();
  for (int a = 0; a < s.dim(); a++) u[a] = -s.e(a)[k];
  return u;
}

double angle(const Vec3 &u, const Vec3 &v)
{
  return std::atan2(u.cross(v).norm(), u.dot(v));
}

// of p about u, counter-clockwise as seen from outside, in [0, 2 pi)
double azimuth(const Vec3 &p, const Vec3 &u)
{
  const Vec3 e1 = u.unitOrthogonal();
  const double phi = std::atan2(u.cross(e1).dot(p), e1.dot(p));
  return phi < 0.0 ? phi + 2.0 * PI : phi;
}

struct Neighbour {
  std::array<long long, 4> rank;    // distance, then direction
  Vec3 u;
  int k;
};

// wall neighbours by distance
std::vector<Neighbour> wall_neighbours(const Stencil &s, const Role *role, int i, double reach)
{
  std::vector<Neighbour> all;
  for (int k = s.begin(i); k < s.end(i); k++) {
    if (!(role[s.col()[k]] & WALL) || s.r()[k] > reach) continue;
    const Vec3 u = direction(s, k);
    all.push_back({{std::llround(s.r()[k] / (SAME * reach)), std::llround(u[0] / SAME),
                    std::llround(u[1] / SAME), std::llround(u[2] / SAME)},
                   u,
                   k});
  }
  std::sort(all.begin(), all.end(),
            [](const Neighbour &a, const Neighbour &b) { return a.rank < b.rank; });
  return all;
}

}    // namespace

WallFan::WallFan(const Stencil &s, const Role *role, int i, double d, const FanParams &params)
{
  select_vertices(s, role, i, d, params);
  if (s.dim() == 2)
    join_2d();
  else
    join_3d(params);
  for (Vertex &vertex : vertices_) sort_around(vertex);
  prune();
  trace_sides();
}

void WallFan::select_vertices(const Stencil &s, const Role *role, int i, double d,
                              const FanParams &params)
{
  const std::vector<Neighbour> all = wall_neighbours(s, role, i, WITNESS_REACH * d);
  for (size_t m = 0; m < all.size(); m++) {
    const double r = s.r()[all[m].k];
    const auto on_the_way = [&](const Neighbour &p) {
      return (s.r()[p.k] * p.u - r * all[m].u).norm() < params.detour * r;
    };
    if (r <= params.reach * d && std::none_of(all.begin(), all.begin() + m, on_the_way))
      vertices_.push_back({all[m].u, all[m].k, {}});
    witnesses_.push_back(all[m].u);
  }
}

void WallFan::join_2d()
{
  const int n = static_cast<int>(vertices_.size());
  vertices_.push_back({Vec3::UnitZ(), NONE, {}});
  vertices_.push_back({-Vec3::UnitZ(), NONE, {}});
  for (int v = 0; v < n; v++) {
    add_arc(v, n, 0.5 * PI);
    add_arc(v, n + 1, 0.5 * PI);
  }
}

void WallFan::join_3d(const FanParams &params)
{
  const int n = static_cast<int>(vertices_.size());
  for (int v = 0; v < n; v++)
    for (int w = v + 1; w < n; w++) {
      const double width = angle(vertices_[v].u, vertices_[w].u);
      if (width < params.max_gap * DEGREE && is_facet(v, w, width)) add_arc(v, w, width);
    }
}

// No other vertex lies within the circle that has the arc as its diameter (so that arcs do not
// cross), and a wide one has a wall particle in it.
bool WallFan::is_facet(int v, int w, double width) const
{
  const Vec3 bisector = (vertices_[v].u + vertices_[w].u).normalized();
  const double circle = std::cos(0.5 * width + SAME), witness = std::cos(WITNESS);
  for (int other = 0; other < static_cast<int>(vertices_.size()); other++)
    if (other != v && other != w && vertices_[other].u.dot(bisector) >= circle) return false;
  return width <= NEEDS_WITNESS ||
      std::any_of(witnesses_.begin(), witnesses_.end(),
                  [&](const Vec3 &u) { return u.dot(bisector) >= witness; });
}

void WallFan::add_arc(int from, int to, double width)
{
  const int a = static_cast<int>(arcs_.size());
  const Vec3 normal = vertices_[from].u.cross(vertices_[to].u).normalized();
  arcs_.push_back({from, to, normal, width});
  arcs_.push_back({to, from, -normal, width});
  vertices_[from].out.push_back(a);
  vertices_[to].out.push_back(a + 1);
}

void WallFan::sort_around(Vertex &vertex) const
{
  std::vector<std::pair<double, int>> turn;
  for (const int a : vertex.out) turn.emplace_back(azimuth(vertices_[arcs_[a].to].u, vertex.u), a);
  std::sort(turn.begin(), turn.end());
  for (size_t m = 0; m < turn.size(); m++) vertex.out[m] = turn[m].second;
}

// Arcs that hang on a closed curve divide nothing. Without a closed curve all arcs stay: the wall
// has a rim here.
void WallFan::prune()
{
  std::vector<std::vector<int>> out;
  for (const Vertex &vertex : vertices_) out.push_back(vertex.out);
  for (bool again = true; again;) {
    again = false;
    for (std::vector<int> &mine : out) {
      if (mine.size() != 1) continue;
      std::vector<int> &other = out[arcs_[mine[0]].to];
      other.erase(std::find(other.begin(), other.end(), mine[0] ^ 1));
      mine.clear();
      again = true;
    }
  }
  if (std::all_of(out.begin(), out.end(), [](const auto &arcs) { return arcs.empty(); })) return;
  for (size_t v = 0; v < out.size(); v++) vertices_[v].out = out[v];
}

/* ----------------------------------------------------------------------
   Along the boundary of a side, with the side to the left: the next arc is
   the one clockwise of the arc that one has come by.
------------------------------------------------------------------------- */
int WallFan::next(int arc) const
{
  const std::vector<int> &out = vertices_[arcs_[arc].to].out;
  if (out.size() == 1) return NONE;
  const size_t back = std::find(out.begin(), out.end(), arc ^ 1) - out.begin();
  return out[(back + out.size() - 1) % out.size()];
}

int WallFan::previous(int arc) const
{
  const std::vector<int> &out = vertices_[arcs_[arc].from].out;
  if (out.size() == 1) return NONE;
  const size_t here = std::find(out.begin(), out.end(), arc) - out.begin();
  return out[(here + 1) % out.size()] ^ 1;
}

void WallFan::trace_sides()
{
  for (const Vertex &vertex : vertices_)
    for (const int first : vertex.out) {
      if (arcs_[first].side != NONE) continue;
      for (int a = first; a != NONE && arcs_[a].side == NONE; a = next(a)) arcs_[a].side = nsides_;
      for (int a = previous(first); a != NONE && arcs_[a].side == NONE; a = previous(a))
        arcs_[a].side = nsides_;
      nsides_++;
    }
}

/* ----------------------------------------------------------------------
   Nothing lies between p and the nearest point of the arcs.
------------------------------------------------------------------------- */
int WallFan::side_of(const Vec3 &direction) const
{
  const Vec3 p = direction.normalized();
  double nearest = 2.0 * PI;
  int side = NONE;
  for (const Vertex &vertex : vertices_) {
    if (vertex.out.empty()) continue;
    const double distance = angle(p, vertex.u);
    if (distance < nearest) {
      nearest = distance;
      side = distance > ON_ARC ? side_at(vertex, p) : NONE;
    }
    for (const int a : vertex.out) {
      const Arc &arc = arcs_[a];
      const Vec3 &u = vertices_[arc.from].u, &v = vertices_[arc.to].u;
      const double sine = arc.normal.dot(p);
      const bool beside = arc.normal.cross(u).dot(p) > 0.0 && v.cross(arc.normal).dot(p) > 0.0;
      // the other direction of the arc is for the other sign
      if (!beside || sine < 0.0 || std::asin(std::min(sine, 1.0)) >= nearest) continue;
      nearest = std::asin(std::min(sine, 1.0));
      side = nearest > ON_ARC ? arc.side : NONE;
    }
  }
  return side;
}

// the side in which p lies next to the vertex
int WallFan::side_at(const Vertex &vertex, const Vec3 &p) const
{
  const double phi = azimuth(p, vertex.u);
  const auto turn = [this, &vertex](int a) { return azimuth(vertices_[arcs_[a].to].u, vertex.u); };
  if (vertex.out.size() == 1) {    // a rim: left or right of its last arc
    const double ahead = std::remainder(phi - turn(vertex.out[0]), 2.0 * PI);
    return arcs_[ahead > 0.0 ? vertex.out[0] : vertex.out[0] ^ 1].side;
  }
  int last = vertex.out.back();
  for (const int a : vertex.out)
    if (turn(a) <= phi) last = a;
  return arcs_[last].side;
}

WallFan::Mean WallFan::mean(int side) const
{
  Mean mean;
  Vec3 middle = Vec3::Zero();
  double weight = 0.0;
  for (const Vertex &vertex : vertices_)
    for (const int a : vertex.out) {
      if (arcs_[a].side != side) continue;
      weight += arcs_[a].width;
      mean.n += arcs_[a].width * arcs_[a].normal;
      middle += arcs_[a].width * (vertex.u + vertices_[arcs_[a].to].u);
    }
  if (weight > 0.0) mean.n /= weight;
  mean.lean = middle.dot(mean.n);
  return mean;
}

std::vector<int> WallFan::boundary(int side) const
{
  std::vector<int> pairs;
  for (const Vertex &vertex : vertices_)
    if (vertex.k != NONE && std::any_of(vertex.out.begin(), vertex.out.end(), [&](int a) {
          return arcs_[a].side == side || arcs_[a ^ 1].side == side;
        }))
      pairs.push_back(vertex.k);
  return pairs;
}

}    // namespace aleisph
