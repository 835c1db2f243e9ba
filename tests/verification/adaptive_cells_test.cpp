// Estimate and refinement of bodies of many cells, against energies that are known or computed without them.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "scabo/analysis/adaptive/adaptive.hpp"
#include "scabo/analysis/quasistatic/run.hpp"
#include "scabo/mesh/plane/division.hpp"
#include "verification/models.hpp"
#include "verification/run.hpp"

namespace scabo::verification {
namespace {

class RefinedCells : public testing::TestWithParam<const char*> {
 protected:
  std::string kind() const { return GetParam(); }
};
INSTANTIATE_TEST_SUITE_P(Kinds, RefinedCells, testing::Values("polygons", "quadtree"),
                         [](const auto& kind) { return std::string(kind.param); });

double estimate_of(const analysis::StaticSolution& solution) { return last(solution).error.value().relative; }

/// Of a body under dead loads with supports at rest: |u - u_h|^2 = 2 (U - U_h), over 2 U.
double error_against(double exact, const analysis::StaticSolution& solution) {
  return std::sqrt(std::max(0.0, 1.0 - last(solution).energy.elastic / exact));
}

// Lame: a ring from radius 1 to 2 under inner pressure 1, plane stress, E = 1. The estimate knows only the domain of
// the mesh, whose sides are polynomials in place of arcs: up to order 2 the energy of the ring itself differs from that
// of this domain by as much as the squared error. The exact energy of the domain is that of elements three orders
// higher.
TEST_P(RefinedCells, EstimateOfARingIsNearItsError) {
  const double lame = 0.5 * ((1.0 + 4.0) / (4.0 - 1.0) + 0.3) * std::numbers::pi / 2.0;
  for (int order = 1; order <= 3; ++order)
    for (const double size : {0.2, 0.1}) {
      const auto solution = run(fmt::format(R"(scabo: 1
analysis: {{type: static, plane: stress, thickness: 1}}
materials: {{steel: {{young: 1, poisson: 0.3}}}}
bodies:
  ring:
    material: steel
    shape:
      outline:
        - {{line: {{from: [1, 0], to: [2, 0]}}, name: low}}
        - {{arc: {{to: [0, 2], centre: [0, 0]}}, name: outer}}
        - {{line: {{to: [0, 1]}}, name: side}}
        - {{arc: {{to: [1, 0], centre: [0, 0], direction: clockwise}}, name: inner}}
    mesh: {{kind: {}, size: {}, order: {}}}
supports: [{{on: ring.low, fix: [y]}}, {{on: ring.side, fix: [x]}}]
loads: {{pressure: {{on: ring.inner, pressure: 1}}}}
output: {{error: true}}
)",
                                            kind(), size, order));
      mesh::Mesh higher = solution.mesh;
      for (int k = 0; k < 3; ++k) higher = mesh::enriched(solution.model, higher, {});
      const double exact = last(analysis::solve_on_mesh(solution.model, higher, {})).energy.elastic;
      const double effectivity = estimate_of(solution) / error_against(exact, solution);
      const double of_lame = estimate_of(solution) / std::sqrt(std::abs(last(solution).energy.elastic / lame - 1.0));
      std::cout << kind() << " ring, order " << order << ", size " << size << ": true "
                << error_against(exact, solution) << ", effectivity " << effectivity << "; against Lame's energy "
                << of_lame << "\n";
      EXPECT_GT(effectivity, 0.8) << "order " << order << ", size " << size;
      EXPECT_LT(effectivity, 1.01) << "order " << order << ", size " << size;
      if (order == 3) EXPECT_NEAR(of_lame, 0.8, 0.3);
    }
}

/// A re-entrant corner between two free faces, exponent 0.5445; the rollers of the other edges cause no singularity.
std::string corner(const std::string& mesh, double unit = 1.0) {
  const auto length = [&](double value) { return value * unit; };
  return fmt::format(R"(scabo: 1
analysis: {{type: static, plane: strain}}
materials: {{steel: {{young: 1e3, poisson: 0.3}}}}
bodies:
  ell:
    material: steel
    shape:
      polygon:
        vertices: [[-{0}, -{0}], [0, -{0}], [0, 0], [{0}, 0], [{0}, {0}], [-{0}, {0}]]
        names: {{bottom: edge_1, right: edge_4, left: edge_6}}
    mesh: {1}
supports: [{{on: ell.bottom, fix: y}}, {{on: ell.left, fix: x}}]
loads: {{pull: {{on: ell.right, traction: [1, 0]}}}}
)",
                     length(1.0), mesh);
}

/// By one super-element with its scaling centre at the corner, which holds the singular field exactly.
double exact_energy_of_corner() {
  static const double energy = [] {
    const auto with = [](int order) {
      return last(run(corner(fmt::format("{{size: 0.25, order: {}, centre: [0, 0]}}", order)))).energy.elastic;
    };
    const double first = with(8), second = with(12);
    EXPECT_NEAR(first / second, 1.0, 1e-10);
    return second;
  }();
  return energy;
}

TEST_P(RefinedCells, MeetTheToleranceAtAReEntrantCorner) {
  const std::pair<int, double> cases[] = {{1, 1e-2}, {2, 1e-2}, {2, 1e-3}, {3, 1e-3}};
  for (const auto& [order, tolerance] : cases) {
    const auto solution =
        run(corner(fmt::format("{{kind: {}, size: 0.5, order: {}, tolerance: {}}}", kind(), order, tolerance)));
    const double truth = error_against(exact_energy_of_corner(), solution);
    std::cout << kind() << " corner, order " << order << ", tolerance " << tolerance << ": " << solution.passes.size()
              << " passes, " << 2 * solution.mesh.nodes() << " dofs, estimated " << estimate_of(solution) << ", true "
              << truth << "\n";
    EXPECT_LE(truth, tolerance);
    EXPECT_GT(estimate_of(solution) / truth, 0.5);
  }
}

// Error against degrees of freedom N: N^(-p / 2) refined, N^(-0.5445 / 2) with equal cells.
TEST_P(RefinedCells, ConvergeWithTheirOrderAtAReEntrantCorner) {
  const double exact = exact_energy_of_corner();
  const auto slope = [&](const auto& coarse, const auto& fine) {
    return 2.0 * std::log(error_against(exact, coarse) / error_against(exact, fine)) /
           std::log(double(fine.mesh.nodes()) / coarse.mesh.nodes());
  };
  for (const int order : {1, 2}) {
    const auto with = [&](const char* key, double value) {
      return run(corner(fmt::format("{{kind: {}, size: {}, order: {}{}}}", kind(), key[0] == 's' ? value : 0.5, order,
                                    key[0] == 's' ? "" : fmt::format(", tolerance: {}", value))));
    };
    const double refined = order == 1 ? slope(with("tolerance", 2e-2), with("tolerance", 7e-3))
                                      : slope(with("tolerance", 2e-3), with("tolerance", 5e-4));
    const double equal = slope(with("size", 0.1), with("size", 0.05));
    std::cout << kind() << " corner, order " << order << ": slopes " << refined << " refined, " << equal
              << " with equal cells\n";
    EXPECT_GT(refined, order - 0.15);
    EXPECT_LT(equal, 0.8);
    EXPECT_GT(equal, 0.45);
  }
}

// The cell at the tip becomes smaller with those around it. Energy by one super-element with its scaling centre there.
TEST_P(RefinedCells, MeetTheToleranceOfACrackedPlate) {
  const auto with = [](const std::string& mesh) {
    return run(fmt::format(R"(scabo: 1
analysis: {{plane: strain}}
materials: {{steel: {{young: 1.0, poisson: 0.3}}}}
bodies:
  plate:
    material: steel
    shape: {{rectangle: {{corner: [0, 0], size: [1, 2]}}}}
    mesh: {}
    cracks: [{{tip: [0.5, 1], mouth: [0, 1], name: flaw}}]
supports: [{{on: plate.bottom_right, fix: [x, y]}}, {{on: plate.top_right, fix: x}}]
loads: {{pull: {{on: plate.top, traction: [0, 1e-3]}}, hold: {{on: plate.bottom, traction: [0, -1e-3]}}}}
)",
                           mesh));
  };
  const double exact = last(with("{size: 0.5, order: 12}")).energy.elastic;
  for (const int order : {2, 3}) {
    const auto solution = with(fmt::format("{{kind: {}, size: 0.25, order: {}, tolerance: 4e-3}}", kind(), order));
    const double truth = error_against(exact, solution);
    std::cout << kind() << " crack, order " << order << ": " << solution.passes.size() << " passes, "
              << 2 * solution.mesh.nodes() << " dofs, estimated " << estimate_of(solution) << ", true " << truth
              << "\n";
    if (order == 2) {  // of order 3 the first mesh is good enough, as the cell at the tip resolves the singularity
      EXPECT_GT(solution.passes.size(), 1u);
    }
    EXPECT_LE(truth, 4e-3);
    EXPECT_GT(estimate_of(solution) / truth, 0.5);
  }
}

TEST(RefinedQuadtree, DoesNotDependOnUnits) {
  const char* const mesh = "{{kind: quadtree, size: {}, order: 2, tolerance: 3e-3}}";
  const auto metres = run(corner(fmt::format(fmt::runtime(mesh), 0.5)));
  const auto millimetres = run(corner(fmt::format(fmt::runtime(mesh), 500.0), 1e3));
  const mesh::BodyMesh &a = metres.mesh.bodies[0], &b = millimetres.mesh.bodies[0];
  EXPECT_GT(metres.passes.size(), 5u);
  ASSERT_EQ(a.nodes.size(), b.nodes.size());
  ASSERT_EQ(a.cells.size(), b.cells.size());
  for (std::size_t i = 0; i < a.nodes.size(); ++i) EXPECT_LT((1e3 * a.nodes[i] - b.nodes[i]).norm(), 1e-9);
  EXPECT_NEAR(estimate_of(metres) / estimate_of(millimetres), 1.0, 1e-5);
}

TEST(RefinedQuadtree, IsSymmetricWhereTheModelIs) {
  const auto solution = run(R"(scabo: 1
analysis: {type: static, plane: strain}
materials: {steel: {young: 1, poisson: 0.3}}
bodies:
  block: {material: steel, shape: {rectangle: {corner: [-1, -1], size: [2, 1]}}, mesh: {kind: quadtree, size: 0.25, tolerance: 1e-2}}
supports: [{on: block.bottom, fix: [x, y]}]
loads: {press: {on: block.top, pressure: 1}}
)");
  const mesh::BodyMesh& mesh = solution.mesh.bodies[0];
  ASSERT_GT(solution.passes.size(), 3u);
  for (const Vec2& x : mesh.nodes) {
    const Vec2 mirrored(-x.x(), x.y());
    EXPECT_TRUE(std::any_of(mesh.nodes.begin(), mesh.nodes.end(), [&](const Vec2& y) {
      return (y - mirrored).norm() < 1e-9;
    })) << x.transpose();
  }
}

/// A rigid cylinder of radius 1 pressed onto a block: Hertz, b^2 = 4 F R (1 - nu^2) / (pi E), p = 2 F / (pi b).
const char* const hertz = R"(scabo: 1
analysis: {type: static, plane: strain}
materials: {steel: {young: 200e9, poisson: 0.3}}
bodies:
  block:
    material: steel
    shape: {rectangle: {corner: [-1, -1], size: [2, 1]}}
    mesh: {kind: quadtree, size: 0.25, order: 2, tolerance: 6e-3}
  cylinder:
    rigid: true
    shape: {outline: [{arc: {from: [-1, 1], to: [1, 1], centre: [0, 1]}, name: tread}, {line: {to: [-1, 1]}}]}
supports: [{on: block.bottom, fix: [x, y]}, {on: cylinder, fix: x}]
loads: {weight: {on: cylinder, force: [0, -2e8]}}
contacts: {joint: {between: [block.top, cylinder.tread], friction: 0}}
)";

TEST_P(RefinedCells, AreSmallAtTheEdgesOfHertzsContact) {
  const auto solution = run(hertz, {"bodies.block.mesh.kind=" + kind()});
  const double force = 2e8, b = std::sqrt(4.0 * force * (1.0 - 0.09) / (std::numbers::pi * 200e9));
  EXPECT_NEAR(b, 0.03404, 1e-5);
  EXPECT_LE(estimate_of(solution), 6e-3);
  const auto smallest_near = [&](double from, double to) {  // sides on the surface with their middle within
    double least = 1e9;
    const mesh::BodyMesh& mesh = solution.mesh.bodies[0];
    for (const mesh::LineElement& side : mesh.edges[2]) {
      const double x = mesh.nodes[static_cast<std::size_t>(side.nodes.front())].x(),
                   y = mesh.nodes[static_cast<std::size_t>(side.nodes.back())].x();
      if (std::abs(0.5 * (x + y)) >= from && std::abs(0.5 * (x + y)) < to) least = std::min(least, std::abs(x - y));
    }
    return least;
  };
  EXPECT_LT(smallest_near(0.9 * b, 1.1 * b), 0.1 * b);
  EXPECT_LE(smallest_near(0.9 * b, 1.1 * b), 0.51 * smallest_near(0.0, 0.5 * b));
  EXPECT_GT(smallest_near(0.5, 1.0), b);
  const auto& contact = last(solution).contacts.at(0);
  double pressure = 0.0;
  for (const auto& pair : contact.pairs) pressure = std::max(pressure, pair.pressure);
  EXPECT_NEAR(pressure / (2.0 * force / (std::numbers::pi * b)), 1.0, 0.01);
  std::cout << kind() << " Hertz: " << 2 * solution.mesh.nodes() << " dofs, largest pressure "
            << pressure / (2.0 * force / (std::numbers::pi * b)) << " of Hertz's, smallest side "
            << smallest_near(0.9 * b, 1.1 * b) / b << " b\n";
}

TEST(RefinedCellsInContact, MatchOtherKindsOfMesh) {
  const std::vector<std::vector<std::string>> cases = {
      {},
      {"bodies.upper.mesh={kind: polygons, size: 0.5, tolerance: 5e-3, order: 3}"},
      {"bodies.upper.mesh={tolerance: 5e-3}"},
      {"bodies.lower.mesh={tolerance: 5e-3}"},
      {"bodies.upper.mesh={size: 0.1875}"}};
  const std::string mesh = "kind: quadtree, size: 0.75, order: 2, tolerance: 5e-3";
  for (const auto& settings : cases) {
    const auto solution = run(double_cantilever(mesh, mesh), settings);
    const auto& errors = last(solution).error.value().bodies;
    EXPECT_NEAR(last(solution).contacts[0].normal_force / double_cantilever_force, 1.0, 1e-3);
    EXPECT_LE(errors.at(0).value().relative, 5e-3);
    if (settings.empty()) EXPECT_LE(errors.at(1).value().relative, 5e-3);
    std::cout << (settings.empty() ? "quadtrees" : settings[0]) << ": " << 2 * solution.mesh.nodes() << " dofs, force "
              << last(solution).contacts[0].normal_force << "\n";
  }
}

TEST(RefinedQuadtree, SaysWhyAToleranceIsNotReached) {
  const model::Model model =
      input::parse_model(corner("{kind: quadtree, size: 0.5, order: 1, tolerance: 1e-3}"), "test.yaml", {});
  analysis::RefinementLimits limits;
  limits.dofs_of_cells = 1000;
  const auto solution = analysis::solve_refined(model, {}, limits);
  EXPECT_EQ(solution.outcome, analysis::Outcome::not_converged);
  EXPECT_NE(solution.reason.find("mesh.tolerance was not reached: the estimated error is"), std::string::npos);
  EXPECT_NE(solution.reason.find("in one body, more than 1000"), std::string::npos) << solution.reason;
  EXPECT_TRUE(solution.increments.at(0).converged);
}

TEST(SizeField, IsTheLeastOfItsSamplesAndGrows) {
  std::vector<mesh::SizeField::Sample> samples;
  for (int i = 0; i < 500; ++i)  // scattered, deterministic
    samples.push_back(
        {{std::fmod(0.618 * i, 1.0), std::fmod(0.377 * i * i, 1.0)}, 0.01 + 0.1 * std::fmod(0.271 * i, 1.0)});
  const mesh::SizeField field(samples, 0.3);
  EXPECT_LT(field.samples().size(), samples.size());
  for (int i = 0; i < 200; ++i) {
    const Vec2 x(std::fmod(0.771 * i, 1.4) - 0.2, std::fmod(0.139 * i, 1.4) - 0.2);
    double least = 1e9;
    for (const auto& sample : samples) least = std::min(least, sample.size + 0.3 * (x - sample.at).norm());
    EXPECT_DOUBLE_EQ(field.at(x), least);
  }
  EXPECT_EQ(mesh::SizeField().at({1, 2}), std::numeric_limits<double>::infinity());
}

}  // namespace
}  // namespace scabo::verification
