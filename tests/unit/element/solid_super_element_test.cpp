// Hexahedra and wedges as super-elements, where closed forms give the answer.
#include "scabo/element/space/solid_super_element.hpp"

#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <random>
#include <set>

#include "scabo/base/cell_topology.hpp"
#include "scabo/element/sbfem/ill_posed.hpp"
#include "scabo/element/space/facet.hpp"
#include "scabo/element/space/solid_cell.hpp"
#include "support/decompositions.hpp"
#include "support/random.hpp"
#include "support/solid_blocks.hpp"

namespace scabo::element {
namespace {

/// A unit cube or half of one with straight edges, corners moved at random, turned, away from the origin.
Matrix nodes_of_cell(int count, double moved) {
  const mesh::SolidMesh block = test::solid_block({0, 0, 0}, {1, 1, 1}, {1, 1, 1}, count);
  const auto& topology = CellTopology::of(static_cast<std::size_t>(count));
  Matrix nodes = mesh::nodes_of(block, block.cells.front());
  const auto corners = static_cast<Eigen::Index>(topology.corners);
  std::mt19937 random(5);
  nodes.leftCols(corners) =
      nodes.leftCols(corners).unaryExpr([&](double x) { return x + test::uniform(random, -moved, moved); });
  nodes = (Eigen::AngleAxisd(0.8, Eigen::Vector3d(1, -2, 3).normalized()).toRotationMatrix() * nodes).eval();
  for (std::size_t e = 0; e < topology.edges.size(); ++e)
    nodes.col(corners + static_cast<Eigen::Index>(e)) =
        0.5 * (nodes.col(static_cast<Eigen::Index>(topology.edges[e][0])) +
               nodes.col(static_cast<Eigen::Index>(topology.edges[e][1])));
  return nodes.colwise() + Eigen::Vector3d(3, -2, 1);
}

const Vec6 strain_of_cell = (Vec6() << 1.0, -0.5, 0.3, 0.8, -0.2, 0.6).finished();

Eigen::Matrix3d gradient_of_test() {
  Eigen::Matrix3d gradient;
  gradient << 1.0, 0.4, 0.3, 0.4, -0.5, -0.1, 0.3, -0.1, 0.3;  // of strain_of_cell
  return gradient;
}

struct CellCase {
  int nodes;
  double moved, poisson;
};
class CellsAsSuperElements : public testing::TestWithParam<CellCase> {
 protected:
  const Matrix nodes = nodes_of_cell(GetParam().nodes, GetParam().moved);
  const Mat6 D = elasticity_in_space(3.0, GetParam().poisson);
  const SolidSuperElement cell{nodes, D};
  const Eigen::Vector3d inside =
      nodes.leftCols(static_cast<Eigen::Index>(CellTopology::of(static_cast<std::size_t>(GetParam().nodes)).corners))
          .rowwise()
          .mean() +
      Eigen::Vector3d(0.1, 0.05, -0.15);
  const double rounding = 1e-11 * D(0, 0) / 3.0;  // of strains: those of pressures, which D multiplies
};

TEST_P(CellsAsSuperElements, HaveSixRigidMotionsAndNoOther) {
  EXPECT_LT(cell.solution().residual, 1e-12);
  const Vector values = test::symmetric_eigenvalues(cell.K());
  EXPECT_LT(values.head(6).cwiseAbs().maxCoeff(), 1e-13 * values.tail(1)[0]);
  EXPECT_GT(values[6], 1e-3);
  EXPECT_EQ(cell.modes().exponents.front(), 0.0);
  int ones = 0;  // the rotations and constant strains
  for (const auto& exponent : cell.modes().exponents) ones += std::abs(exponent - 1.0) < 1e-6;
  EXPECT_EQ(ones, 9);
}

TEST_P(CellsAsSuperElements, HoldAConstantStrainExactly) {
  const Vector u = ((gradient_of_test() * nodes).colwise() + Eigen::Vector3d(5, 6, 7)).reshaped();
  EXPECT_NEAR(u.dot(cell.K() * u) / (strain_of_cell.dot(D * strain_of_cell) * cell_volume_weights(nodes).sum()), 1.0,
              1e-11);
  EXPECT_LT((strains_at_nodes(nodes, cell, u).colwise() - strain_of_cell).cwiseAbs().maxCoeff(), rounding);
  const auto place = place_in_super_element(nodes, inside, 1e-6);
  ASSERT_TRUE(place);
  const SolidInterior interior(nodes, cell, u);
  EXPECT_LT((interior.strain_at(*place) - strain_of_cell).norm(), rounding);
  EXPECT_LT((interior.displacement_at(*place) - gradient_of_test() * inside - Eigen::Vector3d(5, 6, 7)).norm(),
            rounding);
  EXPECT_FALSE(place_in_super_element(nodes, inside + Eigen::Vector3d(2, 0, 0), 1e-6));
}

/// The forces of a constant stress at the nodes are those on the facets.
TEST_P(CellsAsSuperElements, AreInBalanceWithTheTractionsOfAConstantStress) {
  const Eigen::Matrix3d stress = [&] {
    const Vec6 s = D * strain_of_cell;
    Eigen::Matrix3d tensor;
    tensor << s[0], s[3], s[5], s[3], s[1], s[4], s[5], s[4], s[2];
    return tensor;
  }();
  Matrix forces = Matrix::Zero(3, nodes.cols());
  const auto& topology = CellTopology::of(static_cast<std::size_t>(nodes.cols()));
  for (std::size_t side = 0; side < topology.sides.size(); ++side) {
    const std::vector<std::size_t> of_side = topology.nodes_of_side(side, true);
    const std::vector<Eigen::Index> at(of_side.begin(), of_side.end());
    forces(Eigen::all, at) += stress * normal_weights(nodes(Eigen::all, at));
  }
  const Vector u = (gradient_of_test() * nodes).reshaped();
  EXPECT_LT((cell.K() * u - forces.reshaped()).lpNorm<Eigen::Infinity>(), 1e-11 * forces.cwiseAbs().maxCoeff());
}

TEST_P(CellsAsSuperElements, CarryTheirWeightAndTheMomentOfIt) {
  const Eigen::Vector3d weight(0.3, -0.2, -2.0);
  const Matrix h = loads_of_volume_force(nodes, cell, weight).h.reshaped(3, nodes.cols());
  const Vector weights = cell_volume_weights(nodes);
  EXPECT_LT((h.rowwise().sum() - weights.sum() * weight).norm(), 1e-12);
  Eigen::Vector3d moment = Eigen::Vector3d::Zero();
  for (Eigen::Index i = 0; i < nodes.cols(); ++i)
    moment += Eigen::Vector3d(nodes.col(i)).cross(Eigen::Vector3d(h.col(i)));
  EXPECT_LT((moment - Eigen::Vector3d(nodes * weights).cross(weight)).norm(), 1e-11);
}

INSTANTIATE_TEST_SUITE_P(Cells, CellsAsSuperElements,
                         testing::Values(CellCase{20, 0.0, 0.3}, CellCase{20, 0.15, 0.3}, CellCase{20, 0.15, 0.49999},
                                         CellCase{20, 0.15, 0.0}, CellCase{15, 0.0, 0.3}, CellCase{15, 0.15, 0.3},
                                         CellCase{15, 0.15, 0.49999}));

/// A temperature that is linear in the coordinates bends a free body of parallel sides without any stress: the
/// quadratic displacements are exact at nodes and inside, which they are by the load inside the cell.
TEST(BricksAndPrisms, ExpandWithoutStressUnderALinearTemperature) {
  constexpr double expansion = 1e-2;
  for (const int count : {20, 15}) {
    const Matrix nodes = nodes_of_cell(count, 0.0);
    const Mat6 D = elasticity_in_space(3.0, 0.3);
    const SolidSuperElement cell(nodes, D);
    const Eigen::Vector3d slope(1.0, 2.0, -0.5);
    const auto displacement = [&](const Eigen::Vector3d& x) -> Eigen::Vector3d {
      return expansion * (0.7 * x + slope.dot(x) * x - 0.5 * x.squaredNorm() * slope);
    };
    Vector u(3 * nodes.cols());
    for (Eigen::Index i = 0; i < nodes.cols(); ++i) u.segment<3>(3 * i) = displacement(nodes.col(i));
    const Vector T = (nodes.transpose() * slope).array() + 0.7;
    const Vec6 stress = expansion * D.leftCols<3>().rowwise().sum();
    const SolidCellLoads loads = loads_of_stress(nodes, cell, stress, T);
    EXPECT_LT((cell.K() * u - loads.h).norm(), 1e-13 * loads.h.norm());
    Matrix expected = Matrix::Zero(6, nodes.cols());
    expected.topRows(3).rowwise() = expansion * T.transpose();
    EXPECT_LT((strains_at_nodes(nodes, cell, u, loads) - expected).cwiseAbs().maxCoeff(), 1e-13);
    const Eigen::Vector3d x = nodes.leftCols(count == 20 ? 8 : 6).rowwise().mean() + Eigen::Vector3d(0.1, -0.05, 0.1);
    const auto place = place_in_super_element(nodes, x, 1e-6);
    ASSERT_TRUE(place);
    const SolidInterior interior(nodes, cell, u, loads);
    Vec6 there = Vec6::Zero();
    there.head<3>().setConstant(expansion * (0.7 + slope.dot(x)));
    EXPECT_LT((interior.strain_at(*place) - there).norm(), 1e-12);
    EXPECT_LT((interior.displacement_at(*place) - displacement(x)).norm(), 1e-12);
    const double held =
        0.5 * expansion * expansion * D.topLeftCorner<3, 3>().sum() * super_element_integral_of_square(nodes, T);
    EXPECT_NEAR(0.5 * u.dot(cell.K() * u) - u.dot(loads.h) + held - 0.5 * work_inside(cell, loads), 0.0, 1e-12 * held);
  }
}

/// Between the values of xi at which the modes are computed.
TEST(FieldsInside, AreThoseOfTheModes) {
  const Matrix nodes = nodes_of_cell(20, 0.15);
  const SolidSuperElement cell(nodes, elasticity_in_space(1.0, 0.3));
  std::mt19937 random(7);
  const Vector u = Vector::NullaryExpr(60, [&] { return test::uniform(random, -1.0, 1.0); });
  const RadialField field(cell.solution(), cell.modes(), u);
  const SolidInterior interior(nodes, cell, u);
  for (const double xi : {0.05, 0.3, 0.65, 0.97}) {
    const PyramidPlace corner{0, xi * Eigen::Vector3d(-1, -1, 1)};  // the ray through node 0
    EXPECT_LT((interior.displacement_at(corner) - field.at(xi).u.head<3>()).norm(), 2e-4 * u.norm());
  }
}

TEST(CellsThatCannotBeSolved, SayWhy) {
  Matrix nodes = nodes_of_cell(20, 0.0);
  EXPECT_GT(least_visibility(nodes), 0.5);
  nodes.col(0) += 1.2 * (nodes.col(6) - nodes.col(0));
  EXPECT_LT(least_visibility(nodes), 0.0);
  EXPECT_THROW(SolidSuperElement(nodes, elasticity_in_space(1.0, 0.3)), IllPosed);
}

/// Those of a grid are one, wherever it is.
TEST(EqualSuperElements, AreSolvedOnce) {
  mesh::SolidMesh block = test::solid_block({0.1, 0.2, 0.3}, {1.3, 1.1, 0.9}, {3, 3, 2}, 20);
  block.nodes.colwise() += Eigen::Vector3d(3.0, -2.0, 1.0);
  const SuperElements solved = solve_super_elements(block, elasticity_in_space(1.0, 0.3));
  std::set<const SolidSuperElement*> distinct;
  for (const auto& cell : solved) distinct.insert(cell.get());
  EXPECT_LE(distinct.size(), 3);
}

}  // namespace
}  // namespace scabo::element
