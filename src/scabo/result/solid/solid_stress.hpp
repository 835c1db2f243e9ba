// Stress of a body in space, cell by cell.
#pragma once

#include <optional>
#include <utility>

#include "scabo/analysis/space/solid_analysis.hpp"
#include "scabo/element/space/solid_cell.hpp"

namespace scabo::result {

/// Of xx, yy, zz, xy, yz, zx.
Eigen::Matrix3d tensor_of(const element::Vec6& stress);

struct StressInSpace {
  explicit StressInSpace(const element::Vec6& stress);
  Eigen::Vector3d principal;  ///< descending: the first is the largest tension
  double von_mises;           ///< sqrt(3/2 s : s) of the deviator s
};

/// A place in a cell. Straight lines in the cell are straight in its coordinates, but for curved sides.
struct PlaceInCell {
  Vector lambda;   ///< barycentric; of a super-element element::PyramidPlace::at
  int facet = -1;  ///< of a super-element
};

/// Displacements and stresses in one cell of an elastic body.
class CellField {
 public:
  CellField(Matrix nodes, Vector u, std::optional<element::SolidInterior> interior)
      : nodes_(std::move(nodes)), u_(std::move(u)), interior_(std::move(interior)) {}

  Eigen::Vector3d displacement_at(const PlaceInCell& place) const;
  element::Vec6 strain_at(const PlaceInCell& place) const;

 private:
  Matrix nodes_;
  Vector u_;
  std::optional<element::SolidInterior> interior_;  // of a super-element
};

/// `model` and `increment` must outlive it.
class SolidStress {
 public:
  SolidStress(const analysis::SolidModel& model, const analysis::SolidIncrement& increment, std::size_t body);

  bool is_rigid() const { return body_.rigid_at.has_value(); }
  CellField field_of(std::size_t cell) const;
  /// In a cell of an elastic body with this field: xx, yy, zz, xy, yz, zx.
  element::Vec6 at(std::size_t cell, const CellField& field, const PlaceInCell& place) const;
  /// At the nodes, 6 x nodes: the mean of those of the cells around each; 0 of a rigid body.
  Matrix at_nodes() const;

 private:
  Vector displacements_of(std::size_t cell) const;
  element::SolidCellLoads loads_in(std::size_t cell, const Matrix& nodes) const;

  const analysis::SolidBody& body_;
  const Vector& u_;
  const Vector& heated_;  // change of temperature of the nodes, or empty
  element::InsideCells inside_;
  element::Mat6 D_ = element::Mat6::Zero();
  const system::SolidCut* cut_ = nullptr;  // of a bolt
  double shortening_ = 0.0;
};

}  // namespace scabo::result
