// Resultants of the stress over plane sections of bodies in space.
//
// With the normal n of the plane, force = int stress n dA, moment = int (x - c) x (stress n) dA: what the side to which
// n points exerts on the other one, tension along n. Every tetrahedron is seen as eight with straight edges between its
// nodes, and every super-element as those between its centre and the triangles that the nodes of its facets form. Their
// sections are triangles, on which the stress of the cell is integrated by a rule of degree 2, which is exact where
// edges are straight and the stress is linear.
#pragma once

#include <vector>

#include "scabo/analysis/space/solid_analysis.hpp"
#include "scabo/model/solid_model.hpp"
#include "scabo/result/solid/solid_stress.hpp"

namespace scabo::result {

/// Points of an integral over a section.
struct SolidSection {
  struct Point {
    std::size_t body = 0, cell = 0;
    PlaceInCell at;
    Eigen::Vector3d x;
    double area = 0.0;
  };
  std::vector<Point> points;  ///< those of a cell one after the other; none: the plane cuts no elastic body
  Eigen::Vector3d normal, about;
};

/// The elements next to a face of a body that lies in the plane count if they are below it.
SolidSection section_of(const analysis::SolidModel& model, const model::SpaceSection& section);

struct SolidResultant {
  Eigen::Vector3d force = Eigen::Vector3d::Zero(), moment = Eigen::Vector3d::Zero();
};
SolidResultant resultant_of(const analysis::SolidModel& model, const analysis::SolidIncrement& increment,
                            const SolidSection& section);

}  // namespace scabo::result
