// Bodies whose cells come from a mesh file.
#pragma once

#include <variant>

#include "scabo/mesh/mesh.hpp"
#include "scabo/mesh/plane/size_field.hpp"

namespace scabo::mesh {

/// The cells of body.imported: super-elements (kind: imported) or finite elements (kind: fem).
///
/// Sides keep their nodes. In super-elements a side of lower order than mesh.order is raised to it: its inner nodes lie
/// at the Gauss-Lobatto-Legendre points of the line or parabola through its nodes. The scaling centre is the centroid
/// if that sees the whole boundary well, else the point that sees it best.
///
/// Where `sizes` or mesh.refine ask for smaller cells, those of the file are divided (divided_file.hpp); cracks open
/// along sides of cells (slit.hpp).
///
/// A Diagnostic if a cell has no such point or is no finite element, or for more nodes than `most_nodes`.
std::variant<BodyMesh, Diagnostic> cells_of_file(const model::Body& body, const SizeField& sizes, double most_nodes);

}  // namespace scabo::mesh
