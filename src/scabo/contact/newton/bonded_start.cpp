#include "scabo/contact/newton/bonded_start.hpp"

#include <algorithm>
#include <cmath>

#include "scabo/contact/constants.hpp"
#include "scabo/contact/kkt/newton_direction.hpp"
#include "scabo/contact/kkt/saddle_system.hpp"
#include "scabo/contact/pair_operator.hpp"

namespace scabo::contact {

namespace {

/// Every touching component that a force moves; `diagonal` of W.
std::vector<int> held_components(const Problem& problem, const Vector& diagonal, const std::vector<bool>& touching) {
  std::vector<int> held;
  for (int k = 0; k < diagonal.size(); ++k)
    if ((touching.empty() || touching[static_cast<std::size_t>(k / problem.dimension)]) && diagonal[k] > 0.0)
      held.push_back(k);
  return held;
}

/// These, each alone in its row and column; all that touch where all bodies are rigid.
SaddleRows held_rows(const Problem& problem, const std::vector<bool>& touching) {
  const int d = problem.dimension;
  Vector diagonal = problem.W.diagonal();
  if (diagonal.isZero(0.0)) diagonal.setOnes();
  const std::vector<int> held = held_components(problem, diagonal, touching);
  SaddleRows rows;
  rows.resize(held.size());
  for (std::size_t j = 0; j < held.size(); ++j) {
    const auto column = static_cast<Eigen::Index>(j);
    rows.pair[j] = held[j] / d;
    rows.L(held[j] % d, column) = rows.C(held[j] % d, column) = 1.0;
    rows.D[column] = newton_constants.softness * diagonal[held[j]];
  }
  return rows;
}

/// By joined bodies.
std::optional<Point> joined_start(const Problem& problem, const std::vector<bool>& touching) {
  const PairHolder* const holder = problem.W.holder();
  if (holder == nullptr) return std::nullopt;
  const Eigen::Index N = problem.pairs(), d = problem.dimension;
  const std::vector<int> rows = held_components(problem, problem.W.diagonal(), touching);
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
  if (!NewtonDirection(equations).find(at, newton_constants.softness, direction)) return std::nullopt;
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
  for (const double hold : {0.0, newton_constants.free_motion}) {
    rows.E = hold;
    if (!system.factorise(rows)) continue;
    const Vector x = system.solve(right);
    if (!x.allFinite()) continue;
    Point start{Vector::Zero(problem.q.size()), x.tail(m)};
    rows.add_forces(x, problem.dimension, start.p);
    if (m == 0) return start;
    const double force = std::max(start.p.lpNorm<Eigen::Infinity>(), problem.f.lpNorm<Eigen::Infinity>());
    const Vector left = problem.G.transpose() * start.p + problem.f;
    if (n > 0 && left.lpNorm<Eigen::Infinity>() <= newton_constants.bond_balance * force) return start;
  }
  return std::nullopt;
}

}  // namespace scabo::contact
