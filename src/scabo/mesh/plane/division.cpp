#include "scabo/mesh/plane/division.hpp"

#include <algorithm>
#include <map>

#include "scabo/geometry/line_basis.hpp"
#include "scabo/mesh/plane/divide.hpp"
#include "scabo/mesh/plane/interface.hpp"
#include "scabo/mesh/plane/replace_elements.hpp"

namespace scabo::mesh {

namespace {

using Ends = std::pair<int, int>;

Ends ends_of(const LineElement& element) { return {element.nodes.front(), element.nodes.back()}; }

/// `nodes` of order p as those of order p + 1 on the same curve: the two ends, and the points between.
std::vector<Vec2> inner_points(const std::vector<Vec2>& curve) {
  const int order = static_cast<int>(curve.size()) - 1;
  const Matrix shape = geometry::LineBasis::of_order(order).values_at(geometry::lobatto_points(order + 1));
  std::vector<Vec2> points;
  for (Eigen::Index k = 1; k + 1 < shape.rows(); ++k) {
    Vec2 x = Vec2::Zero();
    for (std::size_t i = 0; i < curve.size(); ++i) x += shape(k, static_cast<Eigen::Index>(i)) * curve[i];
    points.push_back(x);
  }
  return points;
}

/// The element with the given ends, turned round if it runs the other way.
const LineElement* find_element(const std::map<Ends, LineElement>& elements, Ends ends, LineElement& turned) {
  if (const auto found = elements.find(ends); found != elements.end()) return &found->second;
  std::swap(ends.first, ends.second);
  const auto found = elements.find(ends);
  if (found == elements.end()) return nullptr;
  turned.nodes.assign(found->second.nodes.rbegin(), found->second.nodes.rend());
  return &turned;
}

/// `frozen`: the boundary elements of all cells, in their order.
BodyMesh enriched(const BodyMesh& mesh, const std::vector<bool>& frozen) {
  BodyMesh fine = mesh;
  fine.nodes.clear();
  std::map<int, int> number;  // new numbers of the nodes that elements share
  std::map<Ends, LineElement> element_of;
  LineElement turned;
  const auto shared = [&](int node) {
    const auto [found, is_new] = number.emplace(node, static_cast<int>(fine.nodes.size()));
    if (is_new) fine.nodes.push_back(mesh.nodes[static_cast<std::size_t>(node)]);
    return found->second;
  };
  std::size_t place = 0;
  for (Cell& cell : fine.cells) {
    if (cell.kind == CellKind::finite_element) become_superelement(cell, mesh.nodes);
    for (LineElement& element : cell.boundary) {
      const LineElement old = element;
      const bool stays = !frozen.empty() && frozen[place];
      ++place;
      if (const LineElement* of_neighbour = find_element(element_of, ends_of(old), turned)) {
        element = *of_neighbour;
        continue;
      }
      element.nodes = {shared(old.nodes.front())};
      std::vector<Vec2> curve;
      for (const int node : old.nodes) curve.push_back(mesh.nodes[static_cast<std::size_t>(node)]);
      for (const Vec2& x : stays ? std::vector<Vec2>(curve.begin() + 1, curve.end() - 1) : inner_points(curve)) {
        element.nodes.push_back(static_cast<int>(fine.nodes.size()));
        fine.nodes.push_back(x);
      }
      element.nodes.push_back(shared(old.nodes.back()));
      element_of[ends_of(old)] = element;
    }
  }
  for (auto* lines : {&fine.edges, &fine.faces})
    for (std::vector<LineElement>& edge : *lines)
      for (LineElement& element : edge) element = *find_element(element_of, ends_of(element), turned);
  for (int& corner : fine.corners)
    if (corner >= 0) corner = number.at(corner);
  for (int& node : fine.mouth)
    if (node >= 0) node = number.at(node);
  return fine;
}

/// Pairs the elements of one contact.
void pair_elements(const Joint& contact, const Interface& interface, const Mesh& mesh, PairedElements& paired) {
  if (contact.a.kind == model::Place::Kind::face) return;  // of no edge
  std::map<int, int> b_of, a_of;
  for (const ContactPair& pair : interface.pairs) {
    if (pair.node_a < 0 || pair.node_b < 0) return;  // one side is rigid and has no elements
    b_of[pair.node_a] = pair.node_b;
    a_of[pair.node_b] = pair.node_a;
  }
  const auto elements = [&](const model::Place& place) -> const std::vector<LineElement>& {
    return mesh.bodies[static_cast<std::size_t>(place.body)].edges[static_cast<std::size_t>(place.index)];
  };
  std::map<Ends, int> of_b;
  for (std::size_t k = 0; k < elements(contact.b).size(); ++k)
    of_b[ends_of(elements(contact.b)[k])] = static_cast<int>(k);
  std::vector<bool> met(elements(contact.b).size(), false);
  // A single node is the end of the overlap, and its element lies beyond it.
  const auto lies_within = [](const LineElement& element, const std::map<int, int>& partners) {
    return std::count_if(element.nodes.begin(), element.nodes.end(),
                         [&](int node) { return partners.contains(node); }) > 1;
  };
  for (std::size_t k = 0; k < elements(contact.a).size(); ++k) {
    const LineElement& element = elements(contact.a)[k];
    const EdgeElement on_a{contact.a.body, contact.a.index, static_cast<int>(k)};
    if (!lies_within(element, b_of)) continue;
    const auto first = b_of.find(element.nodes.front()), last = b_of.find(element.nodes.back());
    const auto other =
        first == b_of.end() || last == b_of.end() ? of_b.end() : of_b.find({last->second, first->second});
    if (other == of_b.end() ||
        elements(contact.b)[static_cast<std::size_t>(other->second)].nodes.size() != element.nodes.size()) {
      paired.alone.push_back(on_a);
      continue;
    }
    met[static_cast<std::size_t>(other->second)] = true;
    paired.alike.push_back({on_a, {contact.b.body, contact.b.index, other->second}});
  }
  for (std::size_t k = 0; k < met.size(); ++k)
    if (!met[k] && lies_within(elements(contact.b)[k], a_of))
      paired.alone.push_back({contact.b.body, contact.b.index, static_cast<int>(k)});
}

}  // namespace

Division initial_division(const model::Model& model) {
  Division division(model.bodies.size());
  for (std::size_t b = 0; b < model.bodies.size(); ++b) {
    const model::Body& body = model.bodies[b];
    if (!body.rigid && body.mesh.kind == model::MeshKind::superelement) division[b] = initial_division(body);
  }
  return division;
}

Mesh enriched(const model::Model& model, const Mesh& mesh, const std::vector<std::vector<bool>>& frozen) {
  Mesh fine;
  for (std::size_t b = 0; b < mesh.bodies.size(); ++b) {
    const bool finite = mesh.bodies[b].count(CellKind::finite_element) > 0;
    const bool divided = !mesh.bodies[b].cells.empty() && !(finite && (frozen.empty() || frozen[b].empty()));
    fine.bodies.push_back(divided ? enriched(mesh.bodies[b], frozen.empty() ? std::vector<bool>{} : frozen[b])
                                  : mesh.bodies[b]);
  }
  std::vector<Diagnostic> mistakes = add_interfaces(model, fine).mistakes;
  if (!mistakes.empty()) throw InputError(model.file, std::move(mistakes));
  return fine;
}

PairedElements paired_elements(const model::Model& model, const Mesh& mesh) {
  PairedElements paired;
  for (const Interface& interface : mesh.interfaces)
    pair_elements(joint_of(model.contacts[static_cast<std::size_t>(interface.contact)]), interface, mesh, paired);
  for (std::size_t t = 0; t < mesh.ties.size(); ++t) pair_elements(joint_of(model.ties[t]), mesh.ties[t], mesh, paired);
  return paired;
}

int boundary_element(const BodyMesh& mesh, int edge, int element) {
  const Ends ends = ends_of(mesh.edges[static_cast<std::size_t>(edge)][static_cast<std::size_t>(element)]);
  int place = 0;
  for (const Cell& cell : mesh.cells)
    for (const LineElement& line : cell.boundary) {
      if (ends_of(line) == ends || ends_of(line) == Ends(ends.second, ends.first)) return place;
      ++place;
    }
  return -1;
}

}  // namespace scabo::mesh
