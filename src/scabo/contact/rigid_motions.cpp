#include "scabo/contact/rigid_motions.hpp"

#include <Eigen/SVD>
#include <cmath>
#include <numbers>

#include "scabo/linalg/nonnegative_least_squares.hpp"

namespace scabo::contact {

namespace {

/// The proof moves up the friction cones while it slides; the slide that changes no gap says the same more plainly. It is
/// taken where the proof is mostly that.
Vector slide_of(const Problem& problem, const Vector& motion) {
  if (problem.pairs() == 0) return motion;
  Matrix normals(problem.pairs(), motion.size());
  for (Eigen::Index i = 0; i < problem.pairs(); ++i) normals.row(i) = problem.G.row(problem.dimension * i);
  const Eigen::JacobiSVD<Matrix> svd(normals, Eigen::ComputeFullV);
  Eigen::Index rank = 0;
  for (Eigen::Index k = 0; k < svd.singularValues().size(); ++k)
    if (svd.singularValues()[k] > 1e-10 * svd.singularValues()[0]) ++rank;
  const Matrix slides = svd.matrixV().rightCols(motion.size() - rank);
  const Vector slide = slides * (slides.transpose() * motion);
  return slide.norm() > 0.7 ? Vector(slide.normalized()) : motion;
}

/// Effects on the rigid motions of rays whose non-negative combinations hold all friction forces: in the plane the extreme
/// rays n + mu t and n - mu t, in space those of a pyramid around the cone, so that a proof against it is one against the
/// cone.
Matrix rays_of(const Problem& problem) {
  const Eigen::Index N = problem.pairs(), d = problem.dimension;
  constexpr int sides = 16;
  const int count = d == 2 ? 2 : sides;
  Matrix rays(problem.G.cols(), count * N);
  for (Eigen::Index i = 0; i < N; ++i)
    for (int k = 0; k < count; ++k) {
      Vector ray = problem.G.row(d * i).transpose();
      if (d == 2) {
        ray += (k == 0 ? 1.0 : -1.0) * problem.mu[i] * problem.G.row(2 * i + 1).transpose();
      } else {
        const double angle = 2.0 * std::numbers::pi * k / sides, reach = problem.mu[i] / std::cos(std::numbers::pi / sides);
        ray += reach * (std::cos(angle) * problem.G.row(3 * i + 1) + std::sin(angle) * problem.G.row(3 * i + 2)).transpose();
      }
      rays.col(count * i + k) = ray;
    }
  return rays;
}

}  // namespace

std::optional<Vector> find_mechanism(const Problem& problem) {
  const Eigen::Index m = problem.G.cols(), N = problem.pairs();
  if (m == 0 || problem.f.isZero(0.0)) return std::nullopt;
  for (Eigen::Index i = 0; i < N; ++i)  // not a cone: no proof this way
    if (problem.cohesion_of(i) > 0.0 || problem.tension_of(i) > 0.0) return std::nullopt;
  const Matrix rays = rays_of(problem);
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
    const int d = problem.dimension;
    if (state != ContactState::open) rows.push_back(d * i);
    if (state == ContactState::stick)
      for (int k = 1; k < d; ++k) rows.push_back(d * i + k);
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
