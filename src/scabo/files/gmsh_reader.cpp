// The format: Gmsh reference manual, "MSH file format" (version 4.1) and "Legacy formats" (version 2).
#include "scabo/files/gmsh_reader.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cstring>
#include <limits>

namespace scabo::files {

namespace {

constexpr int no_dimension = -1;  // of physical names in version 2.0

constexpr std::int64_t most_groups = 100;  // of one entity: each takes memory for every cell of it

}  // namespace

std::int64_t GmshReader::magnitude(std::int64_t tag) {
  return tag < 0 ? -std::max(tag, -std::numeric_limits<std::int64_t>::max()) : tag;
}

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
  if (!name.empty() && name != found)
    fail(fmt::format("the physical groups '{}' and '{}' both have the tag {}{}", printable(name), printable(found), tag,
                     dimension == no_dimension ? ", and without dimensions it is not known which is which; save as 4.1 "
                                                 "or 2.2 (in Gmsh: -format msh41)"
                                               : " of one dimension; keep the one that is meant"));
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
  reserve(bounded(nodes, binary_ ? 28 : 8), 0);
  for (std::int64_t i = 0; i < nodes; ++i) {
    if (!binary_) in_.skip_white();
    const FilePlace at = place();
    const std::int64_t number = integer("the number of a node");
    const double x = real("a coordinate"), y = real("a coordinate"), z = real("a coordinate");
    add_node(number, x, y, z, at);
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
  reserve(bounded(nodes, binary_ ? 32 : 8), 0);
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
      add_node(tag, x, y, z, at);
    }
    found += n;
  }
  if (found != nodes) {
    fail(fmt::format("$Nodes announces {} nodes, its blocks have {}: write the file again", nodes, found));
  }
  end_section("$Nodes", line);
}

std::string GmshReader::group_name(int dimension, std::int64_t tag, const char* prefix) const {
  for (const int of : {dimension, no_dimension})
    if (const auto name = names_.find({of, tag}); name != names_.end() && !name->second.empty()) return name->second;
  return fmt::format("{}_{}", prefix, tag);
}

void GmshReader::read_elements_2() {
  in_.skip_white();
  const int line = in_.line();
  const std::int64_t elements = count(in_.integer("the count of elements"), "the count of elements");
  start_binary_data();
  reserve(0, bounded(elements, binary_ ? 20 : 12));
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
    if (shape.nodes == 0) {  // a polygon
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
  reserve(0, bounded(elements, binary_ ? 32 : 8));
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

void GmshReader::read_sections() {
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
  if (!has_nodes_)
    fail(fmt::format("the file has no $Nodes; save the mesh again, after meshing it (in Gmsh: -{})", dimension_));
  if (!has_elements_)
    fail(fmt::format("the file has no $Elements; save the mesh again, after meshing it (in Gmsh: -{})", dimension_));
}

}  // namespace scabo::files
