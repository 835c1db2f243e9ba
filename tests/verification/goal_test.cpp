// Error bars of single numbers (analysis/adaptive/goal.hpp): the exact number lies inside the bar, and the bar is at
// most five times the error. Truths are closed forms, published numbers, or numbers of other methods; each says which.
#include "scabo/analysis/adaptive/goal.hpp"

#include <fmt/format.h>

#include <cmath>
#include <map>
#include <numbers>
#include <utility>

#include "scabo/analysis/state/quantities.hpp"
#include "support/mesh_text.hpp"
#include "verification/models.hpp"
#include "verification/run.hpp"

namespace scabo::verification {
namespace {

using std::numbers::pi;

/// A number of a model, with its exact value.
struct GoalCase {
  std::string name, model, of;
  double exact = 0.0;
  double relative = 0.0;  ///< tolerance; 0: bar without refinement
};
void PrintTo(const GoalCase& of, std::ostream* stream) { *stream << of.name; }

class ErrorBar : public testing::TestWithParam<GoalCase> {};

TEST_P(ErrorBar, HoldsTheExactNumberAndIsAtMostFiveErrors) {
  const GoalCase& of = GetParam();
  const bool refine = of.relative > 0.0;
  const auto solution =
      run(of.model + (refine ? fmt::format("tolerance: {{of: {}, relative: {}}}\n", of.of, of.relative)
                             : fmt::format("output: {{error_of: [{}]}}\n", of.of)));
  const auto& quantities = last(solution).quantities;
  ASSERT_EQ(quantities.size(), 1u);
  const analysis::QuantityResult& found = quantities.front();
  const double error = std::abs(found.value - of.exact);
  RecordProperty("bar_over_error", fmt::format("{:.2f}", found.bar / error));
  EXPECT_EQ(found.of, of.of);
  EXPECT_GE(found.bar, error) << found.value;
  EXPECT_LE(found.bar, 5.0 * error) << found.value;
  EXPECT_LE(std::abs(found.finer - of.exact), error);
  if (refine) {
    EXPECT_LE(found.bar, of.relative * std::abs(found.value));
    EXPECT_TRUE(found.reached());
  }
}

/// `superelement` or a kind of cells.
std::string mesh_of(const std::string& kind, double size, int order) {
  return fmt::format("{{{}size: {}, order: {}}}", kind == "superelement" ? "" : fmt::format("kind: {}, ", kind), size,
                     order);
}

std::string beams(const std::string& kind, double size, int order) {
  const std::string mesh = mesh_of(kind, size, order);
  return double_cantilever(mesh.substr(1, mesh.size() - 2), mesh.substr(1, mesh.size() - 2));
}

/// Plate with a crack from its edge, half height h, crack a, width 1.
std::string edge_crack(const std::string& kind, double h, double a, double size, int order) {
  const std::string crack = kind == "superelement" ? fmt::format("tip: [{}, 0], mouth: [0, 0]", a)
                                                   : fmt::format("path: [[0, 0], [{}, 0]]", a);
  return fmt::format(R"(scabo: 1
materials: {{steel: {{young: 1, poisson: 0.3}}}}
bodies:
  plate:
    material: steel
    shape: {{polygon: {{vertices: [[0, -{0}], [1, -{0}], [1, {0}], [0, {0}]]}}}}
    cracks: [{{name: flaw, {1}}}]
    mesh: {2}
supports: [{{on: plate.vertex_1, fix: [x, y]}}, {{on: plate.vertex_2, fix: [y]}}]
loads: {{up: {{on: plate.edge_3, traction: [0, 1]}}, down: {{on: plate.edge_1, traction: [0, -1]}}}}
)",
                     h, crack, mesh_of(kind, size, order));
}

/// Quarter of a shaft of radius 50 in a hub to 100, interference 0.05 (Lame).
std::string press_fit(const std::string& kind, double size, int order) {
  return fmt::format(R"(scabo: 1
materials: {{steel: {{young: 210e3, poisson: 0.3}}}}
bodies:
  shaft:
    material: steel
    shape: {{outline: [{{line: {{from: [0, 0], to: [50, 0]}}, name: foot}}, {{arc: {{to: [0, 50], centre: [0, 0]}}, name: rim}}, {{line: {{to: [0, 0]}}, name: side}}]}}
    mesh: {0}
  hub:
    material: steel
    shape: {{outline: [{{line: {{from: [50, 0], to: [100, 0]}}, name: foot}}, {{arc: {{to: [0, 100], centre: [0, 0]}}, name: out}}, {{line: {{to: [0, 50]}}, name: side}}, {{arc: {{to: [50, 0], centre: [0, 0], direction: clockwise}}, name: bore}}]}}
    mesh: {0}
supports:
  - {{on: shaft.foot, fix: [y], name: shaft_foot}}
  - {{on: shaft.side, fix: [x]}}
  - {{on: hub.foot, fix: [y], name: hub_foot}}
  - {{on: hub.side, fix: [x]}}
contacts: {{joint: {{between: [shaft.rim, hub.bore], friction: 0, gap: -0.05}}}}
)",
                     mesh_of(kind, size, order));
}

/// Quarter of a ring, radii 1 and 2, under an inner pressure of 1 (Lame).
std::string ring(const std::string& kind, double size, int order) {
  return fmt::format(R"(scabo: 1
materials: {{m: {{young: 1000, poisson: 0.3}}}}
bodies:
  ring:
    material: m
    shape: {{outline: [{{line: {{from: [1, 0], to: [2, 0]}}, name: foot}}, {{arc: {{to: [0, 2], centre: [0, 0]}}, name: out}}, {{line: {{to: [0, 1]}}, name: side}}, {{arc: {{to: [1, 0], centre: [0, 0], direction: clockwise}}, name: bore}}]}}
    mesh: {0}
supports: [{{on: ring.foot, fix: [y], name: foot}}, {{on: ring.side, fix: [x]}}]
loads: {{p: {{on: ring.bore, pressure: 1}}}}
)",
                     mesh_of(kind, size, order));
}

/// The unbounded plate around a hole of radius 1 under an inner pressure of 1.
std::string tunnel(double size, int order) {
  return fmt::format(R"(scabo: 1
materials: {{m: {{young: 1000, poisson: 0.3}}}}
bodies:
  ground:
    material: m
    outside: true
    shape: {{circle: {{centre: [0, 0], radius: 1}}}}
    mesh: {{size: {}, order: {}}}
loads: {{p: {{on: ground.rim, pressure: 1}}}}
)",
                     size, order);
}

/// L-shaped body with free faces at its re-entrant corner.
std::string corner(const std::string& kind, double size, int order) {
  return fmt::format(R"(scabo: 1
materials: {{steel: {{young: 1, poisson: 0.3}}}}
bodies:
  body:
    material: steel
    shape: {{polygon: {{vertices: [[0, 0], [0, -1], [1, -1], [1, 1], [-1, 1], [-1, 0]]}}}}
    mesh: {}
supports: [{{on: body.edge_5, fix: x}}, {{on: body.edge_2, fix: y}}]
loads: {{right: {{on: body.edge_3, traction: [1, 0]}}, up: {{on: body.edge_4, traction: [0, 0.5]}}}}
)",
                     mesh_of(kind, size, order));
}

/// corner() from a file of squares of side 1 / parts, or of their halves.
std::string corner_from_file(const std::string& mesh, bool triangles, int parts) {
  test::MeshText text;
  std::map<std::pair<int, int>, int> numbers;
  const auto node = [&](int i, int j) {
    const auto [found, is_new] = numbers.emplace(std::pair(i, j), static_cast<int>(text.nodes.size()));
    if (is_new) text.nodes.push_back(Vec2(i, j) / parts);
    return found->second;
  };
  const auto side = [&](int region, int from, int to) { text.cells.push_back({3, {from, to}, region}); };
  for (int i = -parts; i < parts; ++i)
    for (int j = -parts; j < parts; ++j) {
      if (i < 0 && j < 0) continue;
      const int a = node(i, j), b = node(i + 1, j), c = node(i + 1, j + 1), d = node(i, j + 1);
      if (triangles) {
        text.cells.push_back({5, {a, b, c}});
        text.cells.push_back({5, {a, c, d}});
      } else {
        text.cells.push_back({9, {a, b, c, d}});
      }
      if (j == -parts) side(2, a, b);
      if (i + 1 == parts) side(3, b, c);
      if (j + 1 == parts) side(4, c, d);
      if (i == -parts) side(5, d, a);
    }
  return fmt::format(R"(scabo: 1
materials: {{steel: {{young: 1, poisson: 0.3}}}}
bodies: {{body: {{material: steel, mesh: {{file: {}, {}}}}}}}
supports: [{{on: body.boundary_5, fix: x}}, {{on: body.boundary_2, fix: y}}]
loads: {{right: {{on: body.boundary_3, traction: [1, 0]}}, up: {{on: body.boundary_4, traction: [0, 0.5]}}}}
)",
                     text.file(), mesh);
}

/// Half of a cylinder of radius 1, moved by 0.01 into a block.
std::string hertz(const std::string& kind, double size, int order) {
  const std::string mesh = kind == "superelement"
                               ? mesh_of(kind, size, order)
                               : fmt::format("{{kind: {}, size: {}, order: {}, refine: [{{near: [0, 0], size: {}}}]}}",
                                             kind, size, order, 0.125 * size);
  return fmt::format(R"(scabo: 1
analysis: {{plane: strain}}
materials: {{steel: {{young: 210, poisson: 0.3}}, aluminium: {{young: 70, poisson: 0.3}}}}
bodies:
  block: {{material: aluminium, shape: {{rectangle: {{corner: [0, -2], size: [2, 2]}}}}, mesh: {0}}}
  roller:
    material: steel
    shape: {{outline: [{{line: {{from: [1, 1], to: [0, 1]}}, name: top}}, {{line: {{to: [0, 0]}}, name: axis}}, {{arc: {{to: [1, 1], centre: [0, 1]}}, name: rim}}]}}
    mesh: {0}
supports:
  - {{on: block.bottom, fix: [y]}}
  - {{on: block.left, fix: [x]}}
  - {{on: roller.axis, fix: [x]}}
  - {{on: roller.top, displacement: [null, -0.01], name: press}}
contacts: {{joint: {{between: [block.top, roller.rim], friction: 0}}}}
)",
                     mesh);
}

std::vector<GoalCase> goal_cases() {
  // Double cantilever: three codes and meshes (docs/verification.md).
  const double beam = double_cantilever_force;
  // Half a cylinder: quadtrees of orders 2, 3, 4 with cells of 0.002 and 0.001 along the contact, and polygons of order
  // 3, agree to 2e-6; their largest pressure is within 0.2 % of Hertz's sqrt(P E* / (pi R)) = 2.0266.
  const double cylinder = 0.1118264;
  const double corner_energy = 4.98789291788;  // one super-element with its scaling centre there, order 16
  const double fit = 78.75 * 50.0 * 0.5 * pi;  // Lame: pressure times length
  const double widening = (5.0 / 3.0 + 0.3) / 1000.0;
  std::vector<GoalCase> cases;
  // Single-edge cracks: K_I / (sigma sqrt(pi a)) of two programs (fracture_test.cpp).
  const double cracks[][3] = {
      {1, 0.5, 2.82546}, {0.5, 0.5, 3.00876}, {1, 0.4, 2.11276}, {1, 0.2, 1.36804}, {1, 0.6, 4.0333}};
  for (const auto& [h, a, factor] : cracks)
    cases.push_back({fmt::format("Crack_{:.0f}_{:.0f}", 10 * h, 10 * a), edge_crack("superelement", h, a, 0.25, 2),
                     "plate.flaw.K_I", factor * std::sqrt(pi * a), 1e-3});
  for (const char* kind : {"quadtree", "polygons"})
    cases.push_back({fmt::format("Crack_{}", kind), edge_crack(kind, 1, 0.4, 0.25, 2), "plate.flaw.end.K_I",
                     2.11276 * std::sqrt(0.4 * pi), 1e-3});
  for (const char* kind : {"superelement", "quadtree", "polygons"}) {
    cases.push_back({fmt::format("Beam_{}", kind), beams(kind, 0.375, 2), "joint.normal_force", beam});
    cases.push_back({fmt::format("Beam_{}_refined", kind), beams(kind, 0.375, 2), "joint.normal_force", beam, 1e-3});
  }
  cases.push_back({"Beam_1e4", beams("superelement", 0.375, 2), "joint.normal_force", beam, 1e-4});
  cases.push_back({"Beam_friction", beams("superelement", 0.375, 2), "joint.tangential_force", 0.2 * beam, 1e-3});
  cases.push_back({"Beam_reaction", beams("superelement", 0.375, 2), "lower.left.reaction_y", beam, 1e-3});
  // Beam ends: super-elements, quadtrees and polygons of orders 4 and 6 agree to 4e-7.
  for (const char* kind : {"superelement", "quadtree", "fem"})
    cases.push_back(
        {fmt::format("Beam_deflection_{}", kind), beams(kind, 0.375, 2), "lower.top_right.uy", -1.2788944e-3, 1e-3});
  cases.push_back({"Hertz_superelement", hertz("superelement", 0.1, 2), "joint.normal_force", cylinder, 1e-2});
  cases.push_back({"Hertz_quadtree", hertz("quadtree", 0.1, 2), "joint.normal_force", cylinder, 1e-3});
  cases.push_back({"Hertz_polygons", hertz("polygons", 0.1, 2), "joint.normal_force", cylinder, 1e-2});
  cases.push_back({"PressFit_quadtree", press_fit("quadtree", 25, 2), "joint.normal_force", fit});
  cases.push_back({"PressFit_polygons", press_fit("polygons", 25, 2), "joint.normal_force", fit});
  cases.push_back({"PressFit_linear", press_fit("polygons", 25, 1), "hub_foot.reaction_y", -78.75 * 50.0});
  cases.push_back({"Ring_quadtree", ring("quadtree", 0.25, 2), "ring.vertex_1.ux", widening});
  cases.push_back({"Ring_polygons", ring("polygons", 0.25, 2), "ring.vertex_1.ux", widening});
  cases.push_back({"Ring_linear", ring("quadtree", 0.25, 1), "ring.vertex_1.ux", widening});
  // At the outer arc, 2 p a^2 b / (E (b^2 - a^2)): cells of order 1 that arcs cut are divided for the bar.
  cases.push_back({"Ring_linear_refined", ring("quadtree", 0.4, 1), "ring.vertex_2.ux", 4e-3 / 3.0, 1e-3});
  cases.push_back(
      {"Crack_fem", edge_crack("fem", 1, 0.4, 0.125, 2), "plate.flaw.end.K_I", 2.11276 * std::sqrt(0.4 * pi), 1e-3});
  cases.push_back(
      {"Crack_fem_linear", edge_crack("fem", 1, 0.4, 0.125, 1), "plate.flaw.end.K_I", 2.11276 * std::sqrt(0.4 * pi)});
  cases.push_back({"Beam_fem", beams("fem", 0.375, 2), "joint.normal_force", beam});
  cases.push_back({"Beam_fem_refined", beams("fem", 0.375, 2), "joint.normal_force", beam, 1e-3});
  cases.push_back({"Beam_fem_linear", beams("fem", 0.25, 1), "joint.normal_force", beam, 1e-2});
  cases.push_back({"Hertz_fem", hertz("fem", 0.1, 2), "joint.normal_force", cylinder, 1e-2});
  cases.push_back({"PressFit_fem", press_fit("fem", 12.5, 2), "joint.normal_force", fit});
  cases.push_back({"Ring_fem", ring("fem", 0.25, 2), "ring.vertex_1.ux", widening, 1e-4});
  cases.push_back({"Ring_fem_linear", ring("fem", 0.125, 1), "ring.vertex_1.ux", widening});
  cases.push_back({"Corner_fem", corner("fem", 0.25, 2), "elastic_energy", corner_energy, 1e-2});
  cases.push_back({"Corner_fem_linear", corner("fem", 0.25, 1), "elastic_energy", corner_energy});
  for (const auto& [name, triangles] : {std::pair("triangles", true), std::pair("squares", false)}) {
    cases.push_back({fmt::format("Corner_fem_of_a_file_{}", name), corner_from_file("elements: fem", triangles, 4),
                     "elastic_energy", corner_energy});
    cases.push_back({fmt::format("Corner_fem_of_a_file_{}_refined", name),
                     corner_from_file("elements: fem", triangles, 4), "elastic_energy", corner_energy, 1e-2});
  }
  cases.push_back({"Corner_of_a_file", corner_from_file("order: 2", false, 2), "elastic_energy", corner_energy});
  cases.push_back(
      {"Corner_of_a_file_refined", corner_from_file("order: 2", false, 2), "elastic_energy", corner_energy, 1e-2});
  // A hole in the infinite plate under an inner pressure: p a (1 + nu) / E (Lame).
  cases.push_back({"Tunnel", tunnel(0.5, 2), "ground.rim_start.ux", 1.3e-3});
  cases.push_back({"Tunnel_refined", tunnel(0.5, 1), "ground.rim_start.ux", 1.3e-3, 1e-4});
  cases.push_back({"Corner", corner("superelement", 0.25, 2), "elastic_energy", corner_energy});
  cases.push_back({"Corner_superelement", corner("superelement", 0.25, 2), "elastic_energy", corner_energy, 1e-3});
  cases.push_back({"Ring_of_parts", ring("superelement", 0.5, 2), "ring.vertex_1.ux", widening});
  cases.push_back({"Ring_of_parts_refined", ring("superelement", 0.5, 2), "ring.vertex_1.ux", widening, 1e-4});
  cases.push_back({"Corner_quadtree", corner("quadtree", 0.25, 2), "elastic_energy", corner_energy, 1e-2});
  cases.push_back({"Corner_polygons", corner("polygons", 0.25, 2), "elastic_energy", corner_energy, 1e-2});
  return cases;
}

INSTANTIATE_TEST_SUITE_P(Cases, ErrorBar, testing::ValuesIn(goal_cases()),
                         [](const auto& of) { return of.param.name; });

// dJ = z . df: the load of a model whose pairs stick, slip and are open is raised by 1e-6, which changes no state.
// Every number changes as its dual displacement says.
TEST(DualProblem, GivesTheChangeOfEveryNumber) {
  const std::string text = R"(scabo: 1
materials: {m: {young: 30, poisson: 0.2}}
bodies:
  lower:
    material: m
    shape: {rectangle: {corner: [0, 0], size: [3, 1]}}
    cracks: [{name: flaw, path: [[0, 0.5], [0.4, 0.5]]}]
    mesh: {kind: quadtree, size: 0.25}
  upper: {material: m, shape: {rectangle: {corner: [0.9, 1], size: [1.2, 1]}}, mesh: {size: 0.15}}
  cap: {rigid: true, shape: {rectangle: {corner: [1.6, 2], size: [0.6, 0.2]}}}
supports: [{on: lower.bottom, fix: [x, y], name: floor}, {on: cap.bottom_left, fix: [x], name: guide}]
loads:
  weight: {on: cap, force: [0, -1e-3]}
  push: {on: upper.left, traction: [1e-4, 0]}
contacts:
  joint: {between: [lower.top, upper.bottom], friction: 0.3}
  top: {between: [upper.top, cap.bottom], friction: 0.1}
)";
  const char* numbers[] = {"joint.normal_force", "joint.tangential_force", "top.tangential_force", "joint.max_gap",
                           "floor.reaction_x",   "guide.reaction_x",       "upper.bottom_left.ux", "cap.top_left.uy",
                           "lower.top_right.uy", "lower.flaw.K_I",         "lower.flaw.K_II",      "elastic_energy"};
  std::string list;
  for (const char* number : numbers) list += fmt::format("{}{}", list.empty() ? "" : ", ", number);
  model::Model model = input::parse_model(text + "output: {error_of: [" + list + "]}\n", "test.yaml");
  const std::vector<model::Quantity> quantities = std::exchange(model.output.error_of, {});
  ASSERT_EQ(model.loads.size(), 2u);

  constexpr double step = 1e-6;
  std::vector<double> before, after, rates;
  int open = 0, stick = 0, slip = 0;
  for (const bool raised : {false, true}) {
    model.steps.front().load_factors = {1.0, raised ? 1.0 + step : 1.0};
    analysis::Options options;
    options.on_state = [&](const analysis::Prepared& prepared, const analysis::State& state,
                           const analysis::StaticSolution& solution) {
      for (const model::Quantity& quantity : quantities) {
        const auto value = analysis::value_of(solution, solution.increments.back(), quantity);
        ASSERT_TRUE(value.has_value()) << quantity.name;
        (raised ? after : before).push_back(*value);
        if (raised) continue;
        const auto z =
            analysis::dual_displacements(prepared, state, analysis::derivative_of(prepared, state, quantity));
        double rate = 0.0;
        for (std::size_t b = 0; b < z.size(); ++b)
          if (const Vector& force = prepared.structure.loads[1][b]; force.size() > 0) rate += z[b].dot(force);
        rates.push_back(rate);
      }
      for (const auto& contact : solution.increments.back().contacts)
        open += contact.open, stick += contact.stick, slip += contact.slip;
    };
    ASSERT_EQ(analysis::solve_static(model, options).outcome, analysis::Outcome::solved);
  }
  EXPECT_GT(open, 0);
  EXPECT_GT(stick, 0);
  EXPECT_GT(slip, 0);
  for (std::size_t k = 0; k < quantities.size(); ++k) {
    const double change = (after[k] - before[k]) / step;
    EXPECT_NEAR(rates[k], change, 1e-5 * std::abs(change) + 1e-7 * std::abs(before[k])) << quantities[k].name;
  }
}

// A block that slides all along its joint carries T = mu_b N backward and T = -mu_f N forward, whatever its shape: so
// much of the load that presses it is in the tangential force, and nothing of what drives it.
TEST(DualProblem, KnowsTheFrictionOfTheDirectionThatSlips) {
  constexpr double forward = 0.2, backward = 0.5, width = 2.0, pressure = 500.0;
  for (const double drive : {0.01, -0.01}) {
    model::Model model = input::parse_model(fmt::format(R"(scabo: 1
materials: {{m: {{young: 1e9, poisson: 0.3}}}}
bodies:
  lower: {{material: m, shape: {{rectangle: {{corner: [-1, -1], size: [4, 1]}}}}, mesh: {{size: 0.5}}}}
  upper: {{material: m, shape: {{rectangle: {{corner: [0, 0], size: [{}, 0.5]}}}}, mesh: {{size: 0.4}}}}
supports: [{{on: lower.bottom, fix: [x, y]}}, {{on: upper.top, displacement: [{}, null], name: drive}}]
loads: {{press: {{on: upper.top, pressure: {}}}}}
contacts: {{joint: {{between: [lower.top, upper.bottom], friction: {{forward: {}, backward: {}}}}}}}
output: {{error_of: [joint.tangential_force, joint.normal_force, drive.reaction_x]}}
)",
                                                        width, drive, pressure, forward, backward),
                                            "test.yaml");
    const std::vector<model::Quantity> quantities = std::exchange(model.output.error_of, {});
    const double normal = pressure * width, tangential = drive > 0.0 ? -forward * normal : backward * normal;
    const double exact[] = {tangential, normal, -tangential};
    int rates = 0;
    analysis::Options options;
    options.on_state = [&](const analysis::Prepared& prepared, const analysis::State& state,
                           const analysis::StaticSolution& solution) {
      EXPECT_EQ(contact_of(solution.increments.back()).stick, 0);
      for (std::size_t k = 0; k < std::size(exact); ++k) {
        const model::Quantity& quantity = quantities.at(k);
        const auto z =
            analysis::dual_displacements(prepared, state, analysis::derivative_of(prepared, state, quantity));
        double rate = 0.0;
        for (std::size_t b = 0; b < z.size(); ++b)
          if (const Vector& force = prepared.structure.loads[0][b]; force.size() > 0) rate += z[b].dot(force);
        EXPECT_NEAR(rate, exact[k], 1e-8 * normal) << quantity.name << ", driven by " << drive;
        ++rates;
      }
    };
    ASSERT_EQ(analysis::solve_static(model, options).outcome, analysis::Outcome::solved);
    EXPECT_EQ(rates, 3);
  }
}

// A number that cannot be reached within the limits keeps its bar.
TEST(ErrorBars, ToleranceThatCannotBeReachedIsReported) {
  const model::Model model = input::parse_model(
      corner("superelement", 0.5, 1) + "tolerance: {of: elastic_energy, relative: 1e-12}\n", "test.yaml");
  analysis::RefinementLimits limits;
  limits.passes = 3;
  const auto solution = analysis::solve_with_bars(model, analysis::check(model), {}, limits);
  EXPECT_EQ(solution.outcome, analysis::Outcome::not_converged);
  EXPECT_NE(solution.reason.find("the tolerance of elastic_energy was not reached"), std::string::npos)
      << solution.reason;
  ASSERT_FALSE(solution.increments.empty());
  ASSERT_EQ(solution.increments.back().quantities.size(), 1u);
  EXPECT_FALSE(solution.increments.back().quantities.front().reached());
}

// A ring by cells of order 1, which become curved in the meshes of the error bar. Between the hollow arc and a line of
// the tree that is its tangent there were cells that no point sees; no bar was computed, and the ring was refined up to
// the limit, 63,062 degrees of freedom. Lame: u(b) = 2 p a^2 b / (E (b^2 - a^2)).
TEST(ErrorBars, OfARingOfChords) {
  for (const char* kind : {"quadtree", "polygons"})
    for (const double unit : {1.0, 1e3, 1e-3})
      for (const double angle : {0.0, 0.3}) {
        if (unit != 1.0 && angle != 0.0) continue;
        const auto at = [&](double x, double y) {
          const double c = std::cos(angle), s = std::sin(angle);
          return fmt::format("[{:.17g}, {:.17g}]", unit * (c * x - s * y), unit * (s * x + c * y));
        };
        const auto solution = run(fmt::format(
            R"(scabo: 1
materials: {{m: {{young: 1e9, poisson: 0.3}}}}
bodies:
  ring:
    material: m
    shape: {{outline: [{{line: {{from: {}, to: {}}}}}, {{arc: {{to: {}, centre: [0, 0]}}}}, {{line: {{to: {}}}}}, {{arc: {{to: {}, centre: [0, 0], direction: clockwise}}}}]}}
    mesh: {{kind: {}, size: {}, order: 1}}
supports: [{{on: ring.edge_1, fix: normal}}, {{on: ring.edge_3, fix: normal}}]
loads: {{p: {{on: ring.edge_4, pressure: 1e6}}}}
tolerance: {{of: ring.vertex_2.{}, relative: 1e-3}}
)",
            at(1, 0), at(2, 0), at(0, 2), at(0, 1), at(1, 0), kind, 0.4 * unit, "ux"));
        const analysis::QuantityResult& found = last(solution).quantities.at(0);
        const double exact = 4e6 / 3e9 * unit * std::cos(angle);
        EXPECT_NEAR(found.value, exact, 1e-3 * exact) << kind << ' ' << unit << ' ' << angle;
        EXPECT_TRUE(found.reached());
        EXPECT_LT(2 * solution.mesh.nodes(), 15000) << kind << ' ' << unit << ' ' << angle;
      }
}

// Zero by symmetry: nothing is small relative to it, and what is found of it is rounding. It took a minute and 15
// meshes.
TEST(ErrorBars, ANumberThatIsZeroHasABarOfRounding) {
  const std::string symmetric = R"(scabo: 1
materials: {steel: {young: 200e9, poisson: 0.3}}
bodies: {plate: {material: steel, shape: {rectangle: {corner: [-1, 0], size: [2, 1]}}, mesh: {size: 0.5}}}
supports: [{on: plate.bottom, fix: [x, y], name: floor}]
loads: {press: {on: plate.top, pressure: 1e6}}
output: {points: [{at: [0, 1], name: tip}], error_of: [tip.ux, floor.reaction_x]}
)";
  const auto bars = run(symmetric);
  for (const auto& quantity : last(bars).quantities) EXPECT_LE(std::abs(quantity.value), quantity.bar) << quantity.of;
  const auto solution = run(symmetric + "tolerance: {of: tip.ux, relative: 1e-3}\n");
  EXPECT_EQ(solution.outcome, analysis::Outcome::not_converged);
  EXPECT_NE(solution.reason.find("the value is zero but for rounding errors"), std::string::npos) << solution.reason;
  EXPECT_EQ(solution.passes.size(), 1u);
}

// Side faces of a notch have no elements to divide: a segmentation fault once.
TEST(ErrorBars, OfASuperElementWithANotch) {
  const auto solution = run(R"(scabo: 1
materials: {steel: {young: 10e9, poisson: 0.2}}
bodies:
  plate:
    material: steel
    shape: {polygon: {vertices: [[0, 0], [1, 0], [1, 1], [-1, 1], [-1, -1], [0, -1]]}}
    mesh: {size: 1, centre: [0, 0]}
supports: [{on: plate.edge_5, fix: [x, y]}]
loads: {press: {on: plate.edge_3, pressure: 1e6}}
tolerance: {of: plate.vertex_3.uy, relative: 1e-2}
)");
  const auto& quantity = last(solution).quantities.front();
  EXPECT_NEAR(quantity.value, -0.003168, quantity.bar + 4.8e-5);  // of a finer mesh: -0.003168 +- 4.8e-5
  EXPECT_LE(quantity.bar, 1e-2 * std::abs(quantity.value));
}

// Every increment has its bars, which do not change the results.
TEST(ErrorBars, OfEveryIncrement) {
  const std::string steps = "steps: [{increments: 3}]\n";
  const auto without = run(beams("superelement", 0.75, 2) + steps),
             with = run(beams("superelement", 0.75, 2) + steps +
                        "output: {error_of: [joint.normal_force, upper.left.reaction_y]}\n");
  ASSERT_EQ(with.increments.size(), 3u);
  for (std::size_t i = 0; i < 3; ++i) {
    ASSERT_EQ(increment_at(with, i).quantities.size(), 2u);
    const double force = increment_at(without, i).contacts[0].normal_force;
    EXPECT_EQ(increment_at(with, i).quantities[0].value, force);
    EXPECT_GE(increment_at(with, i).quantities[0].bar,
              std::abs(force - double_cantilever_force * static_cast<double>(i + 1) / 3.0));
  }
}

}  // namespace
}  // namespace scabo::verification
