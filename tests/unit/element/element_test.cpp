// Elasticity, coefficient matrices, symmetry blocks.
#include <gtest/gtest.h>

#include <Eigen/LU>

#include "scabo/element/plane/elasticity.hpp"
#include "scabo/element/plane/mirror_symmetry.hpp"
#include "scabo/element/sbfem/ill_posed.hpp"
#include "theory/rings.hpp"

namespace scabo::element {
namespace {

using namespace test;

// D^-1 in terms of E and nu; plane strain is plane stress with E/(1 - nu^2) and nu/(1 - nu).
TEST(Elasticity, InvertsHookesLaw) {
  const double E = 210e9, nu = 0.3;
  Mat3 compliance;
  compliance << 1, -nu, 0, -nu, 1, 0, 0, 0, 2 * (1 + nu);
  EXPECT_LT(largest(elasticity(E, nu) * compliance / E - Mat3::Identity()), 1e-15);
  const Mat3 strain = elasticity(E, nu, model::Plane::strain),
             equivalent = elasticity(E / (1 - nu * nu), nu / (1 - nu));
  EXPECT_LT(largest(strain - equivalent), 1e-15 * E);
  model::Material material;
  material.young = E;
  material.poisson = nu;
  EXPECT_DOUBLE_EQ(stress_zz({3.0, 4.0, 9.0}, material, model::Plane::strain), 2.1);
  EXPECT_EQ(stress_zz({3.0, 4.0, 9.0}, material, model::Plane::stress), 0.0);
}

TEST(CoefficientMatrices, TranslationsCarryNoForceAndE0AndE2AreSymmetric) {
  std::mt19937 random(3);
  for (int k = 0; k < 20; ++k) {
    const Ring ring = polygon_ring(random_star(random), 2, 1 + k % 4);
    const CoefficientMatrices matrices = coefficient_matrices(ring, elasticity(1.0, 0.3), 0.5);
    Matrix R(matrices.E0.rows(), 2);
    R.col(0) = at_nodes(ring.nodes, [](const Vec2&) { return Vec2(1, 0); });
    R.col(1) = at_nodes(ring.nodes, [](const Vec2&) { return Vec2(0, 1); });
    const double size = largest(Matrix(matrices.E2));
    EXPECT_LT(largest(matrices.E1.transpose() * R), 1e-13 * size);
    EXPECT_LT(largest(matrices.E2 * R), 1e-13 * size);
    EXPECT_EQ(Matrix(matrices.E0), Matrix(matrices.E0.transpose()));
    EXPECT_EQ(Matrix(matrices.E2), Matrix(matrices.E2.transpose()));
  }
}

TEST(CoefficientMatrices, RefuseABoundaryThatTheCentreDoesNotSee) {
  Ring ring = polygon_ring(rectangle(2, 2), 1, 1);
  for (Vec2& node : ring.nodes) node += Vec2(3.0, 0.0);
  EXPECT_THROW(coefficient_matrices(ring, elasticity(1.0, 0.3), 1.0), IllPosed);
}

TEST(SymmetryBlocks, AreAnOrthonormalBasisThatSplitsTheMatrices) {
  for (const Ring& ring :
       {rectangle_ring(6, 1.5, 4, 1, 2), polygon_ring(rectangle(1, 1), 3, 1),
        polygon_ring(regular_polygon(5, 1, 0.7), 1, 2), polygon_ring({{-1, -1}, {2, 0}, {0, 1}}, 2, 2)}) {
    const auto blocks = symmetry_blocks(ring, elasticity(1.0, 0.3));
    const auto n = static_cast<Eigen::Index>(2 * ring.nodes.size());
    Matrix T(n, 0);
    for (const auto& block : blocks) {
      T.conservativeResize(n, T.cols() + block.cols());
      T.rightCols(block.cols()) = Matrix(block);
    }
    ASSERT_EQ(T.cols(), n);
    EXPECT_LT(largest(T.transpose() * T - Matrix::Identity(n, n)), 1e-14);
    const CoefficientMatrices matrices = coefficient_matrices(ring, elasticity(1.0, 0.3), 1.0);
    for (std::size_t i = 0; i < blocks.size(); ++i)
      for (std::size_t j = 0; j < blocks.size(); ++j) {
        if (i == j) continue;
        for (const auto* E : {&matrices.E0, &matrices.E1, &matrices.E2})
          EXPECT_LT(largest(Matrix(blocks[i].transpose() * *E * blocks[j])), 1e-13 * largest(Matrix(*E)));
      }
  }
}

// The only mirror line maps the first node to the opposite one: the line through both is none, by the shape or by the
// materials.
TEST(SymmetryBlocks, FindTheLineAcrossTheFirstNode) {
  const Ring tall = polygon_ring({{-1, 0}, {-1, -1}, {1, -1}, {1, 0}, {1, 2}, {-1, 2}}, 2, 1),
             square = polygon_ring({{-1, 0}, {-1, -1}, {1, -1}, {1, 0}, {1, 1}, {-1, 1}}, 2, 1);
  const Mat3 soft = elasticity(1.0, 0.3);
  EXPECT_EQ(symmetry_blocks(tall, soft).size(), 2u);
  EXPECT_EQ(symmetry_blocks(square, soft).size(), 4u);
  std::vector<Mat3> of_elements;
  for (std::size_t e = 0; e < square.elements.size(); ++e)
    of_elements.push_back((e < square.elements.size() / 2 ? 10.0 : 1.0) * soft);
  EXPECT_EQ(symmetry_blocks(square, of_elements).size(), 2u);
}

// A mirror line of the nodes that is not one of the elements is none of the body.
TEST(SymmetryBlocks, LookAtElementsToo) {
  Ring ring = polygon_ring(rectangle(2, 2), 4, 1);  // 16 nodes; elements of order 2 and 1 on them, not mirrored
  ring.elements.clear();
  for (int at = 0; at < 16;) {
    const int order = at == 0 ? 2 : 1;
    mesh::LineElement element;
    for (int k = 0; k <= order; ++k) element.nodes.push_back((at + k) % 16);
    ring.elements.push_back(element);
    at += order;
  }
  EXPECT_EQ(symmetry_blocks(ring, elasticity(1.0, 0.3)).size(), 1u);
}

}  // namespace
}  // namespace scabo::element
