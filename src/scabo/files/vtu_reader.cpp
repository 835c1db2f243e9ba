// The format: VTK user's guide, "VTK file formats", XML file formats.
#include "scabo/files/vtu_reader.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cstring>
#include <map>
#include <set>

#include "scabo/files/text_cursor.hpp"

namespace scabo::files {

namespace {

constexpr std::size_t most_values = 2'000'000'000;
constexpr std::size_t most_set_values = 1000;  // more different values are numbers of cells, not of sets

}  // namespace

int VtuReader::line_at(std::size_t offset) const {
  const auto end = xml_.begin() + static_cast<std::ptrdiff_t>(std::min(offset, xml_.size()));
  return 1 + static_cast<int>(std::count(xml_.begin(), end, '\n'));
}

void VtuReader::fail(const pugi::xml_node& node, const std::string& message) const {
  const std::ptrdiff_t offset = node.offset_debug();
  fail_in_file(file_, offset < 0 ? 0 : line_at(static_cast<std::size_t>(offset)), 1, message);
}

/// Raw bytes are no XML: takes what stands between `_` and the last end tag of AppendedData out of the text.
void VtuReader::cut_appended() {
  xml_ = bytes_;
  const auto start = bytes_.find("<AppendedData");
  if (start == std::string_view::npos) return;
  const auto tag_end = bytes_.find('>', start);
  const auto mark = tag_end == std::string_view::npos ? tag_end : bytes_.find('_', tag_end);
  if (mark == std::string_view::npos) {
    fail_in_file(file_, line_at(start), 1, "AppendedData has no `_` that marks its start; write the file again");
  }
  const std::string_view tag = bytes_.substr(start, tag_end - start);
  appended_base64_ = tag.find("base64") != std::string_view::npos;
  const auto end = bytes_.rfind("</AppendedData>");
  if (end == std::string_view::npos || end < mark) {
    fail_in_file(file_, line_at(start), 1, "AppendedData has no end tag; write the file again");
  }
  appended_ = bytes_.substr(mark + 1, end - mark - 1);
  has_appended_ = true;
  without_appended_ = std::string(bytes_.substr(0, start)) + "</VTKFile>";
  xml_ = without_appended_;
}

void VtuReader::open() {
  cut_appended();
  const pugi::xml_parse_result parsed =
      document_.load_buffer(xml_.data(), xml_.size(), pugi::parse_minimal | pugi::parse_escapes, pugi::encoding_utf8);
  if (!parsed) {
    fail_in_file(file_, line_at(static_cast<std::size_t>(parsed.offset)), 1,
                 fmt::format("the XML ends here or is wrong, as the parser says ({}); write the file again",
                             parsed.description()));
  }
  const pugi::xml_node root = document_.child("VTKFile");
  if (!root) fail_in_file(file_, 1, 1, "the file has no element VTKFile: it is not a .vtu file");
  const std::string type = root.attribute("type").value();
  if (type != "UnstructuredGrid") {
    fail(root, fmt::format("the type of the file is '{}'; only UnstructuredGrid is read: convert it (in ParaView: save "
                           "data as .vtu)",
                           printable(type)));
  }
  const std::string version = root.attribute("version").value();
  if (version != "0.1" && version != "1.0" && version != "2.0" && version != "2.1" && version != "2.2") {
    fail(root, fmt::format("version '{}' of the format is not known; 0.1 to 2.2 are read", printable(version)));
  }
  const std::string order = root.attribute("byte_order").value();
  if (order == "BigEndian") {
    fail(root, "the byte order is BigEndian; save the file as text, or on a machine with the other order");
  }
  const std::string header = root.attribute("header_type").value();
  if (!header.empty() && header != "UInt32" && header != "UInt64") {
    fail(root, fmt::format("header_type is '{}'; it is UInt32 or UInt64", printable(header)));
  }
  encoding_.wide_header = header == "UInt64";
  const std::string compressor = root.attribute("compressor").value();
  if (!compressor.empty() && compressor != "vtkZLibDataCompressor") {
    fail(root,
         fmt::format("the compressor '{}' is not read; save with zlib or without compression", printable(compressor)));
  }
  encoding_.zlib = !compressor.empty();
}

std::size_t VtuReader::count(const pugi::xml_node& piece, const char* attribute) const {
  std::int64_t value = -1;
  const std::string text = piece.attribute(attribute).value();
  if (!parse_number(text, value) || value < 0 || value > static_cast<std::int64_t>(most_values)) {
    fail(piece, fmt::format("{} of a Piece is '{}', which is no count below 2e9", attribute, printable(text)));
  }
  return static_cast<std::size_t>(value);
}

pugi::xml_node VtuReader::array_named(const pugi::xml_node& parent, const char* name) const {
  for (const pugi::xml_node array : parent.children("DataArray")) {
    if (std::strcmp(array.attribute("Name").value(), name) == 0) return array;
  }
  fail(parent, fmt::format("Cells has no array '{}'; write the file again", name));
}

VtuValues VtuReader::values(const pugi::xml_node& array, std::size_t most) const {
  VtuSource source;
  const std::string name = array.attribute("Name").value();
  source.what = fmt::format("array '{}'", printable(name));
  const std::string format = array.attribute("format").value();
  const std::ptrdiff_t offset = array.offset_debug();
  source.line = offset < 0 ? 0 : line_at(static_cast<std::size_t>(offset));
  if (format == "appended") {
    std::int64_t start = -1;
    if (!has_appended_) fail(array, source.what + " is in AppendedData, but the file has none; write it again");
    if (!parse_number(array.attribute("offset").value(), start) || start < 0 ||
        static_cast<std::size_t>(start) > appended_.size()) {
      fail(array,
           fmt::format("{} has the offset '{}', which is outside the {} bytes of appended data; write the file again",
                       source.what, printable(array.attribute("offset").value()), appended_.size()));
    }
    source.form = appended_base64_ ? VtuSource::Form::base64 : VtuSource::Form::raw;
    source.data = appended_.substr(static_cast<std::size_t>(start));
  } else if (format == "binary" || format == "ascii" || format.empty()) {
    for (const pugi::xml_node child : array.children()) {
      if (child.type() != pugi::node_pcdata && child.type() != pugi::node_cdata) continue;
      source.data = child.value();
      const std::ptrdiff_t at = child.offset_debug();
      if (at >= 0) source.line = line_at(static_cast<std::size_t>(at));
      break;
    }
    source.form = format == "binary" ? VtuSource::Form::base64 : VtuSource::Form::text;
  } else {
    fail(array, fmt::format("{} has the format '{}'; it is ascii, binary or appended", source.what, printable(format)));
  }
  return read_vtu_values(source, array.attribute("type").value(), encoding_, most, file_);
}

void VtuReader::add_cells(const pugi::xml_node& cells, const VtuValues& connectivity, const VtuValues& offsets,
                          const VtuValues& types, std::int64_t first_node, std::size_t points) {
  std::vector<std::int64_t> nodes;
  std::size_t begin = 0;
  for (std::size_t i = 0; i < types.size(); ++i, ++positions_) {
    const auto number = static_cast<std::int64_t>(positions_);
    const auto fail_at = [&](int line, const std::string& message) {
      const std::string text = fmt::format("cell {} (counted from 0) {}", number, message);
      if (line == 0) fail(cells, text);
      fail_in_file(file_, line, 1, text);
    };
    const std::int64_t end = offsets.whole[i];
    const int offset_line = offsets.lines.empty() ? 0 : offsets.lines[i];
    if (end < static_cast<std::int64_t>(begin) || end > static_cast<std::int64_t>(connectivity.size())) {
      fail_at(offset_line,
              fmt::format("ends at position {} of the array 'connectivity', which is not between {} and {}; "
                          "write the file again",
                          end, begin, connectivity.size()));
    }
    const std::size_t n = static_cast<std::size_t>(end) - begin;
    const std::optional<VtuShape> shape = shape_of(types.whole[i], n);
    if (!shape) fail_at(types.lines.empty() ? 0 : types.lines[i], why_not_read(types.whole[i], n));
    const bool wrong_count = (shape->nodes > 0 && n != static_cast<std::size_t>(shape->nodes)) ||
                             (shape->use == VtuShape::Use::cell && n < 3) ||
                             (shape->kind == CellKind::quadratic_polygon && (n % 2 != 0 || n < 6));
    if (wrong_count) {
      fail_at(offset_line, fmt::format("of VTK's type {} has {} nodes{}; write the file again", types.whole[i], n,
                                       shape->nodes > 0 ? fmt::format(" instead of {}", shape->nodes) : ""));
    }
    nodes.clear();
    const int line = connectivity.lines.empty() || n == 0 ? 0 : connectivity.lines[begin];
    for (std::size_t k = 0; k < n; ++k) {
      const std::int64_t node = connectivity.whole[begin + k];
      if (node < 0 || node >= static_cast<std::int64_t>(points)) {
        fail_at(line, fmt::format("has node {}, but the points are numbered from 0 to {}; write the file again", node,
                                  static_cast<std::int64_t>(points) - 1));
      }
      nodes.push_back(first_node + node);
    }
    begin = static_cast<std::size_t>(end);
    if (types.whole[i] == 8 || types.whole[i] == 11) std::swap(nodes[2], nodes[3]);  // pixels and voxels go row by row
    if (types.whole[i] == 11) std::swap(nodes[6], nodes[7]);
    if (shape->use == VtuShape::Use::cell) {
      nodes.resize(static_cast<std::size_t>(shape->kept_nodes));
      add_cell(*shape, number, nodes, {0, line});
      cell_position_.push_back(positions_);
    } else if (shape->use != VtuShape::Use::unused) {
      small_.push_back({positions_, shape->use == VtuShape::Use::facet, nodes});
    }
  }
}

void VtuReader::read_cell_data(const pugi::xml_node& piece, std::size_t cells_before, std::size_t cells) {
  for (const pugi::xml_node array : piece.child("CellData").children("DataArray")) {
    const std::string type = array.attribute("type").value();
    const std::string components = array.attribute("NumberOfComponents").value();
    const std::string name = array.attribute("Name").value();
    const bool integer = type.rfind("Int", 0) == 0 || type.rfind("UInt", 0) == 0;
    if (!integer || name.empty() || name.rfind("vtk", 0) == 0 || (!components.empty() && components != "1")) continue;
    const VtuValues read = values(array, cells);
    if (read.size() != cells) {
      fail(array, fmt::format("array '{}' has {} values, but there are {} cells; write the file again", printable(name),
                              read.size(), cells));
    }
    auto known = std::find_if(arrays_.begin(), arrays_.end(), [&](const CellArray& a) { return a.name == name; });
    if (known == arrays_.end() && cells_before == 0) known = arrays_.insert(arrays_.end(), {name, {}});
    if (known == arrays_.end() || known->values.size() != cells_before) continue;  // not in all pieces
    known->values.insert(known->values.end(), read.whole.begin(), read.whole.end());
  }
}

void VtuReader::read_piece(const pugi::xml_node& piece) {
  const std::size_t points = count(piece, "NumberOfPoints"), cells = count(piece, "NumberOfCells");
  if (cells == 0) return;
  const std::int64_t first_node = nodes_;

  const pugi::xml_node point_array = piece.child("Points").child("DataArray");
  if (!point_array) fail(piece, "a Piece has no Points with a DataArray; write the file again");
  const std::string components = point_array.attribute("NumberOfComponents").value();
  if (components != "3") {
    fail(point_array, fmt::format("points have NumberOfComponents '{}'; it is 3", printable(components)));
  }
  const VtuValues coordinates = values(point_array, 3 * points);
  if (coordinates.size() != 3 * points) {
    fail(point_array,
         fmt::format("NumberOfPoints is {}, but there are {} coordinates instead of {}; write the file again", points,
                     coordinates.size(), 3 * points));
  }
  for (std::size_t i = 0; i < points; ++i) {
    const int line = coordinates.lines.empty() ? 0 : coordinates.lines[3 * i];
    add_node(first_node + static_cast<std::int64_t>(i), coordinates.at(3 * i), coordinates.at(3 * i + 1),
             coordinates.at(3 * i + 2), {0, line});
  }
  nodes_ += static_cast<std::int64_t>(points);

  const pugi::xml_node group = piece.child("Cells");
  if (!group) fail(piece, "a Piece has no Cells; write the file again");
  const auto read = [&](const char* name, std::size_t most) {
    const pugi::xml_node array = array_named(group, name);
    VtuValues found = values(array, most);
    if (!found.integers) fail(array, fmt::format("array '{}' has no integers; write the file again", name));
    return found;
  };
  const VtuValues types = read("types", cells);
  const VtuValues offsets = read("offsets", cells);
  if (types.size() != cells || offsets.size() != cells) {
    fail(group, fmt::format("NumberOfCells is {}, but there are {} types and {} offsets; write the file again", cells,
                            types.size(), offsets.size()));
  }
  const std::int64_t last = offsets.whole.back();
  if (last < 0 || last > static_cast<std::int64_t>(most_values)) {
    fail(group, fmt::format("the last offset is {}, which is no count of nodes; write the file again", last));
  }
  const VtuValues connectivity = read("connectivity", static_cast<std::size_t>(last));
  const std::size_t before = positions_;
  add_cells(group, connectivity, offsets, types, first_node, points);
  read_cell_data(piece, before, cells);
}

const VtuReader::CellArray* VtuReader::find_regions() {
  std::erase_if(arrays_, [this](const CellArray& array) { return array.values.size() != positions_; });
  const CellArray* regions = nullptr;
  for (const char* name : {"region", "material", "gmsh:physical", "MaterialIds", "CellEntityIds", "gmsh:geometrical"}) {
    for (const CellArray& array : arrays_) {
      if (regions == nullptr && array.name == name) regions = &array;
    }
  }
  for (const CellArray& array : arrays_) {
    std::set<std::int64_t> different;
    for (std::size_t i = 0; i < array.values.size() && different.size() <= most_set_values; ++i) {
      different.insert(array.values[i]);
    }
    if (different.size() > most_set_values) continue;
    if (regions == nullptr) regions = &array;
    std::map<std::int64_t, int> sets;
    for (std::size_t c = 0; c < cell_position_.size(); ++c) {
      const std::int64_t value = array.values[cell_position_[c]];
      auto set = sets.find(value);
      if (set == sets.end()) set = sets.emplace(value, cell_set(fmt::format("{}_{}", array.name, value))).first;
      add_cell_to_set(set->second, static_cast<int>(c));
    }
  }
  return regions;
}

void VtuReader::read_pieces() {
  open();
  const pugi::xml_node grid = document_.child("VTKFile").child("UnstructuredGrid");
  if (!grid) fail(document_.child("VTKFile"), "the file has no UnstructuredGrid; write it again");
  for (const pugi::xml_node piece : grid.children("Piece")) read_piece(piece);
}

}  // namespace scabo::files
