#include "scabo/contact/sweeps/long_sweeps.hpp"

#include <Eigen/QR>
#include <algorithm>
#include <utility>

#include "scabo/base/interruption.hpp"
#include "scabo/contact/constants.hpp"
#include "scabo/contact/work.hpp"

namespace scabo::contact {

LongSweeps::LongSweeps(const Problem& problem, Vector p)
    : problem_(problem), measure_(problem), iteration_(problem), changes_(p.size()), p_(std::move(p)), best_(p_) {
  iteration_.start(p_);
}

bool LongSweeps::run(int most, const IsSolution& accepts, const Deadline& deadline) {
  const auto go_on = [&] {
    return sweeps_ < most ||
           (sweeps_ < 4 * most && sweeps_ - gained_ <= std::max(sweep_constants.least_patience, sweeps_ / 2));
  };
  while (!deadline.passed() && go_on()) {
    const Vector before = p_;
    iteration_.start(p_);  // afresh, without what rounding added from pair to pair
    bool moved = false;
    for (int sweep = 0; sweep < sweep_constants.round; ++sweep) {
      interruption_point();
      moved = iteration_.sweep(p_) > 0.0 || moved;
    }
    sweeps_ += sweep_constants.round;
    deadline.spend(sweep_constants.round * (iteration_.of_joints() ? sweep_constants.part_of_joints : 1.0) *
                   operations_of_sweep(problem_));
    const Vector& motion = iteration_.motion();
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
    if (accepts && accepts(p_, Vector(), motion) && accepts(p_, Vector(), motion_of(problem_, p_, Vector()))) {
      best_ = p_;
      return true;
    }
    if (!moved || !std::isfinite(map)) break;
    if (least_ <= 0.5 * halved_) {
      halved_ = least_;
      gained_ = sweeps_;
    }
    changes_.remember(before, p_);
    round_ = Round{p_, map};
    if (!changes_.extrapolate(p_)) round_.reset();
  }
  return false;
}

LongSweeps::Changes::Changes(Eigen::Index n) : f_(n, sweep_constants.depth), p_(n, sweep_constants.depth) {}

void LongSweeps::Changes::remember(const Vector& before, const Vector& p) {
  Vector f = p - before;
  if (last_p_.size() > 0) {
    f_.col(next_) = f - last_f_;
    p_.col(next_) = p - last_p_;
    next_ = (next_ + 1) % sweep_constants.depth;
    count_ = std::min(count_ + 1, sweep_constants.depth);
  }
  last_f_ = std::move(f);
  last_p_ = p;
}

/// False where there is too little to go by.
bool LongSweeps::Changes::extrapolate(Vector& p) const {
  if (count_ < 2) return false;
  const Vector gamma = Matrix(f_.leftCols(count_)).colPivHouseholderQr().solve(last_f_);
  if (!gamma.allFinite()) return false;
  p.noalias() -= p_.leftCols(count_) * gamma;
  return true;
}

}  // namespace scabo::contact
