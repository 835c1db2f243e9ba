// Boundaries of open super-elements and of outside bodies: where the chain begins and ends, what is divided, which way
// it runs; and a contact between an outside body and one that stands in its hole.
#include <gtest/gtest.h>

#include <algorithm>

#include "scabo/input/read_model.hpp"
#include "scabo/mesh/mesh.hpp"

namespace scabo::mesh {
namespace {

model::Model read(const std::string& bodies, const std::string& more) {
  return input::parse_model("scabo: 1\nmaterials: {rock: {young: 1, poisson: 0.2}}\nbodies:\n" + bodies + more,
                            "test.yaml");
}

constexpr const char* held =
    "supports: [{on: plate.edge_1, fix: [x, y]}]\nloads: {p: {on: plate.edge_3, pressure: 1}}\n";

struct Chain {
  Vec2 centre;
  std::vector<Vec2> nodes;  // along the chain
  std::vector<int> numbers;
  double angle = 0.0;  // turned through about the centre
};
Chain chain_of(const Mesh& mesh, std::size_t b = 0) {
  const Cell& super_element = mesh.bodies[b].cells.front();
  Chain chain{super_element.centre, {}, {}, 0.0};
  for (const LineElement& element : super_element.boundary)
    for (std::size_t k = chain.numbers.empty() ? 0 : 1; k < element.nodes.size(); ++k) {
      chain.numbers.push_back(element.nodes[k]);
      chain.nodes.push_back(mesh.bodies[b].nodes[static_cast<std::size_t>(element.nodes[k])]);
    }
  for (std::size_t i = 0; i + 1 < chain.nodes.size(); ++i) {
    const Vec2 a = chain.nodes[i] - chain.centre, c = chain.nodes[i + 1] - chain.centre;
    chain.angle += std::atan2(cross(a, c), a.dot(c));
  }
  return chain;
}

TEST(OpenChain, OfACrackStartsAndEndsAtItsMouthWithTwoNodes) {
  const Chain chain =
      chain_of(make_mesh(read("  plate: {material: rock, shape: {polygon: {vertices: [[0, 0], [2, 0], [2, 2], [0, "
                              "2]]}}, mesh: {size: 0.7, order: 3}, "
                              "cracks: [{tip: [1, 1], mouth: [0, 1.2]}]}\n",
                              held)));
  EXPECT_EQ(chain.centre, Vec2(1, 1));
  EXPECT_EQ(chain.nodes.front(), Vec2(0, 1.2));
  EXPECT_EQ(chain.nodes.back(), Vec2(0, 1.2));
  EXPECT_NE(chain.numbers.front(), chain.numbers.back());
  EXPECT_NEAR(chain.angle, 2 * 3.14159265358979, 1e-12);
  // Edge 4 is cut at the mouth: 0.8 and 1.2 long, no element longer than asked for; every other edge as without the
  // crack.
  EXPECT_EQ(chain.nodes.size(), 1u + 3 * (3 + 3 + 3 + 2 + 2));
}

TEST(OpenChain, OfACrackWhoseMouthIsACorner) {
  const Chain chain =
      chain_of(make_mesh(read("  plate: {material: rock, shape: {polygon: {vertices: [[0, 0], [2, 0], [2, 2], [0, "
                              "2]]}}, mesh: {size: 1, order: 1}, "
                              "cracks: [{tip: [1, 1], mouth: [0, 2]}]}\n",
                              held)));
  EXPECT_EQ(chain.nodes.front(), Vec2(0, 2));
  EXPECT_EQ(chain.nodes.back(), Vec2(0, 2));
  EXPECT_EQ(chain.nodes.size(), 9u);
}

TEST(OpenChain, OfANotchLeavesItsFacesUndivided) {
  const Chain chain = chain_of(make_mesh(
      read("  plate: {material: rock, shape: {polygon: {vertices: [[0, 0], [1, 0], [1, 1], [2, 1], [2, 2], [0, 2]]}}, "
           "mesh: {size: 0.5, order: 2, centre: [1, 1]}}\n",
           "supports: [{on: plate.edge_1, fix: [x, y]}]\nloads: {p: {on: plate.edge_4, pressure: 1}}\n")));
  EXPECT_EQ(chain.nodes.front(), Vec2(2, 1));
  EXPECT_EQ(chain.nodes.back(), Vec2(1, 0));
  EXPECT_NEAR(chain.angle, 1.5 * 3.14159265358979, 1e-12);
  EXPECT_EQ(chain.nodes.size(), 1u + 2 * (2 + 4 + 4 + 2));
}

constexpr const char* trench =
    "  ground: {material: rock, outside: true, shape: {polygon: {vertices: [[0, 0], [-2, 0], [-2, -3], [2, -3], [2, "
    "0]]}}, "
    "mesh: {size: 1, order: 2, centre: [0, 0]}}\n";

TEST(OpenChain, OfAnOutsideBodyRunsAboutItsCentreAsThatOfAnInsideBody) {
  const model::Model model =
      read(trench, "loads: {p: {on: ground.edge_3, pressure: 1}}\nsupports: [{on: ground.edge_2, fix: x}]\n");
  EXPECT_LT(model.bodies[0].outline.area(), 0.0);  // the material on the left of the outline
  const Chain chain = chain_of(make_mesh(model));
  EXPECT_EQ(chain.centre, Vec2(0, 0));
  EXPECT_NEAR(std::abs(chain.angle), 3.14159265358979, 1e-12);
  EXPECT_GT(chain.angle, 0.0);
  EXPECT_NE(chain.numbers.front(), chain.numbers.back());
  EXPECT_NEAR(chain.nodes.front().y(), 0.0, 0.0);
  EXPECT_NEAR(chain.nodes.back().y(), 0.0, 0.0);
}

// A block stands on the floor of the trench: pairs in node order, the normal from the ground into the block or back, no
// gap.
TEST(OutsideBody, MeetsABlockInItsHole) {
  for (const char* between : {"[ground.edge_3, block.bottom]", "[block.bottom, ground.edge_3]"}) {
    const model::Model model =
        read(std::string(trench) +
                 "  block: {material: rock, shape: {rectangle: {corner: [-2, -3], size: [4, 1]}}, mesh: {size: 1, "
                 "order: 2}}\n",
             std::string("loads: {p: {on: block.top, pressure: 1}}\ncontacts: {seat: {between: ") + between +
                 ", friction: 0.3, gap: 1e-3}}\n");
    const Mesh mesh = make_mesh(model);
    ASSERT_EQ(mesh.interfaces.size(), 1u);
    ASSERT_EQ(mesh.interfaces[0].pairs.size(), 9u);
    const bool ground_first = model.contacts[0].a.body == 0;
    for (const ContactPair& pair : mesh.interfaces[0].pairs) {
      const Vec2 a = mesh.bodies[ground_first ? 0 : 1].nodes[static_cast<std::size_t>(pair.node_a)],
                 b = mesh.bodies[ground_first ? 1 : 0].nodes[static_cast<std::size_t>(pair.node_b)];
      EXPECT_LT((a - b).norm(), 1e-12);
      EXPECT_NEAR(pair.gap, 1e-3, 1e-15);
      EXPECT_NEAR(pair.normal.x(), 0.0, 1e-14);
      EXPECT_NEAR(pair.normal.y(), ground_first ? 1.0 : -1.0, 1e-14);
    }
  }
}

}  // namespace
}  // namespace scabo::mesh
