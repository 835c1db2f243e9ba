#include "scabo/analysis/dynamics/time_step.hpp"

#include <algorithm>
#include <cmath>

#include "scabo/analysis/dynamics/acting_pairs.hpp"
#include "scabo/analysis/dynamics/internal_motion.hpp"
#include "scabo/analysis/dynamics/projection.hpp"
#include "scabo/analysis/state/balance.hpp"
#include "scabo/analysis/state/loads.hpp"
#include "scabo/analysis/state/pair_motions.hpp"
#include "scabo/linalg/decompositions.hpp"

namespace scabo::analysis {

namespace {

system::ContactSystem condensed(const Prepared& at_rest, const system::Structure& structure, int threads) {
  system::ContactSystem contact = system::condense(structure, at_rest.model, at_rest.mesh, threads);
  if (!at_rest.absent.empty()) contact = system::without_parts(contact, structure, at_rest.model, at_rest.absent);
  ensure(contact.pairs.size() == at_rest.contact.pairs.size(), "inertia changes which pairs can move");
  return contact;
}

/// Right-hand side of eq. (1) without contact.
std::vector<Vector> forces_in_time(const InTime& in, const State& from, const std::vector<Vector>& applied) {
  const double h = in.system.size;
  std::vector<Vector> forces = applied;
  for (std::size_t p = 0; p < forces.size(); ++p) {
    if (in.at_rest.is_absent(p)) continue;
    const system::PartInertia& part = in.inertia[p];
    const Vector& v = from.velocity[p];
    forces[p] += part.M.times(v) / h;
    forces[p] -= part.stiffness_times(from.u[p] + part.theta * (1.0 - part.theta) * h * v);
    if (part.C && part.theta < 1.0) forces[p] -= (1.0 - part.theta) * part.damping_times(v);
  }
  return forces;
}

/// A time step while it is made. `as_at_rest`: the state of eq. (1), whose displacements are w.
struct UnfinishedStep {
  const InTime& in;
  const State& from;
  const Acting& acting;
  Attempt attempt = {};
  State as_at_rest = {};
  std::vector<Balance> balances = {};
  std::vector<Vector> applied = {};  // mean of the step, with the inertia of a moving ground
  InternalSteps inside = {};
  std::vector<Vector> mean_velocity = {};
  Vector motion = {};  // 2N, mean velocities of the pairs
  Projection projected = {};
  /// Of the largest force along the largest motion that the pairs would have without contact.
  double work_of_loads = 0.0;

  State& to() { return attempt.state; }
  double size() const { return in.system.size; }
};

void begin(UnfinishedStep& making) {
  const Prepared& at_rest = making.in.at_rest;
  State& to = making.to();
  const State& from = making.from;
  to.factors = making.acting.end;
  to.offset = from.offset;
  to.held_offset = from.held_offset;
  to.released = from.released;
  to.referred = from.referred;
  to.replaced = from.replaced;
  to.rigid_motion = from.rigid_motion;
  to.time = from.time + making.size();
  making.applied = applied_forces(at_rest, making.acting.mean, to.released);
  for (std::size_t p = 0; p < making.acting.ground.size(); ++p) making.applied[p] += making.acting.ground[p];
  to.forces = making.applied;
  to.prescribed = prescribed_values(at_rest, to.factors.supports, to.replaced.moved);
  State& t = making.as_at_rest;
  t.forces = forces_in_time(making.in, from, making.applied);
  making.inside = eliminate_levels(making.in, from, making.acting, t.forces);
  for (const Vector& velocity : making.acting.support) t.prescribed.push_back(making.size() * velocity);
}

contact::SolverOptions options_of(const UnfinishedStep& making) {
  const Prepared& prepared = making.in.system.prepared;
  contact::SolverOptions options;
  options.tolerance = prepared.model.solver.tolerance;
  options.iterations = prepared.model.solver.iterations;
  options.on_iteration = prepared.on_iteration;
  options.force_scale = std::max({prepared.force_scale, making.from.largest_force, largest_force(making.as_at_rest)});
  return options;
}

/// Contact forces, and the velocities that follow from them.
void solve(UnfinishedStep& making) {
  const Prepared& prepared = making.in.system.prepared;
  Attempt& made = making.attempt;
  State& to = made.state;
  const contact::SolverOptions options = options_of(making);
  made.force_scale = options.force_scale;
  const ActingPairs pairs = acting_pairs(making.in, making.from, to.factors);
  std::vector<system::BegunSolve> begun;
  contact::Problem posed = pose(pairs, prepared, making.as_at_rest, begun);
  if (posed.q.size() > 0) making.work_of_loads = options.force_scale * posed.q.lpNorm<Eigen::Infinity>();
  const contact::History history = at_places(making.from.history, pairs.places);
  made.start = {entries_of(making.from.p, pairs.places), Vector::Zero(posed.G.cols()),
                std::vector<bool>(pairs.places.size(), true)};
  contact::Evolution evolution = contact::evolve(std::move(posed), pairs.laws, history, made.start, options);
  made.solution = std::move(evolution.solution);
  made.certificate = made.solution.certificate;
  give_to_all(pairs, made.solution, evolution.history, making.from, to);
  State& t = making.as_at_rest;
  t.p = to.p;
  t.rigid_motion = made.solution.a;
  making.balances = add_displacements(prepared, nullptr, t, begun);
  to.reactions = t.reactions;
}

/// Velocities, displacements, slips and gaps at the end of the step.
void advance(UnfinishedStep& making) {
  const Prepared& at_rest = making.in.at_rest;
  const double h = making.size();
  State& to = making.to();
  const State& from = making.from;
  for (std::size_t p = 0; p < from.u.size(); ++p) {
    const double theta = making.in.inertia[p].theta;
    to.velocity.push_back(making.as_at_rest.u[p] / h);
    making.mean_velocity.push_back(theta * to.velocity[p] + (1.0 - theta) * from.velocity[p]);
    to.u.push_back(from.u[p] + h * making.mean_velocity[p]);
  }
  recover_levels(making.in, from, making.inside, making.as_at_rest.u, to);
  making.motion = motion_under(at_rest.contact.motion, making.mean_velocity, to.p.size());
  to.slip = from.slip;
  for (Eigen::Index i = 0; i < to.slip.size(); ++i) to.slip[i] += h * making.motion[2 * i + 1];
  to.gap = gaps_at(at_rest, to);
  making.projected = project(making.in, making.as_at_rest, to);
  const auto held = static_cast<Eigen::Index>(2 * at_rest.contact.held.size());
  if (held > 0) check_held_pairs(at_rest, motion_under(at_rest.contact.held_motion, to.u, held), to);
}

/// Work of the step, which closes the balance of energy, and how much contact and projection added.
double add_energy(UnfinishedStep& making) {
  const Prepared& at_rest = making.in.at_rest;
  const double h = making.size();
  State& to = making.to();
  const State& from = making.from;
  Energy& energy = to.energy = from.energy;
  energy.kinetic = kinetic_energy(at_rest, making.in.inertia, to);
  energy.elastic = 0.0;
  for (std::size_t p = 0; p < to.u.size(); ++p) {
    if (at_rest.is_absent(p)) continue;
    const system::PartInertia& part = making.in.inertia[p];
    const system::BodySystem& body = *at_rest.structure.parts[p];
    const Vector moved = to.u[p] - from.u[p], by_velocity = h * making.mean_velocity[p];
    energy.external += making.applied[p].dot(moved);
    energy.external += to.reactions[p].dot(support_values(body, by_velocity));
    energy.damping += h * making.mean_velocity[p].dot(part.damping_times(making.mean_velocity[p]));
    if (part.theta == 1.0) energy.massless += 0.5 * by_velocity.dot(part.stiffness_times(by_velocity));
    const InternalWork inside = internal_work(making.in, making.inside, from, to, making.mean_velocity[p], p);
    energy.external += inside.external;
    energy.damping += inside.damping;
    energy.elastic += internal_elastic(part, to, p);
    const double thermal = thermal_energy(at_rest, to.factors, p, to.u[p]);
    energy.elastic += 0.5 * to.u[p].dot(part.stiffness_times(to.u[p])) + thermal;
    energy.external += thermal - thermal_energy(at_rest, from.factors, p, from.u[p]);
  }
  double normal = 0.0, tangential = 0.0;
  for (Eigen::Index i = 0; 2 * i < to.p.size(); ++i) {
    normal += h * to.p[2 * i] * making.motion[2 * i];
    tangential += h * to.p[2 * i + 1] * making.motion[2 * i + 1];
  }
  energy.impact -= normal;
  energy.friction -= tangential;
  double projected = 0.0;
  for (std::size_t p = 0; p < making.projected.displacement.size(); ++p) {
    const Vector& d = making.projected.displacement[p];
    if (d.size() == 0 || d.isZero(0.0)) continue;
    projected += d.dot(making.in.inertia[p].stiffness_times(to.u[p] - 0.5 * d) - making.applied[p]);
  }
  energy.projection -= projected;
  return std::max(0.0, normal + tangential) + std::max(0.0, projected);
}

/// Of what a step leaves out: where forces change by r over it, the trapezoidal rule errs by h^3/12 of the third
/// derivative of u, d = A^-1 r/12. Of rigid bodies on springs; what waves need is known before (longest_time_step()).
double energy_of_error(const UnfinishedStep& making) {
  const double h = making.size();
  double energy = 0.0;
  for (std::size_t p = 0; p < making.from.u.size(); ++p) {
    const system::PartInertia& part = making.in.inertia[p];
    if (!making.in.at_rest.structure.dofs.is_rigid(p) || part.is_massless() || part.K.springs.none()) continue;
    const Vector r = part.stiffness_times(making.attempt.state.u[p] - making.from.u[p]);
    Matrix A(r.size(), r.size());
    for (Eigen::Index k = 0; k < r.size(); ++k) {
      const Vector unit = Vector::Unit(r.size(), k);
      A.col(k) = part.M.times(unit) / (h * h) + part.theta * part.theta * part.stiffness_times(unit);
    }
    const Vector d = A.ldlt().solve(r) / 12.0;
    energy += 0.5 * d.dot(part.stiffness_times(d));
  }
  return energy;
}

double total(const Energy& energy) {
  return energy.kinetic + energy.elastic + energy.friction + energy.damping + energy.impact + energy.projection +
         energy.massless - energy.external;
}

}  // namespace

StepSystem::StepSystem(const Prepared& at_rest, const std::vector<system::PartInertia>& inertia, double h, int threads)
    : size(h),
      levels(system::levels_in_time(inertia, h)),
      structure(system::structure_in_time(at_rest.structure, at_rest.model, inertia, levels, at_rest.contact.motion, h,
                                          threads)),
      contact(condensed(at_rest, structure, threads)),
      prepared(at_rest, structure, contact) {}

double kinetic_energy(const Prepared& prepared, const std::vector<system::PartInertia>& inertia, const State& state) {
  double energy = 0.0;
  for (std::size_t p = 0; p < state.velocity.size(); ++p) {
    if (prepared.is_absent(p)) continue;
    const Vector& v = state.velocity[p];
    energy += 0.5 * v.dot(inertia[p].M.times(v)) + internal_kinetic(inertia[p], state, p);
  }
  return energy;
}

Attempt time_step(const InTime& in, const State& from, const Acting& acting, const StepBounds& bounds) {
  constexpr double most_unbalanced = 1e-9;  // of the energy
  UnfinishedStep making{in, from, acting};
  begin(making);
  solve(making);
  advance(making);
  Attempt& made = making.attempt;
  State& to = made.state;
  const double added = add_energy(making);
  to.largest_energy = std::max(from.largest_energy, to.energy.kinetic + std::abs(to.energy.elastic));
  // Where nothing moves, of bodies that stick to ground that shakes, energies are known as well as the forces are.
  const double tolerance = in.at_rest.model.solver.tolerance;
  const double energy = std::max(to.largest_energy, tolerance / most_unbalanced * making.work_of_loads);
  if (energy > 0.0) made.certificate.energy_balance = std::abs(total(to.energy) - total(from.energy)) / energy;
  to.largest_force = std::max(from.largest_force, largest_force(to));
  const double scale = std::max(made.force_scale, largest_force(making.as_at_rest));
  certify_structure(in.system.prepared, making.as_at_rest, std::move(making.balances), scale, made.certificate);
  made.accepted = made.solution.status == contact::Status::solved && made.certificate.worst() <= tolerance &&
                  !(made.certificate.energy_balance > most_unbalanced) && !(added > bounds.added * energy) &&
                  (std::isinf(bounds.error) || !(energy_of_error(making) > bounds.error * bounds.error * energy));
  if (made.accepted) made.solution.trace.clear();
  return std::move(made);
}

}  // namespace scabo::analysis
