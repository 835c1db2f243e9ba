#include "scabo/analysis/large_rotations.hpp"

#include <fmt/format.h>

#include <cmath>

#include "scabo/base/components.hpp"

namespace scabo::analysis {

namespace {

constexpr double largest_small_rotation = 0.1;  // rad, as of prescribed rotations

/// Rotation of the rigid motion nearest to the displacements `u` of nodes.
double mean_rotation(const std::vector<Vec2>& nodes, const Vector& u) {
  Vec2 centre = Vec2::Zero();
  for (const Vec2& node : nodes) centre += node / static_cast<double>(nodes.size());
  double turning = 0.0, inertia = 0.0;
  for (std::size_t node = 0; node < nodes.size(); ++node) {
    const Vec2 arm = nodes[node] - centre;
    turning += cross(arm, Vec2(u.segment<2>(place_of(node))));
    inertia += arm.squaredNorm();
  }
  return turning / inertia;
}

}  // namespace

std::string large_rotation(const Prepared& prepared, const State& state) {
  const system::Dofs& dofs = prepared.structure.dofs;
  std::size_t most = 0;
  double largest = 0.0;
  for (std::size_t b = 0; b < prepared.model.bodies.size(); ++b) {
    const auto body = static_cast<int>(b);
    const std::size_t part = dofs.part_of(body);
    if (prepared.model.bodies[b].outside || prepared.is_absent(part)) continue;
    const double rotation = dofs.is_rigid(part)
                                ? state.u[part][2] / part_of(prepared, body).lever()
                                : mean_rotation(prepared.mesh.bodies[b].nodes, dofs.of_body(body, state.u[part]));
    if (std::abs(rotation) > std::abs(largest)) largest = rotation, most = b;
  }
  // A prescribed rotation of just this size is allowed.
  if (std::abs(largest) <= largest_small_rotation * (1.0 + 1e-9)) return {};
  return fmt::format(
      "body '{}' turns by {:.3g} rad: the theory is valid for rotations of up to {:.3g} rad, and normals of contacts "
      "and "
      "directions of loads do not turn; check loads, supports and the units of stiffness",
      prepared.model.bodies[most].name, largest, largest_small_rotation);
}

}  // namespace scabo::analysis
