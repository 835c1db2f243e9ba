#include "scabo/contact/plane_interior_points.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <memory>
#include <utility>

#include "scabo/base/interruption.hpp"
#include "scabo/contact/b_differentiable.hpp"
#include "scabo/contact/joint_order.hpp"
#include "scabo/linalg/sparse_general_solver.hpp"

namespace scabo::contact {

namespace {

using Index = Eigen::Index;
using Array = Eigen::ArrayXd;
using Sparse = Eigen::SparseMatrix<double>;

constexpr double usual = 12.0;  // products of the start over the square of the mean friction bound
constexpr int most_steps = 80;
constexpr int patience = 6;                              // steps without a gain in |H| or in the products
constexpr double gain = 0.9;                             // of the least so far
constexpr double least_part = 0.98, most_part = 0.9995;  // of the way to the nearest boundary
constexpr int correctors = 6;                            // most, each a solve
constexpr double wanted = 0.3;                           // by which a corrector lengthens the step, at best; ...
constexpr double worth = 0.03;                           // ... and at least
constexpr double off = 10.0;  // products further from their middle than this factor are led back by correctors
// A second aim of the products, this part of the usual one, if the step is not shorter than this part of it.
constexpr double bolder = 0.1, as_long = 0.9;

}  // namespace

class PlaneInteriorPoints::Implementation {
  /// A change of everything.
  struct Direction {
    Array p_n, p_t, u_n, forward, backward;
    Vector a;
  };
  /// What a step is made with.
  struct Plan {
    Direction d;
    double target = 0.0;  ///< of the products
    double step = 0.0;
    double left = HUGE_VAL;  ///< of products and distances, over those of the present point
  };
  /// Products of the three factors of every pair.
  struct Products {
    Array normal, forward, backward;
  };

 public:
  Implementation(const Problem& problem, const Vector& p, const Vector& a, double start)
      : problem_(problem),
        equations_(problem, 1.0),
        N_(problem.pairs()),
        m_(problem.G.cols()),
        mu_(problem.mu.array()) {
    lay_out();
    a_ = a.cwiseQuotient(length_);
    p_n_.resize(N_), p_t_.resize(N_), u_n_.resize(N_), forward_.resize(N_), backward_.resize(N_);
    const Residual at = equations_.residual(p, a);
    double mean = 0.0;
    for (Index i = 0; i < N_; ++i) mean += std::abs(p[2 * i]) / static_cast<double>(N_);
    const double friction = mu_.mean();
    const double middle = usual * start * friction * friction * std::max(mean * mean, 1e-300);
    for (Index i = 0; i < N_; ++i) {
      const double r_n = equations_.r()[2 * i], r_t = equations_.r()[2 * i + 1];
      const auto [p_n, gap] = divided(p[2 * i] - r_n * at.motion[2 * i], r_n * middle);
      p_n_[i] = p_n, u_n_[i] = gap / r_n;
      const auto [s_plus, s_minus] =
          divided_bound(p[2 * i + 1] - r_t * at.motion[2 * i + 1], mu_[i] * p_n, r_t * middle);
      p_t_[i] = 0.5 * (s_plus - s_minus);
      forward_[i] = middle / s_plus, backward_[i] = middle / s_minus;
    }
  }

  InteriorPointEnd advance(double aim, const std::function<bool(const Vector&, const Vector&)>& content,
                           const Deadline& deadline) {
    InteriorPointEnd end;
    end.residual = HUGE_VAL;
    int since = 0;
    for (;; ++end.iterations, ++steps_) {
      interruption_point();
      const Vector p = forces(), a = a_.cwiseProduct(length_);
      const Residual at = equations_.residual(p, a);
      const double residual = at.largest() / std::max(p.lpNorm<Eigen::Infinity>(), 1e-300);
      if (!std::isfinite(residual)) break;
      evaluate(at.motion);
      ++since;
      if (middle_ <= gain * least_middle_ || residual <= gain * least_residual_) since = 0;
      least_middle_ = std::min(least_middle_, middle_);
      least_residual_ = std::min(least_residual_, residual);
      if (residual < end.residual) end.residual = residual, end.p = p, end.a = a;
      end.trace.push_back({end.iterations, at.largest(), at.merit(), step_, 0, "interior point"});
      if (content && content(p, at.motion)) {
        end.p = p, end.a = a;
        end.content = true;
        break;
      }
      if (residual <= aim || steps_ >= most_steps || since >= patience || deadline.passed() || !take_step()) break;
    }
    return end;
  }

 private:
  /// x, y > 0 with x - y = `difference` and x y = m.
  static std::pair<double, double> divided(double difference, double m) {
    const double larger = 0.5 * (std::abs(difference) + std::sqrt(difference * difference + 4.0 * m));
    return difference > 0.0 ? std::pair(larger, m / larger) : std::pair(m / larger, larger);
  }

  /// s+ and s- of a tangential force p_t = (s+ - s-) / 2 within `bound` = (s+ + s-) / 2 and slip v+ - v- with p_t - (v+
  /// - v-) = `difference`: what of a force is beyond the bound is slip. By bisection; it grows with p_t.
  static std::pair<double, double> divided_bound(double difference, double bound, double m) {
    double low = -bound, high = bound;
    for (int k = 0; k < 50; ++k) {
      const double p_t = 0.5 * (low + high);
      (p_t - m / (bound + p_t) + m / (bound - p_t) < difference ? low : high) = p_t;
    }
    const double p_t = 0.5 * (low + high), least = 1e-12 * bound;
    return {std::max(bound + p_t, least), std::max(bound - p_t, least)};
  }

  /// [W G; G' 0] with whole blocks on its diagonal, rigid motions of unit length.
  void lay_out() {
    G_ = m_ > 0 ? problem_.G.sparse() : Sparse(2 * N_, 0);
    length_.setOnes(m_);
    for (Index k = 0; k < m_; ++k) {
      const double size = G_.col(k).norm();
      if (size > 0.0) length_[k] = 1.0 / size;
      G_.col(k) *= length_[k];
    }
    f_ = m_ > 0 ? Vector(problem_.f.cwiseProduct(length_)) : Vector();
    const Sparse of_dense = problem_.W.is_sparse() ? Sparse() : Sparse(problem_.W.dense().sparseView());
    const Sparse& W = problem_.W.is_sparse() ? problem_.W.sparse() : of_dense;
    std::vector<Eigen::Triplet<double>> entries;
    entries.reserve(static_cast<std::size_t>(W.nonZeros() + 2 * G_.nonZeros() + 4 * N_));
    const auto add = [&](Index row, Index column, double value) {
      entries.emplace_back(static_cast<int>(row), static_cast<int>(column), value);
    };
    for (Index column = 0; column < 2 * N_; ++column) {
      for (Sparse::InnerIterator it(W, column); it; ++it) add(it.row(), column, it.value());
      for (Index k = 0; k < 2; ++k) add(column - column % 2 + k, column, 0.0);
    }
    for (Index k = 0; k < m_; ++k)
      for (Sparse::InnerIterator it(G_, k); it; ++it) {
        add(it.row(), 2 * N_ + k, it.value());
        add(2 * N_ + k, it.row(), it.value());
      }
    whole_.resize(2 * N_ + m_, 2 * N_ + m_);
    whole_.setFromTriplets(entries.begin(), entries.end());
    K_ = whole_;
    diagonal_.resize(static_cast<std::size_t>(N_));
    const double* const first = whole_.valuePtr();
    for (Index i = 0; i < N_; ++i)
      diagonal_[static_cast<std::size_t>(i)] = {&whole_.coeffRef(2 * i, 2 * i) - first,
                                                &whole_.coeffRef(2 * i + 1, 2 * i) - first,
                                                &whole_.coeffRef(2 * i + 1, 2 * i + 1) - first};
  }

  Array room_forward() const { return mu_ * p_n_ + p_t_; }  // s+
  Array room_backward() const { return mu_ * p_n_ - p_t_; }

  Vector forces() const {
    Vector p(2 * N_);
    for (Index i = 0; i < N_; ++i) p[2 * i] = p_n_[i], p[2 * i + 1] = p_t_[i];
    return p;
  }

  static double sum_of(const Products& products) {
    return products.normal.sum() + products.forward.sum() + products.backward.sum();
  }

  Products products(const Direction& d, double step) const {
    return {(p_n_ + step * d.p_n) * (u_n_ + step * d.u_n),
            (s_forward_ + step * (mu_ * d.p_n + d.p_t)) * (forward_ + step * d.forward),
            (s_backward_ + step * (mu_ * d.p_n - d.p_t)) * (backward_ + step * d.backward)};
  }

  /// `motion`: at the present forces.
  void evaluate(const Vector& motion) {
    s_forward_ = room_forward();
    s_backward_ = room_backward();
    distance_.resize(2 * N_);
    for (Index i = 0; i < N_; ++i) {
      distance_[2 * i] = motion[2 * i] - u_n_[i];
      distance_[2 * i + 1] = motion[2 * i + 1] - forward_[i] + backward_[i];
    }
    balance_ = m_ > 0 ? Vector(G_.transpose() * forces() + f_) : Vector();
    now_ = {p_n_ * u_n_, s_forward_ * forward_, s_backward_ * backward_};
    middle_ = sum_of(now_) / static_cast<double>(3 * N_);
  }

  bool factorise() {
    std::copy_n(whole_.valuePtr(), whole_.nonZeros(), K_.valuePtr());
    row_.setOnes(2 * N_ + m_);
    for (Index i = 0; i < N_; ++i) {
      const double plus = forward_[i] / s_forward_[i], minus = backward_[i] / s_backward_[i],
                   normal = u_n_[i] / p_n_[i];
      const auto& at = diagonal_[static_cast<std::size_t>(i)];
      K_.valuePtr()[at[0]] += normal;
      K_.valuePtr()[at[1]] += mu_[i] * (plus - minus);
      K_.valuePtr()[at[2]] += plus + minus;
      row_[2 * i] = 1.0 / (1.0 + normal);
      row_[2 * i + 1] = 1.0 / (1.0 + plus + minus);
    }
    for (Index k = 0; k < K_.nonZeros(); ++k) K_.valuePtr()[k] *= row_[K_.innerIndexPtr()[k]];
    return lu_.factorise(K_, [&] {
      std::vector<int> pair_of(static_cast<std::size_t>(2 * N_));
      for (std::size_t row = 0; row < pair_of.size(); ++row) pair_of[row] = static_cast<int>(row / 2);
      return JointOrder(problem_).blocks(pair_of);
    });
  }

  /// Of the equations linearised, with these changes of the products; distance and balance go to zero if `whole`.
  Direction direction(const Products& change, bool whole) const {
    Vector right(2 * N_ + m_), x, correction;
    for (Index i = 0; i < N_; ++i) {
      right[2 * i] = change.normal[i] / p_n_[i];
      right[2 * i + 1] = change.forward[i] / s_forward_[i] - change.backward[i] / s_backward_[i];
    }
    right.tail(m_).setZero();
    if (whole) {
      right.head(2 * N_) -= distance_;
      right.tail(m_) = -balance_;
    }
    right.array() *= row_.array();
    lu_.solve(right, x);
    right -= K_ * x;
    lu_.solve(right, correction);
    x += correction;
    Direction d;
    d.p_n.resize(N_), d.p_t.resize(N_);
    for (Index i = 0; i < N_; ++i) d.p_n[i] = x[2 * i], d.p_t[i] = x[2 * i + 1];
    d.a = x.tail(m_);
    d.u_n = (change.normal - u_n_ * d.p_n) / p_n_;
    d.forward = (change.forward - forward_ * (mu_ * d.p_n + d.p_t)) / s_forward_;
    d.backward = (change.backward - backward_ * (mu_ * d.p_n - d.p_t)) / s_backward_;
    return d;
  }

  /// The step to the nearest boundary.
  double reach(const Direction& d) const {
    const auto rate = [](const Array& x, const Array& dx) { return (-dx / x).maxCoeff(); };
    const double most =
        std::max({rate(p_n_, d.p_n), rate(u_n_, d.u_n), rate(s_forward_, mu_ * d.p_n + d.p_t),
                  rate(s_backward_, mu_ * d.p_n - d.p_t), rate(forward_, d.forward), rate(backward_, d.backward)});
    return most > 0.0 ? 1.0 / most : HUGE_VAL;
  }

  /// Towards products `target`, after the predictor `first` with its step, with as many correctors as are worth it.
  Plan plan(const Direction& first, double step, double target) const {
    Plan plan;
    plan.target = target;
    plan.d = direction({target - now_.normal - step * first.p_n * first.u_n,
                        target - now_.forward - step * (mu_ * first.p_n + first.p_t) * first.forward,
                        target - now_.backward - step * (mu_ * first.p_n - first.p_t) * first.backward},
                       true);
    double far = reach(plan.d);
    for (int k = 0; k < correctors && far < 1.0; ++k) {
      const Products then = products(plan.d, std::min(1.0, far + wanted));
      const auto back = [&](const Array& product) -> Array {
        return (product.max(target / off).min(off * target) - product).max(-off * target);
      };
      const Direction more = direction({back(then.normal), back(then.forward), back(then.backward)}, false);
      Direction both = plan.d;
      both.p_n += more.p_n, both.p_t += more.p_t, both.u_n += more.u_n;
      both.forward += more.forward, both.backward += more.backward, both.a += more.a;
      const double longer = reach(both);
      if (!(longer >= far + worth)) break;
      plan.d = std::move(both);
      far = longer;
    }
    plan.step = std::min(1.0, std::clamp(1.0 - target / middle_, least_part, most_part) * far);
    plan.left = sum_of(products(plan.d, plan.step)) / static_cast<double>(3 * N_) / middle_ + 1.0 - plan.step;
    return plan;
  }

  bool take_step() {
    if (!factorise()) return false;
    const Direction first = direction({-now_.normal, -now_.forward, -now_.backward}, true);
    const double predicted = std::min(1.0, reach(first));
    const double reached = std::max(sum_of(products(first, predicted)), 0.0) / static_cast<double>(3 * N_);
    const double target = std::pow(std::min(reached / middle_, 1.0), 3) * middle_;
    Plan best = plan(first, predicted, target), bold = plan(first, predicted, bolder * target);
    if (bold.step >= as_long * best.step && bold.left < best.left) best = std::move(bold);
    step_ = best.step;
    if (!std::isfinite(step_)) return false;
    const Direction& d = best.d;
    p_n_ += step_ * d.p_n, p_t_ += step_ * d.p_t, u_n_ += step_ * d.u_n;
    forward_ += step_ * d.forward, backward_ += step_ * d.backward, a_ += step_ * d.a;
    return true;
  }

  const Problem& problem_;
  BDifferentiableEquations equations_;
  Index N_, m_;
  Array mu_, p_n_, p_t_, u_n_, forward_, backward_, s_forward_, s_backward_;
  Vector a_, length_, f_, distance_, balance_, row_;
  Products now_;
  Sparse G_, whole_, K_;
  std::vector<std::array<Index, 3>> diagonal_;  // entries nn, tn and tt of every pair
  linalg::SparseGeneralSolver lu_;
  double middle_ = 0.0, step_ = 0.0, least_middle_ = HUGE_VAL, least_residual_ = HUGE_VAL;
  int steps_ = 0;
};

PlaneInteriorPoints::PlaneInteriorPoints(const Problem& problem, const Vector& p, const Vector& a, double start)
    : implementation_(std::make_unique<Implementation>(problem, p, a, start)) {}
PlaneInteriorPoints::~PlaneInteriorPoints() = default;

InteriorPointEnd PlaneInteriorPoints::advance(double aim,
                                              const std::function<bool(const Vector&, const Vector&)>& content,
                                              const Deadline& deadline) {
  return implementation_->advance(aim, content, deadline);
}

}  // namespace scabo::contact
