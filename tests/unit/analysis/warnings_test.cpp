// Models that are solved as they are written, and are probably not what was meant.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <string>
#include <vector>

#include "scabo/analysis/static_analysis.hpp"
#include "scabo/input/read_model.hpp"

namespace scabo::analysis {
namespace {

using testing::AllOf;
using testing::Contains;
using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;

/// A frictionless block of 2 m x 1 m on another, on rollers above and below, free to widen: `overlap` presses them with
/// E overlap / (1 m + 1 m).
std::string stack(double overlap, const std::string& rest = "", const std::string& size = "0.25") {
  return "scabo: 1\n"
         "materials: {steel: {young: 210e9, poisson: 0.3}}\n"
         "bodies:\n"
         "  lower: {material: steel, shape: {rectangle: {corner: [0, 0], size: [2, 1]}}, mesh: {size: " +
         size +
         "}}\n"
         "  upper: {material: steel, shape: {rectangle: {corner: [0, " +
         std::to_string(1.0 - overlap) + "], size: [2, 1]}}, mesh: {size: " + size +
         "}}\n"
         "supports:\n"
         "  - {on: lower.bottom, fix: [y]}\n"
         "  - {on: lower.bottom_left, fix: [x]}\n"
         "  - {on: upper.top, displacement: [null, -1e-9], name: roller}\n"
         "  - {on: upper.top_left, fix: [x]}\n"
         "contacts:\n"
         "  joint: {between: [lower.top, upper.bottom]}\n" +
         rest;
}

StaticSolution solve(const std::string& text) { return solve_static(input::parse_model(text, "model.yaml")); }

TEST(Warnings, AnOrdinaryModelHasNone) {
  EXPECT_THAT(texts_of(solve(stack(1e-4)).warnings), IsEmpty());
  EXPECT_THAT(texts_of(solve(stack(0.0, "steps: [{loads: {roller: 1e5}}]\n")).warnings), IsEmpty());
}

/// A lining in unbounded ground, pressed from inside, with a support that keeps it from moving and carries nothing but
/// what its mesh lacks in symmetry, 7e-10 of the pressure.
std::string lining(const std::string& more) {
  return "scabo: 1\n"
         "analysis: {plane: strain}\n"
         "materials: {soil: {young: 150e6, poisson: 0.3}, concrete: {young: 15e9, poisson: 0.2}}\n"
         "bodies:\n"
         "  ground: {material: soil, outside: true, shape: {circle: {centre: [0, 0], radius: 3}}, mesh: {size: 0.8}}\n"
         "  lining:\n"
         "    material: concrete\n"
         "    shape: {circle: {centre: [0, 0], radius: 3}}\n"
         "    holes: {inside: {circle: {centre: [0, 0], radius: 2.7}}}\n"
         "    mesh: {kind: polygons, size: 0.4}\n"
         "supports: [{on: lining.rim_start, fix: y}]\n"
         "loads: {water: {on: lining.inside, pressure: 1e5}" +
         more +
         "}\n"
         "contacts: {interface: {between: [ground.rim, lining.rim], friction: 0.2}}\n";
}

TEST(Warnings, OfForcesOnUnboundedGroundThatDoNotBalance) {
  EXPECT_THAT(texts_of(solve(lining("")).warnings), IsEmpty());
  EXPECT_THAT(texts_of(solve(lining(", wind: {on: ground.rim, traction: [100, 0]}")).warnings),
              Contains(HasSubstr("the forces on the unbounded body 'ground' have a resultant (18")));
}

TEST(Warnings, OfADeepOverlapWithItsPressure) {
  const StaticSolution solution = solve(stack(0.2));
  ASSERT_EQ(solution.outcome, Outcome::solved) << solution.reason;
  ASSERT_NEAR(solution.increments.back().contacts[0].max_pressure, 21e9, 1e6);
  EXPECT_THAT(texts_of(solution.warnings),
              ElementsAre(AllOf(HasSubstr("contact 'joint': the bodies overlap at the start by up to 0.2, 20 %"),
                                HasSubstr("presses with 2.1e+10"))));
}

TEST(Warnings, OfAnOverlapOfMoreThanOnePerCent) {
  EXPECT_THAT(texts_of(solve(stack(0.012)).warnings),
              ElementsAre(HasSubstr("overlap at the start by up to 0.012, 1.2 %")));
  EXPECT_THAT(texts_of(solve(stack(0.009)).warnings), IsEmpty());
}

TEST(Warnings, OfPressureThatTheTheoryDoesNotCover) {
  const StaticSolution solution = solve(stack(0.0, "steps: [{loads: {roller: 2e8}}]\n"));  // 0.2 m as well
  EXPECT_THAT(texts_of(solution.warnings),
              Contains(HasSubstr("contact 'joint': the pressure reaches 2.1e+10, 10 % of Young's")));
}

TEST(Warnings, OfAContactThatNeverCloses) {
  const StaticSolution solution = solve(stack(-1e-3));
  EXPECT_THAT(
      texts_of(solution.warnings),
      ElementsAre("contact 'joint' never closes: the smallest gap is 0.001; as drawn it is 0.001: the loads hardly "
                  "change it"));
  EXPECT_THAT(texts_of(solve(stack(-1e-3, "steps: [{loads: {roller: -2e4}}]\n")).warnings),
              ElementsAre(AllOf(HasSubstr("contact 'joint' never closes: the smallest gap is "),
                                HasSubstr("; as drawn it is 0.001: the loads take the sides farther apart"))));
}

TEST(Warnings, OfAContactThatTheLoadOpens) {
  const StaticSolution solution = solve(
      "scabo: 1\n"
      "materials: {steel: {young: 210e9, poisson: 0}}\n"
      "bodies:\n"
      "  floor: {rigid: true, shape: {rectangle: {corner: [-1, -1], size: [4, 1]}}}\n"
      "  block: {material: steel, shape: {rectangle: {corner: [0, 0], size: [2, 1]}}, mesh: {size: 0.5}}\n"
      "supports: [{on: floor, fix: [x, y]}, {on: block.top, displacement: [0, 1e-3], name: lift}]\n"
      "contacts: {joint: {between: [floor.top, block.bottom], friction: 0.3}}\n"
      "steps: [{increments: 2}]\n");
  EXPECT_THAT(texts_of(solution.warnings),
              ElementsAre("the loads open contact 'joint' in the first increment, and no pair "
                          "closes again: the smallest gap is 0.0005"));
}

// A crack may well stay open.
TEST(Warnings, NoneOfACrackThatNeverCloses) {
  EXPECT_THAT(texts_of(solve("scabo: 1\n"
                             "materials: {steel: {young: 210e9, poisson: 0.3}}\n"
                             "bodies:\n"
                             "  plate:\n"
                             "    material: steel\n"
                             "    shape: {rectangle: {corner: [0, 0], size: [2, 2]}}\n"
                             "    mesh: {kind: polygons, size: 0.4, order: 4}\n"
                             "    cracks: [{path: [[0, 1], [1, 1]], name: slit}]\n"
                             "supports: [{on: plate.bottom, fix: [x, y]}]\n"
                             "loads: {pull: {on: plate.top, traction: [0, 1e6]}}\n"
                             "contacts: {slit: {between: [plate.slit.left, plate.slit.right], friction: 0.3}}\n")
                           .warnings),
              IsEmpty());
}

TEST(Warnings, OfAContactZoneOfLessThanFivePairs) {
  EXPECT_THAT(
      texts_of(solve(stack(1e-4, "", "2")).warnings),
      ElementsAre(HasSubstr("contact 'joint': only 3 pairs are in contact at the end, too few for a reliable")));
  EXPECT_THAT(texts_of(solve(stack(1e-4, "", "2, order: 3")).warnings),
              ElementsAre(HasSubstr("contact 'joint': only 4 pairs are in contact at the end")));
  EXPECT_THAT(texts_of(solve(stack(1e-4, "", "1")).warnings), IsEmpty());  // five pairs
}

TEST(Warnings, OfLoadsThatMoveNothing) {
  const StaticSolution solution = solve(stack(1e-4,
                                              "loads:\n"
                                              "  down: {on: lower.bottom_left, force: [5, -3]}\n"
                                              "  none: {on: upper.left, pressure: 0}\n"
                                              "  some: {on: lower.bottom, force: [1, -3]}\n"));
  EXPECT_THAT(texts_of(solution.warnings),
              ElementsAre(HasSubstr("load 'down' has no effect"), HasSubstr("load 'none' is zero")));
}

TEST(Warnings, OfGravityAndTemperatureOfMaterialsThatKnowNeither) {
  for (const char* mesh : {"{size: 0.25}", "{kind: fem, size: 0.25}", "{kind: polygons, size: 0.25}"})
    for (const bool light : {true, false}) {
      const std::string of_material = light ? "density: 0, expansion: 0" : "density: 2400, expansion: 1e-5";
      const StaticSolution solution =
          solve("scabo: 1\nmaterials: {stone: {young: 1e9, poisson: 0.3, " + of_material +
                "}}\n"
                "bodies: {block: {material: stone, shape: {rectangle: {corner: [0, 0], size: [2, 1]}}, mesh: " +
                mesh +
                "}}\n"
                "supports: [{on: block.bottom, fix: [x, y]}]\n"
                "loads:\n"
                "  weight: {gravity: [0, -9.81]}\n"
                "  summer: {on: block, temperature: 20}\n"
                "  push: {on: block.top, pressure: 1e3}\n");
      if (light)
        EXPECT_THAT(texts_of(solution.warnings),
                    ElementsAre(HasSubstr("load 'weight' has no effect because the density of all materials"),
                                HasSubstr("load 'summer' has no effect because the temperature does not change, or")))
            << mesh;
      else
        EXPECT_THAT(texts_of(solution.warnings), IsEmpty()) << mesh;
    }
}

TEST(Warnings, OfALoadThatIsLostInTheRoundingOfAnother) {
  const auto with = [](const char* small) {
    return texts_of(solve(stack(1e-4, std::string("loads:\n  small: {on: lower.right, traction: [") + small +
                                          ", 0]}\n  large: {on: upper.right, traction: [1e6, 0]}\n"))
                        .warnings);
  };
  EXPECT_THAT(with("1e-3"), IsEmpty());
  EXPECT_THAT(with("1e-6"), ElementsAre(HasSubstr("load 'small': the nodal forces are only 1e-12 times those of load "
                                                  "'large', whose rounding changes what it causes by a part of about "
                                                  "1e-02")));
  EXPECT_THAT(with("1e-20"), ElementsAre(HasSubstr("whose rounding hides what it causes")));
}

// Young's modulus in wrong units: the forces of the temperature are so large that the weight is lost in their rounding.
TEST(Warnings, OfAWeightBesideATemperatureInWrongUnits) {
  const std::string text =
      "scabo: 1\n"
      "materials: {m: {young: 210e60, poisson: 0.3, density: 7800, expansion: 1e-5}}\n"
      "bodies:\n"
      "  floor: {rigid: true, shape: {rectangle: {corner: [-1, -1], size: [4, 1]}}}\n"
      "  block: {material: m, shape: {rectangle: {corner: [0, 0], size: [2, 1]}}, mesh: {size: 1}}\n"
      "supports: [{on: floor, fix: [x, y]}]\n"
      "loads: {weight: {gravity: [0, -9.81]}, warm: {temperature: 10}}\n"
      "contacts: {base: {between: [floor.top, block.bottom], friction: 0.3}}\n";
  EXPECT_THAT(texts_of(solve(text).warnings),
              Contains(AllOf(HasSubstr("load 'weight'"), HasSubstr("load 'warm', whose rounding hides"))));
}

/// A block on springs along an edge that is inclined.
std::string block_on_springs(double k_n) {
  return "scabo: 1\n"
         "materials: {steel: {young: 210e9, poisson: 0.3}}\n"
         "bodies:\n"
         "  block: {material: steel, shape: {polygon: {vertices: [[0, 0], [2, 1], [1.5, 2], [-0.5, 1]]}}, "
         "mesh: {size: 0.5}}\n"
         "springs: [{on: block.edge_1, k_n: " +
         std::to_string(k_n) +
         ", k_t: 0}]\n"
         "supports: [{on: block.vertex_1, fix: x}]\n"
         "loads: {push: {on: block.edge_3, traction: [1e6, -10e6]}}\n";
}

TEST(Warnings, OfSpringsThatAreMuchStifferThanTheirBody) {
  const auto on_bottom = [](const std::string& k_n) {
    return texts_of(solve(stack(1e-4, "springs: [{on: lower.left, k_n: " + k_n + ", k_t: 0}]\n")).warnings);
  };
  EXPECT_THAT(on_bottom("1e12"), IsEmpty());
  EXPECT_THAT(on_bottom("1e30"), ElementsAre(HasSubstr("springs 'lower.left' are ")));
}

TEST(Reasons, OfForcesThatStiffSpringsLeaveUnbalanced) {
  const StaticSolution stiff = solve(block_on_springs(1e20));
  EXPECT_EQ(stiff.outcome, Outcome::not_converged);
  const std::string advice = "or a stiffness of at most ";
  EXPECT_THAT(stiff.reason, AllOf(HasSubstr("springs 'block.edge_1' are "), HasSubstr(advice)));
  EXPECT_THAT(texts_of(stiff.warnings), ElementsAre(HasSubstr("springs 'block.edge_1' are ")));
  const double most = std::stod(stiff.reason.substr(stiff.reason.find(advice) + advice.size()));
  EXPECT_GT(most, 1e12);
  const StaticSolution solved = solve(block_on_springs(most));  // as advised
  EXPECT_EQ(solved.outcome, Outcome::solved);
  EXPECT_THAT(texts_of(solved.warnings), IsEmpty());
}

TEST(Warnings, ContactsWithTheSameFaultShareOneSentence) {
  std::string text = stack(-1e-3), bodies, supports, contacts;
  for (int i = 1; i <= 6; ++i) {
    const std::string name = "floating_" + std::to_string(i), corner = std::to_string(10 * i);
    bodies += "  " + name + "_a: {rigid: true, shape: {rectangle: {corner: [" + corner + ", -1], size: [2, 1]}}}\n";
    bodies += "  " + name + "_b: {material: steel, shape: {rectangle: {corner: [" + corner +
              ", 0.001], size: [2, 1]}}, mesh: {size: 1}}\n";
    supports += "  - {on: " + name + "_a, fix: [x, y]}\n  - {on: " + name + "_b.top, fix: [x, y]}\n";
    contacts += "  " + name + ": {between: [" + name + "_a.top, " + name + "_b.bottom]}\n";
  }
  text.insert(text.find("contacts:\n") + 10, contacts);
  text.insert(text.find("supports:\n") + 10, supports);
  text.insert(text.find("bodies:\n") + 8, bodies);
  EXPECT_THAT(texts_of(solve(text).warnings),
              ElementsAre(HasSubstr("contacts 'floating_1', 'floating_2', 'floating_3' and 4 more never close")));
}

/// `count` blocks in a row.
std::string row(int count, const std::string& other_bodies, const std::string& rest) {
  return "scabo: 1\n"
         "materials: {steel: {young: 210e9, poisson: 0.3, density: 7850}}\n"
         "bodies:\n" +
         other_bodies +
         "  block: {material: steel, shape: {rectangle: {corner: [1, 0], size: [1, 1]}}, mesh: {size: 1}, "
         "repeat: {count: " +
         std::to_string(count) + ", step: [1, 0]}}\n" + rest;
}

/// Blocks on a floor, pressed on it; `friction` of each, and further lines.
std::string on_floor(const std::vector<double>& friction, const std::string& rest = "") {
  std::string contacts = "contacts:\n";
  for (std::size_t k = 1; k <= friction.size(); ++k)
    contacts += "  base_" + std::to_string(k) + ": {between: [floor.top, block_" + std::to_string(k) +
                ".bottom], friction: " + std::to_string(friction[k - 1]) + "}\n";
  return row(static_cast<int>(friction.size()),
             "  floor: {rigid: true, shape: {rectangle: {corner: [0, -1], size: [40, 1]}}}\n",
             "supports: [{on: floor, fix: [x, y]}]\nloads: {weight: {gravity: [0, -9.81]}}\n" + contacts + rest);
}

/// The sentences about motions that nothing determines.
std::vector<std::string> of_motions(const StaticSolution& solution) {
  std::vector<std::string> texts;
  for (const Warning& warning : solution.warnings)
    if (warning.kind == WarningKind::undetermined_motion) texts.push_back(warning.text);
  return texts;
}

TEST(Warnings, OfManyBodiesThatSlideFreelyInOneSentence) {
  EXPECT_THAT(of_motions(solve(on_floor({0.0, 0.0, 0.3, 0.0}))),
              ElementsAre(HasSubstr("do not determine bodies 'block_1', 'block_2' and 'block_4': translation "
                                    "along (1, 0); the smallest such motion was chosen")));
  EXPECT_THAT(
      of_motions(solve(on_floor(std::vector<double>(6, 0.0)))),
      ElementsAre(HasSubstr("do not determine bodies 'block_1', 'block_2', 'block_3' and 'block_4': translation "
                            "along (1, 0); and 2 more bodies; the smallest")));
}

TEST(Warnings, OfFreeMotionsAgainOnlyWhereOtherBodiesHaveThem) {
  const std::string steps = "steps: [{loads: {weight: 1}, increments: 2}, {friction: {base_2: 0}}]\n";
  EXPECT_THAT(
      of_motions(solve(on_floor({0.0, 0.3, 0.3}, steps))),
      ElementsAre(HasSubstr("step step_1, increment 1: supports, friction and loads do not determine body 'block_1': "),
                  HasSubstr("do not determine bodies 'block_1' and 'block_2': translation along (1, 0);")));
}

std::size_t times(const std::string& part, const std::string& text) {
  std::size_t count = 0;
  for (auto at = text.find(part); at != std::string::npos; at = text.find(part, at + 1)) ++count;
  return count;
}

TEST(Reasons, OfAMechanismNameTheFewBodiesThatMoveMost) {
  const std::string floor = "  floor: {rigid: true, shape: {rectangle: {corner: [0, -1], size: [40, 1]}}}\n",
                    held = "supports: [{on: floor, fix: [x, y]}]\nloads: {push: {gravity: [5, -9.81]}}\n";
  const auto reason_of = [&](int count) {
    std::string contacts = "contacts:\n";
    for (int k = 1; k <= count; ++k) {
      const std::string block = "block_" + std::to_string(k);
      contacts += "  " + block + ": {between: [floor.top, " + block + ".bottom], friction: 0.1}\n";
    }
    return solve(row(count, floor, held + contacts)).reason;
  };
  EXPECT_EQ(times("translation along (1, 0)", reason_of(4)), 4u) << reason_of(4);
  EXPECT_EQ(times("more bod", reason_of(4)), 0u);
  EXPECT_EQ(times("translation along (1, 0)", reason_of(5)), 4u) << reason_of(5);
  EXPECT_THAT(reason_of(5), HasSubstr("; and 1 more body, held neither by supports"));
  EXPECT_THAT(reason_of(20), HasSubstr("; and 16 more bodies, held neither by supports"));
}

TEST(Reasons, NameFourOfManyTiedBodies) {
  std::string ties = "loads: {push: {gravity: [5, -9.81]}}\nties:\n";
  for (int k = 1; k < 7; ++k)
    ties += "  tie_" + std::to_string(k) + ": {between: [block_" + std::to_string(k) + ".right, block_" +
            std::to_string(k + 1) + ".left]}\n";
  try {
    solve(row(7, "", ties));
    FAIL() << "seven blocks that nothing supports";
  } catch (const InputError& error) {
    EXPECT_THAT(error.what(), HasSubstr("the tied bodies 'block_1', 'block_2', 'block_3', 'block_4' and 3 more are "
                                        "insufficiently supported"));
  }
}

}  // namespace
}  // namespace scabo::analysis
