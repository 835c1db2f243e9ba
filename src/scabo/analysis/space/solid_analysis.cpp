#include "scabo/analysis/space/solid_analysis.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <memory>

#include "scabo/analysis/quasistatic/branch.hpp"
#include "scabo/analysis/space/prepared_solids.hpp"
#include "scabo/analysis/space/smallest_motions.hpp"
#include "scabo/analysis/space/solid_bars.hpp"
#include "scabo/analysis/space/solid_preloads.hpp"
#include "scabo/analysis/state/friction_work.hpp"
#include "scabo/analysis/state/pair_motions.hpp"
#include "scabo/system/solid_part.hpp"

namespace scabo::analysis {

namespace {

/// Of nodes and pairs.
double largest_force_of_solids(const MovedSolids& moved, const Vector& p) {
  double largest = p.size() > 0 ? p.lpNorm<Eigen::Infinity>() : 0.0;
  for (std::size_t i = 0; i < moved.u.size(); ++i)
    largest =
        std::max({largest, moved.forces[i].lpNorm<Eigen::Infinity>(), moved.unbalanced[i].lpNorm<Eigen::Infinity>()});
  return largest;
}

/// The largest imbalance of a node over the largest force so far.
double imbalance_of(const PreparedSolids& prepared, const MovedSolids& moved, double largest) {
  double imbalance = 0.0;
  for (std::size_t i = 0; i < moved.u.size(); ++i)
    imbalance = std::max(imbalance, prepared.structure.parts[i]->imbalance_of(moved.unbalanced[i]));
  return largest > 0.0 ? imbalance / largest : 0.0;
}

/// What every spring exerts on its body.
std::vector<Eigen::Vector3d> spring_resultants_of_solids(const SolidModel& model, const SolidFactors& factors,
                                                         const std::vector<Vector>& u) {
  std::vector<Eigen::Vector3d> resultants;
  for (const SolidSpringOfBody& of : model.springs) {
    const auto b = static_cast<std::size_t>(of.body);
    Vector forces = -of.spring.times(u[b]);
    if (of.load >= 0) forces += factors.loads[of.load] * model.loads[static_cast<std::size_t>(of.load)][b];
    resultants.emplace_back(forces.reshaped(3, forces.size() / 3).rowwise().sum());
  }
  return resultants;
}

/// All pairs; those that supports hold on both sides as they are at rest.
std::vector<SolidPair> solid_pairs(const PreparedSolids& prepared, const SolidState& state) {
  const PairedFaces& paired = prepared.paired;
  std::vector<SolidPair> pairs = paired.pairs;
  for (std::size_t i = 0; i < pairs.size(); ++i) pairs[i].gap = paired.points[i].gap;
  for (std::size_t k = 0; k < prepared.contact.pairs.size(); ++k) {
    if (prepared.contact.pairs[k].is_bar()) break;  // after those of all contacts
    const auto row = static_cast<Eigen::Index>(k);
    const auto i = static_cast<std::size_t>(prepared.contact.pairs[k].index);
    const Eigen::Matrix3d directions = paired.points[i].directions;
    const double sense = paired.turned[i] ? -1.0 : 1.0;
    pairs[i].force = sense * (directions * state.p.segment<3>(in_space.of(row)));
    pairs[i].slip = sense * slip_of_pair(directions, state.slip.segment<2>(2 * row));
    pairs[i].gap = state.gap[row];
    pairs[i].state = state.states[k];
    pairs[i].broken = state.history[k].broken;
  }
  return pairs;
}

/// Of the forces of every contact at the nodes of its sides, about the origin.
std::vector<std::array<Eigen::Vector3d, 2>> moments_of_sides(const PreparedSolids& prepared,
                                                             const std::vector<SolidPair>& pairs) {
  const SolidModel& model = prepared.model;
  std::vector<std::array<Eigen::Vector3d, 2>> moments(model.contacts.size(),
                                                      {Eigen::Vector3d::Zero(), Eigen::Vector3d::Zero()});
  for (std::size_t i = 0; i < pairs.size(); ++i) {
    const auto contact = static_cast<std::size_t>(pairs[i].contact);
    for (const auto* side : {&prepared.paired.points[i].a, &prepared.paired.points[i].b}) {
      Eigen::Vector3d at = Eigen::Vector3d::Zero();
      for (const system::PairSide::Node& node : side->nodes)
        at += node.weight * model.bodies[side->part].mesh.nodes.col(node.node);
      const bool on_b = static_cast<int>(side->part) == model.contacts[contact].b.body;
      moments[contact][on_b ? 1 : 0] += at.cross((on_b ? 1.0 : -1.0) * pairs[i].force);
    }
  }
  return moments;
}

/// Gives the pairs that supports hold on both sides their gaps, and says what no contact force can remove there: an
/// overlap, or a tie whose sides move apart. Empty: nothing.
std::string add_held_gaps(const PreparedSolids& prepared, SolidIncrement& to) {
  const std::vector<system::ContactSystem::Pair>& held = prepared.contact.held;
  if (held.empty()) return {};
  const Vector motion =
      motion_under(prepared.contact.held_motion, to.u, in_space.count(static_cast<Eigen::Index>(held.size())));
  std::string worst;
  double most = 0.0;
  for (std::size_t k = 0; k < held.size(); ++k) {
    const auto i = static_cast<std::size_t>(held[k].index);
    const Eigen::Vector3d moved = motion.segment<3>(in_space.of(static_cast<Eigen::Index>(k)));
    SolidPair& pair = to.pairs[i];
    pair.gap = gap_of_solids(prepared, to.factors, i) + moved[0];
    const bool tied = prepared.given[static_cast<std::size_t>(pair.contact)].bond;
    const double wrong = tied ? moved.norm() : -pair.gap;
    constexpr double rounding = 1e-12;
    if (wrong <= std::max(most, rounding * std::max(pair.point.norm(), std::abs(pair.gap)))) continue;
    most = wrong;
    worst = fmt::format(
        "supports on both sides of the pair at ({:.6g}, {:.6g}, {:.6g}) {} by {:.3g}, which no contact force can "
        "remove: free one side there",
        pair.point.x(), pair.point.y(), pair.point.z(), tied ? "move the sides of a tie apart" : "keep an overlap",
        wrong);
  }
  return worst;
}

FrictionWork friction_work_of_solids(const PreparedSolids& prepared, const SolidState& from, const SolidState& to) {
  FrictionWork total;
  const contact::JointLaws before = laws_of_solids(prepared, from.factors),
                           after = laws_of_solids(prepared, to.factors);
  for (std::size_t k = 0; k < prepared.contact.pairs.size(); ++k) {
    if (prepared.contact.pairs[k].is_bar()) break;
    const auto row = static_cast<Eigen::Index>(k);
    const Eigen::Index at = in_space.of(row);
    add_friction_work(
        {*before.of_pair[k], *after.of_pair[k], after.area[row], from.history[k], to.history[k], from.p[at], to.p[at],
         from.p.segment<2>(at + 1), to.p.segment<2>(at + 1),
         to.slip.segment<2>(2 * row) - from.slip.segment<2>(2 * row), from.gap[row], from.states[k], to.states[k]},
        total);
  }
  return total;
}

/// What temperatures and preloads add to 1/2 u'K u: the strain they cause in a free body takes no energy.
double initial_energy_of_solid(const PreparedSolids& prepared, const SolidFactors& factors, std::size_t b,
                               const AppliedToSolids& applied, const Vector& u) {
  double energy = 0.0;
  for (std::size_t i = 0; i < prepared.model.preloads.size(); ++i)
    if (const SolidPreload& preload = prepared.model.preloads[i]; preload.body == static_cast<int>(b))
      energy += preload.cut.energy(applied.shortening[static_cast<Eigen::Index>(i)], u);
  if (applied.heated[b].size() == 0) return energy;
  const SolidBody& body = prepared.model.bodies[b];
  energy += system::held_thermal_energy(body.mesh, elasticity_of(body), body.expansion, applied.heated[b], body.solved);
  for (std::size_t load = 0; load < prepared.model.loads.size(); ++load)
    if (prepared.model.temperatures[load][b].size() > 0)
      energy -= factors.loads[static_cast<Eigen::Index>(load)] * u.dot(prepared.model.loads[load][b]);
  return energy;
}

/// The energy of `from` and what an increment adds to it.
Energy energy_of_solids(const PreparedSolids& prepared, const SolidState& from, const MovedSolids& before,
                        const SolidState& to, const MovedSolids& after) {
  Energy energy = from.energy;
  energy.elastic = 0.0;
  for (std::size_t i = 0; i < after.u.size(); ++i) {
    energy.external += 0.5 * (before.applied.forces[i] + after.applied.forces[i]).dot(after.u[i] - before.u[i]);
    energy.external +=
        0.5 *
        (before.reactions[i] + after.reactions[i]).dot(after.applied.prescribed[i] - before.applied.prescribed[i]);
    energy.elastic += prepared.structure.parts[i]->elastic_energy(after.u[i], after.forces[i], after.unbalanced[i]);
    const double initial = initial_energy_of_solid(prepared, to.factors, i, after.applied, after.u[i]);
    energy.elastic += initial;
    energy.external += initial - initial_energy_of_solid(prepared, from.factors, i, before.applied, before.u[i]);
  }
  const Vector normal = to.p(Eigen::seqN(0, to.p.size() / in_space.dimension, in_space.dimension));
  energy.elastic += 0.5 * prepared.contact.softness.dot(normal.cwiseAbs2());
  const FrictionWork friction = friction_work_of_solids(prepared, from, to);
  energy.friction += friction.work;
  energy.external += friction.beyond_rule;
  energy.friction_error += friction.error;
  return energy;
}

/// Increments in their order, each from the state that the one before it left.
class SolidMarch {
 public:
  SolidMarch(const SolidModel& model, const SolidOptions& options)
      : prepared_(prepared_solids(model, options.threads)), before_(solids_at_rest(prepared_)) {
    solver_.tolerance = options.tolerance;
    uniqueness_ = options.uniqueness;
    if (options.from == nullptr) {
      const Eigen::Index pairs = prepared_.contact.gap.size();
      state_.slip = Vector::Zero(2 * pairs);
      state_.gap = prepared_.contact.gap;
      state_.p = Vector::Zero(in_space.count(pairs));
      state_.a = Vector::Zero(prepared_.contact.rigid_motions());
      state_.states.assign(static_cast<std::size_t>(pairs), contact::ContactState::open);
      state_.history.resize(static_cast<std::size_t>(pairs));
      state_.shortening = before_.applied.shortening;
      return;
    }
    state_ = *options.from;
    before_ =
        moved_solids(prepared_, applied_to_solids(prepared_, state_.factors, state_.shortening), state_.p, state_.a);
  }

  SolidIncrement next(const SolidFactors& factors);
  const SolidState& state() const { return state_; }

 private:
  MovingSolids moving(const std::vector<std::size_t>& tightened) const {
    return {prepared_.model,        prepared_.structure,     prepared_.contact,      tightened,
            prepared_.paired.pairs, prepared_.paired.points, prepared_.paired.turned};
  }
  /// Of motions that nothing determines the smallest one, of increments without preloads that are tightened.
  void give_smallest_motions(const AppliedToSolids& applied, const contact::Problem& problem,
                             const contact::Start& start, contact::Solution& solution) const;
  /// The solution of the contact problem; `to` has what it says of it.
  contact::Evolution solved(const AppliedToSolids& applied, const SolidFactors& factors,
                            const std::vector<std::size_t>& tightened, SolidIncrement& to) const;
  /// Tensions of all bars; of those that waited the elongation is kept, from which their stiffness counts.
  std::vector<double> keep_bars(SolidState& reached, const std::vector<Vector>& u) const;

  PreparedSolids prepared_;
  contact::SolverOptions solver_;
  bool uniqueness_ = false;
  SolidState state_;
  MovedSolids before_;
  std::vector<Warning> given_;
};

void SolidMarch::give_smallest_motions(const AppliedToSolids& applied, const contact::Problem& problem,
                                       const contact::Start& start, contact::Solution& solution) const {
  if (solution.status != contact::Status::solved || solution.undetermined.cols() == 0) return;
  std::vector<Vector> moved = moved_solids(prepared_, applied, solution.p, solution.a).u;
  for (std::size_t b = 0; b < moved.size(); ++b) moved[b] -= before_.u[b];
  const std::vector<std::size_t> none;
  const std::optional<Vector> a = smallest_motions(moving(none), problem, solution, moved);
  if (!a) return;
  if (auto other = contact::with_motions(solution, *a, problem, start, solver_)) solution = *std::move(other);
}

contact::Evolution SolidMarch::solved(const AppliedToSolids& applied, const SolidFactors& factors,
                                      const std::vector<std::size_t>& tightened, SolidIncrement& to) const {
  const Eigen::Index motions = state_.a.size();
  contact::Start start{state_.p, state_.a};
  start.a.conservativeResize(motions + static_cast<Eigen::Index>(tightened.size()));
  for (std::size_t k = 0; k < tightened.size(); ++k)
    start.a[motions + static_cast<Eigen::Index>(k)] = state_.shortening[static_cast<Eigen::Index>(tightened[k])];
  contact::Problem problem = problem_of_solids(prepared_, applied, factors, state_.slip, state_.gap, tightened);
  contact::JointLaws laws = laws_of_solids(prepared_, factors);
  contact::History history = state_.history;
  const std::vector<char> waiting = waiting_bars(prepared_.model, state_.factors);
  const bool waits = std::find(waiting.begin(), waiting.end(), char{1}) != waiting.end();
  const WithoutWaiting without(prepared_.contact.pairs, prepared_.paired.pairs.size(), waiting);
  if (waits) {
    problem = without.of(problem);
    laws = without.of(laws);
    history = without.of(history);
    start.p = without.of(start.p);
  }
  contact::Evolution evolution = contact::evolve(problem, laws, history, start, solver_);
  if (uniqueness_ && problem.q.size() > 0)
    to.uniqueness = follow_history(problem, laws, history, start, solver_, evolution);
  if (tightened.empty()) give_smallest_motions(applied, evolution.problem, start, evolution.solution);
  const contact::Solution& solution = evolution.solution;
  to.factors = factors;
  to.status = solution.status;
  to.iterations = solution.iterations;
  if (solution.status == contact::Status::mechanism || solution.status == contact::Status::collapse)
    to.mechanism = solid_mechanism(moving(tightened), evolution.problem, solution);
  to.reason = reason_of_solids(prepared_.model, solution, to.mechanism);
  if (waits && to.status == contact::Status::solved) without.put_back(state_.history, evolution);
  return evolution;
}

std::vector<double> SolidMarch::keep_bars(SolidState& reached, const std::vector<Vector>& u) const {
  const SolidModel& model = prepared_.model;
  const std::vector<char> waiting = waiting_bars(model, state_.factors);
  std::vector<double> tensions(model.bars.size());
  for (std::size_t k = 0; k < prepared_.contact.pairs.size(); ++k) {
    const system::ContactSystem::Pair& pair = prepared_.contact.pairs[k];
    if (!pair.is_bar()) continue;
    const auto row = static_cast<Eigen::Index>(k);
    const std::size_t bar = static_cast<std::size_t>(pair.index) - prepared_.paired.pairs.size();
    tensions[bar] = given_tension(model, reached.factors, bar) - reached.p[in_space.of(row)];
    reached.gap[row] = waiting[bar] ? elongation(model.bars[bar], u) : state_.gap[row];
  }
  return tensions;
}

SolidIncrement SolidMarch::next(const SolidFactors& factors) {
  const SolidModel& model = prepared_.model;
  const std::vector<std::size_t> tightened =
      preloads_being_tightened(model, state_.factors.tightened, factors.tightened);
  Vector shortening = known_shortenings(model, tightened, state_.shortening, factors.tightened);
  AppliedToSolids applied = applied_to_solids(prepared_, factors, shortening);
  for (const Vector& forces : applied.forces)
    state_.force_scale = std::max(state_.force_scale, forces.lpNorm<Eigen::Infinity>());
  for (const std::size_t i : tightened)
    state_.force_scale = std::max(state_.force_scale, std::abs(*model.preloads[i].force));
  solver_.force_scale = state_.force_scale;
  SolidIncrement to;
  contact::Evolution evolution = solved(applied, factors, tightened, to);
  const contact::Solution& solution = evolution.solution;
  if (solution.status != contact::Status::solved) return to;
  to.certificate = solution.certificate;
  const Eigen::Index motions = state_.a.size();
  const Vector a = solution.a.head(motions);
  for (std::size_t k = 0; k < tightened.size(); ++k)
    shortening[static_cast<Eigen::Index>(tightened[k])] = solution.a[motions + static_cast<Eigen::Index>(k)];
  if (!tightened.empty()) applied = applied_to_solids(prepared_, factors, shortening);
  MovedSolids moved = moved_solids(prepared_, std::move(applied), solution.p, a);
  const double largest = std::max(state_.force_scale, largest_force_of_solids(moved, solution.p));
  to.certificate.equilibrium = imbalance_of(prepared_, moved, largest);
  to.u = moved.u;
  to.reactions = moved.reactions;
  to.heated = moved.applied.heated;
  to.tensions = tensions_of(model, shortening, moved.u);
  to.springs = spring_resultants_of_solids(model, factors, moved.u);
  SolidState reached{factors,         state_.slip + solution.slip_increment, solution.gap, solution.p, a, shortening,
                     solution.states, std::move(evolution.history),          largest,      {}};
  to.bars = keep_bars(reached, moved.u);
  to.energy = reached.energy = energy_of_solids(prepared_, state_, before_, reached, moved);
  to.pairs = solid_pairs(prepared_, reached);
  to.moments_of_sides = moments_of_sides(prepared_, to.pairs);
  if (std::string reason = add_held_gaps(prepared_, to); !reason.empty()) {
    to.status = contact::Status::not_converged;
    to.reason = std::move(reason);
  } else if (to.certificate.worst() > solver_.tolerance) {
    to.status = contact::Status::not_converged;
    to.reason = "the forces at some node do not balance to the tolerance of the certificate";
  }
  if (to.status != contact::Status::solved) return to;
  add_warnings(moving(tightened), solution, given_, to);
  state_ = std::move(reached);
  before_ = std::move(moved);
  return to;
}

}  // namespace

SolidBody with_super_elements(SolidBody body, int threads) {
  body.solved = element::solve_super_elements(body.mesh, elasticity_of(body), threads);
  return body;
}

element::InsideCells inside_cells_of(const SolidModel& model, const SolidIncrement& increment, std::size_t body) {
  const element::Mat6 D = elasticity_of(model.bodies[body]);
  element::InsideCells inside;
  inside.heated = increment.heated[body];
  inside.stress = model.bodies[body].expansion * D.leftCols<3>().rowwise().sum();
  for (std::size_t load = 0; load < model.per_volume.size(); ++load)
    inside.per_volume += increment.factors.loads[static_cast<Eigen::Index>(load)] * model.per_volume[load][body];
  return inside;
}

std::vector<int> count_pairs(const SolidModel& model) {
  std::vector<int> counts(model.contacts.size(), 0);
  for (const SolidPair& pair : paired_faces(model).pairs) ++counts[static_cast<std::size_t>(pair.contact)];
  return counts;
}

void solve_solids(const SolidModel& model, const std::vector<SolidFactors>& increments, const SolidOptions& options) {
  SolidMarch march(model, options);
  for (std::size_t k = options.first; k < increments.size(); ++k) {
    const SolidIncrement made = march.next(increments[k]);
    if (options.on_increment) options.on_increment(made, march.state());
    if (made.status != contact::Status::solved) break;
  }
}

}  // namespace scabo::analysis
