#include "scabo/contact/joint_order.hpp"

#include <algorithm>

#include "scabo/linalg/elimination_order.hpp"

namespace scabo::contact {

namespace {

void make_set(std::vector<int>& numbers) {
  std::sort(numbers.begin(), numbers.end());
  numbers.erase(std::unique(numbers.begin(), numbers.end()), numbers.end());
}

/// First rigid motions, then pairs of which each pair's own motion depends.
std::pair<std::vector<int>, std::vector<int>> neighbours_of(const Problem& problem,
                                                            const Eigen::SparseMatrix<double, Eigen::RowMajor>& motions,
                                                            Eigen::Index pair) {
  std::vector<int> of_motions, of_pairs;
  const Eigen::Index d = problem.dimension;
  for (Eigen::Index row = d * pair; row < d * (pair + 1); ++row) {
    for (Eigen::SparseMatrix<double>::InnerIterator it(problem.W.sparse(), row); it; ++it)
      if (const auto other = static_cast<int>(it.row() / d); of_pairs.empty() || of_pairs.back() != other)
        of_pairs.push_back(other);
    if (motions.cols() > 0)
      for (Eigen::SparseMatrix<double, Eigen::RowMajor>::InnerIterator it(motions, row); it; ++it)
        of_motions.push_back(static_cast<int>(it.col()));
  }
  make_set(of_motions);
  make_set(of_pairs);
  return {std::move(of_motions), std::move(of_pairs)};
}

}  // namespace

JointOrder::JointOrder(const Problem& problem) {
  const Eigen::Index N = problem.pairs(), m = problem.G.cols();
  Eigen::SparseMatrix<double, Eigen::RowMajor> motions;
  if (m > 0) motions = problem.G.sparse();
  joint_of_pair_.resize(static_cast<std::size_t>(N));
  std::pair<std::vector<int>, std::vector<int>> before;
  std::vector<std::vector<int>> pairs_beside;  // of each joint
  std::vector<std::vector<int>> joints_of(static_cast<std::size_t>(m));
  for (Eigen::Index i = 0; i < N; ++i) {
    auto own = neighbours_of(problem, motions, i);
    if (i == 0 || own != before) {
      const auto joint = static_cast<int>(pairs_beside.size());
      for (const int k : own.first) joints_of[static_cast<std::size_t>(k)].push_back(joint);
      pairs_beside.push_back(own.second);
      before = std::move(own);
    }
    joint_of_pair_[static_cast<std::size_t>(i)] = static_cast<int>(pairs_beside.size()) - 1;
  }

  // Rigid bodies have no W; their joints are neighbours by their motions.
  const auto joints = static_cast<int>(pairs_beside.size());
  std::vector<Eigen::Triplet<double>> edges;
  for (int joint = 0; joint < joints; ++joint) {
    edges.emplace_back(joint, joint, 1.0);
    int last = -1;
    for (const int pair : pairs_beside[static_cast<std::size_t>(joint)]) {
      const int other = joint_of_pair_[static_cast<std::size_t>(pair)];
      if (other == last) continue;
      last = other;
      edges.emplace_back(joint, other, 1.0);
      edges.emplace_back(other, joint, 1.0);
    }
  }
  for (const std::vector<int>& of_motion : joints_of)
    for (const int a : of_motion)
      for (const int b : of_motion) edges.emplace_back(a, b, 1.0);
  linalg::SparseMatrix graph(joints, joints);
  graph.setFromTriplets(edges.begin(), edges.end());
  const std::vector<std::int64_t> order = linalg::elimination_order(graph, linalg::Ordering::nested_dissection);
  std::vector<int> place(order.size());
  for (std::size_t k = 0; k < order.size(); ++k) place[static_cast<std::size_t>(order[k])] = static_cast<int>(k);

  for (int& joint : joint_of_pair_) joint = place[static_cast<std::size_t>(joint)];
  later_.resize(order.size());
  for (int joint = 0; joint < joints; ++joint) {
    const int at = place[static_cast<std::size_t>(joint)];
    std::vector<int>& later = later_[static_cast<std::size_t>(at)];
    for (linalg::SparseMatrix::InnerIterator it(graph, joint); it; ++it)
      if (const int other = place[static_cast<std::size_t>(it.row())]; other > at) later.push_back(other);
    std::sort(later.begin(), later.end());
  }
  for (std::vector<int>& of_motion : joints_of) {
    for (int& joint : of_motion) joint = place[static_cast<std::size_t>(joint)];
    make_set(of_motion);
  }
  joints_of_motion_ = std::move(joints_of);
}

linalg::OrderedBlocks JointOrder::blocks(const std::vector<int>& pair_of) const {
  const std::size_t joints = later_.size();
  std::vector<std::vector<int>> members(joints), last_of(joints), motions_of(joints);
  for (std::size_t j = 0; j < pair_of.size(); ++j)
    members[static_cast<std::size_t>(joint_of_pair_[static_cast<std::size_t>(pair_of[j])])].push_back(
        static_cast<int>(j));
  std::vector<int> unheld;  // motions of bodies without forces
  for (std::size_t k = 0; k < joints_of_motion_.size(); ++k) {
    const auto motion = static_cast<int>(k);
    int last = -1;
    for (const int joint : joints_of_motion_[k]) {
      if (members[static_cast<std::size_t>(joint)].empty()) continue;
      motions_of[static_cast<std::size_t>(joint)].push_back(motion);
      last = joint;
    }
    (last < 0 ? unheld : last_of[static_cast<std::size_t>(last)]).push_back(motion);
  }

  linalg::OrderedBlocks blocks;
  std::vector<int> block_of_joint(joints, -1), block_of_motion(joints_of_motion_.size(), -1);
  const auto add_motion = [&](int motion) {
    block_of_motion[static_cast<std::size_t>(motion)] = static_cast<int>(blocks.members.size());
    blocks.members.push_back({static_cast<int>(pair_of.size()) + motion});
    blocks.bare.push_back(blocks.members.back().front());
  };
  for (std::size_t joint = 0; joint < joints; ++joint) {
    if (!members[joint].empty()) {
      block_of_joint[joint] = static_cast<int>(blocks.members.size());
      blocks.members.push_back(std::move(members[joint]));
    }
    for (const int motion : last_of[joint]) add_motion(motion);
  }
  for (const int motion : unheld) add_motion(motion);
  blocks.later.resize(blocks.members.size());
  for (std::size_t joint = 0; joint < joints; ++joint) {
    if (block_of_joint[joint] < 0) continue;
    std::vector<int>& later = blocks.later[static_cast<std::size_t>(block_of_joint[joint])];
    for (const int other : later_[joint])
      if (const int block = block_of_joint[static_cast<std::size_t>(other)]; block >= 0) later.push_back(block);
    for (const int motion : motions_of[joint]) later.push_back(block_of_motion[static_cast<std::size_t>(motion)]);
    std::sort(later.begin(), later.end());
  }
  return blocks;
}

}  // namespace scabo::contact
