#include "scabo/analysis/growth/sought.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "scabo/analysis/growth/criteria.hpp"
#include "scabo/analysis/growth/longer_pairs.hpp"
#include "scabo/analysis/quasistatic/attempt.hpp"
#include "scabo/analysis/state/cracks.hpp"

namespace scabo::analysis {

namespace {

constexpr double infinite = std::numeric_limits<double>::infinity();

/// Where the tips are.
GrowthResult tips_of(const model::Model& model, const std::vector<Tip>& tips) {
  GrowthResult result;
  for (const Tip& at : tips) {
    TipResult tip;
    tip.name = name_of(model, at);
    tip.position = position_of(model, at);
    tip.length = length_of(crack_of(model, at));
    result.tips.push_back(std::move(tip));
  }
  return result;
}

/// Tips that are critical at the load factor of the leading one, or nearly so, grow.
void let_grow(GrowthResult& result) {
  for (TipResult& tip : result.tips) tip.grows = tip.load_factor <= (1.0 + together) * result.load_factor;
}

/// The tips in the state of a load factor.
GrowthResult critical_tips(const model::Model& model, const std::vector<Tip>& tips,
                           const std::vector<TipPattern>& patterns) {
  GrowthResult result = tips_of(model, tips);
  result.load_factor = infinite;
  for (std::size_t t = 0; t < tips.size(); ++t) {
    result.tips[t].load_factor = critical_factor(model.steps.back().growth->criterion, patterns[t]);
    result.load_factor = std::min(result.load_factor, result.tips[t].load_factor);
  }
  let_grow(result);
  return result;
}

/// The tips at the highest load of a cycle.
GrowthResult tips_in_cycle(const Prepared& prepared, const std::vector<Tip>& tips,
                           const std::vector<CycledTip>& cycled) {
  const model::GrowthStep& growth = *prepared.model.steps.back().growth;
  GrowthResult result = tips_of(prepared.model, tips);
  result.load_factor = 1.0;
  double fastest = 0.0;
  for (const CycledTip& tip : cycled) fastest = std::max(fastest, tip.rate);
  for (std::size_t t = 0; t < tips.size(); ++t) {
    TipResult& tip = result.tips[t];
    tip.range = cycled[t].range;
    double breaks_at = growth.cycles->K_c.value_or(infinite);
    if (growth.K_Ic) breaks_at = std::min(breaks_at, toughness_of(growth, material_constants(prepared, tips[t])));
    tip.load_factor = breaks_at / cycled[t].highest;
    tip.grows = cycled[t].rate > 0.0 && cycled[t].rate >= least_rate * fastest;
  }
  return result;
}

constexpr const char* critical_alone =
    "a tip is critical under the loads that stay alone: let 'scale' name them, or make them smaller";
constexpr const char* never_critical =
    "no factor of the scaled loads makes a tip critical: they close the crack, or do not reach it";

/// Why a tip with these factors does not grow, if its faces may overlap; empty if it does.
std::string closed(const model::Model& model, const Tip& tip, const Vec2& K) {
  constexpr double rounding = 1e-6;
  if (!(K[0] < -rounding * K.norm()) || has_contact(model, tip)) return {};
  return fmt::format(
      "the loads close the crack at its tip '{}' (K_I < 0): give a contact between the faces of '{}', "
      "so that they touch",
      name_of(model, tip), name_of_crack(model, tip));
}

/// Whether any load or support has a factor other than 0.
bool is_loaded(const Factors& factors) {
  const auto acts = [](double factor) { return factor != 0.0; };
  return std::any_of(factors.loads.begin(), factors.loads.end(), acts) ||
         std::any_of(factors.supports.begin(), factors.supports.end(), acts);
}

/// Trial states with contacts.
class Trials {
 public:
  Trials(const Prepared& prepared, const std::vector<Tip>& tips, const State& from, const Options& options)
      : prepared_(prepared), tips_(tips), from_(from), options_(options) {
    for (const Tip& tip : tips) materials_.push_back(material_constants(prepared, tip));
  }

  struct Trial {
    double lambda = 0.0;
    std::vector<double> part;  ///< of every tip: K* over the toughness
    std::string failed;
    std::optional<Reached> reached;

    double most() const { return *std::max_element(part.begin(), part.end()); }
  };

  Trial at(double lambda) const {
    Trial trial{lambda, std::vector<double>(tips_.size(), 0.0), {}, {}};
    const Factors factors = factors_at(prepared_.model, lambda);
    if (!is_loaded(factors) && from_.p.isZero(0.0)) return trial;
    Reached reached = reach_from(prepared_, from_, factors, options_);
    trial.failed = reached.reason;
    if (!trial.failed.empty()) return trial;
    const auto found = factors_of_tips(prepared_, tips_, reached.state);
    if (const auto* reason = std::get_if<std::string>(&found)) return trial.failed = *reason, trial;
    const model::GrowthStep& growth = *prepared_.model.steps.back().growth;
    for (std::size_t t = 0; t < tips_.size(); ++t) {
      const TipFactors& at_tip = std::get<std::vector<TipFactors>>(found)[t];
      if (is_stuck(prepared_, reached.state, tips_[t])) continue;
      trial.failed = closed(prepared_.model, tips_[t], at_tip.K);
      if (!trial.failed.empty()) return trial;
      trial.part[t] =
          equivalent_factor(growth.criterion, at_tip, materials_[t].kappa) / toughness_of(growth, materials_[t]);
    }
    trial.reached = std::move(reached);
    return trial;
  }

  const std::vector<MaterialConstants>& materials() const { return materials_; }

 private:
  const Prepared& prepared_;
  const std::vector<Tip>& tips_;
  const State& from_;
  const Options& options_;
  std::vector<MaterialConstants> materials_;
};

using Trial = Trials::Trial;

/// Where a tip is critical by two trials.
double critical_by(const Trial& one, const Trial& other, std::size_t t) {
  const double slope = (one.part[t] - other.part[t]) / (one.lambda - other.lambda);
  if (one.part[t] == 1.0) return one.lambda;
  return slope > 0.0 ? one.lambda + (1.0 - one.part[t]) / slope : infinite;
}

/// The next load factor to try after `last` and `before`, between the largest one known to be too small and the
/// smallest too large.
double next_trial(const Trial& last, const Trial& before, double low, double high) {
  const double slope = (last.most() - before.most()) / (last.lambda - before.lambda);
  const double by_secant = last.lambda + (1.0 - last.most()) / slope;
  if (std::isfinite(by_secant) && by_secant > low && by_secant < high) return by_secant;
  return std::isfinite(high) ? 0.5 * (low + high) : 2.0 * low;
}

}  // namespace

double rate_of(const GrowthResult& at, const std::vector<CycledTip>& cycled) {
  double rate = 0.0;
  for (std::size_t t = 0; t < at.tips.size(); ++t)
    if (at.tips[t].grows) rate += cycled[t].rate;
  return rate;
}

Sought sought_without_contact(const Prepared& prepared, const std::vector<Tip>& tips, const Options& options) {
  Sought now;
  auto found = tip_patterns(prepared, tips, options);
  if (auto* reason = std::get_if<std::string>(&found)) return now.failed = std::move(*reason), now;
  const auto& patterns = std::get<std::vector<TipPattern>>(found);
  now.at = critical_tips(prepared.model, tips, patterns);
  now.factors = factors_at(prepared.model, now.at.load_factor);
  if (now.at.load_factor == 0.0)
    now.failed = critical_alone;
  else if (!std::isfinite(now.at.load_factor))
    now.failed = never_critical;
  for (std::size_t t = 0; t < tips.size(); ++t) {
    now.materials.push_back(patterns[t].material);
    if (now.failed.empty()) now.failed = closed(prepared.model, tips[t], patterns[t].at(now.at.load_factor).K);
  }
  return now;
}

Sought sought_in_contact(const Prepared& prepared, const std::vector<Tip>& tips, const State& from, double guess,
                         const Options& options) {
  constexpr double rounding = 1e-9, farthest = 1e3;  // from the guess, where the secant does not show the way
  constexpr int most_trials = 60;
  const Trials trials(prepared, tips, from, options);
  Sought now;
  now.materials = trials.materials();
  Trial before = trials.at(0.0), last;
  if (before.failed.empty() && before.most() >= 1.0) before.failed = critical_alone;
  if (!before.failed.empty()) return now.failed = before.failed, now;
  double low = 0.0, high = infinite, lambda = guess;
  for (int k = 0;; ++k) {
    last = trials.at(lambda);
    if (!last.failed.empty()) return now.failed = last.failed, now;
    if (std::abs(last.most() - 1.0) <= rounding) break;
    (last.most() < 1.0 ? low : high) = lambda;
    lambda = next_trial(last, before, low, high);
    if (lambda == 2.0 * low && lambda > farthest * guess) return now.failed = never_critical, now;
    if (k == most_trials || !(lambda > low && lambda < high))
      return now.failed = fmt::format(
                 "the load factor at which a tip is critical is not found: between {:.9g} and "
                 "{:.9g} pairs change their states back and forth",
                 low, high),
             now;
    before = std::move(last);
  }
  now.at = tips_of(prepared.model, tips);
  now.at.load_factor = last.lambda;
  for (std::size_t t = 0; t < tips.size(); ++t) now.at.tips[t].load_factor = critical_by(last, before, t);
  let_grow(now.at);
  now.factors = factors_at(prepared.model, last.lambda);
  now.reached = std::move(last.reached);
  return now;
}

Sought sought_in_cycle(const Prepared& prepared, const std::vector<Tip>& tips, const State& from,
                       const Options& options) {
  Sought now;
  auto found = cycled_tips(prepared, tips, from, options);
  if (auto* reason = std::get_if<std::string>(&found)) return now.failed = std::move(*reason), now;
  now.cycled = std::get<Cycled>(found).tips;
  now.reached = std::get<Cycled>(std::move(found)).highest;
  now.at = tips_in_cycle(prepared, tips, now.cycled);
  if (rate_of(now.at, now.cycled) == 0.0) now.failed = "no tip grows: the loads of the cycle do not reach any";
  now.factors = factors_in_cycle(prepared.model, 1);
  return now;
}

/// Factors, T and G from the state itself, and the kinks.
void add_factors(const Prepared& prepared, const std::vector<Tip>& tips, const IncrementResult& increment,
                 GrowthResult& growth) {
  const model::GrowthStep& step = *prepared.model.steps.back().growth;
  for (std::size_t t = 0; t < growth.tips.size(); ++t) {
    TipResult& tip = growth.tips[t];
    const auto crack = std::find_if(increment.cracks.begin(), increment.cracks.end(),
                                    [&](const CrackResult& one) { return one.name == tip.name; });
    tip.K_I = crack->factors.K_I;
    tip.K_II = crack->factors.K_II;
    tip.T = crack->factors.T_left;
    tip.G = crack->factors.G;
    tip.kink = kink_at(step.criterion, tip_factors(step, crack->factors), material_constants(prepared, tips[t]).kappa);
  }
}

}  // namespace scabo::analysis
