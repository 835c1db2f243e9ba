// Displacements and stresses of bodies in space at points of the undeformed shape.
//
// In a tetrahedron both are interpolated by its shape functions: from the displacements of its nodes, and from the
// stresses there, each the mean of those of the cells around the node, as in the .vtu files. In a super-element both
// are those of its modes.
#pragma once

#include <array>
#include <memory>
#include <optional>
#include <vector>

#include "scabo/analysis/space/solid_analysis.hpp"
#include "scabo/geometry/box_tree.hpp"
#include "scabo/result/solid/solid_stress.hpp"

namespace scabo::result {

/// The cells of a body, by points in them. `mesh` must outlive it.
class SolidFinder {
 public:
  explicit SolidFinder(const mesh::SolidMesh& mesh);

  struct Place {
    std::size_t cell = 0;
    PlaceInCell at = {};
  };
  /// A point at most 1e-6 of the size of a cell outside of it counts as inside.
  std::optional<Place> at(const Eigen::Vector3d& point) const;

 private:
  const mesh::SolidMesh& mesh_;
  std::vector<std::array<double, 2>> heights_;  // of each cell, along z
  std::unique_ptr<geometry::BoxTree> tree_;     // seen along z
};

struct SolidPlace {
  int body = -1;  ///< -1: outside of all
  SolidFinder::Place in = {};
};

/// Where points lie. `only`: of each the body that is meant, or -1. Of one that lies in several bodies, all of them.
std::vector<std::vector<SolidPlace>> places_of(const analysis::SolidModel& model,
                                               const std::vector<Eigen::Vector3d>& points,
                                               const std::vector<int>& only);

struct SolidPointValues {
  Eigen::Vector3d displacement = Eigen::Vector3d::Zero();
  std::optional<Eigen::Matrix<double, 6, 1>> stress;  ///< xx, yy, zz, xy, yz, zx; none in a rigid body
  bool absent = false;                                ///< the body is not there; the values are 0
};

/// At places in bodies.
std::vector<SolidPointValues> values_at(const analysis::SolidModel& model, const analysis::SolidIncrement& increment,
                                        const std::vector<SolidPlace>& places);

}  // namespace scabo::result
