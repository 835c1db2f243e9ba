// Facets of a face as balls, and those of them that are near a line.
#pragma once

#include <Eigen/Core>
#include <algorithm>
#include <array>
#include <vector>

#include "scabo/geometry/box_tree.hpp"

namespace scabo::mesh {

/// Where a facet is, to find those opposite.
struct Ball {
  Eigen::Vector3d centre, normal;  // outwards
  double radius;
};

/// Finds the balls near a line, among those whose boxes in the plane across the axis nearest to its direction are near
/// what is seen of it there.
class BallsNearLines {
 public:
  explicit BallsNearLines(const std::vector<Ball>& balls)
      : trees_{tree_across(balls, 0), tree_across(balls, 1), tree_across(balls, 2)} {}

  /// In ascending order; `radius`: within which the boxes are.
  std::vector<std::size_t> near(const Eigen::Vector3d& point, const Eigen::Vector3d& direction, double radius) const {
    Eigen::Index axis = 0;
    direction.cwiseAbs().maxCoeff(&axis);
    const geometry::BoxTree& tree = trees_[static_cast<std::size_t>(axis)];
    const Vec2 seen = across(point, axis), along = across(direction, axis).stableNormalized();
    const auto is_near = [&](const geometry::Box& box) {
      const Vec2 apart = 0.5 * (box.low + box.high) - seen;
      return (apart - apart.dot(along) * along).norm() <= 0.5 * (box.high - box.low).norm() + radius;
    };
    std::vector<std::size_t> found;
    tree.visit([&](std::size_t node) { return is_near(tree.nodes()[node].box); },
               [&](std::size_t ball) {
                 if (is_near(tree.box(ball))) found.push_back(ball);
               });
    std::sort(found.begin(), found.end());
    return found;
  }

 private:
  static Vec2 across(const Eigen::Vector3d& x, Eigen::Index axis) { return {x[(axis + 1) % 3], x[(axis + 2) % 3]}; }
  static geometry::BoxTree tree_across(const std::vector<Ball>& balls, Eigen::Index axis) {
    std::vector<geometry::Box> boxes(balls.size());
    for (std::size_t i = 0; i < balls.size(); ++i) {
      const Vec2 centre = across(balls[i].centre, axis);
      boxes[i].low = centre.array() - balls[i].radius;
      boxes[i].high = centre.array() + balls[i].radius;
    }
    return geometry::BoxTree(std::move(boxes));
  }

  std::array<geometry::BoxTree, 3> trees_;
};

}  // namespace scabo::mesh
