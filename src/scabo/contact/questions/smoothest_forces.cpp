#include "scabo/contact/questions/smoothest_forces.hpp"

#include <algorithm>
#include <cmath>
#include <map>
#include <numeric>

#include "scabo/linalg/decompositions.hpp"
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
constexpr double solver_rounding = 1e-8;  // of the largest force: by what a solution may be beyond the laws

/// A half-plane of forces of a pair: of_force . p >= least.
struct Limit {
  Vec2 of_force;
  double least;
};

/// How the force of a pair may change: p + C y, C of 2 x columns, within the limits.
struct Freedom {
  int columns = 0;  // 0: it keeps its force
  Eigen::Matrix2d C = Eigen::Matrix2d::Zero();
  std::vector<Limit> limits;
  /// Forces that a pair with tensile strength may carry are not convex where pull becomes pressure; `limits` are those
  /// of their convex hull, and a force of the hull that the pair may not carry is to be in one of these two convex
  /// parts. Empty: `limits` are all there are.
  std::vector<Limit> part_of_pull, part_of_pressure;

  double beyond(const std::vector<Limit>& some, const Vec2& p) const {
    double most = 0.0;
    for (const Limit& limit : some) most = std::max(most, limit.least - limit.of_force.dot(p));
    return most;
  }
};

/// |p_t| <= c + mu (p_n + shift), mu that of the direction.
void add_friction(const Problem& problem, Index i, double shift, std::vector<Limit>& limits) {
  const double cohesion = problem.cohesion_of(i);
  for (const double side : {-1.0, 1.0}) {
    const double mu = problem.mu_against(i, side);
    limits.push_back({{mu, -side}, -cohesion - mu * shift});
  }
}

/// Adds the limits of strength and friction to a pair that sticks or touches. With tensile strength T and cohesion c it
/// may carry -T <= p_n with |p_t| <= c, and 0 <= p_n with |p_t| <= c + mu p_n; the hull of both is |p_t| <= c + mu (p_n
/// + T).
void add_limits_of_stick(const Problem& problem, Index i, Freedom& freedom) {
  const double tension = problem.tension_of(i), cohesion = problem.cohesion_of(i);
  if (std::isinf(tension)) return;
  freedom.limits.push_back({{1.0, 0.0}, -tension});
  if (std::isinf(cohesion)) return;
  add_friction(problem, i, tension, freedom.limits);
  if (!(tension > 0.0) || !(problem.largest_mu(i) > 0.0)) return;
  freedom.part_of_pull = {{{0.0, 1.0}, -cohesion}, {{0.0, -1.0}, -cohesion}};
  freedom.part_of_pressure = {{{1.0, 0.0}, 0.0}};
  add_friction(problem, i, 0.0, freedom.part_of_pressure);
}

/// Those of a pair that slips, or that has no friction, on its side of no normal force: beyond, its bound changes with
/// another slope.
void add_limits_of_slip(const Problem& problem, Index i, bool pulled, Freedom& freedom) {
  const double tension = problem.tension_of(i);
  if (!std::isinf(tension)) freedom.limits.push_back({{1.0, 0.0}, pulled ? -tension : 0.0});
  if (pulled) freedom.limits.push_back({{-1.0, 0.0}, 0.0});
}

/// `still`: motions of the pair's two components up to which it does not move.
Freedom freedom_of(const Problem& problem, const Solution& solution, Index i, const Vec2& still, const Scales& scales) {
  const double p_n = solution.p[2 * i], slip = solution.slip_increment[i];
  const bool moves = std::abs(slip) > still[1];
  const ContactState state = solution.states[static_cast<std::size_t>(i)];
  Freedom freedom;
  if (state == ContactState::open && solution.gap[i] > still[0]) {
    const double cohesion = problem.cohesion_of(i);
    if (moves || !(cohesion > 0.0)) return freedom;
    freedom.C(1, 0) = 1.0;
    freedom.columns = 1;
    freedom.limits = {{{0.0, 1.0}, -cohesion}, {{0.0, -1.0}, -cohesion}};
    return freedom;
  }
  const bool bonded = std::isinf(problem.cohesion_of(i)), two_sided = std::isinf(problem.tension_of(i));
  const bool slips = moves && state != ContactState::stick;
  const bool frictionless = !bonded && problem.largest_mu(i) == 0.0 && problem.cohesion_of(i) == 0.0;
  // Rounding leaves a tensile force where there is none: no strength is in it, and such a pair may press.
  const bool pulled = problem.tension_of(i) > 0.0 && !two_sided && p_n < -no_force * scales.force;
  freedom.C(0, 0) = 1.0;
  freedom.columns = 1;
  if (frictionless || slips) {
    const double against = slip > 0.0 ? -1.0 : 1.0;  // the direction of friction
    if (!frictionless && !pulled) freedom.C(1, 0) = against * problem.mu_against(i, against);
    add_limits_of_slip(problem, i, pulled, freedom);
    return freedom;
  }
  freedom.C(1, 1) = 1.0;
  freedom.columns = 2;
  add_limits_of_stick(problem, i, freedom);
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

/// (1) for a group: its forces p + Z y, and the sum as |R y - aim|^2.
struct Choice {
  std::vector<int> group;
  Vector p;  // 2 for each pair
  Matrix Z;  // 2 for each pair; no columns: the forces are unique
  Matrix R;  // upper triangular
  Vector aim;

  Vec2 force(Index k, const Vector& y) const { return p.segment<2>(2 * k) + Z.middleRows<2>(2 * k) * y; }
};

/// The rows of (1) over y: tractions times sqrt(a) less those of a stress in each point, then the tractions themselves.
void set_sum(const ActionOfPairs& action, const std::vector<int>& points, Choice& choice) {
  const Index rows = choice.p.size(), columns = choice.Z.cols();
  Matrix S(rows, columns);  // along x and y, on B
  Vector s(rows);
  for (Index k = 0; k < rows / 2; ++k) {
    const auto i = static_cast<std::size_t>(choice.group[static_cast<std::size_t>(k)]);
    Eigen::Matrix2d turned;
    turned << action.normal[i], tangent_of(action.normal[i]);
    turned /= std::sqrt(action.area[static_cast<Index>(i)]);
    S.middleRows<2>(2 * k) = turned * choice.Z.middleRows<2>(2 * k);
    s.segment<2>(2 * k) = turned * choice.p.segment<2>(2 * k);
  }
  Matrix all = Matrix::Zero(2 * rows, columns);
  Vector right = Vector::Zero(2 * rows);
  all.bottomRows(rows) = shortness * S;
  right.tail(rows) = -shortness * s;
  if (*std::max_element(points.begin(), points.end()) >= 0) {
    const Matrix T = tractions_of_stresses(choice.group, points, action);
    const Eigen::CompleteOrthogonalDecomposition<Matrix> fit(T);
    const Matrix left = S - T * fit.solve(S);
    const Vector of_p = s - T * fit.solve(s);
    for (Index k = 0; k < rows / 2; ++k) {
      if (points[static_cast<std::size_t>(k)] < 0) continue;
      all.middleRows<2>(2 * k) = left.middleRows<2>(2 * k);
      right.segment<2>(2 * k) = -of_p.segment<2>(2 * k);
    }
  }
  const Eigen::HouseholderQR<Matrix> qr(all);
  choice.R = qr.matrixQR().topRows(columns).triangularView<Eigen::Upper>();
  choice.aim = (qr.householderQ().transpose() * right).head(columns);
}

Choice choice_of(const std::vector<int>& group, Index columns, const Network& network,
                 const std::vector<Freedom>& freedom, const ActionOfPairs& action, const Vector& p) {
  Choice choice;
  choice.group = group;
  const Matrix free = null_space(network.equilibrium_of(group, columns));
  const auto rows = 2 * static_cast<Index>(group.size());
  choice.p.resize(rows);
  choice.Z.resize(rows, free.cols());
  for (Index k = 0, column = 0; k < rows / 2; ++k) {
    const int i = group[static_cast<std::size_t>(k)];
    const Freedom& at = freedom[static_cast<std::size_t>(i)];
    choice.p.segment<2>(2 * k) = p.segment<2>(2 * Index{i});
    choice.Z.middleRows<2>(2 * k) = at.C.leftCols(at.columns) * free.middleRows(column, at.columns);
    column += at.columns;
  }
  if (free.cols() > 0) set_sum(action, network.points_of(group), choice);
  return choice;
}

/// The y of the least sum within limits of the pairs of the group, one list for each. `rounding`: by how much the
/// forces of the solution may be beyond limits that they keep.
Vector least_within(const Choice& choice, const std::vector<std::vector<Limit>>& limits, double rounding) {
  Index count = 0;
  for (const std::vector<Limit>& of_pair : limits) count += static_cast<Index>(of_pair.size());
  Matrix B(count, choice.Z.cols());
  Vector h(count);
  for (Index k = 0, row = 0; k < static_cast<Index>(limits.size()); ++k)
    for (const Limit& limit : limits[static_cast<std::size_t>(k)]) {
      B.row(row) = limit.of_force.transpose() * choice.Z.middleRows<2>(2 * k);
      h[row] = limit.least - limit.of_force.dot(choice.p.segment<2>(2 * k));
      if (!(B.row(row).norm() > dependent * limit.of_force.norm())) {
        B.row(row).setZero();  // rounding: no y changes this
        h[row] = std::min(h[row], 0.0);
      }
      ++row;
    }
  const auto R = choice.R.triangularView<Eigen::Upper>();
  Matrix scaled = R.solve<Eigen::OnTheRight>(B);
  Vector least = h;
  for (Index l = 0; l < count; ++l) {
    if (least[l] > 0.0 && least[l] <= rounding) least[l] = 0.0;  // as if the solution itself, y = 0, were within
    if (const double size = scaled.row(l).norm(); size > 0.0) {
      scaled.row(l) /= size;
      least[l] /= size;
    }
  }
  return within(B, h, R.solve(linalg::nearest_within(scaled, least, choice.aim)));
}

/// Change of the forces of a group, 2 for each of its pairs; empty where they are unique. Forces of the hulls of what
/// pairs with tensile strength may carry are looked for first: which convex part a pair belongs to then follows from
/// the forces that are wanted, and not from those that the solver happened to find.
Vector change_of(const Choice& choice, const std::vector<Freedom>& freedom, const Scales& scales) {
  if (choice.Z.cols() == 0) return {};
  const double rounding = solver_rounding * scales.force;
  const auto of_pair = [&](Index k) -> const Freedom& {
    return freedom[static_cast<std::size_t>(choice.group[static_cast<std::size_t>(k)])];
  };
  const auto pairs = static_cast<Index>(choice.group.size());
  std::vector<std::vector<Limit>> limits;
  for (Index k = 0; k < pairs; ++k) limits.push_back(of_pair(k).limits);
  std::vector<char> decided(choice.group.size(), 0);
  Vector y = least_within(choice, limits, rounding);
  for (bool again = true; again;) {
    again = false;
    for (Index k = 0; k < pairs; ++k) {
      const Freedom& at = of_pair(k);
      const Vec2 force = choice.force(k, y);
      const double pull = at.beyond(at.part_of_pull, force), pressure = at.beyond(at.part_of_pressure, force);
      if (decided[static_cast<std::size_t>(k)] || !(std::min(pull, pressure) > rounding)) continue;
      const std::vector<Limit>& part = pull < pressure ? at.part_of_pull : at.part_of_pressure;
      auto& own = limits[static_cast<std::size_t>(k)];
      own.insert(own.end(), part.begin(), part.end());
      decided[static_cast<std::size_t>(k)] = 1;
      again = true;
    }
    if (again) y = least_within(choice, limits, rounding);
  }
  return choice.Z * y;
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
    const Vector change = change_of(choice_of(group, columns, network, freedom, action, solution.p), freedom, scales);
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
