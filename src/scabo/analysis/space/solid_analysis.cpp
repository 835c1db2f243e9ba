#include "scabo/analysis/space/solid_analysis.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <memory>

#include "scabo/analysis/quasistatic/branch.hpp"
#include "scabo/analysis/space/smallest_motions.hpp"
#include "scabo/analysis/space/solid_preloads.hpp"
#include "scabo/analysis/state/friction_work.hpp"
#include "scabo/analysis/state/loads.hpp"
#include "scabo/analysis/state/pair_motions.hpp"
#include "scabo/system/contact_laws.hpp"
#include "scabo/system/rigid_solid.hpp"
#include "scabo/system/solid_part.hpp"

namespace scabo::analysis {

namespace {

constexpr Components in_space{3};

/// The pairs of all contacts, in their order.
struct PairedFaces {
  std::vector<system::PairPoints> points;
  std::vector<SolidPair> pairs;  // at rest
  std::vector<char> turned;      // whether the pairs are corners of side a
  contact::JointLaws laws;
};

const SolidBody& body_of(const SolidModel& model, const SolidContact::Side& side) {
  return model.bodies[static_cast<std::size_t>(side.body)];
}

/// A rigid side has pairs only against another one.
bool has_pairs_on_first(const SolidModel& model, const SolidContact& contact, const mesh::Face& a,
                        const mesh::Face& b) {
  const bool rigid_a = body_of(model, contact.a).rigid_at.has_value(),
             rigid_b = body_of(model, contact.b).rigid_at.has_value();
  return rigid_a == rigid_b ? !mesh::has_pairs_on_second(a, b) : rigid_b;
}

PairedFaces paired_faces(const SolidModel& model) {
  PairedFaces paired;
  std::vector<double> areas;
  for (std::size_t c = 0; c < model.contacts.size(); ++c) {
    const SolidContact& contact = model.contacts[c];
    const auto face_of = [&](const SolidContact::Side& side) {
      return mesh::Face{body_of(model, side).mesh, side.facets};
    };
    const mesh::Face a = face_of(contact.a), b = face_of(contact.b);
    const bool turned = has_pairs_on_first(model, contact, a, b);
    const std::vector<mesh::FacetPair> found =
        turned ? mesh::facet_pairs(b, a, contact.law.bond) : mesh::facet_pairs(a, b, contact.law.bond);
    const auto first = static_cast<std::size_t>(turned ? contact.b.body : contact.a.body),
               second = static_cast<std::size_t>(turned ? contact.a.body : contact.b.body);
    const system::LawPointer law = system::law_of(contact.law);
    std::vector<system::PairPoints> of_contact = system::points_of(found, first, second);
    for (std::size_t i = 0; i < found.size(); ++i) {
      system::PairPoints& points = of_contact[i];
      points.gap += contact.gap;
      if (contact.law.modulus) points.softness = 1.0 / (*contact.law.modulus * found[i].area);
      paired.points.push_back(std::move(points));
    }
    for (const mesh::FacetPair& pair : found) {
      SolidPair at_rest;
      at_rest.contact = static_cast<int>(c);
      at_rest.corner = pair.corner;
      at_rest.on_a = turned;
      at_rest.point = pair.point;
      at_rest.normal = (turned ? -1.0 : 1.0) * pair.directions.col(0);
      at_rest.area = pair.area;
      paired.pairs.push_back(at_rest);
      paired.turned.push_back(turned);
      paired.laws.of_pair.push_back(law);
      areas.push_back(pair.area);
    }
  }
  paired.laws.area = Eigen::Map<const Vector>(areas.data(), static_cast<Eigen::Index>(areas.size()));
  return paired;
}

element::Mat6 elasticity_of(const SolidBody& body) { return element::elasticity_in_space(body.young, body.poisson); }

/// What stays over all increments.
struct PreparedSolids {
  const SolidModel& model;
  PairedFaces paired;
  system::Structure structure;
  system::ContactSystem contact;
  std::vector<model::Contact> given;  // laws of the contacts of the model
};

PreparedSolids prepared_solids(const SolidModel& model, int threads) {
  PreparedSolids prepared{model, paired_faces(model), {}, {}, {}};
  for (const SolidContact& contact : model.contacts) prepared.given.push_back(contact.law);
  std::vector<std::vector<system::SolidSpring>> springs(model.bodies.size());
  for (const SolidSpringOfBody& of : model.springs) springs[static_cast<std::size_t>(of.body)].push_back(of.spring);
  std::vector<system::ElasticPart> parts;
  for (std::size_t b = 0; b < model.bodies.size(); ++b) {
    const SolidBody& body = model.bodies[b];
    if (body.rigid_at) continue;
    system::Stiffness stiffness = system::solid_stiffness(body.mesh, elasticity_of(body), body.solved);
    for (const system::SolidSpring& spring : springs[b])
      stiffness.springs.matrix =
          stiffness.springs.none() ? spring.on_nodes : linalg::SparseMatrix(stiffness.springs.matrix + spring.on_nodes);
    parts.push_back({std::move(stiffness), system::Positions(body.mesh.nodes), body.supports});
  }
  std::vector<std::unique_ptr<system::BodySystem>> elastic = system::elastic_bodies(std::move(parts), threads);
  auto next = elastic.begin();
  for (std::size_t b = 0; b < model.bodies.size(); ++b) {
    const SolidBody& body = model.bodies[b];
    prepared.structure.parts.push_back(
        body.rigid_at ? system::rigid_solid(body.mesh.nodes, *body.rigid_at, body.supports, springs[b])
                      : std::move(*next++));
  }
  prepared.contact = system::condense(prepared.structure, prepared.paired.points, prepared.paired.laws, threads);
  for (system::ContactSystem::Pair& pair : prepared.contact.pairs)
    pair.contact = prepared.paired.pairs[static_cast<std::size_t>(pair.index)].contact;
  return prepared;
}

/// Laws of the pairs that move.
contact::JointLaws laws_of_solids(const PreparedSolids& prepared, const SolidFactors& factors) {
  return system::with_coefficients(prepared.contact.laws, prepared.contact.pairs, prepared.given,
                                   {factors.coefficients.begin(), factors.coefficients.end()});
}

/// Loads and prescribed displacements of all bodies, and of each the sum of the sizes of all its loads.
struct AppliedToSolids {
  std::vector<Vector> forces, prescribed, heated;
  std::vector<double> sums;
  Vector shortening;  // of preloads
};
AppliedToSolids applied_to_solids(const PreparedSolids& prepared, const SolidFactors& factors, Vector shortening) {
  const SolidModel& model = prepared.model;
  AppliedToSolids applied;
  applied.shortening = std::move(shortening);
  for (std::size_t b = 0; b < model.bodies.size(); ++b) {
    const SolidBody& body = model.bodies[b];
    Vector forces = Vector::Zero(in_space.count(body.mesh.nodes.cols())), heated;
    double sum = 0.0;
    for (std::size_t load = 0; load < model.loads.size(); ++load) {
      const double factor = factors.loads[static_cast<Eigen::Index>(load)];
      if (model.loads[load][b].size() > 0) {
        forces += factor * model.loads[load][b];
        sum += std::abs(factor) * model.loads[load][b].lpNorm<1>();
      }
      if (model.temperatures.empty() || model.temperatures[load][b].size() == 0) continue;
      if (heated.size() == 0) heated = Vector::Zero(body.mesh.nodes.cols());
      heated += factor * model.temperatures[load][b];
    }
    for (std::size_t i = 0; i < model.preloads.size(); ++i) {
      if (model.preloads[i].body != static_cast<int>(b)) continue;
      forces += applied.shortening[static_cast<Eigen::Index>(i)] * model.preloads[i].cut.forces;
      sum += std::abs(applied.shortening[static_cast<Eigen::Index>(i)]) * model.preloads[i].cut.forces.lpNorm<1>();
    }
    if (const Matrix& rigid = prepared.structure.parts[b]->rigid_motions(); rigid.cols() > 0 && !body.rigid_at)
      take_out_rounding(rigid, sum, forces);
    Vector values(static_cast<Eigen::Index>(body.supports.size()));
    for (std::size_t c = 0; c < body.supports.size(); ++c)
      values[static_cast<Eigen::Index>(c)] = body.supports[c].value * factors.supports[body.supports[c].support];
    applied.forces.push_back(std::move(forces));
    applied.prescribed.push_back(std::move(values));
    applied.heated.push_back(std::move(heated));
    applied.sums.push_back(sum);
  }
  return applied;
}

/// Resultants of the loads on a part along its free motions; what is rounding of their sum is 0.
Vector resultants_of_loads(const system::BodySystem& part, const Vector& forces, double sum) {
  constexpr double rounding_of_sums = 1e-12;
  Vector f = part.rigid_motions().transpose() * forces;
  for (double& resultant : f)
    if (std::abs(resultant) <= rounding_of_sums * sum) resultant = 0.0;
  return f;
}

/// The gap of pair i of the model; of an interference, the part that is there.
double gap_of_solids(const PreparedSolids& prepared, const SolidFactors& factors, std::size_t i) {
  const double gap = prepared.paired.points[i].gap;
  if (gap >= 0.0 || factors.fits.size() == 0) return gap;
  return gap * factors.fits[prepared.paired.pairs[i].contact];
}

/// The contact problem of the pairs that move, its laws not yet included; `slip`: (d - 1) numbers of each so far;
/// `tightened`: preloads whose shortenings are unknowns too.
contact::Problem problem_of_solids(const PreparedSolids& prepared, const AppliedToSolids& applied,
                                   const SolidFactors& factors, const Vector& slip,
                                   const std::vector<std::size_t>& tightened) {
  const system::ContactSystem& system = prepared.contact;
  const Eigen::Index pairs = system.gap.size();
  contact::Problem problem;
  problem.dimension = in_space.dimension;
  problem.W = system.W;
  problem.G = system.G;
  problem.q = Vector::Zero(in_space.count(pairs));
  problem.f = Vector::Zero(system.rigid_motions());
  for (Eigen::Index i = 0; i < pairs; ++i) {
    const auto k = static_cast<std::size_t>(i);
    const double gap = system.gap[i] < 0.0
                           ? gap_of_solids(prepared, factors, static_cast<std::size_t>(system.pairs[k].index))
                           : system.gap[i];  // that of a pair that keeps its gap is 0
    problem.q.segment<3>(in_space.of(i)) << gap, -slip.segment<2>(2 * i);
  }
  std::vector<Vector> u;
  for (std::size_t p = 0; p < prepared.structure.parts.size(); ++p) {
    const system::BodySystem& part = *prepared.structure.parts[p];
    u.push_back(part.displacement(applied.forces[p], applied.prescribed[p]));
    problem.q += system.motion[p] * u[p];
    problem.f.segment(system.first_rigid[p], part.rigid_motions().cols()) =
        resultants_of_loads(part, applied.forces[p], applied.sums[p]);
  }
  add_shortenings(prepared.model, tightened, factors.tightened, prepared.structure, system, u, problem);
  return problem;
}

/// What the parts do under loads, contact forces and rigid motions.
struct MovedSolids {
  AppliedToSolids applied;
  std::vector<Vector> u, forces, unbalanced, reactions;
};
MovedSolids moved_solids(const PreparedSolids& prepared, AppliedToSolids applied, const Vector& p, const Vector& a) {
  MovedSolids moved{std::move(applied), {}, {}, {}, {}};
  for (std::size_t i = 0; i < prepared.structure.parts.size(); ++i) {
    const system::BodySystem& part = *prepared.structure.parts[i];
    moved.forces.push_back(moved.applied.forces[i] + prepared.contact.motion[i].transpose() * p);
    moved.u.push_back(part.displacement(moved.forces[i], moved.applied.prescribed[i]));
    moved.u[i] += part.rigid_motions() * a.segment(prepared.contact.first_rigid[i], part.rigid_motions().cols());
    moved.unbalanced.push_back(part.unbalanced(moved.u[i], moved.forces[i]));
    moved.reactions.push_back(part.reactions_of(moved.unbalanced[i]));
  }
  return moved;
}

/// Before the first increment.
MovedSolids solids_at_rest(const PreparedSolids& prepared) {
  MovedSolids rest;
  rest.applied.shortening = Vector::Zero(static_cast<Eigen::Index>(prepared.model.preloads.size()));
  for (const SolidBody& body : prepared.model.bodies) {
    rest.applied.forces.push_back(Vector::Zero(in_space.count(body.mesh.nodes.cols())));
    rest.applied.prescribed.push_back(Vector::Zero(static_cast<Eigen::Index>(body.supports.size())));
    rest.applied.heated.emplace_back();
    rest.u.push_back(rest.applied.forces.back());
    rest.reactions.push_back(rest.applied.prescribed.back());
  }
  return rest;
}

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
    const auto row = static_cast<Eigen::Index>(k);
    const auto i = static_cast<std::size_t>(prepared.contact.pairs[k].index);
    const Eigen::Matrix3d directions = paired.points[i].directions;
    const double sense = paired.turned[i] ? -1.0 : 1.0;
    pairs[i].force = sense * (directions * state.p.segment<3>(in_space.of(row)));
    pairs[i].slip = sense * (directions.rightCols<2>() * state.slip.segment<2>(2 * row));
    pairs[i].gap = state.gap[row];
    pairs[i].state = state.states[k];
    pairs[i].broken = state.history[k].broken;
  }
  return pairs;
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
  const contact::Problem problem = problem_of_solids(prepared_, applied, factors, state_.slip, tightened);
  const contact::JointLaws laws = laws_of_solids(prepared_, factors);
  contact::Evolution evolution = contact::evolve(problem, laws, state_.history, start, solver_);
  if (uniqueness_ && problem.pairs() > 0)
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
  to.energy = reached.energy = energy_of_solids(prepared_, state_, before_, reached, moved);
  to.pairs = solid_pairs(prepared_, reached);
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
