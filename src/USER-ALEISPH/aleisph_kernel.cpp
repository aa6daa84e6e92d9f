// SPDX-License-Identifier: GPL-2.0-only
/* ----------------------------------------------------------------------
   Smoothing kernels as functions of q = r/h: W = norm f(q),
   dW/dr = norm/h f'(q), norm = sigma/h^dim.
   The constants sigma are those of the sources named in the header; for
   the 3d quintic spline it is 1/(120 pi).
------------------------------------------------------------------------- */

#include "aleisph_kernel.h"

#include <cmath>
#include <stdexcept>

namespace aleisph {
namespace {

constexpr double PI = 3.14159265358979323846;

struct Entry {
  const char *name;
  KernelType type;
  double support_over_h;
  double sigma2, sigma3;    // normalisation in 2d and 3d
};

constexpr Entry TABLE[] = {
    {"cubic-spline", KernelType::CUBIC_SPLINE, 2.0, 10.0 / (7.0 * PI), 1.0 / PI},
    {"quintic-spline", KernelType::QUINTIC_SPLINE, 3.0, 7.0 / (478.0 * PI), 1.0 / (120.0 * PI)},
    {"wendland-c2", KernelType::WENDLAND_C2, 2.0, 7.0 / (4.0 * PI), 21.0 / (16.0 * PI)},
    {"wendland-c4", KernelType::WENDLAND_C4, 2.0, 9.0 / (4.0 * PI), 495.0 / (256.0 * PI)}};

const Entry &entry(KernelType type)
{
  for (const Entry &e : TABLE)
    if (e.type == type) return e;
  throw std::invalid_argument("unknown smoothing kernel");
}

}    // namespace

Kernel::Kernel(KernelType type, int dim, double h) : type_(type), dim_(dim), h_(h)
{
  if (dim != 2 && dim != 3) throw std::invalid_argument("a kernel needs dimension 2 or 3");
  if (!(h > 0.0) || !std::isfinite(h))
    throw std::invalid_argument("a kernel needs a smoothing length > 0");
  const Entry &e = entry(type);
  support_ = e.support_over_h * h;
  inverse_h_ = 1.0 / h;
  norm_ = dim == 2 ? e.sigma2 / (h * h) : e.sigma3 / (h * h * h);
}

bool Kernel::parse(const std::string &name, KernelType &type)
{
  for (const Entry &e : TABLE) {
    if (name != e.name) continue;
    type = e.type;
    return true;
  }
  return false;
}

const char *Kernel::names()
{
  static const std::string all = [] {
    std::string s;
    for (const Entry &e : TABLE) s += (s.empty() ? "" : ", ") + std::string(e.name);
    return s;
  }();
  return all.c_str();
}

double Kernel::support_over_h(KernelType type)
{
  return entry(type).support_over_h;
}

}    // namespace aleisph
