#include "scabo/geometry/frame.hpp"

#include <Eigen/Geometry>

namespace scabo::geometry {

Eigen::Matrix3d frame_along(const Eigen::Vector3d& axis) {
  Eigen::Matrix3d frame;
  Eigen::Index least = 0;
  axis.cwiseAbs().minCoeff(&least);
  frame.col(2) = axis.normalized();
  frame.col(0) = (Eigen::Vector3d::Unit(least) - frame.col(2)[least] * frame.col(2)).normalized();
  frame.col(1) = frame.col(2).cross(frame.col(0));
  return frame;
}

}  // namespace scabo::geometry
