// Line elements on the sides of cells that are polygons; sides on arcs are curved.
#pragma once

#include <algorithm>
#include <cstdint>
#include <optional>
#include <unordered_map>
#include <utility>
#include <vector>

#include "scabo/mesh/mesh.hpp"
#include "scabo/mesh/plane/domain.hpp"

namespace scabo::mesh {

/// The side between two nodes as one number, whichever of them is named first.
inline std::uint64_t side_number(int a, int b) {
  return (static_cast<std::uint64_t>(std::min(a, b)) << 32) | static_cast<std::uint32_t>(std::max(a, b));
}

/// A number for every side that is added, whichever of its ends is named first: of many, without an allocation for
/// each.
class SideNumbers {
 public:
  explicit SideNumbers(std::size_t nodes) : last_(nodes, -1) {}
  /// The number of a side, `given` if it is new, and whether it is.
  std::pair<int, bool> add(int a, int b, int given) {
    const int low = std::min(a, b), high = std::max(a, b);
    if (static_cast<std::size_t>(low) >= last_.size()) last_.resize(static_cast<std::size_t>(low) + 1, -1);
    int& last = last_[static_cast<std::size_t>(low)];
    for (int k = last; k >= 0; k = sides_[static_cast<std::size_t>(k)].before)
      if (sides_[static_cast<std::size_t>(k)].high == high) return {sides_[static_cast<std::size_t>(k)].number, false};
    sides_.push_back({high, given, last});
    last = static_cast<int>(sides_.size()) - 1;
    return {given, true};
  }

 private:
  struct Side {
    int high, number, before;  // the other end; the side of the same lower end that was added before
  };
  std::vector<Side> sides_;
  std::vector<int> last_;  // side of every lower end
};

/// Nodes within a side are made once, for the cells on both sides of it.
class CellSides {
 public:
  /// Keeps references; adds to `nodes`, which begin with those of the polygons.
  CellSides(const PolygonMesh& polygons, const Domain& domain, int order, std::vector<Vec2>& nodes);

  /// The elements from node `a` to node `b`, two corners of a polygon that follow each other.
  std::vector<LineElement> elements(int a, int b);
  /// The same, behind those of `to`.
  void append(int a, int b, std::vector<LineElement>& to);

  /// The arc on which a side lies; empty: it is straight.
  std::optional<geometry::Arc> arc_of(int a, int b) const;

 private:
  using Ends = std::pair<int, int>;  // lower number first

  void find_arcs(const PolygonMesh& polygons);
  void put_on_arc(int a, int b, std::size_t line);
  bool is_on_arc(int node) const {
    return static_cast<std::size_t>(node) < ends_on_arc_.size() && ends_on_arc_[static_cast<std::size_t>(node)] != 0;
  }
  void divide_at_tip(const Vec2& tip, const Ends& ends);
  LineElement element(int a, int b);
  int first_inside(const Ends& ends);
  const Vec2& at(int node) const { return nodes_[static_cast<std::size_t>(node)]; }
  int add_node(const Vec2& x);

  const Domain& domain_;
  int order_;
  std::vector<double> fractions_;  // where the nodes between the ends of an element are
  std::vector<Vec2>& nodes_;
  // By side_number():
  std::unordered_map<std::uint64_t, std::size_t> on_arc_;      // line of the domain
  std::vector<char> ends_on_arc_;                              // of every node: whether such a side ends there
  std::unordered_map<std::uint64_t, std::vector<int>> parts_;  // ends of elements that divide a side, from the lower
                                                               // number on
  SideNumbers inside_;  // first node between the ends of an element, from the lower number on: the others follow it
};

}  // namespace scabo::mesh
