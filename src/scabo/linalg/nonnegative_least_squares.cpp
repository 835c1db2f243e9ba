#include "scabo/linalg/nonnegative_least_squares.hpp"

#include <Eigen/QR>
#include <vector>

namespace scabo::linalg {

Vector nonnegative_least_squares(const Matrix& A, const Vector& b) {
  const Eigen::Index n = A.cols();
  Vector x = Vector::Zero(n);
  if (n == 0 || A.rows() == 0) return x;
  std::vector<int> passive;  // the x that may be positive
  const double small = 1e-13 * A.colwise().norm().maxCoeff() * b.norm();
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

}  // namespace scabo::linalg
