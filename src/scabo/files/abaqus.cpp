#include "scabo/files/abaqus.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <optional>

#include "scabo/files/abaqus_element.hpp"
#include "scabo/files/abaqus_lines.hpp"
#include "scabo/files/abaqus_sets.hpp"
#include "scabo/files/mesh_builder.hpp"

namespace scabo::files {

namespace {

class AbaqusReader {
 public:
  AbaqusReader(std::string_view text, const std::string& file, const ReadInclude& read_include)
      : builder_(file),
        lines_(text, file, read_include, builder_),
        most_entries_(1'000'000 + 20 * static_cast<std::int64_t>(text.size())) {}

  ImportedMesh read();
  AbaqusDeck read_deck();

 private:
  /// A number that a set names; those of GENERATE need not exist.
  struct Listed {
    std::int64_t number;
    FilePlace at;
    bool node;
  };
  struct SurfaceEntry {
    std::string of;  // element or set
    std::string side;
    FilePlace at;
  };
  struct Surface {
    std::string name;
    std::vector<SurfaceEntry> entries;
  };
  struct Section {
    std::string keyword, set, material;
    FilePlace at;
  };
  struct LineElement {
    std::int64_t number;
    std::array<std::int64_t, 3> nodes;  // start, end, middle or -1
  };

  void keyword(const AbaqusKeyword& key);
  void nodes(const AbaqusKeyword& key);
  void elements(const AbaqusKeyword& key);
  void set(const AbaqusKeyword& key, AbaqusSets& sets, const char* parameter);
  void generate(AbaqusSet& target);
  void surface(const AbaqusKeyword& key);
  void section(const AbaqusKeyword& key);
  void instance(const AbaqusKeyword& key);
  void block(const AbaqusKeyword& key);
  DeckPlace place_of(const FilePlace& at) const { return {builder_.file(at), at.line}; }

  std::int64_t integer(std::string_view field, const char* what) const;
  double real(std::string_view field, const char* what) const;
  void add_numbers(AbaqusSet& target, const std::vector<std::int64_t>& numbers);
  void add_listed(AbaqusSet& target, std::int64_t number, bool node);
  void count_entries(std::int64_t count);

  // `elements` gives positions: cells first, then lines.
  void resolve_regions(const NumberIndex& elements);
  void resolve_sets(const NumberIndex& elements);
  void resolve_surfaces(const NumberIndex& elements);

  MeshBuilder builder_;
  AbaqusLines lines_;
  std::int64_t most_entries_;  // of all sets together: sets of sets grow faster than the file
  std::int64_t entries_ = 0;
  std::vector<std::int64_t> cell_numbers_;
  std::vector<bool> shell_;  // per cell
  std::vector<LineElement> line_elements_;
  std::vector<std::int64_t> discrete_;
  AbaqusSets node_sets_, element_sets_;
  std::vector<Listed> listed_;
  std::vector<Surface> surfaces_;
  std::vector<Section> sections_;
  Vec2 shift_ = Vec2::Zero();
  int parts_ = 0, instances_ = 0;
  AbaqusDeck deck_;
  bool whole_ = false;  // what is not part of the mesh is kept
};

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

void AbaqusReader::count_entries(std::int64_t count) {
  const bool too_many = count > most_entries_ - entries_;
  entries_ += too_many ? 0 : count;
  if (too_many) builder_.fail(lines_.at(), "the sets of the file are too many and too large to be meant");
}

void AbaqusReader::add_listed(AbaqusSet& target, std::int64_t number, bool node) {
  count_entries(1);
  target.numbers.push_back(number);
  listed_.push_back({number, lines_.at(), node});
}

void AbaqusReader::add_numbers(AbaqusSet& target, const std::vector<std::int64_t>& numbers) {
  count_entries(static_cast<std::int64_t>(numbers.size()));
  const std::vector<std::int64_t> copy = numbers;  // a set may name itself
  target.numbers.insert(target.numbers.end(), copy.begin(), copy.end());
}

void AbaqusReader::nodes(const AbaqusKeyword& key) {
  if (key.has("SYSTEM") && upper(key.value("SYSTEM")) != "R") {
    builder_.fail(key.at, "coordinates in a cylindrical or spherical SYSTEM are not read; write rectangular ones");
  }
  if (key.has("INPUT")) lines_.insert(key);
  const std::string name = key.value("NSET");
  if (key.has("NSET")) node_sets_.named(name);
  std::vector<std::string_view> fields;
  std::vector<std::int64_t> numbers;
  while (lines_.next_data(fields)) {
    if (fields.empty()) continue;
    const std::int64_t number = integer(fields[0], "the number of a node");
    std::array<double, 3> x{};  // what is not given is zero
    for (std::size_t i = 0; i < 3 && i + 1 < fields.size(); ++i) x[i] = real(fields[i + 1], "a coordinate");
    builder_.add_node(number, x[0] + shift_.x(), x[1] + shift_.y(), x[2], lines_.at());
    if (key.has("NSET")) numbers.push_back(number);
  }
  if (key.has("NSET")) add_numbers(node_sets_.named(name), numbers);
}

void AbaqusReader::elements(const AbaqusKeyword& key) {
  const std::string type = upper(key.value("TYPE"));
  if (type.empty()) builder_.fail(key.at, "*ELEMENT has no TYPE; write for example TYPE=CPS4");
  const std::string name = key.value("ELSET");
  if (key.has("ELSET")) element_sets_.named(name).of_element_line = true;
  if (key.has("INPUT")) lines_.insert(key);
  const std::optional<AbaqusElement> element = abaqus_element(type);
  if (whole_) deck_.elements.push_back({type, place_of(key.at)});
  std::vector<std::string_view> fields;
  std::vector<std::int64_t> numbers, nodes;
  while (lines_.next_data(fields)) {
    if (fields.empty()) continue;
    const FilePlace at = lines_.at();
    const std::int64_t number = integer(fields[0], "the number of an element");
    if (!element && is_discrete_abaqus_element(type)) {
      if (numbers.empty()) {
        builder_.remark(at, fmt::format("elements of type {} have no area and are left out", printable(type)));
      }
      numbers.push_back(number);
      discrete_.push_back(number);
      continue;
    }
    if (!element) {
      builder_.fail(at, fmt::format("cell {}: type {} {}", number, printable(type), abaqus_refusal(type)));
    }
    nodes.clear();
    std::size_t first = 1;
    const auto wanted = static_cast<std::size_t>(element->nodes);
    while (true) {
      for (std::size_t i = first; i < fields.size(); ++i) nodes.push_back(integer(fields[i], "the number of a node"));
      if (nodes.size() >= wanted) break;
      first = 0;
      if (!lines_.next_data(fields)) {
        builder_.fail(at, fmt::format("cell {} has {} nodes, but type {} has {}; the line is truncated, or the type is "
                                      "another",
                                      number, nodes.size(), type, wanted));
      }
    }
    if (nodes.size() > wanted) {
      builder_.fail(at, fmt::format("cell {} has {} nodes, but type {} has {}; correct the type or the line", number,
                                    nodes.size(), type, wanted));
    }
    numbers.push_back(number);
    if (element->family == ElementFamily::line) {
      // Of three nodes the second is the middle one.
      line_elements_.push_back({number, {nodes.front(), nodes.back(), wanted == 3 ? nodes[1] : -1}});
    } else {
      if (wanted == 9) nodes.pop_back();
      builder_.add_cell(abaqus_cell_kind(element->nodes), number, nodes, 0, at);
      cell_numbers_.push_back(number);
      if (whole_) deck_.type_of_cell[number] = static_cast<int>(deck_.elements.size()) - 1;
      shell_.push_back(element->family == ElementFamily::shell);
    }
  }
  if (key.has("ELSET")) add_numbers(element_sets_.named(name), numbers);
}

void AbaqusReader::generate(AbaqusSet& target) {
  std::vector<std::string_view> fields;
  while (lines_.next_data(fields)) {
    if (fields.empty()) continue;
    const std::int64_t first = integer(fields[0], "the first number of GENERATE");
    const std::int64_t last = fields.size() > 1 ? integer(fields[1], "the last number of GENERATE") : first;
    const std::int64_t step = fields.size() > 2 ? integer(fields[2], "the increment of GENERATE") : 1;
    if (first < 0 || last < first || step < 1) {
      builder_.fail(lines_.at(),
                    "GENERATE needs a first number, a last one that is not smaller, and a positive "
                    "increment");
    }
    count_entries((last - first) / step + 1);
    for (std::int64_t number = first; number <= last; number += step) {
      target.numbers.push_back(number);
      if (last - number < step) break;
    }
  }
}

void AbaqusReader::set(const AbaqusKeyword& key, AbaqusSets& sets, const char* parameter) {
  const std::string name = key.value(parameter);
  if (name.empty())
    builder_.fail(key.at, fmt::format("*{} has no name; write *{}, {}=name", parameter, parameter, parameter));
  if (key.has("INPUT")) lines_.insert(key);
  sets.named(name);
  if (key.has("GENERATE")) {
    generate(sets.named(name));
    return;
  }
  if (key.has("ELSET") && parameter == std::string("NSET")) {
    const AbaqusSet* of = element_sets_.find(key.value("ELSET"));
    if (of == nullptr) {
      builder_.fail(key.at,
                    fmt::format("there is no element set '{}' before this line", printable(key.value("ELSET"))));
    }
    const NumberIndex cells(cell_numbers_);
    std::vector<std::int64_t> numbers;
    for (const std::int64_t number : of->numbers) {
      const int cell = cells.find(number);
      if (cell < 0) continue;
      const auto nodes = builder_.cell_nodes(cell);
      numbers.insert(numbers.end(), nodes.begin(), nodes.end());
    }
    add_numbers(sets.named(name), numbers);
    return;
  }
  std::vector<std::string_view> fields;
  while (lines_.next_data(fields)) {
    for (const std::string_view field : fields) {
      if (field.empty()) continue;
      std::int64_t number = 0;
      AbaqusSet& target = sets.named(name);
      if (parse_number(field, number)) {
        add_listed(target, number, &sets == &node_sets_);
      } else if (const AbaqusSet* other = sets.find(std::string(field))) {
        add_numbers(target, other->numbers);
      } else {
        builder_.fail(lines_.at(),
                      fmt::format("'{}' is neither a number nor the name of a set before this line", printable(field)));
      }
    }
  }
}

void AbaqusReader::surface(const AbaqusKeyword& key) {
  const std::string name = key.value("NAME");
  if (name.empty()) builder_.fail(key.at, "*SURFACE has no name; write *SURFACE, NAME=name");
  const std::string type = upper(key.value("TYPE"));
  std::vector<std::string_view> fields;
  if (type == "NODE") {
    node_sets_.named(name);
    while (lines_.next_data(fields)) {
      if (fields.empty()) continue;
      std::int64_t number = 0;
      AbaqusSet& target = node_sets_.named(name);
      if (parse_number(fields[0], number)) {
        add_listed(target, number, true);
      } else if (const AbaqusSet* other = node_sets_.find(std::string(fields[0]))) {
        add_numbers(target, other->numbers);
      } else {
        builder_.fail(lines_.at(), fmt::format("surface '{}': there is no node set '{}' before this line",
                                               printable(name), printable(fields[0])));
      }
    }
    return;
  }
  if (!type.empty() && type != "ELEMENT") return;  // cutting, user and revolved surfaces have no sides of cells
  surfaces_.push_back({name, {}});
  while (lines_.next_data(fields)) {
    if (fields.empty()) continue;
    surfaces_.back().entries.push_back(
        {std::string(fields[0]), fields.size() > 1 ? upper(fields[1]) : std::string(), lines_.at()});
  }
}

void AbaqusReader::section(const AbaqusKeyword& key) {
  if (!key.has("ELSET")) builder_.fail(key.at, fmt::format("*{} has no ELSET; name the elements it is for", key.name));
  sections_.push_back({key.name, key.value("ELSET"), key.value("MATERIAL"), key.at});
  block(key);
}

void AbaqusReader::instance(const AbaqusKeyword& key) {
  if (++instances_ > 1) {
    builder_.fail(key.at, "several instances of parts are not read; write the input file without parts and assemblies");
  }
  std::vector<std::string_view> fields;
  for (int row = 0; lines_.next_data(fields); ++row) {
    if (row > 0) builder_.fail(lines_.at(), "a rotated instance is not read; rotate the part itself");
    if (builder_.nodes() == 0) {
      for (std::size_t i = 0; i < 2 && i < fields.size(); ++i) {
        shift_[static_cast<Eigen::Index>(i)] = real(fields[i], "a translation");
      }
      continue;
    }
    for (const std::string_view field : fields) {
      if (real(field, "a translation") != 0.0) {
        builder_.fail(lines_.at(), "a translated instance is not read; move the part itself");
      }
    }
  }
}

void AbaqusReader::block(const AbaqusKeyword& key) {
  if (!whole_) return;
  DeckBlock read{key.name, key.parameters, place_of(key.at), {}};
  std::vector<std::string_view> fields;
  while (lines_.next_data(fields)) {
    DeckLine line{{fields.begin(), fields.end()}, place_of(lines_.at()), {}};
    const std::string label = fields.size() > 1 ? upper(fields[1]) : "";
    if (key.name == "DLOAD" && label.size() == 2 && label[0] == 'P' && label[1] >= '1' && label[1] <= '4') {
      line.sides = fmt::format("*DLOAD {}", surfaces_.size());
      surfaces_.push_back({line.sides, {{line.fields[0], "S" + label.substr(1), lines_.at()}}});
    }
    read.lines.push_back(std::move(line));
  }
  deck_.blocks.push_back(std::move(read));
}

void AbaqusReader::keyword(const AbaqusKeyword& key) {
  if (key.name == "NODE") return nodes(key);
  if (key.name == "ELEMENT") return elements(key);
  if (key.name == "NSET") return set(key, node_sets_, "NSET");
  if (key.name == "ELSET") return set(key, element_sets_, "ELSET");
  if (key.name == "SURFACE") return surface(key);
  if (key.name == "INCLUDE") return lines_.insert(key);
  if (key.name == "INSTANCE") return instance(key);
  for (const char* section_name : {"SOLIDSECTION", "SHELLSECTION", "MEMBRANESECTION", "SHELLGENERALSECTION",
                                   "BEAMSECTION", "BEAMGENERALSECTION", "TRUSSSECTION"}) {
    if (key.name == section_name) return section(key);
  }
  if (key.name == "PART" && ++parts_ > 1) {
    builder_.fail(key.at, "several parts are not read; write the input file without parts and assemblies");
  }
  for (const char* maker : {"NGEN", "NFILL", "NCOPY", "NMAP", "ELGEN", "ELCOPY", "SYSTEM"}) {
    if (key.name == maker) {
      builder_.fail(key.at, fmt::format("*{} makes nodes or elements and is not read; write them out", key.name));
    }
  }
  block(key);
}

void AbaqusReader::resolve_regions(const NumberIndex& elements) {
  const int cells = static_cast<int>(cell_numbers_.size());
  std::vector<int> regions(cell_numbers_.size(), -1);
  const auto assign = [&](const AbaqusSet& set, bool replace) {
    int region = -1;
    for (const std::int64_t number : set.numbers) {
      const int at = elements.find(number);
      if (at < 0 || at >= cells || (!replace && regions[static_cast<std::size_t>(at)] >= 0)) continue;
      if (region < 0) region = builder_.region(set.name);
      regions[static_cast<std::size_t>(at)] = region;
    }
    return region;
  };
  for (const bool of_element_line : {true, false}) {
    for (const AbaqusSet& set : element_sets_.all()) {
      if (set.of_element_line == of_element_line) assign(set, false);
    }
  }
  for (const Section& section : sections_) {
    const AbaqusSet* set = element_sets_.find(section.set);
    if (set == nullptr) {
      builder_.fail(section.at, fmt::format("*{}: there is no element set '{}'; correct its name", section.keyword,
                                            printable(section.set)));
    }
    for (const std::int64_t number : set->numbers) {
      if (elements.find(number) < cells) continue;  // a cell, or none
      builder_.fail(section.at, fmt::format("*{} makes element {} a truss or beam, which is not read; take it out of "
                                            "the file",
                                            section.keyword, number));
    }
    const int region = assign(*set, true);
    if (region >= 0) builder_.set_material(region, section.material);
  }
  for (int cell = 0; cell < cells; ++cell) {
    int region = regions[static_cast<std::size_t>(cell)];
    if (region < 0) region = builder_.region("elements");
    builder_.set_region(cell, region);
  }
}

void AbaqusReader::resolve_sets(const NumberIndex& elements) {
  const int cells = static_cast<int>(cell_numbers_.size());
  for (const AbaqusSet& set : element_sets_.all()) {
    int cell_set = -1, facet_set = -1;
    for (const std::int64_t number : set.numbers) {
      const int at = elements.find(number);
      if (at < 0) continue;
      if (at < cells) {
        if (cell_set < 0) cell_set = builder_.cell_set(set.name);
        builder_.add_cell_to_set(cell_set, at);
      } else {
        if (facet_set < 0) facet_set = builder_.facet_set(set.name);
        builder_.add_facet(facet_set, line_elements_[static_cast<std::size_t>(at - cells)].nodes);
      }
    }
  }
  for (const AbaqusSet& set : node_sets_.all()) {
    const int node_set = builder_.node_set(set.name);
    for (const std::int64_t number : set.numbers) builder_.add_node_to_set(node_set, number);
  }
}

void AbaqusReader::resolve_surfaces(const NumberIndex& elements) {
  const int cells = static_cast<int>(cell_numbers_.size());
  for (const Surface& surface : surfaces_) {
    const int set = builder_.facet_set(surface.name);
    for (const SurfaceEntry& entry : surface.entries) {
      // Solids: S1 is side 12. Shells: S1 and S2 are their faces, S3 (CalculiX) or E1 (Abaqus) is side 12.
      const std::string& side = entry.side;
      const bool face =
          side == "SPOS" || side == "SNEG" || side == "SP" || side == "SN" || side == "NEG" || side == "POS";
      const bool numbered = side.size() == 2 && (side[0] == 'S' || side[0] == 'E') && side[1] >= '1' && side[1] <= '6';
      if (!side.empty() && !face && !numbered) {
        builder_.fail(entry.at, fmt::format("surface '{}': '{}' is no side of a plane element; sides are S1 to S4",
                                            printable(surface.name), printable(side)));
      }
      std::vector<std::int64_t> one;
      const std::vector<std::int64_t>* numbers = &one;
      std::int64_t number = 0;
      if (parse_number(entry.of, number)) {
        one.push_back(number);
      } else if (const AbaqusSet* of = element_sets_.find(entry.of)) {
        numbers = &of->numbers;
      } else {
        builder_.fail(entry.at, fmt::format("surface '{}': there is no element set '{}'; correct its name",
                                            printable(surface.name), printable(entry.of)));
      }
      count_entries(static_cast<std::int64_t>(numbers->size()));
      for (const std::int64_t element : *numbers) {
        const int at = elements.find(element);
        if (at < 0) {
          builder_.fail(entry.at,
                        fmt::format("surface '{}': element {} is not in the file", printable(surface.name), element));
        }
        if (at >= cells || face) continue;
        if (side.empty()) {
          builder_.add_free_sides(set, at);
          continue;
        }
        const bool shell = shell_[static_cast<std::size_t>(at)] && side[0] == 'S';
        const int position = side[1] - '1' - (shell ? 2 : 0);
        if (position < 0) continue;
        if (!builder_.add_side(set, at, position)) {
          builder_.fail(entry.at,
                        fmt::format("surface '{}': element {} has no side {}", printable(surface.name), element, side));
        }
      }
    }
  }
}

ImportedMesh AbaqusReader::read() {
  AbaqusKeyword key;
  while (lines_.next_keyword(key)) keyword(key);
  if (builder_.cells() == 0) return builder_.finish();  // says that the mesh is empty

  std::vector<std::int64_t> numbers = cell_numbers_;
  for (const LineElement& line : line_elements_) numbers.push_back(line.number);
  const NumberIndex elements(numbers);
  if (const auto& repeated = elements.repeated()) {
    const int second = std::min(repeated->second, static_cast<int>(cell_numbers_.size()) - 1);
    builder_.fail(builder_.cell_place(second),
                  fmt::format("element {} is defined twice; give each element its own number",
                              numbers[static_cast<std::size_t>(repeated->second)]));
  }
  const NumberIndex nodes(builder_.node_numbers());
  const NumberIndex discrete(discrete_);
  for (const Listed& listed : listed_) {
    const bool known = listed.node ? nodes.find(listed.number) >= 0
                                   : elements.find(listed.number) >= 0 || discrete.find(listed.number) >= 0;
    if (known) continue;
    builder_.remark(listed.at, fmt::format("a set names {} {}, which is not in the file",
                                           listed.node ? "node" : "element", listed.number));
  }
  resolve_regions(elements);
  resolve_sets(elements);
  resolve_surfaces(elements);
  return builder_.finish();
}

AbaqusDeck AbaqusReader::read_deck() {
  whole_ = true;
  deck_.mesh = read();
  deck_.node_numbers = builder_.take_node_numbers();
  return std::move(deck_);
}

}  // namespace

AbaqusDeck parse_abaqus_deck(std::string_view text, const std::string& file, const ReadInclude& read_include) {
  return AbaqusReader(text, file, read_include).read_deck();
}

ImportedMesh parse_abaqus(std::string_view text, const std::string& file, const ReadInclude& read_include) {
  return AbaqusReader(text, file, read_include).read();
}

}  // namespace scabo::files
