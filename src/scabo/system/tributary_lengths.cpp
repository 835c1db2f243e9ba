#include "scabo/system/tributary_lengths.hpp"

#include <map>

#include "scabo/geometry/line_basis.hpp"
#include "scabo/mesh/crack_faces.hpp"

namespace scabo::system {

namespace {

/// Eq. (1) for the nodes of one elastic side, in the given order.
std::vector<double> lengths_of_side(const model::Place& place, const mesh::Mesh& mesh, const std::vector<int>& paired) {
  const std::vector<Vec2>& nodes = mesh.bodies[static_cast<std::size_t>(place.body)].nodes;
  std::vector<bool> takes_part(nodes.size(), false);
  for (const int node : paired) takes_part[static_cast<std::size_t>(node)] = true;
  std::vector<Vec2> whole(nodes.size(), Vec2::Zero()), covered = whole;
  for (const mesh::LineElement& element : mesh::nodes_of(place, mesh).elements) {
    const int order = static_cast<int>(element.nodes.size()) - 1;
    const geometry::LineBasis& basis = geometry::LineBasis::of_order(order);
    bool is_covered = true;
    for (const int node : element.nodes) is_covered = is_covered && takes_part[static_cast<std::size_t>(node)];
    for (std::size_t i = 0; i < element.nodes.size(); ++i) {
      Vec2 along = Vec2::Zero();
      for (std::size_t j = 0; j < element.nodes.size(); ++j)
        along += basis.derivatives_at_nodes()(static_cast<Eigen::Index>(i), static_cast<Eigen::Index>(j)) *
                 nodes[static_cast<std::size_t>(element.nodes[j])];
      const auto node = static_cast<std::size_t>(element.nodes[i]);
      whole[node] += basis.weights()[i] * along;
      if (is_covered) covered[node] += basis.weights()[i] * along;
    }
  }
  std::vector<double> lengths;
  for (const int node : paired) {
    const auto i = static_cast<std::size_t>(node);
    lengths.push_back((covered[i].norm() > 0.0 ? covered[i] : whole[i]).norm());
  }
  return lengths;
}

/// Of the two faces of a crack. Where other cracks end on it, two pairs may share a node but not their lengths.
std::vector<double> lengths_of_crack(const model::Contact& contact, const mesh::Interface& interface,
                                     const mesh::Mesh& mesh) {
  std::map<std::pair<int, int>, double> of_pair;
  for (const mesh::FacePair& pair :
       mesh::face_pairs(mesh.bodies[static_cast<std::size_t>(contact.a.body)], contact.a.index / 2))
    of_pair[std::minmax(pair.left, pair.right)] = pair.normal.norm();
  std::vector<double> lengths;
  for (const mesh::ContactPair& pair : interface.pairs)
    lengths.push_back(of_pair.at(std::minmax(pair.node_a, pair.node_b)));
  return lengths;
}

}  // namespace

std::vector<double> tributary_lengths(int contact, const model::Model& model, const mesh::Mesh& mesh) {
  const model::Contact& named = model.contacts[static_cast<std::size_t>(contact)];
  const mesh::Interface& interface = mesh.interfaces[static_cast<std::size_t>(contact)];
  std::vector<double> lengths(interface.pairs.size(), 0.0);
  if (named.a.kind == model::Place::Kind::face) return lengths_of_crack(named, interface, mesh);
  std::vector<int> sides(lengths.size(), 0);
  for (const bool on_b : {false, true}) {
    const model::Place& place = on_b ? named.b : named.a;
    if (model.bodies[static_cast<std::size_t>(place.body)].rigid) continue;
    std::vector<int> paired;
    for (const mesh::ContactPair& pair : interface.pairs) paired.push_back(on_b ? pair.node_b : pair.node_a);
    const std::vector<double> of_side = lengths_of_side(place, mesh, paired);
    std::map<int, int> pairs_of;
    for (const int node : paired) ++pairs_of[node];
    for (std::size_t i = 0; i < lengths.size(); ++i) {
      if (pairs_of[paired[i]] > 1) continue;  // it faces the mouth of a crack, whose two nodes divide its length
      lengths[i] += of_side[i];
      ++sides[i];
    }
  }
  for (std::size_t i = 0; i < lengths.size(); ++i) {
    lengths[i] /= sides[i];
    ensure(lengths[i] > 0.0, "a node of a contact has no tributary length");
  }
  return lengths;
}

}  // namespace scabo::system
