// Exponents of wedges whose side faces are held: closed forms.
#include <fmt/format.h>

#include <cmath>
#include <complex>
#include <numbers>

#include "run.hpp"
#include "scabo/element/exponents.hpp"

namespace scabo::verification {
namespace {

using std::numbers::pi;

/// A wedge of radius 1 and angle w, counter-clockwise from the x axis, as a polygon with its scaling centre at the tip.
/// Its faces are edge_1 and edge_N.
std::string wedge(double w, int parts, const std::string& supports) {
  std::string vertices = "[0, 0]";
  for (int k = 0; k <= parts; ++k)
    vertices += fmt::format(", [{:.17g}, {:.17g}]", std::cos(w * k / parts), std::sin(w * k / parts));
  return fmt::format(R"(scabo: 1
analysis: {{plane: strain}}
materials: {{m: {{young: 1, poisson: 0.3}}}}
bodies:
  wedge: {{material: m, shape: {{polygon: {{vertices: [{}]}}}}, mesh: {{size: 2, order: 10, centre: [0, 0]}}}}
supports: {}
loads: {{pull: {{on: wedge.edge_2, traction: [1, 0]}}}}
)",
                     vertices, supports);
}

std::vector<std::complex<double>> exponents_below(const std::string& text, double most) {
  std::vector<std::complex<double>> below;
  for (const auto& body : element::exponents_of(input::parse_model(text, "test.yaml")))
    for (const element::Exponent& exponent : body.exponents)
      if (exponent.value.real() < most) below.push_back(exponent.value);
  return below;
}

// Fixed and free: sin^2(lambda w) = (4 (1 - nu)^2 - lambda^2 sin^2 w) / (3 - 4 nu) (Williams 1952). At 90 degrees and
// nu = 0.3 the least is 0.7112, at 180 degrees 1/2 +- i ln(3 - 4 nu) / 2 pi.
TEST(SideFaces, ExponentsOfAWedgeFixedOnOneFace) {
  const double nu = 0.3, kappa = 3.0 - 4.0 * nu;
  for (const double degrees : {60.0, 90.0, 135.0, 180.0, 270.0}) {
    const double w = degrees * pi / 180.0;
    const int parts = static_cast<int>(std::ceil(degrees / 30.0));
    for (const std::string& face : {std::string("edge_1"), fmt::format("edge_{}", parts + 2)}) {
      const auto found = exponents_below(wedge(w, parts, fmt::format("[{{on: wedge.{}, fix: [x, y]}}]", face)), 2.5);
      ASSERT_FALSE(found.empty());
      for (const std::complex<double>& lambda : found) {
        EXPECT_GT(lambda.real(), 0.1);  // no translation is left
        const std::complex<double> s = std::sin(lambda * w), t = lambda * std::sin(w);
        EXPECT_LT(std::abs(s * s - (4.0 * (1.0 - nu) * (1.0 - nu) - t * t) / kappa), 1e-6) << degrees << " " << lambda;
      }
      if (degrees == 90.0) EXPECT_NEAR(found.front().real(), 0.7112, 1e-4);
      if (degrees == 180.0) {
        EXPECT_NEAR(found.front().real(), 0.5, 1e-8);
        EXPECT_NEAR(found.front().imag(), std::log(kappa) / (2.0 * pi), 1e-8);
      }
    }
  }
}

// On a line of symmetry a wedge is half of one with twice its angle: sin(2 lambda w) + lambda sin(2 w) = 0.
TEST(SideFaces, ExponentsOfAWedgeOnALineOfSymmetry) {
  for (const double degrees : {70.0, 135.0, 180.0}) {
    const double w = degrees * pi / 180.0;
    const auto found =
        exponents_below(wedge(w, 6, "[{on: wedge.edge_1, fix: normal}, {on: wedge.vertex_4, fix: x}]"), 2.5);
    int zeros = 0;
    for (const std::complex<double>& lambda : found) {
      if (lambda == 0.0) ++zeros;
      EXPECT_LT(std::abs(std::sin(2.0 * lambda * w) + lambda * std::sin(2.0 * w)), 1e-6) << degrees << " " << lambda;
    }
    EXPECT_EQ(zeros, 1);  // along the face
    if (degrees == 135.0) EXPECT_NEAR(found[1].real(), 0.544484, 1e-6);
    if (degrees == 180.0) EXPECT_NEAR(found[1].real(), 0.5, 1e-8);
  }
}

}  // namespace
}  // namespace scabo::verification
