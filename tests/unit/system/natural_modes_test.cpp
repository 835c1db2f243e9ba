// Modes of one body: sparse against dense, orthogonality, the completeness of effective masses.
#include "scabo/system/natural_modes.hpp"

#include <gtest/gtest.h>

#include <array>
#include <map>

#include "scabo/element/facet/mass.hpp"
#include "scabo/linalg/symmetric_eigen.hpp"
#include "scabo/system/assembly.hpp"
#include "support/decompositions.hpp"
#include "theory/rings.hpp"

namespace scabo::system {
namespace {

using namespace test;

/// Four corners counter-clockwise, then the middles of the sides.
void add_element(mesh::BodyMesh& mesh, const std::array<int, 8>& nodes) {
  mesh::Cell cell;
  cell.kind = mesh::CellKind::finite_element;
  cell.materials = {0};
  for (std::size_t side = 0; side < 4; ++side)
    cell.boundary.push_back({{nodes[side], nodes[side + 4], nodes[(side + 1) % 4]}});
  mesh.cells.push_back(std::move(cell));
}

/// A grid of nx by ny 8-node elements of side 1.
mesh::BodyMesh grid(int nx, int ny) {
  mesh::BodyMesh mesh;
  std::map<std::pair<int, int>, int> numbers;
  const auto node = [&](int i, int j) {
    const auto [at, added] = numbers.emplace(std::pair(i, j), static_cast<int>(mesh.nodes.size()));
    if (added) mesh.nodes.emplace_back(0.5 * i, 0.5 * j);
    return at->second;
  };
  for (int j = 0; j < 2 * ny; j += 2)
    for (int i = 0; i < 2 * nx; i += 2)
      add_element(mesh, {node(i, j), node(i + 2, j), node(i + 2, j + 2), node(i, j + 2), node(i + 1, j),
                         node(i + 2, j + 1), node(i + 1, j + 2), node(i, j + 1)});
  return mesh;
}

struct Pair {
  Stiffness K, M;
};

Pair sparse(const mesh::BodyMesh& mesh) {
  Pair pair;
  model::Model model;
  model.materials.resize(1);
  model.materials[0].young = 1.0;
  model.materials[0].poisson = 0.3;
  model.materials[0].density = 1.0;
  const element::SolvedCells none(mesh.cells.size());
  MassLibrary masses([](const element::SolvedSuperElement&) { return Matrix(); });
  pair.K = body_stiffness(model, 1.0, mesh, none);
  pair.M = body_mass(model, 1.0, mesh, none, masses);
  return pair;
}

Pair dense(const Pair& pair) {
  Pair full;
  full.K.dense = std::make_shared<const Matrix>(pair.K.sparse);
  full.M.dense = std::make_shared<const Matrix>(pair.M.sparse);
  return full;
}

std::vector<Constraint> held(const mesh::BodyMesh& mesh, bool both) {
  std::vector<Constraint> constraints;
  for (std::size_t i = 0; i < mesh.nodes.size(); ++i)
    if (mesh.nodes[i].x() == 0.0)
      for (int component = 0; component < (both ? 2 : 1); ++component) {
        constraints.emplace_back();
        constraints.back().dof = 2 * static_cast<int>(i) + component;
      }
  return constraints;
}

// A free square has pairs of equal frequencies, which Lanczos might find once only.
TEST(NaturalModes, LanczosFindsWhatTheDenseSolverFinds) {
  const mesh::BodyMesh square = grid(8, 8), strip = grid(20, 4);
  const std::vector<std::pair<const mesh::BodyMesh*, std::vector<Constraint>>> cases = {{&square, {}},
                                                                                        {&square, held(square, false)},
                                                                                        {&square, held(square, true)},
                                                                                        {&strip, {}},
                                                                                        {&strip, held(strip, true)}};
  for (const auto& [mesh, constraints] : cases) {
    const Pair matrices = sparse(*mesh), full = dense(matrices);
    const NaturalModes lanczos = natural_modes(matrices.K, matrices.M, mesh->nodes, constraints, 25);
    const NaturalModes oracle = natural_modes(full.K, full.M, mesh->nodes, constraints, 25);
    ASSERT_EQ(lanczos.eigenvalues.size(), 25);
    EXPECT_EQ(lanczos.rigid, oracle.rigid);
    for (Eigen::Index k = lanczos.rigid; k < 25; ++k)
      EXPECT_NEAR(lanczos.eigenvalues[k] / oracle.eigenvalues[k], 1.0, 1e-10) << k;
    for (const NaturalModes& modes : {lanczos, oracle}) {
      const Matrix gram = modes.shapes.transpose() * (matrices.M.sparse * modes.shapes);
      EXPECT_LT(largest(gram - Matrix::Identity(25, 25)), 1e-10);
      EXPECT_LT(modes.residuals.maxCoeff(), 1e-12);  // to which Lanczos is asked to go
    }
  }
}

// Bodies of a millimetre in m, or in units of their own: the eigenvalues of Lanczos are 1e-12 or 1e15 then.
TEST(NaturalModes, LanczosFindsThemInAllUnits) {
  const mesh::BodyMesh square = grid(8, 8);
  const auto constraints = held(square, true);
  const Pair matrices = sparse(square);
  const NaturalModes first = natural_modes(matrices.K, matrices.M, square.nodes, constraints, 25);
  for (const auto& [stiffness, mass] : {std::pair(1e12, 1.0), {1e-15, 1.0}, {1.0, 1e-20}, {1e3, 1e40}, {1e-30, 1e-9}}) {
    Pair other = sparse(square);
    other.K.sparse *= stiffness;
    other.M.sparse *= mass;
    const NaturalModes modes = natural_modes(other.K, other.M, square.nodes, constraints, 25);
    for (Eigen::Index k = 0; k < 25; ++k)
      EXPECT_NEAR(modes.eigenvalues[k] / first.eigenvalues[k] * mass / stiffness, 1.0, 1e-10) << k;
    EXPECT_LT(modes.residuals.maxCoeff(), 1e-12);
  }
}

TEST(NaturalModes, RigidMotionsHaveNoStiffnessToRounding) {
  const element::Ring ring = polygon_ring(rectangle(6, 1.5), {16, 4, 16, 4}, 2);
  const auto solution = element::solve_super_element(ring, elasticity(1.0, 0.3), 1.0);
  Pair pair;
  pair.K.dense = std::make_shared<const Matrix>(solution.K);
  pair.M.dense = std::make_shared<const Matrix>(
      element::mass_matrix(ring, solution, element::modal_solution(solution), {1.0}, 1.0));
  const NaturalModes modes = natural_modes(pair.K, pair.M, ring.nodes, {}, 6);
  ASSERT_EQ(modes.rigid, 3);
  // The entries of K are exact to 4e-15 (page 2); the first bending mode of a slender beam is much softer than they
  // are.
  const double rounding = 1e-14 * solution.K.cwiseAbs().rowwise().sum().maxCoeff();
  for (Eigen::Index k = 0; k < 3; ++k) {
    const Vector phi = modes.shapes.col(k);
    EXPECT_LT(std::abs(phi.dot(solution.K * phi)), rounding * phi.squaredNorm()) << k;
    EXPECT_LT(std::abs(phi.dot(solution.K * phi)), 1e-11 * modes.eigenvalues[3]) << k;
  }
}

// All modes together carry the mass that moves: sum (phi'M r)^2 = (M r)_f' M_ff^-1 (M r)_f.
TEST(NaturalModes, EffectiveMassesAddUp) {
  const mesh::BodyMesh mesh = grid(3, 1);
  const Pair matrices = sparse(mesh);
  const auto constraints = held(mesh, true);
  const auto size = static_cast<int>(2 * mesh.nodes.size());
  const NaturalModes modes = natural_modes(matrices.K, matrices.M, mesh.nodes, constraints, size);
  ASSERT_EQ(modes.eigenvalues.size(), size - static_cast<int>(constraints.size()));
  const Matrix M(matrices.M.sparse);
  std::vector<int> free;
  for (int dof = 0; dof < size; ++dof)
    if (mesh.nodes[static_cast<std::size_t>(dof / 2)].x() > 0.0) free.push_back(dof);
  const Vector r = at_nodes(mesh.nodes, [](const Vec2&) { return Vec2(1, 0); });
  const Vector Mr = Vector(M * r)(free);
  const double all = Mr.dot(Vector(solve_cholesky(M(free, free), Mr)));
  EXPECT_NEAR((modes.shapes.transpose() * (M * r)).squaredNorm(), all, 1e-10 * all);
  EXPECT_LT(all, 3.0);  // the mass; the supports carry the rest
}

/// `count` copies of a mesh beside each other, which nothing joins: every frequency occurs as many times.
mesh::BodyMesh copies(const mesh::BodyMesh& one, int count) {
  mesh::BodyMesh all;
  for (int k = 0; k < count; ++k) {
    const auto first = static_cast<int>(all.nodes.size());
    for (const Vec2& node : one.nodes) all.nodes.push_back(node);
    for (mesh::Cell cell : one.cells) {
      for (auto& element : cell.boundary)
        for (int& node : element.nodes) node += first;
      all.cells.push_back(std::move(cell));
    }
  }
  return all;
}

// The teeth of a comb that is held along its back. Lanczos finds some copies of a frequency once only, until rounding
// has brought the others, and with 8 or more there is no gap soon behind the ones that are asked for.
TEST(NaturalModes, ManyEqualPartsHaveEveryFrequencyAsManyTimes) {
  const mesh::BodyMesh one = grid(4, 4);
  const Pair full = dense(sparse(one));
  const NaturalModes oracle = natural_modes(full.K, full.M, one.nodes, held(one, true), 5);
  for (const int parts : {8, 12, 20}) {
    const mesh::BodyMesh all = copies(one, parts);
    const Pair matrices = sparse(all);
    for (const int wanted : {3, 10, 25}) {
      const NaturalModes modes = natural_modes(matrices.K, matrices.M, all.nodes, held(all, true), wanted);
      ASSERT_EQ(modes.eigenvalues.size(), wanted);
      for (int k = 0; k < wanted; ++k)
        EXPECT_NEAR(modes.eigenvalues[k] / oracle.eigenvalues[k / parts], 1.0, 1e-10) << k << " of " << parts;
    }
  }
}

TEST(NaturalModes, InertiaCountsEigenvalues) {
  const mesh::BodyMesh mesh = grid(4, 4);
  const Pair matrices = sparse(mesh), full = dense(matrices);
  const NaturalModes modes = natural_modes(full.K, full.M, mesh.nodes, {}, 20);
  for (int k : {3, 6, 12, 18}) {
    const double shift = 0.5 * (modes.eigenvalues[k] + modes.eigenvalues[k + 1]);
    if (modes.eigenvalues[k + 1] < 1.001 * modes.eigenvalues[k]) continue;
    EXPECT_EQ(linalg::eigenvalues_below(matrices.K.sparse, matrices.M.sparse, shift), k + 1);
  }
}

}  // namespace
}  // namespace scabo::system
