#include "scabo/linalg/least_distance.hpp"

#include <Eigen/QR>
#include <algorithm>
#include <vector>

#include "scabo/linalg/nonnegative_least_squares.hpp"

namespace scabo::linalg {

Vector nearest_within(const Matrix& B, const Vector& h, const Vector& aim) {
  const double size = aim.norm(), allowed = 1e-13 * size;
  const auto inside = [&](const Vector& v) { return (B * v - h).minCoeff() >= -allowed; };
  if (size == 0.0 || B.rows() == 0 || inside(aim)) return aim;
  Matrix E(B.cols() + 1, B.rows());
  E << B.transpose(), ((h - B * aim) / size).transpose();
  const Vector multipliers = nonnegative_least_squares(E, Vector::Unit(E.rows(), E.rows() - 1));
  std::vector<Eigen::Index> active;
  for (Eigen::Index i = 0; i < multipliers.size(); ++i)
    if (multipliers[i] > 0.0) active.push_back(i);
  Vector v = aim;
  if (!active.empty()) {
    const Matrix held = B(active, Eigen::all);
    v += held.completeOrthogonalDecomposition().solve(h(active) - held * aim);
  }
  if (inside(v)) return v;
  double part = 1.0;
  const Vector ahead = B * v;
  for (Eigen::Index i = 0; i < h.size(); ++i)
    if (ahead[i] < h[i]) part = std::min(part, h[i] / ahead[i]);  // h <= 0
  return part * v;
}

}  // namespace scabo::linalg
