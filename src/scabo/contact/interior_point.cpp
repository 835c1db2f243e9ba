#include "scabo/contact/interior_point.hpp"

#include <algorithm>
#include <cmath>

#include "scabo/contact/judge.hpp"
#include "scabo/linalg/sparse_general_solver.hpp"

namespace scabo::contact {

namespace {

using Index = Eigen::Index;
using Sparse = Eigen::SparseMatrix<double>;

struct Constants {
  int iterations = 100;        ///< most; towers and walls that are solved take 11 to 90
  int patience = 5;            ///< steps without `gain` in the residual or in g: rounding, or steps that collapsed
  double gain = 0.9;           ///< of the least so far
  double part = 0.99;          ///< of the way to the boundary of the cones
  double collapsed = 0.1;      ///< a step shorter than this is replaced by one that leads back to the middle, ...
  double centring = 0.8;       ///< ... with this sigma and no correction
  double distance_lag = 10.0;  ///< |b| may fall so many times more slowly than g; beyond it ...
  double lagging = 0.9;        ///< ... sigma is at least this, so that y does not reach the boundary before the motions
  double settled = 1e-13;      ///< of |q'|: |b| below it is rounding
};
constexpr Constants constants;

/// What concerns one pair's cone of d components.
template <int d>
struct Cone {
  using V = Eigen::Matrix<double, d, 1>;
  using M = Eigen::Matrix<double, d, d>;
  static auto tangential(const V& x) { return x.template tail<d - 1>(); }

  static double determinant(const V& x) {
    const double t = tangential(x).norm();
    return (x[0] - t) * (x[0] + t);
  }

  static V product(const V& a, const V& b) {
    V c;
    c[0] = a.dot(b);
    c.template tail<d - 1>() = a[0] * tangential(b) + b[0] * tangential(a);
    return c;
  }

  /// x of l o x = b.
  static V quotient(const V& b, const V& l) {
    V x;
    x[0] = (l[0] * b[0] - tangential(l).dot(tangential(b))) / determinant(l);
    x.template tail<d - 1>() = (tangential(b) - x[0] * tangential(l)) / l[0];
    return x;
  }

  /// The largest a for which x + a dx is in the cone.
  static double reach(const V& x, const V& dx) {
    const double a = dx[0] * dx[0] - tangential(dx).squaredNorm(), c = determinant(x);
    const double b = x[0] * dx[0] - tangential(x).dot(tangential(dx)), discriminant = b * b - a * c;
    double most = dx[0] < 0.0 ? -x[0] / dx[0] : HUGE_VAL;
    if (discriminant < 0.0) return most;
    for (const double below : {-b + std::sqrt(discriminant), -b - std::sqrt(discriminant)}) {
      const double root = c / below;
      if (root > 0.0) most = std::min(most, root);
    }
    return most;
  }

  /// F and its inverse: F x = F^-1 y.
  static void scaling(const V& x, const V& y, M& F, M& F_inverse) {
    const double size_x = std::sqrt(determinant(x)), size_y = std::sqrt(determinant(y));
    const V x_unit = x / size_x, y_unit = y / size_y;
    V w = y_unit;
    w[0] += x_unit[0];
    w.template tail<d - 1>() -= tangential(x_unit);
    w /= 2.0 * std::sqrt(0.5 * (1.0 + x_unit.dot(y_unit)));
    const auto t = tangential(w).eval();
    w[0] = std::sqrt(1.0 + t.squaredNorm());
    const double eta = std::sqrt(size_y / size_x);
    F(0, 0) = w[0];
    F.template block<1, d - 1>(0, 1) = t.transpose();
    F.template block<d - 1, 1>(1, 0) = t;
    F.template block<d - 1, d - 1>(1, 1).setIdentity();
    F.template block<d - 1, d - 1>(1, 1) += t * t.transpose() / (1.0 + w[0]);
    F_inverse = F;
    F_inverse.template block<1, d - 1>(0, 1) *= -1.0;
    F_inverse.template block<d - 1, 1>(1, 0) *= -1.0;
    F *= eta;
    F_inverse /= eta;
  }
};

/// W with its pattern filled to whole blocks of d x d, those of the diagonal included.
template <int d>
Sparse in_whole_blocks(const Sparse& W) {
  const Index N = W.rows() / d;
  std::vector<Eigen::Triplet<double>> entries;
  entries.reserve(static_cast<std::size_t>(2 * W.nonZeros()));
  std::vector<Index> seen(static_cast<std::size_t>(N), -1);
  for (Index j = 0; j < N; ++j) {
    const auto fill = [&](Index i) {
      if (seen[static_cast<std::size_t>(i)] == j) return;
      seen[static_cast<std::size_t>(i)] = j;
      for (int k = 0; k < d * d; ++k)
        entries.emplace_back(static_cast<int>(d * i + k % d), static_cast<int>(d * j + k / d), 0.0);
    };
    fill(j);
    for (int k = 0; k < d; ++k)
      for (Sparse::InnerIterator at(W, d * j + k); at; ++at) {
        fill(at.row() / d);
        entries.emplace_back(static_cast<int>(at.row()), static_cast<int>(d * j + k), at.value());
      }
  }
  Sparse result(W.rows(), W.cols());
  result.setFromTriplets(entries.begin(), entries.end());
  return result;
}

template <int d>
class InteriorPoints {
  using C = Cone<d>;
  using V = typename C::V;
  using M = typename C::M;

 public:
  explicit InteriorPoints(const Problem& problem)
      : problem_(problem), N_(problem.pairs()), S_(d * N_), F_(blocks()), F_inverse_(blocks()), T_(blocks()) {
    const Vector diagonal = problem.W.diagonal();
    for (Index i = 0; i < N_; ++i) {
      S_.segment<d>(d * i).setConstant(std::sqrt(diagonal.segment<d>(d * i).mean()));
      S_[d * i] *= problem.mu[i];
    }
    W_ = in_whole_blocks<d>(problem.W.sparse());
    for (Index k = 0; k < W_.outerSize(); ++k)
      for (Sparse::InnerIterator at(W_, k); at; ++at) at.valueRef() /= S_[at.row()] * S_[k];
    q_ = problem.q.cwiseQuotient(S_);
    x_.setZero(d * N_);
    for (Index i = 0; i < N_; ++i) x_[d * i] = q_.template lpNorm<Eigen::Infinity>();
    y_ = x_;
  }

  InteriorPointEnd run(const std::function<bool(const Vector&, const Vector&)>& content, const Deadline& deadline) {
    InteriorPointEnd end;
    end.residual = HUGE_VAL;
    const Measure measure(problem_);
    double least_gap = HUGE_VAL;
    int since = 0;
    for (;; ++end.iterations) {
      evaluate();
      const Vector p = x_.cwiseQuotient(S_), motion = problem_.q + problem_.W * p;
      const double residual = measure.natural_map(problem_, p, motion);
      if (!std::isfinite(residual)) break;
      if (end.iterations == 0) first_gap_ = gap_, first_distance_ = distance_.norm();
      ++since;
      if (gap_ <= constants.gain * least_gap || residual <= constants.gain * end.residual) since = 0;
      least_gap = std::min(least_gap, gap_);
      if (residual < end.residual) end.residual = residual, end.p = p;
      end.trace.push_back({end.iterations, residual, 0.5 * gap_, step_, 0, "interior point"});
      if (content && content(p, motion)) {
        end.p = p;
        end.content = true;
        break;
      }
      if (end.iterations >= constants.iterations || since >= constants.patience || deadline.passed() || !advance())
        break;
    }
    return end;
  }

 private:
  std::size_t blocks() const { return static_cast<std::size_t>(N_); }
  V part(const Vector& v, Index i) const { return v.segment<d>(d * i); }

  void evaluate() {
    const Vector u = W_ * x_ + q_;
    distance_ = u - y_;
    for (Index i = 0; i < N_; ++i) {
      const auto u_t = u.segment<d - 1>(d * i + 1);
      const double slip = u_t.norm();
      distance_[d * i] += slip;
      M& T = T_[static_cast<std::size_t>(i)];
      T.setIdentity();
      if (slip > 0.0) T.template block<1, d - 1>(0, 1) = u_t.transpose() / slip;
    }
    gap_ = x_.dot(y_) / static_cast<double>(N_);
  }

  /// False where no step exists.
  bool advance() {
    lambda_.resize(d * N_);
    for (Index i = 0; i < N_; ++i) {
      const auto k = static_cast<std::size_t>(i);
      if (!(C::determinant(part(x_, i)) > 0.0 && C::determinant(part(y_, i)) > 0.0)) return false;
      C::scaling(part(x_, i), part(y_, i), F_[k], F_inverse_[k]);
      lambda_.segment<d>(d * i) = F_[k] * part(x_, i);
    }
    assemble();
    if (!lu_.factorise(K_)) return false;
    Vector affine(d * N_);
    for (Index i = 0; i < N_; ++i) affine.segment<d>(d * i) = -C::product(part(lambda_, i), part(lambda_, i));
    find_direction(affine);
    double step = std::min(1.0, reach());
    const double reached = (x_ + step * dx_).dot(y_ + step * dy_) / static_cast<double>(N_);
    double sigma = std::pow(std::clamp(reached / gap_, 0.0, 1.0), 3);
    const double size = distance_.norm();
    if (size * first_gap_ > constants.distance_lag * gap_ * first_distance_ && size > constants.settled * q_.norm())
      sigma = std::max(sigma, constants.lagging);
    Vector corrected = affine;
    for (Index i = 0; i < N_; ++i) {
      const auto k = static_cast<std::size_t>(i);
      const V second = C::product(F_inverse_[k] * part(dy_, i), F_[k] * part(dx_, i));
      corrected.segment<d>(d * i) -= step * second;
      corrected[d * i] += sigma * gap_;
    }
    find_direction(corrected);
    step = reach();
    if (step < constants.collapsed) {
      for (Index i = 0; i < N_; ++i) affine[d * i] += constants.centring * gap_;
      find_direction(affine);
      step = reach();
    }
    step_ = std::min(1.0, constants.part * step);
    x_ += step_ * dx_;
    y_ += step_ * dy_;
    return std::isfinite(step_);
  }

  /// K = I + F^-1 T W' F^-1, by block columns.
  void assemble() {
    K_ = W_;
    for (Index j = 0; j < N_; ++j) {
      const int first = K_.outerIndexPtr()[d * j], rows = K_.outerIndexPtr()[d * j + 1] - first;
      Eigen::Map<Eigen::Matrix<double, Eigen::Dynamic, d>> column(K_.valuePtr() + first, rows, d);
      for (int at = 0; at < rows; at += d) {
        const Index i = K_.innerIndexPtr()[first + at] / d;
        const auto k = static_cast<std::size_t>(i);
        const M block = column.template middleRows<d>(at);
        column.template middleRows<d>(at) = F_inverse_[k] * T_[k] * block * F_inverse_[static_cast<std::size_t>(j)];
        if (i == j) column.template middleRows<d>(at) += M::Identity();
      }
    }
  }

  void find_direction(const Vector& right) {
    Vector b(d * N_);
    for (Index i = 0; i < N_; ++i)
      b.segment<d>(d * i) =
          C::quotient(part(right, i), part(lambda_, i)) - F_inverse_[static_cast<std::size_t>(i)] * part(distance_, i);
    Vector z, correction;
    lu_.solve(b, z);
    b -= K_ * z;  // once refined: the last digits of the forces hang on it
    lu_.solve(b, correction);
    z += correction;
    dx_.resize(d * N_);
    for (Index i = 0; i < N_; ++i) dx_.segment<d>(d * i) = F_inverse_[static_cast<std::size_t>(i)] * part(z, i);
    dy_ = W_ * dx_;
    for (Index i = 0; i < N_; ++i) {
      const V turned = T_[static_cast<std::size_t>(i)] * part(dy_, i);
      dy_.segment<d>(d * i) = turned + part(distance_, i);
    }
  }

  double reach() const {
    double most = HUGE_VAL;
    for (Index i = 0; i < N_; ++i)
      most = std::min({most, C::reach(part(x_, i), part(dx_, i)), C::reach(part(y_, i), part(dy_, i))});
    return most;
  }

  const Problem& problem_;
  Index N_;
  Vector S_, q_, x_, y_, dx_, dy_, lambda_, distance_;
  Sparse W_, K_;
  std::vector<M> F_, F_inverse_, T_;
  linalg::SparseGeneralSolver lu_;
  double gap_ = 0.0, first_gap_ = 0.0, first_distance_ = 0.0, step_ = 0.0;
};

}  // namespace

bool may_take_interior_points(const Problem& problem) {
  return problem.pairs() > 0 && problem.G.cols() == 0 && problem.cohesion.size() == 0 && problem.tension.size() == 0 &&
         problem.W.is_sparse() && problem.mu.minCoeff() > 0.0 && problem.W.diagonal().minCoeff() > 0.0 &&
         !problem.q.isZero(0.0);
}

InteriorPointEnd interior_points(const Problem& problem,
                                 const std::function<bool(const Vector& p, const Vector& motion)>& content,
                                 const Deadline& deadline) {
  return problem.dimension == 3 ? InteriorPoints<3>(problem).run(content, deadline)
                                : InteriorPoints<2>(problem).run(content, deadline);
}

}  // namespace scabo::contact
