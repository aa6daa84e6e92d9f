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

inline double pow4(double x)
{
  const double x2 = x * x;
  return x2 * x2;
}

inline double pow5(double x)
{
  return x * pow4(x);
}

double cubic_spline(double q)
{
  if (q < 1.0) return 1.0 + q * q * (0.75 * q - 1.5);
  const double u = 2.0 - q;
  return 0.25 * u * u * u;
}

double cubic_spline_slope(double q)
{
  if (q < 1.0) return q * (2.25 * q - 3.0);
  const double u = 2.0 - q;
  return -0.75 * u * u;
}

double quintic_spline(double q)
{
  double f = pow5(3.0 - q);
  if (q < 2.0) f -= 6.0 * pow5(2.0 - q);
  if (q < 1.0) f += 15.0 * pow5(1.0 - q);
  return f;
}

double quintic_spline_slope(double q)
{
  // the three terms cancel at q = 0 only up to rounding: use the expanded form there
  if (q < 1.0) return q * (-120.0 + q * q * (120.0 - 50.0 * q));
  double f = -5.0 * pow4(3.0 - q);
  if (q < 2.0) f += 30.0 * pow4(2.0 - q);
  return f;
}

double wendland_c2(double q)
{
  return pow4(1.0 - 0.5 * q) * (1.0 + 2.0 * q);
}

double wendland_c2_slope(double q)
{
  const double u = 1.0 - 0.5 * q;
  return -5.0 * q * u * u * u;
}

double wendland_c4(double q)
{
  const double u = 1.0 - 0.5 * q;
  return u * u * pow4(u) * (1.0 + q * (3.0 + 35.0 / 12.0 * q));
}

double wendland_c4_slope(double q)
{
  return -7.0 / 3.0 * q * (2.0 + 5.0 * q) * pow5(1.0 - 0.5 * q);
}

}    // namespace

Kernel::Kernel(KernelType type, int dim, double h) : type_(type), dim_(dim), h_(h)
{
  if (dim != 2 && dim != 3) throw std::invalid_argument("a kernel needs dimension 2 or 3");
  if (!(h > 0.0) || !std::isfinite(h))
    throw std::invalid_argument("a kernel needs a smoothing length > 0");
  const Entry &e = entry(type);
  support_ = e.support_over_h * h;
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

double Kernel::w(double r) const
{
  if (r >= support_) return 0.0;
  const double q = r / h_;
  switch (type_) {
    case KernelType::CUBIC_SPLINE: return norm_ * cubic_spline(q);
    case KernelType::QUINTIC_SPLINE: return norm_ * quintic_spline(q);
    case KernelType::WENDLAND_C2: return norm_ * wendland_c2(q);
    case KernelType::WENDLAND_C4: return norm_ * wendland_c4(q);
  }
  return 0.0;    // not reached: the constructor has checked the type
}

double Kernel::dw(double r) const
{
  if (r >= support_) return 0.0;
  const double q = r / h_;
  const double norm = norm_ / h_;
  switch (type_) {
    case KernelType::CUBIC_SPLINE: return norm * cubic_spline_slope(q);
    case KernelType::QUINTIC_SPLINE: return norm * quintic_spline_slope(q);
    case KernelType::WENDLAND_C2: return norm * wendland_c2_slope(q);
    case KernelType::WENDLAND_C4: return norm * wendland_c4_slope(q);
  }
  return 0.0;    // not reached: the constructor has checked the type
}

}    // namespace aleisph
