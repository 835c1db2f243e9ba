#include "scabo/contact/questions/uniqueness.hpp"

#include <cmath>
#include <random>

#include "scabo/contact/newton/newton.hpp"
#include "scabo/contact/questions/lemke.hpp"
#include "scabo/linalg/decompositions.hpp"
#include "scabo/linalg/dense.hpp"

namespace scabo::contact {

namespace {

constexpr Eigen::Index most_dense = 1200;  // unknowns of dense eigenvalues and determinants

bool solves(const Problem& problem, const Vector& p, const Vector& a, const SolverOptions& options) {
  return p.allFinite() &&
         judge(problem, p, a, motion_of(problem, p, a), Measure(problem, p, options.force_scale), Judge::certificate)
             .solved(options.tolerance);
}

/// Forces whose difference causes no motion (of a pair that a support holds along the joint) are not another solution,
/// and neither are forces that differ by rounding relative to `scale`.
bool same(const Problem& problem, const Vector& p, const Vector& other, double scale) {
  const double mean = problem.W.diagonal().mean(),
               force = std::max({linalg::largest_of(p), linalg::largest_of(other), 1e-5 * scale});
  const Vector difference = p - other;
  return linalg::largest_of(difference) <= 1e-6 * force ||
         linalg::largest_of(problem.W * difference) <= 1e-6 * mean * force;
}

void add_if_new(const Problem& problem, std::vector<Vector>& solutions, const Vector& p, double scale) {
  for (const Vector& known : solutions)
    if (same(problem, known, p, scale)) return;
  solutions.push_back(p);
}

/// States of plane pairs in the enumeration.
enum class Trial { open, stick, slip_plus, slip_minus };

/// Forces of a plane problem if all pairs have these states; nothing if there are none. `determined` is set to false if
/// there are many.
std::optional<Vector> forces_with(const Problem& problem, const std::vector<Trial>& states, bool& determined) {
  Matrix A = problem.W.dense();
  Vector b = -problem.q;
  const double scale = A.cwiseAbs().maxCoeff();
  const auto prescribe = [&](Eigen::Index row, double factor = 0.0) {  // p_row = factor p_n
    A.row(row).setZero();
    A(row, row) = scale;
    if (factor != 0.0) A(row, row - 1) = -scale * factor;
    b[row] = 0.0;
  };
  for (Eigen::Index i = 0; i < problem.pairs(); ++i) {
    const Trial state = states[static_cast<std::size_t>(i)];
    if (state == Trial::open) prescribe(2 * i, 0.0), prescribe(2 * i + 1, 0.0);
    if (state == Trial::slip_plus) prescribe(2 * i + 1, problem.mu_against(i, 1.0));
    if (state == Trial::slip_minus) prescribe(2 * i + 1, -problem.mu_against(i, -1.0));
  }
  Eigen::FullPivLU<Matrix> lu(A);
  lu.setThreshold(1e-12);
  const Vector p = lu.solve(b);
  if (!p.allFinite() || (A * p - b).norm() > 1e-9 * b.norm()) return std::nullopt;
  if (!lu.isInvertible()) determined = false;
  return p;
}

bool may_enumerate(const Problem& problem) {
  return problem.dimension == 2 && problem.G.cols() == 0 && problem.pairs() > 0 && problem.pairs() <= most_enumerated &&
         problem.cohesion.size() == 0 && problem.tension.size() == 0;
}

/// Away from the kink of the gap: its rows of H' are those of dp for any slope of the bound and do not affect the
/// determinant.
bool is_open(const Branch& branch) { return !branch.contact && !branch.normal_tie && branch.bound_tie; }

/// Newton's method from `p`: forces if it ends in a solution.
std::optional<Vector> newton_from(const Problem& problem, const Vector& p, const Vector& a,
                                  const SolverOptions& options) {
  const BDifferentiableEquations equations(problem, options.r_factor);
  NewtonOptions newton_options;
  newton_options.iterations = options.iterations;
  newton_options.small = 0.01 * options.tolerance * Measure(problem, Vector(), options.force_scale).scales(p).force;
  const NewtonEnd end = newton(equations, p, a, newton_options);
  if (!end.converged || !solves(problem, end.p, end.a, options)) return std::nullopt;
  return end.p;
}

/// Starts that may lead to other solutions: open, frictionless, stuck, reversed friction, and a few random points in
/// the cones.
std::vector<Vector> other_starts(const Problem& problem, const Solution& solution, const SolverOptions& options) {
  const Eigen::Index N = problem.pairs(), d = problem.dimension;
  std::vector<Vector> starts{Vector::Zero(d * N)};
  Problem changed = problem;
  changed.mu.setZero();
  changed.mu_backward.resize(0);
  changed.cohesion.resize(0);
  if (const Solution frictionless = solve(changed, {}, options); frictionless.status == Status::solved)
    starts.push_back(frictionless.p);
  if (problem.G.cols() == 0 && problem.q.size() <= most_dense) {
    const Eigen::LDLT<Matrix> stuck(problem.W.dense());
    if (const Vector p = stuck.solve(-problem.q); p.allFinite()) starts.push_back(p);
  }
  Vector turned = solution.p;
  for (Eigen::Index i = 0; i < N; ++i) turned.segment(d * i + 1, d - 1) *= -1.0;
  starts.push_back(turned);
  const double mean = problem.W.diagonal().mean();
  const double size = std::max(linalg::largest_of(solution.p), mean > 0.0 ? linalg::largest_of(problem.q) / mean : 1.0);
  std::mt19937 random(20);
  std::uniform_real_distribution<double> uniform(-1.0, 1.0);
  constexpr int at_random = 6;
  for (int k = 0; k < at_random; ++k) {
    Vector p(d * N);
    for (Eigen::Index i = 0; i < N; ++i) {
      p[d * i] = size * std::max(uniform(random), 0.0);
      for (Eigen::Index t = 1; t < d; ++t) {
        const double part = uniform(random);
        p[d * i + t] = problem.mu_against(i, part) * p[d * i] * part;
      }
    }
    starts.push_back(p);
  }
  return starts;
}

}  // namespace

const char* name_of(Uniqueness uniqueness) {
  switch (uniqueness) {
    case Uniqueness::proven:
      return "proven";
    case Uniqueness::several:
      return "several found";
    case Uniqueness::not_decided:
      break;
  }
  return "not decided";
}

double uniqueness_bound(const Problem& problem) {
  const Eigen::Index N = problem.pairs(), d = problem.dimension, t = d - 1;
  if (problem.G.cols() > 0 || problem.q.size() > most_dense) return HUGE_VAL;
  if (N == 0) return 0.0;
  const Matrix W = 0.5 * (problem.W.dense() + problem.W.dense().transpose());
  if ((W - problem.W.dense()).cwiseAbs().maxCoeff() > 1e-9 * W.cwiseAbs().maxCoeff()) return HUGE_VAL;
  const Eigen::LLT<Matrix> factor(W);
  if (factor.info() != Eigen::Success || factor.rcond() < 1e-13) return HUGE_VAL;
  const Matrix K = factor.solve(Matrix::Identity(W.rows(), W.cols()));
  Matrix normal(N, N), tangent(t * N, t * N);
  for (Eigen::Index i = 0; i < N; ++i)
    for (Eigen::Index j = 0; j < N; ++j) {
      const double D_i = std::sqrt(W.diagonal().segment(d * i + 1, t).mean());
      const double D_j = std::sqrt(W.diagonal().segment(d * j + 1, t).mean());
      const double M = std::sqrt(problem.largest_mu(i) * problem.largest_mu(j));
      normal(i, j) = M * D_i * D_j * K(d * i, d * j);
      tangent.block(t * i, t * j, t, t) = M / (D_i * D_j) * W.block(d * i + 1, d * j + 1, t, t);
    }
  const auto largest = [](const Matrix& A) {
    return Eigen::SelfAdjointEigenSolver<Matrix>(A, Eigen::EigenvaluesOnly).eigenvalues().maxCoeff();
  };
  return largest(normal) * largest(tangent);
}

int index_of(const Problem& problem, const Vector& p, const Vector& a) {
  const Eigen::Index n = problem.q.size() + problem.G.cols();
  if (n == 0 || n > most_dense) return 0;
  const BDifferentiableEquations equations(problem, 1.0);
  const Residual at = equations.residual(p, a);
  for (const Branch& branch : at.branches)
    if (branch.tied() && !is_open(branch)) return 0;
  Matrix H(n, n);
  for (Eigen::Index k = 0; k < n; ++k) H.col(k) = equations.derivative(at, Vector::Unit(n, k));
  for (Eigen::Index row = 0; row < n; ++row)
    if (const double size = H.row(row).norm(); size > 0.0) H.row(row) /= size;
  const Eigen::PartialPivLU<Matrix> lu(H);
  if (!(lu.rcond() > 1e-13)) return 0;
  // With the rows of equilibrium the matrix is [W G; G' 0], whose determinant has the sign of (-1)^m if W is positive
  // definite.
  double sign = lu.permutationP().determinant() * (problem.G.cols() % 2 == 0 ? 1.0 : -1.0);
  for (Eigen::Index k = 0; k < n; ++k) sign *= lu.matrixLU()(k, k) < 0.0 ? -1.0 : 1.0;
  return sign > 0.0 ? 1 : -1;
}

std::optional<std::vector<Vector>> all_solutions(const Problem& problem, double tolerance, double force_scale) {
  if (!may_enumerate(problem)) return std::nullopt;
  SolverOptions options;
  options.tolerance = tolerance;
  options.force_scale = force_scale;
  const double scale = Measure(problem, Vector(), options.force_scale).reference();
  std::vector<Vector> solutions;
  std::vector<Trial> states(static_cast<std::size_t>(problem.pairs()));
  for (int combination = 0; combination < 1 << (2 * problem.pairs()); ++combination) {
    for (std::size_t i = 0; i < states.size(); ++i) states[i] = static_cast<Trial>(combination >> (2 * i) & 3);
    bool determined = true;
    const auto p = forces_with(problem, states, determined);
    if (!determined) return std::nullopt;
    if (p && solves(problem, *p, Vector(), options)) add_if_new(problem, solutions, *p, scale);
  }
  return solutions;
}

UniquenessReport examine_uniqueness(const Problem& problem, const Start& start, const Solution& solution,
                                    const SolverOptions& given) {
  UniquenessReport report;
  if (solution.status != Status::solved) return report;
  SolverOptions options = given;  // forces of the history count as well
  options.force_scale = std::max(given.force_scale, linalg::largest_of(start.p));
  const double scale = Measure(problem, Vector(), options.force_scale).scales(solution.p).force;
  report.bound = uniqueness_bound(problem);
  report.index = index_of(problem, solution.p, solution.a);
  if (report.bound < 1.0) {
    report.unique = Uniqueness::proven;
    report.complete = true;
    return report;
  }
  std::vector<Vector> found{solution.p};
  if (const auto all = all_solutions(problem, options.tolerance, options.force_scale)) {
    for (const Vector& p : *all) add_if_new(problem, found, p, scale);
    report.complete = true;
  } else {
    for (const Vector& p : other_starts(problem, solution, options))
      if (const auto other = newton_from(problem, p, solution.a, options)) add_if_new(problem, found, *other, scale);
  }
  report.others.assign(found.begin() + 1, found.end());
  if (!report.others.empty())
    report.unique = Uniqueness::several;
  else if (report.complete && report.bound < HUGE_VAL)
    report.unique = Uniqueness::proven;
  if (start.p.size() != solution.p.size()) return report;
  double least = (1.0 - 1e-9) * (solution.p - start.p).norm();
  for (std::size_t k = 0; k < report.others.size(); ++k)
    if (const double distance = (report.others[k] - start.p).norm(); distance < least) {
      least = distance;
      report.nearest = static_cast<int>(k);
    }
  return report;
}

std::string why_no_solution(const Problem& problem, const SolverOptions& options) {
  if (const auto all = all_solutions(problem, options.tolerance, options.force_scale); all && all->empty())
    return "no combination of open, sticking and slipping pairs meets all conditions: the problem has no "
           "solution";
  constexpr int most_pivoted = 100;
  const bool plain = problem.dimension == 2 && problem.G.cols() == 0 && problem.cohesion.size() == 0 &&
                     problem.tension.size() == 0 && problem.pairs() > 0 && problem.pairs() <= most_pivoted;
  if (plain && !lemke(problem))
    return "Lemke's pivoting also ends on a ray, so that it is not known whether there is a solution";
  return {};
}

}  // namespace scabo::contact
