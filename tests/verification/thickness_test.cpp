// Bodies of different thickness: bars in series, weight, inertia, uplift, springs and strength of joints against closed
// forms; and twins, in which the thickness of the model is that of every body instead.
#include <fmt/format.h>

#include <cmath>

#include "scabo/analysis/modal/modal_analysis.hpp"
#include "verification/history_columns.hpp"

namespace scabo::verification::thicknesses {
namespace {

constexpr double young = 30e9, width = 0.8, below = 2.0, above = 1.0;  // height and thickness below are 2, above 1
constexpr double force = 600e3;

struct SeriesCase {
  const char* name;
  const char* mesh;
  const char* joint;
};
class BarsInSeries : public testing::TestWithParam<SeriesCase> {};

// A bar of thickness 2 below one of thickness 1, pressed by a force without contraction: u = F / (E b) (h / t + h / t).
TEST_P(BarsInSeries, ShortenByTheirThicknesses) {
  const bool tied = std::string(GetParam().joint).find("ties") != std::string::npos;
  for (const bool other : {false, true}) {
    // The upper one may have the thickness of the model, or a name for its own.
    const auto solution =
        run(fmt::format(R"(
scabo: 1
analysis: {{thickness: {}}}
materials: {{stuff: {{young: {}, poisson: 0}}}}
bodies:
  lower: {{material: stuff, thickness: 2, shape: {{rectangle: {{corner: [0, 0], size: [{}, {}]}}}}, mesh: {{{}}}}}
  upper: {{material: stuff, {}shape: {{rectangle: {{corner: [0, {}], size: [{}, {}]}}}}, mesh: {{{}}}}}
supports: [{{on: lower.bottom, fix: y, name: ground}}, {{on: lower.bottom_left, fix: x}}, {{on: upper.top_left, fix: x}}]
loads: {{push: {{on: upper.top, force: [0, -{}]}}}}
{}
output:
  history:
    top: upper.top_right.uy
    in_lower: {{section: {{from: [-1, 1], to: [3, 1]}}}}
    in_upper: {{section: {{from: [-1, 2.5], to: [3, 2.5]}}}}
    edge: {{edge: upper.bottom}}
)",
                        other ? 3.0 : 1.0, young, width, below, GetParam().mesh, other ? "thickness: 1, " : "", below,
                        width, above, GetParam().mesh, force, GetParam().joint));
    const analysis::IncrementResult& at = last(solution);
    const auto values = history_of(solution);
    const double shortened = force / (young * width) * (below / 2.0 + above / 1.0);
    EXPECT_NEAR(values.at("top"), -shortened, 1e-10 * shortened);
    EXPECT_NEAR(at.reactions[0].y(), force, 1e-10 * force);
    EXPECT_NEAR(values.at("in_lower.normal"), -force, 1e-10 * force);
    EXPECT_NEAR(values.at("in_upper.normal"), -force, 1e-10 * force);
    EXPECT_NEAR(values.at("edge.force_y"), force, 1e-10 * force);
    EXPECT_NEAR(at.energy.elastic, 0.5 * force * shortened, 1e-10 * force * shortened);
    EXPECT_NEAR(at.energy.external, at.energy.elastic, 1e-10 * force * shortened);
    if (tied) continue;
    const analysis::ContactResult& joint = contact_of(at);
    EXPECT_NEAR(joint.normal_force, force, 1e-10 * force);
    for (const analysis::PairResult& pair : joint.pairs)  // over the smaller thickness
      EXPECT_NEAR(pair.pressure, force / width, 1e-9 * force / width);
  }
}

constexpr const char* contact = "contacts: {joint: {between: [lower.top, upper.bottom], friction: 0.3}}";
constexpr const char* tie = "ties: {joint: {between: [lower.top, upper.bottom]}}";
INSTANTIATE_TEST_SUITE_P(Meshes, BarsInSeries,
                         testing::Values(SeriesCase{"superelement", "size: 0.4", contact},
                                         SeriesCase{"fem", "size: 0.4, kind: fem", contact},
                                         SeriesCase{"polygons", "size: 0.4, kind: polygons", contact},
                                         SeriesCase{"quadtree", "size: 0.2, kind: quadtree", contact},
                                         SeriesCase{"tied_superelements", "size: 0.4", tie},
                                         SeriesCase{"tied_fem", "size: 0.4, kind: fem", tie}),
                         [](const auto& info) { return std::string(info.param.name); });

/// A block of thickness 0.5 on one of thickness 2 and a stone of thickness 3 beside them, in a model of thickness 1.
std::string blocks(const std::string& rest) {
  return R"(
scabo: 1
materials: {stuff: {young: 30e9, poisson: 0.2, density: 2000, expansion: 1e-5}}
bodies:
  base: {material: stuff, thickness: 2, shape: {rectangle: {corner: [0, 0], size: [3, 1]}}, mesh: {size: 0.5}}
  block: {material: stuff, thickness: 0.5, shape: {rectangle: {corner: [1, 1], size: [1, 1]}}, mesh: {kind: fem, size: 0.25}}
  floor: {rigid: true, shape: {rectangle: {corner: [4, -1], size: [3, 1]}}}
  stone: {rigid: true, thickness: 3, density: 2500, shape: {rectangle: {corner: [5, 0], size: [1, 0.4]}}}
supports:
  - {on: base.bottom, fix: [x, y], name: ground}
  - {on: floor, fix: [x, y], name: floor}
)" + rest;
}

// Weight: density times area times thickness of every body.
TEST(Thickness, OfEveryBodyIsInItsWeight) {
  const auto solution = run(blocks(R"(
loads: {weight: {gravity: [0, -10]}}
contacts: {joint: {between: [base.top, block.bottom], friction: 0.5}, bed: {between: [floor.top, stone.bottom]}}
)"));
  const double of_base = 2000.0 * 10.0 * 3.0 * 2.0, of_block = 2000.0 * 10.0 * 0.5,
               of_stone = 2500.0 * 10.0 * 0.4 * 3.0;
  EXPECT_NEAR(last(solution).reactions[0].y(), of_base + of_block, 1e-10 * of_base);
  EXPECT_NEAR(last(solution).reactions[1].y(), of_stone, 1e-10 * of_stone);
  EXPECT_NEAR(contact_of(last(solution), 0).normal_force, of_block, 1e-9 * of_block);
  EXPECT_NEAR(contact_of(last(solution), 1).normal_force, of_stone, 1e-9 * of_stone);
}

// Pressures, tractions, water and moments act over the thickness of their body; fluid in a joint over the smaller one.
TEST(Thickness, OfEveryBodyIsInItsPressures) {
  const auto solution = run(blocks(R"(
loads:
  down: {on: block.top, pressure: 100e3}
  aside: {on: base.left, traction: {over: y, at: [0, 1], values: [[0, 0], [30e3, 0]]}}
  uplift: {in: joint, pressure: 40e3}
contacts: {joint: {between: [base.top, block.bottom], friction: 0.5}, bed: {between: [floor.top, stone.bottom]}}
)"));
  const analysis::IncrementResult& at = last(solution);
  EXPECT_NEAR(at.reactions[0].x(), -0.5 * 30e3 * 2.0, 1e-6);
  EXPECT_NEAR(at.reactions[0].y(), 100e3 * 0.5, 1e-5);
  EXPECT_NEAR(*contact_of(at).pore_force, 40e3 * 0.5, 1e-6);
  EXPECT_NEAR(contact_of(at).normal_force, 60e3 * 0.5, 1e-5);
  for (const analysis::PairResult& pair : contact_of(at).pairs) EXPECT_GE(pair.pressure, -1e-6);
}

// The strength of a joint is that of the area on which both bodies lie: c A + mu N, with the smaller thickness,
// whichever side has it.
TEST(Thickness, TheSmallerOneIsInTheStrengthOfAJoint) {
  for (const bool upper_is_thin : {true, false}) {
    const double strength = 50e3 * 1.0 * 0.5 + 0.4 * 100e3;  // 1 m of joint
    for (const double part : {0.9999, 1.0001}) {
      const auto solution = run(fmt::format(R"(
scabo: 1
materials: {{stuff: {{young: 30e9, poisson: 0.2}}}}
bodies:
  floor: {{rigid: true, thickness: {}, shape: {{rectangle: {{corner: [-1, -1], size: [3, 1]}}}}}}
  block: {{material: stuff, thickness: {}, shape: {{rectangle: {{corner: [0, 0], size: [1, 1]}}}}, mesh: {{size: 0.25}}}}
supports: [{{on: floor, fix: [x, y]}}]
loads: {{down: {{on: block.top, force: [0, -100e3]}}, push: {{on: block.left, traction: {{over: y, at: [0, 0.1], values: [[{:.17g}, 0], [{:.17g}, 0]]}}}}}}
contacts: {{joint: {{between: [floor.top, block.bottom], friction: 0.4, cohesion: {{lasting: 50e3}}}}}}
)",
                                            upper_is_thin ? 2.0 : 0.5, upper_is_thin ? 0.5 : 2.0,
                                            part * strength / 0.1 / (upper_is_thin ? 0.5 : 2.0),
                                            part * strength / 0.1 / (upper_is_thin ? 0.5 : 2.0)));
      EXPECT_EQ(solution.outcome, part < 1.0 ? analysis::Outcome::solved : analysis::Outcome::mechanism) << part;
    }
  }
}

// A bed of springs under an edge: settlement F / (k b t).
TEST(Thickness, OfABodyIsInTheSpringsUnderIt) {
  for (const char* body : {"rigid: true", "material: stuff, mesh: {size: 0.5}"}) {
    const auto solution = run(fmt::format(R"(
scabo: 1
materials: {{stuff: {{young: 30e9, poisson: 0}}}}
bodies:
  beam: {{{}, thickness: 2.5, shape: {{rectangle: {{corner: [0, 0], size: [2, 0.5]}}}}}}
  other: {{material: stuff, shape: {{rectangle: {{corner: [0, 0.5], size: [2, 0.5]}}}}, mesh: {{size: 0.5}}}}
springs: [{{on: beam.bottom, k_n: 1e6, k_t: 1e6}}]
supports: [{{on: other.top_left, fix: x}}]
loads: {{down: {{on: other.top, force: [0, -50e3]}}}}
contacts: {{joint: {{between: [beam.top, other.bottom], friction: 0.3}}}}
output: {{history: {{low: beam.bottom_left.uy}}}}
)",
                                          body));
    EXPECT_NEAR(last(solution).springs[0].y(), 50e3, 1e-6);
    EXPECT_NEAR(history_of(solution).at("low"), -50e3 / (1e6 * 2.0 * 2.5), 1e-12);
  }
}

// A rigid body of thickness 3 that a constant force F pushes from rest: F t^2 / (2 m).
TEST(Thickness, OfARigidBodyIsInItsMass) {
  const auto solution = run(R"(
scabo: 1
analysis: {type: dynamic}
materials: {stuff: {young: 30e9, poisson: 0.2, density: 2000}}
bodies:
  stone: {rigid: true, thickness: 3, density: 2500, shape: {rectangle: {corner: [5, 0], size: [1, 0.4]}}}
  block: {material: stuff, thickness: 2, shape: {rectangle: {corner: [0, 0], size: [1, 1]}}, mesh: {kind: fem, size: 0.5}}
supports: [{on: block.bottom, fix: [x, y]}]
loads: {push: {on: stone, force: [6000, 0]}}
contacts: {never: {between: [block.right, stone.left]}}
steps: [{dynamic: {duration: 0.1, step: 0.01}}]
output: {history: {x: stone.bottom_left.ux}}
)");
  EXPECT_NEAR(history_of(solution).at("x"), 0.5 * 6000.0 / (2500.0 * 0.4 * 3.0) * 0.01, 1e-12);
}

// Stiffness and mass grow alike: frequencies do not depend on the thickness.
TEST(Thickness, LeavesFrequenciesAsTheyAre) {
  for (const char* kind : {"size: 0.25", "kind: fem, size: 0.25", "kind: polygons, size: 0.3"}) {
    const auto modes = [&](const char* thickness) {
      const std::string text = fmt::format(R"(
scabo: 1
analysis: {{type: modal, modes: 6}}
materials: {{steel: {{young: 210e9, poisson: 0.3, density: 7800}}}}
bodies: {{plate: {{material: steel, {}shape: {{rectangle: {{corner: [0, 0], size: [2, 1]}}}}, mesh: {{{}}}}}}}
supports: [{{on: plate.left, fix: [x, y]}}]
)",
                                           thickness, kind);
      return analysis::solve_modal(input::parse_model(text, "test.yaml", {})).modes;
    };
    const auto one = modes(""), seven = modes("thickness: 7, ");
    ASSERT_EQ(one.size(), seven.size());
    for (std::size_t i = 0; i < one.size(); ++i)
      EXPECT_NEAR(seven[i].frequency, one[i].frequency, 1e-9 * one[i].frequency) << kind;
  }
}

/// Whether two runs are the same to rounding.
void expect_same(const analysis::StaticSolution& a, const analysis::StaticSolution& b) {
  EXPECT_EQ(a.outcome, b.outcome);
  ASSERT_EQ(a.increments.size(), b.increments.size());
  for (std::size_t i = 0; i < a.increments.size(); ++i) {
    const analysis::IncrementResult &one = a.increments[i], &other = b.increments[i];
    const double near = 1e-12 * std::max(one.largest_force, 1e-300);
    for (std::size_t s = 0; s < one.reactions.size(); ++s)
      EXPECT_LE((one.reactions[s] - other.reactions[s]).norm(), near);
    for (std::size_t s = 0; s < one.springs.size(); ++s) EXPECT_LE((one.springs[s] - other.springs[s]).norm(), near);
    for (std::size_t c = 0; c < one.contacts.size(); ++c)
      for (std::size_t p = 0; p < one.contacts[c].pairs.size(); ++p) {
        EXPECT_NEAR(one.contacts[c].pairs[p].normal_force, other.contacts[c].pairs[p].normal_force, near);
        EXPECT_NEAR(one.contacts[c].pairs[p].pressure, other.contacts[c].pairs[p].pressure,
                    1e-12 * std::abs(one.contacts[c].pairs[p].pressure) + near);
      }
    EXPECT_NEAR(one.energy.elastic, other.energy.elastic, 1e-12 * std::abs(one.energy.elastic));
    EXPECT_NEAR(one.energy.external, other.energy.external, 1e-12 * std::abs(one.energy.external));
    if (!one.growth || !one.growth->energy) continue;
    EXPECT_NEAR(one.growth->energy->integral, other.growth->energy->integral, 1e-12 * one.growth->energy->integral);
    EXPECT_NEAR(one.growth->energy->released, one.growth->energy->integral, 0.05 * one.growth->energy->integral);
  }
}

class ThicknessTwin : public testing::TestWithParam<const char*> {};

// A thickness of all bodies is that of the model: the good models of the reader, which have every kind of load.
TEST_P(ThicknessTwin, OfAllBodiesIsThatOfTheModel) {
  const std::string path = fmt::format("{}/{}.yaml", SCABO_GOOD_MODELS, GetParam());
  const std::vector<input::Override> flat{input::parse_override("analysis.plane=stress")};
  model::Model whole = input::read_model(path, flat), each = whole;
  constexpr double thickness = 0.35;
  for (model::Body& body : whole.bodies) body.thickness.reset();
  whole.analysis.thickness = thickness;
  each.analysis.thickness = 9.0;
  for (model::Body& body : each.bodies) body.thickness = thickness;
  const analysis::StaticSolution solution = analysis::solve_static(whole);
  ASSERT_FALSE(solution.increments.empty());
  expect_same(solution, analysis::solve_static(each));
}

INSTANTIATE_TEST_SUITE_P(Models, ThicknessTwin,
                         testing::Values("temperature_tables", "growth", "springs", "bars", "history", "in_time",
                                         "edge_loads", "crack_faces", "finite_elements", "layers", "stages", "notch",
                                         "blocks", "cracks", "large_slip", "laws", "ties"),
                         [](const auto& info) { return std::string(info.param); });

}  // namespace
}  // namespace scabo::verification::thicknesses
