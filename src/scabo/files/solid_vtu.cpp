#include "scabo/files/solid_vtu.hpp"

#include <fmt/format.h>

#include "scabo/files/solid_builder.hpp"
#include "scabo/files/text_cursor.hpp"
#include "scabo/files/vtu_reader.hpp"

namespace scabo::files {

namespace {

class SolidVtu : public VtuReader {
 public:
  SolidVtu(std::string_view bytes, const std::string& file)
      : VtuReader(bytes, file), files_(file, true), builder_(files_, SolidBuilder::TurnedCells::put_in_order) {}

  ImportedSolidMesh read() {
    read_pieces();
    if (builder_.cells() == 0) fail_in_file(file(), 0, 0, "the file has no tetrahedra; save the mesh of a volume");
    name_sets();
    return builder_.finish();
  }

 private:
  std::optional<VtuShape> shape_of(std::int64_t type, std::size_t nodes) const override;
  std::string why_not_read(std::int64_t type, std::size_t nodes) const override {
    return fmt::format(
        "has VTK's type {} with {} nodes, which is not read in space; use tetrahedra of order 1 or 2 (in ParaView: "
        "Tetrahedralize)",
        type, nodes);
  }
  void add_node(std::int64_t number, double x, double y, double z, const FilePlace& at) override {
    builder_.add_node(number, x, y, z, at);
  }
  void add_cell(const VtuShape&, std::int64_t number, const std::vector<std::int64_t>& nodes,
                const FilePlace& at) override {
    builder_.add_cell(number, nodes, at);
  }
  int cell_set(const std::string& name) override { return builder_.cell_set(name); }
  void add_cell_to_set(int set, int cell) override { builder_.add_cell_to_set(set, cell); }
  void name_sets();

  MeshBuilder files_;
  SolidBuilder builder_;
};

std::optional<VtuShape> SolidVtu::shape_of(std::int64_t type, std::size_t nodes) const {
  using Use = VtuShape::Use;
  const auto shape = [](Use use, int of_file) { return VtuShape{use, {}, of_file, of_file}; };
  const int n = nodes == 10 ? 10 : 4, of_triangle = nodes == 6 ? 6 : 3;
  switch (type) {
    case 0:
    case 3:  // lines name no face
    case 4:
    case 21:
    case 68:
      return shape(Use::unused, 0);
    case 1:
    case 2:
      return shape(Use::node, 0);
    case 5:
      return shape(Use::facet, 3);
    case 22:
      return shape(Use::facet, 6);
    case 69:  // Lagrange's cells of order 1 and 2 have the same nodes in the same order
      return shape(Use::facet, of_triangle);
    case 10:
      return shape(Use::cell, 4);
    case 24:
      return shape(Use::cell, 10);
    case 71:
      return shape(Use::cell, n);
    default:
      return std::nullopt;
  }
}

void SolidVtu::name_sets() {
  const CellArray* regions = find_regions();
  const std::vector<std::size_t>& positions = cell_positions();
  if (regions == nullptr) return;
  for (std::size_t c = 0; c < positions.size(); ++c)
    builder_.add_cell_to_set(builder_.cell_set(fmt::format("region_{}", regions->values[positions[c]])),
                             static_cast<int>(c));
  for (const SmallCell& cell : small_cells()) {
    const std::int64_t value = regions->values[cell.position];
    if (cell.facet) {
      builder_.add_facet(builder_.side_set(fmt::format("boundary_{}", value)), cell.nodes);
    } else {
      const int set = builder_.node_set(fmt::format("points_{}", value));
      for (const std::int64_t node : cell.nodes) builder_.add_node_to_set(set, node);
    }
  }
}

}  // namespace

ImportedSolidMesh parse_solid_vtu(std::string_view bytes, const std::string& file) {
  return SolidVtu(bytes, file).read();
}

}  // namespace scabo::files
