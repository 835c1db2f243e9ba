#include "scabo/files/vtu.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <map>

#include "scabo/files/vtu_reader.hpp"

namespace scabo::files {

namespace {

std::optional<VtuShape> vtu_shape(std::int64_t type, std::size_t nodes) {
  using Use = VtuShape::Use;
  const int n = static_cast<int>(std::min<std::size_t>(nodes, 1'000'000'000));
  switch (type) {
    case 0:
      return VtuShape{Use::unused, {}, 0, 0};
    case 1:
      return VtuShape{Use::node, {}, 1, 1};
    case 2:
      return VtuShape{Use::node, {}, 0, n};
    case 3:
      return VtuShape{Use::facet, {}, 2, 2};
    case 5:
      return VtuShape{Use::cell, CellKind::triangle3, 3, 3};
    case 7:
      return VtuShape{Use::cell, CellKind::polygon, 0, n};
    case 8:
    case 9:
      return VtuShape{Use::cell, CellKind::quad4, 4, 4};
    case 21:
      return VtuShape{Use::facet, {}, 3, 3};
    case 22:
      return VtuShape{Use::cell, CellKind::triangle6, 6, 6};
    case 23:
      return VtuShape{Use::cell, CellKind::quad8, 8, 8};
    case 28:
      return VtuShape{Use::cell, CellKind::quad8, 9, 8};
    case 34:
      return VtuShape{Use::cell, CellKind::triangle6, 7, 6};
    case 36:
      return VtuShape{Use::cell, CellKind::quadratic_polygon, 0, n};
    case 68:  // Lagrange's cells of order 1 and 2 have the same nodes in the same order
      if (nodes == 2 || nodes == 3) return VtuShape{Use::facet, {}, n, n};
      return std::nullopt;
    case 69:
      if (nodes == 3) return VtuShape{Use::cell, CellKind::triangle3, 3, 3};
      if (nodes == 6) return VtuShape{Use::cell, CellKind::triangle6, 6, 6};
      return std::nullopt;
    case 70:
      if (nodes == 4) return VtuShape{Use::cell, CellKind::quad4, 4, 4};
      if (nodes == 9) return VtuShape{Use::cell, CellKind::quad8, 9, 8};
      return std::nullopt;
    default:
      return std::nullopt;
  }
}

bool is_vtk_solid(std::int64_t type) {
  return (type >= 10 && type <= 14) || (type >= 24 && type <= 33 && type != 28) || type == 15 || type == 16 ||
         type == 37 || type == 41 || type == 42 || (type >= 71 && type <= 74) || (type >= 78 && type <= 81);
}

class PlaneVtu : public VtuReader {
 public:
  PlaneVtu(std::string_view bytes, const std::string& file) : VtuReader(bytes, file), builder_(file, true) {}

  ImportedMesh read() {
    read_pieces();
    name_regions();
    return builder_.finish();
  }

 private:
  std::optional<VtuShape> shape_of(std::int64_t type, std::size_t nodes) const override {
    return vtu_shape(type, nodes);
  }
  std::string why_not_read(std::int64_t type, std::size_t nodes) const override;
  void add_node(std::int64_t number, double x, double y, double z, const FilePlace& at) override {
    builder_.add_node(number, x, y, z, at);
  }
  void add_cell(const VtuShape& shape, std::int64_t number, const std::vector<std::int64_t>& nodes,
                const FilePlace& at) override {
    builder_.add_cell(shape.kind, number, nodes, 0, at);
  }
  int cell_set(const std::string& name) override { return builder_.cell_set(name); }
  void add_cell_to_set(int set, int cell) override { builder_.add_cell_to_set(set, cell); }
  void name_regions();

  MeshBuilder builder_;
};

std::string PlaneVtu::why_not_read(std::int64_t type, std::size_t nodes) const {
  if (is_vtk_solid(type))
    return fmt::format(
        "has VTK's type {}, a three-dimensional cell: a model of solids needs 'analysis: {{space: true}}', one of the "
        "plane a plane surface only",
        type);
  return fmt::format(
      "has VTK's type {} with {} nodes, which is not read; use triangles, quadrilaterals and polygons of order 1 or 2",
      type, nodes);
}

void PlaneVtu::name_regions() {
  const CellArray* regions = find_regions();
  const std::vector<std::size_t>& positions = cell_positions();
  std::map<std::int64_t, int> named;
  for (std::size_t c = 0; c < positions.size(); ++c) {
    const std::int64_t value = regions == nullptr ? 0 : regions->values[positions[c]];
    auto region = named.find(value);
    if (region == named.end()) {
      const std::string name = regions == nullptr ? "elements" : fmt::format("region_{}", value);
      region = named.emplace(value, builder_.region(name)).first;
    }
    builder_.set_region(static_cast<int>(c), region->second);
  }
  if (regions == nullptr) return;
  for (const SmallCell& cell : small_cells()) {
    const std::int64_t value = regions->values[cell.position];
    if (cell.facet) {
      builder_.add_facet(builder_.facet_set(fmt::format("boundary_{}", value)), cell.nodes);
    } else {
      const int set = builder_.node_set(fmt::format("points_{}", value));
      for (const std::int64_t node : cell.nodes) builder_.add_node_to_set(set, node);
    }
  }
}

}  // namespace

ImportedMesh parse_vtu(std::string_view bytes, const std::string& file) { return PlaneVtu(bytes, file).read(); }

}  // namespace scabo::files
