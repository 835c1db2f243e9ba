#include "scabo/system/loads.hpp"

#include <gtest/gtest.h>

#include "scabo/element/plane/stiffness.hpp"
#include "scabo/system/contact_system.hpp"
#include "scabo/system/structure.hpp"
#include "theory/rings.hpp"
#include "unit/mesh/models.hpp"

namespace scabo::system {
namespace {

Vec2 total(const Vector& f) { return f.reshaped(2, f.size() / 2).rowwise().sum(); }

double moment(const Vector& f, const std::vector<Vec2>& nodes) {
  double sum = 0.0;
  for (std::size_t i = 0; i < nodes.size(); ++i)
    sum += cross(nodes[i], Vec2(f.segment<2>(static_cast<Eigen::Index>(2 * i))));
  return sum;
}

mesh::BodyMesh mesh_of(const model::Body& body) {
  model::Model model;
  model.bodies = {body};
  return mesh::make_mesh(model).bodies.front();
}

TEST(TractionForces, HaveTheForceAndMomentOfALinearTractionOnALine) {
  for (int order = 1; order <= 8; ++order) {
    const auto body = mesh_of(test::elastic("beam", test::rectangle({1, 2}, {6, 1.5}), 2.0, order));
    const double thickness = 0.3;
    const Vector f = traction_forces(body.edges[2], body.nodes, thickness, [](const Vec2& x, const Vec2& n) {
      EXPECT_LT((n - Vec2(0, 1)).norm(), 1e-13);
      return Vec2(5.0, -2.0 * x.x());
    });
    // y = 3.5, 1 <= x <= 7: int x = 24, int x^2 = 114.
    EXPECT_LT((total(f) - thickness * Vec2(30.0, -48.0)).norm(), 1e-14 * 48.0);
    EXPECT_NEAR(moment(f, body.nodes), thickness * (-2.0 * 114.0 - 3.5 * 30.0), 1e-12);
    EXPECT_NEAR(area_of(body.edges[2], body.nodes, 1.0), 6.0, 6e-14);
  }
}

// The pressure on a closed curve has no resultant, and on an open one that on its chord: exact for any
// division.
TEST(TractionForces, OfPressureOnAnArcIsThatOnItsChord) {
  const model::Outline half_disc =
      test::outline({test::line("bottom", {-2, 0}, {2, 0}), test::arc("rim", {0, 0}, 2.0, 0.0, test::pi)});
  for (int order = 1; order <= 6; ++order) {
    model::Body body = test::elastic("disc", half_disc, 0.9, order);
    body.mesh.centre = {0.0, 0.8};
    const auto mesh = mesh_of(body);
    const auto press = [](const Vec2&, const Vec2& n) { return Vec2(-7.0 * n); };
    EXPECT_LT((total(traction_forces(mesh.edges[1], mesh.nodes, 0.5, press)) - Vec2(0.0, -7.0 * 4.0 * 0.5)).norm(),
              1e-13);
    EXPECT_LT(total(traction_forces(mesh.cells[0].boundary, mesh.nodes, 0.5, press)).norm(), 1e-13);
  }
}

// A force that acts at a place of an edge, wherever that is: its sum and its moment, and nothing beyond the ends.
TEST(ForcesAtAPlace, HaveTheForceAndItsMoment) {
  const Vec2 force(3.0, -5.0);
  for (int order = 1; order <= 4; ++order) {
    const auto beam = mesh_of(test::elastic("beam", test::rectangle({1, 2}, {6, 1.5}), 2.0, order));
    const model::Edge top = test::rectangle({1, 2}, {6, 1.5}).edges[2];  // from (7, 3.5) to (1, 3.5)
    for (const double place : {0.0, 0.7, 2.0, 3.1, 6.0}) {
      const Vector f = forces_at_place(beam.edges[2], beam.nodes, top, place, force);
      EXPECT_LT((total(f) - force).norm(), 1e-14);
      EXPECT_NEAR(moment(f, beam.nodes), cross(Vec2(7.0 - place, 3.5), force), 1e-12);
    }
    for (const double place : {-0.1, 6.1})
      EXPECT_TRUE(forces_at_place(beam.edges[2], beam.nodes, top, place, force).isZero(0.0));
  }
  const model::Outline half_disc =
      test::outline({test::line("bottom", {-2, 0}, {2, 0}), test::arc("rim", {0, 0}, 2.0, 0.0, test::pi)});
  model::Body disc = test::elastic("disc", half_disc, 0.5, 4);
  disc.mesh.centre = {0.0, 0.8};
  const auto mesh = mesh_of(disc);
  for (const double angle : {0.0, 0.3, 1.9, 3.1}) {
    const Vector f = forces_at_place(mesh.edges[1], mesh.nodes, half_disc.edges[1], 2.0 * angle, force);
    EXPECT_LT((total(f) - force).norm(), 1e-13);
    EXPECT_NEAR(moment(f, mesh.nodes), cross(2.0 * Vec2(std::cos(angle), std::sin(angle)), force), 1e-4);
  }
}

TEST(TractionForces, LengthOfAnArcConverges) {
  double before = 1.0;
  for (int order : {1, 2, 3, 4}) {
    model::Body body = test::elastic(
        "disc", test::outline({test::line("bottom", {-2, 0}, {2, 0}), test::arc("rim", {0, 0}, 2.0, 0.0, test::pi)}),
        0.9, order);
    body.mesh.centre = {0.0, 0.8};
    const auto mesh = mesh_of(body);
    const double error = std::abs(area_of(mesh.edges[1], mesh.nodes, 1.0) - 2.0 * test::pi);
    EXPECT_LT(error, 0.1 * before);
    before = error;
  }
}

/// Two blocks of different size elements' edges alike, one on the other; the lower one on supports.
struct TwoBlocks {
  model::Model model;
  mesh::Mesh mesh;
  Structure structure;

  TwoBlocks() {
    model = test::pair_of(test::elastic("lower", test::rectangle({0, 0}, {3, 1}), 0.75), "top",
                          test::elastic("upper", test::rectangle({0, 1}, {3, 2}), 0.75), "bottom");
    model.contacts[0].friction = 0.4;
    model.materials.resize(1);
    model.materials[0].young = 100.0;
    model.materials[0].poisson = 0.2;
    model.analysis.thickness = 0.5;
    model::Support support;
    support.on = test::edge_of(model, "lower", "bottom");
    support.displacement = {0.0, 0.0};
    model.supports = {support};
    model.steps.resize(1);
    model.steps[0].support_factors = {1.0};
    mesh = mesh::make_mesh(model);
    structure = make_structure(model, mesh, element::solve_cells(model, mesh, 1));
  }
};

// relative motion = q + W p + G a: column by column what equal and opposite unit forces on a pair do.
TEST(Condensation, IsTheMotionOfThePairsUnderUnitPairForces) {
  const TwoBlocks blocks;
  const ContactSystem system = condense(blocks.structure, blocks.model, blocks.mesh);
  const auto N = static_cast<Eigen::Index>(system.pairs.size());
  ASSERT_EQ(N, 9);
  ASSERT_EQ(system.rigid_motions(), 3);
  EXPECT_EQ(system.first_rigid[0], 0);
  ASSERT_EQ(system.laws.of_pair.size(), static_cast<std::size_t>(N));
  for (const auto& law : system.laws.of_pair) EXPECT_EQ(law->limits({}), (contact::Limits{.mu = 0.4}));
  EXPECT_LT(test::largest(system.gap), 1e-15);
  EXPECT_EQ(system.W.dense(), system.W.dense().transpose());
  const auto& pairs = blocks.mesh.interfaces[0].pairs;
  const auto motion = [&](const Vector& lower, const Vector& upper) {
    Vector result(2 * N);
    for (Eigen::Index i = 0; i < N; ++i) {
      const auto& pair = pairs[static_cast<std::size_t>(i)];
      const Vec2 relative = upper.segment<2>(2 * pair.node_b) - lower.segment<2>(2 * pair.node_a);
      result[2 * i] = relative.dot(pair.normal);
      result[2 * i + 1] = relative.dot(tangent_of(pair.normal));
    }
    return result;
  };
  for (Eigen::Index j = 0; j < 2 * N; ++j) {
    const auto& pair = pairs[static_cast<std::size_t>(j / 2)];
    const Vec2 direction = j % 2 == 0 ? pair.normal : tangent_of(pair.normal);
    Vector on_lower = Vector::Zero(blocks.structure.parts[0]->size()),
           on_upper = Vector::Zero(blocks.structure.parts[1]->size());
    on_lower.segment<2>(2 * pair.node_a) = -direction;
    on_upper.segment<2>(2 * pair.node_b) = direction;
    const auto held = static_cast<Eigen::Index>(blocks.structure.parts[0]->constraints().size());
    const Vector expected = motion(blocks.structure.parts[0]->displacement(on_lower, Vector::Zero(held)),
                                   blocks.structure.parts[1]->displacement(on_upper, Vector()));
    EXPECT_LT(test::largest(system.W.dense().col(j) - expected), 1e-13 * test::largest(system.W.dense()));
  }
  for (Eigen::Index k = 0; k < 3; ++k)
    EXPECT_LT(test::largest(system.G.dense().col(k) - motion(Vector::Zero(blocks.structure.parts[0]->size()),
                                                             blocks.structure.parts[1]->rigid_motions().col(k))),
              1e-14);
}

}  // namespace
}  // namespace scabo::system
