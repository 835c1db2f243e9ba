// B A B' of a part whose flexibility is made in groups of degrees of freedom, against that as a whole.
#include "scabo/system/pair_flexibility.hpp"

#include <gtest/gtest.h>

#include "scabo/system/solid_part.hpp"
#include "support/solid_blocks.hpp"

namespace scabo::system {
namespace {

std::vector<std::unique_ptr<BodySystem>> block(const mesh::SolidMesh& mesh) {
  std::vector<Constraint> held;
  for (const int node : test::nodes_at(mesh, 2, 0.0))
    for (int axis = 0; axis < 3; ++axis) held.push_back(held_along_axis(node, axis));
  std::vector<ElasticPart> parts;
  parts.push_back({solid_stiffness(mesh, element::elasticity_in_space(3.0, 0.3)), Positions(mesh.nodes), held});
  return elastic_bodies(std::move(parts), 1);
}

TEST(PairFlexibility, InGroupsIsThatOfTheWhole) {
  const mesh::SolidMesh mesh = test::solid_block({0.0, 0.0, 0.0}, {1.0, 1.0, 1.0}, {2, 2, 1}, 10, 0.2);
  const auto body = block(mesh);
  std::vector<int> dofs;
  for (int node = 0; node < mesh.nodes.cols(); node += 2)  // also some that are held
    for (int axis = 0; axis < 3; ++axis) dofs.push_back(3 * node + axis);
  constexpr int rows = 7;
  Eigen::SparseMatrix<double, Eigen::RowMajor> motion(rows, static_cast<Eigen::Index>(dofs.size()));
  for (int row = 0; row < rows; ++row)
    for (int column = row % 3; column < static_cast<int>(dofs.size()); column += 4 + row)
      motion.insert(row, column) = 1.0 + 0.1 * row - 0.02 * column;
  const Matrix expected = motion * body.front()->flexibility(dofs) * motion.transpose();
  for (const std::size_t most : {std::size_t{1000}, std::size_t{0}}) {
    const Matrix found = pair_flexibility(motion, dofs, *body.front(), most);
    EXPECT_LT((found - expected).lpNorm<Eigen::Infinity>(), 1e-12 * expected.lpNorm<Eigen::Infinity>()) << most;
    EXPECT_EQ(found, Matrix(found.transpose()));
  }
}

}  // namespace
}  // namespace scabo::system
