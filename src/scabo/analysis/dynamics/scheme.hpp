// Dynamics as a scheme of the march (march/reach.hpp): an increment is the time between two results, and is reached in
// time steps (time_step.hpp), which are halved where contact adds energy or is not solved. What bodies are there, and
// their systems at rest, come from the scheme of the steps before (Prepared).
#pragma once

#include <memory>
#include <optional>
#include <vector>

#include "scabo/analysis/dynamics/time_step.hpp"

namespace scabo::analysis {

class Dynamics {
 public:
  /// The solution has model, mesh and cells, and outlives this.
  explicit Dynamics(const StaticSolution& solution) : solution_(solution) {}

  void begin(const Prepared& at_rest, std::size_t step, double begin, double end);
  double part_at_once(double rest) const;
  /// A whole time step again where a halved one has come to its end.
  double part_after(double at, double part) const;
  Attempt attempt(const State& from, double part) const;

 private:
  const StepSystem& system_of(double size) const;
  /// Velocity of each constraint of every part, by a central difference: the trapezoidal rule is then exact to the
  /// third order.
  std::vector<Vector> support_velocities(double time, double within) const;
  /// With the velocities before the first time step, of size `step`.
  State in_motion(State at_rest, double step) const;
  Acting acting(double from, double to, const StepSystem& system) const;

  /// Of the present increment; times are those since the begin of the step.
  struct Increment {
    std::size_t step = 0;
    double begin = 0.0, end = 0.0;
    int steps = 1;        ///< equal time steps, while none is halved
    double before = 0.0;  ///< time at the begin of this step
  };

  const StaticSolution& solution_;
  const Prepared* at_rest_ = nullptr;
  std::vector<system::PartInertia> inertia_;
  std::vector<Vector> mass_of_ground_[2];  ///< per part: M r of a motion of the ground along x and y
  mutable std::vector<std::unique_ptr<const StepSystem>> systems_;  ///< those of the sizes of this increment
  Increment increment_;
  std::optional<std::size_t> step_;  ///< of which this is the longest time step
  double longest_ = 0.0;
};

/// Longest time step of a step in time: as it says, or the shorter one of the time that a wave needs to pass the
/// smallest element of the bodies with a mass, a thousandth of its duration where there is none, and of steps that
/// resolve its curves (model/time_steps.hpp).
double longest_time_step(const model::Model& model, const mesh::Mesh& mesh, const model::Step& step);

}  // namespace scabo::analysis
