#include "scabo/system/solid_part.hpp"

#include "scabo/element/space/facet.hpp"

namespace scabo::system {

namespace {

constexpr Components space{3};

/// Adds forces, 3 x n, to those of these nodes.
void add_forces(const std::vector<int>& nodes, const Matrix& forces, Vector& sum) {
  for (std::size_t i = 0; i < nodes.size(); ++i)
    sum.segment<3>(space.of(nodes[i])) += forces.col(static_cast<Eigen::Index>(i));
}

PairSide side_of(const std::vector<mesh::WeightedNode>& nodes, std::size_t part) {
  PairSide side;
  side.part = part;
  for (const mesh::WeightedNode& at : nodes) side.nodes.push_back({at.node, at.weight});
  return side;
}

}  // namespace

Stiffness solid_stiffness(const mesh::SolidMesh& mesh, const element::Mat6& D) {
  std::vector<Eigen::Triplet<double>> entries;
  for (const std::vector<int>& cell : mesh.cells) {
    const Matrix K = element::tetrahedron_stiffness(mesh::nodes_of(mesh, cell), D);
    for (Eigen::Index j = 0; j < K.cols(); ++j)
      for (Eigen::Index i = 0; i < K.rows(); ++i)
        entries.emplace_back(
            static_cast<int>(space.of(cell[static_cast<std::size_t>(space.node_of(i))], space.component_of(i))),
            static_cast<int>(space.of(cell[static_cast<std::size_t>(space.node_of(j))], space.component_of(j))),
            K(i, j));
  }
  Stiffness stiffness;
  const Eigen::Index size = space.count(mesh.nodes.cols());
  stiffness.sparse.resize(size, size);
  stiffness.sparse.setFromTriplets(entries.begin(), entries.end());
  return stiffness;
}

Constraint held_along_axis(int node, int axis, double value) {
  Constraint constraint;
  constraint.dof = static_cast<int>(space.of(node, axis));
  constraint.component = axis;
  constraint.value = value;
  return constraint;
}

Vector volume_forces(const mesh::SolidMesh& mesh, const Eigen::Vector3d& per_volume) {
  Vector forces = Vector::Zero(space.count(mesh.nodes.cols()));
  for (const std::vector<int>& cell : mesh.cells)
    add_forces(cell, per_volume * element::volume_weights(mesh::nodes_of(mesh, cell)).transpose(), forces);
  return forces;
}

Vector traction_forces(const mesh::SolidMesh& mesh, const std::vector<mesh::SolidFacet>& facets,
                       const Eigen::Vector3d& traction) {
  Vector forces = Vector::Zero(space.count(mesh.nodes.cols()));
  for (const mesh::SolidFacet& facet : facets)
    add_forces(facet, traction * element::area_weights(mesh::nodes_of(mesh, facet)).transpose(), forces);
  return forces;
}

Vector pressure_forces(const mesh::SolidMesh& mesh, const std::vector<mesh::SolidFacet>& facets, double pressure) {
  Vector forces = Vector::Zero(space.count(mesh.nodes.cols()));
  for (const mesh::SolidFacet& facet : facets)
    add_forces(facet, -pressure * element::normal_weights(mesh::nodes_of(mesh, facet)), forces);
  return forces;
}

std::vector<PairPoints> points_of(const std::vector<mesh::FacetPair>& pairs, std::size_t part_a, std::size_t part_b) {
  std::vector<PairPoints> points;
  for (const mesh::FacetPair& pair : pairs)
    points.push_back({side_of(pair.a, part_a), side_of(pair.b, part_b), pair.directions, pair.gap});
  return points;
}

}  // namespace scabo::system
