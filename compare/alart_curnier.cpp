#include "compare/alart_curnier.hpp"

#include <Eigen/LU>
#include <cmath>
#include <deque>

#include "compare/proximal_point.hpp"

namespace scabo::compare {

namespace {

/// F at a point with dF = A du + B dp for each pair (d x d blocks side by side).
struct Equations {
  Vector F;     // dN + m
  Matrix A, B;  // d x dN
  std::vector<int> states;
  double merit() const { return 0.5 * F.squaredNorm(); }
};

class AlartCurnier {
 public:
  AlartCurnier(const Problem& problem, const Vector* bound)
      : problem_(problem), bound_(bound), r_(pair_stiffness(problem)), W_(problem.W.dense()) {}

  const Matrix& r() const { return r_; }

  Equations at(const Vector& p, const Vector& a) const {
    const Eigen::Index d = problem_.dimension, N = problem_.pairs();
    const Vector motion = motion_of(problem_, p, a);
    Equations result{Vector(d * N + a.size()), Matrix::Zero(d, d * N), Matrix::Zero(d, d * N), {}};
    for (Eigen::Index i = 0; i < N; ++i) pair(i, p.segment(d * i, d), motion.segment(d * i, d), result);
    if (a.size() > 0) result.F.tail(a.size()) = problem_.G.transpose() * p + problem_.f;
    return result;
  }

  /// Solves J d = -F, with W + alpha in the Jacobian. Nothing if J is singular.
  bool direction(const Equations& at, double alpha, Vector& step) const {
    const Eigen::Index d = problem_.dimension, N = problem_.pairs(), m = problem_.G.cols();
    // Open pairs have dp = -F, which is moved to the right-hand side.
    std::vector<Eigen::Index> held;
    step = -at.F;
    for (Eigen::Index i = 0; i < N; ++i) {
      const bool free = at.A.middleCols(d * i, d).isZero(0.0) && at.B.middleCols(d * i, d).isIdentity(0.0);
      if (free) continue;
      step.segment(d * i, d).setZero();
      held.push_back(i);
    }
    const auto n = d * static_cast<Eigen::Index>(held.size());
    const Vector known = step.head(d * N), moved = problem_.W.times(known);
    Matrix J(n + m, n + m);
    Vector right(n + m);
    J.bottomRightCorner(m, m).setZero();
    for (Eigen::Index k = 0; k < n / d; ++k) {
      const Eigen::Index i = held[static_cast<std::size_t>(k)];
      const LocalMatrix A = at.A.middleCols(d * i, d), B = at.B.middleCols(d * i, d);
      for (Eigen::Index l = 0; l < n / d; ++l)
        J.block(d * k, d * l, d, d).noalias() = A * W_.block(d * i, d * held[static_cast<std::size_t>(l)], d, d);
      J.block(d * k, d * k, d, d) += B + alpha * A;
      right.segment(d * k, d) = -at.F.segment(d * i, d) - A * moved.segment(d * i, d);
      if (m == 0) continue;
      J.block(d * k, n, d, m) = A * problem_.G.dense().middleRows(d * i, d);
      J.block(n, d * k, m, d) = problem_.G.dense().middleRows(d * i, d).transpose();
    }
    if (m > 0) right.tail(m) = -at.F.tail(m) - problem_.G.transpose() * known;
    if (n + m == 0) return true;
    const Eigen::PartialPivLU<Matrix> lu(J);
    Vector solved = lu.solve(right);
    if (!solved.allFinite()) return false;
    solved += lu.solve(right - J * solved);
    if (!solved.allFinite() || (J * solved - right).norm() > 1e-6 * right.norm()) return false;
    for (Eigen::Index k = 0; k < n / d; ++k)
      step.segment(d * held[static_cast<std::size_t>(k)], d) = solved.segment(d * k, d);
    step.tail(m) = solved.tail(m);
    return true;
  }

 private:
  void pair(Eigen::Index i, const Local& p, const Local& u, Equations& to) const {
    const Eigen::Index d = problem_.dimension, t = d - 1;
    const PairLaw law = pair_law(problem_, i);
    const double r_n = r_(0, i), r_t = r_(1, i);
    LocalMatrix A = LocalMatrix::Zero(d, d), B = LocalMatrix::Zero(d, d);
    Local F(d);
    const bool contact = p[0] + law.tension > r_n * u[0];
    F[0] = contact ? r_n * u[0] : p[0] + law.tension;
    (contact ? A(0, 0) : B(0, 0)) = contact ? r_n : 1.0;

    const double s_n = contact ? p[0] - r_n * u[0] : -law.tension;  // augmented normal force
    const double bound = bound_ ? (*bound_)[i] : law.bound(s_n);
    const Local s = p.tail(t) - r_t * u.tail(t);
    const double length = s.norm();
    int state = contact ? 1 : 0;
    if (length <= bound && bound > 0.0) {
      F.tail(t) = r_t * u.tail(t);
      A.bottomRightCorner(t, t).diagonal().setConstant(r_t);
    } else {
      if (contact) state = 2;
      F.tail(t) = p.tail(t);
      B.bottomRightCorner(t, t).setIdentity();
      if (bound > 0.0) {
        const Local e = s / length;
        const LocalMatrix turn = bound / length * (LocalMatrix::Identity(t, t) - e * e.transpose());
        F.tail(t) -= bound * e;
        B.bottomRightCorner(t, t) -= turn;
        A.bottomRightCorner(t, t) += r_t * turn;
        if (!bound_ && contact && s_n > 0.0) {
          B.bottomLeftCorner(t, 1) -= law.mu * e;
          A.bottomLeftCorner(t, 1) += law.mu * r_n * e;
        }
      }
    }
    to.F.segment(d * i, d) = F;
    to.A.middleCols(d * i, d) = A;
    to.B.middleCols(d * i, d) = B;
    to.states.push_back(state);
  }

  const Problem& problem_;
  const Vector* bound_;
  Matrix r_;  // 2 x N
  const Matrix& W_;
};

}  // namespace

End alart_curnier(const Problem& problem, Vector p, Vector a, const Control& control, const Vector* bound) {
  const AlartCurnier newton(problem, bound);
  const Eigen::Index size = p.size();
  End end;
  Best best(end);
  if (!bound) end.iterations = start_softly(problem, p, a, control);
  Equations at = newton.at(p, a);
  std::deque<double> merits;  // of the last five points
  int unchecked = 0;          // full steps without descent
  double step_length = 0.0;
  std::vector<int> before = at.states;
  while (true) {
    const double residual = largest(at.F);
    best.offer(p, a, residual);
    end.trace.push_back(
        {end.iterations, residual, at.merit(), step_length, changes(before, at.states), "alart_curnier"});
    before = at.states;
    end.converged = residual <= control.small;
    if (end.converged) return end;
    if (end.iterations >= control.iterations || control.deadline.passed()) {
      end.reason = "the limit of iterations was reached";
      return end;
    }
    Vector d;
    bool found = false;
    for (double alpha : {0.0, 1e-10, 1e-6})
      if ((found = newton.direction(at, alpha, d))) break;
    if (!found) {
      end.reason = "the Jacobian is singular, so that there is no search direction";
      return end;
    }
    ++end.iterations;
    merits.push_back(at.merit());
    if (merits.size() > 5) merits.pop_front();
    const double ceiling = *std::max_element(merits.begin(), merits.end()), slope = 2.0 * at.merit();
    bool descended = false;
    for (step_length = 1.0; step_length > 1e-4; step_length *= 0.5) {
      Equations next = newton.at(p + step_length * d.head(size), a + step_length * d.tail(a.size()));
      if (!(next.merit() <= ceiling - 1e-4 * step_length * slope)) continue;
      at = std::move(next);
      descended = true;
      break;
    }
    if (!descended && ++unchecked > 5) {
      end.reason = "no step along Newton's direction lowers the residual";
      return end;
    }
    if (!descended) step_length = 1.0;  // a full step may pass a kink where no shorter step descends
    p += step_length * d.head(size);
    a += step_length * d.tail(a.size());
    if (!descended) at = newton.at(p, a);
  }
}

}  // namespace scabo::compare
