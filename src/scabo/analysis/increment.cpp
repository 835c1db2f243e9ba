#include "scabo/analysis/increment.hpp"

#include <fmt/format.h>

#include <Eigen/Cholesky>
#include <algorithm>
#include <cmath>
#include <limits>

#include "scabo/analysis/branch.hpp"
#include "scabo/analysis/large_slip.hpp"
#include "scabo/linalg/twofold.hpp"
#include "scabo/system/contact_laws.hpp"

namespace scabo::analysis {

namespace {

const mesh::ContactPair& mesh_pair(const Prepared& prepared, const system::ContactSystem::Pair& at) {
  return prepared.mesh.interfaces[static_cast<std::size_t>(at.contact)].pairs[static_cast<std::size_t>(at.index)];
}

/// The part that a body belongs to.
const system::BodySystem& part_of(const Prepared& prepared, int body) {
  return *prepared.structure.parts[prepared.structure.dofs.part_of(body)];
}

/// Resultants up to this part of the sum of all forces on a part are rounding of that sum; far below the tolerance of
/// the certificate, 1e-10.
constexpr double rounding_of_sums = 1e-12;

/// Sum of the sizes of all forces on part `p`.
double sum_of_loads(const Prepared& prepared, std::size_t p, const Factors& factors,
                    const std::vector<Vector>& released) {
  double sum = 0.0;
  for (std::size_t load = 0; load < factors.loads.size(); ++load)
    if (prepared.structure.loads[load][p].size() > 0)
      sum += std::abs(factors.loads[load]) * prepared.structure.loads[load][p].lpNorm<1>();
  if (!released.empty()) sum += released[p].lpNorm<1>();
  return sum;
}

/// Takes out of the forces on part `p` resultants along its free rigid motions that are rounding, spread over all
/// forces. Contact balances the resultants without them (loads_on_motions); left in, they would be found unbalanced on
/// the few degrees of freedom that hold the part in displacement(): with a thousand pairs, 5e-11 of the largest force.
void take_out_rounding(const Matrix& rigid, double sum, Vector& forces) {
  Vector resultants(rigid.cols());
  for (Eigen::Index k = 0; k < rigid.cols(); ++k) {
    linalg::Twofold work;  // of many small forces, as weight, a sum in working precision is rounding itself
    for (Eigen::Index i = 0; i < forces.size(); ++i) work = work + linalg::exact_product(rigid(i, k), forces[i]);
    resultants[k] = work.high;
  }
  for (double& resultant : resultants)
    if (std::abs(resultant) > rounding_of_sums * sum) resultant = 0.0;
  if (resultants.isZero(0.0)) return;
  std::vector<int> loaded;
  for (Eigen::Index i = 0; i < forces.size(); ++i)
    if (forces[i] != 0.0) loaded.push_back(static_cast<int>(i));
  const Matrix motions = rigid(loaded, Eigen::all);
  const Eigen::LDLT<Matrix> squares(motions.transpose() * motions);
  if (squares.info() == Eigen::Success && squares.rcond() > 1e-6)
    forces(loaded) -= motions * squares.solve(resultants);
  else  // few forces, or parallel ones
    forces -= rigid * Matrix(rigid.transpose() * rigid).ldlt().solve(resultants);
}

/// Loads, and what removed bodies still exert of the forces that they exerted.
std::vector<Vector> applied_forces(const Prepared& prepared, const Factors& factors,
                                   const std::vector<Vector>& released) {
  std::vector<Vector> forces;
  for (const auto& part : prepared.structure.parts) forces.push_back(Vector::Zero(part->size()));
  for (std::size_t p = 0; p < forces.size(); ++p) {
    const double presence = presence_of(prepared, factors, p);
    if (presence == 0.0) continue;
    for (std::size_t load = 0; load < factors.loads.size(); ++load)
      if (prepared.structure.loads[load][p].size() > 0)
        forces[p] += presence * factors.loads[load] * prepared.structure.loads[load][p];
    if (!released.empty() && released[p].size() > 0 && factors.release != 0.0)
      forces[p] += factors.release * released[p];
    if (const Matrix& rigid = prepared.structure.parts[p]->rigid_motions(); rigid.cols() > 0)
      take_out_rounding(rigid, sum_of_loads(prepared, p, factors, released), forces[p]);
  }
  return forces;
}

/// Resultants of the loads on part `p` along its free rigid motions. Loads in equilibrium, as two equal opposite forces
/// or the forces of a temperature, leave rounding of their sum, which nothing could balance where neither supports nor
/// friction hold it: it is zero, whatever the unit of length makes of the last digits.
Vector loads_on_motions(const Prepared& prepared, std::size_t p, const State& state) {
  const double sum = sum_of_loads(prepared, p, state.factors, state.released);
  Vector f = prepared.structure.parts[p]->rigid_motions().transpose() * state.forces[p];
  for (double& resultant : f)
    if (std::abs(resultant) <= rounding_of_sums * sum) resultant = 0.0;
  return f;
}

/// Of the displacements `u`: without the translations of the parts.
std::vector<Vector> prescribed_values(const Prepared& prepared, const std::vector<double>& factors,
                                      const std::vector<Vec2>& moved) {
  std::vector<Vector> values;
  for (std::size_t p = 0; p < prepared.structure.parts.size(); ++p) {
    const auto& part = prepared.structure.parts[p];
    Vector value = Vector::Zero(static_cast<Eigen::Index>(part->constraints().size()));
    for (std::size_t c = 0; c < part->constraints().size() && !prepared.is_absent(p); ++c) {
      const system::Constraint& constraint = part->constraints()[c];
      double& of = value[static_cast<Eigen::Index>(c)];
      of = constraint.value * factors[static_cast<std::size_t>(constraint.support)];
      if (!moved.empty() && !constraint.rotation) of -= constraint.direction().dot(moved[values.size()]);
    }
    values.push_back(std::move(value));
  }
  return values;
}

/// Motions of pairs without contact forces, along [n, t].
struct FreeMotion {
  Vector pairs, held;  ///< 2N; of pairs that supports hold
};

/// Degrees of freedom of a part that its pairs touch.
std::vector<int> touched_dofs(const system::ContactSystem& contact, std::size_t p) {
  std::vector<int> dofs;
  const auto is_touched = [](const Eigen::SparseMatrix<double>& motion, Eigen::Index dof) {
    return motion.outerIndexPtr()[dof] < motion.outerIndexPtr()[dof + 1];
  };
  for (Eigen::Index dof = 0; dof < contact.motion[p].cols(); ++dof)
    if (is_touched(contact.motion[p], dof) || (!contact.held.empty() && is_touched(contact.held_motion[p], dof)))
      dofs.push_back(static_cast<int>(dof));
  return dofs;
}

FreeMotion free_motion(const Prepared& prepared, const State& state) {
  const system::ContactSystem& contact = prepared.contact;
  FreeMotion free{Vector::Zero(static_cast<Eigen::Index>(2 * contact.pairs.size())),
                  Vector::Zero(static_cast<Eigen::Index>(2 * contact.held.size()))};
  if (contact.pairs.empty() && contact.held.empty()) return free;
  for (std::size_t p = 0; p < prepared.structure.parts.size(); ++p) {
    if (prepared.is_absent(p)) continue;
    const Vector u =
        prepared.structure.parts[p]->displacement_at(state.forces[p], state.prescribed[p], touched_dofs(contact, p));
    free.pairs.noalias() += contact.motion[p] * u;
    if (!contact.held.empty()) free.held.noalias() += contact.held_motion[p] * u;
  }
  return free;
}

/// Supports on both sides may hold a pair; they must not press its points into each other. `motion`: of these pairs.
void check_held_pairs(const Prepared& prepared, Vector motion, const Vector& offset, const Replacing& replaced) {
  const system::ContactSystem& contact = prepared.contact;
  if (contact.held.empty()) return;
  if (offset.size() > 0) motion += offset;
  for (std::size_t i = 0; i < contact.held.size(); ++i) {
    const mesh::ContactPair& pair = mesh_pair(prepared, contact.held[i]);
    const double gap = pair.gap + motion[static_cast<Eigen::Index>(2 * i)] +
                       unplaced_motion(prepared, replaced, contact.held[i].contact).dot(pair.normal);
    double size = 0.0;
    for (const Vec2& x : {pair.point_a, pair.point_b}) size = std::max(size, x.norm());
    if (gap >= -1e-12 * std::max(size, std::abs(pair.gap))) continue;
    const model::Contact& named = prepared.model.contacts[static_cast<std::size_t>(contact.held[i].contact)];
    throw InputError(
        prepared.model.file,
        {{named.source, fmt::format("supports on both sides of the pair at ({:.6g}, {:.6g}) keep it at an overlap of "
                                    "{:.3g}, which no contact force can remove: free one side there",
                                    pair.point_a.x(), pair.point_a.y(), -gap)}});
  }
}

/// Resultant of nodal forces.
Vec2 resultant_of(const Vector& forces) { return forces.reshaped(2, forces.size() / 2).rowwise().sum(); }

/// What acts on the parts of a state, and what of it their displacements leave unbalanced (BodySystem::unbalanced): one
/// product with the stiffness for reactions, certificate and energy. Empty for an absent part.
struct Balance {
  Vector forces, unbalanced;
};

/// Work done on the way between two accepted states, by the trapezoidal rule; displacements are relative to the
/// reference point. The nodal displacements are not: there the stiffness of an unbounded body is that of one held far
/// away, which resists a translation.
Energy energy_between(const Prepared& prepared, const State& from, const State& to,
                      const std::vector<Balance>& balances) {
  Energy energy = from.energy;
  energy.elastic = 0.0;
  for (std::size_t p = 0; p < to.u.size(); ++p) {
    energy.external += 0.5 * (from.forces[p] + to.forces[p]).dot(to.u[p] - from.u[p]);
    energy.external += 0.5 * (from.reactions[p] + to.reactions[p]).dot(to.prescribed[p] - from.prescribed[p]);
    if (!prepared.is_absent(p))
      energy.elastic +=
          prepared.structure.parts[p]->elastic_energy(to.u[p], balances[p].forces, balances[p].unbalanced);
  }
  if (prepared.reference) {
    const Vec2 reached = reference_displacement(prepared, to.u),
               moved = reached - reference_displacement(prepared, from.u);
    for (std::size_t p = 0; p < to.u.size(); ++p) {
      const auto loads = [&](const State& state) {  // of a rigid part: force and moment about its centroid
        return prepared.structure.dofs.is_rigid(p) ? Vec2(state.forces[p].head<2>()) : resultant_of(state.forces[p]);
      };
      energy.external -= 0.5 * (loads(from) + loads(to)).dot(moved);
    }
    const std::size_t part = prepared.structure.dofs.part_of(prepared.reference->body);
    energy.elastic -=
        0.5 * resultant_of(to.forces[part] + prepared.contact.motion[part].transpose() * to.p).dot(reached);
  }
  for (Eigen::Index i = 0; i < to.slip.size(); ++i) {
    const contact::PairHistory &before = from.history[static_cast<std::size_t>(i)],
                               &after = to.history[static_cast<std::size_t>(i)];
    // Where the strength fell at once, the slip took place under what was left of it; friction never gives energy back.
    const bool fell = before.broken != after.broken || before.slipped != after.slipped;
    const double slip = to.slip[i] - from.slip[i], at_end = -to.p[2 * i + 1] * slip;
    const double mean = 0.5 * (at_end - from.p[2 * i + 1] * slip);
    energy.friction += fell || mean < 0.0 ? std::max(at_end, 0.0) : mean;
  }
  return energy;
}

/// Largest force at work in a state.
double largest_force(const State& state) {
  double largest = state.p.size() > 0 ? state.p.lpNorm<Eigen::Infinity>() : 0.0;
  for (const auto* forces : {&state.forces, &state.reactions})
    for (const Vector& of_part : *forces)
      if (of_part.size() > 0) largest = std::max(largest, of_part.lpNorm<Eigen::Infinity>());
  return largest;
}

/// What displacements may leave unbalanced, a tenth of what the certificate allows; less where the tolerance is large.
/// Without reactions, which are not known before: those of its own constraints every part adds.
system::Balanced wanted_balance(const Prepared& prepared, const State& state) {
  constexpr double well_below = 0.1;
  system::Balanced wanted;
  wanted.part = std::min(wanted.part, well_below * prepared.model.solver.tolerance);
  wanted.at_least = std::max(prepared.force_scale, largest_force(state));
  return wanted;
}

/// Displacements and reactions under the loads and contact forces of a state; `known`: the displacements without rigid
/// motions.
std::vector<Balance> add_displacements(const Prepared& prepared, const std::vector<Vector>* known, State& to) {
  const auto& parts = prepared.structure.parts;
  const system::Balanced wanted = wanted_balance(prepared, to);
  std::vector<Balance> balances(parts.size());
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
        known ? system::Displaced{(*known)[p], {}} : parts[p]->displaced(forces, to.prescribed[p], wanted);
    if (rigid.cols() > 0) reached.u += rigid * to.a.segment(prepared.contact.first_rigid[p], rigid.cols());
    balance.unbalanced = reached.unbalanced.size() > 0 ? std::move(reached.unbalanced)  // K resists no rigid motion
                                                       : parts[p]->unbalanced(reached.u, forces);
    to.reactions.push_back(parts[p]->reactions_of(balance.unbalanced));
    to.u.push_back(std::move(reached.u));
  }
  return balances;
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

/// Of K u, against resistance().
constexpr double rounding = 1e3 * std::numeric_limits<double>::epsilon();

/// The forces by which K would resist displacements as large.
double resistance(const Prepared& prepared, const State& state) {
  double largest = 0.0;
  for (std::size_t p = 0; p < state.u.size(); ++p)
    largest = std::max(largest, prepared.structure.parts[p]->stiff_force(state.u[p]));
  return largest;
}

/// What forces of a state are judged against: the largest at work so far. Without any load, and where nothing but the
/// rounding of K u is at work (supports that move a body without stress), the forces by which K would resist
/// displacements as large.
double scale_of(const Prepared& prepared, const State& state, double largest_at_work) {
  if (prepared.force_scale > 0.0) return largest_at_work;
  const double resisting = resistance(prepared, state);
  return largest_at_work <= rounding * resisting ? resisting : largest_at_work;
}

/// Completes the certificate with what only the whole structure can tell: equilibrium of every node and of every part.
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
    // Of a rigid body imbalance() is the balance; what acts on an unbounded part goes to infinity.
    if (dofs.is_rigid(p) || dofs.is_unbounded(p)) continue;
    system::add_reactions(part.constraints(), state.reactions[p], forces);
    if (part.has_springs()) forces += part.spring_forces(state.u[p]);
    // Against all forces on the part: those of a fine mesh are small, and many.
    const double unbalanced = resultant(part, dofs.nodes(p), forces).lpNorm<Eigen::Infinity>();
    certificate.rigid_balance = std::max(certificate.rigid_balance, unbalanced / std::max(scale, forces.lpNorm<1>()));
  }
}

/// Displacement along [n, t] of the point of a pair on side 0 (A) or 1 (B), from where the pair was found.
Vec2 displacement_at(const Prepared& prepared, const State& state, int contact, const mesh::ContactPair& pair,
                     int side) {
  Vec2 u = displacement_of(prepared, state, contact, pair, side);
  if (const mesh::Placement& placement = prepared.mesh.placement; !placement.empty())
    u -= placement[static_cast<std::size_t>(contact)][static_cast<std::size_t>(side)];
  return {u.dot(pair.normal), u.dot(tangent_of(pair.normal))};
}

void add_totals(const Vec2& about, ContactResult& result) {
  Vec2 weighted = Vec2::Zero();  // relative to `about`, so that distant coordinates keep their digits
  double pressing = 0.0;
  for (const PairResult& pair : result.pairs) {
    const Vec2 force = pair.normal_force * pair.normal + pair.tangential_force * tangent_of(pair.normal);
    const Vec2 arm = pair.position - about;
    result.force += force;
    result.moment += cross(arm, force);
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
  if (result.normal_force > rounding_of_sum * pressing)
    result.centre_of_pressure = about + Vec2(weighted / result.normal_force);
}

std::vector<ContactResult> contact_results(const Prepared& prepared, const State& state) {
  std::vector<ContactResult> results(prepared.model.contacts.size());
  for (std::size_t i = 0; i < prepared.contact.pairs.size(); ++i) {
    const system::ContactSystem::Pair& at = prepared.contact.pairs[i];
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
    row.normal_force = state.p[2 * k];
    row.tangential_force = state.p[2 * k + 1];
    row.pressure = row.normal_force / prepared.contact.laws.area[k];
    row.shear = row.tangential_force / prepared.contact.laws.area[k];
    row.state = state.states[i];
    row.displacement_a = displacement_at(prepared, state, at.contact, pair, 0);
    row.displacement_b = displacement_at(prepared, state, at.contact, pair, 1);
    ContactResult& result = results[static_cast<std::size_t>(at.contact)];
    result.pairs.push_back(row);
    if (contact.cohesion > 0.0 || contact.tension > 0.0)
      result.broken = result.broken.value_or(0) + state.history[i].broken;
  }
  for (std::size_t c = 0; c < results.size(); ++c) {
    results[c].name = prepared.model.contacts[c].name;
    for (std::size_t load = 0; load < prepared.model.loads.size(); ++load)
      if (const auto& pores = prepared.structure.pores[load]; !pores.empty() && pores[c])
        results[c].pore_force = results[c].pore_force.value_or(0.0) + state.factors.loads[load] * *pores[c];
    add_totals(prepared.model.contacts[c].about, results[c]);
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
  double energy = prepared.reference ? 0.0 : state.energy.elastic, lost = 0.0, resisting = 0.0;
  for (std::size_t p = 0; p < state.u.size(); ++p) {
    const system::BodySystem& part = *prepared.structure.parts[p];
    if (prepared.reference) energy += part.elastic_energy(state.u[p]);
    lost += part.energy_lost(state.u[p]);
    if (state.u[p].size() > 0) resisting += part.stiff_force(state.u[p]) * state.u[p].lpNorm<Eigen::Infinity>();
  }
  return energy > 1e-22 * resisting ? lost / energy : 0.0;
}

}  // namespace

double presence_of(const Prepared& prepared, const Factors& factors, std::size_t p) {
  if (prepared.is_absent(p)) return 0.0;
  if (factors.presence.empty()) return 1.0;
  return factors.presence[static_cast<std::size_t>(prepared.structure.dofs.bodies_of(p).front())];
}

Factors between(const Factors& from, const Factors& to, double part) {
  if (part == 1.0) return to;
  Factors factors = to;
  for (std::size_t i = 0; i < to.loads.size(); ++i)
    factors.loads[i] = from.loads[i] + part * (to.loads[i] - from.loads[i]);
  for (std::size_t i = 0; i < to.supports.size(); ++i)
    factors.supports[i] = from.supports[i] + part * (to.supports[i] - from.supports[i]);
  for (std::size_t i = 0; i < to.friction.size(); ++i)
    factors.friction[i] = from.friction[i] + part * (to.friction[i] - from.friction[i]);
  for (std::size_t b = 0; b < to.presence.size(); ++b)
    factors.presence[b] = from.presence[b] + part * (to.presence[b] - from.presence[b]);
  for (std::size_t c = 0; c < to.fits.size(); ++c) factors.fits[c] = from.fits[c] + part * (to.fits[c] - from.fits[c]);
  factors.release = from.release + part * (to.release - from.release);
  return factors;
}

contact::JointLaws laws_at(const Prepared& prepared, const Factors& factors) {
  return system::with_coefficients(prepared.contact.laws, prepared.contact.pairs, prepared.model, factors.friction);
}

std::vector<bool> touching_pairs(const Prepared& prepared) {
  constexpr double rounding_of_points = 1e-9;  // of a body's size
  std::vector<bool> touching;
  for (std::size_t i = 0; i < prepared.contact.pairs.size(); ++i) {
    const model::Contact& contact =
        prepared.model.contacts[static_cast<std::size_t>(prepared.contact.pairs[i].contact)];
    const double size = std::max(part_of(prepared, contact.a.body).lever(), part_of(prepared, contact.b.body).lever());
    touching.push_back(prepared.contact.gap[static_cast<Eigen::Index>(i)] <= rounding_of_points * size);
  }
  return touching;
}

std::vector<double> coefficients_at_start(const model::Model& model) {
  std::vector<double> coefficients;
  if (model.steps.empty() || model.steps.front().friction.empty()) return coefficients;
  for (const model::Contact& contact : model.contacts) coefficients.push_back(contact.friction);
  for (const model::Contact& contact : model.contacts)
    coefficients.push_back(contact.backward_friction.value_or(contact.friction));
  return coefficients;
}

double gap_at(const Prepared& prepared, const Factors& factors, Eigen::Index i) {
  const double gap = prepared.contact.gap[i];
  if (gap >= 0.0 || factors.fits.empty()) return gap;
  const int contact = prepared.contact.pairs[static_cast<std::size_t>(i)].contact;
  return gap * factors.fits[static_cast<std::size_t>(contact)];
}

std::vector<double> fits_at(const model::Model& model, int step) {
  std::vector<double> fits;
  for (const model::Contact& contact : model.contacts) fits.push_back(contact.fit_in <= step ? 1.0 : 0.0);
  const bool any = std::any_of(model.contacts.begin(), model.contacts.end(),
                               [](const model::Contact& contact) { return contact.fit_in >= 0; });
  return any ? fits : std::vector<double>();
}

State initial_state(const Prepared& prepared) {
  State state;
  state.factors = {std::vector<double>(prepared.model.loads.size(), 0.0),
                   std::vector<double>(prepared.model.supports.size(), 0.0), coefficients_at_start(prepared.model)};
  state.factors.fits = fits_at(prepared.model, -1);
  const auto N = static_cast<Eigen::Index>(prepared.contact.pairs.size());
  state.p = Vector::Zero(2 * N);
  state.a = Vector::Zero(prepared.contact.rigid_motions());
  state.gap = prepared.contact.gap;
  for (Eigen::Index i = 0; i < N; ++i) state.gap[i] = gap_at(prepared, state.factors, i);
  state.slip = Vector::Zero(N);
  state.history.assign(prepared.contact.pairs.size(), {});
  state.states.assign(prepared.contact.pairs.size(), contact::ContactState::open);
  state.forces = applied_forces(prepared, state.factors, state.released);
  state.prescribed = prescribed_values(prepared, state.factors.supports, {});
  for (const auto& part : prepared.structure.parts) {
    state.u.push_back(Vector::Zero(part->size()));
    state.reactions.push_back(Vector::Zero(static_cast<Eigen::Index>(part->constraints().size())));
  }
  return state;
}

void complete(const Prepared& prepared, State& state, const std::vector<Vector>* without_motions) {
  state.forces = applied_forces(prepared, state.factors, state.released);
  state.prescribed = prescribed_values(prepared, state.factors.supports, state.replaced.moved);
  state.u.clear();
  state.reactions.clear();
  add_displacements(prepared, without_motions, state);
}

Attempt attempt(const Prepared& prepared, const State& from, const Factors& factors) {
  const auto& parts = prepared.structure.parts;
  const system::ContactSystem& system = prepared.contact;
  const auto N = static_cast<Eigen::Index>(system.pairs.size());
  Attempt result;
  State& to = result.state;
  to.factors = factors;
  to.replaced = from.replaced;
  to.offset = from.offset;
  to.held_offset = from.held_offset;
  to.released = from.released;
  to.forces = applied_forces(prepared, factors, to.released);
  to.prescribed = prescribed_values(prepared, factors.supports, to.replaced.moved);

  contact::Problem problem;
  problem.W = system.W;
  problem.q = Vector::Zero(2 * N);
  problem.G = system.G;
  problem.f = Vector::Zero(system.rigid_motions());
  for (Eigen::Index i = 0; i < N; ++i) {
    problem.q[2 * i] = gap_at(prepared, factors, i);
    problem.q[2 * i + 1] = -from.slip[i];
  }
  if (from.offset.size() > 0) problem.q += from.offset;
  if (from.replaced.offset.size() > 0) problem.q += from.replaced.offset;
  contact::SolverOptions options;
  options.tolerance = prepared.model.solver.tolerance;
  options.iterations = prepared.model.solver.iterations;
  options.on_iteration = prepared.on_iteration;
  options.force_scale = std::max({prepared.force_scale, from.largest_force, largest_force(to)});
  FreeMotion free = free_motion(prepared, to);
  problem.q += free.pairs;
  for (std::size_t p = 0; p < parts.size(); ++p)
    if (!prepared.is_absent(p))
      problem.f.segment(system.first_rigid[p], parts[p]->rigid_motions().cols()) = loads_on_motions(prepared, p, to);
  check_held_pairs(prepared, std::move(free.held), from.held_offset, from.replaced);

  result.start = {from.p, from.a, touching_pairs(prepared)};
  result.force_scale = options.force_scale;
  const contact::JointLaws laws = laws_at(prepared, factors);
  contact::Evolution evolution = contact::evolve(problem, laws, from.history, result.start, options);
  if (prepared.model.solver.uniqueness && N > 0)
    result.uniqueness = follow_history(problem, laws, from.history, result.start, options, evolution);
  result.solution = std::move(evolution.solution);
  result.problem = std::move(evolution.problem);
  to.history = std::move(evolution.history);
  to.p = result.solution.p;
  to.a = result.solution.a;
  to.gap = result.solution.gap;
  to.slip = from.slip + result.solution.slip_increment;
  to.states = result.solution.states;
  std::vector<Balance> balances = add_displacements(prepared, nullptr, to);
  to.energy = energy_between(prepared, from, to, balances);
  result.certificate = result.solution.certificate;
  to.largest_force = std::max(from.largest_force, largest_force(to));
  const double scale = scale_of(prepared, to, std::max(options.force_scale, to.largest_force));
  certify_structure(prepared, to, std::move(balances), scale, result.certificate);
  if (scale > 0.0) result.rounding = rounding * resistance(prepared, to) / scale;
  result.accepted = result.solution.status == contact::Status::solved &&
                    result.certificate.worst() <= prepared.model.solver.tolerance;
  return result;
}

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

Vec2 unplaced_motion(const Prepared& prepared, const Replacing& replaced, int contact) {
  Vec2 motion = Vec2::Zero();
  if (replaced.moved.empty()) return motion;
  const auto c = static_cast<std::size_t>(contact);
  const model::Contact& named = prepared.model.contacts[c];
  motion += replaced.moved[prepared.structure.dofs.part_of(named.b.body)];
  motion -= replaced.moved[prepared.structure.dofs.part_of(named.a.body)];
  return motion - (replaced.placement[c][1] - replaced.placement[c][0]);
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

DiscreteProblem discrete_problem(const Prepared& prepared, const Attempt& attempt) {
  DiscreteProblem discrete{
      attempt.problem, attempt.start, attempt.solution, attempt.accepted, attempt.force_scale, {}, {}};
  for (const system::ContactSystem::Pair& pair : prepared.contact.pairs) {
    discrete.contact_of_pair.push_back(pair.contact);
    discrete.number_of_pair.push_back(pair.number);
  }
  return discrete;
}

Vec2 reference_displacement(const Prepared& prepared, const std::vector<Vector>& u) {
  if (!prepared.reference) return Vec2::Zero();
  const system::Dofs& dofs = prepared.structure.dofs;
  const auto& [body, N] = *prepared.reference;
  return N * dofs.of_body(body, u[dofs.part_of(body)]);
}

const element::InitialStress& FieldState::initial_of(std::size_t body) const {
  static const element::InitialStress none;
  return initial.empty() ? none : initial[body];
}

bool IncrementResult::is_absent(int body) const { return std::binary_search(absent.begin(), absent.end(), body); }

IncrementResult describe(const Prepared& prepared, const State& state) {
  IncrementResult result;
  for (std::size_t i = 0; i < prepared.model.loads.size(); ++i)
    result.factors[prepared.model.loads[i].name] = state.factors.loads[i];
  for (std::size_t i = 0; i < prepared.model.supports.size(); ++i) {
    const model::Support& support = prepared.model.supports[i];
    if (support.displacement[0].value_or(0.0) != 0.0 || support.displacement[1].value_or(0.0) != 0.0 ||
        support.rotation.value_or(0.0) != 0.0)
      result.factors[support.name] = state.factors.supports[i];
  }
  result.contacts = contact_results(prepared, state);
  result.energy = state.energy;
  result.largest_force = largest_force(state);
  result.lost_to_rounding = lost_to_rounding(prepared, state);
  result.reactions.assign(prepared.model.supports.size(), Vec2::Zero());
  result.moments.resize(prepared.model.supports.size());
  for (std::size_t p = 0; p < state.u.size(); ++p) {
    const std::vector<system::Constraint>& constraints = prepared.structure.parts[p]->constraints();
    for (std::size_t c = 0; c < constraints.size(); ++c) {
      if (constraints[c].rotation) {
        const auto support = static_cast<std::size_t>(constraints[c].support);
        if (prepared.model.supports[support].rotation)
          result.moments[support] =
              state.reactions[p][static_cast<Eigen::Index>(c)] * prepared.structure.parts[p]->lever();
        continue;
      }
      result.reactions[static_cast<std::size_t>(constraints[c].support)] +=
          state.reactions[p][static_cast<Eigen::Index>(c)] * constraints[c].direction();
    }
  }
  const system::Dofs& dofs = prepared.structure.dofs;
  result.springs =
      system::spring_resultants(prepared.structure.springs, prepared.model, dofs, state.u, state.factors.loads);
  result.fields.interior.resize(prepared.model.bodies.size());
  result.fields.initial.resize(prepared.model.bodies.size());
  for (std::size_t b = 0; b < prepared.model.bodies.size(); ++b) {
    const auto body = static_cast<int>(b);
    result.fields.displacements.push_back(dofs.of_body(body, state.u[dofs.part_of(body)]));
    if (!state.replaced.moved.empty()) {
      Vector& u = result.fields.displacements[b];
      const Vec2& moved = state.replaced.moved[dofs.part_of(body)];
      if (prepared.model.bodies[b].rigid)
        u.head<2>() += moved;
      else
        u.reshaped(2, u.size() / 2).colwise() += moved;
    }
    if (prepared.model.bodies[b].rigid) result.fields.displacements[b][2] /= part_of(prepared, body).lever();
    const double presence = presence_of(prepared, state.factors, dofs.part_of(body));
    for (std::size_t load = 0; load < prepared.model.loads.size(); ++load) {
      add(result.fields.interior[b], prepared.structure.interior[load][b], presence * state.factors.loads[load]);
      result.fields.initial[b].add(prepared.structure.initial[load][b], presence * state.factors.loads[load]);
    }
    if (prepared.is_absent(dofs.part_of(body))) result.absent.push_back(body);
  }
  return result;
}

std::string too_large(const Prepared& prepared, const State& state) {
  const system::Dofs& dofs = prepared.structure.dofs;
  for (std::size_t p = 0; p < state.u.size(); ++p) {
    if (dofs.is_rigid(p)) continue;
    const double size = 2.0 * prepared.structure.parts[p]->lever();
    Vector u = state.u[p];
    if (has_large_slip(prepared.model)) {  // bodies may slide, and others push them, as far as they like
      const Vec2 mean = u.reshaped(2, u.size() / 2).rowwise().mean();
      u.reshaped(2, u.size() / 2).colwise() -= mean;
    }
    const double largest = u.lpNorm<Eigen::Infinity>();
    if (largest > 0.1 * size)
      return fmt::format(
          "displacements of {} reach {:.3g}, more than a tenth of its size: the theory is valid for small ones "
          "only; check the units of stiffness and loads",
          dofs.name_of(p, prepared.model), largest);
  }
  return {};
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
