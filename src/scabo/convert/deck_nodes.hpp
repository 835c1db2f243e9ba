// What the lines of *BOUNDARY and *CLOAD name: nodes of the mesh and reference nodes, and their components.
#pragma once

#include <unordered_map>
#include <utility>
#include <vector>

#include "scabo/convert/deck_references.hpp"

namespace scabo::convert {

/// A line of *BOUNDARY: a word such as ENCASTRE, or degrees of freedom from 1 and a value.
struct HeldFreedoms {
  std::string word;
  int first = 1, last = 0;
  double value = 0.0;
};

class DeckNodes {
 public:
  /// `deck` must outlive it.
  DeckNodes(const files::AbaqusDeck& deck, std::vector<DeckReference> references);

  /// Nodes of a number or set: those of the mesh by their index, reference nodes by negative numbers. A node of no
  /// element is lost.
  std::vector<int> named(const files::DeckLine& line, const char* what, Remarks& remarks) const;

  /// Node and component of a degree of freedom, from 0, of a node that `named` gave; nothing, if it has no such one.
  std::optional<std::pair<int, int>> component_at(int node, int freedom) const;
  /// Of all freedoms that a line holds; a remark about a value that is lost.
  std::vector<std::pair<int, int>> components_of(int node, const HeldFreedoms& held, const files::DeckLine& line,
                                                 Remarks& remarks) const;

  /// The reference of a node of `component_at`; null for one of the mesh.
  DeckReference* reference_of(int node);
  std::vector<DeckReference> take_references() { return std::move(references_); }

  const char* body() const { return deck_.solid ? "solid" : "plane body"; }
  const char* element() const { return deck_.solid ? "solid element" : "plane element"; }

 private:
  int count() const { return static_cast<int>(references_.size()); }
  std::vector<int> references_named(const std::string& name) const;

  const files::AbaqusDeck& deck_;
  std::vector<DeckReference> references_;  // k is the node -1 - k, its node of rotations -1 - count() - k
  std::unordered_map<std::int64_t, int> node_of_;
};

/// Nothing, with a remark, if the line has no such numbers.
std::optional<HeldFreedoms> held_freedoms(const files::DeckLine& line, int dimension, Remarks& remarks);

}  // namespace scabo::convert
