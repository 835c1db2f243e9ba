// The end of an increment, in one attempt or in parts, by a scheme.
//
// A scheme poses and solves the problem of an interval of time, of which the march knows only the parts from 0, the
// begin of the increment, to 1, its end:
//
//     part_at_once(rest)      the part of the increment that an attempt goes, of the rest
//     part_after(at, part)    the same after an accepted attempt over `part`, which ended at part `at`
//     now()                   what its increments have in common at present
//     attempt(from, part)     from an accepted state to that part of the increment
//     is_same_scaled(from, tried, part)   whether the attempt to that part is the same problem as `tried`, scaled
//     beyond_mesh(from, to)   how far an attempt goes, relative to what the present mesh allows; 0: it allows all
//     mesh_is_due(state)      whether there must be another mesh before the march goes on
#pragma once

#include <algorithm>
#include <cmath>
#include <optional>

#include "scabo/analysis/march/reached.hpp"

namespace scabo::analysis {

/// Part of an increment that is no longer divided because attempts go beyond their mesh.
inline constexpr double smallest_part_of_mesh = 1e-5;
/// Of parts of an increment, relative to them.
inline constexpr double rounding_of_parts = 1e-9;

/// Whether an attempt to part `next` that was not accepted is followed by one to half of the `part` that it went;
/// otherwise the reason why `reached` is the end.
template <typename Scheme>
bool halves(const Scheme& scheme, const Attempt& tried, double next, double part, bool may_halve, bool automatic,
            const Options& options, Reached& reached) {
  using contact::Status;
  const Status status = tried.solution.status;
  const bool no_equilibrium = status == Status::mechanism || status == Status::collapse || !tried.rolls.empty();
  const auto is_same_at_half = [&] { return scheme.is_same_scaled(reached.state, tried, reached.part + 0.5 * part); };
  // A mechanism is a proof; that stages found nothing is none, and the last equilibrium is part of the answer.
  const bool may_close_in = no_equilibrium && (automatic || status == Status::collapse);
  const bool closes_in = may_close_in && may_halve && !is_same_at_half();
  if (closes_in) reached.limit = next;
  const bool smaller_steps_may_help = (!no_equilibrium || closes_in) && !tried.lost;
  reached.stopped = smaller_steps_may_help && options.stop && *options.stop;
  if (reached.stopped) return false;
  const bool in_vain =
      smaller_steps_may_help && may_halve && is_far_from_solved(scheme.now(), tried) && is_same_at_half();
  if (smaller_steps_may_help && may_halve && !in_vain) return true;
  give_up(scheme.now(), tried, next, reached);
  if (in_vain) reached.reason += "; smaller parts of these loads are the same problem, scaled, and were not tried";
  return false;
}

/// Proceeds from the state and part in `reached`, halving the way if an attempt is not accepted; every part starts from
/// the last accepted state. With `least`, that of an automatic increment, it ends with the first attempt that is
/// accepted, and is halved down to that, even where there is no equilibrium, so that increments close in on the loads
/// that can still be carried. It also ends where there must be another mesh, and goes on from what it then `reached`;
/// an attempt that goes too far for its mesh is made again in equal smaller parts.
template <typename Scheme>
Reached reach(const Scheme& scheme, Reached reached, std::optional<double> least, const Options& options) {
  const IncrementRule rule;
  const Prepared& prepared = scheme.now();
  const State from = reached.state;
  double part = scheme.part_at_once(1.0 - reached.part);
  int repeats = 0;
  int halved = reached.halvings;  // how many times `part` is
  reached.mesh_is_due = false;
  while (reached.part < 1.0) {
    double next = std::min(1.0, reached.part + part);
    if (1.0 - next <= rounding_of_parts * part) next = 1.0;
    Attempt tried = scheme.attempt(reached.state, next);
    reached.iterations += tried.solution.iterations;
    reached.coarse_iterations += tried.solution.coarse_iterations;
    const double beyond = tried.accepted ? scheme.beyond_mesh(reached.state, tried.state) : 0.0;
    if (beyond > 1.0 && part > smallest_part_of_mesh) {
      part = (next - reached.part) / std::min(std::ceil(beyond - 0.01), 64.0);
      tried.accepted = false;
      record(prepared, tried, options, reached);
      continue;
    }
    const bool may_halve = least ? part > *least * (1.0 + rounding_of_parts) : halved < prepared.model.solver.halvings;
    if (tried.accepted && least) {
      reached.changes = changes_between(prepared, from, tried.state);
      if (reached.changes.too_many(rule) && may_halve && repeats < rule.repeats) {
        ++repeats;
        tried.accepted = false;
      }
    }
    record(prepared, tried, options, reached);
    if (tried.accepted) {
      accept(std::move(tried), next, reached);
      reached.mesh_is_due = !least && reached.part < 1.0 && scheme.mesh_is_due(reached.state);
      if (least || reached.mesh_is_due) break;
      if (const double longer = scheme.part_after(reached.part, part); longer > part) part = longer, halved = 0;
      continue;
    }
    if (!halves(scheme, tried, next, part, may_halve, least.has_value(), options, reached)) return reached;
    reached.halvings = std::max(reached.halvings, ++halved);
    part = std::max(0.5 * part, std::min(part, least.value_or(0.0)));
  }
  return reached;
}

}  // namespace scabo::analysis
