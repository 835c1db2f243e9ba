// The cracks of a body of many cells, as chains of segments that meet only at their ends.
#pragma once

#include <vector>

#include "scabo/model/model.hpp"

namespace scabo::mesh {

/// Cracks get a point where another one ends on them or crosses them, and where they cross the border of a region; ends
/// on the outline are moved exactly onto it. Lengths up to 1e-9 of the size of the body are rounding.
class CrackNet {
 public:
  explicit CrackNet(const model::Body& body);

  const std::vector<Vec2>& tips() const { return tips_; }  ///< ends neither on the outline nor on another crack
  const std::vector<std::vector<Vec2>>& paths() const { return paths_; }
  /// Positions at which cracks end on an edge, with 0 and 1.
  const std::vector<double>& cuts(std::size_t edge) const { return cuts_[edge]; }
  /// Positions at which cracks cross an edge of a region, with 0 and 1.
  const std::vector<double>& region_cuts(std::size_t region, std::size_t edge) const {
    return region_cuts_[region][edge];
  }

 private:
  bool divide(std::vector<Vec2>& path, std::size_t k, const Vec2& point) const;
  void divide_at_crossings(std::size_t p, std::size_t q);
  std::vector<double> cuts_by_cracks(const geometry::Edge& edge);
  bool put_on_outline(const model::Body& body, Vec2& end);
  bool put_on_crack(std::size_t own, Vec2& end);

  double tolerance_;
  std::vector<std::vector<Vec2>> paths_;
  std::vector<std::vector<double>> cuts_;
  std::vector<std::vector<std::vector<double>>> region_cuts_;
  std::vector<Vec2> tips_;
};

}  // namespace scabo::mesh
