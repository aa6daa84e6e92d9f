// SPDX-License-Identifier: GPL-2.0-only

#include "aleisph_cloud.h"

#include <cmath>

namespace aleisph {

Cloud::Cloud(const Kernel &kernel, double spacing, Timers &timers) :
    kernel_(kernel), spacing_(spacing), volume_(std::pow(spacing, kernel.dim())), timers_(timers)
{
  stencil_.set_close(CLOSE * spacing);
}

void Cloud::reset(int nowned, int n)
{
  nowned_ = nowned;
  role_.assign(n, 0);
  normal_.assign(3 * static_cast<std::size_t>(n), 0.0);
  shape_.assign(n, 0.0);
  have_seen_ = false;
}

void Cloud::update(const double *const *x, const CandidateList &list, bool dry)
{
  Timers::Scope scope(timers_, Part::STENCIL);
  PairFilter filter;
  if (dry) filter = {role_.data(), ~0u, DRY};
  stencil_.build(kernel_, nowned_, x, list, filter);
  sort_rows();
  have_gradient_ = have_laplacian_ = have_weights_ = have_seen_ = false;
  counts_.stencil++;
  version_++;
}

void Cloud::sort_rows()
{
  // the first of these roles that a particle has says where it belongs
  const auto belongs = [this](int i) {
    for (const Role role : {DRY, WALL, BUFFER, FLUID})
      if (role_[i] & role) return role;
    return Role(0);
  };
  const auto rows_of = [&](Role role) {
    return select_rows(nowned_, [&](int i) { return belongs(i) == role; });
  };
  fluid_ = rows_of(FLUID);
  wall_ = rows_of(WALL);
  buffer_ = rows_of(BUFFER);
  all_.resize(nowned_);
  for_rows(nowned_, [this](int i) { all_[i] = i; });
}

const GradientWeights &Cloud::gradient() const
{
  if (!have_gradient_) {
    Timers::Scope scope(timers_, Part::OPERATORS);
    gradient_.build(stencil_, volume_, fluid_, floor_);
    have_gradient_ = true;
    counts_.gradient++;
  }
  return gradient_;
}

SeenRoles Cloud::neighbours() const
{
  if (!have_seen_) {
    Timers::Scope scope(timers_, Part::STENCIL);
    SeenRoles(stencil_, role_.data()).make_table(seen_);
    have_seen_ = true;
  }
  return SeenRoles(stencil_, role_.data(), seen_.data());
}

const LaplacianWeights &Cloud::laplacian() const
{
  if (!have_weights_) {
    const GradientWeights &g = gradient();
    Timers::Scope scope(timers_, Part::OPERATORS);
    laplacian_.build(stencil_, g, fluid_, laplacian_bounds(limits_, kernel_, spacing_),
                     role_.data());
    have_laplacian_ = have_weights_ = true;
    counts_.laplacian++;
  }
  return laplacian_;
}

void Cloud::laplacian_weights(bool keep, std::vector<double> &a) const
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

const LaplacianWeights &Cloud::laplacian_rows() const
{
  return have_laplacian_ ? laplacian_ : laplacian();
}

double Cloud::bytes() const
{
  return stencil_.bytes() + gradient_.bytes() + laplacian_.bytes() +
      static_cast<double>(sizeof(double) * (normal_.capacity() + shape_.capacity()) +
                          sizeof(Role) * (role_.capacity() + seen_.capacity()));
}

}    // namespace aleisph
