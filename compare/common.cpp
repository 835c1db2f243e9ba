#include "compare/common.hpp"

#include <cmath>

namespace scabo::compare {

PairLaw pair_law(const Problem& problem, Eigen::Index i) {
  PairLaw law;
  law.mu = problem.mu[i];
  if (problem.cohesion.size() > 0) law.cohesion = problem.cohesion[i];
  if (problem.tension.size() > 0) law.tension = problem.tension[i];
  return law;
}

Matrix pair_stiffness(const Problem& problem) {
  const Eigen::Index d = problem.dimension, N = problem.pairs();
  const Vector diagonal = problem.W.diagonal();
  const double mean = N > 0 && diagonal.mean() > 0.0 ? diagonal.mean() : 1.0;
  const auto inverse = [&](double w) { return 1.0 / (w > 1e-14 * mean ? w : mean); };
  Matrix r(2, N);
  for (Eigen::Index i = 0; i < N; ++i)
    r.col(i) << inverse(diagonal[d * i]), inverse(diagonal.segment(d * i + 1, d - 1).mean());
  return r;
}

Local project_on_disk(const Local& t, double bound) {
  const double length = t.norm();
  return length <= bound ? t : Local(t * (bound / length));
}

Vector residual_of(const Problem& problem, const Matrix& r, const Vector& p, const Vector& a) {
  const Eigen::Index d = problem.dimension, N = problem.pairs();
  const Vector motion = motion_of(problem, p, a);
  Vector H(d * N + a.size());
  for (Eigen::Index i = 0; i < N; ++i) {
    const PairLaw law = pair_law(problem, i);
    H[d * i] = std::min(r(0, i) * motion[d * i], p[d * i] + law.tension);
    const Local p_t = p.segment(d * i + 1, d - 1), slip = motion.segment(d * i + 1, d - 1);
    H.segment(d * i + 1, d - 1) = p_t - project_on_disk(p_t - r(1, i) * slip, law.bound(p[d * i]));
  }
  if (a.size() > 0) H.tail(a.size()) = problem.G.transpose() * p + problem.f;
  return H;
}

double largest(const Vector& v) {
  if (!v.allFinite()) return HUGE_VAL;
  return v.size() > 0 ? v.lpNorm<Eigen::Infinity>() : 0.0;
}

std::vector<int> states_at(const Problem& problem, const Matrix& r, const Vector& p, const Vector& motion) {
  const Eigen::Index d = problem.dimension;
  std::vector<int> states;
  for (Eigen::Index i = 0; i < problem.pairs(); ++i) {
    const PairLaw law = pair_law(problem, i);
    const Local trial = p.segment(d * i + 1, d - 1) - r(1, i) * motion.segment(d * i + 1, d - 1);
    if (p[d * i] + law.tension < r(0, i) * motion[d * i])
      states.push_back(0);
    else
      states.push_back(trial.norm() <= law.bound(p[d * i]) ? 1 : 2);
  }
  return states;
}

int changes(const std::vector<int>& before, const std::vector<int>& after) {
  int count = 0;
  for (std::size_t i = 0; i < after.size(); ++i) count += i >= before.size() || before[i] != after[i];
  return count;
}

}  // namespace scabo::compare
