// Parts and instances: the lines of a part are kept and read once for each of its instances.
#include <fmt/format.h>

#include <map>

#include "scabo/files/abaqus_reader.hpp"

namespace scabo::files {

void AbaqusReader::part(const AbaqusKeyword& key) {
  if (instance_ != AbaqusInstances::none) builder_.fail(key.at, "*PART stands within an *INSTANCE; end this before");
  const std::string name = key.value("NAME");
  for (const Part& other : parts_)
    if (upper(other.name) == upper(name))
      builder_.fail(key.at, fmt::format("there are two parts '{}'; give each its own name", printable(name)));
  const RecordedLines lines = lines_.record_until("ENDPART");
  if (!lines) builder_.fail(key.at, fmt::format("part '{}' has no *END PART; add it", printable(name)));
  parts_.push_back({name, lines});
}

/// Of the data lines of *INSTANCE: a translation, then two points of an axis and an angle in degrees.
Placement AbaqusReader::placement() {
  Placement placement;
  std::vector<std::string_view> fields;
  for (int row = 0; next_data(fields); ++row) {
    std::array<double, 7> x{};
    if (row > 1 || fields.size() > (row == 0 ? 3u : 7u))
      builder_.fail(lines_.at(), "*INSTANCE takes a line with a translation and one with an axis and an angle");
    for (std::size_t i = 0; i < fields.size(); ++i) x[i] = real(fields[i], "a number of *INSTANCE");
    if (row == 0) {
      placement.shift = {x[0], x[1], x[2]};
      continue;
    }
    placement.about = {x[0], x[1], x[2]};
    const auto turn = turn_about(placement.about, {x[3], x[4], x[5]}, x[6]);
    if (!turn) builder_.fail(lines_.at(), "the two points of the axis of *INSTANCE are one; correct them");
    placement.turn = *turn;
  }
  return placement;
}

void AbaqusReader::instance(const AbaqusKeyword& key) {
  if (instance_ != AbaqusInstances::none)
    builder_.fail(key.at, "*INSTANCE stands within another one; end that with *END INSTANCE");
  const std::string name = key.value("NAME"), of = key.value("PART");
  if (name.empty()) builder_.fail(key.at, "*INSTANCE has no name; write *INSTANCE, NAME=name, PART=part");
  if (key.has("INSTANCE") || key.has("LIBRARY"))
    builder_.fail(key.at, fmt::format("*INSTANCE with {} is from the results of another run and is not read; write the "
                                      "part out",
                                      key.has("LIBRARY") ? "LIBRARY" : "INSTANCE"));
  if (instances_.find(name) != AbaqusInstances::none)
    builder_.fail(key.at, fmt::format("there are two instances '{}'; give each its own name", printable(name)));
  const Part* part = nullptr;
  for (const Part& known : parts_)
    if (upper(known.name) == upper(of)) part = &known;
  if (part == nullptr)
    builder_.fail(key.at, fmt::format("there is no part '{}' before this line; correct its name", printable(of)));
  instance_ = instances_.add(name, placement());
  instance_at_ = key.at;
  lines_.insert(part->lines);
}

void AbaqusReader::end_instance(const AbaqusKeyword& key) {
  if (instance_ == AbaqusInstances::none) builder_.fail(key.at, "*END INSTANCE ends none; add *INSTANCE before it");
  instance_ = AbaqusInstances::none;
}

/// A file with one part and no assembly is the mesh of this part.
void AbaqusReader::read_lone_part() {
  if (instances_.count() > 0 || parts_.empty()) return;
  if (parts_.size() > 1)
    builder_.fail(FilePlace{}, "the file has several parts and no *INSTANCE of them; add an *ASSEMBLY with instances");
  lines_.insert(parts_.front().lines);
  read_keywords();
}

/// In a deck, and where there are several, an instance is a set of its elements.
void AbaqusReader::set_of_each_instance() {
  if (!whole_ && instances_.count() < 2) return;
  for (std::size_t i = 0; i < instances_.count(); ++i) {
    int set = -1;
    for (std::size_t c = 0; c < cell_numbers_.size(); ++c) {
      if (cell_numbers_[c] / AbaqusInstances::spacing != static_cast<std::int64_t>(i) + 1) continue;
      if (set < 0) set = builder_.cell_set(instances_.names()[i]);
      builder_.add_cell_to_set(set, static_cast<int>(c));
    }
  }
}

/// `Instance.Set` becomes `Set` where no other set has this name.
void AbaqusReader::name_small(ImportedMesh& mesh) {
  const auto shorten = [this](const std::vector<std::string*>& names) {
    std::map<std::string, int> count;
    const auto short_name = [this](const std::string& name) {
      const auto of = instances_.split(name);
      return of ? of->second : name;
    };
    for (const std::string* name : names) ++count[upper(short_name(*name))];
    for (std::string* name : names)
      if (count[upper(short_name(*name))] == 1) *name = short_name(*name);
  };
  const auto shorten_all = [&shorten](auto& sets) {
    std::vector<std::string*> names;
    for (auto& set : sets) names.push_back(&set.name);
    shorten(names);
  };
  shorten_all(mesh.facet_sets);
  shorten_all(mesh.node_sets);
  shorten_all(mesh.cell_sets);
  std::vector<std::string*> regions;
  for (std::string& name : mesh.regions) regions.push_back(&name);
  shorten(regions);
}

void AbaqusReader::number_small(ImportedMesh& mesh) {
  SmallNumbers nodes(instances_.count()), elements(instances_.count());
  for (const std::int64_t number : deck_.node_numbers) nodes.add(number);
  for (const ImportedCell& cell : mesh.cells) elements.add(cell.number);
  for (ImportedCell& cell : mesh.cells) cell.number = static_cast<long>(elements(cell.number));
  for (std::int64_t& number : deck_.node_numbers) number = nodes(number);
  std::map<std::int64_t, int> types;
  for (const auto& [number, type] : deck_.type_of_cell) types[elements(number)] = type;
  deck_.type_of_cell = std::move(types);
  for (std::size_t i = 0; i < instances_.count(); ++i) {
    const int at = static_cast<int>(i);
    deck_.instances.push_back({instances_.names()[i],
                               instances_.placement(at).turn,
                               {nodes.offset(at), nodes.largest(at)},
                               {elements.offset(at), elements.largest(at)}});
  }
}

}  // namespace scabo::files
