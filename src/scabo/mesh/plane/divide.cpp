#include "scabo/mesh/plane/divide.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <numbers>
#include <numeric>

#include "scabo/geometry/line_basis.hpp"
#include "scabo/mesh/plane/graded_edge.hpp"

namespace scabo::mesh {

namespace {

/// An arc element that turns by more than this approximates a circle poorly at low order.
constexpr double largest_turn = std::numbers::pi / 3;

/// Smallest sine of the angle between the ray from the scaling centre and the boundary; below it the boundary counts as
/// not visible.
constexpr double smallest_sine = 1e-6;

/// A part of an edge in the direction of the boundary of the super-element, counter-clockwise around the scaling
/// centre; `from` and `to` are measured in the direction of the edge.
struct Run {
  int edge = -1;
  double from = 0.0, to = 1.0;
};

/// The parts of the boundary: all edges without side faces, from the mouth of a crack to its other side.
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

/// More nodes are a mistyped size of mesh.refine.
constexpr double most_elements = 1e6;

/// Where an edge is divided along a run, ascending; nothing if into more than `most_elements`.
std::vector<double> breaks_of_run(const model::Body& body, const Run& run) {
  const geometry::Edge& edge = body.outline.edges[static_cast<std::size_t>(run.edge)];
  const double low = std::min(run.from, run.to), high = std::max(run.from, run.to);
  if (!body.mesh.refine.empty())
    return graded_breaks(edge, {low, high}, [&](const Vec2& x) { return wanted_size(body, {}, x); },
                         {.turn = largest_turn, .most = most_elements});
  const double elements = elements_of(edge, run, body.mesh.size);
  if (elements > most_elements) return {};
  std::vector<double> breaks;
  for (int k = 0; k < elements; ++k) breaks.push_back(std::lerp(low, high, k / elements));
  breaks.push_back(high);
  return breaks;
}

double elements_of(const model::Body& body, const Run& run) {
  if (body.mesh.refine.empty())
    return elements_of(body.outline.edges[static_cast<std::size_t>(run.edge)], run, body.mesh.size);
  const std::vector<double> breaks = breaks_of_run(body, run);
  return breaks.empty() ? std::numeric_limits<double>::infinity() : static_cast<double>(breaks.size()) - 1.0;
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

BodyDivision initial_division(const model::Body& body) {
  BodyDivision division(body.outline.edges.size());
  for (const Run& run : runs_of(body)) {
    EdgeDivision& divided = division[static_cast<std::size_t>(run.edge)];
    std::vector<double> breaks = breaks_of_run(body, run);
    ensure(!breaks.empty(), "the number of elements of an edge was checked");
    const std::size_t elements = breaks.size() - 1;
    if (!divided.breaks.empty()) breaks.pop_back();  // the last part beside a crack ends where the first began
    divided.breaks.insert(divided.breaks.begin(), breaks.begin(), breaks.end());
    divided.orders.insert(divided.orders.end(), elements, body.mesh.order);
  }
  return division;
}

BodyMesh divide_boundary(const model::Body& body) { return divide_boundary(body, initial_division(body)); }

namespace {

/// Elements along one part; their nodes are appended, except those of the last element but one node.
std::vector<LineElement> divide_run(const model::Edge& edge, const EdgeDivision& divided, const Run& run, int total,
                                    std::vector<Vec2>& nodes) {
  const double low = std::min(run.from, run.to), high = std::max(run.from, run.to);
  std::vector<std::size_t> elements;
  for (std::size_t k = 0; k < divided.orders.size(); ++k) {
    const double middle = 0.5 * (divided.breaks[k] + divided.breaks[k + 1]);
    if (middle > low && middle < high) elements.push_back(k);
  }
  const bool backwards = run.to < run.from;
  if (backwards) std::reverse(elements.begin(), elements.end());
  std::vector<LineElement> line;
  for (const std::size_t k : elements) {
    const int order = divided.orders[k];
    const std::vector<double> points = geometry::lobatto_points(order);
    const double from = divided.breaks[backwards ? k + 1 : k], to = divided.breaks[backwards ? k : k + 1];
    LineElement& element = line.emplace_back();
    for (int i = 0; i <= order; ++i) {
      element.nodes.push_back(static_cast<int>(nodes.size()) % total);  // closed: the last node is the first again
      if (i == order) break;                                            // the node belongs to the next element
      const bool first = line.size() == 1 && i == 0;
      nodes.push_back(
          edge.at(first ? run.from : std::lerp(from, to, 0.5 * (1.0 + points[static_cast<std::size_t>(i)]))));
    }
  }
  return line;
}

/// The elements of a part as those of its edge, in the direction of the edge.
void add_to_edge(const Run& run, const std::vector<LineElement>& line, std::vector<LineElement>& edge) {
  if (run.from < run.to) {
    // The first part beside a crack is the later part of its edge.
    edge.insert(run.from > 0.0 ? edge.end() : edge.begin(), line.begin(), line.end());
    return;
  }
  for (auto element = line.rbegin(); element != line.rend(); ++element)
    edge.push_back({{element->nodes.rbegin(), element->nodes.rend()}});
}

}  // namespace

BodyMesh divide_boundary(const model::Body& body, const BodyDivision& division) {
  const std::size_t edges = body.outline.edges.size();
  ensure(division.size() == edges, "a division speaks of every edge");
  int total = body.open() ? 1 : 0;
  for (const EdgeDivision& edge : division) total = std::accumulate(edge.orders.begin(), edge.orders.end(), total);
  BodyMesh mesh;
  mesh.nodes.reserve(static_cast<std::size_t>(total));
  mesh.edges.resize(edges);
  mesh.corners.assign(edges, -1);
  Cell whole;
  whole.centre = body.mesh.centre;
  if (body.sector_materials.empty()) whole.materials = {body.material};
  const std::vector<Run> runs = runs_of(body);
  for (const Run& run : runs) {
    const auto e = static_cast<std::size_t>(run.edge);
    const std::vector<LineElement> line = divide_run(body.outline.edges[e], division[e], run, total, mesh.nodes);
    add_to_edge(run, line, mesh.edges[e]);
    const auto corner_at = [&](double end) -> int& {
      return mesh.corners[static_cast<std::size_t>(end == 1.0 ? body.outline.next(run.edge) : run.edge)];
    };
    if (run.from == 0.0 || run.from == 1.0) corner_at(run.from) = line.front().nodes.front();
    if (run.to == 0.0 || run.to == 1.0) corner_at(run.to) = line.back().nodes.back();
    whole.boundary.insert(whole.boundary.end(), line.begin(), line.end());
    if (!body.sector_materials.empty())
      whole.materials.insert(whole.materials.end(), line.size(), body.sector_materials[e]);
  }
  if (body.open()) {
    const Run& last = runs.back();
    mesh.nodes.push_back(body.outline.edges[static_cast<std::size_t>(last.edge)].at(last.to));
    mesh.mouth = {0, total - 1};
  }
  ensure(static_cast<int>(mesh.nodes.size()) == total, "the boundary has the nodes that were counted");
  mesh.cells.push_back(std::move(whole));
  return mesh;
}

std::vector<Diagnostic> unseen_edges(const model::Body& body, const BodyMesh& mesh) {
  // J| is a polynomial of degree 2 p - 1 along an element: it is checked at 2 p + 1 points, including the ends.
  struct Sampling {
    Matrix shape, slope;
  };
  std::map<std::size_t, Sampling> of_order;
  const auto is_seen = [&](const LineElement& element) {
    const auto [found, is_new] = of_order.try_emplace(element.nodes.size());
    auto& [shape, slope] = found->second;
    if (is_new) {
      const int order = static_cast<int>(element.nodes.size()) - 1;
      const geometry::LineBasis& basis = geometry::LineBasis::of_order(order);
      shape = basis.values_at(geometry::lobatto_points(2 * order));
      slope = shape * basis.derivatives_at_nodes();
    }
    Eigen::MatrixX2d x(element.nodes.size(), 2);
    for (std::size_t i = 0; i < element.nodes.size(); ++i) {
      x.row(i) = mesh.nodes[element.nodes[i]] - body.mesh.centre;
    }
    const Eigen::MatrixX2d at = shape * x;
    const Eigen::MatrixX2d along = slope * x;
    const double sense = body.outside ? -1.0 : 1.0;  // the edges of an unbounded body run clockwise
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
             ? fmt::format("the arc {} in {} {} of order {} is not entirely visible from the scaling centre {}: use a "
                           "smaller 'size' or a higher 'order', or set 'centre'",
                           name, mesh.edges[e].size(), mesh.edges[e].size() == 1 ? "element" : "elements",
                           body.mesh.order, centre)
             : fmt::format("the edge {} is not entirely visible from the scaling centre {}: set 'centre' to a point "
                           "from which the whole boundary is visible, or divide the body",
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
