#include "scabo/element/plane/point_operator.hpp"

#include <algorithm>
#include <cmath>

#include "scabo/base/components.hpp"
#include "scabo/geometry/line_basis.hpp"
#include "scabo/linalg/decompositions.hpp"
#include "scabo/linalg/parallel.hpp"

namespace scabo::element {

namespace {

/// Exponents of rotation and uniform strain are 1 except for rounding.
constexpr double rounding = 1e-9;

double slowest_of(const linalg::SchurExponential& modes) {
  double slowest = 1.0;
  for (const std::complex<double>& value : modes.eigenvalues())
    if (value.real() < 1.0 - rounding) slowest = std::min(slowest, value.real() - std::abs(value.imag()));
  return std::max(slowest, 0.0);
}

/// Rows over all boundary displacements, n x (2 + 3 + 3): N, then B1 and B2 at a boundary point.
Matrix boundary_rows(const Ring& ring, const ScaledPoint& point) {
  const mesh::LineElement& element = ring.elements[static_cast<std::size_t>(point.element)];
  const geometry::LineBasis& basis = geometry::LineBasis::of_order(static_cast<int>(element.nodes.size()) - 1);
  const Vector N = basis.values(point.eta);
  const StrainMatrices strain = strain_matrices(ring, element, N, basis.derivatives(point.eta));
  Matrix rows = Matrix::Zero(places_of(ring.nodes.size()), 8);
  for (std::size_t i = 0; i < element.nodes.size(); ++i)
    for (Eigen::Index k = 0; k < 2; ++k) {
      const Eigen::Index to = place_of(element.nodes[i], k), from = place_of(i, k);
      rows(to, k) = N[static_cast<Eigen::Index>(i)];
      rows.block<1, 3>(to, 2) = strain.B1.col(from).transpose();
      rows.block<1, 3>(to, 5) = strain.B2.col(from).transpose();
    }
  return rows;
}

}  // namespace

PointCondensation::PointCondensation(const Ring& ring, const SuperElementSolution& solution)
    : ring_(ring), solution_(solution) {
  for (const Block& block : solution.blocks) {
    Adjoint adjoint;
    adjoint.modes = linalg::SchurExponential(Matrix(block.S.transpose()));
    adjoint.slowest = slowest_of(adjoint.modes);
    adjoint.A_over_S = block.S.transpose().partialPivLu().solve(Matrix(block.A.transpose())).transpose();
    adjoints_.push_back(std::move(adjoint));
  }
}

PointOperator PointCondensation::at(const ScaledPoint& point) const {
  const double xi = std::clamp(point.xi, 0.0, 1.0);
  const double s = std::log(std::max(xi, 1e-9));  // as in RadialField: nothing changes closer to the centre
  const Matrix rows = boundary_rows(ring_, point);
  const Eigen::Index n = rows.rows();
  Matrix condensed = Matrix::Zero(n, 5);
  for (std::size_t k = 0; k < adjoints_.size(); ++k) {
    const Block& block = solution_.blocks[k];
    const Adjoint& adjoint = adjoints_[k];
    const Matrix r = block.T.transpose() * rows;
    const Matrix r_v = block.on_v(r), r_a = block.on_a(r);
    const auto of = [](const Matrix& of_rows, Eigen::Index first, Eigen::Index count) {
      return of_rows.middleCols(first, count);
    };
    Matrix y(r_v.rows(), 5);  // eq. (2)
    y.leftCols(2) = xi * (of(r_v, 0, 2) + adjoint.A_over_S.transpose() * of(r_a, 0, 2));
    y.rightCols(3) = block.S.transpose() * of(r_v, 2, 3) + block.A.transpose() * of(r_a, 2, 3) + of(r_v, 5, 3) +
                     adjoint.A_over_S.transpose() * of(r_a, 5, 3);
    // X' = xi^(slowest - 1) e^((S' - slowest) s)
    const Matrix& U = adjoint.modes.U();
    const Matrix start = U.transpose() * y;
    Matrix moved(start.rows(), 5);
    for (Eigen::Index column = 0; column < 5; ++column)
      moved.col(column) = adjoint.modes.propagate(start.col(column), {}, s, adjoint.slowest);
    Matrix z = std::exp((adjoint.slowest - 1.0) * s) * (U * moved);
    z.leftCols(2) -= adjoint.A_over_S.transpose() * of(r_a, 0, 2);
    Matrix of_block = block.from_v(z);
    for (std::size_t j = 0; j < block.J.size(); ++j)
      of_block.row(block.J[j]).leftCols(2) += r_a.row(static_cast<Eigen::Index>(j)).leftCols(2);
    condensed += block.T * of_block;
  }
  return {condensed.leftCols(2).transpose(), condensed.rightCols(3).transpose()};
}

std::vector<PointOperator> PointCondensation::at(const std::vector<ScaledPoint>& points, int threads) const {
  std::vector<PointOperator> operators(points.size());
  const int parts = std::max(1, std::min(threads, static_cast<int>(points.size())));
  linalg::parallel_for(parts, threads, [&](int part) {
    for (std::size_t i = static_cast<std::size_t>(part); i < points.size(); i += static_cast<std::size_t>(parts))
      operators[i] = at(points[i]);
  });
  return operators;
}

}  // namespace scabo::element
