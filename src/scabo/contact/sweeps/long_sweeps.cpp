#include "scabo/contact/sweeps/long_sweeps.hpp"

#include <algorithm>
#include <utility>

#include "scabo/base/interruption.hpp"
#include "scabo/contact/constants.hpp"
#include "scabo/contact/work.hpp"

namespace scabo::contact {

LongSweeps::LongSweeps(const Problem& problem, Vector p)
    : problem_(problem),
      measure_(problem),
      iteration_(gauss_seidel(problem)),
      changes_(sweep_constants.depth),
      p_(std::move(p)),
      best_(p_) {
  iteration_->start(p_);
}

bool LongSweeps::run(int most, const IsSolution& accepts, const Deadline& deadline) {
  if (settles(most, accepts, deadline)) return true;
  random_ = true;
  p_ = best_;
  round_.reset();
  return settles(most, accepts, deadline);
}

/// With extrapolation, or in random orders.
bool LongSweeps::settles(int most, const IsSolution& accepts, const Deadline& deadline) {
  const int first = sweeps_;
  int gained = first;
  double least = HUGE_VAL;
  const auto gains = [&] { return sweeps_ - gained <= std::max(sweep_constants.patience, (sweeps_ - first) / 2); };
  while (!deadline.passed() && sweeps_ - first < most && gains()) {
    const Vector before = p_;
    const bool moved = round(deadline);
    const Vector motion = motion_of(problem_, p_, Vector());
    const double map = measure_.natural_map(problem_, p_, motion);
    if (round_ && !(map <= round_->map)) {
      p_ = round_->p;
      round_.reset();
      changes_.forget();
      continue;
    }
    if (map < least_) {
      least_ = map;
      best_ = p_;
    }
    if (accepts && accepts(p_, Vector(), motion)) {
      best_ = p_;
      return true;
    }
    if (!moved || !std::isfinite(map)) break;
    if (map <= 0.5 * least) {
      least = map;
      gained = sweeps_;
    }
    if (random_) continue;
    changes_.remember(p_ - before, p_);
    round_ = Round{p_, map};
    if (!changes_.apply(p_, 2)) round_.reset();
  }
  return false;
}

/// Sweeps between two extrapolations; false where they change nothing.
bool LongSweeps::round(const Deadline& deadline) {
  iteration_->start(p_);  // afresh, without what rounding added from pair to pair
  bool moved = false;
  for (int sweep = 0; sweep < sweep_constants.round; ++sweep) {
    interruption_point();
    if (random_) iteration_->reorder(engine_);
    moved = iteration_->sweep(p_) > 0.0 || moved;
  }
  sweeps_ += sweep_constants.round;
  deadline.spend(sweep_constants.round * iteration_->part_of_work() * operations_of_sweep(problem_));
  return moved;
}

}  // namespace scabo::contact
