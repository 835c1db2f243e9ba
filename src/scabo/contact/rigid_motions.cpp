#include "scabo/contact/rigid_motions.hpp"

#include <Eigen/SVD>

#include "scabo/linalg/nonnegative_least_squares.hpp"

namespace scabo::contact {

namespace {

/// The proof moves up the friction cones while it slides; the slide that changes no gap says the same more plainly. It is
/// taken where the proof is mostly that.
Vector slide_of(const Problem& problem, const Vector& motion) {
  if (problem.pairs() == 0) return motion;
  Matrix normals(problem.pairs(), motion.size());
  for (Eigen::Index i = 0; i < problem.pairs(); ++i) normals.row(i) = problem.G.row(2 * i);
  const Eigen::JacobiSVD<Matrix> svd(normals, Eigen::ComputeFullV);
  Eigen::Index rank = 0;
  for (Eigen::Index k = 0; k < svd.singularValues().size(); ++k)
    if (svd.singularValues()[k] > 1e-10 * svd.singularValues()[0]) ++rank;
  const Matrix slides = svd.matrixV().rightCols(motion.size() - rank);
  const Vector slide = slides * (slides.transpose() * motion);
  return slide.norm() > 0.7 ? Vector(slide.normalized()) : motion;
}

}  // namespace

std::optional<Vector> find_mechanism(const Problem& problem) {
  const Eigen::Index m = problem.G.cols(), N = problem.pairs();
  if (m == 0 || problem.f.isZero(0.0)) return std::nullopt;
  // Extreme rays of the friction cones: n + mu t and n - mu t.
  Matrix rays(m, 2 * N);
  for (Eigen::Index i = 0; i < N; ++i) {
    const Vector n = problem.G.row(2 * i).transpose(), t = problem.G.row(2 * i + 1).transpose();
    rays.col(2 * i) = n + problem.mu[i] * t;
    rays.col(2 * i + 1) = n - problem.mu[i] * t;
  }
  const Vector strengths = linalg::nonnegative_least_squares(rays, -problem.f);
  const Vector unbalanced = problem.f + rays * strengths;  // f'unbalanced = |unbalanced|^2 > 0, rays'unbalanced >= 0
  if (unbalanced.norm() <= 1e-9 * problem.f.norm()) return std::nullopt;
  return slide_of(problem, unbalanced.normalized());
}

Matrix undetermined_motions(const Problem& problem, const std::vector<ContactState>& states) {
  const Eigen::Index m = problem.G.cols();
  if (m == 0) return Matrix(0, 0);
  std::vector<int> rows;
  for (int i = 0; i < problem.pairs(); ++i) {
    const ContactState state = states[static_cast<std::size_t>(i)];
    if (state != ContactState::open) rows.push_back(2 * i);
    if (state == ContactState::stick) rows.push_back(2 * i + 1);
  }
  if (rows.empty()) return Matrix::Identity(m, m);
  const Matrix held = problem.G(rows, Eigen::all);
  const Eigen::JacobiSVD<Matrix> svd(held, Eigen::ComputeFullV);
  Eigen::Index rank = 0;
  for (Eigen::Index k = 0; k < svd.singularValues().size(); ++k)
    if (svd.singularValues()[k] > 1e-10 * svd.singularValues()[0]) ++rank;
  return svd.matrixV().rightCols(m - rank);
}

}  // namespace scabo::contact
