#include "scabo/system/held_points.hpp"

#include "scabo/system/structure.hpp"

namespace scabo::system {

namespace {

PairSide side_of(const Constraint& held, std::size_t part) {
  PairSide side{part, {}, held.point};
  if (held.dof >= 0) side.nodes.push_back({static_cast<int>(plane_components.node_of(held.dof)), 1.0});
  return side;
}

BarSystem held_point(const Constraint& held, std::size_t part, const model::Outline& outline) {
  BarSystem made;
  made.held = held;
  if (!held.rotation) {
    made.a.part = PairSide::ground;
    made.b = side_of(held, part);
    made.direction = held.direction();
    return made;
  }
  made.a = made.b = {part, {}, outline.centroid()};
  made.b.point.x() += half_size(outline);
  made.direction = Vec2(0.0, 1.0);
  return made;
}

}  // namespace

std::vector<BarSystem> held_points_of(const model::Model& model, const mesh::Mesh& mesh, const Dofs& dofs) {
  std::vector<BarSystem> points;
  const auto constraints = staged_constraints_of(model, mesh, dofs);
  for (std::size_t part = 0; part < constraints.size(); ++part)
    for (const Constraint& held : constraints[part]) {
      points.push_back(
          held_point(held, part, model.bodies[static_cast<std::size_t>(dofs.bodies_of(part).front())].outline));
      points.back().pull.resize(dofs.parts());
    }
  return points;
}

}  // namespace scabo::system
