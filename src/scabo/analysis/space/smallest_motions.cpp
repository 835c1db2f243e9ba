#include "scabo/analysis/space/smallest_motions.hpp"

#include <algorithm>

#include "scabo/analysis/diagnostics/undetermined_motions.hpp"
#include "scabo/linalg/decompositions.hpp"
#include "scabo/linalg/least_distance.hpp"
#include "scabo/system/solid_part.hpp"

namespace scabo::analysis {

namespace {

Matrix rows_of(const std::vector<Vector>& rows, Eigen::Index columns) {
  Matrix matrix(static_cast<Eigen::Index>(rows.size()), columns);
  for (std::size_t k = 0; k < rows.size(); ++k) matrix.row(static_cast<Eigen::Index>(k)) = rows[k];
  return matrix;
}

/// Conditions on y: B y >= h.
struct Conditions {
  std::vector<Vector> within;  // rows of B
  std::vector<double> least;   // h

  void keep(const Vector& row, double room) {
    constexpr double rounding = 1e-9;
    if (row.norm() <= rounding) return;
    within.push_back(row);
    least.push_back(-std::max(room, 0.0));
  }
};
Conditions conditions_of(const contact::Problem& problem, const contact::Solution& solution, const Matrix& U) {
  const Matrix moved = problem.G.sparse() * U;
  Conditions conditions;
  for (Eigen::Index i = 0; i < problem.pairs(); ++i) {
    const contact::ContactState state = solution.states[static_cast<std::size_t>(i)];
    if (state == contact::ContactState::open) conditions.keep(moved.row(3 * i), solution.gap[i]);
    const Eigen::Vector2d friction = solution.p.segment<2>(3 * i + 1);
    if (state != contact::ContactState::slip || friction.isZero(0.0)) continue;
    const Eigen::Vector2d along = -friction.normalized();
    conditions.keep(moved.middleRows<2>(3 * i + 1).transpose() * along,
                    along.dot(solution.slip_increment.segment<2>(2 * i)));
  }
  return conditions;
}

/// The sum of squares as y'A y + 2 b'y + a constant.
struct Squares {
  Matrix A;
  Vector b;
};
Squares squares_of(const MovingSolids& solids, const std::vector<Vector>& moved, const Matrix& U) {
  Squares squares{Matrix::Zero(U.cols(), U.cols()), Vector::Zero(U.cols())};
  double volume = 0.0;
  for (std::size_t b = 0; b < moved.size(); ++b) {
    const Matrix rigid = solids.rigid_motions(b);
    if (rigid.cols() == 0) continue;
    const Matrix R = rigid * U.middleRows(solids.contact.first_rigid[b], rigid.cols());
    const Vector weights = system::volume_of(solids.model.bodies[b].mesh).weights;
    const Matrix weighted = weights.replicate(1, 3).transpose().reshaped().asDiagonal() * R;
    squares.A += R.transpose() * weighted;
    squares.b += weighted.transpose() * moved[b];
    volume += weights.sum();
  }
  squares.A /= volume;
  squares.b /= volume;
  return squares;
}

}  // namespace

std::optional<Vector> smallest_motions(const MovingSolids& solids, const contact::Problem& problem,
                                       const contact::Solution& solution, const std::vector<Vector>& moved) {
  const Matrix& U = solution.undetermined;
  if (U.cols() == 0 || U.cols() > most_undetermined) return std::nullopt;
  const Conditions conditions = conditions_of(problem, solution, U);
  const Matrix within = rows_of(conditions.within, U.cols());
  const Squares squares = squares_of(solids, moved, U);
  const Eigen::LLT<Matrix> factor(squares.A);
  if (factor.info() != Eigen::Success) return std::nullopt;
  // z = L'y: the sum is |z + L^-1 b|^2.
  const Matrix B = factor.matrixL().solve(within.transpose()).transpose();
  const Vector least = Eigen::Map<const Vector>(conditions.least.data(), within.rows());
  const Vector z = linalg::nearest_within(B, least, -factor.matrixL().solve(squares.b));
  return Vector(solution.a + U * factor.matrixU().solve(z));
}

}  // namespace scabo::analysis
