// The same double cantilever beam told in other ways: the same answer, the same number of iterations.
#include <fmt/format.h>

#include <cmath>
#include <numbers>

#include "run.hpp"

namespace scabo::verification {
namespace {

/// How the double cantilever beam (Zhu et al. 2017) is written down.
struct Telling {
  double length = 1.0;  ///< units of length in a metre
  double force = 1.0;   ///< units of force in a newton
  double turned = 0.0;  ///< degrees
  bool swapped = false, upper_first = false;
};

std::string double_cantilever(const Telling& telling) {
  const double angle = telling.turned * std::numbers::pi / 180.0;
  const auto point = [&](double x, double y) {
    const double c = std::cos(angle), s = std::sin(angle), m = telling.length;
    return fmt::format("[{}, {}]", m * (c * x - s * y), m * (s * x + c * y));
  };
  const auto body = [&](const char* name, double y) {
    return fmt::format(
        "  {}: {{material: concrete, shape: {{polygon: {{vertices: [{}, {}, {}, {}], names: {{bottom: edge_1, "
        "top: edge_3, left: edge_4, tip: vertex_3}}}}}}, mesh: {{size: {}}}}}\n",
        name, point(0, y), point(6, y), point(6, y + 1.5), point(0, y + 1.5), 0.375 * telling.length);
  };
  const std::string lower = body("lower", 0.0), upper = body("upper", 1.5);
  const double F = -100e3 * telling.force;
  return fmt::format(
      "scabo: 1\nanalysis: {{thickness: {}}}\nmaterials: {{concrete: {{young: {}, poisson: 0.3}}}}\nbodies:\n{}{}"
      "supports:\n  - {{on: lower.left, fix: [x, y]}}\n  - {{on: upper.left, fix: [x, y]}}\n"
      "loads:\n  tip: {{on: upper.tip, force: [{}, {}]}}\n"
      "contacts:\n  joint: {{between: [{}], friction: 0.2}}\n",
      telling.length, 10e9 * telling.force / (telling.length * telling.length), telling.upper_first ? upper : lower,
      telling.upper_first ? lower : upper, -std::sin(angle) * F, std::cos(angle) * F,
      telling.swapped ? "upper.bottom, lower.top" : "lower.top, upper.bottom");
}

struct Named {
  const char* name;
  Telling telling;
};
void PrintTo(const Named& named, std::ostream* out) { *out << named.name; }

class Invariance : public testing::TestWithParam<Named> {};

TEST_P(Invariance, SameAnswer) {
  const auto reference_solution = run(double_cantilever({}));
  const auto solution = run(double_cantilever(GetParam().telling));
  const analysis::IncrementResult& reference = last(reference_solution);
  const analysis::IncrementResult& told = last(solution);
  const analysis::ContactResult &expected = reference.contacts.front(), &contact = told.contacts.front();
  const double force = GetParam().telling.force, length = GetParam().telling.length;
  EXPECT_NEAR(expected.normal_force, 53.64e3, 10.0);
  EXPECT_NEAR(contact.normal_force / force, expected.normal_force, 1e-9 * expected.normal_force);
  ASSERT_EQ(contact.pairs.size(), expected.pairs.size());
  for (std::size_t i = 0; i < contact.pairs.size(); ++i) {
    const analysis::PairResult &a = expected.pairs[i], &b = contact.pairs[i];
    EXPECT_EQ(a.state, b.state) << "pair " << a.pair;
    EXPECT_NEAR(b.normal_force / force, a.normal_force, 1e-8 * expected.normal_force);
    EXPECT_NEAR(b.tangential_force / force, a.tangential_force, 1e-8 * expected.normal_force);
    EXPECT_NEAR(b.gap / length, a.gap, 1e-9 * expected.max_gap);
    EXPECT_NEAR(b.slip / length, a.slip, 1e-9 * expected.max_gap);
    EXPECT_NEAR(b.pressure * length * length / force, a.pressure, 1e-8 * expected.max_pressure);
  }
}

INSTANTIATE_TEST_SUITE_P(
    Tellings, Invariance,
    testing::Values(Named{"millimetres", {.length = 1e3}}, Named{"centimetres_kN", {.length = 1e2, .force = 1e-3}},
                    Named{"swapped", {.swapped = true}}, Named{"turned", {.turned = 37.0}},
                    Named{"upper_first", {.upper_first = true}},
                    Named{"all_at_once",
                          {.length = 1e3, .force = 1e-3, .turned = -53.0, .swapped = true, .upper_first = true}}),
    [](const auto& parameter) { return parameter.param.name; });

// Thickness is in the unit of length, and the answer must not depend on how a model is thick: forces do.
TEST(Invariance, TwiceAsThickUnderTwiceTheLoad) {
  const std::string model = double_cantilever({});
  const auto thin = run(model), thick = run(model, {"analysis.thickness=2", "loads.tip.force=[0, -200e3]"});
  EXPECT_NEAR(last(thick).contacts.front().normal_force, 2.0 * last(thin).contacts.front().normal_force, 1e-4);
  EXPECT_NEAR(last(thick).contacts.front().max_pressure, last(thin).contacts.front().max_pressure, 1e-4);
}

// Two bodies of many cells, with a hole, a crack, a region and meshes that do not match: the mesh, and so every digit
// but the last, does not know the unit of length or where the origin lies.
struct Twin {
  const char* name;
  double length = 1.0;
  Vec2 move = Vec2::Zero();  // in metres
};

std::string block_on_cracked_plate(const Twin& twin, const char* lower, const char* upper) {
  const auto point = [&](double x, double y) {
    return fmt::format("[{:.17g}, {:.17g}]", twin.length * (x + twin.move.x()), twin.length * (y + twin.move.y()));
  };
  const double m = twin.length, pascal = 1.0 / (m * m);
  const std::string crack = std::string(lower) == "fem"
                                ? ""
                                : fmt::format("    cracks: [{{name: c, path: [{}, {}, {}]}}]\n", point(0.3, 0.3),
                                              point(0.6, 0.4), point(0.8, 0.3));
  return fmt::format(
      "scabo: 1\nanalysis: {{plane: strain, thickness: {}}}\n"
      "materials: {{a: {{young: {}, poisson: 0.3}}, b: {{young: {}, poisson: 0.25}}}}\nbodies:\n  low:\n"
      "    material: a\n    shape: {{polygon: {{vertices: [{}, {}, {}, {}]}}}}\n"
      "    holes: {{h: {{circle: {{centre: {}, radius: {:.17g}}}}}}}\n"
      "    regions: {{r: {{material: b, shape: {{polygon: {{vertices: [{}, {}, {}]}}}}}}}}\n{}"
      "    mesh: {{kind: {}, size: {:.17g}, refine: [{{near: {}, size: {:.17g}}}]}}\n"
      "  up: {{material: b, shape: {{polygon: {{vertices: [{}, {}, {}, {}]}}}}, mesh: {{kind: {}, size: {:.17g}}}}}\n"
      "supports: [{{on: low.edge_1, fix: [x, y]}}]\n"
      "loads: {{p: {{on: up.edge_3, traction: [{:.17g}, {:.17g}]}}}}\n"
      "contacts: {{joint: {{between: [low.edge_3, up.edge_1], friction: 0.35}}}}\n",
      m, 200e9 * pascal, 70e9 * pascal, point(0, 0), point(3, 0), point(3, 1), point(0, 1), point(2.3, 0.5), 0.2 * m,
      point(1.2, 0.3), point(1.8, 0.35), point(1.5, 0.8), crack, lower, 0.21 * m, point(1, 1), 0.05 * m, point(0.5, 1),
      point(2.5, 1), point(2.5, 2), point(0.5, 2), upper, 0.17 * m, 3e5 * pascal, -1e6 * pascal);
}

TEST(Invariance, MeshesOfManyCellsDoNotKnowTheUnitOfLength) {
  for (const auto& [lower, upper] :
       {std::pair("polygons", "quadtree"), std::pair("quadtree", "fem"), std::pair("fem", "polygons")}) {
    const auto reference_solution = run(block_on_cracked_plate({"m"}, lower, upper));
    const analysis::IncrementResult& expected = last(reference_solution);
    for (const Twin& twin :
         {Twin{"mm", 1e3}, Twin{"inches", 1.0 / 0.0254}, Twin{"km", 1e-3}, Twin{"far", 1.0, {3000, -2000}}}) {
      SCOPED_TRACE(fmt::format("{} on {}, {}", upper, lower, twin.name));
      const auto solution = run(block_on_cracked_plate(twin, lower, upper));
      const analysis::IncrementResult& told = last(solution);
      const analysis::ContactResult &a = expected.contacts.front(), &b = told.contacts.front();
      ASSERT_EQ(a.pairs.size(), b.pairs.size());
      EXPECT_NEAR(b.normal_force, a.normal_force, 1e-10 * a.normal_force);
      EXPECT_NEAR(b.max_pressure * twin.length * twin.length, a.max_pressure, 1e-10 * a.max_pressure);
      for (std::size_t i = 0; i < a.pairs.size(); ++i)
        EXPECT_NEAR(b.pairs[i].slip / twin.length, a.pairs[i].slip, 1e-10 * a.max_gap + 1e-16);
      EXPECT_NEAR(told.energy.elastic / twin.length, expected.energy.elastic, 1e-10 * expected.energy.elastic);
    }
  }
}

// A block that only contact holds, ten million of its sizes away from the origin: its coordinates have nine digits
// left, and the certificate, with balance of forces and moments, has all of its own.
TEST(Invariance, FarFromTheOrigin) {
  for (const char* kind : {"fem", "polygons", "quadtree", "superelement"})
    for (const double x : {1e6, 1e7}) {
      SCOPED_TRACE(fmt::format("{} at {}", kind, x));
      const auto solution = run(fmt::format(
          "scabo: 1\nmaterials: {{s: {{young: 200, poisson: 0.3}}}}\nbodies:\n"
          "  low: {{material: s, shape: {{rectangle: {{corner: [{1:.17g}, 0], size: [1, 1]}}}}, mesh: {{kind: {0}, "
          "size: 0.125}}}}\n"
          "  up: {{material: s, shape: {{rectangle: {{corner: [{1:.17g}, 1], size: [1, 1]}}}}, mesh: {{kind: {0}, "
          "size: 0.125}}}}\n"
          "supports: [{{on: low.bottom, fix: [x, y]}}]\nloads: {{p: {{on: up.top, traction: [0.05, -1]}}}}\n"
          "contacts: {{joint: {{between: [low.top, up.bottom], friction: 0.3}}}}\n",
          kind, x));
      EXPECT_LT(last(solution).certificate.worst(), 1e-11);
      EXPECT_NEAR(last(solution).contacts.front().normal_force, 1.0, 1e-9);  // the length of the top is rounded
      EXPECT_NEAR(last(solution).contacts.front().tangential_force, -0.05, 1e-9);
    }
}

}  // namespace
}  // namespace scabo::verification
