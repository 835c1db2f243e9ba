#include "scabo/mesh/space/facet_pairs.hpp"

#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <map>
#include <numbers>

#include "scabo/files/solid_abaqus.hpp"
#include "scabo/mesh/space/imported_solid.hpp"
#include "scabo/mesh/space/shaped_solid.hpp"
#include "support/solid_blocks.hpp"

namespace scabo::mesh {
namespace {

const Eigen::Vector3d up(0, 0, 1);

/// A block below z = 0 and one above z = 0.1, whose faces have 3 x 2 and `n` bricks, turned and moved together.
struct TwoBlocks {
  explicit TwoBlocks(int nodes_of_cell, double moved = 0.0, const Eigen::Vector3d& shift = Eigen::Vector3d::Zero())
      : lower(test::solid_block({0, 0, -1}, {1, 1, 0}, {3, 2, 1}, nodes_of_cell, moved, 1)),
        upper(test::solid_block({0, 0, 0.1}, {1, 1, 1}, {4, 5, 2}, nodes_of_cell, moved, 2)) {
    const std::vector<SolidFacet> top = test::facets_at(lower, {0, 0, 0}, up),
                                  bottom = test::facets_at(upper, {0, 0, 0.1}, -up);
    turn = Eigen::AngleAxisd(0.7, Eigen::Vector3d(1, 2, 3).normalized()).toRotationMatrix();
    lower.nodes = (turn * lower.nodes).colwise() + shift;
    upper.nodes = (turn * upper.nodes).colwise() + shift;
    facets_a = top, facets_b = bottom;
  }
  Face a() const { return {lower, facets_a}; }
  Face b() const { return {upper, facets_b}; }

  SolidMesh lower, upper;
  Eigen::Matrix3d turn;
  std::vector<SolidFacet> facets_a, facets_b;
};

Eigen::Vector3d mean_of(const SolidMesh& mesh, const std::vector<WeightedNode>& nodes) {
  Eigen::Vector3d sum = Eigen::Vector3d::Zero();
  for (const WeightedNode& at : nodes) sum += at.weight * mesh.nodes.col(at.node);
  return sum;
}

double sum_of(const std::vector<WeightedNode>& nodes) {
  double sum = 0.0;
  for (const WeightedNode& at : nodes) sum += at.weight;
  return sum;
}

class Faces : public testing::TestWithParam<int> {};

TEST_P(Faces, ArePairedWithWeightsOfEqualSumAndMoment) {
  const TwoBlocks blocks(GetParam(), 0.3, {1000, -2000, 500});
  ASSERT_EQ(why_no_pairs(blocks.a(), blocks.b()), std::nullopt);
  const std::vector<FacetPair> pairs = facet_pairs(blocks.a(), blocks.b());
  EXPECT_EQ(pairs.size(), 30);  // corners of 4 x 5 bricks
  double area = 0.0;
  for (const FacetPair& pair : pairs) {
    EXPECT_LT((pair.directions.col(0) - blocks.turn * up).norm(), 1e-12);
    EXPECT_LT((pair.directions.transpose() * pair.directions - Eigen::Matrix3d::Identity()).norm(), 1e-14);
    area += pair.area;
    EXPECT_NEAR(sum_of(pair.a), 1.0, 1e-12);
    EXPECT_NEAR(sum_of(pair.b), 1.0, 1e-12);
    EXPECT_NEAR(pair.gap, 0.1, 1e-11);
    const Eigen::Vector3d on_a = mean_of(blocks.lower, pair.a), on_b = mean_of(blocks.upper, pair.b);
    EXPECT_LT((on_b - on_a - 0.1 * pair.directions.col(0)).norm(), 1e-11);  // no moment but that of the gap
    EXPECT_LT((pair.point - on_b).norm(), 1e-11);
  }
  EXPECT_NEAR(area, 1.0, 1e-12);
}

TEST_P(Faces, OfTheSameMeshHaveTheAreasOfTheirCorners) {
  const SolidMesh lower = test::solid_block({0, 0, -1}, {2, 2, 0}, {2, 2, 1}, GetParam()),
                  upper = test::solid_block({0, 0, 0}, {2, 2, 1}, {2, 2, 1}, GetParam());
  const Face a{lower, test::facets_at(lower, {0, 0, 0}, up)}, b{upper, test::facets_at(upper, {0, 0, 0}, -up)};
  for (const FacetPair& pair : facet_pairs(a, b)) {
    double area = 0.0;
    for (const SolidFacet& facet : b.facets) {
      const auto corners = static_cast<std::ptrdiff_t>(corners_of(facet));
      if (std::count(facet.begin(), facet.begin() + corners, pair.corner) > 0)
        area += corners == 4 ? 1.0 / 4.0 : 0.5 / 3.0;
    }
    EXPECT_NEAR(pair.area, area, 1e-14);
  }
}

/// Of faces of which one is not plane: the weights of side B, which side A covers wholly, are at the corner, the other
/// corners of its facets and the middles of their edges that meet there. Of a tie they are also at those opposite.
TEST(QuadraticFaces, HavePairsWithoutWeightAtTheMiddlesOfEdgesOpposite) {
  SolidMesh lower = test::solid_block({0, 0, -1}, {1, 1, 0}, {3, 2, 1}, 10, 0.2, 1);
  const SolidMesh upper = test::solid_block({0, 0, 0}, {1, 1, 1}, {4, 5, 1}, 10, 0.2, 2);
  const Face a{lower, test::facets_at(lower, {0, 0, 0}, up)}, b{upper, test::facets_at(upper, {0, 0, 0}, -up)};
  lower.nodes(2, a.facets.front()[3]) -= 1e-2;
  for (const bool tied : {false, true})
    for (const FacetPair& pair : facet_pairs(a, b, tied)) {
      std::map<int, double> weights;
      for (const WeightedNode& at : pair.b) weights[at.node] = at.weight;
      Eigen::Vector3d mean = Eigen::Vector3d::Zero();
      for (const SolidFacet& facet : b.facets)
        for (std::size_t k = 0; k < 3; ++k) {
          if (facet[k] != pair.corner) continue;
          const Eigen::Matrix3d x = nodes_of(upper, {facet[k], facet[(k + 1) % 3], facet[(k + 2) % 3]});
          const Eigen::Vector3d e = x.col(1) - x.col(0), f = x.col(2) - x.col(0);
          // int phi_i psi_i, int phi_i psi_j over the area
          mean +=
              0.5 * e.cross(f).norm() * (x.col(0) / (tied ? 6.0 : 4.0) + (x.col(1) + x.col(2)) / (tied ? 12.0 : 24.0));
          if (tied)
            EXPECT_GT(weights.at(facet[3 + (k + 1) % 3]), 1e-2);
          else
            EXPECT_NEAR(weights.at(facet[3 + (k + 1) % 3]), 0.0, 1e-12);
          EXPECT_GT(weights.at(facet[3 + k]), 1e-2);
        }
      EXPECT_LT((pair.point - mean / pair.area).norm(), 1e-12);
    }
}

INSTANTIATE_TEST_SUITE_P(OfOneKind, Faces, testing::Values(4, 10, 15, 20));

/// Half of the upper face hangs over: pairs exist where the faces have something in common, and a corner with next to
/// nothing of it is united with another one.
TEST(OverlappingFaces, HavePairsOnTheirCommonPart) {
  const SolidMesh lower = test::solid_block({0, 0, -1}, {1, 1, 0}, {2, 2, 1}, 10);
  for (const double overhang : {0.5, 0.5 - 1e-5}) {
    const SolidMesh upper = test::solid_block({overhang, 0, 0}, {1 + overhang, 1, 1}, {4, 4, 1}, 10);
    const Face a{lower, test::facets_at(lower, {0, 0, 0}, up)}, b{upper, test::facets_at(upper, {0, 0, 0}, -up)};
    const std::vector<FacetPair> pairs = facet_pairs(a, b);
    EXPECT_EQ(pairs.size(), 15);
    double area = 0.0;
    Eigen::Vector3d moment = Eigen::Vector3d::Zero();
    for (const FacetPair& pair : pairs) {
      area += pair.area;
      moment += pair.area * pair.point;
      EXPECT_LT((mean_of(upper, pair.b) - mean_of(lower, pair.a)).norm(), 1e-10);
    }
    EXPECT_NEAR(area, 1.0 - overhang, 1e-12);
    EXPECT_NEAR(moment.x(), 0.5 * (1.0 - overhang * overhang), 1e-12);
  }
}

TEST(FacesOnEachOther, HaveGapsOfExactlyZeroWhereverTheyAre) {
  SolidMesh lower = test::solid_block({0, 0, -1}, {1, 1, 0}, {2, 2, 1}, 10, 0.2, 1),
            upper = test::solid_block({0, 0, 0}, {1, 1, 1}, {3, 3, 1}, 10, 0.2, 2);
  const std::vector<SolidFacet> top = test::facets_at(lower, {0, 0, 0}, up),
                                bottom = test::facets_at(upper, {0, 0, 0}, -up);
  const Eigen::Matrix3d turn = Eigen::AngleAxisd(1.1, Eigen::Vector3d(1, -2, 0.5).normalized()).toRotationMatrix();
  for (SolidMesh* mesh : {&lower, &upper})
    mesh->nodes = (turn * (mesh->nodes.colwise() + Eigen::Vector3d(20, -30, 10))).eval();
  for (const FacetPair& pair : facet_pairs({lower, top}, {upper, bottom})) EXPECT_EQ(pair.gap, 0.0);
}

TEST(FacesWithoutPairs, SayWhy) {
  TwoBlocks blocks(10);
  EXPECT_EQ(why_no_pairs({blocks.lower, {}}, blocks.b()), "the first face has no facets");
  EXPECT_EQ(why_no_pairs(blocks.a(), blocks.a()), "the faces do not face each other");
}

/// A bush in a ring, whose faces have a gap of 0.02: every pair sees it along its own normal.
TEST(CurvedFaces, HaveTheGapOfTheirSurfaces) {
  const auto tube = [](double inner, double outer, double size) {
    return solid_of_shape(model::SolidTube{{1, 2, 3}, {1, 2, 3.6}, inner, outer}, {size, {}});
  };
  const ShapedSolid ring = tube(1.02, 1.5, 0.25), bush = tube(0.6, 1.0, 0.2);
  const Face a{ring.mesh, ring.faces.at("inside")}, b{bush.mesh, bush.faces.at("outside")};
  ASSERT_EQ(why_no_pairs(a, b), std::nullopt);
  double area = 0.0;
  for (const FacetPair& pair : facet_pairs(a, b)) {
    area += pair.area;
    EXPECT_NEAR(sum_of(pair.a), 1.0, 1e-12);
    EXPECT_NEAR(sum_of(pair.b), 1.0, 1e-12);
    EXPECT_NEAR(pair.gap, 0.02, 2e-4);
    Eigen::Vector3d inwards = Eigen::Vector3d(1, 2, pair.point.z()) - pair.point;
    EXPECT_NEAR(inwards.norm(), 1.0, 5e-3);
    EXPECT_GT(inwards.normalized().dot(pair.directions.col(0)), 0.995);
  }
  EXPECT_NEAR(area, 2.0 * std::numbers::pi * 0.6, 0.02 * area);
}

/// A ball of radius 1 on a plane: at a distance x from the axis it leans by x. Of a rigid plane the normals are those.
TEST(CurvedFaces, AreSeenAlongTheLineThatBisectsTheirNormals) {
  const ShapedSolid block = solid_of_shape(model::SolidBox{{-1, -1, -1}, {2, 2, 1}}, {0.3, {}}),
                    ball = solid_of_shape(model::SolidSphere{{0, 0, 1}, 1.0, {}}, {0.2, {}});
  for (const bool rigid : {false, true}) {
    std::size_t near = 0;
    for (const FacetPair& pair :
         facet_pairs({block.mesh, block.faces.at("top"), rigid}, {ball.mesh, ball.faces.at("surface")})) {
      if (pair.point.head<2>().norm() > 0.4) continue;
      ++near;
      const Eigen::Vector3d n = pair.directions.col(0);
      const Eigen::Vector2d leaning = -pair.point.head<2>() / pair.point.head<2>().norm() * (rigid ? 0.0 : 1.0),
                            half = std::tan(0.5 * std::asin(pair.point.head<2>().norm())) * leaning;
      EXPECT_LT((n.head<2>() / n.z() - half).norm(), rigid ? 1e-12 : 0.02);
    }
    EXPECT_GT(near, 8U);
  }
}

TEST(SideOfThePairs, DoesNotChangeWithTheOrderOfTheFaces) {
  const TwoBlocks blocks(10, 0.2);
  EXPECT_TRUE(has_pairs_on_second(blocks.a(), blocks.b()));
  EXPECT_FALSE(has_pairs_on_second(blocks.b(), blocks.a()));
}

/// Surfaces of a file name the sides as its format does: S1 to S4 of the cell are all of its boundary, once each.
TEST(SolidOfAFile, HasItsSurfacesAndSetsAsFacets) {
  const std::string text =
      "*NODE\n1,0,0,0\n2,1,0,0\n3,0,1,0\n4,0,0,1\n5,.5,0,0\n6,.5,.5,0\n7,0,.5,0\n8,0,0,.5\n9,.5,0,.5\n10,0,.5,.5\n"
      "*ELEMENT, TYPE=C3D10, ELSET=All\n1,1,2,3,4,5,6,7,8,9,10\n*NSET, NSET=Front\n1,2,4\n"
      "*SURFACE, NAME=Bottom\n1,S1\n*SURFACE, NAME=Front\n1,S2\n*SURFACE, NAME=Slope\n1,S3\n*SURFACE, "
      "NAME=Left\n1,S4\n";
  const files::ImportedSolidMesh file = files::parse_solid_abaqus(text, "one.inp");
  const SolidMesh mesh = solid_mesh_of(file);
  const std::vector<SolidFacet> boundary = boundary_facets(mesh);
  const Eigen::Vector3d normals[4] = {{0, 0, -1}, {0, -1, 0}, {1, 1, 1}, {-1, 0, 0}};
  ASSERT_EQ(file.side_sets.size(), 4);
  for (std::size_t i = 0; i < 4; ++i) {
    const std::vector<SolidFacet> facets = facets_of_sides(mesh, file.side_sets[i].sides);
    ASSERT_EQ(facets.size(), 1);
    const Matrix x = nodes_of(mesh, facets[0]);
    const Eigen::Vector3d a = x.col(1) - x.col(0), b = x.col(2) - x.col(0);
    EXPECT_LT((a.cross(b) - normals[i]).norm(), 1e-15);
    EXPECT_LT((x.col(4) - 0.5 * (x.col(1) + x.col(2))).norm(), 1e-15);
    EXPECT_EQ(std::count(boundary.begin(), boundary.end(), facets[0]), 1);
  }
  EXPECT_EQ(facets_among(boundary, file.node_sets[0].nodes), facets_of_sides(mesh, file.side_sets[1].sides));
}

TEST(Boundary, OfABlockIsClosed) {
  const SolidMesh mesh = test::solid_block({0, 0, 0}, {1, 2, 3}, {2, 3, 4}, 10, 0.1);
  const std::vector<SolidFacet> facets = boundary_facets(mesh);
  EXPECT_EQ(facets.size(), 2 * 2 * (2 * 3 + 3 * 4 + 4 * 2));
  Eigen::Vector3d sum = Eigen::Vector3d::Zero();
  for (const SolidFacet& facet : facets) {
    const Matrix x = nodes_of(mesh, facet);
    for (int k = 0; k < 3; ++k) EXPECT_LT((x.col(3 + k) - 0.5 * (x.col(k) + x.col((k + 1) % 3))).norm(), 1e-15);
    const Eigen::Vector3d a = x.col(1) - x.col(0), b = x.col(2) - x.col(0);
    sum += 0.5 * a.cross(b);
    EXPECT_GT(a.cross(b).dot(x.col(0) - Eigen::Vector3d(0.5, 1.0, 1.5)), 0.0);  // outwards
  }
  EXPECT_LT(sum.norm(), 1e-14);
}

}  // namespace
}  // namespace scabo::mesh
