#include "scabo/contact/neutral_motions.hpp"

#include <algorithm>
#include <cmath>
#include <vector>

#include "scabo/contact/constants.hpp"
#include "scabo/contact/questions/rigid_motions.hpp"
#include "scabo/linalg/decompositions.hpp"

namespace scabo::contact {

namespace {

/// The state in which a pair resists most.
std::vector<ContactState> strongest_states(const Problem& problem) {
  std::vector<ContactState> states;
  for (Eigen::Index i = 0; i < problem.pairs(); ++i) {
    const bool resists = problem.largest_mu(i) > neutral_constants.no_friction || problem.cohesion_of(i) > 0.0 ||
                         (problem.tension_of(i) > 0.0 && std::isfinite(problem.tension_of(i)));
    states.push_back(resists ? ContactState::stick : ContactState::slip);
  }
  return states;
}

/// What costs next to nothing tells nearly always that there are none.
bool all_are_felt(const Problem& problem, const std::vector<ContactState>& states) {
  if (has_many_motions(problem)) return false;
  std::vector<int> rows;
  for (int i = 0; i < problem.pairs(); ++i)
    for (int k = 0; k < (states[static_cast<std::size_t>(i)] == ContactState::stick ? problem.dimension : 1); ++k)
      rows.push_back(problem.dimension * i + k);
  const Matrix felt = problem.G.dense()(rows, Eigen::all);
  const Vector values =
      Eigen::SelfAdjointEigenSolver<Matrix>(felt.transpose() * felt, Eigen::EigenvaluesOnly).eigenvalues();
  return values[0] > neutral_constants.surely_felt * values[values.size() - 1];
}

/// Columns of a sparse map.
RigidMap columns_of(const RigidMap& G, const std::vector<int>& kept) {
  RigidMap::Sparse left(G.rows(), static_cast<Eigen::Index>(kept.size()));
  left.reserve(G.sparse().nonZeros());
  for (Eigen::Index k = 0; k < left.cols(); ++k) {
    left.startVec(k);
    for (RigidMap::Sparse::InnerIterator at(G.sparse(), kept[static_cast<std::size_t>(k)]); at; ++at)
      left.insertBack(at.row(), k) = at.value();
  }
  left.finalize();
  return RigidMap(std::move(left));
}

}  // namespace

Start WithoutNeutral::start(const Start& given) const {
  Start left = given;
  if (given.a.size() != neutral.rows()) return left;
  const Matrix of_held = neutral(held, Eigen::all);
  const Vector shifted = given.a - neutral * of_held.colPivHouseholderQr().solve(Vector(given.a(held)));
  left.a = shifted(kept);
  return left;
}

Vector WithoutNeutral::motions(const Vector& a_left, const Vector& a_start) const {
  Vector a = Vector::Zero(neutral.rows());
  a(kept) = a_left;
  return a + neutral * (neutral.transpose() * (a_start - a));
}

std::optional<WithoutNeutral> without_neutral(const Problem& problem, double force_scale) {
  const Eigen::Index m = problem.G.cols();
  if (m == 0 || problem.pairs() == 0 || !(problem.W.is_dense() || problem.W.is_sparse())) return std::nullopt;
  const std::vector<ContactState> states = strongest_states(problem);
  if (all_are_felt(problem, states)) return std::nullopt;
  const Matrix neutral = undetermined_motions(problem, states);
  const Eigen::Index count = neutral.cols();
  if (count == 0) return std::nullopt;
  const Vector driven = neutral.transpose() * problem.f;
  if (driven.norm() > neutral_constants.balanced * std::max(problem.f.norm(), force_scale)) return std::nullopt;

  // The motions that fix the neutral ones: the pivots of their rows.
  const Eigen::ColPivHouseholderQR<Matrix> pivots(Matrix(neutral.transpose()));
  std::vector<bool> is_held(static_cast<std::size_t>(m), false);
  for (Eigen::Index k = 0; k < count; ++k)
    is_held[static_cast<std::size_t>(pivots.colsPermutation().indices()[k])] = true;
  WithoutNeutral left{problem, neutral, {}, {}};
  for (int k = 0; k < m; ++k) (is_held[static_cast<std::size_t>(k)] ? left.held : left.kept).push_back(k);
  left.problem.W = problem.W.with_holder(nullptr);  // it knows the motions of the whole problem
  left.problem.G = columns_of(problem.G, left.kept);
  left.problem.f = problem.f(left.kept);
  return left;
}

}  // namespace scabo::contact
