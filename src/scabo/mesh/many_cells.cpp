#include "scabo/mesh/many_cells.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <numbers>

#include "scabo/geometry/box.hpp"
#include "scabo/geometry/foot_points.hpp"
#include "scabo/geometry/outline_checks.hpp"
#include "scabo/mesh/divide.hpp"
#include "scabo/mesh/domain_triangles.hpp"
#include "scabo/mesh/polygon_kernel.hpp"
#include "scabo/mesh/polygons.hpp"
#include "scabo/mesh/quadtree.hpp"
#include "scabo/mesh/star_cells.hpp"

namespace scabo::mesh {

namespace {

/// A side on an arc turns by at most this, so that its chord is near it and cells beside it stay valid.
constexpr double largest_turn_of_side = std::numbers::pi / 12;

/// Fractions of the length of an edge at which its part from `from` to `to` is divided, both included.
std::vector<double> breaks_of(const model::Body& body, const SizeField& sizes, const geometry::Edge& edge, double from,
                              double to) {
  const double length = (to - from) * edge.length();
  const double by_turn = edge.arc ? (to - from) * std::abs(edge.arc->sweep) / largest_turn_of_side : 1.0;
  std::vector<double> breaks{from};
  if (body.mesh.refine.empty() && sizes.empty()) {
    const double count = std::max(elements_along(length, body.mesh.size), std::ceil(by_turn - 1e-9));
    for (int k = 1; k < count; ++k) breaks.push_back(std::lerp(from, to, k / count));
  } else {
    // As many elements as the integral of 1 / size, each with an equal part of it. Steps are short compared with the
    // size, which changes by less than the distance.
    constexpr int samples = 1000;
    constexpr double longest_step = 0.25;
    std::vector<double> ends{from}, sum{0.0};
    const auto add = [&](const auto& self, double low, double high) -> void {
      const double step = (high - low) * edge.length();
      const double size = std::min(wanted_size(body, sizes, edge.at(0.5 * (low + high))), length / by_turn);
      if (step > longest_step * size && step > 1e-9 * length) {
        self(self, low, 0.5 * (low + high));
        self(self, 0.5 * (low + high), high);
        return;
      }
      ends.push_back(high);
      sum.push_back(sum.back() + step / size);
    };
    for (int i = 0; i < samples; ++i)
      add(add, std::lerp(from, to, double(i) / samples), std::lerp(from, to, (i + 1.0) / samples));
    const double count = std::max(1.0, std::ceil(sum.back() - 1e-9));
    std::size_t i = 0;
    for (int k = 1; k < count; ++k) {
      const double part = k / count * sum.back();
      while (sum[i + 1] < part) ++i;
      breaks.push_back(std::lerp(ends[i], ends[i + 1], (part - sum[i]) / (sum[i + 1] - sum[i])));
    }
  }
  breaks.push_back(to);
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

/// Lines of an edge between the given positions on it, `cuts`, which include 0 and 1: one, or two halves of a long arc.
std::vector<DomainLine> lines_of(const model::Body& body, const SizeField& sizes, const geometry::Edge& edge,
                                 const std::vector<double>& cuts) {
  std::vector<DomainLine> lines;
  for (std::size_t c = 0; c + 1 < cuts.size(); ++c) {
    const std::vector<double> breaks = breaks_of(body, sizes, edge, cuts[c], cuts[c + 1]);
    const std::size_t last = breaks.size() - 1;
    if (!edge.arc || (cuts[c + 1] - cuts[c]) * std::abs(edge.arc->sweep) < std::numbers::pi) {
      lines.push_back(part_of(edge, breaks, 0, last));
      continue;
    }
    lines.push_back(part_of(edge, breaks, 0, last / 2));
    lines.push_back(part_of(edge, breaks, last / 2, last));
  }
  return lines;
}

/// Cracks as chains of segments that end where others begin; ends on the outline are moved exactly onto it.
class CrackNet {
 public:
  explicit CrackNet(const model::Body& body) : tolerance_(1e-9 * geometry::outline_size(body.outline)) {
    cuts_.assign(body.outline.edges.size(), {0.0, 1.0});
    for (const model::Crack& crack : body.cracks) paths_.push_back(crack.path);
    for (std::size_t p = 0; p < paths_.size(); ++p)
      for (const bool last : {false, true}) {
        Vec2& end = last ? paths_[p].back() : paths_[p].front();
        if (!put_on_outline(body, end) && !put_on_crack(p, end)) tips.push_back(end);
      }
    for (std::vector<double>& cut : cuts_) std::sort(cut.begin(), cut.end());
  }

  std::vector<Vec2> tips;
  const std::vector<std::vector<Vec2>>& paths() const { return paths_; }
  /// Positions at which cracks end on an edge, with 0 and 1.
  const std::vector<double>& cuts(std::size_t edge) const { return cuts_[edge]; }

 private:
  bool put_on_outline(const model::Body& body, Vec2& end) {
    for (std::size_t e = 0; e < body.outline.edges.size(); ++e) {
      const geometry::Edge& edge = body.outline.edges[e];
      const double at = geometry::closest_position(edge, end);
      if ((edge.at(at) - end).norm() > tolerance_) continue;
      end = edge.at(at);
      const double slack = tolerance_ / edge.length();
      if (at <= slack) {
        end = edge.start;
      } else if (at >= 1.0 - slack) {
        end = edge.end;
      } else {
        cuts_[e].push_back(at);
        end = edge.at(at);
      }
      return true;
    }
    return false;
  }

  /// An end on another crack becomes a point of it.
  bool put_on_crack(std::size_t own, Vec2& end) {
    for (std::size_t p = 0; p < paths_.size(); ++p) {
      if (p == own) continue;
      std::vector<Vec2>& path = paths_[p];
      for (std::size_t k = 0; k + 1 < path.size(); ++k) {
        const Vec2 along = path[k + 1] - path[k];
        const double t = (end - path[k]).dot(along) / along.squaredNorm();
        if (t < -1e-9 || t > 1.0 + 1e-9 || (path[k] + t * along - end).norm() > tolerance_) continue;
        if ((path[k] - end).norm() <= tolerance_)
          end = path[k];
        else if ((path[k + 1] - end).norm() <= tolerance_)
          end = path[k + 1];
        else
          path.insert(path.begin() + static_cast<std::ptrdiff_t>(k) + 1, end);
        return true;
      }
    }
    return false;
  }

  double tolerance_;
  std::vector<std::vector<Vec2>> paths_;
  std::vector<std::vector<double>> cuts_;
};

/// Region that holds a point, as in BodyDomain.
int region_at(const model::Body& body, const Vec2& point) {
  int at = 0;
  double least = std::numeric_limits<double>::infinity();
  for (std::size_t k = 0; k < body.regions.size(); ++k) {
    const geometry::Outline& outline = body.regions[k].outline;
    if (outline.area() >= least || !geometry::encloses(outline, point)) continue;
    at = static_cast<int>(k) + 1;
    least = outline.area();
  }
  return at;
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

PolygonMesh polygons_of(const Domain& domain, const model::Body& body) {
  const auto size_of_options = [&body](const Vec2& x) { return wanted_size(body, {}, x); };
  switch (body.mesh.kind) {
    case model::MeshKind::polygons:
      return polygon_mesh(domain);
    case model::MeshKind::quadtree:
      return quadtree_mesh(domain, {.min_size = body.mesh.min_size, .size_of_roots = size_of_options});
    case model::MeshKind::parts:
      return star_cells(domain);
    case model::MeshKind::fem:
      return triangle_mesh(domain);
    case model::MeshKind::superelement:
      break;
  }
  throw BrokenInvariant("one super-element is not made of polygons");
}

}  // namespace

double wanted_size(const model::Body& body, const SizeField& sizes, const Vec2& x) {
  double size = std::min(body.mesh.size, sizes.at(x));
  for (const model::LocalSize& local : body.mesh.refine) {
    const double distance = local.near
                                ? (*local.near - x).norm()
                                : geometry::distance_to(body.outline.edges[static_cast<std::size_t>(local.edge)], x);
    size = std::min(size, local.size + model::mesh_growth * distance);
  }
  return size;
}

BodyDomain domain_of(const model::Body& body, const SizeField& sizes) {
  BodyDomain made;
  const CrackNet cracks(body);
  for (std::size_t e = 0; e < body.outline.edges.size(); ++e) {
    made.lines_of_edge.emplace_back();
    for (DomainLine& line : lines_of(body, sizes, body.outline.edges[e], cracks.cuts(e))) {
      made.lines_of_edge.back().push_back(made.domain.lines.size());
      made.domain.lines.push_back(std::move(line));
    }
  }
  for (std::size_t k = 0; k < body.regions.size(); ++k)
    for (const geometry::Edge& edge : body.regions[k].outline.edges)
      for (DomainLine& line : lines_of(body, sizes, edge, {0.0, 1.0})) {
        line.left = static_cast<int>(k) + 1;
        line.right = region_around(body, k);
        made.domain.lines.push_back(std::move(line));
      }
  for (const std::vector<Vec2>& path : cracks.paths())
    for (std::size_t k = 0; k + 1 < path.size(); ++k) {
      geometry::Edge edge;
      edge.start = path[k];
      edge.end = path[k + 1];
      const std::vector<double> breaks = breaks_of(body, sizes, edge, 0.0, 1.0);
      DomainLine line = part_of(edge, breaks, 0, breaks.size() - 1);
      line.crack = true;
      line.left = line.right = region_at(body, edge.at(0.5));
      made.domain.lines.push_back(std::move(line));
    }
  made.domain.centres = cracks.tips;
  made.domain.size = [&body, &sizes](const Vec2& x) { return wanted_size(body, sizes, x); };
  return made;
}

BodyMesh body_mesh_of(const PolygonMesh& polygons, const BodyDomain& of, const model::Body& body) {
  const Domain& domain = of.domain;
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
  // A side on a hollow arc is seen from where its end tangents are seen: the corner where they meet stands for it.
  const auto seeing_centre = [&](const PolygonCell& polygon) {
    std::vector<Vec2> points;
    bool hollow = false;
    const std::size_t count = polygon.nodes.size();
    for (std::size_t i = 0; i < count; ++i) {
      const int a = polygon.nodes[i], b = polygon.nodes[(i + 1) % count];
      const Vec2 &from = mesh.nodes[static_cast<std::size_t>(a)], &to = mesh.nodes[static_cast<std::size_t>(b)];
      points.push_back(from);
      const auto arc = on_arc.find(std::minmax(a, b));
      if (arc == on_arc.end() || (polygon.open && i + 1 == count)) continue;
      const Vec2 &centre = domain.lines[arc->second].arc->centre, middle = 0.5 * (from + to) - centre;
      if (cross(from - centre, to - centre) >= 0.0) continue;  // bulges outwards
      hollow = true;
      points.push_back(centre + (from - centre).squaredNorm() / middle.squaredNorm() * middle);
    }
    constexpr double well_seen = 0.1;
    if (!hollow || polygon.open || visibility(points, polygon.centre) > well_seen) return polygon.centre;
    const KernelCentre better = kernel_centre(points, well_seen);
    return better.visibility > 0.0 ? better.centre : polygon.centre;
  };
  for (const PolygonCell& polygon : polygons.cells) {
    Cell cell;
    if (body.mesh.kind == model::MeshKind::fem) cell.kind = CellKind::finite_element;
    cell.centre = seeing_centre(polygon);
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
  for (const std::vector<std::size_t>& lines : of.lines_of_edge) {
    std::vector<LineElement>& elements = mesh.edges.emplace_back();
    mesh.corners.push_back(polygons.left[lines.front()].empty() ? -1 : polygons.left[lines.front()].front());
    for (const std::size_t line : lines)
      for (std::size_t k = 0; k + 1 < polygons.left[line].size(); ++k)
        elements.push_back(side(polygons.left[line][k], polygons.left[line][k + 1]));
  }
  return mesh;
}

std::variant<BodyMesh, Diagnostic> divide_into_cells(const model::Body& body, const SizeField& sizes,
                                                     double most_nodes) {
  const double nodes = body.mesh.kind == model::MeshKind::parts ? 0.0 : approximate_nodes(body);
  if (!(nodes <= most_nodes))
    return Diagnostic{body.mesh.source, fmt::format("size {:.6g} would give about {:.2g} nodes, more than the {:.7g} "
                                                    "allowed: use a larger 'size'",
                                                    body.mesh.size, nodes, most_nodes)};
  const BodyDomain of = domain_of(body, sizes);
  try {
    return body_mesh_of(polygons_of(of.domain, body), of, body);
  } catch (const InputError& error) {
    return Diagnostic{body.mesh.source,
                      fmt::format("this shape could not be divided ({}): use another 'size' or kind", error.diagnostics().front().message)};
  }
}

}  // namespace scabo::mesh
