#include "scabo/analysis/space/solid_analysis.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <memory>

#include "scabo/analysis/quasistatic/branch.hpp"
#include "scabo/analysis/space/prepared_solids.hpp"
#include "scabo/analysis/space/smallest_motions.hpp"
#include "scabo/analysis/space/solid_bars.hpp"
#include "scabo/analysis/space/solid_energy.hpp"
#include "scabo/analysis/space/solid_preloads.hpp"
#include "scabo/analysis/space/solid_stages.hpp"
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
std::vector<Eigen::Vector3d> spring_resultants_of_solids(const PreparedSolids& prepared, const SolidFactors& factors,
                                                         const std::vector<Vector>& u) {
  const SolidModel& model = prepared.model;
  std::vector<Eigen::Vector3d> resultants;
  for (const SolidSpringOfBody& of : model.springs) {
    const auto b = static_cast<std::size_t>(of.body);
    Vector forces = -of.spring.times(u[b]);
    if (of.load >= 0 && !prepared.is_absent(b))
      forces += factors.presence_of(b) * factors.loads[of.load] * model.loads[static_cast<std::size_t>(of.load)][b];
    resultants.emplace_back(forces.reshaped(3, forces.size() / 3).rowwise().sum());
  }
  return resultants;
}

/// All pairs; those that supports hold on both sides as they are at rest.
std::vector<SolidPair> solid_pairs(const PreparedSolids& prepared, const SolidState& state) {
  const PairedFaces& paired = prepared.paired;
  std::vector<SolidPair> pairs = paired.pairs;
  for (std::size_t i = 0; i < pairs.size(); ++i) pairs[i].gap = paired.points[i].gap;
  for (std::size_t k = 0; k < prepared.contact().pairs.size(); ++k) {
    const auto row = static_cast<Eigen::Index>(k);
    if (prepared.contact().pairs[k].is_bar()) continue;
    const auto i = static_cast<std::size_t>(prepared.contact().pairs[k].index);
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
std::string add_held_gaps(const PreparedSolids& prepared, const Vector& offset, SolidIncrement& to) {
  const std::vector<system::ContactSystem::Pair>& held = prepared.contact().held;
  if (held.empty()) return {};
  Vector motion =
      motion_under(prepared.contact().held_motion, to.u, in_space.count(static_cast<Eigen::Index>(held.size())));
  if (offset.size() > 0) motion += offset;
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

/// Leaves out the pairs of bodies that are absent.
void leave_out_pairs(const PreparedSolids& prepared, SolidIncrement& to) {
  if (prepared.absent.empty()) return;
  std::vector<SolidPair> there;
  for (std::size_t i = 0; i < to.pairs.size(); ++i)
    if (const system::PairPoints& points = prepared.paired.points[i];
        !prepared.is_absent(points.a.part) && !prepared.is_absent(points.b.part))
      there.push_back(to.pairs[i]);
  to.pairs = std::move(there);
}

/// What the parts do in an increment.
void describe_parts(const PreparedSolids& prepared, const SolidState& from, const SolidFactors& factors,
                    const Vector& p, const Vector& shortening, const MovedSolids& moved, SolidIncrement& to) {
  to.u = moved.u;
  to.reactions = moved.reactions;
  to.heated = moved.applied.heated;
  to.tensions = tensions_of(prepared.model, shortening, moved.u);
  for (std::size_t i = 0; i < to.tensions.size(); ++i)
    if (prepared.is_absent(static_cast<std::size_t>(prepared.model.preloads[i].body))) to.tensions[i] = {};
  to.springs = spring_resultants_of_solids(prepared, factors, moved.u);
  to.held = reactions_of_held_points(prepared, p, factors.release, from.released_points);
  to.bars = tensions_of_bars(prepared, factors, p);
}

/// Increments in their order, each from the state that the one before it left.
class SolidMarch {
 public:
  SolidMarch(const SolidModel& model, const SolidOptions& options)
      : prepared_(prepared_solids(model, options.threads)), before_(solids_at_rest(prepared_)) {
    solver_.tolerance = options.tolerance;
    uniqueness_ = options.uniqueness;
    set_stage(prepared_, options.from == nullptr ? 0 : options.from->factors.step);
    if (options.from == nullptr && !options.start) {
      state_ = solid_state_at_rest(prepared_);
      return;
    }
    state_ = options.from == nullptr ? options.start(prepared_) : *options.from;
    before_ = moved_solids(prepared_, applied_to_solids(prepared_, state_.factors, state_.shortening, state_.released),
                           state_.p, state_.a);
  }

  SolidIncrement next(const SolidFactors& factors);
  const SolidState& state() const { return state_; }
  const PreparedSolids& prepared() const { return prepared_; }

 private:
  MovingSolids moving(const std::vector<std::size_t>& tightened) const {
    return {prepared_.model,        prepared_.structure,     prepared_.contact(),     tightened,
            prepared_.paired.pairs, prepared_.paired.points, prepared_.paired.turned, prepared_.absent};
  }
  /// Of motions that nothing determines the smallest one, of increments without preloads that are tightened.
  void give_smallest_motions(const AppliedToSolids& applied, const contact::Problem& problem,
                             const contact::Start& start, contact::Solution& solution) const;
  /// The solution of the contact problem; `to` has what it says of it.
  contact::Evolution solved(const AppliedToSolids& applied, const SolidFactors& factors,
                            const std::vector<std::size_t>& tightened, SolidIncrement& to) const;

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
  const contact::Problem problem = problem_of_solids(prepared_, applied, factors, state_, tightened);
  const contact::JointLaws laws = laws_of_solids(prepared_, factors);
  contact::Evolution evolution = contact::evolve(problem, laws, state_.history, start, solver_);
  if (uniqueness_ && !prepared_.contact().pairs.empty())
    to.uniqueness = follow_history(problem, laws, state_.history, start, solver_, evolution);
  if (tightened.empty()) give_smallest_motions(applied, evolution.problem, start, evolution.solution);
  const contact::Solution& solution = evolution.solution;
  to.factors = factors;
  to.status = solution.status;
  to.iterations = solution.iterations;
  if (solution.status == contact::Status::mechanism || solution.status == contact::Status::collapse)
    to.mechanism = solid_mechanism(moving(tightened), evolution.problem, solution);
  to.reason = reason_of_solids(prepared_.model, solution, to.mechanism);
  return evolution;
}

SolidIncrement SolidMarch::next(const SolidFactors& factors) {
  const SolidModel& model = prepared_.model;
  if (factors.step != state_.factors.step) enter_step(prepared_, factors.step, state_, before_);
  const std::vector<std::size_t> tightened =
      preloads_being_tightened(model, state_.factors.tightened, factors.tightened);
  Vector shortening = known_shortenings(model, tightened, state_.shortening, factors.tightened);
  AppliedToSolids applied = applied_to_solids(prepared_, factors, shortening, state_.released);
  for (const Vector& forces : applied.forces)
    state_.force_scale = std::max(state_.force_scale, forces.lpNorm<Eigen::Infinity>());
  for (const std::size_t i : tightened)
    state_.force_scale = std::max(state_.force_scale, std::abs(*model.preloads[i].force));
  solver_.force_scale = state_.force_scale;
  SolidIncrement to;
  to.absent = prepared_.absent;
  contact::Evolution evolution = solved(applied, factors, tightened, to);
  const contact::Solution& solution = evolution.solution;
  if (solution.status != contact::Status::solved) return to;
  to.certificate = solution.certificate;
  const Eigen::Index motions = state_.a.size();
  const Vector a = solution.a.head(motions);
  for (std::size_t k = 0; k < tightened.size(); ++k)
    shortening[static_cast<Eigen::Index>(tightened[k])] = solution.a[motions + static_cast<Eigen::Index>(k)];
  if (!tightened.empty()) applied = applied_to_solids(prepared_, factors, shortening, state_.released);
  MovedSolids moved = moved_solids(prepared_, std::move(applied), solution.p, a);
  const double largest = std::max(state_.force_scale, largest_force_of_solids(moved, solution.p));
  to.certificate.equilibrium = imbalance_of(prepared_, moved, largest);
  describe_parts(prepared_, state_, factors, solution.p, shortening, moved, to);
  SolidState reached{factors,
                     state_.slip + solution.slip_increment,
                     solution.gap,
                     solution.p,
                     a,
                     shortening,
                     solution.states,
                     std::move(evolution.history),
                     largest,
                     {},
                     state_.offset,
                     state_.held_offset,
                     state_.released,
                     state_.released_points};
  to.energy = reached.energy = energy_of_solids(prepared_, state_, before_, reached, moved);
  to.pairs = solid_pairs(prepared_, reached);
  to.moments_of_sides = moments_of_sides(prepared_, to.pairs);
  std::string held = add_held_gaps(prepared_, state_.held_offset, to);
  leave_out_pairs(prepared_, to);
  if (!held.empty()) {
    to.status = contact::Status::not_converged;
    to.reason = std::move(held);
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

bool SolidModel::has_stages() const {
  return !held_points.empty() ||
         std::any_of(bodies.begin(), bodies.end(), [](const SolidBody& body) { return body.stay.is_staged(); }) ||
         std::any_of(bars.begin(), bars.end(), [](const SolidBar& bar) { return !bar.stay.is_there(0); });
}

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
    inside.per_volume += increment.factors.presence_of(body) *
                         increment.factors.loads[static_cast<Eigen::Index>(load)] * model.per_volume[load][body];
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
    if (made.status != contact::Status::solved) return;
  }
  if (options.on_end) options.on_end(march.prepared(), march.state());
}

}  // namespace scabo::analysis
