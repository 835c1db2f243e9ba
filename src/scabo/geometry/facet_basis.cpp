#include "scabo/geometry/facet_basis.hpp"

#include <algorithm>
#include <cmath>

#include "scabo/base/error.hpp"
#include "scabo/geometry/line_basis.hpp"

namespace scabo::geometry {

namespace {

/// Corners of a quadrilateral, then the middles of its edges.
constexpr std::array<std::array<double, 2>, 8> places_on_square{
    {{-1, -1}, {1, -1}, {1, 1}, {-1, 1}, {0, -1}, {1, 0}, {0, 1}, {-1, 0}}};

FacetRule square_rule(int count) {
  const GaussRule line = gauss_rule(count);
  FacetRule rule{Matrix(2, count * count), Vector(count * count)};
  Eigen::Index at = 0;
  for (std::size_t i = 0; i < line.points.size(); ++i)
    for (std::size_t j = 0; j < line.points.size(); ++j, ++at) {
      rule.places.col(at) << line.points[i], line.points[j];
      rule.weights[at] = line.weights[i] * line.weights[j];
    }
  return rule;
}

Vector barycentric(const Vec2& at) { return (Vector(3) << 1.0 - at.x() - at.y(), at.x(), at.y()).finished(); }

/// The bilinear function of a corner, and its derivatives.
struct Bilinear {
  double value, by_eta, by_zeta;
};
Bilinear bilinear(const std::array<double, 2>& corner, const Vec2& at) {
  const double a = 1.0 + corner[0] * at.x(), b = 1.0 + corner[1] * at.y();
  return {0.25 * a * b, 0.25 * corner[0] * b, 0.25 * a * corner[1]};
}

/// The function of the middle of an edge.
Bilinear of_middle(const std::array<double, 2>& middle, const Vec2& at) {
  const bool along_eta = middle[0] == 0.0;
  const double t = along_eta ? at.x() : at.y(), sign = along_eta ? middle[1] : middle[0],
               across = 1.0 + sign * (along_eta ? at.y() : at.x());
  const double value = 0.5 * (1.0 - t * t) * across, by_t = -t * across, by_across = 0.5 * (1.0 - t * t) * sign;
  return along_eta ? Bilinear{value, by_t, by_across} : Bilinear{value, by_across, by_t};
}

/// Values in the first column, derivatives in the others.
Matrix of_square(int nodes, const Vec2& at) {
  Matrix all(nodes, 3);
  for (int i = 0; i < nodes; ++i) {
    const auto& place = places_on_square[static_cast<std::size_t>(i)];
    const Bilinear N = i < 4 ? bilinear(place, at) : of_middle(place, at);
    all.row(i) << N.value, N.by_eta, N.by_zeta;
  }
  for (int i = 4; i < nodes; ++i)
    for (const int corner : {i - 4, (i - 3) % 4}) all.row(corner) -= 0.5 * all.row(i);
  return all;
}

}  // namespace

FacetRule triangle_rule(int count) {
  FacetRule rule = square_rule(count);
  for (Eigen::Index i = 0; i < rule.weights.size(); ++i) {
    const double u = 0.5 * (1.0 + rule.places(0, i)), v = 0.5 * (1.0 + rule.places(1, i));
    rule.places.col(i) << u, v * (1.0 - u);
    rule.weights[i] *= 0.25 * (1.0 - u);
  }
  return rule;
}

FacetBasis::FacetBasis(int nodes) : nodes_(nodes), corners_(nodes % 4 == 0 ? 4 : 3), places_(2, nodes) {
  constexpr int fine = 4, finest = 8;
  if (corners_ == 4) {
    for (int i = 0; i < nodes; ++i)
      places_.col(i) << places_on_square[static_cast<std::size_t>(i)][0],
          places_on_square[static_cast<std::size_t>(i)][1];
    rule_ = finer_ = square_rule(fine);
    finest_ = square_rule(finest);
    return;
  }
  const SimplexRule& simplex = SimplexBasis::of(2, nodes).rule();
  rule_ = {simplex.points.bottomRows(2), 0.5 * simplex.weights};
  finer_ = triangle_rule(fine);
  finest_ = triangle_rule(finest);
  places_.leftCols(3) << 0.0, 1.0, 0.0, 0.0, 0.0, 1.0;
  for (int i = 3; i < nodes; ++i) places_.col(i) = 0.5 * (places_.col(i - 3) + places_.col((i - 2) % 3));
}

const FacetBasis& FacetBasis::of(int nodes) {
  static const FacetBasis triangle3(3), triangle6(6), square4(4), square8(8);
  for (const FacetBasis* basis : {&triangle3, &triangle6, &square4, &square8})
    if (basis->nodes() == nodes) return *basis;
  throw BrokenInvariant("no facet has that many nodes");
}

double FacetBasis::inside(const Vec2& at) const {
  if (corners_ == 3) return barycentric(at).minCoeff();
  return 0.5 * (1.0 - at.lpNorm<Eigen::Infinity>());
}

Vector FacetBasis::values(const Vec2& at) const {
  return corners_ == 4 ? Vector(of_square(nodes_, at).col(0)) : SimplexBasis::of(2, nodes_).values(barycentric(at));
}

Matrix FacetBasis::derivatives(const Vec2& at) const {
  return corners_ == 4 ? Matrix(of_square(nodes_, at).rightCols(2))
                       : SimplexBasis::of(2, nodes_).derivatives(barycentric(at));
}

}  // namespace scabo::geometry
