#include "scabo/analysis/state/friction_work.hpp"

#include <algorithm>
#include <cmath>

namespace scabo::analysis {

namespace {

/// The slip of one pair in an increment, along the path on which its normal force changes linearly.
class PairSlip {
 public:
  PairSlip(const contact::Law& before, const contact::Law& after, double area, const contact::PairHistory& history,
           const Vec2& p_before, const Vec2& p_after, double slip)
      : before_(before),
        after_(after),
        area_(area),
        history_(history),
        p_before_(p_before),
        p_after_(p_after),
        slip_(slip) {}

  /// The bound against the slip when part x of it has taken place.
  double bound(double x) const {
    contact::PairHistory history = history_;
    history.slip += x * std::abs(slip_);
    const double pressing = std::max(std::lerp(p_before_[0], p_after_[0], x), 0.0);
    const auto of = [&](const contact::Law& law) {
      const contact::Limits limits = law.limits(history);
      const double mu = slip_ < 0.0 ? limits.mu_backward.value_or(limits.mu) : limits.mu;
      return limits.cohesion * area_ + mu * pressing;
    };
    const double at = x > 0.0 ? std::lerp(of(before_), of(after_), x) : of(before_);
    return std::isfinite(at) ? at : std::abs(p_before_[1]);  // a bonded pair has none, and no slip but rounding
  }

  /// The mean of the bound: exact for Coulomb's law; to 1e-4 where a coefficient falls with slip and then no further.
  double mean_bound() const {
    const int parts = before_.remembers() || after_.remembers() ? 64 : 1;
    double sum = 0.5 * (bound(0.0) + at_end());
    for (int k = 1; k < parts; ++k) sum += bound(static_cast<double>(k) / parts);
    return sum / parts;
  }

  /// The force at the end, as it was solved.
  double at_end() const { return std::max(-p_after_[1] * (slip_ < 0.0 ? -1.0 : 1.0), 0.0); }

 private:
  const contact::Law &before_, &after_;
  double area_;
  const contact::PairHistory& history_;
  Vec2 p_before_, p_after_;
  double slip_;
};

/// Whether the pair may have begun or ended to slip anywhere within the increment. A pair that touches without force
/// slips from the start, as the force grows.
bool has_changed(const State& from, const State& to, std::size_t i, double slip) {
  const auto k = static_cast<Eigen::Index>(i);
  if (from.states[i] == contact::ContactState::open && from.p[2 * k] == 0.0 && from.gap[k] <= 0.0) return false;
  const bool turned = from.p[2 * k + 1] * slip > 0.0;
  return turned || from.states[i] != to.states[i];
}

}  // namespace

FrictionWork friction_work(const Prepared& prepared, const State& from, const State& to) {
  FrictionWork total;
  const contact::JointLaws before = laws_at(prepared, from.factors), after = laws_at(prepared, to.factors);
  for (Eigen::Index k = 0; k < to.slip.size(); ++k) {
    const auto i = static_cast<std::size_t>(k);
    const double slip = to.slip[k] - from.slip[k];
    if (slip == 0.0) continue;
    const contact::PairHistory &history = from.history[i], &reached = to.history[i];
    const PairSlip pair(*before.of_pair[i], *after.of_pair[i], after.area[k], history, from.p.segment<2>(2 * k),
                        to.p.segment<2>(2 * k), slip);
    // Where the strength fell at once, the slip took place under what was left of it.
    if (history.broken != reached.broken || history.slipped != reached.slipped) {
      total.work += pair.at_end() * std::abs(slip);
      continue;
    }
    const double work = pair.mean_bound() * std::abs(slip);
    total.work += work;
    total.beyond_rule += work + 0.5 * (from.p[2 * k + 1] + to.p[2 * k + 1]) * slip;
    if (has_changed(from, to, i, slip)) total.error += 0.5 * std::abs(pair.at_end() - pair.bound(0.0)) * std::abs(slip);
  }
  return total;
}

}  // namespace scabo::analysis
