#include "scabo/mesh/divide.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <numbers>
#include <numeric>

#include "scabo/mesh/lobatto.hpp"

namespace scabo::mesh {

namespace {

/// An arc element that turns by more than this is a poor circle at low order.
constexpr double largest_turn = std::numbers::pi / 3;

/// Smallest sine of the angle between the ray from the scaling centre and the boundary; below it the boundary
/// counts as seen edge-on.
constexpr double smallest_sine = 1e-6;

double elements_of(const model::Edge& edge, double size) {
  const double by_length = elements_along(edge.length(), size);
  return edge.arc ? std::max(by_length, elements_along(std::abs(edge.arc->sweep), largest_turn)) : by_length;
}

}  // namespace

double elements_along(double length, double size) {
  ensure(size > 0.0 && length >= 0.0, "an element has a positive size");
  return std::max(1.0, std::ceil(length / size - 1e-9));
}

double count_boundary_nodes(const model::Body& body) {
  double elements = 0.0;
  for (const model::Edge& edge : body.outline.edges) elements += elements_of(edge, body.mesh.size);
  return elements * body.mesh.order;
}

BodyDivision uniform_division(const model::Body& body) {
  BodyDivision division;
  for (const model::Edge& edge : body.outline.edges) {
    const int elements = static_cast<int>(elements_of(edge, body.mesh.size));
    EdgeDivision& divided = division.emplace_back();
    divided.orders.assign(static_cast<std::size_t>(elements), body.mesh.order);
    for (int k = 0; k <= elements; ++k) divided.breaks.push_back(static_cast<double>(k) / elements);
  }
  return division;
}

BodyMesh divide_boundary(const model::Body& body) { return divide_boundary(body, uniform_division(body)); }

BodyMesh divide_boundary(const model::Body& body, const BodyDivision& division) {
  ensure(division.size() == body.outline.edges.size(), "a division speaks of every edge");
  int total = 0;
  for (const EdgeDivision& edge : division) total = std::accumulate(edge.orders.begin(), edge.orders.end(), total);

  BodyMesh mesh;
  mesh.nodes.reserve(static_cast<std::size_t>(total));
  SuperElement whole;
  whole.centre = body.mesh.centre;
  for (std::size_t e = 0; e < division.size(); ++e) {
    const model::Edge& edge = body.outline.edges[e];
    const EdgeDivision& divided = division[e];
    mesh.corners.push_back(static_cast<int>(mesh.nodes.size()));
    std::vector<LineElement>& line = mesh.edges.emplace_back();
    for (std::size_t k = 0; k < divided.orders.size(); ++k) {
      const int order = divided.orders[k];
      const std::vector<double> points = lobatto_points(order);
      LineElement element;
      for (int i = 0; i <= order; ++i) {
        const int next = static_cast<int>(mesh.nodes.size());
        element.nodes.push_back(next % total);  // the last node is the first again
        if (i == order) break;                  // and belongs to the next element
        const bool corner = k == 0 && i == 0;
        const double t = std::lerp(divided.breaks[k], divided.breaks[k + 1], 0.5 * (1.0 + points[i]));
        mesh.nodes.push_back(corner ? edge.start : edge.at(t));
      }
      line.push_back(element);
      whole.boundary.push_back(std::move(element));
    }
  }
  ensure(static_cast<int>(mesh.nodes.size()) == total, "the boundary has the nodes that were counted");
  mesh.super_elements.push_back(std::move(whole));
  return mesh;
}

std::vector<Diagnostic> unseen_edges(const model::Body& body, const BodyMesh& mesh) {
  // |J| is a polynomial of degree 2 p - 1 along an element: 2 p + 1 points, the ends among them.
  struct Sampling {
    Matrix shape, slope;
  };
  std::map<std::size_t, Sampling> of_order;
  const auto is_seen = [&](const LineElement& element) {
    const auto [found, is_new] = of_order.try_emplace(element.nodes.size());
    auto& [shape, slope] = found->second;
    if (is_new) {
      const int order = static_cast<int>(element.nodes.size()) - 1;
      const LobattoBasis basis(order);
      shape = basis.shape_at(lobatto_points(2 * order));
      slope = shape * basis.derivative;
    }
    Eigen::MatrixX2d x(element.nodes.size(), 2);
    for (std::size_t i = 0; i < element.nodes.size(); ++i) {
      x.row(i) = mesh.nodes[element.nodes[i]] - body.mesh.centre;
    }
    const Eigen::MatrixX2d at = shape * x;
    const Eigen::MatrixX2d along = slope * x;
    for (Eigen::Index k = 0; k < at.rows(); ++k) {
      const Vec2 ray = at.row(k);
      const Vec2 tangent = along.row(k);
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
