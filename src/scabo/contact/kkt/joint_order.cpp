#include "scabo/contact/kkt/joint_order.hpp"

#include <algorithm>

#include "scabo/linalg/elimination_order.hpp"

namespace scabo::contact {

namespace {

void make_set(std::vector<int>& numbers) {
  std::sort(numbers.begin(), numbers.end());
  numbers.erase(std::unique(numbers.begin(), numbers.end()), numbers.end());
}

/// The rigid motions that each pair measures, ascending; the same for all pairs of a joint.
std::vector<std::vector<int>> motions_of_pairs(const Problem& problem) {
  std::vector<std::vector<int>> motions(static_cast<std::size_t>(problem.pairs()));
  if (problem.G.cols() == 0) return motions;
  const RigidMap::Sparse& G = problem.G.sparse();
  for (Eigen::Index k = 0; k < G.cols(); ++k)
    for (RigidMap::Sparse::InnerIterator it(G, k); it; ++it) {
      std::vector<int>& of_pair = motions[static_cast<std::size_t>(it.row() / problem.dimension)];
      if (of_pair.empty() || of_pair.back() != k) of_pair.push_back(static_cast<int>(k));
    }
  return motions;
}

}  // namespace

std::vector<int> pairs_beside(const Problem& problem, Eigen::Index pair, std::vector<int> with) {
  const Eigen::Index d = problem.dimension;
  for (Eigen::Index row = d * pair; row < d * (pair + 1); ++row)
    for (Eigen::SparseMatrix<double>::InnerIterator it(problem.W.sparse(), row); it; ++it)
      if (const auto other = static_cast<int>(it.row() / d); with.empty() || with.back() != other)
        with.push_back(other);
  make_set(with);
  return with;
}

JointOrder::JointOrder(const Problem& problem) {
  const Eigen::Index N = problem.pairs(), m = problem.G.cols();
  const std::vector<std::vector<int>> motions = motions_of_pairs(problem);
  joint_of_pair_.resize(static_cast<std::size_t>(N));
  std::vector<std::vector<int>> beside;  // pairs beside each joint
  std::vector<std::vector<int>> joints_of(static_cast<std::size_t>(m));
  for (Eigen::Index i = 0; i < N; ++i) {
    const auto pair = static_cast<std::size_t>(i);
    std::vector<int> own = pairs_beside(problem, i);
    if (i == 0 || motions[pair] != motions[pair - 1] || own != beside.back()) {
      for (const int k : motions[pair])
        joints_of[static_cast<std::size_t>(k)].push_back(static_cast<int>(beside.size()));
      beside.push_back(std::move(own));
    }
    joint_of_pair_[pair] = static_cast<int>(beside.size()) - 1;
  }

  // Rigid bodies have no W; their joints are neighbours by their motions.
  const auto joints = static_cast<int>(beside.size());
  std::vector<Eigen::Triplet<double>> edges;
  for (int joint = 0; joint < joints; ++joint) {
    edges.emplace_back(joint, joint, 1.0);
    int last = -1;
    for (const int pair : beside[static_cast<std::size_t>(joint)]) {
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
