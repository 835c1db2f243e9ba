#include "scabo/mesh/plane/concurrent_rays.hpp"

#include <Eigen/QR>
#include <algorithm>
#include <cmath>

#include "scabo/geometry/line_basis.hpp"

namespace scabo::mesh {

namespace {

/// Height of a circle above a chord.
double rise(double chord, double radius) { return chord * chord / (8.0 * radius); }

/// The arc on which the points of a chain are; of the arc only the centre, the radius and the sense are meant.
std::optional<geometry::Arc> arc_through(const geometry::Edge& chain, double longest_element) {
  const bool closed = chain.start == chain.end;
  const int count = chain.segments() + (closed ? 0 : 1);
  if (count < 4) return std::nullopt;
  // Circle of least squares, |x|^2 = 2 c'x + e, about the first point and in units of the chain's length.
  const double unit = chain.length();
  Matrix A(count, 3);
  Vector b(count);
  for (int i = 0; i < count; ++i) {
    const Vec2 x = (chain.chain_point(i) - chain.start) / unit;
    A.row(i) << x.x(), x.y(), 1.0;
    b[i] = x.squaredNorm();
  }
  const Eigen::ColPivHouseholderQR<Matrix> fit(A);
  if (fit.rank() < 3) return std::nullopt;
  const Vector solution = fit.solve(b);
  const Vec2 centre = chain.start + 0.5 * unit * solution.head<2>();
  const double radius = unit * std::sqrt(std::max(solution[2] + 0.25 * solution.head<2>().squaredNorm(), 0.0));

  constexpr double on_circle = 0.01;
  double longest = longest_element, area = 0.0;
  for (int i = 0; i < chain.segments(); ++i) {
    const Vec2 from = chain.chain_point(i) - centre, to = chain.chain_point(i + 1) - centre;
    longest = std::max(longest, (to - from).norm());
    area += cross(from, to);
  }
  for (int i = 0; i < count; ++i)
    if (std::abs((chain.chain_point(i) - centre).norm() - radius) > on_circle * rise(longest, radius))
      return std::nullopt;
  return geometry::Arc{centre, radius, 0.0, std::copysign(1.0, area)};
}

/// The edge as a line or an arc.
std::optional<geometry::Edge> plain(const model::Model& model, std::size_t body, std::size_t index, const Mesh& mesh) {
  geometry::Edge edge = model.bodies[body].outline.edges[index];
  if (!edge.is_chain()) return edge;
  double longest = 0.0;
  const BodyMesh& of = mesh.bodies[body];
  for (const LineElement& element : of.edges[index])
    longest = std::max(longest, (of.nodes[static_cast<std::size_t>(element.nodes.back())] -
                                 of.nodes[static_cast<std::size_t>(element.nodes.front())])
                                    .norm());
  edge.arc = arc_through(edge, longest);
  if (!edge.arc) return std::nullopt;
  edge.points.clear();
  return edge;
}

/// Area between an element and the arc through its ends.
double area_beside(const LineElement& element, const geometry::Arc& arc, const std::vector<Vec2>& nodes) {
  const int order = static_cast<int>(element.nodes.size()) - 1;
  const geometry::LineBasis& basis = geometry::LineBasis::of_order(order);
  const auto point = [&](int i) -> Vec2 {
    return nodes[static_cast<std::size_t>(element.nodes[static_cast<std::size_t>(i)])] - arc.centre;
  };
  double twice = 0.0;  // by Lobatto's rule, exact for the degree 2 p - 1 of x times its derivative
  for (int i = 0; i <= order; ++i) {
    Vec2 along = Vec2::Zero();
    for (int j = 0; j <= order; ++j) along += basis.derivatives_at_nodes()(i, j) * point(j);
    twice += basis.weights()[static_cast<std::size_t>(i)] * cross(point(i), along);
  }
  const Vec2 from = point(0), to = point(order);
  const double angle = std::atan2(cross(from, to), from.dot(to));
  return 0.5 * std::abs(arc.radius * arc.radius * angle - twice);
}

}  // namespace

double lost_of_arcs(const model::Model& model, int body, const Mesh& mesh) {
  const auto b = static_cast<std::size_t>(body);
  const BodyMesh& of = mesh.bodies[b];
  double lost = 0.0;
  for (std::size_t index = 0; index < of.edges.size(); ++index) {
    const std::optional<geometry::Edge> edge = plain(model, b, index, mesh);
    if (!edge || !edge->arc) continue;
    for (const LineElement& element : of.edges[index]) lost += area_beside(element, *edge->arc, of.nodes);
  }
  return lost / std::abs(model.bodies[b].outline.area());
}

std::optional<Rays> concurrent_rays(const model::Model& model, const model::Contact& contact, const Mesh& mesh) {
  for (const model::Place& place : {contact.a, contact.b})
    if (place.kind != model::Place::Kind::edge || model.bodies[static_cast<std::size_t>(place.body)].rigid)
      return std::nullopt;
  const auto of = [&](const model::Place& place) {
    return plain(model, static_cast<std::size_t>(place.body), static_cast<std::size_t>(place.index), mesh);
  };
  const std::optional<geometry::Edge> a = of(contact.a), b = of(contact.b);
  if (!a || !b || (!a->arc && !b->arc)) return std::nullopt;
  return Rays(*a, *b);
}

}  // namespace scabo::mesh
