#include "scabo/files/solid_vtu.hpp"

#include <fmt/format.h>

#include <array>
#include <span>

#include "scabo/files/solid_builder.hpp"
#include "scabo/files/text_cursor.hpp"
#include "scabo/files/vtu_reader.hpp"

namespace scabo::files {

namespace {

class SolidVtu : public VtuReader {
 public:
  SolidVtu(std::string_view bytes, const std::string& file, Bricks bricks)
      : VtuReader(bytes, file), files_(file, true), builder_(files_, SolidBuilder::TurnedCells::put_in_order, bricks) {}

  ImportedSolidMesh read() {
    read_pieces();
    if (builder_.cells() == 0)
      fail_in_file(file(), 0, 0, "the file has no tetrahedra, hexahedra or wedges; save the mesh of a volume");
    name_sets();
    return builder_.finish();
  }

 private:
  std::optional<VtuShape> shape_of(std::int64_t type, std::size_t nodes) const override;
  std::string why_not_read(std::int64_t type, std::size_t nodes) const override {
    return fmt::format(
        "has VTK's type {} with {} nodes, which is not read in space; use tetrahedra, hexahedra or wedges of order 1 "
        "or 2, types 10, 12, 13 and 24 to 26 (in ParaView: Tetrahedralize)",
        type, nodes);
  }
  void add_node(std::int64_t number, double x, double y, double z, const FilePlace& at) override {
    builder_.add_node(number, x, y, z, at);
  }
  void add_cell(const VtuShape&, std::int64_t number, const std::vector<std::int64_t>& nodes,
                const FilePlace& at) override {
    ranges_.push_back(builder_.add_cell(number, nodes, at));
  }
  int cell_set(const std::string& name) override { return builder_.cell_set(name); }
  void add_cell_to_set(int set, int cell) override {
    builder_.add_cells_to_set(set, ranges_[static_cast<std::size_t>(cell)]);
  }
  void name_sets();

  MeshBuilder files_;
  SolidBuilder builder_;
  std::vector<SolidBuilder::CellRange> ranges_;  // of the cells that the file has
};

struct VtkType {
  std::int64_t type;
  VtuShape::Use use;
  int nodes, kept;  ///< 0: any count; without those in the middle of sides and cells
};

/// Lines name no face. Lagrange's cells (69 to 73) of order 1 and 2 have the same nodes in the same order as others,
/// but that of middle nodes of hexahedra and wedges depends on the version of VTK, so that these have order 1.
constexpr std::array<VtkType, 32> types_of_vtk{
    {{0, VtuShape::Use::unused, 0, 0},  {3, VtuShape::Use::unused, 0, 0},  {4, VtuShape::Use::unused, 0, 0},
     {21, VtuShape::Use::unused, 0, 0}, {68, VtuShape::Use::unused, 0, 0}, {1, VtuShape::Use::node, 0, 0},
     {2, VtuShape::Use::node, 0, 0},    {5, VtuShape::Use::facet, 3, 3},   {22, VtuShape::Use::facet, 6, 6},
     {34, VtuShape::Use::facet, 7, 7},  {69, VtuShape::Use::facet, 3, 3},  {69, VtuShape::Use::facet, 6, 6},
     {8, VtuShape::Use::facet, 4, 4},   {9, VtuShape::Use::facet, 4, 4},   {23, VtuShape::Use::facet, 8, 8},
     {28, VtuShape::Use::facet, 9, 9},  {70, VtuShape::Use::facet, 4, 4},  {70, VtuShape::Use::facet, 9, 9},
     {10, VtuShape::Use::cell, 4, 4},   {24, VtuShape::Use::cell, 10, 10}, {71, VtuShape::Use::cell, 4, 4},
     {71, VtuShape::Use::cell, 10, 10}, {11, VtuShape::Use::cell, 8, 8},   {12, VtuShape::Use::cell, 8, 8},
     {25, VtuShape::Use::cell, 20, 20}, {29, VtuShape::Use::cell, 27, 20}, {33, VtuShape::Use::cell, 24, 20},
     {13, VtuShape::Use::cell, 6, 6},   {26, VtuShape::Use::cell, 15, 15}, {32, VtuShape::Use::cell, 18, 15},
     {72, VtuShape::Use::cell, 8, 8},   {73, VtuShape::Use::cell, 6, 6}}};

std::optional<VtuShape> SolidVtu::shape_of(std::int64_t type, std::size_t nodes) const {
  const auto found = [](const VtkType& of) { return VtuShape{of.use, {}, of.nodes, of.kept}; };
  const bool of_lagrange = type >= 69 && type <= 73;
  const VtkType* same_type = nullptr;
  for (const VtkType& of : types_of_vtk) {
    if (of.type != type) continue;
    if (of.nodes == 0 || static_cast<std::size_t>(of.nodes) == nodes) return found(of);
    same_type = &of;
  }
  if (same_type == nullptr || of_lagrange) return std::nullopt;
  return found(*same_type);
}

void SolidVtu::name_sets() {
  const CellArray* regions = find_regions();
  const std::vector<std::size_t>& positions = cell_positions();
  if (regions == nullptr) return;
  for (std::size_t c = 0; c < positions.size(); ++c)
    builder_.add_cells_to_set(builder_.cell_set(fmt::format("region_{}", regions->values[positions[c]])), ranges_[c]);
  for (const SmallCell& cell : small_cells()) {
    const std::int64_t value = regions->values[cell.position];
    if (cell.facet) {
      const std::size_t n = cell.nodes.size(), corners = n == 3 || n == 6 || n == 7 ? 3 : 4;
      builder_.add_facet(builder_.side_set(fmt::format("boundary_{}", value)), std::span(cell.nodes).first(corners));
    } else {
      const int set = builder_.node_set(fmt::format("points_{}", value));
      for (const std::int64_t node : cell.nodes) builder_.add_node_to_set(set, node);
    }
  }
}

}  // namespace

ImportedSolidMesh parse_solid_vtu(std::string_view bytes, const std::string& file, Bricks bricks) {
  return SolidVtu(bytes, file, bricks).read();
}

}  // namespace scabo::files
