#include "compare/fischer_burmeister.hpp"

#include <Eigen/LU>
#include <cmath>

namespace scabo::compare {

namespace {

/// L_x: x o y = L_x y.
LocalMatrix product_matrix(const Local& x) {
  const Eigen::Index d = x.size();
  LocalMatrix L = x[0] * LocalMatrix::Identity(d, d);
  L.row(0).tail(d - 1) = x.tail(d - 1).transpose();
  L.col(0).tail(d - 1) = x.tail(d - 1);
  return L;
}

/// z in the cone with z o z = w: spectral values w_0 +- |w_t|.
Local root(const Local& w) {
  const double length = w.tail(w.size() - 1).norm();
  const double upper = std::sqrt(std::max(w[0] + length, 0.0)), lower = std::sqrt(std::max(w[0] - length, 0.0));
  Local z = Local::Zero(w.size());
  z[0] = 0.5 * (upper + lower);
  if (length > 0.0) z.tail(w.size() - 1) = 0.5 * (upper - lower) / length * w.tail(w.size() - 1);
  return z;
}

struct SmoothedEquations {
  Vector F;     // dN + m
  Matrix A, B;  // d x dN: dF = A du + B dp of each pair
  double merit() const { return 0.5 * F.squaredNorm(); }
};

class Smoothed {
 public:
  Smoothed(const Problem& problem, double eps) : problem_(problem), r_(pair_stiffness(problem)), eps_(eps) {}

  SmoothedEquations at(const Vector& p, const Vector& a) const {
    const Eigen::Index d = problem_.dimension, N = problem_.pairs();
    const Vector motion = motion_of(problem_, p, a);
    SmoothedEquations result{Vector(d * N + a.size()), Matrix::Zero(d, d * N), Matrix::Zero(d, d * N)};
    for (Eigen::Index i = 0; i < N; ++i) pair(i, p.segment(d * i, d), motion.segment(d * i, d), result);
    if (a.size() > 0) result.F.tail(a.size()) = problem_.G.transpose() * p + problem_.f;
    return result;
  }

 private:
  void pair(Eigen::Index i, const Local& p, const Local& u, SmoothedEquations& to) const {
    const Eigen::Index d = problem_.dimension, t = d - 1;
    const double mu = problem_.mu[i], r = mu > 0.0 ? std::min(r_(0, i), r_(1, i)) : r_(0, i);
    auto F = to.F.segment(d * i, d);
    auto A = to.A.middleCols(d * i, d), B = to.B.middleCols(d * i, d);
    if (mu == 0.0) {
      const double y = r * u[0], z = std::sqrt(p[0] * p[0] + y * y + 2.0 * eps_ * eps_);
      F[0] = p[0] + y - z;
      B(0, 0) = z > 0.0 ? 1.0 - p[0] / z : 1.0;
      A(0, 0) = z > 0.0 ? r * (1.0 - y / z) : r;
      F.tail(t) = p.tail(t);
      B.bottomRightCorner(t, t).setIdentity();
      return;
    }
    const double eps_slip = eps_ / r, slip = std::sqrt(u.tail(t).squaredNorm() + eps_slip * eps_slip);
    Local x = p, y = r * mu * u;
    x[0] *= mu;
    y[0] = r * (u[0] + mu * (slip - eps_slip));
    LocalMatrix dx = LocalMatrix::Identity(d, d), dy = r * mu * LocalMatrix::Identity(d, d);
    dx(0, 0) = mu;
    dy(0, 0) = r;
    if (slip > 0.0) dy.topRightCorner(1, t) = r * mu / slip * u.tail(t).transpose();
    const LocalMatrix Lx = product_matrix(x), Ly = product_matrix(y);
    Local w = Lx * x + Ly * y;
    w[0] += 2.0 * eps_ * eps_;
    const Local z = root(w);
    F = x + y - z;
    const LocalMatrix Lz_inverse = product_matrix(z).inverse(), one = LocalMatrix::Identity(d, d);
    B = (one - Lz_inverse * Lx) * dx;
    A = (one - Lz_inverse * Ly) * dy;
  }

  const Problem& problem_;
  Matrix r_;
  double eps_;
};

/// J d = -F with J = [A W + B, A G; G', 0].
bool direction(const Problem& problem, const SmoothedEquations& at, Vector& step) {
  const Eigen::Index d = problem.dimension, N = problem.pairs(), n = d * N, m = problem.G.cols();
  const Matrix& W = problem.W.dense();
  for (double alpha : {0.0, 1e-10, 1e-6}) {  // W + alpha: redundant pairs
    Matrix J = Matrix::Zero(n + m, n + m);
    for (Eigen::Index i = 0; i < N; ++i) {
      const LocalMatrix A = at.A.middleCols(d * i, d);
      J.block(d * i, 0, d, n).noalias() = A * W.middleRows(d * i, d);
      J.block(d * i, d * i, d, d) += at.B.middleCols(d * i, d) + alpha * A;
      if (m > 0) J.block(d * i, n, d, m) = A * problem.G.dense().middleRows(d * i, d);
    }
    if (m > 0) J.block(n, 0, m, n) = problem.G.dense().transpose();
    const Eigen::PartialPivLU<Matrix> lu(J);
    step = lu.solve(-at.F);
    if (step.allFinite()) step += lu.solve(-at.F - J * step);
    if (step.allFinite() && (J * step + at.F).norm() <= 1e-6 * at.F.norm()) return true;
  }
  return false;
}

}  // namespace

End fischer_burmeister(const Problem& problem, Vector p, Vector a, const Control& control) {
  const Matrix r = pair_stiffness(problem);
  const Eigen::Index size = p.size();
  End end;
  Best best(end);
  std::vector<int> before;
  double step_length = 0.0;
  int stalled = 0;
  double eps = std::max(0.1 * largest(residual_of(problem, r, p, a)), 10.0 * control.small);
  while (true) {
    const double residual = largest(residual_of(problem, r, p, a));
    const SmoothedEquations now = Smoothed(problem, eps).at(p, a);
    const std::vector<int> states = states_at(problem, r, p, motion_of(problem, p, a));
    best.offer(p, a, residual);
    end.trace.push_back(
        {end.iterations, residual, now.merit(), step_length, changes(before, states), "fischer_burmeister"});
    before = states;
    end.converged = residual <= control.small;
    if (end.converged) return end;
    if (end.iterations >= 4 * control.iterations || control.deadline.passed()) {
      end.reason = "the limit of iterations was reached";
      return end;
    }
    Vector d;
    if (!direction(problem, now, d)) {
      end.reason = "the Jacobian is singular, so that there is no search direction";
      return end;
    }
    ++end.iterations;
    bool descended = false;
    for (step_length = 1.0; step_length > 1e-4; step_length *= 0.5) {
      const Vector p_next = p + step_length * d.head(size), a_next = a + step_length * d.tail(a.size());
      const SmoothedEquations next = Smoothed(problem, eps).at(p_next, a_next);
      if (!(next.merit() <= (1.0 - 2e-4 * step_length) * now.merit())) continue;
      p = p_next;
      a = a_next;
      descended = true;
      // Close enough to the path of solutions: reduce smoothing, more so after a good step.
      if (largest(next.F) <= eps) eps *= step_length == 1.0 ? 0.02 : 0.2;
      break;
    }
    stalled = descended ? 0 : stalled + 1;
    if (!descended) eps *= 0.1;
    if (stalled > 4) {
      end.reason = "no step along Newton's direction lowers the residual";
      return end;
    }
    eps = std::max(eps, 1e-3 * control.small);
  }
}

}  // namespace scabo::compare
