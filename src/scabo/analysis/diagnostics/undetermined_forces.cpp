#include "scabo/analysis/diagnostics/undetermined_forces.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <random>

#include "scabo/contact/questions/smoothest_forces.hpp"
#include "scabo/contact/solve.hpp"
#include "scabo/linalg/symmetric_positive_solver.hpp"

namespace scabo::analysis {

namespace {

using Sparse = Eigen::SparseMatrix<double>;
using Triplets = std::vector<Eigen::Triplet<double>>;

constexpr double least_room = 1e-6;   // of the largest force of a pair: how far a force may change to count
constexpr double least_share = 1e-3;  // of a random vector of size 1: what counts as not zero

/// What supports leave of a force on each node that they hold.
std::map<Eigen::Index, Mat2> left_by_supports(const system::BodySystem& part) {
  std::map<Eigen::Index, Mat2> left;
  for (const system::Constraint& constraint : part.constraints()) {
    const Vec2 d = constraint.direction();
    const auto [at, first] =
        left.try_emplace(plane_components.node_of(constraint.dof), Mat2(Mat2::Identity() - d * d.transpose()));
    if (!first) at->second.setZero();
  }
  return left;
}

/// Where the forces of the pairs act; blocks that no pair enters are left out.
contact::ActionOfPairs action_of_pairs(const Prepared& prepared) {
  contact::ActionOfPairs action;
  Triplets entries;
  int rows = 0;
  const auto add_block = [&](int size, bool is_point) {
    action.first_row.push_back(rows);
    action.is_point.push_back(is_point ? 1 : 0);
    rows += size;
  };
  for (std::size_t p = 0; p < prepared.structure.parts.size(); ++p) {
    if (prepared.is_absent(p)) continue;
    const system::BodySystem& part = *prepared.structure.parts[p];
    const Sparse& motion = prepared.contact.motion[p];
    if (motion.nonZeros() == 0) continue;
    if (prepared.structure.dofs.is_rigid(p)) {
      // Resultants along the free motions, and along those that springs hold.
      Matrix ways = part.rigid_motions().transpose();
      if (part.is_flexible()) {
        const Matrix A = part.flexibility({0, 1, 2});
        ways.conservativeResize(ways.rows() + 3, 3);
        ways.bottomRows(3) = A / std::max(A.lpNorm<Eigen::Infinity>(), 1e-300);
      }
      for (Eigen::Index k = 0; k < motion.outerSize(); ++k)
        for (Sparse::InnerIterator it(motion, k); it; ++it)
          for (Eigen::Index way = 0; way < ways.rows(); ++way)
            entries.emplace_back(rows + static_cast<int>(way), static_cast<int>(it.row()), ways(way, k) * it.value());
      if (ways.rows() > 0) add_block(static_cast<int>(ways.rows()), false);
      continue;
    }
    const auto left = left_by_supports(part);
    for (Eigen::Index node = 0; place_of(node) < motion.outerSize(); ++node) {
      const auto held = left.find(node);
      bool any = false;
      for (Eigen::Index k = 0; k < 2; ++k)
        for (Sparse::InnerIterator it(motion, place_of(node, k)); it; ++it) {
          any = true;
          for (Eigen::Index row = 0; row < 2; ++row) {
            const double share = held == left.end() ? (row == k ? 1.0 : 0.0) : held->second(row, k);
            if (share != 0.0)
              entries.emplace_back(rows + static_cast<int>(row), static_cast<int>(it.row()), share * it.value());
          }
        }
      if (any) add_block(2, true);
    }
  }
  for (Eigen::Index i = 0; i < prepared.contact.softness.size(); ++i) {
    if (prepared.contact.softness[i] == 0.0) continue;  // else the force is that of the spring between the sides
    entries.emplace_back(rows, static_cast<int>(place_of(i)), 1.0);
    add_block(1, false);
  }
  action.on_bodies.resize(rows, 2 * static_cast<Eigen::Index>(prepared.contact.pairs.size()));
  action.on_bodies.setFromTriplets(entries.begin(), entries.end());
  for (const system::ContactSystem::Pair& pair : prepared.contact.pairs)
    action.normal.push_back(normal_of(prepared, pair));
  action.area = prepared.contact.laws.area;
  return action;
}

/// C: columns of the forces that may change while the pairs keep their states.
Sparse free_forces(const State& state, const contact::Problem& problem) {
  const Eigen::Index N = problem.pairs();
  const double room = least_room * state.p.lpNorm<Eigen::Infinity>();
  Triplets entries;
  int columns = 0;
  for (Eigen::Index i = 0; i < N; ++i) {
    const double p_n = state.p[2 * i], p_t = state.p[2 * i + 1];
    const contact::ContactState pair = state.states[static_cast<std::size_t>(i)];
    if (pair == contact::ContactState::open || !(p_n + problem.tension_of(i) > room)) {
      if (problem.friction_bound(i, p_n, p_t) - std::abs(p_t) >
          room)  // shear of a strength that pressure does not change
        entries.emplace_back(2 * i + 1, columns++, 1.0);
      continue;
    }
    const bool bonded = std::isinf(problem.cohesion_of(i));
    const bool sticks =
        bonded || (pair == contact::ContactState::stick && problem.friction_bound(i, p_n, p_t) - std::abs(p_t) > room);
    entries.emplace_back(2 * i, columns, 1.0);
    if (!sticks && p_t != 0.0) entries.emplace_back(2 * i + 1, columns, std::copysign(problem.mu_against(i, p_t), p_t));
    ++columns;
    if (sticks && problem.friction_bound(i, p_n, p_t) > 0.0) entries.emplace_back(2 * i + 1, columns++, 1.0);
  }
  Sparse C(2 * N, columns);
  C.setFromTriplets(entries.begin(), entries.end());
  return C;
}

/// The part of a random vector in the null space of A; empty where there is none.
Vector random_null_vector(const Sparse& A) {
  std::minstd_rand random(1);
  Vector y(A.cols());
  for (double& value : y) value = static_cast<double>(random()) / static_cast<double>(std::minstd_rand::max()) - 0.5;
  if (A.rows() == 0) return y;
  constexpr double softness = 1e-9;  // e, of the mean of A A'
  constexpr double exact = 1e-8;
  constexpr int most = 12;
  Sparse B = A * Sparse(A.transpose());
  const double mean = Vector(B.diagonal()).mean();
  if (!(mean > 0.0)) return y;
  Sparse identity(B.rows(), B.cols());
  identity.setIdentity();
  B += softness * mean * identity;
  const linalg::SymmetricPositiveSolver solver(B);
  Vector left = A * y;
  for (int round = 0; round < most && left.lpNorm<Eigen::Infinity>() > 1e-3 * exact * std::sqrt(mean); ++round) {
    y -= A.transpose() * solver.solve(Matrix(left)).col(0);
    left = A * y;
  }
  return left.lpNorm<Eigen::Infinity>() <= exact * std::sqrt(mean) ? y : Vector();
}

/// Whether forces that are not unique are those that the solver happened to find.
bool left_as_they_are(const Prepared& prepared, const State& state, const contact::Problem& problem) {
  contact::Solution solution;
  solution.p = state.p;
  solution.gap = state.gap;
  solution.slip_increment = Vector::Zero(problem.pairs());
  solution.states = state.states;
  return contact::smoothest_forces(problem, solution, action_of_pairs(prepared), {}).left > 0;
}

std::string names_of(const Prepared& prepared, const std::vector<std::size_t>& contacts) {
  constexpr std::size_t most = 3;
  std::string text = contacts.size() == 1 ? "contact " : "contacts ";
  const std::size_t named = contacts.size() <= most + 1 ? contacts.size() : most;
  for (std::size_t i = 0; i < named; ++i) {
    if (i > 0) text += i + 1 == contacts.size() ? " and " : ", ";
    text += fmt::format("'{}'", prepared.model.contacts[contacts[i]].name);
  }
  return named == contacts.size() ? text : text + fmt::format(" and {} more", contacts.size() - named);
}

}  // namespace

void give_smoothest_forces(const Prepared& prepared, const contact::Problem& problem, const contact::Start& start,
                           const contact::SolverOptions& options, contact::Solution& solution) {
  if (solution.status != contact::Status::solved || problem.pairs() < 2 || problem.dimension != 2) return;
  const contact::Scales scales = contact::Measure(problem, start.p, options.force_scale).scales(solution.p);
  contact::SmoothestForces smooth = contact::smoothest_forces(problem, solution, action_of_pairs(prepared), scales);
  if (smooth.changed == 0) return;
  auto other = contact::with_forces(solution, std::move(smooth.p), problem, start, options);
  if (other) solution = std::move(*other);
}

Vector undetermined_forces(const Prepared& prepared, const State& state, const contact::Problem& problem) {
  if (problem.pairs() == 0 || problem.dimension != 2 || state.p.isZero(0.0)) return {};
  const Sparse C = free_forces(state, problem);
  if (C.cols() == 0) return {};
  Vector y = random_null_vector(action_of_pairs(prepared).on_bodies * C);
  if (y.size() == 0) return {};
  for (double& value : y)
    if (std::abs(value) <= least_share) value = 0.0;
  return y.isZero(0.0) ? Vector() : Vector(C * y);
}

std::optional<Warning> undetermined_forces_warning(const Prepared& prepared, const State& state,
                                                   const contact::Problem& problem) {
  const Vector change = undetermined_forces(prepared, state, problem);
  if (change.size() == 0) return {};
  std::vector<Vec2> total(prepared.model.contacts.size(), Vec2::Zero());
  std::vector<bool> concerned(prepared.model.contacts.size(), false);
  int pairs = 0;
  for (std::size_t i = 0; i < prepared.contact.pairs.size(); ++i) {
    const system::ContactSystem::Pair& at = prepared.contact.pairs[i];
    const Vec2 force = change.segment<2>(static_cast<Eigen::Index>(2 * i));
    if (force.isZero(0.0) || at.is_bar()) continue;
    ++pairs;
    const auto c = static_cast<std::size_t>(at.contact);
    concerned[c] = true;
    const Vec2& n = prepared.mesh.interfaces[c].pairs[static_cast<std::size_t>(at.index)].normal;
    total[c] += force[0] * n + force[1] * tangent_of(n);
  }
  std::vector<std::size_t> contacts, totals;
  for (std::size_t c = 0; c < concerned.size(); ++c) {
    if (!concerned[c]) continue;
    contacts.push_back(c);
    if (total[c].norm() > least_share) totals.push_back(c);
  }
  if (contacts.empty()) return {};  // of supports that share points the sum of the reactions is known
  const std::string names = names_of(prepared, contacts);
  std::string unique = "Displacements, stresses and the total force of every contact are unique";
  if (!totals.empty())
    unique = fmt::format("Displacements and stresses are unique, and so are the total forces of all contacts except {}",
                         names_of(prepared, totals));
  return Warning{WarningKind::undetermined_force, "",
                 fmt::format("{}: the forces of {} of {} pairs are not unique: other forces there balance every body "
                             "with the same displacements; {}. {}",
                             names, pairs, prepared.contact.pairs.size(),
                             left_as_they_are(prepared, state, problem) ? "some of many that are possible are given"
                                                                        : "the smoothest ones are given",
                             unique)};
}

}  // namespace scabo::analysis
