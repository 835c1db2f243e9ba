#include "scabo/contact/interior/plane_interior_points.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <memory>
#include <utility>

#include "scabo/base/interruption.hpp"
#include "scabo/contact/newton/b_differentiable.hpp"
#include "scabo/contact/kkt/joint_order.hpp"
#include "scabo/contact/work.hpp"
#include "scabo/linalg/sparse_general_solver.hpp"

namespace scabo::contact {

namespace {

using Index = Eigen::Index;
using Array = Eigen::ArrayXd;
using Sparse = Eigen::SparseMatrix<double>;

constexpr double usual = 12.0;  // products of the start over the square of the mean friction bound
/// Of the largest coefficient. Pairs with less friction, or none, get so much; Newton's method follows with what they
/// have. Where no pair has friction, all get the square of it.
constexpr double least_friction = 1e-6;
/// Of the largest force of the start: strengths above, also those without limit, count as so much.
constexpr double largest_strength = 1e3;
constexpr int most_steps = 80;
constexpr int patience = 6;                              // steps without a gain in H or in the products
constexpr double gain = 0.9;                             // of the least so far
constexpr double whole = 0.85;                           // least step after which Newton's method may follow
constexpr double least_part = 0.98, most_part = 0.9995;  // of the way to the nearest boundary
constexpr int correctors = 6;                            // most, each a solve
constexpr double wanted = 0.3;                           // by which a corrector lengthens the step, at best; ...
constexpr double worth = 0.03;                           // ... and at least
constexpr double off = 10.0;  // products further from their middle than this factor are led back by correctors
/// Aims of the products, as parts of Mehrotra's: his is cautious where a few of ten thousand factors shorten the
/// predictor, which correctors and longer steps then pass.
constexpr std::array<double, 3> aims{1.0, 0.3, 0.1};
// A step shorter than `jammed`, and not one of the first few, is followed by factors divided anew, with products
// `wider`.
constexpr double jammed = 0.3, wider = 3.0;
constexpr int free_steps = 2, most_divided = 8;
// The residual from which steps are far from the solution. After so many steps those that are to be called short may be
// longer by this factor, and with such a residual all are slow.
constexpr double far_away = 5e-3;
constexpr int most_short = 5;
constexpr double slowly = 1.45, late_away = 1.5e-3;
// Parts of the factors that may go less far than the others, and how far: they keep at least 1 - `nearly` of what they
// are, or what gives this part of the usual product.
constexpr std::array<double, 7> shorter{1e-4, 3e-4, 1e-3, 3e-3, 1e-2, 3e-2, 1e-1};
constexpr double nearly = 0.98, usual_part = 0.1;
// Squares of what the linear equations lack count so much more than products.
constexpr double weight = 100.0;

}  // namespace

class PlaneInteriorPoints::Implementation {
  /// A change of everything. `normal`, `plus`, `minus`: of the first factors of the products.
  struct Direction {
    Array p_n, p_t, normal, plus, minus, u_n, forward, backward;
    Vector a;
  };
  /// What a step is made with.
  struct Plan {
    Direction d;
    double target = 0.0;  ///< of the products
    double step = 0.0;
  };
  /// Products of the three factors of every pair.
  struct Products {
    Array normal, forward, backward;
  };

 public:
  Implementation(const Problem& problem, const Vector& p, const Vector& a, double start)
      : problem_(problem), equations_(problem, 1.0), N_(problem.pairs()), m_(problem.G.cols()) {
    lay_out();
    a_ = a.cwiseQuotient(length_);
    p_n_.resize(N_), p_t_.resize(N_), u_n_.resize(N_), forward_.resize(N_), backward_.resize(N_);
    normal_.resize(N_), plus_.resize(N_), minus_.resize(N_);
    const double bound = take_strengths(p);
    divide(p, a, usual * start * std::max(bound * bound, 1e-300));
  }

  InteriorPointEnd advance(double aim, const IsSolution& content, const Deadline& deadline, const ShortSteps& shorter) {
    InteriorPointEnd end;
    end.residual = HUGE_VAL;
    int since = 0;
    for (;; ++end.iterations, ++steps_) {
      interruption_point();
      deadline.spend(operations_of_system(problem_));
      const Vector p = forces(), a = a_.cwiseProduct(length_);
      const Residual at = equations_.residual(p, a);
      const double mean = std::sqrt(at.merit() / static_cast<double>(N_));  // the merit is half of the sum
      const double residual = mean / std::max(p.lpNorm<Eigen::Infinity>(), 1e-300);
      if (!std::isfinite(residual)) break;
      rounding_ = mean_of(present());
      evaluate(at.motion);
      ++since;
      if (middle_ <= gain * least_middle_ || residual <= gain * least_residual_) since = 0;
      least_middle_ = std::min(least_middle_, middle_);
      least_residual_ = std::min(least_residual_, residual);
      if (residual < end.residual) end.residual = residual, end.p = p, end.a = a;
      if (steps_ == free_steps) early_p_ = p, early_a_ = a;
      end.trace.push_back({end.iterations, at.largest(), at.merit(), step_, 0, "interior point"});
      if (content && content(p, a, at.motion)) {
        end.p = p, end.a = a;
        end.content = true;
        break;
      }
      if (leads_on_slowly(residual, shorter)) {
        end.jammed = true;
        end.early_p = early_p_, end.early_a = early_a_;
        break;
      }
      if ((residual <= aim && step_ >= whole) || steps_ >= most_steps || since >= patience || deadline.passed() ||
          !take_step())
        break;
      if (++since_divided_ > free_steps && step_ < jammed && divided_again_ < most_divided) {
        divide_again();
        since = 0;
      }
    }
    return end;
  }

 private:
  /// Where something other than steps leads on sooner.
  bool leads_on_slowly(double residual, const ShortSteps& shorter) const {
    if (!(shorter.near > 0.0) || steps_ <= free_steps) return false;
    if (steps_ > most_short) return residual > late_away || step_ < slowly * shorter.near;
    return step_ < (residual > far_away ? shorter.far : shorter.near);
  }

  /// Coefficients, and strengths that the forces `p` suggest where they are none or all too large. Returns the mean
  /// friction bound.
  double take_strengths(const Vector& p) {
    double mean = 0.0, bound = 0.0;
    for (Index i = 0; i < N_; ++i) mean += std::abs(p[2 * i]) / static_cast<double>(N_);
    const double most = largest_strength * p.lpNorm<Eigen::Infinity>();
    const double least = least_friction * std::max(problem_.mu.maxCoeff(), least_friction);
    mu_.resize(N_), mu_backward_.resize(N_), cohesion_.resize(N_), tension_.resize(N_);
    for (Index i = 0; i < N_; ++i) {
      cohesion_[i] = std::min(problem_.cohesion_of(i), most);
      tension_[i] = std::min(problem_.tension_of(i), most);
      mu_[i] = std::max(problem_.mu_against(i, -1.0), least);
      mu_backward_[i] = std::max(problem_.mu_against(i, 1.0), least);
      bound += (0.5 * (mu_[i] + mu_backward_[i]) * mean + std::min(cohesion_[i], mean)) / static_cast<double>(N_);
    }
    return bound;
  }

  /// Factors from forces and motions, all products `middle`.
  void divide(const Vector& p, const Vector& a, double middle) {
    const Residual at = equations_.residual(p, a);
    for (Index i = 0; i < N_; ++i) {
      const double r_n = equations_.r()[2 * i], r_t = equations_.r()[2 * i + 1];
      const auto [normal, gap] = divided(p[2 * i] + tension_[i] - r_n * at.motion[2 * i], r_n * middle);
      p_n_[i] = normal - tension_[i], u_n_[i] = gap / r_n;
      const double pressure = pressure_of(i, middle).first, forth = cohesion_[i] + mu_[i] * pressure,
                   back = cohesion_[i] + mu_backward_[i] * pressure;
      p_t_[i] = divided_bound(p[2 * i + 1] - r_t * at.motion[2 * i + 1], forth, back, r_t * middle);
      const double s_least = 1e-12 * std::max(forth, back);
      const double s_plus = std::max(forth + p_t_[i], s_least), s_minus = std::max(back - p_t_[i], s_least);
      normal_[i] = normal, plus_[i] = s_plus, minus_[i] = s_minus;
      forward_[i] = middle / s_plus, backward_[i] = middle / s_minus;
    }
    since_divided_ = 0;
  }

  /// From the forces and motions of now. Where a step is short some factors are far smaller than their products ask
  /// for, and each step that follows ends at them.
  void divide_again() {
    const Vector p = forces(), a = a_.cwiseProduct(length_);
    evaluate(equations_.residual(p, a).motion);
    divide(p, a, wider * middle_);
    least_middle_ = HUGE_VAL;
    ++divided_again_;
  }

  /// x, y > 0 with x - y = `difference` and x y = m.
  static std::pair<double, double> divided(double difference, double m) {
    const double larger = 0.5 * (std::abs(difference) + std::sqrt(difference * difference + 4.0 * m));
    return difference > 0.0 ? std::pair(larger, m / larger) : std::pair(m / larger, larger);
  }

  /// A tangential force between -`forth` and `back` with slip v+ - v- such that p_t - (v+ - v-) = `difference`: what of
  /// a force is beyond its bounds is slip. By bisection; it grows with p_t.
  static double divided_bound(double difference, double forth, double back, double m) {
    double low = -forth, high = back;
    for (int k = 0; k < 50; ++k) {
      const double p_t = 0.5 * (low + high);
      (p_t - m / (forth + p_t) + m / (back - p_t) < difference ? low : high) = p_t;
    }
    return 0.5 * (low + high);
  }

  /// What of p_n presses, (p_n)+, and its derivative; where there is tensile strength rounded off at zero as much as
  /// products of this size round off the law.
  std::pair<double, double> pressure_of(Index i, double middle) const {
    if (tension_[i] == 0.0) return {p_n_[i], 1.0};
    const double root = std::sqrt(p_n_[i] * p_n_[i] + 4.0 * middle * equations_.r()[2 * i]);
    const double pressure =
        p_n_[i] > 0.0 ? 0.5 * (p_n_[i] + root) : 0.5 * (root * root - p_n_[i] * p_n_[i]) / (root - p_n_[i]);
    return {pressure, pressure / root};
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

  Vector forces() const {
    Vector p(2 * N_);
    for (Index i = 0; i < N_; ++i) p[2 * i] = p_n_[i], p[2 * i + 1] = p_t_[i];
    return p;
  }

  static double sum_of(const Products& products) {
    return products.normal.sum() + products.forward.sum() + products.backward.sum();
  }

  double mean_of(const Products& products) const { return sum_of(products) / static_cast<double>(3 * N_); }

  Products present() const { return {normal_ * u_n_, plus_ * forward_, minus_ * backward_}; }

  Products products(const Direction& d, double step) const {
    return {(normal_ + step * d.normal) * (u_n_ + step * d.u_n),
            (plus_ + step * d.plus) * (forward_ + step * d.forward),
            (minus_ + step * d.minus) * (backward_ + step * d.backward)};
  }

  /// `motion`: at the present forces.
  void evaluate(const Vector& motion) {
    off_normal_ = p_n_ + tension_ - normal_;
    off_plus_.resize(N_), off_minus_.resize(N_), forth_.resize(N_), back_.resize(N_);
    distance_.resize(2 * N_);
    for (Index i = 0; i < N_; ++i) {
      const auto [pressure, slope] = pressure_of(i, rounding_);
      off_plus_[i] = cohesion_[i] + mu_[i] * pressure + p_t_[i] - plus_[i];
      off_minus_[i] = cohesion_[i] + mu_backward_[i] * pressure - p_t_[i] - minus_[i];
      forth_[i] = mu_[i] * slope, back_[i] = mu_backward_[i] * slope;
      distance_[2 * i] = motion[2 * i] - u_n_[i];
      distance_[2 * i + 1] = motion[2 * i + 1] - forward_[i] + backward_[i];
    }
    balance_ = m_ > 0 ? Vector(G_.transpose() * forces() + f_) : Vector();
    now_ = present();
    middle_ = mean_of(now_);
  }

  bool factorise() {
    std::copy_n(whole_.valuePtr(), whole_.nonZeros(), K_.valuePtr());
    row_.setOnes(2 * N_ + m_);
    for (Index i = 0; i < N_; ++i) {
      const double plus = forward_[i] / plus_[i], minus = backward_[i] / minus_[i], normal = u_n_[i] / normal_[i];
      const auto& at = diagonal_[static_cast<std::size_t>(i)];
      K_.valuePtr()[at[0]] += normal;
      K_.valuePtr()[at[1]] += forth_[i] * plus - back_[i] * minus;
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

  /// Of the equations linearised, with these changes of the products. What the linear equations lack goes to zero if
  /// `whole`.
  Direction direction(Products change, bool whole) const {
    if (whole) {
      change.normal -= u_n_ * off_normal_;
      change.forward -= forward_ * off_plus_;
      change.backward -= backward_ * off_minus_;
    }
    Vector right(2 * N_ + m_), x, correction;
    for (Index i = 0; i < N_; ++i) {
      right[2 * i] = change.normal[i] / normal_[i];
      right[2 * i + 1] = change.forward[i] / plus_[i] - change.backward[i] / minus_[i];
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
    d.normal = d.p_n, d.plus = forth_ * d.p_n + d.p_t, d.minus = back_ * d.p_n - d.p_t;
    d.u_n = (change.normal - u_n_ * d.normal) / normal_;
    d.forward = (change.forward - forward_ * d.plus) / plus_;
    d.backward = (change.backward - backward_ * d.minus) / minus_;
    if (whole) d.normal += off_normal_, d.plus += off_plus_, d.minus += off_minus_;
    return d;
  }

  /// The step to the nearest boundary.
  double reach(const Direction& d) const {
    const auto rate = [](const Array& x, const Array& dx) { return (-dx / x).maxCoeff(); };
    const double most = std::max({rate(normal_, d.normal), rate(u_n_, d.u_n), rate(plus_, d.plus),
                                  rate(minus_, d.minus), rate(forward_, d.forward), rate(backward_, d.backward)});
    return most > 0.0 ? 1.0 / most : HUGE_VAL;
  }

  /// Towards products `target`, after the predictor `first` with its step, with as many correctors as are worth it.
  Plan plan(const Direction& first, double step, double target) const {
    Plan plan;
    plan.target = target;
    plan.d = direction({target - now_.normal - step * first.normal * first.u_n,
                        target - now_.forward - step * first.plus * first.forward,
                        target - now_.backward - step * first.minus * first.backward},
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
      both.normal += more.normal, both.plus += more.plus, both.minus += more.minus;
      both.forward += more.forward, both.backward += more.backward, both.a += more.a;
      const double longer = reach(both);
      if (!(longer >= far + worth)) break;
      plan.d = std::move(both);
      far = longer;
    }
    plan.step = std::min(1.0, std::clamp(1.0 - target / middle_, least_part, most_part) * far);
    return plan;
  }

  /// The plan after which least is left.
  bool take_step() {
    if (!factorise()) return false;
    const Direction first = direction({-now_.normal, -now_.forward, -now_.backward}, true);
    const double predicted = std::min(1.0, reach(first));
    const double reached = std::max(sum_of(products(first, predicted)), 0.0) / static_cast<double>(3 * N_);
    const double target = std::pow(std::min(reached / middle_, 1.0), 3) * middle_;
    std::array<Plan, aims.size()> plans;
    for (std::size_t k = 0; k < aims.size(); ++k) plans[k] = plan(first, predicted, aims[k] * target);
    const Point from = point();
    const double middle = middle_;
    Point best;
    double least = HUGE_VAL;
    for (const Plan& plan : plans) {
      if (!std::isfinite(plan.step)) continue;
      const double step = longest_step(plan, from, middle), left = left_after(plan, step, from, middle);
      if (left < least) least = left, best = point(), step_ = step;
    }
    if (least == HUGE_VAL) return false;
    set(best);
    return true;
  }

  /// What changes in a step.
  struct Point {
    Array p_n, p_t, normal, plus, minus, u_n, forward, backward;
    Vector a;
  };
  Point point() const { return {p_n_, p_t_, normal_, plus_, minus_, u_n_, forward_, backward_, a_}; }
  void set(const Point& at) {
    p_n_ = at.p_n, p_t_ = at.p_t, a_ = at.a;
    normal_ = at.normal, plus_ = at.plus, minus_ = at.minus;
    u_n_ = at.u_n, forward_ = at.forward, backward_ = at.backward;
  }

  /// The step `plan`.step ends where the first factor comes to its boundary. If a few go less far than the others, the
  /// others go further: the linear equations of those few are then not met, and the next step takes it. Of such steps
  /// the one after which least is left.
  double longest_step(const Plan& plan, const Point& from, double middle) {
    const Direction& d = plan.d;
    std::vector<double> rates;
    rates.reserve(static_cast<std::size_t>(6 * N_));
    const auto collect = [&](const Array& x, const Array& dx) {
      for (Index i = 0; i < N_; ++i) rates.push_back(-dx[i] / x[i]);
    };
    collect(from.normal, d.normal), collect(from.plus, d.plus), collect(from.minus, d.minus);
    collect(from.u_n, d.u_n), collect(from.forward, d.forward), collect(from.backward, d.backward);
    std::sort(rates.begin(), rates.end(), std::greater<>());
    std::vector<double> steps{plan.step};
    for (const double part : shorter) {
      const double rate = rates[static_cast<std::size_t>(part * static_cast<double>(rates.size()))];
      const double step = rate > nearly ? nearly / rate : 1.0;
      if (step > steps.back()) steps.push_back(step);
    }
    if (steps.back() < 1.0) steps.push_back(1.0);
    double least = HUGE_VAL, longest = plan.step;
    for (const double step : steps) {
      const double left = left_after(plan, step, from, middle);
      if (left < least || step == plan.step) least = left, longest = step;
    }
    return longest;
  }

  double left_after(const Plan& plan, double step, const Point& from, double middle) {
    set(from);
    take(plan, step, middle);
    return left_over();
  }

  /// This part of the way, but of factors that would leave their domain less.
  void take(const Plan& plan, double step, double middle) {
    const Direction& d = plan.d;
    p_n_ += step * d.p_n, p_t_ += step * d.p_t, a_ += step * d.a;
    const double product = usual_part * ((1.0 - step) * middle + step * plan.target);
    const auto go = [&](Array& x, const Array& dx, Array& y, const Array& dy) {
      for (Index i = 0; i < N_; ++i) {
        const double x_least = (1.0 - nearly) * x[i], y_least = (1.0 - nearly) * y[i];
        double x_new = x[i] + step * dx[i], y_new = y[i] + step * dy[i];
        if (step > plan.step) {
          const bool x_stops = x_new < x_least, y_stops = y_new < y_least;
          x_new = std::max(x_new, x_least), y_new = std::max(y_new, y_least);
          if (x_stops && !y_stops) x_new = std::max(x_new, std::min(x[i], product / y_new));
          if (y_stops && !x_stops) y_new = std::max(y_new, std::min(y[i], product / x_new));
        }
        x[i] = x_new, y[i] = y_new;
      }
    };
    go(normal_, d.normal, u_n_, d.u_n);
    go(plus_, d.plus, forward_, d.forward);
    go(minus_, d.minus, backward_, d.backward);
  }

  /// Products, and squares of what the linear equations lack as forces.
  double left_over() {
    evaluate(equations_.residual(forces(), a_.cwiseProduct(length_)).motion);
    const double lacks = off_normal_.square().sum() + off_plus_.square().sum() + off_minus_.square().sum() +
                         balance_.squaredNorm() + distance_.cwiseProduct(equations_.r()).squaredNorm();
    return weight * lacks + static_cast<double>(3 * N_) * middle_;
  }

  const Problem& problem_;
  BDifferentiableEquations equations_;
  Index N_, m_;
  // Forces, the factors of the products, and by how much p_n, s+ and s- differ from the first factors.
  Array mu_, mu_backward_, cohesion_, tension_, forth_, back_, p_n_, p_t_, normal_, plus_, minus_, u_n_, forward_,
      backward_, off_normal_, off_plus_, off_minus_;
  Vector early_p_, early_a_;  // after the free steps
  Vector a_, length_, f_, distance_, balance_, row_;
  Products now_;
  Sparse G_, whole_, K_;
  std::vector<std::array<Index, 3>> diagonal_;  // entries nn, tn and tt of every pair
  linalg::SparseGeneralSolver lu_;
  double rounding_ = 0.0;  ///< products by which (p_n)+ is rounded off in this step
  double middle_ = 0.0, step_ = 1.0, least_middle_ = HUGE_VAL, least_residual_ = HUGE_VAL;
  int steps_ = 0, since_divided_ = 0, divided_again_ = 0;
};

bool may_take_plane_interior_points(const Problem& problem) {
  constexpr Eigen::Index most_dense = 2500;  // a step then takes two seconds
  return problem.dimension == 2 && may_factorise_with_pairs(problem, most_dense);
}

PlaneInteriorPoints::PlaneInteriorPoints(const Problem& problem, const Vector& p, const Vector& a, double start)
    : implementation_(std::make_unique<Implementation>(problem, p, a, start)) {}
PlaneInteriorPoints::~PlaneInteriorPoints() = default;

InteriorPointEnd PlaneInteriorPoints::advance(double aim, const IsSolution& content, const Deadline& deadline,
                                              const ShortSteps& shorter) {
  return implementation_->advance(aim, content, deadline, shorter);
}

}  // namespace scabo::contact
