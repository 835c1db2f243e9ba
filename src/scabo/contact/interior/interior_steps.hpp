// Steps of interior points for Coulomb's law (interior_point.hpp): cones, scaling, linear systems, direction and step.
// What is done with them, and where they end: interior_point.cpp, held_slips.cpp.
#pragma once

#include <algorithm>
#include <cmath>
#include <functional>
#include <optional>
#include <utility>
#include <vector>

#include "scabo/contact/interior/interior_point.hpp"
#include "scabo/contact/kkt/joint_system.hpp"
#include "scabo/contact/judge.hpp"
#include "scabo/linalg/sparse_general_solver.hpp"

namespace scabo::contact {

/// Of the steps.
struct InteriorConstants {
  double part = 0.95;          ///< of the way to the boundary of the cones
  double collapsed = 0.1;      ///< a step shorter than this is replaced by one that leads back to the middle, ...
  double centring = 0.8;       ///< ... with this sigma and no correction
  double distance_lag = 10.0;  ///< |(b, g)| may fall so many times more slowly than m; ...
  double lagging = 0.9;  ///< ... beyond it sigma is at least this: y must not reach the boundary before the motions
  double small_scaling = 1.0;   ///< phi below which y' is computed from x'
  double least_of_mean = 1e-6;  ///< of the mean W_ii: least by which a pair is scaled
  double settled = 1e-13;       ///< of |(q', f)|: |(b, g)| below it is rounding
};
inline constexpr InteriorConstants interior_constants;

/// What concerns one pair's cone K, in coordinates in which it is easily described.
template <int d>
struct InteriorCone;

/// In the plane K is the angle between two rays: with the components along them as coordinates it is the quadrant of
/// positive numbers, and x o y = (x_1 y_1, x_2 y_2).
template <>
struct InteriorCone<2> {
  using V = Eigen::Vector2d;
  using M = Eigen::Matrix2d;
  /// Coordinates of [normal, tangent], and back: the matrix is its own inverse.
  static M frame() {
    M rays;
    rays << 1.0, 1.0, 1.0, -1.0;
    return rays / std::sqrt(2.0);
  }
  static V normal() { return frame().col(0); }
  static V tangential(const V& v) { return frame().col(1).dot(v) * frame().col(1); }
  /// The point for which every product with it is the point itself, over x . y.
  static V middle() { return V(0.5, 0.5); }
  static bool inside(const V& x) { return x.minCoeff() > 0.0; }
  static V product(const V& a, const V& b) { return a.cwiseProduct(b); }
  static V quotient(const V& b, const V& l) { return b.cwiseQuotient(l); }
  static V nearest(const V& v) { return v.cwiseMax(0.0); }

  static double reach(const V& x, const V& dx) {
    double most = HUGE_VAL;
    for (int k = 0; k < 2; ++k)
      if (dx[k] < 0.0) most = std::min(most, -x[k] / dx[k]);
    return most;
  }

  static void scaling(const V& x, const V& y, M& Q, V& phi) {
    Q.setIdentity();
    phi = y.cwiseQuotient(x).cwiseSqrt();
  }
};

/// In space, as [normal, tangents].
template <>
struct InteriorCone<3> {
  using V = Eigen::Vector3d;
  using M = Eigen::Matrix3d;
  static M frame() { return M::Identity(); }
  static V normal() { return V::UnitX(); }
  static V tangential(const V& v) { return {0.0, v[1], v[2]}; }
  static V middle() { return V::UnitX(); }
  static bool inside(const V& x) { return determinant(x) > 0.0; }

  static double determinant(const V& x) {
    const double t = x.tail<2>().norm();
    return (x[0] - t) * (x[0] + t);
  }

  static V product(const V& a, const V& b) {
    V c;
    c << a.dot(b), a[0] * b.tail<2>() + b[0] * a.tail<2>();
    return c;
  }

  /// x of l o x = b.
  static V quotient(const V& b, const V& l) {
    V x;
    x[0] = (l[0] * b[0] - l.tail<2>().dot(b.tail<2>())) / determinant(l);
    x.tail<2>() = (b.tail<2>() - x[0] * l.tail<2>()) / l[0];
    return x;
  }

  /// The nearest point of the cone.
  static V nearest(const V& v) {
    const double size = v.tail<2>().norm();
    if (size <= v[0]) return v;
    if (size <= -v[0]) return V::Zero();
    const double along = 0.5 * (v[0] + size);
    V x;
    x << along, along / size * v.tail<2>();
    return x;
  }

  /// The largest a for which x + a dx is in the cone.
  static double reach(const V& x, const V& dx) {
    const double a = dx[0] * dx[0] - dx.tail<2>().squaredNorm(), c = determinant(x);
    const double b = x[0] * dx[0] - x.tail<2>().dot(dx.tail<2>()), discriminant = b * b - a * c;
    double most = dx[0] < 0.0 ? -x[0] / dx[0] : HUGE_VAL;
    if (discriminant < 0.0) return most;
    for (const double below : {-b + std::sqrt(discriminant), -b - std::sqrt(discriminant)}) {
      const double root = c / below;
      if (root > 0.0) most = std::min(most, root);
    }
    return most;
  }

  /// F = Q diag(phi) Q', for which F x = F^-1 y.
  static void scaling(const V& x, const V& y, M& Q, V& phi) {
    const double size_x = std::sqrt(determinant(x)), size_y = std::sqrt(determinant(y));
    const V x_unit = x / size_x, y_unit = y / size_y;
    Vec2 t = y_unit.tail<2>() - x_unit.tail<2>();
    t /= 2.0 * std::sqrt(0.5 * (1.0 + x_unit.dot(y_unit)));
    const double size = t.norm(), most = std::sqrt(1.0 + size * size) + size;
    const Vec2 along = size > 0.0 ? Vec2(t / size) : Vec2(1.0, 0.0);
    const double half = std::sqrt(0.5);
    Q << half, half, 0.0,                              //
        half * along[0], -half * along[0], -along[1],  //
        half * along[1], -half * along[1], along[0];
    phi = std::sqrt(size_y / size_x) * V(most, 1.0 / most, 1.0);
  }
};

/// [W G; G' 0] with its pattern filled to whole blocks: d x d of the pairs, those of the diagonal included, d x 1 of a
/// pair and a rigid motion.
template <int d>
Eigen::SparseMatrix<double> in_whole_blocks(const Eigen::SparseMatrix<double>& W,
                                            const Eigen::SparseMatrix<double>& G) {
  using Sparse = Eigen::SparseMatrix<double>;
  const Eigen::Index N = W.rows() / d, m = G.cols();
  std::vector<Eigen::Triplet<double>> entries;
  entries.reserve(static_cast<std::size_t>(2 * W.nonZeros() + 4 * G.nonZeros()));
  const auto add = [&](Eigen::Index row, Eigen::Index column, double value) {
    entries.emplace_back(static_cast<int>(row), static_cast<int>(column), value);
  };
  std::vector<Eigen::Index> seen(static_cast<std::size_t>(N), -1);
  for (Eigen::Index j = 0; j < N; ++j) {
    const auto fill = [&](Eigen::Index i) {
      if (seen[static_cast<std::size_t>(i)] == j) return;
      seen[static_cast<std::size_t>(i)] = j;
      for (int k = 0; k < d * d; ++k) add(d * i + k % d, d * j + k / d, 0.0);
    };
    fill(j);
    for (int k = 0; k < d; ++k)
      for (Sparse::InnerIterator at(W, d * j + k); at; ++at) {
        fill(at.row() / d);
        add(at.row(), d * j + k, at.value());
      }
  }
  for (Eigen::Index motion = 0; motion < m; ++motion)
    for (Sparse::InnerIterator at(G, motion); at; ++at) {
      const Eigen::Index first = at.row() - at.row() % d;
      for (int k = 0; k < d; ++k) {
        const double value = first + k == at.row() ? at.value() : 0.0;
        add(first + k, d * N + motion, value);
        add(d * N + motion, first + k, value);
      }
    }
  Sparse result(d * N + m, d * N + m);
  result.setFromTriplets(entries.begin(), entries.end());
  return result;
}

template <int d>
class InteriorSteps {
  using Index = Eigen::Index;
  using Sparse = Eigen::SparseMatrix<double>;
  using C = InteriorCone<d>;
  using V = typename C::V;
  using M = typename C::M;

 public:
  InteriorSteps(const Problem& problem, double start_factor)
      : problem_(problem),
        N_(problem.pairs()),
        m_(problem.G.cols()),
        S_(d * N_),
        phi_(d * N_),
        Q_(blocks()),
        T_(blocks()) {
    const Vector diagonal = problem.W.diagonal();
    const double least =
        interior_constants.least_of_mean * diagonal.mean();  // what a body is held at does not give way
    for (Index i = 0; i < N_; ++i) {
      S_.segment<d>(d * i).setConstant(std::sqrt(std::max(diagonal.segment<d>(d * i).mean(), least)));
      S_[d * i] *= problem.mu[i];
    }
    if (auto joints = find_joints<d>(problem)) lay_out_joints(std::move(*joints));
    if (!joints_) lay_out();
    q_ = in_frame(problem.q.cwiseQuotient(S_));
    f_ = C_.cwiseProduct(problem.f);
    size_of_loads_ = std::hypot(q_.norm(), f_.norm());
    const double start =
        start_factor * std::max(problem.q.cwiseQuotient(S_).template lpNorm<Eigen::Infinity>(), balancing_force());
    x_.resize(d * N_);
    for (Index i = 0; i < N_; ++i) x_.segment<d>(d * i) = start * C::normal();
    y_ = x_;
    a_.setZero(m_);
    slips_.setZero(N_);
  }

  /// The unknowns of one iterate.
  struct Point {
    Vector x, y, a;
  };
  Point point() const { return {x_, y_, a_}; }
  void go_to(const Point& point) { x_ = point.x, y_ = point.y, a_ = point.a; }

  /// y = (u'_n + slips, u'_t) from now on, with no derivative of the slips; one of each pair.
  void hold(Vector slips) {
    held_ = std::move(slips);
    T_.assign(blocks(), M::Identity());
  }

  /// What the steps so far have left is measured by what this iterate has; after evaluate().
  void measure_from_here() { first_gap_ = gap_, first_distance_ = distance(); }

  Index pairs() const { return N_; }
  double gap() const { return gap_; }                                                ///< m
  double distance() const { return std::hypot(distance_.norm(), balance_.norm()); }  ///< |(b, g)|
  double step() const { return step_; }                                              ///< length of the last one
  const Vector& slips() const { return slips_; }                                     ///< |u'_t| of the pairs
  double size_of_loads() const { return size_of_loads_; }                            ///< |(q', f)|
  Vector forces() const { return in_frame(x_).cwiseQuotient(S_); }
  Vector rigid_motions() const { return a_.cwiseProduct(C_); }

  /// Forces whose states are exactly open, stick or slip: the cone's point nearest to x - y. It is x where x o y = 0.
  Vector at_the_boundary() const {
    Vector p(d * N_);
    for (Index i = 0; i < N_; ++i) p.segment<d>(d * i) = C::nearest(part(x_, i) - part(y_, i));
    return in_frame(p).cwiseQuotient(S_);
  }

  void evaluate() {
    Vector u = product(x_) + q_;
    balance_ = f_;
    if (m_ > 0) {
      u += G_ * a_;
      balance_ += G_.transpose() * x_;
    }
    distance_ = u - y_;
    for (Index i = 0; i < N_; ++i) {
      const V u_t = C::tangential(part(u, i));
      const double slip = slips_[i] = u_t.norm();
      distance_.segment<d>(d * i) += (held_.size() > 0 ? held_[i] : slip) * C::normal();
      if (held_.size() > 0) continue;
      M& T = T_[static_cast<std::size_t>(i)];
      T.setIdentity();
      if (slip > 0.0) T += C::normal() * u_t.transpose() / slip;
    }
    gap_ = x_.dot(y_) / static_cast<double>(N_);
  }

  /// False where no step exists.
  bool advance() {
    lambda_.resize(d * N_);
    for (Index i = 0; i < N_; ++i) {
      if (!(C::inside(part(x_, i)) && C::inside(part(y_, i)))) return false;
      V phi;
      C::scaling(part(x_, i), part(y_, i), Q_[static_cast<std::size_t>(i)], phi);
      phi_.segment<d>(d * i) = phi;
      lambda_.segment<d>(d * i) = scaled(i, part(x_, i));
    }
    if (!(joints_ ? factorise_joints() : factorise())) return false;
    Vector affine(d * N_);
    for (Index i = 0; i < N_; ++i) affine.segment<d>(d * i) = -C::product(part(lambda_, i), part(lambda_, i));
    find_direction(affine);
    double step = std::min(1.0, reach());
    const double reached = (x_ + step * dx_).dot(y_ + step * dy_) / static_cast<double>(N_);
    double sigma = std::pow(std::clamp(reached / gap_, 0.0, 1.0), 3);
    const double size = std::hypot(distance_.norm(), balance_.norm());
    if (size * first_gap_ > interior_constants.distance_lag * gap_ * first_distance_ &&
        size > interior_constants.settled * size_of_loads_)
      sigma = std::max(sigma, interior_constants.lagging);
    Vector corrected = affine;
    for (Index i = 0; i < N_; ++i)
      corrected.segment<d>(d * i) +=
          sigma * gap_ * C::middle() - step * C::product(unscaled(i, part(dy_, i)), scaled(i, part(dx_, i)));
    find_direction(corrected);
    step = reach();
    if (step < interior_constants.collapsed) {
      for (Index i = 0; i < N_; ++i) affine.segment<d>(d * i) += interior_constants.centring * gap_ * C::middle();
      find_direction(affine);
      step = reach();
    }
    step_ = std::min(1.0, interior_constants.part * step);
    x_ += step_ * dx_;
    y_ += step_ * dy_;
    a_ += step_ * da_;
    return std::isfinite(step_);
  }

 private:
  void lay_out() {
    const Problem& problem = problem_;
    Sparse W = problem.W.is_sparse() ? problem.W.sparse() : Sparse(problem.W.dense().sparseView());
    for (Index k = 0; k < W.outerSize(); ++k)
      for (Sparse::InnerIterator at(W, k); at; ++at) at.valueRef() /= S_[at.row()] * S_[k];
    const Sparse G = scaled_motions();
    whole_ = in_whole_blocks<d>(W, G);
    turn_to_frame();
    W_ = whole_.topLeftCorner(d * N_, d * N_);
    G_ = whole_.topRightCorner(d * N_, m_);
  }

  /// Without rigid motions: the system is one of joints.
  void lay_out_joints(Joints<d> joints) {
    joints_.emplace(std::move(joints));
    for (Index i = 0; i < N_; ++i) {
      joints_->turn(i, C::frame() * part(S_, i).cwiseInverse().asDiagonal());
      for (int k = 0; k < d; ++k) joints_->pair.push_back(static_cast<int>(i));
    }
    joints_->L.resize(d * N_, JointSystem<d>::R);
    joints_->C.resize(d * N_, JointSystem<d>::R);
    C_.setOnes(0);
  }

  /// W' v.
  Vector product(const Vector& v) const { return joints_ ? joints_->times(v) : Vector(W_ * v); }

  std::size_t blocks() const { return static_cast<std::size_t>(N_); }
  V part(const Vector& v, Index i) const { return v.segment<d>(d * i); }

  /// Coordinates of the cones of [normal, tangents] of every pair, or back.
  Vector in_frame(const Vector& v) const {
    Vector turned(v.size());
    for (Index i = 0; i < N_; ++i) turned.segment<d>(d * i) = C::frame() * part(v, i);
    return turned;
  }

  /// S^-1 G C, C so that every rigid motion is of unit length.
  Sparse scaled_motions() {
    Sparse G = m_ > 0 ? problem_.G.sparse() : Sparse(d * N_, 0);
    C_.setOnes(m_);
    for (Index motion = 0; motion < m_; ++motion) {
      for (Sparse::InnerIterator at(G, motion); at; ++at) at.valueRef() /= S_[at.row()];
      const double size = G.col(motion).norm();
      if (size > 0.0) C_[motion] = 1.0 / size;
      G.col(motion) *= C_[motion];
    }
    return G;
  }

  /// Calls act(block) with the blocks of `whole` (in_whole_blocks) as matrices: of_pairs(row pair, column pair, d x d),
  /// of_motion(row pair, d x 1) in the columns of the motions, of_balance(column pair, g x d) in their rows.
  template <typename OfPairs, typename OfMotion, typename OfBalance>
  void for_each_block(Sparse& whole, const OfPairs& of_pairs, const OfMotion& of_motion, const OfBalance& of_balance) {
    const int *const start = whole.outerIndexPtr(), *const row = whole.innerIndexPtr();
    for (Index j = 0; j < N_; ++j) {
      const int first = start[d * j], rows = start[d * j + 1] - first;
      Eigen::Map<Eigen::Matrix<double, Eigen::Dynamic, d>> column(whole.valuePtr() + first, rows, d);
      int at = 0;
      for (; at < rows && row[first + at] < d * N_; at += d)
        of_pairs(row[first + at] / d, j, column.template middleRows<d>(at));
      of_balance(j, column.bottomRows(rows - at));
    }
    for (Index motion = d * N_; motion < d * N_ + m_; ++motion)
      for (int at = start[motion]; at < start[motion + 1]; at += d)
        of_motion(row[at] / d, Eigen::Map<V>(whole.valuePtr() + at));
  }

  /// Largest force of pairs that balance the rigid motions, bonded and as soft as their bodies: a tower of 200 blocks
  /// presses on its foot with 200 times the weight of one.
  double balancing_force() {
    if (m_ == 0) return 0.0;
    Sparse K = whole_;
    for (Index k = 0; k < d * N_; ++k) K.coeffRef(k, k) += 1.0;
    Vector right(d * N_ + m_), x;
    right << -q_, -f_;
    if (!lu_.factorise(K)) return f_.template lpNorm<Eigen::Infinity>();
    lu_.solve(right, x);
    return x.head(d * N_).template lpNorm<Eigen::Infinity>();
  }

  void turn_to_frame() {
    const M R = C::frame();
    for_each_block(
        whole_, [&](Index, Index, auto block) { block = (R * block * R).eval(); },
        [&](Index, auto block) { block = (R * block).eval(); }, [&](Index, auto block) { block = (block * R).eval(); });
  }

  /// F v and F^-1 v of pair i.
  V scaled(Index i, const V& v) const {
    const M& Q = Q_[static_cast<std::size_t>(i)];
    return Q * part(phi_, i).cwiseProduct(Q.transpose() * v);
  }
  V unscaled(Index i, const V& v) const {
    const M& Q = Q_[static_cast<std::size_t>(i)];
    return Q * (Q.transpose() * v).cwiseQuotient(part(phi_, i));
  }

  bool factorise() {
    assemble();
    return lu_.factorise(K_);
  }

  bool factorise_joints() {
    for (Index i = 0; i < N_; ++i) {
      const M& Q = Q_[static_cast<std::size_t>(i)];
      joints_->L.template middleRows<d>(d * i) = Q.transpose() * T_[static_cast<std::size_t>(i)] * joints_->A(i);
      joints_->C.template middleRows<d>(d * i) = Q.transpose() * joints_->A(i);
    }
    joints_->D = phi_.cwiseAbs2();
    return joints_->factorise();
  }

  /// K z = b.
  Vector solved(const Vector& b) const {
    Vector z;
    if (joints_) {
      joints_->solve_refined(b, z);
      return z;
    }
    Vector correction, rest = b;
    lu_.solve(b, z);
    rest -= K_ * z;  // once refined: the last digits of the forces hang on it
    lu_.solve(rest, correction);
    return z + correction;
  }

  /// K = [diag(phi)^2 + Q' T W' Q, Q' T G'; G'^T Q, 0], by block columns.
  void assemble() {
    K_ = whole_;
    const auto left = [&](Index i) -> M {
      return Q_[static_cast<std::size_t>(i)].transpose() * T_[static_cast<std::size_t>(i)];
    };
    for_each_block(
        K_,
        [&](Index i, Index j, auto block) {
          block = (left(i) * block * Q_[static_cast<std::size_t>(j)]).eval();
          if (i == j) block.diagonal() += part(phi_, i).cwiseAbs2();
        },
        [&](Index i, auto block) { block = (left(i) * block).eval(); },
        [&](Index j, auto block) { block = (block * Q_[static_cast<std::size_t>(j)]).eval(); });
  }

  void find_direction(const Vector& right) {
    Vector c(d * N_), b(d * N_ + m_);
    for (Index i = 0; i < N_; ++i) {
      const M& Q = Q_[static_cast<std::size_t>(i)];
      c.segment<d>(d * i) = part(phi_, i).cwiseProduct(Q.transpose() * C::quotient(part(right, i), part(lambda_, i)));
      b.segment<d>(d * i) = part(c, i) - Q.transpose() * part(distance_, i);
    }
    b.tail(m_) = -balance_;
    const Vector z = solved(b);
    dx_.resize(d * N_);
    for (Index i = 0; i < N_; ++i) dx_.segment<d>(d * i) = Q_[static_cast<std::size_t>(i)] * part(z, i);
    da_ = z.tail(m_);
    dy_ = product(dx_);
    if (m_ > 0) dy_ += G_ * da_;
    for (Index i = 0; i < N_; ++i) {
      // Twice the same, y' = T u' + b and l o (F x' + F^-1 y') = right: each is taken where it loses no digits.
      const M& Q = Q_[static_cast<std::size_t>(i)];
      V of_y = Q.transpose() * (T_[static_cast<std::size_t>(i)] * part(dy_, i) + part(distance_, i));
      for (int k = 0; k < d; ++k) {
        const double phi = phi_[d * i + k];
        if (phi < interior_constants.small_scaling) of_y[k] = c[d * i + k] - phi * phi * z[d * i + k];
      }
      dy_.segment<d>(d * i) = Q * of_y;
    }
  }

  double reach() const {
    double most = HUGE_VAL;
    for (Index i = 0; i < N_; ++i)
      most = std::min({most, C::reach(part(x_, i), part(dx_, i)), C::reach(part(y_, i), part(dy_, i))});
    return most;
  }

  const Problem& problem_;
  Index N_, m_;
  Vector S_, C_, q_, f_, x_, y_, a_, dx_, dy_, da_, lambda_, phi_, distance_, balance_, slips_, held_;
  Sparse W_, G_, whole_, K_;
  std::vector<M> Q_, T_;
  linalg::SparseGeneralSolver lu_;
  std::optional<JointSystem<d>> joints_;  // of rigid bodies
  double size_of_loads_ = 0.0, gap_ = 0.0, first_gap_ = 0.0, first_distance_ = 0.0, step_ = 0.0;
};

/// Judges the iterate of now: the least natural map and its forces are kept in `end`; content: what is handed over.
template <int d>
double judge_iterate(const InteriorSteps<d>& steps, const Problem& problem, const Measure& measure,
                     const IsSolution& content, const char* stage, InteriorPointEnd& end) {
  const Vector p = steps.forces(), a = steps.rigid_motions(), motion = motion_of(problem, p, a);
  const double residual = measure.natural_map(problem, p, motion);
  if (!std::isfinite(residual)) return residual;
  if (residual < end.residual) end.residual = residual, end.p = p, end.a = a;
  end.trace.push_back({end.iterations, residual, 0.5 * steps.gap(), steps.step(), 0, stage});
  if (content && content(p, a, motion)) {
    // What is open carries nothing, what slips carries all it can: where that is a solution too, it is the better one.
    const Vector snapped = steps.at_the_boundary();
    end.p = content(snapped, a, motion_of(problem, snapped, a)) ? snapped : p;
    end.a = a;
    end.content = true;
  }
  return residual;
}

}  // namespace scabo::contact
