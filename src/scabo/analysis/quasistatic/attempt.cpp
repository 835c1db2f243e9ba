#include "scabo/analysis/quasistatic/attempt.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "scabo/analysis/diagnostics/beyond_sides.hpp"
#include "scabo/analysis/diagnostics/rolling.hpp"
#include "scabo/analysis/diagnostics/softly_held.hpp"
#include "scabo/analysis/diagnostics/undetermined_forces.hpp"
#include "scabo/analysis/diagnostics/undetermined_motions.hpp"
#include "scabo/analysis/quasistatic/branch.hpp"
#include "scabo/analysis/state/balance.hpp"
#include "scabo/analysis/state/loads.hpp"
#include "scabo/analysis/state/pair_motions.hpp"

namespace scabo::analysis {

namespace {

/// The contact problem of an increment, its laws not yet included.
struct Posed {
  contact::Problem problem;
  Vector motion_of_held;  ///< 2N, of pairs that supports hold
  Vector drawn;           ///< 2N, motions of the pairs where no body is displaced
};

/// From `from` to `factors`; loads and supports of `to` are set.
Posed pose(const Prepared& prepared, const State& from, const Factors& factors, State& to) {
  const auto& parts = prepared.structure.parts;
  const system::ContactSystem& system = prepared.contact;
  const auto N = static_cast<Eigen::Index>(system.pairs.size());
  to.factors = factors;
  to.replaced = from.replaced;
  to.offset = from.offset;
  to.held_offset = from.held_offset;
  to.released = from.released;
  to.released_reactions = from.released_reactions;
  to.referred = from.referred;
  to.forces = applied_forces(prepared, factors, to.released);
  to.prescribed = prescribed_values(prepared, factors.supports, to.replaced.moved);

  Posed posed;
  contact::Problem& problem = posed.problem;
  problem.W = system.W;
  problem.q = Vector::Zero(2 * N);
  problem.G = system.G;
  problem.f = Vector::Zero(system.rigid_motions());
  for (Eigen::Index i = 0; i < N; ++i) {
    problem.q[2 * i] = gap_at(prepared, factors, i);
    problem.q[2 * i + 1] = -from.slip[i];
  }
  if (from.offset.size() > 0) problem.q += from.offset;
  if (from.replaced.offset.size() > 0) problem.q += from.replaced.offset;
  posed.drawn = problem.q;
  FreeMotion free = free_motion(prepared, to);
  problem.q += free.pairs;
  for (std::size_t p = 0; p < parts.size(); ++p)
    if (!prepared.is_absent(p))
      problem.f.segment(system.first_rigid[p], parts[p]->rigid_motions().cols()) = loads_on_motions(prepared, p, to);
  posed.motion_of_held = std::move(free.held);
  return posed;
}

/// What of a state follows from the solution of its contact problem without further solves.
void take(const State& from, const contact::Solution& solution, contact::History history, State& to) {
  to.history = std::move(history);
  to.p = solution.p;
  to.rigid_motion = solution.a;
  to.gap = solution.gap;
  to.slip = from.slip + solution.slip_increment;
  to.states = solution.states;
}

contact::SolverOptions options_of(const Prepared& prepared, const State& from, const State& to) {
  contact::SolverOptions options;
  options.tolerance = prepared.model.solver.tolerance;
  options.iterations = prepared.model.solver.iterations;
  options.on_iteration = prepared.on_iteration;
  options.force_scale = std::max({prepared.force_scale, from.largest_force, largest_force(to)});
  return options;
}

/// An attempt while it is made.
struct Making {
  const Prepared& prepared;
  const State& from;
  contact::JointLaws laws;
  contact::SolverOptions options;
  Attempt attempt;
  std::vector<Balance> balances = {};
  std::optional<SoftlyHeld> soft = {};

  State& to() { return attempt.state; }
};

/// Contact with the laws of the pairs, and the displacements that follow from its forces.
void solve(const contact::Problem& problem, Making& making) {
  Attempt& made = making.attempt;
  contact::Evolution evolution = contact::evolve(problem, making.laws, making.from.history, made.start, making.options);
  if (making.prepared.model.solver.uniqueness && !making.prepared.contact.pairs.empty())
    made.uniqueness = follow_history(problem, making.laws, making.from.history, made.start, making.options, evolution);
  made.solution = contact::continued(std::move(made.solution), std::move(evolution.solution));
  made.problem = std::move(evolution.problem);
  // Forces that are not unique.
  give_smoothest_forces(making.prepared, made.problem, made.start, making.options, made.solution);
  take(making.from, made.solution, std::move(evolution.history), making.to());
  making.balances = add_displacements(making.prepared, nullptr, making.to());
}

/// Corrections of a solution, which leave it one of the same laws: motions that nothing determines, and forces that
/// are lost in the rounding of W p and q, or because gaps count by the way that loads would move a softly held body
/// without contact. Whether contact is to be solved again, from there, with another q and a smaller tolerance.
bool refine(const Vector& drawn, contact::Problem& problem, Making& making) {
  Attempt& made = making.attempt;
  if (made.solution.status != contact::Status::solved) return false;
  if (give_smallest_motions(making.prepared, made.problem, making.laws, made.start, making.options, making.from,
                            making.to(), made.solution))
    making.balances = add_displacements(making.prepared, nullptr, making.to());
  making.soft = softly_held(making.prepared, making.to(), made.problem, made.solution, drawn, made.force_scale);
  if (!making.soft || !(making.soft->apart > SoftlyHeld::good || making.soft->wrong > SoftlyHeld::allowed))
    return false;
  problem.q += making.soft->difference;
  constexpr double smaller = 1e-2;  // each time: with less than rounding allows nothing is solved
  if (making.soft->wrong > SoftlyHeld::allowed) making.options.tolerance *= smaller;
  return true;
}

/// Energy, certificate, and whether the attempt is accepted.
void certify(Making& making) {
  const Prepared& prepared = making.prepared;
  Attempt& made = making.attempt;
  State& to = made.state;
  to.energy = energy_between(prepared, making.from, to, making.balances);
  made.certificate = made.solution.certificate;
  to.largest_force = std::max(making.from.largest_force, largest_force(to));
  const double scale = scale_of(prepared, to, std::max(made.force_scale, to.largest_force));
  certify_structure(prepared, to, std::move(making.balances), scale, made.certificate);
  if (scale > 0.0) made.rounding = rounding_of_resistance * resistance(prepared, to) / scale;
  made.accepted =
      made.solution.status == contact::Status::solved && made.certificate.worst() <= prepared.model.solver.tolerance;
  if (made.accepted) made.beyond = slid_beyond_sides(prepared, to);
  made.lost = made.accepted && made.beyond.empty() && making.soft && making.soft->wrong > SoftlyHeld::allowed;
  if (made.lost) made.beyond = lost_where_softly_held(prepared, *making.soft);
  made.accepted = made.accepted && made.beyond.empty();
  if (made.accepted) made.rolls = rolling_body(prepared, to);
  made.accepted = made.accepted && made.rolls.empty();
}

/// Whether a fluid that enters the contact acts at a pair.
std::vector<bool> pairs_with_fluid(const Prepared& prepared) {
  std::vector<bool> with(prepared.contact.pairs.size(), false);
  for (const auto& of_load : prepared.structure.entering)
    for (const system::EnteringPressure& fluid : of_load)
      for (std::size_t i = 0; i < with.size(); ++i)
        if (prepared.contact.pairs[i].contact == fluid.contact) with[i] = true;
  return with;
}

/// With the fluids of `factors` where they are.
Attempt attempt_with(const Prepared& prepared, const State& from, const Factors& factors) {
  Attempt made;
  Posed posed = pose(prepared, from, factors, made.state);
  check_held_pairs(prepared, std::move(posed.motion_of_held), from);
  made.start = {from.p, from.rigid_motion, touching_pairs(prepared)};
  const contact::SolverOptions options = options_of(prepared, from, made.state);
  made.force_scale = options.force_scale;
  Making making{prepared, from, laws_at(prepared, factors), options, std::move(made)};
  constexpr int most_corrections = 3;
  std::optional<Making> before;
  for (int round = 0;; ++round) {
    solve(posed.problem, making);
    if (before && making.attempt.solution.status != contact::Status::solved) {  // rounding allows no better one
      certify(*before);
      return std::move(before->attempt);
    }
    if (!refine(posed.drawn, posed.problem, making) || round == most_corrections) break;
    before.emplace(making);
    const contact::Solution& solution = making.attempt.solution;
    making.attempt.start = {solution.p, solution.a, making.attempt.start.touching};
  }
  certify(making);
  return std::move(making.attempt);
}

/// With fluids where they have entered (`entered`), which enter pairs that open and leave pairs that close, each once
/// at most in either direction: a pair that is closed with its fluid, and opens without it, keeps it.
Attempt attempt_with_fluids(const Prepared& prepared, const State& from, Factors factors, std::vector<double> entered) {
  const std::vector<bool> with_fluid = pairs_with_fluid(prepared);
  std::vector<bool> entered_now(with_fluid.size(), false);
  factors.entered = std::move(entered);
  for (;;) {
    Attempt made = attempt_with(prepared, from, factors);
    if (made.solution.status != contact::Status::solved) return made;
    bool changed = false;
    for (std::size_t i = 0; i < with_fluid.size(); ++i) {
      const bool open = made.state.states[i] == contact::ContactState::open, there = factors.entered[i] != 0.0;
      const bool enters = with_fluid[i] && open && !there, leaves = there && !open && !entered_now[i];
      if (!enters && !leaves) continue;
      factors.entered[i] = enters ? 1.0 : 0.0;
      entered_now[i] = enters;
      changed = true;
    }
    if (!changed) return made;
  }
}

}  // namespace

Attempt attempt(const Prepared& prepared, const State& from, const Factors& factors) {
  if (!may_enter(prepared)) return attempt_with(prepared, from, factors);
  const std::vector<double> dry(prepared.contact.pairs.size(), 0.0);
  if (from.factors.entered.empty() || from.factors.entered == dry)
    return attempt_with_fluids(prepared, from, factors, dry);
  Attempt made = attempt_with_fluids(prepared, from, factors, from.factors.entered);
  // Where the fluid is too much for what holds the joint now, it may have left before.
  return made.accepted ? std::move(made) : attempt_with_fluids(prepared, from, factors, dry);
}

bool is_same_scaled(const Prepared& prepared, const State& from, const Attempt& tried, const Factors& less) {
  constexpr double rounding = 1e-12;
  const contact::Problem& more = tried.problem;
  const contact::JointLaws laws = laws_at(prepared, less);
  const bool remembers =
      std::any_of(laws.of_pair.begin(), laws.of_pair.end(), [](const auto& law) { return law->remembers(); });
  if (remembers || !from.p.isZero(0.0) || !from.rigid_motion.isZero(0.0)) return false;
  State to;
  contact::Problem fewer = pose(prepared, from, less, to).problem;
  contact::set_limits(laws, from.history, fewer);
  if (fewer.mu != more.mu || fewer.mu_backward.size() != more.mu_backward.size() ||
      (fewer.mu_backward.size() > 0 && fewer.mu_backward != more.mu_backward) || fewer.cohesion.size() > 0 ||
      fewer.tension.size() > 0 || more.cohesion.size() > 0 || more.tension.size() > 0)
    return false;
  const double all = more.q.squaredNorm() + more.f.squaredNorm();
  if (!(all > 0.0)) return false;
  const double part = (more.q.dot(fewer.q) + more.f.dot(fewer.f)) / all;
  const auto proportional = [&](const Vector& a, const Vector& b) {
    return a.size() == 0 || (a - part * b).lpNorm<Eigen::Infinity>() <= rounding * part * b.lpNorm<Eigen::Infinity>();
  };
  return part > 0.0 && proportional(fewer.q, more.q) && proportional(fewer.f, more.f);
}

}  // namespace scabo::analysis
