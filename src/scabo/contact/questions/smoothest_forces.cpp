#include "scabo/contact/questions/smoothest_forces.hpp"

#include <Eigen/QR>
#include <algorithm>
#include <cmath>
#include <map>
#include <numeric>

#include "scabo/linalg/least_distance.hpp"

namespace scabo::contact {

namespace {

using Index = Eigen::Index;

constexpr Index most_columns = 150;       // of a group, which is solved by dense matrices: 0.1 s
constexpr double no_motion = 1e-12;       // of the length scale, beyond what rigid motions lose
constexpr double dependent = 1e-10;       // of entries of A, which are parts of 1
constexpr double shortness = 1e-5;        // sqrt(E)
constexpr double worth_changing = 1e-12;  // of the largest force
constexpr double no_force = 1e-13;        // of the largest force: such a pair is open

/// How the force of a pair may change: p + C y, C of 2 x columns, with rows y -> limit . y >= bound.
struct Freedom {
  int columns = 0;  // 0: it keeps its force
  Eigen::Matrix2d C = Eigen::Matrix2d::Zero();
  struct Limit {
    Vec2 row;
    double bound;
  };
  std::vector<Limit> limits;
};

/// Adds the limits of strength and friction to a pair. What a pair with tensile strength may carry is not convex where
/// it changes from pull to pressure: of one that sticks and has no more shear than its cohesion, the part taken is that
/// with no more shear than its cohesion, -tension <= p_n; of any other, that on its side, p_n >= 0 or
/// -tension <= p_n <= 0 (`pulled`).
void add_limits(const Problem& problem, Index i, double p_n, double p_t, bool sticks, bool pulled, Freedom& freedom) {
  const double tension = problem.tension_of(i), cohesion = problem.cohesion_of(i);
  const auto add = [&](const Vec2& of_force, double least) {
    freedom.limits.push_back({freedom.C.transpose() * of_force, least - of_force[0] * p_n - of_force[1] * p_t});
  };
  const bool bound_by_friction = sticks && !std::isinf(cohesion);
  const bool by_cohesion = pulled || (tension > 0.0 && std::abs(p_t) <= cohesion);
  if (!std::isinf(tension)) add({1.0, 0.0}, pulled || (bound_by_friction && by_cohesion) ? -tension : 0.0);
  if (pulled && !sticks) add({-1.0, 0.0}, 0.0);  // beyond, the bound grows with mu
  if (!bound_by_friction) return;
  add({by_cohesion ? 0.0 : problem.mu_against(i, -1.0), 1.0}, -cohesion);
  add({by_cohesion ? 0.0 : problem.mu_against(i, 1.0), -1.0}, -cohesion);
}

/// `still`: motions of the pair's two components up to which it does not move.
Freedom freedom_of(const Problem& problem, const Solution& solution, Index i, const Vec2& still, const Scales& scales) {
  const double p_n = solution.p[2 * i], p_t = solution.p[2 * i + 1], slip = solution.slip_increment[i];
  const bool moves = std::abs(slip) > still[1];
  const ContactState state = solution.states[static_cast<std::size_t>(i)];
  Freedom freedom;
  if (state == ContactState::open && solution.gap[i] > still[0]) return freedom;
  const bool bonded = std::isinf(problem.tension_of(i));
  const bool slips = moves && state != ContactState::stick;
  const bool frictionless = !bonded && problem.largest_mu(i) == 0.0 && problem.cohesion_of(i) == 0.0;
  // Rounding leaves a tensile force where there is none: no strength is in it, and such a pair may press.
  const bool pulled = problem.tension_of(i) > 0.0 && p_n < -no_force * scales.force;
  freedom.C(0, 0) = 1.0;
  freedom.columns = 1;
  if (frictionless || slips) {
    const double against = slip > 0.0 ? -1.0 : 1.0;  // the direction of friction
    if (!frictionless && !pulled) freedom.C(1, 0) = against * problem.mu_against(i, against);
    add_limits(problem, i, p_n, p_t, false, pulled, freedom);
    return freedom;
  }
  freedom.C(1, 1) = 1.0;
  freedom.columns = 2;
  add_limits(problem, i, p_n, p_t, true, pulled, freedom);
  return freedom;
}

/// The pairs whose forces may change, and the blocks of rows in which they act.
class Network {
 public:
  Network(const ActionOfPairs& action, const std::vector<Freedom>& freedom) : action_(action), freedom_(freedom) {
    std::vector<int> block_of(static_cast<std::size_t>(action.on_bodies.rows()));
    for (std::size_t b = 0; b < action.first_row.size(); ++b) {
      const auto end = b + 1 < action.first_row.size() ? action.first_row[b + 1] : action.on_bodies.rows();
      for (auto row = static_cast<std::size_t>(action.first_row[b]); row < static_cast<std::size_t>(end); ++row)
        block_of[row] = static_cast<int>(b);
    }
    blocks_.resize(freedom.size());
    pairs_.resize(action.first_row.size());
    for (std::size_t i = 0; i < freedom.size(); ++i) {
      if (freedom[i].columns == 0) continue;
      for (Index k = 0; k < 2; ++k)
        for (Eigen::SparseMatrix<double>::InnerIterator it(action.on_bodies, static_cast<Index>(2 * i) + k); it; ++it)
          blocks_[i].push_back(block_of[static_cast<std::size_t>(it.row())]);
      std::sort(blocks_[i].begin(), blocks_[i].end());
      blocks_[i].erase(std::unique(blocks_[i].begin(), blocks_[i].end()), blocks_[i].end());
      for (const int b : blocks_[i]) pairs_[static_cast<std::size_t>(b)].push_back(static_cast<int>(i));
    }
    strip();
  }

  /// Pairs that are connected by blocks, each group and the groups in ascending order.
  std::vector<std::vector<int>> groups() const {
    std::vector<std::vector<int>> found;
    std::vector<char> seen(freedom_.size(), 0);
    for (std::size_t first = 0; first < freedom_.size(); ++first) {
      if (!live_[first] || seen[first]) continue;
      std::vector<int> group{static_cast<int>(first)};
      seen[first] = 1;
      for (std::size_t k = 0; k < group.size(); ++k)
        for (const int b : blocks_[static_cast<std::size_t>(group[k])])
          for (const int j : pairs_[static_cast<std::size_t>(b)])
            if (auto& known = seen[static_cast<std::size_t>(j)]; live_[static_cast<std::size_t>(j)] && !known) {
              known = 1;
              group.push_back(j);
            }
      std::sort(group.begin(), group.end());
      found.push_back(std::move(group));
    }
    return found;
  }

  /// A C of the pairs of a group.
  Matrix equilibrium_of(const std::vector<int>& group, Index columns) const {
    std::map<Index, Index> rows;
    for (const int i : group)
      for (Index k = 0; k < 2; ++k)
        for (Eigen::SparseMatrix<double>::InnerIterator it(action_.on_bodies, 2 * Index{i} + k); it; ++it)
          rows.try_emplace(it.row(), static_cast<Index>(rows.size()));
    Matrix A = Matrix::Zero(static_cast<Index>(rows.size()), columns);
    Index column = 0;
    for (const int i : group) {
      const Freedom& freedom = freedom_[static_cast<std::size_t>(i)];
      for (Index k = 0; k < 2; ++k)
        for (Eigen::SparseMatrix<double>::InnerIterator it(action_.on_bodies, 2 * Index{i} + k); it; ++it)
          A.row(rows.at(it.row())).segment(column, freedom.columns) +=
              it.value() * freedom.C.row(k).head(freedom.columns);
      column += freedom.columns;
    }
    return A;
  }

  /// The points that pairs of a group share: a number for each, -1 of a pair that shares none.
  std::vector<int> points_of(const std::vector<int>& group) const {
    std::vector<int> point(group.size(), -1);
    std::map<int, std::vector<std::size_t>> of_block;
    for (std::size_t k = 0; k < group.size(); ++k)
      for (const int b : blocks_[static_cast<std::size_t>(group[k])])
        if (action_.is_point[static_cast<std::size_t>(b)]) of_block[b].push_back(k);
    std::vector<std::size_t> root(group.size());
    std::iota(root.begin(), root.end(), std::size_t{0});
    const auto find = [&](std::size_t k) {
      while (root[k] != k) k = root[k] = root[root[k]];
      return k;
    };
    for (const auto& [b, at] : of_block)
      for (const std::size_t k : at) root[find(k)] = find(at.front());
    std::vector<int> size(group.size(), 0), number(group.size(), -1);
    for (std::size_t k = 0; k < group.size(); ++k) ++size[find(k)];
    int points = 0;
    for (std::size_t k = 0; k < group.size(); ++k) {
      const std::size_t at = find(k);
      if (size[at] < 2) continue;
      if (number[at] < 0) number[at] = points++;
      point[k] = number[at];
    }
    return point;
  }

 private:
  /// Takes out pairs whose force is all that acts in a block, one after the other: it cannot change.
  void strip() {
    live_.assign(freedom_.size(), 0);
    std::vector<int> left(pairs_.size(), 0), due;
    for (std::size_t i = 0; i < freedom_.size(); ++i) live_[i] = freedom_[i].columns > 0;
    for (std::size_t b = 0; b < pairs_.size(); ++b) {
      left[b] = static_cast<int>(pairs_[b].size());
      if (left[b] == 1) due.push_back(static_cast<int>(b));
    }
    while (!due.empty()) {
      const auto b = static_cast<std::size_t>(due.back());
      due.pop_back();
      const auto last = std::find_if(pairs_[b].begin(), pairs_[b].end(),
                                     [&](int i) { return live_[static_cast<std::size_t>(i)] != 0; });
      if (last == pairs_[b].end() || !takes_all(*last, static_cast<int>(b))) continue;
      live_[static_cast<std::size_t>(*last)] = 0;
      for (const int other : blocks_[static_cast<std::size_t>(*last)])
        if (--left[static_cast<std::size_t>(other)] == 1) due.push_back(other);
    }
  }

  /// Whether no change of the force of a pair is without effect in a block.
  bool takes_all(int pair, int block) const {
    const auto b = static_cast<std::size_t>(block);
    const Index first = action_.first_row[b],
                end = b + 1 < action_.first_row.size() ? action_.first_row[b + 1] : action_.on_bodies.rows();
    const Freedom& freedom = freedom_[static_cast<std::size_t>(pair)];
    Eigen::Matrix2d squares = Eigen::Matrix2d::Zero();
    std::map<Index, Vec2> rows;
    for (Index k = 0; k < 2; ++k)
      for (Eigen::SparseMatrix<double>::InnerIterator it(action_.on_bodies, 2 * Index{pair} + k); it; ++it)
        if (it.row() >= first && it.row() < end)
          rows.try_emplace(it.row(), Vec2::Zero()).first->second += it.value() * freedom.C.row(k).transpose();
    for (const auto& [row, entries] : rows) squares += entries * entries.transpose();
    const double small = dependent * dependent;
    return freedom.columns == 1 ? squares(0, 0) > small : squares.determinant() > small * squares.trace();
  }

  const ActionOfPairs& action_;
  const std::vector<Freedom>& freedom_;
  std::vector<std::vector<int>> blocks_;  // of a pair
  std::vector<std::vector<int>> pairs_;   // of a block
  std::vector<char> live_;                // per pair
};

/// An orthonormal basis of the null space of A.
Matrix null_space(const Matrix& A) {
  if (A.rows() == 0) return Matrix::Identity(A.cols(), A.cols());
  Eigen::ColPivHouseholderQR<Matrix> qr(A.transpose());
  qr.setThreshold(dependent);
  const Matrix Q = qr.householderQ();
  return Q.rightCols(A.cols() - qr.rank());
}

/// Columns of the tractions of the stresses in the points of a group, and zero rows for pairs that share none; rows
/// are scaled by sqrt(a).
Matrix tractions_of_stresses(const std::vector<int>& group, const std::vector<int>& points,
                             const ActionOfPairs& action) {
  const int count = 1 + *std::max_element(points.begin(), points.end());
  Matrix T = Matrix::Zero(2 * static_cast<Index>(group.size()), 3 * Index{count});
  for (std::size_t k = 0; k < group.size(); ++k) {
    if (points[k] < 0) continue;
    const Vec2& n = action.normal[static_cast<std::size_t>(group[k])];
    Eigen::Matrix<double, 2, 3> of_stress;
    of_stress << n.x(), 0.0, n.y(), 0.0, n.y(), n.x();
    T.block<2, 3>(2 * static_cast<Index>(k), 3 * Index{points[k]}) = std::sqrt(action.area[group[k]]) * of_stress;
  }
  return T;
}

/// y, moved as little as possible to where B y >= h. It is beyond these limits by rounding, and by as much as the
/// solution is, up to its tolerance.
Vector within(const Matrix& B, const Vector& h, Vector y) {
  std::vector<Index> beyond;
  double before = HUGE_VAL;
  while (true) {
    const Vector room = B * y - h;
    const double least = room.size() > 0 ? room.minCoeff() : 0.0;
    if (least >= 0.0 || -least >= 0.5 * before) return y;
    before = -least;
    for (Index i = 0; i < room.size(); ++i)
      if (room[i] < 0.0 && std::find(beyond.begin(), beyond.end(), i) == beyond.end()) beyond.push_back(i);
    const Matrix held = B(beyond, Eigen::all);
    y += held.completeOrthogonalDecomposition().solve(h(beyond) - held * y);
  }
}

/// Change of the forces of a group, 2 for each of its pairs; empty where they are unique.
Vector change_of(const std::vector<int>& group, Index columns, const Network& network,
                 const std::vector<Freedom>& freedom, const ActionOfPairs& action, const Vector& p) {
  const Matrix Z = null_space(network.equilibrium_of(group, columns));
  if (Z.cols() == 0) return {};
  const auto rows = 2 * static_cast<Index>(group.size());
  Matrix S(rows, Z.cols());  // tractions times sqrt(a) along x and y, on B
  Vector s(rows);
  Matrix CZ(rows, Z.cols());
  std::vector<Freedom::Limit> limits;
  std::vector<std::pair<Index, Index>> of_limit;  // first column and number of columns of its pair
  for (Index k = 0, column = 0; k < rows / 2; ++k) {
    const Index i = group[static_cast<std::size_t>(k)];
    const Freedom& at = freedom[static_cast<std::size_t>(i)];
    const Vec2& n = action.normal[static_cast<std::size_t>(i)];
    Eigen::Matrix2d turned;
    turned << n, tangent_of(n);
    turned /= std::sqrt(action.area[i]);
    CZ.middleRows<2>(2 * k) = at.C.leftCols(at.columns) * Z.middleRows(column, at.columns);
    S.middleRows<2>(2 * k) = turned * CZ.middleRows<2>(2 * k);
    s.segment<2>(2 * k) = turned * p.segment<2>(2 * i);
    for (const Freedom::Limit& limit : at.limits) {
      limits.push_back(limit);
      of_limit.emplace_back(column, at.columns);
    }
    column += at.columns;
  }
  const std::vector<int> points = network.points_of(group);
  Matrix all(2 * rows, Z.cols());
  Vector right(2 * rows);
  all.bottomRows(rows) = shortness * S;
  right.tail(rows) = -shortness * s;
  if (*std::max_element(points.begin(), points.end()) >= 0) {
    const Matrix T = tractions_of_stresses(group, points, action);
    const Eigen::CompleteOrthogonalDecomposition<Matrix> fit(T);
    all.topRows(rows) = S - T * fit.solve(S);
    right.head(rows) = -(s - T * fit.solve(s));
    for (Index k = 0; k < rows / 2; ++k)
      if (points[static_cast<std::size_t>(k)] < 0) {
        all.middleRows<2>(2 * k).setZero();
        right.segment<2>(2 * k).setZero();
      }
  } else {
    all.topRows(rows).setZero();
    right.head(rows).setZero();
  }
  const Eigen::HouseholderQR<Matrix> qr(all);
  const Matrix R = qr.matrixQR().topRows(Z.cols()).triangularView<Eigen::Upper>();
  const Vector aim = (qr.householderQ().transpose() * right).head(Z.cols());
  Matrix B(static_cast<Index>(limits.size()), Z.cols());
  Vector h(B.rows());
  for (Index l = 0; l < B.rows(); ++l) {
    const auto& [column, width] = of_limit[static_cast<std::size_t>(l)];
    const Freedom::Limit& limit = limits[static_cast<std::size_t>(l)];
    B.row(l) = limit.row.head(width).transpose() * Z.middleRows(column, width);
    h[l] = limit.bound;
  }
  const Matrix limits_of_y = B;
  const Vector bounds_of_y = h;
  h = h.cwiseMin(0.0);  // as if the solution itself, y = 0, were within them
  B = R.triangularView<Eigen::Upper>().solve<Eigen::OnTheRight>(B);
  for (Index l = 0; l < B.rows(); ++l)
    if (const double size = B.row(l).norm(); size > 0.0) {
      B.row(l) /= size;
      h[l] /= size;
    }
  const Vector y = R.triangularView<Eigen::Upper>().solve(linalg::nearest_within(B, h, aim));
  return CZ * within(limits_of_y, bounds_of_y, y);
}

}  // namespace

SmoothestForces smoothest_forces(const Problem& problem, const Solution& solution, const ActionOfPairs& action,
                                 const Scales& scales) {
  SmoothestForces result{solution.p};
  std::vector<Freedom> freedom;
  const Vector still =
      rounding_of_rigid_motions(problem, solution.a, scales.length).array() + no_motion * scales.length;
  for (Index i = 0; i < problem.pairs(); ++i)
    freedom.push_back(freedom_of(problem, solution, i, still.segment<2>(2 * i), scales));
  const Network network(action, freedom);
  const double small = worth_changing * scales.force;
  for (const std::vector<int>& group : network.groups()) {
    Index columns = 0;
    for (const int i : group) columns += freedom[static_cast<std::size_t>(i)].columns;
    if (columns > most_columns) {
      result.left += static_cast<int>(group.size());
      continue;
    }
    const Vector change = change_of(group, columns, network, freedom, action, solution.p);
    if (change.size() == 0 || !(change.lpNorm<Eigen::Infinity>() > small)) continue;
    for (std::size_t k = 0; k < group.size(); ++k) {
      const Vec2 of_pair = change.segment<2>(2 * static_cast<Index>(k));
      if (of_pair.isZero(0.0)) continue;
      auto force = result.p.segment<2>(2 * Index{group[k]});
      force += of_pair;
      const bool may_lift = problem.tension_of(group[k]) == 0.0 && problem.cohesion_of(group[k]) == 0.0;
      if (may_lift && force[0] <= no_force * scales.force) force.setZero();  // what rounding leaves of a limit
      ++result.changed;
    }
  }
  return result;
}

}  // namespace scabo::contact
