#pragma once

namespace scabo::verification {

/// Cook's membrane: a tapered panel, built in at the left, sheared by a total of 1 on the right; E = 1, nu = 1/3.
inline constexpr char cooks_membrane[] = R"(
scabo: 1
analysis: {plane: stress}
materials: {panel: {young: 1, poisson: 0.3333333333333333}}
bodies:
  panel:
    material: panel
    shape: {polygon: {vertices: [[0, 0], [48, 44], [48, 60], [0, 44]]}}
    mesh: {size: 11, order: 2}
supports: [{on: panel.edge_4, fix: [x, y]}]
loads: {shear: {on: panel.edge_2, traction: [0, 0.0625]}}
output: {error: true}
)";

}  // namespace scabo::verification
