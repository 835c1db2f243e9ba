// What stands behind a point of the plane, across it: a thickness; or, of bodies of revolution, the arc on which the
// point is turned about the axis x = 0: the whole circle, whose length is 2 pi x, or one radian of it, x.
#pragma once

#include <numbers>

namespace scabo {

struct Extent {
  double thickness = 1.0;  ///< length; not used by bodies of revolution
  bool revolved = false;
  double angle = 2.0 * std::numbers::pi;  ///< of bodies of revolution: 2 pi, or 1 for forces per radian

  Extent() = default;
  /// A thickness alone.
  Extent(double of_plane) : thickness(of_plane) {}
  Extent(double of_plane, bool turned, double by = 2.0 * std::numbers::pi)
      : thickness(of_plane), revolved(turned), angle(by) {}

  /// Length across the plane at x.
  double at(double x) const { return revolved ? angle * x : thickness; }
};

}  // namespace scabo
