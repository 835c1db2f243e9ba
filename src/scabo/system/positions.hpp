// Positions of the nodes of a body, in the plane or in space.
#pragma once

#include <vector>

#include "scabo/base/components.hpp"
#include "scabo/base/types.hpp"

namespace scabo::system {

class Positions {
 public:
  Positions() = default;
  Positions(const std::vector<Vec2>& nodes) : columns_(2, static_cast<Eigen::Index>(nodes.size())) {
    for (std::size_t i = 0; i < nodes.size(); ++i) columns_.col(static_cast<Eigen::Index>(i)) = nodes[i];
  }
  /// d x nodes.
  explicit Positions(Matrix columns) : columns_(std::move(columns)) {}

  const Matrix& columns() const { return columns_; }
  Eigen::Index count() const { return columns_.cols(); }
  /// Of a plane body.
  std::vector<Vec2> in_plane() const {
    std::vector<Vec2> nodes;
    for (Eigen::Index i = 0; i < count(); ++i) nodes.emplace_back(columns_.col(i));
    return nodes;
  }
  Components components() const { return {static_cast<int>(columns_.rows())}; }

 private:
  Matrix columns_ = Matrix(2, 0);
};

}  // namespace scabo::system
