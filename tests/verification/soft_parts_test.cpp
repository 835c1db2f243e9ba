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
    EXPECT_NE(solution.reason.find("body 'block' is held by parts so soft"), std::string::npos) << solution.reason;
  }
}

}  // namespace
}  // namespace scabo::verification
