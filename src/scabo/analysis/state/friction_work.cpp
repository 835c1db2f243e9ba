#include "scabo/analysis/state/friction_work.hpp"

#include <algorithm>
#include <cmath>

namespace scabo::analysis {

namespace {

/// The bound against the slip when part x of it has taken place, while the normal force changes linearly.
double bound_at(const PairCourse& pair, double x) {
  contact::PairHistory history = pair.history_before;
  history.slip += x * pair.slip.norm();
  const double pressing = std::max(std::lerp(pair.pressing_before, pair.pressing_after, x), 0.0);
  const bool backward = pair.slip.size() == 1 && pair.slip[0] < 0.0;
  const auto of = [&](const contact::Law& law) {
    const contact::Limits limits = law.limits(history);
    return limits.cohesion * pair.area + (backward ? limits.mu_backward.value_or(limits.mu) : limits.mu) * pressing;
  };
  const double at = x > 0.0 ? std::lerp(of(pair.law_before), of(pair.law_after), x) : of(pair.law_before);
  return std::isfinite(at) ? at : pair.shearing_before.norm();  // a bonded pair has none, and no slip but rounding
}

/// The force at the end, as it was solved.
double force_at_end(const PairCourse& pair) {
  return std::max(-pair.shearing_after.dot(pair.slip / pair.slip.norm()), 0.0);
}

/// The mean of the bound: exact for Coulomb's law; to 1e-4 where a coefficient falls with slip and then no further.
double mean_bound(const PairCourse& pair) {
  const int parts = pair.law_before.remembers() || pair.law_after.remembers() ? 64 : 1;
  double sum = 0.5 * (bound_at(pair, 0.0) + force_at_end(pair));
  for (int k = 1; k < parts; ++k) sum += bound_at(pair, static_cast<double>(k) / parts);
  return sum / parts;
}

/// Whether the pair may have begun or ended to slip anywhere within the increment. A pair that touches without force
/// slips from the start, as the force grows.
bool has_changed(const PairCourse& pair) {
  if (pair.state_before == contact::ContactState::open && pair.pressing_before == 0.0 && pair.gap_before <= 0.0)
    return false;
  const bool turned = pair.shearing_before.dot(pair.slip) > 0.0;
  return turned || pair.state_before != pair.state_after;
}

}  // namespace

void add_friction_work(const PairCourse& pair, FrictionWork& total) {
  const double way = pair.slip.norm();
  if (way == 0.0) return;
  // Where the strength fell at once, the slip took place under what was left of it.
  const contact::PairHistory &before = pair.history_before, &after = pair.history_after;
  if (before.broken != after.broken || before.slipped != after.slipped) {
    total.work += force_at_end(pair) * way;
    return;
  }
  const double work = mean_bound(pair) * way;
  total.work += work;
  total.beyond_rule += work + 0.5 * (pair.shearing_before + pair.shearing_after).dot(pair.slip);
  if (has_changed(pair)) total.error += 0.5 * std::abs(force_at_end(pair) - bound_at(pair, 0.0)) * way;
}

FrictionWork friction_work(const Prepared& prepared, const State& from, const State& to) {
  FrictionWork total;
  const contact::JointLaws before = laws_at(prepared, from.factors), after = laws_at(prepared, to.factors);
  for (Eigen::Index k = 0; k < to.slip.size(); ++k) {
    const auto i = static_cast<std::size_t>(k);
    if (to.slip[k] == from.slip[k]) continue;
    add_friction_work({*before.of_pair[i], *after.of_pair[i], after.area[k], from.history[i], to.history[i],
                       from.p[2 * k], to.p[2 * k], from.p.segment(2 * k + 1, 1), to.p.segment(2 * k + 1, 1),
                       to.slip.segment(k, 1) - from.slip.segment(k, 1), from.gap[k], from.states[i], to.states[i]},
                      total);
  }
  return total;
}

}  // namespace scabo::analysis
