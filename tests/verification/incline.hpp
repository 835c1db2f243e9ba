// A block on an inclined plane.
#pragma once

#include <fmt/format.h>

#include <cmath>
#include <numbers>
#include <string>

namespace scabo::verification {

/// A block of 2 x 1 m under its weight on a rigid plane. The plane is drawn level, and gravity is turned by the angle.
/// `contact`: keys of the joint.
inline std::string incline(double degrees, const std::string& contact) {
  const double angle = degrees * std::numbers::pi / 180.0;
  return fmt::format(R"(
scabo: 1
materials: {{m: {{young: 10e9, poisson: 0.3, density: 2000}}}}
bodies:
  block: {{material: m, shape: {{rectangle: {{corner: [0, 0], size: [2, 1]}}}}, mesh: {{size: 0.25}}}}
  plane: {{rigid: true, shape: {{rectangle: {{corner: [-1, -1], size: [4, 1]}}}}}}
supports: [{{on: plane, fix: [x, y]}}]
loads: {{weight: {{gravity: [{}, {}]}}}}
contacts: {{joint: {{between: [plane.top, block.bottom], {}}}}}
)",
                     10.0 * std::sin(angle), -10.0 * std::cos(angle), contact);
}

}  // namespace scabo::verification
