#include "scabo/files/solid_gmsh.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <span>

#include "scabo/base/cell_topology.hpp"
#include "scabo/files/gmsh_reader.hpp"
#include "scabo/files/solid_builder.hpp"

namespace scabo::files {

namespace {

constexpr std::array<GmshElement, 16> elements_of_solids{{{1, 1, 2},
                                                          {2, 2, 3},
                                                          {3, 2, 4},
                                                          {4, 3, 4},
                                                          {5, 3, 8},
                                                          {6, 3, 6},
                                                          {8, 1, 3},
                                                          {9, 2, 6},
                                                          {10, 2, 9},
                                                          {11, 3, 10},
                                                          {12, 3, 27},
                                                          {13, 3, 18},
                                                          {15, 0, 1},
                                                          {16, 2, 8},
                                                          {17, 3, 20},
                                                          {18, 3, 15}}};

/// Edges of Gmsh's cells in the order of their middle nodes, behind which those of sides and of the inside follow.
struct GmshEdges {
  std::size_t corners;
  std::vector<std::array<std::size_t, 2>> edges;
};
const GmshEdges& edges_of_gmsh(std::size_t nodes) {
  static const GmshEdges tetrahedron{4, {{0, 1}, {1, 2}, {2, 0}, {3, 0}, {2, 3}, {1, 3}}},
      wedge{6, {{0, 1}, {0, 2}, {0, 3}, {1, 2}, {1, 4}, {2, 5}, {3, 4}, {3, 5}, {4, 5}}},
      brick{8, {{0, 1}, {0, 3}, {0, 4}, {1, 2}, {1, 5}, {2, 3}, {2, 6}, {3, 7}, {4, 5}, {4, 7}, {5, 6}, {6, 7}}};
  return nodes == 4 || nodes == 10 ? tetrahedron : nodes == 6 || nodes == 15 || nodes == 18 ? wedge : brick;
}

/// In the order of CellTopology, without nodes in the middle of sides and cells.
std::vector<std::int64_t> in_order(const std::vector<std::int64_t>& nodes) {
  const GmshEdges& of = edges_of_gmsh(nodes.size());
  if (nodes.size() == of.corners) return nodes;
  std::vector<std::int64_t> ordered(nodes.begin(),
                                    nodes.begin() + static_cast<std::ptrdiff_t>(of.corners + of.edges.size()));
  for (std::size_t e = 0; e < of.edges.size(); ++e)
    ordered[CellTopology::of(of.corners).middle(of.edges[e][0], of.edges[e][1])] = nodes[of.corners + e];
  return ordered;
}

class SolidGmsh : public GmshReader {
 public:
  SolidGmsh(std::string_view bytes, const std::string& file, Bricks bricks)
      : GmshReader(bytes, file, 3), files_(file), builder_(files_, SolidBuilder::TurnedCells::put_in_order, bricks) {}

  ImportedSolidMesh read() {
    read_sections();
    if (builder_.cells() == 0)
      fail_in_file(files_.file({}), 0, 0,
                   "the file has no tetrahedra, hexahedra or wedges; save the mesh of a volume (in Gmsh: -3)");
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
  const bool is_pyramid = type == 7 || type == 14 || type == 19;
  fail(
      fmt::format("cell {} has Gmsh's type {}{}, which is not read in space; use tetrahedra, hexahedra or wedges of "
                  "order 1 or 2 (in Gmsh: -3 -order 2{})",
                  number, type, is_pyramid ? ", a pyramid" : "", is_pyramid ? ", without Recombine" : ""));
}

void SolidGmsh::find_sets(int dimension, const Tags& groups, std::int64_t entity) {
  if (last_dimension_ == dimension && last_entity_ == entity && last_groups_ == groups) return;
  last_dimension_ = dimension;
  last_entity_ = entity;
  last_groups_ = groups;
  sets_.clear();
  const auto at = static_cast<std::size_t>(dimension);
  constexpr std::array<const char*, 4> of_group{"points", "curve", "boundary", "region"},
      of_entity{"point", "curve", "surface", "volume"};
  std::vector<std::string> names;
  for (const std::int64_t tag : groups) names.push_back(group_name(dimension, tag, of_group[at]));
  if (names.empty()) names.push_back(fmt::format("{}_{}", of_entity[at], entity));
  for (const std::string& name : names)
    sets_.push_back(dimension == 3   ? builder_.cell_set(name)
                    : dimension == 2 ? builder_.side_set(name)
                    : dimension == 1 ? builder_.line_set(name)
                                     : builder_.node_set(name));
}

void SolidGmsh::add_element(const GmshElement& element, std::int64_t number, const Tags& groups, std::int64_t entity,
                            const Tags& nodes, const FilePlace& at, bool may_be_repeated) {
  find_sets(element.dimension, groups, entity);
  SolidBuilder::CellRange cells;
  if (element.dimension == 3)
    cells = builder_.add_cell(number, in_order(nodes), at, may_be_repeated ? magnitude(entity) : -1);
  const std::size_t corners = element.nodes == 3 || element.nodes == 6 ? 3 : 4;  // of a side
  for (const int set : sets_) {
    if (element.dimension == 3) builder_.add_cells_to_set(set, cells);
    if (element.dimension == 2) builder_.add_facet(set, std::span(nodes).first(corners));
    if (element.dimension == 1) builder_.add_line(set, nodes[0], nodes[1]);
    if (element.dimension == 0) builder_.add_node_to_set(set, nodes.front());
  }
}

}  // namespace

ImportedSolidMesh parse_solid_gmsh(std::string_view bytes, const std::string& file, Bricks bricks) {
  return SolidGmsh(bytes, file, bricks).read();
}

}  // namespace scabo::files
