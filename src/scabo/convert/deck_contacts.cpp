#include "scabo/convert/deck_contacts.hpp"

#include <fmt/format.h>

#include "scabo/convert/deck_fields.hpp"
#include "scabo/files/abaqus_lines.hpp"

namespace scabo::convert {

using files::DeckBlock;
using files::DeckLine;
using files::upper;

bool ContactReader::read(const DeckBlock& block, bool in_step) {
  if (block.name == "SURFACEINTERACTION") {
    interaction_ = upper(parameter(block, "NAME"));
    content_.interactions[interaction_].name = parameter(block, "NAME");
  } else if (block.name == "SURFACEBEHAVIOR") {
    surface_behavior(block);
  } else if (block.name == "FRICTION") {
    friction(block);
  } else if (block.name == "CONTACTPAIR" || block.name == "TIE") {
    pairs(block, in_step);
  } else {
    return false;
  }
  return true;
}

void ContactReader::friction(const DeckBlock& block) {
  if (interaction_.empty())
    return remarks_.essential(block.at, "*FRICTION stands before any *SURFACE INTERACTION and is lost");
  for (const char* unread :
       {"ROUGH", "TAUMAX", "EXPONENTIALDECAY", "EXPONENTIAL DECAY", "USER", "ANISOTROPIC", "DEPENDENCIES"})
    if (block.parameters.contains(unread))
      return remarks_.essential(block.at, fmt::format("*FRICTION with {} is not taken; give a coefficient", unread));
  if (block.lines.empty() || block.lines[0].fields.empty())
    return remarks_.essential(block.at, "*FRICTION has no coefficient; add a line with it");
  if (block.lines.size() > 1)
    return remarks_.essential(block.lines[1].at,
                              "a coefficient of friction that depends on something is not taken; give one number");
  if (const auto mu = number(remarks_, block.lines[0], 0, "the coefficient of friction"))
    content_.interactions[interaction_].friction = *mu;
  if (block.lines[0].fields.size() > 1)
    remarks_.note(block.lines[0].at,
                  "the stiffness of sticking is left out; in Scabo pairs that stick do not slip at all");
}

void ContactReader::surface_behavior(const DeckBlock& block) {
  const std::string law = upper(parameter(block, "PRESSURE-OVERCLOSURE", "HARD"));
  if (law == "TIED") {
    if (!interaction_.empty()) content_.interactions[interaction_].tied = true;
  } else if (law != "HARD") {
    remarks_.note(
        block.at,
        fmt::format("the stiffness of contact (PRESSURE-OVERCLOSURE={}) is left out; in Scabo bodies in contact do "
                    "not overlap",
                    files::printable(law)));
  }
  if (block.parameters.contains("NO SEPARATION"))
    remarks_.essential(block.at,
                       "contact that does not open (NO SEPARATION) is not taken; `bond` of a contact may replace it");
}

void ContactReader::pairs(const DeckBlock& block, bool in_step) {
  const bool tie = block.name == "TIE";
  if (in_step)
    return remarks_.essential(
        block.at, fmt::format("{} within a step is not taken; give it before the first step", shown(block.name)));
  for (const char* unread : {"TIED", "CYCLIC SYMMETRY", "MULTISTAGE", "NO THICKNESS"})
    if (block.parameters.contains(unread) && std::string_view(unread) != "NO THICKNESS")
      return remarks_.essential(block.at, fmt::format("{} with {} is not taken; use *TIE", shown(block.name), unread));
  if (!tie && block.parameters.contains("ADJUST"))
    remarks_.note(block.at,
                  "ADJUST moves nodes onto the other side, which is left out; the gaps are those of the mesh");
  bool any = false;
  for (const DeckLine& line : block.lines) {
    if (line.fields.empty()) continue;
    if (line.fields.size() < 2 || line.fields[1].empty()) {
      remarks_.essential(line.at, fmt::format("{} needs two surfaces; contact of a surface with itself is not taken",
                                              shown(block.name)));
      continue;
    }
    any = true;
    content_.contacts.push_back({line.fields[0], line.fields[1], upper(parameter(block, "INTERACTION")), tie, line.at});
  }
  if (!any) remarks_.essential(block.at, fmt::format("{} names no surfaces; add a line with two", shown(block.name)));
}

}  // namespace scabo::convert
