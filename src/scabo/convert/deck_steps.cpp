#include "scabo/convert/deck_steps.hpp"

#include <algorithm>
#include <cmath>

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

double first_part(const DeckStep& step) {
  return step.at_once ? 1.0 : 1.0 / std::max(1.0, std::ceil(step.period / step.first - 1e-6));
}

}  // namespace scabo::convert
