#include "scabo/mesh/many_cells.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <numbers>

#include "scabo/geometry/foot_points.hpp"
#include "scabo/geometry/outline_checks.hpp"
#include "scabo/mesh/divide.hpp"
#include "scabo/mesh/domain_triangles.hpp"
#include "scabo/mesh/polygons.hpp"
#include "scabo/mesh/quadtree.hpp"
#include "scabo/mesh/star_cells.hpp"

namespace scabo::mesh {

namespace {

/// A side on an arc turns by at most this, so that its chord is near it and cells beside it stay valid.
constexpr double largest_turn_of_side = std::numbers::pi / 8;

/// Fractions of the length of an edge at which it is divided, 0 and 1 included.
std::vector<double> breaks_of(const model::Body& body, const geometry::Edge& edge) {
  const double length = edge.length();
  const double by_turn = edge.arc ? std::abs(edge.arc->sweep) / largest_turn_of_side : 1.0;
  std::vector<double> breaks{0.0};
  if (body.mesh.refine.empty()) {
    const double count = std::max(elements_along(length, body.mesh.size), std::ceil(by_turn - 1e-9));
    for (int k = 1; k < count; ++k) breaks.push_back(k / count);
  } else {
    // As many elements as the integral of 1 / size, each with an equal part of it.
    constexpr int samples = 1000;
    std::vector<double> sum{0.0};
    for (int i = 0; i < samples; ++i) {
      const double size = std::min(wanted_size(body, edge.at((i + 0.5) / samples)), length / by_turn);
      sum.push_back(sum.back() + length / samples / size);
    }
    const double count = std::max(1.0, std::ceil(sum.back() - 1e-9));
    int i = 0;
    for (int k = 1; k < count; ++k) {
      const double part = k / count * sum.back();
      while (sum[static_cast<std::size_t>(i) + 1] < part) ++i;
      const double low = sum[static_cast<std::size_t>(i)], high = sum[static_cast<std::size_t>(i) + 1];
      breaks.push_back((i + (part - low) / (high - low)) / samples);
    }
  }
  breaks.push_back(1.0);
  return breaks;
}

/// The part of an edge from fraction `from` to `to`.
DomainLine part_of(const geometry::Edge& edge, const std::vector<double>& breaks, std::size_t from, std::size_t to) {
  DomainLine line;
  for (std::size_t k = from; k <= to; ++k) line.points.push_back(edge.at(breaks[k]));
  if (edge.arc) {
    line.arc = edge.arc;
    line.arc->start_angle += breaks[from] * edge.arc->sweep;
    line.arc->sweep *= breaks[to] - breaks[from];
  }
  return line;
}

/// Lines of one edge: one, or two halves of a long arc.
std::vector<DomainLine> lines_of(const model::Body& body, const geometry::Edge& edge) {
  std::vector<double> breaks = breaks_of(body, edge);
  if (!edge.arc || std::abs(edge.arc->sweep) < std::numbers::pi) return {part_of(edge, breaks, 0, breaks.size() - 1)};
  const std::size_t middle = breaks.size() / 2;
  return {part_of(edge, breaks, 0, middle), part_of(edge, breaks, middle, breaks.size() - 1)};
}

std::size_t lines_in(const geometry::Edge& edge) {
  return edge.arc && std::abs(edge.arc->sweep) >= std::numbers::pi ? 2 : 1;
}

/// Index of the innermost region that holds region `inner`, plus one; 0 if there is none.
int region_around(const model::Body& body, std::size_t inner) {
  int around = 0;
  double least = std::numeric_limits<double>::infinity();
  const Vec2 point = body.regions[inner].outline.edges.front().at(0.5);
  for (std::size_t k = 0; k < body.regions.size(); ++k) {
    const geometry::Outline& outline = body.regions[k].outline;
    if (k == inner || outline.area() >= least || !geometry::encloses(outline, point)) continue;
    around = static_cast<int>(k) + 1;
    least = outline.area();
  }
  return around;
}

double approximate_nodes(const model::Body& body) {
  // A cell of side h has an area of about h^2 as a square and 2.6 h^2 as a hexagon; each has about two inner sides.
  const double area = std::abs(body.outline.area());
  constexpr int samples = 200;  // the finest size counts in its own surroundings only
  double cells = area / (body.mesh.size * body.mesh.size);
  for (const model::LocalSize& local : body.mesh.refine) {
    const double around = local.near ? 1.0 : body.outline.edges[static_cast<std::size_t>(local.edge)].length();
    for (int i = 0; i < samples; ++i) {  // rings around the place
      const double ratio = body.mesh.size / local.size;
      if (ratio <= 1.0) break;
      const double size = local.size * std::pow(ratio, (i + 0.5) / samples);
      const double distance = (size - local.size) / model::mesh_growth;
      const double width = size * std::log(ratio) / samples / model::mesh_growth;
      const double ring = local.near ? 2.0 * std::numbers::pi * distance : 2.0 * around;
      cells += std::min(area, ring * width) / (size * size);
    }
  }
  return cells * (1.0 + 2.0 * (body.mesh.order - 1));
}

/// Points between the ends of a side, in the direction from `a` to `b`.
std::vector<Vec2> between(const Vec2& a, const Vec2& b, int order, const std::optional<geometry::Arc>& arc) {
  const std::vector<double> lobatto = lobatto_points(order);
  std::vector<Vec2> points;
  for (int i = 1; i < order; ++i) {
    const double t = 0.5 * (1.0 + lobatto[static_cast<std::size_t>(i)]);
    if (!arc) {
      points.push_back(a + t * (b - a));
      continue;
    }
    const Vec2 from = a - arc->centre, to = b - arc->centre;
    const double turn = std::atan2(cross(from, to), from.dot(to)), angle = std::atan2(from.y(), from.x()) + t * turn;
    const double radius = (1.0 - t) * from.norm() + t * to.norm();
    points.push_back(arc->centre + radius * Vec2(std::cos(angle), std::sin(angle)));
  }
  return points;
}

PolygonMesh polygons_of(const Domain& domain, const model::MeshOptions& mesh) {
  switch (mesh.kind) {
    case model::MeshKind::polygons:
      return polygon_mesh(domain);
    case model::MeshKind::quadtree:
      return quadtree_mesh(domain, {.min_size = mesh.min_size});
    case model::MeshKind::parts:
      return star_cells(domain);
    case model::MeshKind::fem:
      return triangle_mesh(domain);
    case model::MeshKind::superelement:
    case model::MeshKind::imported:
      break;
  }
  throw BrokenInvariant("one super-element, or a mesh of a file, is not made of polygons");
}

}  // namespace

double wanted_size(const model::Body& body, const Vec2& x) {
  double size = body.mesh.size;
  for (const model::LocalSize& local : body.mesh.refine) {
    const double distance = local.near
                                ? (*local.near - x).norm()
                                : geometry::distance_to(body.outline.edges[static_cast<std::size_t>(local.edge)], x);
    size = std::min(size, local.size + model::mesh_growth * distance);
  }
  return size;
}

Domain domain_of(const model::Body& body) {
  Domain domain;
  const auto add = [&](const geometry::Outline& outline, int left, int right) {
    for (const geometry::Edge& edge : outline.edges)
      for (DomainLine& line : lines_of(body, edge)) {
        line.left = left;
        line.right = right;
        domain.lines.push_back(std::move(line));
      }
  };
  add(body.outline, 0, -1);
  for (std::size_t k = 0; k < body.regions.size(); ++k)
    add(body.regions[k].outline, static_cast<int>(k) + 1, region_around(body, k));
  domain.size = [&body](const Vec2& x) { return wanted_size(body, x); };
  return domain;
}

BodyMesh body_mesh_of(const PolygonMesh& polygons, const Domain& domain, const model::Body& body) {
  const int order = body.mesh.order;
  BodyMesh mesh;
  mesh.nodes = polygons.nodes;
  using Ends = std::pair<int, int>;
  std::map<Ends, std::size_t> on_arc;  // lower number first
  for (std::size_t l = 0; l < domain.lines.size(); ++l)
    for (const auto* chain : {&polygons.left[l], &polygons.right[l]})
      for (std::size_t k = 0; domain.lines[l].arc && k + 1 < chain->size(); ++k)
        on_arc.emplace(std::minmax((*chain)[k], (*chain)[k + 1]), l);
  std::map<Ends, std::vector<int>> inner;  // nodes between the ends, from the lower number on
  const auto side = [&](int a, int b) {
    const Ends ends = std::minmax(a, b);
    LineElement element;
    element.nodes.push_back(a);
    if (order > 1) {
      const auto [found, is_new] = inner.try_emplace(ends);
      if (is_new) {
        const auto arc = on_arc.find(ends);
        for (const Vec2& x : between(mesh.nodes[static_cast<std::size_t>(ends.first)],
                                     mesh.nodes[static_cast<std::size_t>(ends.second)], order,
                                     arc == on_arc.end() ? std::nullopt : domain.lines[arc->second].arc)) {
          found->second.push_back(static_cast<int>(mesh.nodes.size()));
          mesh.nodes.push_back(x);
        }
      }
      if (a == ends.first)
        element.nodes.insert(element.nodes.end(), found->second.begin(), found->second.end());
      else
        element.nodes.insert(element.nodes.end(), found->second.rbegin(), found->second.rend());
    }
    element.nodes.push_back(b);
    return element;
  };
  for (const PolygonCell& polygon : polygons.cells) {
    Cell cell;
    if (body.mesh.kind == model::MeshKind::fem) cell.kind = CellKind::finite_element;
    cell.centre = polygon.centre;
    const auto material_of = [&](int region) {
      return region == 0 ? body.material : body.regions[static_cast<std::size_t>(region - 1)].material;
    };
    cell.materials = {material_of(polygon.region)};
    if (!polygon.side_regions.empty()) cell.materials.clear();
    for (const int region : polygon.side_regions) cell.materials.push_back(material_of(region));
    const std::size_t count = polygon.nodes.size();
    for (std::size_t i = 0; i + (polygon.open ? 1 : 0) < count; ++i)
      cell.boundary.push_back(side(polygon.nodes[i], polygon.nodes[(i + 1) % count]));
    mesh.cells.push_back(std::move(cell));
  }
  std::size_t line = 0;
  for (const geometry::Edge& edge : body.outline.edges) {
    std::vector<LineElement>& elements = mesh.edges.emplace_back();
    mesh.corners.push_back(polygons.left[line].empty() ? -1 : polygons.left[line].front());
    for (std::size_t part = 0; part < lines_in(edge); ++part, ++line)
      for (std::size_t k = 0; k + 1 < polygons.left[line].size(); ++k)
        elements.push_back(side(polygons.left[line][k], polygons.left[line][k + 1]));
  }
  return mesh;
}

std::variant<BodyMesh, Diagnostic> divide_into_cells(const model::Body& body, double most_nodes) {
  const double nodes = body.mesh.kind == model::MeshKind::parts ? 0.0 : approximate_nodes(body);
  if (!(nodes <= most_nodes))
    return Diagnostic{body.mesh.source, fmt::format("size {:.6g} would give about {:.2g} nodes, more than the {:.7g} "
                                                    "allowed: use a larger 'size'",
                                                    body.mesh.size, nodes, most_nodes)};
  const Domain domain = domain_of(body);
  try {
    return body_mesh_of(polygons_of(domain, body.mesh), domain, body);
  } catch (const InputError& error) {
    return Diagnostic{body.mesh.source,
                      fmt::format("this shape could not be divided ({}): use another 'size' or kind", error.diagnostics().front().message)};
  }
}

}  // namespace scabo::mesh
