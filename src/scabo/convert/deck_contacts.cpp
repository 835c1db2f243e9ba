#include "scabo/convert/deck_contacts.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "scabo/convert/deck_fields.hpp"
#include "scabo/files/abaqus_lines.hpp"
#include "scabo/files/text_cursor.hpp"

namespace scabo::convert {

using files::DeckBlock;
using files::DeckLine;
using files::upper;

namespace {

constexpr double most_friction = 1e6;  // the largest one that a model may have; decks write more where nothing slips

}  // namespace

void tell_unknown_interactions(const DeckContent& content, Remarks& remarks) {
  for (const DeckContact& contact : content.contacts)
    if (!contact.tie && !contact.interaction.empty() && !content.interactions.contains(contact.interaction))
      remarks.essential(contact.at, fmt::format("there is no *SURFACE INTERACTION '{}'; correct its name",
                                                files::printable(contact.interaction)));
}

bool ContactReader::read(const DeckBlock& block, bool in_step) {
  if (block.name == "SURFACEINTERACTION") {
    interaction_ = upper(parameter(block, "NAME"));
    laws_.clear();
    changes_ = false;
    if (content_.interactions.contains(interaction_))
      remarks_.essential(block.at, fmt::format("there is another {} '{}' before this one; give each a name of its own",
                                               block.written, files::printable(parameter(block, "NAME"))));
    content_.interactions[interaction_].name = parameter(block, "NAME");
  } else if (block.name == "SURFACEBEHAVIOR") {
    surface_behavior(block);
  } else if (block.name == "CHANGEFRICTION") {
    change_friction(block, in_step);
  } else if (block.name == "FRICTION") {
    friction(block);
  } else if (block.name == "CONTACTPAIR" || block.name == "TIE") {
    pairs(block, in_step);
  } else {
    return false;
  }
  if ((block.name == "SURFACEBEHAVIOR" || block.name == "FRICTION") && !laws_.insert(block.name).second)
    remarks_.essential(block.at, fmt::format("{} of this *SURFACE INTERACTION stands before this one too; leave one "
                                             "of them",
                                             block.written));
  return true;
}

void ContactReader::change_friction(const DeckBlock& block, bool in_step) {
  const std::string name = parameter(block, "INTERACTION");
  if (!in_step) return remarks_.essential(block.at, "*CHANGE FRICTION stands outside of a step; give it within *STEP");
  if (!content_.interactions.contains(upper(name)))
    return remarks_.essential(
        block.at, fmt::format("there is no *SURFACE INTERACTION '{}'; correct its name", files::printable(name)));
  interaction_ = upper(name);
  laws_.clear();
  changes_ = true;
  remarks_.note(block.at, "*CHANGE FRICTION: the coefficient goes to its new value over the step, and not at once");
}

void ContactReader::friction(const DeckBlock& block) {
  if (interaction_.empty())
    return remarks_.essential(block.at, "*FRICTION stands before any *SURFACE INTERACTION and is lost");
  if (block.lines.empty()) return;
  if (const auto mu = number(remarks_, block.lines[0], 0, "the coefficient of friction"))
    (changes_ ? content_.steps.back().friction[interaction_] : content_.interactions[interaction_].friction) =
        std::min(*mu, most_friction);
  DeckInteraction& interaction = content_.interactions[interaction_];
  if (block.lines[0].fields.size() > 1) {
    interaction.stick_stiffness = number(remarks_, block.lines[0], 1, "the stiffness of sticking", 0.0);
    interaction.at_stick_stiffness = block.lines[0].at;
  }
}

void ContactReader::surface_behavior(const DeckBlock& block) {
  const std::string law = upper(parameter(block, "PRESSURE-OVERCLOSURE", "HARD"));
  if (law == "TIED") {
    if (!interaction_.empty()) content_.interactions[interaction_].tied = true;
  }
  if (law == "HARD") return;
  if (interaction_.empty())
    return remarks_.essential(block.at,
                              fmt::format("{} stands before any *SURFACE INTERACTION and is lost", block.written));
  if (!block.has_data && law != "TIED")
    return remarks_.essential(
        block.at, fmt::format("{}, PRESSURE-OVERCLOSURE={} has no data lines; add them", block.written, law));
  if (block.lines.empty()) return;
  if (law == "EXPONENTIAL") {
    content_.interactions[interaction_].exponential = true;
    content_.interactions[interaction_].at_stiffness = block.at;
    return;
  }
  const auto slope = law == "TABULAR" ? least_slope(block) : number(remarks_, block.lines[0], 0, "the stiffness");
  if (!slope) return;
  content_.interactions[interaction_].stiffness = slope;
  content_.interactions[interaction_].linear = law == "LINEAR";
  content_.interactions[interaction_].at_stiffness = block.lines[0].at;
}

/// Of a table of pressure and overlap that begins at 0, 0.
std::optional<double> ContactReader::least_slope(const DeckBlock& block) {
  std::optional<double> least;
  std::pair<double, double> before;
  for (const DeckLine& line : block.lines) {
    const auto pressure = number(remarks_, line, 0, "the pressure"), overlap = number(remarks_, line, 1, "the overlap");
    if (!pressure || !overlap) return std::nullopt;
    const std::pair<double, double> now{*pressure, *overlap};
    if (&line != &block.lines.front()) {
      const double slope = (now.first - before.first) / (now.second - before.second);
      least = std::min(least.value_or(slope), slope);
    }
    before = now;
  }
  const DeckLine& first = block.lines.front();
  const double zero = number(remarks_, first, 0, "the pressure", 0.0).value_or(0.0);
  const double begin = number(remarks_, first, 1, "the overlap", 0.0).value_or(0.0);
  if (least && *least > 0.0 && zero == 0.0 && begin == 0.0) return least;
  remarks_.essential(first.at, "a table of PRESSURE-OVERCLOSURE is taken if it begins at 0, 0 and rises; correct it");
  return std::nullopt;
}

void ContactReader::pairs(const DeckBlock& block, bool in_step) {
  const bool tie = block.name == "TIE";
  if (in_step)
    return remarks_.essential(
        block.at, fmt::format("{} within a step is not taken; give it before the first step", block.written));
  if (!tie && parameter(block, "INTERACTION").empty())
    remarks_.essential(block.at, fmt::format("{} has no INTERACTION; name its *SURFACE INTERACTION", block.written));
  for (const DeckLine& line : block.lines) {
    if (line.fields.size() < 2 || line.fields[1].empty()) {
      remarks_.essential(
          line.at, fmt::format("{} needs two surfaces; contact of a surface with itself is not taken", block.written));
      continue;
    }
    DeckContact contact;
    contact.slave = line.fields[0];
    contact.master = line.fields[1];
    contact.interaction = upper(parameter(block, "INTERACTION"));
    contact.tie = tie;
    contact.at = line.at;
    adjust(block, contact);
    content_.contacts.push_back(std::move(contact));
  }
}

void ContactReader::clearance(const DeckBlock& block, bool in_step) {
  const std::string text = parameter(block, "VALUE");
  double value = 0.0;
  for (const auto& [name, given] : block.parameters)
    if (name != "MASTER" && name != "SLAVE" && name != "VALUE")
      remarks_.essential(block.at, fmt::format("*CLEARANCE with {} is not taken; there is MASTER, SLAVE, VALUE",
                                               files::printable(name)));
  if (in_step)
    return remarks_.essential(block.at, "*CLEARANCE within a step is not taken; give it before the first step");
  if (!files::parse_number(std::string_view(text), value) || !std::isfinite(value))
    return remarks_.essential(block.at,
                              fmt::format("'{}' is no VALUE of *CLEARANCE; write a length", files::printable(text)));
  const std::string slave = upper(parameter(block, "SLAVE")), master = upper(parameter(block, "MASTER"));
  for (DeckContact& contact : content_.contacts) {
    if (contact.tie || upper(contact.slave) != slave || upper(contact.master) != master) continue;
    if (contact.clearance)
      remarks_.essential(block.at, "another *CLEARANCE of this contact stands before this one; leave one of them");
    contact.clearance = value;
    return;
  }
  remarks_.essential(block.at,
                     fmt::format("no *CONTACT PAIR before this *CLEARANCE has the slave '{}' and the master '{}'; "
                                 "correct the names",
                                 files::printable(slave), files::printable(master)));
}

void ContactReader::adjust(const DeckBlock& block, DeckContact& contact) {
  const std::string tolerance = parameter(block, "POSITION TOLERANCE"), value = parameter(block, "ADJUST");
  double distance = 0.0;
  if (contact.tie) {
    contact.adjusts = upper(value) != "NO";
    if (tolerance.empty()) return;
    if (!files::parse_number(std::string_view(tolerance), distance) || !(distance >= 0.0))
      return remarks_.essential(
          block.at, fmt::format("'{}' is no POSITION TOLERANCE; write a length", files::printable(tolerance)));
    contact.tolerance = distance;
    return;
  }
  if (!block.parameters.contains("ADJUST")) return;
  if (files::parse_number(std::string_view(value), distance)) {
    contact.adjust_within = distance;
  } else if (const auto nodes = nodes_(value)) {
    contact.adjusted_nodes = {nodes->begin(), nodes->end()};
  } else {
    remarks_.essential(block.at, fmt::format("ADJUST={} of {} is neither a distance nor a node set; correct it",
                                             files::printable(value), block.written));
  }
}

}  // namespace scabo::convert
