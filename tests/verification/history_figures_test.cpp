// Histories of every figure that a run prints for an increment: counts of pairs, forces of water in contacts, moments
// of supports, factors of cracks and corners, against statics and closed forms.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "verification/history_columns.hpp"

namespace scabo::verification {
namespace {

/// Edge crack of length 1 in a plate of 2 x 4 under tension 1e6, in plane strain: the upper half, whose scaling centre
/// is the vertex at the tip.
const std::string half_plate = R"(scabo: 1
analysis: {plane: strain}
materials: {m: {young: 2e9, poisson: 0.3}}
bodies:
  half:
    material: m
    shape: {polygon: {vertices: [[0, 0], [1, 0], [2, 0], [2, 2], [0, 2]], names: {crack: edge_1, ligament: edge_2, tip: vertex_2}}}
    mesh: {size: 0.5, order: 8, centre: [1, 0]}
supports: [{on: half.ligament, fix: normal}, {on: half.vertex_4, fix: x}]
loads: {pull: {on: half.edge_4, pressure: -1e6}}
)";

// K_I = 2.82546 sigma sqrt(pi a) and G = K_I^2 (1 - nu^2) / E (Irwin). The tip has the name of the corner, its own or
// the one that the user gave it.
TEST(HistoryFigures, FactorsOfACrackAtAScalingCentre) {
  const auto solution = run(half_plate + R"(output:
  history: {opening: half.tip.K_I, same: half.vertex_2.K_I, sliding: half.tip.K_II, rate: half.tip.G, hoop: half.tip.K_tt}
)");
  const auto values = history_of(solution);
  const double K = 2.82546e6 * std::sqrt(std::numbers::pi);
  EXPECT_NEAR(values.at("opening") / K, 1.0, 1e-5);
  EXPECT_EQ(values.at("same"), values.at("opening"));
  EXPECT_NEAR(values.at("sliding") / K, 0.0, 1e-5);
  EXPECT_NEAR(values.at("rate") / (K * K * 0.91 / 2e9), 1.0, 2e-5);
  // A crack has no factors of a corner, which a warning says.
  EXPECT_TRUE(std::isnan(values.at("hoop")));
  EXPECT_EQ(std::count_if(solution.warnings.begin(), solution.warnings.end(),
                          [](const Warning& warning) {
                            return warning.text.ends_with(
                                "the column 'hoop' of history.csv stays empty: 'half.tip' is a crack in one material, "
                                "which has K_I, K_II, T, G and J");
                          }),
            1);
}

// Under tension along itself a crack has only its T-stress, which is the tension. A corner has the stresses on its ray.
TEST(HistoryFigures, TStressOfACrackAndStressesOfACorner) {
  const auto values = history_of(run(R"(scabo: 1
materials: {m: {young: 2e9, poisson: 0.3}}
bodies:
  plate:
    material: m
    shape: {rectangle: {corner: [0, 0], size: [2, 2]}}
    mesh: {size: 0.5, order: 6}
    cracks: [{tip: [1, 1], mouth: left, name: flaw}]
supports: [{on: plate.bottom_left, fix: [x, y]}, {on: plate.top_left, fix: x}]
loads: {pull: {on: plate.right, pressure: -1e6}, hold: {on: plate.left, pressure: -1e6}}
output: {history: {along: plate.flaw.T, opening: plate.flaw.K_I, J: plate.flaw.J}}
)"));
  EXPECT_NEAR(values.at("along") / 1e6, 1.0, 1e-9);
  EXPECT_NEAR(values.at("opening") / 1e6, 0.0, 1e-9);
  EXPECT_NEAR(values.at("J"), 0.0, 1e-9);

  const auto corner = run(R"(scabo: 1
materials: {m: {young: 2e9, poisson: 0.3}}
bodies:
  bracket:
    material: m
    shape: {polygon: {vertices: [[0, 0], [1, 0], [1, 1], [-1, 1], [-1, -1], [0, -1]], names: {root: vertex_1}}}
    mesh: {size: 0.5, order: 6, centre: [0, 0]}
supports: [{on: bracket.edge_5, fix: [x, y]}]
loads: {push: {on: bracket.edge_2, traction: [0, 1e6]}}
output: {history: {hoop: bracket.root.K_tt, shear: bracket.root.K_rt}}
)");
  const auto stresses = history_of(corner);
  ASSERT_EQ(last(corner).cracks.size(), 1u);
  EXPECT_EQ(stresses.at("hoop"), last(corner).cracks[0].factors.K_I);
  EXPECT_EQ(stresses.at("shear"), last(corner).cracks[0].factors.K_II);
  EXPECT_GT(stresses.at("hoop"), 0.0);  // the load bends the bracket open
}

/// A block of 2 x 1 on a rigid floor, with 9 pairs, whose top is moved by `move`.
std::string block(const std::string& move, const std::string& law, const std::string& rest) {
  return fmt::format(R"(scabo: 1
materials: {{m: {{young: 1e9, poisson: 0}}}}
bodies:
  floor: {{rigid: true, shape: {{rectangle: {{corner: [-1, -1], size: [8, 1]}}}}}}
  block: {{material: m, shape: {{rectangle: {{corner: [0, 0], size: [2, 1]}}}}, mesh: {{size: 0.5}}}}
supports: [{{on: floor, fix: [x, y]}}, {{on: block.top, displacement: {}, name: move}}]
contacts: {{base: {{between: [floor.top, block.bottom], {}}}}}
output:
  history: {{open: base.open, stick: base.stick, slip: base.slip, first: base.first_pair_in_contact, last: base.last_pair_in_contact{}}}
)",
                     move, law, rest);
}

TEST(HistoryFigures, CountPairs) {
  auto values = history_of(run(block("[0, -1e-3]", "friction: 0.3", "")));
  EXPECT_EQ(values.at("stick"), 9.0);
  EXPECT_EQ(values.at("open") + values.at("slip"), 0.0);
  EXPECT_EQ(values.at("first"), 1.0);
  EXPECT_EQ(values.at("last"), 9.0);
  values = history_of(run(block("[0.01, -1e-3]", "friction: 0.3", "")));
  EXPECT_EQ(values.at("slip"), 9.0);
  values = history_of(run(block("[0, 1e-3]", "friction: 0.3", "")));
  EXPECT_EQ(values.at("open"), 9.0);
  EXPECT_TRUE(std::isnan(values.at("first")));
  EXPECT_TRUE(std::isnan(values.at("last")));
  // Tensile strength of 1e5 holds a stress of 0.5e5 and breaks under 1e6.
  values = history_of(run(block("[0, 0.5e-4]", "friction: 0.3, cohesion: 1e6, tension: 1e5", ", broken: base.broken")));
  EXPECT_EQ(values.at("broken"), 0.0);
  EXPECT_EQ(values.at("stick"), 9.0);
  values = history_of(run(block("[0, 1e-3]", "friction: 0.3, cohesion: 1e6, tension: 1e5", ", broken: base.broken")));
  EXPECT_EQ(values.at("broken"), 9.0);
  EXPECT_EQ(values.at("open"), 9.0);
}

// Water of 2e5 in the joint and a stress of 1e6 on it: 0.4e6 of water, 1.6e6 effective, 2e6 in all.
TEST(HistoryFigures, ForcesOfWaterInAContact) {
  const auto values = history_of(run(R"(scabo: 1
materials: {m: {young: 1e9, poisson: 0}}
bodies:
  floor: {rigid: true, shape: {rectangle: {corner: [-1, -1], size: [8, 1]}}}
  block: {material: m, shape: {rectangle: {corner: [0, 0], size: [2, 1]}}, mesh: {size: 0.5}}
supports: [{on: floor, fix: [x, y]}]
loads: {down: {on: block.top, pressure: 1e6}, uplift: {in: base, pressure: 2e5}}
contacts: {base: {between: [floor.top, block.bottom], friction: 0.3}}
output: {history: {water: base.pore_force, effective: base.normal_force, total: base.total_normal_force}}
)"));
  EXPECT_NEAR(values.at("water"), 0.4e6, 1e-4);
  EXPECT_NEAR(values.at("effective"), 1.6e6, 1e-4);
  EXPECT_NEAR(values.at("total"), 2e6, 1e-4);
}

// A lid that does not tilt carries 300 N at the distance of 1 m from the point that its rotation is about.
TEST(HistoryFigures, MomentOfASupport) {
  const auto values = history_of(run(R"(scabo: 1
materials: {m: {young: 1e9, poisson: 0}}
bodies:
  block: {material: m, shape: {rectangle: {corner: [0, 0], size: [2, 1]}}, mesh: {size: 0.5}}
  lid: {rigid: true, shape: {rectangle: {corner: [0, 1], size: [2, 1]}}}
supports: [{on: block.bottom, fix: [x, y]}, {on: lid, rotation: 0, at: [1, 1], name: guide}]
loads: {weight: {on: lid.top_right, force: [0, -300]}}
contacts: {seat: {between: [block.top, lid.bottom], friction: 0.3}}
output: {history: {held: guide.moment, shared: seat.moment}}
)"));
  EXPECT_NEAR(values.at("held"), 300.0, 1e-6);
  EXPECT_NEAR(values.at("shared"), 300.0, 1e-6);  // about the origin: 300 N up at x = 1
}

}  // namespace
}  // namespace scabo::verification
