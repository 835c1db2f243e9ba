// Degrees of freedom: which number a component of a node has.
//
// Bodies that ties join have their tied nodes in common and form one part; every other body is a part of its own. All
// vectors of a part have as many components for each of its nodes as the mesh has dimensions, those of a rigid body one
// for each of its motions (body_system.hpp).
#pragma once

#include <span>
#include <string>
#include <vector>

#include "scabo/base/components.hpp"
#include "scabo/mesh/mesh.hpp"

namespace scabo::system {

class Dofs {
 public:
  Dofs() = default;
  Dofs(const model::Model& model, const mesh::Mesh& mesh);

  Components components() const { return components_; }
  std::size_t parts() const { return parts_.size(); }
  std::size_t part_of(int body) const { return part_of_[static_cast<std::size_t>(body)]; }
  /// Bodies of a part, ascending.
  const std::vector<int>& bodies_of(std::size_t part) const { return parts_[part].bodies; }
  bool is_rigid(std::size_t part) const { return parts_[part].rigid; }
  /// Whether one of its bodies reaches to infinity.
  bool is_unbounded(std::size_t part) const { return parts_[part].unbounded; }
  /// Positions of the nodes of an elastic part; none for a rigid one.
  const std::vector<Vec2>& nodes(std::size_t part) const { return parts_[part].nodes; }
  Eigen::Index size(std::size_t part) const {
    return parts_[part].rigid ? components_.rigid_motions() : components_.count(parts_[part].nodes.size());
  }
  /// Whether bodies are of revolution, about x = 0.
  bool revolved() const { return revolved_; }
  /// Whether a point of an elastic part lies on the axis of revolution.
  bool is_on_axis(std::size_t part, const Vec2& x) const { return revolved_ && x.x() <= parts_[part].rounding; }
  /// `body 'upper'`, or `the tied bodies 'wall', 'base'`; of many the first four, and how many others.
  std::string name_of(std::size_t part, const model::Model& model) const;

  /// Displacements of a part that moves by 1 along x (component 0) or y (1).
  Vector translation(std::size_t part, int component) const;

  /// Number of a node of an elastic body in its part.
  int node_in_part(int body, int node) const {
    const std::vector<int>& number = numbers_[static_cast<std::size_t>(body)];
    return number.empty() ? node : number[static_cast<std::size_t>(node)];
  }
  /// Number, in its part, of component 0 (x), 1 (y) or 2 (z) of a node of an elastic body.
  int of(int body, int node, int component) const {
    return static_cast<int>(components_.of(node_in_part(body, node), component));
  }
  /// Numbers of all components of each of some nodes, in their order.
  std::vector<int> of(int body, std::span<const int> nodes) const;

  /// The part's values at the degrees of freedom of one of its bodies.
  Vector of_body(int body, const Vector& of_part) const;
  /// Adds values at the degrees of freedom of a body to those of its part.
  void add(int body, const Vector& values, Vector& to_part) const;

 private:
  struct Part {
    std::vector<int> bodies;
    std::vector<Vec2> nodes;
    bool rigid = false, unbounded = false;
    double rounding = 0.0;  // of positions, length
  };

  Components components_;
  bool revolved_ = false;
  std::vector<Part> parts_;
  std::vector<std::size_t> part_of_;       // of every body
  std::vector<std::vector<int>> numbers_;  // [body][node]: number in its part; empty: the same
};

}  // namespace scabo::system
