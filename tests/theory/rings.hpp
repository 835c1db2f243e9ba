// Boundaries of super-elements for tests, made without the mesh generator.
#pragma once

#include <algorithm>
#include <cmath>
#include <numbers>
#include <vector>

#include "scabo/element/facet/radial_load.hpp"
#include "support/random.hpp"

namespace scabo::test {

/// A closed polygon, counter-clockwise, as the scaling centre at the origin sees it. Edge i (from vertex i)
/// is divided into divisions[i] elements of one order.
element::Ring polygon_ring(const std::vector<Vec2>& vertices, const std::vector<int>& divisions, int order);

element::Ring polygon_ring(const std::vector<Vec2>& vertices, int divisions, int order);

std::vector<element::RadialLoad> uniform_body_force(const element::Ring& ring, const Vec2& b, double thickness);

std::vector<Vec2> rectangle(double width, double height);

/// A rectangle with nx and ny elements along its sides.
element::Ring rectangle_ring(double width, double height, int nx, int ny, int order);

std::vector<Vec2> regular_polygon(int corners, double radius, double first_angle);

/// The same boundary and node numbers, its elements listed from another one on: the symmetries of such a ring
/// are not looked for.
element::Ring unsplit(element::Ring ring);

/// The angle at which the scaling centre sees the closest call of |J| > 0: smallest sine between an edge and
/// the ray to its end, and between the rays to its ends.
double visibility(const std::vector<Vec2>& vertices, const Vec2& centre);

/// A random star-shaped polygon of 3 to 12 corners relative to a random centre that sees its whole boundary
/// by at least about three degrees.
std::vector<Vec2> random_star(std::mt19937& random, double size = 1.0);

/// Elasticity of a random material, plane stress or strain.
element::Mat3 random_elasticity(std::mt19937& random);

element::Mat3 elasticity(double young, double poisson, model::Plane plane = model::Plane::stress);

/// Values of a displacement field at the nodes, two per node.
template <typename Field>
Vector at_nodes(const std::vector<Vec2>& nodes, Field field) {
  Vector u(static_cast<Eigen::Index>(2 * nodes.size()));
  for (std::size_t i = 0; i < nodes.size(); ++i) u.segment<2>(static_cast<Eigen::Index>(2 * i)) = field(nodes[i]);
  return u;
}

double largest(const Matrix& A);

/// [xx, yy, xy] as the traction on a plane of unit normal n.
Vec2 traction_of(const element::Vec3& stress, const Vec2& n);

}  // namespace scabo::test
