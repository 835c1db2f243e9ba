// What needs all nodes and elements of the file: regions, sets and surfaces.
#include <fmt/format.h>

#include <algorithm>
#include <map>

#include "scabo/files/abaqus_reader.hpp"

namespace scabo::files {

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
    const AbaqusSet* set = set_in(element_sets_, section.set, AbaqusInstances::none);
    if (set == nullptr)
      builder_.fail(section.at, fmt::format("{}: there is no element set '{}'; correct its name", section.keyword,
                                            printable(section.set)));
    for (const std::int64_t number : set->numbers) {
      if (elements.find(number) < cells) continue;  // a cell, or none
      builder_.fail(section.at, fmt::format("{} makes element {} a truss or beam, which is not read; take it out of "
                                            "the file",
                                            section.keyword, number % AbaqusInstances::spacing));
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

void AbaqusReader::resolve_entry(int set, const Surface& surface, const SurfaceEntry& entry,
                                 const NumberIndex& elements) {
  // Solids: S1 is side 12. Shells: S1 and S2 are their faces, S3 (CalculiX) or E1 (Abaqus) is side 12.
  const std::string& side = entry.side;
  const bool face = side == "SPOS" || side == "SNEG" || side == "SP" || side == "SN" || side == "NEG" || side == "POS";
  const bool numbered = side.size() == 2 && (side[0] == 'S' || side[0] == 'E') && side[1] >= '1' && side[1] <= '6';
  if (!side.empty() && !face && !numbered)
    builder_.fail(entry.at, fmt::format("{}: '{}' is no side of a plane element; sides are S1 to S4", surface.written,
                                        printable(side)));
  if (entry.of.empty())
    builder_.fail(entry.at, fmt::format("{}: the line names no element or element set; add it", surface.written));
  std::vector<std::int64_t> numbers;
  if (const auto number = number_in(entry.of, entry.instance)) {
    numbers.push_back(*number);
  } else if (const AbaqusSet* of = set_in(element_sets_, entry.of, entry.instance)) {
    numbers = of->numbers;
  } else {
    builder_.fail(entry.at, fmt::format("{}: there is no element set '{}'; correct its name", surface.written,
                                        printable(entry.of)));
  }
  count_entries(static_cast<std::int64_t>(numbers.size()));
  for (const std::int64_t element : numbers) {
    const int at = elements.find(element);
    if (at < 0)
      builder_.fail(entry.at, fmt::format("{}: element {} is not in the file", surface.written,
                                          element % AbaqusInstances::spacing));
    if (at >= static_cast<int>(cell_numbers_.size()) || face) continue;
    if (side.empty()) {
      builder_.add_free_sides(set, at);
      continue;
    }
    const bool shell = shell_[static_cast<std::size_t>(at)] && side[0] == 'S';
    const int position = side[1] - '1' - (shell ? 2 : 0);
    if (position >= 0 && !builder_.add_side(set, at, position))
      builder_.fail(entry.at, fmt::format("{}: element {} has no side {}", surface.written,
                                          element % AbaqusInstances::spacing, side));
  }
}

void AbaqusReader::resolve_surfaces(const NumberIndex& elements) {
  for (const Surface& surface : surfaces_) {
    const int set = builder_.facet_set(surface.name);
    for (const SurfaceEntry& entry : surface.entries) resolve_entry(set, surface, entry, elements);
  }
}

void AbaqusReader::tell_what_is_not_there(const NumberIndex& elements) {
  const NumberIndex nodes(builder_.node_numbers());
  const NumberIndex discrete(discrete_);
  for (const Listed& listed : listed_) {
    const bool known = listed.node ? nodes.find(listed.number) >= 0
                                   : elements.find(listed.number) >= 0 || discrete.find(listed.number) >= 0;
    if (known) continue;
    builder_.remark(listed.at, fmt::format("a set names {} {}, which is not in the file",
                                           listed.node ? "node" : "element", listed.number % AbaqusInstances::spacing));
  }
}

ImportedMesh AbaqusReader::read() {
  read_keywords();
  if (instance_ != AbaqusInstances::none) builder_.fail(instance_at_, "this *INSTANCE has no *END INSTANCE; add it");
  read_lone_part();
  if (builder_.cells() == 0) return builder_.finish();  // says that the mesh is empty

  std::vector<std::int64_t> numbers = cell_numbers_;
  for (const LineElement& line : line_elements_) numbers.push_back(line.number);
  const NumberIndex elements(numbers);
  if (const auto& repeated = elements.repeated()) {
    const int second = std::min(repeated->second, static_cast<int>(cell_numbers_.size()) - 1);
    builder_.fail(builder_.cell_place(second),
                  fmt::format("element {} is defined twice; give each element its own number",
                              numbers[static_cast<std::size_t>(repeated->second)] % AbaqusInstances::spacing));
  }
  tell_what_is_not_there(elements);
  resolve_regions(elements);
  resolve_sets(elements);
  resolve_surfaces(elements);
  set_of_each_instance();
  builder_.name_copies(AbaqusInstances::spacing, instances_.names());
  ImportedMesh mesh = builder_.finish();
  deck_.node_numbers = builder_.take_node_numbers();
  number_small(mesh);
  if (!whole_) name_small(mesh);
  return mesh;
}

AbaqusDeck AbaqusReader::read_deck() {
  whole_ = true;
  deck_.mesh = read();
  return std::move(deck_);
}

AbaqusDeck parse_abaqus_deck(std::string_view text, const std::string& file, const ReadInclude& read_include) {
  return AbaqusReader(text, file, read_include).read_deck();
}

ImportedMesh parse_abaqus(std::string_view text, const std::string& file, const ReadInclude& read_include,
                          std::vector<std::string>* types) {
  AbaqusReader reader(text, file, read_include);
  ImportedMesh mesh = reader.read();
  if (types) *types = reader.types();
  return mesh;
}

}  // namespace scabo::files
