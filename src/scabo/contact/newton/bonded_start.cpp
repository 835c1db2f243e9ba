#include "scabo/contact/newton/bonded_start.hpp"

#include <algorithm>

#include "scabo/contact/pair_operator.hpp"
#include "scabo/linalg/general_solver.hpp"
#include "scabo/linalg/sparse_general_solver.hpp"

namespace scabo::contact {

namespace {

constexpr double softness = 1e-3;  // eps
constexpr double least_condition = 1e-12;
constexpr double free_motion = 1e-6;  // delta
constexpr double balance = 1e-4;      // of forces, relative to the largest

/// `hold`: on the diagonal of the rows of balance.
std::optional<Vector> solve_sparse(const Problem& problem, const std::vector<int>& place, Eigen::Index size,
                                   const Vector& right, double hold) {
  const Eigen::SparseMatrix<double>&W = problem.W.sparse(), &G = problem.G.sparse();
  std::vector<Eigen::Triplet<double>> entries;
  entries.reserve(static_cast<std::size_t>(W.nonZeros() + 2 * G.nonZeros()));
  for (Eigen::Index column = 0; column < W.cols(); ++column) {
    const int j = place[static_cast<std::size_t>(column)];
    if (j < 0) continue;
    for (Eigen::SparseMatrix<double>::InnerIterator it(W, column); it; ++it)
      if (const int i = place[static_cast<std::size_t>(it.row())]; i >= 0)
        entries.emplace_back(i, j, i == j ? (1.0 + softness) * it.value() : it.value());
  }
  for (Eigen::Index k = 0; k < G.cols(); ++k)
    for (Eigen::SparseMatrix<double>::InnerIterator it(G, k); it; ++it)
      if (const int i = place[static_cast<std::size_t>(it.row())]; i >= 0) {
        entries.emplace_back(i, size + k, it.value());
        entries.emplace_back(size + k, i, it.value());
      }
  if (hold > 0.0)
    for (Eigen::Index k = size; k < right.size(); ++k) entries.emplace_back(k, k, -hold);
  Eigen::SparseMatrix<double> A(right.size(), right.size());
  A.setFromTriplets(entries.begin(), entries.end());
  entries = {};  // of large walls half a gigabyte
  linalg::SparseGeneralSolver solver;
  if (!solver.factorise(A) || !(solver.reciprocal_condition() > least_condition)) return std::nullopt;
  Vector x;
  solver.solve(right, x);
  return x;
}

std::optional<Vector> solve_dense(const Problem& problem, const std::vector<int>& rows, const Vector& right,
                                  double hold) {
  const Eigen::Index size = static_cast<Eigen::Index>(rows.size()), m = problem.G.cols();
  Matrix A = Matrix::Zero(size + m, size + m);
  A.topLeftCorner(size, size) = problem.W.factor() * problem.W.matrix()(rows, rows);
  A.diagonal().head(size) *= 1.0 + softness;
  A.topRightCorner(size, m) = problem.G.dense()(rows, Eigen::all);
  A.bottomLeftCorner(m, size) = A.topRightCorner(size, m).transpose();
  A.diagonal().tail(m).setConstant(-hold);
  linalg::GeneralSolver solver;
  if (!solver.factorise(A, size + m) || !(solver.reciprocal_condition() > least_condition)) return std::nullopt;
  Vector x = right;
  solver.solve_in_place(x);
  return x;
}

/// By joined bodies.
std::optional<Point> joined_start(const Problem& problem, const std::vector<bool>& touching) {
  const PairHolder* const holder = problem.W.holder();
  if (holder == nullptr) return std::nullopt;
  const Eigen::Index N = problem.pairs(), d = problem.dimension;
  const Vector diagonal = problem.W.diagonal();
  std::vector<int> rows;
  for (Eigen::Index k = 0; k < d * N; ++k)
    if ((touching.empty() || touching[static_cast<std::size_t>(k / d)]) && diagonal[k] > 0.0)
      rows.push_back(static_cast<int>(k));
  if (rows.empty()) return std::nullopt;
  const std::unique_ptr<HeldPairs> held = holder->hold(rows);
  if (!held) return std::nullopt;
  const double factor = problem.W.factor();
  Vector p, a;
  held->solve(-problem.q(rows) / factor, -problem.f, p, a);
  if (!p.allFinite() || !a.allFinite()) return std::nullopt;
  Point start{Vector::Zero(d * N), factor * a};
  start.p(rows) = p;
  return start;
}

}  // namespace

std::optional<Point> bonded_start(const Problem& problem, const std::vector<bool>& touching) {
  if (!problem.W.is_dense() && !problem.W.is_sparse()) return joined_start(problem, touching);
  const Eigen::Index N = problem.pairs(), d = problem.dimension, m = problem.G.cols();
  std::vector<int> rows, place(static_cast<std::size_t>(d * N), -1);
  const Vector diagonal = problem.W.diagonal();
  for (Eigen::Index i = 0; i < N; ++i)
    for (Eigen::Index k = d * i; k < d * (i + 1); ++k)
      if ((touching.empty() || touching[static_cast<std::size_t>(i)]) && diagonal[k] > 0.0) {
        place[static_cast<std::size_t>(k)] = static_cast<int>(rows.size());
        rows.push_back(static_cast<int>(k));
      }
  const auto size = static_cast<Eigen::Index>(rows.size());
  Vector right(size + m);
  right << -problem.q(rows), -problem.f;
  const auto solved = [&](double hold) {
    return problem.W.is_sparse() ? solve_sparse(problem, place, size, right, hold)
                                 : solve_dense(problem, rows, right, hold);
  };
  std::optional<Vector> x = solved(0.0);
  if (!x && m > 0) x = solved(free_motion);
  if (!x || !x->allFinite()) return std::nullopt;
  Point start{Vector::Zero(d * N), x->tail(m)};
  start.p(rows) = x->head(size);
  const double force = std::max(start.p.lpNorm<Eigen::Infinity>(), m > 0 ? problem.f.lpNorm<Eigen::Infinity>() : 0.0);
  if (m > 0 && !((problem.G.transpose() * start.p + problem.f).lpNorm<Eigen::Infinity>() <= balance * force))
    return std::nullopt;
  return start;
}

}  // namespace scabo::contact
