// The quasi-static scheme of the march (march/reach.hpp, march/steps.hpp): every increment ends in equilibrium under
// the loads at its end, from the pairs of the accepted state at its begin.
#pragma once

#include <optional>

#include "scabo/analysis/march/reached.hpp"
#include "scabo/analysis/quasistatic/large_slip.hpp"
#include "scabo/analysis/quasistatic/stages.hpp"

namespace scabo::analysis {

class Quasistatic {
 public:
  /// On the discretisation of `solution`, with its systems, from step `step` on. `large`: nothing without large slip.
  /// Bodies come and go, or pairs are found anew, which replaces the discretisation: not both in one model.
  Quasistatic(StaticSolution& solution, std::optional<LargeSlip> large, std::size_t step, OnIteration on_iteration);

  const Prepared& now() const { return stages_ ? stages_->now() : *whole_; }
  State start() const;
  void enter(std::size_t step, State& state);
  void begin(std::size_t step, double begin, double end, const State& from);
  double part_at_once(double rest) const { return rest; }
  double part_after(double /*at*/, double part) const { return part; }
  Attempt attempt(const State& from, double part) const;
  bool is_same_scaled(const State& from, const Attempt& tried, double part) const;
  double beyond_mesh(const State& from, const State& to) const;
  bool mesh_is_due(const State& state) const;
  bool mesh_is_due_at_end(const State& state) const;
  bool remesh(Reached& reached);
  const std::optional<PairsFound>& pairs_found() const { return found_; }
  void add_warnings(const State& state, const IncrementResult& at, StaticSolution& solution) const;

 private:
  Factors factors_at(double part) const;

  /// An increment: from these factors to those at its end.
  struct Increment {
    std::size_t step = 0;
    double begin = 0.0, end = 1.0;  ///< parts of the step
    Factors from, to;
  };

  StaticSolution& solution_;
  std::optional<Prepared> whole_;  // all that is there with large slip
  std::optional<LargeSlip> large_;
  std::optional<Stages> stages_;  // without large slip
  Increment increment_;
  // With large slip:
  State since_;  // where the present pairs were found, or the increment began
  std::optional<PairsFound> found_;
};

}  // namespace scabo::analysis
