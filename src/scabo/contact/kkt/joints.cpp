#include "scabo/contact/kkt/joints.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <unordered_map>
#include <utility>

#include "scabo/contact/constants.hpp"
#include "scabo/contact/kkt/joint_order.hpp"

namespace scabo::contact {

namespace {

using Sparse = Eigen::SparseMatrix<double>;

/// Pairs that each pair is coupled with, itself included, in order.
struct Pattern {
  std::vector<int> first, pairs;
  std::size_t size(int i) const {
    return static_cast<std::size_t>(first[static_cast<std::size_t>(i) + 1] - first[static_cast<std::size_t>(i)]);
  }
  const int* begin(int i) const { return pairs.data() + first[static_cast<std::size_t>(i)]; }
  const int* end(int i) const { return pairs.data() + first[static_cast<std::size_t>(i) + 1]; }
  bool same(int i, int j) const { return size(i) == size(j) && std::equal(begin(i), end(i), begin(j)); }
  std::size_t hash(int i) const {
    std::size_t sum = size(i);
    for (const int* at = begin(i); at != end(i); ++at) sum = 1000003 * sum + static_cast<std::size_t>(*at);
    return sum;
  }
};

Pattern pattern_of(const Problem& problem) {
  Pattern pattern{{0}, {}};
  for (int i = 0; i < problem.pairs(); ++i) {
    const std::vector<int> beside = pairs_beside(problem, i, {i});
    pattern.pairs.insert(pattern.pairs.end(), beside.begin(), beside.end());
    pattern.first.push_back(static_cast<int>(pattern.pairs.size()));
  }
  return pattern;
}

/// The pivots of a joint and the Cholesky factor of their block.
template <int d>
struct Pivots {
  static constexpr int R = Joints<d>::R;
  using Right = Eigen::Matrix<double, R, d>;

  std::vector<int> rows;
  Eigen::Matrix<double, R, R> L = Eigen::Matrix<double, R, R>::Zero();
  int pairs = 0;

  /// L^-1 W_pi.
  Right forward(const Sparse& W, int i) const {
    Right Y = Right::Zero();
    const auto r = static_cast<int>(rows.size());
    for (int a = 0; a < r; ++a)
      for (int k = 0; k < d; ++k) {
        double sum = W.coeff(rows[static_cast<std::size_t>(a)], d * i + k);
        for (int b = 0; b < a; ++b) sum -= L(a, b) * Y(b, k);
        Y(a, k) = sum / L(a, a);
      }
    return Y;
  }

  /// W_ip W_pp^-1.
  typename Joints<d>::Combination combination(const Sparse& W, int i) const {
    Right Y = forward(W, i);
    for (int a = static_cast<int>(rows.size()) - 1; a >= 0; --a)
      for (int k = 0; k < d; ++k) {
        for (int b = a + 1; b < static_cast<int>(rows.size()); ++b) Y(a, k) -= L(b, a) * Y(b, k);
        Y(a, k) /= L(a, a);
      }
    return Y.transpose();
  }

  /// With pair i, and the pivots that it adds; false, and unchanged, where there would be more than R.
  bool take(const Sparse& W, int i) {
    Right Y = forward(W, i);
    Eigen::Matrix<double, d, d> left;
    Eigen::Matrix<double, d, 1> whole;
    for (int k = 0; k < d; ++k) {
      for (int j = 0; j < d; ++j) left(j, k) = W.coeff(d * i + j, d * i + k);
      whole[k] = left(k, k);
    }
    left -= Y.transpose() * Y;
    Pivots more = *this;
    for (int added = 0; added < d; ++added) {
      int best = -1;
      double part = system_constants.independent;
      for (int k = 0; k < d; ++k)
        if (whole[k] > 0.0 && left(k, k) > part * whole[k]) best = k, part = left(k, k) / whole[k];
      if (best < 0) break;
      const auto r = static_cast<int>(more.rows.size());
      if (r == R) return false;
      const double size = std::sqrt(left(best, best));
      more.L.row(r).head(r) = Y.col(best).head(r).transpose();
      more.L(r, r) = size;
      more.rows.push_back(d * i + best);
      Y.row(r) = left.row(best) / size;
      left -= (Y.row(r).transpose() * Y.row(r)).eval();
    }
    ++more.pairs;
    *this = std::move(more);
    return true;
  }
};

/// The pairs by joints.
template <int d>
struct Groups {
  std::vector<int> joint;         // of each pair
  std::vector<Pivots<d>> pivots;  // of each joint
  std::vector<int> example;       // a pair of each joint
};

/// Pairs with the same neighbours and the same R motions; nothing where there are nearly as many joints as pairs.
template <int d>
std::optional<Groups<d>> groups_of(const Sparse& W, const Pattern& pattern, int N) {
  Groups<d> groups;
  std::unordered_multimap<std::size_t, int> of_pattern;
  for (int i = 0; i < N; ++i) {
    const std::size_t hash = pattern.hash(i);
    const auto [begin, end] = of_pattern.equal_range(hash);
    int found = -1, alike = 0;
    for (auto at = begin; at != end && found < 0; ++at) {
      const auto e = static_cast<std::size_t>(at->second);
      if (!pattern.same(i, groups.example[e])) continue;
      if (groups.pivots[e].take(W, i))
        found = at->second;
      else if (++alike == system_constants.most_of_class)
        return {};
    }
    if (found < 0) {
      found = static_cast<int>(groups.pivots.size());
      if (found > N / 2 + 8) return {};
      groups.pivots.emplace_back();
      groups.example.push_back(i);
      if (!groups.pivots.back().take(W, i)) return {};
      of_pattern.emplace(hash, found);
    }
    groups.joint.push_back(found);
  }
  return groups;
}

/// Neighbours and K of every joint; false where W is not symmetric.
template <int d>
bool couple(const Sparse& W, const Pattern& pattern, const Groups<d>& groups, Joints<d>& joints) {
  joints.first.push_back(0);
  std::vector<int> pairs_met(groups.pivots.size(), 0);
  for (std::size_t f = 0; f < groups.pivots.size(); ++f) {
    const int pair = groups.example[f];
    const auto before = static_cast<std::ptrdiff_t>(joints.neighbour.size());
    for (const int* at = pattern.begin(pair); at != pattern.end(pair); ++at) {
      const int e = groups.joint[static_cast<std::size_t>(*at)];
      if (pairs_met[static_cast<std::size_t>(e)]++ == 0) joints.neighbour.push_back(e);
    }
    std::sort(joints.neighbour.begin() + before, joints.neighbour.end());
    for (auto at = joints.neighbour.begin() + before; at != joints.neighbour.end(); ++at) {
      const auto e = static_cast<std::size_t>(*at);
      if (std::exchange(pairs_met[e], 0) != groups.pivots[e].pairs) return false;
      typename Joints<d>::Block K = Joints<d>::Block::Zero();
      const std::vector<int>&rows = groups.pivots[e].rows, &columns = groups.pivots[f].rows;
      for (std::size_t a = 0; a < rows.size(); ++a)
        for (std::size_t b = 0; b < columns.size(); ++b)
          K(static_cast<int>(a), static_cast<int>(b)) = W.coeff(rows[a], columns[b]);
      joints.K.push_back(K);
    }
    joints.first.push_back(static_cast<int>(joints.neighbour.size()));
  }
  return true;
}

/// Whether W = A K A' in every entry, by block columns: K A' of a pair once for every joint.
template <int d>
bool are_those_of(const Sparse& W, const Pattern& pattern, const Joints<d>& joints) {
  const Vector diagonal = W.diagonal();
  std::vector<Eigen::Matrix<double, Joints<d>::R, d>> of_joint(static_cast<std::size_t>(joints.count()));
  for (int j = 0; j < static_cast<int>(joints.A.size()); ++j) {
    const auto f = static_cast<std::size_t>(joints.joint[static_cast<std::size_t>(j)]);
    for (int at = joints.first[f]; at < joints.first[f + 1]; ++at)
      of_joint[static_cast<std::size_t>(joints.neighbour[static_cast<std::size_t>(at)])] =
          joints.K[static_cast<std::size_t>(at)] * joints.A[static_cast<std::size_t>(j)].transpose();
    for (const int* at = pattern.begin(j); at != pattern.end(j); ++at) {
      const auto i = static_cast<std::size_t>(*at);
      const Eigen::Matrix<double, d, d> block = joints.A[i] * of_joint[static_cast<std::size_t>(joints.joint[i])];
      const double size = std::sqrt(diagonal.segment<d>(d * *at).maxCoeff() * diagonal.segment<d>(d * j).maxCoeff());
      for (int k = 0; k < d; ++k)
        for (int c = 0; c < d; ++c)
          if (!(std::abs(W.coeff(d * *at + c, d * j + k) - block(c, k)) <= system_constants.equal_within * size))
            return false;
    }
  }
  return true;
}

}  // namespace

template <int d>
std::optional<Joints<d>> find_joints(const Problem& problem) {
  if (!problem.W.is_sparse() || problem.G.cols() > 0 || problem.dimension != d) return {};
  const Sparse& W = problem.W.sparse();
  const Pattern pattern = pattern_of(problem);
  std::optional<Groups<d>> groups = groups_of<d>(W, pattern, problem.pairs());
  Joints<d> joints;
  if (!groups || !couple(W, pattern, *groups, joints)) return {};
  if (static_cast<double>(joints.K.size()) * Joints<d>::R * Joints<d>::R >
      system_constants.paying * static_cast<double>(W.nonZeros()))
    return {};
  joints.joint = std::move(groups->joint);
  for (int i = 0; i < problem.pairs(); ++i) {
    const auto e = static_cast<std::size_t>(joints.joint[static_cast<std::size_t>(i)]);
    joints.A.push_back(groups->pivots[e].combination(W, i));
  }
  if (!are_those_of(W, pattern, joints)) return {};
  return joints;
}

template std::optional<Joints<2>> find_joints<2>(const Problem& problem);
template std::optional<Joints<3>> find_joints<3>(const Problem& problem);

}  // namespace scabo::contact
