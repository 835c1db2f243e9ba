#include "scabo/linalg/nonnegative_least_squares.hpp"

#include <Eigen/QR>
#include <algorithm>
#include <cmath>
#include <vector>

namespace scabo::linalg {

Vector nonnegative_least_squares(const Matrix& A, const Vector& b) {
  const Eigen::Index n = A.cols();
  Vector x = Vector::Zero(n);
  if (n == 0 || A.rows() == 0) return x;
  std::vector<int> passive;  // the x that may be positive
  const double small = 1e-15 * A.colwise().norm().maxCoeff() * b.norm();  // rounding of the gradient
  for (Eigen::Index round = 0; round < 3 * n + 10; ++round) {
    Vector gradient = A.transpose() * (b - A * x);
    for (int j : passive) gradient[j] = -1.0;
    Eigen::Index best = 0;
    if (gradient.maxCoeff(&best) <= small) break;
    passive.push_back(static_cast<int>(best));
    while (!passive.empty()) {
      const Vector z = A(Eigen::all, passive).completeOrthogonalDecomposition().solve(b);
      double step = 1.0;
      for (std::size_t k = 0; k < passive.size(); ++k) {
        const double from = x[passive[k]], to = z[static_cast<Eigen::Index>(k)];
        if (to <= 0.0) step = std::min(step, from <= 0.0 ? 0.0 : from / (from - to));
      }
      std::vector<int> kept;
      for (std::size_t k = 0; k < passive.size(); ++k) {
        double& value = x[passive[k]];
        value += step * (z[static_cast<Eigen::Index>(k)] - value);
        if (step == 1.0 || value > 1e-15 * x.cwiseAbs().maxCoeff())
          kept.push_back(passive[k]);
        else
          value = 0.0;
      }
      if (step == 1.0) break;
      passive = std::move(kept);
    }
  }
  return x;
}

Vector nonnegative_least_squares_of_normal(const Matrix& G, const Vector& h,
                                           const std::function<Vector(const Vector& x)>& residual) {
  const Eigen::Index n = h.size();
  Vector x = Vector::Zero(n);
  if (n == 0) return x;
  const double small = 1e-10 * h.lpNorm<Eigen::Infinity>();
  std::vector<int> passive;
  std::vector<bool> dependent(static_cast<std::size_t>(n), false);  // on the passive ones
  Matrix L(0, 0);  // L L' = G of the passive ones, in the leading block
  const auto size = [&] { return static_cast<Eigen::Index>(passive.size()); };
  const auto append = [&](int j) {
    const Eigen::Index k = size();
    if (L.rows() == k) L.conservativeResize(2 * k + 16, 2 * k + 16);
    Vector row(k);
    for (Eigen::Index i = 0; i < k; ++i) row[i] = G(passive[static_cast<std::size_t>(i)], j);
    L.topLeftCorner(k, k).triangularView<Eigen::Lower>().solveInPlace(row);
    const double left = G(j, j) - row.squaredNorm();
    if (!(left > 1e-13 * G(j, j))) return false;
    L.row(k).head(k) = row.transpose();
    L(k, k) = std::sqrt(left);
    passive.push_back(j);
    return true;
  };
  const auto solved = [&](Vector right) {
    const auto lower = L.topLeftCorner(size(), size()).triangularView<Eigen::Lower>();
    lower.solveInPlace(right);
    lower.transpose().solveInPlace(right);
    return right;
  };
  const auto of_passive = [&](const Vector& v) { return Vector(v(passive)); };
  for (Eigen::Index round = 0; round < 3 * n + 10; ++round) {
    Vector gradient = h;
    for (const int j : passive) gradient -= x[j] * G.col(j);
    for (Eigen::Index j = 0; j < n; ++j)
      if (dependent[static_cast<std::size_t>(j)]) gradient[j] = -1.0;
    for (const int j : passive) gradient[j] = -1.0;
    Eigen::Index best = 0;
    if (gradient.maxCoeff(&best) <= small) break;
    if (!append(static_cast<int>(best))) {
      dependent[static_cast<std::size_t>(best)] = true;
      continue;
    }
    while (!passive.empty()) {
      const Vector z = solved(of_passive(h));
      double step = 1.0;
      for (Eigen::Index k = 0; k < size(); ++k) {
        const double from = x[passive[static_cast<std::size_t>(k)]], to = z[k];
        if (to <= 0.0) step = std::min(step, from <= 0.0 ? 0.0 : from / (from - to));
      }
      std::vector<int> kept;
      for (Eigen::Index k = 0; k < size(); ++k) {
        const int j = passive[static_cast<std::size_t>(k)];
        x[j] += step * (z[k] - x[j]);
        if (step == 1.0 || x[j] > 1e-15 * x.cwiseAbs().maxCoeff())
          kept.push_back(j);
        else
          x[j] = 0.0;
      }
      if (step == 1.0) break;
      passive.clear();
      for (const int j : kept)
        if (!append(j)) x[j] = 0.0;
      std::fill(dependent.begin(), dependent.end(), false);
    }
  }
  // G has the squared condition of A; therefore x is refined with A itself.
  for (int round = 0; round < 6 && !passive.empty(); ++round) {
    const Vector change = solved(of_passive(residual(x)));
    for (Eigen::Index k = 0; k < size(); ++k) {
      double& value = x[passive[static_cast<std::size_t>(k)]];
      value = std::max(value + change[k], 0.0);
    }
  }
  return x;
}

}  // namespace scabo::linalg
