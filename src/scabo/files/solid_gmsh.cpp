#include "scabo/files/solid_gmsh.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>

#include "scabo/files/gmsh_reader.hpp"
#include "scabo/files/solid_builder.hpp"

namespace scabo::files {

namespace {

constexpr std::array<GmshElement, 7> elements_of_solids{
    {{1, 1, 2}, {2, 2, 3}, {4, 3, 4}, {8, 1, 3}, {9, 2, 6}, {11, 3, 10}, {15, 0, 1}}};

class SolidGmsh : public GmshReader {
 public:
  SolidGmsh(std::string_view bytes, const std::string& file)
      : GmshReader(bytes, file, 3), files_(file), builder_(files_, SolidBuilder::TurnedCells::put_in_order) {}

  ImportedSolidMesh read() {
    read_sections();
    if (builder_.cells() == 0)
      fail_in_file(files_.file({}), 0, 0, "the file has no tetrahedra; save the mesh of a volume (in Gmsh: -3)");
    return builder_.finish();
  }

 private:
  void reserve(std::size_t, std::size_t) override {}
  void add_node(std::int64_t number, double x, double y, double z, const FilePlace& at) override {
    builder_.add_node(number, x, y, z, at);
  }
  const GmshElement& element(std::int64_t type, std::int64_t number) override;
  void add_element(const GmshElement& element, std::int64_t number, const Tags& groups, std::int64_t entity,
                   const Tags& nodes, const FilePlace& at, bool may_be_repeated) override;
  void find_sets(int dimension, const Tags& groups, std::int64_t entity);

  MeshBuilder files_;
  SolidBuilder builder_;
  // Indices of the sets of the element before, which are mostly those of the next as well.
  int last_dimension_ = -1;
  std::int64_t last_entity_ = 0;
  Tags last_groups_;
  std::vector<int> sets_;
};

const GmshElement& SolidGmsh::element(std::int64_t type, std::int64_t number) {
  for (const GmshElement& known : elements_of_solids)
    if (known.type == type) return known;
  fail(
      fmt::format("cell {} has Gmsh's type {}, which is not read in space; use tetrahedra of order 1 or 2 (in Gmsh: "
                  "-3 -order 2, without Recombine)",
                  number, type));
}

void SolidGmsh::find_sets(int dimension, const Tags& groups, std::int64_t entity) {
  if (last_dimension_ == dimension && last_entity_ == entity && last_groups_ == groups) return;
  last_dimension_ = dimension;
  last_entity_ = entity;
  last_groups_ = groups;
  sets_.clear();
  const auto at = static_cast<std::size_t>(dimension);
  constexpr std::array<const char*, 4> of_group{"points", "", "boundary", "region"},
      of_entity{"point", "", "surface", "volume"};
  std::vector<std::string> names;
  for (const std::int64_t tag : groups) names.push_back(group_name(dimension, tag, of_group[at]));
  if (names.empty()) names.push_back(fmt::format("{}_{}", of_entity[at], entity));
  for (const std::string& name : names)
    sets_.push_back(dimension == 3   ? builder_.cell_set(name)
                    : dimension == 2 ? builder_.side_set(name)
                                     : builder_.node_set(name));
}

void SolidGmsh::add_element(const GmshElement& element, std::int64_t number, const Tags& groups, std::int64_t entity,
                            const Tags& nodes, const FilePlace& at, bool may_be_repeated) {
  if (element.dimension == 1) return;  // an edge names no face
  find_sets(element.dimension, groups, entity);
  int cell = -1;
  if (element.dimension == 3) {
    Tags ordered = nodes;
    if (nodes.size() == 10) std::swap(ordered[8], ordered[9]);  // Gmsh has the middle of 34 before that of 24
    cell = builder_.add_cell(number, ordered, at, may_be_repeated ? magnitude(entity) : -1);
  }
  for (const int set : sets_) {
    if (element.dimension == 3) builder_.add_cell_to_set(set, cell);
    if (element.dimension == 2) builder_.add_facet(set, nodes);
    if (element.dimension == 0) builder_.add_node_to_set(set, nodes.front());
  }
}

}  // namespace

ImportedSolidMesh parse_solid_gmsh(std::string_view bytes, const std::string& file) {
  return SolidGmsh(bytes, file).read();
}

}  // namespace scabo::files
