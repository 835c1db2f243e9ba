// Interferences that a step of its own resolves, and runs that start where another one ended.
#include <fmt/format.h>
#include <unistd.h>

#include <filesystem>
#include <numbers>

#include "run.hpp"
#include "scabo/analysis/state/restart.hpp"

namespace scabo::verification {
namespace {

// A ring, outer radius R, is shrunk on a shaft of radius a of the same material with the radial interference d. Lame:
// p = E' d (R^2 - a^2) / (2 a R^2), E' = E in plane stress and E / (1 - nu^2) in plane strain. Pressure q on the ring
// adds q: together they are a solid disc, whose stress is -q everywhere.
TEST(Fits, OfARingOnAShaft) {
  const double E = 210e9, nu = 0.3, R = 2.0, d = 1e-4, q = 5e6;
  for (const double scale : {1.0, 1e-3})
    for (const bool strain : {false, true}) {
      const auto solution =
          run(fmt::format(R"(
scabo: 1
analysis: {{plane: {0}}}
materials: {{steel: {{young: {1}, poisson: {2}}}}}
bodies:
  shaft:
    material: steel
    shape:
      outline:
        - {{line: {{from: [0, 0], to: [{3}, 0]}}, name: floor}}
        - {{arc: {{to: [0, {3}], centre: [0, 0]}}, name: rim}}
        - {{line: {{to: [0, 0]}}, name: wall}}
    mesh: {{size: {5}, order: 4}}
  ring:
    material: steel
    shape:
      outline:
        - {{line: {{from: [{3}, 0], to: [{4}, 0]}}, name: floor}}
        - {{arc: {{to: [0, {4}], centre: [0, 0]}}, name: outer}}
        - {{line: {{to: [0, {3}]}}, name: wall}}
        - {{arc: {{to: [{3}, 0], centre: [0, 0], direction: clockwise}}, name: bore}}
    mesh: {{size: {5}, order: 4, kind: polygons}}
supports:
  - {{on: shaft.floor, fix: y}}
  - {{on: shaft.wall, fix: x}}
  - {{on: ring.floor, fix: y}}
  - {{on: ring.wall, fix: x}}
loads: {{squeeze: {{on: ring.outer, pressure: {6}}}}}
contacts: {{seat: {{between: [shaft.rim, ring.bore], friction: 0, gap: {7}, fit_in: shrink}}}}
steps:
  - {{name: touch, loads: {{squeeze: 1}}}}
  - {{name: shrink, increments: 2, loads: {{}}}}
  - {{name: relieve, loads: {{squeeze: 0}}}}
)",
                          strain ? "strain" : "stress", E, nu, scale, R * scale, 0.3 * scale, q, -d * scale));
      const double fit = (strain ? E / (1.0 - nu * nu) : E) * d * (R * R - 1.0) / (2.0 * R * R);
      const double expected[] = {q, q + 0.5 * fit, q + fit, fit};
      ASSERT_EQ(solution.increments.size(), 4U) << solution.reason;
      for (std::size_t k = 0; k < 4; ++k) {
        const double mean = contact_of(increment_at(solution, k)).normal_force / (0.5 * std::numbers::pi * scale);
        EXPECT_NEAR(mean, expected[k], 1e-8 * expected[k]) << k;
      }
    }
}

std::filesystem::path fresh_directory(const std::string& name) {
  const auto directory = std::filesystem::temp_directory_path() / fmt::format("scabo_restart_{}_{}", name, ::getpid());
  std::filesystem::remove_all(directory);
  std::filesystem::create_directories(directory);
  return directory;
}

analysis::StaticSolution run_and_keep(const std::string& text, const std::filesystem::path& directory) {
  analysis::Options options;
  options.on_end = [&](const analysis::EndState& end) { analysis::write_end_state(directory, end); };
  return analysis::solve_static(input::parse_model(text, "test.yaml", {}), options);
}

/// Two blocks on a floor, glued to each other; the upper one is pushed until the glue breaks in part, and goes back.
std::string glued(const std::string& steps, const std::string& more = {}, double size = 0.25) {
  return fmt::format(R"(
scabo: 1
materials: {{stone: {{young: 1e8, poisson: 0.2, density: 2000}}}}
bodies:
  floor: {{rigid: true, shape: {{rectangle: {{corner: [-1, -1], size: [4, 1]}}}}}}
  low: {{material: stone, shape: {{rectangle: {{corner: [0, 0], size: [1, 0.5]}}}}, mesh: {{size: {2}}}}}
  high: {{material: stone, shape: {{rectangle: {{corner: [0, 0.5], size: [1, 0.5]}}}}, mesh: {{size: 0.25}}}}
supports: [{{on: floor, fix: [x, y]}}]
loads: {{weight: {{gravity: [0, -10]}}, push: {{on: high.right, traction: [-8e3, 0]}}}}
contacts:
  base: {{between: [floor.top, low.bottom], friction: 0.9}}
  joint: {{between: [low.top, high.bottom], friction: {{static: 0.5, dynamic: 0.45, slip_distance: 1e-5}}, cohesion: 500, tension: 250}}
steps: {0}
{1}
)",
                     steps, more, size);
}

/// `states`: whether pairs slip in the same increments.
void expect_same_end(const analysis::IncrementResult& a, const analysis::IncrementResult& b, bool states = true) {
  for (std::size_t c = 0; c < a.contacts.size(); ++c) {
    ASSERT_EQ(a.contacts[c].pairs.size(), b.contacts[c].pairs.size());
    EXPECT_EQ(a.contacts[c].broken, b.contacts[c].broken);
    for (std::size_t i = 0; i < a.contacts[c].pairs.size(); ++i) {
      const analysis::PairResult &one = a.contacts[c].pairs[i], &other = b.contacts[c].pairs[i];
      if (states) {
        EXPECT_EQ(one.state, other.state);
      }
      EXPECT_NEAR(one.normal_force, other.normal_force, 1e-12 * a.largest_force);
      EXPECT_NEAR(one.tangential_force, other.tangential_force, 1e-12 * a.largest_force);
      EXPECT_NEAR(one.slip, other.slip, 1e-12 * std::abs(one.slip) + 1e-18);
    }
  }
  for (std::size_t body = 0; body < a.fields.displacements.size(); ++body)
    EXPECT_LE((a.fields.displacements[body] - b.fields.displacements[body]).lpNorm<Eigen::Infinity>(),
              1e-12 * a.fields.displacements[body].lpNorm<Eigen::Infinity>());
  EXPECT_NEAR(a.energy.external, b.energy.external, 1e-12 * std::abs(a.energy.external));
  EXPECT_NEAR(a.energy.elastic, b.energy.elastic, 1e-12 * a.energy.elastic);
  EXPECT_NEAR(a.energy.friction, b.energy.friction, 1e-12 * a.energy.friction + 1e-18);
  EXPECT_EQ(a.factors, b.factors);
}

TEST(Restart, TwoHalvesAreOneRun) {
  const std::string
      first = "{name: settle, loads: {weight: 1}}, {name: push, increments: 3, loads: {push: 0.8}}",
      then = "{name: more, increments: 2, loads: {push: 1}}, {name: back, increments: 2, loads: {push: -0.5}}";
  const auto directory = fresh_directory("halves");
  const auto whole = run(glued("[" + first + ", " + then + "]"));
  const auto half = run_and_keep(glued("[" + first + "]"), directory);
  EXPECT_GT(*contact_of(last(half), 1).broken, 0);
  EXPECT_GT(last(half).energy.friction, 0.0);
  const auto other = run(glued("[" + then + "]", "restart: " + directory.string()));
  expect_same_end(last(whole), last(other));
  // A step without a change is at rest where the other run ended, and nothing slips.
  const auto still = run(glued("[{name: wait, loads: {}}]", "restart: " + directory.string()));
  expect_same_end(last(half), last(still), false);
  EXPECT_EQ(contact_of(last(still), 1).slip, 0);
  std::filesystem::remove_all(directory);
}

TEST(Restart, TellsWhatDoesNotAgree) {
  const auto directory = fresh_directory("disagree");
  run_and_keep(glued("[{name: settle, loads: {weight: 1, push: 0.1}}]"), directory);
  const auto message = [&](const std::string& text) -> std::string {
    try {
      run(text);
    } catch (const InputError& error) {
      return error.what();
    }
    return "no error";
  };
  const std::string restart = "restart: " + directory.string(), steps = "[{name: push, loads: {push: 1}}]";
  const auto with = [&](std::string text, const std::string& from, const std::string& to) {
    return text.replace(text.find(from), from.size(), to);
  };
  const std::string good = glued(steps, restart);
  EXPECT_EQ(message(good), "no error");
  EXPECT_NE(message(glued(steps, restart, 0.2)).find("body 'low' is not the same as in"), std::string::npos);
  EXPECT_NE(message(with(good, "1e8", "2e8")).find("body 'high' is not the same as in"), std::string::npos);
  EXPECT_NE(message(with(good, "gravity: [0, -10]", "gravity: [0, -11]")).find("load 'weight' is not the same as in"),
            std::string::npos);
  EXPECT_NE(message(with(good, "fix: [x, y]", "fix: y")).find("support 'floor' is not the same as in"),
            std::string::npos);
  EXPECT_NE(message(with(good, "friction: 0.9", "friction: 0.9, gap: 1e-6")).find("contact 'base' is not the same"),
            std::string::npos);
  EXPECT_EQ(message(with(good, "friction: 0.9", "friction: 0.8")), "no error");
  EXPECT_NE(message(with(good, "weight: {gravity: [0, -10]}, ", "")).find("load 'weight' is there at the end of"),
            std::string::npos);
  std::filesystem::resize_file(directory / "end.state", 1000);
  EXPECT_NE(message(good).find("is damaged"), std::string::npos);
  std::filesystem::remove_all(directory);
}

TEST(Restart, GoesOnFromAStageOfConstruction) {
  const auto model = [](const char* low, const char* middle, const char* high, const std::string& rest) {
    std::string text = R"(
scabo: 1
materials: {stuff: {young: 1e9, poisson: 0.2, density: 2000}}
bodies:
  floor: {rigid: true, shape: {rectangle: {corner: [-1, -1], size: [3, 1]}}}
)";
    const auto block = [&](const char* name, double y, const char* key) {
      text += fmt::format(
          "  {}: {{material: stuff, shape: {{rectangle: {{corner: [0, {}], size: [1, 1]}}}}, mesh: {{size: "
          "0.5}}{}}}\n",
          name, y, key);
    };
    block("low", 0, low);
    block("middle", 1, middle);
    if (high != nullptr) block("high", 2, high);
    text +=
        "supports: [{on: floor, fix: [x, y]}]\nloads: {weight: {gravity: [0, -10]}}\ncontacts:\n"
        "  base: {between: [floor.top, low.bottom], friction: 0.4}\n"
        "  one: {between: [low.top, middle.bottom], friction: 0.4}\n";
    if (high != nullptr) text += "  two: {between: [middle.top, high.bottom], friction: 0.4}\n";
    return text + rest;
  };
  const auto directory = fresh_directory("stages");
  const auto whole = run(model("", ", added: b", ", added: d", "steps: [{name: a}, {name: b}, {name: c}, {name: d}]"));
  const auto half = run_and_keep(model("", ", added: b", nullptr, "steps: [{name: a}, {name: b}]"), directory);
  EXPECT_EQ(half.outcome, analysis::Outcome::solved);
  const auto other = run(model("", "", ", added: d", "steps: [{name: c}, {name: d}]\nrestart: " + directory.string()));
  expect_same_end(last(whole), last(other));
  std::filesystem::remove_all(directory);
}

}  // namespace
}  // namespace scabo::verification
