// SPDX-License-Identifier: GPL-2.0-only
/* ----------------------------------------------------------------------
   Wall-clock seconds by part of the step. Scopes nest; the time of an inner
   scope is not counted in the outer one, so that the parts add up.
------------------------------------------------------------------------- */

#ifndef LMP_ALEISPH_TIMERS_H
#define LMP_ALEISPH_TIMERS_H

#include <array>
#include <chrono>

namespace aleisph {

enum class Part {
  OUTSIDE,
  STENCIL,
  OPERATORS,
  SURFACE,
  TENSION,
  MOMENTUM,
  ASSEMBLY,
  PRECONDITIONER,
  SOLVE,
  SHIFT,
  COMM
};
constexpr int NUM_PARTS = 11;

inline const char *to_string(Part part)
{
  static const char *const names[NUM_PARTS] = {
      "outside",  "stencil",        "operators", "surface", "tension",      "momentum",
      "assembly", "preconditioner", "solve",     "shift",   "communication"};
  return names[static_cast<int>(part)];
}

class Timers {
 public:
  class Scope {
   public:
    Scope(Timers &timers, Part part) : timers_(timers), outer_(timers.enter(part)) {}
    ~Scope() { timers_.enter(outer_); }
    Scope(const Scope &) = delete;
    Scope &operator=(const Scope &) = delete;

   private:
    Timers &timers_;
    Part outer_;
  };

  double seconds(Part part) const { return seconds_[static_cast<int>(part)]; }
  void reset() { seconds_.fill(0.0); }

 private:
  Part enter(Part next)
  {
    const auto now = Clock::now();
    seconds_[static_cast<int>(current_)] += std::chrono::duration<double>(now - since_).count();
    const Part previous = current_;
    current_ = next;
    since_ = now;
    return previous;
  }

  using Clock = std::chrono::steady_clock;
  Part current_ = Part::OUTSIDE;
  Clock::time_point since_ = Clock::now();
  std::array<double, NUM_PARTS> seconds_ = {};
};

}    // namespace aleisph
#endif
