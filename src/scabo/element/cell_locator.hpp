// Which cell of a body holds a point, and where in it.
#pragma once

#include <optional>
#include <vector>

#include "scabo/element/cell_library.hpp"
#include "scabo/element/plane/finite_element.hpp"
#include "scabo/element/plane/interior_field.hpp"

namespace scabo::element {

/// A point of a body: its cell, and scaled boundary coordinates or, in a finite element, natural coordinates.
struct CellPlace {
  std::size_t cell = 0;
  ScaledPoint scaled;
  Vec2 natural = Vec2::Zero();
};

/// Cells are found by the boxes that enclose them. Keeps references to the mesh and the cells.
class CellLocator {
 public:
  CellLocator(const mesh::BodyMesh& mesh, const SolvedCells& cells);

  /// Nothing if no cell holds the point. Between two cells, the first.
  std::optional<CellPlace> find(const Vec2& x) const;
  /// The same; a point slightly outside of the mesh (an arc is divided into polynomials, which may pass inside of it)
  /// is placed on the boundary of the nearest cell.
  CellPlace nearest(const Vec2& x) const;

 private:
  std::optional<CellPlace> in_cell(std::size_t cell, const Vec2& x) const;
  /// The point of the boundary of a cell near `x`, which lies outside; nothing if a super-element does not see it.
  struct Candidate {
    CellPlace place;
    double distance = 0.0;
  };
  std::optional<Candidate> nearest_in(std::size_t cell, const Vec2& x) const;
  Eigen::Vector2i indices_of(const Vec2& x) const;
  const std::vector<std::size_t>& bucket(int i, int j) const;

  const mesh::BodyMesh& mesh_;
  const SolvedCells& cells_;
  Vec2 low_ = Vec2::Zero(), step_ = Vec2::Ones();
  Eigen::Vector2i counts_ = Eigen::Vector2i::Ones();
  std::vector<std::vector<std::size_t>> buckets_;  // cells whose boxes overlap each; row by row; one for a single cell
};

}  // namespace scabo::element
