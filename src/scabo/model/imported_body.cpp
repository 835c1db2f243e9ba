#include "scabo/model/imported_body.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>
#include <map>
#include <numbers>
#include <unordered_map>
#include <unordered_set>

#include "scabo/base/disjoint_sets.hpp"
#include "scabo/geometry/box.hpp"
#include "scabo/model/equal_sides.hpp"
#include "scabo/model/wording.hpp"

namespace scabo::model {

namespace {

using files::BoundaryLoop;
using files::Facet;
using files::ImportedCell;
using files::ImportedMesh;

/// A boundary without a set is cut where it turns by more than this.
constexpr double corner_turn = std::numbers::pi / 6;
/// Straight segments for a curved side. Nodes that a contact inserts lie on them: with 8, the pressure of a disc in a
/// ring of another division deviates by 12 % from a uniform one, with 32 by 0.7 %.
constexpr int segments_of_side = 32;
/// Distance from a line, relative to its length, of points that lie on it.
constexpr double on_line = 1e-10;

const Vec2& at(const ImportedMesh& mesh, int node) { return mesh.nodes[static_cast<std::size_t>(node)]; }

/// Whether each cell is one of the part.
using Chosen = std::vector<bool>;

/// The chosen cells, with nodes and regions of their own; `original`: number of each node in `whole`.
ImportedMesh part_of(const ImportedMesh& whole, const Chosen& chosen, std::vector<int>& original) {
  ImportedMesh part;
  std::vector<int> number(whole.nodes.size(), -1);
  std::vector<int> region_number(whole.regions.size(), -1);
  for (std::size_t c = 0; c < whole.cells.size(); ++c) {
    const ImportedCell& cell = whole.cells[c];
    if (!chosen[c]) continue;
    ImportedCell& copy = part.cells.emplace_back(cell);
    int& of_region = region_number[static_cast<std::size_t>(cell.region)];
    if (of_region < 0) {
      of_region = static_cast<int>(part.regions.size());
      part.regions.push_back(whole.regions[static_cast<std::size_t>(cell.region)]);
      part.materials.push_back(whole.materials.empty() ? "" : whole.materials[static_cast<std::size_t>(cell.region)]);
    }
    copy.region = of_region;
    for (int& node : copy.nodes) {
      int& new_number = number[static_cast<std::size_t>(node)];
      if (new_number < 0) {
        new_number = static_cast<int>(part.nodes.size());
        part.nodes.push_back(at(whole, node));
        original.push_back(node);
      }
      node = new_number;
    }
  }
  return part;
}

/// Key of the two ends of a side, in either direction.
std::uint64_t key_of(int a, int b) {
  const auto [low, high] = std::minmax(a, b);
  return (static_cast<std::uint64_t>(low) << 32) | static_cast<std::uint32_t>(high);
}

/// Direction of a side at its start or end.
Vec2 direction_of(const ImportedMesh& mesh, const Facet& facet, bool at_end) {
  const Vec2 &a = at(mesh, facet.start), &b = at(mesh, facet.end);
  if (facet.middle < 0) return (b - a).normalized();
  const Vec2& m = at(mesh, facet.middle);
  const Vec2 along = at_end ? Vec2(a - 4.0 * m + 3.0 * b) : Vec2(4.0 * m - 3.0 * a - b);
  return along.norm() > 0.0 ? along.normalized() : (b - a).normalized();
}

bool is_corner(const ImportedMesh& mesh, const Facet& before, const Facet& after) {
  const Vec2 from = direction_of(mesh, before, true), to = direction_of(mesh, after, false);
  return std::abs(std::atan2(cross(from, to), from.dot(to))) > corner_turn * (1.0 + 1e-9);
}

/// The points of a side after its start, its end included.
void append_points(const ImportedMesh& mesh, const Facet& facet, std::vector<Vec2>& points) {
  const Vec2 &a = at(mesh, facet.start), &b = at(mesh, facet.end);
  if (facet.middle >= 0) {
    const Vec2 &m = at(mesh, facet.middle), chord = b - a;
    if (std::abs(cross(chord, Vec2(m - a))) > on_line * chord.squaredNorm())
      for (int k = 1; k < segments_of_side; ++k) {
        const double s = 2.0 * k / segments_of_side - 1.0;
        points.push_back(0.5 * s * (s - 1.0) * a + (1.0 - s) * (1.0 + s) * m + 0.5 * s * (s + 1.0) * b);
      }
  }
  points.push_back(b);
}

/// Whether all points lie on the line from the first to the last, in this order.
bool on_one_line(const std::vector<Vec2>& points) {
  const Vec2 along = points.back() - points.front();
  const double length = along.norm();
  double before = 0.0;
  for (std::size_t i = 1; i < points.size(); ++i) {
    const Vec2 arm = points[i] - points.front();
    const double far = arm.dot(along) / length;
    if (!(far > before) || std::abs(cross(along, arm)) > on_line * length * length) return false;
    before = far;
  }
  return true;
}

/// Makes the outline of a part.
class OutlineMaker {
 public:
  OutlineMaker(const ImportedMesh& whole, const Chosen& chosen, const ImportedMesh& part,
               const std::vector<int>& original)
      : part_(part), original_(original) {
    for (BoundaryLoop& loop : files::boundary_facets(part)) {
      const bool outer = loop.area > 0.0;
      loops_.insert(outer ? loops_.begin() + outer_loops_++ : loops_.end(), std::move(loop));
    }
    collect_names(whole, chosen);
    for (const auto& set : whole.node_sets)
      if (set.nodes.size() == 1) points_.emplace(set.nodes.front(), name_from(set.name));
  }

  ImportedBody make() {
    for (const std::string& name : names_) used_.insert(name);
    for (std::size_t k = 0; k < loops_.size(); ++k) {
      if (k > 0) body_.outline.holes.push_back(static_cast<int>(body_.outline.edges.size()));
      add_loop(loops_[k]);
    }
    name_corners();
    return std::move(body_);
  }

  std::vector<files::FacetSet> take_sides() { return std::move(sides_); }

 private:
  const std::vector<int>& label_of(const Facet& facet) const {
    static const std::vector<int> none;
    const auto found = labels_.find(whole_key(facet));
    return found == labels_.end() ? none : found->second;
  }
  std::uint64_t whole_key(const Facet& facet) const {
    return key_of(original_[static_cast<std::size_t>(facet.start)], original_[static_cast<std::size_t>(facet.end)]);
  }

  /// The names of every side of the boundary: neighbouring regions first, then sets.
  void collect_names(const ImportedMesh& whole, const Chosen& chosen) {
    std::unordered_set<std::uint64_t> boundary;
    for (const BoundaryLoop& loop : loops_)
      for (const Facet& facet : loop.facets) boundary.insert(whole_key(facet));
    std::map<std::string, int> number;
    const auto add = [&](std::uint64_t key, const std::string& name) {
      if (!boundary.contains(key)) return;
      const auto [found, is_new] = number.emplace(name, static_cast<int>(names_.size()));
      if (is_new) names_.push_back(name);
      std::vector<int>& label = labels_[key];
      if (std::find(label.begin(), label.end(), found->second) == label.end()) label.push_back(found->second);
    };
    for (std::size_t c = 0; c < whole.cells.size(); ++c) {
      const ImportedCell& cell = whole.cells[c];
      for (int i = 0; !chosen[c] && i < cell.corners(); ++i) {
        const Facet side = files::side_of(cell, i);
        const std::uint64_t key = key_of(side.start, side.end);
        if (boundary.contains(key)) add(key, "to_" + name_from(whole.regions[static_cast<std::size_t>(cell.region)]));
      }
    }
    for (const auto& set : whole.facet_sets)
      for (const Facet& facet : set.facets) add(key_of(facet.start, facet.end), name_from(set.name));
    for (auto& entry : labels_) std::sort(entry.second.begin(), entry.second.end());
  }

  const std::string* point_name(int node) const {
    const auto found = points_.find(original_[static_cast<std::size_t>(node)]);
    return found == points_.end() ? nullptr : &found->second;
  }

  bool is_break(const Facet& before, const Facet& after) const {
    const std::vector<int>&first = label_of(before), &second = label_of(after);
    if (first != second) return true;
    return first.empty() && (point_name(after.start) != nullptr || is_corner(part_, before, after));
  }

  void add_loop(const BoundaryLoop& loop) {
    const std::size_t count = loop.facets.size();
    std::vector<std::size_t> breaks;
    for (std::size_t i = 0; i < count; ++i)
      if (is_break(loop.facets[(i + count - 1) % count], loop.facets[i])) breaks.push_back(i);
    if (breaks.empty()) {  // one closed edge; it starts as if all its nodes were corners
      for (std::size_t i = 0; i < count; ++i) breaks.push_back(i);
      breaks = {lowest(loop, breaks)};
    }
    const auto first = std::find(breaks.begin(), breaks.end(), lowest(loop, breaks));
    std::rotate(breaks.begin(), first, breaks.end());
    for (std::size_t k = 0; k < breaks.size(); ++k) {
      const std::size_t from = breaks[k], to = breaks[(k + 1) % breaks.size()];
      std::vector<Facet> run;
      std::size_t i = from;
      do {
        run.push_back(loop.facets[i]);
        i = (i + 1) % count;
      } while (i != to);
      add_edge(std::move(run));
    }
  }

  std::size_t lowest(const BoundaryLoop& loop, const std::vector<std::size_t>& breaks) const {
    geometry::Box box;
    for (const Facet& facet : loop.facets) box.add(at(part_, facet.start));
    const double rounding = 1e-9 * (box.high - box.low).norm();
    std::size_t best = breaks.front();
    for (const std::size_t i : breaks) {
      const Vec2 &x = at(part_, loop.facets[i].start), &least = at(part_, loop.facets[best].start);
      if (x.y() < least.y() - rounding || (x.y() <= least.y() + rounding && x.x() < least.x())) best = i;
    }
    return best;
  }

  void add_edge(std::vector<Facet> run) {
    geometry::Edge edge;
    std::vector<Vec2> points{at(part_, run.front().start)};
    for (const Facet& facet : run) append_points(part_, facet, points);
    edge.start = points.front();
    edge.end = points.back();
    if (!on_one_line(points)) edge.points.assign(points.begin() + 1, points.end() - 1);
    const std::vector<int>& label = label_of(run.front());
    if (label.empty()) {
      do edge.names = {fmt::format("edge_{}", ++unnamed_)};
      while (!used_.insert(edge.names.front()).second);
    }
    for (const int name : label) edge.names.push_back(piece_name(names_[static_cast<std::size_t>(name)]));
    if (!label.empty())
      for (std::size_t i = 1; i < run.size(); ++i)
        if (const std::string* name = point_name(run[i].start))
          body_.lost_points.emplace(*name, at(part_, run[i].start));
    corner_nodes_.push_back(run.front().start);
    body_.outline.corners.push_back({{}, edge.start});
    sides_.push_back({edge.names.front(), std::move(run)});
    body_.outline.edges.push_back(std::move(edge));
  }

  /// NAME for the first piece of a set, then NAME_2, NAME_3, ...
  std::string piece_name(const std::string& name) {
    int& count = pieces_[name];
    if (++count == 1) return name;
    std::string made = fmt::format("{}_{}", name, count);
    while (!used_.insert(made).second) made = fmt::format("{}_{}", name, ++count);
    body_.pieces[name].push_back(made);
    return made;
  }

  void name_corners() {
    int number = 0;
    for (std::size_t i = 0; i < corner_nodes_.size(); ++i) {
      std::vector<std::string>& names = body_.outline.corners[i].names;
      do names = {fmt::format("vertex_{}", ++number)};
      while (!used_.insert(names.front()).second);
    }
    for (std::size_t i = 0; i < corner_nodes_.size(); ++i)
      if (const std::string* name = point_name(corner_nodes_[i])) {
        std::string made = *name;
        for (int k = 2; !used_.insert(made).second; ++k) made = fmt::format("{}_{}", *name, k);
        body_.outline.corners[i].names.push_back(made);
      }
  }

  const ImportedMesh& part_;
  const std::vector<int>& original_;
  std::vector<BoundaryLoop> loops_;  // the outer ones first
  int outer_loops_ = 0;
  std::vector<std::string> names_;
  std::unordered_map<std::uint64_t, std::vector<int>> labels_;  // of sides: indices into names_
  std::unordered_map<int, std::string> points_;                 // of nodes of the whole mesh
  std::unordered_set<std::string> used_;
  std::map<std::string, int> pieces_;
  int unnamed_ = 0;
  std::vector<int> corner_nodes_;
  std::vector<files::FacetSet> sides_;
  ImportedBody body_;
};

/// The sides of a set as chains, each from one of its ends to the other; a closed one begins anywhere.
std::vector<std::vector<int>> chains_of(const std::vector<Facet>& facets) {
  std::multimap<int, std::size_t> at_node;
  for (std::size_t i = 0; i < facets.size(); ++i)
    at_node.emplace(facets[i].start, i), at_node.emplace(facets[i].end, i);
  std::vector<bool> used(facets.size(), false);
  std::vector<std::vector<int>> chains;
  const auto walk = [&](std::size_t first, int node) {
    std::vector<int> chain{node};
    for (std::size_t i = first; i < facets.size();) {
      used[i] = true;
      node = facets[i].start == node ? facets[i].end : facets[i].start;
      chain.push_back(node);
      i = facets.size();
      if (at_node.count(node) != 2) break;  // an end, or a place where chains meet
      const auto [from, to] = at_node.equal_range(node);
      for (auto other = from; other != to; ++other)
        if (!used[other->second]) i = other->second;
    }
    chains.push_back(std::move(chain));
  };
  for (std::size_t i = 0; i < facets.size(); ++i)
    if (!used[i] && at_node.count(facets[i].start) != 2) walk(i, facets[i].start);
  for (std::size_t i = 0; i < facets.size(); ++i)
    if (!used[i] && at_node.count(facets[i].end) != 2) walk(i, facets[i].end);
  for (std::size_t i = 0; i < facets.size(); ++i)
    if (!used[i]) walk(i, facets[i].start);
  return chains;
}

/// Sets of sides of which some lie between cells of the part.
std::map<std::string, std::vector<std::vector<Vec2>>> lines_of(const ImportedMesh& whole, const ImportedMesh& part,
                                                               const std::vector<int>& original) {
  std::map<std::string, std::vector<std::vector<Vec2>>> lines;
  std::unordered_set<std::uint64_t> boundary, sides;
  for (const ImportedCell& cell : part.cells)
    for (int i = 0; i < cell.corners(); ++i) {
      const Facet side = files::side_of(cell, i);
      const std::uint64_t key =
          key_of(original[static_cast<std::size_t>(side.start)], original[static_cast<std::size_t>(side.end)]);
      if (sides.insert(key).second)
        boundary.insert(key);
      else
        boundary.erase(key);
    }
  for (const files::FacetSet& set : whole.facet_sets) {
    std::vector<Facet> inside;
    bool within = false;
    for (const Facet& facet : set.facets) {
      const std::uint64_t key = key_of(facet.start, facet.end);
      if (!sides.contains(key)) continue;
      inside.push_back(facet);
      within = within || !boundary.contains(key);
    }
    if (!within) continue;
    auto& chains = lines[name_from(set.name)];
    for (const std::vector<int>& chain : chains_of(inside)) {
      std::vector<Vec2>& points = chains.emplace_back();
      for (const int node : chain) points.push_back(at(whole, node));
    }
  }
  return lines;
}

std::string quoted_list(const std::vector<std::string>& names) {
  std::vector<std::string> quoted;
  for (const std::string& name : names) quoted.push_back("'" + name + "'");
  return name_list(quoted);
}

/// Which of the chosen cells sides join: the number of the part of each, in the order of their first cells; -1 for
/// others.
std::vector<int> parts_of(const ImportedMesh& mesh, const Chosen& chosen, int& count) {
  std::unordered_map<std::uint64_t, std::size_t> first;
  DisjointSets sets(mesh.cells.size());
  for (std::size_t c = 0; c < mesh.cells.size(); ++c)
    for (int i = 0; chosen[c] && i < mesh.cells[c].corners(); ++i) {
      const Facet side = files::side_of(mesh.cells[c], i);
      const auto [found, is_new] = first.emplace(key_of(side.start, side.end), c);
      if (!is_new) sets.join(found->second, c);
    }
  std::vector<int> part(mesh.cells.size(), -1);
  std::unordered_map<std::size_t, int> number;
  for (std::size_t c = 0; c < mesh.cells.size(); ++c)
    if (chosen[c]) part[c] = number.emplace(sets.root(c), static_cast<int>(number.size())).first->second;
  count = static_cast<int>(number.size());
  return part;
}

ImportedBody body_of(const ImportedMesh& mesh, const Chosen& chosen) {
  std::vector<int> original;
  ImportedMesh part = part_of(mesh, chosen, original);
  OutlineMaker maker(mesh, chosen, part, original);
  ImportedBody body = maker.make();
  body.lines = lines_of(mesh, part, original);
  part.facet_sets = maker.take_sides();
  body.mesh = std::make_shared<const ImportedMesh>(std::move(part));
  return body;
}

}  // namespace

std::string name_from(std::string_view text) {
  std::string name;
  for (const char c : text) {
    const bool letter = (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || c == '_';
    const bool rest = (c >= '0' && c <= '9') || c == '-';
    if (name.empty() && rest) name = "_";  // a name begins with a letter or _
    name += letter || rest ? c : '_';
  }
  return name.empty() ? "_" : name;
}

std::variant<ImportedBodies, std::string> imported_bodies(const files::ImportedMesh& mesh, const CellChoice& choice,
                                                          bool join) {
  Chosen chosen(mesh.cells.size(), choice.set < 0);
  for (std::size_t c = 0; choice.region >= 0 && c < chosen.size(); ++c)
    chosen[c] = mesh.cells[c].region == choice.region;
  if (choice.set >= 0)
    for (const int cell : mesh.cell_sets[static_cast<std::size_t>(choice.set)].cells)
      chosen[static_cast<std::size_t>(cell)] = true;
  ImportedBodies made;
  int count = 0;
  std::vector<int> part = parts_of(mesh, chosen, count);
  ImportedMesh joined;
  const ImportedMesh* whole = &mesh;
  if (join && count > 1) {
    made.joined_nodes = join_equal_sides(mesh, part, joined);
    if (made.joined_nodes > 0) {
      whole = &joined;
      part = parts_of(joined, chosen, count);
    }
  }
  if (count > 1 && choice.region < 0 && choice.set < 0 && mesh.regions.size() > 1)
    return fmt::format(
        "the file has {} parts that have no side in common, but a body is connected: give one of the regions with "
        "'region': {}",
        count, quoted_list(mesh.regions));
  for (int k = 0; k < count; ++k) {
    Chosen of_part(chosen.size());
    for (std::size_t c = 0; c < chosen.size(); ++c) of_part[c] = part[c] == k;
    made.parts.push_back(body_of(*whole, of_part));
  }
  return made;
}

}  // namespace scabo::model
