#include "scabo/analysis/growth/fatigue.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "scabo/analysis/growth/criteria.hpp"
#include "scabo/analysis/growth/overlap.hpp"
#include "scabo/analysis/state/step_factors.hpp"

namespace scabo::analysis {

namespace {

/// Factors below this part of those at the other end of the cycle are none.
constexpr double no_load = 1e-6;

/// Why a tip does not grow by the cycles between these factors; empty if it does.
std::string why_not(const std::string& name, const Vec2& low, const Vec2& high, double turn) {
  constexpr double degree = 0.017453292519943295;
  if (low.norm() > high.norm())
    return fmt::format("the first load of 'between' is the higher one at the tip '{}': exchange the two", name);
  if (high[0] < -no_load * high.norm() || low[0] < -no_load * high.norm())
    return fmt::format(
        "the loads of the cycle close the crack at its tip '{}' (K_I < 0), and growth of cracks in contact is not "
        "available in this version",
        name);
  if (std::abs(turn) > degree)
    return fmt::format(
        "the mode mix at the tip '{}' turns within a cycle, by {:.3g} degrees of the kink, for which no law of growth "
        "is available",
        name, std::abs(turn) / degree);
  return {};
}

}  // namespace

double growth_per_cycle(const model::LoadCycles& cycles, double range, double highest) {
  const double R = highest > 0.0 ? 1.0 - range / highest : 0.0;
  switch (cycles.law) {
    case model::FatigueLaw::paris:
      return cycles.C * std::pow(range, cycles.m);
    case model::FatigueLaw::walker:
      return cycles.C * std::pow(range / std::pow(1.0 - R, 1.0 - *cycles.gamma), cycles.m);
    case model::FatigueLaw::forman: {
      const double left = (1.0 - R) * *cycles.K_c - range;
      return left > 0.0 ? cycles.C * std::pow(range, cycles.m) / left : std::numeric_limits<double>::infinity();
    }
  }
  return 0.0;
}

Factors factors_in_cycle(const model::Model& model, int end) {
  const model::LoadCycles& cycles = *model.steps.back().growth->cycles;
  Factors factors = factors_in(model, model.steps.size() - 1, 1.0);
  factors.loads = cycles.loads[static_cast<std::size_t>(end)];
  factors.supports = cycles.supports[static_cast<std::size_t>(end)];
  return factors;
}

std::variant<std::vector<CycledTip>, std::string> cycled_tips(const Prepared& prepared, const std::vector<Tip>& tips,
                                                              const Options& options) {
  const model::GrowthStep& growth = *prepared.model.steps.back().growth;
  std::vector<std::vector<Vec2>> ends;
  for (const int end : {0, 1}) {
    const Factors factors = factors_in_cycle(prepared.model, end);
    if (!is_loaded(factors)) {
      ends.emplace_back(tips.size(), Vec2(0.0, 0.0));
      continue;
    }
    const Reached reached = reach_from_rest(prepared, factors, options);
    if (!reached.reason.empty()) return reached.reason;
    if (std::string reason = overlap(prepared, describe(prepared, reached.state).fields); !reason.empty())
      return reason;
    auto found = factors_of_tips(prepared, tips, reached.state);
    if (auto* reason = std::get_if<std::string>(&found)) return *reason;
    ends.push_back(std::get<std::vector<Vec2>>(std::move(found)));
  }
  std::vector<CycledTip> cycled;
  for (std::size_t t = 0; t < tips.size(); ++t) {
    const Vec2 low = ends[0][t], high = ends[1][t];
    CycledTip tip;
    if (high.norm() == 0.0) {
      cycled.push_back(tip);
      continue;
    }
    const double kappa = material_constants(prepared, tips[t]).kappa;
    const auto kink = [&](const Vec2& K) { return kink_of(growth.criterion, {std::max(K[0], 0.0), K[1]}, kappa); };
    const Kink at_high = kink(high), at_low = low.norm() > no_load * high.norm() ? kink(low) : Kink{at_high.angle, 0.0};
    if (std::string reason = why_not(name_of(prepared.model, tips[t]), low, high, at_low.angle - at_high.angle);
        !reason.empty())
      return reason;
    tip.kink = at_high.angle;
    tip.highest = at_high.equivalent;
    tip.range = at_high.equivalent - at_low.equivalent;
    tip.rate = growth_per_cycle(*growth.cycles, tip.range, tip.highest);
    cycled.push_back(tip);
  }
  return cycled;
}

}  // namespace scabo::analysis
