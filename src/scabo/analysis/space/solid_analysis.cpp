#include "scabo/analysis/space/solid_analysis.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <memory>

#include "scabo/analysis/state/friction_work.hpp"
#include "scabo/analysis/state/pair_motions.hpp"
#include "scabo/contact/laws/bonded.hpp"
#include "scabo/contact/laws/coulomb.hpp"
#include "scabo/contact/solve.hpp"
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

PairedFaces paired_faces(const SolidModel& model) {
  PairedFaces paired;
  std::vector<double> areas;
  for (std::size_t c = 0; c < model.contacts.size(); ++c) {
    const SolidContact& contact = model.contacts[c];
    const auto face_of = [&](const SolidContact::Side& side) {
      return mesh::Face{model.bodies[static_cast<std::size_t>(side.body)].mesh, side.facets};
    };
    const mesh::Face a = face_of(contact.a), b = face_of(contact.b);
    const bool turned = !mesh::has_pairs_on_second(a, b);
    const std::vector<mesh::FacetPair> found = turned ? mesh::facet_pairs(b, a) : mesh::facet_pairs(a, b);
    const auto first = static_cast<std::size_t>(turned ? contact.b.body : contact.a.body),
               second = static_cast<std::size_t>(turned ? contact.a.body : contact.b.body);
    std::shared_ptr<const contact::Law> law = std::make_shared<contact::Bonded>();
    if (contact.friction) law = std::make_shared<contact::Coulomb>(*contact.friction);
    for (system::PairPoints& points : system::points_of(found, first, second)) {
      points.gap += contact.gap;
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

/// What stays over all increments.
struct PreparedSolids {
  const SolidModel& model;
  PairedFaces paired;
  system::Structure structure;
  system::ContactSystem contact;
};

PreparedSolids prepared_solids(const SolidModel& model, int threads) {
  PreparedSolids prepared{model, paired_faces(model), {}, {}};
  std::vector<system::ElasticPart> parts;
  for (const SolidBody& body : model.bodies)
    parts.push_back({system::solid_stiffness(body.mesh, element::elasticity_in_space(body.young, body.poisson)),
                     system::Positions(body.mesh.nodes), body.supports});
  prepared.structure.parts = system::elastic_bodies(std::move(parts), threads);
  prepared.contact = system::condense(prepared.structure, prepared.paired.points, prepared.paired.laws, threads);
  return prepared;
}

/// Loads and prescribed displacements of all bodies.
struct AppliedToSolids {
  std::vector<Vector> forces, prescribed;
};
AppliedToSolids applied_to_solids(const SolidModel& model, const SolidFactors& factors) {
  AppliedToSolids applied;
  for (std::size_t b = 0; b < model.bodies.size(); ++b) {
    const SolidBody& body = model.bodies[b];
    applied.forces.push_back(Vector::Zero(in_space.count(body.mesh.nodes.cols())));
    for (std::size_t load = 0; load < model.loads.size(); ++load)
      if (model.loads[load][b].size() > 0)
        applied.forces[b] += factors.loads[static_cast<Eigen::Index>(load)] * model.loads[load][b];
    Vector values(static_cast<Eigen::Index>(body.supports.size()));
    for (std::size_t c = 0; c < body.supports.size(); ++c)
      values[static_cast<Eigen::Index>(c)] = body.supports[c].value * factors.supports[body.supports[c].support];
    applied.prescribed.push_back(std::move(values));
  }
  return applied;
}

/// The contact problem of the pairs that move; `slip`: (d - 1) numbers of each so far.
contact::Problem problem_of_solids(const PreparedSolids& prepared, const AppliedToSolids& applied, const Vector& slip) {
  const system::ContactSystem& system = prepared.contact;
  const Eigen::Index pairs = system.gap.size();
  contact::Problem problem;
  problem.dimension = in_space.dimension;
  problem.W = system.W;
  problem.G = system.G;
  problem.q = Vector::Zero(in_space.count(pairs));
  problem.f = Vector::Zero(system.rigid_motions());
  for (Eigen::Index i = 0; i < pairs; ++i)
    problem.q.segment<3>(in_space.of(i)) << system.gap[i], -slip.segment<2>(2 * i);
  for (std::size_t p = 0; p < prepared.structure.parts.size(); ++p) {
    const system::BodySystem& part = *prepared.structure.parts[p];
    problem.q += system.motion[p] * part.displacement(applied.forces[p], applied.prescribed[p]);
    problem.f.segment(system.first_rigid[p], part.rigid_motions().cols()) =
        part.rigid_motions().transpose() * applied.forces[p];
  }
  contact::set_limits(system.laws, contact::History(static_cast<std::size_t>(pairs)), problem);
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
  for (const SolidBody& body : prepared.model.bodies) {
    rest.applied.forces.push_back(Vector::Zero(in_space.count(body.mesh.nodes.cols())));
    rest.applied.prescribed.push_back(Vector::Zero(static_cast<Eigen::Index>(body.supports.size())));
    rest.u.push_back(rest.applied.forces.back());
    rest.reactions.push_back(rest.applied.prescribed.back());
  }
  return rest;
}

/// The largest imbalance of a node over the largest force.
double imbalance_of(const PreparedSolids& prepared, const MovedSolids& moved, const Vector& p) {
  double largest = p.size() > 0 ? p.lpNorm<Eigen::Infinity>() : 0.0, imbalance = 0.0;
  for (std::size_t i = 0; i < moved.u.size(); ++i) {
    largest =
        std::max({largest, moved.forces[i].lpNorm<Eigen::Infinity>(), moved.unbalanced[i].lpNorm<Eigen::Infinity>()});
    imbalance = std::max(imbalance, prepared.structure.parts[i]->imbalance_of(moved.unbalanced[i]));
  }
  return largest > 0.0 ? imbalance / largest : 0.0;
}

/// All pairs; those that supports hold on both sides as they are at rest.
std::vector<SolidPair> solid_pairs(const PreparedSolids& prepared, const contact::Solution& solution,
                                   const Vector& slip) {
  const PairedFaces& paired = prepared.paired;
  std::vector<SolidPair> pairs = paired.pairs;
  for (std::size_t i = 0; i < pairs.size(); ++i) pairs[i].gap = paired.points[i].gap;
  for (std::size_t k = 0; k < prepared.contact.pairs.size(); ++k) {
    const auto row = static_cast<Eigen::Index>(k);
    const auto i = static_cast<std::size_t>(prepared.contact.pairs[k].index);
    const Eigen::Matrix3d directions = paired.points[i].directions;
    const double sense = paired.turned[i] ? -1.0 : 1.0;
    pairs[i].force = sense * (directions * solution.p.segment<3>(in_space.of(row)));
    pairs[i].slip = sense * (directions.rightCols<2>() * slip.segment<2>(2 * row));
    pairs[i].gap = solution.gap[row];
    pairs[i].state = solution.states[k];
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
    pair.gap = prepared.paired.points[i].gap + moved[0];
    const bool tied = !prepared.model.contacts[static_cast<std::size_t>(pair.contact)].friction;
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

/// Whether a pair may have begun or ended to slip anywhere within the increment. One that touches without force slips
/// from the start, as the force grows.
bool has_changed(const SolidState& from, const contact::Solution& to, std::size_t k) {
  const auto row = static_cast<Eigen::Index>(k);
  const Eigen::Vector3d before = from.p.segment<3>(in_space.of(row));
  if (from.states[k] == contact::ContactState::open && before[0] == 0.0 && from.gap[row] <= 0.0) return false;
  const bool turned = before.tail<2>().dot(to.slip_increment.segment<2>(2 * row)) > 0.0;
  return turned || from.states[k] != to.states[k];
}

/// As analysis/state/friction_work.hpp, with a constant coefficient.
FrictionWork friction_work_of_solids(const PreparedSolids& prepared, const SolidState& from,
                                     const contact::Solution& to) {
  FrictionWork total;
  for (std::size_t k = 0; k < prepared.contact.pairs.size(); ++k) {
    const auto row = static_cast<Eigen::Index>(k);
    const auto i = static_cast<std::size_t>(prepared.contact.pairs[k].index);
    const auto& friction = prepared.model.contacts[static_cast<std::size_t>(prepared.paired.pairs[i].contact)].friction;
    const Eigen::Vector2d slip = to.slip_increment.segment<2>(2 * row);
    if (!friction || slip.isZero(0.0)) continue;
    const Eigen::Vector3d before = from.p.segment<3>(in_space.of(row)), after = to.p.segment<3>(in_space.of(row));
    const double way = slip.norm(), bound = *friction * std::max(before[0], 0.0),
                 at_end = std::max(-after.tail<2>().dot(slip) / way, 0.0), work = 0.5 * (bound + at_end) * way;
    total.work += work;
    total.beyond_rule += work + 0.5 * (before + after).tail<2>().dot(slip);
    if (has_changed(from, to, k)) total.error += 0.5 * std::abs(at_end - bound) * way;
  }
  return total;
}

/// The energy of `from` and what an increment adds to it.
Energy energy_of_solids(const PreparedSolids& prepared, const SolidState& from, const MovedSolids& before,
                        const MovedSolids& after, const contact::Solution& solution) {
  Energy energy = from.energy;
  energy.elastic = 0.0;
  for (std::size_t i = 0; i < after.u.size(); ++i) {
    energy.external += 0.5 * (before.applied.forces[i] + after.applied.forces[i]).dot(after.u[i] - before.u[i]);
    energy.external +=
        0.5 *
        (before.reactions[i] + after.reactions[i]).dot(after.applied.prescribed[i] - before.applied.prescribed[i]);
    energy.elastic += prepared.structure.parts[i]->elastic_energy(after.u[i], after.forces[i], after.unbalanced[i]);
  }
  const FrictionWork friction = friction_work_of_solids(prepared, from, solution);
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
    if (options.from == nullptr) {
      const Eigen::Index pairs = prepared_.contact.gap.size();
      state_.slip = Vector::Zero(2 * pairs);
      state_.gap = prepared_.contact.gap;
      state_.p = Vector::Zero(in_space.count(pairs));
      state_.a = Vector::Zero(prepared_.contact.rigid_motions());
      state_.states.assign(static_cast<std::size_t>(pairs), contact::ContactState::open);
      return;
    }
    state_ = *options.from;
    before_ = moved_solids(prepared_, applied_to_solids(model, state_.factors), state_.p, state_.a);
  }

  SolidIncrement next(const SolidFactors& factors);
  const SolidState& state() const { return state_; }

 private:
  PreparedSolids prepared_;
  contact::SolverOptions solver_;
  SolidState state_;
  MovedSolids before_;
};

SolidIncrement SolidMarch::next(const SolidFactors& factors) {
  AppliedToSolids applied = applied_to_solids(prepared_.model, factors);
  for (const Vector& forces : applied.forces)
    state_.force_scale = std::max(state_.force_scale, forces.lpNorm<Eigen::Infinity>());
  solver_.force_scale = state_.force_scale;
  const contact::Solution solution =
      contact::solve(problem_of_solids(prepared_, applied, state_.slip), {state_.p, state_.a}, solver_);
  SolidIncrement to;
  to.factors = factors;
  to.status = solution.status;
  to.reason = solution.reason;
  to.iterations = solution.iterations;
  if (solution.status != contact::Status::solved) return to;
  to.certificate = solution.certificate;
  MovedSolids moved = moved_solids(prepared_, std::move(applied), solution.p, solution.a);
  to.certificate.equilibrium = imbalance_of(prepared_, moved, solution.p);
  to.u = moved.u;
  to.reactions = moved.reactions;
  to.energy = energy_of_solids(prepared_, state_, before_, moved, solution);
  const Vector slip = state_.slip + solution.slip_increment;
  to.pairs = solid_pairs(prepared_, solution, slip);
  if (std::string reason = add_held_gaps(prepared_, to); !reason.empty()) {
    to.status = contact::Status::not_converged;
    to.reason = std::move(reason);
  } else if (to.certificate.worst() > solver_.tolerance) {
    to.status = contact::Status::not_converged;
    to.reason = "the forces at some node do not balance to the tolerance of the certificate";
  }
  if (to.status != contact::Status::solved) return to;
  state_ = {factors, slip, solution.gap, solution.p, solution.a, solution.states, state_.force_scale, to.energy};
  before_ = std::move(moved);
  return to;
}

}  // namespace

std::vector<SolidIncrement> solve_solids(const SolidModel& model, const std::vector<SolidFactors>& increments,
                                         const SolidOptions& options) {
  SolidMarch march(model, options);
  std::vector<SolidIncrement> made;
  for (std::size_t k = options.first; k < increments.size(); ++k) {
    made.push_back(march.next(increments[k]));
    if (options.on_increment) options.on_increment(made.back(), march.state());
    if (made.back().status != contact::Status::solved) break;
  }
  return made;
}

}  // namespace scabo::analysis
