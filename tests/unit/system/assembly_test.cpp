// Assembly against a plain sum of triplets in the order of the cells, and on several threads.
#include "scabo/system/assembly.hpp"

#include <gtest/gtest.h>

#include "scabo/element/plane/finite_element.hpp"
#include "unit/mesh/models.hpp"

namespace scabo::system {
namespace {

using namespace test;

/// Two bodies side by side, one of finite elements and one of super-elements; each has more nodes than one thread
/// assembles at a time.
model::Model side_by_side() {
  model::Model model;
  model.file = "model.yaml";
  model.analysis.thickness = 0.5;
  model.materials.resize(1);
  model.materials[0].name = "steel";
  model.materials[0].young = 10e9;
  model.materials[0].poisson = 0.3;
  for (const model::MeshKind kind : {model::MeshKind::fem, model::MeshKind::quadtree}) {
    const double left = kind == model::MeshKind::fem ? 0.0 : 1.0;
    model::Body body = elastic(kind == model::MeshKind::fem ? "a" : "b", rectangle({left, 0.0}, {1.0, 1.0}), 1.0 / 64);
    body.mesh.kind = kind;
    body.mesh.refine = {};
    body.material = 0;
    model.bodies.push_back(body);
  }
  return model;
}

linalg::SparseMatrix plain_sum(const model::Model& model, const mesh::BodyMesh& mesh,
                               const element::SolvedCells& cells) {
  std::vector<Eigen::Triplet<double>> entries;
  for (std::size_t c = 0; c < cells.size(); ++c) {
    const mesh::Cell& cell = mesh.cells[c];
    std::vector<int> nodes;
    Matrix K;
    if (cells[c]) {
      nodes = cell.nodes();
      K = cells[c]->K();
    } else {
      const auto finite = element::finite_element_of(cell, mesh.nodes);
      nodes.assign(finite.nodes().begin(), finite.nodes().end());
      K = element::finite_element_stiffness(
          finite, element::elasticity_matrix(model.materials[0], model.analysis.plane), model.analysis.thickness);
    }
    const auto dof = [&](Eigen::Index i) {
      return 2 * nodes[static_cast<std::size_t>(i / 2)] + static_cast<int>(i % 2);
    };
    for (Eigen::Index j = 0; j < K.cols(); ++j)
      for (Eigen::Index i = 0; i < K.rows(); ++i) entries.emplace_back(dof(i), dof(j), K(i, j));
  }
  const auto n = static_cast<Eigen::Index>(2 * mesh.nodes.size());
  linalg::SparseMatrix sum(n, n);
  sum.setFromTriplets(entries.begin(), entries.end());
  return sum;
}

void expect_same_bits(const linalg::SparseMatrix& a, const linalg::SparseMatrix& b) {
  ASSERT_EQ(a.rows(), b.rows());
  ASSERT_EQ(a.nonZeros(), b.nonZeros());
  EXPECT_TRUE(std::equal(a.outerIndexPtr(), a.outerIndexPtr() + a.cols() + 1, b.outerIndexPtr()));
  EXPECT_TRUE(std::equal(a.innerIndexPtr(), a.innerIndexPtr() + a.nonZeros(), b.innerIndexPtr()));
  EXPECT_TRUE(std::equal(a.valuePtr(), a.valuePtr() + a.nonZeros(), b.valuePtr()));
}

TEST(Assembly, IsTheSumInTheOrderOfCellsOnAnyNumberOfThreads) {
  const model::Model model = side_by_side();
  const mesh::Mesh mesh = mesh::make_mesh(model);
  const auto cells = element::solve_cells(model, mesh, 1);
  for (std::size_t b = 0; b < 2; ++b) {
    ASSERT_GT(mesh.bodies[b].nodes.size(), 8192u);
    const linalg::SparseMatrix expected = plain_sum(model, mesh.bodies[b], cells[b]);
    for (const int threads : {1, 2, 5})
      expect_same_bits(body_stiffness(model, model.analysis.thickness, mesh.bodies[b], cells[b], threads).sparse,
                       expected);
  }
}

}  // namespace
}  // namespace scabo::system
