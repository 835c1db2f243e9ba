// Cells of a mesh file that are too large are divided, as often as it takes.
//
// A cell with n corners becomes n quadrilaterals: from a corner to the middle of the next side, a point inside that
// sees all of the cell, and the middle of the side before. Its neighbours keep their shape and take the new points of
// common sides as ordinary corners, because a cell takes any number of them; a finite element beside such a point,
// which has then too many corners, becomes a super-element. Sides keep their place: straight ones stay straight, and
// the halves of a parabola through three nodes lie on it, so that the outline of the body is that of the file.
#pragma once

#include <functional>
#include <vector>

#include "scabo/files/imported_mesh.hpp"

namespace scabo::mesh {

/// `mesh` with cells whose box has no side longer than `size_at` its middle. Cells that no point sees as a whole stay
/// as they are, and so do those that are `kept` (empty: none). It ends with more than `most_cells` as soon as there are
/// that many.
files::ImportedMesh divided_mesh(const files::ImportedMesh& mesh, const std::function<double(const Vec2&)>& size_at,
                                 double most_cells, const std::vector<bool>& kept = {});

/// The cells in the first `rows` rows around points (at which nodes lie, to within `tolerance`).
std::vector<bool> cells_around(const files::ImportedMesh& mesh, const std::vector<Vec2>& points, int rows,
                               double tolerance);

}  // namespace scabo::mesh
