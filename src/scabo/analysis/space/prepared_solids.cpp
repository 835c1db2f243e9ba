#include "scabo/analysis/space/prepared_solids.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <memory>

#include "scabo/analysis/space/solid_bars.hpp"
#include "scabo/analysis/space/solid_preloads.hpp"
#include "scabo/analysis/state/loads.hpp"
#include "scabo/contact/laws/two_sided.hpp"
#include "scabo/linalg/decompositions.hpp"
#include "scabo/system/contact_laws.hpp"
#include "scabo/system/fewer_parts.hpp"
#include "scabo/system/rigid_solid.hpp"
#include "scabo/system/solid_part.hpp"

namespace scabo::analysis {

namespace {

const SolidBody& body_of(const SolidModel& model, const SolidContact::Side& side) {
  return model.bodies[static_cast<std::size_t>(side.body)];
}

/// A rigid side has pairs only against another one.
bool has_pairs_on_first(const mesh::Face& a, const mesh::Face& b) {
  return a.rigid == b.rigid ? !mesh::has_pairs_on_second(a, b) : b.rigid;
}

/// Tangents along and across the direction of friction axes. The cone of friction becomes round where the tangent
/// across is scaled by the ratio of the coefficients: forces along it are divided by that, motions multiplied.
void take_axes(const model::SpaceFrictionAxes& axes, double friction, system::PairPoints::Directions& directions) {
  const Eigen::Vector3d n = directions.col(0);
  directions.col(1) = (axes.direction - n.dot(axes.direction) * n).normalized();
  directions.col(2) = axes.across / friction * n.cross(Eigen::Vector3d(directions.col(1)));
}

/// Resultants of the loads on a part along its free motions; what is rounding of their sum is 0.
Vector resultants_of_loads(const system::BodySystem& part, const Vector& forces, double sum) {
  constexpr double rounding_of_sums = 1e-12;
  Vector f = part.rigid_motions().transpose() * forces;
  for (double& resultant : f)
    if (std::abs(resultant) <= rounding_of_sums * sum) resultant = 0.0;
  return f;
}

}  // namespace

system::PairSide side_at(const SolidModel& model, int body, const Eigen::Vector3d& at) {
  const Matrix& nodes = model.bodies[static_cast<std::size_t>(body)].mesh.nodes;
  const Eigen::Vector3d middle = nodes.rowwise().mean();
  const Eigen::Matrix3Xd arms = nodes.colwise() - middle;
  const Eigen::Vector3d along = (arms * arms.transpose()).ldlt().solve(at - middle);
  const Vector weights = (arms.transpose() * along).array() + 1.0 / static_cast<double>(nodes.cols());
  system::PairSide side{static_cast<std::size_t>(body), {}, Vec2::Zero()};
  for (Eigen::Index i = 0; i < weights.size(); ++i) side.nodes.push_back({static_cast<int>(i), weights[i]});
  return side;
}

namespace {

/// The ground and a point of a body, of which only the direction that is held counts. A rotation about axis k is held
/// as a pair of the body with itself, whose side B is a lever along the next axis, and moves along the one after that.
system::PairPoints points_of_held(const SolidModel& model, const SolidHeldPoint& point) {
  system::PairPoints points;
  points.a.part = system::PairSide::ground;
  int axis = point.held.component;
  if (const std::optional<Eigen::Vector3d>& at = model.bodies[static_cast<std::size_t>(point.body)].rigid_at) {
    points.b = side_at(model, point.body, *at);
    if (point.held.rotation) {
      points.a = points.b;
      const Eigen::Vector3d arm = lever_of(model, point) * Eigen::Vector3d::Unit((axis + 1) % 3);
      points.b = side_at(model, point.body, *at + arm);
      axis = (axis + 2) % 3;
    }
  } else {
    points.b = {static_cast<std::size_t>(point.body),
                {{static_cast<int>(in_space.node_of(point.held.dof)), 1.0}},
                Vec2::Zero()};
  }
  points.directions = Eigen::Matrix3d::Zero();
  for (int k = 0; k < 3 && axis >= 0; ++k) points.directions((axis + k) % 3, k) = 1.0;
  if (axis < 0) {
    const Eigen::Vector3d n = point.held.inclined, t = n.unitOrthogonal();
    points.directions << n, t, n.cross(t);
  }
  return points;
}

}  // namespace

PairsOfFaces pairs_of(const SolidModel& model, const SolidContact& contact) {
  const auto face_of = [&](const SolidContact::Side& side) {
    return mesh::Face{body_of(model, side).mesh, side.facets, body_of(model, side).rigid_at.has_value()};
  };
  const mesh::Face a = face_of(contact.a), b = face_of(contact.b);
  const bool turned = has_pairs_on_first(a, b);
  return {turned ? mesh::facet_pairs(b, a, contact.law.bond) : mesh::facet_pairs(a, b, contact.law.bond), turned};
}

PairedFaces paired_faces(const SolidModel& model) {
  PairedFaces paired;
  std::vector<double> areas;
  for (std::size_t c = 0; c < model.contacts.size(); ++c) {
    const SolidContact& contact = model.contacts[c];
    const auto [found, turned] = pairs_of(model, contact);
    const auto first = static_cast<std::size_t>(turned ? contact.b.body : contact.a.body),
               second = static_cast<std::size_t>(turned ? contact.a.body : contact.b.body);
    const system::LawPointer law = system::law_of(contact.law);
    std::vector<system::PairPoints> of_contact = system::points_of(found, first, second);
    for (std::size_t i = 0; i < found.size(); ++i) {
      system::PairPoints& points = of_contact[i];
      points.gap += contact.gap;
      if (contact.friction_axes) take_axes(*contact.friction_axes, contact.law.friction, points.directions);
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
  for (const SolidHeldPoint& point : model.held_points) {
    paired.points.push_back(points_of_held(model, point));
    paired.laws.of_pair.push_back(std::make_shared<contact::TwoSided>());
    areas.push_back(1.0);
  }
  for (const SolidBar& bar : model.bars) {
    paired.points.push_back(points_of(bar));
    paired.laws.of_pair.push_back(std::make_shared<contact::TwoSided>());
    areas.push_back(1.0);
  }
  paired.laws.area = Eigen::Map<const Vector>(areas.data(), static_cast<Eigen::Index>(areas.size()));
  return paired;
}

element::Mat6 elasticity_of(const SolidBody& body) { return element::elasticity_in_space(body.young, body.poisson); }

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
  prepared.whole = system::condense(prepared.structure, prepared.paired.points, prepared.paired.laws, threads);
  const std::vector<SolidPair>& at_rest = prepared.paired.pairs;
  for (std::vector<system::ContactSystem::Pair>* pairs : {&prepared.whole.pairs, &prepared.whole.held})
    for (system::ContactSystem::Pair& pair : *pairs)
      pair.contact = static_cast<std::size_t>(pair.index) < at_rest.size()
                         ? at_rest[static_cast<std::size_t>(pair.index)].contact
                         : -1;
  return prepared;
}

double lever_of(const SolidModel& model, const SolidHeldPoint& point) {
  if (!point.held.rotation) return 1.0;
  const Matrix& nodes = model.bodies[static_cast<std::size_t>(point.body)].mesh.nodes;
  return 0.5 * (nodes.rowwise().maxCoeff() - nodes.rowwise().minCoeff()).norm();
}

std::vector<char> absent_in(const SolidModel& model, int step) {
  std::vector<char> absent;
  for (const SolidBody& body : model.bodies) absent.push_back(body.stay.is_there(step) ? 0 : 1);
  if (std::none_of(absent.begin(), absent.end(), [](char is) { return is != 0; })) absent.clear();
  return absent;
}

void set_stage(PreparedSolids& prepared, int step) {
  const SolidModel& model = prepared.model;
  prepared.fewer.reset();
  prepared.absent = absent_in(model, step);
  const auto waits = [&](const auto& of) { return !of.stay.is_there(step); };
  if (prepared.absent.empty() && std::none_of(model.held_points.begin(), model.held_points.end(), waits) &&
      std::none_of(model.bars.begin(), model.bars.end(), waits))
    return;
  std::vector<char> absent = prepared.absent;
  absent.resize(model.bodies.size(), 0);
  const auto has_side = [&](const system::PairSide& side) {
    return side.part == system::PairSide::ground || absent[side.part] == 0;
  };
  prepared.fewer =
      system::with_pairs(prepared.whole, prepared.structure, absent, [&](const system::ContactSystem::Pair& pair) {
        if (prepared.is_held_point(pair) && waits(model.held_points[prepared.held_point(pair)])) return false;
        if (prepared.is_bar(pair) && waits(model.bars[prepared.bar(pair)])) return false;
        const system::PairPoints& points = prepared.paired.points[static_cast<std::size_t>(pair.index)];
        return has_side(points.a) && has_side(points.b);
      });
}

double displacement_of_held_point(const PreparedSolids& prepared, const SolidFactors& factors, std::size_t point) {
  const SolidHeldPoint& of = prepared.model.held_points[point];
  return lever_of(prepared.model, of) * of.held.value * factors.supports[of.held.support];
}

Vector reactions_of_held_points(const PreparedSolids& prepared, const Vector& p, double release,
                                const Vector& released) {
  const std::vector<SolidHeldPoint>& points = prepared.model.held_points;
  Vector reactions = Vector::Zero(static_cast<Eigen::Index>(points.size()));
  if (released.size() > 0) reactions = release * released;
  const std::vector<system::ContactSystem::Pair>& pairs = prepared.contact().pairs;
  for (std::size_t i = 0; i < pairs.size(); ++i)
    if (prepared.is_held_point(pairs[i])) {
      const std::size_t point = prepared.held_point(pairs[i]);
      reactions[static_cast<Eigen::Index>(point)] +=
          lever_of(prepared.model, points[point]) * p[in_space.of(static_cast<Eigen::Index>(i))];
    }
  return reactions;
}

contact::JointLaws laws_of_solids(const PreparedSolids& prepared, const SolidFactors& factors) {
  return system::with_coefficients(prepared.contact().laws, prepared.contact().pairs, prepared.given,
                                   {factors.coefficients.begin(), factors.coefficients.end()});
}

AppliedToSolids applied_to_solids(const PreparedSolids& prepared, const SolidFactors& factors, Vector shortening,
                                  const std::vector<Vector>& released) {
  const SolidModel& model = prepared.model;
  AppliedToSolids applied;
  applied.shortening = std::move(shortening);
  std::vector<Vector> pulls;
  for (const SolidBody& body : model.bodies) pulls.push_back(Vector::Zero(in_space.count(body.mesh.nodes.cols())));
  for (std::size_t i = 0; i < model.bars.size(); ++i) model.bars[i].pull(given_tension(prepared, factors, i), pulls);
  for (std::size_t b = 0; b < model.bodies.size(); ++b) {
    const SolidBody& body = model.bodies[b];
    Vector forces = pulls[b], heated;
    double sum = forces.lpNorm<1>();
    for (std::size_t load = 0; load < model.loads.size() && !prepared.is_absent(b); ++load) {
      const double factor = factors.presence_of(b) * factors.loads[static_cast<Eigen::Index>(load)];
      if (model.loads[load][b].size() > 0) {
        forces += factor * model.loads[load][b];
        sum += std::abs(factor) * model.loads[load][b].lpNorm<1>();
      }
      if (model.temperatures.empty() || model.temperatures[load][b].size() == 0) continue;
      if (heated.size() == 0) heated = Vector::Zero(body.mesh.nodes.cols());
      heated += factor * model.temperatures[load][b];
    }
    for (std::size_t i = 0; i < model.preloads.size(); ++i) {
      if (model.preloads[i].body != static_cast<int>(b) || prepared.is_absent(b)) continue;
      forces += applied.shortening[static_cast<Eigen::Index>(i)] * model.preloads[i].cut.forces;
      sum += std::abs(applied.shortening[static_cast<Eigen::Index>(i)]) * model.preloads[i].cut.forces.lpNorm<1>();
    }
    if (!released.empty() && released[b].size() > 0) {
      forces += factors.release * released[b];
      sum += factors.release * released[b].lpNorm<1>();
    }
    if (const Matrix& rigid = prepared.structure.parts[b]->rigid_motions(); rigid.cols() > 0 && !body.rigid_at)
      take_out_rounding(rigid, sum, forces);
    Vector values = Vector::Zero(static_cast<Eigen::Index>(body.supports.size()));
    for (std::size_t c = 0; c < body.supports.size() && !prepared.is_absent(b); ++c)
      values[static_cast<Eigen::Index>(c)] = body.supports[c].value * factors.supports[body.supports[c].support];
    applied.forces.push_back(std::move(forces));
    applied.prescribed.push_back(std::move(values));
    applied.heated.push_back(std::move(heated));
    applied.sums.push_back(sum);
  }
  return applied;
}

double gap_of_solids(const PreparedSolids& prepared, const SolidFactors& factors, std::size_t i) {
  const std::size_t contacts = prepared.paired.pairs.size(), held = prepared.model.held_points.size();
  if (i >= contacts) return i < contacts + held ? -displacement_of_held_point(prepared, factors, i - contacts) : 0.0;
  const double gap = prepared.paired.points[i].gap;
  if (gap >= 0.0 || factors.fits.size() == 0) return gap;
  return gap * factors.fits[prepared.paired.pairs[i].contact];
}

contact::Problem problem_of_solids(const PreparedSolids& prepared, const AppliedToSolids& applied,
                                   const SolidFactors& factors, const SolidState& from,
                                   const std::vector<std::size_t>& tightened) {
  const system::ContactSystem& system = prepared.contact();
  const Eigen::Index pairs = system.gap.size();
  contact::Problem problem;
  problem.dimension = in_space.dimension;
  problem.W = system.W;
  problem.G = system.G;
  problem.q = Vector::Zero(in_space.count(pairs));
  problem.f = Vector::Zero(system.rigid_motions());
  for (Eigen::Index i = 0; i < pairs; ++i) {
    const auto k = static_cast<std::size_t>(i);
    const double gap = system.gap[i] < 0.0 || system.pairs[k].is_bar()
                           ? gap_of_solids(prepared, factors, static_cast<std::size_t>(system.pairs[k].index))
                           : system.gap[i];  // that of a pair that keeps its gap is 0
    problem.q.segment<3>(in_space.of(i)) << gap, -from.slip.segment<2>(2 * i);
  }
  if (from.offset.size() > 0) problem.q += from.offset;
  std::vector<Vector> u;
  for (std::size_t p = 0; p < prepared.structure.parts.size(); ++p) {
    const system::BodySystem& part = *prepared.structure.parts[p];
    u.push_back(prepared.is_absent(p) ? Vector(Vector::Zero(part.size()))
                                      : part.displacement(applied.forces[p], applied.prescribed[p]));
    if (prepared.is_absent(p)) continue;
    problem.q += system.motion[p] * u[p];
    problem.f.segment(system.first_rigid[p], part.rigid_motions().cols()) =
        resultants_of_loads(part, applied.forces[p], applied.sums[p]);
  }
  add_shortenings(prepared.model, tightened, factors.tightened, prepared.structure, system, u, problem);
  return problem;
}

MovedSolids moved_solids(const PreparedSolids& prepared, AppliedToSolids applied, const Vector& p, const Vector& a) {
  MovedSolids moved{std::move(applied), {}, {}, {}, {}};
  for (std::size_t i = 0; i < prepared.structure.parts.size(); ++i) {
    const system::BodySystem& part = *prepared.structure.parts[i];
    if (prepared.is_absent(i)) {
      for (std::vector<Vector>* of : {&moved.forces, &moved.u, &moved.unbalanced})
        of->push_back(Vector::Zero(part.size()));
      moved.reactions.push_back(Vector::Zero(static_cast<Eigen::Index>(part.constraints().size())));
      continue;
    }
    moved.forces.push_back(moved.applied.forces[i] + prepared.contact().motion[i].transpose() * p);
    moved.u.push_back(part.displacement(moved.forces[i], moved.applied.prescribed[i]));
    moved.u[i] += part.rigid_motions() * a.segment(prepared.contact().first_rigid[i], part.rigid_motions().cols());
    moved.unbalanced.push_back(part.unbalanced(moved.u[i], moved.forces[i]));
    moved.reactions.push_back(part.reactions_of(moved.unbalanced[i]));
  }
  return moved;
}

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

SolidState solid_state_at_rest(const PreparedSolids& prepared) {
  const system::ContactSystem& contact = prepared.contact();
  const Eigen::Index pairs = contact.gap.size();
  SolidState rest;
  rest.slip = Vector::Zero(2 * pairs);
  rest.gap = contact.gap;
  rest.p = Vector::Zero(in_space.count(pairs));
  rest.a = Vector::Zero(contact.rigid_motions());
  rest.states.assign(static_cast<std::size_t>(pairs), contact::ContactState::open);
  rest.history.resize(static_cast<std::size_t>(pairs));
  rest.shortening = Vector::Zero(static_cast<Eigen::Index>(prepared.model.preloads.size()));
  return rest;
}

}  // namespace scabo::analysis
