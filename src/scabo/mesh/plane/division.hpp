// The division of boundaries as a value, which refinement changes from mesh to mesh.
//
// Elements of different length and order may be neighbours: they share only their end node, and every line element has
// its own order.
#pragma once

#include <array>
#include <compare>
#include <vector>

#include "scabo/mesh/mesh.hpp"
#include "scabo/mesh/plane/size_field.hpp"

namespace scabo::mesh {

/// Element k of an edge extends from breaks[k] to breaks[k + 1], fractions of the length of the edge from 0 to 1, and
/// has order orders[k].
struct EdgeDivision {
  std::vector<double> breaks;  ///< one more than there are elements, ascending
  std::vector<int> orders;     ///< 1 to 16
};
using BodyDivision = std::vector<EdgeDivision>;  ///< one for each edge of the outline
using Division = std::vector<BodyDivision>;      ///< one for each body; an empty one stands for its mesh options

/// The division that follows from the mesh options, for every super-element.
Division initial_division(const model::Model& model);

/// Upper limits of the sizes of cells, one for each body; those of bodies without many cells are not used.
using Sizes = std::vector<SizeField>;

/// make_mesh() (mesh.hpp) with the given division of bodies of one super-element, and cells no larger than `sizes` in
/// the others; `sizes` may be empty.
Mesh make_mesh(const model::Model& model, const Division& division, const Sizes& sizes = {});

/// The same boundaries with all elements raised by one order, except those `frozen` ([body][boundary element],
/// those of all cells in their order; empty: none). The geometry does not change: every displacement field of the old
/// elements is also one of the new elements. Finite elements become super-elements of the higher order, unless the
/// body has no list in `frozen`: then it stays as it is.
Mesh enriched(const model::Model& model, const Mesh& mesh, const std::vector<std::vector<bool>>& frozen);

/// An element of an edge of a body.
struct EdgeElement {
  int body = -1, edge = -1, element = -1;
  auto operator<=>(const EdgeElement&) const = default;
};

/// Elements of contact edges with paired nodes.
struct PairedElements {
  std::vector<std::array<EdgeElement, 2>> alike;  ///< elements that match node by node, with opposite directions
  std::vector<EdgeElement> alone;                 ///< elements without such a match: dividing them would separate pairs
};
PairedElements paired_elements(const model::Model& model, const Mesh& mesh);

/// Index of an element of an edge among the boundary elements of all cells, in their order; -1 if it is none of them.
int boundary_element(const BodyMesh& mesh, int edge, int element);

}  // namespace scabo::mesh
