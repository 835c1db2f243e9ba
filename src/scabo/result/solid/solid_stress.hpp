// Stress of a body in space, element by element.
#pragma once

#include <utility>

#include "scabo/analysis/space/solid_analysis.hpp"
#include "scabo/element/space/tetrahedron.hpp"

namespace scabo::result {

/// Of xx, yy, zz, xy, yz, zx.
Eigen::Matrix3d tensor_of(const element::Vec6& stress);

struct StressInSpace {
  explicit StressInSpace(const element::Vec6& stress);
  Eigen::Vector3d principal;  ///< descending: the first is the largest tension
  double von_mises;           ///< sqrt(3/2 s : s) of the deviator s
};

/// `model` and `increment` must outlive it.
class SolidStress {
 public:
  SolidStress(const analysis::SolidModel& model, const analysis::SolidIncrement& increment, std::size_t body);

  bool is_rigid() const { return body_.rigid_at.has_value(); }
  /// In a cell of an elastic body, at barycentric coordinates: xx, yy, zz, xy, yz, zx.
  element::Vec6 at(std::size_t cell, const Vector& lambda) const;
  /// At the nodes, 6 x nodes: the mean of those of the elements around each; 0 of a rigid body.
  Matrix at_nodes() const;

 private:
  Vector displacements_of(std::size_t cell) const;

  const analysis::SolidBody& body_;
  const Vector& u_;
  const Vector& heated_;  // change of temperature of the nodes, or empty
  element::Mat6 D_ = element::Mat6::Zero();
  const system::SolidCut* cut_ = nullptr;  // of a bolt
  double shortening_ = 0.0;
};

}  // namespace scabo::result
