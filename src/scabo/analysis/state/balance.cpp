#include "scabo/analysis/state/balance.hpp"

#include <algorithm>
#include <cmath>

#include "scabo/analysis/state/friction_work.hpp"
#include "scabo/analysis/state/loads.hpp"

namespace scabo::analysis {

namespace {

/// Resultant of nodal forces.
Vec2 resultant_of(const Vector& forces) { return forces.reshaped(2, forces.size() / 2).rowwise().sum(); }

/// What displacements may leave unbalanced, a tenth of what the certificate allows; less where the tolerance is large.
/// Without reactions, which are not known before: those of its own constraints every part adds.
system::Balanced wanted_balance(const Prepared& prepared, const State& state) {
  constexpr double well_below = 0.1;
  system::Balanced wanted;
  wanted.part = std::min(wanted.part, well_below * prepared.model.solver.tolerance);
  wanted.at_least = std::max(prepared.force_scale, largest_force(state));
  return wanted;
}

/// Force and moment of everything that acts on a part, as [F_x, F_y, M / L] about its reference point.
Eigen::Vector3d resultant(const system::BodySystem& part, const std::vector<Vec2>& nodes, const Vector& forces) {
  if (nodes.empty()) return forces;  // a rigid body's forces are resultants
  Eigen::Vector3d sum = Eigen::Vector3d::Zero();
  for (std::size_t i = 0; i < nodes.size(); ++i)
    sum += system::rigid_point(nodes[i], part.reference(), part.lever()).transpose() *
           forces.segment<2>(static_cast<Eigen::Index>(2 * i));
  return sum;
}

/// 1/2 R'w: half the resultant of the loads on all bodies that share a reference point, times its displacement (7.6).
double work_on_references(const Prepared& prepared, const State& state) {
  double work = 0.0;
  for (const Reference& reference : prepared.references) {
    Vec2 resultant = Vec2::Zero();
    for (const int number : reference.parts) {
      const Vector& forces = state.forces[static_cast<std::size_t>(number)];
      // Of a rigid part: force and moment about its centroid.
      const bool rigid = prepared.structure.dofs.is_rigid(static_cast<std::size_t>(number));
      resultant += rigid ? Vec2(forces.head<2>()) : resultant_of(forces);
    }
    work += 0.5 * resultant.dot(displacement_of(reference, prepared, state.u));
  }
  return work;
}

/// Of what supports that begin or end prescribe: the points that they hold move with them.
double work_of_held_points(const Prepared& prepared, const State& from, const State& to) {
  double work = 0.0;
  for (std::size_t i = 0; i < prepared.contact.pairs.size(); ++i) {
    if (!is_held_point(prepared, prepared.contact.pairs[i])) continue;
    const auto k = static_cast<Eigen::Index>(i);
    const double moved = gap_at(prepared, from.factors, k) - gap_at(prepared, to.factors, k);
    work += 0.5 * (from.p[place_of(i)] + to.p[place_of(i)]) * moved;
  }
  return work;
}

/// N, of the pairs.
Vector normal_forces(const State& state) { return state.p(Eigen::seqN(0, state.p.size() / 2, 2)); }

}  // namespace

std::vector<Balance> add_displacements(const Prepared& prepared, const std::vector<Vector>* known, State& to,
                                       const std::vector<system::BegunSolve>& begun) {
  const auto& parts = prepared.structure.parts;
  const system::Balanced wanted = wanted_balance(prepared, to);
  std::vector<Balance> balances(parts.size());
  to.u.clear();
  to.reactions.clear();
  for (std::size_t p = 0; p < parts.size(); ++p) {
    if (prepared.is_absent(p)) {
      to.u.push_back(Vector::Zero(parts[p]->size()));
      to.reactions.push_back(Vector::Zero(static_cast<Eigen::Index>(parts[p]->constraints().size())));
      continue;
    }
    Balance& balance = balances[p];
    balance.forces = to.forces[p] + prepared.contact.motion[p].transpose() * to.p;
    // What rounding of the contact forces leaves of the balance of a part that they hold: the certificate judges it as
    // a resultant, against all forces, and not at one of the nodes that hold the part in displaced().
    const Matrix& rigid = parts[p]->rigid_motions();
    Vector forces = balance.forces;
    if (rigid.cols() > 0 && !prepared.structure.dofs.is_rigid(p)) take_out_rounding(rigid, forces.lpNorm<1>(), forces);
    system::Displaced reached =
        known ? system::Displaced{(*known)[p], {}}
              : parts[p]->displaced(forces, to.prescribed[p], wanted, begun.empty() ? nullptr : &begun[p]);
    if (rigid.cols() > 0) reached.u += rigid * to.rigid_motion.segment(prepared.contact.first_rigid[p], rigid.cols());
    balance.unbalanced = reached.unbalanced.size() > 0 ? std::move(reached.unbalanced)  // K resists no rigid motion
                                                       : parts[p]->unbalanced(reached.u, forces);
    to.reactions.push_back(parts[p]->reactions_of(balance.unbalanced));
    to.u.push_back(std::move(reached.u));
  }
  return balances;
}

void complete(const Prepared& prepared, State& state, const std::vector<Vector>* without_motions) {
  state.factors.time = state.time;
  state.forces = applied_forces(prepared, state.factors, state.released);
  state.prescribed = prescribed_values(prepared, state.factors.supports, state.replaced.moved);
  if (!state.velocity.empty()) return;  // in time displacements are a part of the history
  add_displacements(prepared, without_motions, state);
}

std::vector<Vector> displacements_without_motions(const Prepared& prepared, const State& state) {
  const std::vector<Vector> forces = applied_forces(prepared, state.factors, state.released),
                            prescribed = prescribed_values(prepared, state.factors.supports, state.replaced.moved);
  std::vector<Vector> u;
  for (std::size_t p = 0; p < forces.size(); ++p)
    u.push_back(prepared.structure.parts[p]->displacement(forces[p] + prepared.contact.motion[p].transpose() * state.p,
                                                          prescribed[p]));
  return u;
}

Vec2 displacement_of(const Reference& reference, const Prepared& prepared, const std::vector<Vector>& u) {
  const system::Dofs& dofs = prepared.structure.dofs;
  return reference.N * dofs.of_body(reference.body, u[dofs.part_of(reference.body)]);
}

Vector thermal_forces(const Prepared& prepared, const Factors& factors, std::size_t p) {
  Vector forces;
  if (prepared.structure.thermal.empty() || prepared.is_absent(p)) return forces;
  const double presence = presence_of(prepared, factors, p);
  for (const int load : prepared.structure.thermal[p].loads) {
    const auto number = static_cast<std::size_t>(load);
    const double factor = presence * factors.loads[number];
    if (factor == 0.0) continue;
    if (forces.size() == 0) forces = Vector::Zero(prepared.structure.dofs.size(p));
    forces += factor * prepared.structure.loads[number][p];
  }
  return forces;
}

double thermal_energy(const Prepared& prepared, const Factors& factors, std::size_t p, const Vector& u) {
  const Vector forces = thermal_forces(prepared, factors, p);
  if (forces.size() == 0) return 0.0;
  const system::ThermalEnergy& thermal = prepared.structure.thermal[p];
  Vector z(static_cast<Eigen::Index>(thermal.loads.size()));
  for (Eigen::Index k = 0; k < z.size(); ++k)
    z[k] = presence_of(prepared, factors, p) *
           factors.loads[static_cast<std::size_t>(thermal.loads[static_cast<std::size_t>(k)])];
  return 0.5 * z.dot(thermal.Q * z) - u.dot(forces);
}

Energy energy_between(const Prepared& prepared, const State& from, const State& to,
                      const std::vector<Balance>& balances) {
  Energy energy = from.energy;
  energy.elastic = 0.0;
  for (std::size_t p = 0; p < to.u.size(); ++p) {
    energy.external += 0.5 * (from.forces[p] + to.forces[p]).dot(to.u[p] - from.u[p]);
    energy.external += 0.5 * (from.reactions[p] + to.reactions[p]).dot(to.prescribed[p] - from.prescribed[p]);
    if (prepared.is_absent(p)) continue;
    energy.elastic += prepared.structure.parts[p]->elastic_energy(to.u[p], balances[p].forces, balances[p].unbalanced);
    const double thermal = thermal_energy(prepared, to.factors, p, to.u[p]);
    energy.elastic += thermal;
    energy.external += thermal - thermal_energy(prepared, from.factors, p, from.u[p]);
  }
  if (to.p.size() > 0)  // springs between the sides of pairs, and bars
    energy.elastic += 0.5 * prepared.contact.softness.dot(normal_forces(to).cwiseAbs2());
  if (!prepared.references.empty()) {
    const double reached = work_on_references(prepared, to);
    energy.elastic -= reached;
    energy.external -= reached - work_on_references(prepared, from);
  }
  energy.external += work_of_held_points(prepared, from, to);
  const FrictionWork friction = friction_work(prepared, from, to);
  energy.friction += friction.work;
  energy.external += friction.beyond_rule;
  energy.friction_error += friction.error;
  return energy;
}

double largest_force(const State& state) {
  double largest = state.p.size() > 0 ? state.p.lpNorm<Eigen::Infinity>() : 0.0;
  for (const auto* forces : {&state.forces, &state.reactions})
    for (const Vector& of_part : *forces)
      if (of_part.size() > 0) largest = std::max(largest, of_part.lpNorm<Eigen::Infinity>());
  return largest;
}

double resistance(const Prepared& prepared, const State& state) {
  double largest = 0.0;
  for (std::size_t p = 0; p < state.u.size(); ++p)
    largest = std::max(largest, prepared.structure.parts[p]->stiff_force(state.u[p]));
  return largest;
}

double scale_of(const Prepared& prepared, const State& state, double largest_at_work) {
  if (prepared.force_scale > 0.0) return largest_at_work;
  const double resisting = resistance(prepared, state);
  return largest_at_work <= rounding_of_resistance * resisting ? resisting : largest_at_work;
}

void certify_structure(const Prepared& prepared, const State& state, std::vector<Balance> balances, double scale,
                       contact::Certificate& certificate) {
  if (scale == 0.0) return;
  const system::Dofs& dofs = prepared.structure.dofs;
  for (std::size_t p = 0; p < state.u.size(); ++p) {
    if (!state.u[p].allFinite() || !state.reactions[p].allFinite()) {  // comparisons with nan would all look right
      certificate.equilibrium = HUGE_VAL;
      return;
    }
    if (prepared.is_absent(p)) continue;
    const system::BodySystem& part = *prepared.structure.parts[p];
    Vector& forces = balances[p].forces;
    certificate.equilibrium = std::max(certificate.equilibrium, part.imbalance_of(balances[p].unbalanced) / scale);
    // Of a rigid body imbalance() is the balance.
    if (dofs.is_rigid(p) || part.resists_rigid_motions()) continue;
    system::add_reactions(part.constraints(), state.reactions[p], forces);
    if (part.has_springs()) forces += part.spring_forces(state.u[p]);
    const Eigen::Vector3d sum = resultant(part, dofs.nodes(p), forces);
    // Against all forces on the part: those of a fine mesh are small, and many.
    const double unbalanced = part.is_revolved() ? std::abs(sum[1]) : sum.lpNorm<Eigen::Infinity>();
    certificate.rigid_balance = std::max(certificate.rigid_balance, unbalanced / std::max(scale, forces.lpNorm<1>()));
  }
}

}  // namespace scabo::analysis
