// Bars between two points: bolts, anchors, props, and springs along a line.
#pragma once

#include <array>
#include <optional>
#include <string>

#include "scabo/model/place.hpp"

namespace scabo::model {

/// A bar that carries a force along the line between its two ends as they are drawn, pull and push alike.
struct Bar {
  /// A corner or point of a body; an edge, whose mean displacement it has; or a point of the ground, which does not
  /// move.
  struct End {
    std::optional<Place> on;
    Vec2 at = Vec2::Zero();  ///< of the ground
  };
  std::string name;
  std::array<End, 2> between;
  std::optional<double> stiffness;  ///< force / length, > 0; empty: that of area, young and the length of the bar
  double area = 0.0;                ///< length^2, > 0
  double young = 0.0;               ///< force / length^2, > 0
  /// Its tension at the end of the step in which it is tightened; 0: it acts from the start. Until then it has this
  /// force, growing over the step, and no stiffness; from then on its elongation counts.
  double preload = 0.0;
  int tightened = 0;  ///< index into Model::steps, of a bar with preload; below 0: in the run of `restart`
  Source source;

  /// Whether its stiffness acts in a step.
  bool acts_in(int step) const { return preload == 0.0 || step > tightened; }
};

}  // namespace scabo::model
