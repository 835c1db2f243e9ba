// The format: Gmsh reference manual, "MSH file format" (version 4.1) and "Legacy formats" (version 2).
#include "scabo/files/gmsh.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cstring>
#include <limits>
#include <map>
#include <optional>

#include "scabo/files/mesh_builder.hpp"
#include "scabo/files/text_cursor.hpp"

namespace scabo::files {

namespace {

struct GmshElement {
  int type;
  int dimension;
  int nodes;
  std::optional<CellKind> kind;  // of a cell
};

constexpr std::array<GmshElement, 9> gmsh_elements{{{1, 1, 2, {}},
                                                    {2, 2, 3, CellKind::triangle3},
                                                    {3, 2, 4, CellKind::quad4},
                                                    {8, 1, 3, {}},
                                                    {9, 2, 6, CellKind::triangle6},
                                                    {10, 2, 9, CellKind::quad8},
                                                    {15, 0, 1, {}},
                                                    {16, 2, 8, CellKind::quad8},
                                                    {34, 2, 0, CellKind::polygon}}};

bool is_gmsh_solid(std::int64_t type) {
  constexpr std::array<int, 36> solids{4,  5,  6,  7,  11, 12, 13, 14, 17, 18, 19, 29, 30, 31, 32,  33,  71,  72,
                                       73, 74, 75, 79, 80, 81, 82, 83, 90, 91, 92, 93, 94, 95, 118, 119, 120, 35};
  return std::find(solids.begin(), solids.end(), type) != solids.end();
}

/// Gmsh writes the tag of a group with a minus sign where an entity has the other orientation.
std::int64_t magnitude(std::int64_t tag) {
  return tag < 0 ? -std::max(tag, -std::numeric_limits<std::int64_t>::max()) : tag;
}

constexpr int no_dimension = -1;  // of physical names in version 2.0

constexpr std::int64_t most_groups = 100;  // of one entity: each takes memory for every cell of it

class GmshReader {
 public:
  GmshReader(std::string_view bytes, const std::string& file) : in_(bytes, file), builder_(file) {}

  ImportedMesh read();

 private:
  using Tags = std::vector<std::int64_t>;

  void read_format();
  void read_names();
  void read_name();
  void read_entities();
  void read_nodes_2();
  void read_elements_2();
  void read_nodes_4();
  void read_elements_4();
  void skip_section(std::string_view name);
  void end_section(std::string_view name, int count_line);

  [[noreturn]] void fail(const std::string& message) const;
  void need(std::size_t bytes, const char* what) const;
  template <class T>
  T raw(const char* what);

  /// The next number, whether text or binary. In binary files counts and tags of nodes and elements have 8 bytes.
  std::int64_t integer(const char* what) { return binary_ ? raw<std::int32_t>(what) : in_.integer(what); }
  std::int64_t size(const char* what) {
    return binary_ ? static_cast<std::int64_t>(raw<std::uint64_t>(what)) : in_.integer(what);
  }
  double real(const char* what) { return binary_ ? raw<double>(what) : in_.number(what); }
  std::int64_t count(std::int64_t value, const char* what) const;
  std::size_t bounded(std::int64_t count, std::size_t bytes_each) const {
    return std::min<std::size_t>(static_cast<std::size_t>(count), in_.remaining() / bytes_each);
  }
  void start_binary_data();
  FilePlace place() const { return {0, binary_ ? 0 : in_.line()}; }

  const GmshElement& element(std::int64_t type, std::int64_t number);
  void add_element(const GmshElement& element, std::int64_t number, const Tags& groups, std::int64_t entity,
                   const Tags& nodes, const FilePlace& at, bool may_be_repeated);
  std::string group_name(int dimension, std::int64_t tag) const;

  TextCursor in_;
  MeshBuilder builder_;
  bool binary_ = false;
  int version_ = 0;                                            // 2 or 4
  std::map<std::pair<int, std::int64_t>, std::string> names_;  // by dimension, or no_dimension, and tag
  std::map<std::pair<int, std::int64_t>, Tags> groups_of_;     // version 4: by dimension and entity
  bool has_nodes_ = false, has_elements_ = false;

  // Indices of the sets of the element before, which are mostly those of the next as well.
  struct Sets {
    int dimension = -1;
    std::int64_t entity = 0;
    Tags groups;
    int region = 0;
    std::vector<int> sets;
  } last_;
};

void GmshReader::fail(const std::string& message) const {
  if (!binary_) in_.fail(message);
  fail_in_file(in_.file(), 0, 0, fmt::format("byte {}: {}", in_.position(), message));
}

void GmshReader::need(std::size_t bytes, const char* what) const {
  if (in_.remaining() < bytes) {
    fail(fmt::format("the file ends where {} is expected: it is truncated; write it again", what));
  }
}

template <class T>
T GmshReader::raw(const char* what) {
  need(sizeof(T), what);
  T value;
  std::memcpy(&value, in_.rest().data(), sizeof(T));
  in_.skip_bytes(sizeof(T));
  return value;
}

std::int64_t GmshReader::count(std::int64_t value, const char* what) const {
  if (value < 0) fail(fmt::format("{} is {}, which is no count; write the file again", what, value));
  return value;
}

void GmshReader::start_binary_data() {
  if (binary_) in_.rest_of_line();
}

void GmshReader::read_format() {
  const std::string_view version = in_.word();
  double value = 0.0;
  if (!parse_number(version, value))
    in_.fail("$MeshFormat must be followed by a version such as 4.1; write the file again");
  const bool is_2 = value >= 2.0 && value <= 2.2;
  if (!is_2 && value != 4.1) {
    in_.fail(fmt::format("version {} of the format is not read; save as 4.1 or 2.2 (in Gmsh: -format msh41)", value));
  }
  version_ = is_2 ? 2 : 4;
  const std::int64_t type = in_.integer("the type of the file (0 text, 1 binary)");
  const std::int64_t data_size = in_.integer("the size of numbers");
  if (type != 0 && type != 1) in_.fail(fmt::format("the type of the file is {}; it is 0 (text) or 1 (binary)", type));
  if (data_size != 8) {
    in_.fail(fmt::format("numbers have {} bytes; only 8 are read: save the mesh again with a usual build of Gmsh",
                         data_size));
  }
  if (type == 1) {
    in_.rest_of_line();
    binary_ = true;
    const std::int32_t one = raw<std::int32_t>("the number one that shows the order of bytes");
    if (one == 0x01000000) {
      fail("the file was written on a machine with the other order of bytes; save it as text (in Gmsh: -bin 0)");
    }
    if (one != 1) fail(fmt::format("expected the number one that shows the order of bytes, found {}", one));
  }
  end_section("$MeshFormat", 0);
}

void GmshReader::end_section(std::string_view name, int count_line) {
  const std::string expected = "$End" + std::string(name.substr(1));
  if (binary_ && in_.remaining() > 0 && in_.rest().front() == '\r') in_.skip_bytes(1);
  const int line = in_.line();
  const std::string_view found = in_.word();
  if (found == expected) return;
  if (found.empty()) fail(fmt::format("the file ends in {}, which has no {}; write it again", name, expected));
  std::string lies = "; the counts of this section do not agree with its content: write the file again";
  if (!binary_ && count_line > 0) {
    lies = fmt::format("; the count in line {} does not agree with the content: write the file again", count_line);
  }
  fail(fmt::format("expected {}{}{}", expected, binary_ ? "" : fmt::format(" after line {}", line), lies));
}

void GmshReader::skip_section(std::string_view name) {
  const std::string end = "$End" + std::string(name.substr(1));
  const std::string_view rest = in_.rest();
  for (std::size_t at = rest.find(end); at != std::string_view::npos; at = rest.find(end, at + 1)) {
    const bool whole = at + end.size() == rest.size() || static_cast<unsigned char>(rest[at + end.size()]) <= ' ';
    if (!whole) continue;
    in_.advance_to(in_.position() + at + end.size());
    return;
  }
  fail(fmt::format("the file ends in {}, which has no {}; write it again", name.substr(0, 40), end.substr(0, 43)));
}

void GmshReader::read_names() {
  // Text in binary files, too.
  const int line = in_.line();
  const std::int64_t names = count(in_.integer("the count of physical names"), "the count of physical names");
  for (std::int64_t i = 0; i < names; ++i) read_name();
  end_section("$PhysicalNames", line);
}

/// Dimension, tag and name; in version 2.0 tag and name only, whose dimension then shows in the elements. The line
/// itself says which it is: some programs write version 2.0 in files of 2.1 or later.
void GmshReader::read_name() {
  std::int64_t dimension = no_dimension;
  std::int64_t tag = in_.integer("the number of a physical group");
  in_.skip_white();
  if (version_ != 2 || in_.rest().substr(0, 1) != "\"") {
    dimension = tag;
    tag = in_.integer("the tag of a physical group");
    in_.skip_white();
  }
  const int line = in_.line();
  const std::string_view rest = in_.rest_of_line();
  const auto first = rest.find('"'), last = rest.rfind('"');
  if (first == std::string_view::npos || last == first || dimension < no_dimension || dimension > 3) {
    fail(fmt::format("a physical name of line {} must read: dimension (0 to 3), tag, name in quotes", line));
  }
  std::string& name = names_[{static_cast<int>(dimension), tag}];
  const std::string_view found = rest.substr(first + 1, last - first - 1);
  if (dimension == no_dimension && !name.empty() && name != found) {
    fail(
        fmt::format("the physical groups '{}' and '{}' both have the tag {}, and without dimensions it is not known "
                    "which is which; save as 4.1 or 2.2 (in Gmsh: -format msh41)",
                    printable(name), printable(found), tag));
  }
  name = found;
}

void GmshReader::read_entities() {
  start_binary_data();
  const int line = in_.line();
  std::array<std::int64_t, 4> counts{};
  for (std::int64_t& n : counts) n = count(size("the count of entities"), "the count of entities");
  for (int dimension = 0; dimension < 4; ++dimension) {
    for (std::int64_t i = 0; i < counts[static_cast<std::size_t>(dimension)]; ++i) {
      const std::int64_t tag = integer("the tag of an entity");
      for (int k = 0; k < (dimension == 0 ? 3 : 6); ++k) real("a bound of an entity");
      const std::int64_t groups = count(size("the count of physical tags"), "the count of physical tags");
      if (groups > most_groups) {
        fail(fmt::format("entity {} is in {} physical groups; at most {} are read", tag, groups, most_groups));
      }
      Tags& tags = groups_of_[{dimension, tag}];
      for (std::int64_t k = 0; k < groups; ++k) tags.push_back(magnitude(integer("a physical tag")));
      if (dimension == 0) continue;
      const std::int64_t bounds = count(size("the count of bounding entities"), "the count of bounding entities");
      for (std::int64_t k = 0; k < bounds; ++k) integer("the tag of a bounding entity");
    }
  }
  end_section("$Entities", line);
}

void GmshReader::read_nodes_2() {
  in_.skip_white();
  const int line = in_.line();
  const std::int64_t nodes = count(in_.integer("the count of nodes"), "the count of nodes");
  start_binary_data();
  builder_.reserve(bounded(nodes, binary_ ? 28 : 8), 0);
  for (std::int64_t i = 0; i < nodes; ++i) {
    if (!binary_) in_.skip_white();
    const FilePlace at = place();
    const std::int64_t number = integer("the number of a node");
    const double x = real("a coordinate"), y = real("a coordinate"), z = real("a coordinate");
    builder_.add_node(number, x, y, z, at);
  }
  end_section("$Nodes", line);
}

void GmshReader::read_nodes_4() {
  start_binary_data();
  if (!binary_) in_.skip_white();
  const int line = in_.line();
  const std::int64_t blocks = count(size("the count of blocks of nodes"), "the count of blocks of nodes");
  const std::int64_t nodes = count(size("the count of nodes"), "the count of nodes");
  size("the least number of a node");
  size("the largest number of a node");
  builder_.reserve(bounded(nodes, binary_ ? 32 : 8), 0);
  std::int64_t found = 0;
  Tags tags;
  for (std::int64_t b = 0; b < blocks; ++b) {
    const std::int64_t dimension = integer("the dimension of an entity");
    integer("the tag of an entity");
    const std::int64_t parametric = integer("0 or 1 (parametric coordinates)");
    const std::int64_t n = count(size("the count of nodes of a block"), "the count of nodes of a block");
    if (dimension < 0 || dimension > 3 || parametric < 0 || parametric > 1) {
      fail(
          fmt::format("a block of nodes begins with dimension {} and parametric {}, which are 0 to 3 and 0 or 1; write "
                      "the file again",
                      dimension, parametric));
    }
    tags.clear();
    for (std::int64_t i = 0; i < n; ++i) tags.push_back(size("the number of a node"));
    for (const std::int64_t tag : tags) {
      if (!binary_) in_.skip_white();
      const FilePlace at = place();
      const double x = real("a coordinate"), y = real("a coordinate"), z = real("a coordinate");
      for (std::int64_t k = 0; k < parametric * dimension; ++k) real("a parametric coordinate");
      builder_.add_node(tag, x, y, z, at);
    }
    found += n;
  }
  if (found != nodes) {
    fail(fmt::format("$Nodes announces {} nodes, its blocks have {}: write the file again", nodes, found));
  }
  end_section("$Nodes", line);
}

const GmshElement& GmshReader::element(std::int64_t type, std::int64_t number) {
  for (const GmshElement& known : gmsh_elements) {
    if (known.type == type && (type != 34 || (version_ == 2 && !binary_))) return known;
  }
  if (is_gmsh_solid(type)) {
    fail(
        fmt::format("cell {} has Gmsh's type {}, a three-dimensional cell; Scabo's bodies are plane: save the mesh of "
                    "a plane surface only (in Gmsh: -2)",
                    number, type));
  }
  fail(
      fmt::format("cell {} has Gmsh's type {}, which is not read; use triangles and quadrilaterals of order 1 or 2 (in "
                  "Gmsh: -order 2)",
                  number, type));
}

std::string GmshReader::group_name(int dimension, std::int64_t tag) const {
  for (const int of : {dimension, no_dimension})
    if (const auto name = names_.find({of, tag}); name != names_.end() && !name->second.empty()) return name->second;
  constexpr std::array<const char*, 3> prefix{"points", "boundary", "region"};
  return fmt::format("{}_{}", prefix[static_cast<std::size_t>(dimension)], tag);
}

void GmshReader::add_element(const GmshElement& element, std::int64_t number, const Tags& groups, std::int64_t entity,
                             const Tags& nodes, const FilePlace& at, bool may_be_repeated) {
  const int dimension = element.dimension;
  if (last_.dimension != dimension || last_.entity != entity || last_.groups != groups) {
    last_ = {dimension, entity, groups, 0, {}};
    std::vector<std::string> names;
    for (const std::int64_t tag : groups) names.push_back(group_name(dimension, tag));
    if (names.empty()) {
      constexpr std::array<const char*, 3> prefix{"point", "curve", "surface"};
      names.push_back(fmt::format("{}_{}", prefix[static_cast<std::size_t>(dimension)], entity));
    }
    if (dimension == 2) last_.region = builder_.region(names.front());
    for (const std::string& name : names) {
      last_.sets.push_back(dimension == 2   ? builder_.cell_set(name)
                           : dimension == 1 ? builder_.facet_set(name)
                                            : builder_.node_set(name));
    }
  }
  int cell = -1;
  if (dimension == 2) {
    const std::size_t kept = element.type == 10 ? 8 : nodes.size();
    cell = builder_.add_cell(*element.kind, number, std::span(nodes).first(kept), last_.region, at,
                             may_be_repeated ? magnitude(entity) : -1);
  }
  for (const int set : last_.sets) {
    if (dimension == 2) builder_.add_cell_to_set(set, cell);
    if (dimension == 1) builder_.add_facet(set, nodes);
    if (dimension == 0) builder_.add_node_to_set(set, nodes.front());
  }
}

void GmshReader::read_elements_2() {
  in_.skip_white();
  const int line = in_.line();
  const std::int64_t elements = count(in_.integer("the count of elements"), "the count of elements");
  start_binary_data();
  builder_.reserve(0, bounded(elements, binary_ ? 20 : 12));
  Tags tags, groups, nodes;
  std::int64_t type = 0, tag_count = 0, left_in_block = 0;
  for (std::int64_t i = 0; i < elements; ++i) {
    if (binary_ && left_in_block == 0) {
      type = integer("the type of an element");
      left_in_block = integer("the count of elements of a block");
      tag_count = integer("the count of tags");
      if (left_in_block <= 0) fail("a block of elements has no elements; write the file again");
    }
    if (!binary_) in_.skip_white();
    const FilePlace at = place();
    const std::int64_t number = integer("the number of an element");
    if (!binary_) {
      type = integer("the type of an element");
      tag_count = integer("the count of tags");
    }
    const GmshElement& shape = element(type, number);
    if (tag_count < 0 || tag_count > 1000) {
      fail(fmt::format("element {} has {} tags; it has 2 or a few more: write the file again", number, tag_count));
    }
    tags.clear();
    for (std::int64_t k = 0; k < tag_count; ++k) tags.push_back(integer("a tag of an element"));
    std::int64_t node_count = shape.nodes;
    if (shape.kind == CellKind::polygon) {
      node_count = integer("the count of nodes of a polygon");
      if (node_count < 3 || node_count > 1'000'000) {
        fail(fmt::format("polygon {} has {} nodes; it has at least three", number, node_count));
      }
    }
    nodes.clear();
    for (std::int64_t k = 0; k < node_count; ++k) nodes.push_back(integer("a node of an element"));
    groups.clear();
    if (!tags.empty() && tags[0] != 0) groups.push_back(magnitude(tags[0]));
    add_element(shape, number, groups, tags.size() > 1 ? tags[1] : 0, nodes, at, true);
    --left_in_block;
  }
  if (binary_ && left_in_block > 0) fail("a block has more elements than $Elements announces; write the file again");
  end_section("$Elements", line);
}

void GmshReader::read_elements_4() {
  start_binary_data();
  if (!binary_) in_.skip_white();
  const int line = in_.line();
  const std::int64_t blocks = count(size("the count of blocks of elements"), "the count of blocks of elements");
  const std::int64_t elements = count(size("the count of elements"), "the count of elements");
  size("the least number of an element");
  size("the largest number of an element");
  builder_.reserve(0, bounded(elements, binary_ ? 32 : 8));
  std::int64_t found = 0;
  Tags nodes;
  const Tags none;
  for (std::int64_t b = 0; b < blocks; ++b) {
    const std::int64_t dimension = integer("the dimension of an entity");
    const std::int64_t entity = integer("the tag of an entity");
    const std::int64_t type = integer("the type of the elements");
    const std::int64_t n = count(size("the count of elements of a block"), "the count of elements of a block");
    const auto groups = groups_of_.find({static_cast<int>(std::clamp<std::int64_t>(dimension, -1, 4)), entity});
    const Tags& tags = groups == groups_of_.end() ? none : groups->second;
    for (std::int64_t i = 0; i < n; ++i) {
      if (!binary_) in_.skip_white();
      const FilePlace at = place();
      const std::int64_t number = size("the number of an element");
      const GmshElement& shape = element(type, number);
      nodes.clear();
      for (int k = 0; k < shape.nodes; ++k) nodes.push_back(size("a node of an element"));
      add_element(shape, number, tags, entity, nodes, at, false);
    }
    found += n;
  }
  if (found != elements) {
    fail(fmt::format("$Elements announces {} elements, its blocks have {}: write the file again", elements, found));
  }
  end_section("$Elements", line);
}

ImportedMesh GmshReader::read() {
  while (in_.skip_white()) {
    const std::string_view section = in_.word();
    if (section.size() < 2 || section.front() != '$' || section.substr(0, 4) == "$End") {
      fail(fmt::format("expected the start of a section such as $Nodes, found '{}'; write the file again",
                       printable(section)));
    }
    if (section == "$MeshFormat") {
      if (version_ != 0) fail("$MeshFormat is given twice; write the file again");
      read_format();
      continue;
    }
    if (section == "$NOD") fail("version 1 of the format is not read; save as 4.1 or 2.2 (in Gmsh: -format msh41)");
    const bool own = section == "$Nodes" || section == "$Elements" || section == "$Entities" ||
                     section == "$PhysicalNames" || section == "$PartitionedEntities";
    if (own && version_ == 0) {
      fail(fmt::format("{} comes before $MeshFormat, which says how to read it; write the file again", section));
    }
    if (section == "$PartitionedEntities") {
      fail("the mesh is divided into partitions; save it without them (in Gmsh: Mesh > Unpartition)");
    }
    if (section == "$PhysicalNames") {
      read_names();
    } else if (section == "$Entities") {
      read_entities();
    } else if (section == "$Nodes") {
      if (has_nodes_) fail("$Nodes is given twice; write the file again");
      has_nodes_ = true;
      version_ == 2 ? read_nodes_2() : read_nodes_4();
    } else if (section == "$Elements") {
      if (has_elements_) fail("$Elements is given twice; write the file again");
      has_elements_ = true;
      version_ == 2 ? read_elements_2() : read_elements_4();
    } else {
      skip_section(section);
    }
  }
  if (version_ == 0) fail("the file has no $MeshFormat, with which a mesh of Gmsh begins");
  if (!has_nodes_) fail("the file has no $Nodes; save the mesh again, after meshing it (in Gmsh: -2)");
  if (!has_elements_) fail("the file has no $Elements; save the mesh again, after meshing it (in Gmsh: -2)");
  return builder_.finish();
}

}  // namespace

ImportedMesh parse_gmsh(std::string_view bytes, const std::string& file) { return GmshReader(bytes, file).read(); }

}  // namespace scabo::files
