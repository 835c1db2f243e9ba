// Slender beams: rounding of K u is (L / h)^3 times the unit of rounding of the load. Closed forms of beams.
#include <fmt/format.h>
#include <gmock/gmock.h>

#include <cmath>

#include "run.hpp"
#include "scabo/analysis/diagnostics/warnings.hpp"
#include "scabo/result/probe.hpp"

namespace scabo::verification {
namespace {

/// A cantilever of depth 1, thickness 1, under a tip force of 1; everything in units of `length` and `force`. Poisson's
/// ratio is 0, so that the built-in end does not stiffen it.
std::string cantilever(double ratio, const std::string& mesh, double length = 1.0, double force = 1.0) {
  return fmt::format(R"(
scabo: 1
analysis: {{plane: stress, thickness: {1}}}
materials: {{m: {{young: {2}, poisson: 0}}}}
bodies: {{beam: {{material: m, shape: {{rectangle: {{corner: [0, 0], size: [{0}, {1}]}}}}, mesh: {3}}}}}
supports: [{{on: beam.left, fix: [x, y]}}]
loads: {{tip: {{on: beam.right, force: [0, {4}]}}}}
)",
                     ratio * length, length, 1e9 * force / (length * length), mesh, -force);
}

/// Timoshenko's beam, shear coefficient 5/6.
double deflection(double ratio) { return (4.0 * std::pow(ratio, 3) + ratio * 1.2 * 2.0) / 1e9; }

double tip(const analysis::StaticSolution& solution, double ratio, double length = 1.0) {
  return -result::Probe(solution, last(solution).fields, 0).at({ratio * length, 0.5 * length})->displacement.y() /
         length;
}

struct Beam {
  double ratio;
  bool fem;
  std::string mesh(double length) const {
    return fem ? fmt::format("{{kind: fem, size: {}}}", length)
               : fmt::format("{{order: 3, size: {}}}", ratio * length / 20.0);
  }
};
constexpr Beam slender_beams[] = {{10.0, false}, {100.0, false}, {300.0, false}, {1000.0, false},
                                  {100.0, true}, {500.0, true},  {1000.0, true}};

TEST(SlenderBeam, BendsAsABeamAndItsReactionsBalanceTheLoad) {
  for (const Beam& beam : slender_beams) {
    const auto solution = run(cantilever(beam.ratio, beam.mesh(1.0)));
    const analysis::IncrementResult& increment = last(solution);
    EXPECT_NEAR(tip(solution, beam.ratio) / deflection(beam.ratio), 1.0, 1e-4) << beam.ratio;
    EXPECT_NEAR(increment.reactions[0].y(), 1.0, 1e-10) << beam.ratio;
    EXPECT_NEAR(increment.reactions[0].x(), 0.0, 1e-10) << beam.ratio;
    EXPECT_NEAR(2.0 * increment.energy.elastic / tip(solution, beam.ratio), 1.0, 1e-4) << beam.ratio;
    EXPECT_THAT(texts_of(solution.warnings), testing::IsEmpty()) << beam.ratio;
  }
}

// Of the default order 2 with sides longer than the depth, and of order 1 with any: the warning states what is missing,
// to a factor of 1.5, and stays away where less than a hundredth is.
TEST(SlenderBeam, OfLowOrderWithLongSidesIsWarnedOf) {
  struct Case {
    double ratio;
    const char* mesh;
    bool warned;
  };
  for (const Case& at :
       {Case{10.0, "{size: 2.5}", true}, Case{20.0, "{size: 2.5}", true}, Case{100.0, "{size: 5}", true},
        Case{1000.0, "{size: 20}", true}, Case{10.0, "{size: 0.5, order: 1}", true},
        Case{20.0, "{size: 0.25, order: 1}", true}, Case{10.0, "{size: 1}", false},
        Case{100.0, "{size: 5, order: 3}", false}, Case{10.0, "{size: 2.5, kind: fem}", false}}) {
    const auto solution = run(cantilever(at.ratio, at.mesh));
    const double missing = 1.0 - tip(solution, at.ratio) / deflection(at.ratio);
    EXPECT_THAT(texts_of(solution.warnings),
                at.warned ? testing::Matcher<std::vector<std::string>>(
                                testing::Contains(testing::HasSubstr("bends too little")))
                          : testing::Matcher<std::vector<std::string>>(
                                testing::Not(testing::Contains(testing::HasSubstr("bends too little")))))
        << at.ratio << " " << at.mesh;
    const double stated = analysis::stiffened_in_bending(solution.mesh.bodies[0]);
    if (at.warned) {
      EXPECT_GT(missing, stated / 1.5) << at.ratio << " " << at.mesh;
      EXPECT_LT(missing, stated * 1.5) << at.ratio << " " << at.mesh;
    } else {
      EXPECT_LT(missing, 0.01) << at.ratio << " " << at.mesh;
    }
  }
}

TEST(SlenderBeam, UnitsDoNotMatter) {
  for (const Beam& beam : slender_beams) {
    const auto metres = run(cantilever(beam.ratio, beam.mesh(1.0))),
               millimetres = run(cantilever(beam.ratio, beam.mesh(1000.0), 1000.0, 1.0)),
               centimetres = run(cantilever(beam.ratio, beam.mesh(100.0), 100.0, 1e-3));
    const double expected = tip(metres, beam.ratio);
    EXPECT_NEAR(tip(millimetres, beam.ratio, 1000.0) / expected, 1.0, 1e-4) << beam.ratio;
    EXPECT_NEAR(tip(centimetres, beam.ratio, 100.0) / expected, 1.0, 1e-4) << beam.ratio;
  }
}

// Finer meshes, a scaling centre that is not in the middle, and directions in which no coordinate is exact.
TEST(SlenderBeam, MeshCentreAndDirectionDoNotMatter) {
  for (const char* mesh : {"{order: 3, size: 100}", "{order: 4, size: 25}", "{order: 3, size: 50, centre: [400, 0.5]}"})
    EXPECT_NEAR(tip(run(cantilever(1000.0, mesh)), 1000.0) / deflection(1000.0), 1.0, 1e-4) << mesh;
  const double c = std::cos(0.5), s = std::sin(0.5);
  const auto at = [&](double x, double y) { return Vec2(100.0 + c * x - s * y, 77.0 + s * x + c * y); };
  std::string vertices;
  for (const Vec2& x : {at(0, 0), at(1000, 0), at(1000, 1), at(0, 1)})
    vertices += fmt::format("{}[{:.17g}, {:.17g}]", vertices.empty() ? "" : ", ", x.x(), x.y());
  const auto solution = run(fmt::format(R"(
scabo: 1
materials: {{m: {{young: 1e9, poisson: 0}}}}
bodies: {{beam: {{material: m, shape: {{polygon: {{vertices: [{}]}}}}, mesh: {{order: 3, size: 50}}}}}}
supports: [{{on: beam.edge_4, fix: [x, y]}}]
loads: {{tip: {{on: beam.edge_2, force: [{:.17g}, {:.17g}]}}}}
)",
                                        vertices, s, -c));
  const Vec2 moved = result::Probe(solution, last(solution).fields, 0).at(at(1000.0, 0.5))->displacement;
  EXPECT_NEAR(moved.dot(Vec2(s, -c)) / deflection(1000.0), 1.0, 1e-4);
}

// Where digits run out, the warning states the order of the error.
TEST(SlenderBeam, SaysWhatRoundingOfItsStiffnessCosts) {
  for (const double ratio : {2000.0, 3000.0}) {
    const auto solution = run(cantilever(ratio, fmt::format("{{order: 3, size: {}}}", ratio / 20.0)));
    EXPECT_THAT(texts_of(solution.warnings), testing::Contains(testing::HasSubstr("rounding of the stiffness")))
        << ratio;
    const double error = std::abs(tip(solution, ratio) / deflection(ratio) - 1.0);
    EXPECT_LE(error, 6.0 * last(solution).lost_to_rounding) << ratio;
    EXPECT_LE(last(solution).lost_to_rounding, 1e-2) << ratio;
  }
}

// Nor does the estimate overflow with displacements that do not: it was infinite for loads of 1e90.
TEST(SlenderBeam, EstimateOfRoundingDoesNotDependOnTheSizeOfTheLoad) {
  const std::string text = cantilever(300.0, "{order: 3, size: 15}"), unit = "force: [0, -1]";
  const auto at = text.find(unit);
  ASSERT_NE(at, std::string::npos);
  const double expected = last(run(text)).lost_to_rounding;
  EXPECT_GT(expected, 0.0);
  for (const char* load : {"force: [0, -1e85]", "force: [0, -1e-85]"}) {
    const auto solution = run(std::string(text).replace(at, unit.size(), load));
    EXPECT_NEAR(last(solution).lost_to_rounding, expected, 1e-6 * expected) << load;
  }
}

TEST(SlenderBeam, IsRefusedAsTooSlender) {
  try {
    const auto solution = run(cantilever(1e5, "{order: 3, size: 5000}"));
    EXPECT_NE(solution.outcome, analysis::Outcome::solved);
  } catch (const InputError& error) {
    EXPECT_THAT(error.what(), testing::HasSubstr("times as long as deep"));
  }
}

// Two beams, one on the other without friction, built in at the left, the upper one pressed at its tip: they bend alike
// and share the load, so that the tip contact carries half of it.
TEST(SlenderBeam, TwoCantileversInContactShareTheLoad) {
  const auto solution = run(R"(
scabo: 1
materials: {m: {young: 1e9, poisson: 0}}
bodies:
  lower: {material: m, shape: {rectangle: {corner: [0, 0], size: [100, 1]}}, mesh: {size: 5, order: 3}}
  upper: {material: m, shape: {rectangle: {corner: [0, 1], size: [100, 1]}}, mesh: {size: 5, order: 3}}
supports: [{on: lower.left, fix: [x, y]}, {on: upper.left, fix: [x, y]}]
loads: {tip: {on: upper.top_right, force: [0, -1]}}
contacts: {joint: {between: [lower.top, upper.bottom], friction: 0}}
)");
  const analysis::IncrementResult& increment = last(solution);
  EXPECT_NEAR(increment.reactions[0].y() + increment.reactions[1].y(), 1.0, 1e-9);
  EXPECT_NEAR(increment.reactions[0].y(), increment.contacts[0].normal_force, 1e-9);
  EXPECT_NEAR(increment.contacts[0].normal_force, 0.5, 2e-3);
  const double down = -result::Probe(solution, increment.fields, 0).at({100.0, 0.5})->displacement.y();
  EXPECT_NEAR(down / (0.5 * deflection(100.0)), 1.0, 1e-2);
}

}  // namespace
}  // namespace scabo::verification
