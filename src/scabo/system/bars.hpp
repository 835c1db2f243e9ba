// Bars between two points of parts or the ground (model::Bar).
//
// With e the direction from the first end P to the second one Q, as drawn, and L their distance, the elongation of a
// bar and its tension are
//
//     d = e . (u_Q - u_P),     N = N_0 + k (d - d_0),     k = E A / L
//
// N acts on P along e and on Q against it. An end on an edge is its mean displacement, and N acts there as a uniform
// traction. Without preload N_0 = d_0 = 0. With a preload F the bar is tightened in a step: there N is a pair of
// forces that grows to F; d_0 is the elongation at the end of the step, and N_0 = F from then on.
//
// The stiffness is a pair of the contact system, of which only the normal e has a force p_n = -(N - N_0), pull and push
// alike: with the softness 1/k in W,
//
//     u_n = (d - d_0) + p_n / k = 0
//
// so that ends may be on rigid bodies, and on bodies that nothing else holds. N_0 is applied as a load.
#pragma once

#include <optional>
#include <vector>

#include "scabo/mesh/mesh.hpp"
#include "scabo/system/body_system.hpp"
#include "scabo/system/dofs.hpp"
#include "scabo/system/pair_side.hpp"

namespace scabo::system {

struct BarSystem {
  PairSide a, b;
  Vec2 direction = Vec2::Zero();  ///< e, from a to b
  double softness = 0.0;          ///< L / (E A), length / force
  /// Per part: generalised forces of a tension of 1; empty where it has no end, and of a held point.
  std::vector<Vector> pull;
  /// Of a support that begins or ends in a step: what is held at a point (held_points.hpp); empty of a bar.
  std::optional<Constraint> held = {};
};

/// Throws InputError where both ends are one point. Systems of the parts are made later: levers of rigid ones follow
/// from their outlines.
std::vector<BarSystem> bars_of(const model::Model& model, const mesh::Mesh& mesh, const Dofs& dofs);

}  // namespace scabo::system
