#include "scabo/mesh/divide.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "scabo/mesh/lobatto.hpp"

namespace scabo::mesh {

namespace {

/// An arc element that turns by more than this is a poor circle at low order.
constexpr double largest_turn = std::numbers::pi / 3;

/// Smallest sine of the angle between the ray from the scaling centre and the boundary; below it the boundary
/// counts as seen edge-on.
constexpr double smallest_sine = 1e-6;

/// A part of an edge as the boundary of the super-element is run, counter-clockwise around the scaling centre: from and to
/// count along the edge's own direction.
struct Run {
  int edge = -1;
  double from = 0.0, to = 1.0;
};

/// The runs of the boundary: all edges, without side faces, from the mouth of a crack to its other side.
std::vector<Run> runs_of(const model::Body& body) {
  const int count = static_cast<int>(body.outline.edges.size());
  std::vector<Run> runs;
  if (!body.cracks.empty()) {
    const model::Crack& crack = body.cracks.front();
    runs.push_back({crack.edge, crack.at, 1.0});
    for (int k = 1; k < count; ++k) runs.push_back({(crack.edge + k) % count});
    if (crack.at > 0.0) runs.push_back({crack.edge, 0.0, crack.at});
    return runs;
  }
  const int corner = body.mesh.centre_corner;  // edge `corner` leaves it, the one before arrives
  if (corner >= 0) {
    for (int k = 1; k + 1 < count; ++k) runs.push_back({(corner + k) % count});
  } else {
    for (int k = 0; k < count; ++k) runs.push_back({k});
  }
  if (body.outside) {  // the outline runs clockwise around the hole
    std::reverse(runs.begin(), runs.end());
    for (Run& run : runs) std::swap(run.from, run.to);
  }
  return runs;
}

double elements_of(const model::Edge& edge, const Run& run, double size) {
  const double part = std::abs(run.to - run.from);
  const double by_length = elements_along(part * edge.length(), size);
  return edge.arc ? std::max(by_length, elements_along(part * std::abs(edge.arc->sweep), largest_turn)) : by_length;
}

double elements_of(const model::Body& body, const Run& run) {
  return elements_of(body.outline.edges[static_cast<std::size_t>(run.edge)], run, body.mesh.size);
}

}  // namespace

double elements_along(double length, double size) {
  ensure(size > 0.0 && length >= 0.0, "an element has a positive size");
  return std::max(1.0, std::ceil(length / size - 1e-9));
}

double count_boundary_nodes(const model::Body& body) {
  double elements = 0.0;
  for (const Run& run : runs_of(body)) elements += elements_of(body, run);
  return elements * body.mesh.order + (body.open() ? 1.0 : 0.0);
}

namespace {

/// Elements along one run, their nodes appended; those of the run's last element but one node.
std::vector<LineElement> divide_run(const model::Body& body, const Run& run, int total, std::vector<Vec2>& nodes) {
  const model::Edge& edge = body.outline.edges[static_cast<std::size_t>(run.edge)];
  const int order = body.mesh.order, elements = static_cast<int>(elements_of(body, run));
  const std::vector<double> points = lobatto_points(order);
  std::vector<LineElement> line;
  for (int k = 0; k < elements; ++k) {
    LineElement& element = line.emplace_back();
    for (int i = 0; i <= order; ++i) {
      element.nodes.push_back(static_cast<int>(nodes.size()) % total);  // closed: the last node is the first again
      if (i == order) break;                                           // and belongs to the next element
      const double part = (k + 0.5 * (1.0 + points[static_cast<std::size_t>(i)])) / elements;
      nodes.push_back(k == 0 && i == 0 ? edge.at(run.from) : edge.at(run.from + part * (run.to - run.from)));
    }
  }
  return line;
}

/// The elements of a run as those of its edge, in the edge's own direction.
void add_to_edge(const Run& run, const std::vector<LineElement>& line, std::vector<LineElement>& edge) {
  if (run.from < run.to) {
    // A crack's first run is the later part of its edge.
    edge.insert(run.from > 0.0 ? edge.end() : edge.begin(), line.begin(), line.end());
    return;
  }
  for (auto element = line.rbegin(); element != line.rend(); ++element)
    edge.push_back({{element->nodes.rbegin(), element->nodes.rend()}});
}

}  // namespace

BodyMesh divide_boundary(const model::Body& body) {
  const std::size_t edges = body.outline.edges.size();
  const int total = static_cast<int>(count_boundary_nodes(body));
  BodyMesh mesh;
  mesh.nodes.reserve(static_cast<std::size_t>(total));
  mesh.edges.resize(edges);
  mesh.corners.assign(edges, -1);
  SuperElement whole;
  whole.centre = body.mesh.centre;
  const std::vector<Run> runs = runs_of(body);
  for (const Run& run : runs) {
    const std::vector<LineElement> line = divide_run(body, run, total, mesh.nodes);
    add_to_edge(run, line, mesh.edges[static_cast<std::size_t>(run.edge)]);
    const auto corner_at = [&](double end) -> int& {
      return mesh.corners[(static_cast<std::size_t>(run.edge) + (end == 1.0 ? 1 : 0)) % edges];
    };
    if (run.from == 0.0 || run.from == 1.0) corner_at(run.from) = line.front().nodes.front();
    if (run.to == 0.0 || run.to == 1.0) corner_at(run.to) = line.back().nodes.back();
    whole.boundary.insert(whole.boundary.end(), line.begin(), line.end());
    if (!body.sector_materials.empty())
      mesh.materials.insert(mesh.materials.end(), line.size(), body.sector_materials[static_cast<std::size_t>(run.edge)]);
  }
  if (body.open()) {
    const Run& last = runs.back();
    mesh.nodes.push_back(body.outline.edges[static_cast<std::size_t>(last.edge)].at(last.to));
  }
  ensure(static_cast<int>(mesh.nodes.size()) == total, "the boundary has the nodes that were counted");
  mesh.super_elements.push_back(std::move(whole));
  return mesh;
}

std::vector<Diagnostic> unseen_edges(const model::Body& body, const BodyMesh& mesh) {
  const LobattoBasis basis(body.mesh.order);
  // |J| is a polynomial of degree 2 p - 1 along an element: 2 p + 1 points, the ends among them.
  const Matrix shape = basis.shape_at(lobatto_points(2 * body.mesh.order));
  const Matrix slope = shape * basis.derivative;

  const auto is_seen = [&](const LineElement& element) {
    Eigen::MatrixX2d x(element.nodes.size(), 2);
    for (std::size_t i = 0; i < element.nodes.size(); ++i) {
      x.row(i) = mesh.nodes[element.nodes[i]] - body.mesh.centre;
    }
    const Eigen::MatrixX2d at = shape * x;
    const Eigen::MatrixX2d along = slope * x;
    const double sense = body.outside ? -1.0 : 1.0;  // the edges of an outside body run clockwise
    for (Eigen::Index k = 0; k < at.rows(); ++k) {
      const Vec2 ray = at.row(k);
      const Vec2 tangent = sense * along.row(k);
      if (!(cross(ray, tangent) > smallest_sine * ray.norm() * tangent.norm())) return false;
    }
    return true;
  };

  std::vector<Diagnostic> mistakes;
  for (std::size_t e = 0; e < mesh.edges.size(); ++e) {
    if (std::all_of(mesh.edges[e].begin(), mesh.edges[e].end(), is_seen)) continue;
    const std::string centre = fmt::format("({:.6g}, {:.6g})", body.mesh.centre.x(), body.mesh.centre.y());
    const std::string name = edge_name(body, static_cast<int>(e));
    mistakes.push_back(
        {body.mesh.source,
         body.outline.edges[e].arc
             ? fmt::format(
                   "the arc {} in {} {} of order {} is not wholly seen from the scaling centre {}: use a "
                   "smaller 'size' or a higher 'order', or set 'centre'",
                   name, mesh.edges[e].size(), mesh.edges[e].size() == 1 ? "element" : "elements",
                   body.mesh.order, centre)
             : fmt::format(
                   "the edge {} is not seen from the scaling centre {}: set 'centre' to a point that sees "
                   "the whole boundary, or cut the body in two",
                   name, centre)});
  }
  return mistakes;
}

std::string edge_name(const model::Body& body, int edge) {
  const std::vector<std::string>& names = body.outline.edges[edge].names;
  if (names.empty()) return fmt::format("{}.edge_{}", body.name, edge + 1);
  return body.name + "." + names[names.size() > 1 ? 1 : 0];
}

}  // namespace scabo::mesh
