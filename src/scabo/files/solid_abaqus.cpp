#include "scabo/files/solid_abaqus.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <map>
#include <set>

#include "scabo/base/cell_topology.hpp"
#include "scabo/files/abaqus_lines.hpp"
#include "scabo/files/abaqus_sets.hpp"
#include "scabo/files/solid_builder.hpp"
#include "scabo/files/split_solid.hpp"

namespace scabo::files {

namespace {

/// Nodes of an element type; 0 for one that is not read.
std::size_t nodes_of_solid(const std::string& type) {
  if (type == "C3D4") return 4;
  if (type == "C3D10" || type == "C3D10M") return 10;
  return nodes_of_split(type).value_or(0);
}

/// Elements that bound solids in files of Gmsh, or join nodes.
bool is_not_solid(const std::string& type) {
  for (const char* start : {"CPS", "CPE", "S", "M3D", "T3D", "T2D", "B2", "B3", "DASHPOT", "GAP", "MASS", "DCOUP"})
    if (type.rfind(start, 0) == 0 && type.rfind("SC", 0) != 0) return true;
  return false;
}

class SolidReader {
 public:
  SolidReader(std::string_view text, const std::string& file, const ReadInclude& read_include, Bricks bricks)
      : builder_(file),
        solid_(builder_, SolidBuilder::TurnedCells::refused, bricks),
        lines_(text, file, read_include, builder_),
        most_entries_(1'000'000 + 20 * static_cast<std::int64_t>(text.size())),
        bricks_(bricks) {}

  ImportedSolidMesh read();
  AbaqusDeck read_deck();

 private:
  struct SurfaceEntry {
    std::string of, side;  // element or set
    FilePlace at;
  };
  struct Surface {
    std::string name;
    std::vector<SurfaceEntry> entries;
  };

  void keyword(const AbaqusKeyword& key);
  void nodes(const AbaqusKeyword& key);
  void elements(const AbaqusKeyword& key);
  void set(const AbaqusKeyword& key, AbaqusSets& sets, const char* parameter);
  void surface(const AbaqusKeyword& key);
  void nodes_of_surface(const std::string& name);
  void block(const AbaqusKeyword& key);
  bool next_data(std::vector<std::string_view>& fields);
  std::int64_t integer(std::string_view field, const char* what) const;
  void add(AbaqusSet& target, std::int64_t number);
  void add_all(AbaqusSet& target, std::vector<std::int64_t> numbers);
  void hand_over_sets();
  void hand_over_sides(const Surface& surface, const NumberIndex& cells);
  [[noreturn]] void fail_on_other_type(const Surface& surface, const SurfaceEntry& entry,
                                       const std::string& type) const;

  MeshBuilder builder_;  // knows the files
  SolidBuilder solid_;
  AbaqusLines lines_;
  std::int64_t most_entries_, entries_ = 0;  // of all sets together: sets of sets grow faster than the file
  Bricks bricks_;
  AbaqusSets node_sets_, element_sets_;
  struct Whole {
    std::vector<std::int64_t> nodes;
    SolidBuilder::CellRange parts;
  };
  std::map<std::int64_t, Whole> split_;                     // by number
  std::map<std::int64_t, std::string> other_types_;         // of elements that are left out, by number
  std::map<std::string, std::string> types_of_other_sets_;  // by the name of their set in upper case
  std::map<std::int64_t, std::size_t> nodes_of_kept_;       // of cells that are not divided, by number
  std::vector<Surface> surfaces_;
  std::vector<std::string> remarks_;
  std::set<std::string> left_out_;  // types
  bool whole_ = false;              // what is not part of the mesh is kept
  AbaqusDeck deck_;
};

bool SolidReader::next_data(std::vector<std::string_view>& fields) {
  do {
    if (!lines_.next_data(fields)) return false;
  } while (fields.empty());
  return true;
}

std::int64_t SolidReader::integer(std::string_view field, const char* what) const {
  std::int64_t value = 0;
  if (!parse_number(field, value)) builder_.fail(lines_.at(), fmt::format("'{}' is not {}", printable(field), what));
  return value;
}

void SolidReader::add(AbaqusSet& target, std::int64_t number) {
  if (++entries_ > most_entries_)
    builder_.fail(lines_.at(), "the sets of the file are too many and too large to be meant");
  target.numbers.push_back(number);
}

void SolidReader::add_all(AbaqusSet& target, std::vector<std::int64_t> numbers) {
  for (const std::int64_t number : numbers) add(target, number);
}

void SolidReader::nodes(const AbaqusKeyword& key) {
  if (key.has("SYSTEM") && upper(key.value("SYSTEM")) != "R")
    builder_.fail(key.at, "coordinates in a cylindrical or spherical SYSTEM are not read; write rectangular ones");
  if (key.has("INPUT")) lines_.insert(key);
  std::vector<std::string_view> fields;
  std::vector<std::int64_t> numbers;
  while (next_data(fields)) {
    numbers.push_back(integer(fields[0], "the number of a node"));
    std::array<double, 3> x{};  // what is not given is zero
    for (std::size_t k = 1; k <= 3; ++k)
      if (k < fields.size() && !fields[k].empty() && !parse_number(fields[k], x[k - 1]))
        builder_.fail(lines_.at(), fmt::format("'{}' is not a coordinate", printable(fields[k])));
    solid_.add_node(numbers.back(), x[0], x[1], x[2], lines_.at());
    if (whole_) deck_.loose_nodes[numbers.back()] = Eigen::Vector3d(x.data());
  }
  if (key.has("NSET")) add_all(node_sets_.named(key.value("NSET")), std::move(numbers));
}

void SolidReader::elements(const AbaqusKeyword& key) {
  const std::string type = upper(key.value("TYPE"));
  if (type.empty()) builder_.fail(key.at, "*ELEMENT has no TYPE; write for example TYPE=C3D10");
  const std::size_t wanted = nodes_of_solid(type);
  if (wanted == 0 && !is_not_solid(type))
    builder_.fail(key.at, fmt::format("elements of type {} are not read; use C3D4, C3D6, C3D8, C3D10, C3D15 or "
                                      "C3D20, and take others out of the file",
                                      printable(type)));
  if (wanted == 0 && left_out_.insert(type).second)
    remarks_.push_back(fmt::format("{}:{}: elements of type {} are no solids and are left out", builder_.file(key.at),
                                   key.at.line, printable(type)));
  if (key.has("INPUT")) lines_.insert(key);
  std::vector<std::string_view> fields;
  std::vector<std::int64_t> numbers;
  while (next_data(fields)) {
    if (wanted == 0) {
      std::int64_t other = 0;
      if (parse_number(fields[0], other)) other_types_.try_emplace(other, type);
      continue;
    }
    const FilePlace at = lines_.at();
    std::vector<std::int64_t> nodes;
    const std::int64_t number = integer(fields[0], "the number of an element");
    for (std::size_t first = 1; true; first = 0) {
      for (std::size_t i = first; i < fields.size(); ++i) nodes.push_back(integer(fields[i], "the number of a node"));
      if (nodes.size() >= wanted || !next_data(fields)) break;
    }
    if (nodes.size() != wanted)
      builder_.fail(at, fmt::format("cell {} has {} nodes, but type {} has {}; correct the type or the line", number,
                                    nodes.size(), type, wanted));
    if (const auto least = std::min_element(nodes.begin(), nodes.end()); *least < 1)
      builder_.fail(at, fmt::format("cell {} has the node {}; numbers of nodes are positive", number, *least));
    numbers.push_back(number);
    const SolidBuilder::CellRange cells = solid_.add_cell(number, nodes, at);
    if (nodes_of_split(type) && bricks_ == Bricks::divided)
      split_.try_emplace(number, Whole{nodes, cells});
    else
      nodes_of_kept_[number] = nodes.size();
  }
  if (whole_ && wanted > 0) {
    deck_.elements.push_back({type, {builder_.file(key.at), key.at.line}});
    for (const std::int64_t number : numbers) deck_.type_of_cell[number] = static_cast<int>(deck_.elements.size()) - 1;
  }
  if (key.has("ELSET") && wanted == 0) types_of_other_sets_.try_emplace(upper(key.value("ELSET")), type);
  if (key.has("ELSET") && wanted > 0) add_all(element_sets_.named(key.value("ELSET")), std::move(numbers));
}

void SolidReader::set(const AbaqusKeyword& key, AbaqusSets& sets, const char* parameter) {
  const std::string name = key.value(parameter);
  if (name.empty())
    builder_.fail(key.at, fmt::format("*{} has no name; write *{}, {}=name", parameter, parameter, parameter));
  if (key.has("INPUT")) lines_.insert(key);
  sets.named(name);
  std::vector<std::string_view> fields;
  while (next_data(fields)) {
    if (key.has("GENERATE")) {
      const std::int64_t first = integer(fields[0], "the first number of GENERATE");
      const std::int64_t last = fields.size() > 1 ? integer(fields[1], "the last number of GENERATE") : first;
      const std::int64_t step = fields.size() > 2 ? integer(fields[2], "the increment of GENERATE") : 1;
      if (first < 0 || last < first || step < 1)
        builder_.fail(lines_.at(),
                      "GENERATE needs a first number, a last one that is not smaller, and a positive increment");
      for (std::int64_t k = 0; k <= (last - first) / step; ++k) add(sets.named(name), first + k * step);
      continue;
    }
    for (const std::string_view field : fields) {
      if (field.empty()) continue;
      const std::string entry = without_quotes(field);
      std::int64_t number = 0;
      if (parse_number(std::string_view(entry), number)) {
        add(sets.named(name), number);
      } else if (const AbaqusSet* other = sets.find(entry)) {
        add_all(sets.named(name), std::vector(other->numbers));
      } else {
        builder_.fail(lines_.at(),
                      fmt::format("'{}' is neither a number nor the name of a set before this line", printable(field)));
      }
    }
  }
}

void SolidReader::surface(const AbaqusKeyword& key) {
  const std::string name = key.value("NAME"), type = upper(key.value("TYPE"));
  if (name.empty()) builder_.fail(key.at, "*SURFACE has no name; write *SURFACE, NAME=name");
  if (whole_ && type == "NODE") return nodes_of_surface(name);
  if (!type.empty() && type != "ELEMENT") {
    remarks_.push_back(fmt::format("{}:{}: the surface '{}' of TYPE={} has no sides of cells and is left out",
                                   builder_.file(key.at), key.at.line, printable(name), printable(type)));
    return;
  }
  surfaces_.push_back({name, {}});
  std::vector<std::string_view> fields;
  while (next_data(fields))
    surfaces_.back().entries.push_back(
        {without_quotes(fields[0]), fields.size() > 1 ? upper(fields[1]) : std::string(), lines_.at()});
}

/// Of a deck: those of sets and numbers, on which contact may act.
void SolidReader::nodes_of_surface(const std::string& name) {
  std::vector<std::string_view> fields;
  node_sets_.named(name);
  while (next_data(fields)) {
    const std::string entry = without_quotes(fields[0]);
    std::int64_t number = 0;
    if (parse_number(std::string_view(entry), number))
      add(node_sets_.named(name), number);
    else if (const AbaqusSet* other = node_sets_.find(entry))
      add_all(node_sets_.named(name), std::vector(other->numbers));
    else
      builder_.fail(lines_.at(), fmt::format("surface '{}': there is no node set '{}'; correct its name",
                                             printable(name), printable(entry)));
  }
}

/// What is not part of the mesh, of a deck. Sides that *DLOAD names become a surface.
void SolidReader::block(const AbaqusKeyword& key) {
  if (!whole_) return;
  if (key.has("INPUT")) lines_.insert(key);
  std::vector<std::string_view> fields;
  while (next_data(fields)) {
    DeckLine line{{}, {builder_.file(lines_.at()), lines_.at().line}, {}};
    for (const std::string_view field : fields)
      line.fields.push_back(key.name == "HEADING" ? std::string(field) : without_quotes(field));
    const std::string label = fields.size() > 1 ? upper(fields[1]) : "";
    if (key.name == "DLOAD" && label.size() == 2 && label[0] == 'P' && label[1] >= '1' && label[1] <= '6') {
      line.sides = fmt::format("*DLOAD {}", surfaces_.size());
      surfaces_.push_back({line.sides, {{line.fields[0], "S" + label.substr(1), lines_.at()}}});
    }
    deck_.blocks.back().lines.push_back(std::move(line));
  }
  deck_.blocks.back().has_data = !deck_.blocks.back().lines.empty();
}

void SolidReader::keyword(const AbaqusKeyword& key) {
  if (whole_)
    deck_.blocks.push_back({key.name, key.written, key.parameters, {builder_.file(key.at), key.at.line}, {}, true, -1});
  if (key.name == "NODE") return nodes(key);
  if (key.name == "ELEMENT") return elements(key);
  if (key.name == "NSET") return set(key, node_sets_, "NSET");
  if (key.name == "ELSET") return set(key, element_sets_, "ELSET");
  if (key.name == "SURFACE") return surface(key);
  for (const char* assembly : {"PART", "INSTANCE"})
    if (key.name == assembly)
      builder_.fail(key.at,
                    "parts and instances of solids are not read; save the mesh without them, a file for a body");
  for (const char* maker : {"NGEN", "NFILL", "NCOPY", "NMAP", "ELGEN", "ELCOPY", "SYSTEM"})
    if (key.name == maker)
      builder_.fail(key.at, fmt::format("{} makes nodes or elements and is not read; write them out", key.written));
  block(key);
}

void SolidReader::fail_on_other_type(const Surface& surface, const SurfaceEntry& entry, const std::string& type) const {
  builder_.fail(entry.at,
                fmt::format("surface '{}': '{}' has elements of type {}, which are no solids and have no sides "
                            "in space; make the part of solid elements, or take the surface out",
                            printable(surface.name), printable(entry.of), printable(type)));
}

void SolidReader::hand_over_sides(const Surface& surface, const NumberIndex& cells) {
  const int set = solid_.side_set(surface.name);
  for (const SurfaceEntry& entry : surface.entries) {
    const bool is_side = entry.side.size() == 2 && entry.side[0] == 'S' && entry.side[1] >= '1' && entry.side[1] <= '6';
    const auto no_side = [&] {
      builder_.fail(entry.at, fmt::format("surface '{}': '{}' is no side of this element; write S1 to S4 of a "
                                          "tetrahedron, S1 to S5 of a wedge or S1 to S6 of a hexahedron",
                                          printable(surface.name), printable(entry.side)));
    };
    std::vector<std::int64_t> numbers(1, 0);
    if (!parse_number(std::string_view(entry.of), numbers[0])) {
      const AbaqusSet* of = element_sets_.find(entry.of);
      const auto other = types_of_other_sets_.find(upper(entry.of));
      if (of == nullptr && other != types_of_other_sets_.end()) fail_on_other_type(surface, entry, other->second);
      if (of == nullptr)
        builder_.fail(entry.at, fmt::format("surface '{}': there is no element set '{}'; correct its name",
                                            printable(surface.name), printable(entry.of)));
      numbers = of->numbers;
    }
    for (const std::int64_t number : numbers)
      if (const auto other = other_types_.find(number);
          other != other_types_.end() && !split_.contains(number) && cells.find(number) < 0)
        fail_on_other_type(surface, entry, other->second);
    if (!is_side) no_side();
    for (const std::int64_t number : numbers) {
      if (const auto whole = split_.find(number); whole != split_.end()) {
        const bool wedge = whole->second.nodes.size() == 6 || whole->second.nodes.size() == 15;
        if (wedge && entry.side[1] == '6') no_side();
        for (const std::vector<std::int64_t>& corners : triangles_of_side(whole->second.nodes, entry.side[1] - '0'))
          solid_.add_facet(set, corners);
        continue;
      }
      const SolidSide side{cells.find(number), entry.side[1] - '1'};
      const auto kept = nodes_of_kept_.find(number);
      if (entry.side[1] > '4' && kept == nodes_of_kept_.end()) no_side();
      if (side.cell < 0)
        builder_.fail(entry.at, fmt::format("surface '{}': there is no cell {}; correct its number",
                                            printable(surface.name), number));
      if (static_cast<std::size_t>(side.side) >= CellTopology::of(kept->second).sides.size()) no_side();
      solid_.add_side(set, side);
    }
  }
}

void SolidReader::hand_over_sets() {
  const NumberIndex cells = solid_.cell_index();
  for (const AbaqusSet& set : node_sets_.all()) {
    const int to = solid_.node_set(set.name);
    for (const std::int64_t number : set.numbers) solid_.add_node_to_set(to, number);
  }
  for (const AbaqusSet& set : element_sets_.all()) {
    const int to = solid_.cell_set(set.name);
    for (const std::int64_t number : set.numbers) {
      const auto whole = split_.find(number);
      if (whole != split_.end())
        solid_.add_cells_to_set(to, whole->second.parts);
      else if (const int cell = cells.find(number); cell >= 0)
        solid_.add_cell_to_set(to, cell);
    }
  }
  for (const Surface& surface : surfaces_) hand_over_sides(surface, cells);
}

ImportedSolidMesh SolidReader::read() {
  AbaqusKeyword key;
  while (lines_.next_keyword(key)) keyword(key);
  if (solid_.cells() == 0)
    fail_in_file(builder_.file({}), 0, 0,
                 "the file has no solid elements; save the mesh with elements C3D4, C3D8, C3D10 or C3D20");
  hand_over_sets();
  ImportedSolidMesh mesh = solid_.finish();
  mesh.remarks.insert(mesh.remarks.begin(), remarks_.begin(), remarks_.end());
  return mesh;
}

AbaqusDeck SolidReader::read_deck() {
  whole_ = true;
  ImportedSolidMesh solid = read();
  deck_.node_numbers = solid_.kept_numbers();
  for (const std::int64_t number : deck_.node_numbers) deck_.loose_nodes.erase(number);
  for (const AbaqusSet& set : node_sets_.all())
    for (const std::int64_t number : set.numbers)
      if (deck_.loose_nodes.contains(number)) deck_.loose_sets[upper(set.name)].push_back(number);
  deck_.mesh.node_sets = solid.node_sets;
  deck_.mesh.cell_sets = solid.cell_sets;
  deck_.mesh.remarks = solid.remarks;
  for (const ImportedSolidCell& cell : solid.cells) {
    deck_.mesh.cells.emplace_back();
    deck_.mesh.cells.back().number = cell.number;
  }
  for (const SolidSideSet& set : solid.side_sets) {
    FacetSet& facets = deck_.mesh.facet_sets.emplace_back();
    facets.name = set.name;
    for (const SolidSide& side : set.sides) facets.facets.push_back(facet_of_solid(side));
  }
  deck_.solid = std::move(solid);
  return std::move(deck_);
}

}  // namespace

bool is_solid_deck(std::string_view text, const std::string& file, const ReadInclude& read_include) {
  MeshBuilder builder(file);
  AbaqusLines lines(text, file, read_include, builder);
  AbaqusKeyword key;
  while (lines.next_keyword(key))
    if (key.name == "ELEMENT" && upper(key.value("TYPE")).starts_with("C3D")) return true;
  return false;
}

AbaqusDeck parse_solid_deck(std::string_view text, const std::string& file, const ReadInclude& read_include) {
  return SolidReader(text, file, read_include, Bricks::divided).read_deck();
}

ImportedSolidMesh parse_solid_abaqus(std::string_view text, const std::string& file, const ReadInclude& read_include,
                                     Bricks bricks) {
  return SolidReader(text, file, read_include, bricks).read();
}

}  // namespace scabo::files
