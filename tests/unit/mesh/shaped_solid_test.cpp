// Meshes of simple shapes in space: volumes and areas in closed form, no folded elements, closed boundaries.
#include "scabo/mesh/space/shaped_solid.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <set>

#include "scabo/element/space/facet.hpp"
#include "scabo/element/space/solid_cell.hpp"

namespace scabo::mesh {
namespace {

double volume_of(const SolidMesh& mesh) {
  double sum = 0.0;
  for (const std::vector<int>& cell : mesh.cells) sum += element::cell_volume_weights(nodes_of(mesh, cell)).sum();
  return sum;
}

double area_of(const SolidMesh& mesh, const std::vector<SolidFacet>& facets) {
  double sum = 0.0;
  for (const SolidFacet& facet : facets) sum += element::area_weights(nodes_of(mesh, facet)).sum();
  return sum;
}

struct Expected {
  std::string name;
  model::SolidShape shape;
  model::SolidSizes sizes;
  double volume = 0.0;
  std::map<std::string, double> areas;
  double tolerance = 0.0;  // relative; 0 for shapes without curved faces
};

model::SolidSphere sphere(double radius, std::array<int, 3> kept) {
  model::SolidSphere of{{1, -2, 0.5}, radius};
  of.kept = kept;
  return of;
}

const std::vector<Expected>& shapes() {
  static const std::vector<Expected> all{
      {"box",
       model::SolidBox{{1, 2, 3}, {2, 3, 1}},
       {0.7, {}},
       6.0,
       {{"left", 3}, {"right", 3}, {"front", 2}, {"back", 2}, {"bottom", 6}, {"top", 6}}},
      {"graded_box",
       model::SolidBox{{-1, -1, -1}, {2, 2, 1}},
       {0.7, {{{0, 0, 0}, 0.05, 0.5}}},
       4.0,
       {{"left", 2}, {"right", 2}, {"front", 2}, {"back", 2}, {"bottom", 4}, {"top", 4}}},
      {"cylinder",
       model::SolidCylinder{{0, 1, 0}, {1, 1, 2}, 0.5},
       {0.15, {}},
       std::numbers::pi * 0.25 * std::sqrt(5.0),
       {{"bottom", std::numbers::pi * 0.25},
        {"top", std::numbers::pi * 0.25},
        {"side", std::numbers::pi * std::sqrt(5.0)}},
       2e-4},
      {"tube",
       model::SolidTube{{0, 0, 0}, {0, 3, 0}, 1, 1.5},
       {0.3, {}},
       std::numbers::pi * 1.25 * 3,
       {{"bottom", std::numbers::pi * 1.25},
        {"top", std::numbers::pi * 1.25},
        {"inside", 6 * std::numbers::pi},
        {"outside", 9 * std::numbers::pi}},
       2e-4},
      {"graded_box_of_hexahedra",
       model::SolidBox{{-1, -1, -1}, {2, 2, 1}},
       {0.7, {{{0, 0, 0}, 0.05, 0.5}}, true},
       4.0,
       {{"left", 2}, {"right", 2}, {"front", 2}, {"back", 2}, {"bottom", 4}, {"top", 4}}},
      {"tube_of_hexahedra",
       model::SolidTube{{0, 0, 0}, {0, 3, 0}, 1, 1.5},
       {0.3, {}, true},
       std::numbers::pi * 1.25 * 3,
       {{"bottom", std::numbers::pi * 1.25},
        {"top", std::numbers::pi * 1.25},
        {"inside", 6 * std::numbers::pi},
        {"outside", 9 * std::numbers::pi}},
       2e-4},
      {"sphere",
       sphere(2, {0, 0, 0}),
       {0.5, {}},
       4.0 / 3.0 * std::numbers::pi * 8,
       {{"surface", 16 * std::numbers::pi}},
       2e-3},
      {"graded_quarter",
       sphere(2, {1, -1, 0}),
       {0.5, {{{1, -2, -1.5}, 0.1, 0.4}}},
       std::numbers::pi * 8 / 3,
       {{"surface", 4 * std::numbers::pi}, {"cut_x", 2 * std::numbers::pi}, {"cut_y", 2 * std::numbers::pi}},
       2e-3},
  };
  return all;
}

class Shapes : public testing::TestWithParam<std::size_t> {};

TEST_P(Shapes, HaveTheirVolumeAndTheAreasOfTheirFaces) {
  const Expected& expected = shapes()[GetParam()];
  const ShapedSolid solid = solid_of_shape(expected.shape, expected.sizes);
  EXPECT_EQ(static_cast<double>(solid.mesh.nodes.cols()), count_nodes(expected.shape, expected.sizes));
  const double tolerance = std::max(expected.tolerance, 1e-12);
  EXPECT_NEAR(volume_of(solid.mesh), expected.volume, tolerance * expected.volume);
  std::set<std::string> names;
  for (const auto& [name, facets] : solid.faces) {
    names.insert(name);
    ASSERT_TRUE(expected.areas.contains(name)) << name;
    EXPECT_NEAR(area_of(solid.mesh, facets), expected.areas.at(name), tolerance * expected.areas.at(name)) << name;
  }
  for (const std::string& name : model::face_names(expected.shape)) EXPECT_TRUE(names.contains(name)) << name;
}

TEST_P(Shapes, AreClosedAndNotFolded) {
  const Expected& expected = shapes()[GetParam()];
  const ShapedSolid solid = solid_of_shape(expected.shape, expected.sizes);
  for (const std::vector<int>& cell : solid.mesh.cells)
    ASSERT_GT(element::least_of_cell(nodes_of(solid.mesh, cell)), 1e-4);
  std::set<SolidFacet> of_faces;
  std::size_t count = 0;
  for (const auto& [name, facets] : solid.faces) {
    of_faces.insert(facets.begin(), facets.end());
    count += facets.size();
  }
  const std::vector<SolidFacet> boundary = boundary_facets(solid.mesh);
  EXPECT_EQ(of_faces, std::set<SolidFacet>(boundary.begin(), boundary.end()));
  EXPECT_EQ(count, boundary.size());
}

INSTANTIATE_TEST_SUITE_P(Simple, Shapes, testing::Range<std::size_t>(0, shapes().size()),
                         [](const auto& info) { return shapes()[info.param].name; });

TEST(ShapedSolid, HasTheSameCellsInOtherUnits) {
  const auto of = [](double unit) {
    return solid_of_shape(
               model::SolidBox{unit * Eigen::Vector3d(-41.3, -43.1, -20), unit * Eigen::Vector3d(85, 87, 20)},
               {unit * 20, {}})
        .mesh;
  };
  const SolidMesh one = of(1.0);
  for (const double unit : {1e-3, 1e-4, 3.7, 0.3048}) EXPECT_EQ(of(unit).cells, one.cells) << unit;
}

TEST(RefinedShapes, HaveTheWantedSizeAtTheirPoint) {
  const model::SolidBox box{{0, 0, 0}, {1, 1, 1}};
  const ShapedSolid solid = solid_of_shape(box, {0.25, {{{0, 0, 0}, 0.01, 0.3}}});
  double nearest = 1.0;
  for (Eigen::Index i = 0; i < solid.mesh.nodes.cols(); ++i)
    if (const double x = solid.mesh.nodes(0, i); x > 0.0) nearest = std::min(nearest, x);
  EXPECT_LE(2.0 * nearest, 0.0115);  // the first node is in the middle of an edge
  EXPECT_GE(2.0 * nearest, 0.008);
}

}  // namespace
}  // namespace scabo::mesh
