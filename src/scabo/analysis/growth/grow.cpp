#include "scabo/analysis/growth/grow.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>

#include "scabo/analysis/growth/criteria.hpp"
#include "scabo/analysis/growth/growth_energy.hpp"
#include "scabo/analysis/growth/longer_pairs.hpp"
#include "scabo/analysis/growth/overlap.hpp"
#include "scabo/analysis/growth/path_step.hpp"
#include "scabo/analysis/growth/sought.hpp"
#include "scabo/analysis/march/increment_warnings.hpp"
#include "scabo/analysis/march/reports.hpp"
#include "scabo/analysis/state/continuation.hpp"
#include "scabo/base/stopwatch.hpp"
#include "scabo/mesh/plane/former_vertices.hpp"

namespace scabo::analysis {

namespace {

/// A step is halved while the direction turns by more than this at its middle, radians: a quarter of a step off its
/// course by a hundredth of it. Not below a part of the step that is wanted: after a kink the path bends like the root
/// of its length, so that no step is short enough.
constexpr double largest_turn = 0.25, shortest_part = 0.125;

/// So many states one after the other are solved by the factor of the first one's stiffness. They are counted from the
/// first state of the step on, so that a run that resumes takes the same ones.
constexpr int states_of_a_factor = 16;

/// What the next state needs of the growth that leads to it.
struct Growth {
  std::vector<double> lengths;            // of each tip
  std::vector<std::optional<Vec2>> from;  // where the tips that grow were
  // Under a load:
  Factors factors;  // of the state before
  double load_factor = 0.0;
  RestEnergy before;      // of that state
  double integral = 0.0;  // of G times the thickness, the part of its beginning and middle
  // Under cycles:
  double cycles = 0.0;                // before
  double rate = 0.0, rate_mid = 0.0;  // of all tips together
  // Where tips met something, and others go on; `lengths` are then 0:
  std::vector<std::optional<Vec2>> met;  // of each tip
  double until_met = 0.0;                // how far the ones that met something went, together
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
      : solution_(solution),
        options_(options),
        tips_(growing_tips(solution.model)),
        all_tips_(tips_),
        first_cells_(solution.cells),
        vertices_(solution.model.bodies.size()),
        first_(solution.increments.size()),
        from_(std::move(before)) {
    factorised_.structure = solution.structure;
    factorised_.cells = solution.cells;
    for (const model::Body& body : solution.model.bodies) sizes_.push_back(body.mesh.refine);
    for (const Tip& tip : tips_) first_length_ = std::max(first_length_, length_of(crack_of(solution.model, tip)));
    if (mesh::has_polygons(model())) mesh::make_mesh(with_fine_tips(solution.model), vertices_);
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
  Discretisation divided(model::Model model, std::vector<mesh::FormerVertices>& former);
  Discretisation divided_for(model::Model model, int number);
  void go_on(Discretisation longer);
  bool has_contacts() const { return !model().contacts.empty(); }
  Sought sought(const Prepared& prepared) const;
  Sought known_again(const Prepared& prepared, const State& state) const;
  double cycles_until(const Sought& now) const;
  std::optional<GrowthEnergy> energy_until(const Prepared& prepared, const Sought& now, const State& state) const;
  std::variant<Middle, std::string> middle(const Prepared& prepared, const Sought& now, const State& state,
                                           const std::vector<Vec2>& directions, const std::vector<double>& lengths);
  std::variant<double, std::string> turn_at_middle(const Prepared& prepared, const Sought& now, const State& state,
                                                   std::vector<Vec2>& directions, Growth& by);
  double step_wanted(const GrowthResult& at, int number) const;
  Next next(const Prepared& prepared, Sought& now, const State& state, int number);
  Next after_meeting(const Meetings& met, Sought& now, Growth by) const;
  double part_done(int number) const;
  IncrementResult result_at(const Prepared& prepared, Reached& reached, int number);
  bool fail(const Prepared& prepared, std::string reason, int number);
  void grow_to(const Prepared& prepared, const State& state, Next after, int number);

  StaticSolution& solution_;
  const Options& options_;
  std::vector<Tip> tips_;                                // that may still grow
  const std::vector<Tip> all_tips_;                      // at first
  const std::vector<element::SolvedCells> first_cells_;  // of the first state: equal ones take their solutions
  Discretisation factorised_;                            // structure and cells of the last state factorised as a whole
  std::vector<mesh::FormerVertices> vertices_;           // of the present mesh, of every body
  std::size_t first_ = 0;                                // increments of the steps before
  std::vector<std::vector<model::LocalSize>> sizes_;     // given by the user
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

Discretisation Growing::divided(model::Model model, std::vector<mesh::FormerVertices>& former) {
  mesh::Mesh mesh = timed(solution_.timing.mesh, [&] { return mesh::make_mesh(model, former); });
  return remesh(solution_, std::move(model), std::move(mesh), solution_.timing, &factorised_);
}

Discretisation Growing::divided_for(model::Model model, int number) {
  const bool is_first = (number - 1) % states_of_a_factor == 0;
  if (is_first) factorised_.structure.reset(), factorised_.cells = first_cells_;
  Discretisation of = divided(std::move(model), vertices_);
  if (is_first) factorised_.structure = of.structure, factorised_.cells = of.cells;
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
  first_ = from.increments.size() - static_cast<std::size_t>(number);
  for (std::size_t i = first_; i + 1 < from.increments.size(); ++i) {
    follow(longer, tips_, *from.increments[i].growth, *from.increments[i + 1].growth);
    const int next = static_cast<int>(i - first_) + 2;
    const bool is_wanted =
        next == number || ((next - 1) % states_of_a_factor == 0 && number - next < states_of_a_factor);
    model::Model refined = longer;
    refine_at_tips(refined, tips_, sizes_);
    if (is_wanted) {
      Discretisation of = divided_for(std::move(refined), next);
      if (next == number) go_on(std::move(of));
    } else if (mesh::has_polygons(model())) {
      mesh::make_mesh(refined, vertices_);  // of which parts stay
    }
  }
  solution_.pairings = number - 1;
  return number;
}

Sought Growing::sought(const Prepared& prepared) const {
  if (growth().cycles) return sought_in_cycle(prepared, tips_, from_ ? *from_ : initial_state(prepared), options_);
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
  if (growth().cycles) {
    auto found = cycled_again(prepared, tips_, reached.state, now.at);
    if (auto* reason = std::get_if<std::string>(&found)) return now.failed = std::move(*reason), now;
    now.cycled = std::get<std::vector<CycledTip>>(std::move(found));
  }
  return now;
}

/// Cycles of load until this state: dN = ds / (da/dN of all tips), by Simpson's rule over the growth that led to it.
double Growing::cycles_until(const Sought& now) const {
  if (!last_) return 0.0;
  if (!last_->met.empty()) return last_->cycles + last_->until_met / last_->rate;
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
  if (!last_ || !last_->met.empty() || growth().cycles || !prepared.structure.thermal.empty() ||
      !prepared.references.empty() || prepared.contact.rigid_motions() > 0)
    return {};
  State longer;
  if (has_contacts()) {
    longer = *from_;
  } else if (state.p.size() == 0 && is_at_rest(prepared, factors_at(model(), 0.0))) {
    longer = times(last_->load_factor / now.at.load_factor, state);
    longer.factors = last_->factors;
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
                std::get<std::vector<TipFactors>>(found)[t].K.squaredNorm() / now.materials[t].modulus;
  const auto closed = closed_growth(prepared, longer, tips_, last_->from);
  if (!closed) return {};
  const bool known = !has_contacts() && state.p.size() == 0;  // of states from rest without pairs that store any
  const auto stored = [&](const State& of) { return known ? of.energy.elastic : elastic_energy(prepared, of); };
  return energy_of_growth(prepared, last_->before, *closed, {longer, stored(longer)}, {state, stored(state)}, integral);
}

/// What tips are like where the cracks have gone half of a step in these directions, under the load before it.
std::variant<Middle, std::string> Growing::middle(const Prepared& prepared, const Sought& now, const State& state,
                                                  const std::vector<Vec2>& directions,
                                                  const std::vector<double>& lengths) {
  std::vector<mesh::FormerVertices> former = vertices_;
  const Discretisation half = divided(longer(directions, now.at, lengths, 0.5), former);
  const Prepared there(half);
  Middle middle;
  const State from = has_contacts() ? on_longer(there, prepared, state, tips_) : initial_state(there);
  if (growth().cycles) {
    auto found = cycled_tips(there, tips_, from, options_);
    if (auto* reason = std::get_if<std::string>(&found)) return std::move(*reason);
    middle.cycled = std::get<Cycled>(std::move(found)).tips;
    for (const CycledTip& tip : middle.cycled) middle.kinks.push_back(tip.kink);
    return middle;
  }
  FactorsOfTips found, alone;
  if (has_contacts()) {
    const Reached reached = reach_from(there, from, now.factors, options_);
    if (!reached.reason.empty()) return reached.reason;
    found = factors_of_tips(there, tips_, reached.state);
    alone = factors_of_tips(there, tips_, from);
  } else {
    found = alone = factors_of_tips(there, tips_, now.factors, options_);
  }
  for (const auto* factors : {&found, &alone})
    if (const auto* reason = std::get_if<std::string>(factors)) return *reason;
  for (const TipFactors& factors : std::get<std::vector<TipFactors>>(alone)) middle.K_alone.push_back(factors.K);
  for (std::size_t t = 0; t < tips_.size(); ++t) {
    const TipFactors& factors = std::get<std::vector<TipFactors>>(found)[t];
    const bool kinks = factors.K[0] > 0.0 || has_contact(model(), tips_[t]);
    middle.kinks.push_back(kinks ? kink_at(growth().criterion, factors, now.materials[t].kappa) : 0.0);
  }
  return middle;
}

/// Turns the directions so that no kink is left at the middle of the step, and shares the growth as the tips grow
/// there; the largest turn, or a reason where there is no such state.
std::variant<double, std::string> Growing::turn_at_middle(const Prepared& prepared, const Sought& now,
                                                          const State& state, std::vector<Vec2>& directions,
                                                          Growth& by) {
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
  largest = 0.0;
  for (std::size_t t = 0; t < tips_.size(); ++t) {
    if (!now.at.tips[t].grows) continue;
    directions[t] = turned(directions[t], kink_or_none(turns[t]));
    largest = std::max(largest, std::abs(turns[t]));
  }
  if (growth().cycles) {
    by.rate_mid = rate_of(now.at, at.cycled);
    const double whole = std::accumulate(by.lengths.begin(), by.lengths.end(), 0.0);
    if (std::isfinite(by.rate_mid)) by.lengths = shares(growth(), now.at, at.cycled, whole);
    return largest;
  }
  by.integral = 0.0;
  for (std::size_t t = 0; t < tips_.size(); ++t) {
    const Vec2 before = direction_of(model(), tips_[t]);
    const double angle = std::atan2(cross(before, directions[t]), before.dot(directions[t]));
    const Vec2 first = factors_at_kink({now.at.tips[t].K_I, now.at.tips[t].K_II}, angle);
    by.integral += model::thickness_of(model(), tips_[t].body) * by.lengths[t] / 6.0 *
                   (first.squaredNorm() + 4.0 * at.K_alone[t].squaredNorm()) / now.materials[t].modulus;
  }
  return largest;
}

/// Twice as far as before, up to the step that is given.
double Growing::step_wanted(const GrowthResult& at, int number) const {
  if (number == 1) return growth().step;
  const GrowthResult& before = *solution_.increments[first_ + static_cast<std::size_t>(number) - 2].growth;
  const double grown = grown_between(before, at);
  return grown > 0.0 ? std::min(growth().step, 2.0 * grown) : growth().step;
}

/// Ends the cracks that meet something. The others wait, and go on from there if the model asks for it.
Next Growing::after_meeting(const Meetings& met, Sought& now, Growth by) const {
  Next after;
  const auto left = std::count(met.at.begin(), met.at.end(), std::nullopt);
  if (!growth().broken || met.broken || left == 0) {
    after.end = cracks_of(met.model, all_tips_, met.told);
    after.end->broken = met.broken;
    return after;
  }
  by.until_met = length_until(met, now.at);
  by.met = met.at;
  by.lengths.assign(tips_.size(), 0.0);
  for (std::size_t t = 0; t < tips_.size(); ++t) now.at.tips[t].meets = met.at[t];
  after.model = met.model;
  after.growth = std::move(by);
  return after;
}

Next Growing::next(const Prepared& prepared, Sought& now, const State& state, int number) {
  Next after;
  if (std::string ended = end_wanted(growth(), now.at, number); !ended.empty()) {
    after.end = cracks_of(model(), all_tips_, std::move(ended));
    return after;
  }
  const double wanted = step_wanted(now.at, number);
  Growth by;
  by.lengths = shares(growth(), now.at, now.cycled, wanted);
  by.factors = now.factors;
  by.load_factor = now.at.load_factor;
  by.before = rest_energy(prepared, state);
  by.cycles = now.at.cycles.value_or(0.0);
  if (growth().cycles) by.rate = rate_of(now.at, now.cycled);
  std::vector<Vec2> ahead, directions;
  for (std::size_t t = 0; t < tips_.size(); ++t)
    ahead.push_back(turned(direction_of(model(), tips_[t]), kink_or_none(now.at.tips[t].kink)));
  for (double part = 1.0;; part *= 0.5) {
    directions = ahead;
    if (const auto met = meetings(model(), tips_, now.at, directions, by.lengths))
      return after_meeting(*met, now, std::move(by));
    try {
      const auto turn = turn_at_middle(prepared, now, state, directions, by);
      if (const auto* reason = std::get_if<std::string>(&turn)) return after.failed = *reason, after;
      if (std::get<double>(turn) <= largest_turn || 0.5 * part * wanted < shortest_part * growth().step) break;
    } catch (const InputError& error) {
      return after.failed = error.diagnostics().front().message, after;
    }
    for (double& length : by.lengths) length *= 0.5;
  }
  if (const auto met = meetings(model(), tips_, now.at, directions, by.lengths))
    return after_meeting(*met, now, std::move(by));
  after.model = longer(directions, now.at, by.lengths);
  for (const TipResult& tip : now.at.tips) by.from.push_back(tip.grows ? std::optional(tip.position) : std::nullopt);
  after.growth = std::move(by);
  return after;
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
  solution_.grown = cracks_of(model(), all_tips_, reached.reason);
  end_unsolved(reached, solution_, options_);
  return false;
}

/// Makes the cracks of the next state the present ones; with contacts their history follows.
void Growing::grow_to(const Prepared& prepared, const State& state, Next after, int number) {
  last_ = std::move(after.growth);
  if (!last_->met.empty()) refine_at_tips(*after.model, without_met(tips_, last_->met), sizes_);
  Discretisation longer = divided_for(*std::move(after.model), number);
  if (has_contacts()) {
    const Prepared there(longer);
    from_ = on_longer(there, prepared, state, tips_);
    from_->energy.external += rest_energy(there, *from_).of_loads - last_->before.of_loads;
  }
  go_on(std::move(longer));
  if (last_->met.empty()) return;
  tips_ = without_met(tips_, last_->met);
  last_->lengths.assign(tips_.size(), 0.0);
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
  for (std::size_t t = 0; t < tips_.size(); ++t)
    now.at.tips[t].opening = largest_opening(prepared, result.fields, tips_[t].body, tips_[t].crack);
  if (!growth().cycles) add_conjugates(prepared, reached.state, now.at);
  if (growth().cycles)
    now.at.cycles = known != nullptr ? solution_.increments.back().growth->cycles : cycles_until(now);
  if (known == nullptr) now.at.energy = energy_until(prepared, now, reached.state);
  Next after = next(prepared, now, reached.state, number);
  solution_.grown = after.end ? *after.end : cracks_of(model(), all_tips_, {});
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
    grow_to(prepared, reached.state, std::move(after), number + 1);
  } catch (const InputError& error) {
    return fail(prepared, error.diagnostics().front().message, number + 1);
  }
  return true;
}

}  // namespace

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
