// What a reader of mesh files promises, whatever the bytes: a mesh as the header of ImportedMesh describes it, or an
// InputError with a message.
#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <string_view>

#include "scabo/base/cell_topology.hpp"
#include "scabo/base/error.hpp"
#include "scabo/files/imported_mesh.hpp"
#include "scabo/files/imported_solid_mesh.hpp"

template <class Read>
void check_mesh_reader(const std::uint8_t* data, std::size_t size, Read read) {
  using namespace scabo::files;
  const auto require = [](bool holds) {
    if (!holds) __builtin_trap();
  };
  try {
    const ImportedMesh mesh = read(std::string_view(reinterpret_cast<const char*>(data), size), std::string("fuzz"));
    const auto is_node = [&mesh](int node) { return node >= 0 && node < static_cast<int>(mesh.nodes.size()); };
    require(!mesh.cells.empty() && mesh.materials.size() == mesh.regions.size());
    for (const scabo::Vec2& node : mesh.nodes) require(node.allFinite());
    std::size_t sides = 0;
    for (const ImportedCell& cell : mesh.cells) {
      require(cell.corners() >= 3 && area_of(mesh, cell) > 0.0);
      require(cell.region >= 0 && cell.region < static_cast<int>(mesh.regions.size()));
      for (const int node : cell.nodes) require(is_node(node));
      sides += static_cast<std::size_t>(cell.corners());
    }
    for (const FacetSet& set : mesh.facet_sets) {
      require(!set.facets.empty() && set.facets.size() <= sides);
      for (const Facet& facet : set.facets) {
        require(is_node(facet.start) && is_node(facet.end) && (facet.middle == -1 || is_node(facet.middle)));
      }
    }
    for (const NodeSet& set : mesh.node_sets) {
      require(!set.nodes.empty() && set.nodes.size() <= mesh.nodes.size());
      for (const int node : set.nodes) require(is_node(node));
    }
    for (const CellSet& set : mesh.cell_sets) {
      require(!set.cells.empty() && set.cells.size() <= mesh.cells.size());
      for (const int cell : set.cells) require(cell >= 0 && cell < static_cast<int>(mesh.cells.size()));
    }
    std::size_t on_boundary = 0;
    for (const BoundaryLoop& loop : boundary_facets(mesh)) on_boundary += loop.facets.size();
    require(on_boundary > 0 && on_boundary <= sides);
  } catch (const scabo::InputError& error) {
    require(!error.diagnostics().empty() && !error.diagnostics().front().message.empty());
  }
}

/// What the header of ImportedSolidMesh promises, or an InputError with a message.
template <class Read>
void check_solid_reader(const std::uint8_t* data, std::size_t size, Read read, bool tetrahedra_only = true) {
  using namespace scabo::files;
  const auto require = [](bool holds) {
    if (!holds) __builtin_trap();
  };
  try {
    const ImportedSolidMesh mesh =
        read(std::string_view(reinterpret_cast<const char*>(data), size), std::string("fuzz"));
    require(!mesh.cells.empty() && mesh.nodes.allFinite());
    for (const ImportedSolidCell& cell : mesh.cells) {
      const auto& topology = scabo::CellTopology::of(cell.nodes.size());
      require(tetrahedra_only ? topology.corners == 4 : topology.corners >= 4);
      for (const int node : cell.nodes) require(node >= 0 && node < mesh.nodes.cols());
    }
    for (const NodeSet& set : mesh.node_sets)
      for (const int node : set.nodes) require(node >= 0 && node < mesh.nodes.cols());
    for (const CellSet& set : mesh.cell_sets)
      for (const int cell : set.cells) require(cell >= 0 && cell < static_cast<int>(mesh.cells.size()));
    for (const SolidSideSet& set : mesh.side_sets)
      for (const SolidSide& at : set.sides)
        require(at.cell >= 0 && at.cell < static_cast<int>(mesh.cells.size()) && at.side >= 0 &&
                at.side < sides_of(mesh.cells[static_cast<std::size_t>(at.cell)]));
  } catch (const scabo::InputError& error) {
    require(!error.diagnostics().empty() && !error.diagnostics().front().message.empty());
  }
}
