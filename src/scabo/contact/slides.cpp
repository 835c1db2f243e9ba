#include "scabo/contact/slides.hpp"

#include <Eigen/LU>
#include <Eigen/QR>
#include <cmath>
#include <vector>

#include "scabo/contact/rigid_motions.hpp"

namespace scabo::contact {

namespace {

using Index = Eigen::Index;

constexpr double no_slip = 1e-9;  // of all slips

bool may_slide(const Problem& problem) {
  return problem.dimension == 2 && problem.pairs() > 0 && problem.G.cols() > 0 && problem.W.is_dense() &&
         problem.cohesion.size() == 0 && problem.tension.size() == 0 && !has_many_motions(problem) &&
         problem.mu.minCoeff() <= little_friction && (problem.mu.maxCoeff() > 0.0 || problem.mu_backward.size() > 0);
}

/// The largest coefficient of the pairs that slide by `slips` (N).
double friction_along(const Problem& problem, const Vector& slips) {
  double largest = 0.0;
  const double small = no_slip * slips.norm();
  for (Index i = 0; i < slips.size(); ++i)
    if (std::abs(slips[i]) > small) largest = std::max(largest, problem.largest_mu(i));
  return largest;
}

Vector slips_of(const Matrix& G, Index column) { return G.col(column)(Eigen::seqN(1, G.rows() / 2, 2)); }

}  // namespace

std::optional<SlidesApart> slides_apart(const Problem& problem) {
  if (!may_slide(problem)) return std::nullopt;
  const auto pairs = static_cast<std::size_t>(problem.pairs());
  const Matrix all = undetermined_motions(problem, std::vector<ContactState>(pairs, ContactState::slip));
  if (all.cols() == 0) return std::nullopt;

  // Of two rollers on each other, each slide moves pairs of one contact: one pair by 1 that the others leave at rest.
  const Matrix slips = (problem.G.dense() * all)(Eigen::seqN(1, problem.pairs(), 2), Eigen::all);
  const Eigen::ColPivHouseholderQR<Matrix> chosen(Matrix(slips.transpose()));
  if (chosen.rank() < all.cols()) return std::nullopt;  // a motion that nothing resists
  const Matrix at_chosen = slips(chosen.colsPermutation().indices().head(all.cols()), Eigen::all);
  const Matrix slides = all * at_chosen.partialPivLu().inverse(), moved = problem.G.dense() * slides;

  const Index m = problem.G.cols();
  Matrix basis(m, m);
  Index count = 0;
  for (Index k = 0; k < slides.cols(); ++k)
    if (const double mu = friction_along(problem, slips_of(moved, k)); mu > 0.0 && mu <= little_friction)
      basis.col(count++) = slides.col(k) / std::sqrt(mu);
  if (count == 0) return std::nullopt;
  const Matrix orthonormal =
      Eigen::HouseholderQR<Matrix>(basis.leftCols(count)).householderQ() * Matrix::Identity(m, m);
  basis.rightCols(m - count) = orthonormal.rightCols(m - count);

  SlidesApart apart{problem, basis};
  apart.problem.W = problem.W.with_holder(nullptr);  // it knows the motions as they were
  Matrix G = problem.G.dense() * basis;
  G.leftCols(count)(Eigen::seqN(0, problem.pairs(), 2), Eigen::all).setZero();
  apart.problem.G = RigidMap(G);
  apart.problem.f = basis.transpose() * problem.f;
  return apart;
}

bool has_slides(const Problem& problem) {
  if (!may_slide(problem)) return false;
  const Matrix& G = problem.G.dense();
  for (Index k = 0; k < G.cols(); ++k) {
    if (!G.col(k)(Eigen::seqN(0, problem.pairs(), 2)).isZero(0.0)) continue;
    if (const double mu = friction_along(problem, slips_of(G, k)); mu > 0.0 && mu <= little_friction) return true;
  }
  return false;
}

}  // namespace scabo::contact
