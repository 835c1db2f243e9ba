// points.csv, lines.csv and grid.csv: which points, which values, what is left empty.
#include "scabo/result/point_tables.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <map>

#include "scabo/result/probe.hpp"
#include "unit/result/solutions.hpp"

namespace scabo::result {
namespace {

using namespace scabo::test;
using testing::HasSubstr;

const Mat2 table_gradient = (Mat2() << 1.1e-3, -0.4e-3, 0.7e-3, -0.9e-3).finished();

std::vector<std::map<std::string, std::string>> read(const std::string& header, const std::string& rows) {
  const auto cells = [](const std::string& line) {
    std::vector<std::string> found(1);
    for (const char letter : line)
      if (letter == ',')
        found.emplace_back();
      else
        found.back() += letter;
    return found;
  };
  std::istringstream text(header + rows);
  std::string line;
  std::getline(text, line);
  const auto names = cells(line);
  std::vector<std::map<std::string, std::string>> table;
  while (std::getline(text, line)) {
    const auto values = cells(line);
    EXPECT_EQ(values.size(), names.size()) << line;
    auto& row = table.emplace_back();
    for (std::size_t i = 0; i < names.size(); ++i) row[names[i]] = values[i];
  }
  return table;
}

/// Two blocks, one on the other, and a rigid floor under them.
model::Model blocks() {
  model::Body floor;
  floor.name = "floor";
  floor.rigid = true;
  floor.outline = rectangle({-1, -1}, {4, 1});
  return model_of(
      {elastic("lower", rectangle({0, 0}, {2, 1}), 0.5), elastic("upper", rectangle({0, 1}, {2, 1}), 0.5), floor},
      model::Plane::strain);
}

TEST(PointTables, OfALinearFieldAreExactAndEveryBodyHasItsRow) {
  model::Model model = blocks();
  model.output.points = {{"inside", {0.3, 0.4}, -1, {}},
                         {"joint", {1.1, 1.0}, -1, {}},
                         {"only", {1.1, 1.0}, 1, {}},
                         {"edge", {2.0, 0.25}, -1, {}},
                         {"floor", {-0.5, -0.5}, -1, {}}};
  const auto solution = solution_of(model);
  const auto increment = increment_of(solution, linear_field(table_gradient), {0.1, 0.2, 0.0});
  for (const int increments : {1, 100}) {  // directly and condensed
    const PointEvaluation evaluation(solution, mesh::output_points(model).points, increments);
    const auto rows = read(std::string(header_of(PointTable::points)),
                           point_table_rows(PointTable::points, evaluation, solution, increment));
    ASSERT_EQ(rows.size(), 6u);
    const std::vector<std::string> bodies = {"lower", "lower", "upper", "upper", "lower", "floor"};
    const UniformStress expected = stress_of(table_gradient, model::Plane::strain);
    for (std::size_t i = 0; i < rows.size(); ++i) {
      EXPECT_EQ(rows[i].at("body"), bodies[i]);
      if (i == 5) continue;
      const Vec2 u = linear_field(table_gradient)({std::stod(rows[i].at("x")), std::stod(rows[i].at("y"))});
      EXPECT_NEAR(std::stod(rows[i].at("ux")), u.x(), 1e-13);
      EXPECT_NEAR(std::stod(rows[i].at("uy")), u.y(), 1e-13);
      const double scale = expected.in_plane.norm();
      EXPECT_NEAR(std::stod(rows[i].at("stress_xx")), expected.in_plane[0], 1e-10 * scale);
      EXPECT_NEAR(std::stod(rows[i].at("stress_xy")), expected.in_plane[2], 1e-10 * scale);
      EXPECT_NEAR(std::stod(rows[i].at("stress_zz")), expected.zz, 1e-10 * scale);
      const element::Vec3 strain(gradient(0, 0), gradient(1, 1), gradient(0, 1) + gradient(1, 0));
      EXPECT_NEAR(std::stod(rows[i].at("energy_density")), 0.5 * strain.dot(expected.in_plane), 1e-10 * scale);
    }
    EXPECT_EQ(rows[5].at("ux"), "0.1");
    EXPECT_EQ(rows[5].at("stress_xx"), "");
    EXPECT_EQ(rows[5].at("energy_density"), "");
  }
}

TEST(PointTables, LinesRunFromEndToEndAndTheGridKeepsWhatLiesInside) {
  model::Model model =
      model_of({elastic("body", polygon({{0, 0}, {2, 0}, {0, 2}}, {"a", "b", "c"}), 0.5)}, model::Plane::stress);
  model.output.lines = {{"axis", {0, 0}, {1, 1}, 5, -1, {}}};
  model.output.grid = model::OutputGrid{0.5, {}, {}, {}, -1, {}};
  const mesh::OutputPoints points = mesh::output_points(model);
  ASSERT_EQ(points.lines.size(), 5u);
  EXPECT_EQ(points.lines[2].at, Vec2(0.5, 0.5));
  EXPECT_NEAR(points.lines[4].distance, std::sqrt(2.0), 1e-15);
  EXPECT_EQ(points.grid.size(), 15u);  // 5 + 4 + 3 + 2 + 1
  const auto solution = solution_of(model);
  const auto increment = increment_of(solution, linear_field(table_gradient));
  const PointEvaluation evaluation(solution, points.lines, 1);
  const auto rows = read(std::string(header_of(PointTable::lines)),
                         point_table_rows(PointTable::lines, evaluation, solution, increment));
  EXPECT_EQ(rows[2].at("name"), "axis");
  EXPECT_NEAR(std::stod(rows[2].at("distance")), std::sqrt(0.5), 1e-15);
}

TEST(PointTables, HoldPointsOnAnArcThatItsElementsDoNotReach) {
  model::Model model =
      model_of({elastic("disc", outline({arc("a", {5, 0}, 1, 0, pi), arc("b", {5, 0}, 1, pi, pi)}), 0.9, 2)},
               model::Plane::stress);
  const Vec2 on_arc(5 + std::cos(0.2), std::sin(0.2));
  model.output.points = {{"rim", on_arc, -1, {}}};
  const auto solution = solution_of(model);
  const auto increment = increment_of(solution, linear_field(table_gradient));
  EXPECT_FALSE(Probe(solution, increment.fields, 0).at(on_arc));
  for (const int increments : {1, 100}) {
    const PointEvaluation evaluation(solution, mesh::output_points(model).points, increments);
    const PointResult result = evaluation.at(solution, increment).front();
    EXPECT_LT((result.values.displacement - linear_field(table_gradient)(on_arc)).norm(), 1e-6);
    EXPECT_LT((result.values.stress - stress_of(table_gradient, model::Plane::stress).in_plane).norm(),
              1e-3 * young * 1e-3);
  }
}

TEST(PointTables, OutsideEveryBodyIsAMistakeThatNamesTheNearest) {
  model::Model model = blocks();
  model.output.points = {{"away", {2.5, 1.5}, -1, {}}};
  try {
    mesh::output_points(model);
    FAIL() << "no error";
  } catch (const InputError& error) {
    EXPECT_THAT(error.diagnostics().front().message,
                HasSubstr("(2.5, 1.5) lies outside every body; the nearest is 'upper', 0.5 away"));
  }
}

TEST(PointTables, ATipWhereStressIsInfiniteHasNone) {
  // A crack along y = 0 from (-1, 0) to its tip, the scaling centre: first and last node lie at its mouth.
  model::Model model = model_of(
      {elastic("plate", polygon({{-1, 0}, {-1, -1}, {1, -1}, {1, 1}, {-1, 1}}, {"a", "b", "c", "d", "e"}), 0.5)},
      model::Plane::stress);
  model.bodies[0].mesh.centre = Vec2::Zero();
  model.output.points = {{"tip", {0, 0}, -1, {}}, {"beside", {0.1, 0}, -1, {}}};
  auto solution = solution_of(model);
  auto cracked = std::make_shared<element::SolvedSuperElement>();
  cracked->ring = solution.cells[0][0]->ring;
  cracked->ring.elements.back().nodes.back() = static_cast<int>(cracked->ring.nodes.size());
  cracked->ring.nodes.push_back(cracked->ring.nodes.front());
  cracked->sectors = solution.cells[0][0]->sectors;
  cracked->set(element::solve_super_element(cracked->ring, cracked->sectors.D, 1.0));
  solution.cells[0][0] = cracked;
  mesh::BodyMesh& mesh = solution.mesh.bodies[0];
  mesh.cells[0].boundary.back().nodes.back() = static_cast<int>(mesh.nodes.size());
  mesh.nodes.push_back(mesh.nodes.front());
  auto increment = increment_of(solution, linear_field(table_gradient));
  Vector& u = increment.fields.displacements[0];
  u.tail<2>() = Vec2(1e-3, 2e-3);
  const PointEvaluation evaluation(solution, mesh::output_points(model).points, 1);
  const auto results = evaluation.at(solution, increment);
  EXPECT_FALSE(results[0].has_stress);
  EXPECT_TRUE(results[1].has_stress);
  ASSERT_EQ(evaluation.warnings().size(), 1u);
  EXPECT_THAT(evaluation.warnings()[0], HasSubstr("'tip' has no stress there"));
}

}  // namespace
}  // namespace scabo::result
