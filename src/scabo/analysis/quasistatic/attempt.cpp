#include "scabo/analysis/quasistatic/attempt.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "scabo/analysis/diagnostics/beyond_sides.hpp"
#include "scabo/analysis/diagnostics/softly_held.hpp"
#include "scabo/analysis/diagnostics/undetermined_forces.hpp"
#include "scabo/analysis/diagnostics/undetermined_motions.hpp"
#include "scabo/analysis/quasistatic/branch.hpp"
#include "scabo/analysis/state/balance.hpp"
#include "scabo/analysis/state/loads.hpp"

namespace scabo::analysis {

namespace {

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

/// The contact problem of an increment, its laws not yet included.
struct Posed {
  contact::Problem problem;
  Vector motion_of_held;  ///< 2N, of pairs that supports hold
  Vector drawn;           ///< 2N, motions of the pairs where no body is displaced
};

/// From `from` to `factors`; loads and supports of `to` are set.
Posed pose(const Prepared& prepared, const State& from, const Factors& factors, State& to) {
  const auto& parts = prepared.structure.parts;
  const system::ContactSystem& system = prepared.contact;
  const auto N = static_cast<Eigen::Index>(system.pairs.size());
  to.factors = factors;
  to.replaced = from.replaced;
  to.offset = from.offset;
  to.held_offset = from.held_offset;
  to.released = from.released;
  to.referred = from.referred;
  to.forces = applied_forces(prepared, factors, to.released);
  to.prescribed = prescribed_values(prepared, factors.supports, to.replaced.moved);

  Posed posed;
  contact::Problem& problem = posed.problem;
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
  posed.drawn = problem.q;
  FreeMotion free = free_motion(prepared, to);
  problem.q += free.pairs;
  for (std::size_t p = 0; p < parts.size(); ++p)
    if (!prepared.is_absent(p))
      problem.f.segment(system.first_rigid[p], parts[p]->rigid_motions().cols()) = loads_on_motions(prepared, p, to);
  posed.motion_of_held = std::move(free.held);
  return posed;
}

/// What of a state follows from the solution of its contact problem without further solves.
void take(const State& from, const contact::Solution& solution, contact::History history, State& to) {
  to.history = std::move(history);
  to.p = solution.p;
  to.a = solution.a;
  to.gap = solution.gap;
  to.slip = from.slip + solution.slip_increment;
  to.states = solution.states;
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

}  // namespace

Attempt attempt(const Prepared& prepared, const State& from, const Factors& factors) {
  const auto N = static_cast<Eigen::Index>(prepared.contact.pairs.size());
  Attempt result;
  State& to = result.state;
  Posed posed = pose(prepared, from, factors, to);
  contact::Problem& problem = posed.problem;
  contact::SolverOptions options;
  options.tolerance = prepared.model.solver.tolerance;
  options.iterations = prepared.model.solver.iterations;
  options.on_iteration = prepared.on_iteration;
  options.force_scale = std::max({prepared.force_scale, from.largest_force, largest_force(to)});
  check_held_pairs(prepared, std::move(posed.motion_of_held), from.held_offset, from.replaced);

  result.start = {from.p, from.a, touching_pairs(prepared)};
  result.force_scale = options.force_scale;
  const contact::JointLaws laws = laws_at(prepared, factors);
  std::vector<Balance> balances;
  std::optional<SoftlyHeld> soft;
  constexpr int most_corrections = 3;
  for (int round = 0;; ++round) {
    contact::Evolution evolution = contact::evolve(problem, laws, from.history, result.start, options);
    if (prepared.model.solver.uniqueness && N > 0)
      result.uniqueness = follow_history(problem, laws, from.history, result.start, options, evolution);
    result.solution = contact::continued(std::move(result.solution), std::move(evolution.solution));
    result.problem = std::move(evolution.problem);
    give_smoothest_forces(prepared, result.problem, result.start, options, result.solution);
    take(from, result.solution, std::move(evolution.history), to);
    balances = add_displacements(prepared, nullptr, to);
    if (result.solution.status != contact::Status::solved) break;
    if (give_smallest_motions(prepared, result.problem, laws, result.start, options, from, to, result.solution))
      balances = add_displacements(prepared, nullptr, to);
    soft = softly_held(prepared, to, result.problem, result.solution, posed.drawn, options.force_scale);
    if (!soft || !(soft->apart > SoftlyHeld::good) || round == most_corrections) break;
    problem.q += soft->difference;
    result.start = {result.solution.p, result.solution.a, result.start.touching};
  }
  to.energy = energy_between(prepared, from, to, balances);
  result.certificate = result.solution.certificate;
  to.largest_force = std::max(from.largest_force, largest_force(to));
  const double scale = scale_of(prepared, to, std::max(options.force_scale, to.largest_force));
  certify_structure(prepared, to, std::move(balances), scale, result.certificate);
  if (scale > 0.0) result.rounding = rounding_of_resistance * resistance(prepared, to) / scale;
  result.accepted = result.solution.status == contact::Status::solved &&
                    result.certificate.worst() <= prepared.model.solver.tolerance;
  if (result.accepted) result.beyond = slid_beyond_sides(prepared, to);
  result.lost = result.accepted && result.beyond.empty() && soft && soft->wrong > SoftlyHeld::allowed;
  if (result.lost) result.beyond = lost_where_softly_held(prepared, *soft);
  result.accepted = result.accepted && result.beyond.empty();
  return result;
}

bool is_same_scaled(const Prepared& prepared, const State& from, const Attempt& tried, const Factors& less) {
  constexpr double rounding = 1e-12;
  const contact::Problem& more = tried.problem;
  const contact::JointLaws laws = laws_at(prepared, less);
  const bool remembers =
      std::any_of(laws.of_pair.begin(), laws.of_pair.end(), [](const auto& law) { return law->remembers(); });
  if (remembers || !from.p.isZero(0.0) || !from.a.isZero(0.0)) return false;
  State to;
  contact::Problem fewer = pose(prepared, from, less, to).problem;
  contact::set_limits(laws, from.history, fewer);
  if (fewer.mu != more.mu || fewer.mu_backward.size() != more.mu_backward.size() ||
      (fewer.mu_backward.size() > 0 && fewer.mu_backward != more.mu_backward) || fewer.cohesion.size() > 0 ||
      fewer.tension.size() > 0 || more.cohesion.size() > 0 || more.tension.size() > 0)
    return false;
  const double all = more.q.squaredNorm() + more.f.squaredNorm();
  if (!(all > 0.0)) return false;
  const double part = (more.q.dot(fewer.q) + more.f.dot(fewer.f)) / all;
  const auto proportional = [&](const Vector& a, const Vector& b) {
    return a.size() == 0 || (a - part * b).lpNorm<Eigen::Infinity>() <= rounding * part * b.lpNorm<Eigen::Infinity>();
  };
  return part > 0.0 && proportional(fewer.q, more.q) && proportional(fewer.f, more.f);
}

}  // namespace scabo::analysis
