#include "scabo/contact/gauss_seidel.hpp"

#include <algorithm>
#include <cmath>

namespace scabo::contact {

namespace {

/// A pair's own problem in space; the plane is its special case without the second tangent.
struct Local {
  double W_nn;
  Vec2 W_nt, W_tn;
  Mat2 W_tt;
  double u_n;
  Vec2 u_t;  ///< without the pair's own force
  double mu, cohesion, tension;
};

Local local_of(const double* W, int d, const double* free, double mu, double cohesion, double tension) {
  Local pair{W[0], Vec2::Zero(), Vec2::Zero(), Mat2::Identity(), free[0], Vec2::Zero(), mu, cohesion, tension};
  for (int k = 1; k < d; ++k) {
    pair.W_nt[k - 1] = W[d * k];
    pair.W_tn[k - 1] = W[k];
    pair.u_t[k - 1] = free[k];
    for (int j = 1; j < d; ++j) pair.W_tt(j - 1, k - 1) = W[d * k + j];
  }
  if (d == 2) pair.W_tt(1, 1) = pair.W_tt(0, 0) > 0.0 ? pair.W_tt(0, 0) : 1.0;
  return pair;
}

/// Tangential force for the resistance s: (A + s) p_t = -c, of at most the size of -c / s.
Vec2 tangential(const Mat2& A, const Vec2& c, double s) {
  const double a = A(0, 0) + s, b = A(1, 1) + s, determinant = a * b - A(0, 1) * A(1, 0);
  return Vec2(-b * c[0] + A(0, 1) * c[1], A(1, 0) * c[0] - a * c[1]) / determinant;
}

Eigen::Vector3d force_of(const Local& pair) {
  const Eigen::Vector3d open(0.0, 0.0, 0.0);
  const bool bonded = std::isinf(pair.tension);
  const auto with_normal_at = [&](double p_n) {  // open at full tension, cohesion still holds the tangent
    if (pair.cohesion == 0.0) return Eigen::Vector3d(p_n, 0.0, 0.0);
    const Vec2 c = pair.u_t + pair.W_tn * p_n;
    Vec2 p_t = tangential(pair.W_tt, c, 0.0);
    if (p_t.norm() > pair.cohesion) p_t *= pair.cohesion / p_t.norm();
    return Eigen::Vector3d(p_n, p_t[0], p_t[1]);
  };
  if (pair.W_nn <= 0.0) return open;
  if (!bonded && pair.u_n - pair.W_nn * pair.tension >= 0.0) return with_normal_at(-pair.tension);
  if (pair.mu == 0.0 && pair.cohesion == 0.0) return {-pair.u_n / pair.W_nn, 0.0, 0.0};
  // p_n from u_n = 0; what is left for the tangent: u_t = A p_t + c.
  const Mat2 A = pair.W_tt - pair.W_tn * pair.W_nt.transpose() / pair.W_nn;
  const Vec2 c = pair.u_t - pair.W_tn * pair.u_n / pair.W_nn;
  const auto normal = [&](const Vec2& p_t) { return -(pair.u_n + pair.W_nt.dot(p_t)) / pair.W_nn; };
  const auto excess = [&](const Vec2& p_t) {
    return p_t.norm() - pair.cohesion - pair.mu * std::max(normal(p_t), 0.0);
  };
  const double scale = pair.W_tt.trace();
  if (!(scale > 0.0)) return {-pair.u_n / pair.W_nn, 0.0, 0.0};
  if (A(0, 0) * A(1, 1) - A(0, 1) * A(1, 0) > 1e-14 * scale * scale) {
    const Vec2 stick = tangential(A, c, 0.0);
    if (normal(stick) >= -pair.tension && excess(stick) <= 0.0) return {normal(stick), stick[0], stick[1]};
  }
  // Slip: u_t = -s p_t, excess(s) = 0; at s -> infinity it is negative.
  double low = 0.0, high = scale;
  Vec2 at_high = tangential(A, c, high);
  for (int k = 0; k < 60 && excess(at_high) > 0.0; ++k) {
    low = high;
    high *= 4.0;
    at_high = tangential(A, c, high);
  }
  double f_high = excess(at_high);
  double f_low = excess(tangential(A, c, std::max(low, 1e-14 * scale)));
  if (!(f_low > 0.0)) return {std::max(normal(at_high), -pair.tension), at_high[0], at_high[1]};
  Vec2 p_t = at_high;
  for (int k = 0; k < 60; ++k) {
    double s = (low * f_high - high * f_low) / (f_high - f_low);
    if (!(s > low && s < high)) s = 0.5 * (low + high);
    p_t = tangential(A, c, s);
    const double f = excess(p_t);
    if (std::abs(f) <= 1e-15 * (p_t.norm() + pair.cohesion) || high - low <= 1e-16 * high) break;
    if (f > 0.0) {
      low = s, f_low = f;
      if (k % 3 != 0) f_high *= 0.5;  // Illinois: keeps the bracket moving at both ends
    } else {
      high = s, f_high = f;
      if (k % 3 != 0) f_low *= 0.5;
    }
  }
  return {normal(p_t), p_t[0], p_t[1]};
}

}  // namespace

Vector local_force(const Matrix& W, const Vector& free, double mu, double cohesion, double tension) {
  const auto d = static_cast<int>(free.size());
  return force_of(local_of(W.data(), d, free.data(), mu, cohesion, tension)).head(d);
}

GaussSeidel::GaussSeidel(const Problem& problem)
    : problem_(problem), blocks_(problem.W.diagonal_blocks(problem.dimension)) {}

void GaussSeidel::start(const Vector& p) { motion_ = problem_.q + problem_.W * p; }

double GaussSeidel::sweep(Vector& p) {
  const int d = problem_.dimension;
  const bool sparse = problem_.W.is_sparse();
  const Matrix* dense = sparse ? nullptr : &problem_.W.dense();
  double change = 0.0;
  for (Eigen::Index i = 0; i < problem_.pairs(); ++i) {
    const double* W = blocks_.data() + d * d * i;
    double free[3];
    for (int k = 0; k < d; ++k) {
      free[k] = motion_[d * i + k];
      for (int j = 0; j < d; ++j) free[k] -= W[d * j + k] * p[d * i + j];
    }
    const Eigen::Vector3d next =
        force_of(local_of(W, d, free, problem_.mu[i], problem_.cohesion_of(i), problem_.tension_of(i)));
    for (int k = 0; k < d; ++k) {
      const double step = next[k] - p[d * i + k];
      if (step == 0.0 || !std::isfinite(step)) continue;
      p[d * i + k] = next[k];
      change = std::max(change, std::abs(step));
      if (sparse) {
        for (Eigen::SparseMatrix<double>::InnerIterator it(problem_.W.sparse(), d * i + k); it; ++it)
          motion_[it.row()] += it.value() * step;
      } else {
        motion_.noalias() += dense->col(d * i + k) * step;
      }
    }
  }
  return change;
}

Vector gauss_seidel(const Problem& problem, Vector p, int sweeps) {
  GaussSeidel iteration(problem);
  iteration.start(p);
  for (int sweep = 0; sweep < sweeps; ++sweep)
    if (iteration.sweep(p) <= 1e-12 * p.lpNorm<Eigen::Infinity>()) break;
  return p;
}

}  // namespace scabo::contact
