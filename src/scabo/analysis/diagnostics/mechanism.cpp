#include "scabo/analysis/diagnostics/mechanism.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "scabo/geometry/plane/polygon.hpp"
#include "scabo/linalg/decompositions.hpp"

namespace scabo::analysis {

namespace {

/// Motion of a part, for each of its bodies.
BodyMotion motion_of_part(const Prepared& prepared, std::size_t p, const Vector& rigid) {
  const system::BodySystem& part = *prepared.structure.parts[p];
  BodyMotion motion;
  motion.about = part.reference();
  motion.size = part.lever();
  motion.present = !prepared.is_absent(p);
  const Eigen::Index m = part.rigid_motions().cols();
  if (m == 0 || !motion.present) return motion;
  const Eigen::Vector3d of_part = part.rigid_coordinates() * rigid.segment(prepared.contact.first_rigid[p], m);
  motion.shift = of_part.head<2>();
  motion.rotation = of_part[2] / part.lever();
  return motion;
}

/// Of the body with number `b`.
double largest_displacement(const Prepared& prepared, std::size_t b, const BodyMotion& motion) {
  if (motion.shift.isZero(0.0) && motion.rotation == 0.0) return 0.0;
  const std::vector<Vec2>& nodes = prepared.mesh.bodies[b].nodes;
  double largest = 0.0;
  for (const Vec2& x : nodes) largest = std::max(largest, motion.at(x).norm());
  if (nodes.empty())
    for (const Vec2& x : polygon_of(prepared.model.bodies[b].outline)) largest = std::max(largest, motion.at(x).norm());
  return largest;
}

/// Integrals over the area of a body of 1, x, y and x^2 + y^2, coordinates from `about`.
struct Areas {
  double area = 0.0, polar = 0.0;
  Vec2 first = Vec2::Zero();

  /// A polygon, counter-clockwise.
  void add(const std::vector<Vec2>& corners, const Vec2& about) {
    for (std::size_t i = 0; i < corners.size(); ++i) {
      const Vec2 a = corners[i] - about, b = corners[(i + 1) % corners.size()] - about;
      const double twice = cross(a, b);
      area += twice / 2.0;
      first += twice / 6.0 * (a + b);
      polar += twice / 12.0 * (a.squaredNorm() + a.dot(b) + b.squaredNorm());
    }
  }
};

Areas areas_of_part(const Prepared& prepared, std::size_t p) {
  const system::BodySystem& part = *prepared.structure.parts[p];
  Areas areas;
  if (prepared.structure.dofs.is_unbounded(p)) {
    areas.area = 4.0 * part.lever() * part.lever();
    areas.polar = areas.area * part.lever() * part.lever() * 2.0 / 3.0;
    return areas;
  }
  for (const int body : prepared.structure.dofs.bodies_of(p)) {
    const mesh::BodyMesh& mesh = prepared.mesh.bodies[static_cast<std::size_t>(body)];
    if (mesh.cells.empty())
      areas.add(polygon_of(prepared.model.bodies[static_cast<std::size_t>(body)].outline), part.reference());
    for (const mesh::Cell& cell : mesh.cells) {
      std::vector<Vec2> corners;
      for (const int node : cell.nodes()) corners.push_back(mesh.nodes[static_cast<std::size_t>(node)]);
      if (cell.is_open()) corners.push_back(cell.centre);
      areas.add(corners, part.reference());
    }
  }
  return areas;
}

void multiply(BodyMotion& motion, double factor) {
  motion.shift *= factor;
  motion.rotation *= factor;
  motion.largest *= factor;
}

PairMotion motion_of_pair(const Prepared& prepared, const system::ContactSystem::Pair& at,
                          const std::vector<BodyMotion>& bodies) {
  const mesh::ContactPair& pair = mesh_pair(prepared, at);
  const model::Contact& contact = prepared.model.contacts[static_cast<std::size_t>(at.contact)];
  PairMotion motion;
  motion.contact = at.contact;
  motion.pair = at.number;
  motion.position = prepared.mesh.point_of(at.contact, pair, 0);
  motion.normal = pair.normal;
  const Vec2 relative =
      bodies[static_cast<std::size_t>(contact.b.body)].at(prepared.mesh.point_of(at.contact, pair, 1)) -
      bodies[static_cast<std::size_t>(contact.a.body)].at(motion.position);
  motion.opening = relative.dot(pair.normal);
  motion.slip = relative.dot(tangent_of(pair.normal));
  return motion;
}

}  // namespace

Mechanism mechanism_of(const Prepared& prepared, const Vector& rigid, FlowRule rule, const Vector& loads) {
  Mechanism mechanism;
  mechanism.rule = rule;
  const std::size_t bodies = prepared.model.bodies.size();
  double largest = 0.0;
  for (std::size_t b = 0; b < bodies; ++b) {
    const std::size_t p = prepared.structure.dofs.part_of(static_cast<int>(b));
    BodyMotion motion = motion_of_part(prepared, p, rigid);
    motion.largest = largest_displacement(prepared, b, motion);
    largest = std::max(largest, motion.largest);
    mechanism.bodies.push_back(motion);
  }
  ensure(largest > 0.0 && std::isfinite(largest), "a mechanism moves a body");
  for (BodyMotion& motion : mechanism.bodies) multiply(motion, 1.0 / largest);
  mechanism.rigid = rigid / largest;
  mechanism.work = loads.dot(mechanism.rigid);
  for (const system::ContactSystem::Pair& at : prepared.contact.pairs)
    if (!at.is_bar()) mechanism.pairs.push_back(motion_of_pair(prepared, at, mechanism.bodies));
  return mechanism;
}

Eigen::Matrix3d moments_of_part(const Prepared& prepared, std::size_t p) {
  const Areas areas = areas_of_part(prepared, p);
  const double L = prepared.structure.parts[p]->lever();
  Eigen::Matrix3d moments;
  moments << areas.area, 0.0, -areas.first.y() / L, 0.0, areas.area, areas.first.x() / L, -areas.first.y() / L,
      areas.first.x() / L, areas.polar / (L * L);
  return moments;
}

Eigen::Vector3d nearest_rigid_motion(const Prepared& prepared, std::size_t p, const Vector& u) {
  if (prepared.structure.dofs.is_rigid(p)) return u;
  const system::BodySystem& part = *prepared.structure.parts[p];
  const std::vector<Vec2>& nodes = prepared.structure.dofs.nodes(p);
  Eigen::Matrix3d gram = Eigen::Matrix3d::Zero();
  Eigen::Vector3d along = Eigen::Vector3d::Zero();
  for (std::size_t node = 0; node < nodes.size(); ++node) {
    const Eigen::Matrix<double, 2, 3> N = system::rigid_point(nodes[node], part.reference(), part.lever());
    gram += N.transpose() * N;
    along += N.transpose() * u.segment<2>(place_of(node));
  }
  return gram.inverse() * along;
}

Eigen::SparseMatrix<double> inverse_mass(const Prepared& prepared) {
  std::vector<Eigen::Triplet<double>> entries;
  double scale = 0.0;  // a power of two, of the first part
  for (std::size_t p = 0; p < prepared.structure.parts.size(); ++p) {
    const system::BodySystem& part = *prepared.structure.parts[p];
    const Eigen::Index m = part.rigid_motions().cols();
    if (m == 0 || prepared.is_absent(p)) continue;
    const Eigen::Matrix3d mass = moments_of_part(prepared, p);
    if (scale == 0.0) scale = std::exp2(-std::ilogb(mass(0, 0)));
    const Matrix along = part.rigid_coordinates().transpose() * (scale * mass) * part.rigid_coordinates();
    const Matrix inverse = Eigen::PartialPivLU<Matrix>(along).inverse();
    for (Eigen::Index i = 0; i < m; ++i)
      for (Eigen::Index j = 0; j < m; ++j)
        entries.emplace_back(prepared.contact.first_rigid[p] + i, prepared.contact.first_rigid[p] + j,
                             0.5 * (inverse(i, j) + inverse(j, i)));
  }
  Eigen::SparseMatrix<double> result(prepared.contact.rigid_motions(), prepared.contact.rigid_motions());
  result.setFromTriplets(entries.begin(), entries.end());
  return result;
}

const char* name_of(FlowRule rule) { return rule == FlowRule::coulomb ? "coulomb" : "associated"; }

std::string describe(const Mechanism& mechanism, const model::Model& model) {
  const int moving = mechanism.moving();
  return fmt::format("{} of {} bodies {} '{}'", moving, mechanism.present(),
                     moving == 1 ? "moves," : "move, most of all", model.bodies[mechanism.most()].name);
}

}  // namespace scabo::analysis
