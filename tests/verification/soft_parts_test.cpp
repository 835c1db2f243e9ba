// A block of steel on a rigid floor, pressed and pushed, with a strip tied to its side that is far softer and held on
// its far side: contact, not the strip, decides how the block deforms. Loads and supports would move it by up to 1e10
// times as far without contact.
#include <fmt/format.h>

#include <string>

#include "run.hpp"

namespace scabo::verification {
namespace {

/// Without a strip for 0.
analysis::StaticSolution with_strip(const char* kind, double young) {
  const std::string mesh = fmt::format("mesh: {{kind: {}, size: 0.25, order: 2}}", kind);
  std::string model = fmt::format(R"(
scabo: 1
analysis: {{plane: strain}}
materials: {{steel: {{young: 10e9, poisson: 0.2}}, soft: {{young: {}, poisson: 0.2}}}}
bodies:
  floor: {{rigid: true, shape: {{rectangle: {{corner: [-3, -1], size: [6, 1]}}}}}}
  block: {{material: steel, shape: {{rectangle: {{corner: [-1, 0], size: [2, 1]}}}}, {}}}
)",
                                  young > 0.0 ? young : 1.0, mesh);
  if (young > 0.0)
    model += fmt::format(
        "  strip: {{material: soft, shape: {{rectangle: {{corner: [1, 0], size: [0.5, 1]}}}}, {}}}\n"
        "ties: {{glue: {{between: [block.right, strip.left]}}}}\n",
        mesh);
  model += "supports:\n  - {on: floor, fix: [x, y]}\n";
  if (young > 0.0) model += "  - {on: strip.right, fix: [x, y]}\n";
  return run(model + R"(
contacts: {base: {between: [floor.top, block.bottom], friction: 0.3}}
loads:
  weight: {body_force: [0, -25e3], on: block}
  press: {on: block.top, pressure: 1e5}
  push: {on: block.left, traction: [1e4, 0]}
)");
}

TEST(SoftParts, ThatHoldABlockInContactLoseNoDigits) {
  for (const char* kind : {"superelement", "fem"}) {
    const double alone = last(with_strip(kind, 0.0)).energy.elastic;
    for (const double young : {1e5, 1e4, 1e3}) {
      const analysis::Energy energy = last(with_strip(kind, young)).energy;
      EXPECT_NEAR(energy.external, energy.elastic + energy.friction, 1e-6 * energy.elastic) << kind << " " << young;
      EXPECT_NEAR(energy.elastic, alone, (1e-6 + 1e-9 * young / 10.0) * alone) << kind << " " << young;
    }
  }
}

TEST(SoftParts, ThatAreTooSoftAreNamed) {
  for (const char* kind : {"superelement", "fem"}) {
    const analysis::StaticSolution solution = with_strip(kind, 1.0);
    EXPECT_EQ(solution.outcome, analysis::Outcome::not_converged) << kind;
    EXPECT_NE(solution.reason.find("body 'block' gives way "), std::string::npos) << solution.reason;
  }
}

// Two slender layers under a pressure that varies: the upper one, 150 times as long as thick, is held by contact alone.
// Without contact it would bend by hundreds of metres, in contact it moves by hundredths of a millimetre. Displacements
// were wrong by as much as that while all contact forces were right, and the energies by half.
TEST(SlenderBodies, InContactAreDisplacedAsTheirPairsMove) {
  for (const double size : {0.005, 0.01}) {
    const analysis::StaticSolution solution = run(fmt::format(R"(
scabo: 1
analysis: {{plane: strain}}
materials: {{steel: {{young: 210e9, poisson: 0.3}}}}
bodies:
  upper: {{material: steel, shape: {{rectangle: {{corner: [0, 0], size: [1.5, 0.01]}}}}, mesh: {{kind: fem, order: 2, size: {0}}}}}
  lower: {{material: steel, shape: {{rectangle: {{corner: [0, -0.01], size: [1.5, 0.01]}}}}, mesh: {{kind: fem, order: 2, size: {0}}}}}
supports: [{{on: lower.bottom, fix: [x, y]}}]
contacts: {{joint: {{between: [lower.top, upper.bottom], friction: 0.5}}}}
loads:
  down: {{on: upper.top, pressure: {{over: x, at: [0, 0.75, 1.5], values: [20e6, 140e6, 60e6]}}}}
  push: {{on: upper.top, traction: [12e6, 0]}}
)",
                                                              size));
    const analysis::IncrementResult& increment = last(solution);
    const analysis::Energy& energy = increment.energy;
    EXPECT_EQ(increment.attempts.back().iterations.back().iteration,  // all rounds are in the history
              increment.newton_iterations + increment.coarse_iterations);
    EXPECT_NEAR(energy.external, energy.elastic + energy.friction, 1e-6 * energy.elastic);
    // Thin layers that cannot widen: p^2 t / (2 M) and tau^2 t / (2 G) over their length, 481.1 and 26.7 J
    EXPECT_NEAR(energy.elastic, 507.8, 3.0);
    for (const analysis::PairResult& pair : contact_of(increment).pairs)
      EXPECT_NEAR(pair.displacement_b[0] - pair.displacement_a[0], pair.gap, 1e-6 * 2e-5) << pair.pair;  // m
  }
}

}  // namespace
}  // namespace scabo::verification
