#include "scabo/contact/sweeps/joint_sweeps.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <utility>

namespace scabo::contact {

using Index = Eigen::Index;

template <int d>
JointSweeps<d>::JointSweeps(const Problem& problem, Joints<d> joints)
    : problem_(&problem), joints_(std::move(joints)), pairs_(pair_problems<d>(problem)), order_(pairs_.size()) {
  std::iota(order_.begin(), order_.end(), 0);
  const auto count = static_cast<std::size_t>(joints_.count());
  own_.resize(count);
  motion_.assign(count, Components::Zero());
  for (std::size_t e = 0; e < count; ++e)
    for (int at = joints_.first[e]; at < joints_.first[e + 1]; ++at)
      if (joints_.neighbour[static_cast<std::size_t>(at)] == static_cast<int>(e))
        own_[e] = joints_.K[static_cast<std::size_t>(at)];
}

template <int d>
void JointSweeps<d>::start(const Vector& p) {
  std::vector<Components> resultant(motion_.size(), Components::Zero());
  for (std::size_t i = 0; i < pairs_.size(); ++i)
    resultant[static_cast<std::size_t>(joints_.joint[i])].noalias() +=
        joints_.A[i].transpose() * p.segment<d>(d * static_cast<Index>(i));
  std::fill(motion_.begin(), motion_.end(), Components::Zero());
  for (std::size_t e = 0; e < motion_.size(); ++e)
    for (int at = joints_.first[e]; at < joints_.first[e + 1]; ++at)
      motion_[static_cast<std::size_t>(joints_.neighbour[static_cast<std::size_t>(at)])].noalias() +=
          joints_.K[static_cast<std::size_t>(at)] * resultant[e];
}

template <int d>
void JointSweeps<d>::leave(int joint) {
  const auto e = static_cast<std::size_t>(joint);
  if (left_.isZero(0.0)) return;
  for (int at = joints_.first[e]; at < joints_.first[e + 1]; ++at) {
    const int f = joints_.neighbour[static_cast<std::size_t>(at)];
    if (f != joint) motion_[static_cast<std::size_t>(f)].noalias() += joints_.K[static_cast<std::size_t>(at)] * left_;
  }
  left_.setZero();
}

template <int d>
void JointSweeps<d>::reorder(std::minstd_rand& random) {
  std::shuffle(order_.begin(), order_.end(), random);
  std::vector<int> place(own_.size());
  std::iota(place.begin(), place.end(), 0);
  std::shuffle(place.begin(), place.end(), random);
  const auto place_of = [&](int i) {
    return place[static_cast<std::size_t>(joints_.joint[static_cast<std::size_t>(i)])];
  };
  std::stable_sort(order_.begin(), order_.end(), [&](int i, int j) { return place_of(i) < place_of(j); });
}

template <int d>
double JointSweeps<d>::sweep(Vector& p) {
  double largest = 0.0;
  int joint = order_.empty() ? 0 : joints_.joint[static_cast<std::size_t>(order_.front())];
  for (const int pair : order_) {
    const auto i = static_cast<std::size_t>(pair);
    if (joints_.joint[i] != joint) {
      leave(joint);
      joint = joints_.joint[i];
    }
    const auto first = d * static_cast<Index>(i);
    Components& motion = motion_[static_cast<std::size_t>(joint)];
    Eigen::Matrix<double, d, 1> moved = joints_.A[i] * motion, change;
    moved += problem_->q.template segment<d>(first);
    if (!pairs_[i].step(moved.data(), p.data() + first, change.data(), largest)) continue;
    const Components resultant = joints_.A[i].transpose() * change;
    motion.noalias() += own_[static_cast<std::size_t>(joint)] * resultant;
    left_ += resultant;
  }
  leave(joint);
  return largest;
}

template class JointSweeps<2>;
template class JointSweeps<3>;

}  // namespace scabo::contact
