#include "scabo/analysis/march/increment_size.hpp"

#include <algorithm>
#include <cmath>

#include "scabo/base/components.hpp"

namespace scabo::analysis {

namespace {

/// Open, stick, or slip along t or against it.
int state_of(const State& state, std::size_t pair) {
  switch (state.states[pair]) {
    case contact::ContactState::open:
      return 0;
    case contact::ContactState::stick:
      return 1;
    case contact::ContactState::slip:
      return state.p[place_of(pair, 1)] >= 0.0 ? 2 : 3;
  }
  throw BrokenInvariant("a pair without a state");
}

/// Whether the forces of a pair depend on the path that the loads take.
bool depends_on_path(const contact::Law& law) {
  const contact::Limits limits = law.limits({});
  return limits.mu > 0.0 || limits.mu_backward.value_or(0.0) > 0.0 || limits.cohesion > 0.0 || limits.tension > 0.0;
}

}  // namespace

double Changes::wanted(const IncrementRule& rule) const { return std::max(1.0, rule.share * in_contact); }

bool Changes::too_many(const IncrementRule& rule) const { return changed - released > rule.too_many * wanted(rule); }

Changes changes_between(const Prepared& prepared, const State& from, const State& to) {
  const bool first = from.largest_force == 0.0 && from.p.isZero(0.0);
  const std::vector<bool> touching = first ? touching_pairs(prepared) : std::vector<bool>{};
  Changes changes;
  for (std::size_t i = 0; i < to.states.size(); ++i) {
    if (!depends_on_path(*prepared.contact.laws.of_pair[i])) continue;
    const int before = state_of(from, i), after = state_of(to, i);
    if (before == 0 && after == 0) continue;
    ++changes.in_contact;
    if (before == after || (first && touching[i])) continue;
    ++changes.changed;
    changes.released += before >= 2 && after == 1;
  }
  return changes;
}

double next_size(const model::AutomaticIncrements& limits, double size, bool was_halved, const Changes& changes,
                 const IncrementRule& rule) {
  double ratio = was_halved ? 1.0 : rule.growth;
  if (changes.changed > 0) ratio = std::min(ratio, std::max(rule.reduction, changes.wanted(rule) / changes.changed));
  return std::clamp(ratio * size, limits.smallest, limits.largest);
}

double next_end(const model::Step& step, const StepProgress& progress, const std::vector<double>& corners) {
  if (!step.automatic) {
    const auto k = static_cast<std::size_t>(progress.increment);
    return step.ends.empty() ? static_cast<double>(progress.increment + 1) / step.increments : step.ends.at(k);
  }
  constexpr double rounding_of_sums = 1e-9;
  const auto corner = std::upper_bound(corners.begin(), corners.end(), progress.reached + rounding_of_sums);
  const double last = corner == corners.end() ? 1.0 : *corner;
  double size = progress.size > 0.0 ? progress.size : step.automatic->first;
  if (const double ahead = progress.limit - progress.reached; ahead > 0.0) {
    if (ahead <= step.automatic->smallest * (1.0 + rounding_of_sums)) return progress.limit;
    size = std::min(size, std::max(0.5 * ahead, step.automatic->smallest));
  }
  const double left = last - progress.reached;
  if (left <= size * (1.0 + rounding_of_sums)) return last;
  // What is left is divided in halves, so that no small rest remains.
  return progress.reached + (left < 2.0 * size ? std::max(0.5 * left, step.automatic->smallest) : size);
}

}  // namespace scabo::analysis
