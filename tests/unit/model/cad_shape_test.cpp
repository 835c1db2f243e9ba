// Shapes that Gmsh's library divides: volumes by hand, names of faces, and the same mesh in other units.
#include "scabo/model/cad_shape.hpp"

#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <filesystem>
#include <fstream>
#include <numbers>

#include "scabo/base/error.hpp"
#include "scabo/files/cad.hpp"
#include "scabo/model/nearest_face.hpp"

namespace scabo::model {
namespace {

using Eigen::Vector3d;
constexpr double pi = std::numbers::pi;

geometry::Outline rectangle(const Vec2& low, const Vec2& high) {
  geometry::Outline outline;
  const std::array<Vec2, 4> corners{low, Vec2(high.x(), low.y()), high, Vec2(low.x(), high.y())};
  const std::array<const char*, 4> names{"bottom", "right", "top", "left"};
  for (std::size_t i = 0; i < 4; ++i) {
    geometry::Edge edge;
    edge.names = {names[i]};
    edge.start = corners[i], edge.end = corners[(i + 1) % 4];
    outline.edges.push_back(edge);
    outline.corners.push_back({{}, corners[i]});
  }
  return outline;
}

SolidRevolution ring(double angle) {
  SolidRevolution of;
  of.outline = rectangle({2, 0}, {3, 1});
  of.axes = {0, 2, 1};
  of.from = {0, 0}, of.to = {0, 1};
  of.angle = angle;
  return of;
}

double volume_of(const files::ImportedSolidMesh& mesh) {
  double volume = 0.0;
  for (const files::ImportedSolidCell& cell : mesh.cells) {
    const Eigen::Matrix<double, 3, 4> x =
        mesh.nodes(Eigen::all, std::vector<int>(cell.nodes.begin(), cell.nodes.begin() + 4));
    volume += (x.col(1) - x.col(0)).cross(x.col(2) - x.col(0)).dot(x.col(3) - x.col(0)) / 6.0;
  }
  return volume;
}

double area_of(const files::ImportedSolidMesh& mesh, const std::string& name) {
  double area = 0.0;
  for (const files::SolidSideSet& set : mesh.side_sets)
    for (const files::SolidSide& side : set.sides) {
      if (set.name != name) continue;
      const Eigen::Matrix3d x =
          mesh.nodes(Eigen::all, files::corners_of(mesh.cells[static_cast<std::size_t>(side.cell)], side.side));
      area += 0.5 * (x.col(1) - x.col(0)).cross(x.col(2) - x.col(0)).norm();
    }
  return area;
}

std::vector<std::string> names_of(const files::ImportedSolidMesh& mesh) {
  std::vector<std::string> names;
  for (const files::SolidSideSet& set : mesh.side_sets) names.push_back(set.name);
  return names;
}

SolidCombination plate_with_a_bore(SolidCombination::Kind kind, double unit = 1.0) {
  const SolidBox plate{Vector3d(0, 0, 0), unit * Vector3d(4, 4, 1)};
  const SolidCylinder bore{unit * Vector3d(2, 2, -1), unit * Vector3d(2, 2, 2), unit * 1.0};
  return {kind, {{"plate", SolidShape(plate)}, {"bore", SolidShape(bore)}}};
}

TEST(FaceDistance, IsZeroOnTheFaceAlone) {
  const AnyShape box = SolidShape(SolidBox{Vector3d(1, 1, 1), Vector3d(2, 3, 4)});
  EXPECT_DOUBLE_EQ(distance_to_face(box, "top", {2, 2, 5}), 0.0);
  EXPECT_DOUBLE_EQ(distance_to_face(box, "top", {2, 2, 4.5}), 0.5);
  EXPECT_DOUBLE_EQ(distance_to_face(box, "top", {4, 2, 5}), 1.0);  // in its plane, beside it
  EXPECT_DOUBLE_EQ(distance_to_face(box, "left", {1, 2, 5}), 0.0);
  const AnyShape tube = SolidShape(SolidTube{Vector3d(0, 0, 0), Vector3d(0, 2, 0), 1.0, 2.0});
  EXPECT_DOUBLE_EQ(distance_to_face(tube, "inside", {1, 1, 0}), 0.0);
  EXPECT_DOUBLE_EQ(distance_to_face(tube, "inside", {0, 3, 1}), 1.0);
  EXPECT_DOUBLE_EQ(distance_to_face(tube, "bottom", {0, 0, 1.5}), 0.0);
  EXPECT_DOUBLE_EQ(distance_to_face(tube, "bottom", {0, 0, 0.5}), 0.5);
  const AnyShape ball = SolidShape(SolidSphere{Vector3d(0, 0, 1), 2.0, {0, 0, -1}});
  EXPECT_DOUBLE_EQ(distance_to_face(ball, "surface", {0, 0, -1}), 0.0);
  EXPECT_DOUBLE_EQ(distance_to_face(ball, "surface", {0, 0, 3}), 2.0);
  EXPECT_DOUBLE_EQ(distance_to_face(ball, "cut_z", {1, 1, 1}), 0.0);
  const AnyShape quarter = CadShape(ring(90));
  EXPECT_NEAR(distance_to_face(quarter, "start", {2.5, 0, 0.5}), 0.0, 1e-15);
  EXPECT_NEAR(distance_to_face(quarter, "end", {0, -2.5, 0.5}), 5.0, 1e-14);  // counter-clockwise about z leads to +y
  EXPECT_NEAR(distance_to_face(quarter, "end", {0, 2.5, 0.5}), 0.0, 1e-15);
  EXPECT_NEAR(distance_to_face(quarter, "right", {3 * std::sqrt(0.5), 3 * std::sqrt(0.5), 0.5}), 0.0, 1e-15);
  EXPECT_GT(distance_to_face(quarter, "right", {-3, 0, 0.5}), 1.0);
  EXPECT_NEAR(distance_to_face(CadShape(ring(360)), "right", {-3, 0, 0.5}), 0.0, 1e-15);
  const AnyShape both = CadShape(plate_with_a_bore(SolidCombination::Kind::united));
  EXPECT_DOUBLE_EQ(distance_to_face(both, "plate_top", {3, 2, 1}), 0.0);
  EXPECT_DOUBLE_EQ(distance_to_face(both, "bore_side", {3, 2, 1}), 0.0);
}

TEST(NearestFaces, OfASimpleShape) {
  const SolidShape box = SolidBox{Vector3d(0, 0, 0), Vector3d(2, 3, 4)};
  using Names = std::vector<std::string>;
  EXPECT_EQ(nearest_faces(box, {1, 1, 4}), Names{"top"});
  EXPECT_EQ(nearest_faces(box, {1, 1, 9}), Names{"top"});
  EXPECT_EQ(nearest_faces(box, {0.1, 1, 2}), Names{"left"});  // inside
  EXPECT_EQ(nearest_faces(box, {2, 1, 4}), (Names{"right", "top"}));
  SolidExtrusion drawn;
  drawn.outline = rectangle({0, 0}, {1, 1});
  drawn.outline.edges[0].names = {"edge_1", "base"};
  drawn.to = 1.0;
  EXPECT_EQ(nearest_faces(drawn, {0.5, 0, 0.5}), Names{"edge_1"});
}

TEST(NearestFaces, OfAMesh) {
  files::ImportedSolidMesh mesh;
  mesh.nodes = Matrix::Zero(3, 4);
  mesh.nodes.rightCols(3).setIdentity();
  mesh.cells = {{{0, 1, 2, 3}, 1}};
  mesh.side_sets = {{"bottom", {{0, 0}}}, {"other name", {{0, 0}}}, {"oblique", {{0, 2}}}};
  using Names = std::vector<std::string>;
  EXPECT_EQ(nearest_faces(mesh, {0.2, 0.2, 0.0}), Names{"bottom"});
  EXPECT_EQ(nearest_faces(mesh, {0.4, 0.4, 0.4}), Names{"oblique"});
  EXPECT_EQ(nearest_faces(mesh, {-1, -1, 0.1}), Names{"bottom"});  // beside it: a corner of it is nearer
  EXPECT_EQ(nearest_faces(mesh, {0.5, 0.5, 0.0}), (Names{"bottom", "oblique"}));
}

class MadeByGmsh : public testing::Test {
 protected:
  void SetUp() override {
    if (!files::reads_cad()) GTEST_SKIP() << "built without Gmsh's library";
  }
};

TEST_F(MadeByGmsh, RevolutionsHaveTheVolumeOfPappus) {
  for (const double angle : {60.0, 180.0, 360.0}) {
    const auto mesh = divided_cad_shape(ring(angle), {0.4, {}}, "model.yaml");
    const double by_hand = 2.5 * angle * pi / 180.0;
    EXPECT_NEAR(volume_of(mesh), by_hand, 0.01 * by_hand) << angle;  // chords instead of arcs
    EXPECT_NEAR(area_of(mesh, "right"), 3 * angle * pi / 180.0, 0.01 * 3 * angle * pi / 180.0);
    EXPECT_NEAR(area_of(mesh, "start"), angle < 360.0 ? 1.0 : 0.0, 1e-9);
    EXPECT_NEAR(area_of(mesh, "end"), angle < 360.0 ? 1.0 : 0.0, 1e-9);
  }
}

TEST_F(MadeByGmsh, CombinationsHaveTheVolumeAndTheFacesOfTheirShapes) {
  using Kind = SolidCombination::Kind;
  const auto cut = divided_cad_shape(plate_with_a_bore(Kind::cut), {0.25, {}}, "model.yaml");
  EXPECT_NEAR(volume_of(cut), 16 - pi, 0.02 * pi);
  EXPECT_NEAR(area_of(cut, "plate_top"), 16 - pi, 0.02 * pi);
  EXPECT_NEAR(area_of(cut, "bore_side"), 2 * pi, 0.02 * 2 * pi);
  EXPECT_EQ(names_of(cut), (std::vector<std::string>{"plate_left", "plate_right", "plate_front", "plate_back",
                                                     "plate_bottom", "plate_top", "bore_side"}));
  const auto common = divided_cad_shape(plate_with_a_bore(Kind::common), {0.25, {}}, "model.yaml");
  EXPECT_NEAR(volume_of(common), pi, 0.02 * pi);
  EXPECT_EQ(names_of(common), (std::vector<std::string>{"plate_bottom", "plate_top", "bore_side"}));
  const auto all = divided_cad_shape(plate_with_a_bore(Kind::united), {0.25, {}}, "model.yaml");
  EXPECT_NEAR(volume_of(all), 16 + 2 * pi, 0.02 * 3 * pi);
  EXPECT_NEAR(area_of(all, "bore_side"), 4 * pi, 0.02 * 4 * pi);
  EXPECT_NEAR(area_of(all, "bore_top"), pi, 0.02 * pi);
}

/// Faces of two boxes in one plane stay apart, and the part that they share has both names.
TEST_F(MadeByGmsh, FacesThatShapesShareHaveBothNames) {
  const SolidBox a{Vector3d(0, 0, 0), Vector3d(2, 1, 1)}, b{Vector3d(1, 0, 0), Vector3d(2, 1, 1)};
  const CadShape both = SolidCombination{SolidCombination::Kind::united, {{"a", SolidShape(a)}, {"b", SolidShape(b)}}};
  const auto mesh = divided_cad_shape(both, {0.5, {}}, "model.yaml");
  EXPECT_NEAR(volume_of(mesh), 3.0, 1e-9);
  EXPECT_NEAR(area_of(mesh, "a_top"), 2.0, 1e-9);
  EXPECT_NEAR(area_of(mesh, "b_top"), 2.0, 1e-9);
  EXPECT_NEAR(area_of(mesh, "a_right"), 0.0, 1e-9);
}

TEST_F(MadeByGmsh, TheMeshIsTheSameInOtherUnits) {
  const auto of = [](double unit) {
    return divided_cad_shape(plate_with_a_bore(SolidCombination::Kind::cut, unit),
                             {0.5 * unit, {{unit * Vector3d(1, 2, 0), 0.2 * unit, 0.3}}}, "model.yaml");
  };
  const auto metres = of(1.0), micrometres = of(1e6), again = of(1.0);
  ASSERT_EQ(metres.nodes.cols(), micrometres.nodes.cols());
  EXPECT_LT((metres.nodes - 1e-6 * micrometres.nodes).cwiseAbs().maxCoeff(), 1e-9);
  EXPECT_EQ(metres.nodes, again.nodes);
}

TEST_F(MadeByGmsh, RefinementMakesSmallerCellsThereAndNoLargerOnesThanAskedFor) {
  const auto coarse = divided_cad_shape(plate_with_a_bore(SolidCombination::Kind::cut), {1.0, {}}, "model.yaml");
  const auto fine = divided_cad_shape(plate_with_a_bore(SolidCombination::Kind::cut),
                                      {1.0, {{Vector3d(0, 0, 0), 0.1, 0.3}}}, "model.yaml");
  EXPECT_GT(fine.cells.size(), coarse.cells.size() + 50);
  double least = 1.0;
  for (const files::ImportedSolidCell& cell : fine.cells)
    least = std::min(least, (fine.nodes.col(cell.nodes[0]) - fine.nodes.col(cell.nodes[1])).norm());
  EXPECT_LT(least, 0.2);
}

TEST_F(MadeByGmsh, AStepFileGivesItsNamesAndMetres) {
  const std::string path = std::string(SCABO_EXAMPLES) + "/49_part_from_step/bracket.step";
  const auto mesh = divided_cad_shape(CadFile{path}, {2e-3, {}}, "model.yaml");
  EXPECT_NEAR(area_of(mesh, "foot"), 60e-3 * 40e-3 - pi * 64e-6, 0.03 * pi * 64e-6);
  EXPECT_NEAR(area_of(mesh, "seat"), pi * (225e-6 - 64e-6), 0.03 * pi * 225e-6);
  EXPECT_NEAR(area_of(mesh, "bore"), 2 * pi * 8e-3 * 25e-3, 0.03 * 2 * pi * 8e-3 * 25e-3);
  EXPECT_EQ(area_of(mesh, "face_5"), 0.0);  // it has a name
  EXPECT_NEAR(area_of(mesh, "face_1"), 40e-3 * 10e-3, 1e-12);
  EXPECT_TRUE(mesh.remarks.empty());
  const CadShape filled =
      SolidCombination{SolidCombination::Kind::united,
                       {{"part", CadShape(CadFile{path})},
                        {"pin", SolidShape(SolidCylinder{Vector3d(0, 0, 0), Vector3d(0, 0, 25e-3), 8e-3})}}};
  EXPECT_NEAR(area_of(divided_cad_shape(filled, {2e-3, {}}, "model.yaml"), "pin_top"), pi * 64e-6, 0.03 * pi * 64e-6);
}

TEST_F(MadeByGmsh, TrianglesOfAClosedSurfaceAreFilled) {
  const auto path = std::filesystem::temp_directory_path() / "scabo_cube_test.stl";
  std::ofstream file(path);
  file << "solid cube\n";
  for (int axis = 0; axis < 3; ++axis)
    for (int side = 0; side < 2; ++side)
      for (int half = 0; half < 2; ++half) {
        std::array<Vector3d, 4> corner;
        for (int k = 0; k < 4; ++k) {
          corner[static_cast<std::size_t>(k)][axis] = side;
          corner[static_cast<std::size_t>(k)][(axis + 1) % 3] = k == 1 || k == 2;
          corner[static_cast<std::size_t>(k)][(axis + 2) % 3] = k >= 2;
        }
        std::array<int, 3> of = half == 0 ? std::array{0, 1, 2} : std::array{0, 2, 3};
        if (side == 0) std::swap(of[1], of[2]);
        file << "facet normal 0 0 0\nouter loop\n";
        for (const int k : of) file << "vertex " << corner[static_cast<std::size_t>(k)].transpose() << "\n";
        file << "endloop\nendfacet\n";
      }
  file << "endsolid\n";
  file.close();
  const auto mesh = divided_cad_shape(CadFile{path.string()}, {0.3, {}}, "model.yaml");
  EXPECT_NEAR(volume_of(mesh), 1.0, 1e-6);
  EXPECT_GT(mesh.cells.size(), 50u);
  EXPECT_TRUE(mesh.side_sets.empty());  // named as those of mesh files
}

TEST_F(MadeByGmsh, WhatCannotBeMadeIsRefusedWithASentence) {
  const auto message = [](const CadShape& shape, double size) -> std::string {
    try {
      divided_cad_shape(shape, {size, {}}, "model.yaml");
    } catch (const InputError& error) {
      return error.diagnostics().front().message;
    }
    return "no error";
  };
  const SolidBox a{Vector3d(0, 0, 0), Vector3d(1, 1, 1)}, b{Vector3d(5, 0, 0), Vector3d(1, 1, 1)};
  using Kind = SolidCombination::Kind;
  EXPECT_EQ(message(SolidCombination{Kind::common, {{"a", SolidShape(a)}, {"b", SolidShape(b)}}}, 0.5),
            "nothing is left of the shapes: see where they lie");
  EXPECT_EQ(message(ring(360), 1e-4).substr(0, 44), "with 'size' 0.0001 the mesh would have about");
  EXPECT_EQ(message(SolidCombination{Kind::united, {{"a", SolidShape(a)}, {"b", CadShape(CadFile{"b.stl"})}}}, 0.5),
            "there is no such file; correct its name");
  const auto folder = std::filesystem::temp_directory_path();
  std::ofstream(folder / "scabo_no.step") << "ISO-10303-21;\nHEADER;\n";
  std::ofstream(folder / "scabo_no.brep") << "CASCADE Topology V1\n";
  EXPECT_NE(message(CadFile{(folder / "scabo_no.step").string()}, 0.5), "no error");
  EXPECT_EQ(message(CadFile{(folder / "scabo_no.brep").string()}, 0.5),
            "the file does not end as a BREP file of OpenCASCADE does; write it again");
}

}  // namespace
}  // namespace scabo::model
