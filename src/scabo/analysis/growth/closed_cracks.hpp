// Which cells of a body change where the new parts of its cracks are closed (closed_growth.hpp).
#pragma once

#include <map>
#include <set>
#include <utility>
#include <vector>

#include "scabo/analysis/growth/tips.hpp"
#include "scabo/analysis/state/state.hpp"
#include "scabo/element/plane/interior_field.hpp"
#include "scabo/geometry/box.hpp"
#include "scabo/mesh/mesh.hpp"

namespace scabo::analysis {

/// Cells of the open body, and the one that is there in the closed body.
struct Exchange {
  std::vector<std::size_t> cells;
  mesh::Cell closed;
  // Nodes that the closed one does not have:
  std::map<int, element::ScaledPoint> on_faces = {};
  std::vector<int> between = {};
};

/// What growth of the cracks of a body changes.
class ClosedCracks {
 public:
  ClosedCracks(const Prepared& prepared, int body)
      : body_(prepared.model.bodies[static_cast<std::size_t>(body)]),
        mesh_(prepared.mesh.bodies[static_cast<std::size_t>(body)]),
        tolerance_(1e-9 * geometry::outline_size(body_.outline)) {}

  /// Whether it is known.
  bool close(const model::Model& model, const Tip& tip, const Vec2& before);

  int same(int node) const {
    const auto found = same_.find(node);
    return found == same_.end() ? node : found->second;
  }
  /// The same for faces that end at the old tip, whose two nodes are one then.
  int tied(int node) const { return old_tip_.count(node) > 0 ? *old_tip_.begin() : same(node); }
  const std::map<int, int>& joined() const { return same_; }
  const std::vector<Exchange>& exchanges() const { return exchanges_; }

 private:
  const Vec2& at(int node) const { return mesh_.nodes[static_cast<std::size_t>(node)]; }
  bool close_faces(const Tip& tip, const Vec2& before);
  bool join_at(const Tip& tip, const Vec2& before, const Vec2& now);
  bool close_at(const Vec2& tip, bool has_rings);
  std::vector<int> same_nodes(const mesh::LineElement& element) const {
    std::vector<int> nodes;
    for (const int node : element.nodes) nodes.push_back(same(node));
    return nodes;
  }
  bool set_boundary(Exchange& joined, const std::set<std::vector<int>>& faces, const Vec2& new_tip) const;
  bool is_seen(const mesh::LineElement& element, const Vec2& from, double angle) const;
  bool is_all_around(const mesh::Cell& cell) const;
  bool add_beyond(Exchange& joined, double angle) const;
  bool add_inside(Exchange& joined, int crack) const;
  /// Cell and number of every side, by its nodes.
  using Sides = std::map<std::vector<int>, std::pair<std::size_t, std::size_t>>;
  Sides sides() const;
  std::vector<std::size_t> ring_around(const Sides& sides, const Vec2& tip, std::vector<mesh::LineElement>& copy) const;
  std::set<int> nodes_of(const std::vector<std::size_t>& cells) const;

  const model::Body& body_;
  const mesh::BodyMesh& mesh_;
  double tolerance_;
  std::map<int, int> same_;  // node of a right face to the opposite one
  std::set<int> on_new_, old_tip_;
  std::vector<Exchange> exchanges_;
};

}  // namespace scabo::analysis
