#include "scabo/mesh/plane/dual_vertices.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <numbers>
#include <numeric>
#include <utility>

#include "scabo/mesh/plane/distinct_points.hpp"
#include "scabo/mesh/plane/interior_points.hpp"
#include "scabo/mesh/plane/polygons.hpp"
#include "scabo/mesh/plane/refusal.hpp"

namespace scabo::mesh {
namespace {

constexpr double largest_facet_turn =
    std::numbers::pi / 6.0;  // of a facet of an arc that has vertices at middles of facets
constexpr int rounds_of_smoothing = 3;

std::size_t index_of(int i) { return static_cast<std::size_t>(i); }

// The middle of a facet: of the chord, or of the arc.
Vec2 middle_of(const DomainLine& line, int facet) {
  const Vec2 middle = 0.5 * (line.points[index_of(facet)] + line.points[index_of(facet + 1)]);
  if (!line.arc) return middle;
  return line.arc->centre + line.arc->radius * (middle - line.arc->centre).normalized();
}

double facet_length(const DomainLine& line, int facet) {
  return (line.points[index_of(facet + 1)] - line.points[index_of(facet)]).norm();
}

// Largest angle by which a facet of the arc turns.
double largest_turn_of(const DomainLine& line) {
  double longest = 0.0;
  for (int k = 0; k + 1 < static_cast<int>(line.points.size()); ++k) longest = std::max(longest, facet_length(line, k));
  return 2.0 * std::asin(std::min(1.0, 0.5 * longest / line.arc->radius));
}

// Which arcs are divided at all their points: those that turn by much, and those that would share an edge of the
// triangulation with another line.
std::vector<bool> divided_lines(const Domain& domain, const std::vector<std::pair<int, int>>& ends, bool divide_arcs) {
  std::vector<bool> divided(domain.lines.size(), false);
  std::map<std::pair<int, int>, std::vector<std::size_t>> between;
  for (std::size_t i = 0; i < domain.lines.size(); ++i) {
    const DomainLine& line = domain.lines[i];
    if (line.arc)
      divided[i] = divide_arcs || ends[i].first == ends[i].second || largest_turn_of(line) > largest_facet_turn;
    if (line.points.size() <= 3) between[std::minmax(ends[i].first, ends[i].second)].push_back(i);
  }
  for (const auto& [pair, lines] : between)
    if (lines.size() > 1)
      for (const std::size_t i : lines) divided[i] = divided[i] || domain.lines[i].arc;
  return divided;
}

void add_edges(DualVertices& vertices) {
  for (std::size_t p = 0; p < vertices.pieces.size(); ++p) {
    const std::vector<int>& chain = vertices.pieces[p].vertices;
    for (std::size_t j = 0; j + 1 < chain.size(); ++j) {
      const PieceEdge edge{static_cast<int>(p), static_cast<int>(j)};
      if (chain[j] == chain[j + 1] ||
          !vertices.piece_edges.emplace(DualVertices::pair_key(chain[j], chain[j + 1]), edge).second)
        throw Refusal("two lines of the shape lie on each other, or a line returns to its start");
      vertices.segments.emplace_back(chain[j], chain[j + 1]);
    }
  }
}

// Length of the facets at an edge of a piece.
double facet_at(const DomainLine& line, const LinePiece& piece, int edge) {
  if (piece.facets() == 1) return facet_length(line, piece.begin);
  return std::min(facet_length(line, piece.begin + edge), facet_length(line, piece.begin + edge + 1));
}

// Regions of all triangles, from the lines that bound them.
std::vector<int> regions_of(const Domain& domain, const DualVertices& vertices,
                            const std::vector<Triangle>& triangles) {
  constexpr int unknown = -2;
  std::vector<int> region(triangles.size(), unknown);
  std::vector<std::size_t> known;
  for (std::size_t t = 0; t < triangles.size(); ++t)
    for (std::size_t i = 0; i < 3; ++i) {
      if (!triangles[t].constrained[i]) continue;
      const int a = triangles[t].vertices[(i + 1) % 3], b = triangles[t].vertices[(i + 2) % 3];
      const auto found = vertices.piece_edges.find(DualVertices::pair_key(a, b));
      if (found == vertices.piece_edges.end())
        throw Refusal("a line of the shape touches another one between its ends");
      const LinePiece& piece = vertices.pieces[index_of(found->second.piece)];
      const bool on_left = piece.vertices[index_of(found->second.edge)] == a;
      const DomainLine& line = domain.lines[index_of(piece.line)];
      const int own = on_left ? line.left : line.right;
      if (region[t] == unknown) known.push_back(t);
      if (region[t] != unknown && region[t] != own) throw Refusal("the lines of the shape do not enclose its regions");
      region[t] = own;
    }
  while (!known.empty()) {
    const std::size_t t = known.back();
    known.pop_back();
    for (std::size_t i = 0; i < 3; ++i) {
      if (triangles[t].constrained[i] || triangles[t].neighbours[i] < 0) continue;
      int& other = region[index_of(triangles[t].neighbours[i])];
      if (other == unknown) {
        other = region[t];
        known.push_back(index_of(triangles[t].neighbours[i]));
      } else if (other != region[t]) {
        throw Refusal("the lines of the shape do not enclose its regions");
      }
    }
  }
  // What no line encloses lies between the shape and the convex hull.
  std::replace(region.begin(), region.end(), unknown, -1);
  for (std::size_t t = 0; t < triangles.size(); ++t)
    for (std::size_t i = 0; i < 3; ++i)
      if (region[t] >= 0 && triangles[t].neighbours[i] < 0 && !triangles[t].constrained[i])
        throw Refusal("the lines of the shape do not enclose its regions");
  return region;
}

// Moves the vertices from `first` on to the centroid of the triangles around them, weighted by the density of points.
void smooth(DualTriangulation& dual, int first) {
  DualVertices& vertices = dual.vertices;
  const std::size_t count = vertices.points.size() - index_of(first);
  std::vector<Vec2> moment(count, Vec2::Zero());
  std::vector<double> weight(count, 0.0);
  for (std::size_t t = 0; t < dual.triangles.size(); ++t) {
    if (dual.region[t] < 0) continue;
    const auto& corner = dual.triangles[t].vertices;
    const Vec2 &a = vertices.points[index_of(corner[0])], &b = vertices.points[index_of(corner[1])],
               &c = vertices.points[index_of(corner[2])];
    const double spacing = (vertices.spacing[index_of(corner[0])] + vertices.spacing[index_of(corner[1])] +
                            vertices.spacing[index_of(corner[2])]) /
                           3.0;
    // The density of a centroidal tessellation whose points have this spacing: spacing^-4.
    const double part = cross(b - a, c - a) / (spacing * spacing * spacing * spacing);
    const Vec2 centroid = (a + b + c) / 3.0;
    for (const int v : corner)
      if (v >= first) {
        moment[index_of(v - first)] += part * centroid;
        weight[index_of(v - first)] += part;
      }
  }
  std::vector<Vec2> moved(count);
  for (std::size_t i = 0; i < count; ++i)
    moved[i] = weight[i] > 0.0 ? Vec2(moment[i] / weight[i]) : vertices.points[index_of(first) + i];
  // A vertex stays where it is if it would leave the triangles around it.
  std::vector<bool> stays(count, false);
  for (std::size_t t = 0; t < dual.triangles.size(); ++t)
    for (std::size_t i = 0; i < 3; ++i) {
      const auto& corner = dual.triangles[t].vertices;
      if (corner[i] < first) continue;
      const Vec2 &a = vertices.points[index_of(corner[(i + 1) % 3])],
                 &b = vertices.points[index_of(corner[(i + 2) % 3])];
      const std::size_t k = index_of(corner[i] - first);
      const double area = cross(b - a, vertices.points[index_of(corner[i])] - a);
      if (cross(b - a, moved[k] - a) < 0.2 * area) stays[k] = true;
    }
  for (std::size_t i = 0; i < count; ++i)
    if (!stays[i]) vertices.points[index_of(first) + i] = moved[i];
}

// Triangles in the order of their vertices, the least of which comes first.
std::vector<Triangle> in_order(std::vector<Triangle> triangles) {
  for (Triangle& triangle : triangles) {
    const auto least = std::min_element(triangle.vertices.begin(), triangle.vertices.end()) - triangle.vertices.begin();
    std::rotate(triangle.vertices.begin(), triangle.vertices.begin() + least, triangle.vertices.end());
    std::rotate(triangle.neighbours.begin(), triangle.neighbours.begin() + least, triangle.neighbours.end());
    std::rotate(triangle.constrained.begin(), triangle.constrained.begin() + least, triangle.constrained.end());
  }
  std::vector<std::size_t> order(triangles.size());
  std::iota(order.begin(), order.end(), 0);
  std::sort(order.begin(), order.end(),
            [&](std::size_t a, std::size_t b) { return triangles[a].vertices < triangles[b].vertices; });
  std::vector<int> place(triangles.size());
  for (std::size_t k = 0; k < order.size(); ++k) place[order[k]] = static_cast<int>(k);
  std::vector<Triangle> sorted;
  sorted.reserve(triangles.size());
  for (const std::size_t k : order) {
    sorted.push_back(triangles[k]);
    for (int& neighbour : sorted.back().neighbours)
      if (neighbour >= 0) neighbour = place[index_of(neighbour)];
  }
  return sorted;
}

// Vertices inside: those that stay in their order, then those that are new. `former` becomes them, as they are before
// they are smoothed.
void add_inside(DualVertices& vertices, InteriorPoints inside, InteriorPoints& former) {
  const auto from = inside.points.begin() + static_cast<std::ptrdiff_t>(inside.kept);
  std::vector<std::size_t> order(inside.kept);
  std::iota(order.begin(), order.end(), 0);
  for (const std::size_t i : spatial_order(std::vector<Vec2>(from, inside.points.end())))
    order.push_back(inside.kept + i);
  former = {{}, {}, {}, inside.kept};
  for (const std::size_t i : order) {
    vertices.points.push_back(inside.points[i]);
    vertices.spacing.push_back(inside.spacing[i]);
    former.points.push_back(inside.points[i]);
    former.spacing.push_back(inside.spacing[i]);
    former.angles.push_back(inside.angles[i]);
  }
}

}  // namespace

DualVertices vertices_on_lines(const Domain& domain, bool divide_arcs) {
  DualVertices vertices;
  Vec2 low = Vec2::Constant(std::numeric_limits<double>::infinity()), high = -low;
  double shortest = low.x();
  for (const DomainLine& line : domain.lines) {
    ensure(line.points.size() >= 2, "a line of a domain has two points or more");
    for (const Vec2& p : line.points) {
      low = low.cwiseMin(p);
      high = high.cwiseMax(p);
    }
    for (int k = 0; k + 1 < static_cast<int>(line.points.size()); ++k)
      shortest = std::min(shortest, facet_length(line, k));
  }
  ensure(!domain.lines.empty() && shortest > 0.0, "the facets of a domain have a length");
  DistinctPoints corners(std::max(1e-9 * shortest, 1e-14 * (high - low).maxCoeff()), low);
  for (const DomainLine& line : domain.lines) {
    const int start = corners.number(line.points.front());
    vertices.ends.emplace_back(start, corners.number(line.points.back()));
  }

  const std::vector<bool> divided = divided_lines(domain, vertices.ends, divide_arcs);
  std::vector<Vec2> middles;
  std::vector<LinePiece>& pieces = vertices.pieces;
  for (std::size_t i = 0; i < domain.lines.size(); ++i) {
    const int last = static_cast<int>(domain.lines[i].points.size()) - 1;
    if (divided[i])
      for (int k = 0; k < last; ++k) pieces.push_back({static_cast<int>(i), k, k + 1, {}});
    else
      pieces.push_back({static_cast<int>(i), 0, last, {}});
    for (std::size_t p = divided[i] ? pieces.size() - index_of(last) : pieces.size() - 1; p < pieces.size(); ++p) {
      LinePiece& piece = pieces[p];
      const auto corner = [&](int k) {
        if (k == 0) return vertices.ends[i].first;
        return k == last ? vertices.ends[i].second : corners.number(domain.lines[i].points[index_of(k)]);
      };
      piece.vertices.push_back(corner(piece.begin));
      for (int k = piece.begin + 1; k + 1 < piece.end; ++k) {
        piece.vertices.push_back(-1 - static_cast<int>(middles.size()));
        middles.push_back(middle_of(domain.lines[i], k));
      }
      piece.vertices.push_back(corner(piece.end));
    }
  }
  vertices.corners = static_cast<int>(corners.points.size());
  vertices.points = std::move(corners.points);
  vertices.points.insert(vertices.points.end(), middles.begin(), middles.end());
  vertices.on_lines = static_cast<int>(vertices.points.size());
  for (LinePiece& piece : pieces)
    for (int& v : piece.vertices)
      if (v < 0) v = vertices.corners + (-1 - v);
  add_edges(vertices);
  return vertices;
}

int corner_at(const DualVertices& vertices, const Vec2& place) {
  int nearest = -1;
  double least = std::numeric_limits<double>::infinity();
  for (int i = 0; i < vertices.corners; ++i)
    if (const double distance = (vertices.points[index_of(i)] - place).norm(); distance < least) {
      least = distance;
      nearest = i;
    }
  return least <= 1e-9 * vertices.spacing[index_of(nearest)] ? nearest : -1;
}

DualTriangulation triangulate_domain(const Domain& domain, DualVertices vertices, FormerVertices& former) {
  std::vector<BorderSegment> borders;
  std::vector<std::array<double, 4>> segments;
  vertices.spacing.assign(index_of(vertices.on_lines), std::numeric_limits<double>::infinity());
  for (const LinePiece& piece : vertices.pieces) {
    const DomainLine& line = domain.lines[index_of(piece.line)];
    for (std::size_t j = 0; j + 1 < piece.vertices.size(); ++j) {
      const std::size_t a = index_of(piece.vertices[j]), b = index_of(piece.vertices[j + 1]);
      const double facet = facet_at(line, piece, static_cast<int>(j));
      segments.push_back(FormerVertices::segment(vertices.points[a], vertices.points[b]));
      borders.push_back({vertices.points[a], vertices.points[b], facet, line.left >= 0, line.right >= 0,
                         !former.has(segments.back())});
      for (const std::size_t v : {a, b}) vertices.spacing[v] = std::min(vertices.spacing[v], spacing_per_size * facet);
    }
  }
  const auto spacing = [&](const Vec2& p) { return spacing_per_size * domain.size(p); };
  add_inside(vertices, interior_points(borders, spacing, former.inside), former.inside);
  std::sort(segments.begin(), segments.end());
  former.segments = std::move(segments);

  DualTriangulation dual{std::move(vertices), {}, {}};
  const std::vector<std::size_t> order = spatial_order(dual.vertices.points);
  for (int round = 0;; ++round) {
    dual.triangles = in_order(triangulate(dual.vertices.points, dual.vertices.segments, order));
    dual.region = regions_of(domain, dual.vertices, dual.triangles);
    if (round == rounds_of_smoothing) break;
    smooth(dual, dual.vertices.on_lines + static_cast<int>(former.inside.kept));
  }
  former.inside.points.assign(dual.vertices.points.begin() + dual.vertices.on_lines, dual.vertices.points.end());
  return dual;
}

}  // namespace scabo::mesh
