#include "scabo/mesh/lobatto.hpp"

#include <cmath>
#include <numbers>

#include "scabo/base/error.hpp"
#include "scabo/mesh/mesh.hpp"

namespace scabo::mesh {

namespace {

/// P_p(x) and P_{p-1}(x), by the three-term recurrence.
struct Legendre {
  double value;
  double previous;
};

Legendre legendre(int order, double x) {
  double previous = 1.0;
  double value = x;
  for (int k = 2; k <= order; ++k) {
    const double next = ((2 * k - 1) * x * value - (k - 1) * previous) / k;
    previous = value;
    value = next;
  }
  return {value, previous};
}

}  // namespace

std::vector<double> lobatto_points(int order) {
  ensure(order >= 1, "the order of a line element is at least 1");
  std::vector<double> points(order + 1, 0.0);
  points.front() = -1.0;
  points.back() = 1.0;
  // The upper half by Newton's method, the lower half by reflection: exactly symmetric. For an even order the middle
  // point remains exactly 0.
  for (int i = 1; 2 * i < order; ++i) {
    double x = std::cos(std::numbers::pi * i / order);  // Chebyshev points are close
    for (int iteration = 0; iteration < 100; ++iteration) {
      const Legendre p = legendre(order, x);
      // (1 - x^2) P_p' = p (P_{p-1} - x P_p), and its derivative is -p (p + 1) P_p.
      const double step = (p.previous - x * p.value) / ((order + 1) * p.value);
      x += step;
      if (std::abs(step) < 1e-16) break;
    }
    points[order - i] = x;
    points[i] = -x;
  }
  return points;
}

LobattoBasis::LobattoBasis(int order)
    : points(lobatto_points(order)), weights(order + 1), derivative(Matrix::Zero(order + 1, order + 1)) {
  std::vector<double> value(order + 1);  // P_p at the points
  for (int i = 0; i <= order; ++i) {
    value[i] = legendre(order, points[i]).value;
    weights[i] = 2.0 / (order * (order + 1) * value[i] * value[i]);
  }
  for (int i = 0; i <= order; ++i) {
    for (int j = 0; j <= order; ++j) {
      if (i != j) derivative(i, j) = value[i] / (value[j] * (points[i] - points[j]));
    }
  }
  derivative(0, 0) = -0.25 * order * (order + 1);
  derivative(order, order) = 0.25 * order * (order + 1);
}

Matrix LobattoBasis::shape_at(const std::vector<double>& at) const {
  Matrix shape = Matrix::Ones(at.size(), points.size());
  for (std::size_t k = 0; k < at.size(); ++k) {
    for (std::size_t j = 0; j < points.size(); ++j) {
      for (std::size_t m = 0; m < points.size(); ++m) {
        if (m != j) shape(k, j) *= (at[k] - points[m]) / (points[j] - points[m]);
      }
    }
  }
  return shape;
}

}  // namespace scabo::mesh
