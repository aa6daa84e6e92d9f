// SPDX-License-Identifier: GPL-2.0-only

#include "aleisph_tension_contact_walls.h"

#include "aleisph_nearest.h"
#include "aleisph_vectors.h"

#include <Eigen/Dense>
#include <algorithm>

namespace aleisph {

using Eigen::Vector3d;

namespace {

constexpr double CONCAVE = 1.03;      // shape of edges: the faces turn by 28 degrees or more
constexpr double SAME_FACE = 0.88;    // cosine of these 28 degrees
constexpr double SAME_WALL = 0.7;     // a curved wall turns by as much where one particle sees it
constexpr double OPPOSITE = -0.7;     // of two walls of a gap, only the nearer one
constexpr double NEXT = 1.7;          // in spacings: the diagonal of a square, not of a cube
constexpr double IN_PLANE = 0.25;     // in spacings

bool is_new(const std::vector<Vector3d> &normals, const Vector3d &n)
{
  return std::none_of(normals.begin(), normals.end(),
                      [&n](const Vector3d &known) { return known.dot(n) > SAME_WALL; });
}

}    // namespace

Vector3d ContactWalls::normal_at(int k) const
{
  return at(cloud_.normal(), s_.col()[k]);
}

bool ContactWalls::is_edge(int k) const
{
  const int j = s_.col()[k];
  return (cloud_.role()[j] & WALL) && cloud_.shape()[j] > CONCAVE;
}

// to the wall with this normal; null: any wall
bool ContactWalls::belongs(int k, const Vector3d *face) const
{
  if (!(cloud_.role()[s_.col()[k]] & WALL)) return false;
  return !face || (!is_edge(k) && normal_at(k).dot(*face) > SAME_WALL);
}

// of two pairs of the same row
bool ContactWalls::is_nearer(int k, int m) const
{
  return nearer(s_.r()[k], separation(s_, k), s_.r()[m], separation(s_, m), cloud_.spacing());
}

int ContactWalls::nearest_pair(int i, const Vector3d *face) const
{
  int nearest = -1;
  for (int k = s_.begin(i); k < s_.end(i); k++)
    if (belongs(k, face) && (nearest < 0 || is_nearer(k, nearest))) nearest = k;
  return nearest;
}

std::vector<ContactWalls::Face> ContactWalls::faces(int i, int k) const
{
  const double d = cloud_.spacing();
  std::vector<Face> all, found;
  if (!is_edge(k)) return found;
  for (int m = s_.begin(i); m < s_.end(i); m++) {
    if (!(cloud_.role()[s_.col()[m]] & WALL) || is_edge(m)) continue;
    const Vector3d r = separation(s_, m) - separation(s_, k), n = normal_at(m);
    const Face face = {n, m, r.norm()};
    if (face.distance < NEXT * d && std::abs(r.dot(n)) < IN_PLANE * d) all.push_back(face);
  }
  std::stable_sort(all.begin(), all.end(), [&](const Face &a, const Face &b) {
    return nearer(a.distance, separation(s_, a.pair), b.distance, separation(s_, b.pair), d);
  });
  for (const Face &face : all)
    if (std::none_of(found.begin(), found.end(),
                     [&face](const Face &f) { return f.n.dot(face.n) > SAME_FACE; }))
      found.push_back(face);
  return found;
}

// of the nearest wall and of all that meet it or one another in the edges that i sees, the nearest
// edges first; none if there is no edge
std::vector<Vector3d> ContactWalls::face_normals(int i) const
{
  std::vector<int> edges;
  int nearest = -1;
  for (int k = s_.begin(i); k < s_.end(i); k++) {
    if (is_edge(k))
      edges.push_back(k);
    else if ((cloud_.role()[s_.col()[k]] & WALL) && (nearest < 0 || is_nearer(k, nearest)))
      nearest = k;
  }
  if (edges.empty() || nearest < 0) return {};
  std::stable_sort(edges.begin(), edges.end(), [this](int a, int b) { return is_nearer(a, b); });
  std::vector<Vector3d> normals = {normal_at(nearest)};
  for (const int k : edges)
    for (const Face &face : faces(i, k))
      if (is_new(normals, face.n)) normals.push_back(face.n);
  return normals;
}

bool ContactWalls::wall(int i, double depth, const Vector3d *face, ContactWall &found) const
{
  const int nearest = nearest_pair(i, face);
  if (nearest < 0) return false;
  if (depth == 0.0) {
    found.n = normal_at(nearest);
    found.height = separation(s_, nearest).dot(found.n);
    found.cosine = cosine_[s_.col()[nearest]];
    return true;
  }
  double weights = 0.0;
  for (int k = s_.begin(i); k < s_.end(i); k++) {
    const double beyond = (s_.r()[k] - s_.r()[nearest]) / depth;
    if (!belongs(k, face) || beyond >= 1.0) continue;
    const double w = (1.0 - beyond) * (1.0 - beyond);
    const Vector3d n = normal_at(k);
    found.n += w * n;
    found.height += w * separation(s_, k).dot(n);
    found.cosine += w * cosine_[s_.col()[k]];
    weights += w;
  }
  const double length = found.n.norm();
  if (!(length > 0.0)) return false;
  found.n /= length;
  found.height /= weights;
  found.cosine /= weights;
  return true;
}

std::vector<ContactWall> ContactWalls::walls(int i, double depth) const
{
  const auto normals = face_normals(i);
  std::vector<ContactWall> all;
  ContactWall one;
  if (normals.size() < 2) {
    if (wall(i, depth, nullptr, one)) all.push_back(one);
    return all;
  }
  for (const Vector3d &n : normals) {
    ContactWall next;
    if (wall(i, depth, &n, next)) all.push_back(next);
  }
  const double d = cloud_.spacing();
  std::stable_sort(all.begin(), all.end(), [d](const ContactWall &a, const ContactWall &b) {
    return nearer(a.height, d * a.n, b.height, d * b.n, d);
  });
  for (size_t a = 0; a < all.size(); a++)
    all.erase(std::remove_if(all.begin() + a + 1, all.end(),
                             [&](const ContactWall &w) { return w.n.dot(all[a].n) < OPPOSITE; }),
              all.end());
  return all;
}

}    // namespace aleisph
