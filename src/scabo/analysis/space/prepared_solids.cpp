#include "scabo/analysis/space/prepared_solids.hpp"

#include <cmath>
#include <memory>

#include "scabo/analysis/space/solid_bars.hpp"
#include "scabo/analysis/space/solid_preloads.hpp"
#include "scabo/analysis/state/loads.hpp"
#include "scabo/contact/laws/two_sided.hpp"
#include "scabo/system/contact_laws.hpp"
#include "scabo/system/rigid_solid.hpp"
#include "scabo/system/solid_part.hpp"

namespace scabo::analysis {

namespace {

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
  std::vector<system::PairPoints> points = prepared.paired.points;
  contact::JointLaws laws = prepared.paired.laws;
  for (const SolidBar& bar : model.bars) {
    points.push_back(points_of(bar));
    laws.of_pair.push_back(std::make_shared<contact::TwoSided>());
  }
  laws.area.conservativeResize(static_cast<Eigen::Index>(points.size()));
  laws.area.tail(static_cast<Eigen::Index>(model.bars.size())).setOnes();
  prepared.contact = system::condense(prepared.structure, points, laws, threads);
  const std::size_t of_contacts = prepared.paired.pairs.size();
  for (system::ContactSystem::Pair& pair : prepared.contact.pairs) {
    const auto i = static_cast<std::size_t>(pair.index);
    pair.contact = i < of_contacts ? prepared.paired.pairs[i].contact : -1;
  }
  return prepared;
}

contact::JointLaws laws_of_solids(const PreparedSolids& prepared, const SolidFactors& factors) {
  return system::with_coefficients(prepared.contact.laws, prepared.contact.pairs, prepared.given,
                                   {factors.coefficients.begin(), factors.coefficients.end()});
}

AppliedToSolids applied_to_solids(const PreparedSolids& prepared, const SolidFactors& factors, Vector shortening) {
  const SolidModel& model = prepared.model;
  AppliedToSolids applied;
  applied.shortening = std::move(shortening);
  std::vector<Vector> pulls;
  for (const SolidBody& body : model.bodies) pulls.push_back(Vector::Zero(in_space.count(body.mesh.nodes.cols())));
  for (std::size_t i = 0; i < model.bars.size(); ++i) model.bars[i].pull(given_tension(model, factors, i), pulls);
  for (std::size_t b = 0; b < model.bodies.size(); ++b) {
    const SolidBody& body = model.bodies[b];
    Vector forces = pulls[b], heated;
    double sum = forces.lpNorm<1>();
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

double gap_of_solids(const PreparedSolids& prepared, const SolidFactors& factors, std::size_t i) {
  const double gap = prepared.paired.points[i].gap;
  if (gap >= 0.0 || factors.fits.size() == 0) return gap;
  return gap * factors.fits[prepared.paired.pairs[i].contact];
}

contact::Problem problem_of_solids(const PreparedSolids& prepared, const AppliedToSolids& applied,
                                   const SolidFactors& factors, const Vector& slip, const Vector& of_pairs,
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
    const double gap = system.pairs[k].is_bar() ? -of_pairs[i]
                       : system.gap[i] < 0.0
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

}  // namespace scabo::analysis
