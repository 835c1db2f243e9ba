#include "scabo/linalg/least_distance.hpp"

#include <algorithm>
#include <cmath>
#include <vector>

#include "scabo/linalg/decompositions.hpp"
#include "scabo/linalg/nonnegative_least_squares.hpp"

namespace scabo::linalg {

namespace {

using Index = Eigen::Index;

/// The point nearest to `aim` on the planes of some conditions, and its multipliers, v - aim = B' m.
struct OnPlanes {
  Vector v, multipliers;
};
OnPlanes on_planes(const Matrix& B, const Vector& h, const Vector& aim, const std::vector<Index>& active) {
  if (active.empty()) return {aim, Vector()};
  const Matrix held = B(active, Eigen::all);
  const Vector change = held.completeOrthogonalDecomposition().solve(h(active) - held * aim);
  return {aim + change, Matrix(held.transpose()).completeOrthogonalDecomposition().solve(change)};
}

/// Multipliers that rounding has left out of the active conditions, or in them, put right one after the other.
Vector refined(const Matrix& B, const Vector& h, const Vector& aim, std::vector<Index> active, double allowed) {
  OnPlanes at = on_planes(B, h, aim, active);
  Vector best = at.v;
  double best_room = -HUGE_VAL;
  for (Index round = 0; round < 2 * B.rows(); ++round) {
    Index worst = 0, last = 0;
    const double room = (B * at.v - h).minCoeff(&worst);
    const double least = at.multipliers.size() > 0 ? at.multipliers.minCoeff(&last) : 0.0;
    if (least < -allowed) {
      active.erase(active.begin() + last);
    } else {
      if (room > best_room) best_room = room, best = at.v;
      if (room >= -allowed || std::find(active.begin(), active.end(), worst) != active.end()) break;
      active.push_back(worst);
    }
    at = on_planes(B, h, aim, active);
  }
  return best;
}

}  // namespace

Vector nearest_within(const Matrix& B, const Vector& h, const Vector& aim) {
  if (B.rows() == 0) return aim;
  const Vector beyond = h - B * aim;
  if (beyond.maxCoeff() <= 0.0) return aim;
  // Of what is far within, h says nothing.
  const double allowed = 1e-13 * std::max(aim.norm(), beyond.maxCoeff());
  Matrix E(B.cols() + 1, B.rows());
  E << B.transpose(), (beyond / beyond.maxCoeff()).transpose();
  const Vector multipliers = nonnegative_least_squares(E, Vector::Unit(E.rows(), E.rows() - 1));
  std::vector<Index> active;
  for (Index i = 0; i < multipliers.size(); ++i)
    if (multipliers[i] > 0.0) active.push_back(i);
  return refined(B, h, aim, std::move(active), allowed);
}

}  // namespace scabo::linalg
