// Many cells are solved in batches, few of them alone: both give the same stiffness, and fields when they are needed.
#include "scabo/element/cell_library.hpp"

#include <gtest/gtest.h>

#include <set>

#include "scabo/element/plane/stiffness.hpp"
#include "scabo/element/sbfem/ill_posed.hpp"
#include "theory/rings.hpp"
#include "unit/mesh/models.hpp"

namespace scabo::element {
namespace {

/// `count` distinct triangles, quadrilaterals, ... of one body, each scaled by another factor.
struct Cells {
  model::Model model;
  mesh::Mesh mesh;
};

Cells distinct_cells(int count) {
  Cells made;
  made.model.materials.emplace_back();
  made.model.materials.front().young = 200e9;
  made.model.materials.front().poisson = 0.3;
  made.model.bodies = {test::elastic("plate", test::rectangle({0, 0}, {1, 1}), 0.5, 1)};
  mesh::BodyMesh body;
  for (int c = 0; c < count; ++c) {
    mesh::Cell cell;
    cell.centre = Vec2(3.0 * c, 1.0);
    cell.materials = {0};
    const int corners = 3 + c % 5, first = static_cast<int>(body.nodes.size());
    for (int i = 0; i < corners; ++i) {
      const double angle = 2.0 * test::pi * i / corners + 0.01 * c;
      body.nodes.push_back(cell.centre + (1.0 + 0.1 * (i % 2)) * Vec2(std::cos(angle), std::sin(angle)));
      cell.boundary.push_back({{first + i, first + (i + 1) % corners}});
    }
    body.cells.push_back(cell);
  }
  made.mesh.bodies = {body};
  return made;
}

double largest(const Matrix& A) { return A.cwiseAbs().maxCoeff(); }

TEST(CellLibrary, ManyCellsHaveTheStiffnessThatEachHasAlone) {
  const Cells many = distinct_cells(4200);
  const SolvedCells solved = solve_cells(many.model, many.mesh, 2).front();
  ASSERT_EQ(solved.size(), 4200U);
  EXPECT_EQ(std::set(solved.begin(), solved.end()).size(), 4200U);
  for (std::size_t c = 0; c < solved.size(); c += 13) {  // every kind of polygon
    const auto& cell = solved[c];
    const SuperElementSolution alone = solve_super_element(cell->ring, cell->sectors.D, cell->thickness);
    EXPECT_LT(largest(cell->K() - alone.K), 1e-13 * largest(alone.K));
    EXPECT_EQ(cell->K(), Matrix(cell->K().transpose()));
    EXPECT_NEAR(cell->rounding() / alone.rounding, 1.0, 1e-6);
    EXPECT_EQ(cell->solution().K, alone.K);  // for fields
    EXPECT_EQ(cell->modes().exponents.size(), static_cast<std::size_t>(alone.K.rows()));
  }
}

TEST(CellLibrary, OnlyCellsThatHaveChangedAreSolvedAnew) {
  Cells cells = distinct_cells(12);
  const std::vector<SolvedCells> before = solve_cells(cells.model, cells.mesh, 1);
  std::vector<Vec2>& nodes = cells.mesh.bodies[0].nodes;
  for (const int node : cells.mesh.bodies[0].cells[7].nodes()) nodes[static_cast<std::size_t>(node)] *= 1.0 + 1e-15;
  const SolvedCells anew = solve_cells(cells.model, cells.mesh, 1, {}, before).front(),
                    alone = solve_cells(cells.model, cells.mesh, 1).front();
  for (std::size_t c = 0; c < anew.size(); ++c) {
    EXPECT_EQ(anew[c] == before.front()[c], c != 7) << c;
    EXPECT_EQ(anew[c]->K(), alone[c]->K()) << c;  // also its last bits
  }
}

// A rotation is free of force to rounding, not only to what a batch leaves of it (1e-12).
TEST(CellLibrary, CellsOfABatchLetARotationFree) {
  const Cells many = distinct_cells(4200);
  const SolvedCells solved = solve_cells(many.model, many.mesh, 1).front();
  for (const auto& cell : solved) {
    Vector r(2 * static_cast<Eigen::Index>(cell->ring.nodes.size()));
    for (std::size_t i = 0; i < cell->ring.nodes.size(); ++i)
      r.segment<2>(static_cast<Eigen::Index>(2 * i)) = Vec2(-cell->ring.nodes[i].y(), cell->ring.nodes[i].x());
    EXPECT_LT((cell->K() * r).norm(), 3e-15 * cell->K().norm() * r.norm());
  }
}

// The one that cannot be solved is named by its body, as where few are solved.
TEST(CellLibrary, ACellThatCannotBeSolvedIsAnErrorOfItsBody) {
  Cells many = distinct_cells(4200);
  for (const int node : many.mesh.bodies[0].cells[137].nodes())
    many.mesh.bodies[0].nodes[static_cast<std::size_t>(node)] += Vec2(5.0, 0.0);  // its centre lies outside
  try {
    solve_cells(many.model, many.mesh, 2);
    FAIL() << "nothing was thrown";
  } catch (const InputError& error) {
    EXPECT_NE(std::string(error.what()).find("not entirely visible"), std::string::npos) << error.what();
  }
}

}  // namespace
}  // namespace scabo::element
