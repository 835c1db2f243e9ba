#include "scabo/system/solid_edges.hpp"

#include "scabo/base/components.hpp"
#include "scabo/element/space/edge.hpp"

namespace scabo::system {

namespace {

constexpr Components of_edges{3};

Eigen::Matrix3d nodes_of_edge(const mesh::SolidMesh& mesh, const mesh::SolidEdge& edge) {
  return mesh.nodes(Eigen::all, edge);
}

}  // namespace

Vector length_weights_of(const mesh::SolidMesh& mesh, const std::vector<mesh::SolidEdge>& edges) {
  Vector weights = Vector::Zero(mesh.nodes.cols());
  for (const mesh::SolidEdge& edge : edges) weights(edge) += element::length_weights(nodes_of_edge(mesh, edge));
  return weights;
}

double length_of_edges(const mesh::SolidMesh& mesh, const std::vector<mesh::SolidEdge>& edges) {
  double length = 0.0;
  for (const mesh::SolidEdge& edge : edges) length += element::length_weights(nodes_of_edge(mesh, edge)).sum();
  return length;
}

Vector line_load_forces(const mesh::SolidMesh& mesh, const std::vector<mesh::SolidEdge>& edges,
                        const std::function<Eigen::Vector3d(const Eigen::Vector3d&)>& load) {
  Vector forces = Vector::Zero(of_edges.count(mesh.nodes.cols()));
  for (const mesh::SolidEdge& edge : edges) {
    const Eigen::Matrix3d of_edge = element::line_load_integrals(nodes_of_edge(mesh, edge), load);
    for (std::size_t i = 0; i < edge.size(); ++i)
      forces.segment<3>(of_edges.of(edge[i])) += of_edge.col(static_cast<Eigen::Index>(i));
  }
  return forces;
}

SolidSpring springs_on_edges(const mesh::SolidMesh& mesh, const std::vector<mesh::SolidEdge>& edges,
                             const Eigen::Vector3d& k) {
  std::vector<Eigen::Triplet<double>> entries;
  for (const mesh::SolidEdge& edge : edges) {
    const Eigen::Matrix3d mass = element::length_mass(nodes_of_edge(mesh, edge));
    for (int i = 0; i < 3; ++i)
      for (int j = 0; j < 3; ++j)
        for (int axis = 0; axis < 3; ++axis)
          if (k[axis] > 0.0)
            entries.emplace_back(static_cast<int>(of_edges.of(edge[static_cast<std::size_t>(i)], axis)),
                                 static_cast<int>(of_edges.of(edge[static_cast<std::size_t>(j)], axis)),
                                 k[axis] * mass(i, j));
  }
  const Eigen::Index size = of_edges.count(mesh.nodes.cols());
  SolidSpring spring{linalg::SparseMatrix(size, size)};
  spring.on_nodes.setFromTriplets(entries.begin(), entries.end());
  return spring;
}

}  // namespace scabo::system
