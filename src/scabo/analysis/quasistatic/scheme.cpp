#include "scabo/analysis/quasistatic/scheme.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "scabo/analysis/state/restart.hpp"
#include "scabo/analysis/state/step_factors.hpp"

namespace scabo::analysis {

namespace {

/// Adds, once for each contact, that its sides face each other over less than at the start.
void add_slid_off(const LargeSlip& large, const State& state, const IncrementResult& at, StaticSolution& solution) {
  if (state.replaced.placement.empty()) return;
  for (const auto& [contact, sentence] : large.slid_off(solution.model, state.replaced.placement)) {
    const std::string& name = solution.model.contacts[contact].name;
    const bool told = std::any_of(solution.warnings.begin(), solution.warnings.end(), [&](const Warning& warning) {
      return warning.kind == WarningKind::slides_off && warning.subject == name;
    });
    if (!told)
      solution.warnings.push_back({WarningKind::slides_off, name,
                                   fmt::format("step {}, increment {}: {}", at.step_name, at.increment, sentence)});
  }
}

}  // namespace

Quasistatic::Quasistatic(StaticSolution& solution, std::optional<LargeSlip> large, std::size_t step,
                         OnIteration on_iteration)
    : solution_(solution), large_(std::move(large)) {
  whole_.emplace(solution, std::move(on_iteration));
  if (!large_) stages_.emplace(*whole_, step);
}

State Quasistatic::start() const { return solution_.model.restart ? state_of_restart(now()) : initial_state(now()); }

void Quasistatic::enter(std::size_t step, State& state) {
  if (stages_) stages_->enter(step, state);
}

void Quasistatic::begin(std::size_t step, double begin, double end, const State& from) {
  increment_ = {step, begin, end, from.factors, factors_in(solution_.model, step, end)};
  if (!large_) return;
  since_ = from;
  found_.emplace();
}

Factors Quasistatic::factors_at(double part) const {
  const model::Step& step = solution_.model.steps[increment_.step];
  const bool curved = !step.load_curves.empty() || !step.support_curves.empty();
  if (!curved || part == 1.0) return between(increment_.from, increment_.to, part);
  return factors_in(solution_.model, increment_.step, increment_.begin + part * (increment_.end - increment_.begin));
}

Attempt Quasistatic::attempt(const State& from, double part) const {
  return analysis::attempt(now(), from, factors_at(part));
}

bool Quasistatic::is_same_scaled(const State& from, const Attempt& tried, double part) const {
  return !large_ && analysis::is_same_scaled(now(), from, tried, factors_at(part));
}

double Quasistatic::beyond_mesh(const State& from, const State& to) const {
  return large_ ? large_->passed(now(), from, to) : 0.0;
}

bool Quasistatic::mesh_is_due(const State& state) const { return large_ && large_->is_due(now(), state); }

/// Where sides slide off each other.
bool Quasistatic::mesh_is_due_at_end(const State& state) const {
  return large_ && large_->overlap_changed(now(), state);
}

bool Quasistatic::remesh(Reached& reached) {
  FoundAnew anew = find_pairs_anew(*large_, *whole_, since_, reached.state, solution_.timing);
  reached.iterations += anew.iterations;
  reached.reason = anew.reason;
  since_ = reached.state;
  if (!reached.reason.empty()) return false;
  replace(solution_, std::move(anew.discretisation));
  whole_.emplace(solution_, OnIteration(whole_->on_iteration));
  ++solution_.pairings;
  reached.certificate = anew.certificate;
  reached.residual = anew.residual;
  ++found_->times;
  found_->jump = std::max(found_->jump, anew.jump);
  for (IncrementResult& increment : solution_.increments) increment.fields = {};  // of another mesh
  return true;
}

void Quasistatic::add_warnings(const State& state, const IncrementResult& at, StaticSolution& solution) const {
  if (large_) add_slid_off(*large_, state, at, solution);
}

}  // namespace scabo::analysis
