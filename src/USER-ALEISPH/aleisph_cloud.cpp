// SPDX-License-Identifier: GPL-2.0-only

#include "aleisph_cloud.h"

#include <cmath>

namespace aleisph {

Cloud::Cloud(const Kernel &kernel, double spacing, Timers &timers) :
    kernel_(kernel), spacing_(spacing), volume_(std::pow(spacing, kernel.dim())), timers_(timers)
{
}

void Cloud::update(int nowned, const double *const *x, const CandidateList &list, const Role *role,
                   bool dry)
{
  Timers::Scope scope(timers_, Part::STENCIL);
  PairFilter filter;
  if (dry) filter = {role, ~0u, DRY};
  stencil_.build(kernel_, nowned, x, list, filter);
  role_ = role;
  sort_rows(nowned, role);
  have_gradient_ = have_laplacian_ = have_weights_ = have_seen_ = false;
  counts_.stencil++;
}

void Cloud::sort_rows(int nowned, const Role *role)
{
  fluid_.clear();
  wall_.clear();
  buffer_.clear();
  all_.resize(nowned);
  for (int i = 0; i < nowned; i++) {
    all_[i] = i;
    if (role[i] & DRY) continue;
    if (role[i] & WALL)
      wall_.push_back(i);
    else if (role[i] & BUFFER)
      buffer_.push_back(i);
    else if (role[i] & FLUID)
      fluid_.push_back(i);
  }
}

const GradientWeights &Cloud::gradient()
{
  if (!have_gradient_) {
    Timers::Scope scope(timers_, Part::OPERATORS);
    gradient_.build(stencil_, volume_, fluid_, floor_);
    have_gradient_ = true;
    counts_.gradient++;
  }
  return gradient_;
}

const Role *Cloud::seen()
{
  if (!have_seen_) {
    Timers::Scope scope(timers_, Part::STENCIL);
    SeenRoles(stencil_, role_).make_table(seen_);
    have_seen_ = true;
  }
  return seen_.data();
}

const LaplacianWeights &Cloud::laplacian()
{
  if (!have_weights_) {
    const GradientWeights &g = gradient();
    Timers::Scope scope(timers_, Part::OPERATORS);
    laplacian_.build(stencil_, g, fluid_, kernel_, spacing_, LaplacianLimits(), role_);
    have_laplacian_ = have_weights_ = true;
    counts_.laplacian++;
  }
  return laplacian_;
}

void Cloud::laplacian_weights(bool keep, std::vector<double> &a)
{
  if (keep) {
    laplacian();
    a.assign(laplacian_.a(), laplacian_.a() + stencil_.pairs());
  } else {
    if (!have_weights_) laplacian_.swap_weights(a);    // built in the memory of a
    laplacian();
    laplacian_.swap_weights(a);
    have_weights_ = false;
  }
}

const LaplacianWeights &Cloud::laplacian_rows()
{
  return have_laplacian_ ? laplacian_ : laplacian();
}

}    // namespace aleisph
