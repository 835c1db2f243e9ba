#include "scabo/element/plane_element8.hpp"

#include <Eigen/LU>

#include "scabo/element/line_basis.hpp"

namespace scabo::element {

const std::array<Vec2, 8> plane_element8_nodes = {Vec2(-1, -1), Vec2(1, -1), Vec2(1, 1), Vec2(-1, 1),
                                                  Vec2(0, -1),  Vec2(1, 0),  Vec2(0, 1), Vec2(-1, 0)};

namespace {

struct Shape {
  std::array<double, 8> N;
  std::array<Vec2, 8> gradient;  // in natural, then in real coordinates
  double jacobian = 0.0;
};

Shape shape_at(const Corners8& x, double r, double s) {
  Shape shape;
  for (std::size_t i = 0; i < 8; ++i) {
    const double ri = plane_element8_nodes[i].x(), si = plane_element8_nodes[i].y();
    if (i < 4) {
      shape.N[i] = 0.25 * (1 + r * ri) * (1 + s * si) * (r * ri + s * si - 1);
      shape.gradient[i] = {0.25 * ri * (1 + s * si) * (2 * r * ri + s * si),
                           0.25 * si * (1 + r * ri) * (r * ri + 2 * s * si)};
    } else if (ri == 0.0) {
      shape.N[i] = 0.5 * (1 - r * r) * (1 + s * si);
      shape.gradient[i] = {-r * (1 + s * si), 0.5 * si * (1 - r * r)};
    } else {
      shape.N[i] = 0.5 * (1 - s * s) * (1 + r * ri);
      shape.gradient[i] = {0.5 * ri * (1 - s * s), -s * (1 + r * ri)};
    }
  }
  Mat2 J = Mat2::Zero();  // J(a, b) = d x_a / d natural_b
  for (std::size_t i = 0; i < 8; ++i) J += x[i] * shape.gradient[i].transpose();
  shape.jacobian = J.determinant();
  ensure(shape.jacobian > 0.0, "a finite element is turned inside out");
  const Mat2 to_real = J.inverse().transpose();
  for (Vec2& gradient : shape.gradient) gradient = to_real * gradient;
  return shape;
}

Eigen::Matrix<double, 3, 16> strain_matrix(const Shape& shape) {
  Eigen::Matrix<double, 3, 16> B = Eigen::Matrix<double, 3, 16>::Zero();
  for (Eigen::Index i = 0; i < 8; ++i) {
    const Vec2& g = shape.gradient[static_cast<std::size_t>(i)];
    B(0, 2 * i) = B(2, 2 * i + 1) = g.x();
    B(1, 2 * i + 1) = B(2, 2 * i) = g.y();
  }
  return B;
}

/// Calls `visit(shape, weight)` at the 3 x 3 Gauss points; weights include the Jacobian.
template <typename Visit>
void integrate(const Corners8& x, Visit visit) {
  static const GaussRule rule = gauss_rule(3);
  for (std::size_t i = 0; i < 3; ++i)
    for (std::size_t j = 0; j < 3; ++j) {
      const Shape shape = shape_at(x, rule.points[i], rule.points[j]);
      visit(shape, rule.weights[i] * rule.weights[j] * shape.jacobian);
    }
}

}  // namespace

Matrix16 plane_element8_stiffness(const Corners8& x, const Mat3& D, double thickness) {
  Matrix16 K = Matrix16::Zero();
  integrate(x, [&](const Shape& shape, double weight) {
    const Eigen::Matrix<double, 3, 16> B = strain_matrix(shape);
    K.noalias() += B.transpose() * (D * (weight * thickness)) * B;
  });
  return 0.5 * (K + K.transpose());
}

Matrix8 plane_element8_mass(const Corners8& x, double density, double thickness) {
  Matrix8 M = Matrix8::Zero();
  integrate(x, [&](const Shape& shape, double weight) {
    const Eigen::Map<const Eigen::Matrix<double, 8, 1>> N(shape.N.data());
    M.noalias() += N * N.transpose() * (weight * density * thickness);
  });
  return M;
}

std::array<double, 8> plane_element8_areas(const Corners8& x) {
  std::array<double, 8> areas{};
  integrate(x, [&](const Shape& shape, double weight) {
    for (std::size_t i = 0; i < 8; ++i) areas[i] += shape.N[i] * weight;
  });
  return areas;
}

PointValues plane_element8_values(const Corners8& x, const Vector16& u, const Mat3& D, double r, double s) {
  const Shape shape = shape_at(x, r, s);
  PointValues point;
  for (std::size_t i = 0; i < 8; ++i) point.displacement += shape.N[i] * u.segment<2>(static_cast<Eigen::Index>(2 * i));
  point.strain = strain_matrix(shape) * u;
  point.stress = D * point.strain;
  return point;
}

std::array<int, 8> plane_element8_nodes_of(const mesh::Cell& cell) {
  ensure(cell.boundary.size() == 4, "an 8-node element has four sides");
  std::array<int, 8> nodes{};
  for (std::size_t side = 0; side < 4; ++side) {
    ensure(cell.boundary[side].nodes.size() == 3, "a side of an 8-node element has order 2");
    nodes[side] = cell.boundary[side].nodes[0];
    nodes[side + 4] = cell.boundary[side].nodes[1];
  }
  return nodes;
}

Corners8 corners8_of(const mesh::Cell& cell, const std::vector<Vec2>& nodes) {
  Corners8 x;
  const std::array<int, 8> numbers = plane_element8_nodes_of(cell);
  for (std::size_t i = 0; i < 8; ++i) x[i] = nodes[static_cast<std::size_t>(numbers[i])];
  return x;
}

}  // namespace scabo::element
