#include "scabo/system/solid_part.hpp"

#include <Eigen/Geometry>

#include "scabo/linalg/decompositions.hpp"

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

Stiffness solid_stiffness(const mesh::SolidMesh& mesh, const element::Mat6& D, const element::SuperElements& solved) {
  std::vector<Eigen::Triplet<double>> entries;
  for (std::size_t c = 0; c < mesh.cells.size(); ++c) {
    const std::vector<int>& cell = mesh.cells[c];
    const Matrix K = element::cell_stiffness(mesh::nodes_of(mesh, cell), D, element::super_element_of(solved, c));
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

Vector volume_forces(const mesh::SolidMesh& mesh, const Eigen::Vector3d& per_volume,
                     const element::SuperElements& solved) {
  Vector forces = Vector::Zero(space.count(mesh.nodes.cols()));
  for (std::size_t c = 0; c < mesh.cells.size(); ++c) {
    const std::vector<int>& cell = mesh.cells[c];
    const Matrix nodes = mesh::nodes_of(mesh, cell);
    if (const element::SolidSuperElement* of = element::super_element_of(solved, c))
      add_forces(cell, element::loads_of_volume_force(nodes, *of, per_volume).h.reshaped(3, nodes.cols()), forces);
    else
      add_forces(cell, per_volume * element::cell_volume_weights(nodes).transpose(), forces);
  }
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

Vector varying_traction_forces(const mesh::SolidMesh& mesh, const std::vector<mesh::SolidFacet>& facets,
                               const element::TractionAt& traction) {
  Vector forces = Vector::Zero(space.count(mesh.nodes.cols()));
  for (const mesh::SolidFacet& facet : facets)
    add_forces(facet, element::traction_integrals(mesh::nodes_of(mesh, facet), traction), forces);
  return forces;
}

double area_of_facets(const mesh::SolidMesh& mesh, const std::vector<mesh::SolidFacet>& facets) {
  double area = 0.0;
  for (const mesh::SolidFacet& facet : facets) area += element::area_weights(mesh::nodes_of(mesh, facet)).sum();
  return area;
}

namespace {

/// Of the nodal forces of unit rotations about a centroid, as much as has this moment.
Vector with_moment(const Matrix& nodes, const Eigen::Vector3d& centroid, const Matrix& of_rotations,
                   const Eigen::Vector3d& moment) {
  Eigen::Matrix3d moments = Eigen::Matrix3d::Zero();
  for (int k = 0; k < 3; ++k)
    for (Eigen::Index i = 0; i < nodes.cols(); ++i) {
      const Eigen::Vector3d arm = nodes.col(i) - centroid;
      moments.col(k) += arm.cross(Eigen::Vector3d(of_rotations.col(k).segment<3>(space.of(i))));
    }
  return of_rotations * moments.ldlt().solve(moment);
}

}  // namespace

Eigen::Vector3d centroid_of_facets(const mesh::SolidMesh& mesh, const std::vector<mesh::SolidFacet>& facets) {
  Eigen::Vector3d centroid = Eigen::Vector3d::Zero();
  for (const mesh::SolidFacet& facet : facets) {
    const Matrix nodes = mesh::nodes_of(mesh, facet);
    centroid += nodes * element::area_weights(nodes);
  }
  return centroid / area_of_facets(mesh, facets);
}

Vector moment_forces(const mesh::SolidMesh& mesh, const std::vector<mesh::SolidFacet>& facets,
                     const Eigen::Vector3d& moment) {
  const Eigen::Vector3d centroid = centroid_of_facets(mesh, facets);
  Matrix of_rotations(space.count(mesh.nodes.cols()), 3);
  for (int k = 0; k < 3; ++k)
    of_rotations.col(k) =
        varying_traction_forces(mesh, facets, [&](const Eigen::Vector3d& x, const Eigen::Vector3d&) -> Eigen::Vector3d {
          return Eigen::Vector3d::Unit(k).cross(x - centroid);
        });
  return with_moment(mesh.nodes, centroid, of_rotations, moment);
}

SolidVolume volume_of(const mesh::SolidMesh& mesh) {
  SolidVolume of{Vector::Zero(mesh.nodes.cols())};
  for (const std::vector<int>& cell : mesh.cells)
    of.weights(cell) += element::cell_volume_weights(mesh::nodes_of(mesh, cell));
  of.volume = of.weights.sum();
  of.centroid = mesh.nodes * of.weights / of.volume;
  return of;
}

Vector forces_on_rigid(const mesh::SolidMesh& mesh, const Eigen::Vector3d& force, const Eigen::Vector3d& moment) {
  const SolidVolume of = volume_of(mesh);
  Vector forces(space.count(mesh.nodes.cols()));
  Matrix of_rotations(forces.size(), 3);
  for (Eigen::Index i = 0; i < mesh.nodes.cols(); ++i) {
    const Eigen::Vector3d arm = mesh.nodes.col(i) - of.centroid;
    forces.segment<3>(space.of(i)) = of.weights[i] / of.volume * force;
    for (int k = 0; k < 3; ++k)
      of_rotations.col(k).segment<3>(space.of(i)) = of.weights[i] * Eigen::Vector3d::Unit(k).cross(arm);
  }
  return forces + with_moment(mesh.nodes, of.centroid, of_rotations, moment);
}

Vector thermal_forces(const mesh::SolidMesh& mesh, const element::Mat6& D, double expansion, const Vector& change,
                      const element::SuperElements& solved) {
  Vector forces = Vector::Zero(space.count(mesh.nodes.cols()));
  const element::Vec6 stress = D.leftCols<3>().rowwise().sum() * expansion;
  for (std::size_t c = 0; c < mesh.cells.size(); ++c) {
    const std::vector<int>& cell = mesh.cells[c];
    const Matrix nodes = mesh::nodes_of(mesh, cell);
    const element::SolidSuperElement* of = element::super_element_of(solved, c);
    const Vector of_cell = of ? element::loads_of_stress(nodes, *of, stress, change(cell)).h
                              : element::forces_of_stress(nodes, stress, change(cell));
    add_forces(cell, of_cell.reshaped(3, nodes.cols()), forces);
  }
  return forces;
}

double held_thermal_energy(const mesh::SolidMesh& mesh, const element::Mat6& D, double expansion, const Vector& change,
                           const element::SuperElements& solved) {
  const element::Vec6 stress = D.leftCols<3>().rowwise().sum() * expansion;
  const double of_square = 0.5 * expansion * expansion * D.topLeftCorner<3, 3>().sum();
  double energy = 0.0;
  for (std::size_t c = 0; c < mesh.cells.size(); ++c) {
    const std::vector<int>& cell = mesh.cells[c];
    const Matrix nodes = mesh::nodes_of(mesh, cell);
    if (const element::SolidSuperElement* of = element::super_element_of(solved, c))
      energy += of_square * element::super_element_integral_of_square(nodes, change(cell)) -
                0.5 * element::work_inside(*of, element::loads_of_stress(nodes, *of, stress, change(cell)));
    else
      energy += of_square * element::integral_of_square(nodes, change(cell));
  }
  return energy;
}

std::vector<PairPoints> points_of(const std::vector<mesh::FacetPair>& pairs, std::size_t part_a, std::size_t part_b) {
  std::vector<PairPoints> points;
  for (const mesh::FacetPair& pair : pairs)
    points.push_back({side_of(pair.a, part_a), side_of(pair.b, part_b), pair.directions, pair.gap});
  return points;
}

}  // namespace scabo::system
