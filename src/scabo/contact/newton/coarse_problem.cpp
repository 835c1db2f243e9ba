#include "scabo/contact/newton/coarse_problem.hpp"

#include <cmath>

#include "scabo/base/error.hpp"

namespace scabo::contact {

namespace {

constexpr Eigen::Index components = 2;
constexpr int none = -1;

/// The free pair with which pair i forms a group, or none. `root`: N, of the diagonal of W_nn; it lies far apart.
Eigen::Index neighbour_of(Eigen::Index i, const Problem& problem, const Vector& root, const std::vector<int>& group) {
  const Matrix& W = problem.W.matrix();
  const bool bonded = std::isinf(problem.tension_of(i));  // entries are compared: the factor of W does not count
  Eigen::Index nearest = none;
  double strongest = 0.0, most = 0.0;  // of all pairs, of the free pairs; times sqrt((W_nn)_ii)
  for (Eigen::Index j = 0; j < problem.pairs(); ++j) {
    if (j == i || !(root[j] > 0.0) || std::isinf(problem.tension_of(j)) != bonded) continue;
    const double coupling = W(components * j, components * i) / root[j];
    if (coupling > strongest) strongest = coupling;
    if (coupling > most && group[static_cast<std::size_t>(j)] == none) most = coupling, nearest = j;
  }
  return most >= 0.5 * strongest ? nearest : none;
}

/// Sets group and share; returns the number of groups.
int make_groups(const Problem& problem, CoarseProblem& coarse) {
  int groups = 0;
  Vector root(problem.pairs());
  for (Eigen::Index i = 0; i < problem.pairs(); ++i)
    root[i] = std::sqrt(std::max(problem.W.matrix()(components * i, components * i), 0.0));
  coarse.group.assign(static_cast<std::size_t>(problem.pairs()), none);
  coarse.share.setOnes(problem.pairs());
  for (Eigen::Index i = 0; i < problem.pairs(); ++i) {
    if (coarse.group[static_cast<std::size_t>(i)] != none) continue;
    coarse.group[static_cast<std::size_t>(i)] = groups;
    if (const Eigen::Index j = neighbour_of(i, problem, root, coarse.group); j != none) {
      coarse.group[static_cast<std::size_t>(j)] = groups;
      coarse.share[i] = coarse.share[j] = 0.5;
    }
    ++groups;
  }
  return groups;
}

/// The smallest strength of the members of each group; empty if the fine problem has none.
Vector weakest(const Vector& strength, const CoarseProblem& coarse, int groups) {
  if (strength.size() == 0) return {};
  Vector least = Vector::Constant(groups, HUGE_VAL);
  for (Eigen::Index i = 0; i < strength.size(); ++i) {
    double& of_group = least[coarse.group[static_cast<std::size_t>(i)]];
    of_group = std::min(of_group, strength[i] / coarse.share[i]);
  }
  return least;
}

}  // namespace

Vector CoarseProblem::prolong(const Vector& p_coarse) const {
  Vector p(components * share.size());
  for (Eigen::Index i = 0; i < share.size(); ++i)
    p.segment<components>(components * i) =
        share[i] * p_coarse.segment<components>(components * group[static_cast<std::size_t>(i)]);
  return p;
}

CoarseProblem coarse_problem(const Problem& problem) {
  ensure(problem.dimension == components && problem.W.is_dense(),
         "a coarse problem is made of a plane problem with dense W");
  const Matrix& W = problem.W.matrix();
  const Eigen::Index N = problem.pairs();
  CoarseProblem coarse;
  const int groups = make_groups(problem, coarse);
  Problem& small = coarse.problem;
  small.cohesion = weakest(problem.cohesion, coarse, groups);
  small.tension = weakest(problem.tension, coarse, groups);
  small.mu.setConstant(groups, HUGE_VAL);
  if (problem.mu_backward.size() > 0) small.mu_backward = small.mu;
  small.q.setZero(components * groups);
  Matrix G_small = Matrix::Zero(components * groups, problem.G.cols());
  small.f = problem.f;
  Matrix W_small = Matrix::Zero(components * groups, components * groups);
  for (Eigen::Index j = 0; j < N; ++j) {
    const Eigen::Index to = coarse.group[static_cast<std::size_t>(j)];
    const double share = coarse.share[j];
    small.mu[to] = std::min(small.mu[to], problem.mu[j]);
    if (problem.mu_backward.size() > 0) small.mu_backward[to] = std::min(small.mu_backward[to], problem.mu_backward[j]);
    small.q.segment<components>(components * to) += share * problem.q.segment<components>(components * j);
    G_small.middleRows<components>(components * to) += share * problem.G.dense().middleRows<components>(components * j);
    for (Eigen::Index i = 0; i < N; ++i)
      W_small.block<components, components>(components * coarse.group[static_cast<std::size_t>(i)], components * to) +=
          share * coarse.share[i] * W.block<components, components>(components * i, components * j);
  }
  W_small *= problem.W.factor();
  small.W = std::move(W_small);
  small.G = G_small;
  return coarse;
}

}  // namespace scabo::contact
