#include "scabo/contact/starts/sampled_problem.hpp"

#include <cmath>

#include "scabo/contact/pair_operator.hpp"

namespace scabo::contact {

namespace {

constexpr int of_pair = 2;  // components

/// Whether a sampled pair could stand for the next one: on the same joint, and both bonded or both not.
bool goes_on(const Problem& problem, const std::vector<int>& joints, Eigen::Index i) {
  return joints[static_cast<std::size_t>(i)] == joints[static_cast<std::size_t>(i + 1)] &&
         std::isinf(problem.tension_of(i)) == std::isinf(problem.tension_of(i + 1));
}

/// Every `step`-th pair of each run of pairs, the first and the last of the run included, and the hat functions.
void sample(const Problem& problem, const std::vector<int>& joints, Eigen::Index step, SampledProblem& sampled) {
  const Eigen::Index N = problem.pairs();
  sampled.before.resize(static_cast<std::size_t>(N));
  sampled.weight.assign(static_cast<std::size_t>(N), 1.0);
  for (Eigen::Index first = 0, last = 0; first < N; first = last + 1) {
    for (last = first; last + 1 < N && goes_on(problem, joints, last);) ++last;
    const Eigen::Index pieces = std::max<Eigen::Index>((last - first + step / 2) / step, last > first ? 1 : 0);
    for (Eigen::Index piece = 0; piece <= pieces; ++piece) {
      const auto at = static_cast<int>(sampled.pairs.size());
      const Eigen::Index begin = first + (pieces > 0 ? std::min(piece * step, last - first) : 0),
                         from = piece < pieces ? begin : last,
                         to = piece + 1 < pieces ? begin + step : last;  // the next sampled pair
      sampled.pairs.push_back(static_cast<int>(from));
      if (piece == pieces) {
        sampled.before[static_cast<std::size_t>(from)] = at;
        break;
      }
      for (Eigen::Index i = from; i < to; ++i) {
        sampled.before[static_cast<std::size_t>(i)] = at;
        sampled.weight[static_cast<std::size_t>(i)] = static_cast<double>(to - i) / static_cast<double>(to - from);
      }
    }
  }
  sampled.sum.setZero(static_cast<Eigen::Index>(sampled.pairs.size()));
  for (Eigen::Index i = 0; i < N; ++i) {
    const int at = sampled.before[static_cast<std::size_t>(i)];
    const double weight = sampled.weight[static_cast<std::size_t>(i)];
    sampled.sum[at] += weight;
    if (weight < 1.0) sampled.sum[at + 1] += 1.0 - weight;
  }
}

}  // namespace

Vector SampledProblem::spread(const Vector& p_sampled) const {
  const auto N = static_cast<Eigen::Index>(before.size());
  Vector p(of_pair * N);
  const auto share = [&](int at) { return p_sampled.segment<of_pair>(of_pair * at) / sum[at]; };
  for (Eigen::Index i = 0; i < N; ++i) {
    const int at = before[static_cast<std::size_t>(i)];
    const double phi = weight[static_cast<std::size_t>(i)];
    p.segment<of_pair>(of_pair * i) = phi * share(at);
    if (phi < 1.0) p.segment<of_pair>(of_pair * i) += (1.0 - phi) * share(at + 1);
  }
  return p;
}

std::optional<SampledProblem> sampled_problem(const Problem& problem, int most) {
  const PairHolder* const holder = problem.W.holder();
  if (holder == nullptr || problem.dimension != of_pair) return std::nullopt;
  const std::vector<int> joints = holder->joints();
  Eigen::Index step = (problem.pairs() + most - 1) / most;
  step += step % 2;  // of elements with nodes in the middle of their edges, the same nodes of each
  if (joints.size() != static_cast<std::size_t>(problem.pairs()) || step < 4) return std::nullopt;
  SampledProblem sampled;
  sample(problem, joints, step, sampled);
  std::vector<int> rows;
  for (const int pair : sampled.pairs) rows.insert(rows.end(), {of_pair * pair, of_pair * pair + 1});
  Matrix W = problem.W.is_dense() ? Matrix(problem.W.matrix()(rows, rows)) : holder->flexibility(rows);
  if (W.rows() != static_cast<Eigen::Index>(rows.size())) return std::nullopt;
  Problem& few = sampled.problem;
  few.W = Delassus(std::move(W)).scaled(problem.W.factor());
  few.q = problem.q(rows);
  few.mu = problem.mu(sampled.pairs);
  if (problem.mu_backward.size() > 0) few.mu_backward = problem.mu_backward(sampled.pairs);
  if (problem.cohesion.size() > 0) few.cohesion = problem.cohesion(sampled.pairs).cwiseProduct(sampled.sum);
  if (problem.tension.size() > 0) few.tension = problem.tension(sampled.pairs).cwiseProduct(sampled.sum);
  few.G = Matrix(problem.G.dense()(rows, Eigen::all));
  few.f = problem.f;
  return sampled;
}

}  // namespace scabo::contact
