// SPDX-License-Identifier: GPL-2.0-only

#include "aleisph_contact.h"

#include <Eigen/Core>
#include <algorithm>
#include <cmath>

namespace aleisph {
namespace {

using Eigen::Vector3d;

Vector3d vector_at(const double *field, int i)
{
  return {field[3 * i], field[3 * i + 1], field[3 * i + 2]};
}

// x_i - x_j of pair k
Vector3d separation(const Stencil &s, int k)
{
  return s.r()[k] * Vector3d(s.e(0)[k], s.e(1)[k], s.dim() == 3 ? s.e(2)[k] : 0.0);
}

// pair of i with the nearest wall particle, -1 if there is none
int nearest_wall(const Stencil &s, int i, const Role *role)
{
  int nearest = -1;
  for (int k = s.begin(i); k < s.end(i); k++)
    if ((role[s.col()[k]] & WALL) && (nearest < 0 || s.r()[k] < s.r()[nearest])) nearest = k;
  return nearest;
}

}    // namespace

int contact_normals(const Stencil &s, const Rows &surface, const Role *role, const double *normal,
                    const double *cosine, double d, const ContactParams &params, double *contact)
{
  int count = 0;
  for (const int i : surface) {
    std::fill(contact + 4 * i, contact + 4 * i + 4, 0.0);
    const int k = nearest_wall(s, i, role);
    if (k < 0) continue;
    const int j = s.col()[k];
    const Vector3d n = vector_at(normal, j), N = vector_at(normal, i);
    if (separation(s, k).dot(n) >= params.reach * d) continue;
    const Vector3d along = N - N.dot(n) * n;
    const double length = along.norm();
    if (!(length > 1.0e-6)) continue;
    const double c = cosine[j], sine = std::sqrt(1.0 - c * c);
    const Vector3d Nc = sine / length * along + c * n;
    for (int a = 0; a < 3; a++) contact[4 * i + a] = Nc[a];
    contact[4 * i + 3] = 1.0;
    count++;
  }
  return count;
}

void contact_planes(const Stencil &wide, const Rows &walls, const Role *role, const double *normal,
                    const double *contact, double d, double *plane)
{
  for (const int j : walls) {
    plane[2 * j] = (role[j] & DRY) ? COVERED : -COVERED;
    plane[2 * j + 1] = 0.0;
    const Vector3d n = vector_at(normal, j);
    double nearest2 = 0.0;
    int pair = -1;
    for (int k = wide.begin(j); k < wide.end(j); k++) {
      if (contact[4 * wide.col()[k] + 3] == 0.0) continue;
      const Vector3d r = separation(wide, k);
      const double along2 = (r - r.dot(n) * n).squaredNorm();
      if (pair >= 0 && along2 >= nearest2) continue;
      nearest2 = along2;
      pair = k;
    }
    if (pair < 0) continue;
    const double *c = contact + 4 * wide.col()[pair];
    const Vector3d Nc(c[0], c[1], c[2]);
    plane[2 * j] = separation(wide, pair).dot(Nc) / d - 0.5;
    plane[2 * j + 1] = n.dot(Nc);
  }
}

void add_continuation(const Stencil &wide, const Kernel &kernel, const Rows &surface,
                      const Role *role, const double *normal, const double *plane, double volume,
                      double d, const ContactParams &params, double *N)
{
  for (const int i : surface) {
    Vector3d sum = Vector3d::Zero();
    for (int k = wide.begin(i); k < wide.end(i); k++) {
      const int j = wide.col()[k];
      if (!(role[j] & WALL)) continue;
      const Vector3d r0 = separation(wide, k), n = vector_at(normal, j);
      for (int m = 0; m <= params.depth; m++) {
        const double weight = std::clamp(0.5 - (plane[2 * j] - m * plane[2 * j + 1]), 0.0, 1.0);
        const Vector3d r = r0 + m * d * n;
        const double distance = r.norm();
        if (weight == 0.0 || distance == 0.0) continue;
        sum -= volume * weight * kernel.dw(distance) / distance * r;
      }
    }
    for (int a = 0; a < 3; a++) N[3 * i + a] += sum[a];
  }
}

}    // namespace aleisph
