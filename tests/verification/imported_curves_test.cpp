// Closed curves of mesh files that touch something in one point: largest pressures are those of Hertz, with the radius
// of curvature at this point.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <numbers>

#include "support/mesh_text.hpp"
#include "verification/run.hpp"

namespace scabo::verification {
namespace {

using std::numbers::pi;

struct Ellipse {
  double across = 1.0, up = 1.0;  // half axes
  int sides = 128;                // of the rim
  bool quadratic = true;          // sides with middle nodes on the curve, otherwise chords
  double start = 0.0;             // angle of the first node, in sides: at 0.5 the lowest point is between nodes
  Vec2 centre = Vec2::Zero();
  double angle = 0.0, unit = 1.0;  // turned about the origin, and a metre in units of length
};

/// Quadrilaterals around a polygon in the middle, nodes closer to each other towards the rim.
std::string file_of(const Ellipse& ellipse) {
  test::MeshText mesh;
  const int layers = ellipse.sides / 8, count = (ellipse.quadratic ? 2 : 1) * ellipse.sides;
  const auto point = [&](double r, double k) {
    const double angle = -0.5 * pi + 2.0 * pi * (k / count + ellipse.start / ellipse.sides);
    const Vec2 x = ellipse.centre + r * Vec2(ellipse.across * std::cos(angle), ellipse.up * std::sin(angle));
    return Vec2(ellipse.unit * Vec2(std::cos(ellipse.angle) * x.x() - std::sin(ellipse.angle) * x.y(),
                                    std::sin(ellipse.angle) * x.x() + std::cos(ellipse.angle) * x.y()));
  };
  const auto radius = [&](double i) { return 1.0 - 0.8 * std::pow(1.0 - i / layers, 1.5); };
  for (int i = 0; i <= layers; ++i)
    for (int k = 0; k < count; ++k) mesh.nodes.push_back(point(radius(i), k));
  const auto node = [&](int i, int k) { return count * i + k % count; };
  const int step = ellipse.quadratic ? 2 : 1;
  std::vector<int> middle;
  for (int k = 0; k < count; k += step) middle.push_back(node(0, k));
  for (int k = 1; ellipse.quadratic && k < count; k += step) middle.push_back(node(0, k));
  mesh.cells.push_back({ellipse.quadratic ? 36 : 7, middle});
  std::map<int, int> radial;  // middle nodes of sides between layers, by their inner ends
  for (int i = 0; i < layers; ++i)
    for (int k = 0; k < count; k += step) {
      test::MeshText::Cell cell{9, {node(i, k), node(i + 1, k), node(i + 1, k + step), node(i, k + step)}};
      if (ellipse.quadratic) {
        cell.type = 23;
        const auto between = [&](int at) {
          const auto [found, is_new] = radial.emplace(node(i, at), static_cast<int>(mesh.nodes.size()));
          if (is_new) mesh.nodes.push_back(point(radius(i + 0.5), at));
          return found->second;
        };
        for (const int one : {between(k), node(i + 1, k + 1), between(k + step), node(i, k + 1)})
          cell.nodes.push_back(one);
      }
      mesh.cells.push_back(cell);
    }
  return mesh.file();
}

/// The ellipse on a plate, pressed by the force at its top with which Hertz's contact zone is `half_width` wide.
struct Pressed {
  Ellipse ellipse;
  double half_width = 0.2;
  bool swapped = false, ellipse_first = false;
  std::string plate = "kind: quadtree";
};

void expect_hertz(const Pressed& of, double tolerance) {
  Ellipse ellipse = of.ellipse;
  ellipse.centre = {0.0, ellipse.up};
  const double R = ellipse.across * ellipse.across / ellipse.up, modulus = 1.0 / (2.0 * (1.0 - 0.09)),
               a = of.half_width, force = pi * modulus * a * a / (4.0 * R), largest = 2.0 * force / (pi * a);
  const auto at = [&](double x, double y) {
    const double c = std::cos(ellipse.angle), s = std::sin(ellipse.angle);
    return fmt::format("[{:.17g}, {:.17g}]", ellipse.unit * (c * x - s * y), ellipse.unit * (s * x + c * y));
  };
  const std::string top = fmt::format("{{body: roller, near: {}}}", at(0.0, 2.0 * ellipse.up));
  const std::string roller = fmt::format("  roller: {{material: m, mesh: {{file: {}}}}}\n", file_of(ellipse));
  const std::string plate = fmt::format(
      "  plate: {{material: m, shape: {{polygon: {{vertices: [{}, {}, {}, {}]}}}}, "
      "mesh: {{{}, size: {}, refine: [{{near: [0, 0], size: {}}}]}}}}\n",
      at(-4, -4), at(4, -4), at(4, 0), at(-4, 0), of.plate, ellipse.unit, 0.04 * ellipse.unit);
  const std::string text = fmt::format(
      R"(scabo: 1
analysis: {{plane: strain}}
materials: {{m: {{young: {:.17g}, poisson: 0.3}}}}
bodies:
{}{}supports: [{{on: plate.edge_1, fix: [x, y]}}, {{on: {}, fix: {{along: [{:.17g}, {:.17g}]}}}}]
loads: {{press: {{on: {}, force: [{:.17g}, {:.17g}]}}}}
contacts: {{joint: {{between: [{}], friction: 0.3}}}}
)",
      1.0 / (ellipse.unit * ellipse.unit), of.ellipse_first ? roller : plate, of.ellipse_first ? plate : roller, top,
      std::cos(ellipse.angle), std::sin(ellipse.angle), top, force / ellipse.unit * std::sin(ellipse.angle),
      -force / ellipse.unit * std::cos(ellipse.angle),
      of.swapped ? "roller.edge_1, plate.edge_3" : "plate.edge_3, roller.edge_1");
  SCOPED_TRACE(text);
  const auto solution = run(text);
  const analysis::ContactResult& joint = contact_of(last(solution));
  EXPECT_NEAR(joint.normal_force * ellipse.unit, force, 5e-3 * force);
  double found = 0.0;
  for (const analysis::PairResult& pair : joint.pairs)
    found = std::max(found, pair.pressure * ellipse.unit * ellipse.unit);
  EXPECT_NEAR(found, largest, tolerance * largest);
}

TEST(ImportedCurves, CirclesAndEllipsesOnAPlate) {
  for (const bool quadratic : {true, false})
    for (const double start : {0.0, 0.5, 0.2})
      for (const auto& [across, up] : {std::array{1.0, 1.0}, {1.5, 1.0}, {1.0, 1.4}})
        // Chords touch at their corners, where the pressure is larger.
        expect_hertz({.ellipse = {.across = across, .up = up, .quadratic = quadratic, .start = start}},
                     quadratic ? 0.01 : 0.35);
}

TEST(ImportedCurves, TurnedSwappedListedOtherwiseAndInOtherUnits) {
  for (const double unit : {1.0, 1e3, 1e-3})
    for (const double angle : {0.0, 0.6})
      for (const bool swapped : {false, true})
        expect_hertz(
            {.ellipse = {.across = 1.3, .angle = angle, .unit = unit}, .swapped = swapped, .ellipse_first = !swapped},
            0.05);
}

}  // namespace
}  // namespace scabo::verification
