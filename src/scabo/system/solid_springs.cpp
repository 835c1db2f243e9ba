#include "scabo/system/solid_springs.hpp"

#include "scabo/element/space/facet.hpp"
#include "scabo/system/solid_part.hpp"

namespace scabo::system {

namespace {

constexpr Components of_nodes{3};

linalg::SparseMatrix springs_matrix(const mesh::SolidMesh& mesh, const std::vector<Eigen::Triplet<double>>& entries) {
  const Eigen::Index size = of_nodes.count(mesh.nodes.cols());
  linalg::SparseMatrix S(size, size);
  S.setFromTriplets(entries.begin(), entries.end());
  return S;
}

}  // namespace

Matrix SolidSpring::times(const Matrix& u) const {
  Matrix forces = on_nodes * u;
  if (along.size() > 0) forces += along * (stiffness.asDiagonal() * (along.transpose() * u));
  return forces;
}

SolidSpring springs_on_facets(const mesh::SolidMesh& mesh, const std::vector<mesh::SolidFacet>& facets, double k_n,
                              double k_t) {
  std::vector<Eigen::Triplet<double>> entries;
  for (const mesh::SolidFacet& facet : facets) {
    const Matrix K = element::spring_integrals(mesh::nodes_of(mesh, facet), k_n, k_t);
    const auto place = [&](Eigen::Index i) {
      return static_cast<int>(
          of_nodes.of(facet[static_cast<std::size_t>(of_nodes.node_of(i))], of_nodes.component_of(i)));
    };
    for (Eigen::Index i = 0; i < K.rows(); ++i)
      for (Eigen::Index j = 0; j < K.cols(); ++j)
        if (K(i, j) != 0.0) entries.emplace_back(place(i), place(j), K(i, j));
  }
  return {springs_matrix(mesh, entries)};
}

SolidSpring springs_at_nodes(const mesh::SolidMesh& mesh, const std::vector<int>& nodes, const Eigen::Vector3d& k) {
  std::vector<Eigen::Triplet<double>> entries;
  for (const int node : nodes)
    for (int axis = 0; axis < 3; ++axis) {
      const auto dof = static_cast<int>(of_nodes.of(node, axis));
      if (k[axis] > 0.0) entries.emplace_back(dof, dof, k[axis]);
    }
  return {springs_matrix(mesh, entries)};
}

SolidSpring springs_at_centroid(const mesh::SolidMesh& mesh, const Eigen::Vector3d& k) {
  SolidSpring spring{springs_matrix(mesh, {}), Matrix(of_nodes.count(mesh.nodes.cols()), 3), k};
  for (int axis = 0; axis < 3; ++axis)
    spring.along.col(axis) = forces_on_rigid(mesh, Eigen::Vector3d::Unit(axis), Eigen::Vector3d::Zero());
  return spring;
}

}  // namespace scabo::system
