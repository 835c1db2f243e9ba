#include "scabo/contact/newton/bonded_start.hpp"

#include <algorithm>
#include <cmath>

#include "scabo/contact/kkt/newton_direction.hpp"
#include "scabo/contact/kkt/saddle_system.hpp"
#include "scabo/contact/pair_operator.hpp"

namespace scabo::contact {

namespace {

constexpr double softness = 1e-3;     // eps
constexpr double free_motion = 1e-6;  // E where the bodies are not held without it
constexpr double balance = 1e-4;      // of forces, relative to the largest

/// Every touching component that a force moves, alone in its row and column; where all bodies are rigid, every touching
/// one.
SaddleRows held_rows(const Problem& problem, const std::vector<bool>& touching) {
  const Eigen::Index d = problem.dimension;
  Vector diagonal = problem.W.diagonal();
  if (diagonal.isZero(0.0)) diagonal.setOnes();
  std::vector<Eigen::Index> held;
  for (Eigen::Index k = 0; k < diagonal.size(); ++k)
    if ((touching.empty() || touching[static_cast<std::size_t>(k / d)]) && diagonal[k] > 0.0) held.push_back(k);
  SaddleRows rows;
  rows.resize(held.size());
  for (std::size_t j = 0; j < held.size(); ++j) {
    const auto column = static_cast<Eigen::Index>(j);
    rows.pair[j] = static_cast<int>(held[j] / d);
    rows.L(held[j] % d, column) = rows.C(held[j] % d, column) = 1.0;
    rows.D[column] = softness * diagonal[held[j]];
  }
  return rows;
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

/// By products alone: Newton's direction from zero where all touching pairs stick.
std::optional<Point> start_by_products(const Problem& problem, const std::vector<bool>& touching) {
  const Eigen::Index n = problem.q.size(), m = problem.G.cols(), d = problem.dimension;
  const BDifferentiableEquations equations(problem, 1.0);
  const Vector none = Vector::Zero(n);
  const Residual apart = equations.residual(none, Vector::Zero(m));
  Residual at = apart;
  equations.stick_below(HUGE_VAL, none, at);
  for (std::size_t i = 0; i < touching.size(); ++i) {
    if (touching[i]) continue;
    at.branches[i] = apart.branches[i];
    at.H.segment(d * static_cast<Eigen::Index>(i), d) = apart.H.segment(d * static_cast<Eigen::Index>(i), d);
  }
  Vector direction;
  if (!NewtonDirection(equations).find(at, softness, direction)) return std::nullopt;
  return Point{direction.head(n), direction.tail(m)};
}

}  // namespace

std::optional<Point> bonded_start(const Problem& problem, const std::vector<bool>& touching) {
  if (!problem.W.is_dense() && !problem.W.is_sparse())
    return problem.W.holder() != nullptr ? joined_start(problem, touching) : start_by_products(problem, touching);
  const Eigen::Index n = problem.q.size(), m = problem.G.cols();
  SaddleRows rows = held_rows(problem, touching);
  SaddleSystem system(problem);
  Vector right(rows.size() + m);
  for (Eigen::Index j = 0; j < rows.size(); ++j)
    right[j] = -problem.q.segment(problem.dimension * rows.pair[static_cast<std::size_t>(j)], problem.dimension)
                    .dot(rows.L.col(j).head(problem.dimension));
  right.tail(m) = -problem.f;
  for (const double hold : {0.0, free_motion}) {
    rows.E = hold;
    if (!system.factorise(rows)) continue;
    const Vector x = system.solve(right);
    if (!x.allFinite()) continue;
    Point start{rows.forces(x, problem.dimension, problem.pairs()), x.tail(m)};
    if (m == 0) return start;
    const double force = std::max(start.p.lpNorm<Eigen::Infinity>(), problem.f.lpNorm<Eigen::Infinity>());
    const Vector left = problem.G.transpose() * start.p + problem.f;
    if (n > 0 && left.lpNorm<Eigen::Infinity>() <= balance * force) return start;
  }
  return std::nullopt;
}

}  // namespace scabo::contact
