// Joints of rigid bodies: W in the motions of whole joints instead of single pairs.
//
// All pairs between the same two rigid bodies move together. Their motions u and the motion of any body that their
// forces cause are those of one relative rigid motion, of at most R components (3 in the plane, 6 in space), however
// many pairs there are: with R rows of W of the joint as its pivots, all others are combinations of them. With the
// combinations A (dN x RJ, each pair in the columns of its joint) and the rows and columns K of W at the pivots,
//
//     W = A K A',   A = W_p W_pp^-1 within each joint, W_p its rows at the pivots, W_pp its own block of K
//
// Linear systems (joint_system.hpp) become cheaper by 5 to 50.
//
// Nothing but W is needed: pairs of one joint have the same neighbours in W, and what is found is compared with every
// entry of W.
#pragma once

#include <optional>
#include <vector>

#include "scabo/contact/problem.hpp"

namespace scabo::contact {

template <int d>
struct Joints {
  static constexpr int R = d == 3 ? 6 : 3;
  using Combination = Eigen::Matrix<double, d, R, Eigen::RowMajor>;
  using Block = Eigen::Matrix<double, R, R>;

  std::vector<int> joint;             ///< N, of every pair
  std::vector<Combination> A;         ///< N; columns beyond the rank of the joint are zero, as those of K
  std::vector<int> first, neighbour;  ///< J + 1; joints coupled with joint e: first[e] .. first[e + 1], e included
  std::vector<Block> K;               ///< K(neighbour, e)
  int count() const { return static_cast<int>(first.size()) - 1; }
};

/// Nothing if W is not sparse, there are rigid motions, the pairs do not move so, or K has more than 0.4 of the entries
/// of W.
template <int d>
std::optional<Joints<d>> find_joints(const Problem& problem);

extern template std::optional<Joints<2>> find_joints<2>(const Problem& problem);
extern template std::optional<Joints<3>> find_joints<3>(const Problem& problem);

}  // namespace scabo::contact
