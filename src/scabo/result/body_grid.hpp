// Points and cells of the output grid of each body (grid.hpp).
#pragma once

#include <cstdint>
#include <memory>
#include <unordered_map>
#include <vector>

#include "scabo/mesh/mesh.hpp"
#include "scabo/result/grid.hpp"
#include "scabo/result/ring_sampling.hpp"

namespace scabo::result {

/// A body that is one super-element.
struct SuperElementBody {
  std::shared_ptr<const RingSampling> sampling;
};
/// A body of many cells. Points are numbered within the body: first those on the sides, which cells of one material
/// share.
struct CellsBody {
  struct OfCell {
    std::shared_ptr<const RingSampling> sampling;  // null: a finite element
    std::vector<std::int32_t> outer;               // shared point of every point of the ring, or of every node
    std::int32_t inner = 0;                        // first point inside
  };
  std::vector<OfCell> cells;
  std::vector<int> nodes, materials;  // of every shared point
};
struct RigidBody {
  std::vector<Vec2> arms;  // outline relative to its centroid
};

/// How many cells are equal to a super-element.
using UsesOfCells = std::unordered_map<const element::SolvedSuperElement*, std::size_t>;

/// Rings from the boundary inwards, then the centre: quadrilaterals between the rings, triangles at the centre. For an
/// unbounded domain, rings from the boundary outwards.
void add_super_element(Grid& grid, const mesh::BodyMesh& body, const RingSampling& sampling, std::int32_t number);

/// Every cell: the sides at the points that cells of one material share, and what is inside of them. Rings as above.
CellsBody add_cells(Grid& grid, const mesh::BodyMesh& body, const element::SolvedCells& cells, SamplingLibrary& library,
                    const UsesOfCells& uses, std::int32_t number);

/// The outline as one polygon, arcs in pieces of at most 3 degrees.
RigidBody add_rigid(Grid& grid, const model::Outline& outline, std::int32_t number);

}  // namespace scabo::result
