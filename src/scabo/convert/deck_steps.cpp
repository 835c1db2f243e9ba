#include "scabo/convert/deck_steps.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <set>
#include <string>

#include "scabo/convert/deck_fields.hpp"
#include "scabo/files/abaqus_lines.hpp"

namespace scabo::convert {

bool asks_for_large_displacements(const files::DeckBlock& step) { return is_on(step, "NLGEOM"); }

DeckStep begun_step(const files::DeckBlock& block, bool told_of_large_displacements, Remarks& remarks) {
  if (asks_for_large_displacements(block) && !told_of_large_displacements)
    remarks.note(
        block.at,
        "NLGEOM asks for large displacements and stiffness by stress, and Scabo's displacements are small: the "
        "run warns where they, or rotations, are not; for slender parts compare with NLGEOM=NO in the other "
        "program");
  DeckStep step;
  step.name = parameter(block, "NAME");
  step.at = block.at;
  step.at_once = files::upper(parameter(block, "AMPLITUDE")) == "STEP";
  return step;
}

void read_static(const files::DeckBlock& block, DeckStep& step, Remarks& remarks) {
  step.equal = is_on(block, "DIRECT");
  if (block.lines.empty()) return;
  const files::DeckLine& line = block.lines.front();
  step.first = number(remarks, line, 0, "the first increment of *STATIC", 1.0).value_or(1.0);
  step.period = number(remarks, line, 1, "the period of *STATIC", 1.0).value_or(1.0);
  step.smallest = number(remarks, line, 2, "the smallest increment of *STATIC", 0.0).value_or(0.0);
  step.largest = number(remarks, line, 3, "the largest increment of *STATIC", 0.0).value_or(0.0);
  if (std::min({step.first, step.period, step.smallest, step.largest}) < 0.0)
    remarks.essential(line.at, "an increment or the period of *STATIC is negative; correct it");
  if (!(step.period > 0.0)) step.period = 1.0;
  if (!(step.first > 0.0) || step.first > step.period) step.first = step.period;
}

std::vector<bool> blocks_left_out(const files::AbaqusDeck& deck, Remarks& remarks) {
  static const std::set<std::string> about_a_state = {"FREQUENCY", "BUCKLE", "COMPLEXFREQUENCY", "MODALDYNAMIC",
                                                      "STEADYSTATEDYNAMICS"},
                                     conditions = {
                                         "BOUNDARY",         "CLOAD",       "DLOAD",          "DSLOAD",
                                         "TEMPERATURE",      "MODELCHANGE", "CHANGEFRICTION", "CHANGESURFACEBEHAVIOR",
                                         "CHANGECONTACTTYPE"};
  struct Step {
    std::size_t first = 0, end = 0;
    std::string about;  // its procedure, as written
    bool is_static = false, has_conditions = false;
  };
  std::vector<Step> steps;
  for (std::size_t b = 0; b < deck.blocks.size(); ++b) {
    const files::DeckBlock& block = deck.blocks[b];
    if (block.name == "STEP") steps.push_back({b, b, {}});
    if (steps.empty()) continue;
    Step& step = steps.back();
    step.end = b + 1;
    if (about_a_state.contains(block.name)) step.about = block.written;
    step.is_static = step.is_static || block.name == "STATIC";
    step.has_conditions = step.has_conditions || conditions.contains(block.name);
  }
  std::vector<bool> out(deck.blocks.size(), false);
  const auto is_static = [](const Step& step) { return step.is_static; };
  if (std::none_of(steps.begin(), steps.end(), is_static)) return out;
  for (auto step = steps.begin(); step != steps.end(); ++step) {
    if (step->about.empty() || step->is_static) continue;
    if (step->has_conditions && std::any_of(step, steps.end(), is_static)) continue;
    std::fill(out.begin() + static_cast<std::ptrdiff_t>(step->first),
              out.begin() + static_cast<std::ptrdiff_t>(step->end), true);
    remarks.note(
        deck.blocks[step->first].at,
        fmt::format("the step with {} asks for vibrations or buckling about a state, and changes nothing in the "
                    "static steps; it is left out",
                    step->about));
  }
  return out;
}

double first_part(const DeckStep& step) {
  return step.at_once ? 1.0 : 1.0 / std::max(1.0, std::ceil(step.period / step.first - 1e-6));
}

}  // namespace scabo::convert
