#include "scabo/files/gmsh.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <optional>
#include <span>

#include "scabo/files/gmsh_reader.hpp"

namespace scabo::files {

namespace {

struct PlaneGmshElement : GmshElement {
  std::optional<CellKind> kind;  // of a cell
};

constexpr std::array<PlaneGmshElement, 9> gmsh_elements{{{{1, 1, 2}, {}},
                                                         {{2, 2, 3}, CellKind::triangle3},
                                                         {{3, 2, 4}, CellKind::quad4},
                                                         {{8, 1, 3}, {}},
                                                         {{9, 2, 6}, CellKind::triangle6},
                                                         {{10, 2, 9}, CellKind::quad8},
                                                         {{15, 0, 1}, {}},
                                                         {{16, 2, 8}, CellKind::quad8},
                                                         {{34, 2, 0}, CellKind::polygon}}};

bool is_gmsh_solid(std::int64_t type) {
  constexpr std::array<int, 36> solids{4,  5,  6,  7,  11, 12, 13, 14, 17, 18, 19, 29, 30, 31, 32,  33,  71,  72,
                                       73, 74, 75, 79, 80, 81, 82, 83, 90, 91, 92, 93, 94, 95, 118, 119, 120, 35};
  return std::find(solids.begin(), solids.end(), type) != solids.end();
}

class PlaneGmsh : public GmshReader {
 public:
  PlaneGmsh(std::string_view bytes, const std::string& file) : GmshReader(bytes, file, 2), builder_(file) {}

  ImportedMesh read() {
    read_sections();
    return builder_.finish();
  }

 private:
  void reserve(std::size_t nodes, std::size_t cells) override { builder_.reserve(nodes, cells); }
  void add_node(std::int64_t number, double x, double y, double z, const FilePlace& at) override {
    builder_.add_node(number, x, y, z, at);
  }
  const GmshElement& element(std::int64_t type, std::int64_t number) override;
  void add_element(const GmshElement& element, std::int64_t number, const Tags& groups, std::int64_t entity,
                   const Tags& nodes, const FilePlace& at, bool may_be_repeated) override;

  MeshBuilder builder_;
  // Indices of the sets of the element before, which are mostly those of the next as well.
  struct Sets {
    int dimension = -1;
    std::int64_t entity = 0;
    Tags groups;
    int region = 0;
    std::vector<int> sets;
  } last_;
};

const GmshElement& PlaneGmsh::element(std::int64_t type, std::int64_t number) {
  for (const GmshElement& known : gmsh_elements) {
    if (known.type == type && (type != 34 || is_text_of_version_2())) return known;
  }
  if (is_gmsh_solid(type)) {
    fail(
        fmt::format("cell {} has Gmsh's type {}, a three-dimensional cell: a model of solids needs 'analysis: "
                    "{{space: true}}', one of the plane a plane surface only (in Gmsh: -2)",
                    number, type));
  }
  fail(
      fmt::format("cell {} has Gmsh's type {}, which is not read; use triangles and quadrilaterals of order 1 or 2 (in "
                  "Gmsh: -order 2)",
                  number, type));
}

void PlaneGmsh::add_element(const GmshElement& element, std::int64_t number, const Tags& groups, std::int64_t entity,
                            const Tags& nodes, const FilePlace& at, bool may_be_repeated) {
  const int dimension = element.dimension;
  if (last_.dimension != dimension || last_.entity != entity || last_.groups != groups) {
    last_ = {dimension, entity, groups, 0, {}};
    std::vector<std::string> names;
    constexpr std::array<const char*, 3> of_group{"points", "boundary", "region"};
    for (const std::int64_t tag : groups)
      names.push_back(group_name(dimension, tag, of_group[static_cast<std::size_t>(dimension)]));
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
    const CellKind kind = *static_cast<const PlaneGmshElement&>(element).kind;
    cell = builder_.add_cell(kind, number, std::span(nodes).first(kept), last_.region, at,
                             may_be_repeated ? magnitude(entity) : -1);
  }
  for (const int set : last_.sets) {
    if (dimension == 2) builder_.add_cell_to_set(set, cell);
    if (dimension == 1) builder_.add_facet(set, nodes);
    if (dimension == 0) builder_.add_node_to_set(set, nodes.front());
  }
}

}  // namespace

ImportedMesh parse_gmsh(std::string_view bytes, const std::string& file) { return PlaneGmsh(bytes, file).read(); }

}  // namespace scabo::files
