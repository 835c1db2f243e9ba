#include "compare/quadratic_programme.hpp"

#include <Eigen/Cholesky>
#include <Eigen/Eigenvalues>
#include <cmath>

namespace scabo::compare {

namespace {

/// Step for the forces of the active set: to the minimum on the set or, if it has none, along a force that causes no
/// motion and decreases the objective without limit.
struct Way {
  Vector d;
  bool endless = false;
};

Way way(const Matrix& W, const Vector& gradient) {
  const Eigen::LLT<Matrix> cholesky(W);
  if (cholesky.info() == Eigen::Success && cholesky.rcond() > 1e-13) {
    Vector d = -cholesky.solve(gradient);
    d -= cholesky.solve(gradient + W * d);
    return {d};
  }
  const Eigen::SelfAdjointEigenSolver<Matrix> eigen(W);
  const Vector& values = eigen.eigenvalues();
  const Vector parts = eigen.eigenvectors().transpose() * gradient;
  const double zero = 1e-12 * values[values.size() - 1];
  const Eigen::ArrayXd none = (values.array() > zero).select(0.0, parts.array());
  if (none.matrix().norm() > 1e-9 * gradient.norm()) return {-(eigen.eigenvectors() * none.matrix()), true};
  const Eigen::ArrayXd some = (values.array() > zero).select(parts.array() / values.array().max(zero), 0.0);
  return {-(eigen.eigenvectors() * some.matrix())};
}

Vector of_set(const Vector& v, const std::vector<Eigen::Index>& set) {
  Vector part(static_cast<Eigen::Index>(set.size()));
  for (std::size_t k = 0; k < set.size(); ++k) part[static_cast<Eigen::Index>(k)] = v[set[k]];
  return part;
}
Matrix of_set(const Matrix& M, const std::vector<Eigen::Index>& set) {
  const auto n = static_cast<Eigen::Index>(set.size());
  Matrix part(n, n);
  for (Eigen::Index k = 0; k < n; ++k)
    for (Eigen::Index l = 0; l < n; ++l)
      part(k, l) = M(set[static_cast<std::size_t>(k)], set[static_cast<std::size_t>(l)]);
  return part;
}

}  // namespace

End quadratic_programme(const Problem& problem, const Control& control) {
  const Eigen::Index d = problem.dimension, N = problem.pairs();
  const Matrix& W = problem.W.dense();
  std::vector<Eigen::Index> normals;
  for (Eigen::Index i = 0; i < N; ++i) normals.push_back(d * i);
  const Matrix W_nn = of_set(W, normals);
  const Vector q_n = of_set(problem.q, normals);
  const Vector r = W_nn.diagonal().cwiseMax(1e-14).cwiseInverse();
  End end;
  Vector p_n = Vector::Zero(N);
  std::vector<Eigen::Index> in;
  std::vector<bool> is_in(static_cast<std::size_t>(N), false);
  const auto finish = [&](std::string reason) {
    end.p = Vector::Zero(d * N);
    for (Eigen::Index i = 0; i < N; ++i) end.p[d * i] = p_n[i];
    const Vector H = residual_of(problem, pair_stiffness(problem), end.p, Vector());
    end.residual = largest(H);
    end.converged = end.residual <= control.small;
    if (!end.converged)
      end.reason = reason.empty()
                       ? "the active set is found, but rounding prevents an accurate solution of its equations"
                       : reason;
    return end;
  };
  while (true) {
    const Vector gap = q_n + W_nn * p_n;
    Eigen::Index enters = -1;
    double most = -0.5 * control.small;
    for (Eigen::Index i = 0; i < N; ++i)
      if (!is_in[static_cast<std::size_t>(i)] && r[i] * gap[i] < most) most = r[enters = i] * gap[i];
    end.trace.push_back(
        {end.iterations, enters < 0 ? 0.0 : -most, 0.5 * p_n.dot(gap + q_n), 1.0, 1, "quadratic_programme"});
    if (enters < 0) return finish("");
    if (++end.iterations > 10 * N + 100 || control.deadline.passed()) return finish("the active set did not settle");
    in.push_back(enters);
    is_in[static_cast<std::size_t>(enters)] = true;
    while (!in.empty()) {
      const Vector gradient = of_set(Vector(q_n + W_nn * p_n), in);
      const Way go = way(of_set(W_nn, in), gradient);
      double step = go.endless ? HUGE_VAL : 1.0;
      for (std::size_t k = 0; k < in.size(); ++k) {
        const double change = go.d[static_cast<Eigen::Index>(k)];
        if (change < 0.0) step = std::min(step, p_n[in[k]] / -change);
      }
      if (std::isinf(step)) return finish("no forces can close the gaps");
      for (std::size_t k = 0; k < in.size(); ++k) p_n[in[k]] += step * go.d[static_cast<Eigen::Index>(k)];
      if (step == 1.0 && !go.endless) break;
      std::vector<Eigen::Index> kept;
      const double zero = 1e-15 * largest(p_n);
      for (std::size_t k = 0; k < in.size(); ++k) {
        if (p_n[in[k]] > zero || go.d[static_cast<Eigen::Index>(k)] >= 0.0)
          kept.push_back(in[k]);
        else
          p_n[in[k]] = 0.0, is_in[static_cast<std::size_t>(in[k])] = false;
      }
      if (kept.size() == in.size()) break;
      in = std::move(kept);
    }
  }
}

}  // namespace scabo::compare
