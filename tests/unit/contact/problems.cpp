#include "unit/contact/problems.hpp"

#include <algorithm>
#include <cmath>

#include "scabo/contact/sweeps/gauss_seidel.hpp"

namespace scabo::test {

Matrix elastic_flexibility(std::mt19937& random, int pairs, double size, int d) {
  const double reach = uniform(random, 0.5, 4.0), coupling = uniform(random, 0.0, 0.5);
  Matrix S = Matrix::Zero(d * pairs, d * pairs);
  for (int i = 0; i < pairs; ++i)
    for (int j = 0; j < pairs; ++j) {
      Matrix block = Matrix::Identity(d, d);
      block += coupling * Matrix::NullaryExpr(d, d, [&] { return uniform(random, -1, 1); });
      S.block(d * i, d * j, d, d) = std::exp(-std::abs(i - j) / reach) * block;
    }
  const Matrix W = S * S.transpose();
  return size / W.diagonal().mean() * W;
}

Vector mixed_motion(std::mt19937& random, int pairs, double size, int d) {
  Vector q(d * pairs);
  const double shift = uniform(random, -0.5, 0.5);
  for (int i = 0; i < d * pairs; ++i) {
    q[i] = size * (uniform(random, -1, 1) + (i % d == 0 ? shift : 0.0));
    if (whole(random, 0, 9) == 0) q[i] = 0.0;
  }
  return q;
}

contact::Problem held_problem(std::mt19937& random, int pairs, double most_friction, int d) {
  contact::Problem problem;
  problem.dimension = d;
  problem.W = elastic_flexibility(random, pairs, 1.0, d);
  problem.q = mixed_motion(random, pairs, 1.0, d);
  const double friction = whole(random, 0, 5) == 0 ? 0.0 : uniform(random, 0.0, most_friction);
  problem.mu = Vector::Constant(pairs, friction);
  problem.G.resize(d * pairs, 0);
  return problem;
}

Matrix block_motions(int pairs, double width, double height) {
  Matrix G(2 * pairs, 3);
  for (int i = 0; i < pairs; ++i) {
    const double x = pairs > 1 ? width * (static_cast<double>(i) / (pairs - 1) - 0.5) : 0.0, L = 0.5 * width;
    G.row(2 * i) << 0.0, 1.0, x / L;
    G.row(2 * i + 1) << 1.0, 0.0, height / L;
  }
  return G;
}

contact::Problem floating_problem(std::mt19937& random, int pairs, double most_friction) {
  contact::Problem problem = held_problem(random, pairs, most_friction);
  const int m = whole(random, 1, 3);
  const Matrix G = block_motions(pairs, 2.0, uniform(random, 0.1, 1.0));
  const double weight = uniform(random, 0.1, 2.0) * pairs;
  const Eigen::Vector3d f(weight * problem.mu[0] * uniform(random, -1.2, 1.2), -weight,
                          weight * uniform(random, -0.6, 0.6));
  const std::vector<int> motions = m == 1   ? std::vector<int>{1}
                                   : m == 2 ? std::vector<int>{0, 1}
                                            : std::vector<int>{0, 1, 2};
  problem.G = G(Eigen::all, motions);
  problem.f = f(motions);
  return problem;
}

double violation(const contact::Problem& problem, const Vector& p, const Vector& a) {
  Vector motion = problem.q + problem.W * p;
  if (a.size() > 0) motion += problem.G * a;
  const double scale =
      std::max(p.size() > 0 ? p.cwiseAbs().maxCoeff() : 0.0, std::max(problem.q.cwiseAbs().maxCoeff(), 1e-300));
  double worst = 0.0;
  const Eigen::Index d = problem.dimension;
  for (Eigen::Index i = 0; i < problem.pairs(); ++i) {
    const double g = motion[d * i], pn = p[d * i];
    const Vector slip = motion.segment(d * i + 1, d - 1), friction = p.segment(d * i + 1, d - 1);
    const double ds = slip.norm(), pt = friction.norm();
    const double cohesion = problem.cohesion_of(i), tension = problem.tension_of(i);
    if (std::isinf(tension)) {  // bonded
      worst = std::max({worst, std::abs(g), ds});
      continue;
    }
    worst = std::max({worst, -g, -(pn + tension), std::min(std::abs(g), std::abs(pn + tension))});
    if (problem.mu_backward.size() > 0 || cohesion > 0.0) {
      // -c - mu_f (p_n)+ <= p_t <= c + mu_b (p_n)+, forward slip at the lower end, backward at the upper
      const double pressure = cohesion > 0.0 ? std::max(pn, 0.0) : pn;
      const double low = friction[0] + cohesion + problem.mu_against(i, -1.0) * pressure,
                   high = cohesion + problem.mu_against(i, 1.0) * pressure - friction[0];
      worst = std::max({worst, -low, -high, std::min(ds, std::abs(slip[0] > 0.0 ? low : high))});
      continue;
    }
    const double bound = problem.mu[i] * pn, to_bound = bound - pt;
    worst = std::max({worst, -to_bound, std::min(ds, std::abs(to_bound))});
    if (ds > 1e-7 * scale && pt > 1e-7 * scale && slip.dot(friction) > -(1.0 - 1e-9) * ds * pt)
      worst = scale;  // friction opposes slip
  }
  if (a.size() > 0) worst = std::max(worst, (problem.G.transpose() * p + problem.f).cwiseAbs().maxCoeff());
  return worst / scale;
}

Vector swept_forces(const contact::Problem& problem, int sweeps) {
  Vector p = Vector::Zero(problem.q.size());
  const std::unique_ptr<contact::GaussSeidel> pairs = contact::gauss_seidel(problem, false);
  pairs->start(p);
  for (int sweep = 0; sweep < sweeps; ++sweep)
    if (pairs->sweep(p) <= 1e-12 * p.lpNorm<Eigen::Infinity>()) break;
  return p;
}

}  // namespace scabo::test
