#include "sizes.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "scabo/system/structure.hpp"
#include "terminal.hpp"

namespace scabo::app {

namespace {

/// Degrees of freedom of one body that are held by supports.
class Held {
 public:
  Held(const model::Body& body, const mesh::BodyMesh& mesh, const std::vector<system::Constraint>& constraints)
      : whole_(body.rigid && constraints.size() >= 3), dofs_(2 * mesh.nodes.size()) {
    if (body.rigid) return;
    for (const system::Constraint& constraint : constraints) dofs_[constraint.dof] = true;
  }
  /// True if the body cannot move along `normal`; `node` is used only for an elastic body.
  bool at(int node, const Vec2& normal) const {
    if (node < 0) return whole_;
    const auto moves = [&](int k) { return std::abs(normal[k]) > 1e-12 && !dofs_[2 * node + k]; };
    return !moves(0) && !moves(1);
  }

 private:
  bool whole_;
  std::vector<bool> dofs_;  // two for each node
};

}  // namespace

std::vector<int> moving_pairs(const model::Model& model, const mesh::Mesh& mesh) {
  const auto constraints = system::constraints_of(model, mesh);
  std::vector<Held> held;
  for (size_t i = 0; i < model.bodies.size(); ++i) held.emplace_back(model.bodies[i], mesh.bodies[i], constraints[i]);
  std::vector<int> moving;
  for (const mesh::Interface& interface : mesh.interfaces) {
    const model::Contact& contact = model.contacts[interface.contact];
    const auto moves = [&](const mesh::ContactPair& pair) {
      return !held[contact.a.body].at(pair.node_a, pair.normal) || !held[contact.b.body].at(pair.node_b, pair.normal);
    };
    moving.push_back(static_cast<int>(std::count_if(interface.pairs.begin(), interface.pairs.end(), moves)));
  }
  return moving;
}

Sizes sizes_of(const model::Model& model, const mesh::Mesh& mesh) {
  Sizes sizes;
  sizes.bodies = static_cast<int>(model.bodies.size());
  sizes.nodes = mesh.nodes();
  sizes.dofs = 2 * sizes.nodes;
  for (const mesh::BodyMesh& body : mesh.bodies) {
    sizes.super_elements += body.count(mesh::CellKind::superelement);
    sizes.finite_elements += body.count(mesh::CellKind::finite_element);
  }
  for (const int pairs : moving_pairs(model, mesh)) sizes.contact_pairs += pairs;
  return sizes;
}

std::string describe_sizes(const Sizes& sizes) {
  std::string text = fmt::format("{}, {}, {} degrees of freedom",
                                 sizes.bodies == 1 ? "1 body" : fmt::format("{} bodies", sizes.bodies),
                                 count(sizes.nodes, "node"), sizes.dofs);
  if (sizes.super_elements > 0) text += ", " + count(sizes.super_elements, "super-element");
  if (sizes.finite_elements > 0) text += ", " + count(sizes.finite_elements, "finite element");
  return text + ", " + count(sizes.contact_pairs, "contact pair");
}

int increments_of(const model::Model& model) {
  int increments = 0;
  for (const model::Step& step : model.steps) increments += step.increments;
  return increments;
}

}  // namespace scabo::app
