#include "scabo/mesh/plane/matched_side.hpp"

#include <cmath>
#include <utility>

#include "scabo/geometry/plane/foot_points.hpp"

namespace scabo::mesh {

namespace {

/// The order of two sides: the shorter edge first, then that of fewer elements, so that the order of the bodies, or the
/// unit and the place of the model, make no difference; only where all this is equal the number of the body decides.
bool is_before(const model::Model& model, const model::Place& a, const model::Place& b,
               const std::vector<BodyMesh>& bodies) {
  const auto length = [&](const model::Place& place) {
    const auto& edges = model.bodies[static_cast<std::size_t>(place.body)].outline.edges;
    return edges[static_cast<std::size_t>(place.index)].length();
  };
  const auto elements = [&](const model::Place& place) {
    const auto& edges = bodies[static_cast<std::size_t>(place.body)].edges;
    return edges[static_cast<std::size_t>(place.index)].size();
  };
  if (std::abs(length(a) - length(b)) > 1e-9 * length(a)) return length(a) < length(b);
  if (elements(a) != elements(b)) return elements(a) < elements(b);
  return std::pair(a.body, a.index) < std::pair(b.body, b.index);
}

}  // namespace

MatchedSide side_of(const model::Model& model, int body, int edge, const std::vector<BodyMesh>& bodies,
                    const FixedNodes& fixed, const Vec2& moved) {
  const auto b = static_cast<std::size_t>(body), e = static_cast<std::size_t>(edge);
  const BodyMesh& mesh = bodies[b];
  const std::vector<LineElement>& elements = mesh.edges[e];
  MatchedSide side;
  side.edge = std::make_shared<const model::Edge>(geometry::translated(model.bodies[b].outline.edges[e], moved));
  side.moved = moved;
  side.body = body;
  side.index = edge;
  side.length = side.edge->length();
  // Also where a crack ends at the first point, so that there are two nodes.
  side.closed = (side.edge->at(0.0) - side.edge->at(1.0)).norm() <= 1e-9 * side.length;
  const std::set<int>& stay = fixed[b];
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
  if (is_before(model, joint.b, joint.a, bodies))
    return SidesToMatch{joint.b, joint.a, {joint.moved[1], joint.moved[0]}};
  return SidesToMatch{joint.a, joint.b, joint.moved};
}

}  // namespace scabo::mesh
