// Published numbers and closed forms of contact between meshes of many cells that do not match.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <iostream>
#include <numbers>

#include "verification/models.hpp"
#include "verification/run.hpp"

namespace scabo::verification {
namespace {

// ---- Cattaneo and Mindlin ------------------------------------------------------------------------------

/// Two equal cylinders, radius 8, E = 200, nu = 0.3, plane strain, pressed together and then moved sideways.
struct Cattaneo {
  double P, Q, a, c, p0;  // forces; half widths of contact and stick; largest pressure
  static constexpr double mu = 0.2;

  Cattaneo(double normal, double tangential) : P(normal), Q(tangential) {
    const double R = 4.0, E = 200.0 / (2.0 * 0.91);
    a = std::sqrt(4.0 * P * R / (std::numbers::pi * E));
    p0 = 2.0 * P / (std::numbers::pi * a);
    c = a * std::sqrt(1.0 - Q / (mu * P));
  }
  double pressure(double x) const { return p0 * std::sqrt(std::max(0.0, 1.0 - x * x / (a * a))); }
  double shear(double x) const {
    return mu * (pressure(x) - c / a * p0 * std::sqrt(std::max(0.0, 1.0 - x * x / (c * c))));
  }
};

/// Linear between the pairs, which are sorted along x.
double interpolated(const std::vector<std::array<double, 2>>& values, double x) {
  const auto after =
      std::find_if(values.begin() + 1, values.end() - 1, [&](const auto& value) { return value[0] > x; });
  const auto& [x0, y0] = *(after - 1);
  const auto& [x1, y1] = *after;
  return std::lerp(y0, y1, (x - x0) / (x1 - x0));
}

/// Where the curve through points (x, value), sorted along x, differs from a pressure or shear in L2, relative, to 1.3
/// a.
template <typename Exact>
double difference(const std::vector<std::array<double, 2>>& values, double a, const Exact& exact) {
  double sum = 0.0, whole = 0.0;
  for (int i = -2600; i <= 2600; ++i) {
    const double x = 5e-4 * i * a;
    sum += std::pow(interpolated(values, x) - exact(x), 2);
    whole += std::pow(exact(x), 2);
  }
  return std::sqrt(sum / whole);
}

/// The same of the exact values at these points: what straight lines between the pairs differ by.
template <typename Exact>
double difference_of_lines(std::vector<std::array<double, 2>> values, double a, const Exact& exact) {
  for (auto& [x, value] : values) value = exact(x);
  return difference(values, a, exact);
}

/// Sizes relative to the half width `a` at the middle (0: none), at the ends of the stick zone and at the ends of the
/// contact.
std::string graded(double a, double c, const std::array<double, 3>& sizes) {
  std::string places;
  for (const auto& [x, size] :
       {std::pair(0.0, sizes[0]), std::pair(-0.5 * a, sizes[0]), std::pair(0.5 * a, sizes[0]), std::pair(-c, sizes[1]),
        std::pair(c, sizes[1]), std::pair(-a, sizes[2]), std::pair(a, sizes[2])})
    if (size > 0.0) places += fmt::format("{}{{near: [{}, 0], size: {}}}", places.empty() ? "" : ", ", x, a * size);
  return places;
}

/// One super-element, whose boundary has the nodes of the other body along the contact.
const std::string whole = "{size: 1}";

struct CattaneoCase {
  const char *low, *up;    // kinds of mesh
  double sideways, stick;  // displacement; the half width of stick that it gives, where the mesh is graded
  std::array<double, 3> sizes;
  int most;  // degrees of freedom
};

class CattaneoMindlin : public testing::TestWithParam<CattaneoCase> {};
constexpr std::array usual{0.5, 0.03, 0.02};
INSTANTIATE_TEST_SUITE_P(
    Loads, CattaneoMindlin,
    testing::Values(CattaneoCase{"polygons", "superelement", 3.12e-3, 0.2426, {0, 0.01, 0.006}, 5000},
                    CattaneoCase{"polygons", "superelement", 6.24e-3, 0.199, {0.3, 0.015, 0.01}, 5000},
                    CattaneoCase{"polygons", "superelement", 9.35e-3, 0.145, {0.4, 0.02, 0.015}, 5000},
                    CattaneoCase{"polygons", "polygons", 3.12e-3, 0.243, usual, 8000},
                    CattaneoCase{"polygons", "polygons", 6.24e-3, 0.198, usual, 8000},
                    CattaneoCase{"polygons", "polygons", 9.35e-3, 0.140, usual, 8000},
                    CattaneoCase{"quadtree", "quadtree", 6.24e-3, 0.198, usual, 13000}));

TEST_P(CattaneoMindlin, ShearTractionAndStickZone) {
  const CattaneoCase& of = GetParam();
  const double a = 0.2804;
  const auto mesh = [&](const std::string& kind, double factor) {
    if (kind == "superelement") return whole;
    return fmt::format("{{kind: {}, size: 8, refine: [{}]}}", kind,
                       graded(a, of.stick, {factor * of.sizes[0], factor * of.sizes[1], factor * of.sizes[2]}));
  };
  const auto solution = run(fmt::format(R"(scabo: 1
analysis: {{plane: strain}}
materials: {{steel: {{young: 200, poisson: 0.3}}}}
bodies:
  low:
    material: steel
    shape: {{outline: [{{line: {{from: [-8, -8], to: [8, -8]}}, name: base}}, {{arc: {{to: [-8, -8], centre: [0, -8]}}, name: rim}}]}}
    mesh: {0}
  up:
    material: steel
    shape: {{outline: [{{line: {{from: [8, 8], to: [-8, 8]}}, name: top}}, {{arc: {{to: [8, 8], centre: [0, 8]}}, name: rim}}]}}
    mesh: {1}
supports:
  - {{on: low.base, fix: [x, y]}}
  - {{on: up.top, displacement: [null, -0.04], name: down}}
  - {{on: up.top, displacement: [{2}, null], name: aside}}
contacts: {{touch: {{between: [low.rim, up.rim], friction: 0.2}}}}
steps: [{{loads: {{down: 1}}}}, {{loads: {{aside: 1}}}}]
)",
                                        mesh(of.low, 1.0), mesh(of.up, 0.8), of.sideways));
  const analysis::ContactResult& touch = contact_of(last(solution));
  const Cattaneo exact(touch.normal_force, std::abs(touch.tangential_force));
  std::vector<std::array<double, 2>> pressure, shear;
  double sticks = 0.0, slips = exact.a;  // last pair that sticks, first one that slips
  for (const analysis::PairResult& pair : touch.pairs) {
    pressure.push_back({pair.position.x(), pair.pressure});
    shear.push_back({pair.position.x(), std::abs(pair.shear)});
    if (pair.state == contact::ContactState::stick) sticks = std::max(sticks, std::abs(pair.position.x()));
    if (pair.state == contact::ContactState::slip) slips = std::min(slips, std::abs(pair.position.x()));
  }
  std::sort(pressure.begin(), pressure.end());
  std::sort(shear.begin(), shear.end());
  const auto p = [&](double x) { return exact.pressure(x); };
  const auto q = [&](double x) { return exact.shear(x); };
  const double of_pressure = difference(pressure, exact.a, p), of_shear = difference(shear, exact.a, q);
  std::cout << of.low << " and " << of.up << ", Q/(mu P) " << exact.Q / (exact.mu * exact.P) << ", "
            << 2 * solution.mesh.nodes() << " dofs: pressure " << of_pressure << ", shear " << of_shear
            << " in L2; exact values at the pairs " << difference_of_lines(pressure, exact.a, p) << ", "
            << difference_of_lines(shear, exact.a, q) << "; stick c/a " << exact.c / exact.a << ", between "
            << sticks / exact.a << " and " << slips / exact.a << "\n";
  EXPECT_LT(2 * solution.mesh.nodes(), of.most);
  EXPECT_LT(of_pressure, 5e-3);
  EXPECT_LT(of_shear, 1e-2);
  EXPECT_NEAR(0.5 * (sticks + slips), exact.c, 0.015 * exact.a);
}

// ---- Hertz -----------------------------------------------------------------------------------------------

// A steel roller of radius 50 mm on an aluminium block under 1 MN/m, as example 12: pressure in L2, and it converges.
TEST(Hertz, PressureOfFewDegreesOfFreedom) {
  const double P = 1e6, R = 0.05, E = 1.0 / (0.91 / 210e9 + 0.91 / 70e9),
               a = std::sqrt(4.0 * P * R / (std::numbers::pi * E)), largest = 2.0 * P / (std::numbers::pi * a);
  const auto exact = [&](double x) { return largest * std::sqrt(std::max(0.0, 1.0 - x * x / (a * a))); };
  const auto error = [&](const std::string& block, const std::string& roller, int most) {
    const auto solution = run(fmt::format(R"(scabo: 1
analysis: {{plane: strain}}
materials: {{steel: {{young: 210e9, poisson: 0.3}}, aluminium: {{young: 70e9, poisson: 0.3}}}}
bodies:
  block: {{material: aluminium, shape: {{rectangle: {{corner: [-0.2, -0.2], size: [0.4, 0.2]}}}}, mesh: {}}}
  roller:
    material: steel
    shape: {{outline: [{{line: {{from: [0.05, 0.05], to: [-0.05, 0.05]}}, name: top}}, {{arc: {{to: [0.05, 0.05], centre: [0, 0.05]}}, name: rim}}]}}
    mesh: {}
supports: [{{on: block.bottom, fix: [x, y]}}, {{on: roller.top, fix: x}}]
loads: {{press: {{on: roller.top, pressure: 10e6}}}}
contacts: {{touch: {{between: [block.top, roller.rim]}}}}
)",
                                          block, roller));
    std::vector<std::array<double, 2>> pressure;
    for (const analysis::PairResult& pair : contact_of(last(solution)).pairs)
      pressure.push_back({pair.position.x(), pair.pressure});
    std::sort(pressure.begin(), pressure.end());
    const double found = difference(pressure, a, exact);
    std::cout << "Hertz, " << 2 * solution.mesh.nodes() << " dofs: " << found << " in L2, exact values at the pairs "
              << difference_of_lines(pressure, a, exact) << "\n";
    EXPECT_LT(2 * solution.mesh.nodes(), most);
    return found;
  };
  const auto cells = [&](const char* kind, double size, double end) {
    return fmt::format(
        "{{kind: {0}, size: {1}, refine: [{{near: [-{2}, 0], size: {3}}}, {{near: [{2}, 0], size: {3}}}]}}", kind, size,
        a, a * end);
  };
  const double coarse = error(cells("polygons", 0.2, 0.16), "{size: 0.01}", 3500),
               fine = error(cells("polygons", 0.2, 0.02), "{size: 0.01}", 5000);
  EXPECT_LT(fine, 5e-3);
  EXPECT_LT(fine, 0.5 * coarse);
  EXPECT_LT(error("{size: 0.1}", cells("polygons", 0.05, 0.04), 3500), 1e-2);
  EXPECT_LT(error("{size: 0.1}", cells("quadtree", 0.05, 0.04), 5500), 1e-2);
  EXPECT_LT(error(cells("polygons", 0.2, 0.1), cells("polygons", 0.05, 0.08), 6000), 1e-2);
}

// ---- Persson -------------------------------------------------------------------------------------------

/// Half angle of contact e in degrees; E* dR / Q; R p_max / Q. The pin of this clearance dR is loaded at its centre.
class PerssonsPin : public testing::TestWithParam<std::array<double, 3>> {};
INSTANTIATE_TEST_SUITE_P(Angles, PerssonsPin,
                         testing::Values(std::array{30.0, 7.943540, 1.260289}, std::array{45.0, 2.823121, 0.882111},
                                         std::array{60.0, 1.067202, 0.711721}, std::array{75.0, 0.287077, 0.628103},
                                         std::array{84.828, 0.0, 0.599629}));

TEST_P(PerssonsPin, OfPolygonsInAnUnboundedPlate) {
  const auto [half_angle, clearance, pressure] = GetParam();
  const double dR = 1e-3 * clearance;  // E* = 1e3, R = 1, Q = 1
  const auto solution = run(fmt::format(R"(scabo: 1
analysis: {{plane: strain}}
materials: {{m: {{young: 910, poisson: 0.3}}}}
bodies:
  pin:
    material: m
    shape:
      outline:
        - {{arc: {{from: [1, 0], to: [-1, 0], centre: [0, 0]}}, name: crown}}
        - {{arc: {{to: [1, 0], centre: [0, 0]}}, name: rim}}
    holes: {{bore: {{circle: {{centre: [0, 0], radius: 0.02}}}}}}
    mesh: {{size: 0.3, kind: polygons, refine: [{{on: rim, size: 0.066}}, {{near: [0, 0], size: 0.02}}]}}
  plate:
    material: m
    outside: true
    reference: [0, -1000]
    shape:
      outline:
        - {{arc: {{from: [{0:.15g}, {1:.15g}], to: [-{0:.15g}, {1:.15g}], centre: [0, {1:.15g}]}}, name: crown}}
        - {{arc: {{to: [{0:.15g}, {1:.15g}], centre: [0, {1:.15g}]}}, name: rim}}
    mesh: {{size: 0.06}}
supports: [{{on: pin.vertex_1, fix: x}}, {{on: {{body: pin, near: [0, 1]}}, fix: x}}]
loads: {{press: {{on: pin.bore, force: [0, -1]}}}}
contacts: {{joint: {{between: [pin.rim, plate.rim]}}}}
)",
                                        1.0 + dR, dR));
  double largest = 0.0, edge = 0.0, after = 180.0;  // last angle in contact, first one that is not
  for (const analysis::PairResult& pair : contact_of(last(solution)).pairs) {
    const double angle = std::atan2(std::abs(pair.position.x()), -pair.position.y()) * 180 / std::numbers::pi;
    largest = std::max(largest, pair.pressure);
    if (pair.pressure > 0.0) edge = std::max(edge, angle);
  }
  for (const analysis::PairResult& pair : contact_of(last(solution)).pairs) {
    const double angle = std::atan2(std::abs(pair.position.x()), -pair.position.y()) * 180 / std::numbers::pi;
    if (angle > edge + 1e-9) after = std::min(after, angle);
  }
  std::cout << half_angle << " degrees, " << 2 * solution.mesh.nodes() << " dofs: largest pressure "
            << largest / pressure - 1.0 << ", contact ends between " << edge << " and " << after << "\n";
  EXPECT_LT(2 * solution.mesh.nodes(), 5000);
  EXPECT_NEAR(largest / pressure, 1.0, 5e-3);
  EXPECT_NEAR(edge, half_angle, 1.5);
}

// ---- press fit -----------------------------------------------------------------------------------------

// Lame: a shaft of radius 50 in a hub to radius 100, interference 0.05, E = 210e3, plane stress: pressure 78.75 all
// around.
TEST(PressFit, PressureIsUniformOverMeshesThatDoNotMatch) {
  struct Case {
    const char *shaft, *hub;
    double bound, mean;
  };
  for (const auto& [shaft, hub, bound, mean] :
       {Case{"quadtree", "polygons", 2e-3, 1e-4}, Case{"polygons", "polygons", 4e-3, 1e-4},
        Case{"polygons", "quadtree", 1e-2, 5e-4}}) {
    const auto solution = run(fmt::format(R"(scabo: 1
materials: {{steel: {{young: 210e3, poisson: 0.3}}}}
bodies:
  shaft: {{material: steel, shape: {{circle: {{centre: [0, 0], radius: 50}}}}, mesh: {{size: 12, order: 2, kind: {}}}}}
  hub:
    material: steel
    shape: {{circle: {{centre: [0, 0], radius: 100}}}}
    holes: {{bore: {{circle: {{centre: [0, 0], radius: 50}}}}}}
    mesh: {{size: 15, order: 2, kind: {}}}
supports: [{{on: {{body: hub, near: [100, 0]}}, fix: [x, y]}}, {{on: {{body: hub, near: [-100, 0]}}, fix: y}}]
contacts: {{fit: {{between: [shaft.rim, hub.bore], friction: 0.1, gap: -0.05}}}}
)",
                                          shaft, hub));
    double least = 1e9, largest = 0.0, sum = 0.0;
    const auto& pairs = contact_of(last(solution)).pairs;
    for (const analysis::PairResult& pair : pairs) {
      least = std::min(least, pair.pressure / 78.75);
      largest = std::max(largest, pair.pressure / 78.75);
      sum += pair.pressure / 78.75;
    }
    std::cout << shaft << " in " << hub << ", " << 2 * solution.mesh.nodes() << " dofs: pressure " << least << " to "
              << largest << ", mean " << sum / pairs.size() << "\n";
    EXPECT_LT(2 * solution.mesh.nodes(), 5000);
    EXPECT_NEAR(least, 1.0, bound);
    EXPECT_NEAR(largest, 1.0, bound);
    EXPECT_NEAR(sum / pairs.size(), 1.0, mean);
  }
}

// ---- double cantilever beam ----------------------------------------------------------------------------

// The beams of example 01 as 2,000 and 3,500 polygons: the converged force, the same with A and B
// swapped.
TEST(DoubleCantileverBeam, OfThousandsOfPolygonsThatDoNotMatch) {
  const std::string text =
      double_cantilever("kind: polygons, size: 0.0698, order: 1", "kind: polygons, size: 0.0518, order: 1") +
      "output: {fields: []}\n";
  const auto solution = run(text), swapped = run(text, {"contacts.joint.between=[upper.bottom, lower.top]"});
  const double force = contact_of(last(solution)).normal_force;
  std::cout << solution.cells[0].size() << " and " << solution.cells[1].size() << " polygons: " << force << " N\n";
  EXPECT_NEAR(static_cast<double>(solution.cells[0].size()), 2000.0, 50.0);
  EXPECT_NEAR(static_cast<double>(solution.cells[1].size()), 3500.0, 100.0);
  EXPECT_NEAR(force / double_cantilever_force, 1.0, 1e-3);
  EXPECT_NEAR(contact_of(last(swapped)).normal_force / force, 1.0, 1e-12);
}

}  // namespace
}  // namespace scabo::verification
