#include "scabo/mesh/plane/match.hpp"

#include <algorithm>
#include <cmath>
#include <map>
#include <optional>
#include <set>
#include <vector>

#include "scabo/mesh/plane/contact_side.hpp"
#include "scabo/mesh/plane/edge_ends.hpp"
#include "scabo/mesh/plane/matched_side.hpp"
#include "scabo/mesh/plane/node_matching.hpp"
#include "scabo/mesh/plane/replace_elements.hpp"
#include "scabo/mesh/plane/unite_sides.hpp"

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
  for (const model::Bar& bar : model.bars)
    for (const model::Bar::End& end : bar.between)
      if (end.on) hold(*end.on);
  for (const model::Load& load : model.loads)
    if (load.on) hold(*load.on);
  for (std::size_t b = 0; b < bodies.size(); ++b)
    if (bodies[b].cells.size() > 1) fixed[b].merge(material_nodes(bodies[b]));
  return fixed;
}

const model::Edge& edge_of(const model::Model& model, const model::Place& place) {
  return model.bodies[static_cast<std::size_t>(place.body)].outline.edges[static_cast<std::size_t>(place.index)];
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
  const model::Edge edge_a = geometry::translated(edge_of(model, sides.first), sides.moved[0]),
                    edge_b = geometry::translated(edge_of(model, sides.second), sides.moved[1]);
  const ContactSide a = contact_side(sides.first, edge_a, bodies, sides.moved[0]),
                    b = contact_side(sides.second, edge_b, bodies, sides.moved[1]);
  const NodeMatching matching = match_nodes(a, b);
  if (matching.lone || matching.unlike) return false;
  for (const auto& [i, j] : matching.partners) {
    fixed[static_cast<std::size_t>(sides.first.body)].insert(a.nodes[static_cast<std::size_t>(i)]);
    fixed[static_cast<std::size_t>(sides.second.body)].insert(b.nodes[static_cast<std::size_t>(j)]);
  }
  return true;
}

/// Sides are united one pair after the other, and an edge of several contacts is divided by all of them: in an order
/// that follows from the lengths of the edges and their elements, so that the order of the contacts, or the unit and
/// the place of the model, make no difference; only where all this is equal that of the contacts decides.
void order_by_size(const model::Model& model, const std::vector<BodyMesh>& bodies, std::vector<SidesToMatch>& sides) {
  const auto length = [&](const model::Place& place) { return edge_of(model, place).length(); };
  const auto elements = [&](const model::Place& place) {
    return bodies[static_cast<std::size_t>(place.body)].edges[static_cast<std::size_t>(place.index)].size();
  };
  std::stable_sort(sides.begin(), sides.end(), [&](const SidesToMatch& a, const SidesToMatch& b) {
    for (const auto& [x, y] : {std::pair(&a.first, &b.first), std::pair(&a.second, &b.second)}) {
      if (std::abs(length(*x) - length(*y)) > 1e-9 * length(*x)) return length(*x) < length(*y);
      if (elements(*x) != elements(*y)) return elements(*x) < elements(*y);
    }
    return false;
  });
}

using EndsOnEdges = std::map<std::array<int, 2>, std::vector<FacedEnd>>;  // by body and edge

void add_ends(const model::Place& place, std::vector<FacedEnd> ends, EndsOnEdges& all) {
  std::vector<FacedEnd>& there = all[{place.body, place.index}];
  there.insert(there.end(), ends.begin(), ends.end());
}

/// The ends of the sides of contacts and ties that do not match on the sides that they face.
void find_ends(const model::Model& model, const SidesToMatch& sides, const std::vector<BodyMesh>& bodies,
               EndsOnEdges& ends) {
  const std::array<const model::Place*, 2> places{&sides.first, &sides.second};
  const std::array<model::Edge, 2> edges{geometry::translated(edge_of(model, sides.first), sides.moved[0]),
                                         geometry::translated(edge_of(model, sides.second), sides.moved[1])};
  const Rays rays(edges[0], edges[1]);
  for (const std::size_t s : {0u, 1u}) {
    const BodyMesh& mesh = bodies[static_cast<std::size_t>(places[s]->body)];
    const std::vector<LineElement>& elements = mesh.edges[static_cast<std::size_t>(places[s]->index)];
    const auto length = [&](const LineElement& element) {
      return (mesh.nodes[static_cast<std::size_t>(element.nodes.back())] -
              mesh.nodes[static_cast<std::size_t>(element.nodes.front())])
          .norm();
    };
    add_ends(*places[1 - s],
             ends_of_elastic(edges[s], {length(elements.front()), length(elements.back())}, edges[1 - s], rays), ends);
  }
}

/// The ends of the rigid side of a contact.
void find_rigid_ends(const model::Model& model, const Joint& joint, EndsOnEdges& ends) {
  if (joint.a.kind != model::Place::Kind::edge) return;
  const auto is_rigid = [&](const model::Place& place) {
    return model.bodies[static_cast<std::size_t>(place.body)].rigid;
  };
  if (is_rigid(joint.a) == is_rigid(joint.b)) return;
  const std::size_t r = is_rigid(joint.a) ? 0 : 1;
  const std::array<const model::Place*, 2> places{&joint.a, &joint.b};
  const auto edge = [&](std::size_t s) { return geometry::translated(edge_of(model, *places[s]), joint.moved[s]); };
  add_ends(*places[1 - r], ends_of_rigid(edge(r), edge(1 - r)), ends);
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
    EndsOnEdges ends;
    for (const Joint& joint : joints) {
      find_rigid_ends(model, joint, ends);
      const auto sides = sides_to_match(model, joint, matched);
      if (!sides || matches(model, *sides, matched, fixed)) continue;
      apart.push_back(*sides);
      find_ends(model, *sides, matched, ends);
    }
    order_by_size(model, matched, apart);
    bool any = false;
    for (auto& [edge, of_others] : ends) {
      const auto& [body, index] = edge;
      const auto& edges = matched[static_cast<std::size_t>(body)].edges;
      if (edges.empty() || edges[static_cast<std::size_t>(index)].empty()) continue;  // it has no nodes
      if (!divide_at_ends(side_of(model, body, index, matched, fixed, Vec2::Zero()), of_others, matched, fixed))
        continue;
      changed.insert(body);
      any = true;
    }
    for (const auto& [first, second, moved] : apart) {
      if (!unite_sides(side_of(model, first.body, first.index, matched, fixed, moved[0]),
                       side_of(model, second.body, second.index, matched, fixed, moved[1]), matched, fixed))
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
