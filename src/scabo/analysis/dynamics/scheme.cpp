#include "scabo/analysis/dynamics/scheme.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "scabo/analysis/dynamics/acting_pairs.hpp"
#include "scabo/analysis/state/loads.hpp"
#include "scabo/analysis/state/step_factors.hpp"
#include "scabo/base/components.hpp"
#include "scabo/element/plane/elasticity.hpp"
#include "scabo/model/limits.hpp"
#include "scabo/model/time_steps.hpp"

namespace scabo::analysis {

namespace {

/// Gives the components of a velocity that supports hold theirs. Of a rigid body on supports all are 0.
void hold(const system::BodySystem& part, const Vector& of_supports, Vector& v) {
  for (std::size_t c = 0; c < part.constraints().size(); ++c) {
    const system::Constraint& constraint = part.constraints()[c];
    if (constraint.dof < 0) {
      v.setZero();
      return;
    }
    auto at = v.segment<2>(constraint.dof / 2 * 2);
    const Vec2 along = constraint.direction();
    at += (of_supports[static_cast<Eigen::Index>(c)] - at.dot(along)) * along;
  }
}

double shortest_side(const mesh::BodyMesh& mesh) {
  double shortest = std::numeric_limits<double>::infinity();
  for (const mesh::Cell& cell : mesh.cells)
    for (const mesh::LineElement& element : cell.boundary) {
      const Vec2 &a = mesh.nodes[static_cast<std::size_t>(element.nodes.front())],
                 &b = mesh.nodes[static_cast<std::size_t>(element.nodes.back())];
      shortest = std::min(shortest, (b - a).norm() / static_cast<double>(element.nodes.size() - 1));
    }
  return shortest;
}

/// Speed of the fastest waves.
double wave_speed(const model::Material& material, model::Plane plane) {
  const element::Mat3 D = element::elasticity_matrix(material, plane);
  return std::sqrt(std::max(D(0, 0), D(1, 1)) / *material.density);
}

/// A size of time steps without the rounding of the times between which they lie: it does not depend on which increment
/// of a run asks first.
double without_rounding(double size) {
  constexpr int bits = 40;
  int exponent = 0;
  const double mantissa = std::frexp(size, &exponent);
  return std::ldexp(std::round(std::ldexp(mantissa, bits)), exponent - bits);
}

/// An interference has to be resolved at rest. `at_rest` has the gaps of the contact problem: those that follow from the
/// displacements of a slender body that contact alone holds have its rounding errors.
void refuse_overlap(const Prepared& prepared, const State& at_rest) {
  const double none = rounding_of_gaps(prepared);
  for (Eigen::Index i = 0; i < at_rest.gap.size(); ++i) {
    if (at_rest.gap[i] >= -none) continue;
    const model::Contact& contact =
        prepared.model.contacts[static_cast<std::size_t>(prepared.contact.pairs[static_cast<std::size_t>(i)].contact)];
    throw InputError(prepared.model.file,
                     {{contact.source, fmt::format("contact '{}' overlaps by {:.3g} at the begin of the first step in "
                                                   "time: let a quasi-static step before it resolve the interference",
                                                   contact.name, -at_rest.gap[i])}});
  }
}

}  // namespace

double longest_time_step(const model::Model& model, const mesh::Mesh& mesh, const model::Step& step) {
  if (step.dynamic->step) return *step.dynamic->step;
  double shortest = std::numeric_limits<double>::infinity();
  for (std::size_t b = 0; b < model.bodies.size(); ++b) {
    if (model.bodies[b].rigid || model.bodies[b].outside) continue;
    double fastest = 0.0;
    for (const mesh::Cell& cell : mesh.bodies[b].cells)
      for (const int index : cell.materials)
        if (const model::Material& material = model.materials[static_cast<std::size_t>(index)];
            material.density.value_or(0.0) > 0.0)
          fastest = std::max(fastest, wave_speed(material, model.analysis.plane));
    if (fastest > 0.0) shortest = std::min(shortest, shortest_side(mesh.bodies[b]) / fastest);
  }
  constexpr double parts = 1000.0;
  const double duration = step.dynamic->duration;
  double longest = std::isfinite(shortest) ? shortest : duration / parts;
  for (const std::size_t curve : model::curves_in_time(step))
    longest = std::min(longest, model::resolving_step(model.curves[curve], duration));
  return longest;
}

void Dynamics::begin(const Prepared& at_rest, std::size_t step, double begin, double end) {
  const bool other_bodies = model::has_stages(solution_.model.bodies) && step != increment_.step;
  if (at_rest_ != &at_rest || other_bodies) {
    at_rest_ = &at_rest;
    systems_.clear();
    inertia_ =
        system::inertia_of(at_rest.structure, solution_.model, solution_.mesh, solution_.cells, solution_.threads);
    for (int k = 0; k < 2; ++k) {
      mass_of_ground_[k].clear();
      for (std::size_t p = 0; p < inertia_.size(); ++p)
        mass_of_ground_[k].push_back(inertia_[p].M.times(at_rest.structure.dofs.translation(p, k)));
    }
  }
  const double duration = solution_.model.steps[step].dynamic->duration;
  increment_ = {step, begin * duration, end * duration, 1, 0.0};
  if (solution_.model.restart && solution_.model.restart->motion)
    increment_.before = solution_.model.restart->motion->time;
  for (std::size_t before = 0; before < step; ++before)
    if (const auto& dynamic = solution_.model.steps[before].dynamic) increment_.before += dynamic->duration;
  if (step_ != step) {
    step_ = step;
    longest_ = longest_time_step(solution_.model, solution_.mesh, solution_.model.steps[step]);
  }
  const double longest = longest_;
  if (duration > model::limits::time_steps * longest)
    throw InputError(solution_.model.file,
                     {{solution_.model.steps[step].source,
                       fmt::format("would need {:.0e} time steps of {:.3g}, by its waves and curves: give 'step'",
                                   duration / longest, longest)}});
  constexpr double rounding = 1e-9;
  increment_.steps =
      std::max(1, static_cast<int>(std::ceil((increment_.end - increment_.begin) / longest * (1.0 - rounding))));
}

double Dynamics::part_at_once(double rest) const { return std::min(rest, 1.0 / increment_.steps); }

double Dynamics::part_after(double at, double part) const {
  constexpr double rounding = 1e-6;
  const double steps = at * increment_.steps;
  return std::abs(steps - std::round(steps)) <= rounding ? 1.0 / increment_.steps : part;
}

const StepSystem& Dynamics::system_of(double size) const {
  constexpr double rounding = 1e-6;
  constexpr std::size_t most = 8;  // factors of that many sizes are kept, which a step may be halved to again and again
  const auto found = std::find_if(systems_.begin(), systems_.end(),
                                  [&](const auto& system) { return std::abs(system->size - size) <= rounding * size; });
  if (found != systems_.end()) {
    std::rotate(systems_.begin(), found, found + 1);
    return *systems_.front();
  }
  if (systems_.size() == most) systems_.pop_back();
  systems_.insert(systems_.begin(), std::make_unique<const StepSystem>(*at_rest_, inertia_, size, solution_.threads));
  return *systems_.front();
}

std::vector<Vector> Dynamics::support_velocities(double time, double within) const {
  const auto values = [&](double at) {
    return prescribed_values(*at_rest_, factors_at_time(solution_.model, increment_.step, at).supports, {});
  };
  std::vector<Vector> velocities = values(time + 0.5 * within);
  const std::vector<Vector> before = values(time - 0.5 * within);
  for (std::size_t p = 0; p < velocities.size(); ++p) velocities[p] = (velocities[p] - before[p]) / within;
  return velocities;
}

State Dynamics::in_motion(State at_rest, double step) const {
  refuse_overlap(*at_rest_, at_rest);
  at_rest.gap = gaps_at(*at_rest_, at_rest);
  const std::vector<Vector> of_supports = support_velocities(increment_.begin, step);
  const system::Dofs& dofs = at_rest_->structure.dofs;
  for (const Vector& u : at_rest.u) at_rest.velocity.push_back(Vector::Zero(u.size()));
  for (const model::InitialVelocity& initial : solution_.model.initial) {
    const auto b = static_cast<std::size_t>(initial.body);
    const std::size_t p = dofs.part_of(initial.body);
    Vector& v = at_rest.velocity[p];
    const Vec2 about = solution_.model.bodies[b].outline.centroid();
    if (dofs.is_rigid(p))
      v << initial.velocity, at_rest_->structure.parts[p]->lever() * initial.rotation;
    else
      for (std::size_t node = 0; node < solution_.mesh.bodies[b].nodes.size(); ++node) {
        const Vec2 arm = solution_.mesh.bodies[b].nodes[node] - about;
        v.segment<2>(dofs.of(initial.body, static_cast<int>(node), 0)) =
            initial.velocity + initial.rotation * Vec2(-arm.y(), arm.x());
      }
  }
  for (std::size_t p = 0; p < of_supports.size(); ++p)
    hold(*at_rest_->structure.parts[p], of_supports[p], at_rest.velocity[p]);
  add_internal(*at_rest_, inertia_, at_rest);
  at_rest.energy.kinetic = kinetic_energy(*at_rest_, inertia_, at_rest);
  at_rest.energy.external += at_rest.energy.kinetic;
  at_rest.largest_energy = at_rest.energy.kinetic + std::abs(at_rest.energy.elastic);
  return at_rest;
}

Acting Dynamics::acting(double from, double to, const StepSystem& system) const {
  const model::Model& model = solution_.model;
  const std::size_t step = increment_.step;
  const model::DynamicStep& dynamic = *model.steps[step].dynamic;
  Acting acting{mean_factors(model, step, from, to), factors_at_time(model, step, to), {}, Vec2::Zero(), {}};
  acting.mean.time = increment_.before + 0.5 * (from + to);
  acting.end.time = increment_.before + to;
  acting.support = support_velocities(to, system.size);
  for (std::size_t k = 0; k < 2; ++k) {
    if (dynamic.ground[k] < 0) continue;
    const double acceleration =
        model::mean_between(model.curves[static_cast<std::size_t>(dynamic.ground[k])], from, to, dynamic.duration);
    acting.acceleration[static_cast<Eigen::Index>(k)] = acceleration;
    acting.ground.resize(inertia_.size());
    for (std::size_t p = 0; p < inertia_.size(); ++p) {
      if (acting.ground[p].size() == 0) acting.ground[p] = Vector::Zero(at_rest_->structure.parts[p]->size());
      acting.ground[p] -= acceleration * mass_of_ground_[k][p];
    }
  }
  return acting;
}

Attempt Dynamics::attempt(const State& from, double part) const {
  const double end = increment_.begin + part * (increment_.end - increment_.begin);
  const double begin = from.velocity.empty() ? increment_.begin : from.time - increment_.before;
  const double longest = without_rounding((increment_.end - increment_.begin) / increment_.steps);
  const int halvings = std::max(0, static_cast<int>(std::lround(std::log2(longest / (end - begin)))));
  const StepSystem& system = system_of(std::ldexp(longest, -halvings));
  StepBounds bounds;
  if (halvings < solution_.model.solver.halvings) {
    bounds.added = 1e-4;
    if (!solution_.model.steps[increment_.step].dynamic->step) bounds.error = 1e-3;
  }
  const InTime in{*at_rest_, inertia_, system};
  const Acting acts = acting(begin, end, system);
  Attempt made = from.velocity.empty() ? time_step(in, in_motion(from, system.size), acts, bounds)
                                       : time_step(in, from, acts, bounds);
  made.state.time = increment_.before + end;
  return made;
}

}  // namespace scabo::analysis
