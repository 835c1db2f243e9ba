#include "scabo/contact/laws/evolution.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include "scabo/base/error.hpp"
#include "scabo/contact/laws/compliance.hpp"
#include "scabo/contact/questions/rigid_motions.hpp"

namespace scabo::contact {

namespace {

/// Motions that need less than this fraction of the strength of the pair are rounding.
constexpr double noticeable = 1e-9;
/// A force this close to its limit, as a fraction of the strength, has reached it: a solution is within the tolerance
/// of the limits, not within rounding, and what moves a pair by more than rounding is at one of them.
constexpr double at_limit = 1e-6;

/// How every pair ends, and its motions beyond its strength.
struct Ends {
  std::vector<PairEnd> of_pair;
  Vector opening, sliding;  ///< N, lengths, 0 where they do not count
  Vector strength;          ///< N, at least what counts as rounding
};

/// The force equivalent to a motion of components that give way by W each, `mean` on the average.
double equivalent_force(double motion, double W, double mean) {
  return motion == 0.0 ? 0.0 : motion / (W > 1e-14 * mean ? W : mean);
}

double mean_of(const Vector& diagonal) { return diagonal.size() > 0 ? diagonal.mean() : 1.0; }

Ends ends_of(const Problem& problem, const Solution& solution, const Vector& diagonal) {
  const Eigen::Index N = problem.pairs(), d = problem.dimension;
  Ends ends{std::vector<PairEnd>(static_cast<std::size_t>(N)), Vector::Zero(N), Vector::Zero(N), Vector::Ones(N)};
  const double mean = mean_of(diagonal);
  const double largest = solution.p.size() > 0 ? solution.p.lpNorm<Eigen::Infinity>() : 0.0;
  for (Eigen::Index i = 0; i < N; ++i) {
    const ContactState state = solution.states[static_cast<std::size_t>(i)];
    const double slip = solution.slip_increment.segment((d - 1) * i, d - 1).norm();
    const double p_n = solution.p[d * i], tension = problem.tension_of(i);
    const double bound = problem.friction_bound(i, p_n, solution.p[d * i + 1]), strength = bound + tension;
    const double gap = std::max(solution.gap[i], 0.0), opening = equivalent_force(gap, diagonal[d * i], mean);
    const double sliding = equivalent_force(slip, diagonal.segment(d * i + 1, d - 1).mean(), mean);
    if (std::isinf(strength)) continue;
    const double size = largest > 0.0 ? std::clamp(strength, 1e-3 * largest, largest) : strength;
    const double rounding = noticeable * size, near = at_limit * size;
    const bool pulls_all = state == ContactState::open || (tension > 0.0 && p_n + tension <= near);
    const bool shears_all =
        state == ContactState::slip ||
        (state == ContactState::stick && bound - solution.p.segment(d * i + 1, d - 1).norm() <= near);
    PairEnd& end = ends.of_pair[static_cast<std::size_t>(i)];
    end.opened = pulls_all && opening > rounding;
    end.slid = shears_all && sliding > rounding;
    // An open pair without tension can still slide if it has cohesion.
    if (state == ContactState::open && problem.cohesion_of(i) > 0.0 && sliding > rounding) end.slid = true;
    end.slip = end.slid && state != ContactState::open ? slip : 0.0;
    ends.opening[i] = end.opened ? gap : 0.0;
    ends.sliding[i] = end.slid ? slip : 0.0;
    ends.strength[i] = std::max(strength, rounding);
  }
  return ends;
}

/// Updates the flags of the most overloaded pairs among those whose flags the solution changes; once there are none,
/// strength comes back where pairs have closed, once in an increment. Returns whether there were any.
bool let_fall(const JointLaws& laws, const Ends& ends, int dimension, Compliance& compliance, History& trial,
              std::vector<char>& recovered) {
  History next = trial;
  std::vector<std::size_t> fallen, closed;
  for (std::size_t i = 0; i < trial.size(); ++i) {
    next[i] = laws.of_pair[i]->after(trial[i], ends.of_pair[i]);
    if (trial[i].broken && !next[i].broken) {
      if (!recovered[i]) closed.push_back(i);
      next[i].broken = true;
    }
    if (next[i].broken != trial[i].broken || next[i].slipped != trial[i].slipped) fallen.push_back(i);
  }
  const double mean = mean_of(compliance.diagonal());
  std::vector<double> overload(fallen.size(), 0.0);
  for (std::size_t k = 0; k < fallen.size() && fallen.size() > 1; ++k) {
    const auto i = static_cast<Eigen::Index>(fallen[k]), first = dimension * i;
    double along = 0.0;
    for (Eigen::Index t = 1; t < dimension; ++t) along += compliance.of(first + t) / (dimension - 1);
    overload[k] = (equivalent_force(ends.opening[i], compliance.of(first), mean) +
                   equivalent_force(ends.sliding[i], along, mean)) /
                  ends.strength[i];
  }
  const double largest = fallen.empty() ? 0.0 : *std::max_element(overload.begin(), overload.end());
  for (std::size_t k = 0; k < fallen.size(); ++k)
    if (overload[k] >= (1.0 - 1e-6) * largest - noticeable) {
      trial[fallen[k]].broken = next[fallen[k]].broken;
      trial[fallen[k]].slipped = next[fallen[k]].slipped;
    }
  if (!fallen.empty()) return true;
  for (const std::size_t i : closed) trial[i].broken = false, recovered[i] = 1;
  return !closed.empty();
}

/// Coefficients that depend on slip: Aitken's extrapolation of the slip of each pair from three rounds.
class Following {
 public:
  /// Slip of the next round from the result of this round for `used`; false if all have converged.
  bool next(const JointLaws& laws, const History& from, const Ends& ends, double tolerance, History& trial) {
    bool settled = true;
    const bool extrapolate = ++round_ % 3 == 0;
    before_.resize(trial.size(), 0.0);
    for (std::size_t i = 0; i < trial.size(); ++i) {
      PairHistory reached = trial[i];
      reached.slip = from[i].slip + ends.of_pair[i].slip;
      const Limits used = laws.of_pair[i]->limits(trial[i]), then = laws.of_pair[i]->limits(reached);
      const auto same = [&](double mu, double mu_reached) {
        return std::abs(mu_reached - mu) <= tolerance * std::max(mu, mu_reached);
      };
      settled = settled && same(used.mu, then.mu) &&
                same(used.mu_backward.value_or(used.mu), then.mu_backward.value_or(then.mu));
      const double change = reached.slip - trial[i].slip, ratio = before_[i] != 0.0 ? change / before_[i] : 0.0;
      before_[i] = change;
      trial[i].slip = extrapolate && std::abs(ratio) < 0.95
                          ? std::max(from[i].slip, trial[i].slip + change / (1.0 - ratio))
                          : reached.slip;
    }
    return !settled;
  }
  void forget() {
    round_ = 0;
    before_.clear();
  }

 private:
  int round_ = 0;
  std::vector<double> before_;
};

/// The force scale of the motions and loads of the problem.
double reference_force(const Problem& problem, const Vector& diagonal, const Start& start,
                       const SolverOptions& options) {
  const auto largest = [](const Vector& v) { return v.size() > 0 ? v.lpNorm<Eigen::Infinity>() : 0.0; };
  const double mean = diagonal.size() > 0 ? diagonal.mean() : 0.0;
  return std::max(
      {options.force_scale, largest(problem.f), largest(start.p), mean > 0.0 ? largest(problem.q) / mean : 0.0});
}

/// Solves with strengths limited to a multiple of the acting forces, which would otherwise be lost in rounding (p_n +
/// c_t). If a pair comes close to the limit, the problem is solved again with a larger multiple; otherwise the solution
/// does not depend on the limit. `problem` keeps the strengths of the last solve.
Solution solve_within(Problem& problem, const Start& start, const SolverOptions& options, double force) {
  const Vector cohesion = problem.cohesion, tension = problem.tension;
  const Eigen::Index d = problem.dimension;
  for (double most = 1e2 * force;; most *= 1e4) {
    bool cut = false;
    for (const auto& [whole, used] : {std::pair(&cohesion, &problem.cohesion), std::pair(&tension, &problem.tension)})
      for (Eigen::Index i = 0; i < whole->size(); ++i) {
        const bool here = most > 0.0 && (*whole)[i] > most && !std::isinf((*whole)[i]);
        (*used)[i] = here ? most : (*whole)[i];
        cut = cut || here;
      }
    Solution solution = solve(problem, start, options);
    bool near = solution.status != Status::solved;
    for (Eigen::Index i = 0; i < problem.pairs() && !near; ++i)
      near = (problem.cohesion_of(i) == most && solution.p.segment(d * i + 1, d - 1).norm() > 0.1 * most) ||
             (problem.tension_of(i) == most && -solution.p[d * i] > 0.1 * most);
    const bool hopeless = solution.status != Status::solved && most > 1e5 * force;
    if (!cut || !near || hopeless) return solution;
  }
}

bool remembers(const JointLaws& laws) {
  return std::any_of(laws.of_pair.begin(), laws.of_pair.end(), [](const auto& law) { return law->remembers(); });
}

History after(const History& from, const History& trial, const Ends& ends) {
  History history = trial;
  for (std::size_t i = 0; i < trial.size(); ++i) history[i].slip = from[i].slip + ends.of_pair[i].slip;
  return history;
}

}  // namespace

void set_limits(const JointLaws& laws, const History& history, Problem& problem) {
  const auto N = static_cast<Eigen::Index>(laws.of_pair.size());
  problem.mu.resize(N);
  problem.mu_backward.resize(0);
  problem.cohesion = problem.tension = Vector::Zero(N);
  Vector backward(N);
  bool directional = false;
  for (Eigen::Index i = 0; i < N; ++i) {
    const auto k = static_cast<std::size_t>(i);
    const Limits limits = laws.of_pair[k]->limits(history[k]);
    problem.mu[i] = limits.mu;
    backward[i] = limits.mu_backward.value_or(limits.mu);
    directional = directional || limits.mu_backward.has_value();
    problem.cohesion[i] = limits.cohesion * laws.area[i];
    problem.tension[i] = limits.tension * laws.area[i];
  }
  if (directional) problem.mu_backward = std::move(backward);
  if (problem.cohesion.isZero(0.0)) problem.cohesion.resize(0);
  if (problem.tension.isZero(0.0)) problem.tension.resize(0);
}

Evolution evolve(Problem problem, const JointLaws& laws, const History& from, const Start& start,
                 const SolverOptions& options) {
  ensure(laws.of_pair.size() == from.size(), "laws and histories of contact pairs differ in number");
  constexpr int gradual = 200;  // rounds in which no strength drops at once
  const bool with_memory = remembers(laws);
  Compliance compliance(problem);
  const Vector& diagonal = compliance.diagonal();
  Evolution result;
  History trial = from;
  Following following;
  std::vector<char> recovered(from.size(), 0);
  Start at = start;
  const int most = 4 * static_cast<int>(from.size()) + gradual;
  for (int quiet = 0; result.rounds < most && quiet < gradual;) {
    set_limits(laws, trial, problem);
    Solution solution = solve_within(problem, at, options, reference_force(problem, diagonal, at, options));
    ++result.rounds;
    result.solution = continued(std::move(result.solution), std::move(solution));
    const bool solved = result.solution.status == Status::solved;
    const Ends ends = solved ? ends_of(problem, result.solution, diagonal) : Ends{};
    const bool again = solved && with_memory && [&] {
      if (let_fall(laws, ends, problem.dimension, compliance, trial, recovered)) {
        following.forget();
        quiet = 0;
        return true;
      }
      ++quiet;
      return following.next(laws, from, ends, 0.1 * options.tolerance, trial);
    }();
    if (!again) {
      result.history = solved ? after(from, trial, ends) : from;
      result.problem = std::move(problem);
      return result;
    }
    at = {result.solution.p, result.solution.a, start.touching};
  }
  result.history = from;
  result.problem = std::move(problem);
  result.solution.status = Status::not_converged;
  result.solution.reason =
      "the failure states of the joints did not converge within " + std::to_string(result.rounds) + " iterations";
  return result;
}

std::optional<Vector> mechanism_once_broken(Problem problem, const JointLaws& laws, History history) {
  for (PairHistory& pair : history) pair.broken = true;
  set_limits(laws, history, problem);
  return find_mechanism(problem);
}

}  // namespace scabo::contact
