// Validation of outlines: closed, simple, of reasonable size, with names for edges and corners.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <unordered_map>

#include "scabo/geometry/box.hpp"
#include "scabo/geometry/plane/foot_points.hpp"
#include "scabo/model/checking.hpp"

namespace scabo::model {

namespace {

constexpr double rounding_of_outlines = 1e-9;  // of coordinates, relative to the size of the outline
/// Least length of a piece of an outline, and least size of a hole or region, relative to the size of the body. Meshers
/// take lines within 1e-9 of it as one; with pieces of 3.5e-9 they failed, with pieces of 1e-8 they do not.
constexpr double smallest_part = 1e-8;

/// One outline under check.
struct Shape {
  Checking& checking;
  const std::string& path;
  const Outline& outline;
  double size = 0.0;
  double body_size = 0.0;  ///< at least `size`; larger where the outline is that of a hole or region

  std::string name(std::size_t edge) const { return shown_name(outline.edges[edge]); }
  /// Path of an edge: that in its file, or by its name.
  std::string path_of_edge(std::size_t edge) const {
    const Edge& of = outline.edges[edge];
    if (!of.source.path.empty()) return path_of(path, of.source, edge);
    return fmt::format("{}.{}", path, of.names.empty() ? fmt::format("edge_{}", edge + 1) : of.names.front());
  }
  void error(std::string message) const { checking.error(path, "", std::move(message)); }
  void error_of_edge(std::size_t edge, std::string_view key, std::string message) const {
    checking.error(path_of_edge(edge), key, std::move(message));
  }
};

/// A full circle may be one edge that ends where it starts, and so may the boundary of a mesh.
bool is_circle(const Outline& chain) {
  if (chain.edges.size() == 1 && chain.edges[0].is_chain()) return chain.edges[0].start == chain.edges[0].end;
  return chain.edges.size() == 1 && chain.edges[0].arc && std::abs(chain.edges[0].arc->sweep) > 6.0 &&
         chain.edges[0].start == chain.edges[0].end;
}

bool check_counts(const Shape& shape) {
  const std::size_t edges = shape.outline.edges.size(), corners = shape.outline.corners.size();
  if (edges < 2 && !is_circle(shape.outline)) {
    shape.error(fmt::format("an outline needs at least two pieces, not {}", edges));
  } else if (edges > static_cast<std::size_t>(limits::edges)) {
    shape.error(fmt::format("{} edges are too many: at most {} are allowed", edges, limits::edges));
  } else if (corners != edges) {
    shape.error(fmt::format("has {} edges and {} corners: every edge needs the corner at its start", edges, corners));
  } else {
    return true;
  }
  return false;
}

bool check_numbers(const Shape& shape) {
  const auto good = [&](const Edge& edge) {
    const auto all_finite = [](const Vec2& x) { return x.allFinite() && x.cwiseAbs().maxCoeff() <= 1e100; };
    if (!all_finite(edge.start) || !all_finite(edge.end)) return false;
    if (!std::all_of(edge.points.begin(), edge.points.end(), all_finite)) return false;
    return !edge.arc || (all_finite(edge.arc->centre) && std::isfinite(edge.arc->radius) &&
                         std::isfinite(edge.arc->start_angle) && std::isfinite(edge.arc->sweep));
  };
  for (std::size_t i = 0; i < shape.outline.edges.size(); ++i) {
    const Edge& edge = shape.outline.edges[i];
    if (good(edge) && shape.outline.corners[i].position.allFinite()) continue;
    shape.error_of_edge(i, "", "must have finite coordinates, of at most 1e100");
    return false;
  }
  return true;
}

/// Every edge and corner has a name of its own.
bool check_names(const Shape& shape) {
  std::unordered_map<std::string, std::string> owners;
  const std::size_t count = shape.outline.edges.size();
  owners.reserve(3 * count);
  for (std::size_t i = 0; i < count; ++i) {
    const auto& corner = shape.outline.corners[i].names;
    const auto& edge = shape.outline.edges[i].names;
    if (corner.empty() || edge.empty()) {
      shape.error_of_edge(i, "", "the edge and the corner at its start need names, as in edge_1 and vertex_1");
      return false;
    }
  }
  const auto add = [&](std::size_t i, const std::vector<std::string>& names, std::size_t k) {
    const auto [owner, is_new] = owners.emplace(names[k], names.front());
    if (is_new) return true;
    shape.error_of_edge(i, "name", fmt::format("'{}' already names {}: choose another name", names[k], owner->second));
    return false;
  };
  // First the own names, which may not be taken by others.
  for (std::size_t i = 0; i < count; ++i)
    if (!add(i, shape.outline.corners[i].names, 0)) return false;
  for (std::size_t i = 0; i < count; ++i)
    if (!add(i, shape.outline.edges[i].names, 0)) return false;
  for (std::size_t i = 0; i < count; ++i)
    for (const auto* names : {&shape.outline.edges[i].names, &shape.outline.corners[i].names})
      for (std::size_t k = 1; k < names->size(); ++k)
        if (!add(i, *names, k)) return false;
  return true;
}

bool check_arc(const Shape& shape, std::size_t i) {
  const Edge& edge = shape.outline.edges[i];
  const Arc& arc = *edge.arc;
  const double ra = (edge.start - arc.centre).norm();
  const double rb = (edge.end - arc.centre).norm();
  const double larger = std::max(ra, rb);
  if ((edge.end - edge.start).norm() <= rounding_of_outlines * larger && !is_circle(shape.outline)) {
    shape.error_of_edge(
        i, "",
        fmt::format("{} is an arc that ends where it starts: write a full circle as two arcs", edge.names.front()));
    return false;
  }
  if (std::abs(ra - rb) > 1e-6 * larger) {
    shape.error_of_edge(i, "arc.centre",
                        fmt::format("the ends of an arc must be equally far from its centre: from {} it is {:.9g}, "
                                    "to {} it is {:.9g}",
                                    point_text(edge.start), ra, point_text(edge.end), rb));
    return false;
  }
  const auto off = [&](const Vec2& end, double angle) {
    return (arc.centre + arc.radius * Vec2(std::cos(angle), std::sin(angle)) - end).norm();
  };
  if (!(arc.radius > 0.0) || !(std::abs(arc.sweep) <= 2.0 * std::numbers::pi * (1.0 + rounding_of_outlines)) ||
      !(std::max(off(edge.start, arc.start_angle), off(edge.end, arc.start_angle + arc.sweep)) <= 1e-5 * larger)) {
    shape.error_of_edge(
        i, "arc",
        fmt::format("radius {:.9g}, start angle {:.9g} and sweep {:.9g} do not lead from {} to {}", arc.radius,
                    arc.start_angle, arc.sweep, point_text(edge.start), point_text(edge.end)));
    return false;
  }
  return true;
}

bool check_closed(const Shape& shape) {
  const std::size_t count = shape.outline.edges.size();
  for (std::size_t i = 0; i < count; ++i) {
    const Edge& edge = shape.outline.edges[i];
    const Vec2& before = shape.outline.edges[(i + count - 1) % count].end;
    if ((edge.start - before).norm() > rounding_of_outlines * shape.size) {
      shape.error_of_edge(i, "",
                          fmt::format("{} starts at {}, but {} ends at {}{}", edge.names.front(),
                                      point_text(edge.start), i == 0 ? "the last piece" : "the piece before",
                                      point_text(before), i == 0 ? ": the outline is not closed" : ""));
      return false;
    }
    if ((edge.start - shape.outline.corners[i].position).norm() > rounding_of_outlines * shape.size) {
      shape.error_of_edge(
          i, "",
          fmt::format("{} starts at {}, but corner {} is at {}", shape.name(i), point_text(edge.start),
                      shape.outline.corners[i].names.front(), point_text(shape.outline.corners[i].position)));
      return false;
    }
  }
  return true;
}

/// Holes and regions are not so small that coordinates do not resolve them.
bool check_part(const Shape& shape) {
  const double least = smallest_part * shape.body_size;
  if (shape.size >= least || shape.size == shape.body_size) return true;
  shape.error(
      fmt::format("is only {:.3g} in size, too small beside the body: its parts must be at least {:.0e} of its size, "
                  "{:.3g} here; enlarge it, or leave it out",
                  shape.size, smallest_part, least));
  return false;
}

bool check_extent(const Shape& shape) {
  double farthest = 0.0;
  for (const Edge& edge : shape.outline.edges) farthest = std::max(farthest, edge.start.cwiseAbs().maxCoeff());
  const double size = shape.size;
  if (!(size > 0.0)) {
    shape.error("has no extent: all its points coincide");
    return false;
  }
  if (size < 1e-30 || size > 1e30) {
    shape.error(
        fmt::format("has a size of {:.2g}, but sizes must be from 1e-30 to 1e30: use another unit of length", size));
    return false;
  }
  if (farthest > 1e10 * size) {
    shape.error(
        fmt::format("lies {:.1e} times its own size away from the origin, so that its coordinates lose "
                    "precision: move the origin closer",
                    farthest / size));
    return false;
  }
  return true;
}

bool check_lengths(const Shape& shape) {
  for (std::size_t i = 0; i < shape.outline.edges.size(); ++i) {
    const double length = shape.outline.edges[i].length(), least = smallest_part * shape.body_size;
    if (length >= least) continue;
    const std::string why =
        length <= rounding_of_outlines * shape.size
            ? fmt::format("has no length because both its ends are at {}", point_text(shape.outline.edges[i].start))
            : fmt::format(
                  "is only {:.3g} long, too short beside the body, whose pieces must be at least {:.0e} of its "
                  "size, {:.3g} here",
                  length, smallest_part, least);
    shape.error_of_edge(i, "", fmt::format("{} {}: remove it, or move one end", shape.name(i), why));
    return false;
  }
  return true;
}

bool check_simple(const Shape& shape) {
  constexpr const char* no_area = "has no area because its points lie on one line: move some of them";
  const double area = shape.outline.area(), least = 1e-12 * shape.size * shape.size;
  if (std::abs(area) <= least && shape.outline.edges.size() < 4) {
    shape.error(no_area);
    return false;
  }
  if (const auto crossing = find_crossing(shape.outline)) {
    const bool folds = crossing->kind == geometry::Crossing::Kind::fold_back;
    shape.error(
        fmt::format("{} and {} {} {}: the outline must not {}", shape.name(static_cast<std::size_t>(crossing->first)),
                    shape.name(static_cast<std::size_t>(crossing->second)), folds ? "overlap, beginning at" : "meet at",
                    point_text(crossing->point), folds ? "fold back on itself" : "cross or touch itself"));
    return false;
  }
  if (std::abs(area) <= least) {
    shape.error(no_area);
    return false;
  }
  if (area < 0.0) {
    shape.error(
        "runs the wrong way round: the material must lie on the left of its edges, in a body counter-clockwise "
        "and around the hole of an unbounded body clockwise");
    return false;
  }
  return true;
}

/// The edges of a rectangle are its bottom, right, top and left, in this order.
bool check_rectangle(const Shape& shape) {
  if (!shape.outline.rectangle) return true;
  bool good = shape.outline.edges.size() == 4;
  for (std::size_t i = 0; good && i < 4; ++i) {
    const Edge& edge = shape.outline.edges[i];
    const Vec2 along = edge.end - edge.start;
    const double sense = i < 2 ? 1.0 : -1.0;
    const int axis = static_cast<int>(i % 2);
    good = !edge.arc && sense * along[axis] > 0.0 && std::abs(along[1 - axis]) <= rounding_of_outlines * shape.size;
  }
  if (!good) shape.error("is marked as a rectangle, but its edges are not the bottom, right, top and left of one");
  return good;
}

/// The chains of an outline by themselves, all running counter-clockwise: the outer one, then the holes.
std::vector<Outline> chains_of(const Outline& outline) {
  std::vector<Outline> chains;
  for (std::size_t k = 0; k <= outline.holes.size(); ++k) {
    const int first = k == 0 ? 0 : outline.holes[k - 1];
    const int end = k < outline.holes.size() ? outline.holes[k] : static_cast<int>(outline.edges.size());
    Outline chain;
    chain.edges.assign(outline.edges.begin() + first, outline.edges.begin() + end);
    chain.corners.assign(outline.corners.begin() + first, outline.corners.begin() + end);
    if (k > 0) turn_round(chain);
    chains.push_back(std::move(chain));
  }
  return chains;
}

/// One closed chain; `body_size` is 0 where it is the outline of the body itself.
bool check_chain(Checking& checking, const std::string& path, const Outline& chain, double body_size) {
  Shape shape{checking, path, chain};
  if (!check_counts(shape) || !check_numbers(shape) || !check_names(shape)) return false;
  for (std::size_t i = 0; i < chain.edges.size(); ++i)
    if (chain.edges[i].arc && !check_arc(shape, i)) return false;
  shape.size = geometry::outline_size(chain);
  shape.body_size = std::max(body_size, shape.size);
  return check_part(shape) && check_extent(shape) && check_closed(shape) && check_lengths(shape) &&
         check_simple(shape) && check_rectangle(shape);
}

/// Path and name of a hole: those in its file, or its number.
std::pair<std::string, std::string> hole_of(const std::string& body, const Outline& hole, std::size_t number) {
  const std::string section = body + ".holes.";
  std::string path = hole.edges.empty() ? "" : path_of(section, hole.edges.front().source, number);
  if (!path.starts_with(section) || path.starts_with(section + ".")) path = section + std::to_string(number);
  path = path.substr(0, path.find('.', section.size()));
  return {path, path.substr(section.size())};
}

bool check_holes(Checking& checking, const std::string& path, const Outline& outline) {
  int before = 0;
  for (const int hole : outline.holes) {
    if (hole <= before || static_cast<std::size_t>(hole) >= outline.edges.size()) {
      checking.error(path, "", "the first edges of its holes are not in ascending order, or do not exist");
      return false;
    }
    before = hole;
  }
  const std::vector<Outline> chains = chains_of(outline);
  if (!check_chain(checking, path, chains.front(), 0.0)) return false;
  const double size = geometry::outline_size(chains.front());
  const std::string body = path.substr(0, path.rfind('.'));
  Outline with = chains.front();
  for (std::size_t k = 1; k < chains.size(); ++k) {
    const auto [at, name] = hole_of(body, chains[k], k - 1);
    if (!check_chain(checking, at, chains[k], size)) return false;
    if (!check_inside(checking, at, fmt::format("hole '{}'", name), with, chains[k])) return false;
    Outline hole = chains[k];
    turn_round(hole);
    with.holes.push_back(static_cast<int>(with.edges.size()));
    with.edges.insert(with.edges.end(), hole.edges.begin(), hole.edges.end());
    with.corners.insert(with.corners.end(), hole.corners.begin(), hole.corners.end());
  }
  return check_names({checking, body, outline});
}

}  // namespace

std::optional<geometry::Crossing> crossing_between(const Outline& a, const Outline& b) {
  Outline both = a;
  both.holes.push_back(static_cast<int>(both.edges.size()));
  both.edges.insert(both.edges.end(), b.edges.begin(), b.edges.end());
  return find_crossing(both);
}

bool check_inside(Checking& checking, const std::string& path, const std::string& what, const Outline& outer,
                  const Outline& outline) {
  if (const auto crossing = crossing_between(outer, outline)) {
    const auto name = [&](int edge) {
      const auto i = static_cast<std::size_t>(edge), count = outer.edges.size();
      return shown_name(i < count ? outer.edges[i] : outline.edges[i - count]);
    };
    checking.error(path, "",
                   fmt::format("{} and {} meet at {}: {} must lie inside the body, apart from its boundary "
                               "and other holes",
                               name(crossing->first), name(crossing->second), point_text(crossing->point), what));
    return false;
  }
  if (!encloses(outer, outline.edges.front().at(0.5))) {
    checking.error(path, "", fmt::format("{} lies outside of the body: move it inside", what));
    return false;
  }
  return true;
}

bool check_imported(Checking& checking, const std::string& path, const Body& body) {
  const Outline& outline = body.outline;
  const auto& sides = body.imported->facet_sets;
  const Shape whole{checking, path, outline, geometry::outline_size(outline)};
  if (outline.edges.empty() || body.imported->cells.empty()) {
    whole.error("has no cells, or no edges");
    return false;
  }
  for (const Outline& chain : chains_of(outline)) {
    Shape shape{checking, path, chain, whole.size};
    if (!check_counts(shape) || !check_numbers(shape) || !check_closed(shape)) return false;
  }
  if (!check_names(whole) || !check_extent(whole)) return false;
  const auto lies = [&](int node, const Vec2& point) {
    return node >= 0 && static_cast<std::size_t>(node) < body.imported->nodes.size() &&
           (body.imported->nodes[static_cast<std::size_t>(node)] - point).norm() <= rounding_of_outlines * whole.size;
  };
  bool same = sides.size() == outline.edges.size();
  for (std::size_t i = 0; same && i < sides.size(); ++i)
    same = !sides[i].facets.empty() && lies(sides[i].facets.front().start, outline.edges[i].start) &&
           lies(sides[i].facets.back().end, outline.edges[i].end);
  if (!same) whole.error("the edges are not those of the mesh: make them with imported_body");
  return same;
}

bool check_outline(Checking& checking, const std::string& path, const Outline& outline, double body_size) {
  if (outline.holes.empty()) return check_chain(checking, path, outline, body_size);
  if (!check_counts({checking, path, outline})) return false;
  return check_holes(checking, path, outline);
}

}  // namespace scabo::model
