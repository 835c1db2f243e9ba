#include "scabo/analysis/growth/fatigue.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "scabo/analysis/growth/longer_pairs.hpp"
#include "scabo/analysis/growth/overlap.hpp"
#include "scabo/analysis/state/step_factors.hpp"

namespace scabo::analysis {

namespace {

/// Factors below this part of those at the other end of the cycle are none; below the second part their mode mix does
/// not matter.
constexpr double no_load = 1e-6, no_mix = 1e-2;

/// Why a tip does not grow by the cycles between these factors; empty if it does.
std::string why_not(const model::Model& model, const Tip& at, const Vec2& low, const Vec2& high, double turn) {
  constexpr double degree = 0.017453292519943295;
  const std::string name = name_of(model, at);
  if (low.norm() > high.norm())
    return fmt::format("the first load of 'between' is the higher one at the tip '{}': exchange the two", name);
  const bool closed = high[0] < -no_load * high.norm() || low[0] < -no_load * high.norm();
  if (closed && !has_contact(model, at))
    return fmt::format(
        "the loads of the cycle close the crack at its tip '{}' (K_I < 0): give a contact between the faces of '{}', "
        "so that they touch",
        name, name_of_crack(model, at));
  if (low.norm() > no_mix * high.norm() && std::abs(turn) > degree)
    return fmt::format(
        "the mode mix at the tip '{}' turns within a cycle, by {:.3g} degrees of the kink, for which no law of growth "
        "is available",
        name, std::abs(turn) / degree);
  return {};
}

/// Factors of all tips in a state; of those that stick none.
FactorsOfTips factors_in(const Prepared& prepared, const std::vector<Tip>& tips, const State& state) {
  if (std::string reason = overlap(prepared, describe(prepared, state).fields); !reason.empty()) return reason;
  auto found = factors_of_tips(prepared, tips, state);
  if (std::holds_alternative<std::string>(found)) return found;
  for (std::size_t t = 0; t < tips.size(); ++t)
    if (is_stuck(prepared, state, tips[t])) std::get<std::vector<TipFactors>>(found)[t] = {};
  return found;
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

std::variant<Cycled, std::string> cycled_tips(const Prepared& prepared, const std::vector<Tip>& tips, const State& from,
                                              const Options& options) {
  const model::GrowthStep& growth = *prepared.model.steps.back().growth;
  std::vector<TipFactors> low(tips.size()), high;
  Cycled cycled;
  cycled.highest.state = from;
  const bool has_contacts = !prepared.model.contacts.empty();
  for (const int end : has_contacts ? std::vector<int>{0, 1, 0, 1} : std::vector<int>{0, 1}) {
    const Factors factors = factors_in_cycle(prepared.model, end);
    if (!has_contacts) {
      if (end == 0 && is_at_rest(prepared, factors)) continue;
      cycled.highest.state = initial_state(prepared);
    }
    cycled.highest = reach_from(prepared, cycled.highest.state, factors, options);
    if (!cycled.highest.reason.empty()) return cycled.highest.reason;
    auto found = factors_in(prepared, tips, cycled.highest.state);
    if (auto* reason = std::get_if<std::string>(&found)) return *reason;
    (end == 0 ? low : high) = std::get<std::vector<TipFactors>>(std::move(found));
  }
  for (std::size_t t = 0; t < tips.size(); ++t) {
    CycledTip& tip = cycled.tips.emplace_back();
    if (high[t].K.norm() == 0.0) continue;
    const double kappa = material_constants(prepared, tips[t]).kappa;
    tip.kink = kink_at(growth.criterion, high[t], kappa);
    tip.highest = equivalent_factor(growth.criterion, high[t], kappa);
    const bool loaded = low[t].K.norm() > no_load * high[t].K.norm();
    const double turn = loaded ? kink_at(growth.criterion, low[t], kappa) - tip.kink : 0.0;
    if (std::string reason = why_not(prepared.model, tips[t], low[t].K, high[t].K, turn); !reason.empty())
      return reason;
    tip.range = tip.highest - (loaded ? equivalent_factor(growth.criterion, low[t], kappa) : 0.0);
    tip.rate = growth_per_cycle(*growth.cycles, tip.range, tip.highest);
  }
  return cycled;
}

std::variant<std::vector<CycledTip>, std::string> cycled_again(const Prepared& prepared, const std::vector<Tip>& tips,
                                                               const State& highest, const GrowthResult& known) {
  const model::GrowthStep& growth = *prepared.model.steps.back().growth;
  auto found = factors_in(prepared, tips, highest);
  if (auto* reason = std::get_if<std::string>(&found)) return *reason;
  std::vector<CycledTip> cycled;
  for (std::size_t t = 0; t < tips.size(); ++t) {
    const TipFactors& high = std::get<std::vector<TipFactors>>(found)[t];
    CycledTip& tip = cycled.emplace_back();
    if (high.K.norm() == 0.0) continue;
    const double kappa = material_constants(prepared, tips[t]).kappa;
    tip.kink = kink_at(growth.criterion, high, kappa);
    tip.highest = equivalent_factor(growth.criterion, high, kappa);
    tip.range = *known.tips[t].range;
    tip.rate = growth_per_cycle(*growth.cycles, tip.range, tip.highest);
  }
  return cycled;
}

}  // namespace scabo::analysis
