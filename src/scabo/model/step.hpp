// Steps: how loads, prescribed displacements and coefficients of friction change.
#pragma once

#include <array>
#include <cstddef>
#include <optional>
#include <string>
#include <vector>

#include "scabo/base/error.hpp"
#include "scabo/model/curve.hpp"
#include "scabo/model/growth.hpp"
#include "scabo/model/limit.hpp"

namespace scabo::model {

/// Limits of increments whose size follows from what changes (analysis/march/increment_size.hpp). All are parts of the
/// step, 0 < smallest <= first <= largest <= 1. The last increment of a step may be smaller than `smallest`.
struct AutomaticIncrements {
  double first = 0.1;
  double largest = 0.25;
  double smallest = 1e-4;
};

/// A step in time: its increments end at equal times, and are divided into time steps. Factors of loads and supports
/// hold their new value from its first instant, or follow curves whose tables are in seconds.
struct DynamicStep {
  double duration = 0.0;       ///< time, > 0
  std::optional<double> step;  ///< longest time step, time, > 0; empty: from wave speeds
  /// Index into Model::curves of the acceleration of the ground along x and y, length / time^2; -1: none. Displacements
  /// and velocities are then those relative to the ground.
  std::array<int, 2> ground{-1, -1};
};

/// Factors change linearly, or along curves, over `increments` increments, from those at the end of the previous step
/// (zero before the first) to these. Coefficients of friction change linearly.
struct Step {
  std::string name;
  int increments = 1;                            ///< equal parts; without meaning if `automatic`
  std::optional<AutomaticIncrements> automatic;  ///< instead of equal parts
  /// Instead of equal parts: where each increment ends, ascending, the last one 1. As many as `increments`.
  std::vector<double> ends;
  std::vector<double> load_factors;     ///< at the end of the step, one for each load
  std::vector<double> support_factors;  ///< at the end of the step, one for each support
  /// Index into Model::curves of what a factor follows within the step, for each load and support; -1: it changes
  /// linearly. Empty if no factor follows a curve. The factor above is that of the curve at its end.
  std::vector<int> load_curves, support_curves;
  std::vector<double> friction;  ///< coefficient of every contact at the end of the step; empty if no step changes one
  std::vector<double> backward_friction;  ///< the same against backward slip; as many as `friction`
  std::vector<double> cohesion;           ///< lasting cohesion, force / length^2; as many as `friction`
  std::optional<DynamicStep> dynamic;     ///< empty: the step is quasi-static
  /// Cracks grow in this step, in as many increments as it takes: `increments` has no meaning.
  std::optional<GrowthStep> growth;
  /// The step looks for a limit: factors are those at part 1, and change linearly, also beyond it.
  std::optional<LimitStep> limit;
  Source source;
};

/// Curve that the factor of load or support `index` follows in a step; -1: none.
inline int load_curve(const Step& step, std::size_t index) {
  return step.load_curves.empty() ? -1 : step.load_curves[index];
}
inline int support_curve(const Step& step, std::size_t index) {
  return step.support_curves.empty() ? -1 : step.support_curves[index];
}
/// At the end of a step: coefficients against forward slip of every contact, then against backward slip, then lasting
/// cohesions; empty if no step changes one.
std::vector<double> coefficients_of(const Step& step);

/// Parts of a step, between 0 and 1, at which an increment ends so that no corner of a curve is passed over, ascending.
std::vector<double> corners_of(const Step& step, const std::vector<Curve>& curves);

/// Of a step that looks for a limit: its factor at the begin, at a part of it, and the part at which it has a factor.
double first_factor(const Step& step);
double limit_factor(const Step& step, double part);
double part_at_factor(const Step& step, double factor);

/// Whether the number of its increments is known before.
inline bool is_counted(const Step& step) { return !step.automatic && !step.growth && !step.limit; }

/// Number of increments of a step; if it is not known before, what it may be.
int expected_increments(const Step& step);

}  // namespace scabo::model
