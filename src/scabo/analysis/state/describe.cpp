// The results of an accepted state, and sentences about it.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "scabo/analysis/state/balance.hpp"
#include "scabo/analysis/state/cracks.hpp"
#include "scabo/analysis/state/loads.hpp"
#include "scabo/analysis/state/state.hpp"
#include "scabo/base/components.hpp"
#include "scabo/system/internal_levels.hpp"
#include "scabo/system/tributary_lengths.hpp"

namespace scabo::analysis {

namespace {

/// Displacement along [n, t] of the point of a pair on side 0 (A) or 1 (B), from where the pair was found.
Vec2 displacement_at(const Prepared& prepared, const State& state, int contact, const mesh::ContactPair& pair,
                     int side) {
  Vec2 u = displacement_of(prepared, state, contact, pair, side);
  if (const mesh::Placement& placement = prepared.mesh.placement; !placement.empty())
    u -= placement[static_cast<std::size_t>(contact)][static_cast<std::size_t>(side)];
  return {u.dot(pair.normal), u.dot(tangent_of(pair.normal))};
}

/// Pressure on the axis of revolution, where nodal forces say nothing of it: that of the pairs beside it, with the
/// slope 0 that it has there, a + b r^2 through two of them that are closed.
void set_on_axis(std::size_t axis, ContactResult& result) {
  std::vector<const PairResult*> others;
  for (std::size_t i = 0; i < result.pairs.size(); ++i)
    if (i != axis) others.push_back(&result.pairs[i]);
  PairResult& pair = result.pairs[axis];
  pair.pressure = pair.shear = 0.0;
  if (others.empty()) return;
  const auto count = static_cast<std::ptrdiff_t>(std::min<std::size_t>(2, others.size()));
  std::partial_sort(
      others.begin(), others.begin() + count, others.end(),
      [](const PairResult* one, const PairResult* other) { return one->position.x() < other->position.x(); });
  const PairResult& first = *others[0];
  pair.pressure = first.pressure;
  if (count < 2 || others[1]->state == contact::ContactState::open) return;
  const double near = std::pow(first.position.x(), 2), far = std::pow(others[1]->position.x(), 2);
  pair.pressure += (first.pressure - others[1]->pressure) * near / (far - near);
}

/// `revolved`: forces around an axis have no moment.
void add_totals(const Vec2& about, bool revolved, ContactResult& result) {
  Vec2 weighted = Vec2::Zero();  // relative to `about`, so that distant coordinates keep their digits
  double pressing = 0.0;
  for (const PairResult& pair : result.pairs) {
    const Vec2 force = pair.normal_force * pair.normal + pair.tangential_force * tangent_of(pair.normal);
    const Vec2 arm = pair.position - about;
    result.force += force;
    if (!revolved) result.moment += cross(arm, force);
    weighted += pair.normal_force * arm;
    pressing += std::abs(pair.normal_force);
  }
  for (const PairResult& pair : result.pairs) {
    result.min_gap = std::min(result.min_gap, pair.gap);
    result.normal_force += pair.normal_force;
    result.tangential_force += pair.tangential_force;
    result.open += pair.state == contact::ContactState::open;
    result.stick += pair.state == contact::ContactState::stick;
    result.slip += pair.state == contact::ContactState::slip;
    result.max_pressure = std::max(result.max_pressure, pair.pressure);
    if (pair.state == contact::ContactState::open) {
      result.max_gap = std::max(result.max_gap, pair.gap);  // a closed pair's gap is rounding
      continue;
    }
    if (!result.first_in_contact) result.first_in_contact = pair.pair;
    result.last_in_contact = pair.pair;
  }
  constexpr double rounding_of_sum = 1e-9;  // of a contact that is pulled as much as it is pressed
  if (!revolved && result.normal_force > rounding_of_sum * pressing)
    result.centre_of_pressure = about + Vec2(weighted / result.normal_force);
}

std::vector<ContactResult> contact_results(const Prepared& prepared, const State& state) {
  std::vector<ContactResult> results(prepared.model.contacts.size());
  std::vector<int> on_axis(results.size(), -1);  // of each contact, the pair there
  for (std::size_t i = 0; i < prepared.contact.pairs.size(); ++i) {
    const system::ContactSystem::Pair& at = prepared.contact.pairs[i];
    if (at.is_bar()) continue;
    const mesh::ContactPair& pair = mesh_pair(prepared, at);
    const model::Contact& contact = prepared.model.contacts[static_cast<std::size_t>(at.contact)];
    const auto k = static_cast<Eigen::Index>(i);
    PairResult row;
    row.pair = at.number;
    row.position = pair.point_a;
    row.normal = pair.normal;
    row.gap = state.gap[k];
    row.slip = state.slip[k];
    if (state.replaced.slip_before.size() > 0) row.slip += state.replaced.slip_before[k];
    row.normal_force = state.p[place_of(k)];
    row.tangential_force = state.p[place_of(k, 1)];
    row.pressure = row.normal_force / prepared.contact.laws.area[k];
    row.shear = row.tangential_force / prepared.contact.laws.area[k];
    row.state = state.states[i];
    row.displacement_a = displacement_at(prepared, state, at.contact, pair, 0);
    row.displacement_b = displacement_at(prepared, state, at.contact, pair, 1);
    ContactResult& result = results[static_cast<std::size_t>(at.contact)];
    const mesh::Interface& interface = prepared.mesh.interfaces[static_cast<std::size_t>(at.contact)];
    if (system::is_on_axis(pair, interface, prepared.model))
      on_axis[static_cast<std::size_t>(at.contact)] = static_cast<int>(result.pairs.size());
    result.pairs.push_back(row);
    if (contact.cohesion > 0.0 || contact.tension > 0.0)
      result.broken = result.broken.value_or(0) + state.history[i].broken;
  }
  const Vector entered = entered_forces(prepared, state.factors);
  for (std::size_t c = 0; c < results.size(); ++c) {
    results[c].name = prepared.model.contacts[c].name;
    for (std::size_t i = 0; i < results[c].pairs.size(); ++i)
      if (on_axis[c] == static_cast<int>(i)) set_on_axis(i, results[c]);
    for (std::size_t load = 0; load < prepared.model.loads.size(); ++load)
      if (const auto& pores = prepared.structure.pores[load]; !pores.empty() && pores[c])
        results[c].pore_force = results[c].pore_force.value_or(0.0) + state.factors.loads[load] * *pores[c];
    for (const auto& of_load : prepared.structure.entering)
      for (const system::EnteringPressure& fluid : of_load)
        if (fluid.contact == static_cast<int>(c)) results[c].pore_force = results[c].pore_force.value_or(0.0);
    for (std::size_t i = 0; results[c].pore_force && i < static_cast<std::size_t>(entered.size()) / 2; ++i)
      if (prepared.contact.pairs[i].contact == static_cast<int>(c)) *results[c].pore_force += entered[place_of(i)];
    add_totals(prepared.model.contacts[c].about, prepared.model.analysis.revolved(), results[c]);
  }
  return results;
}

void add(element::CellLoads& to, const element::CellLoads& loads, double factor) {
  if (to.size() < loads.size()) to.resize(loads.size());
  for (std::size_t c = 0; c < loads.size(); ++c) element::add(to[c], loads[c], factor);
}

/// Estimated relative error of displacements and energy by the rounding of stiffness; 0 where bodies only move without
/// stress.
double lost_to_rounding(const Prepared& prepared, const State& state) {
  // Of displacements: of a body that a temperature expands freely, more than what is stored.
  const bool known = prepared.references.empty() && prepared.structure.thermal.empty();
  double energy = known ? state.energy.elastic : 0.0, lost = 0.0, resisting = 0.0;
  for (std::size_t p = 0; p < state.u.size(); ++p) {
    const system::BodySystem& part = *prepared.structure.parts[p];
    if (!known) energy += part.elastic_energy(state.u[p]);
    lost += part.energy_lost(state.u[p]);
    if (state.u[p].size() > 0) resisting += part.stiff_force(state.u[p]) * state.u[p].lpNorm<Eigen::Infinity>();
  }
  return energy > 1e-22 * resisting ? lost / energy : 0.0;
}

/// Factors of all loads, and of the supports that prescribe a motion.
void add_factors(const Prepared& prepared, const State& state, IncrementResult& result) {
  for (std::size_t i = 0; i < prepared.model.loads.size(); ++i)
    result.factors[prepared.model.loads[i].name] = state.factors.loads[i];
  for (std::size_t i = 0; i < prepared.model.supports.size(); ++i) {
    const model::Support& support = prepared.model.supports[i];
    if (support.displacement[0].value_or(0.0) != 0.0 || support.displacement[1].value_or(0.0) != 0.0 ||
        support.rotation.value_or(0.0) != 0.0)
      result.factors[support.name] = state.factors.supports[i];
  }
}

/// Of supports that begin or end: what they exert, and what is left of it in the step in which they end.
void add_staged_reactions(const Prepared& prepared, const State& state, IncrementResult& result) {
  if (!model::has_stages(prepared.model.supports)) return;
  const std::vector<Eigen::Vector3d> exerted = reactions_of_held_points(prepared, state);
  for (std::size_t i = 0; i < exerted.size(); ++i) {
    const model::Support& support = prepared.model.supports[i];
    Eigen::Vector3d all = exerted[i];
    if (!state.released_reactions.empty())
      all += state.factors.release * Eigen::Map<const Eigen::Vector3d>(&state.released_reactions[3 * i]);
    result.reactions[i] += all.head<2>();
    if (support.rotation && support.is_staged()) result.moments[i] = all[2];
  }
}

/// Forces of all supports, and moments of those that prescribe a rotation.
void add_reactions(const Prepared& prepared, const State& state, IncrementResult& result) {
  result.reactions.assign(prepared.model.supports.size(), Vec2::Zero());
  result.moments.resize(prepared.model.supports.size());
  for (std::size_t p = 0; p < state.u.size(); ++p) {
    const system::BodySystem& part = *prepared.structure.parts[p];
    for (std::size_t c = 0; c < part.constraints().size(); ++c) {
      const system::Constraint& constraint = part.constraints()[c];
      const auto support = static_cast<std::size_t>(constraint.support);
      const double reaction = state.reactions[p][static_cast<Eigen::Index>(c)];
      if (!constraint.rotation)
        result.reactions[support] += reaction * constraint.direction();
      else if (prepared.model.supports[support].rotation)
        result.moments[support] = reaction * part.lever();
    }
  }
  add_staged_reactions(prepared, state, result);
}

/// Displacements of the nodes of a body, of a rigid one with its rotation, from where the analysis began.
Vector displacements_of(const Prepared& prepared, const State& state, int body) {
  const system::Dofs& dofs = prepared.structure.dofs;
  const bool rigid = prepared.model.bodies[static_cast<std::size_t>(body)].rigid;
  Vector u = dofs.of_body(body, state.u[dofs.part_of(body)]);
  if (!state.replaced.moved.empty()) {
    const Vec2& moved = state.replaced.moved[dofs.part_of(body)];
    if (rigid)
      u.head<2>() += moved;
    else
      u.reshaped(2, u.size() / 2).colwise() += moved;
  }
  if (rigid) u[2] /= part_of(prepared, body).lever();
  return u;
}

Vector velocities_of(const Prepared& prepared, const State& state, int body) {
  const system::Dofs& dofs = prepared.structure.dofs;
  Vector v = dofs.of_body(body, state.velocity[dofs.part_of(body)]);
  if (prepared.model.bodies[static_cast<std::size_t>(body)].rigid) v[2] /= part_of(prepared, body).lever();
  return v;
}

/// What moves inside bodies that are one super-element each, beyond what their loads do at rest.
void add_internal(const Prepared& prepared, const State& state, FieldState& fields) {
  const Discretisation& on = prepared.discretisation;
  const system::Dofs& dofs = prepared.structure.dofs;
  for (std::size_t p = 0; p < state.internal.size(); ++p) {
    if (state.internal[p].size() == 0 || prepared.is_absent(p)) continue;
    for (const system::BodyLevel& level : system::levels_of(on.model, on.mesh, on.cells, dofs, p)) {
      const auto b = static_cast<std::size_t>(level.body);
      fields.interior[b].resize(1);
      const Vector at_rest = system::translation_of(level, -gravity_on(prepared, state.factors, level.body));
      element::InternalMotion& motion = fields.interior[b].front().motion;
      motion = system::internal_motion(on.model, on.mesh, on.cells, level.body, level.own(state.internal[p]) - at_rest);
      motion.velocity = level.own(state.internal_velocity[p]);
    }
  }
}

/// What the fields of all bodies follow from.
FieldState fields_of(const Prepared& prepared, const State& state) {
  FieldState fields;
  const std::size_t bodies = prepared.model.bodies.size();
  fields.interior.resize(bodies);
  fields.initial.resize(bodies);
  for (std::size_t b = 0; b < bodies; ++b) {
    const auto body = static_cast<int>(b);
    fields.displacements.push_back(displacements_of(prepared, state, body));
    if (!state.velocity.empty()) fields.velocities.push_back(velocities_of(prepared, state, body));
    const double presence = presence_of(prepared, state.factors, prepared.structure.dofs.part_of(body));
    for (std::size_t load = 0; load < prepared.model.loads.size(); ++load) {
      const double factor = presence * state.factors.loads[load];
      add(fields.interior[b], prepared.structure.interior[load][b], factor);
      fields.initial[b].add(prepared.structure.initial[load][b], factor);
    }
  }
  add_internal(prepared, state, fields);
  return fields;
}

std::vector<int> absent_bodies(const Prepared& prepared) {
  std::vector<int> absent;
  for (int body = 0; body < static_cast<int>(prepared.model.bodies.size()); ++body)
    if (prepared.is_absent(prepared.structure.dofs.part_of(body))) absent.push_back(body);
  return absent;
}

}  // namespace

Vec2 displacement_of(const Prepared& prepared, const State& state, int contact, const mesh::ContactPair& pair,
                     int side) {
  const model::Contact& named = prepared.model.contacts[static_cast<std::size_t>(contact)];
  const int body = side == 0 ? named.a.body : named.b.body, node = side == 0 ? pair.node_a : pair.node_b;
  const system::Dofs& dofs = prepared.structure.dofs;
  const system::BodySystem& part = part_of(prepared, body);
  const Vector& of_part = state.u[dofs.part_of(body)];
  Vec2 u = node >= 0
               ? Vec2(of_part.segment<2>(dofs.of(body, node, 0)))
               : Vec2(system::rigid_point(prepared.mesh.point_of(contact, pair, side), part.reference(), part.lever()) *
                      of_part);
  if (!state.replaced.moved.empty()) u += state.replaced.moved[dofs.part_of(body)];
  return u;
}

std::vector<double> tensions_of(const Prepared& prepared, const State& state) {
  std::vector<double> tensions;
  for (std::size_t bar = 0; bar < prepared.model.bars.size(); ++bar)
    tensions.push_back(preload_of(prepared, state.factors, bar));
  for (std::size_t i = 0; i < prepared.contact.pairs.size(); ++i)
    if (const system::ContactSystem::Pair& at = prepared.contact.pairs[i]; at.is_bar() && !is_held_point(prepared, at))
      tensions[static_cast<std::size_t>(at.index)] -= state.p[place_of(i)];
  return tensions;
}

std::vector<Eigen::Vector3d> reactions_of_held_points(const Prepared& prepared, const State& state) {
  std::vector<Eigen::Vector3d> reactions(prepared.model.supports.size(), Eigen::Vector3d::Zero());
  for (std::size_t i = 0; i < prepared.contact.pairs.size(); ++i) {
    const system::ContactSystem::Pair& at = prepared.contact.pairs[i];
    if (!is_held_point(prepared, at)) continue;
    const system::Constraint& held = *prepared.structure.bars[static_cast<std::size_t>(at.index)].held;
    const auto support = static_cast<std::size_t>(held.support);
    const double force = state.p[place_of(i)];
    if (held.rotation)
      reactions[support][2] += force * part_of(prepared, prepared.model.supports[support].on.body).lever();
    else
      reactions[support].head<2>() += force * held.direction();
  }
  return reactions;
}

IncrementResult describe(const Prepared& prepared, const State& state) {
  const system::Dofs& dofs = prepared.structure.dofs;
  IncrementResult result;
  add_factors(prepared, state, result);
  result.contacts = contact_results(prepared, state);
  result.energy = state.energy;
  if (!state.velocity.empty()) result.time = state.time;
  result.largest_force = scale_of(prepared, state, largest_force(state));
  result.lost_to_rounding = lost_to_rounding(prepared, state);
  add_reactions(prepared, state, result);
  result.springs =
      system::spring_resultants(prepared.structure.springs, prepared.model, dofs, state.u, state.factors.loads);
  result.bars = tensions_of(prepared, state);
  result.fields = fields_of(prepared, state);
  result.absent = absent_bodies(prepared);
  return result;
}

std::vector<CrackResult> crack_results(const Prepared& prepared, const State& state) {
  IncrementResult result;
  result.contacts = contact_results(prepared, state);
  result.fields = fields_of(prepared, state);
  result.absent = absent_bodies(prepared);
  return crack_results(prepared.discretisation, result);
}

std::string describe_motions(const Prepared& prepared, const Vector& a) {
  constexpr std::size_t most = 4;
  struct Moving {
    std::size_t part;
    Eigen::Vector3d motion;
  };
  std::vector<Moving> moving;
  for (std::size_t p = 0; p < prepared.structure.parts.size(); ++p) {
    const system::BodySystem& part = *prepared.structure.parts[p];
    const Eigen::Index m = part.rigid_motions().cols();
    if (m == 0 || prepared.is_absent(p)) continue;
    const Eigen::Vector3d motion = part.rigid_coordinates() * a.segment(prepared.contact.first_rigid[p], m);
    if (motion.norm() >= 1e-6 * a.norm()) moving.push_back({p, motion});
  }
  if (moving.size() > most)  // equal motions stay in the order of the parts: differences by rounding do not count
    std::stable_sort(moving.begin(), moving.end(), [](const Moving& one, const Moving& other) {
      return static_cast<float>(one.motion.norm()) > static_cast<float>(other.motion.norm());
    });
  const system::Dofs& dofs = prepared.structure.dofs;
  std::string text;
  std::size_t others = 0;
  for (std::size_t i = 0; i < moving.size(); ++i) {
    const auto& [p, motion] = moving[i];
    if (i >= most) {
      others += dofs.bodies_of(p).size();
      continue;
    }
    const system::BodySystem& part = *prepared.structure.parts[p];
    text += fmt::format("{}{}: {}", i > 0 ? "; " : "", dofs.name_of(p, prepared.model),
                        system::describe_motion(motion, part.reference(), part.lever()));
  }
  if (others > 0) text += fmt::format("; and {} more {}", others, others == 1 ? "body" : "bodies");
  return text;
}

}  // namespace scabo::analysis
