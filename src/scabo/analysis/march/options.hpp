// What a caller may ask of an analysis besides its model, and what it is told while it runs.
#pragma once

#include <atomic>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "scabo/analysis/state/solution.hpp"

namespace scabo::analysis {

/// An increment that is about to be computed.
struct IncrementBegin {
  int step = 0;  ///< from 1
  std::string step_name;
  int increment = 0;              ///< from 1 within the step
  std::optional<int> increments;  ///< of the step; empty if their size is automatic
};

/// Thrown by Options::on_iteration, on_stage or at an interruption point (base/interruption.hpp) to end the analysis:
/// it is then `interrupted`, and the finished increments are kept. `stop` must be set as well.
struct EndAtOnce {};

struct Prepared;  // state/state.hpp
struct State;
struct Continuation;  // state/continuation.hpp
struct EndState;      // state/restart.hpp
struct RunState;

struct Options {
  /// false: displacements, loads inside cells and pairs are kept of the last converged increment only, so that memory
  /// hardly grows with the number of increments; `on_increment` sees those of every increment.
  bool keep_fields = true;
  int threads = 1;  ///< upper limit, for BLAS and for distinct super-elements
  /// Processes among which large bodies are divided; null: this one alone. Analyses on several meshes use only this
  /// one.
  system::Ranks* ranks = nullptr;
  const std::atomic<bool>* stop = nullptr;  ///< set from outside: end after the current increment
  std::function<void(const StaticSolution&, const IncrementResult&)> on_increment;  ///< after each increment
  /// After each increment with contact pairs: the problems of its attempts, in the order of IncrementResult::attempts.
  std::function<void(const IncrementResult&, const std::vector<DiscreteProblem>&)> on_problems;
  /// After each converged increment, before `on_increment`: its accepted state.
  std::function<void(const Prepared&, const State&, const StaticSolution&)> on_state;
  /// After each converged increment and `on_increment`, of analyses that compute increments one after the other (not of
  /// those with an estimated error, whose increments are reported together at the end): all that the next increment
  /// starts from.
  std::function<void(const RunState&, const StaticSolution&)> on_accepted;
  /// After the last increment of an analysis that was solved, of the same ones as on_accepted: what another run may
  /// start from.
  std::function<void(const EndState&)> on_end;
  const Continuation* from = nullptr;                      ///< continues from there; only for such analyses
  std::function<void(const StaticSolution&)> on_mesh;      ///< when super-elements and systems are ready
  std::function<void(const std::string& stage)> on_stage;  ///< current stage, for display of progress
  /// Before each increment, and before `on_stage`. Not of analyses on several meshes, whose increments are reported
  /// together at the end.
  std::function<void(const IncrementBegin&)> on_increment_begin;
  /// Every iteration of the contact solver, within an increment; may throw EndAtOnce.
  std::function<void(const contact::Iteration&)> on_iteration;
};

}  // namespace scabo::analysis
