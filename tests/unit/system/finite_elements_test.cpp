// Assembled finite elements of all kinds, alone and beside super-elements: patch tests, zero modes, mass, rates.
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "scabo/element/facet/mass.hpp"
#include "scabo/element/plane/finite_element.hpp"
#include "scabo/system/assembly.hpp"
#include "scabo/system/loads.hpp"
#include "support/decompositions.hpp"
#include "theory/rings.hpp"
#include "unit/mesh/cell_meshes.hpp"

namespace scabo::system {
namespace {

using namespace test;

constexpr double young = 10e9, poisson = 0.3, density = 2500.0, thickness = 0.5;

/// A model of one body, of which only materials and analysis matter here.
model::Model model_of_one() {
  model::Model model;
  model.file = "model.yaml";
  model.analysis.thickness = thickness;
  model.materials.resize(1);
  model.materials[0].young = young;
  model.materials[0].poisson = poisson;
  model.materials[0].density = density;
  model.bodies.resize(1);
  model.bodies[0].name = "body";
  model.bodies[0].material = 0;
  return model;
}

struct Assembled {
  element::SolvedCells cells;
  Matrix K, M;
};

Assembled assembled(const mesh::BodyMesh& mesh) {
  const model::Model model = model_of_one();
  mesh::Mesh whole;
  whole.bodies = {mesh};
  Assembled made;
  made.cells = element::solve_cells(model, whole, 1).front();
  made.K = Matrix(body_stiffness(model, thickness, mesh, made.cells).sparse);
  MassLibrary masses([](const element::SolvedSuperElement& cell) {
    return element::mass_matrix(cell.ring, cell.solution(), cell.modes(), {density}, thickness);
  });
  made.M = Matrix(body_mass(model, thickness, mesh, made.cells, masses).sparse);
  return made;
}

struct Kind {
  const char* name;
  int order;
  bool triangles;
};

class EveryMesh : public testing::TestWithParam<Kind> {};
INSTANTIATE_TEST_SUITE_P(FiniteElements, EveryMesh,
                         testing::Values(Kind{"triangle3", 1, true}, Kind{"triangle6", 2, true},
                                         Kind{"quad4", 1, false}, Kind{"quad8", 2, false}),
                         [](const auto& info) { return std::string(info.param.name); });

/// MacNeal and Harder's patch: five distorted quadrilaterals in a rectangle of 0.24 x 0.12. The sides inside are curved
/// by `bulge` times their length, in elements of order 2. The first eight corners: four outside, four inside.
CellMesh patch(const Kind& kind, double bulge) {
  CellMesh made(kind.order);
  for (const Vec2& x : {Vec2(0, 0), Vec2(0.24, 0), Vec2(0.24, 0.12), Vec2(0, 0.12), Vec2(0.04, 0.02), Vec2(0.18, 0.03),
                        Vec2(0.16, 0.08), Vec2(0.08, 0.08)})
    made.node(x);
  made.add_quad({0, 1, 5, 4}, kind.triangles);
  made.add_quad({1, 2, 6, 5}, kind.triangles);
  made.add_quad({2, 3, 7, 6}, kind.triangles);
  made.add_quad({3, 0, 4, 7}, kind.triangles);
  made.add_quad({4, 5, 6, 7}, kind.triangles);
  if (kind.order == 2)
    for (int i = 4; i < 8; ++i) {
      const mesh::LineElement side = made.side(i, i == 7 ? 4 : i + 1);
      const Vec2 along = made.mesh.nodes[static_cast<std::size_t>(side.nodes[2])] -
                         made.mesh.nodes[static_cast<std::size_t>(side.nodes[0])];
      made.mesh.nodes[static_cast<std::size_t>(side.nodes[1])] += bulge * Vec2(along.y(), -along.x());
    }
  return made;
}

/// The triangles of the patch are flat.
double bulge_of(const Kind& kind) { return kind.triangles ? 0.02 : 0.1; }

const Mat2 gradient = (Mat2() << 1.1e-3, -0.4e-3, 0.7e-3, -0.9e-3).finished();
Vec2 linear(const Vec2& x) { return gradient * x + Vec2(0.002, -0.001); }

/// Largest error, relative to the largest displacement, of the nodes that are free where the others have the linear
/// field.
double patch_error(const mesh::BodyMesh& mesh, const Matrix& K, const std::function<bool(const Vec2&)>& is_free) {
  std::vector<int> free, held;
  for (std::size_t i = 0; i < mesh.nodes.size(); ++i)
    for (int c = 0; c < 2; ++c) (is_free(mesh.nodes[i]) ? free : held).push_back(2 * static_cast<int>(i) + c);
  const Vector exact = at_nodes(mesh.nodes, linear);
  EXPECT_FALSE(free.empty());
  const Vector u = solve_cholesky(K(free, free), -K(free, held) * exact(held));
  return largest(u - exact(free)) / largest(exact);
}

bool in_patch(const Vec2& x) { return x.x() > 1e-9 && x.x() < 0.24 - 1e-9 && x.y() > 1e-9 && x.y() < 0.12 - 1e-9; }

TEST_P(EveryMesh, PassesThePatchTest) {
  for (const double bulge : {0.0, bulge_of(GetParam())}) {
    const mesh::BodyMesh mesh = patch(GetParam(), bulge).mesh;
    EXPECT_LT(patch_error(mesh, assembled(mesh).K, in_patch), 1e-13);
  }
}

TEST_P(EveryMesh, HasThreeZeroModes) {
  const Matrix K = assembled(patch(GetParam(), bulge_of(GetParam())).mesh).K;
  const Vector values = symmetric_eigenvalues(K);
  EXPECT_LT(values.head(3).cwiseAbs().maxCoeff(), 1e-14 * values.maxCoeff());
  EXPECT_GT(values[3], 1e-4 * values.maxCoeff());
}

TEST_P(EveryMesh, MassSumsToThatOfTheBody) {
  const mesh::BodyMesh mesh = patch(GetParam(), bulge_of(GetParam())).mesh;
  const Matrix M = assembled(mesh).M;
  const double mass = density * thickness * 0.24 * 0.12;
  const Vector x = at_nodes(mesh.nodes, [](const Vec2&) { return Vec2(1, 0); });
  const Vector y = at_nodes(mesh.nodes, [](const Vec2&) { return Vec2(0, 1); });
  EXPECT_NEAR(x.dot(M * x), mass, 1e-14 * mass);
  EXPECT_NEAR(y.dot(M * y), mass, 1e-14 * mass);
  EXPECT_NEAR(x.dot(M * y), 0.0, 1e-14 * mass);
}

// A heptagon as one super-element in the middle of a square, surrounded by finite elements that share its sides.
class MixedMesh : public testing::TestWithParam<Kind> {};
INSTANTIATE_TEST_SUITE_P(SuperElementAmongFiniteElements, MixedMesh,
                         testing::Values(Kind{"triangle3", 1, true}, Kind{"triangle6", 2, true},
                                         Kind{"quad4", 1, false}, Kind{"quad8", 2, false}),
                         [](const auto& info) { return std::string(info.param.name); });

mesh::BodyMesh mixed(const Kind& kind) {
  CellMesh made(kind.order);
  constexpr int sides = 7;
  for (int i = 0; i < sides; ++i)
    made.node(0.8 *
              Vec2(std::cos(2 * std::numbers::pi * i / sides) + 0.1 * i, std::sin(2 * std::numbers::pi * i / sides)));
  for (int i = 0; i < sides; ++i) made.node(Vec2(2.1 * made.mesh.nodes[static_cast<std::size_t>(i)] + Vec2(-0.2, 0.1)));
  std::vector<int> inner;
  for (int i = 0; i < sides; ++i) inner.push_back(i);
  made.add(mesh::CellKind::superelement, inner);
  for (int i = 0; i < sides; ++i) {
    const int next = (i + 1) % sides;
    made.add_quad({i, sides + i, sides + next, next}, kind.triangles);
  }
  return made.mesh;
}

TEST_P(MixedMesh, PassesThePatchTest) {
  const mesh::BodyMesh mesh = mixed(GetParam());
  ASSERT_EQ(mesh.count(mesh::CellKind::superelement), 1);
  const Assembled made = assembled(mesh);
  const std::vector<int> inner = mesh.cells.front().nodes();
  std::vector<Vec2> of_cell;
  for (const int node : inner) of_cell.push_back(mesh.nodes[static_cast<std::size_t>(node)]);
  const auto is_free = [&](const Vec2& x) { return std::find(of_cell.begin(), of_cell.end(), x) != of_cell.end(); };
  EXPECT_LT(patch_error(mesh, made.K, is_free), 1e-12);
  const Vector values = symmetric_eigenvalues(made.K);
  EXPECT_LT(values.head(3).cwiseAbs().maxCoeff(), 1e-13 * values.maxCoeff());
  EXPECT_GT(values[3], 1e-4 * values.maxCoeff());
}

TEST_P(MixedMesh, MassSumsToThatOfTheBody) {
  const mesh::BodyMesh mesh = mixed(GetParam());
  double area = 0.0;
  for (int i = 0; i < 7; ++i)
    area +=
        0.5 * cross(mesh.nodes[static_cast<std::size_t>(7 + i)], mesh.nodes[static_cast<std::size_t>(7 + (i + 1) % 7)]);
  const Vector x = at_nodes(mesh.nodes, [](const Vec2&) { return Vec2(1, 0); });
  EXPECT_NEAR(x.dot(assembled(mesh).M * x), density * thickness * area, 1e-12 * density * thickness * area);
}

TEST(FiniteElements, FoldedOnesAreReportedOnce) {
  mesh::BodyMesh mesh = mapped_grid(2, 2, 1, false, [](const Vec2& x) { return x; });
  mesh.nodes[4] = {2.5, 1.0};  // the node in the middle, beyond the boundary
  try {
    assembled(mesh);
    FAIL();
  } catch (const InputError& error) {
    ASSERT_EQ(error.diagnostics().size(), 1U);
    EXPECT_NE(std::string(error.what()).find("2 of 4 finite elements of body 'body' are folded: number 2"),
              std::string::npos)
        << error.what();
  }
}

/// Energy error of a cantilever of length 4 and depth 1 loaded by the tractions of Timoshenko and Goodier's solution,
/// shear P at the free end: U - U_h, in units of the energy U.
double cantilever_error(const Kind& kind, int refinement) {
  constexpr double L = 4.0, c = 0.5, P = 1e6, I = 2.0 / 3.0 * c * c * c;
  const int nx = 8 * refinement, ny = 2 * refinement;
  const mesh::BodyMesh mesh = mapped_grid(nx, ny, kind.order, kind.triangles, [&](const Vec2& at) {
    const double r = at.x() / nx, s = at.y() / ny;  // distorted inside, alike for all refinements
    const double move = 0.25 * std::sin(std::numbers::pi * r) * std::sin(std::numbers::pi * s);
    return Vec2(L * r + 0.3 * move, 2 * c * s - c + 0.2 * move * std::cos(2 * std::numbers::pi * r));
  });
  const auto stress = [&](const Vec2& x) {
    return element::Vec3(-P * (L - x.x()) * x.y() / I, 0.0, P / (2 * I) * (c * c - x.y() * x.y()));
  };
  Vector f = Vector::Zero(static_cast<Eigen::Index>(2 * mesh.nodes.size()));
  for (const auto& edge : mesh.edges)
    f += traction_forces(edge, mesh.nodes, thickness,
                         [&](const Vec2& x, const Vec2& n) { return traction_of(stress(x), n); });
  const model::Model model = model_of_one();
  const element::SolvedCells none(mesh.cells.size());
  Matrix K = Matrix(body_stiffness(model, thickness, mesh, none).sparse);
  // Three degrees of freedom hold it: both of the first node, y of the last node of the lower edge.
  for (const int dof : {0, 1, 2 * nx + 1}) {
    K.row(dof).setZero();
    K.col(dof).setZero();
    K(dof, dof) = young;
    f[dof] = 0.0;
  }
  const Vector u = solve_cholesky(K, f);
  const double G = young / (2 * (1 + poisson));
  const double exact =
      thickness * (P * P * L * L * L / (6 * young * I) + P * P * L * 16 * std::pow(c, 5) / (15 * 8 * G * I * I));
  return (exact - 0.5 * u.dot(f)) / exact;
}

// Energy error of order h^2p.
TEST_P(EveryMesh, CantileverConvergesAtItsRate) {
  std::vector<double> errors;
  const int finest = GetParam().order == 1 ? 8 : 4;
  for (const int refinement : {finest / 4, finest / 2, finest})
    errors.push_back(cantilever_error(GetParam(), refinement));
  for (const double error : errors) EXPECT_GT(error, 0.0);  // finite elements are too stiff
  const double rate = std::log2(errors[1] / errors[2]);
  EXPECT_GT(rate, 2 * GetParam().order - 0.2) << errors[0] << " " << errors[1] << " " << errors[2];
  EXPECT_LT(errors[2], GetParam().order == 1 ? 0.15 : 2e-3);
}

}  // namespace
}  // namespace scabo::system
