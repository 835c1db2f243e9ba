// Sweeps of Gauss-Seidel (gauss_seidel.hpp) over pairs of rigid bodies with W = A K A' of their joints (joints.hpp).
// The same pairs in the same order with the same result; the motion of a joint is kept by its R components, those of
// its own forces are added at once and those of other joints when the sweep leaves it.
#pragma once

#include <vector>

#include "scabo/contact/kkt/joints.hpp"
#include "scabo/contact/sweeps/pair_problem.hpp"

namespace scabo::contact {

template <int d>
class JointSweeps {
 public:
  /// The problem must outlive this object.
  JointSweeps(const Problem& problem, Joints<d> joints);
  /// The motions of the joints anew: for a start, and when rounding has accumulated.
  void start(const Vector& p);
  /// One sweep; returns the largest change of a force component.
  double sweep(Vector& p);
  /// q + W p after the last sweep.
  Vector motion() const;

 private:
  static constexpr int R = Joints<d>::R;
  using Components = Eigen::Matrix<double, R, 1>;
  void leave(int joint);

  const Problem* problem_;
  Joints<d> joints_;
  std::vector<PairProblem<d>> pairs_;
  std::vector<typename Joints<d>::Block> own_;  // K of each joint with itself
  std::vector<Components> motion_;              // of the pivots of each joint, K A'p
  Components left_ = Components::Zero();        // A'dp of the joint that is swept, not yet added to others
};

extern template class JointSweeps<2>;
extern template class JointSweeps<3>;

}  // namespace scabo::contact
