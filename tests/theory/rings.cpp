#include "theory/rings.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "scabo/element/plane/elasticity.hpp"
#include "scabo/geometry/line_basis.hpp"

namespace scabo::test {

element::Ring polygon_ring(const std::vector<Vec2>& vertices, const std::vector<int>& divisions, int order) {
  const std::vector<double> points = geometry::lobatto_points(order);
  element::Ring ring;
  for (std::size_t i = 0; i < vertices.size(); ++i) {
    const Vec2 from = vertices[i], along = vertices[(i + 1) % vertices.size()] - from;
    for (int part = 0; part < divisions[i]; ++part) {
      mesh::LineElement element;
      for (int k = 0; k <= order; ++k) element.nodes.push_back(static_cast<int>(ring.nodes.size()) + k);
      for (int k = 0; k < order; ++k)
        ring.nodes.push_back(from + (part + 0.5 * (points[static_cast<std::size_t>(k)] + 1.0)) / divisions[i] * along);
      ring.elements.push_back(element);
    }
  }
  ring.elements.back().nodes.back() = 0;
  return ring;
}

element::Ring polygon_ring(const std::vector<Vec2>& vertices, int divisions, int order) {
  return polygon_ring(vertices, std::vector<int>(vertices.size(), divisions), order);
}

std::vector<element::RadialLoad> uniform_body_force(const element::Ring& ring, const Vec2& b, double thickness) {
  return element::body_force_loads(ring, {b.x()}, {b.y()}, thickness);
}

std::vector<Vec2> rectangle(double width, double height) {
  const double x = 0.5 * width, y = 0.5 * height;
  return {{-x, -y}, {x, -y}, {x, y}, {-x, y}};
}

element::Ring rectangle_ring(double width, double height, int nx, int ny, int order) {
  return polygon_ring(rectangle(width, height), {nx, ny, nx, ny}, order);
}

std::vector<Vec2> regular_polygon(int corners, double radius, double first_angle) {
  std::vector<Vec2> vertices;
  for (int i = 0; i < corners; ++i) {
    const double angle = first_angle + 2.0 * std::numbers::pi * i / corners;
    vertices.emplace_back(radius * std::cos(angle), radius * std::sin(angle));
  }
  return vertices;
}

element::Ring unsplit(element::Ring ring) {
  std::rotate(ring.elements.begin(), ring.elements.begin() + 1, ring.elements.end());
  return ring;
}

double visibility(const std::vector<Vec2>& vertices, const Vec2& centre) {
  double least = 1.0;
  for (std::size_t i = 0; i < vertices.size(); ++i) {
    const Vec2 a = vertices[i] - centre, b = vertices[(i + 1) % vertices.size()] - centre, edge = b - a;
    const double twice_area = cross(a, b);
    least = std::min({least, twice_area / (a.norm() * edge.norm()), twice_area / (b.norm() * edge.norm()),
                      a.dot(b) > 0.0 ? twice_area / (a.norm() * b.norm()) : 1.0});
  }
  return least;
}

std::vector<Vec2> random_star(std::mt19937& random, double size) {
  while (true) {
    const int corners = whole(random, 3, 12);
    std::vector<double> angles;
    for (int i = 0; i < corners; ++i) angles.push_back(uniform(random, 0.0, 2.0 * std::numbers::pi));
    std::sort(angles.begin(), angles.end());
    std::vector<Vec2> vertices;
    for (double angle : angles) {
      const double radius = uniform(random, 0.3, 1.0);
      vertices.emplace_back(radius * std::cos(angle), radius * std::sin(angle));
    }
    const Vec2 centre(uniform(random, -0.5, 0.5), uniform(random, -0.5, 0.5));
    if (visibility(vertices, centre) < 0.05) continue;
    for (Vec2& vertex : vertices) vertex = size * (vertex - centre);
    return vertices;
  }
}

element::Mat3 random_elasticity(std::mt19937& random) {
  model::Material material;
  material.young = std::pow(10.0, uniform(random, 0.0, 12.0));
  material.poisson = uniform(random, -0.5, 0.49);
  return element::elasticity_matrix(material, whole(random, 0, 1) == 0 ? model::Plane::stress : model::Plane::strain);
}

element::Mat3 elasticity(double young, double poisson, model::Plane plane) {
  model::Material material;
  material.young = young;
  material.poisson = poisson;
  return element::elasticity_matrix(material, plane);
}

double largest(const Matrix& A) { return A.size() > 0 ? A.cwiseAbs().maxCoeff() : 0.0; }

Vec2 traction_of(const element::Vec3& stress, const Vec2& n) {
  return {stress[0] * n.x() + stress[2] * n.y(), stress[2] * n.x() + stress[1] * n.y()};
}

}  // namespace scabo::test
