#include "scabo/analysis/dynamics/internal_motion.hpp"

#include "scabo/analysis/state/loads.hpp"

namespace scabo::analysis {

namespace {

using system::BodyLevel;
using system::LevelInTime;

/// Calls `of` for each level of a part that is there, and its number.
template <typename Of>
void for_levels(const InTime& in, std::size_t p, const Of& of) {
  const std::vector<BodyLevel>& levels = in.inertia[p].levels;
  for (std::size_t k = 0; k < levels.size() && !in.at_rest.is_absent(p); ++k) of(levels[k], k);
}

}  // namespace

InternalSteps eliminate_levels(const InTime& in, const State& from, const Acting& acting, std::vector<Vector>& forces) {
  const double h = in.system.size;
  InternalSteps steps(forces.size());
  for (std::size_t p = 0; p < forces.size(); ++p) {
    const double theta = in.inertia[p].theta;
    for_levels(in, p, [&](const BodyLevel& level, std::size_t k) {
      const LevelInTime& in_time = in.system.levels[p][k];
      const Vector v = from.velocity[p](level.dofs), w = level.own(from.internal[p]),
                   y = level.own(from.internal_velocity[p]);
      InternalStep step;
      step.r = system::translation_of(level, acting.acceleration - gravity_on(in.at_rest, acting.mean, level.body));
      const Vector momentum = level.Q() * y - level.Z() * v;
      const Vector moves = w + theta * (1.0 - theta) * h * y - step.r + (1.0 - theta) * level.of_stiffness * y;
      step.right = (1.0 / h - (1.0 - theta) * level.of_mass) * momentum - level.Z() * moves;
      const Vector of_u =
          in_time.coupling * in_time.A.solve(step.right) - (1.0 / h - (1.0 - theta) * level.of_mass) * y;
      forces[p](level.dofs) += level.Z() * of_u;
      steps[p].push_back(std::move(step));
    });
  }
  return steps;
}

void recover_levels(const InTime& in, const State& from, const InternalSteps& steps, const std::vector<Vector>& lengths,
                    State& to) {
  const double h = in.system.size;
  to.internal = from.internal;
  to.internal_velocity = from.internal_velocity;
  for (std::size_t p = 0; p < lengths.size(); ++p) {
    const double theta = in.inertia[p].theta;
    for_levels(in, p, [&](const BodyLevel& level, std::size_t k) {
      const LevelInTime& in_time = in.system.levels[p][k];
      const Vector length = lengths[p](level.dofs), y = level.own(from.internal_velocity[p]);
      const Vector reached = in_time.A.solve(steps[p][k].right + in_time.coupling * (level.Z() * length)) / h;
      level.own(to.internal_velocity[p]) = reached;
      level.own(to.internal[p]) += h * (theta * reached + (1.0 - theta) * y);
    });
  }
}

double internal_kinetic(const system::PartInertia& part, const State& state, std::size_t p) {
  double energy = 0.0;
  for (const BodyLevel& level : part.levels) {
    const Vector v = state.velocity[p](level.dofs), y = level.own(state.internal_velocity[p]);
    energy += y.dot(0.5 * (level.Q() * y) - level.Z() * v);
  }
  return energy;
}

double internal_elastic(const system::PartInertia& part, const State& state, std::size_t p) {
  double energy = 0.0;
  for (const BodyLevel& level : part.levels) {
    const Vector w = level.own(state.internal[p]);
    energy += 0.5 * w.dot(level.Z() * w);
  }
  return energy;
}

InternalWork internal_work(const InTime& in, const InternalSteps& steps, const State& from, const State& to,
                           const Vector& v, std::size_t p) {
  InternalWork work;
  const double theta = in.inertia[p].theta;
  for_levels(in, p, [&](const BodyLevel& level, std::size_t k) {
    const Vector y = theta * level.own(to.internal_velocity[p]) + (1.0 - theta) * level.own(from.internal_velocity[p]);
    const Vector Zy = level.Z() * y;
    work.damping += in.system.size * (level.of_mass * (y.dot(level.Q() * y) - 2.0 * Zy.dot(Vector(v(level.dofs)))) +
                                      level.of_stiffness * y.dot(Zy));
    work.external += steps[p][k].r.dot(level.Z() * (level.own(to.internal[p]) - level.own(from.internal[p])));
  });
  return work;
}

void add_internal(const Prepared& at_rest, const std::vector<system::PartInertia>& inertia, State& state) {
  state.internal.clear(), state.internal_velocity.clear();
  for (std::size_t p = 0; p < inertia.size(); ++p) {
    state.internal.push_back(Vector::Zero(system::size_of(inertia[p].levels)));
    state.internal_velocity.push_back(state.internal[p]);
    if (at_rest.is_absent(p)) continue;
    for (const BodyLevel& level : inertia[p].levels)
      level.own(state.internal[p]) = system::translation_of(level, -gravity_on(at_rest, state.factors, level.body));
    const double elastic = internal_elastic(inertia[p], state, p);
    state.energy.elastic += elastic;
    state.energy.external += elastic;
  }
}

}  // namespace scabo::analysis
