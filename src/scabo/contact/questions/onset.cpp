#include "scabo/contact/questions/onset.hpp"

#include <cmath>
#include <vector>

#include "scabo/contact/questions/rigid_motions.hpp"
#include "scabo/contact/solve.hpp"
#include "scabo/linalg/decompositions.hpp"

namespace scabo::contact {

namespace {

constexpr double most_entries_of_onset = 6.4e7;  // of W: half a gigabyte

/// Entries of pairs.
Vector values_of(const Vector& values, const std::vector<int>& pairs) {
  return values.size() > 0 ? Vector(values(pairs)) : values;
}

/// Pairs that some rigid motion moves.
std::vector<int> moved_pairs(const Problem& problem) {
  std::vector<bool> moves(static_cast<std::size_t>(problem.pairs()), false);
  const RigidMap::Sparse& G = problem.G.sparse();
  for (Eigen::Index motion = 0; motion < G.outerSize(); ++motion)
    for (RigidMap::Sparse::InnerIterator it(G, motion); it; ++it)
      if (it.value() != 0.0) moves[static_cast<std::size_t>(it.row() / problem.dimension)] = true;
  std::vector<int> pairs;
  for (int i = 0; i < problem.pairs(); ++i)
    if (moves[static_cast<std::size_t>(i)]) pairs.push_back(i);
  return pairs;
}

/// Entries of W of these pairs, not less than there are; the pairs of a body have those of its three motions.
double entries_of(const Problem& problem, const std::vector<int>& pairs, bool many) {
  const double rows = problem.dimension * static_cast<double>(pairs.size());
  if (!many) return rows * rows;
  const RigidMap::Sparse& G = problem.G.sparse();
  double entries = 0.0;
  for (Eigen::Index motion = 0; motion < G.outerSize(); ++motion) {
    const auto moved = static_cast<double>(G.col(motion).nonZeros());
    entries += moved * moved / 3.0;
  }
  return entries;
}

/// The problem of these pairs alone, its loads and strengths times `scale`; W and q stay empty.
Problem of_moved_pairs(const Problem& problem, const std::vector<int>& pairs, double scale) {
  const int d = problem.dimension;
  Problem part;
  part.dimension = d;
  part.mu = values_of(problem.mu, pairs);
  part.mu_backward = values_of(problem.mu_backward, pairs);
  part.cohesion = scale * values_of(problem.cohesion, pairs);
  part.tension = scale * values_of(problem.tension, pairs);
  part.f = scale * problem.f;
  std::vector<int> place(static_cast<std::size_t>(problem.pairs()), -1);
  for (std::size_t k = 0; k < pairs.size(); ++k) place[static_cast<std::size_t>(pairs[k])] = static_cast<int>(k);
  std::vector<Eigen::Triplet<double>> entries;
  const RigidMap::Sparse& G = problem.G.sparse();
  for (Eigen::Index motion = 0; motion < G.outerSize(); ++motion)
    for (RigidMap::Sparse::InnerIterator it(G, motion); it; ++it)
      if (const int pair = place[static_cast<std::size_t>(it.row() / d)]; pair >= 0)
        entries.emplace_back(d * pair + it.row() % d, motion, it.value());
  RigidMap::Sparse rows(d * static_cast<Eigen::Index>(pairs.size()), G.cols());
  rows.setFromTriplets(entries.begin(), entries.end());
  part.G = RigidMap(std::move(rows));
  return part;
}

/// v of a plane problem to its last digits, for the states of a solution: H v = 0, v = M^-1 (f + G'(p_0 + C y)), with
/// the rows H of gaps that stay closed and of tangents that stick, and the forces p_0 + C y that are admissible in
/// these states. Close to the loads that can be balanced v is a small difference of large forces.
Vector of_states(const Problem& problem, const RigidMap::Sparse& inverse_mass, const Solution& solution) {
  const Matrix& G = problem.G.dense();
  std::vector<Vector> held, forces;
  Vector f = problem.f;
  for (Eigen::Index i = 0; i < problem.pairs(); ++i) {
    const Vector n = G.row(2 * i), t = G.row(2 * i + 1);
    switch (solution.states[static_cast<std::size_t>(i)]) {
      case ContactState::open:
        f += solution.p[2 * i] * n + solution.p[2 * i + 1] * t;
        break;
      case ContactState::stick:
        held.insert(held.end(), {n, t});
        forces.insert(forces.end(), {n, t});
        break;
      case ContactState::slip: {
        const double side = solution.slip_increment[i] > 0.0 ? -1.0 : 1.0;  // of p_t
        held.push_back(n);
        forces.push_back(n + side * problem.mu_against(i, side) * t);
        f += side * problem.cohesion_of(i) * t;
        break;
      }
    }
  }
  Vector v = inverse_mass * f;
  if (held.empty()) return v;
  const auto k = static_cast<Eigen::Index>(held.size());
  Matrix H(k, v.size()), B(v.size(), k);
  for (Eigen::Index row = 0; row < k; ++row) {
    H.row(row) = held[static_cast<std::size_t>(row)].transpose();
    B.col(row) = inverse_mass * forces[static_cast<std::size_t>(row)];
  }
  const Eigen::CompleteOrthogonalDecomposition<Matrix> factor(H * B);
  for (int round = 0; round < 2; ++round) v -= B * factor.solve(H * v);
  return v;
}

}  // namespace

std::optional<Vector> onset_of_motion(const Problem& problem, const RigidMap::Sparse& inverse_mass,
                                      double most_operations) {
  if (problem.f.size() == 0 || problem.f.isZero(0.0)) return std::nullopt;
  const std::vector<int> pairs = moved_pairs(problem);
  const bool many = has_many_motions(problem);
  if (entries_of(problem, pairs, many) > most_entries_of_onset) return std::nullopt;
  const Problem whole = of_moved_pairs(problem, pairs, std::exp2(-std::ilogb(problem.f.norm())));
  const Vector fall = inverse_mass * whole.f;  // without any contact
  if (pairs.empty()) return Vector(fall.normalized());

  Problem at_rest = whole;
  const RigidMap::Sparse& G = whole.G.sparse();
  RigidMap::Sparse W = G * inverse_mass * G.transpose();
  at_rest.W = many ? Delassus(std::move(W)) : Delassus(Matrix(W));
  at_rest.q = whole.G * fall;
  at_rest.G.resize(at_rest.q.size(), 0);
  at_rest.f.resize(0);
  SolverOptions options;
  options.judge = Judge::natural_map;
  options.tolerance = 1e-11;
  options.deadline = Deadline::after(most_operations);
  const Solution solution = solve(at_rest, {}, options);
  if (solution.status != Status::solved) return std::nullopt;

  Vector v = fall + inverse_mass * (whole.G.transpose() * solution.p);
  if (!many && problem.dimension == 2) {
    constexpr double of_solver = 1e-8;  // of the free fall: what the solver may have left
    const Vector exact = of_states(whole, inverse_mass, solution);
    if ((exact - v).norm() <= of_solver * fall.norm()) v = exact;
  }
  if (!(v.norm() > 1e-10 * fall.norm()) || !(whole.f.dot(v) > 0.0)) return std::nullopt;
  return Vector(v.normalized());
}

Eigen::SparseMatrix<double> unit_mass(const Problem& problem) {
  const RigidMap::Sparse& G = problem.G.sparse();
  Eigen::SparseMatrix<double> inverse(G.cols(), G.cols());
  for (Eigen::Index k = 0; k < G.cols(); ++k) {
    const double size = G.col(k).squaredNorm();
    inverse.insert(k, k) = size > 0.0 ? 1.0 / size : 1.0;
  }
  return inverse;
}

}  // namespace scabo::contact
