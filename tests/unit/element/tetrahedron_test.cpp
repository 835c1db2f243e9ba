#include "scabo/element/space/tetrahedron.hpp"

#include <gtest/gtest.h>

#include <Eigen/Geometry>

#include "scabo/base/components.hpp"
#include "scabo/element/space/facet.hpp"
#include "support/decompositions.hpp"
#include "support/solid_blocks.hpp"

namespace scabo::element {
namespace {

constexpr Components in_space{3};

/// One tetrahedron with 4 or 10 nodes; `bent`: middle nodes away from the middles of straight edges.
Matrix nodes_of_tetrahedron(int count, double bent = 0.0) {
  Matrix corners(3, 4);
  corners << 0.1, 1.3, 0.2, 0.4,  //
      -0.2, 0.1, 0.9, 0.3,        //
      0.0, 0.2, -0.1, 1.1;
  Matrix nodes(3, count);
  nodes.leftCols<4>() = corners;
  if (count == 10) {
    int node = 4;
    for (const std::array<int, 2>& edge : geometry::SimplexBasis::of(3, 10).edges()) {
      nodes.col(node) = 0.5 * (corners.col(edge[0]) + corners.col(edge[1]));
      nodes.col(node) += bent * Eigen::Vector3d(0.5 + 0.1 * node, -0.3, 0.7 - 0.1 * node);
      ++node;
    }
  }
  return nodes;
}

/// Displacements with these strains and a rotation.
Vector linear_displacement(const Matrix& nodes, const Vec6& strain, const Eigen::Vector3d& rotation) {
  Eigen::Matrix3d gradient;
  gradient << strain[0], 0.5 * strain[3], 0.5 * strain[5],  //
      0.5 * strain[3], strain[1], 0.5 * strain[4],          //
      0.5 * strain[5], 0.5 * strain[4], strain[2];
  const Matrix u = (gradient * nodes).colwise() + Eigen::Vector3d(1.0, -2.0, 3.0);
  Matrix turned = u;
  for (Eigen::Index i = 0; i < nodes.cols(); ++i) turned.col(i) += rotation.cross(Eigen::Vector3d(nodes.col(i)));
  return turned.reshaped();
}

const Vec6 strain_of_test = (Vec6() << 1.0, -0.5, 0.3, 0.8, -0.2, 0.6).finished();

struct Case {
  int nodes;
  double bent;
};
class Tetrahedra : public testing::TestWithParam<Case> {
 protected:
  const Matrix nodes = nodes_of_tetrahedron(GetParam().nodes, GetParam().bent);
  const Mat6 D = elasticity_in_space(3.0, 0.3);
  const Matrix K = tetrahedron_stiffness(nodes, D);
};

TEST_P(Tetrahedra, HaveSixMotionsWithoutEnergyAndNoMore) {
  const Vector values = test::singular_values(K);
  EXPECT_LT(values.tail<6>().maxCoeff(), 1e-14 * values[0]);
  EXPECT_GT(values[values.size() - 7], 1e-4 * values[0]);
  const Vector rigid = linear_displacement(nodes, Vec6::Zero(), {0.4, -0.7, 0.2});
  EXPECT_LT((K * rigid).lpNorm<Eigen::Infinity>(), 1e-13);
  EXPECT_EQ(K, K.transpose());
}

TEST_P(Tetrahedra, PassThePatchTest) {
  const Vector u = linear_displacement(nodes, strain_of_test, {0.1, 0.2, 0.3});
  const Vec6 stress = D * strain_of_test;
  Vector middle(4);
  middle << 0.1, 0.2, 0.3, 0.4;
  EXPECT_LT((strain_at(nodes, u, middle) - strain_of_test).lpNorm<Eigen::Infinity>(), 1e-14);

  // Tractions stress . normal on the four facets.
  Eigen::Matrix3d tensor;
  tensor << stress[0], stress[3], stress[5], stress[3], stress[1], stress[4], stress[5], stress[4], stress[2];
  mesh::SolidMesh mesh{nodes, {std::vector<int>(static_cast<std::size_t>(nodes.cols()))}};
  for (std::size_t i = 0; i < mesh.cells[0].size(); ++i) mesh.cells[0][i] = static_cast<int>(i);
  Vector forces = Vector::Zero(in_space.count(nodes.cols()));
  for (const mesh::SolidFacet& facet : mesh::boundary_facets(mesh)) {
    const Matrix on_facet = tensor * normal_weights(mesh::nodes_of(mesh, facet));
    for (std::size_t i = 0; i < facet.size(); ++i)
      forces.segment<3>(in_space.of(facet[i])) += on_facet.col(static_cast<Eigen::Index>(i));
  }
  const double tolerance = GetParam().bent == 0.0 ? 1e-14 : 1e-2;  // of curved facets only the sums are exact
  EXPECT_LT((K * u - forces).lpNorm<Eigen::Infinity>(), tolerance);
  for (int k = 0; k < 3; ++k) {
    double sum = 0.0;
    for (Eigen::Index i = 0; i < nodes.cols(); ++i) sum += forces[in_space.of(i, k)];
    EXPECT_NEAR(sum, 0.0, 1e-15);
  }
}

TEST_P(Tetrahedra, WeightsAddUpToTheVolume) {
  double of_facets = 0.0;  // 1/3 int x . n dA, for straight edges
  mesh::SolidMesh mesh{nodes, {std::vector<int>(static_cast<std::size_t>(nodes.cols()))}};
  for (std::size_t i = 0; i < mesh.cells[0].size(); ++i) mesh.cells[0][i] = static_cast<int>(i);
  for (const mesh::SolidFacet& facet : mesh::boundary_facets(mesh)) {
    const Matrix x = mesh::nodes_of(mesh, facet);
    of_facets += x.cwiseProduct(normal_weights(x)).sum() / 3.0;
  }
  EXPECT_NEAR(volume_weights(nodes).sum(), of_facets, GetParam().bent == 0.0 ? 1e-15 : 1e-3);
  EXPECT_GT(least_jacobian(nodes), 0.01);
}

INSTANTIATE_TEST_SUITE_P(All, Tetrahedra, testing::Values(Case{4, 0.0}, Case{10, 0.0}, Case{10, 0.03}));

TEST(Tetrahedron, FoldedByAMiddleNodeOrTurnedOverIsNoticed) {
  Matrix nodes = nodes_of_tetrahedron(10);
  nodes.col(4) = nodes.col(0) + 0.2 * (nodes.col(1) - nodes.col(0));  // beyond a quarter of the edge
  EXPECT_LT(least_jacobian(nodes), 0.0);
  nodes = nodes_of_tetrahedron(4);
  nodes.col(0).swap(nodes.col(1));
  EXPECT_LT(least_jacobian(nodes), 0.0);
}

/// Forces that belong to a constant stress balance at the nodes inside a mesh of curved elements, as its edges are
/// shared: this is why the rule has degree 3.
TEST(CurvedTetrahedra, PassThePatchTestTogether) {
  mesh::SolidMesh mesh = test::solid_block({0, 0, 0}, {1, 1, 1}, {2, 2, 2}, 10, 0.1);
  for (Eigen::Index i = 0; i < mesh.nodes.cols(); ++i) {  // x + a sin: bends all edges inside, none on the faces
    Eigen::Vector3d x = mesh.nodes.col(i);
    const double inside = x.x() * (1 - x.x()) * x.y() * (1 - x.y()) * x.z() * (1 - x.z());
    mesh.nodes.col(i) += inside * Eigen::Vector3d(1.0, -2.0, 1.5);
  }
  const Mat6 D = elasticity_in_space(3.0, 0.3);
  const Vector u = linear_displacement(mesh.nodes, strain_of_test, Eigen::Vector3d::Zero());
  Vector forces = Vector::Zero(u.size());
  std::vector<int> dofs;
  for (const std::vector<int>& cell : mesh.cells) {
    const Matrix x = mesh::nodes_of(mesh, cell);
    ASSERT_GT(least_jacobian(x), 0.0);
    Vector u_cell(in_space.count(cell.size()));
    for (std::size_t i = 0; i < cell.size(); ++i)
      u_cell.segment<3>(in_space.of(i)) = u.segment<3>(in_space.of(cell[i]));
    const Vector of_cell = tetrahedron_stiffness(x, D) * u_cell;
    for (std::size_t i = 0; i < cell.size(); ++i)
      forces.segment<3>(in_space.of(cell[i])) += of_cell.segment<3>(in_space.of(i));
  }
  int inner = 0;
  for (Eigen::Index i = 0; i < mesh.nodes.cols(); ++i) {
    const Eigen::Vector3d x = mesh.nodes.col(i);
    if (std::min(x.minCoeff(), 1.0 - x.maxCoeff()) < 1e-9) continue;
    ++inner;
    EXPECT_LT(forces.segment<3>(in_space.of(i)).lpNorm<Eigen::Infinity>(), 1e-14);
  }
  EXPECT_EQ(inner, 27);
}

TEST(Facets, TractionAndPressureHaveTheirResultants) {
  Matrix x(3, 6);
  x << 0, 1, 0, 0.5, 0.5, 0,  //
      0, 0, 1, 0, 0.5, 0.5,   //
      2, 2, 2, 2, 2, 2;
  Vector expected(6);
  expected << 0, 0, 0, 1, 1, 1;
  EXPECT_LT((area_weights(x) - expected / 6.0).lpNorm<Eigen::Infinity>(), 1e-15);
  Matrix normals = Matrix::Zero(3, 6);
  normals.row(2) = expected.transpose() / 6.0;
  EXPECT_LT((normal_weights(x) - normals).lpNorm<Eigen::Infinity>(), 1e-15);
}

}  // namespace
}  // namespace scabo::element
