#include "scabo/run/sizes.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "scabo/analysis/dynamics/scheme.hpp"
#include "scabo/model/wording.hpp"
#include "scabo/system/structure.hpp"

namespace scabo::run {

namespace {

/// Degrees of freedom that are held by supports.
class Held {
 public:
  Held(const model::Model& model, const mesh::Mesh& mesh) : dofs_(model, mesh) {
    const auto constraints = system::constraints_of(model, mesh, dofs_);
    for (std::size_t p = 0; p < dofs_.parts(); ++p) {
      whole_.push_back(dofs_.is_rigid(p) && constraints[p].size() >= 3);
      held_.emplace_back(dofs_.size(p));
      if (dofs_.is_rigid(p)) continue;
      for (const system::Constraint& constraint : constraints[p]) held_[p][constraint.dof] = true;
    }
  }
  /// True if the body cannot move along `normal` at a node; `node` is -1 for a rigid body.
  bool at(int body, int node, const Vec2& normal) const {
    const std::size_t p = dofs_.part_of(body);
    if (node < 0) return whole_[p];
    const auto moves = [&](int k) { return std::abs(normal[k]) > 1e-12 && !held_[p][dofs_.of(body, node, k)]; };
    return !moves(0) && !moves(1);
  }

 private:
  system::Dofs dofs_;
  std::vector<bool> whole_;              // of every part
  std::vector<std::vector<bool>> held_;  // [part][degree of freedom]
};

}  // namespace

std::vector<int> moving_pairs(const model::Model& model, const mesh::Mesh& mesh) {
  const Held held(model, mesh);
  std::vector<int> moving;
  for (const mesh::Interface& interface : mesh.interfaces) {
    const model::Contact& contact = model.contacts[interface.contact];
    const auto moves = [&](const mesh::ContactPair& pair) {
      return !held.at(contact.a.body, pair.node_a, pair.normal) || !held.at(contact.b.body, pair.node_b, pair.normal);
    };
    moving.push_back(static_cast<int>(std::count_if(interface.pairs.begin(), interface.pairs.end(), moves)));
  }
  return moving;
}

Sizes sizes_of(const model::Model& model, const mesh::Mesh& mesh) {
  Sizes sizes;
  sizes.bodies = static_cast<int>(model.bodies.size());
  sizes.nodes = mesh.nodes();
  sizes.dofs = mesh.dofs();
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
                                 model::counted(sizes.nodes, "node"), sizes.dofs);
  if (sizes.super_elements > 0) text += ", " + model::counted(sizes.super_elements, "super-element");
  if (sizes.finite_elements > 0) text += ", " + model::counted(sizes.finite_elements, "finite element");
  return text + ", " + model::counted(sizes.contact_pairs, "contact pair");
}

int increments_of(const model::Model& model) {
  int increments = 0;
  for (const model::Step& step : model.steps) increments += model::expected_increments(step);
  return increments;
}

double solutions_of(const model::Model& model, const mesh::Mesh& mesh) {
  double solutions = 0.0;
  for (const model::Step& step : model.steps)
    solutions += step.dynamic ? std::ceil(step.dynamic->duration / analysis::longest_time_step(model, mesh, step))
                              : model::expected_increments(step);
  return solutions;
}

}  // namespace scabo::run
