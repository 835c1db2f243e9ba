// The sides of all cells, found by their end nodes. Time and memory grow linearly with the number of sides.
#pragma once

#include <cstddef>
#include <optional>
#include <utility>
#include <vector>

#include "scabo/files/imported_mesh.hpp"

namespace scabo::files {

/// Side `side` of cell `cell`.
struct CellSide {
  int cell = -1;
  int side = -1;
};

class SideTable {
 public:
  SideTable(const std::vector<ImportedCell>& cells, int nodes);

  /// The cell on the other side; none on the boundary.
  std::optional<CellSide> neighbour(CellSide side) const;

  /// Sides between the two ends of the facet, in either direction, with its middle node if it has one. At most two.
  std::vector<CellSide> sides_at(const Facet& facet) const;

  /// Two cells that cannot lie beside each other, as cells of one mesh.
  struct Conflict {
    CellSide first;
    CellSide second;
    enum class Kind {
      overlap,
      order
    } kind;  ///< on the same side of it; or one side straight, the other with a middle node
  };
  std::optional<Conflict> conflict() const;

 private:
  /// First and one past the last entry between two nodes.
  std::pair<std::size_t, std::size_t> between(int a, int b) const;

  struct Entry {
    int high, middle;  // the larger end
    CellSide side;
    bool forward;  // from the smaller end to the larger
  };
  const std::vector<ImportedCell>& cells_;
  std::vector<std::size_t> start_;  // per node: its first entry; entries are with their smaller end
  std::vector<Entry> entries_;
};

}  // namespace scabo::files
