#include "scabo/contact/questions/infeasibility.hpp"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <numbers>
#include <vector>

#include "scabo/contact/judge.hpp"
#include "scabo/linalg/nonnegative_least_squares.hpp"

namespace scabo::contact {

namespace {

using Index = Eigen::Index;
using Sparse = Eigen::SparseMatrix<double>;

constexpr Index most_pairs = 1500, most_dense_pairs = 500;  // of the search along normals: 18 MB
constexpr Index most_rays = 800;                            // of the search in the cones
constexpr double beyond_all = 1e10;                         // times k |q|: larger forces are not considered
constexpr double stands_out = 1e-8;                         // of sum |q_i| |r_i|
constexpr double excluded = 1e-9;  // least distance, relative to |q|, at which a case of a pair is excluded

Vector transposed_product(const Delassus& W, const Vector& r) {
  return W.is_sparse() ? Vector(W.sparse().transpose() * r) : Vector(W.dense().transpose() * r);
}

/// r >= 0 along the rays (columns) with W'(rays r) = 0 and q.(rays r) = -1, as a non-negative least-squares problem.
Vector balanced(const Problem& problem, const Sparse& rays) {
  const double k = stiffness_of(problem), largest = problem.q.lpNorm<Eigen::Infinity>();
  const Vector q = rays.transpose() * problem.q / largest;
  if (problem.W.is_sparse()) {
    const Sparse transposed = problem.W.sparse().transpose();
    const Sparse A = k * (transposed * rays);
    const Sparse gram = A.transpose() * A;
    Matrix G(gram);
    G.noalias() += q * q.transpose();
    const auto residual = [&](const Vector& x) { return Vector(-(A.transpose() * (A * x)) - q * (1.0 + q.dot(x))); };
    return rays * linalg::nonnegative_least_squares_of_normal(G, -q, residual);
  }
  const Matrix A = k * (problem.W.dense().transpose() * rays);
  Matrix G = A.transpose() * A;
  G.noalias() += q * q.transpose();
  const auto residual = [&](const Vector& x) { return Vector(-(A.transpose() * (A * x)) - q * (1.0 + q.dot(x))); };
  return rays * linalg::nonnegative_least_squares_of_normal(G, -q, residual);
}

/// Forces along the normals; `sides` of the cone's edge too (space), or both edges (plane).
Sparse rays_of(const Problem& problem, bool with_friction) {
  const Index N = problem.pairs(), d = problem.dimension;
  const int sides = !with_friction ? 0 : d == 2 ? 2 : 8;
  std::vector<Eigen::Triplet<double>> entries;
  const auto add = [&](Index row, Index column, double value) {
    entries.emplace_back(static_cast<int>(row), static_cast<int>(column), value);
  };
  for (Index i = 0; i < N; ++i)
    for (int side = 0; side <= sides; ++side) {
      const Index column = (sides + 1) * i + side;
      add(d * i, column, 1.0);
      if (side == 0) continue;
      const double angle = 2.0 * std::numbers::pi * side / sides;
      const double along = d == 2 ? 2.0 * side - 3.0 : std::cos(angle);
      add(d * i + 1, column, problem.mu_against(i, along) * along);
      if (d == 3) add(d * i + 2, column, problem.mu[i] * std::sin(angle));
    }
  Sparse rays(d * N, (sides + 1) * N);
  rays.setFromTriplets(entries.begin(), entries.end());
  return rays;
}

/// Whether b is a combination of the columns with factors of zero or more.
bool combine(const Matrix& columns, const Vector& b) {
  Matrix A = columns;
  for (Index j = 0; j < A.cols(); ++j)
    if (const double size = A.col(j).norm(); size > 0.0) A.col(j) /= size;
  return (b - A * linalg::nonnegative_least_squares(A, b)).norm() <= excluded * b.norm();
}

/// Whether a pair by itself, u = q + W p, may slip along some direction between the angles. W and q: k W, k q.
bool may_slip(const Matrix& W, const Vector& q, double mu, double from, double to, int depth) {
  const double half = 0.5 * (to - from), middle = from + half;
  const auto direction = [](double angle, double length) {
    return Eigen::Vector3d(0.0, length * std::cos(angle), length * std::sin(angle));
  };
  const Eigen::Vector3d normal = Eigen::Vector3d::UnitX(), first = direction(from, 1.0), last = direction(to, 1.0);
  Matrix columns(3, 5);
  columns << W * (normal - mu * first), W * (normal - mu * last),
      W * (normal - mu * direction(middle, 1.0 / std::cos(half))), -first, -last;
  if (!combine(columns, -q)) return false;
  return depth == 0 || may_slip(W, q, mu, from, middle, depth - 1) || may_slip(W, q, mu, middle, to, depth - 1);
}

/// Whether no force of the pair alone satisfies Coulomb's law, given r with W r = 0, q.r < 0, which excludes stick.
bool no_force_obeys(const Problem& one) {
  const Matrix& W = one.W.dense();
  const Vector& q = one.q;
  if (!(q[0] < 0.0)) return false;  // open
  if (q.size() == 2) {
    for (const double e : {-1.0, 1.0}) {
      Matrix columns(2, 2);
      columns << W * Vec2(1.0, -one.mu_against(0, -e) * e), Vec2(0.0, -e);
      if (combine(columns, -q)) return false;
    }
    return true;
  }
  constexpr int arcs = 6, halvings = 12;
  const double width = 2.0 * std::numbers::pi / arcs;
  for (int arc = 0; arc < arcs; ++arc)
    if (may_slip(W, q, one.mu[0], arc * width, (arc + 1) * width, halvings)) return false;
  return true;
}

/// The problem of the pair; `alone` if no other pair moves it.
struct OnePair {
  Problem problem;
  bool alone = true;
};
OnePair one_pair(const Problem& problem, Index i) {
  const Index d = problem.dimension;
  OnePair one;
  Matrix W = Matrix::Zero(d, d);
  for (Index k = 0; k < d; ++k) {
    const auto visit = [&](Index row, double value) {
      if (row / d == i)
        W(row - d * i, k) += value;
      else if (value != 0.0)
        one.alone = false;
    };
    if (problem.W.is_sparse())
      for (Sparse::InnerIterator at(problem.W.sparse(), d * i + k); at; ++at) visit(at.row(), at.value());
    else
      for (Index row = 0; row < d * problem.pairs(); ++row) visit(row, problem.W.dense()(row, d * i + k));
  }
  const double stiffness = stiffness_of(problem);
  one.problem.dimension = problem.dimension;
  one.problem.W = Matrix(stiffness * W);
  one.problem.q = stiffness * problem.q.segment(d * i, d);
  one.problem.mu = problem.mu.segment(i, 1);
  if (problem.mu_backward.size() > 0) one.problem.mu_backward = problem.mu_backward.segment(i, 1);
  return one;
}

std::optional<Infeasibility> of_single_pairs(const Problem& problem) {
  if (problem.cohesion.size() > 0 || problem.tension.size() > 0) return std::nullopt;
  const Index d = problem.dimension;
  std::vector<bool> moved(static_cast<std::size_t>(problem.pairs()), false);  // by another pair
  if (problem.W.is_sparse()) {
    for (Index j = 0; j < problem.W.size(); ++j)
      for (Sparse::InnerIterator at(problem.W.sparse(), j); at; ++at)
        if (at.row() / d != j / d && at.value() != 0.0) moved[static_cast<std::size_t>(at.row() / d)] = true;
  } else if (problem.pairs() > 1) {
    return std::nullopt;
  }
  for (Index i = 0; i < problem.pairs(); ++i) {
    if (moved[static_cast<std::size_t>(i)] || !(problem.q[d * i] < 0.0)) continue;
    const OnePair one = one_pair(problem, i);
    if (!one.alone) continue;
    Vector r = balanced(one.problem, rays_of(one.problem, true));
    if (const double size = r.lpNorm<Eigen::Infinity>(); size > 0.0) r /= size;
    if (!proves_no_motion(one.problem, r)) continue;
    if (!no_force_obeys(one.problem)) continue;
    Infeasibility result;
    result.r = Vector::Zero(problem.q.size());
    result.r.segment(d * i, d) = r;
    result.proven = proves_no_motion(problem, result.r);
    char text[300];
    std::snprintf(
        text, sizeof text,
        "pair %lld is wedged: forces r in its friction cone cause no motion (W r = 0) while q.r < 0, and neither the "
        "open state nor stick nor slip in any direction satisfies the contact law, so that the problem has no solution",
        static_cast<long long>(i) + 1);
    result.reason = text;
    return result;
  }
  return std::nullopt;
}

std::optional<Infeasibility> along(const Problem& problem, bool with_friction) {
  Infeasibility result;
  result.r = balanced(problem, rays_of(problem, with_friction));
  const double size = result.r.lpNorm<Eigen::Infinity>();
  if (!(size > 0.0)) return std::nullopt;
  result.r /= size;
  if (!proves_no_motion(problem, result.r)) return std::nullopt;
  result.proven = !with_friction;
  Index pairs = 0;
  for (Index i = 0; i < problem.pairs(); ++i) pairs += result.r[problem.dimension * i] > 0.0;
  char text[300];
  std::snprintf(
      text, sizeof text,
      with_friction
          ? "forces r in the friction cones of %lld pairs cause no motion (W r = 0) while q.r < 0: no motion lies in "
            "the dual cone, so that it is not known whether a solution exists"
          : "normal forces r of %lld pairs cause no motion (W r = 0) while q.r < 0: bodies are compressed that cannot "
            "deform, and one of these gaps stays negative whatever forces act, so that the problem has no solution",
      static_cast<long long>(pairs));
  result.reason = text;
  return result;
}

}  // namespace

bool proves_no_motion(const Problem& problem, const Vector& r) {
  const Index d = problem.dimension;
  if (problem.G.cols() > 0 || r.size() != problem.q.size() || !r.allFinite()) return false;
  for (Index i = 0; i < problem.pairs(); ++i)
    if (!(r[d * i] >= 0.0 &&
          r.segment(d * i + 1, d - 1).norm() <= problem.mu_against(i, r[d * i + 1]) * r[d * i] * (1.0 + 1e-12)))
      return false;
  const double work = -problem.q.dot(r), all = problem.q.cwiseAbs().dot(r.cwiseAbs());
  if (!(work > stands_out * all)) return false;
  // Forces p that separate the pairs have (W'r).p >= work, hence |p|_1 >= work / largest entry of W'r.
  const double moved = transposed_product(problem.W, r).lpNorm<Eigen::Infinity>();
  return work >= beyond_all * moved * stiffness_of(problem) * problem.q.lpNorm<Eigen::Infinity>();
}

std::optional<Infeasibility> find_infeasibility(const Problem& problem, const Deadline& deadline) {
  const bool formed = problem.W.is_dense() || problem.W.is_sparse();
  if (problem.G.cols() > 0 || !formed || problem.pairs() == 0 || !problem.q.allFinite() || problem.q.isZero(0.0))
    return std::nullopt;
  if (auto found = of_single_pairs(problem)) return found;
  const Index most = problem.W.is_sparse() ? most_pairs : most_dense_pairs;
  if (problem.pairs() > most || deadline.passed()) return std::nullopt;
  if (auto found = along(problem, false)) return found;
  const Index rays = problem.pairs() * (problem.dimension == 2 ? 3 : 9);
  if (rays > most_rays || deadline.passed()) return std::nullopt;
  return along(problem, true);
}

void mark_infeasible(Solution& solution, const Infeasibility& found) {
  if (!found.proven) {
    solution.reason += "; " + found.reason;
    return;
  }
  solution.status = Status::infeasible;
  solution.proof = found.r;
  solution.reason = found.reason;
}

}  // namespace scabo::contact
