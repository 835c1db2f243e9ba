#include "scabo/model/equal_sides.hpp"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <unordered_map>
#include <utility>

#include "scabo/base/disjoint_sets.hpp"

namespace scabo::model {

namespace {

using files::Facet;
using files::ImportedMesh;

constexpr double same_place = 1e-6;  // of the length of a side: files with six digits pass

struct FreeSide {
  Facet facet;
  int part = 0;
};

/// Sides that belong to one cell of the parts only.
std::vector<FreeSide> free_sides(const ImportedMesh& mesh, const std::vector<int>& part) {
  std::unordered_map<std::uint64_t, int> count;
  const auto key_of = [](const Facet& side) {
    const auto [low, high] = std::minmax(side.start, side.end);
    return (static_cast<std::uint64_t>(low) << 32) | static_cast<std::uint32_t>(high);
  };
  const auto for_each_side = [&](const auto& visit) {
    for (std::size_t c = 0; c < mesh.cells.size(); ++c)
      for (int i = 0; part[c] >= 0 && i < mesh.cells[c].corners(); ++i)
        visit(files::side_of(mesh.cells[c], i), part[c]);
  };
  for_each_side([&](const Facet& side, int) { ++count[key_of(side)]; });
  std::vector<FreeSide> sides;
  for_each_side([&](const Facet& side, int of) {
    if (count[key_of(side)] == 1) sides.push_back({side, of});
  });
  return sides;
}

/// Sides by the middles of their chords, in squares as large as the rounding of places, their neighbours included.
class SidesByPlace {
 public:
  SidesByPlace(const ImportedMesh& mesh, const std::vector<FreeSide>& sides) : mesh_(mesh), sides_(sides) {
    width_ = HUGE_VAL;
    for (const FreeSide& side : sides) width_ = std::min(width_, (x(side.facet.end) - x(side.facet.start)).norm());
    for (std::size_t i = 0; i < sides.size(); ++i) by_square_.emplace(square(middle(sides[i])), i);
  }

  /// A side of another part with the same ends in the other direction; -1 if there is none.
  int opposite(const FreeSide& side) const {
    const auto [i, j] = square(middle(side));
    for (long di = -1; di <= 1; ++di)
      for (long dj = -1; dj <= 1; ++dj) {
        const auto [from, to] = by_square_.equal_range({i + di, j + dj});
        for (auto other = from; other != to; ++other)
          if (sides_[other->second].part != side.part && lie_on_each_other(side.facet, sides_[other->second].facet))
            return static_cast<int>(other->second);
      }
    return -1;
  }

 private:
  using Square = std::pair<long, long>;
  struct HashOfSquare {
    std::size_t operator()(const Square& of) const {
      return static_cast<std::size_t>(of.first) * 0x9E3779B97F4A7C15u + static_cast<std::size_t>(of.second);
    }
  };

  const Vec2& x(int node) const { return mesh_.nodes[static_cast<std::size_t>(node)]; }
  Vec2 middle(const FreeSide& side) const { return 0.5 * (x(side.facet.start) + x(side.facet.end)); }
  Square square(const Vec2& at) const {
    return {static_cast<long>(std::floor(at.x() / width_)), static_cast<long>(std::floor(at.y() / width_))};
  }

  bool lie_on_each_other(const Facet& a, const Facet& b) const {
    const double tolerance = same_place * (x(a.end) - x(a.start)).norm();
    const auto same = [&](int p, int q) { return (x(p) - x(q)).norm() <= tolerance; };
    if (!same(a.start, b.end) || !same(a.end, b.start) || (a.middle < 0) != (b.middle < 0)) return false;
    return a.middle < 0 || same(a.middle, b.middle);
  }

  const ImportedMesh& mesh_;
  const std::vector<FreeSide>& sides_;
  double width_ = 1.0;  // of the squares: the shortest side
  std::unordered_multimap<Square, std::size_t, HashOfSquare> by_square_;
};

}  // namespace

int join_equal_sides(const ImportedMesh& mesh, const std::vector<int>& part, ImportedMesh& joined) {
  const std::vector<FreeSide> sides = free_sides(mesh, part);
  if (sides.empty()) return 0;
  const SidesByPlace places(mesh, sides);
  DisjointSets nodes(mesh.nodes.size());
  bool any = false;
  for (const FreeSide& side : sides) {
    const int other = places.opposite(side);
    if (other < 0) continue;
    const Facet &a = side.facet, &b = sides[static_cast<std::size_t>(other)].facet;
    for (const auto& [p, q] : {std::pair(a.start, b.end), std::pair(a.end, b.start), std::pair(a.middle, b.middle)})
      if (p >= 0) nodes.join(static_cast<std::size_t>(p), static_cast<std::size_t>(q));
    any = true;
  }
  if (!any) return 0;
  int count = 0;
  for (std::size_t i = 0; i < mesh.nodes.size(); ++i) count += nodes.root(i) != i;
  joined = mesh;
  const auto replace = [&nodes](int& node) {
    if (node >= 0) node = static_cast<int>(nodes.root(static_cast<std::size_t>(node)));
  };
  for (files::ImportedCell& cell : joined.cells)
    for (int& node : cell.nodes) replace(node);
  for (files::FacetSet& set : joined.facet_sets)
    for (Facet& facet : set.facets)
      for (int* node : {&facet.start, &facet.end, &facet.middle}) replace(*node);
  for (files::NodeSet& set : joined.node_sets)
    for (int& node : set.nodes) replace(node);
  return count;
}

}  // namespace scabo::model
