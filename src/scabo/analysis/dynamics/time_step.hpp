// One time step by the scheme of Moreau and Jean, at the level of velocities, without restitution
// (docs/methods/23_dynamics.md). Its equations are those of a structure at rest whose displacements are w = h v+
// (system/inertia.hpp), so that contact, balance and certificate are those of the static analysis:
//
//     a pair acts     if g + h V_n/2 <= 0, or if it carried force before and g is rounding, or if it is bonded; where a
//                     side has no mass, if it carried force before
//     of those        0 <= p_n, h V_n+ >= 0, p_n V_n+ = 0 and friction against h V_t+: contact/problem.hpp
//     of the others   p = 0
//
// V: velocities of the pairs; p: mean forces of the step, its impulses over h. Then what overlaps is projected, by
// displacements d = A^-1 B_n' nu in the metric of eq. (1), with 0 <= nu, g+ + B_n d >= 0, complementary. Velocities and
// slip stay.
#pragma once

#include <limits>
#include <memory>
#include <vector>

#include "scabo/analysis/march/attempt.hpp"
#include "scabo/system/inertia.hpp"

namespace scabo::analysis {

/// What time steps of one size have in common. Refers to the systems at rest.
struct StepSystem {
  StepSystem(const Prepared& at_rest, const std::vector<system::PartInertia>& inertia, double size, int threads);
  StepSystem(const StepSystem&) = delete;
  StepSystem& operator=(const StepSystem&) = delete;

  const double size;
  const std::vector<std::vector<system::LevelInTime>> levels;
  const system::Structure structure;
  const system::ContactSystem contact;
  const Prepared prepared;
};

/// What acts in a time step.
struct Acting {
  Factors mean, end;            ///< factors over the step, and at its end
  std::vector<Vector> ground;   ///< per part: mean force of the inertia of the moving ground; empty: it is at rest
  Vec2 acceleration;            ///< mean of the ground
  std::vector<Vector> support;  ///< per part: velocity of each constraint at the end of the step
};

struct InTime {
  const Prepared& at_rest;
  const std::vector<system::PartInertia>& inertia;
  const StepSystem& system;
};

/// A time step that goes beyond these bounds is not accepted. Parts of the largest energy so far.
struct StepBounds {
  double added = std::numeric_limits<double>::infinity();  ///< energy that contact and projection add
  /// Square root of the energy of the error by which the trapezoidal rule is wrong for rigid bodies on springs.
  double error = std::numeric_limits<double>::infinity();
};

/// From a state with velocities.
Attempt time_step(const InTime& in, const State& from, const Acting& acting, const StepBounds& bounds);

/// Of all parts that are there, with their internal levels.
double kinetic_energy(const Prepared& prepared, const std::vector<system::PartInertia>& inertia, const State& state);

/// A state at rest gets the internal levels that gravity gives it, and their elastic energy.
void add_internal(const Prepared& at_rest, const std::vector<system::PartInertia>& inertia, State& state);

}  // namespace scabo::analysis
