#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "models.hpp"
#include "scabo/geometry/line_basis.hpp"

namespace scabo::mesh {
namespace {

using test::arc;
using test::elastic;
using test::line;
using test::message_of;
using test::pi;
using testing::ElementsAre;
using testing::HasSubstr;

model::Model with(std::vector<model::Body> bodies) {
  model::Model model;
  model.file = "model.yaml";
  model.bodies = std::move(bodies);
  return model;
}

BodyMesh mesh_of(const model::Body& body) { return make_mesh(with({body})).bodies.front(); }

model::Body fem(model::Body body) {
  body.mesh.kind = model::MeshKind::fem;
  return body;
}

model::Outline quarter_disc() {
  return test::outline(
      {line("bottom", {0, 0}, {1, 0}), arc("rim", {0, 0}, 1.0, 0.0, pi / 2), line("left", {0, 1}, {0, 0})});
}

TEST(BoundaryDivision, GivesThePapersBeam80Nodes) {
  const BodyMesh mesh = mesh_of(elastic("lower", test::rectangle({0, 0}, {6, 1.5}), 0.375));
  EXPECT_EQ(mesh.nodes.size(), 80u);
  ASSERT_EQ(mesh.cells.size(), 1u);
  EXPECT_EQ(mesh.cells[0].boundary.size(), 40u);
  EXPECT_EQ(mesh.edges[2].size(), 16u);
  EXPECT_EQ(mesh.cells[0].kind, CellKind::superelement);
  EXPECT_THAT(mesh.corners, ElementsAre(0, 32, 40, 72));
  EXPECT_EQ(mesh.nodes[40], Vec2(6.0, 1.5));
}

// Near the corner elements have the length 0.01 + 0.1 r up to 0.5: their number along an edge of length 6 is the
// integral of 1 / length, 10 ln(1 + 10 (0.49 / 0.1)) + (6 - 4.9) / 0.5, rounded up.
TEST(BoundaryDivision, IsGradedWhereRefineAsks) {
  model::Body beam = elastic("beam", test::rectangle({0, 0}, {6, 1.5}), 0.5, 1);
  model::LocalSize near;
  near.near = Vec2(6, 0);
  near.size = 0.01;
  near.growth = 0.1;
  beam.mesh.refine = {near};
  for (const double scale : {1.0, 1e-3, 1e3}) {  // no unit counts
    model::Body scaled = elastic("beam", test::rectangle({0, 0}, {6 * scale, 1.5 * scale}), 0.5 * scale, 1);
    scaled.mesh.refine = beam.mesh.refine;
    *scaled.mesh.refine.front().near *= scale;
    scaled.mesh.refine.front().size *= scale;
    const BodyMesh mesh = mesh_of(scaled);
    const double bottom = std::ceil(10 * std::log(50.0) + 1.1 / 0.5), right = std::ceil(10 * std::log(16.0));
    EXPECT_EQ(mesh.edges[0].size(), static_cast<std::size_t>(bottom));
    EXPECT_EQ(mesh.edges[1].size(), static_cast<std::size_t>(right));
    for (const std::size_t edge : {0u, 1u, 2u, 3u})
      for (const LineElement& element : mesh.edges[edge]) {
        const Vec2 from = mesh.nodes[static_cast<std::size_t>(element.nodes.front())] / scale,
                   to = mesh.nodes[static_cast<std::size_t>(element.nodes.back())] / scale;
        const double middle = (0.5 * (from + to) - Vec2(6, 0)).norm();
        EXPECT_LE((to - from).norm(), 1.001 * std::min(0.5, 0.01 + 0.1 * middle));
        EXPECT_GE((to - from).norm(), 0.6 * std::min(0.5, 0.01 + 0.1 * middle));
      }
  }
}

TEST(BoundaryDivision, RunsCounterClockwiseAndCloses) {
  for (const int order : {1, 2, 3, 8}) {
    const BodyMesh mesh = mesh_of(elastic("disc", quarter_disc(), 0.4, order));
    int next = 0;
    for (const LineElement& element : mesh.cells[0].boundary) {
      ASSERT_EQ(element.nodes.size(), order + 1u);
      for (int i = 0; i <= order; ++i) {
        EXPECT_EQ(element.nodes[i], (next + i) % static_cast<int>(mesh.nodes.size()));
      }
      next += order;
    }
    EXPECT_EQ(next, static_cast<int>(mesh.nodes.size()));
    double area = 0.0;
    for (int i = 0; i < next; ++i) area += 0.5 * cross(mesh.nodes[i], mesh.nodes[(i + 1) % next]);
    EXPECT_GT(area, 0.7);
  }
}

TEST(BoundaryDivision, TakesTheSizeAsTheLongestElement) {
  const auto elements = [](double length, double size) {
    return mesh_of(elastic("bar", test::rectangle({0, 0}, {length, 1}), size)).edges[0].size();
  };
  EXPECT_EQ(elements(1.0, 0.3), 4u);
  EXPECT_EQ(elements(1.0, 7.0), 1u);
  EXPECT_EQ(elements(6.0, 0.1), 60u);  // 6 / 0.1 rounds to more than 60
  EXPECT_EQ(elements(0.7, 0.1), 7u);
}

TEST(BoundaryDivision, PutsNodesOfAnArcOnTheArcAtEqualArcLength) {
  const BodyMesh mesh = mesh_of(elastic("disc", quarter_disc(), 0.2, 3));
  const std::vector<LineElement>& rim = mesh.edges[1];
  ASSERT_EQ(rim.size(), 8u);
  const std::vector<double> points = geometry::lobatto_points(3);
  for (std::size_t k = 0; k < rim.size(); ++k) {
    for (int i = 0; i <= 3; ++i) {
      const Vec2 x = mesh.nodes[rim[k].nodes[i]];
      const double angle = pi / 2 * (static_cast<double>(k) + 0.5 * (1 + points[i])) / 8;
      EXPECT_LT((x - test::polar({0, 0}, 1.0, angle)).norm(), 1e-15);
    }
  }
}

TEST(BoundaryDivision, LetsNoElementTurnByMoreThan60Degrees) {
  const BodyMesh mesh = mesh_of(elastic("disc", quarter_disc(), 100.0));
  EXPECT_EQ(mesh.edges[0].size(), 1u);
  EXPECT_EQ(mesh.edges[1].size(), 2u);
}

TEST(BoundaryDivision, ClosesACircleOfOneEdge) {
  model::Model model = with({elastic("disc", test::outline({arc("rim", {0, 0}, 1.0, 0.3, 2 * pi)}), 100.0)});
  model.bodies[0].mesh.centre = {0, 0};
  const Mesh mesh = make_mesh(model);
  EXPECT_EQ(mesh.nodes(), 12);
  model::Place rim = test::edge_of(model, "disc", "rim");
  EXPECT_EQ(nodes_of(rim, mesh).nodes.size(), 12u);
  EXPECT_EQ(nodes_of(rim, mesh).elements.size(), 6u);
}

// The scaling centre lies between the arc and its chord.
TEST(BoundaryDivision, NamesAnArcThatItsElementsHide) {
  const Vec2 start = test::polar({0, 0}, 1.0, -pi / 6);
  const Vec2 end = test::polar({0, 0}, 1.0, pi / 6);
  model::Body cap = elastic("cap",
                            test::outline({arc("rim", {0, 0}, 1.0, -pi / 6, pi / 3), line("upper", end, {0, 0}),
                                           line("lower", {0, 0}, start)}),
                            100.0, 1);
  cap.mesh.centre = {0.9, 0.0};
  const std::string message = message_of(with({cap}));
  EXPECT_THAT(message, HasSubstr("model.yaml:7:11: bodies.cap.mesh: the arc cap.rim in 1 element of order 1 is not "
                                 "entirely visible from the scaling centre (0.9, 0)"));
  EXPECT_THAT(message, HasSubstr("use a smaller 'size' or a higher 'order', or set 'centre'"));
  cap.mesh.size = 0.1;
  EXPECT_EQ(message_of(with({cap})), "no error");
}

TEST(BoundaryDivision, NamesAnEdgeThatTheCentreDoesNotSee) {
  model::Body block = elastic("block", test::rectangle({0, 0}, {1, 1}), 0.5);
  block.mesh.centre = {1.5, 0.5};
  EXPECT_THAT(message_of(with({block})),
              HasSubstr("the edge block.right is not entirely visible from the scaling centre"));
  block.mesh.centre = {1.0, 0.5};  // on the edge itself
  EXPECT_THAT(message_of(with({block})), HasSubstr("the edge block.right is not entirely visible"));
}

TEST(BoundaryDivision, RefusesMeshesTooLargeToBeMeant) {
  const model::Body block = elastic("block", test::rectangle({0, 0}, {1, 1}), 1e-9);
  EXPECT_EQ(message_of(with({block})),
            "model.yaml:7:11: bodies.block.mesh: size 1e-09 would give 8e+09 nodes, more than the 4000000 allowed: use "
            "a larger 'size'");
  EXPECT_THAT(message_of(with({fem(block)})), HasSubstr("3e+18 nodes"));
  EXPECT_THAT(message_of(with({elastic("block", test::rectangle({0, 0}, {1, 1}), 1e-300)})), HasSubstr("8e+300"));
  const model::Body large = elastic("large", test::rectangle({0, 0}, {1, 1}), 2.5e-6);
  EXPECT_THAT(message_of(with({large, large})), HasSubstr("with body 'large' the model would have 6.4e+06 nodes"));
}

TEST(BoundaryDivision, TellsOnceThatCopiesAreTooManyTogether) {
  // 4 edges in 200,000 elements of order 2: 1,600,000 nodes each.
  model::Body block = elastic("block_1", test::rectangle({0, 0}, {1, 1}), 5e-6);
  std::vector<model::Body> blocks(5, block);
  for (int b = 1; b < 5; ++b) blocks[static_cast<std::size_t>(b)].name = "block_" + std::to_string(b + 1);
  EXPECT_EQ(
      message_of(with(blocks)),
      "model.yaml:7:11: bodies.block_1.mesh: with body 'block_3' the model would have 4.8e+06 nodes, more than the "
      "4000000 allowed: use larger mesh sizes or fewer bodies");
  // 999,998 elements on each of two edges, and two on each of the others: 8 nodes above the limit with the small one.
  model::Body large = elastic("large", test::rectangle({0, 0}, {1, 1.9 / 999998}), 1.0 / 999998);
  large.mesh.order = 2;
  const model::Body small = elastic("small", test::rectangle({5, 0}, {1, 1}), 1.0, 2);
  EXPECT_THAT(message_of(with({large, small})), HasSubstr("would have 4000008 nodes, more than the 4000000 allowed"));
}

TEST(BoundaryDivision, ReportsEveryBodysMistakesAtOnce) {
  model::Body hidden = elastic("hidden", test::rectangle({0, 0}, {1, 1}), 0.5);
  hidden.mesh.centre = {2, 2};
  const model::Body fine = elastic("fine", test::rectangle({0, 0}, {1, 1}), 1e-9);
  try {
    make_mesh(with({hidden, fine}));
    FAIL();
  } catch (const InputError& error) {
    EXPECT_EQ(error.file(), "model.yaml");
    EXPECT_EQ(error.diagnostics().size(), 3u);  // two edges of `hidden`, the size of `fine`
  }
}

TEST(Grid, NumbersNodesRowByRow) {
  const BodyMesh mesh = mesh_of(fem(elastic("plate", test::rectangle({1, 2}, {2, 1}), 1.0)));
  ASSERT_EQ(mesh.nodes.size(), 13u);
  ASSERT_EQ(mesh.cells.size(), 2u);
  EXPECT_EQ(mesh.count(CellKind::finite_element), 2);
  EXPECT_THAT(mesh.cells[0].nodes(), ElementsAre(0, 1, 2, 6, 10, 9, 8, 5));
  EXPECT_THAT(mesh.cells[1].nodes(), ElementsAre(2, 3, 4, 7, 12, 11, 10, 6));
  EXPECT_THAT(mesh.corners, ElementsAre(0, 4, 12, 8));
  EXPECT_THAT(mesh.edges[0][0].nodes, ElementsAre(0, 1, 2));
  EXPECT_THAT(mesh.edges[0][1].nodes, ElementsAre(2, 3, 4));
  EXPECT_THAT(mesh.edges[1][0].nodes, ElementsAre(4, 7, 12));
  EXPECT_THAT(mesh.edges[2][0].nodes, ElementsAre(12, 11, 10));
  EXPECT_THAT(mesh.edges[2][1].nodes, ElementsAre(10, 9, 8));
  EXPECT_THAT(mesh.edges[3][0].nodes, ElementsAre(8, 5, 0));
  EXPECT_EQ(mesh.nodes[12], Vec2(3, 3));
  EXPECT_EQ(mesh.nodes[6], Vec2(2, 2.5));
}

TEST(Grid, PutsMidsideNodesInTheMiddleAlsoWhenTurned) {
  const test::Similarity turn{37 * pi / 180, 1.0, {3, -2}};
  const model::Model model = turn(with({fem(elastic("plate", test::rectangle({0, 0}, {6, 1.5}), 0.4))}));
  const BodyMesh mesh = make_mesh(model).bodies[0];
  EXPECT_EQ(mesh.cells.size(), 15u * 4u);
  EXPECT_EQ(mesh.nodes.size(), 31u * 5u + 16u * 4u);
  double area = 0.0;
  for (const Cell& cell : mesh.cells) {
    for (const LineElement& side : cell.boundary) {
      const Vec2 a = mesh.nodes[side.nodes[0]];
      const Vec2 b = mesh.nodes[side.nodes[2]];
      EXPECT_LT((mesh.nodes[side.nodes[1]] - 0.5 * (a + b)).norm(), 1e-14);
      area += 0.5 * cross(a, b);
    }
  }
  EXPECT_NEAR(area, 9.0, 1e-13);
}

TEST(Grid, HasTheEdgeNodesOfASuperElementOfOrderTwo) {
  const model::Body body = elastic("plate", test::rectangle({0, 0}, {6, 1.5}), 0.4);
  const BodyMesh boundary = mesh_of(body);
  const BodyMesh grid = mesh_of(fem(body));
  for (int e = 0; e < 4; ++e) {
    ASSERT_EQ(grid.edges[e].size(), boundary.edges[e].size());
    for (std::size_t k = 0; k < grid.edges[e].size(); ++k) {
      for (int i = 0; i < 3; ++i) {
        EXPECT_LT((grid.nodes[grid.edges[e][k].nodes[i]] - boundary.nodes[boundary.edges[e][k].nodes[i]]).norm(),
                  2e-15);
      }
    }
  }
}

TEST(Grid, OfOrderOneHasTheCornersOnly) {
  const BodyMesh mesh = mesh_of(fem(elastic("plate", test::rectangle({1, 2}, {3, 2}), 1.0, 1)));
  EXPECT_EQ(mesh.nodes.size(), 4u * 3u);
  ASSERT_EQ(mesh.cells.size(), 6u);
  EXPECT_EQ(mesh.nodes[5], Vec2(2, 3));
  EXPECT_EQ(mesh.cells[4].nodes(), (std::vector<int>{5, 6, 10, 9}));
  ASSERT_EQ(mesh.edges[2].size(), 3u);
  EXPECT_EQ(mesh.edges[2][0].nodes, (std::vector<int>{11, 10}));
  EXPECT_EQ(mesh.edges[3][1].nodes, (std::vector<int>{4, 0}));
  EXPECT_EQ(mesh.corners, (std::vector<int>{0, 3, 11, 8}));
}

TEST(Grid, TakesTrianglesForOtherShapesAndOrderOneOrTwo) {
  const BodyMesh disc = mesh_of(fem(elastic("disc", quarter_disc(), 0.1)));
  EXPECT_EQ(disc.count(CellKind::finite_element), static_cast<int>(disc.cells.size()));
  for (const Cell& cell : disc.cells) EXPECT_EQ(cell.boundary.size(), 3u);
  EXPECT_THAT(message_of(with({fem(elastic("plate", test::rectangle({0, 0}, {1, 1}), 0.1, 3))})),
              HasSubstr("elements of order 1 or 2, not 3"));
}

TEST(Places, NameNodes) {
  const model::Model model = with(
      {elastic("block", test::rectangle({0, 0}, {2, 1}), 1.0), test::rigid("floor", test::rectangle({0, -1}, {2, 1}))});
  const Mesh mesh = make_mesh(model);
  EXPECT_EQ(mesh.nodes(), 12);

  model::Place place = test::edge_of(model, "block", "left");
  EXPECT_THAT(nodes_of(place, mesh).nodes, ElementsAre(10, 11, 0));
  EXPECT_EQ(nodes_of(place, mesh).elements.size(), 1u);
  place.kind = model::Place::Kind::corner;
  place.index = 2;
  EXPECT_THAT(nodes_of(place, mesh).nodes, ElementsAre(6));
  EXPECT_TRUE(nodes_of(place, mesh).elements.empty());
  place.kind = model::Place::Kind::near;
  place.near = {1.4, 3.0};
  EXPECT_THAT(nodes_of(place, mesh).nodes, ElementsAre(7));  // (1.5, 1)
  place.kind = model::Place::Kind::body;
  EXPECT_EQ(nodes_of(place, mesh).nodes.size(), 12u);
  place.body = 1;
  EXPECT_TRUE(nodes_of(place, mesh).nodes.empty());
  EXPECT_TRUE(nodes_of(test::edge_of(model, "floor", "top"), mesh).nodes.empty());
}

TEST(Places, NearMeansABoundaryNodeOfAGridToo) {
  const model::Model model = with({fem(elastic("plate", test::rectangle({0, 0}, {4, 4}), 1.0))});
  const Mesh mesh = make_mesh(model);
  model::Place place;
  place.kind = model::Place::Kind::near;
  place.body = 0;
  place.near = {2.0, 1.4};
  const Vec2 x = mesh.bodies[0].nodes[nodes_of(place, mesh).nodes.at(0)];
  EXPECT_EQ(x, Vec2(2.0, 0.0));
}

}  // namespace
}  // namespace scabo::mesh
