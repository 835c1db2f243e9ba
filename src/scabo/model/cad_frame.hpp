// Where plane outlines of shapes in space lie, as loops of lines and arcs; boxes of shapes.
#pragma once

#include <Eigen/Geometry>
#include <array>
#include <vector>

#include "scabo/files/solid_cad.hpp"
#include "scabo/model/cad_shape.hpp"

namespace scabo::model {

/// The plane of two of the axes of space, and the axis across.
struct PlaneFrame {
  std::array<int, 3> axes;

  Eigen::Vector3d at(const Vec2& point, double across) const {
    Eigen::Vector3d made;
    made[axes[0]] = point.x(), made[axes[1]] = point.y(), made[axes[2]] = across;
    return made;
  }
  Vec2 in_plane(const Eigen::Vector3d& point) const { return {point[axes[0]], point[axes[1]]}; }
};

/// The outer loop, then the holes. Arcs are cut into parts of a quarter of a circle or less.
std::vector<files::SolidLoop> loops_of(const geometry::Outline& outline, const PlaneFrame& frame, double across);

/// A box along the axes around a shape without files.
Eigen::AlignedBox3d box_of(const AnyShape& shape);

}  // namespace scabo::model
