#include "scabo/analysis/growth/grow.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "scabo/analysis/growth/criteria.hpp"
#include "scabo/analysis/growth/critical.hpp"
#include "scabo/analysis/growth/fatigue.hpp"
#include "scabo/analysis/growth/growth_energy.hpp"
#include "scabo/analysis/growth/overlap.hpp"
#include "scabo/analysis/growth/tips.hpp"
#include "scabo/analysis/march/increment_warnings.hpp"
#include "scabo/analysis/march/reports.hpp"
#include "scabo/analysis/state/continuation.hpp"
#include "scabo/base/stopwatch.hpp"
#include "scabo/model/wording.hpp"

namespace scabo::analysis {

namespace {

/// A crack meets what lies within so many steps ahead of it.
constexpr double reach_of_tip = 1.5;

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

/// The tips in the state of a load factor.
GrowthResult critical_tips(const model::Model& model, const std::vector<Tip>& tips,
                           const std::vector<TipPattern>& patterns) {
  GrowthResult result = tips_of(model, tips);
  result.load_factor = std::numeric_limits<double>::infinity();
  for (std::size_t t = 0; t < tips.size(); ++t) {
    result.tips[t].load_factor = critical_factor(model.steps.back().growth->criterion, patterns[t]);
    result.load_factor = std::min(result.load_factor, result.tips[t].load_factor);
  }
  for (TipResult& tip : result.tips) tip.grows = tip.load_factor <= (1.0 + together) * result.load_factor;
  return result;
}

/// The tips at the highest load of a cycle.
GrowthResult tips_in_cycle(const model::Model& model, const std::vector<Tip>& tips,
                           const std::vector<CycledTip>& cycled) {
  constexpr double infinite = std::numeric_limits<double>::infinity();
  const model::GrowthStep& growth = *model.steps.back().growth;
  const double breaks_at = std::min(growth.K_Ic.value_or(infinite), growth.cycles->K_c.value_or(infinite));
  GrowthResult result = tips_of(model, tips);
  result.load_factor = 1.0;
  double fastest = 0.0;
  for (const CycledTip& tip : cycled) fastest = std::max(fastest, tip.rate);
  for (std::size_t t = 0; t < tips.size(); ++t) {
    TipResult& tip = result.tips[t];
    tip.range = cycled[t].range;
    tip.load_factor = breaks_at / cycled[t].highest;
    tip.grows = cycled[t].rate > 0.0 && cycled[t].rate >= least_rate * fastest;
  }
  return result;
}

/// Why a crack does not grow at the load factor found; empty if it does.
std::string why_not(const GrowthResult& at, const std::vector<TipPattern>& patterns) {
  if (at.load_factor == 0.0)
    return "a tip is critical under the loads that stay alone: let 'scale' name them, or make them smaller";
  if (!std::isfinite(at.load_factor))
    return "no factor of the scaled loads makes a tip critical: they close the crack, or do not reach it";
  for (std::size_t t = 0; t < at.tips.size(); ++t) {
    const Vec2 K = patterns[t].at(at.load_factor);
    constexpr double rounding = 1e-6;
    if (K[0] < -rounding * K.norm())
      return fmt::format(
          "the loads close the crack at its tip '{}' (K_I < 0), and growth of cracks in contact is not available in "
          "this "
          "version",
          at.tips[t].name);
  }
  return {};
}

/// Factors, T and G from the state itself, and the kinks.
void add_factors(const Prepared& prepared, const std::vector<Tip>& tips, const IncrementResult& increment,
                 GrowthResult& growth) {
  const model::GrowthCriterion criterion = prepared.model.steps.back().growth->criterion;
  for (std::size_t t = 0; t < growth.tips.size(); ++t) {
    TipResult& tip = growth.tips[t];
    const auto crack = std::find_if(increment.cracks.begin(), increment.cracks.end(),
                                    [&](const CrackResult& one) { return one.name == tip.name; });
    tip.K_I = crack->factors.K_I;
    tip.K_II = crack->factors.K_II;
    tip.T = crack->factors.T_left;
    tip.G = crack->factors.G;
    const Vec2 open(std::max(tip.K_I, 0.0), tip.K_II);
    if (open.norm() > 0.0) tip.kink = kink_of(criterion, open, material_constants(prepared, tips[t]).kappa).angle;
  }
}

GrownCracks cracks_of(const model::Model& model, const std::vector<Tip>& tips, std::string ended) {
  GrownCracks grown;
  grown.ended = std::move(ended);
  for (const Tip& tip : tips)
    if (const std::string name = name_of_crack(model, tip); grown.paths.empty() || grown.paths.back().crack != name)
      grown.paths.push_back({name, crack_of(model, tip).path});
  return grown;
}

/// Why growth ends in state `number` though nothing is met; empty if it goes on.
std::string end_wanted(const model::GrowthStep& growth, const GrowthResult& at, int number) {
  constexpr double rounding = 1e-9;
  if (growth.steps && number > *growth.steps) return model::counted(*growth.steps, "growth step") + " done";
  if (growth.load_factor && at.load_factor > *growth.load_factor)
    return fmt::format("further growth needs the load factor {:.6g}, above {}", at.load_factor,
                       model::number_text(*growth.load_factor));
  for (const TipResult& tip : at.tips) {
    if (growth.length && tip.length >= (1.0 - rounding) * *growth.length)
      return fmt::format("the crack of '{}' has the length {:.6g}", tip.name, tip.length);
    if (growth.tip && (tip.position - *growth.tip).norm() <= 0.5 * growth.step)
      return fmt::format("'{}' is at {}", tip.name, model::point_text(tip.position));
    if (growth.cycles && tip.load_factor <= 1.0)
      return fmt::format("the body breaks at '{}' after {:.6g} cycles, where K* reaches what it resists", tip.name,
                         *at.cycles);
  }
  return {};
}

/// Growth of all tips in a step.
double growth_of_step(const model::GrowthStep& growth, const GrowthResult& at) {
  double whole = growth.step;
  if (growth.length)
    for (const TipResult& tip : at.tips)
      if (tip.grows) whole = std::min(whole, *growth.length - tip.length);
  return whole;
}

/// How far each tip grows: in proportion to its rate, or by equal parts where growth follows the load.
std::vector<double> shares(const GrowthResult& at, const std::vector<CycledTip>& cycled, double whole) {
  std::vector<double> lengths;
  double sum = 0.0;
  for (std::size_t t = 0; t < at.tips.size(); ++t) {
    lengths.push_back(!at.tips[t].grows ? 0.0 : cycled.empty() ? 1.0 : cycled[t].rate);
    sum += lengths.back();
  }
  for (double& length : lengths) length *= whole / sum;
  return lengths;
}

/// The rates of the tips that grow, together.
double rate_of(const GrowthResult& at, const std::vector<CycledTip>& cycled) {
  double rate = 0.0;
  for (std::size_t t = 0; t < at.tips.size(); ++t)
    if (at.tips[t].grows) rate += cycled[t].rate;
  return rate;
}

Vec2 turned(const Vec2& direction, double angle) {
  const double c = std::cos(angle), s = std::sin(angle);
  return {c * direction.x() - s * direction.y(), s * direction.x() + c * direction.y()};
}

/// A state that is to be solved: where the tips are in it, and why there is none.
struct Sought {
  GrowthResult at;
  Factors factors;
  std::vector<TipPattern> patterns;  // of growth under a load
  std::vector<CycledTip> cycled;     // of growth under cycles
  std::string failed;
};

/// What the next state needs of the growth that leads to it.
struct Growth {
  std::vector<double> lengths;  // of each tip
  // Under a load:
  Factors factors;        // of the state before
  RestEnergy before;      // of that state
  double integral = 0.0;  // of G, the part of its beginning and middle
  // Under cycles:
  double cycles = 0.0;                // before
  double rate = 0.0, rate_mid = 0.0;  // of all tips together
};

/// What follows a state: longer cracks, the end, or a mesh or solution that there is not.
struct Next {
  std::optional<model::Model> model;
  std::optional<GrownCracks> end;
  std::string failed;
  Growth growth;
};

class Growing {
 public:
  Growing(StaticSolution& solution, const Options& options)
      : solution_(solution), options_(options), tips_(growing_tips(solution.model)) {
    for (const model::Body& body : solution.model.bodies) sizes_.push_back(body.mesh.refine);
    for (const Tip& tip : tips_) first_length_ = std::max(first_length_, length_of(crack_of(solution.model, tip)));
  }

  /// Goes back to the last of the increments that the run continues from; its number.
  int restore(const Continuation& from);
  /// One state, and the cracks that follow; false at the end. `known`: its increment is there and told.
  bool advance(int number, bool known = false);

 private:
  const model::Model& model() const { return solution_.model; }
  const model::GrowthStep& growth() const { return *model().steps.back().growth; }
  model::Model longer(const std::vector<Vec2>& directions, const GrowthResult& at, const std::vector<double>& lengths,
                      double part = 1.0) const;
  Discretisation divided(model::Model model);
  void go_on(Discretisation longer);
  std::optional<GrownCracks> meetings(const std::vector<Vec2>& directions, const GrowthResult& at,
                                      const std::vector<double>& lengths) const;
  Sought sought(const Prepared& prepared) const;
  double cycles_until(const Sought& now) const;
  std::optional<GrowthEnergy> energy_until(const Prepared& prepared, const std::vector<TipPattern>& patterns,
                                           const State& state) const;
  std::string turn_at_middle(const Sought& now, std::vector<Vec2>& directions, Growth& by);
  Next next(const Prepared& prepared, const Sought& now, const State& state, int number);
  double part_done(int number) const;
  IncrementResult result_at(const Prepared& prepared, Reached& reached, int number);
  bool fail(const Prepared& prepared, std::string reason, int number);

  StaticSolution& solution_;
  const Options& options_;
  std::vector<Tip> tips_;
  std::vector<std::vector<model::LocalSize>> sizes_;  // given by the user
  double first_length_ = 0.0;
  std::optional<Growth> last_;  // that led to the present cracks
};

model::Model Growing::longer(const std::vector<Vec2>& directions, const GrowthResult& at,
                             const std::vector<double>& lengths, double part) const {
  model::Model longer = model();
  for (std::size_t t = 0; t < tips_.size(); ++t)
    if (at.tips[t].grows) extend(longer, tips_[t], at.tips[t].position + part * lengths[t] * directions[t]);
  refine_at_tips(longer, tips_, sizes_);
  return longer;
}

Discretisation Growing::divided(model::Model model) {
  Discretisation of;
  of.model = std::move(model);
  of.mesh = timed(solution_.timing.mesh, [&] { return mesh::make_mesh(of.model); });
  of.threads = solution_.threads;
  discretise(of, solution_.cells, {}, solution_.timing);
  return of;
}

void Growing::go_on(Discretisation longer) {
  solution_.model.bodies = longer.model.bodies;
  replace(solution_, std::move(longer));
  ++solution_.pairings;
  for (IncrementResult& increment : solution_.increments) increment.fields = {};  // of another mesh
}

int Growing::restore(const Continuation& from) {
  solution_.increments = from.increments;
  solution_.warnings = from.warnings;
  const int number = from.at.progress.increment;
  model::Model longer = model();
  const std::size_t first = from.increments.size() - static_cast<std::size_t>(number);
  for (std::size_t i = first; i + 1 < from.increments.size(); ++i)
    for (std::size_t t = 0; t < tips_.size(); ++t)
      if (from.increments[i].growth->tips[t].grows)
        extend(longer, tips_[t], from.increments[i + 1].growth->tips[t].position);
  if (number > 1) {
    refine_at_tips(longer, tips_, sizes_);
    go_on(divided(std::move(longer)));
  }
  solution_.pairings = number - 1;
  return number;
}

/// The cracks where some of them meet something ahead.
std::optional<GrownCracks> Growing::meetings(const std::vector<Vec2>& directions, const GrowthResult& at,
                                             const std::vector<double>& lengths) const {
  model::Model there = model();
  std::string ended;
  for (std::size_t t = 0; t < tips_.size(); ++t) {
    if (!at.tips[t].grows) continue;
    const auto met = meeting(model(), tips_[t], at.tips[t].position + reach_of_tip * lengths[t] * directions[t]);
    if (!met) continue;
    extend(there, tips_[t], met->at);
    ended += fmt::format("{}'{}' meets {} at {}", ended.empty() ? "" : ", ", at.tips[t].name, met->what,
                         model::point_text(met->at));
  }
  if (ended.empty()) return {};
  return cracks_of(there, tips_, std::move(ended));
}

Sought Growing::sought(const Prepared& prepared) const {
  Sought now;
  if (growth().cycles) {
    auto found = cycled_tips(prepared, tips_, options_);
    if (auto* reason = std::get_if<std::string>(&found)) return now.failed = std::move(*reason), now;
    now.cycled = std::get<std::vector<CycledTip>>(std::move(found));
    now.at = tips_in_cycle(model(), tips_, now.cycled);
    if (rate_of(now.at, now.cycled) == 0.0) now.failed = "no tip grows: the loads of the cycle do not reach any";
    now.factors = factors_in_cycle(model(), 1);
    return now;
  }
  auto found = tip_patterns(prepared, tips_, options_);
  if (auto* reason = std::get_if<std::string>(&found)) return now.failed = std::move(*reason), now;
  now.patterns = std::get<std::vector<TipPattern>>(std::move(found));
  now.at = critical_tips(model(), tips_, now.patterns);
  now.failed = why_not(now.at, now.patterns);
  now.factors = factors_at(model(), now.at.load_factor);
  return now;
}

/// Cycles of load until this state: dN = ds / (da/dN of all tips), by Simpson's rule over the growth that led to it.
double Growing::cycles_until(const Sought& now) const {
  if (!last_) return 0.0;
  double whole = 0.0, rate = 0.0;
  for (std::size_t t = 0; t < tips_.size(); ++t) {
    whole += last_->lengths[t];
    if (last_->lengths[t] > 0.0) rate += now.cycled[t].rate;
  }
  return last_->cycles + whole / 6.0 * (1.0 / last_->rate + 4.0 / last_->rate_mid + 1.0 / rate);
}

/// What the growth that led to this state took (growth_energy.hpp).
std::optional<GrowthEnergy> Growing::energy_until(const Prepared& prepared, const std::vector<TipPattern>& patterns,
                                                  const State& state) const {
  if (!last_ || growth().cycles || !prepared.structure.thermal.empty() || !prepared.references.empty()) return {};
  const Reached longer = reach_from_rest(prepared, last_->factors, options_);
  if (!longer.reason.empty()) return {};
  const auto found = factors_of_tips(prepared, tips_, longer.state);
  if (std::holds_alternative<std::string>(found)) return {};
  double integral = last_->integral;
  for (std::size_t t = 0; t < tips_.size(); ++t)
    integral += last_->lengths[t] / 6.0 * std::get<std::vector<Vec2>>(found)[t].squaredNorm() / patterns[t].modulus;
  return energy_of_growth(last_->before, rest_energy(prepared, longer.state), rest_energy(prepared, state),
                          integral * model().analysis.thickness);
}

/// Turns the directions by the kinks that are left at the middle of the step, and shares the growth as the tips grow
/// there; a reason where there is no such state.
std::string Growing::turn_at_middle(const Sought& now, std::vector<Vec2>& directions, Growth& by) {
  const Discretisation half = divided(longer(directions, now.at, by.lengths, 0.5));
  const Prepared prepared(half);
  if (growth().cycles) {
    auto found = cycled_tips(prepared, tips_, options_);
    if (auto* reason = std::get_if<std::string>(&found)) return std::move(*reason);
    const auto& cycled = std::get<std::vector<CycledTip>>(found);
    by.rate_mid = rate_of(now.at, cycled);
    if (std::isfinite(by.rate_mid)) by.lengths = shares(now.at, cycled, growth_of_step(growth(), now.at));
    for (std::size_t t = 0; t < tips_.size(); ++t)
      if (now.at.tips[t].grows) directions[t] = turned(directions[t], cycled[t].kink);
    return {};
  }
  const auto found = factors_of_tips(prepared, tips_, now.factors, options_);
  if (const auto* reason = std::get_if<std::string>(&found)) return *reason;
  for (std::size_t t = 0; t < tips_.size(); ++t) {
    const Vec2& K = std::get<std::vector<Vec2>>(found)[t];
    if (now.at.tips[t].grows && K[0] > 0.0)
      directions[t] = turned(directions[t], kink_of(growth().criterion, K, now.patterns[t].kappa).angle);
    const Vec2 first = factors_at_kink(now.patterns[t].at(now.at.load_factor), now.at.tips[t].kink);
    by.integral += by.lengths[t] / 6.0 * (first.squaredNorm() + 4.0 * K.squaredNorm()) / now.patterns[t].modulus;
  }
  return {};
}

Next Growing::next(const Prepared& prepared, const Sought& now, const State& state, int number) {
  if (std::string ended = end_wanted(growth(), now.at, number); !ended.empty())
    return {{}, cracks_of(model(), tips_, std::move(ended)), {}, {}};
  Growth by{shares(now.at, now.cycled, growth_of_step(growth(), now.at)), now.factors, rest_energy(prepared, state)};
  by.cycles = now.at.cycles.value_or(0.0);
  if (growth().cycles) by.rate = rate_of(now.at, now.cycled);
  std::vector<Vec2> directions;
  for (std::size_t t = 0; t < tips_.size(); ++t)
    directions.push_back(turned(direction_of(model(), tips_[t]), now.at.tips[t].kink));
  if (auto met = meetings(directions, now.at, by.lengths)) return {{}, std::move(met), {}, {}};
  try {
    if (std::string reason = turn_at_middle(now, directions, by); !reason.empty())
      return {{}, {}, std::move(reason), {}};
  } catch (const InputError& error) {
    return {{}, {}, error.diagnostics().front().message, {}};
  }
  if (auto met = meetings(directions, now.at, by.lengths)) return {{}, std::move(met), {}, {}};
  return {longer(directions, now.at, by.lengths), {}, {}, std::move(by)};
}

/// Of the step, if nothing ends it before.
double Growing::part_done(int number) const {
  double states = std::numeric_limits<double>::infinity();
  if (growth().steps) states = *growth().steps + 1.0;
  if (growth().length) states = std::min(states, 1.0 + std::ceil((*growth().length - first_length_) / growth().step));
  return number < states && std::isfinite(states) ? number / states : number / (number + 1.0);
}

IncrementResult Growing::result_at(const Prepared& prepared, Reached& reached, int number) {
  IncrementResult result = result_of(prepared, reached, solution_);
  result.step = static_cast<int>(model().steps.size());
  result.step_name = model().steps.back().name;
  result.increment = number;
  result.reached = part_done(number);
  return result;
}

bool Growing::fail(const Prepared& prepared, std::string reason, int number) {
  Reached reached;
  reached.reason = std::move(reason);
  solution_.increments.push_back(result_at(prepared, reached, number));
  solution_.grown = cracks_of(model(), tips_, reached.reason);
  end_unsolved(reached, solution_, options_);
  return false;
}

bool Growing::advance(int number, bool known) {
  const Prepared prepared(solution_, options_.on_iteration);
  Sought now = sought(prepared);
  if (!now.failed.empty()) return fail(prepared, std::move(now.failed), number);
  Reached reached = reach_from_rest(prepared, now.factors, options_);
  IncrementResult result = result_at(prepared, reached, number);
  if (!result.converged) return fail(prepared, reached.reason, number);
  if (std::string reason = overlap(prepared, result.fields); !reason.empty())
    return fail(prepared, std::move(reason), number);
  add_factors(prepared, tips_, result, now.at);
  if (growth().cycles) now.at.cycles = known ? solution_.increments.back().growth->cycles : cycles_until(now);
  now.at.energy = energy_until(prepared, now.patterns, reached.state);
  Next after = next(prepared, now, reached.state, number);
  solution_.grown = after.end ? *after.end : cracks_of(model(), tips_, {});
  if (known) {
    solution_.increments.back().fields = std::move(result.fields);
  } else {
    if (after.end) result.reached = 1.0;
    result.growth = std::move(now.at);
    add_warnings(prepared, reached, result, solution_);
    solution_.increments.push_back(std::move(result));
    tell_accepted(prepared,
                  {model().steps.size() - 1, {number, solution_.increments.back().reached}, std::move(reached.state)},
                  solution_, options_);
  }
  if (!after.model) return after.failed.empty() ? false : fail(prepared, std::move(after.failed), number + 1);
  last_ = std::move(after.growth);
  try {
    go_on(divided(*std::move(after.model)));
  } catch (const InputError& error) {
    return fail(prepared, error.diagnostics().front().message, number + 1);
  }
  return true;
}

}  // namespace

void check_growth(const model::Model& model) {
  if (!model::has_growth(model) || !growing_tips(model).empty()) return;
  throw InputError(model.file.empty() ? "model" : model.file,
                   {{model.steps.back().source,
                     "no crack of the step has a tip that could grow: both ends of each lie on the boundary or on "
                     "another crack"}});
}

bool continues_growth(const model::Model& model, const Options& options) {
  return options.from && options.from->at.step + 1 == model.steps.size() && options.from->at.progress.increment > 0;
}

void grow(StaticSolution& solution, const Options& options) {
  Growing growing(solution, options);
  try {
    int number = 1;
    if (continues_growth(solution.model, options)) {
      number = growing.restore(*options.from);
      if (!growing.advance(number, true)) return;
      ++number;
    }
    for (;; ++number) {
      if (options.stop && *options.stop) return interrupt(solution);
      tell_begin(options, solution.model.steps.back(), solution.model.steps.size() - 1, number);
      if (!growing.advance(number)) return;
    }
  } catch (const EndAtOnce&) {
    interrupt(solution);
  }
}

}  // namespace scabo::analysis
