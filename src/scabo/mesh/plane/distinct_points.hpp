// Points without repetition.
#pragma once

#include <cmath>
#include <cstddef>
#include <cstdint>
#include <map>
#include <utility>
#include <vector>

#include "scabo/base/types.hpp"

namespace scabo::mesh {

/// Numbers points; those closer than `tolerance` to each other have one number and the coordinates of the first. They
/// are sought in boxes of 4 x `tolerance`, counted from `origin`.
class DistinctPoints {
 public:
  explicit DistinctPoints(double tolerance, const Vec2& origin = Vec2::Zero())
      : tolerance_(tolerance), origin_(origin) {}

  int number(const Vec2& point) {
    const Vec2 place = (point - origin_) / (4.0 * tolerance_);
    const auto i = static_cast<std::int64_t>(std::floor(place.x())),
               j = static_cast<std::int64_t>(std::floor(place.y()));
    for (std::int64_t a = i - 1; a <= i + 1; ++a)
      for (std::int64_t b = j - 1; b <= j + 1; ++b)
        if (const auto found = boxes_.find({a, b}); found != boxes_.end())
          for (const int n : found->second)
            if ((points[static_cast<std::size_t>(n)] - point).norm() <= tolerance_) return n;
    boxes_[{i, j}].push_back(static_cast<int>(points.size()));
    points.push_back(point);
    return static_cast<int>(points.size()) - 1;
  }

  std::vector<Vec2> points;

 private:
  double tolerance_;
  Vec2 origin_;
  std::map<std::pair<std::int64_t, std::int64_t>, std::vector<int>> boxes_;
};

}  // namespace scabo::mesh
