#include "scabo/analysis/growth/grow.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "scabo/analysis/growth/criteria.hpp"
#include "scabo/analysis/growth/growth_energy.hpp"
#include "scabo/analysis/growth/longer_pairs.hpp"
#include "scabo/analysis/growth/overlap.hpp"
#include "scabo/analysis/growth/sought.hpp"
#include "scabo/analysis/growth/split.hpp"
#include "scabo/analysis/march/increment_warnings.hpp"
#include "scabo/analysis/march/reports.hpp"
#include "scabo/analysis/state/continuation.hpp"
#include "scabo/base/stopwatch.hpp"
#include "scabo/model/wording.hpp"

namespace scabo::analysis {

namespace {

/// A crack meets what lies within so many steps ahead of it.
constexpr double reach_of_tip = 1.5;

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

std::string crack_of(const TipResult& tip) { return tip.name.substr(0, tip.name.rfind('.')); }

/// How far each tip grows in a step: in proportion to its rate, or by equal parts where growth follows the load; less
/// where a crack would become longer than wanted.
std::vector<double> shares(const model::GrowthStep& growth, const GrowthResult& at,
                           const std::vector<CycledTip>& cycled) {
  std::vector<double> lengths;
  double sum = 0.0, whole = growth.step;
  for (std::size_t t = 0; t < at.tips.size(); ++t) {
    lengths.push_back(!at.tips[t].grows ? 0.0 : cycled.empty() ? 1.0 : cycled[t].rate);
    sum += lengths.back();
  }
  for (std::size_t t = 0; growth.length && t < at.tips.size(); ++t) {
    double of_crack = 0.0;
    for (std::size_t other = 0; other < at.tips.size(); ++other)
      if (crack_of(at.tips[other]) == crack_of(at.tips[t])) of_crack += lengths[other] / sum;
    if (of_crack > 0.0) whole = std::min(whole, (*growth.length - at.tips[t].length) / of_crack);
  }
  for (double& length : lengths) length *= whole / sum;
  return lengths;
}

Vec2 turned(const Vec2& direction, double angle) {
  const double c = std::cos(angle), s = std::sin(angle);
  return {c * direction.x() - s * direction.y(), s * direction.x() + c * direction.y()};
}

/// What the next state needs of the growth that leads to it.
struct Growth {
  std::vector<double> lengths;  // of each tip
  // Under a load:
  Factors factors;  // of the state before
  double load_factor = 0.0;
  RestEnergy before;      // of that state
  double integral = 0.0;  // of G times the thickness, the part of its beginning and middle
  // Under cycles:
  double cycles = 0.0;                // before
  double rate = 0.0, rate_mid = 0.0;  // of all tips together
};

/// At the middle of a step.
struct Middle {
  std::vector<double> kinks;      // of every tip, that are left there
  std::vector<Vec2> K_alone;      // of growth under a load: under the pair forces before
  std::vector<CycledTip> cycled;  // of growth under cycles
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
  /// `before`: the state at the end of the steps before; empty: there are none.
  Growing(StaticSolution& solution, const Options& options, std::optional<State> before)
      : solution_(solution), options_(options), tips_(growing_tips(solution.model)), from_(std::move(before)) {
    for (const model::Body& body : solution.model.bodies) sizes_.push_back(body.mesh.refine);
    for (const Tip& tip : tips_) first_length_ = std::max(first_length_, length_of(crack_of(solution.model, tip)));
  }

  /// Goes back to the last of the increments that the run continues from; its number.
  int restore(const Continuation& from);
  /// One state, and the cracks that follow; false at the end. `known`: its increment is there and told, and this is
  /// what a checkpoint keeps of it.
  bool advance(int number, const State* known = nullptr);

 private:
  const model::Model& model() const { return solution_.model; }
  const model::GrowthStep& growth() const { return *model().steps.back().growth; }
  model::Model longer(const std::vector<Vec2>& directions, const GrowthResult& at, const std::vector<double>& lengths,
                      double part = 1.0) const;
  Discretisation divided(model::Model model);
  void go_on(Discretisation longer);
  std::optional<GrownCracks> meetings(const std::vector<Vec2>& directions, const GrowthResult& at,
                                      const std::vector<double>& lengths) const;
  bool has_contacts() const { return !model().contacts.empty(); }
  Sought sought(const Prepared& prepared) const;
  Sought known_again(const Prepared& prepared, const State& state) const;
  double cycles_until(const Sought& now) const;
  std::optional<GrowthEnergy> energy_until(const Prepared& prepared, const Sought& now, const State& state) const;
  std::variant<Middle, std::string> middle(const Prepared& prepared, const Sought& now, const State& state,
                                           const std::vector<Vec2>& directions, const std::vector<double>& lengths);
  std::string turn_at_middle(const Prepared& prepared, const Sought& now, const State& state,
                             std::vector<Vec2>& directions, Growth& by);
  Next next(const Prepared& prepared, const Sought& now, const State& state, int number);
  double part_done(int number) const;
  IncrementResult result_at(const Prepared& prepared, Reached& reached, int number);
  bool fail(const Prepared& prepared, std::string reason, int number);
  void grow_to(const Prepared& prepared, const State& state, Next after);

  StaticSolution& solution_;
  const Options& options_;
  std::vector<Tip> tips_;
  std::vector<std::vector<model::LocalSize>> sizes_;  // given by the user
  double first_length_ = 0.0;
  std::optional<Growth> last_;  // that led to the present cracks
  /// With contacts: the state before, its pairs carried over to the present cracks.
  std::optional<State> from_;
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
  const bool broken = std::any_of(there.bodies.begin(), there.bodies.end(), is_split);
  if (broken) ended += ", and the body is broken";
  GrownCracks grown = cracks_of(there, tips_, std::move(ended));
  grown.broken = broken;
  return grown;
}

Sought Growing::sought(const Prepared& prepared) const {
  if (growth().cycles) return sought_in_cycle(prepared, tips_, options_);
  if (!has_contacts()) return sought_without_contact(prepared, tips_, options_);
  const double guess = last_ ? last_->load_factor : 1.0;
  return sought_in_contact(prepared, tips_, from_ ? *from_ : initial_state(prepared), guess, options_);
}

/// What led to a state with contacts, of which a checkpoint kept the history.
Sought Growing::known_again(const Prepared& prepared, const State& state) const {
  Sought now;
  now.at = *solution_.increments.back().growth;
  now.factors = state.factors;
  for (const Tip& tip : tips_) now.materials.push_back(material_constants(prepared, tip));
  Reached& reached = now.reached.emplace();
  reached.state = state;
  complete(prepared, reached.state);
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
std::optional<GrowthEnergy> Growing::energy_until(const Prepared& prepared, const Sought& now,
                                                  const State& state) const {
  if (!last_ || growth().cycles || !prepared.structure.thermal.empty() || !prepared.references.empty() ||
      prepared.contact.rigid_motions() > 0)
    return {};
  State longer;
  if (has_contacts()) {
    longer = *from_;
  } else {
    Reached reached = reach_from_rest(prepared, last_->factors, options_);
    if (!reached.reason.empty()) return {};
    longer = std::move(reached.state);
  }
  const auto found = factors_of_tips(prepared, tips_, longer);
  if (std::holds_alternative<std::string>(found)) return {};
  double integral = last_->integral;
  for (std::size_t t = 0; t < tips_.size(); ++t)
    integral += model::thickness_of(model(), tips_[t].body) * last_->lengths[t] / 6.0 *
                std::get<std::vector<Vec2>>(found)[t].squaredNorm() / now.materials[t].modulus;
  return energy_of_growth(prepared, last_->before, longer, state, integral);
}

/// What tips are like where the cracks have gone half of a step in these directions, under the load before it.
std::variant<Middle, std::string> Growing::middle(const Prepared& prepared, const Sought& now, const State& state,
                                                  const std::vector<Vec2>& directions,
                                                  const std::vector<double>& lengths) {
  const Discretisation half = divided(longer(directions, now.at, lengths, 0.5));
  const Prepared there(half);
  Middle middle;
  if (growth().cycles) {
    auto found = cycled_tips(there, tips_, options_);
    if (auto* reason = std::get_if<std::string>(&found)) return std::move(*reason);
    middle.cycled = std::get<std::vector<CycledTip>>(std::move(found));
    for (const CycledTip& tip : middle.cycled) middle.kinks.push_back(tip.kink);
    return middle;
  }
  const State from = has_contacts() ? on_longer(there, prepared, state, tips_) : initial_state(there);
  const Reached reached = reach_from(there, from, now.factors, options_);
  if (!reached.reason.empty()) return reached.reason;
  const auto found = factors_of_tips(there, tips_, reached.state),
             alone = has_contacts() ? factors_of_tips(there, tips_, from) : found;
  for (const auto* factors : {&found, &alone})
    if (const auto* reason = std::get_if<std::string>(factors)) return *reason;
  middle.K_alone = std::get<std::vector<Vec2>>(alone);
  for (std::size_t t = 0; t < tips_.size(); ++t) {
    const Vec2& K = std::get<std::vector<Vec2>>(found)[t];
    const bool kinks = K[0] > 0.0 || has_contact(model(), tips_[t]);
    middle.kinks.push_back(kinks ? kink_at(growth().criterion, K, now.materials[t].kappa) : 0.0);
  }
  return middle;
}

/// Turns the directions so that no kink is left at the middle of the step, and shares the growth as the tips grow
/// there; a reason where there is no such state.
std::string Growing::turn_at_middle(const Prepared& prepared, const Sought& now, const State& state,
                                    std::vector<Vec2>& directions, Growth& by) {
  constexpr double small = 0.05, most_left = 0.5;
  auto found = middle(prepared, now, state, directions, by.lengths);
  if (auto* reason = std::get_if<std::string>(&found)) return std::move(*reason);
  Middle at = std::get<Middle>(std::move(found));
  std::vector<double> turns = at.kinks;
  double largest = 0.0;
  for (std::size_t t = 0; t < tips_.size(); ++t)
    if (now.at.tips[t].grows) largest = std::max(largest, std::abs(turns[t]));
  if (largest > small) {
    std::vector<Vec2> tried = directions;
    for (std::size_t t = 0; t < tips_.size(); ++t) tried[t] = turned(directions[t], turns[t]);
    found = middle(prepared, now, state, tried, by.lengths);
    if (auto* reason = std::get_if<std::string>(&found)) return std::move(*reason);
    at = std::get<Middle>(std::move(found));
    for (std::size_t t = 0; t < tips_.size(); ++t)
      if (turns[t] != 0.0) turns[t] /= 1.0 - std::min(at.kinks[t] / turns[t], most_left);
  }
  for (std::size_t t = 0; t < tips_.size(); ++t)
    if (now.at.tips[t].grows) directions[t] = turned(directions[t], turns[t]);
  if (growth().cycles) {
    by.rate_mid = rate_of(now.at, at.cycled);
    if (std::isfinite(by.rate_mid)) by.lengths = shares(growth(), now.at, at.cycled);
    return {};
  }
  for (std::size_t t = 0; t < tips_.size(); ++t) {
    const Vec2 first = factors_at_kink({now.at.tips[t].K_I, now.at.tips[t].K_II}, now.at.tips[t].kink);
    by.integral += model::thickness_of(model(), tips_[t].body) * by.lengths[t] / 6.0 *
                   (first.squaredNorm() + 4.0 * at.K_alone[t].squaredNorm()) / now.materials[t].modulus;
  }
  return {};
}

Next Growing::next(const Prepared& prepared, const Sought& now, const State& state, int number) {
  if (std::string ended = end_wanted(growth(), now.at, number); !ended.empty())
    return {{}, cracks_of(model(), tips_, std::move(ended)), {}, {}};
  Growth by{shares(growth(), now.at, now.cycled), now.factors, now.at.load_factor, rest_energy(prepared, state)};
  by.cycles = now.at.cycles.value_or(0.0);
  if (growth().cycles) by.rate = rate_of(now.at, now.cycled);
  std::vector<Vec2> directions;
  for (std::size_t t = 0; t < tips_.size(); ++t)
    directions.push_back(turned(direction_of(model(), tips_[t]), now.at.tips[t].kink));
  if (auto met = meetings(directions, now.at, by.lengths)) return {{}, std::move(met), {}, {}};
  try {
    if (std::string reason = turn_at_middle(prepared, now, state, directions, by); !reason.empty())
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

/// Makes the next cracks the present ones; with contacts their history follows.
void Growing::grow_to(const Prepared& prepared, const State& state, Next after) {
  last_ = std::move(after.growth);
  Discretisation longer = divided(*std::move(after.model));
  if (has_contacts()) {
    const Prepared there(longer);
    from_ = on_longer(there, prepared, state, tips_);
    from_->energy.external += rest_energy(there, *from_).of_loads - last_->before.of_loads;
  }
  go_on(std::move(longer));
}

bool Growing::advance(int number, const State* known) {
  const Prepared prepared(solution_, options_.on_iteration);
  Sought now = known != nullptr && has_contacts() ? known_again(prepared, *known) : sought(prepared);
  if (!now.failed.empty()) return fail(prepared, std::move(now.failed), number);
  Reached reached = now.reached ? *std::move(now.reached) : reach_from_rest(prepared, now.factors, options_);
  IncrementResult result = result_at(prepared, reached, number);
  if (!result.converged) return fail(prepared, reached.reason, number);
  if (std::string reason = overlap(prepared, result.fields); !reason.empty())
    return fail(prepared, std::move(reason), number);
  add_factors(prepared, tips_, result, now.at);
  if (growth().cycles)
    now.at.cycles = known != nullptr ? solution_.increments.back().growth->cycles : cycles_until(now);
  if (known == nullptr) now.at.energy = energy_until(prepared, now, reached.state);
  Next after = next(prepared, now, reached.state, number);
  solution_.grown = after.end ? *after.end : cracks_of(model(), tips_, {});
  if (known != nullptr) {
    solution_.increments.back().fields = std::move(result.fields);
  } else {
    if (after.end) result.reached = 1.0;
    result.growth = std::move(now.at);
    add_warnings(prepared, reached, result, solution_);
    solution_.increments.push_back(std::move(result));
    tell_accepted(prepared, {model().steps.size() - 1, {number, solution_.increments.back().reached}, reached.state},
                  solution_, options_);
  }
  if (!after.model) return after.failed.empty() ? false : fail(prepared, std::move(after.failed), number + 1);
  try {
    grow_to(prepared, reached.state, std::move(after));
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

void grow(StaticSolution& solution, const Options& options, std::optional<State> before) {
  Growing growing(solution, options, std::move(before));
  try {
    int number = 1;
    if (continues_growth(solution.model, options)) {
      number = growing.restore(*options.from);
      if (!growing.advance(number, &options.from->at.state)) return;
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
