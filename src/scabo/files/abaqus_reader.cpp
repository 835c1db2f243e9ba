#include "scabo/files/abaqus_reader.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "scabo/files/abaqus_element.hpp"

namespace scabo::files {

std::int64_t AbaqusReader::integer(std::string_view field, const char* what) const {
  std::int64_t value = 0;
  if (!parse_number(field, value)) builder_.fail(lines_.at(), fmt::format("'{}' is not {}", printable(field), what));
  return value;
}

double AbaqusReader::real(std::string_view field, const char* what) const {
  double value = 0.0;
  if (!field.empty() && !parse_number(field, value)) {
    builder_.fail(lines_.at(), fmt::format("'{}' is not {}", printable(field), what));
  }
  return value;
}

std::int64_t AbaqusReader::own(std::int64_t number, int instance) const {
  if (instance == AbaqusInstances::none) return number;
  if (number < 0 || number >= AbaqusInstances::spacing)
    builder_.fail(lines_.at(), fmt::format("the number {} is negative or too large; number from 1", number));
  return AbaqusInstances::full_number(instance, number);
}

std::optional<std::int64_t> AbaqusReader::number_in(const std::string& field, int instance) const {
  std::int64_t number = 0;
  if (parse_number(std::string_view(field), number)) return own(number, instance);
  const auto of = instances_.split(field);
  if (of && parse_number(std::string_view(of->second), number)) return own(number, of->first);
  return std::nullopt;
}

/// In the instance, else by its full name, else in the only instance that there is.
const AbaqusSet* AbaqusReader::set_in(const AbaqusSets& sets, const std::string& name, int instance) const {
  const AbaqusSet* found = sets.find(instances_.full_name(instance, name));
  if (found == nullptr && instance == AbaqusInstances::none && instances_.count() == 1)
    found = sets.find(instances_.full_name(0, name));
  const auto dot = name.rfind('.');
  if (found == nullptr && instances_.count() == 0 && dot != std::string::npos) found = sets.find(name.substr(dot + 1));
  return found;
}

void AbaqusReader::nodes(const AbaqusKeyword& key) {
  if (key.has("SYSTEM") && upper(key.value("SYSTEM")) != "R") {
    builder_.fail(key.at, "coordinates in a cylindrical or spherical SYSTEM are not read; write rectangular ones");
  }
  if (key.has("INPUT")) lines_.insert(key);
  const std::string name = full_name(key.value("NSET"));
  if (key.has("NSET")) node_sets_.named(name);
  std::vector<std::string_view> fields;
  std::vector<std::int64_t> numbers;
  while (next_data(fields)) {
    const std::int64_t number = own(fields[0], "the number of a node");
    Vec3 x = Vec3::Zero();  // what is not given is zero
    for (std::size_t i = 0; i < 3 && i + 1 < fields.size(); ++i)
      x[static_cast<Eigen::Index>(i)] = real(fields[i + 1], "a coordinate");
    if (instance_ != AbaqusInstances::none) x = instances_.placement(instance_)(x);
    builder_.add_node(number, x.x(), x.y(), x.z(), lines_.at());
    if (key.has("NSET")) numbers.push_back(number);
  }
  if (key.has("NSET")) add_numbers(node_sets_.named(name), numbers);
}

/// The nodes of an element, whose line goes on where it has too few.
void AbaqusReader::nodes_of_element(std::vector<std::string_view>& fields, std::size_t wanted, std::int64_t number,
                                    const std::string& type, std::vector<std::int64_t>& nodes) {
  const FilePlace at = lines_.at();
  nodes.clear();
  for (std::size_t first = 1; true; first = 0) {
    for (std::size_t i = first; i < fields.size(); ++i) nodes.push_back(own(fields[i], "the number of a node"));
    if (nodes.size() >= wanted) break;
    if (!next_data(fields))
      builder_.fail(at, fmt::format("cell {} has {} nodes, but type {} has {}; correct the type or the line", number,
                                    nodes.size(), type, wanted));
  }
  if (nodes.size() > wanted)
    builder_.fail(at, fmt::format("cell {} has {} nodes, but type {} has {}; correct the type or the line", number,
                                  nodes.size(), type, wanted));
}

void AbaqusReader::elements(const AbaqusKeyword& key) {
  const std::string type = upper(key.value("TYPE"));
  if (type.empty()) builder_.fail(key.at, "*ELEMENT has no TYPE; write for example TYPE=CPS4");
  const std::string name = full_name(key.value("ELSET"));
  if (key.has("ELSET")) element_sets_.named(name).of_element_line = true;
  if (key.has("INPUT")) lines_.insert(key);
  const std::optional<AbaqusElement> element = abaqus_element(type);
  if (whole_) deck_.elements.push_back({type, place_of(key.at)});
  std::vector<std::string_view> fields;
  std::vector<std::int64_t> numbers, nodes;
  while (next_data(fields)) {
    const FilePlace at = lines_.at();
    const std::int64_t number = own(fields[0], "the number of an element");
    if (!element && is_discrete_abaqus_element(type)) {
      if (numbers.empty())
        builder_.remark(at, fmt::format("elements of type {} have no area and are left out", printable(type)));
      numbers.push_back(number);
      discrete_.push_back(number);
      continue;
    }
    const std::string shown(trimmed(fields[0]));
    if (!element) builder_.fail(at, fmt::format("cell {}: type {} {}", shown, printable(type), abaqus_refusal(type)));
    nodes_of_element(fields, static_cast<std::size_t>(element->nodes), integer(shown, ""), type, nodes);
    numbers.push_back(number);
    if (element->family == ElementFamily::line) {
      // Of three nodes the second is the middle one.
      line_elements_.push_back({number, {nodes.front(), nodes.back(), element->nodes == 3 ? nodes[1] : -1}});
      continue;
    }
    if (element->nodes == 9) nodes.pop_back();
    builder_.add_cell(abaqus_cell_kind(element->nodes), number, nodes, 0, at);
    cell_numbers_.push_back(number);
    if (whole_) deck_.type_of_cell[number] = static_cast<int>(deck_.elements.size()) - 1;
    shell_.push_back(element->family == ElementFamily::shell);
    if (std::find(types_.begin(), types_.end(), type) == types_.end()) types_.push_back(type);
  }
  if (key.has("ELSET")) add_numbers(element_sets_.named(name), numbers);
}

void AbaqusReader::section(const AbaqusKeyword& key) {
  if (!key.has("ELSET"))
    builder_.fail(key.at, fmt::format("{} has no ELSET; name the elements it is for", key.written));
  sections_.push_back({key.written, full_name(key.value("ELSET")), key.value("MATERIAL"), key.at});
  block(key);
}

/// The next data line that is not empty.
bool AbaqusReader::next_data(std::vector<std::string_view>& fields) {
  do {
    if (!lines_.next_data(fields)) return false;
  } while (fields.empty());
  if (!deck_.blocks.empty()) deck_.blocks.back().has_data = true;
  return true;
}

DeckLine AbaqusReader::deck_line(const AbaqusKeyword& key, const std::vector<std::string_view>& fields) {
  DeckLine line{{}, place_of(lines_.at()), {}};
  for (const std::string_view field : fields)
    line.fields.push_back(key.name == "HEADING" ? std::string(field) : without_quotes(field));
  const std::string label = fields.size() > 1 ? upper(fields[1]) : "";
  if (key.name == "DLOAD" && label.size() == 2 && label[0] == 'P' && label[1] >= '1' && label[1] <= '4') {
    line.sides = fmt::format("*DLOAD {}", surfaces_.size());
    surfaces_.push_back({line.sides, key.written, {{line.fields[0], "S" + label.substr(1), instance_, lines_.at()}}});
  }
  return line;
}

/// What is not part of the mesh.
void AbaqusReader::block(const AbaqusKeyword& key) {
  if (!whole_) return;
  if (key.has("INPUT")) lines_.insert(key);
  std::vector<std::string_view> fields;
  while (next_data(fields)) deck_.blocks.back().lines.push_back(deck_line(key, fields));
}

void AbaqusReader::keyword(const AbaqusKeyword& key) {
  if (whole_) deck_.blocks.push_back({key.name, key.written, key.parameters, place_of(key.at), {}, false, instance_});
  if (key.name == "NODE") return nodes(key);
  if (key.name == "ELEMENT") return elements(key);
  if (key.name == "NSET") return set(key, node_sets_, "NSET");
  if (key.name == "ELSET") return set(key, element_sets_, "ELSET");
  if (key.name == "SURFACE") return surface(key);
  if (key.name == "PART") return part(key);
  if (key.name == "INSTANCE") return instance(key);
  if (key.name == "ENDINSTANCE") return end_instance(key);
  for (const char* section_name : {"SOLIDSECTION", "SHELLSECTION", "MEMBRANESECTION", "SHELLGENERALSECTION",
                                   "BEAMSECTION", "BEAMGENERALSECTION", "TRUSSSECTION"}) {
    if (key.name == section_name) return section(key);
  }
  for (const char* maker : {"NGEN", "NFILL", "NCOPY", "NMAP", "ELGEN", "ELCOPY", "SYSTEM"}) {
    if (key.name == maker)
      builder_.fail(key.at, fmt::format("{} makes nodes or elements and is not read; write them out", key.written));
  }
  block(key);
}

void AbaqusReader::read_keywords() {
  AbaqusKeyword key;
  while (lines_.next_keyword(key)) keyword(key);
}

}  // namespace scabo::files
