// How boundaries are divided, as a value: what refinement changes from mesh to mesh.
//
// Elements of different length and order may follow each other: neighbours share only their end node, and every line
// element brings its own order.
#pragma once

#include <array>
#include <compare>
#include <vector>

#include "scabo/mesh/mesh.hpp"

namespace scabo::mesh {

/// Element k of an edge runs from breaks[k] to breaks[k + 1], parts of the edge's length from 0 to 1, and has order
/// orders[k].
struct EdgeDivision {
  std::vector<double> breaks;  ///< one more than elements, ascending
  std::vector<int> orders;     ///< 1 to 16
};
using BodyDivision = std::vector<EdgeDivision>;  ///< one for each edge of the outline
using Division = std::vector<BodyDivision>;      ///< one for each body; empty: by its mesh options

/// The division by mesh options, of every super-element.
Division uniform_division(const model::Model& model);

/// make_mesh() (mesh.hpp) with super-elements divided as told.
Mesh make_mesh(const model::Model& model, const Division& division);

/// The same boundaries with elements of one order more, but for those `frozen` ([body][boundary element]; empty: none).
/// Geometry is not changed: every displacement of the old elements is one of the new ones too.
Mesh enriched(const model::Model& model, const Mesh& mesh, const std::vector<std::vector<bool>>& frozen);

/// An element of an edge of a body.
struct EdgeElement {
  int body = -1, edge = -1, element = -1;
  auto operator<=>(const EdgeElement&) const = default;
};

/// Elements of contact edges whose nodes are paired.
struct PairedElements {
  std::vector<std::array<EdgeElement, 2>>
      alike;                       ///< elements that face each other node by node, run against each other
  std::vector<EdgeElement> alone;  ///< with paired nodes but no such element: division would part the pairs
};
PairedElements paired_elements(const model::Model& model, const Mesh& mesh);

/// Place of an edge's element among the super-element's boundary.
int boundary_element(const BodyMesh& mesh, int edge, int element);

}  // namespace scabo::mesh
