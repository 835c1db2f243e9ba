// Stored energy and work of bodies whose temperature changes, by hand: E, nu, a expansion, V volume.
#include <fmt/format.h>

#include <cmath>
#include <string>
#include <vector>

#include "verification/run.hpp"

namespace scabo::verification {
namespace {

constexpr double steel = 210e9, steel_expansion = 1e-5;

const std::vector<const char*> meshes = {"size: 0.25",
                                         "size: 0.5, order: 3",
                                         "size: 0.5, kind: fem, order: 1",
                                         "size: 0.5, kind: fem",
                                         "size: 0.3, kind: polygons",
                                         "size: 0.5, kind: polygons, order: 2",
                                         "size: 0.25, kind: quadtree, order: 2"};

/// A bar of 4 x 1 between rollers at the left and below; `rest`: more supports, loads and other sections.
analysis::StaticSolution bar(const char* mesh, const std::string& supports, const std::string& rest,
                             const char* plane = "stress", double unit = 1.0) {
  return run(
      fmt::format(
          "scabo: 1\nanalysis: {{plane: {}, thickness: {}}}\n"
          "materials: {{s: {{young: {}, poisson: 0.3, expansion: {}}}}}\n"
          "bodies: {{b: {{material: s, shape: {{rectangle: {{corner: [0, 0], size: [4, 1]}}}}, mesh: {{{}}}}}}}\n"
          "supports: [{{on: b.left, fix: x}}, {{on: b.bottom_left, fix: y}}{}]\n",
          plane, unit, steel, steel_expansion, mesh, supports) +
      rest);
}

/// External work and stored energy of the last increment are both `energy`.
void expect_energy(const analysis::StaticSolution& solution, double energy, const char* what, double accuracy = 1e-9) {
  const analysis::Energy& found = last(solution).energy;
  const double scale = std::max(std::abs(energy), 1.0);  // J; a free bar of these would have 12000 as 1/2 u'K u
  EXPECT_NEAR(found.elastic, energy, accuracy * scale) << what;
  EXPECT_NEAR(found.external, energy, accuracy * scale) << what;
  EXPECT_NEAR(found.external - found.elastic - found.friction, 0.0, 1e-8 * scale) << what;
}

TEST(ThermalEnergy, IsZeroOfFreeBodies) {
  for (const char* mesh : meshes) {
    expect_energy(bar(mesh, "", "loads: {T: {temperature: 10}}\n"), 0.0, mesh, 1e-7);
    if (std::string(mesh).find("order: 1") != std::string::npos) continue;
    if (std::string(mesh).find("order") == std::string::npos && std::string(mesh).find("polygons") != std::string::npos)
      continue;  // of order 1, to which a quadratic displacement is not exact
    // A field that is linear in x and y strains nothing either, where nothing keeps the bar from bending.
    expect_energy(run(fmt::format("scabo: 1\nmaterials: {{s: {{young: {}, poisson: 0.3, expansion: {}}}}}\n"
                                  "bodies: {{b: {{material: s, shape: {{rectangle: {{corner: [0, 0], size: [4, 1]}}}}, "
                                  "mesh: {{{}}}}}}}\n"
                                  "supports: [{{on: b.bottom_left, fix: [x, y]}}, {{on: b.bottom_right, fix: y}}]\n"
                                  "loads: {{T: {{temperature: {{constant: 5, x: 3, y: -7}}}}}}\n",
                                  steel, steel_expansion, mesh)),
                  0.0, mesh, 1e-6);
  }
}

// In plane strain the stress across the plane, E a T, stays: E (a T)^2 / 2.
TEST(ThermalEnergy, OfFreeBodiesInPlaneStrainIsThatAcross) {
  for (const char* mesh : meshes)
    expect_energy(bar(mesh, "", "loads: {T: {temperature: 10}}\n", "strain"), 0.5 * steel * 1e-8 * 4.0, mesh, 1e-9);
}

TEST(ThermalEnergy, BetweenWalls) {
  const std::string wall = ", {on: b.right, fix: x}";
  for (const char* mesh : meshes) {
    // E (a T)^2 / 2 V: 4200 J.
    expect_energy(bar(mesh, wall, "loads: {T: {temperature: 10}}\n"), 4200.0, mesh);
    // Increments, and two loads that add up to it.
    expect_energy(bar(mesh, wall, "loads: {T: {temperature: 4}, U: {temperature: 6}}\nsteps: [{increments: 3}]\n"),
                  4200.0, mesh);
    if (std::string(mesh).find("order: 2") == std::string::npos && std::string(mesh) != "size: 0.25") continue;
    // T = 10 (1 + y) K: sigma_x = -E a T(y), of mean square 100 * 7 / 3.
    expect_energy(bar(mesh, wall, "loads: {T: {temperature: {constant: 10, y: 10}}}\n"), 4200.0 * 7.0 / 3.0, mesh);
    expect_energy(bar(mesh, wall, "loads: {T: {temperature: 10}, U: {temperature: {y: 10}}}\n"), 4200.0 * 7.0 / 3.0,
                  mesh);
  }
}

// A table that bends in the middle of the bar, 0, 10, 0 K: of mean square 100 / 3, in cells that it bends in as well.
TEST(ThermalEnergy, OfATableBetweenWalls) {
  for (const char* mesh : {"size: 0.25", "size: 1, order: 3", "size: 0.5, kind: quadtree, order: 2"})
    expect_energy(bar(mesh, ", {on: b.right, fix: x}",
                      "loads: {T: {temperature: {over: y, at: [0, 0.5, 1], values: [0, 10, 0]}}}\n"),
                  4200.0 / 3.0, mesh, 1e-8);
}

// Two layers between walls, of which only the lower one expands: E (a T)^2 / 2 of its half. One super-element of two
// materials moves inside even under one temperature.
TEST(ThermalEnergy, OfTwoMaterialsBetweenWalls) {
  for (const char* mesh : {"size: 0.5", "size: 0.5, kind: fem", "size: 0.5, kind: polygons, order: 2"})
    expect_energy(
        run(fmt::format("scabo: 1\nmaterials:\n  s: {{young: {0}, poisson: 0.3, expansion: {1}}}\n"
                        "  cold: {{young: {0}, poisson: 0.3, expansion: 0}}\n"
                        "bodies: {{b: {{material: s, shape: {{rectangle: {{corner: [0, 0], size: [4, 1]}}}}, "
                        "mesh: {{{2}}}, regions: {{top: {{material: cold, shape: {{rectangle: {{corner: [0, "
                        "0.5], size: [4, 0.5]}}}}}}}}}}}}\n"
                        "supports: [{{on: b.left, fix: x}}, {{on: b.right, fix: x}}, {{on: b.bottom_left, fix: "
                        "y}}]\nloads: {{T: {{temperature: 10}}}}\n",
                        steel, steel_expansion, mesh)),
        2100.0, mesh);
}

// Pulled and then heated without a restraint: the stress stays, and so does what is stored, s^2 V / (2 E); the force
// works on the expansion, and heat takes that up.
TEST(ThermalEnergy, OfAPulledBarStaysWhenItIsHeated) {
  for (const char* mesh : meshes)
    expect_energy(bar(mesh, "",
                      "loads: {pull: {on: b.right, traction: [1e8, 0]}, T: {temperature: 10}}\n"
                      "steps: [{loads: {pull: 1, T: 0}}, {loads: {pull: 1, T: 1}, increments: 2}]\n"),
                  0.5 * 1e16 / steel * 4.0, mesh);
}

TEST(ThermalEnergy, GrowsWithTheThickness) {
  expect_energy(bar("size: 0.25", ", {on: b.right, fix: x}", "loads: {T: {temperature: 10}}\n", "stress", 2.0), 8400.0,
                "thickness");
}

}  // namespace
}  // namespace scabo::verification
