#include "scabo/system/sliding_sides.hpp"

#include <algorithm>
#include <cmath>
#include <set>
#include <utility>

#include "scabo/linalg/decompositions.hpp"
#include "scabo/mesh/plane/concurrent_rays.hpp"
#include "scabo/mesh/plane/interface.hpp"

namespace scabo::system {

namespace {

/// The largest coefficient that counts as little: with more, pairs that stick hold the body.
constexpr double little_friction = 0.1;

/// The least tangential force per normal force that pairs can carry; nothing if they carry some without a normal force.
std::optional<double> least_friction(const model::Model& model, std::size_t c) {
  const model::Contact& contact = model.contacts[c];
  if (contact.bond || contact.cohesion > 0.0 || contact.lasting_cohesion > 0.0 || contact.tension > 0.0 ||
      contact.shear_strength)
    return std::nullopt;
  double least = contact.friction_along.empty() ? contact.friction : contact.friction_along.front().friction;
  for (const std::optional<double>& other :
       {contact.backward_friction, contact.dynamic_friction, contact.backward_dynamic_friction})
    if (other) least = std::min(least, *other);
  for (const model::FrictionPoint& point : contact.friction_along) least = std::min(least, point.friction);
  for (const model::Step& step : model.steps)
    for (const std::vector<double>* changed : {&step.friction, &step.backward_friction})
      if (!changed->empty()) least = std::min(least, (*changed)[c]);
  return least;
}

/// Motions of a part as [u_x, u_y, L rotation] at `point`.
Matrix motions_at(const BodySystem& part, const Vec2& point, double length) {
  Matrix motions(3, part.rigid_coordinates().cols());
  for (Eigen::Index k = 0; k < motions.cols(); ++k) {
    const Eigen::Vector3d motion = part.rigid_coordinates().col(k);
    motions.col(k) << rigid_point(point, part.reference(), part.lever()) * motion, motion[2] * length / part.lever();
  }
  return motions;
}

bool spans(const Matrix& motions, const Eigen::Vector3d& wanted) {
  constexpr double rounding = 1e-9;
  if (motions.cols() == 0) return false;
  const Eigen::ColPivHouseholderQR<Matrix> factor(motions);
  return (motions * factor.solve(wanted) - wanted).norm() <= rounding;
}

/// How the parts of the two sides may move about the common point.
struct Slide {
  bool of_a = false, of_b = false, of_both = false;
};

Slide slide_of(const Structure& structure, const model::Contact& contact, const mesh::Rays& rays,
               const mesh::ContactPair& at) {
  const std::size_t a = structure.dofs.part_of(contact.a.body), b = structure.dofs.part_of(contact.b.body);
  if (a == b) return {};
  const BodySystem &part_a = *structure.parts[a], &part_b = *structure.parts[b];
  const double length = std::max(part_a.lever(), part_b.lever());
  // At the pair: turning about a centre far away is moving across.
  Eigen::Vector3d wanted;
  if (const auto centre = rays.centre()) {
    const Vec2 arm = at.point_b - *centre;
    wanted << -arm.y(), arm.x(), length;
  } else {
    wanted << tangent_of(rays.through(at.point_b).direction), 0.0;
  }
  wanted.normalize();
  const Matrix of_a = motions_at(part_a, at.point_b, length), of_b = motions_at(part_b, at.point_b, length);
  Matrix together(3, of_a.cols() + of_b.cols());
  together << of_b, -of_a;
  return {spans(of_a, wanted), spans(of_b, wanted), spans(together, wanted)};
}

/// Whether the sides touch all along, or overlap, and another contact has pairs at their nodes. Forces of a uniform
/// pressure are then shared there by normals that differ, those of the two elements that meet at such a node: with one
/// normal, a force could pass around the node through the bodies that meet there.
bool presses_beside_another(const mesh::Mesh& mesh, const model::Model& model, const mesh::Interface& interface) {
  double largest = 0.0, length = 0.0;
  for (const mesh::ContactPair& pair : interface.pairs) {
    largest = std::max(largest, pair.gap);
    length = std::max(length, (pair.point_a - interface.pairs.front().point_a).norm());
  }
  constexpr double touching = 1e-9;
  if (largest > touching * length) return false;
  const model::Contact& contact = model.contacts[static_cast<std::size_t>(interface.contact)];
  std::set<std::pair<int, int>> own;  // body, node
  for (const mesh::ContactPair& pair : interface.pairs)
    own.insert({{contact.a.body, pair.node_a}, {contact.b.body, pair.node_b}});
  for (const mesh::Interface& other : mesh.interfaces) {
    if (other.contact == interface.contact) continue;
    const model::Contact& named = model.contacts[static_cast<std::size_t>(other.contact)];
    for (const mesh::ContactPair& pair : other.pairs)
      if (own.contains({named.a.body, pair.node_a}) || own.contains({named.b.body, pair.node_b})) return true;
  }
  return false;
}

/// Takes the resultants along the motion about the common point out of the loads on a part, where they are no more than
/// `lost` of a load.
void balance(Structure& structure, std::size_t p, const mesh::Rays& rays, const Vec2& at, double lost) {
  const BodySystem& part = *structure.parts[p];
  Eigen::Vector3d wanted;
  if (const auto centre = rays.centre()) {
    const Vec2 arm = part.reference() - *centre;
    wanted << -arm.y(), arm.x(), part.lever();
  } else {
    wanted << tangent_of(rays.through(at).direction), 0.0;
  }
  const Vector amplitudes = Eigen::ColPivHouseholderQR<Matrix>(part.rigid_coordinates()).solve(wanted).normalized();
  for (std::vector<Vector>& load : structure.loads) {
    Vector& forces = load[p];
    if (forces.size() == 0) continue;
    const double resultant = amplitudes.dot(Vector(part.rigid_motions().transpose() * forces));
    if (resultant == 0.0 || std::abs(resultant) > lost * forces.lpNorm<1>()) continue;
    add_resultants(part.rigid_motions(), -resultant * amplitudes, forces);
  }
}

}  // namespace

void add_resultants(const Matrix& rigid, const Vector& resultants, Vector& forces) {
  std::vector<int> loaded;
  for (Eigen::Index i = 0; i < forces.size(); ++i)
    if (forces[i] != 0.0) loaded.push_back(static_cast<int>(i));
  const Matrix motions = rigid(loaded, Eigen::all);
  const Eigen::LDLT<Matrix> squares(motions.transpose() * motions);
  // Motions across all forces are there by rounding alone.
  bool moves = !loaded.empty();
  for (Eigen::Index k = 0; k < rigid.cols() && moves; ++k)
    moves = motions.col(k).lpNorm<Eigen::Infinity>() > 1e-6 * rigid.col(k).lpNorm<Eigen::Infinity>();
  if (moves && squares.info() == Eigen::Success && squares.rcond() > 1e-6)
    forces(loaded) += motions * squares.solve(resultants);
  else  // few forces, or parallel ones
    forces += rigid * Matrix(rigid.transpose() * rigid).ldlt().solve(resultants);
}

void let_slide(Structure& structure, const model::Model& model, mesh::Mesh& mesh) {
  for (mesh::Interface& interface : mesh.interfaces) {
    const auto c = static_cast<std::size_t>(interface.contact);
    const model::Contact& contact = model.contacts[c];
    const std::optional<double> friction = least_friction(model, c);
    if (!friction || contact.large_slip || interface.pairs.empty()) continue;
    const bool floats = [&] {
      for (const model::Place& place : {contact.a, contact.b})
        if (structure.parts[structure.dofs.part_of(place.body)]->rigid_coordinates().cols() > 0) return true;
      return false;
    }();
    if (!floats) continue;
    const std::optional<mesh::Rays> rays = mesh::concurrent_rays(model, contact, mesh);
    if (!rays || presses_beside_another(mesh, model, interface)) continue;
    const Slide slide = slide_of(structure, contact, *rays, interface.pairs[interface.pairs.size() / 2]);
    if (!slide.of_both) continue;

    std::vector<mesh::ContactPair> turned = interface.pairs;
    double deviation = 0.0;
    for (mesh::ContactPair& pair : turned) {
      const Vec2 point = slide.of_a == slide.of_b ? Vec2(0.5 * (pair.point_a + pair.point_b))
                         : slide.of_b             ? pair.point_b
                                                  : pair.point_a;
      const Vec2 along = rays->through(point).direction;
      const Vec2 normal = along.dot(pair.normal) < 0.0 ? Vec2(-along) : along;
      deviation = std::max(deviation, std::abs(cross(pair.normal, normal)));
      pair.normal = normal;
    }
    if (*friction >= std::max(deviation, little_friction)) continue;
    mesh::set_gaps(turned, contact.gap);
    const Vec2 at = turned[turned.size() / 2].point_b;
    interface.pairs = std::move(turned);
    for (const auto& [body, moves] : {std::pair(contact.a.body, slide.of_a), std::pair(contact.b.body, slide.of_b)}) {
      if (!moves) continue;
      const std::size_t part = structure.dofs.part_of(body);
      double lost = 0.0;
      for (const int of : structure.dofs.bodies_of(part)) lost = std::max(lost, mesh::lost_of_arcs(model, of, mesh));
      if (*friction < lost) balance(structure, part, *rays, at, lost);
    }
  }
}

}  // namespace scabo::system
