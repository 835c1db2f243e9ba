// A program outside Scabo's own tree that reads and solves a model through the installed headers and library.
#include <cmath>
#include <cstdio>
#include <scabo/analysis/static_analysis.hpp>
#include <scabo/input/read_model.hpp>

int main() {
  const char* text = R"(
scabo: 1
title: Block
analysis: {type: static, plane: stress, thickness: 1.0}
materials:
  steel: {young: 210e9, poisson: 0.3}
bodies:
  block: {material: steel, shape: {rectangle: {corner: [0, 0], size: [2, 1]}}, mesh: {size: 0.5, order: 2}}
supports:
  - {on: block.left, fix: [x, y]}
loads:
  pull: {on: block.right, force: [1e3, 0]}
steps:
  - {name: pull, increments: 1}
)";
  try {
    const scabo::model::Model model = scabo::input::parse_model(text, "block.yaml");
    const double area = model.bodies.at(0).outline.area();
    std::printf("%s: area %g\n", model.bodies.at(0).name.c_str(), area);
    if (area < 1.999 || area > 2.001) return 1;

    const scabo::analysis::StaticSolution solution = scabo::analysis::solve_static(model);
    const double reaction = solution.increments.back().reactions.at(0).x();
    std::printf("reaction %g\n", reaction);
    if (solution.outcome != scabo::analysis::Outcome::solved || std::abs(reaction + 1e3) > 1e-6) return 1;
  } catch (const scabo::InputError& error) {
    std::fprintf(stderr, "%s\n", error.what());
    return 1;
  }

  // A mistake arrives as an exception of the library's type.
  try {
    scabo::input::parse_model("scabo: 1\nbodeis: {}\n", "wrong.yaml");
  } catch (const scabo::InputError& error) {
    return error.diagnostics().empty() ? 1 : 0;
  }
  return 1;
}
