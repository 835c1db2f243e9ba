// Regions that reach the outline and share borders; crack tips close to each other; a thin ring.
#include <fmt/format.h>

#include <cmath>

#include "run.hpp"

namespace scabo::verification {
namespace {

struct Layers {
  const char* name;
  std::string regions;
  double stiffness;  ///< sum of Young's modulus times height
};

std::string layer(const char* name, const char* material, double low, double height) {
  return fmt::format("{}: {{material: {}, shape: {{rectangle: {{corner: [0, {}], size: [3, {}]}}}}}}", name, material,
                     low, height);
}

/// Layers stretched along their borders, and with nu = 0: the strain is the same in all of them, and the stress
/// constant in each.
TEST(LayeredBlock, StretchedAlongItsLayers) {
  const double strain = 0.01;
  for (const auto& [name, regions, stiffness] :
       {Layers{"two", layer("upper", "b", 0.4, 0.6), 10 * 0.4 + 20 * 0.6},
        Layers{"two, given beyond the outline",
               "upper: {material: b, shape: {polygon: {vertices: [[-1, 0.4], [4, 0.4], [5, 7], [-1, 2]]}}}",
               10 * 0.4 + 20 * 0.6},
        Layers{"three", layer("middle", "b", 0.3, 0.4) + ", " + layer("upper", "c", 0.7, 0.3),
               10 * 0.3 + 20 * 0.4 + 50 * 0.3},
        Layers{"one in another", layer("upper", "b", 0.3, 0.7) + ", " + layer("roof", "c", 0.7, 0.3),
               10 * 0.3 + 20 * 0.4 + 50 * 0.3},
        Layers{"the whole body", layer("all", "c", 0, 1), 50}})
    for (const char* kind : {"polygons", "quadtree", "fem", "superelement"})
      for (const int order : {1, 2}) {
        SCOPED_TRACE(fmt::format("{}, {}, order {}", name, kind, order));
        const auto solution =
            run(fmt::format("scabo: 1\nmaterials: {{a: {{young: 10, poisson: 0}}, b: {{young: 20, poisson: 0}}, c: "
                            "{{young: 50, poisson: "
                            "0}}}}\nbodies: {{block: {{material: a, shape: {{rectangle: {{corner: [0, 0], size: [3, "
                            "1]}}}}, mesh: {{kind: "
                            "{}, size: 0.3, order: {}}}, regions: {{{}}}}}}}\nsupports: [{{on: block.left, fix: [x]}}, "
                            "{{on: block.right, "
                            "displacement: [{}, null]}}, {{on: block.bottom_left, fix: [y]}}]\n",
                            kind, order, regions, 3.0 * strain));
        const analysis::IncrementResult& result = last(solution);
        EXPECT_NEAR(result.energy.elastic, 0.5 * stiffness * 3.0 * strain * strain, 1e-12 * stiffness);
        // The exact displacement u = strain x at every node says that strain and stress are exact everywhere.
        const mesh::BodyMesh& mesh = solution.mesh.bodies[0];
        for (std::size_t i = 0; i < mesh.nodes.size(); ++i) {
          ASSERT_NEAR(result.fields.displacements[0](2 * static_cast<Eigen::Index>(i)), strain * mesh.nodes[i].x(),
                      1e-12);
          ASSERT_NEAR(result.fields.displacements[0](2 * static_cast<Eigen::Index>(i) + 1), 0.0, 1e-12);
        }
      }
}

/// Layers pressed across their borders, free at the sides, with the same lateral strain in all: nu / E is one constant.
TEST(LayeredBlock, PressedAcrossItsLayers) {
  for (const char* kind : {"polygons", "quadtree", "fem", "superelement"}) {
    SCOPED_TRACE(kind);
    const auto solution =
        run(fmt::format("scabo: 1\nmaterials: {{a: {{young: 10, poisson: 0.1}}, b: {{young: 20, poisson: 0.2}}, c: "
                        "{{young: 40, poisson: "
                        "0.4}}}}\nbodies: {{block: {{material: a, shape: {{rectangle: {{corner: [0, 0], size: [3, "
                        "1]}}}}, mesh: {{kind: {}, "
                        "size: 0.3}}, regions: {{{}, {}}}}}}}\nsupports: [{{on: block.bottom, fix: [y]}}, {{on: "
                        "block.bottom_left, fix: "
                        "[x]}}]\nloads: {{press: {{on: block.top, pressure: 0.2}}}}\n",
                        kind, layer("middle", "b", 0.3, 0.4), layer("upper", "c", 0.7, 0.3)));
    const analysis::IncrementResult& result = last(solution);
    const mesh::BodyMesh& mesh = solution.mesh.bodies[0];
    for (std::size_t i = 0; i < mesh.nodes.size(); ++i) {
      const double x = mesh.nodes[i].x(), y = mesh.nodes[i].y();
      const double down = std::min(y, 0.3) / 10 + std::clamp(y - 0.3, 0.0, 0.4) / 20 + std::max(y - 0.7, 0.0) / 40;
      ASSERT_NEAR(result.fields.displacements[0](2 * static_cast<Eigen::Index>(i)), 0.2 * 0.01 * x, 1e-12);
      ASSERT_NEAR(result.fields.displacements[0](2 * static_cast<Eigen::Index>(i) + 1), -0.2 * down, 1e-12);
    }
  }
}

/// A ring of two materials under pressure (Lame), as a quarter whose lining is a region between its straight sides and
/// shares its inner arc with the outline. u and the pressure between the layers are continuous.
TEST(LayeredRing, LiningOfAHole) {
  const double a = 1.0, c = 1.2, b = 3.0, Ea = 100, Eb = 10, nu = 0.3, p = 1.0;
  // u = A r + B / r, sigma = E / (1 - nu) A - E / (1 + nu) B / r^2
  const auto radial = [&](double E, double r) { return std::array{E / (1 - nu), -E / (1 + nu) / (r * r)}; };
  Eigen::Matrix4d M = Eigen::Matrix4d::Zero();
  Eigen::Vector4d f(-p, 0, 0, 0);
  M.row(0) << radial(Ea, a)[0], radial(Ea, a)[1], 0, 0;
  M.row(1) << 0, 0, radial(Eb, b)[0], radial(Eb, b)[1];
  M.row(2) << c, 1 / c, -c, -1 / c;
  M.row(3) << radial(Ea, c)[0], radial(Ea, c)[1], -radial(Eb, c)[0], -radial(Eb, c)[1];
  const Eigen::Vector4d x = M.partialPivLu().solve(f);
  const double inner = x[0] * a + x[1] / a;
  const auto quarter = [](double from, double to) {
    return fmt::format(
        "{{outline: [{{arc: {{from: [{1}, 0], to: [0, {1}], centre: [0, 0]}}, name: out}}, {{line: {{to: [0, {0}]}}, "
        "name: "
        "left}}, {{arc: {{to: [{0}, 0], centre: [0, 0], direction: clockwise}}, name: bore}}, {{line: {{to: [{1}, "
        "0]}}, "
        "name: bottom}}]}}",
        from, to);
  };
  for (const char* kind : {"polygons", "quadtree", "fem"}) {
    SCOPED_TRACE(kind);
    const auto solution = run(fmt::format(
        "scabo: 1\nmaterials: {{stone: {{young: {}, poisson: 0.3}}, steel: {{young: {}, poisson: 0.3}}}}\nbodies: "
        "{{ring: "
        "{{material: stone, shape: {}, mesh: {{kind: {}, size: 0.1}}, regions: {{lining: {{material: steel, shape: "
        "{}}}}}}}}}\nsupports: [{{on: ring.left, fix: [x]}}, {{on: ring.bottom, fix: [y]}}]\nloads: {{p: {{on: "
        "ring.bore, "
        "pressure: {}}}}}\n",
        Eb, Ea, quarter(a, b), kind, quarter(a, c), p));
    const analysis::IncrementResult& result = last(solution);
    const double work = 0.5 * p * inner * 0.5 * std::acos(-1.0) * a;
    EXPECT_NEAR(result.energy.elastic, work, 1e-4 * work);
  }
}

/// Two collinear cracks with inner tips at -a and a and outer ones at -b and b, under tension (Tada, Paris, Irwin).
TEST(CloseTips, HaveTheirStressIntensityFactors) {
  const double a = 0.002, b = 0.5, pi = std::acos(-1.0);
  const double k = std::sqrt(1.0 - a * a / (b * b)), ratio = std::comp_ellint_2(k) / std::comp_ellint_1(k);
  const double inner = std::sqrt(pi * a) * (b * b / (a * a) * ratio - 1.0) / std::sqrt(b * b / (a * a) - 1.0);
  const double outer = std::sqrt(pi * b) * (1.0 - ratio) / std::sqrt(1.0 - a * a / (b * b));
  for (const char* kind : {"polygons", "quadtree"}) {
    SCOPED_TRACE(kind);
    const auto solution = run(fmt::format(
        "scabo: 1\nmaterials: {{m: {{young: 1, poisson: 0.3}}}}\nbodies: {{plate: {{material: m, shape: {{rectangle: "
        "{{corner: [-20, -20], size: [40, 40]}}}}, mesh: {{kind: {}, size: 4, order: 3, refine: [{{near: [0, 0], size: "
        "0.1}}]}}, cracks: [{{name: one, path: [[{}, 0], [{}, 0]]}}, {{name: two, path: [[{}, 0], [{}, 0]]}}]}}}}\n"
        "supports: [{{on: plate.bottom, fix: [y]}}, {{on: plate.bottom_left, fix: [x]}}]\n"
        "loads: {{t: {{on: plate.top, traction: [0, 1]}}}}\n",
        kind, -b, -a, a, b));
    const analysis::IncrementResult& result = last(solution);
    ASSERT_EQ(result.cracks.size(), 4u);
    for (const analysis::CrackResult& crack : result.cracks) {
      const bool is_inner = crack.name == "plate.one.end" || crack.name == "plate.two.start";
      const double expected = is_inner ? inner : outer;
      EXPECT_NEAR(crack.factors.K_I, expected, 3e-3 * expected) << crack.name;  // the plate is 40 crack lengths wide
      EXPECT_NEAR(crack.factors.K_II, 0.0, 3e-3 * expected) << crack.name;
    }
  }
}

/// Half of a thin ring under pressure (Lame).
TEST(ThinRing, UnderPressure) {
  const double a = 0.999, b = 1.0, nu = 0.3, E = 200.0, pi = std::acos(-1.0);
  const double inner = a / (E * (b * b - a * a)) * ((1 - nu) * a * a + (1 + nu) * b * b);
  for (const char* kind : {"polygons", "quadtree", "fem"}) {
    SCOPED_TRACE(kind);
    const auto solution = run(fmt::format(
        "scabo: 1\nmaterials: {{m: {{young: 200, poisson: 0.3}}}}\nbodies:\n  ring:\n    material: m\n    shape: "
        "{{outline: "
        "[{{arc: {{from: [1, 0], to: [-1, 0], centre: [0, 0]}}}}, {{line: {{to: [-0.999, 0]}}, name: left}}, {{arc: "
        "{{to: "
        "[0.999, 0], centre: [0, 0], direction: clockwise}}, name: bore}}, {{line: {{to: [1, 0]}}, name: right}}]}}\n"
        "    mesh: {{kind: {}, size: 0.2}}\nsupports: [{{on: ring.left, fix: [y]}}, {{on: ring.right, fix: [y]}}, "
        "{{on: "
        "{{body: ring, near: [-1, 0]}}, fix: [x]}}]\nloads: {{p: {{on: ring.bore, pressure: 1e-3}}}}\n",
        kind));
    const double work = 0.5 * 1e-6 * inner * pi * a;
    EXPECT_NEAR(last(solution).energy.elastic, work, 1e-4 * work);
  }
}

}  // namespace
}  // namespace scabo::verification
