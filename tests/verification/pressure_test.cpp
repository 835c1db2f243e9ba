// Pressures of pairs, force over tributary length: closed forms on straight and curved edges, where contacts meet in a
// point, and at a tensile strength.
#include <fmt/format.h>

#include <array>
#include <cmath>
#include <numbers>
#include <string>
#include <vector>

#include "run.hpp"

namespace scabo::verification {
namespace {

/// A disc of radius 1 in a ring of outer radius 2 that is cut into four pieces. `joint` holds the pieces together,
/// `fit` is the contact of each with the disc.
std::string cut_ring(const std::string& joint, const std::string& fit, const std::string& loads, double size,
                     bool swapped = false) {
  const auto at = [](double radius, int k) {
    const int quarter = k % 4;
    return fmt::format("[{}, {}]",
                       quarter == 0   ? radius
                       : quarter == 2 ? -radius
                                      : 0.0,
                       quarter == 1   ? radius
                       : quarter == 3 ? -radius
                                      : 0.0);
  };
  std::string text =
      "scabo: 1\nmaterials: {m: {young: 2534, poisson: 0.3}}\nbodies:\n"
      "  disc:\n    material: m\n    shape:\n      outline:\n";
  for (int k = 0; k < 4; ++k)
    text += fmt::format("        - {{arc: {{{}to: {}, centre: [0, 0]}}, name: rim_{}}}\n",
                        k == 0 ? "from: " + at(1, 0) + ", " : "", at(1, k + 1), k);
  text += fmt::format("    mesh: {{size: {}}}\n", size);
  std::string contacts = "contacts:\n";
  for (int k = 0; k < 4; ++k) {
    const double x = k == 0 || k == 3 ? 1.3 : -1.3, y = k < 2 ? 1.3 : -1.3;
    text += fmt::format(
        "  ring_{0}:\n    material: m\n    shape:\n      outline:\n"
        "        - {{line: {{from: {1}, to: {2}}}, name: first}}\n"
        "        - {{arc: {{to: {3}, centre: [0, 0]}}, name: rim}}\n"
        "        - {{line: {{to: {4}}}, name: last}}\n"
        "        - {{arc: {{to: {1}, centre: [0, 0], direction: clockwise}}, name: bore}}\n"
        "    mesh: {{size: {5}, centre: [{6}, {7}]}}\n",
        k, at(1, k), at(2, k), at(2, k + 1), at(1, k + 1), size, x, y);
    contacts += fmt::format("  fit_{0}: {{between: [{1}, {2}], {3}}}\n", k,
                            swapped ? fmt::format("ring_{}.bore", k) : fmt::format("disc.rim_{}", k),
                            swapped ? fmt::format("disc.rim_{}", k) : fmt::format("ring_{}.bore", k), fit);
    contacts += fmt::format("  joint_{0}: {{between: [ring_{0}.last, ring_{1}.first], {2}}}\n", k, (k + 1) % 4, joint);
  }
  return text + loads + contacts;
}

// Under the same pressure from all around everything is under that pressure, and displacements are linear: exact.
TEST(Pressure, IsUniformInACutRingUnderPressureFromAround) {
  std::string loads = "loads:\n";
  for (int k = 0; k < 4; ++k) loads += fmt::format("  water_{0}: {{on: ring_{0}.rim, pressure: 1.5}}\n", k);
  for (const bool swapped : {false, true}) {
    const auto solution = run(cut_ring("friction: 0", "friction: 0", loads, 0.4, swapped));
    for (const analysis::ContactResult& contact : last(solution).contacts) {
      for (const analysis::PairResult& pair : contact.pairs) EXPECT_NEAR(pair.pressure, 1.5, 1e-8) << contact.name;
      EXPECT_NEAR(contact.max_pressure, 1.5, 1e-8);
    }
  }
}

// Lame: the disc is too large by 1e-3; p = E d / (2 r R^2 / (R^2 - r^2)). The ring's pieces are bonded: where two of
// them meet on the disc, three contacts share a point.
TEST(Pressure, OfAPressFitOfFourBondedPiecesIsLames) {
  const double lame = 2534.0 * 1e-3 / (2.0 * 4.0 / 3.0);
  double before = HUGE_VAL;
  for (const double size : {0.4, 0.2}) {
    const auto solution = run(cut_ring("bond: true", "friction: 0, gap: -1e-3", "", size));
    double worst = 0.0;
    for (const analysis::ContactResult& contact : last(solution).contacts)
      if (contact.name.starts_with("fit"))
        for (const analysis::PairResult& pair : contact.pairs)
          worst = std::max(worst, std::abs(pair.pressure / lame - 1.0));
    EXPECT_LE(worst, size == 0.4 ? 2e-2 : 0.35 * before) << size;
    before = worst;
  }
}

/// A disc of radius 1 whose rim is one edge, in a ring of outer radius 2 that is cut into six pieces, all turned by
/// 0.2. `pieces`: their division; `fit`: the contact of each with the disc; loads on the outside if `load` is not
/// empty; `loose`: a piece that is not bonded to its neighbours.
std::string disc_in_bonded_pieces(const std::string& disc, const std::string& pieces, const std::string& fit,
                                  const std::string& load = "", int loose = -1) {
  const auto at = [](double radius, int k) {
    const double angle = 0.2 + k * std::numbers::pi / 3.0;
    return fmt::format("[{:.17g}, {:.17g}]", radius * std::cos(angle), radius * std::sin(angle));
  };
  std::string text = fmt::format(
      "scabo: 1\nmaterials: {{m: {{young: 2534, poisson: 0.3}}}}\nbodies:\n"
      "  disc: {{material: m, shape: {{circle: {{centre: [0, 0], radius: 1}}}}, mesh: {{{}}}}}\n",
      disc);
  std::string contacts = "contacts:\n", loads = "loads:\n";
  for (int k = 0; k < 6; ++k) {
    text += fmt::format(
        "  piece_{0}:\n    material: m\n    shape:\n      outline:\n"
        "        - {{line: {{from: {1}, to: {2}}}, name: first}}\n"
        "        - {{arc: {{to: {3}, centre: [0, 0]}}, name: rim}}\n"
        "        - {{line: {{to: {4}}}, name: last}}\n"
        "        - {{arc: {{to: {1}, centre: [0, 0], direction: clockwise}}, name: bore}}\n"
        "    mesh: {{{5}}}\n",
        k, at(1, k), at(2, k), at(2, k + 1), at(1, k + 1), pieces);
    contacts += fmt::format("  fit_{0}: {{between: [disc.rim, piece_{0}.bore], {1}}}\n", k, fit);
    const bool is_loose = k == loose || (k + 1) % 6 == loose;
    contacts += fmt::format("  joint_{0}: {{between: [piece_{0}.last, piece_{1}.first], {2}}}\n", k, (k + 1) % 6,
                            is_loose ? "friction: 0" : "bond: true");
    loads += fmt::format("  water_{0}: {{on: piece_{0}.rim, {1}}}\n", k, load);
  }
  return text + contacts + (load.empty() ? "" : loads);
}

/// Largest relative difference of the pressures between disc and pieces from `exact`, and largest shear over it.
std::array<double, 2> worst_of_fits(const analysis::StaticSolution& solution, double exact) {
  std::array<double, 2> worst{0.0, 0.0};
  for (const analysis::ContactResult& contact : last(solution).contacts)
    if (contact.name.starts_with("fit"))
      for (const analysis::PairResult& pair : contact.pairs) {
        worst[0] = std::max(worst[0], std::abs(pair.pressure / exact - 1.0));
        worst[1] = std::max(worst[1], std::abs(pair.shear / exact));
      }
  return worst;
}

// Lame's pressure in the points in which two pieces and the disc meet, with and without friction, of any mesh: their
// normals there are one. With normals weighted over elements of different lengths it was up to four times as large, and
// friction at its bound where nothing slips.
TEST(Pressure, OfAPressFitOfBondedPiecesWhoseMeshesDiffer) {
  const double lame = 2534.0 * 1e-3 / (2.0 * 4.0 / 3.0);
  struct {
    const char *disc, *pieces;
    double tolerance;
  } const meshes[] = {{"size: 0.1", "size: 0.3", 5e-3},
                      {"size: 0.3, order: 4", "size: 0.2, order: 4", 2e-5},
                      {"kind: polygons, size: 0.1", "kind: polygons, size: 0.2", 3e-2},
                      {"kind: fem, size: 0.1", "kind: fem, size: 0.1", 3e-2}};
  for (const auto& mesh : meshes)
    for (const char* fit : {"friction: 0, gap: -1e-3", "friction: 0.3, gap: -1e-3"}) {
      const auto [pressure, shear] = worst_of_fits(run(disc_in_bonded_pieces(mesh.disc, mesh.pieces, fit)), lame);
      EXPECT_LE(pressure, mesh.tolerance) << mesh.disc << ", " << fit;
      EXPECT_LE(shear, 2.0 * mesh.tolerance) << mesh.disc << ", " << fit;
    }
}

// The same under water pressure from around, which is everywhere then. Without friction the ring may turn: no normals
// of arcs resist that, not those of a piece that is not bonded either (15 %).
TEST(Pressure, OfBondedPiecesUnderPressureFromAround) {
  for (const int loose : {-1, 0})
    for (const char* fit : {"friction: 0", "friction: 0.3"}) {
      const auto solution = run(disc_in_bonded_pieces("size: 0.1", "size: 0.3", fit, "pressure: 1.5", loose));
      EXPECT_LE(worst_of_fits(solution, 1.5)[0], 1e-3) << fit << ", " << loose;
    }
}

// Of six loose pieces one is a little too large: their normals are of one kind, and nothing turns (3 %).
TEST(Pressure, OfLoosePiecesOneOfWhichOverlaps) {
  std::vector<std::string> changes{"contacts.fit_0.gap=-1e-9"};
  for (int k = 0; k < 6; ++k)
    changes.push_back(
        fmt::format("contacts.joint_{0}={{between: [piece_{0}.last, piece_{1}.first], friction: 0}}", k, (k + 1) % 6));
  const auto solution = run(disc_in_bonded_pieces("size: 0.1", "size: 0.3", "friction: 0", "pressure: 1.5"), changes);
  EXPECT_LE(worst_of_fits(solution, 1.5)[0], 1e-4);
}

// The same whichever side is named first, and with friction, which carries nothing: all motion is radial.
TEST(Pressure, OfAPressFitDoesNotDependOnTheOrderOfSidesOrOnFriction) {
  const double lame = 2534.0 * 1e-3 / (2.0 * 4.0 / 3.0);
  for (const bool swapped : {false, true})
    for (const char* fit : {"friction: 0, gap: -1e-3", "friction: 0.3, gap: -1e-3"}) {
      const auto solution = run(cut_ring("bond: true", fit, "", 0.4, swapped));
      int pairs = 0;
      for (const analysis::ContactResult& contact : last(solution).contacts)
        if (contact.name.starts_with("fit"))
          for (const analysis::PairResult& pair : contact.pairs) {
            EXPECT_NEAR(pair.pressure / lame, 1.0, 2e-2) << contact.name << ", pair " << pair.pair << ", " << fit;
            ++pairs;
          }
      EXPECT_GE(pairs, 20);
    }
}

// A block glued to another is pulled off-centre: the joint opens from one side, and no pair carries more than the
// strength at any time.
TEST(Pressure, MeetsATensileStrengthExactly) {
  const auto solution = run(R"(
scabo: 1
materials: {m: {young: 10e9, poisson: 0.2}}
bodies:
  lower: {material: m, shape: {rectangle: {corner: [0, 0], size: [4, 1]}}, mesh: {size: 0.25}}
  upper: {material: m, shape: {rectangle: {corner: [1, 1], size: [2, 1]}}, mesh: {size: 0.25}}
supports: [{on: lower.bottom, fix: [x, y]}]
loads: {pull: {on: upper.top_left, force: [0, 80e3]}}
contacts: {joint: {between: [lower.top, upper.bottom], friction: 0.5, cohesion: 1e6, tension: 0.1e6}}
steps: [{name: pull, increments: 8}]
)");
  double lowest = 0.0;
  for (const analysis::IncrementResult& increment : solution.increments) {
    if (!increment.converged) break;
    for (const analysis::PairResult& pair : increment.contacts.front().pairs) lowest = std::min(lowest, pair.pressure);
  }
  EXPECT_GE(lowest, -0.1e6 * (1.0 + 1e-9));
  EXPECT_LE(lowest, -0.05e6);
}

}  // namespace
}  // namespace scabo::verification
