// Natural frequencies against a closed form and against converged finite elements.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <numbers>
#include <stdexcept>

#include "scabo/analysis/modal/modal_analysis.hpp"
#include "scabo/input/read_model.hpp"

namespace scabo::verification {
namespace {

constexpr const char* free_square = R"(
scabo: 1
analysis: {type: modal, modes: 13}
materials: {steel: {young: 210e9, poisson: 0.3, density: 7800}}
bodies:
  plate: {material: steel, shape: {rectangle: {corner: [0, 0], size: [1, 1]}}, mesh: {size: 0.25}}
)";
constexpr const char* cantilever = R"(
scabo: 1
analysis: {type: modal}
materials: {steel: {young: 210e9, poisson: 0.3, density: 7800}}
bodies:
  beam: {material: steel, shape: {rectangle: {corner: [0, 0], size: [5, 1]}}, mesh: {size: 0.25}}
supports: [{on: beam.left, fix: [x, y]}]
)";

analysis::ModalResult run(const std::string& text, const std::vector<std::string>& settings = {}) {
  test::record_model(text, settings);
  std::vector<input::Override> overrides;
  for (const std::string& setting : settings) overrides.push_back(input::parse_override(setting));
  analysis::ModalResult result = analysis::solve_modal(input::parse_model(text, "test.yaml", overrides));
  if (result.modes.empty()) throw std::runtime_error("the run ended without a mode");
  return result;
}

/// Frequencies of the modes that deform.
std::vector<double> elastic(const analysis::ModalResult& result) {
  std::vector<double> frequencies;
  for (const analysis::NaturalMode& mode : result.modes)
    if (!mode.rigid) frequencies.push_back(mode.frequency);
  return frequencies;
}

/// Converged, by a program that shares nothing with Scabo: hp finite elements (converged_numbers.py). The fourth is
/// Lame's mode, a closed form.
const std::vector<double> square_converged = {2008.9150, 2139.6524, 2139.6524, 2275.4153, 2586.1454,
                                              2988.5675, 3223.0587, 3223.0587, 3725.1275, 4301.2834};
const std::vector<double> cantilever_converged = {32.5938,  176.0740, 259.9840,  420.5039,  700.3939,
                                                  777.6182, 998.4562, 1286.0378, 1297.6885, 1580.8756};

/// Errors in per cent, rounded to a hundredth.
std::vector<double> errors(const std::vector<double>& frequencies, const std::vector<double>& converged) {
  std::vector<double> percent;
  for (std::size_t i = 0; i < converged.size(); ++i)
    percent.push_back(std::round(1e4 * (frequencies.at(i) / converged[i] - 1.0)) / 100.0);
  return percent;
}

// The corners of the free end move equally far, in bending with opposite components along the beam.
TEST(NaturalFrequencies, TheSignOfAModeIsThatOfTheFirstNodeThatMovesFarthest) {
  for (const analysis::NaturalMode& mode : run(cantilever).modes) {
    const Vector& shape = mode.shape.front();
    Eigen::Index node = 0;
    while (node < shape.size() / 2 && shape.segment<2>(2 * node).norm() < 1.0 - 1e-6) ++node;
    ASSERT_LT(node, shape.size() / 2);
    EXPECT_GT(shape.segment<2>(2 * node).maxCoeff(), std::numbers::sqrt2 / 2.0) << mode.frequency;
  }
}

// Lame's mode of a free square of side a, u = sin(kx) cos(ky), v = -cos(kx) sin(ky), k = pi / a about its centre: no
// dilatation, no traction on the sides, omega = sqrt(2) k sqrt(G / rho), in plane stress and plane strain.
TEST(NaturalFrequencies, LamesModeOfAFreeSquareInFiniteElements) {
  const double G = 210e9 / 2.6, exact = std::sqrt(G / 7800.0) / std::numbers::sqrt2;
  for (const char* plane : {"stress", "strain"}) {
    std::vector<double> error;
    for (const char* size : {"0.125", "0.0625"}) {
      double nearest = 0.0;
      for (double f : elastic(run(free_square, {std::string("analysis.plane=") + plane,
                                                std::string("bodies.plate.mesh={kind: fem, size: ") + size + "}"})))
        if (std::abs(f - exact) < std::abs(nearest - exact)) nearest = f;
      error.push_back(nearest / exact - 1.0);
    }
    EXPECT_GT(error[1], 0.0) << plane;
    EXPECT_LT(error[1], 3e-6) << plane;
    EXPECT_NEAR(std::log2(error[0] / error[1]), 4.0, 0.05) << plane;
  }
}

TEST(NaturalFrequencies, FiniteElementsOfAnEighthAreConvergedToAQuarterOfAPerCent) {
  const auto square = elastic(run(free_square, {"bodies.plate.mesh={kind: fem, size: 0.125}"}));
  const auto beam = elastic(run(cantilever, {"bodies.beam.mesh={kind: fem, size: 0.125}"}));
  for (std::size_t i = 0; i < 10; ++i) {
    EXPECT_NEAR(square.at(i) / square_converged[i], 1.0, 2e-3) << i;
    EXPECT_NEAR(beam.at(i) / cantilever_converged[i], 1.0, 5e-4) << i;
  }
}

// What one super-element is worth: the figures of docs/methods/16_mass.md. Its inside has one level of its own, so that
// the lowest fall with smaller boundary elements.
TEST(NaturalFrequencies, OfAFreeSquareThatIsOneSuperElement) {
  EXPECT_EQ(errors(elastic(run(free_square)), square_converged),
            (std::vector<double>{0.06, 0.09, 0.09, 0.01, 0.06, 0.04, 0.19, 0.19, 1.31, 2.18}));
  EXPECT_EQ(errors(elastic(run(free_square, {"bodies.plate.mesh={size: 0.25, order: 8}"})), square_converged),
            (std::vector<double>{0.01, 0.03, 0.03, 0.01, 0.01, 0.03, 0.04, 0.04, 0.8, 1.4}));
}

// Without the level 2162 and 2282 Hz.
TEST(NaturalFrequencies, OfAFreeSquareOfOrderFourWithOneInternalLevel) {
  const auto frequencies = elastic(run(free_square, {"bodies.plate.mesh={size: 0.5, order: 4}"}));
  EXPECT_NEAR(frequencies.at(0), 2009.1, 0.05);
  EXPECT_NEAR(frequencies.at(1), 2140.3, 0.05);
}

// Halves that are tied have a level each; their parts are sparse, of few unknowns and of many.
TEST(NaturalFrequencies, OfTiedSuperElementsHaveTheirLevels) {
  for (const auto& [size, error] : {std::pair{"0.125", 5e-4}, std::pair{"0.025", 5e-4}}) {
    const auto frequencies = elastic(run(fmt::format(R"(
scabo: 1
analysis: {{type: modal, modes: 8}}
materials: {{steel: {{young: 210e9, poisson: 0.3, density: 7800}}}}
bodies:
  left: {{material: steel, shape: {{rectangle: {{corner: [0, 0], size: [0.5, 1]}}}}, mesh: {{size: {0}}}}}
  right: {{material: steel, shape: {{rectangle: {{corner: [0.5, 0], size: [0.5, 1]}}}}, mesh: {{size: {0}}}}}
ties: {{glue: {{between: [left.right, right.left]}}}}
)",
                                                     size)));
    ASSERT_EQ(frequencies.size(), 5u);
    for (std::size_t i = 0; i < 5; ++i) {
      EXPECT_GT(frequencies[i], square_converged[i]);
      EXPECT_LT(frequencies[i] / square_converged[i] - 1.0, error) << size;
    }
  }
}

TEST(NaturalFrequencies, OfACantileverThatIsOneSuperElement) {
  EXPECT_EQ(errors(elastic(run(cantilever)), cantilever_converged),
            (std::vector<double>{0.05, 0.05, 0.01, 0.06, 0.08, 0.02, 0.13, 0.07, 0.21, 0.31}));
  EXPECT_EQ(errors(elastic(run(cantilever, {"bodies.beam.mesh={size: 0.25, order: 8}"})), cantilever_converged),
            (std::vector<double>{0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.06, 0.01, 0.02}));
}

// Rayleigh's principle: every displacement xi^S u(1) - phi(xi) w is one that the body can have.
TEST(NaturalFrequencies, OfSuperElementsAreUpperBoundsThatFallAsTheBoundaryIsRefined) {
  std::vector<double> before(10, 1e300);
  for (const char* size : {"0.5", "0.25", "0.125"}) {
    const auto frequencies = elastic(run(free_square, {std::string("bodies.plate.mesh.size=") + size}));
    for (std::size_t i = 0; i < 10; ++i) EXPECT_GT(frequencies.at(i), square_converged[i]);
    EXPECT_LT(frequencies[0], before[0]);
    EXPECT_LT(frequencies[9], before[9]);
    before = frequencies;
  }
}

// What the table of docs/methods/16_mass.md says. Converged: closed forms between rollers on all edges, c / 2a of
// pressure waves or c / (sqrt(2) a) of shear waves; 8-node elements of 1/16 otherwise.
struct Held {
  std::string name, size;
  std::vector<std::string> supports;
  double converged = 0.0;  // first elastic frequency, Hz
  double error = 0.0;      // per cent
  std::string plane = "stress";
};
void PrintTo(const Held& held, std::ostream* out) { *out << held.name; }

class FirstFrequency : public testing::TestWithParam<Held> {};

TEST_P(FirstFrequency, OfOneSuperElementIsTooHighByWhatIsSaidOfIt) {
  const Held& held = GetParam();
  std::string supports;
  for (const std::string& support : held.supports) supports += (supports.empty() ? "" : ", ") + support;
  const auto frequencies =
      elastic(run(free_square, {"bodies.plate.shape.rectangle.size=" + held.size, "supports=[" + supports + "]",
                                "analysis.plane=" + held.plane, "analysis.modes=4"}));
  EXPECT_NEAR(100.0 * (frequencies.at(0) / held.converged - 1.0), held.error, 0.002);
}

const double shear_speed = std::sqrt(210e9 / 2.6 / 7800.0), plane_stress_speed = std::sqrt(210e9 / 0.91 / 7800.0),
             plane_strain_speed = std::sqrt(210e9 * 0.7 / (1.3 * 0.4) / 7800.0);
const std::string left = "{on: plate.left, fix: [x, y]}", right = "{on: plate.right, fix: [x, y]}",
                  bottom = "{on: plate.bottom, fix: [x, y]}", top = "{on: plate.top, fix: [x, y]}",
                  roll_left = "{on: plate.left, fix: [x]}", roll_right = "{on: plate.right, fix: [x]}",
                  roll_bottom = "{on: plate.bottom, fix: [y]}", roll_top = "{on: plate.top, fix: [y]}";
const std::vector<std::string> all_edges = {roll_left, roll_right, roll_bottom, roll_top};

INSTANTIATE_TEST_SUITE_P(
    Held, FirstFrequency,
    testing::Values(
        Held{"beam_built_in", "[5, 1]", {left}, 32.5938, 0.044},
        Held{"rectangle_built_in", "[2, 1]", {left}, 179.4173, 0.072},
        Held{"square_built_in", "[1, 1]", {left}, 543.5056, 0.107},
        Held{"rectangle_free", "[2, 1]", {}, 845.6268, 0.015},
        Held{"rectangle_between_built_in_ends", "[2, 1]", {left, right}, 653.8473, 0.118},
        Held{"rectangle_rollers_on_the_ends", "[2, 1]", {roll_left, roll_right}, 444.9847, 0.003},
        Held{"rectangle_rollers_on_the_long_edges", "[2, 1]", {roll_bottom, roll_top}, 1359.8207, 0.008},
        Held{"rectangle_rollers_on_three_edges", "[2, 1]", {roll_left, roll_right, roll_bottom}, 1137.7077, 0.013},
        Held{"beam_rollers_all_around", "[5, 1]", all_edges, plane_stress_speed / 10.0, 0.0},
        Held{"square_rollers_all_around", "[1, 1]", all_edges, shear_speed / std::numbers::sqrt2, 0.125},
        Held{"rectangle_rollers_all_around", "[2, 1]", all_edges, plane_stress_speed / 4.0, 0.065},
        Held{"rectangle_rollers_all_around_plane_strain", "[2, 1]", all_edges, plane_strain_speed / 4.0, 0.082,
             "strain"},
        Held{"rectangle_between_built_in_long_edges", "[2, 1]", {bottom, top}, 1535.406, 0.228},
        Held{"square_built_in_and_rollers", "[1, 1]", {left, right, roll_bottom, roll_top}, 2719.6415, 0.323}),
    [](const auto& parameter) { return parameter.param.name; });

TEST(NaturalFrequencies, OfASlenderBeamTendToEulersBeam) {
  const double beta = 1.875104068711961, L = 40.0, E = 210e9, rho = 7800.0;
  const double euler = beta * beta / (2.0 * std::numbers::pi * L * L) * std::sqrt(E / (12.0 * rho));
  const auto frequencies =
      elastic(run(cantilever, {"bodies.beam.shape.rectangle.size=[40, 1]", "bodies.beam.mesh.size=0.5"}));
  EXPECT_NEAR(frequencies.at(0) / euler, 1.0, 1e-3);
}

TEST(NaturalFrequencies, ScaleWithTheSpeedOfSoundOverTheSize) {
  const auto metres = elastic(run(free_square));
  const auto millimetres =  // N, mm, tonne
      elastic(run(free_square,
                  {"materials.steel={young: 210e3, poisson: 0.3, density: 7.8e-9}", "bodies.plate.mesh.size=250",
                   "bodies.plate.shape.rectangle.size=[1000, 1000]", "analysis.thickness=17"}));
  ASSERT_EQ(metres.size(), 10u);
  for (std::size_t i = 0; i < 10; ++i) EXPECT_NEAR(millimetres[i] / metres[i], 1.0, 1e-11);
}

TEST(NaturalFrequencies, AFreeBodyHasThreeRigidBodyModes) {
  for (const char* mesh :
       {"{size: 0.25}", "{size: 0.5, order: 5}", "{kind: fem, size: 0.25}", "{kind: fem, size: 0.0625}"}) {
    const auto result = run(free_square, {std::string("bodies.plate.mesh=") + mesh});
    for (std::size_t k = 0; k < result.modes.size(); ++k) {
      EXPECT_EQ(result.modes[k].rigid, k < 3) << mesh;
      EXPECT_LT(result.modes[k].residual, 1e-13) << mesh;
    }
    EXPECT_EQ(result.modes[2].frequency, 0.0);
    EXPECT_GT(result.modes[3].frequency, 2000.0);
    EXPECT_NEAR(result.total_mass, 7800.0, 1e-9);
    EXPECT_NEAR(result.modes[0].effective_mass.x(), 7800.0, 1e-8);
    EXPECT_NEAR(result.modes[1].effective_mass.y(), 7800.0, 1e-8);
    EXPECT_NEAR(result.modes[4].effective_mass.norm(), 0.0, 1e-8);
  }
}

TEST(NaturalFrequencies, SupportsThatLetABodySlideLeaveOneRigidBodyMode) {
  const auto result = run(free_square, {"supports=[{on: plate.bottom, fix: y}]"});
  EXPECT_TRUE(result.modes[0].rigid);
  EXPECT_FALSE(result.modes[1].rigid);
  EXPECT_NEAR(result.modes[0].effective_mass.x(), 7800.0, 1e-8);
}

TEST(NaturalFrequencies, BodiesVibrateByThemselvesAndContactsAreSaidToBeLeftOut) {
  const auto alone = run(cantilever, {"analysis.modes=5"});
  const auto two = run(R"(
scabo: 1
analysis: {type: modal}
materials: {steel: {young: 210e9, poisson: 0.3, density: 7800}}
bodies:
  beam: {material: steel, shape: {rectangle: {corner: [0, 0], size: [5, 1]}}, mesh: {size: 0.25}}
  other: {material: steel, shape: {rectangle: {corner: [0, 1], size: [5, 1]}}, mesh: {size: 0.25}}
supports: [{on: beam.left, fix: [x, y]}, {on: other.left, displacement: [0, 1e-3], name: settle}]
loads: {tip: {on: other.top_right, force: [0, -1]}}
contacts: {joint: {between: [beam.top, other.bottom]}}
)");
  ASSERT_EQ(two.modes.size(), 10u);
  for (std::size_t k = 0; k < 10; ++k) {
    EXPECT_DOUBLE_EQ(two.modes[k].frequency, alone.modes[k / 2].frequency);
    EXPECT_EQ(two.modes[k].bodies, std::vector<int>{static_cast<int>(k % 2)});
  }
  ASSERT_EQ(two.warnings.size(), 2u);
  EXPECT_EQ(two.warnings[0].text,
            "a modal analysis ignores the model's loads and contacts: each body vibrates by itself");
  EXPECT_NE(two.warnings[1].text.find("'settle'"), std::string::npos);
}

TEST(NaturalFrequencies, MoreModesThanThereAreAreNotInvented) {
  const auto result = run(free_square, {"analysis.modes=20", "bodies.plate.mesh={size: 1, order: 1}"});
  EXPECT_EQ(result.modes.size(), 16u);  // of the boundary and of the inside
  ASSERT_EQ(result.warnings.size(), 1u);
  EXPECT_NE(result.warnings[0].text.find("16 modes only"), std::string::npos);
}

}  // namespace
}  // namespace scabo::verification
