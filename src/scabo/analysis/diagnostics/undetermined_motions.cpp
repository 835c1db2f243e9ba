#include "scabo/analysis/diagnostics/undetermined_motions.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "scabo/analysis/diagnostics/mechanism.hpp"
#include "scabo/contact/questions/rigid_motions.hpp"
#include "scabo/contact/solve.hpp"
#include "scabo/linalg/decompositions.hpp"
#include "scabo/linalg/least_distance.hpp"
#include "scabo/system/rigid_motions.hpp"

namespace scabo::analysis {

namespace {

constexpr double least_motion = 1e-6;  // of a motion of all bodies: motions of many are found to about 1e-8

constexpr double no_force = 10.0;  // tolerances of the solution, that a force must exceed to hold anything

/// What the part may do of the motions, as [u_x, u_y, L rotation], 3 x k.
Matrix motions_of_part(const Prepared& prepared, std::size_t p, const Matrix& motions) {
  const system::BodySystem& part = *prepared.structure.parts[p];
  const Eigen::Index m = part.rigid_motions().cols();
  if (m == 0 || prepared.is_absent(p)) return Matrix(3, 0);
  return part.rigid_coordinates() * motions.middleRows(prepared.contact.first_rigid[p], m);
}

/// The states of the pairs, open those with a force of less than `least`: all that holds a body that is loose may be
/// what the tolerance leaves.
std::vector<contact::ContactState> held_states(const contact::Problem& problem, const contact::Solution& solution,
                                               double least) {
  std::vector<contact::ContactState> states = solution.states;
  for (Eigen::Index i = 0; i < problem.pairs(); ++i)
    if (problem.tension_of(i) == 0.0 && problem.cohesion_of(i) == 0.0 &&
        solution.p.segment(problem.dimension * i, problem.dimension).lpNorm<Eigen::Infinity>() <= least)
      states[static_cast<std::size_t>(i)] = contact::ContactState::open;
  return states;
}

/// Conditions (1) on y, B y >= h, and equations C y = 0 of pairs whose law remembers its slip.
struct Conditions {
  Matrix within;  ///< B
  Vector least;   ///< h
  Matrix held;    ///< C
};
Conditions conditions_of(const contact::Problem& problem, const contact::JointLaws& laws,
                         const contact::Solution& solution, const std::vector<contact::ContactState>& states,
                         const Matrix& U) {
  const Matrix moved = problem.G.sparse() * U;
  std::vector<Eigen::Index> held;
  std::vector<Vector> rows;
  std::vector<double> least;
  const auto keep = [&](const Vector& row, double room) {
    if (row.norm() <= 1e-9) return;  // rounding
    rows.push_back(row);
    least.push_back(-std::max(room, 0.0));
  };
  for (Eigen::Index i = 0; i < problem.pairs(); ++i) {
    const auto pair = static_cast<std::size_t>(i);
    const double p_t = solution.p[2 * i + 1];
    if (states[pair] == contact::ContactState::open) keep(moved.row(2 * i), solution.gap[i]);
    if (states[pair] != contact::ContactState::slip) continue;
    if (laws.of_pair[pair]->remembers())
      held.push_back(2 * i + 1);
    else if (p_t != 0.0)
      keep(-std::copysign(1.0, p_t) * moved.row(2 * i + 1), -std::copysign(solution.slip_increment[i], p_t));
  }
  Conditions conditions{Matrix(static_cast<Eigen::Index>(rows.size()), U.cols()),
                        Vector(static_cast<Eigen::Index>(rows.size())), moved(held, Eigen::all)};
  for (std::size_t k = 0; k < rows.size(); ++k) {
    conditions.within.row(static_cast<Eigen::Index>(k)) = rows[k];
    conditions.least[static_cast<Eigen::Index>(k)] = least[k];
  }
  return conditions;
}

/// (2), over the area of these bodies, as y'A y + 2 b'y + a constant.
struct Squares {
  Matrix A;
  Vector b;
};
Squares squares_of(const Prepared& prepared, const State& from, const State& to, const Matrix& U) {
  Squares squares{Matrix::Zero(U.cols(), U.cols()), Vector::Zero(U.cols())};
  double area = 0.0;
  for (std::size_t p = 0; p < prepared.structure.parts.size(); ++p) {
    const Matrix r = motions_of_part(prepared, p, U);
    if (r.cols() == 0 || r.norm() <= least_motion) continue;
    const Eigen::Matrix3d areas = moments_of_part(prepared, p);
    area += areas(0, 0);
    squares.A += r.transpose() * areas * r;
    squares.b += r.transpose() * (areas * nearest_rigid_motion(prepared, p, to.u[p] - from.u[p]));
  }
  squares.A /= area;
  squares.b /= area;
  return squares;
}

/// Rigid motions in place of those of `to` for which the bodies move least.
Vector smallest_motions(const Prepared& prepared, const contact::Problem& problem, const contact::JointLaws& laws,
                        const State& from, const State& to, const contact::Solution& solution,
                        const std::vector<contact::ContactState>& states) {
  Matrix U = solution.undetermined;
  Conditions conditions = conditions_of(problem, laws, solution, states, U);
  if (conditions.held.rows() > 0) {
    const Matrix free = system::null_space(conditions.held);
    if (free.cols() == 0) return to.rigid_motion;
    U = U * free;
    conditions.within = conditions.within * free;
  }
  const Squares squares = squares_of(prepared, from, to, U);
  const Eigen::LLT<Matrix> factor(squares.A);
  if (factor.info() != Eigen::Success) return to.rigid_motion;
  // z = L'y: (2) is |z + L^-1 b|^2.
  const Matrix B = factor.matrixL().solve(conditions.within.transpose()).transpose();
  const Vector z = linalg::nearest_within(B, conditions.least, -factor.matrixL().solve(squares.b));
  return to.rigid_motion + U * factor.matrixU().solve(z);
}

/// How a part may move, `Q` (3 x k) spanning its motions; empty if it does not.
std::string ways_of_part(const system::BodySystem& part, const Matrix& Q, double size) {
  const Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d> eigen(Eigen::Matrix3d(Q * Q.transpose()));  // smallest first
  int rank = 0;
  while (rank < 3 && eigen.eigenvalues()[2 - rank] > least_motion * least_motion * size * size) ++rank;
  const auto described = [&](const Eigen::Vector3d& motion) {
    return system::describe_motion(motion, part.reference(), part.lever());
  };
  if (rank == 0) return {};
  if (rank == 3) return "any motion";
  if (rank == 1) return described(eigen.eigenvectors().col(2));
  // All motions but those along n: of two, one is a translation, and the other the rotation normal to it.
  const Eigen::Vector3d n = eigen.eigenvectors().col(0);
  if (n.head<2>().norm() <= least_motion) return "any translation";
  const Eigen::Vector3d translation(-n.y(), n.x(), 0.0);
  const double sign = translation.x() < -least_motion * n.head<2>().norm() ? -1.0 : 1.0;
  return described(sign * translation) + " and " + described(n.cross(translation));
}

/// `body 'a'`, `bodies 'a', 'b' and 'c'`; tied bodies as they are named together.
std::string names_of_parts(const Prepared& prepared, const std::vector<std::size_t>& parts) {
  const system::Dofs& dofs = prepared.structure.dofs;
  if (parts.size() == 1) return dofs.name_of(parts[0], prepared.model);
  std::string text = "bodies ";
  for (std::size_t i = 0; i < parts.size(); ++i) {
    if (i > 0) text += i + 1 == parts.size() ? " and " : ", ";
    text += fmt::format("'{}'", prepared.model.bodies[static_cast<std::size_t>(dofs.bodies_of(parts[i])[0])].name);
  }
  return text;
}

}  // namespace

bool give_smallest_motions(const Prepared& prepared, const contact::Problem& problem, const contact::JointLaws& laws,
                           const contact::Start& start, const contact::SolverOptions& options, const State& from,
                           State& to, contact::Solution& solution) {
  const contact::Scales scales = contact::Measure(problem, start.p, options.force_scale).scales(solution.p);
  const auto states = held_states(problem, solution, no_force * options.tolerance * scales.force);
  if (states != solution.states && !contact::has_many_motions(problem))
    solution.undetermined = contact::undetermined_motions(problem, states);
  if (solution.undetermined.cols() == 0 || solution.undetermined.cols() > most_undetermined) return false;
  auto other = contact::with_motions(solution, smallest_motions(prepared, problem, laws, from, to, solution, states),
                                     problem, start, options);
  if (!other) return false;
  for (std::size_t i = 0; i < to.history.size(); ++i) {
    if (solution.states[i] != contact::ContactState::slip) continue;
    const auto pair = static_cast<Eigen::Index>(i);
    const double less = std::abs(solution.slip_increment[pair]) - std::abs(other->slip_increment[pair]);
    to.history[i].slip = std::max(from.history[i].slip, to.history[i].slip - less);
  }
  solution = std::move(*other);
  to.rigid_motion = solution.a;
  to.gap = solution.gap;
  to.slip = from.slip + solution.slip_increment;
  to.states = solution.states;
  return true;
}

std::optional<Warning> undetermined_motion_warning(const Prepared& prepared, const Matrix& undetermined,
                                                   const std::vector<Warning>& given) {
  if (undetermined.cols() == 0) return {};
  const system::Dofs& dofs = prepared.structure.dofs;
  const double size = undetermined.colwise().norm().maxCoeff();
  struct Alike {
    std::string ways;
    std::vector<std::size_t> parts;
    bool tied = false;
  };
  constexpr std::size_t most = 4;
  std::vector<Alike> groups;
  std::string subject;
  std::size_t named = 0, others = 0;
  bool all_given = true;
  for (std::size_t p = 0; p < prepared.structure.parts.size(); ++p) {
    const Matrix Q = motions_of_part(prepared, p, undetermined);
    const std::string ways = Q.cols() > 0 ? ways_of_part(*prepared.structure.parts[p], Q, size) : "";
    if (ways.empty()) continue;
    const std::vector<int>& bodies = dofs.bodies_of(p);
    for (const int body : bodies) {
      const std::string name = fmt::format("'{}'", prepared.model.bodies[static_cast<std::size_t>(body)].name);
      subject += (subject.empty() ? "" : ", ") + name;
      all_given =
          all_given && std::any_of(given.begin(), given.end(), [&](const Warning& warning) {
            return warning.kind == WarningKind::undetermined_motion && warning.subject.find(name) != std::string::npos;
          });
    }
    if (named == most) {
      others += bodies.size();
      continue;
    }
    ++named;
    const bool tied = bodies.size() > 1;
    const auto alike = std::find_if(groups.begin(), groups.end(),
                                    [&](const Alike& group) { return !tied && !group.tied && group.ways == ways; });
    if (alike == groups.end())
      groups.push_back({ways, {p}, tied});
    else
      alike->parts.push_back(p);
  }
  if (all_given) return {};
  std::string text;
  for (const Alike& group : groups)
    text += fmt::format("{}{}: {}", text.empty() ? "" : "; ", names_of_parts(prepared, group.parts), group.ways);
  if (others > 0) text += fmt::format("; and {} more {}", others, others == 1 ? "body" : "bodies");
  return Warning{WarningKind::undetermined_motion, subject,
                 fmt::format("supports, friction and loads do not determine {}; the smallest such motion was chosen: "
                             "add a support if the position matters",
                             text)};
}

}  // namespace scabo::analysis
