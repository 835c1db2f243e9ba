#include "scabo/contact/path.hpp"

#include <algorithm>
#include <cmath>
#include <functional>
#include <optional>
#include <random>

#include "scabo/base/error.hpp"
#include "scabo/base/interruption.hpp"
#include "scabo/contact/b_differentiable.hpp"
#include "scabo/contact/joint_order.hpp"
#include "scabo/contact/newton.hpp"
#include "scabo/linalg/replaced_rows.hpp"

namespace scabo::contact {

namespace {

using Index = Eigen::Index;

class Path {
  using Sparse = Eigen::SparseMatrix<double>;
  using SparseRows = Eigen::SparseMatrix<double, Eigen::RowMajor>;

  /// What the rows of a pair ask for: its normal row u_n = 0 or p_n = 0, its tangential row u_t = 0 (stick) or p_t +
  /// side mu p_n = 0, where side is the sign of the slip and mu the coefficient against slip of this sign.
  struct Pair {
    bool contact = true;
    int side = 0;  // 0: stick
  };

  /// A quantity of a pair that must not become negative.
  enum class Limit { gap, force, upper, lower, slip };
  struct Next {
    double step = HUGE_VAL;
    Index pair = -1;
    Limit limit = Limit::gap;
  };

 public:
  Path(const Problem& problem, const PathStart& start, const PathOptions& options)
      : problem_(problem), options_(options), N_(problem.pairs()), m_(problem.G.cols()), n_(2 * N_ + m_) {
    W_ = problem.W.is_sparse() ? SparseRows(problem.W.sparse()) : SparseRows(problem.W.dense().sparseView());
    soft_ = options.softness * BDifferentiableEquations(problem, 1.0).r().cwiseInverse();
    Sparse softness(2 * N_, 2 * N_);
    softness.setIdentity();
    softness.diagonal() = soft_;
    W_ += SparseRows(softness);
    G_columns_ = m_ > 0 ? problem.G.sparse() : Sparse(2 * N_, 0);
    G_ = G_columns_;
    W_columns_ = W_;
    if (m_ > 0 && problem.W.is_sparse())
      blocks_ = [this] {
        std::vector<int> pair_of(static_cast<std::size_t>(2 * N_));
        for (std::size_t row = 0; row < pair_of.size(); ++row) pair_of[row] = static_cast<int>(row / 2);
        return JointOrder(problem_).blocks(pair_of);
      };
    hold_.setZero(m_);
    for (Index k = 0; k < m_; ++k) hold_[k] = options.hold * G_columns_.col(k).squaredNorm();
    begin(start);
  }

  PathEnd run() {
    PathEnd end;
    const int most = options_.most > 0 ? options_.most : static_cast<int>(4 * N_) + 100;
    const int patience = options_.patience > 0 ? options_.patience : most / 8;
    int round = 0, least_at = 0, leap_at = changes_between_leaps, between_leaps = changes_between_leaps;
    double least = 1.0, error_before = HUGE_VAL;  // least t of the round
    bool endless = false;                         // t stands still while the bodies move
    std::optional<Next> passed;                   // the limit that the path has just come from
    if (options_.leap > 0) leap_on(end);
    if (!factorise(end)) return finish(end, PathEnd::How::broken);
    while (true) {
      // Not while t grows: a leap would go back to where the path has come from.
      if (options_.leap > 0 && round == 0 && passed && t_ <= end.left && end.changes >= leap_at) {
        leap_ = std::max(leap_, 4.0 * least_leap);
        if (leap_on(end)) {
          if (!factorise(end)) return finish(end, PathEnd::How::broken);
          passed.reset();
          least_at = end.changes;
          between_leaps = changes_between_leaps;
        } else {
          between_leaps *= 2;
        }
        leap_at = end.changes + between_leaps;
      }
      if (passed) {
        if (!renew(end, endless)) return finish(end, PathEnd::How::broken);
        interruption_point();
        options_.deadline.spend(solves_of_a_change * matrix_.operations_of_solve());
        change(*passed);
      }
      if (!find_direction(passed)) return finish(end, PathEnd::How::broken);
      const Next next = nearest_limit(passed);
      endless = std::abs(dt_) < 1e-9;
      const double to_end = dt_ < 0.0 && !endless ? t_ / -dt_ : HUGE_VAL;
      if (to_end <= next.step && to_end < HUGE_VAL) {
        advance(to_end);
        if (round > 0 && options_.hold == 0.0 && has_gone_astray())
          return finish(end, PathEnd::How::broken);  // the point before counts
        arrived_ = z_;
        const double error = take_softness_back(round);
        const bool rests = error <= rounding && error > gain * error_before;  // of forces that are not unique
        if (error <= settled || rests || ++round > options_.rounds) return finish(end, PathEnd::How::arrived);
        error_before = error;
        least = 1.0;
        least_at = end.changes;
        passed.reset();
        const bool loosens = round == 1 && options_.hold > 0.0;  // another matrix
        if (!(loosens ? factorise(end) : place())) return finish(end, PathEnd::How::broken);
        continue;
      }
      const bool falls = !(next.step < (endless ? most_of_motion : HUGE_VAL));
      if (falls || (t_ <= end.left && round == 0)) end.motion = dz_.tail(m_).normalized();
      if (falls) return finish(end, PathEnd::How::endless);
      advance(next.step);
      ++end.changes;
      if (t_ < least) {
        least = t_;
        least_at = end.changes;
        if (round == 0) end.left = t_;
      }
      if (options_.deadline.passed()) return finish(end, PathEnd::How::broken);
      const bool back = end.changes - least_at >= patience;
      if (end.changes >= most || t_ > far || (options_.patience > 0 && back))
        return finish(end, back ? PathEnd::How::turned_back : PathEnd::How::broken);
      passed = next;
    }
  }

 private:
  static constexpr double far = 2.0;                    // t: the path runs away from the problem
  static constexpr double settled = 1e-14;              // of the largest force: what rounding leaves of the softness
  static constexpr double rounding = 1e-9, gain = 0.1;  // up to which what is left of it may no longer fall
  static constexpr double least_force = 1e-300;
  static constexpr double loosened = 1e-4;           // of the hold, once t was 0
  static constexpr double solves_of_a_change = 3.0;  // about
  static constexpr double exact = 1e-8;              // what a direction may lack, over its forces and motions
  static constexpr int least_replaced = 200;         // rows, before a matrix that gives inexact directions is given up
  static constexpr int between_places = 250;         // changes of state, from piece to piece by sums
  static constexpr double most_of_motion = 1e6;      // of all forces and motions so far
  // Leaps: the shortest, the factors after success and failure, |H| relative to the largest force, and how far the path
  // is followed change by change before the next leap; twice as far each time that none succeeds.
  static constexpr double least_leap = 1.0 / 256.0, longer = 2.0, shorter = 0.25, leap_tolerance = 3e-6,
                          exact_states = 1e-11;
  static constexpr int changes_between_leaps = 60, leap_patience = 3;

  /// The way on which the softness is taken back is as short as rounding; where it ends early, the point before counts.
  PathEnd finish(PathEnd& end, PathEnd::How how) {
    if (arrived_.size() > 0 && how != PathEnd::How::arrived) {
      z_ = arrived_;
      how = PathEnd::How::arrived;
    }
    end.how = how;
    end.p = z_.head(2 * N_);
    end.a = z_.tail(m_);
    if (how == PathEnd::How::arrived) {
      end.left = 0.0;
      end.motion.resize(0);
    }
    return std::move(end);
  }

  /// Forces within the cones and motions that agree with them; what is missing to the problem are dq and df.
  void begin(const PathStart& start) {
    pairs_.resize(static_cast<std::size_t>(N_));
    z_.resize(n_);
    z_.tail(m_) = start.a;
    const double force = std::max(start.p.cwiseAbs().mean(), least_force);
    Vector motion = problem_.q + W_ * start.p + G_ * start.a, wanted = Vector::Zero(2 * N_);
    const double length = std::max(motion.cwiseAbs().mean(), force * options_.softness);
    std::minstd_rand random(7);
    std::uniform_real_distribution<double> uniform(0.5, 1.0);
    for (Index i = 0; i < N_; ++i) {
      Pair& pair = pairs_[static_cast<std::size_t>(i)];
      const double margin = start.margin * uniform(random);
      const ContactState state = start.states[static_cast<std::size_t>(i)];
      double normal = std::max(start.p[2 * i], 0.0) + force * (start.pressure + margin);
      double tangent = std::clamp(start.p[2 * i + 1], -(1.0 - margin) * mu_of(i, 1) * normal,
                                  (1.0 - margin) * mu_of(i, -1) * normal);
      if (state == ContactState::open) {
        pair = {false, may_stick(i) && motion[2 * i + 1] < 0.0 ? -1 : 1};
        normal = tangent = 0.0;
        wanted[2 * i] = std::max(motion[2 * i], 0.0) + length * margin;
        wanted[2 * i + 1] = motion[2 * i + 1];
      } else if (!may_stick(i)) {
        pair.side = 1;
        wanted[2 * i + 1] = motion[2 * i + 1];
      } else if (state == ContactState::slip) {
        pair.side = tangent > 0.0 ? -1 : 1;
        tangent = -pair.side * mu_of(i, pair.side) * normal;
        wanted[2 * i + 1] = pair.side * (std::max(pair.side * motion[2 * i + 1], 0.0) + length * margin);
      }
      z_[2 * i] = normal;
      z_[2 * i + 1] = tangent;
    }
    q_ = problem_.q;
    centre_.setZero(2 * N_);
    dq_ = wanted - (q_ + W_ * z_.head(2 * N_) + G_ * start.a);
    f_ = problem_.f + hold_.cwiseProduct(start.a);
    centre_a_ = start.a;
    df_ = -(problem_.f + G_.transpose() * z_.head(2 * N_));
    motion_ = wanted;
  }

  /// Whether forces or motions have changed by more than the softness can have caused.
  bool has_gone_astray() const {
    constexpr double most = 1e-3;
    const auto changed = [](const auto& now, const auto& before) {
      return before.size() > 0 &&
             !((now - before).cwiseAbs().maxCoeff() <= most * before.cwiseAbs().maxCoeff() + least_force);
    };
    return changed(z_.head(2 * N_), arrived_.head(2 * N_)) || changed(z_.tail(m_), arrived_.tail(m_));
  }

  /// From u = q + (W + s) p + G a to u = q + W p + s (p - p_now) + G a: a path once more, with hardly any change.
  /// Returns the motions that go, over the size of all.
  double take_softness_back(int round) {
    t_ = 1.0;
    dq_ = soft_.cwiseProduct(z_.head(2 * N_) - centre_);
    centre_ = z_.head(2 * N_);
    q_ -= dq_;
    df_ = hold_.cwiseProduct(centre_a_ - z_.tail(m_));
    centre_a_ = z_.tail(m_);
    if (round == 0) hold_ *= loosened;
    f_ = problem_.f + hold_.cwiseProduct(centre_a_);
    double held = 0.0;  // forces of what holds the bodies
    for (Index k = 0; k < m_; ++k)
      if (hold_[k] > 0.0) held = std::max(held, std::abs(df_[k]) / G_columns_.col(k).norm());
    return std::max(dq_.lpNorm<Eigen::Infinity>(), held) / std::max(centre_.lpNorm<Eigen::Infinity>(), least_force);
  }

  /// Leaps as far as they succeed; whether any did: the matrix is then to be factorised.
  bool leap_on(PathEnd& end) {
    const int before = end.leaps;
    while (t_ > 0.0 && leap_ >= least_leap && !options_.deadline.passed()) {
      const double to = t_ > 1.001 * leap_ ? t_ - leap_ : 0.0;
      if (!leap_to(to, leap_tolerance, end)) {
        leap_ = shorter * (t_ - to);
        continue;
      }
      leap_ *= longer;
      ++end.leaps;
      end.left = std::min(end.left, t_);
    }
    if (end.leaps > before) leap_to(t_, exact_states, end);  // the path goes on from there
    return end.leaps > before;
  }

  /// Newton's method on the problem at t = `to`, from the point reached.
  bool leap_to(double to, double tolerance, PathEnd& end) {
    Problem there = problem_;
    there.q = q_ + to * dq_;
    there.f = f_ + to * df_;
    BDifferentiableEquations equations(there, 1.0);
    equations.hold(options_.softness, Vector::Zero(2 * N_));
    NewtonOptions newton_options;
    newton_options.iterations = options_.leap;
    newton_options.patience = leap_patience;
    newton_options.relative = tolerance;
    newton_options.deadline = options_.deadline;
    newton_options.stage = "path";
    if (options_.on_factorisation)
      newton_options.on_iteration = [&](const Iteration& iteration) {
        if (iteration.iteration > 0) options_.on_factorisation(z_.head(2 * N_), z_.tail(m_));
      };
    const NewtonEnd reached = newton(equations, z_.head(2 * N_), z_.tail(m_), newton_options);
    end.factorisations += reached.iterations;
    if (!reached.converged) return false;
    z_.head(2 * N_) = reached.p;
    z_.tail(m_) = reached.a;
    t_ = to;
    const Residual at = equations.residual(reached.p, reached.a);
    motion_ = at.motion;
    for (Index i = 0; i < N_; ++i) {
      const Branch& branch = at.branches[static_cast<std::size_t>(i)];
      Pair& pair = pairs_[static_cast<std::size_t>(i)];
      pair.contact = branch.contact && z_[2 * i] > 0.0;
      if (!pair.contact || !may_stick(i)) {
        pair.side = may_stick(i) && motion_[2 * i + 1] < 0.0 ? -1 : 1;
      } else {
        pair.side = branch.tangent == Branch::Tangent::stick ? 0 : branch.along[0] > 0.0 ? -1 : 1;
      }
    }
    return true;
  }

  double mu_of(Index pair, int side) const { return problem_.mu_against(pair, -side); }
  bool may_stick(Index pair) const { return problem_.largest_mu(pair) > 0.0; }

  int capacity() const { return options_.changes + 100; }

  static bool asks_for_motion_in(const std::vector<Pair>& pairs, Index row) {
    const Pair& pair = pairs[static_cast<std::size_t>(row / 2)];
    return row % 2 == 0 ? pair.contact : pair.side == 0;
  }

  /// What row `row` of the matrix of these states adds to `entries`, times `factor`.
  void add_row(const std::vector<Pair>& pairs, Index row, double factor, linalg::ReplacedRows::Row& entries) const {
    const auto add = [&](Index column, double value) {
      entries.emplace_back(static_cast<int>(column), factor * value);
    };
    if (asks_for_motion_in(pairs, row)) {
      for (SparseRows::InnerIterator it(W_, row); it; ++it) add(it.col(), it.value());
      for (SparseRows::InnerIterator it(G_, row); it; ++it) add(2 * N_ + it.col(), it.value());
      return;
    }
    add(row, 1.0);
    const int side = pairs[static_cast<std::size_t>(row / 2)].side;
    if (row % 2 == 1) add(row - 1, side * mu_of(row / 2, side));
  }

  /// Right-hand side of the derivative by t: A z' = b.
  double right_of(const std::vector<Pair>& pairs, Index row) const {
    return asks_for_motion_in(pairs, row) ? -dq_[row] : 0.0;
  }

  bool factorise(PathEnd& end) {
    base_ = pairs_;
    inexact_ = false;
    std::vector<Eigen::Triplet<double>> entries;
    entries.reserve(static_cast<std::size_t>(W_.nonZeros() + 2 * G_.nonZeros() + 2 * N_));
    const auto add = [&](Index row, Index column, double value) {
      entries.emplace_back(static_cast<int>(row), static_cast<int>(column), value);
    };
    linalg::ReplacedRows::Row of_row;
    for (Index row = 0; row < 2 * N_; ++row) {
      of_row.clear();
      add_row(base_, row, 1.0, of_row);
      for (const auto& [column, value] : of_row) add(row, column, value);
      for (SparseRows::InnerIterator it(G_, row); it; ++it) add(2 * N_ + it.col(), row, it.value());
    }
    for (Index k = 0; k < m_; ++k)
      if (hold_[k] > 0.0) add(2 * N_ + k, 2 * N_ + k, -hold_[k]);
    Sparse A(n_, n_);
    A.setFromTriplets(entries.begin(), entries.end());
    ++end.factorisations;
    if (options_.on_factorisation) options_.on_factorisation(z_.head(2 * N_), z_.tail(m_));
    return matrix_.factorise(std::move(A), capacity(), blocks_) && place();
  }

  /// Before a change, on a piece on which t moves (there the matrix is regular): factorises anew where many rows are
  /// replaced, and else places the point after so many changes.
  bool renew(PathEnd& end, bool endless) {
    const auto replaced = static_cast<int>(matrix_.rows().size()) + 2;
    const bool many = replaced > (inexact_ ? least_replaced : options_.changes);
    const bool anew = (many && !endless) || replaced > capacity();
    if (!anew && (endless || end.changes < place_at_)) return true;
    place_at_ = end.changes + between_places;
    return anew ? factorise(end) : place();
  }

  /// The point, and the direction of the piece whose matrix was factorised, without what rounding added from piece to
  /// piece.
  bool place() {
    Vector right(n_), now(n_), z;
    for (Index row = 0; row < 2 * N_; ++row) {
      right[row] = right_of(base_, row);
      now[row] = asks_for_motion_in(pairs_, row) ? -(q_[row] + t_ * dq_[row]) : 0.0;
    }
    right.tail(m_) = -df_;
    now.tail(m_) = -(f_ + t_ * df_);
    slope_ = matrix_.solve_before(right);
    if (!matrix_.solve(now, z) || !slope_.allFinite()) return false;
    z_ = z;
    motion_ = q_ + t_ * dq_ + W_columns_ * z_.head(2 * N_) + G_columns_ * z_.tail(m_);
    return true;
  }

  /// The pair at its limit takes its next state.
  void change(const Next& at) {
    Pair& pair = pairs_[static_cast<std::size_t>(at.pair)];
    const Index normal = 2 * at.pair, tangent = normal + 1;
    switch (at.limit) {
      case Limit::gap: {
        const int side = may_stick(at.pair) && motion_[tangent] < 0.0 ? -1 : 1;
        pair.contact = true;
        replaced(normal);
        if (side != pair.side) {
          pair.side = side;
          replaced(tangent);
        }
        return;
      }
      case Limit::force:
        pair.contact = false;
        return replaced(normal);
      case Limit::upper:  // p_t = mu p_n: slips backward
        pair.side = -1;
        return replaced(tangent);
      case Limit::lower:
        pair.side = 1;
        return replaced(tangent);
      case Limit::slip:
        side_before_ = pair.side;
        pair.side = 0;
        return replaced(tangent);
    }
  }

  void replaced(Index row) {
    linalg::ReplacedRows::Row difference;
    add_row(pairs_, row, 1.0, difference);
    add_row(base_, row, -1.0, difference);
    matrix_.replace(static_cast<int>(row), std::move(difference));
  }

  /// dz / dt on the piece of the states as they are, towards the side of the limit just passed on which it is met.
  bool find_direction(const std::optional<Next>& passed) {
    const std::vector<int>& rows = matrix_.rows();
    Vector change(static_cast<Index>(rows.size()));
    for (std::size_t i = 0; i < rows.size(); ++i)
      change[static_cast<Index>(i)] = right_of(pairs_, rows[i]) - right_of(base_, rows[i]);
    matrix_.solve_from(slope_, change, dz_);
    if (!dz_.allFinite()) return false;
    dt_ = 1.0;
    find_motion();
    if (options_.hold > 0.0 && !make_exact()) return false;
    if (!passed) {
      turn(-1.0);
    } else {
      const Index normal = 2 * passed->pair, tangent = normal + 1;
      const int side = pairs_[static_cast<std::size_t>(passed->pair)].side;
      double leaves = 0.0;
      switch (passed->limit) {
        case Limit::gap:
          leaves = dz_[normal];
          break;
        case Limit::force:
          leaves = d_motion_[normal];
          break;
        case Limit::upper:
        case Limit::lower:
          leaves = side * d_motion_[tangent];
          break;
        case Limit::slip:
          leaves = mu_of(passed->pair, side_before_) * dz_[normal] + side_before_ * dz_[tangent];
          break;
      }
      turn(leaves > 0.0 ? 1.0 : -1.0);
    }
    // Along the path by its own length: where t hardly changes, the bodies move.
    const double size =
        std::max(1.0, dz_.lpNorm<Eigen::Infinity>() / std::max(z_.lpNorm<Eigen::Infinity>(), least_force));
    turn(1.0 / size);
    return true;
  }

  /// Bodies that hardly anything held when the matrix was factorised make what follows from it inexact.
  bool make_exact() {
    const Vector left = left_of_direction();
    const double reached = dz_.lpNorm<Eigen::Infinity>() + d_motion_.lpNorm<Eigen::Infinity>();
    if (left.lpNorm<Eigen::Infinity>() <= exact * reached) return true;
    inexact_ = true;
    Vector more;
    if (!matrix_.solve(left, more)) return false;
    dz_ += more;
    find_motion();
    return true;
  }

  void find_motion() { d_motion_ = dq_ + W_columns_ * dz_.head(2 * N_) + G_columns_ * dz_.tail(m_); }

  /// What the direction lacks to A z' = b.
  Vector left_of_direction() const {
    Vector left(n_);
    for (Index row = 0; row < 2 * N_; ++row) {
      if (asks_for_motion_in(pairs_, row)) {
        left[row] = -d_motion_[row];
      } else {
        left[row] = -dz_[row];
        const int side = pairs_[static_cast<std::size_t>(row / 2)].side;
        if (row % 2 == 1) left[row] -= side * mu_of(row / 2, side) * dz_[row - 1];
      }
    }
    left.tail(m_) = hold_.cwiseProduct(dz_.tail(m_)) - df_ - G_columns_.transpose() * dz_.head(2 * N_);
    return left;
  }

  void turn(double factor) {
    dz_ *= factor;
    d_motion_ *= factor;
    dt_ *= factor;
  }

  Next nearest_limit(const std::optional<Next>& passed) const {
    Next next;
    const double still_force = 1e-13 * dz_.head(2 * N_).lpNorm<Eigen::Infinity>(),
                 still_motion = 1e-13 * d_motion_.lpNorm<Eigen::Infinity>();
    for (Index i = 0; i < N_; ++i) {
      const Pair& pair = pairs_[static_cast<std::size_t>(i)];
      const Index normal = 2 * i, tangent = normal + 1;
      const auto meets = [&](Limit limit, double value, double change, double least) {
        if (!(change < -least) || (passed && passed->pair == i && is_just_left(*passed, limit))) return;
        const double step = std::max(value, 0.0) / -change;
        if (step < next.step) next = {step, i, limit};
      };
      if (!pair.contact) {
        meets(Limit::gap, motion_[normal], d_motion_[normal], still_motion);
      } else if (pair.side == 0) {
        const double forward = mu_of(i, 1), backward = mu_of(i, -1);
        meets(Limit::upper, backward * z_[normal] - z_[tangent], backward * dz_[normal] - dz_[tangent], still_force);
        meets(Limit::lower, forward * z_[normal] + z_[tangent], forward * dz_[normal] + dz_[tangent], still_force);
      } else {
        meets(Limit::force, z_[normal], dz_[normal], still_force);
        if (may_stick(i))
          meets(Limit::slip, pair.side * motion_[tangent], pair.side * d_motion_[tangent], still_motion);
      }
    }
    return next;
  }

  /// The limit on which the path has stood since the change, seen from the new state.
  bool is_just_left(const Next& passed, Limit limit) const {
    switch (passed.limit) {
      case Limit::gap:
        return limit == Limit::force;
      case Limit::force:
        return limit == Limit::gap;
      case Limit::upper:
      case Limit::lower:
        return limit == Limit::slip;
      case Limit::slip:
        return limit == (side_before_ > 0 ? Limit::lower : Limit::upper);
    }
    return false;
  }

  void advance(double step) {
    z_ += step * dz_;
    motion_ += step * d_motion_;
    t_ += step * dt_;
  }

  const Problem& problem_;
  const PathOptions& options_;
  Index N_, m_, n_;
  SparseRows W_, G_;
  Sparse W_columns_, G_columns_;
  Vector soft_, hold_, q_, f_, centre_, centre_a_, dq_, df_, z_, motion_, slope_, dz_, d_motion_;
  Vector arrived_;  // z where t was 0, the softness not yet or only in part taken back; empty before
  double t_ = 1.0, dt_ = -1.0;
  double leap_ = 0.5;
  std::vector<Pair> pairs_, base_;
  linalg::ReplacedRows matrix_;                    // of the states `base_`, with the rows of `pairs_`
  std::function<linalg::OrderedBlocks()> blocks_;  // empty where W is dense
  bool inexact_ = false;                           // directions from the factorised matrix lack more than `exact`
  int side_before_ = 0, place_at_ = between_places;
};

}  // namespace

bool may_follow_path(const Problem& problem) {
  constexpr Index most_dense = 2000;  // rows: a factorisation costs their cube
  return problem.dimension == 2 && problem.pairs() > 0 && problem.cohesion.size() == 0 && problem.tension.size() == 0 &&
         (problem.W.is_sparse() || (problem.W.is_dense() && problem.W.size() <= most_dense));
}

PathEnd follow_path(const Problem& problem, const PathStart& start, const PathOptions& options) {
  ensure(options.hold == 0.0 || options.leap == 0, "follow_path: leaps know nothing of what holds bodies");
  return Path(problem, start, options).run();
}

}  // namespace scabo::contact
