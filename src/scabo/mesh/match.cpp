#include "scabo/mesh/match.hpp"

#include <map>
#include <optional>
#include <set>

#include "scabo/mesh/contact_side.hpp"
#include "scabo/mesh/matched_side.hpp"
#include "scabo/mesh/node_matching.hpp"
#include "scabo/mesh/replace_elements.hpp"
#include "scabo/mesh/unite_sides.hpp"

namespace scabo::mesh {

namespace {

/// Contacts that share edges settle after two or three rounds; more than this is a mistake of this file.
constexpr int most_rounds = 10;

/// Nodes at which materials meet.
std::set<int> material_nodes(const BodyMesh& mesh) {
  std::map<int, int> material_at;
  std::set<int> nodes;
  for (const Cell& cell : mesh.cells)
    for (std::size_t k = 0; k < cell.boundary.size(); ++k) {
      const int material = cell.materials.size() > 1 ? cell.materials[k] : cell.materials.front();
      for (const int node : {cell.boundary[k].nodes.front(), cell.boundary[k].nodes.back()})
        if (material_at.emplace(node, material).first->second != material) nodes.insert(node);
    }
  return nodes;
}

/// Nodes that are not to be moved, apart from the ends of edges.
FixedNodes fixed_nodes(const model::Model& model, const std::vector<BodyMesh>& bodies) {
  FixedNodes fixed(bodies.size());
  Mesh mesh;
  mesh.bodies = bodies;
  const auto hold = [&](const model::Place& place) {
    if (place.kind != model::Place::Kind::near || model.bodies[static_cast<std::size_t>(place.body)].rigid) return;
    const std::vector<int> nodes = nodes_of(place, mesh).nodes;
    fixed[static_cast<std::size_t>(place.body)].insert(nodes.begin(), nodes.end());
  };
  for (const model::Support& support : model.supports) hold(support.on);
  for (const model::Spring& spring : model.springs) hold(spring.on);
  for (const model::Load& load : model.loads)
    if (load.on) hold(*load.on);
  for (std::size_t b = 0; b < bodies.size(); ++b)
    if (bodies[b].cells.size() > 1) fixed[b].merge(material_nodes(bodies[b]));
  return fixed;
}

/// `edge`: that of the place, where it has moved.
ContactSide contact_side(const model::Place& place, const model::Edge& edge, const std::vector<BodyMesh>& bodies,
                         const Vec2& moved) {
  const BodyMesh& mesh = bodies[static_cast<std::size_t>(place.body)];
  const auto e = static_cast<std::size_t>(place.index);
  if (moved.isZero(0.0)) return {edge, mesh.edges[e], mesh.nodes};
  std::vector<Vec2> nodes = mesh.nodes;
  for (Vec2& node : nodes) node += moved;
  return {edge, mesh.edges[e], nodes};
}

/// Fixes the nodes of a contact that match, or returns false if some do not.
bool matches(const model::Model& model, const SidesToMatch& sides, const std::vector<BodyMesh>& bodies,
             FixedNodes& fixed) {
  const auto edge_of = [&](const model::Place& place, const Vec2& moved) {
    return geometry::translated(
        model.bodies[static_cast<std::size_t>(place.body)].outline.edges[static_cast<std::size_t>(place.index)], moved);
  };
  const model::Edge edge_a = edge_of(sides.first, sides.moved[0]), edge_b = edge_of(sides.second, sides.moved[1]);
  const ContactSide a = contact_side(sides.first, edge_a, bodies, sides.moved[0]),
                    b = contact_side(sides.second, edge_b, bodies, sides.moved[1]);
  const NodeMatching matching = match_nodes(a, b);
  if (matching.lone) return false;
  for (const auto& [i, j] : matching.partners) {
    fixed[static_cast<std::size_t>(sides.first.body)].insert(a.nodes[static_cast<std::size_t>(i)]);
    fixed[static_cast<std::size_t>(sides.second.body)].insert(b.nodes[static_cast<std::size_t>(j)]);
  }
  return true;
}

}  // namespace

std::optional<std::vector<BodyMesh>> match_sides(const model::Model& model, const std::vector<BodyMesh>& bodies,
                                                 const Placement& placement) {
  std::vector<BodyMesh> matched = bodies;
  FixedNodes fixed = fixed_nodes(model, bodies);
  const std::vector<Joint> joints = joints_of(model, placement);
  std::set<int> changed;
  for (int round = 0; round < most_rounds; ++round) {
    std::vector<SidesToMatch> apart;
    for (const Joint& joint : joints)
      if (const auto sides = sides_to_match(model, joint, matched); sides && !matches(model, *sides, matched, fixed))
        apart.push_back(*sides);
    bool any = false;
    for (const auto& [first, second, moved] : apart) {
      if (!unite_sides(side_of(model, first, matched, fixed, moved[0]),
                       side_of(model, second, matched, fixed, moved[1]), matched, fixed))
        continue;
      changed.insert({first.body, second.body});
      any = true;
    }
    if (!any) break;
  }
  if (changed.empty()) return std::nullopt;
  for (const int body : changed)
    matched[static_cast<std::size_t>(body)] = renumbered(matched[static_cast<std::size_t>(body)]);
  return matched;
}

}  // namespace scabo::mesh
