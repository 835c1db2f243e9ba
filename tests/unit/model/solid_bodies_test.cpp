#include "scabo/model/solid_bodies.hpp"

#include <gtest/gtest.h>

#include <algorithm>

namespace scabo::model {
namespace {

/// Tetrahedra with the corner x = y = z = 0 of unit cubes: two on the common side z = 0, and one that has only a node
/// in common with the first.
files::ImportedSolidMesh three_tetrahedra() {
  files::ImportedSolidMesh mesh;
  mesh.nodes.resize(3, 8);
  mesh.nodes << 0, 1, 0, 0, 0, 1, 0, 0,  //
      0, 0, 1, 0, 0, 0, 1, 0,            //
      0, 0, 0, 1, -1, 1, 1, 2;
  mesh.cells = {{{0, 1, 2, 3}, 1}, {{3, 5, 6, 7}, 2}, {{0, 2, 1, 4}, 3}};
  mesh.cell_sets = {{"rock", {0, 1}}, {"soil", {2}}};
  mesh.side_sets = {{"middle", {{0, 0}, {2, 0}}}, {"left", {{0, 3}, {2, 1}}}};  // z = 0, x = 0
  mesh.node_sets = {{"feet", {4, 7}}};
  return mesh;
}

std::vector<int> cells_of_face(const files::ImportedSolidMesh& mesh, const std::string& name) {
  std::vector<int> cells;
  for (const files::SolidSideSet& set : mesh.side_sets)
    for (const files::SolidSide& at : set.sides)
      if (set.name == name) cells.push_back(at.cell);
  return cells;
}

std::vector<std::string> names_of_faces(const files::ImportedSolidMesh& mesh) {
  std::vector<std::string> names;
  for (const files::SolidSideSet& set : mesh.side_sets) names.push_back(set.name);
  return names;
}

TEST(SolidBodies, AreWhatSidesJoin) {
  const auto bodies = solid_bodies(three_tetrahedra(), -1);
  ASSERT_EQ(bodies.size(), 2);
  EXPECT_EQ(bodies[0].cells.size(), 2);
  EXPECT_EQ(bodies[0].nodes.cols(), 5);
  EXPECT_EQ(bodies[0].cells[1].number, 3);
  EXPECT_EQ(bodies[1].nodes.cols(), 4);
  EXPECT_EQ(bodies[1].nodes.col(0), Eigen::Vector3d(0, 0, 1));
  EXPECT_EQ(bodies[1].node_sets[0].nodes, std::vector<int>{3});
  EXPECT_TRUE(cells_of_face(bodies[0], "middle").empty());  // inside
  EXPECT_EQ(cells_of_face(bodies[0], "left"), (std::vector<int>{0, 1}));
  EXPECT_EQ(names_of_faces(bodies[1]), (std::vector<std::string>{"face_1", "face_2", "face_3", "face_4"}));
}

TEST(SolidBodies, OfOneSetHaveFacesToTheOthers) {
  const auto rocks = solid_bodies(three_tetrahedra(), 0), soil = solid_bodies(three_tetrahedra(), 1);
  ASSERT_EQ(rocks.size(), 2);
  ASSERT_EQ(soil.size(), 1);
  EXPECT_EQ(cells_of_face(rocks[0], "to_soil"), std::vector<int>{0});
  EXPECT_EQ(cells_of_face(soil[0], "to_rock"), std::vector<int>{0});
  EXPECT_EQ(cells_of_face(soil[0], "middle"), std::vector<int>{0});
  EXPECT_TRUE(cells_of_face(rocks[1], "to_soil").empty());
}

/// Every outer side is in one face, and unnamed sides in one plane are one face.
TEST(SolidBodies, CutTheirOtherSidesWhereTheBoundaryTurns) {
  files::ImportedSolidMesh mesh = three_tetrahedra();
  mesh.side_sets.clear();
  const files::ImportedSolidMesh body = solid_bodies(mesh, -1)[0];
  EXPECT_EQ(body.side_sets.size(), 4);  // x = 0, y = 0, and the two slopes
  std::size_t sides = 0;
  for (const files::SolidSideSet& set : body.side_sets) sides += set.sides.size();
  EXPECT_EQ(sides, 6);
}

}  // namespace
}  // namespace scabo::model
