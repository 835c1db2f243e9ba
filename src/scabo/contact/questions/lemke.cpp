#include "scabo/contact/questions/lemke.hpp"

#include <algorithm>
#include <cmath>
#include <vector>

namespace scabo::contact {

namespace {

/// p_t = plus b+ - minus b-, b+ + b- <= bound p_n.
struct Sides {
  double plus = 1.0, minus = 1.0, bound = 0.0;
};
Sides sides_of(const Problem& problem, Eigen::Index i) {
  if (problem.mu_backward.size() == 0) return {1.0, 1.0, problem.mu[i]};
  return {problem.mu_against(i, 1.0), problem.mu_against(i, -1.0), 1.0};
}

/// w - M z - 1 z0 = q / unit as a tableau; columns: w (n), z (n), z0, right-hand side.
Matrix make_tableau(const Problem& problem, double unit) {
  const Eigen::Index N = problem.pairs(), n = 4 * N;
  Matrix M = Matrix::Zero(n, n);
  Vector q = Vector::Zero(n);
  for (Eigen::Index i = 0; i < N; ++i) {
    for (Eigen::Index j = 0; j < N; ++j) {
      const auto W = problem.W.dense().block<2, 2>(2 * i, 2 * j);
      M(i, j) = W(0, 0);
      const Sides to = sides_of(problem, i), from = sides_of(problem, j);
      M(i, N + j) = W(0, 1) * from.plus, M(i, 2 * N + j) = -W(0, 1) * from.minus;
      M(N + i, j) = to.plus * W(1, 0), M(2 * N + i, j) = -to.minus * W(1, 0);
      M(N + i, N + j) = to.plus * W(1, 1) * from.plus, M(N + i, 2 * N + j) = -to.plus * W(1, 1) * from.minus;
      M(2 * N + i, N + j) = -to.minus * W(1, 1) * from.plus;
      M(2 * N + i, 2 * N + j) = to.minus * W(1, 1) * from.minus;
    }
    M(N + i, 3 * N + i) = M(2 * N + i, 3 * N + i) = 1.0;
    const Sides sides = sides_of(problem, i);
    M(3 * N + i, i) = sides.bound;
    M(3 * N + i, N + i) = M(3 * N + i, 2 * N + i) = -1.0;
    q[i] = problem.q[2 * i];
    q[N + i] = sides.plus * problem.q[2 * i + 1], q[2 * N + i] = -sides.minus * problem.q[2 * i + 1];
  }
  Matrix tableau(n, 2 * n + 2);
  tableau.leftCols(n).setIdentity();
  tableau.middleCols(n, n) = -M;
  tableau.col(2 * n).setConstant(-1.0);
  tableau.col(2 * n + 1) = q / unit;
  return tableau;
}

void pivot(Matrix& tableau, Eigen::Index row, Eigen::Index column) {
  tableau.row(row) /= tableau(row, column);
  const Vector factors = tableau.col(column);
  const Eigen::RowVectorXd pivot_row = tableau.row(row);
  for (Eigen::Index c = 0; c < tableau.cols(); ++c) {
    if (pivot_row[c] == 0.0) continue;
    tableau.col(c).noalias() -= factors * pivot_row[c];
    tableau(row, c) = pivot_row[c];
  }
}

/// Keeps those of `rows` whose `value` is the smallest, within rounding.
template <typename Value>
void keep_smallest(std::vector<Eigen::Index>& rows, Value value) {
  double least = HUGE_VAL;
  for (Eigen::Index i : rows) least = std::min(least, value(i));
  std::erase_if(rows, [&](Eigen::Index i) { return value(i) > least + 1e-12 * (1.0 + std::abs(least)); });
}

/// The row with the smallest ratio of right-hand side and pivot; -1 on a ray. Many friction rows are tied because their
/// right-hand sides are 0; ties are broken by the order of whole rows, which prevents cycling (lexicographic rule).
Eigen::Index leaving_row(const Matrix& tableau, const std::vector<Eigen::Index>& basis, Eigen::Index entering) {
  const Eigen::Index n = tableau.rows(), z0 = 2 * n, right = 2 * n + 1;
  const double largest = tableau.col(entering).cwiseAbs().maxCoeff();
  std::vector<Eigen::Index> rows;
  for (Eigen::Index i = 0; i < n; ++i)
    if (tableau(i, entering) > 1e-11 * largest) rows.push_back(i);
  if (rows.empty()) return -1;
  keep_smallest(rows, [&](Eigen::Index i) { return std::max(tableau(i, right), 0.0) / tableau(i, entering); });
  for (Eigen::Index i : rows)
    if (basis[static_cast<std::size_t>(i)] == z0) return i;  // z0 leaves as soon as possible: solved
  for (Eigen::Index column = 0; column < n && rows.size() > 1; ++column)
    keep_smallest(rows, [&](Eigen::Index i) { return tableau(i, column) / tableau(i, entering); });
  return rows.front();
}

}  // namespace

std::optional<Vector> lemke(const Problem& problem) {
  const Eigen::Index N = problem.pairs(), n = 4 * N;
  if (N == 0) return Vector();
  // Ties are detected relative to 1: q is scaled by a power of two to this size, so that units do not matter.
  const double largest = problem.q.lpNorm<Eigen::Infinity>();
  const double unit = largest > 0.0 && std::isfinite(largest) ? std::ldexp(1.0, std::ilogb(largest)) : 1.0;
  Matrix tableau = make_tableau(problem, unit);
  const Eigen::Index z0 = 2 * n, right = 2 * n + 1;
  std::vector<Eigen::Index> basis(static_cast<std::size_t>(n));
  for (Eigen::Index i = 0; i < n; ++i) basis[static_cast<std::size_t>(i)] = i;
  Eigen::Index row = 0;
  if (tableau.col(right).minCoeff(&row) < 0.0) {
    Eigen::Index entering = z0;
    for (Eigen::Index step = 0; step < 20 * n; ++step) {
      pivot(tableau, row, entering);
      const Eigen::Index leaving = basis[static_cast<std::size_t>(row)];
      basis[static_cast<std::size_t>(row)] = entering;
      if (leaving == z0) break;
      entering = leaving < n ? leaving + n : leaving - n;  // the complement enters
      row = leaving_row(tableau, basis, entering);
      if (row < 0) return std::nullopt;  // a ray
    }
  }
  Vector z = Vector::Zero(n);
  for (Eigen::Index i = 0; i < n; ++i) {
    const Eigen::Index variable = basis[static_cast<std::size_t>(i)];
    if (variable >= n && variable < z0) z[variable - n] = std::max(tableau(i, right), 0.0);
  }
  Vector p(2 * N);
  for (Eigen::Index i = 0; i < N; ++i) {
    p[2 * i] = unit * z[i];
    const Sides sides = sides_of(problem, i);
    p[2 * i + 1] = unit * (sides.plus * z[N + i] - sides.minus * z[2 * N + i]);
  }
  return p;
}

}  // namespace scabo::contact
