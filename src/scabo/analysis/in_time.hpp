// The schemes of a run whose steps are quasi-static first and then in time: of every step its own (march/steps.hpp).
#pragma once

#include "scabo/analysis/dynamics/scheme.hpp"
#include "scabo/analysis/quasistatic/scheme.hpp"

namespace scabo::analysis {

class StaticThenDynamic {
 public:
  StaticThenDynamic(Quasistatic& statics, const StaticSolution& solution)
      : solution_(solution), statics_(statics), dynamics_(solution) {}

  const Prepared& now() const { return statics_.now(); }
  State start() const { return statics_.start(); }
  void enter(std::size_t step, State& state) { statics_.enter(step, state); }
  void begin(std::size_t step, double begin, double end, const State& from) {
    in_time_ = solution_.model.steps[step].dynamic.has_value();
    if (in_time_)
      dynamics_.begin(now(), step, begin, end);
    else
      statics_.begin(step, begin, end, from);
  }
  double part_at_once(double rest) const { return in_time_ ? dynamics_.part_at_once(rest) : rest; }
  double part_after(double at, double part) const { return in_time_ ? dynamics_.part_after(at, part) : part; }
  Attempt attempt(const State& from, double part) const {
    return in_time_ ? dynamics_.attempt(from, part) : statics_.attempt(from, part);
  }
  bool is_same_scaled(const State& from, const Attempt& tried, double part) const {
    return !in_time_ && statics_.is_same_scaled(from, tried, part);
  }
  // Without large slip:
  double beyond_mesh(const State&, const State&) const { return 0.0; }
  bool mesh_is_due(const State&) const { return false; }
  bool mesh_is_due_at_end(const State&) const { return false; }
  bool remesh(Reached&) { return false; }
  const std::optional<PairsFound>& pairs_found() const { return statics_.pairs_found(); }
  void add_warnings(const State&, const IncrementResult&, StaticSolution&) const {}

 private:
  const StaticSolution& solution_;
  Quasistatic& statics_;
  Dynamics dynamics_;
  bool in_time_ = false;
};

}  // namespace scabo::analysis
