#include "scabo/mesh/matched_side.hpp"

#include "scabo/geometry/foot_points.hpp"

namespace scabo::mesh {

MatchedSide side_of(const model::Model& model, const model::Place& place, const std::vector<BodyMesh>& bodies,
                    const FixedNodes& fixed, const Vec2& moved) {
  const BodyMesh& mesh = bodies[static_cast<std::size_t>(place.body)];
  const std::vector<LineElement>& elements = mesh.edges[static_cast<std::size_t>(place.index)];
  MatchedSide side;
  side.edge = std::make_shared<const model::Edge>(geometry::translated(
      model.bodies[static_cast<std::size_t>(place.body)].outline.edges[static_cast<std::size_t>(place.index)], moved));
  side.moved = moved;
  side.body = place.body;
  side.index = place.index;
  side.length = side.edge->length();
  // Also where a crack ends at the first point, so that there are two nodes.
  side.closed = (side.edge->at(0.0) - side.edge->at(1.0)).norm() <= 1e-9 * side.length;
  const std::set<int>& stay = fixed[static_cast<std::size_t>(place.body)];
  for (std::size_t k = 0; k <= elements.size(); ++k) {
    BreakPoint at;
    at.before = k > 0 ? elements[k - 1].nodes.back() : -1;
    at.after = k < elements.size() ? elements[k].nodes.front() : -1;
    at.point = mesh.nodes[static_cast<std::size_t>(k > 0 ? at.before : at.after)];
    if (!moved.isZero(0.0)) at.point += moved;
    const bool end = k == 0 || k == elements.size();
    at.fixed = end || at.before != at.after || stay.contains(at.before) || side.edge->is_chain();  // at its points
    const std::optional<geometry::Foot> foot = geometry::foot_on(*side.edge, at.point);
    at.t = foot ? foot->t : 0.0;
    if (side.closed && end) at.t = k == 0 ? 0.0 : 1.0;
    side.breaks.push_back(at);
    if (k < elements.size()) side.orders.push_back(static_cast<int>(elements[k].nodes.size()) - 1);
  }
  return side;
}

bool is_refined_alike(const model::Model& model, const Joint& joint) {
  const auto is_refined = [&](const model::Place& place) {
    const model::Body& body = model.bodies[static_cast<std::size_t>(place.body)];
    return !body.rigid && body.mesh.tolerance && !body.mesh.matched_anew &&
           body.mesh.kind == model::MeshKind::superelement;
  };
  return is_refined(joint.a) && is_refined(joint.b);
}

std::optional<SidesToMatch> sides_to_match(const model::Model& model, const Joint& joint,
                                           const std::vector<BodyMesh>& bodies) {
  if (is_refined_alike(model, joint) || joint.a.kind == model::Place::Kind::face) return std::nullopt;
  for (const model::Place& place : {joint.a, joint.b}) {
    const model::Body& body = model.bodies[static_cast<std::size_t>(place.body)];
    if (body.rigid) return std::nullopt;
    const std::vector<std::vector<LineElement>>& edges = bodies[static_cast<std::size_t>(place.body)].edges;
    if (edges.empty() || edges[static_cast<std::size_t>(place.index)].empty()) return std::nullopt;
  }
  const auto key = [](const model::Place& place) { return std::pair(place.body, place.index); };
  return key(joint.b) < key(joint.a) ? SidesToMatch{joint.b, joint.a, {joint.moved[1], joint.moved[0]}}
                                     : SidesToMatch{joint.a, joint.b, joint.moved};
}

}  // namespace scabo::mesh
