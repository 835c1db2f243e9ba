#include "scabo/mesh/plane/dual_cells.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <unordered_map>

#include "scabo/mesh/plane/polygons.hpp"
#include "scabo/mesh/plane/refusal.hpp"

namespace scabo::mesh {
namespace {

constexpr double largest_corner =
    1.55 * std::numbers::pi;  // of a cell that has it as a node; beyond there are two cells
constexpr int no_node = -1;

// The triangles around a corner vertex within one region: from the edge `first` of the triangulation counter-clockwise
// to the edge `last`.
struct Wedge {
  int vertex = 0, region = 0;
  PieceEdge first, last;
  std::vector<int> triangles;
  int next = -1, previous = -1;  // wedge across `last` and across `first`, of the same body: no crack, no outside
  int run = -1;                  // of wedges linked in this way
  int node = no_node;            // the corner as seen from here; no_node: it is a scaling centre
};

// Goes around the vertices of the triangulation.
class CellMaker {
 public:
  CellMaker(const Domain& domain, DualTriangulation dual)
      : domain_(domain), dual_(std::move(dual)), vertices_(dual_.vertices), triangles_(dual_.triangles) {
    add_centroids();
    add_nodes_on_lines();
    find_cells();
    find_runs();
    find_split_facets();
    add_corner_cells();
    collect_lines();
  }

  DualCells take() {
    return {std::move(mesh_),    std::move(dual_.triangles), std::move(dual_.region), std::move(spacing_),
            std::move(cell_of_), std::move(second_cell_),    std::move(fixed_centre_)};
  }

 private:
  static std::size_t at(int i) { return static_cast<std::size_t>(i); }
  bool inside(int triangle) const { return triangle >= 0 && dual_.region[at(triangle)] >= 0; }
  const Vec2& point(int vertex) const { return vertices_.points[at(vertex)]; }
  const DomainLine& line_of(const PieceEdge& edge) const {
    return domain_.lines[at(vertices_.pieces[at(edge.piece)].line)];
  }
  PieceEdge edge_between(int a, int b) const { return vertices_.piece_edges.at(DualVertices::pair_key(a, b)); }
  bool runs_from(const PieceEdge& edge, int vertex) const {
    return vertices_.pieces[at(edge.piece)].vertices[at(edge.edge)] == vertex;
  }

  // Centroids of the triangles. Where the facets of an arc leave the edge of a triangle, its centroid goes with them.
  void add_centroids() {
    mesh_.nodes.resize(triangles_.size());
    spacing_.resize(triangles_.size());
    for (std::size_t t = 0; t < triangles_.size(); ++t) {
      const auto& corner = triangles_[t].vertices;
      Vec2 centroid = (point(corner[0]) + point(corner[1]) + point(corner[2])) / 3.0;
      spacing_[t] =
          (vertices_.spacing[at(corner[0])] + vertices_.spacing[at(corner[1])] + vertices_.spacing[at(corner[2])]) /
          (3.0 * spacing_per_size);
      for (std::size_t i = 0; i < 3; ++i)
        if (triangles_[t].constrained[i]) {
          const int a = corner[(i + 1) % 3], b = corner[(i + 2) % 3];
          const PieceEdge edge = edge_between(a, b);
          const LinePiece& piece = vertices_.pieces[at(edge.piece)];
          if (piece.facets() == 1 || !line_of(edge).arc) continue;
          const Vec2& node = line_of(edge).points[at(piece.begin + edge.edge + 1)];
          const Vec2 side = point(b) - point(a);
          const Vec2 normal(-side.y(), side.x());
          centroid += (2.0 / 3.0) * cross(side, node - point(a)) / side.squaredNorm() * normal;
        }
      mesh_.nodes[t] = centroid;
    }
  }

  int add_node(const Vec2& place) {
    mesh_.nodes.push_back(place);
    return static_cast<int>(mesh_.nodes.size()) - 1;
  }

  // Nodes of lines apart from the ends of pieces.
  void add_nodes_on_lines() {
    for (auto& side : line_nodes_) side.resize(domain_.lines.size());
    for (std::size_t i = 0; i < domain_.lines.size(); ++i)
      for (auto& side : line_nodes_) side[i].assign(domain_.lines[i].points.size(), no_node);
    for (const LinePiece& piece : vertices_.pieces) {
      const DomainLine& line = domain_.lines[at(piece.line)];
      for (int k = piece.begin + 1; k < piece.end; ++k) {
        const int left = add_node(line.points[at(k)]);
        line_nodes_[0][at(piece.line)][at(k)] = left;
        line_nodes_[1][at(piece.line)][at(k)] = line.crack ? add_node(line.points[at(k)]) : left;
      }
    }
  }

  // Side of a line on which a wedge at `vertex` lies that starts or ends at `edge`: 0 left, 1 right.
  int side_of(const PieceEdge& edge, int vertex, bool starts) const {
    return runs_from(edge, vertex) == starts ? 0 : 1;
  }

  // The node on an edge of a piece of several facets.
  int node_on(const PieceEdge& edge, int side) const {
    const LinePiece& piece = vertices_.pieces[at(edge.piece)];
    return line_nodes_[at(side)][at(piece.line)][at(piece.begin + edge.edge + 1)];
  }

  // Goes around every vertex: cells of vertices inside and in the middle of facets, wedges at corners.
  void find_cells() {
    cell_of_.assign(3 * triangles_.size(), -1);
    std::vector<bool> visited(3 * triangles_.size(), false);
    std::vector<std::size_t> around;
    for (std::size_t start = 0; start < 3 * triangles_.size(); ++start) {
      if (visited[start] || !inside(static_cast<int>(start / 3))) continue;
      const int vertex = triangles_[start / 3].vertices[start % 3];
      // Clockwise to where the wedge starts, or once around.
      std::size_t first = start;
      while (!triangles_[first / 3].constrained[(first % 3 + 2) % 3]) {
        first = corner_in(triangles_[first / 3].neighbours[(first % 3 + 2) % 3], vertex);
        if (first == start) break;
      }
      around.clear();
      bool closed = false;
      for (std::size_t now = first;;) {
        visited[now] = true;
        around.push_back(now);
        if (triangles_[now / 3].constrained[(now % 3 + 1) % 3]) break;
        now = corner_in(triangles_[now / 3].neighbours[(now % 3 + 1) % 3], vertex);
        if (now == first) {
          closed = true;
          break;
        }
      }
      add_around(vertex, around, closed);
    }
  }

  // Number of the corner of `triangle` at `vertex`: 3 triangle + 0, 1 or 2.
  std::size_t corner_in(int triangle, int vertex) const {
    const auto& corner = triangles_[at(triangle)].vertices;
    return 3 * at(triangle) + (corner[0] == vertex ? 0u : corner[1] == vertex ? 1u : 2u);
  }

  void add_around(int vertex, const std::vector<std::size_t>& around, bool closed) {
    PolygonCell cell;
    cell.region = dual_.region[around.front() / 3];
    if (closed) {
      for (const std::size_t corner : around) cell.nodes.push_back(static_cast<int>(corner / 3));
      add_cell(std::move(cell), around);
      return;
    }
    const Triangle &first = triangles_[around.front() / 3], &last = triangles_[around.back() / 3];
    const PieceEdge start = edge_between(vertex, first.vertices[(around.front() % 3 + 1) % 3]);
    const PieceEdge end = edge_between(vertex, last.vertices[(around.back() % 3 + 2) % 3]);
    if (vertex >= vertices_.corners) {
      cell.nodes.push_back(node_on(start, side_of(start, vertex, true)));
      for (const std::size_t corner : around) cell.nodes.push_back(static_cast<int>(corner / 3));
      cell.nodes.push_back(node_on(end, side_of(end, vertex, false)));
      add_cell(std::move(cell), around);
      return;
    }
    Wedge wedge{vertex, cell.region, start, end, {}};
    for (const std::size_t corner : around) {
      wedge.triangles.push_back(static_cast<int>(corner / 3));
      wedge_of_[corner] = static_cast<int>(wedges_.size());
    }
    wedges_.push_back(std::move(wedge));
  }

  int add_cell(PolygonCell cell, const std::vector<std::size_t>& corners) {
    const int number = static_cast<int>(mesh_.cells.size());
    for (const std::size_t corner : corners) cell_of_[corner] = number;
    mesh_.cells.push_back(std::move(cell));
    fixed_centre_.push_back(false);
    return number;
  }

  // Number of an edge of the triangulation at the corner of a wedge, seen from there. A corner is at the start or at
  // the end of a piece, so that piece and direction determine the edge.
  int outgoing(const Wedge& wedge, const PieceEdge& edge) const {
    return 2 * edge.piece + (runs_from(edge, wedge.vertex) ? 1 : 0);
  }

  // Wedges at a corner that lie in the same piece of material, and their common node.
  void find_runs() {
    std::unordered_map<int, int> starting;  // wedge that starts at an edge
    for (std::size_t w = 0; w < wedges_.size(); ++w)
      starting[outgoing(wedges_[w], wedges_[w].first)] = static_cast<int>(w);
    for (std::size_t w = 0; w < wedges_.size(); ++w) {
      if (line_of(wedges_[w].last).crack) continue;
      const auto found = starting.find(outgoing(wedges_[w], wedges_[w].last));
      if (found == starting.end()) continue;
      wedges_[w].next = found->second;
      wedges_[at(found->second)].previous = static_cast<int>(w);
    }
    is_centre_.assign(at(vertices_.corners), false);
    for (const Vec2& centre : domain_.centres) {
      const int corner = corner_at(vertices_, centre);
      if (corner < 0) throw Refusal("a scaling centre is not the end of a line", centre);
      is_centre_[at(corner)] = true;
    }
    std::vector<bool> seen(wedges_.size(), false);
    for (std::size_t w = 0; w < wedges_.size(); ++w) {
      if (seen[w]) continue;
      const std::vector<int> run = run_of(static_cast<int>(w));
      const bool centre = is_centre_[at(wedges_[w].vertex)];
      const int node = centre ? no_node : add_node(point(wedges_[w].vertex));
      for (const int k : run) {
        seen[at(k)] = true;
        wedges_[at(k)].node = node;
        wedges_[at(k)].run = static_cast<int>(runs_.size());
      }
      runs_.push_back(run);
    }
  }

  // All wedges of a run, counter-clockwise from its first.
  std::vector<int> run_of(int w) const {
    int first = w;
    while (wedges_[at(first)].previous >= 0 && wedges_[at(first)].previous != w) first = wedges_[at(first)].previous;
    if (wedges_[at(first)].previous == w) first = w;
    std::vector<int> run{first};
    while (wedges_[at(run.back())].next >= 0 && wedges_[at(run.back())].next != first)
      run.push_back(wedges_[at(run.back())].next);
    return run;
  }

  // Facets that need a node at their middle: those between two scaling centres, and cracks of one facet that end in a
  // tip on both sides, which could not open otherwise.
  void find_split_facets() {
    std::vector<int> tips(vertices_.pieces.size(), 0);
    std::unordered_map<int, int> starting;  // run that starts at an edge
    for (const Wedge& wedge : wedges_) starting[outgoing(wedge, wedge.first)] = wedge.run;
    for (const Wedge& wedge : wedges_)
      if (const auto found = starting.find(outgoing(wedge, wedge.last));
          found != starting.end() && found->second == wedge.run && line_of(wedge.last).crack)
        ++tips[at(wedge.last.piece)];
    split_.assign(vertices_.pieces.size(), false);
    for (std::size_t p = 0; p < vertices_.pieces.size(); ++p) {
      const LinePiece& piece = vertices_.pieces[p];
      if (piece.facets() > 1) continue;
      split_[p] = tips[p] == 2 || (is_centre_[at(piece.vertices[0])] && is_centre_[at(piece.vertices[1])]);
    }
  }

  // Whether the cell at `vertex` has the facet of a piece of one facet: a scaling centre has it, otherwise its start.
  bool owns(const PieceEdge& edge, int vertex) const {
    const std::vector<int>& chain = vertices_.pieces[at(edge.piece)].vertices;
    if (is_centre_[at(chain[0])] != is_centre_[at(chain[1])]) return is_centre_[at(vertex)];
    return chain[0] == vertex;
  }

  // The node at which the cell of a wedge leaves the edge at its start, or reaches the one at its end.
  int node_at_edge(const Wedge& wedge, bool start) {
    const PieceEdge& edge = start ? wedge.first : wedge.last;
    const int side = side_of(edge, wedge.vertex, start);
    const LinePiece& piece = vertices_.pieces[at(edge.piece)];
    if (piece.facets() > 1) return node_on(edge, side);
    const int other = piece.vertices[runs_from(edge, wedge.vertex) ? 1 : 0];
    if (split_[at(edge.piece)]) return middle_node(edge.piece, side);
    if (!owns(edge, wedge.vertex)) return wedge.node;
    const int triangle = start ? wedge.triangles.front() : wedge.triangles.back();
    return wedges_[at(wedge_of_.at(corner_in(triangle, other)))].node;
  }

  // The middle of a split facet.
  int middle_node(int piece, int side) {
    const DomainLine& line = domain_.lines[at(vertices_.pieces[at(piece)].line)];
    auto [found, is_new] = middles_.try_emplace(piece, std::array<int, 2>{});
    if (is_new) {
      const int begin = vertices_.pieces[at(piece)].begin;
      const Vec2 middle = 0.5 * (line.points[at(begin)] + line.points[at(begin + 1)]);
      found->second[0] = add_node(middle);
      found->second[1] = line.crack ? add_node(middle) : found->second[0];
    }
    return found->second[at(side)];
  }

  void add_corner_cells() {
    for (const std::vector<int>& run : runs_)
      if (is_centre_[at(wedges_[at(run.front())].vertex)])
        add_centre_cell(run);
      else
        for (const int w : run) add_corner_cell(wedges_[at(w)]);
  }

  // The cell of one region at a corner that is one of its nodes; two where the region surrounds the corner almost.
  void add_corner_cell(const Wedge& wedge) {
    const int first = node_at_edge(wedge, true), last = node_at_edge(wedge, false);
    std::vector<std::size_t> corners = corners_of(wedge);
    std::vector<double> angle{0.0};  // before each triangle
    for (const std::size_t corner : corners) {
      const auto& vertices = triangles_[corner / 3].vertices;
      const Vec2 a = point(vertices[(corner % 3 + 1) % 3]) - point(wedge.vertex);
      const Vec2 b = point(vertices[(corner % 3 + 2) % 3]) - point(wedge.vertex);
      angle.push_back(angle.back() + std::atan2(cross(a, b), a.dot(b)));
    }
    std::size_t middle = 0;
    for (std::size_t k = 0; k < corners.size(); ++k)  // the angle of a centroid is about that of its triangle's middle
      if (std::abs(angle[k] + angle[k + 1] - angle.back()) < std::abs(angle[middle] + angle[middle + 1] - angle.back()))
        middle = k;
    const bool two = angle.back() > largest_corner;
    for (const bool second : {false, true}) {
      if (second && !two) break;
      const std::size_t begin = second ? middle : 0, end = two && !second ? middle + 1 : corners.size();
      PolygonCell cell;
      cell.region = wedge.region;
      if (!second && first != wedge.node) cell.nodes.push_back(first);
      cell.nodes.insert(cell.nodes.end(), wedge.triangles.begin() + static_cast<std::ptrdiff_t>(begin),
                        wedge.triangles.begin() + static_cast<std::ptrdiff_t>(end));
      if ((second || !two) && last != wedge.node) cell.nodes.push_back(last);
      cell.nodes.push_back(wedge.node);
      if (cell.nodes.size() < 3) continue;  // its neighbours share its facets
      if (second) second_cell_[wedge.triangles[middle]].push_back(static_cast<int>(mesh_.cells.size()));
      add_cell(std::move(cell), {corners.begin() + static_cast<std::ptrdiff_t>(second ? begin + 1 : begin),
                                 corners.begin() + static_cast<std::ptrdiff_t>(end)});
    }
  }

  // The cell whose scaling centre is the corner.
  void add_centre_cell(const std::vector<int>& run) {
    PolygonCell cell;
    cell.centre = point(wedges_[at(run.front())].vertex);
    cell.region = wedges_[at(run.front())].region;
    cell.open = wedges_[at(run.front())].previous < 0;
    std::vector<std::size_t> corners;
    for (const int w : run) {
      const Wedge& wedge = wedges_[at(w)];
      if (cell.nodes.empty()) cell.nodes.push_back(node_at_edge(wedge, true));
      cell.nodes.insert(cell.nodes.end(), wedge.triangles.begin(), wedge.triangles.end());
      cell.nodes.push_back(node_at_edge(wedge, false));
      cell.side_regions.resize(cell.nodes.size() - 1, wedge.region);
      const std::vector<std::size_t> more = corners_of(wedge);
      corners.insert(corners.end(), more.begin(), more.end());
    }
    if (!cell.open) cell.nodes.pop_back();  // the node where it began
    const auto own = [&](int region) { return region == cell.region; };
    if (std::all_of(cell.side_regions.begin(), cell.side_regions.end(), own)) cell.side_regions.clear();
    fixed_centre_[at(add_cell(std::move(cell), corners))] = true;
  }

  std::vector<std::size_t> corners_of(const Wedge& wedge) const {
    std::vector<std::size_t> corners;
    for (const int triangle : wedge.triangles) corners.push_back(corner_in(triangle, wedge.vertex));
    return corners;
  }

  // Ends of pieces on the lines, as the wedges beside them have them.
  void collect_lines() {
    for (std::size_t w = 0; w < wedges_.size(); ++w)
      for (const bool start : {true, false}) {
        const Wedge& wedge = wedges_[w];
        const PieceEdge& edge = start ? wedge.first : wedge.last;
        const LinePiece& piece = vertices_.pieces[at(edge.piece)];
        // The edge alone may start and end the piece: then the direction tells its end.
        const bool at_begin = runs_from(edge, wedge.vertex) && edge.edge == 0;
        line_nodes_[at(side_of(edge, wedge.vertex, start))][at(piece.line)][at(at_begin ? piece.begin : piece.end)] =
            wedge.node;
      }
    mesh_.left.resize(domain_.lines.size());
    mesh_.right.resize(domain_.lines.size());
    std::vector<std::vector<std::pair<int, int>>> middles(domain_.lines.size());  // before which point, piece
    for (const auto& [piece, nodes] : middles_)
      middles[at(vertices_.pieces[at(piece)].line)].emplace_back(vertices_.pieces[at(piece)].end, piece);
    for (std::size_t i = 0; i < domain_.lines.size(); ++i) {
      const DomainLine& line = domain_.lines[i];
      for (const int side : {0, 1}) {
        // The outside has no cells; what it sees are the nodes of the other side.
        const int seen = (side == 0 ? line.left : line.right) >= 0 ? side : 1 - side;
        std::vector<int>& nodes = side == 0 ? mesh_.left[i] : mesh_.right[i];
        for (std::size_t k = 0; k < line.points.size(); ++k) {
          for (const auto& [before, piece] : middles[i])
            if (at(before) == k) nodes.push_back(middles_.at(piece)[at(seen)]);
          if (line_nodes_[at(seen)][i][k] != no_node) nodes.push_back(line_nodes_[at(seen)][i][k]);
        }
      }
    }
  }

  const Domain& domain_;
  DualTriangulation dual_;
  const DualVertices& vertices_;
  const std::vector<Triangle>& triangles_;
  PolygonMesh mesh_;
  std::vector<double> spacing_;
  std::vector<int> cell_of_;
  std::unordered_map<int, std::vector<int>> second_cell_;
  std::vector<bool> fixed_centre_;
  std::array<std::vector<std::vector<int>>, 2> line_nodes_;  // left and right, for each line and each of its points
  std::vector<Wedge> wedges_;
  std::unordered_map<std::size_t, int> wedge_of_;  // for each corner of a triangle at a corner of the domain
  std::vector<std::vector<int>> runs_;             // wedges
  std::vector<bool> is_centre_;                    // for each corner
  std::vector<bool> split_;                        // for each piece: whether its only facet has a node at its middle
  std::unordered_map<int, std::array<int, 2>> middles_;  // of those: left and right
};

}  // namespace

DualCells dual_cells(const Domain& domain, DualTriangulation dual) { return CellMaker(domain, std::move(dual)).take(); }

}  // namespace scabo::mesh
