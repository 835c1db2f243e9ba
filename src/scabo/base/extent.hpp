// What stands behind a point of the plane, across it: a thickness; or, of bodies of revolution, the circle on which the
// point is turned about the axis x = 0, whose length is 2 pi x.
#pragma once

#include <numbers>

namespace scabo {

struct Extent {
  double thickness = 1.0;  ///< length; not used by bodies of revolution
  bool revolved = false;

  Extent() = default;
  /// A thickness alone.
  Extent(double of_plane) : thickness(of_plane) {}
  Extent(double of_plane, bool turned) : thickness(of_plane), revolved(turned) {}

  /// Length across the plane at x.
  double at(double x) const { return revolved ? 2.0 * std::numbers::pi * x : thickness; }
};

}  // namespace scabo
